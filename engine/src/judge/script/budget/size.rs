//! How large a value is.

use super::super::limits::{EXPRESSION_DEPTH_MAX, Why};
use super::{Failable, over};
use rhai::{Array, Dynamic, EvalAltResult, FnPtr, ImmutableString, Map, Position};

/// Bytes of the largest value. The limits of lists, maps and strings allow less, but they don't see
/// the arguments of functions.
const VALUE_BYTES_MAX: usize = 1 << 20;

/// Bytes of a value itself, in a list.
const VALUE_BYTES: usize = 16;
/// Extra bytes of a list, string, function or thing of the match. A separate heap allocation takes
/// as long to copy as this many bytes of a list.
const BOX_BYTES: usize = 112;
/// Extra bytes of a map's entry, besides its name and value.
const ENTRY_BYTES: usize = 64;

/// Computes the total bytes of a value used at a place.
///
/// # Errors
/// It is larger than [`VALUE_BYTES_MAX`], nested too deeply, or being changed.
pub(in super::super) fn bytes_of(value: &Dynamic, at: Position) -> Failable<usize> {
    let mut size = Size { bytes: 0, at };
    size.add(value, 0)?;
    Ok(size.bytes)
}

struct Size {
    bytes: usize,
    at: Position,
}

impl Size {
    fn add(&mut self, value: &Dynamic, level: usize) -> Failable<()> {
        self.bytes += VALUE_BYTES;
        if value.is_int()
            || value.is_float()
            || value.is_bool()
            || value.is_unit()
            || value.is_char()
        {
            return Ok(());
        }
        if level > EXPRESSION_DEPTH_MAX {
            return self
                .too_large(format!("a value is nested deeper than {EXPRESSION_DEPTH_MAX} levels"));
        }
        if value.is_shared() {
            return match value.read_lock::<Dynamic>() {
                Some(inner) => self.add(&inner, level + 1),
                None => over(Why::Changing, self.at),
            };
        }
        self.bytes += BOX_BYTES;
        if let Some(list) = value.read_lock::<Array>() {
            list.iter().try_for_each(|part| self.part(part, level))?;
        } else if let Some(map) = value.read_lock::<Map>() {
            for (name, part) in map.iter() {
                self.bytes += ENTRY_BYTES + name.len();
                self.part(part, level)?;
            }
        } else if let Some(text) = value.read_lock::<ImmutableString>() {
            self.bytes += text.len();
        } else if let Some(function) = value.read_lock::<FnPtr>() {
            function.iter_curry().try_for_each(|part| self.part(part, level))?;
        }
        Ok(())
    }

    fn part(&mut self, part: &Dynamic, level: usize) -> Failable<()> {
        if self.bytes > VALUE_BYTES_MAX {
            return self.too_large(format!("a value is larger than {} KiB", VALUE_BYTES_MAX >> 10));
        }
        self.add(part, level + 1)
    }

    fn too_large(&self, words: String) -> Failable<()> {
        Err(EvalAltResult::ErrorDataTooLarge(words, self.at).into())
    }
}

/// Copies a value together with everything it shares; its size has been checked.
pub(super) fn unshared(value: &Dynamic) -> Dynamic {
    if let Some(list) = value.read_lock::<Array>() {
        return list.iter().map(unshared).collect::<Array>().into();
    }
    if let Some(map) = value.read_lock::<Map>() {
        return map
            .iter()
            .map(|(name, part)| (name.clone(), unshared(part)))
            .collect::<Map>()
            .into();
    }
    if let Some(function) = value.read_lock::<FnPtr>() {
        let mut function = function.clone();
        let captured: Vec<Dynamic> = function.iter_curry().map(unshared).collect();
        function.set_curry(captured);
        return function.into();
    }
    value.flatten_clone()
}
