//! Snapshots: a restored match continues like the original run, from any step of any match; and no
//! bytes do harm.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

use proptest::prelude::*;
use setpiece::engine::digest;
use setpiece::engine::environment::{Environment, EnvironmentOptions, ResetError, Scratch};
use setpiece::engine::random::{Purpose, Stream};
use setpiece::engine::snapshot::{CONTAINER, SnapshotError, match_bytes};
use setpiece::engine::state::player::{Intent, Pose};
use setpiece::scenario::container::HEAD_BYTES;
use setpiece::scenario::vocabulary::EventKind;
use setpiece::scenario::{Action, Bindings, Scenario};
use std::collections::BTreeMap;
use std::sync::Arc;

/// How many step boundaries are tried.
const BOUNDARIES: u32 = 10_000;

/// Everything that an episode can remember: temporal functions, series, a declared observation, a
/// scripted player with a drawn behaviour, scripts that keep maps, lists, words and what they were
/// shown.
const MEMORY: &str = r#"
reward chain {
    state n = 0
    state spot = (0m, 0m)
    give 0.1 once when ball in them.box as "box"
    give 0.01 when held(us has ball, for: 0.5s) as "held"
    give 0.001 * since(pass by us) / 1s when ever(pass by us) as "since"
    give 0.01 * closing(ball, them.goal) / 1m as "closer"
    give 0.5 on goal by us when until(us has ball, shot by us) as "quick"
    on pass by us { n = n + 1  spot = ball }
    give 0.001 * n as "n"
    give 0.001 * distance(ball, spot) / 1m as "spot"
}

behavior wander(longest: duration) {
    repeat until elapsed > 20s {
        let way = me + (uniform(-6m, 6m), uniform(-6m, 6m))
        do move_to(way) for 2s
        do hold for uniform(0.3s, longest)
        do script rhai """
            fn act(ctx, me, now) {
                this.n = if this.n == () { 1 } else { this.n + 1 };
                this.seen = me;
                if ctx.random() < 0.5 { "left" } else { "sprint" }
            }
        """ for 0.5s
    }
    interrupt when possession == them { do press until possession == us }
}

scenario memory {
    param pace: speed = 6m/s in 2m/s..9m/s
    let lane = uniform(-0.15, 0.15)
    rules { half_time: 6s  offside: on  handball: on }
    agents { left: 3  right: 1 }
    ball at (0.2, lane)
    team left {
        GK at (-1, 0)
        CM at (0.18, 0)
        CF at (0.4, 0.1)
        RM at (0.3, 0.2)
        runner: LM at (0.1, -0.2) { ai: wander(2s) }
    }
    team right {
        GK at (1, 0)
        CB at (0.6, 0) { ai: script rhai """
            fn reset(ctx) { this.moves = ["idle", "left", "sliding"]; }
            fn act(ctx, me, now) { this.moves[(ctx.random() * 2.99).to_int()] }
        """ }
        CB at (0.62, 0.1)
        CF at (-0.2, lane)
    }

    reward scoring
    reward chain
    reward script rhai """
        fn reset(ctx) {
            this.quick = 0;
            this.words = "";
            this.places = [];
            this.deep = #{ a: #{ b: [1, 2.5, true, 'x', (), "y"] }, r: 0..5, s: 1..=3 };
        }
        fn reward(ctx, now, prev, events) {
            if now.me != () && now.me.speed > ctx.params.pace { this.quick += 1; }
            if this.places.len > 5 { this.places.remove(0); }
            this.places.push(now.ball.at);
            this.deep.a.b[1] = ctx.random();
            this.velocity = now.ball.velocity;
            let back = if this.last == () || ctx.step % 7 == 0 { this.last = now; this.ctx = ctx; 0.0 } else {
                this.last.ball.x + this.last.elapsed + this.ctx.random()
            };
            for event in events { this.words = event.kind; this.event = event; }
            let on = if this.event == () { 0.0 } else { this.event.at.x };
            0.001 * this.quick + 0.01 * this.deep.a.b[1] + back + on + this.words.len + this.places[0].x
        }
    """ as "mine" * 0.5

    end scored when goal by left
    end script rhai """
        fn done(ctx, now, prev, events) {
            this.still = if now.ball.speed < 0.1 { (if this.still == () { 0 } else { this.still }) + 1 } else { 0 };
            if this.still > 60 { "standing" } else { false }
        }
    """
    end limit 400 steps

    record passes = count of pass completed by left
    record top_speed = max of me.speed
    record began_at = first of ball
    record path = series of ball
    record quickest = max of chain.n
    observe vector { distance(me, ball) as "near"  delta(ball.x) as "way" }
}
"#;

/// A match that never ends early, with an early half-time and many cards, fouls and set pieces.
const HALVES: &str = "scenario halves extends 11_vs_11_stochastic {
    rules { half_time: 20s }
    end limit 500 steps
}";

fn compiled(text: &str) -> Arc<Scenario> {
    setpiece::compile_text(text, "<test>").unwrap_or_else(|error| panic!("{error}")).scenario
}

fn library(name: &str) -> Arc<Scenario> {
    setpiece::load(name).unwrap().scenario
}

fn environment(scenario: &Arc<Scenario>) -> Environment {
    Environment::new(scenario.clone(), EnvironmentOptions::default()).unwrap()
}

/// The scenarios of the walk. They have no scripts: one looks back at the ball only, one at players
/// too.
fn looking_back() -> [Arc<Scenario>; 2] {
    ["delta(ball.x)", "delta(me.x)"].map(|seen| {
        compiled(&format!(
            "reward back {{ give 0.01 * {seen} as \"back\" }}
            scenario looking_back extends academy_3_vs_1_with_keeper {{
                reward back
                observe vector {{ {seen} as \"back\" }}
            }}"
        ))
    })
}

fn scenarios() -> Vec<Arc<Scenario>> {
    let mut scenarios = vec![compiled(MEMORY), compiled(HALVES), library("11_vs_11_stochastic")];
    scenarios.extend(looking_back());
    let rest = [
        "academy_3_vs_1_with_keeper",
        "academy_corner",
        "academy_run_to_score_with_keeper",
        "5_vs_5",
    ];
    scenarios.extend(rest.map(library));
    scenarios
}

/// An agent that mostly plays as the bot, otherwise at random. Every choice comes from the walk's
/// stream.
fn choose(walk: &mut Stream, actions: &mut [Action]) {
    for action in actions {
        *action = match walk.below(4) {
            0 => Action::from_index(walk.below(Action::DEFAULT_SET as u32) as usize).unwrap(),
            1 => Action::Shot,
            _ => Action::BuiltinAi,
        };
    }
}

/// Everything visible of an environment after a step, floats by their bits.
fn seen(environment: &mut Environment) -> String {
    let n_agents = environment.n_agents();
    let n_observed = environment.observed_names().len();
    let mut observed = vec![0.0; n_observed];
    let mut text = format!("{:x} ", environment.digest());
    for agent in 0..n_agents {
        text += &format!("{:?} {:?} ", environment.terms(agent), environment.term_sums(agent));
        if n_observed > 0 {
            environment.observe_vector(agent, &mut observed).unwrap();
            text += &format!("{observed:?} ");
        }
    }
    let records: Vec<_> = environment.records().collect();
    text.push_str(&format!(
        "{:?} {records:?} {:?} {:?} {:?} {:?} {} {} {} {:x}",
        environment.rewards(),
        environment.events(),
        environment.outcome(),
        environment.agents(),
        environment.statistics(),
        environment.faults(),
        environment.is_running(),
        environment.ends_at_start().is_some(),
        digest::of_match(environment.judged_state()),
    ));
    text
}

/// What is under way at a boundary.
fn moments(environment: &Environment) -> Vec<&'static str> {
    let game = environment.state();
    let happened = |kind: EventKind| environment.events().iter().any(|event| event.kind == kind);
    let bodies = || game.players.iter().filter(|player| player.active).map(|player| &player.body);
    let moments = [
        (
            "mid-kick",
            bodies().any(|body| {
                body.kick.is_some_and(|kick| {
                    kick.swing.is_some_and(|swing| swing.ready_at > game.tick as i32)
                })
            }),
        ),
        ("mid-save", game.play.save.iter().any(Option::is_some)),
        ("diving", bodies().any(|body| body.pose == Pose::Diving)),
        ("sliding", bodies().any(|body| body.pose == Pose::Sliding)),
        ("in the keeper's hands", game.play.hands.is_some()),
        ("pass under way", game.play.pass.is_some()),
        ("shot under way", game.play.shot.is_some()),
        ("set piece pending", game.play.set_piece.is_some()),
        ("kick-off pending", game.play.kick_off.is_some()),
        ("running to the ball", bodies().any(|body| matches!(body.intent, Intent::Ball(_)))),
        ("restarted", happened(EventKind::OutOfPlay) || happened(EventKind::Foul)),
        ("goal", happened(EventKind::Goal)),
        ("half-time", happened(EventKind::HalfTime)),
        ("second half", game.play.second_half),
        ("over", !environment.is_running()),
    ];
    moments.into_iter().filter(|(_, holds)| *holds).map(|(name, _)| name).collect()
}

#[test]
fn a_restored_match_is_the_straight_run() {
    let mut walk = Stream::new(4, 0, Purpose::Agent);
    let mut scratch = Scratch::default();
    let (mut tried, mut found) = (0, BTreeMap::<&str, u32>::new());
    let (mut core, mut whole) = (0, 0);
    let mut worlds: Vec<(Environment, Environment)> =
        scenarios().iter().map(|scenario| (environment(scenario), environment(scenario))).collect();
    for episode in 0.. {
        if tried >= BOUNDARIES {
            break;
        }
        let n_worlds = worlds.len();
        let (straight, other) = &mut worlds[episode % n_worlds];
        straight.reset(Some(9), Some(episode as u64)).unwrap();
        let mut actions = vec![Action::Idle; straight.n_agents()];
        // How many more steps the restored one is compared.
        let mut tail = 0;
        for _ in 0..300 {
            if tail == 0 && walk.below(3) > 0 {
                tail = [1, 1, 2, 4, 12][walk.below(5) as usize];
                let snapshot = straight.snapshot().unwrap();
                other.restore(&snapshot).unwrap();
                assert_eq!(
                    other.snapshot().unwrap(),
                    snapshot,
                    "what is restored is what was taken"
                );
                assert_eq!(seen(other), seen(straight));
                core = core.max(match_bytes(straight.state()).unwrap().len());
                whole = whole.max(snapshot.len());
                tried += 1;
                for moment in moments(straight) {
                    *found.entry(moment).or_default() += 1;
                }
            }
            if !straight.is_running() {
                break;
            }
            choose(&mut walk, &mut actions);
            let result = straight.step(&actions, &mut scratch);
            if tail > 0 {
                tail -= 1;
                assert_eq!(other.step(&actions, &mut scratch), result);
                assert_eq!(
                    seen(other),
                    seen(straight),
                    "{} {}",
                    straight.scenario().name,
                    straight.steps()
                );
                if tail == 0 {
                    assert_eq!(other.snapshot(), straight.snapshot());
                }
            }
        }
    }
    assert!(core <= 16 * 1024, "a match takes {core} bytes");
    assert!(whole <= 64 * 1024, "a snapshot takes {whole} bytes");
    for moment in [
        "mid-kick",
        "mid-save",
        "diving",
        "sliding",
        "in the keeper's hands",
        "pass under way",
        "shot under way",
        "set piece pending",
        "kick-off pending",
        "running to the ball",
        "restarted",
        "goal",
        "half-time",
        "second half",
        "over",
    ] {
        assert!(found.contains_key(moment), "no boundary was {moment}: {found:?}");
    }
}

#[test]
fn a_copy_in_memory_is_the_straight_run() {
    let mut walk = Stream::new(5, 0, Purpose::Agent);
    let mut scratch = Scratch::default();
    // A script that draws through a `ctx` of an earlier step shares that step's numbers with
    // copies.
    let fresh =
        compiled(&MEMORY.replace("this.ctx = ctx; ", "").replace(" + this.ctx.random()", ""));
    let mut scenarios = vec![fresh];
    scenarios.extend(
        ["11_vs_11_stochastic", "academy_corner", "academy_run_to_score_with_keeper"].map(library),
    );
    let mut stopped = 0;
    for (k, scenario) in scenarios.iter().enumerate() {
        // The copy is wherever it was left: at first in another episode, or in a different
        // scenario.
        let (mut straight, mut copy) =
            (environment(scenario), environment(&scenarios[(k + 1) % scenarios.len()]));
        for episode in 0..4 {
            straight.reset(Some(9), Some(episode)).unwrap();
            let mut actions = vec![Action::Idle; straight.n_agents()];
            for _ in 0..300 {
                copy.clone_from(&straight);
                assert_eq!(
                    copy.snapshot(),
                    straight.snapshot(),
                    "what is copied is what was there"
                );
                stopped += u32::from(copy.judged_state().dead);
                if !straight.is_running() {
                    break;
                }
                choose(&mut walk, &mut actions);
                let result = straight.step(&actions, &mut scratch);
                assert_eq!(copy.step(&actions, &mut scratch), result);
                assert_eq!(
                    seen(&mut copy),
                    seen(&mut straight),
                    "{} {}",
                    scenario.name,
                    straight.steps()
                );
            }
        }
    }
    assert!(stopped > 5, "{stopped} stops of play");
}

/// Gives a snapshot's content the head that fits it.
fn sealed(file: Vec<u8>) -> Vec<u8> {
    CONTAINER.seal(file)
}

/// An environment some steps into an episode, with its snapshot.
fn underway(scenario: &Arc<Scenario>, seed: u64, steps: u32) -> (Environment, Vec<u8>) {
    let mut environment = environment(scenario);
    let (mut walk, mut scratch) = (Stream::new(seed, 1, Purpose::Agent), Scratch::default());
    environment.reset(Some(seed), None).unwrap();
    let mut actions = vec![Action::Idle; environment.n_agents()];
    for _ in 0..steps {
        if environment.is_running() {
            choose(&mut walk, &mut actions);
            environment.step(&actions, &mut scratch).unwrap();
        }
    }
    let snapshot = environment.snapshot().unwrap();
    (environment, snapshot)
}

/// Restores arbitrary bytes: an error changes nothing, and accepted bytes can be played on.
fn harmless(environment: &mut Environment, before: &[u8], bytes: &[u8]) {
    if environment.restore(bytes).is_err() {
        assert_eq!(environment.snapshot().unwrap(), before, "an error changes nothing");
        return;
    }
    play_on(environment);
    environment.restore(before).unwrap();
    if environment.reset_from(bytes, Some(1), None).is_ok() {
        play_on(environment);
    }
    environment.restore(before).unwrap();
}

fn play_on(environment: &mut Environment) {
    let (mut walk, mut scratch) = (Stream::new(5, 5, Purpose::Agent), Scratch::default());
    let mut actions = vec![Action::Idle; environment.n_agents()];
    for _ in 0..5 {
        choose(&mut walk, &mut actions);
        // A script may fail because of its memory.
        if environment.step(&actions, &mut scratch).is_err() {
            return;
        }
    }
    seen(environment);
    environment.snapshot().unwrap();
}

#[test]
fn no_cut_and_no_flipped_bit_goes_unseen() {
    let (mut environment, snapshot) = underway(&compiled(MEMORY), 3, 40);
    let mut other = environment.clone();
    for length in 0..snapshot.len() {
        let error = other.restore(&snapshot[..length]).unwrap_err();
        assert!(matches!(error, SnapshotError::NotASnapshot | SnapshotError::Truncated), "{error}");
    }
    for at in 0..snapshot.len() {
        let mut flipped = snapshot.clone();
        flipped[at] ^= 1 << (at % 8);
        other.restore(&flipped).unwrap_err();
        assert!(matches!(other.reset_from(&flipped, None, None), Err(ResetError::Snapshot(_))));
    }
    assert_eq!(other.snapshot().unwrap(), snapshot);
    assert_eq!(seen(&mut other), seen(&mut environment));
}

/// A change of a snapshot's content, each place as a share of the length.
#[derive(Clone, Debug)]
enum Change {
    Byte(f64, u8),
    Float(f64, f32),
    Cut(f64, usize),
    Doubled(f64, usize),
}

fn change() -> impl Strategy<Value = Change> {
    let floats = prop_oneof![
        Just(f32::NAN),
        Just(f32::INFINITY),
        Just(-9.0e3),
        Just(9.9e3),
        Just(0.0),
        any::<f32>()
    ];
    let bytes = prop_oneof![Just(0), Just(255), Just(127), Just(22), any::<u8>()];
    prop_oneof![
        6 => (0.0..1.0, bytes).prop_map(|(at, byte)| Change::Byte(at, byte)),
        6 => (0.0..1.0, floats).prop_map(|(at, float)| Change::Float(at, float)),
        1 => (0.0..1.0, 1usize..40).prop_map(|(at, n)| Change::Cut(at, n)),
        1 => (0.0..1.0, 1usize..40).prop_map(|(at, n)| Change::Doubled(at, n)),
    ]
}

fn changed(snapshot: &[u8], changes: &[Change]) -> Vec<u8> {
    let mut bytes = snapshot.to_vec();
    for change in changes {
        let body = bytes.len() - HEAD_BYTES;
        let place = |at: f64| HEAD_BYTES + (at * body as f64) as usize;
        match *change {
            Change::Byte(at, byte) => bytes[place(at)] = byte,
            Change::Float(at, float) => {
                let at = place(at);
                let end = bytes.len().min(at + 4);
                bytes[at..end].copy_from_slice(&float.to_le_bytes()[..end - at]);
            }
            Change::Cut(at, n) => {
                let end = bytes.len().min(place(at) + n);
                bytes.drain(place(at)..end);
            }
            Change::Doubled(at, n) => {
                let end = bytes.len().min(place(at) + n);
                let part = bytes[place(at)..end].to_vec();
                bytes.splice(end..end, part);
            }
        }
        if bytes.len() <= HEAD_BYTES {
            return bytes;
        }
    }
    bytes
}

#[test]
fn whatever_a_sealed_snapshot_says_does_no_harm() {
    let worlds: Vec<(Environment, Vec<u8>)> = scenarios()
        .iter()
        .zip(1..)
        .map(|(scenario, seed)| underway(scenario, seed, 30 + 7 * seed as u32))
        .collect();
    let config = ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(3_000) };
    let changes = proptest::collection::vec(change(), 1..6);
    proptest!(config, |(which in 0..worlds.len(), changes in changes)| {
        let (environment, snapshot) = &worlds[which];
        harmless(&mut environment.clone(), snapshot, &sealed(changed(snapshot, &changes)));
    });
}

#[test]
fn no_byte_of_a_sealed_snapshot_does_harm_as_the_largest() {
    let scenarios = scenarios();
    let (mut environment, snapshot) = underway(scenarios.last().unwrap(), 6, 72);
    for at in HEAD_BYTES..snapshot.len() {
        let mut bytes = snapshot.clone();
        bytes[at] = u8::MAX;
        harmless(&mut environment, &snapshot, &sealed(bytes));
    }
}

/// A reset that finds no start leaves the last episode visible, under its own key.
#[test]
fn what_is_left_by_a_reset_without_a_start_is_restored() {
    let scenario = compiled(
        r#"
        behavior whim {
            do script rhai """fn act(ctx, me, now) { if ctx.random() < 0.5 { "left" } else { "right" } }"""
        }
        scenario picky {
            param least: length = 0m in 0m..90m
            let side = uniform(-0.2, 0.2)
            agents { left: 1 }
            ball at (0, side)
            team left { CM at (-0.1, 0) }
            team right {
                GK at (1, 0)
                LB at (0.5, 0.2) { ai: whim }
                CB at (0.5, 0.1) { ai: whim }
                RB at (0.5, -0.1) { ai: whim }
            }
            require min_gap(right) > least
            end limit 50 steps
        }"#,
    );
    let mut scratch = Scratch::default();
    for seed in 0..20 {
        let mut environment = environment(&scenario);
        environment.reset(Some(seed), None).unwrap();
        environment.step(&[Action::Right], &mut scratch).unwrap();
        environment.set_bindings(&Bindings(vec![80.0])).unwrap();
        environment.reset(Some(seed + 1000), Some(7)).unwrap_err();
        let mut other = self::environment(&scenario);
        other.restore(&environment.snapshot().unwrap()).unwrap();
        assert_eq!(seen(&mut other), seen(&mut environment));
        assert_eq!(other.bot_actions(), environment.bot_actions(), "seed {seed}");
        other.reset(None, None).unwrap_err();
    }
}

#[test]
fn parameters_are_kept_before_the_first_episode_too() {
    let scenario = compiled(MEMORY);
    let (mut taken, mut given) = (environment(&scenario), environment(&scenario));
    taken.set_bindings(&Bindings(vec![3.0])).unwrap();
    given.restore(&taken.snapshot().unwrap()).unwrap();
    assert_eq!(given.bindings(), taken.bindings());
}
