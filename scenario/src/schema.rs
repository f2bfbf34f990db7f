//! The JSON schema of a compiled scenario, published as `docs/pitchc.schema.json`.

use crate::file::FORMAT_VERSION;
use crate::scenario::Scenario;
use schemars::JsonSchema;
use serde_json::{Value, json};

/// A compiled scenario (`.pitchc`), as `setpiece build` writes it.
///
/// The schema describes what a reader may expect. A file that matches it may still be rejected: the
/// programs must also be consistent, and the checksum must be that of the text of `scenario`.
#[derive(JsonSchema)]
#[schemars(title = "Setpiece compiled scenario")]
#[allow(dead_code, reason = "only its schema is wanted")]
struct CompiledScenario {
    /// The format's name.
    format: String,
    /// The version of the format.
    version: u32,
    /// FNV-1a of the text of `scenario`, 64 bit, hexadecimal.
    checksum: String,
    /// The scenario.
    scenario: Scenario,
}

/// The schema.
pub fn schema() -> Value {
    let mut schema = schemars::schema_for!(CompiledScenario).to_value();
    let fields = [
        ("format", json!({ "const": crate::file::FORMAT_NAME })),
        ("version", json!({ "const": FORMAT_VERSION })),
        ("checksum", json!({ "type": "string", "pattern": "^[0-9a-f]{8}$" })),
    ];
    for (name, rule) in fields {
        let field = schema
            .pointer_mut("/properties")
            .and_then(|all| all.get_mut(name))
            .and_then(Value::as_object_mut);
        if let (Some(field), Value::Object(rule)) = (field, rule) {
            field.retain(|key, _| key == "description");
            field.extend(rule);
        }
    }
    schema
}

/// The schema as published.
pub fn text() -> String {
    format!("{:#}\n", schema())
}
