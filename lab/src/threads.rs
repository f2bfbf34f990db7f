//! How many threads the measurements use.

/// Number of threads; no figure depends on it.
pub(crate) fn threads() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}
