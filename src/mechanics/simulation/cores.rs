//! Available processor cores and threads.

use std::sync::LazyLock;
use std::thread::available_parallelism;

/// True if the target platform can start threads.
pub const HAS_THREADS: bool = cfg!(not(target_family = "wasm"));

/// Number of processor cores available to this process. The number is cached because the system query is slow.
pub fn cores() -> usize {
    static CORES: LazyLock<usize> =
        LazyLock::new(|| available_parallelism().map_or(1, |cores| cores.get()));
    *CORES
}
