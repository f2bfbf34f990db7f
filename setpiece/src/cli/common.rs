//! What several commands share: exit codes, progress, choices.

use clap::ValueEnum;
use indicatif::{ProgressBar, ProgressStyle};
use std::io::IsTerminal;
use std::time::Duration;

/// Exit code for success.
pub(super) const FINE: u8 = 0;
/// Exit code if the input has errors.
pub(super) const FAULT: u8 = 1;
/// Exit code if the command line has errors.
pub(super) const USAGE: u8 = 2;
/// How often a progress bar and a watcher update.
pub(super) const TICK: Duration = Duration::from_millis(200);

/// When to colour the output.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum ColourChoice {
    /// On a terminal
    Auto,
    /// Always
    Always,
    /// Never
    Never,
}

/// How `check` prints problems.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum MessageFormat {
    /// With the source around them
    Human,
    /// One line each: FILE:LINE:COLUMN: SEVERITY[CODE]: MESSAGE
    Short,
    /// One JSON array
    Json,
}

/// A progress bar on a terminal, nothing elsewhere.
pub(super) fn bar(length: u64, template: &str) -> ProgressBar {
    if !std::io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let style = ProgressStyle::with_template(template);
    let bar = ProgressBar::new(length);
    bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
    bar.enable_steady_tick(TICK);
    bar
}
