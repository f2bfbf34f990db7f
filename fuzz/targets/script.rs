//! Any text as a script: checked for every hook, and played with its hooks.
#![no_main]

use libfuzzer_sys::fuzz_target;
use setpiece::engine::environment::EnvironmentOptions;
use setpiece::engine::judge::{ScriptNames, check_script};
use setpiece::scenario::Scenario;
use setpiece_fuzz::choice::Choices;
use setpiece_fuzz::game;
use std::sync::{Arc, OnceLock};

const HOOKS: &[&str] = &["reward", "done", "act", "reset"];
const STEPS: u32 = 3;

fuzz_target!(init: setpiece_fuzz::seed::write("script"), |data: &[u8]| {
    let Ok(text) = std::str::from_utf8(data) else { return };
    for hook in HOOKS {
        let known = ScriptNames { params: &["pace"], ..ScriptNames::default() };
        for fault in check_script(text, &[], hook, &known) {
            assert!(text.get(fault.range.clone()).is_some(), "{fault:?} points outside the script");
        }
    }
    let has = |hook: &str| text.contains(&format!("fn {hook}"));
    let hooks = [has("reward"), has("done"), has("act")];
    if hooks.contains(&true) {
        let mut scenario = scenario(hooks).clone();
        for script in &mut scenario.scripts {
            script.source = text.to_owned();
        }
        game::play(&Arc::new(scenario), EnvironmentOptions::default(), Choices::new(&[]), STEPS);
    }
});

/// The scenario that calls these hooks: a reward's, an ending's, a player's.
fn scenario(hooks: [bool; 3]) -> &'static Scenario {
    static SCENARIOS: [OnceLock<Scenario>; 8] = [const { OnceLock::new() }; 8];
    let index = hooks.iter().fold(0, |index, &hook| index * 2 + usize::from(hook));
    SCENARIOS[index].get_or_init(|| {
        let [reward, done, act] = hooks;
        let when = |is: bool, text: &'static str| if is { text } else { "" };
        let text = format!(
            "scenario scripted {{\n\
                 param pace: speed = 6m/s in 2m/s..9m/s\n\
                 ball at (0.6, 0)\n\
                 agents {{ left: 1 }}\n\
                 team left {{ GK at (-1, 0) CM at (0.58, 0) CF at (0.4, 0.1) }}\n\
                 team right {{ GK at (1, 0) CB at (0.7, 0) {{ {} }} }}\n\
                 {}\n{}\n\
                 end limit 50 steps\n\
             }}",
            when(act, "ai: script rhai \"\"\" fn act(ctx, me, now) { \"idle\" } \"\"\""),
            when(
                reward,
                "reward script rhai \"\"\" fn reward(ctx, now, prev, events) { 0.0 } \"\"\""
            ),
            when(done, "end script rhai \"\"\" fn done(ctx, now, prev, events) { false } \"\"\""),
        );
        let loaded = setpiece::compile_text(&text, "<fuzz>").expect("a scenario with scripts");
        Arc::unwrap_or_clone(loaded.scenario)
    })
}
