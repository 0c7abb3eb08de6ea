//! The cores that this process may use.

use std::sync::LazyLock;
use std::thread::available_parallelism;

/// The number of cores that this process may use; asked once, for the system takes its time to answer.
pub fn cores() -> usize {
    static CORES: LazyLock<usize> =
        LazyLock::new(|| available_parallelism().map_or(1, |cores| cores.get()));
    *CORES
}
