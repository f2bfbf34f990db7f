//! The parameters of a level, as its text and its JSON have them.

use serde::{Deserialize, Deserializer};
use std::collections::BTreeMap;

/// What a value that isn't quoted can't have.
const SIGNS: [char; 6] = [',', '=', '{', '}', '#', '"'];

/// A parameter in a level's text. A value that could be read otherwise is quoted as in JSON.
pub(super) fn written(name: &str, value: &str) -> String {
    if value.is_empty() || value.contains(SIGNS) || value.trim() != value {
        return format!("{name}={}", serde_json::Value::from(value));
    }
    format!("{name}={value}")
}

/// Reads `name=value,…`; `None` if the text isn't written like this, an error for a name that comes
/// twice.
pub(super) fn read(mut text: &str) -> Option<Result<BTreeMap<String, String>, String>> {
    let mut values = BTreeMap::new();
    while !text.trim().is_empty() {
        let (name, rest) = text.split_once('=')?;
        let rest = rest.trim_start();
        let (value, rest) = if rest.starts_with('"') { quoted(rest)? } else { bare(rest) };
        let name = name.trim().to_owned();
        if name.is_empty() || name.contains(SIGNS) {
            return None;
        }
        if values.contains_key(&name) {
            return Some(Err(format!("it gives `{name}` twice")));
        }
        values.insert(name, value);
        text = rest;
    }
    Some(Ok(values))
}

/// A value up to the next comma, and what comes behind it.
fn bare(text: &str) -> (String, &str) {
    let (value, rest) = text.split_once(',').unwrap_or((text, ""));
    (value.trim().to_owned(), rest)
}

/// A quoted value, and what comes behind the comma after it.
fn quoted(text: &str) -> Option<(String, &str)> {
    let mut values = serde_json::Deserializer::from_str(text).into_iter::<String>();
    let value = values.next()?.ok()?;
    let rest = text.get(values.byte_offset()..)?.trim_start();
    match rest.strip_prefix(',') {
        Some(rest) => Some((value, rest)),
        None if rest.is_empty() => Some((value, "")),
        None => None,
    }
}

/// A value in JSON: as the language writes it, or a number or a switch.
#[derive(Deserialize)]
#[serde(untagged)]
enum JsonValue {
    Text(String),
    Switch(bool),
    Number(serde_json::Number),
}

/// Reads the parameters of a level's JSON.
pub(super) fn deserialize<'de, D: Deserializer<'de>>(
    from: D,
) -> Result<BTreeMap<String, String>, D::Error> {
    let values = BTreeMap::<String, JsonValue>::deserialize(from)?;
    let text = |value| match value {
        JsonValue::Text(text) => text,
        JsonValue::Switch(is_on) => if is_on { "on" } else { "off" }.to_owned(),
        JsonValue::Number(number) => number.to_string(),
    };
    Ok(values.into_iter().map(|(name, value)| (name, text(value))).collect())
}
