//! What scripts print: lines of the log, with the script's file and place.
//!
//! The lines of a call are kept until it ends, because only then their places are known. How many
//! lines a script may write is bounded, and so is their length: each is a string of a script. What
//! a script prints counts as work whether or not anybody reads the log, so that the log decides
//! nothing.

use super::budget::Failable;
use super::words::line_column;
use log::Level;
use rhai::{Array, Dynamic, Engine, FnPtr, ImmutableString, Map, NativeCallContext};
use std::cell::RefCell;
use std::sync::atomic::{AtomicU32, Ordering};

/// The name of the log.
pub(super) const TARGET: &str = "setpiece.script";
/// The most lines of one script, from when it is loaded.
const LINES_MAX: u32 = 1_000;

/// A line that a call has printed.
struct PrintedLine {
    level: Level,
    /// Line and column of the text that runs.
    place: Option<(usize, usize)>,
    text: ImmutableString,
}

thread_local! {
    /// What the current call has printed, and how many lines it may still print.
    static PRINTED: RefCell<(Vec<PrintedLine>, u32)> = const { RefCell::new((Vec::new(), 0)) };
}

/// The number of lines that a script has printed.
#[derive(Debug, Default)]
pub(super) struct Printed(AtomicU32);

impl Printed {
    /// Begins a call of the script.
    pub(super) fn begin(&self) {
        let left = LINES_MAX.saturating_sub(self.0.load(Ordering::Relaxed));
        PRINTED.with(|printed| printed.borrow_mut().1 = left);
    }

    /// Writes what the call has printed into the log; `place` says where a line is from.
    pub(super) fn end(&self, place: impl Fn(Option<(usize, usize)>) -> String) {
        let lines = PRINTED.with(|printed| {
            let mut printed = printed.borrow_mut();
            // Most calls print nothing.
            if printed.0.is_empty() { Vec::new() } else { std::mem::take(&mut printed.0) }
        });
        for line in lines {
            let n = self.0.fetch_add(1, Ordering::Relaxed) + 1;
            if n > LINES_MAX {
                break;
            }
            let at = place(line.place);
            log::log!(target: TARGET, line.level, "{at}: {}", line.text);
            if n == LINES_MAX {
                log::warn!(target: TARGET, "{at}: a script prints {LINES_MAX} lines at most; no more of its lines follow");
            }
        }
    }
}

/// Registers `print` and `debug`.
pub(super) fn register(engine: &mut Engine) {
    for (name, shown_by, level) in
        [("print", "to_string", Level::Info), ("debug", "to_debug", Level::Debug)]
    {
        // Rhai has these functions for each of its types, which come before the general one.
        macro_rules! of {
            ($($of:ty),+) => {
                $(engine.register_fn(name, move |context: NativeCallContext, value: $of| {
                    print(&context, Dynamic::from(value), shown_by, level)
                });)+
            };
        }
        of!(ImmutableString, i64, f64, bool, char, Array, Map, FnPtr);
        engine.register_fn(name, move |context: NativeCallContext, (): ()| {
            print(&context, Dynamic::UNIT, shown_by, level)
        });
        engine.register_fn(name, move |context: NativeCallContext, value: Dynamic| {
            print(&context, value, shown_by, level)
        });
    }
}

fn print(
    context: &NativeCallContext,
    value: Dynamic,
    shown_by: &str,
    level: Level,
) -> Failable<()> {
    let text: ImmutableString = context.call_native_fn(shown_by, (value,))?;
    PRINTED.with(|printed| {
        let mut printed = printed.borrow_mut();
        if printed.1 > 0 {
            printed.1 -= 1;
            let place = line_column(context.call_position());
            printed.0.push(PrintedLine { level, place, text: one_line(text) });
        }
    });
    Ok(())
}

/// A text as one line of a log; a terminal obeys no character of it.
fn one_line(text: ImmutableString) -> ImmutableString {
    if text.contains(char::is_control) { text.replace(char::is_control, " ").into() } else { text }
}
