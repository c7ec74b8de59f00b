//! Values of scenarios: to Python, and from Python to RON.

use super::tree::Tree;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyFloat, PyInt, PyList, PyString, PyTuple};
use pyo3::{BoundObject, IntoPyObjectExt};
use std::fmt::Write as _;

/// A value of a scenario as Python's own: a variant is `{"Name": value}`, a choice without parameters a `rheotaxis.Ron`.
pub(crate) fn of_tree<'py>(py: Python<'py>, value: &Tree) -> PyResult<Bound<'py, PyAny>> {
    let all =
        |items: &[Tree]| -> PyResult<Vec<Bound<'py, PyAny>>> { items.iter().map(|one| of_tree(py, one)).collect() };
    Ok(match value {
        Tree::None => py.None().into_bound(py),
        Tree::Bool(b) => PyBool::new(py, *b).into_bound().into_any(),
        Tree::Int(n) => n.into_bound_py_any(py)?,
        Tree::Float(v) => v.into_bound_py_any(py)?,
        Tree::Text(text) => PyString::new(py, text).into_any(),
        Tree::Name(name) => ron_type(py)?.call1((name,))?,
        Tree::List(items) => PyList::new(py, all(items)?)?.into_any(),
        Tree::Tuple(items) => PyTuple::new(py, all(items)?)?.into_any(),
        Tree::Fields(fields) => {
            let dict = PyDict::new(py);
            for (name, one) in fields {
                dict.set_item(name, of_tree(py, one)?)?;
            }
            dict.into_any()
        }
        Tree::Variant(name, inner) => {
            let dict = PyDict::new(py);
            dict.set_item(name, of_tree(py, inner)?)?;
            dict.into_any()
        }
    })
}

/// A Python value as RON: numbers, texts, lists, tuples, dicts of fields, `{"Variant": value}`, and [`Ron`](ron_of) as
/// it is.
pub(crate) fn to_ron(value: &Bound<'_, PyAny>) -> PyResult<String> {
    if value.is_none() {
        return Ok("None".to_string());
    }
    if let Some(text) = ron_of(value)? {
        return Ok(text);
    }
    if value.is_instance_of::<PyBool>() {
        return Ok(value.extract::<bool>()?.to_string());
    }
    if value.is_instance_of::<PyInt>() {
        return Ok(value.str()?.to_string());
    }
    if value.is_instance_of::<PyFloat>() {
        return Ok(number(value.extract()?));
    }
    if let Ok(text) = value.cast::<PyString>() {
        return Ok(quoted(&text.to_cow()?));
    }
    if let Ok(fields) = value.cast::<PyDict>() {
        return dict(fields);
    }
    let list = value.is_instance_of::<PyList>();
    if list || value.is_instance_of::<PyTuple>() {
        let all: PyResult<Vec<String>> = value.try_iter()?.map(|one| to_ron(&one?)).collect();
        let all = all?.join(", ");
        return Ok(if list { format!("[{all}]") } else { format!("({all})") });
    }
    // Scalars and arrays of NumPy.
    if value.hasattr("tolist")? {
        return to_ron(&value.call_method0("tolist")?);
    }
    let kind = value.get_type().name()?;
    Err(PyTypeError::new_err(format!(
        "a scenario has no value of type {kind}: give a number, a text, a list, a dict or rheotaxis.Ron(\"...\")"
    )))
}

fn ron_type(py: Python<'_>) -> PyResult<Bound<'_, PyAny>> {
    py.import("rheotaxis")?.getattr("Ron")
}

/// The text of a `rheotaxis.Ron`.
fn ron_of(value: &Bound<'_, PyAny>) -> PyResult<Option<String>> {
    let ron = ron_type(value.py())?;
    value.is_instance(&ron)?.then(|| value.extract()).transpose()
}

fn number(value: f64) -> String {
    if value.is_nan() { "NaN".to_string() } else { format!("{value:?}") }
}

fn quoted(text: &str) -> String {
    let mut quoted = String::from("\"");
    for c in text.chars() {
        match c {
            '"' | '\\' => quoted.extend(['\\', c]),
            '\n' => quoted.push_str("\\n"),
            c if c.is_control() => {
                write!(quoted, "\\u{{{:x}}}", u32::from(c)).expect("writing to a String succeeds");
            }
            c => quoted.push(c),
        }
    }
    quoted.push('"');
    quoted
}

fn dict(fields: &Bound<'_, PyDict>) -> PyResult<String> {
    let mut written = Vec::new();
    for (name, value) in fields {
        let name: String = name.extract()?;
        if fields.len() == 1 && name.starts_with(char::is_uppercase) {
            // `{"Depth": 2}` is `Depth(2)`, `{"Amp": {"speed_m_s": 1}}` is `Amp(speed_m_s: 1)`, and `{"At": (1, 2)}`
            // is `At(1, 2)`.
            let inner = to_ron(&value)?;
            let several = value.is_instance_of::<PyDict>() || value.is_instance_of::<PyTuple>();
            return Ok(if several && inner.starts_with('(') {
                format!("{name}{inner}")
            } else {
                format!("{name}({inner})")
            });
        }
        written.push(format!("{name}: {}", to_ron(&value)?));
    }
    Ok(format!("({})", written.join(", ")))
}
