use super::*;
use crate::environment::{EnvironmentError, EnvironmentOptions, Scratch, StepError};
use crate::snapshot::{SNAPSHOT_VERSION, match_bytes};
use crate::state::PlayerId;
use crate::testing::{scenario, scoring};
use setpiece_scenario::vocabulary::{Action, Role, Team};
use setpiece_scenario::{
    Endings, Program, Reward, RewardBody, RewardHook, Scenario, Script, SideAgents,
};
use std::sync::Arc;

/// One on one, with a keeper behind.
fn duel() -> Scenario {
    let mut scenario = scenario(&[
        (Team::Left, Role::CF, -1.0, 0.0),
        (Team::Right, Role::GK, 50.0, 0.0),
        (Team::Right, Role::CB, 12.0, 2.0),
    ]);
    scenario.rewards.push(scoring());
    scenario
}

fn of(scenario: Scenario) -> Environment {
    Environment::new(Arc::new(scenario), EnvironmentOptions::default()).unwrap()
}

/// An environment after some steps of the bot.
fn underway(scenario: Scenario, steps: u32) -> Environment {
    let mut environment = of(scenario);
    environment.reset(Some(1), Some(2)).unwrap();
    play(&mut environment, steps);
    environment
}

fn play(environment: &mut Environment, steps: u32) {
    let mut scratch = Scratch::default();
    let actions = vec![Action::BuiltinAi; environment.n_agents()];
    for _ in 0..steps {
        environment.step(&actions, &mut scratch).unwrap();
    }
}

/// The snapshot of an environment whose match was changed.
fn tampered(tamper: impl FnOnce(&mut Environment)) -> Vec<u8> {
    let mut environment = underway(duel(), 10);
    tamper(&mut environment);
    environment.snapshot().unwrap()
}

fn refused(snapshot: &[u8]) -> String {
    let mut environment = underway(duel(), 3);
    let before = environment.snapshot().unwrap();
    let error = environment.restore(snapshot).unwrap_err();
    assert_eq!(environment.snapshot().unwrap(), before, "nothing has changed");
    error.to_string()
}

#[test]
fn a_snapshot_brings_back_whatever_has_happened_since() {
    let mut environment = underway(duel(), 10);
    let snapshot = environment.snapshot().unwrap();
    play(&mut environment, 20);
    let later = environment.snapshot().unwrap();
    environment.restore(&snapshot).unwrap();
    assert_eq!((environment.steps(), environment.seed(), environment.index()), (10, 1, 2));
    play(&mut environment, 20);
    assert_eq!(environment.snapshot().unwrap(), later);
}

#[test]
fn the_next_episode_is_that_of_the_straight_run() {
    let mut straight = underway(duel(), 5);
    let mut other = of(duel());
    other.restore(&straight.snapshot().unwrap()).unwrap();
    for environment in [&mut straight, &mut other] {
        environment.reset(None, None).unwrap();
        assert_eq!(environment.index(), 3);
    }
    assert_eq!(straight.snapshot(), other.snapshot());
}

#[test]
fn before_the_first_episode_and_after_the_last_step_there_is_something_to_take() {
    let fresh = of(duel());
    let mut ended = underway(duel(), 50);
    assert!(!ended.is_running());
    let last = ended.snapshot().unwrap();
    ended.restore(&fresh.snapshot().unwrap()).unwrap();
    let step =
        |environment: &mut Environment| environment.step(&[Action::Idle], &mut Scratch::default());
    assert_eq!(step(&mut ended), Err(StepError::NotRunning { begun: false }));
    ended.restore(&last).unwrap();
    assert_eq!(ended.outcome().map(|outcome| &*outcome.label), Some("limit"));
    assert_eq!(step(&mut ended), Err(StepError::NotRunning { begun: true }));
}

#[test]
fn impossible_numbers_are_reported_with_their_place() {
    for (bytes, words) in [
        (tampered(|e| e.game.players[11].pos.x = f32::NAN), "`match.players[11].pos[0]` is NaN"),
        (tampered(|e| e.game.ball.vel.z = 1.0e9), "`match.ball.vel[2]` is 1000000000"),
        (tampered(|e| e.game.tick = u32::MAX), "`match.tick` is 4294967295"),
        (
            tampered(|e| e.game.players[3].body.stats[2] = f32::NAN),
            "`match.players[3].body.stats[2]` is NaN",
        ),
        (
            tampered(|e| e.game.owner = Some(PlayerId(25))),
            "`match` has a value of none of its kinds",
        ),
        (tampered(|e| e.game.owner = Some(PlayerId(5))), "`match.owner` is nobody"),
        (
            tampered(|e| e.game.squad = e.game.squad.ids().chain([PlayerId(25)]).collect()),
            "`match` has a value of none of its kinds",
        ),
        (
            tampered(|e| e.game.agents[0].player = Some(PlayerId(11))),
            "`match.agents[0].player` is nobody of its team",
        ),
        (
            tampered(|e| Arc::make_mut(&mut e.bindings).0.push(1.0)),
            "`bindings` can't be bound: expected 0 parameter values, found 1",
        ),
    ] {
        assert_eq!(refused(&bytes), format!("the snapshot is damaged: {words}"));
    }
}

#[test]
fn bytes_that_are_no_snapshot_of_this_version_are_reported() {
    let snapshot = underway(duel(), 1).snapshot().unwrap();
    let mut newer = snapshot.clone();
    newer[8] = 99;
    let mut changed = snapshot.clone();
    changed[40] ^= 1;
    for (bytes, words) in [
        (b"{}".as_slice(), "not a snapshot: its header isn't recognised"),
        (
            &newer,
            &format!(
                "the snapshot has version 99; this build reads version {SNAPSHOT_VERSION}: take it again"
            ),
        ),
        (&changed, "the snapshot was changed after it was taken: its checksum differs"),
        (&snapshot[..100], "the snapshot is truncated: its end is missing"),
    ] {
        assert_eq!(refused(bytes), words);
    }
}

#[test]
fn a_snapshot_of_something_else_is_reported() {
    let with = |change: fn(&mut Scenario)| {
        let mut scenario = duel();
        change(&mut scenario);
        underway(scenario, 1).snapshot().unwrap()
    };
    assert_eq!(
        refused(&with(|scenario| scenario.name = "other".to_owned())),
        "the snapshot is of scenario `other`, this environment's is `test`"
    );
    assert_eq!(
        refused(&with(|scenario| scenario.doc = "Changed.".to_owned())),
        "the snapshot is of another version of `test`: the scenario has changed since"
    );
    let unpaid = EnvironmentOptions { rewards: Some(Vec::new()), ..EnvironmentOptions::default() };
    let unpaid = Environment::new(Arc::new(duel()), unpaid).unwrap();
    assert_eq!(
        refused(&unpaid.snapshot().unwrap()),
        "the snapshot's rewards are none, this environment's `scoring`"
    );
}

#[test]
fn an_episode_begins_where_another_stood() {
    let mut environment = underway(duel(), 20);
    let snapshot = environment.snapshot().unwrap();
    let stood = environment.state().clone();
    environment.reset_from(&snapshot, Some(7), Some(4)).unwrap();
    let game = environment.state();
    assert_eq!((game.ball, game.score, game.tick), (stood.ball, stood.score, stood.tick));
    assert!(
        game.players
            .iter()
            .zip(&stood.players)
            .all(|(now, then)| now.pos == then.pos && now.vel == then.vel)
    );
    assert_eq!(
        (game.step, game.elapsed_at_start),
        (0, 20),
        "steps start at 0, the clock continues"
    );
    assert_eq!((environment.seed(), environment.index()), (7, 4));
    assert!(environment.is_running() && environment.events().is_empty());
    play(&mut environment, 50);
    assert!(!environment.is_running(), "the limit counts from the new start");
}

/// Everything under way keeps its timing, although steps are counted from 0 again.
#[test]
fn what_was_under_way_goes_on() {
    // A multiple of the bots' own rhythm.
    let mut straight = underway(duel(), 12);
    let mut hindsight = of(duel());
    hindsight.reset_from(&straight.snapshot().unwrap(), Some(1), Some(2)).unwrap();
    hindsight.game.play_random = straight.game.play_random.clone();
    hindsight.game.bot_random = straight.game.bot_random.clone();
    for _ in 0..30 {
        play(&mut straight, 1);
        play(&mut hindsight, 1);
        assert_eq!(hindsight.game.ball, straight.game.ball);
        assert!(
            hindsight.game.players.iter().zip(&straight.game.players).all(|(a, b)| a.pos == b.pos)
        );
    }
}

#[test]
fn noise_is_the_new_seeds() {
    let snapshot = underway(duel(), 12).snapshot().unwrap();
    let ball = |seed| {
        let mut environment = of(duel());
        environment.reset_from(&snapshot, Some(seed), None).unwrap();
        // A kick involves chance.
        for _ in 0..12 {
            environment.step(&[Action::Shot], &mut Scratch::default()).unwrap();
        }
        environment.state().ball
    };
    assert_eq!(ball(1), ball(1));
    assert_ne!(ball(1), ball(2));
}

#[test]
fn the_scenario_may_be_another_but_not_who_takes_part() {
    let mut holding = underway(duel(), 20);
    holding.step(&[Action::Right], &mut Scratch::default()).unwrap();
    let snapshot = holding.snapshot().unwrap();
    let mut longer = duel();
    longer.name = "longer".to_owned();
    longer.rewards.clear();
    longer.endings = Endings::default();
    longer.start.limit = None;
    longer.players[0].role = Role::CM;
    let mut longer = of(longer);
    longer.reset_from(&snapshot, None, None).unwrap();
    assert_eq!(longer.limit_steps(), None);
    assert_eq!(longer.state().players[0].role, Role::CM, "control is the new scenario's");
    assert_eq!(longer.agents()[0].sticky, 0, "a new episode begins with nothing held");
    play(&mut longer, 100);

    let mut alone = duel();
    alone.players.pop();
    let error = of(alone).reset_from(&snapshot, None, None).unwrap_err();
    assert_eq!(
        error.to_string(),
        "the right players differ: the snapshot has 2, this environment 1"
    );
    let mut led = duel();
    led.agents.sides = [SideAgents::All, SideAgents::All];
    let error = of(led).reset_from(&snapshot, None, None).unwrap_err();
    assert!(error.to_string().starts_with("the agents differ: the snapshot has left"), "{error}");
    let unbegun = of(duel()).snapshot().unwrap();
    let error = of(duel()).reset_from(&unbegun, None, None).unwrap_err();
    assert_eq!(error.to_string(), "the snapshot was taken before an episode had begun");
}

#[test]
fn every_episode_may_begin_from_one_snapshot() {
    let snapshot: Arc<[u8]> = underway(duel(), 20).snapshot().unwrap().into();
    let from =
        |snapshot| EnvironmentOptions { from: Some(snapshot), ..EnvironmentOptions::default() };
    let mut environment = Environment::new(Arc::new(duel()), from(snapshot)).unwrap();
    for _ in 0..2 {
        environment.reset(None, None).unwrap();
        assert_eq!(environment.state().elapsed_at_start, 20);
    }
    let none = Environment::new(Arc::new(duel()), from(b"none".as_slice().into())).unwrap_err();
    assert_eq!(none, EnvironmentError::Snapshot(SnapshotError::NotASnapshot));
}

/// A scenario with a script that is called each step.
fn scripted(source: &str) -> Scenario {
    let mut scenario = duel();
    scenario.scripts.push(Script {
        name: "own.rhai".to_owned(),
        at: (1, 1),
        source: source.to_owned(),
        named: Vec::new(),
        modules: Vec::new(),
    });
    let body = RewardBody {
        init: Program { code: Vec::new(), cells: 1, ..Program::default() },
        step: Program { code: Vec::new(), cells: 1, ..Program::default() },
        terms: Vec::new(),
        hooks: vec![RewardHook { script: 0, cell: 0, terms: Vec::new(), args: Vec::new() }],
    };
    scenario.rewards = vec![Reward { name: "own".to_owned(), doc: String::new(), body }];
    scenario
}

#[test]
fn a_function_in_a_scripts_memory_can_not_be_kept() {
    let source = "fn reward(ctx, now, prev, events) { this.how = #{ to: [1, |x| x + 1] }; 0.0 }";
    let error = underway(scripted(source), 1).snapshot().unwrap_err();
    let words = "a script keeps a function in `this.how.to[1]`: \
                 a snapshot holds numbers, words, lists, maps and what a hook is shown";
    assert_eq!(error.to_string(), words);
}

#[test]
fn what_a_script_was_shown_is_one_and_the_same_afterwards() {
    // Both names refer to one scene: what one draws, the other has drawn too.
    let source = "fn reward(ctx, now, prev, events) {
        if this.a == () { this.a = ctx; this.b = ctx; }
        this.sum = this.a.random() + 10.0 * this.b.random();
        this.sum
    }";
    let mut straight = underway(scripted(source), 3);
    let mut other = of(scripted(source));
    other.restore(&straight.snapshot().unwrap()).unwrap();
    for _ in 0..5 {
        play(&mut straight, 1);
        play(&mut other, 1);
        assert_eq!(other.snapshot(), straight.snapshot());
    }
}

#[test]
fn a_match_is_small() {
    let size = match_bytes(underway(duel(), 10).state()).unwrap().len();
    assert!(size < 16 * 1024, "{size} bytes");
}
