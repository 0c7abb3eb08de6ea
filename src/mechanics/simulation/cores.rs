//! Available processor cores.

use std::sync::LazyLock;
use std::thread::available_parallelism;

/// Number of processor cores available to this process. The value is cached because the system query is slow.
pub fn cores() -> usize {
    static CORES: LazyLock<usize> =
        LazyLock::new(|| available_parallelism().map_or(1, |cores| cores.get()));
    *CORES
}
