//! The published JSON schema of a compiled scenario: it is current, every scenario matches it, and
//! it constrains something.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

use serde_json::{Value, json};
use setpiece_scenario::file::to_json;
use setpiece_scenario::schema::{schema, text};
use std::path::{Path, PathBuf};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// Keywords of JSON schema that [`fault`] supports, or that don't constrain a value.
const KNOWN: &[&str] = &[
    "$ref",
    "type",
    "properties",
    "required",
    "items",
    "prefixItems",
    "minItems",
    "maxItems",
    "oneOf",
    "anyOf",
    "enum",
    "const",
    "minimum",
    "maximum",
    "pattern",
    "additionalProperties",
    "description",
    "title",
    "default",
    "format",
    "$schema",
    "$defs",
];

/// The path to what doesn't match a schema.
fn fault(root: &Value, schema: &Value, value: &Value, path: &str) -> Option<String> {
    let Some(rules) = schema.as_object() else {
        return (schema != &json!(true)).then(|| format!("{path}: nothing fits"));
    };
    let deeper = |schema: &Value, value: &Value, key: &str| {
        fault(root, schema, value, &format!("{path}/{key}"))
    };
    for (word, rule) in rules {
        let wrong = match word.as_str() {
            "$ref" => {
                let target =
                    root.pointer(rule.as_str().unwrap().strip_prefix('#').unwrap()).unwrap();
                fault(root, target, value, path)
            }
            "type" => {
                let is = |kind: &str| match kind {
                    "object" => value.is_object(),
                    "array" => value.is_array(),
                    "string" => value.is_string(),
                    "integer" => value.is_u64() || value.is_i64(),
                    "number" => value.is_number(),
                    "boolean" => value.is_boolean(),
                    "null" => value.is_null(),
                    other => panic!("no type {other}"),
                };
                let kinds: Vec<&Value> =
                    rule.as_array().map_or(vec![rule], |kinds| kinds.iter().collect());
                (!kinds.iter().any(|kind| is(kind.as_str().unwrap())))
                    .then(|| format!("{path}: not {rule}"))
            }
            "properties" => rule.as_object().unwrap().iter().find_map(|(key, schema)| {
                value.get(key).and_then(|inner| deeper(schema, inner, key))
            }),
            "required" if value.is_object() => {
                let missing = rule
                    .as_array()
                    .unwrap()
                    .iter()
                    .find(|key| value.get(key.as_str().unwrap()).is_none());
                missing.map(|key| format!("{path}: no {key}"))
            }
            "additionalProperties" => {
                value.as_object().into_iter().flatten().find_map(|(key, inner)| {
                    let known =
                        rules.get("properties").is_some_and(|known| known.get(key).is_some());
                    if known { None } else { deeper(rule, inner, key) }
                })
            }
            "items" | "prefixItems" => {
                value.as_array().into_iter().flatten().enumerate().find_map(|(at, inner)| {
                    let own = rules.get("prefixItems").and_then(|own| own.get(at));
                    own.or(rules.get("items"))
                        .and_then(|schema| deeper(schema, inner, &at.to_string()))
                })
            }
            "minItems" | "maxItems" => value.as_array().and_then(|list| {
                let (n, limit) = (list.len() as u64, rule.as_u64().unwrap());
                (if word == "minItems" { n < limit } else { n > limit })
                    .then(|| format!("{path}: {n} items"))
            }),
            "minimum" => (value.as_f64() < rule.as_f64()).then(|| format!("{path}: below {rule}")),
            "maximum" => (value.as_f64() > rule.as_f64()).then(|| format!("{path}: above {rule}")),
            "enum" => (!rule.as_array().unwrap().contains(value))
                .then(|| format!("{path}: {value} is none of {rule}")),
            "const" => (rule != value).then(|| format!("{path}: {value} is not {rule}")),
            "pattern" => {
                let regex = regex::bytes::RegexBuilder::new(rule.as_str().unwrap())
                    .unicode(false)
                    .build()
                    .unwrap();
                (!regex.is_match(value.as_str().unwrap_or_default().as_bytes()))
                    .then(|| format!("{path}: no {rule}"))
            }
            "oneOf" | "anyOf" => {
                let fits = rule
                    .as_array()
                    .unwrap()
                    .iter()
                    .filter(|one| fault(root, one, value, path).is_none())
                    .count();
                let wanted = if word == "oneOf" { fits == 1 } else { fits > 0 };
                (!wanted).then(|| format!("{path}: {fits} ways to read {value}"))
            }
            other => {
                assert!(KNOWN.contains(&other), "the test does not know `{other}`");
                None
            }
        };
        if wrong.is_some() {
            return wrong;
        }
    }
    None
}

/// Every compiled scenario of the library and the examples.
fn compiled() -> Vec<(String, Value)> {
    let mut loaded: Vec<_> =
        setpiece::list().iter().map(|entry| setpiece::load(&entry.name).unwrap()).collect();
    for entry in std::fs::read_dir(root().join("examples")).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|ending| ending == "pitch") {
            loaded.push(setpiece::load_file(&path).unwrap());
        }
    }
    let value = |text: String| serde_json::from_str(&text).unwrap();
    loaded
        .iter()
        .map(|one| (one.scenario.name.clone(), value(to_json(&one.scenario).unwrap())))
        .collect()
}

#[test]
fn the_published_schema_is_up_to_date() {
    if std::env::var_os("SETPIECE_BLESS").is_some() {
        std::fs::write(root().join("docs/pitchc.schema.json"), text()).unwrap();
    }
    let published =
        std::fs::read_to_string(root().join("docs/pitchc.schema.json")).unwrap_or_default();
    assert!(published == text(), "run `cargo xtask schema`");
}

#[test]
fn every_compiled_scenario_fits_the_schema() {
    let schema = schema();
    let all = compiled();
    assert!(all.len() >= 19);
    for (name, value) in all {
        assert_eq!(fault(&schema, &schema, &value, ""), None, "{name}");
    }
}

#[test]
fn what_is_no_compiled_scenario_does_not_fit() {
    let schema = schema();
    let (_, good) = compiled().remove(0);
    let broken: &[(&str, Value)] = &[
        ("/format", json!("another")),
        ("/version", json!(0)),
        ("/checksum", json!("xyz")),
        ("/scenario/players/0/role", json!("XX")),
        ("/scenario/players/0/start/x", json!(-1)),
        ("/scenario/start/program/code/0", json!({ "conjure": 1 })),
        ("/scenario/endings/list", json!(null)),
        ("/scenario/name", json!(7)),
    ];
    for (pointer, value) in broken {
        let mut bad = good.clone();
        *bad.pointer_mut(pointer).unwrap() = value.clone();
        assert!(fault(&schema, &schema, &bad, "").is_some(), "{pointer} may be {value}");
    }
}
