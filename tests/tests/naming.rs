//! What scripts read by name is what the language reads under that name.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

use setpiece::engine::environment::{Environment, EnvironmentOptions, Scratch};
use setpiece::scenario::vocabulary::Action;
use setpiece_tests::environment;

/// Pays the same by the language and by a script, for both teams.
const BOTH: &str = r#"
table worth over pitch = [[1, 2, 3, 4], [5, 6, 7, 80]]
region wing = rect((-1, 0.2), (1, 0.42))
const few = 3

reward elsewhere {
    give worth(ball) + 10 * worth(ball, linear) + (if ball in wing then 100 else 0) + few as "written"
    give script rhai """
        fn reward(ctx, now, prev, events) {
            let named = now.named;
            let inside = if named.wing.contains(now.ball) { 100 } else { 0 };
            named.worth.at(now.ball) + 10 * named.worth.linear(now.ball.at) + inside + named.few
        }
    """ as "script"
}

scenario s {
    param wide: length = 9m in 1m..20m
    agents { left: 1, right: 1 }
    let spot = uniform(rect((0.2, -0.3), (0.4, 0.3)))
    let share = uniform(0, 1)
    let late = share > 0.5
    let (one, _two) = shuffle(left, right)
    region near = circle(spot, wide)
    region around = circle(ball, 12m)
    ball at (0.6, 0.3)
    team left { first: CM at (-0.9, -0.3) second: CM at (0.5, 0.3) }
    team right { third: CM at (-0.9, 0.3) }
    reward elsewhere
    reward inner {
        give share + spot.x + (if late then 7 else 0) as "values"
        give (if second in near then 1 else 0) + (if second in around then 2 else 0) as "regions"
        give 0.01 * distance(first, second) / 1m + second.x + prev(second.speed) / 1m/s as "players"
        give if one == left then 1 else 0 as "team"
        give script rhai """
            fn reset(ctx) { this.share = ctx.named.share; }
            fn reward(ctx, now, prev, events) {
                this.share + now.named.spot.x + if now.named.late { 7 } else { 0 }
            }
        """ as "script values"
        give script rhai """
            fn reward(ctx, now, prev, events) {
                let named = now.named;
                let near = if named.near.contains(named.second) { 1 } else { 0 };
                near + if named.around.contains(named["second"]) { 2 } else { 0 }
            }
        """ as "script regions"
        give script rhai """
            fn reward(ctx, now, prev, events) {
                0.01 * distance(now.named.first, now.named.second) + now.named.second.x
                    + prev.named.second.speed
            }
        """ as "script players"
        give script rhai """
            fn reward(ctx, now, prev, events) { if now.named.one == "left" { 1 } else { 0 } }
        """ as "script team"
    }
    end success there script rhai """
        fn done(ctx, now, prev, events) { ctx.step > 20 && now.named.around.contains(now.ball) }
    """
    end limit 40 steps
}
"#;

#[test]
fn scripts_and_the_language_agree_on_every_name() {
    let mut environment = environment(BOTH);
    let names = environment.term_names().to_vec();
    let pairs = [
        ("elsewhere/written", "elsewhere/script"),
        ("inner/values", "inner/script values"),
        ("inner/regions", "inner/script regions"),
        ("inner/players", "inner/script players"),
        ("inner/team", "inner/script team"),
    ];
    let mut seen = Vec::new();
    for episode in 0..4 {
        environment.reset(Some(3), Some(episode)).unwrap();
        let mut steps = 0;
        while environment.outcome().is_none() {
            let actions = [Action::Right, Action::TopLeft];
            environment.step(&actions, &mut Scratch::default()).unwrap();
            steps += 1;
            for (agent, (written, script)) in
                (0..2).flat_map(|agent| pairs.map(|pair| (agent, pair)))
            {
                let of = |name: &str| {
                    let at = names.iter().position(|known| known == name).unwrap();
                    environment.terms(agent)[at]
                };
                let (written, script) = (of(written), of(script));
                // The frame is turned for the right team in whole, not in each operand.
                assert!((written - script).abs() < 1e-9, "{agent} {pairs:?} {written} {script}");
                seen.push((script * 100.0) as i64);
            }
        }
        assert_eq!((steps, &*environment.outcome().unwrap().label), (21, "there"));
    }
    seen.sort_unstable();
    seen.dedup();
    assert!(seen.len() > 50, "{seen:?}");
}

#[test]
fn a_snapshot_keeps_what_a_script_keeps_by_name() {
    let text = BOTH.replace(
        "fn reset(ctx) { this.share = ctx.named.share; }",
        "fn reset(ctx) { this.share = ctx.named.share; this.all = ctx.named; }",
    );
    let text = text.replace(
        "let named = now.named;\n            let inside",
        "if this.wing == () { this.wing = now.named.wing; this.worth = now.named.worth; }
         let named = #{ wing: this.wing, worth: this.worth, few: now.named.few };
         let inside",
    );
    let loaded = setpiece::compile_text(&text, "s.pitch").unwrap();
    let new = || Environment::new(loaded.scenario.clone(), EnvironmentOptions::default()).unwrap();
    let (mut one, mut other) = (new(), new());
    one.reset(Some(3), Some(1)).unwrap();
    let actions = [Action::Right, Action::TopLeft];
    for _ in 0..5 {
        one.step(&actions, &mut Scratch::default()).unwrap();
    }
    other.restore(&one.snapshot().unwrap()).unwrap();
    while one.outcome().is_none() {
        one.step(&actions, &mut Scratch::default()).unwrap();
        other.step(&actions, &mut Scratch::default()).unwrap();
        assert_eq!(one.terms(0), other.terms(0));
        assert_eq!(one.terms(1), other.terms(1));
    }
}

#[test]
fn a_changed_script_reads_other_names_at_once() {
    let loaded = |text: &str| {
        let loaded = setpiece::compile_text(text, "s.pitch");
        loaded.unwrap_or_else(|error| panic!("{error}")).scenario
    };
    let text = |name: &str| {
        format!(
            "const few = 3\nscenario s {{ const many = 30 ball at centre team left {{ CM at (0.4, 0) }}
             reward script rhai \"\"\"
                 fn reward(ctx, now, prev, events) {{ now.named.{name} }}
             \"\"\"
             end limit 9 steps }}"
        )
    };
    let mut environment =
        Environment::new(loaded(&text("few")), EnvironmentOptions::default()).unwrap();
    environment.reset(Some(1), Some(0)).unwrap();
    environment.step(&[Action::Idle], &mut Scratch::default()).unwrap();
    assert_eq!(environment.terms(0), [3.0]);
    assert_eq!(environment.adopt_scripts(&loaded(&text("many"))), Ok(true));
    environment.step(&[Action::Idle], &mut Scratch::default()).unwrap();
    assert_eq!(environment.terms(0), [30.0]);
}
