//! What a script returns, as numbers, and what its types are called.

use super::super::words::tidy;
use super::type_name;
use rhai::{Dynamic, EvalAltResult};

/// Converts an integer or float to a float.
pub(in super::super) fn to_number(value: &Dynamic) -> Result<f64, Box<EvalAltResult>> {
    match (value.as_float(), value.as_int()) {
        (Ok(number), _) => Ok(number),
        (_, Ok(whole)) => Ok(whole as f64),
        _ => Err(format!("expected a number, found {}", type_words(value.type_name())).into()),
    }
}

/// Rhai's name of a type in plain words.
pub(in super::super) fn type_words(name: &str) -> String {
    match name {
        "()" => "nothing".to_owned(),
        "i64" => "a whole number".to_owned(),
        "f64" => "a number".to_owned(),
        "string" | "map" | "array" | "bool" | "char" => format!("a {name}"),
        other => match type_name(other) {
            Some(name) => format!(
                "{} {name}",
                if name.starts_with(['a', 'e', 'i', 'o', 'u']) { "an" } else { "a" }
            ),
            None => format!("`{}`", tidy(other)),
        },
    }
}
