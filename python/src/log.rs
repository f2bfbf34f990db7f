//! What scripts print goes to Python's `logging`, under the logger's name.

use log::{Level, Log, Metadata, Record};
use pyo3::prelude::*;

/// The process's logger.
static PYTHON_LOG: PythonLog = PythonLog;

struct PythonLog;

/// Writes the log to Python's `logging` from now on.
pub(crate) fn install() {
    // Whoever came first keeps it: there is one per process.
    if log::set_logger(&PYTHON_LOG).is_ok() {
        log::set_max_level(log::LevelFilter::Debug);
    }
}

impl Log for PythonLog {
    fn enabled(&self, metadata: &Metadata<'_>) -> bool {
        metadata.target().starts_with("setpiece")
    }

    fn log(&self, record: &Record<'_>) {
        if !self.enabled(record.metadata()) {
            return;
        }
        let level = match record.level() {
            Level::Error => 40,
            Level::Warn => 30,
            Level::Info => 20,
            Level::Debug | Level::Trace => 10,
        };
        let text = record.args().to_string();
        // At the end of the process there is no interpreter to write to.
        let _ = Python::try_attach(|py| -> PyResult<()> {
            let logger = py.import("logging")?.call_method1("getLogger", (record.target(),))?;
            logger.call_method1("log", (level, "%s", text)).map(drop)
        });
    }

    fn flush(&self) {}
}
