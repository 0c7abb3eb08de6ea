//! Conversion of values between Python and sessions.

use numpy::{PyArray1, PyArrayMethods};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyFloat, PyInt, PyList, PyString, PyTuple};

use crate::handle::Handle;
use crate::session::NativeSession;
use crate::value::Value;

/// Converts a value to Python. Arrays of numbers become NumPy arrays.
pub fn to_python<'py>(
    session: &Bound<'py, NativeSession>,
    value: Value,
) -> PyResult<Bound<'py, PyAny>> {
    let py = session.py();
    Ok(match value {
        Value::Nothing | Value::Function(_) => py.None().into_bound(py),
        Value::Boolean(truth) => PyBool::new(py, truth).to_owned().into_any(),
        Value::Integer(whole) => whole.into_pyobject(py)?.into_any(),
        Value::Number(number) => PyFloat::new(py, number).into_any(),
        Value::Text(text) => PyString::new(py, &text).into_any(),
        Value::Numbers(numbers) => PyArray1::from_vec(py, numbers).into_any(),
        Value::Integers(whole) => PyArray1::from_vec(py, whole).into_any(),
        Value::Vector([x, y]) => PyArray1::from_vec(py, vec![x, y]).into_any(),
        Value::Vectors(all) => {
            let rows = all.len();
            PyArray1::from_vec(py, all.into_flattened()).reshape([rows, 2])?.into_any()
        }
        Value::Table(columns) => {
            let table = PyDict::new(py);
            for (name, column) in columns {
                table.set_item(name, PyArray1::from_vec(py, column))?;
            }
            py.import("withy._objects")?.call_method1("table", (table,))?
        }
        Value::Array(values) => {
            let values = values.into_iter().map(|value| to_python(session, value));
            PyList::new(py, values.collect::<PyResult<Vec<_>>>()?)?.into_any()
        }
        Value::Map(entries) => {
            let map = PyDict::new(py);
            for (key, value) in entries {
                map.set_item(key, to_python(session, value)?)?;
            }
            map.into_any()
        }
        Value::Object(reference) => {
            let handle = Handle::new(session.clone().unbind(), reference);
            py.import("withy._objects")?.call_method1("wrap", (handle,))?
        }
    })
}

/// Converts a Python object to a value of the session.
///
/// # Errors
/// Fails if the language has no such value, or if the object belongs to another session.
pub fn from_python(
    session: &Bound<'_, NativeSession>,
    object: &Bound<'_, PyAny>,
) -> PyResult<Value> {
    if object.is_none() {
        return Ok(Value::Nothing);
    }
    if let Ok(truth) = object.cast::<PyBool>() {
        return Ok(Value::Boolean(truth.is_true()));
    }
    if object.is_instance_of::<PyInt>() {
        return Ok(Value::Integer(object.extract()?));
    }
    if object.is_instance_of::<PyFloat>() {
        return Ok(Value::Number(object.extract()?));
    }
    if let Ok(text) = object.cast::<PyString>() {
        return Ok(Value::Text(text.to_string()));
    }
    if let Ok(map) = object.cast::<PyDict>() {
        let entry = |(key, value): (Bound<'_, PyAny>, Bound<'_, PyAny>)| {
            Ok((key.extract()?, from_python(session, &value)?))
        };
        return map.iter().map(entry).collect::<PyResult<_>>().map(Value::Map);
    }
    if object.is_instance_of::<PyList>() || object.is_instance_of::<PyTuple>() {
        let values = object.try_iter()?.map(|value| from_python(session, &value?));
        return values.collect::<PyResult<_>>().map(Value::Array);
    }
    from_object(session, object)
}

/// Converts NumPy arrays and numbers, objects of the session, and functions.
fn from_object(session: &Bound<'_, NativeSession>, object: &Bound<'_, PyAny>) -> PyResult<Value> {
    if let Some(handle) = object.getattr_opt("_handle")? {
        let handle = handle.cast::<Handle>()?.get();
        if !handle.is_of(session) {
            let kind = &handle.reference().type_name;
            let message = format!(
                "the {kind} belongs to another session: all objects of a call must be of one session"
            );
            return Err(PyValueError::new_err(message));
        }
        return Ok(Value::Object(handle.reference().clone()));
    }
    // Arrays and numbers of NumPy.
    if let Some(plain) = object.getattr_opt("tolist")? {
        return from_python(session, &plain.call0()?);
    }
    if object.is_callable() {
        return Ok(Value::Function(session.get().register(object.clone().unbind())));
    }
    let message = format!(
        "a value of the type '{}' cannot be passed to withy: use numbers, texts, lists, dictionaries, NumPy arrays, functions, or objects of the session",
        object.get_type().name()?
    );
    Err(PyTypeError::new_err(message))
}
