//! The meaning of names while a match runs: regions in the reader's frame, and a reward's states in
//! records.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

use setpiece_dsl::source::{LoadError, Source, SourceLoader};
use setpiece_dsl::{CompileOptions, compile};
use setpiece_engine::control::agents::Agent;
use setpiece_engine::environment::{Environment, EnvironmentOptions, Scratch};
use setpiece_engine::judge::Recorded;
use setpiece_engine::random::{Purpose, Stream};
use std::sync::Arc;

/// Loads nothing.
struct Alone;

impl SourceLoader for Alone {
    fn load(&self, path: &str, _from: &str) -> Result<Source, LoadError> {
        Err(LoadError { message: format!("no file `{path}`"), similar: Vec::new(), awaited: None })
    }
}

fn environment(text: &str) -> Environment {
    let root = Source { name: "test.pitch".to_owned(), text: text.into() };
    let outcome = compile(root, &Alone, &CompileOptions::default());
    let scenario = outcome.scenario.unwrap_or_else(|| panic!("{:#?}", outcome.problems));
    assert!(outcome.problems.is_empty(), "{:#?}", outcome.problems);
    Environment::new(Arc::new(scenario), EnvironmentOptions::default()).unwrap()
}

/// Plays some steps; returns the first agent's reward in each.
fn paid(environment: &mut Environment, steps: usize) -> Vec<f32> {
    let (mut scratch, mut stream) = (Scratch::default(), Stream::new(1, 0, Purpose::Agent));
    environment.reset(Some(1), None).unwrap();
    let n = environment.state().agents.len();
    let mut step = |environment: &mut Environment| {
        let actions: Vec<_> = (0..n)
            .map(|agent| Agent::RunAndShoot.act(environment.state(), agent, &mut stream))
            .collect();
        environment.step(&actions, &mut scratch).unwrap();
        environment.rewards()[0]
    };
    (0..steps).map(|_| step(environment)).collect()
}

#[test]
fn a_region_lies_where_it_is_declared_and_its_arguments_where_it_is_used() {
    let text = |team: &str, side: &str| {
        format!(
            "region fixed = rect((0.5, -0.2), (1, 0.2))
            region band(w: number) = rect((0.5, -w), (1, w))
            region around(p: point) = circle(p, 3m)
            region slice(a: angle) = sector((0.7, 0), 30m, a - 45deg, a + 45deg)
            reward r {{
                give 1 when ball in fixed
                give 10 when ball in band(0.2)
                give 100 when ball in around(({side}0.8, 0))
                give 1000 when ball in slice({angle})
            }}
            scenario s {{
                param depth = 0.9
                region deep(w: number) = rect((0.5, -w), (depth, w))
                ball at (0.8, 0)
                team {team} {{ CM at (0, 0.3) }}
                agents {{ left: {left}, right: {right} }}
                reward r
                reward inner {{ give 10000 when ball in deep(0.1) }}
                end limit 9 steps
            }}",
            angle = if side.is_empty() { "0deg" } else { "180deg" },
            left = u8::from(team == "left"),
            right = u8::from(team == "right"),
        )
    };
    assert_eq!(paid(&mut environment(&text("left", "")), 1), [11111.0]);
    assert_eq!(paid(&mut environment(&text("right", "-")), 1), [11111.0]);
}

#[test]
fn a_record_reads_what_a_reward_remembers() {
    let mut environment = environment(
        "reward counted(step: number = 1) {
            state n = 3
            state spot = (0.5, 0.1)
            state last = nobody
            n = n + step + delta(me.x)
            on touch by us { last = event.by }
            spot = me
            give n
            give 100 when last == me
            give spot.x
        }
        scenario s {
            ball at (0.05, 0)
            team left { CM at (0, 0)  CM at (0, 0.2) }
            team right { CM at (0.9, 0.3) }
            agents { left: 2 }
            reward counted(step: 2) as \"links\"
            record n = last of links.n
            record change = sum of delta(links.n)
            record first = first of prev(links.n)
            record mine = last of (if links.last == me then 100 else 0)
            record x = last of links.spot.x
            end limit 30 steps
        }",
    );
    let last = f64::from(*paid(&mut environment, 25).last().unwrap());
    let of_first = |name: &str| {
        let recorded = environment
            .records()
            .find(|(known, _)| *known == name)
            .map(|(_, value)| value)
            .unwrap();
        let Recorded::PerAgent(agents) = recorded else {
            panic!("`{name}` is one for all: {recorded:?}")
        };
        assert_eq!(agents.len(), 2);
        let Recorded::Number(Some(number)) = agents[0] else { panic!("{agents:?}") };
        number
    };
    let n = of_first("n");
    assert!(n > 50.0, "{n}");
    assert!((of_first("change") - (n - 3.0)).abs() < 1e-9);
    assert_eq!(of_first("first"), 3.0);
    assert!((last - (n + of_first("mine") + of_first("x"))).abs() < 1e-4, "{last}");
}

/// A script's value is paid like any other: weighed by a parameter, guarded, labelled, with the
/// reward's arguments.
#[test]
fn a_script_pays_within_a_reward() {
    let text = |rewards: &str| {
        format!(
            "reward speed(weight: number = 0.5, spot: point = (0.5, 0), limit: speed = 4m/s) {{
                state n = 0
                n = n + 1
                give script rhai \"\"\"
                    fn reward(ctx, now, prev, events) {{
                        let p = ctx.params;
                        if now.me.speed > p.limit {{ p.weight * distance(now.ball, p.spot) + ctx.random() }} else {{ 0 }}
                    }}
                \"\"\" when n > 3 as \"far\"
                give weight * (if me.speed > limit then distance(ball, spot) / 1m else 0) when n > 3 as \"same\"
            }}
            scenario s {{
                param heavy = 3
                require heavy > 0
                ball at (0.2, 0)
                team left {{ GK at (-1, 0)  CF at (0.1, 0)  CM at (-0.1, 0.2) }}
                team right {{ GK at (1, 0) }}
                agents {{ left: 2 }}
                {rewards}
                end limit 60 steps
            }}"
        )
    };
    for (used, weight) in [
        ("reward speed", 0.5),
        ("reward speed(weight: 2)", 2.0),
        ("reward speed * heavy", 1.5),
        ("reward speed(weight: heavy, limit: 2m/s)", 3.0),
    ] {
        let mut environment = environment(&text(used));
        let _ = paid(&mut environment, 40);
        let names: Vec<&str> = environment.term_names().iter().map(String::as_str).collect();
        assert_eq!(names, ["speed/far", "speed/same"]);
        for agent in 0..2 {
            let [far, same] = environment.term_sums(agent) else { panic!("two terms") };
            // `ctx.random()` adds less than 1 per step.
            let scale = if used.ends_with("heavy") { 3.0 } else { 1.0 };
            assert!(*same > 10.0 * weight, "{used}: agent {agent} never ran: {same}");
            assert!(*far > *same && *far < *same + 37.0 * scale, "{used}: {far} beside {same}");
        }
    }
}

/// A reward that is a script may be weighed by a parameter.
#[test]
fn a_scripts_weight_may_be_computed() {
    let text = "scenario s { param w = 0.5  ball at (0.2, 0)  team left { CM at (0.1, 0) }  agents { left: 1 }
        reward script rhai \"\"\"fn reward(ctx, now, prev, events) { ctx.step }\"\"\" as \"own\" * (w + 1)
        end limit 9 steps }";
    let mut environment = environment(text);
    assert_eq!(paid(&mut environment, 3), [1.5, 3.0, 4.5]);
    assert_eq!(environment.term_names(), ["own/script"]);
}

/// What has no label is called by its text: in the one layout, so that it has one name, and one
/// noise, however it is laid out.
#[test]
fn an_observed_value_is_called_the_same_in_every_layout() {
    let named = |lines: &str| {
        let text = format!(
            "scenario s {{
                ball at (0.1, 0)
                team left {{ CM at (0, 0) }}
                agents {{ left: 1 }}
                observe vector {{ {lines} }}
                end limit 20 steps
            }}"
        );
        environment(&text).observed_names().clone()
    };
    let names = ["count(p in them where p.x > 0)", "ball - me.x", "ball - me.y", "min(1, 2)"];
    assert_eq!(
        named("count(p in them where p.x > 0)\nball - me\nmin(1, 2)"),
        names.map(str::to_owned)
    );
    assert_eq!(
        named("count( p in them  where p.x >0 )\nball-me\nmin(\n1, // one\n 2, /* two */\n)"),
        names.map(str::to_owned)
    );
}
