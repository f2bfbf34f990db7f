//! Long work that Ctrl-C can end.

use pyo3::prelude::*;
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::Duration;

/// A stack like the main thread's.
const STACK_BYTES: usize = 8 << 20;

/// How long a signal may wait.
const WAIT: Duration = Duration::from_millis(50);

/// Does work on a thread of its own, without the interpreter's lock. After Ctrl-C it returns at
/// once; the thread ends when the work is done, and its result is dropped.
///
/// # Errors
/// What the handler of a signal raises, such as `KeyboardInterrupt`.
pub(crate) fn interruptible<T: Send + 'static>(
    py: Python<'_>,
    work: impl FnOnce() -> T + Send + 'static,
) -> PyResult<T> {
    let (send, mut receive) = channel();
    let thread = std::thread::Builder::new().stack_size(STACK_BYTES);
    thread.spawn(move || {
        // Whoever has been interrupted no longer listens.
        let _ = send.send(work());
    })?;
    loop {
        let waited;
        (waited, receive) = py.detach(move || (receive.recv_timeout(WAIT), receive));
        match waited {
            Ok(done) => return Ok(done),
            Err(RecvTimeoutError::Timeout) => py.check_signals()?,
            Err(RecvTimeoutError::Disconnected) => {
                let message = "the work has stopped without a result";
                return Err(pyo3::exceptions::PyRuntimeError::new_err(message));
            }
        }
    }
}
