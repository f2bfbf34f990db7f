//! Rhai's own functions on lists, maps and strings, with their work counted.
//!
//! Each function is taken from Rhai unchanged, and registered again with a wrapper that counts its
//! arguments and result.

use super::super::limits::ARRAY_MAX;
use super::{Failable, bytes_of, count_bytes};
use rhai::plugin::RhaiResult;
use rhai::{
    Array, Caches, Dynamic, Engine, EvalContext, FnPtr, FuncRegistration, ImmutableString, Map,
    Module, NativeCallContext, Position, RhaiFunc, Scope,
};
use std::any::TypeId;
use std::ops::{Range, RangeInclusive};
use std::sync::Arc;

/// Parameters of a function, one letter each: a list, map, string, number, character, range (open
/// or closed), function or anything.
type Letters = &'static str;

/// Functions by name, with their signatures.
const TABLE: &[(&str, &[Letters])] = &[
    ("!=", &["AA", "MM"]),
    ("+", &["AA", "AS", "MM", "MS", "SD", "FS", "CS", "CC"]),
    ("+=", &["AD", "MM", "SD"]),
    ("-", &["SS", "SC"]),
    ("-=", &["SS", "SC"]),
    ("==", &["AA", "MM"]),
    ("all", &["AS", "AF"]),
    ("append", &["AA", "SD"]),
    ("bytes", &["S"]),
    ("chars", &["S", "SI", "SR", "SQ", "SII"]),
    ("chop", &["AI"]),
    ("clear", &["A", "M", "S"]),
    ("contains", &["AD", "MS", "SS", "SC"]),
    ("crop", &["SI", "SR", "SQ", "SII"]),
    ("dedup", &["A", "AS", "AF"]),
    ("drain", &["AS", "AR", "AQ", "AF", "MF", "AII"]),
    ("ends_with", &["SS", "SC"]),
    ("extract", &["AI", "AR", "AQ", "AII"]),
    ("fill_with", &["MM"]),
    ("filter", &["AS", "AF", "MF"]),
    ("find", &["AF", "AFI"]),
    ("find_map", &["AF", "AFI"]),
    ("for_each", &["AF"]),
    ("get", &["AI", "MS", "SI"]),
    ("get$bytes", &["S"]),
    ("get$chars", &["S"]),
    ("get$is_empty", &["A", "S"]),
    ("get$len", &["A", "S"]),
    ("index_of", &["AD", "SS", "SC", "ADI", "SSI", "SCI"]),
    ("insert", &["AID"]),
    ("is_empty", &["A", "M", "S"]),
    ("keys", &["M"]),
    ("len", &["A", "M", "S"]),
    ("make_lower", &["S"]),
    ("make_upper", &["S"]),
    ("map", &["AS", "AF", "MF"]),
    ("max", &["SS"]),
    ("min", &["SS"]),
    ("mixin", &["MM"]),
    ("order", &["A", "AF"]),
    ("order_by", &["AF"]),
    ("order_desc", &["A"]),
    ("pad", &["AID", "SIS", "SIC"]),
    ("parse_float", &["S"]),
    ("parse_int", &["S", "SI"]),
    ("pop", &["A", "S", "SI"]),
    ("push", &["AD"]),
    ("reduce", &["AS", "AF", "ASD", "AFD"]),
    ("reduce_rev", &["AS", "AF", "ASD", "AFD"]),
    ("remove", &["AI", "MS", "SS", "SC"]),
    ("replace", &["SSS", "SSC", "SCS", "SCC"]),
    ("retain", &["AS", "AR", "AQ", "AF", "MF", "AII"]),
    ("reverse", &["A"]),
    ("set", &["AID", "MSD", "SIC"]),
    ("shift", &["A"]),
    ("some", &["AS", "AF"]),
    ("sort", &["A", "AS", "AF"]),
    ("sort_by", &["AF"]),
    ("sort_desc", &["A"]),
    ("splice", &["ARA", "AQA", "AIIA"]),
    ("split", &["S", "AI", "SS", "SI", "SC", "SSI", "SCI"]),
    ("split_rev", &["SS", "SC", "SSI", "SCI"]),
    ("starts_with", &["SS", "SC"]),
    ("sub_string", &["SI", "SR", "SQ", "SII"]),
    ("to_chars", &["S"]),
    ("to_debug", &["A", "M", "S", "F"]),
    ("to_json", &["M"]),
    ("to_lower", &["S"]),
    ("to_string", &["A", "M", "S", "F"]),
    ("to_upper", &["S"]),
    ("trim", &["S"]),
    ("truncate", &["AI", "SI"]),
    ("values", &["M"]),
    ("zip", &["AAF"]),
];

/// Functions that read only a part of the value they are called on.
const LIGHT: &[&str] =
    &["get", "get$is_empty", "get$len", "is_empty", "len", "pop", "push", "set", "clear"];
/// The factor by which their work is smaller.
const LIGHT_SHARE: usize = 8;
/// Lists up to this length are read element by element.
const SHORT_LIST: usize = 32;
/// Bytes that such a function counts as on a longer list, whatever its elements are.
const LOOK_BYTES: usize = 4_096;

/// Functions that read each element about log₂ of the length times.
const SORTING: &[&str] = &["order", "order_by", "order_desc", "sort", "sort_by", "sort_desc"];

/// Functions that take longer than a copy: they search strings, or print values.
const LONG: &[&str] = &[
    "-",
    "-=",
    "chars",
    "contains",
    "get$chars",
    "index_of",
    "remove",
    "replace",
    "split",
    "split_rev",
    "sub_string",
    "to_debug",
    "to_json",
    "to_string",
];
/// The factor by which they take longer.
const LONG_TIMES: usize = 4;
/// Functions that build a string from single characters, with their number of arguments.
const BY_LETTER: &[(&str, usize)] = &[("crop", 2), ("crop", 3), ("pop", 2), ("set", 3)];
/// The factor by which that takes longer than a copy.
const BY_LETTER_TIMES: usize = 64;

/// The signature of a function in Rhai.
type Native = dyn Fn(Option<NativeCallContext>, &mut [&mut Dynamic]) -> RhaiResult + Send + Sync;

/// Registers the functions of the table, as they are in `plain`.
pub(in super::super) fn register(engine: &mut Engine, plain: &Engine) {
    let mut module = Module::new();
    for &(name, all) in TABLE {
        for letters in all {
            if let Some(function) = find(plain, name, letters) {
                let types: Vec<TypeId> = letters.bytes().map(type_of).collect();
                FuncRegistration::new(name).set_into_module_raw(
                    &mut module,
                    types,
                    counted(name, function),
                );
            }
        }
    }
    engine.register_global_module(module.into());
}

/// Finds a function of Rhai by calling it with trivial arguments.
fn find(engine: &Engine, name: &str, letters: Letters) -> Option<RhaiFunc> {
    let mut caches = Caches::new();
    // Rhai doesn't cache the first call.
    for _ in 0..2 {
        let mut values: Vec<Dynamic> = letters.bytes().map(sample).collect();
        let mut arguments: Vec<&mut Dynamic> = values.iter_mut().collect();
        let (mut global, mut scope) = (engine.new_global_runtime_state(), Scope::new());
        let mut context = EvalContext::new(engine, &mut global, &mut caches, &mut scope, None);
        let _ = context.call_native_fn_raw(name, true, &mut arguments);
    }
    caches.fn_resolution_cache_mut().dict.values().flatten().next().map(|found| found.func.clone())
}

fn type_of(letter: u8) -> TypeId {
    match letter {
        b'A' => TypeId::of::<Array>(),
        b'M' => TypeId::of::<Map>(),
        b'S' => TypeId::of::<ImmutableString>(),
        b'I' => TypeId::of::<i64>(),
        b'C' => TypeId::of::<char>(),
        b'R' => TypeId::of::<Range<i64>>(),
        b'Q' => TypeId::of::<RangeInclusive<i64>>(),
        b'F' => TypeId::of::<FnPtr>(),
        _ => TypeId::of::<Dynamic>(),
    }
}

fn sample(letter: u8) -> Dynamic {
    match letter {
        b'A' => Array::new().into(),
        b'M' => Map::new().into(),
        b'S' => "".into(),
        b'I' => Dynamic::from_int(0),
        b'C' => ' '.into(),
        b'R' => Dynamic::from(0i64..0),
        b'Q' => Dynamic::from(0i64..=0),
        b'F' => FnPtr::new("none").map_or(Dynamic::UNIT, Dynamic::from),
        _ => true.into(),
    }
}

/// Wraps a function so that its work is counted.
fn counted(name: &'static str, function: RhaiFunc) -> RhaiFunc {
    let (is_pure, is_volatile) = (function.is_pure(), function.is_volatile());
    let is_method = function.is_method();
    let func: Arc<Native> = Arc::new(move |context, arguments| {
        let at = context.as_ref().map_or(Position::NONE, NativeCallContext::call_position);
        count_given(name, arguments, at)?;
        let value = match &function {
            RhaiFunc::Plugin { func } => func.call(context, arguments),
            RhaiFunc::StaticPlugin { func } => func.call(context, arguments),
            RhaiFunc::Pure { func, .. } | RhaiFunc::Method { func, .. } => func(context, arguments),
            _ => Ok(Dynamic::UNIT),
        }?;
        if !(value.is_unit() || value.is_bool() || value.is_int()) {
            count_bytes(bytes_of(&value, at)?, at)?;
        }
        Ok(value)
    });
    if is_method {
        RhaiFunc::Method { func, has_context: true, is_pure, is_volatile }
    } else {
        RhaiFunc::Pure { func, has_context: true, is_pure, is_volatile }
    }
}

fn count_given(name: &str, arguments: &[&mut Dynamic], at: Position) -> Failable<()> {
    let Some((first, rest)) = arguments.split_first() else { return Ok(()) };
    let mut bytes = 0;
    for argument in rest {
        bytes += bytes_of(argument, at)?;
    }
    let list = first.read_lock::<Array>();
    bytes += match &list {
        // Long lists cost time because Rhai checks the size of whatever was changed.
        Some(list) if LIGHT.contains(&name) && list.len() > SHORT_LIST => {
            LOOK_BYTES + size_of::<Dynamic>() * list.len() / LIGHT_SHARE
        }
        Some(list) if LIGHT.contains(&name) && !list.iter().any(is_whole) => 0,
        _ if SORTING.contains(&name) => {
            let bytes = bytes_of(first, at)?;
            bytes * (usize::BITS - bytes.leading_zeros()) as usize
        }
        _ => bytes_of(first, at)?,
    };
    if LONG.contains(&name) {
        bytes *= LONG_TIMES;
    } else if first.is_string() && BY_LETTER.contains(&(name, arguments.len())) {
        bytes *= BY_LETTER_TIMES;
    }
    // A repeated insertion makes a large value from few arguments.
    match (name, &list, rest) {
        ("pad", Some(list), [length, item]) => {
            let length = usize::try_from(length.as_int().unwrap_or_default()).unwrap_or_default();
            bytes += bytes_of(item, at)? * length.min(ARRAY_MAX).saturating_sub(list.len());
        }
        // The function's name is looked up for each element.
        (_, Some(list), [name]) if name.is_string() => {
            bytes += list.len() * name.read_lock::<ImmutableString>().map_or(0, |name| name.len());
        }
        ("replace", None, [_, by]) => {
            let length = first.read_lock::<ImmutableString>().map_or(0, |text| text.len());
            bytes += (length + 1) * by.read_lock::<ImmutableString>().map_or(1, |by| by.len());
        }
        _ => {}
    }
    count_bytes(bytes, at)
}

/// Whether a value contains others.
fn is_whole(value: &Dynamic) -> bool {
    value.is_array() || value.is_map()
}

#[cfg(test)]
mod tests;
