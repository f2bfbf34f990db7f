//! Compiled scenarios from anybody: whatever loads is played.
#![no_main]

use libfuzzer_sys::{Corpus, fuzz_target};
use setpiece::scenario::container::checksum;
use setpiece::scenario::file::{self, FormatError};
use setpiece_fuzz::choice::Choices;
use setpiece_fuzz::{edit, game, seed};
use std::sync::Arc;

const STEPS: u32 = 5;

fuzz_target!(init: begin(), |data: &[u8]| -> Corpus {
    let Some((&mode, rest)) = data.split_first() else { return Corpus::Reject };
    let loaded = match mode {
        seed::load::FILE => match std::str::from_utf8(rest) {
            Ok(text) => file::from_json(text),
            Err(_) => return Corpus::Reject,
        },
        seed::load::BODY => match std::str::from_utf8(rest) {
            Ok(body) => with_checksum(body),
            Err(_) => return Corpus::Reject,
        },
        seed::load::EDITS => {
            let mut choices = Choices::new(rest);
            let picked = seed::body(seed::pick(&mut choices));
            let mut body = serde_json::from_str(&picked).expect("a body of JSON");
            edit::edit(&mut body, &mut choices);
            with_checksum(&body.to_string())
        }
        _ => return Corpus::Reject,
    };
    let Ok(scenario) = loaded else { return Corpus::Keep };
    let text = file::to_json(&scenario).expect("what was read can be written");
    assert!(file::from_json(&text).is_ok(), "what was read and written can be read");
    let scenario = Arc::new(scenario);
    let options = game::options(&scenario, &mut Choices::new(rest));
    game::play(&scenario, options, Choices::new(rest), STEPS);
    Corpus::Keep
});

fn begin() {
    seed::write("load");
    // Compiled here, so that no input is blamed for the time.
    seed::scenarios();
}

/// Loads a file of this body.
fn with_checksum(body: &str) -> Result<setpiece::scenario::Scenario, FormatError> {
    // As the file's reader sees it: without surrounding blanks.
    let body = body.trim_matches([' ', '\t', '\r', '\n']);
    let checksum = checksum(body.as_bytes());
    file::from_json(&format!(
        "{{\"format\":\"setpiece scenario\",\"version\":{},\"checksum\":\"{checksum:08x}\",\"scenario\":{body}}}",
        file::FORMAT_VERSION
    ))
}
