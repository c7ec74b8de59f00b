//! Arrays of NumPy, made by its own constructor over memory of Python's own.
//!
//! The crate `numpy` would do so too; it needs other features of the linear algebra that the simulator stands on, so
//! that all of it would be built a second time.

use bytemuck::NoUninit;
use pyo3::prelude::*;
use pyo3::types::{PyByteArray, PyTuple};

/// A number as NumPy stores it.
pub(crate) trait Element: NoUninit {
    /// NumPy's name of the type.
    const TYPE: &'static str;
}

impl Element for f64 {
    const TYPE: &'static str = "float64";
}

impl Element for f32 {
    const TYPE: &'static str = "float32";
}

impl Element for i64 {
    const TYPE: &'static str = "int64";
}

impl Element for bool {
    const TYPE: &'static str = "bool";
}

/// An array of a shape, with the values in C order.
pub(crate) fn array<'py, T: Element>(py: Python<'py>, values: &[T], shape: &[usize]) -> PyResult<Bound<'py, PyAny>> {
    let memory = PyByteArray::new(py, bytemuck::cast_slice(values));
    let shape = PyTuple::new(py, shape)?;
    let numpy = py.import("numpy")?;
    numpy.getattr("ndarray")?.call1((shape, T::TYPE, memory))
}

/// A column: an array of one dimension.
pub(crate) fn column<'py, T: Element>(py: Python<'py>, values: &[T]) -> PyResult<Bound<'py, PyAny>> {
    array(py, values, &[values.len()])
}

/// Texts as a column.
pub(crate) fn texts<'py>(py: Python<'py>, texts: &[&'static str]) -> PyResult<Bound<'py, PyAny>> {
    // Few differ, so NumPy is told which they are and where each stands.
    let mut names: Vec<&str> = texts.to_vec();
    names.sort_unstable();
    names.dedup();
    let place = |text: &&str| names.binary_search(text).map_or(0, |n| n as i64);
    let places: Vec<i64> = texts.iter().map(place).collect();
    if names.is_empty() {
        names.push("");
    }
    let numpy = py.import("numpy")?;
    let names = numpy.getattr("asarray")?.call1((names,))?;
    names.call_method1("take", (column(py, &places)?,))
}
