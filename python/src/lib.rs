//! Native part of the Python module `withy`: sessions, values and the catalog of the language.

mod catalog;
mod convert;
mod expressions;
mod handle;
mod messages;
mod names;
mod session;
mod value;
mod worker;

/// Native part of the module `withy`.
#[pyo3::pymodule]
mod _native {
    #[pymodule_export]
    use crate::catalog::{Binding, BindingParameter, bindings, types};
    #[pymodule_export]
    use crate::handle::Handle;
    #[pymodule_export]
    use crate::session::NativeSession;
    #[pymodule_export]
    const VERSION: &str = env!("CARGO_PKG_VERSION");
}
