//! Edits of a compiled scenario: replaces some of its numbers, words and lists.

use crate::choice::Choices;
use serde_json::{Number, Value};

/// The most edits of one scenario.
const EDITS_MAX: usize = 12;
/// A scenario with more values isn't edited.
const VALUES_MAX: usize = 20_000;
/// Numbers at which behaviour may change.
const WHOLE: &[i64] =
    &[0, 1, -1, 2, 10, 11, 21, 22, 64, 255, 256, 100_000, 2_147_483_648, 4_294_967_295, i64::MAX];
const FLOATS: &[f64] = &[0.0, -0.0, 0.5, -1.0, 1e-300, 1e9, 3.5e38, -1e300, f64::MAX, 55.0, -36.0];

/// Applies edits until the bytes are used up.
pub fn edit(body: &mut Value, choices: &mut Choices<'_>) {
    for _ in 0..EDITS_MAX {
        if choices.is_empty() {
            return;
        }
        let n = count(body);
        // A value may be put into itself, repeatedly.
        if n > VALUES_MAX {
            return;
        }
        let other = nth(body, usize::from(choices.word()) % n).cloned().unwrap_or_default();
        let Some(node) = nth(body, usize::from(choices.word()) % n) else { continue };
        change(node, other, choices);
    }
}

fn change(node: &mut Value, other: Value, choices: &mut Choices<'_>) {
    match (choices.below(8), node) {
        (0, node) => *node = other,
        (1, Value::Number(number)) if number.is_f64() => {
            *number = Number::from_f64(choices.one(FLOATS)).unwrap_or_else(|| 0.into());
        }
        (1, Value::Number(number)) => *number = choices.one(WHOLE).into(),
        (_, Value::Number(number)) => match number.as_i64() {
            Some(whole) => *number = whole.wrapping_add(i64::from(choices.byte() as i8) / 8).into(),
            None => {
                *number = Number::from_f64(choices.between(-60.0, 60.0)).unwrap_or_else(|| 0.into())
            }
        },
        (1..3, Value::Array(list)) if !list.is_empty() => {
            let at = usize::from(choices.word()) % list.len();
            list.remove(at);
        }
        (3..5, Value::Array(list)) if !list.is_empty() => {
            let at = usize::from(choices.word()) % list.len();
            list.insert(at, list[at].clone());
        }
        (5..7, Value::Array(list)) if list.len() > 1 => {
            let (a, b) = (
                usize::from(choices.word()) % list.len(),
                usize::from(choices.word()) % list.len(),
            );
            list.swap(a, b);
        }
        (_, Value::Array(list)) => list.push(other),
        (_, Value::Object(map)) => {
            let at = choices.below(map.len());
            if let Some(value) = map.values_mut().nth(at) {
                *value = other;
            }
        }
        (_, Value::Bool(is)) => *is = !*is,
        (1, Value::String(text)) => text.clear(),
        (_, node) => *node = if choices.rarely(2) { Value::Null } else { other },
    }
}

/// The number of values in a value, including itself.
fn count(value: &Value) -> usize {
    1 + match value {
        Value::Array(list) => list.iter().map(count).sum(),
        Value::Object(map) => map.values().map(count).sum(),
        _ => 0,
    }
}

/// The n-th value of a value; the first is itself.
fn nth(value: &mut Value, n: usize) -> Option<&mut Value> {
    let Some(mut n) = n.checked_sub(1) else { return Some(value) };
    let children: Vec<&mut Value> = match value {
        Value::Array(list) => list.iter_mut().collect(),
        Value::Object(map) => map.values_mut().collect(),
        _ => Vec::new(),
    };
    for child in children {
        let size = count(child);
        if n < size {
            return nth(child, n);
        }
        n -= size;
    }
    None
}
