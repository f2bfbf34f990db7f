//! The run-time cost of the language: drawing a start, and judging a step.
//!
//! Times are the thread's CPU time. A draw places 22 players and a ball, each somewhere in a
//! region, under two requirements. Judging covers one step and one agent unless the name says
//! otherwise, in the state of a match of eleven a side, with three events in the step.
#![allow(
    missing_docs,
    clippy::panic,
    reason = "criterion's macros write undocumented functions; a benchmark fails by panicking"
)]

#[path = "measure/cpu.rs"]
mod cpu;

use cpu::CpuTime;
use criterion::{Criterion, criterion_group, criterion_main};
use setpiece::Loaded;
use setpiece::engine::draw::{Drawer, Roster};
use setpiece::engine::environment::{Environment, EnvironmentOptions, Scratch};
use setpiece::engine::judge::script::Scripts;
use setpiece::engine::judge::{Given, Judge};
use setpiece::engine::state::event::{Event, Events};
use setpiece::scenario::{Action, Bindings, EventKind, Qualifier, Scenario, Team};
use std::hint::black_box;
use std::sync::Arc;
use std::time::Duration;

fn compiled(text: &str) -> Loaded {
    setpiece::compile_text(text, "<bench>").unwrap_or_else(|error| panic!("{error}"))
}

const CROWD: &str = "scenario crowd {
    agents { left: 1 }
    ball in middle.third
    team left { GK at own (-1, 0)  4 CB in left.third  3 CM in left.half  3 CF in right.half }
    team right { GK at own (-1, 0)  4 CB in right.third  3 CM in right.half  3 CF in left.half }
    require min_gap(left) > 1m
    require ball.x > -0.3
    end limit 400 steps
}";

fn draws(c: &mut Criterion<CpuTime>) {
    let loaded = compiled(CROWD);
    let scenario = &*loaded.scenario;
    let bindings = Bindings::defaults(&scenario.params);
    let roster = Roster::new(scenario, &bindings, None).unwrap_or_else(|error| panic!("{error}"));
    let mut drawer = Drawer::new(scenario);
    let mut index = 0;
    c.bench_function("draw/23_entities_2_requires", |b| {
        b.iter(|| {
            index += 1;
            black_box(drawer.draw(scenario, &bindings, &roster, 1, index))
                .unwrap_or_else(|error| panic!("{error}"))
        });
    });
}

const SHAPING: &str = "reward shaping {
        give 0.02 * closing(ball, them.goal) / 1m as \"approach\"
        give 0.1 once when ball in them.box as \"box\"
        give 0.05 on pass completed by us as \"pass\"
        give -0.2 on ball_lost by me as \"lost\"
        give 0.01 when me has ball as \"ball\"
        give -0.01 when pressed(me, within: 2m) as \"pressed\"
        give 0.001 * me.speed / 1m * 1s as \"speed\"
        give 0.01 * smoothstep(0m, 30m, distance(me, them.goal)) as \"far\"
        give 0.5 on shot by us as \"shot\"
        give -0.001 * me.fatigue as \"fatigue\"
    }";

/// A term that looks at one place.
const ONE_PLACE: &str =
    "reward r { give 0.01 * smoothstep(0m, 30m, distance(ball, them.goal)) as \"a\" }";

/// The same at 192 places.
const GRID: &str = "reward r {
        give 0.01 * mean(smoothstep(0m, 30m, distance(q, them.goal)) for q in grid(16, 12)) as \"a\"
    }";

/// A table at 192 places.
const TABLE_ON_GRID: &str =
    "reward r { give 0.01 * mean(threat(q, linear) for q in grid(16, 12)) as \"a\" }";

/// Which of two teams has the nearest player, at 192 places: 4,224 distances.
const CONTROL: &str = "reward r {
        give 0.01 * mean(
            if min(distance(p, q) for p in us) < min(distance(p, q) for p in them) then 1 else 0
            for q in grid(12, 16, right.half)
        ) as \"a\"
    }";

/// The same for seven players who run on first, in the example: for three agents, with a record.
const PITCH_CONTROL: &str = include_str!("../../examples/pitch_control.pitch");

/// Twenty operations: operators, assignments, calls and properties.
const SCRIPT_WITH_HELPERS: &str = "reward script rhai \"\"\"
        fn reward(ctx, now, prev, events) {
            let ball = now.ball;
            let goal = now.them.goal;
            let gap = distance(ball, goal);
            let r = (distance(prev.ball, goal) - gap) * 0.02;
            if gap < 20.0 && speed(ball) > 5.0 { r += 0.005 * speed(ball); }
            r + 0.01 * smoothstep(5.0, 30.0, gap) - clamp(gap, 0.0, 0.001)
        }
    \"\"\"";

/// Twenty operations, twelve of them properties.
const SCRIPT_WITH_GETTERS: &str = "reward script rhai \"\"\"
        fn reward(ctx, now, prev, events) {
            let r = (now.ball.x - prev.ball.x) * 0.5;
            if now.me.has_ball { r += 0.01; }
            if now.ball.speed > -1.0 { r += 0.005 * now.me.speed; }
            r - 0.001 * now.me.fatigue
        }
    \"\"\"";

/// A judge in the middle of a match, ready to judge one step repeatedly.
fn judging(c: &mut Criterion<CpuTime>, name: &str, rewards: &str, agents: &str) {
    let text = format!(
        "table threat over pitch = [[0, 0.1, 0.3], [0, 0.2, 0.4]]
        scenario s extends 11_vs_11_stochastic {{ remove reward scoring  agents {{ {agents} }}  {rewards} }}"
    );
    judging_scenario(c, name, &compiled(&text).scenario, 300);
}

/// The same for the rewards of a scenario, with its own agents, after this many steps.
fn judging_scenario(c: &mut Criterion<CpuTime>, name: &str, scenario: &Arc<Scenario>, steps: u32) {
    let mut environment = Environment::new(scenario.clone(), EnvironmentOptions::default())
        .unwrap_or_else(|error| panic!("{name}: {error}"));
    environment.reset(Some(1), None).unwrap_or_else(|error| panic!("{error}"));
    let mut scratch = Scratch::default();
    let actions = vec![Action::BuiltinAi; environment.n_agents()];
    for _ in 0..steps {
        environment.step(&actions, &mut scratch).unwrap_or_else(|error| panic!("{error}"));
    }
    let scripts = Scripts::compile(scenario).unwrap_or_else(|error| panic!("{error}"));
    let n_agents = environment.n_agents();
    let mut judge = Judge::new(scenario, scenario.rewards.clone().into(), scripts, n_agents);
    let game = environment.state();
    let params = &environment.bindings().0;
    let given = Given { seed: 1, index: 0, params, lets: &[], round: 1, rounds: 1, round_start: 0 };
    judge.reset(game, &given);
    let event = |kind, qualifier| Event {
        tick: game.tick,
        kind,
        qualifier,
        team: Some(Team::Left),
        by: game.agents.first().and_then(|agent| agent.player),
        to: None,
        at: game.ball.pos,
        length_m: 12.0,
        speed_mps: 9.0,
    };
    let mut events = Events::new();
    c.bench_function(name, |b| {
        b.iter(|| {
            events.clear();
            events.push(event(EventKind::Touch, None));
            events.push(event(EventKind::Pass, Some(Qualifier::Completed)));
            events.push(event(EventKind::Touch, None));
            let outcome =
                judge.step(black_box(game), &mut events).unwrap_or_else(|error| panic!("{error}"));
            judge.settle(game);
            black_box(outcome)
        });
    });
}

fn judges(c: &mut Criterion<CpuTime>) {
    judging(c, "judge/nothing", "", "left: 1");
    judging(c, "judge/checkpoints", "reward checkpoints", "left: 1");
    judging(c, "judge/shaping_of_ten_terms", SHAPING, "left: 1");
    judging(c, "judge/shaping_of_ten_terms_22_agents", SHAPING, "left: all  right: all");
    judging(c, "judge/one_place", ONE_PLACE, "left: 1");
    judging(c, "judge/grid_of_192_places", GRID, "left: 1");
    judging(c, "judge/table_on_192_places", TABLE_ON_GRID, "left: 1");
    judging(c, "judge/control_of_192_places", CONTROL, "left: 1");
    judging_scenario(c, "judge/example_of_192_places", &compiled(PITCH_CONTROL).scenario, 20);
    judging(c, "judge/script_with_helpers", SCRIPT_WITH_HELPERS, "left: 1");
    judging(c, "judge/script_with_getters", SCRIPT_WITH_GETTERS, "left: 1");
}

criterion_group! {
    name = all;
    config = Criterion::default()
        .with_measurement(CpuTime)
        .sample_size(30)
        .warm_up_time(Duration::from_millis(500))
        .measurement_time(Duration::from_secs(2));
    targets = draws, judges
}
criterion_main!(all);
