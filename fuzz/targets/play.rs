//! Scenarios generated from bytes, played with actions from bytes.
#![no_main]

use libfuzzer_sys::{Corpus, fuzz_target};
use setpiece_fuzz::choice::Choices;
use setpiece_fuzz::{game, generate};

/// Ten ticks each.
const STEPS: u32 = 60;
/// Bytes of actions: the seed, and one per step.
const ACTIONS: usize = STEPS as usize + 1;
/// If set, the scenarios and their problems are printed.
const SHOW: &str = "SETPIECE_FUZZ_SHOW";

fuzz_target!(init: setpiece_fuzz::seed::write("play"), |data: &[u8]| -> Corpus {
    let (actions, rest) = data.split_at(data.len().min(ACTIONS));
    let mut choices = Choices::new(rest);
    let twice = choices.rarely(8);
    let text = generate::scenario(&mut choices);
    let loaded = setpiece::compile_text(&text, "<fuzz>");
    if std::env::var_os(SHOW).is_some() {
        eprintln!("{text}");
        if let Err(setpiece::Error::Compile(failure)) = &loaded {
            let form = setpiece::dsl::report::Format::Short;
            eprintln!("{}", setpiece::dsl::report::render(&failure.problems, &failure.sources, form));
        }
    }
    let Ok(loaded) = loaded else { return Corpus::Reject };
    let actions = Choices::new(actions);
    if twice {
        game::play_again(&loaded.scenario, &actions, STEPS);
    } else {
        let options = game::options(&loaded.scenario, &mut choices);
        game::play(&loaded.scenario, options, actions, STEPS);
    }
    Corpus::Keep
});
