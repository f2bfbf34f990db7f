//! What scripts print goes to standard error.

use log::{Level, Log, Metadata, Record};
use std::io::Write;

static STDERR_LOG: StderrLog = StderrLog;

struct StderrLog;

/// Writes the log to standard error from now on, unless the process already has one.
pub(super) fn install() {
    if log::set_logger(&STDERR_LOG).is_ok() {
        log::set_max_level(log::LevelFilter::Debug);
    }
}

impl Log for StderrLog {
    fn enabled(&self, metadata: &Metadata<'_>) -> bool {
        metadata.target().starts_with("setpiece")
    }

    fn log(&self, record: &Record<'_>) {
        if !self.enabled(record.metadata()) {
            return;
        }
        let kind = if record.level() <= Level::Warn { "warning: " } else { "" };
        let _ = writeln!(std::io::stderr(), "{kind}{}", record.args());
    }

    fn flush(&self) {}
}
