//! Values from JSON to Python and from Python to RON.

use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyFloat, PyInt, PyList, PyString, PyTuple};
use pyo3::{BoundObject, IntoPyObjectExt};
use serde_json::Value;
use std::fmt::Write as _;

/// A JSON value as Python's own.
pub(crate) fn to_python<'py>(py: Python<'py>, value: &Value) -> PyResult<Bound<'py, PyAny>> {
    Ok(match value {
        Value::Null => py.None().into_bound(py),
        Value::Bool(b) => PyBool::new(py, *b).into_bound().into_any(),
        Value::Number(n) => match (n.as_i64(), n.as_u64()) {
            (Some(n), _) => n.into_bound_py_any(py)?,
            (_, Some(n)) => n.into_bound_py_any(py)?,
            _ => n.as_f64().into_bound_py_any(py)?,
        },
        Value::String(text) => PyString::new(py, text).into_any(),
        Value::Array(all) => {
            let list = PyList::empty(py);
            for one in all {
                list.append(to_python(py, one)?)?;
            }
            list.into_any()
        }
        Value::Object(fields) => {
            let dict = PyDict::new(py);
            for (name, one) in fields {
                dict.set_item(name, to_python(py, one)?)?;
            }
            dict.into_any()
        }
    })
}

/// A Python value as RON: numbers, texts, lists, dicts of fields, `{"Variant": value}`, and [`Ron`](ron_of) as it is.
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
    if value.is_instance_of::<PyList>() || value.is_instance_of::<PyTuple>() {
        let all: PyResult<Vec<String>> = value.try_iter()?.map(|one| to_ron(&one?)).collect();
        return Ok(format!("[{}]", all?.join(", ")));
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

/// The text of a `rheotaxis.Ron`.
fn ron_of(value: &Bound<'_, PyAny>) -> PyResult<Option<String>> {
    let ron = value.py().import("rheotaxis")?.getattr("Ron")?;
    value
        .is_instance(&ron)?
        .then(|| value.extract())
        .transpose()
}

fn number(value: f64) -> String {
    if value.is_nan() {
        "NaN".to_string()
    } else {
        format!("{value:?}")
    }
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
            // `{"Depth": 2}` is `Depth(2)`, and `{"Amp": {"speed_m_s": 1}}` is `Amp(speed_m_s: 1)`.
            let inner = to_ron(&value)?;
            let fields = value.is_instance_of::<PyDict>() && inner.starts_with('(');
            return Ok(if fields {
                format!("{name}{inner}")
            } else {
                format!("{name}({inner})")
            });
        }
        written.push(format!("{name}: {}", to_ron(&value)?));
    }
    Ok(format!("({})", written.join(", ")))
}
