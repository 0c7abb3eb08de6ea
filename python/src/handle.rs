//! Reference from Python to a value in the thread of a session.

use pyo3::gc::{PyTraverseError, PyVisit};
use pyo3::prelude::*;

use crate::session::NativeSession;
use crate::value::ObjectReference;

/// Reference to a value of a session. The value is released when the reference is dropped.
#[pyclass(frozen, module = "withy._native")]
pub struct Handle {
    /// Session of the value.
    #[pyo3(get)]
    session: Py<NativeSession>,
    reference: ObjectReference,
}

impl Handle {
    /// Creates a reference.
    pub fn new(session: Py<NativeSession>, reference: ObjectReference) -> Self {
        Self { session, reference }
    }

    /// Number and type of the value.
    pub fn reference(&self) -> &ObjectReference {
        &self.reference
    }

    /// Returns true if the value belongs to `session`.
    pub fn is_of(&self, session: &Bound<'_, NativeSession>) -> bool {
        self.session.is(session)
    }
}

#[pymethods]
impl Handle {
    /// Name of the type of the value in the language.
    #[getter]
    fn type_name(&self) -> &str {
        &self.reference.type_name
    }

    fn __traverse__(&self, visit: PyVisit<'_>) -> Result<(), PyTraverseError> {
        visit.call(&self.session)
    }
}

impl Drop for Handle {
    fn drop(&mut self) {
        self.session.get().release(self.reference.number);
    }
}
