//! Limits what one call of a hook may use.
//!
//! Rhai counts what its interpreter does, whatever the size of the values: one operation may copy a
//! list of thousands. Here the bytes that are copied, read and created are counted as well,
//! [`BYTES_PER_OPERATION`] per operation. So one number bounds both the time of a call and the
//! memory of its values. Copies are counted where the text makes them ([`count_copies`]), and the
//! work of Rhai's own functions where they are registered (`natives`).

mod class;
mod copies;
mod edits;
mod natives;
mod size;

pub(super) use copies::count_copies;
pub(super) use edits::{Edits, inserted};
pub(super) use natives::register as register_natives;
pub(super) use size::bytes_of;

use super::limits::{BYTES_PER_OPERATION, COUNTED, OPERATIONS_MAX, Overspent, WORKED, Why};
use super::words;
use rhai::{Dynamic, Engine, EvalAltResult, FnPtr, NativeCallContext, Position};
use std::cell::{Cell, RefCell};

/// Operations that a caught error counts as. Failed code has done work that nothing else counts.
const CAUGHT_OPERATIONS: i64 = 1_000;
/// The same in a script with closures, where Rhai waits for 50 ms before it reports that two of
/// them use one variable.
const CAUGHT_WAITING_OPERATIONS: i64 = 40_000;

pub(crate) type Failable<T> = Result<T, Box<EvalAltResult>>;

thread_local! {
    /// Operations that the current call may still use.
    static LEFT: Cell<u64> = const { Cell::new(0) };
    /// Variables of the current call that closures share.
    static SHARED: RefCell<Vec<Dynamic>> = const { RefCell::new(Vec::new()) };
}

/// Begins a call.
pub(super) fn begin() {
    LEFT.with(|left| left.set(OPERATIONS_MAX + 1));
}

/// Counts operations of the current call; `false` if none are left.
pub(super) fn count_operations(n: u64) -> bool {
    LEFT.with(|left| {
        left.set(left.get().saturating_sub(n));
        left.get() > 0
    })
}

/// Counts work on this many bytes, done at a place.
///
/// # Errors
/// The call ends if no operations are left; a script can't catch that.
pub(super) fn count_bytes(bytes: usize, at: Position) -> Failable<()> {
    let operations = bytes / BYTES_PER_OPERATION;
    if operations == 0 || count_operations(operations as u64) {
        Ok(())
    } else {
        over(Why::Size, at)
    }
}

fn over(why: Why, at: Position) -> Failable<()> {
    let over = Overspent { why, place: words::line_column(at) };
    Err(EvalAltResult::ErrorTerminated(Dynamic::from(over), at).into())
}

/// Registers the functions that [`count_copies`] inserts.
pub(super) fn register(engine: &mut Engine) {
    engine.register_fn(
        COUNTED,
        |context: NativeCallContext, value: Dynamic| -> Failable<Dynamic> {
            // Most of the values that could be large aren't.
            if value.is_int() || value.is_float() || value.is_bool() || value.is_unit() {
                return Ok(value);
            }
            let at = context.call_position();
            count_bytes(bytes_of(&value, at)?, at)?;
            keep_shared(&value);
            Ok(value)
        },
    );
    engine.register_fn(WORKED, |operations: i64| -> Failable<()> {
        if count_operations(operations.max(0) as u64) {
            Ok(())
        } else {
            Err(EvalAltResult::ErrorTerminated(Dynamic::UNIT, Position::NONE).into())
        }
    });
}

/// Records the variables that a closure shares. One that holds the closure itself would never be
/// freed.
fn keep_shared(value: &Dynamic) {
    if !value.is_fnptr() {
        return;
    }
    let Some(function) = value.read_lock::<FnPtr>() else { return };
    let shared = function.iter_curry().filter(|captured| captured.is_shared()).cloned();
    SHARED.with(|list| list.borrow_mut().extend(shared));
}

/// Ends a call. Only `this` outlives it, and it shares nothing with other values.
///
/// # Errors
/// `this` holds something that can't be kept.
pub(super) fn end(this: &mut Dynamic) -> Result<(), String> {
    let shared = SHARED.with(RefCell::take);
    if shared.is_empty() {
        return Ok(());
    }
    let kept = bytes_of(this, Position::NONE)
        .map_err(|error| words::explain(error).1)
        .map(|_| size::unshared(this));
    for mut variable in shared {
        if let Some(mut value) = variable.write_lock::<Dynamic>() {
            *value = Dynamic::UNIT;
        }
    }
    *this = kept?;
    Ok(())
}
