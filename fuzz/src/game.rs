//! A game under observation: every number that leaves it must be finite.

use crate::choice::Choices;
use setpiece::engine::environment::{Environment, EnvironmentOptions, Scratch};
use setpiece::engine::judge::Recorded;
use setpiece::engine::observe;
use setpiece::scenario::pitch::PLAYERS_MAX;
use setpiece::scenario::vocabulary::{Action, Team};
use setpiece::scenario::{Bindings, Scenario};
use std::cell::RefCell;
use std::sync::Arc;

/// How far beyond the rim a player may run before they are put back, m: two ticks at 12 m/s.
const SLACK_M: f32 = 0.25;
/// The largest possible distance of a ball from the centre spot, m.
const BALL_MAX_M: f32 = 1.0e4;

thread_local! {
    static SCRATCH: RefCell<Scratch> = RefCell::default();
}

/// Plays an episode, at most `steps` steps of it, with actions from the bytes. A rejected
/// environment, start or script is fine.
///
/// Returns the last state's fingerprint; none without an episode.
pub fn play(
    scenario: &Arc<Scenario>,
    options: EnvironmentOptions,
    choices: Choices<'_>,
    steps: u32,
) -> Option<u64> {
    let mut environment = Environment::new(scenario.clone(), options).ok()?;
    SCRATCH.with_borrow_mut(|scratch| episode(&mut environment, choices, steps, scratch))
}

/// Plays the episode twice; both must end in the same state.
pub fn play_again(scenario: &Arc<Scenario>, choices: &Choices<'_>, steps: u32) {
    let Ok(mut environment) = Environment::new(scenario.clone(), EnvironmentOptions::default())
    else {
        return;
    };
    SCRATCH.with_borrow_mut(|scratch| {
        let first = episode(&mut environment, choices.clone(), steps, scratch);
        let again = episode(&mut environment, choices.clone(), steps, scratch);
        assert_eq!(first, again, "the same episode ends otherwise");
    });
}

/// The options from the bytes: parameters within their ranges.
pub fn options(scenario: &Scenario, choices: &mut Choices<'_>) -> EnvironmentOptions {
    let mut bindings = Bindings::defaults(&scenario.params);
    for (param, value) in scenario.params.iter().zip(&mut bindings.0) {
        let wanted = choices.between(-1.0, 2.0) * 10.0;
        *value = param.admit(wanted).unwrap_or(*value);
    }
    EnvironmentOptions { bindings: Some(bindings), ..EnvironmentOptions::default() }
}

fn episode(
    environment: &mut Environment,
    mut choices: Choices<'_>,
    steps: u32,
    scratch: &mut Scratch,
) -> Option<u64> {
    let seed = u64::from(choices.byte());
    environment.reset(Some(seed), Some(seed % 7)).ok()?;
    let n_agents = environment.n_agents();
    assert_eq!(environment.agent_ids().len(), n_agents, "one id an agent");
    watch(environment, 0);
    let mut actions = vec![Action::Idle; n_agents];
    for step in 1..=steps {
        if !environment.is_running() {
            break;
        }
        // Mostly the last press continues, so that a player gets somewhere.
        let pressed = usize::from(choices.byte());
        if let Some(action) = actions.get_mut(pressed / 32 % n_agents.max(1)) {
            *action = Action::ALL[pressed % 32 % Action::ALL.len()];
        }
        let stepped = environment.step(&actions, scratch);
        watch(environment, step);
        if stepped.is_err() {
            assert!(!environment.is_running(), "an episode that failed has ended");
            break;
        }
    }
    Some(environment.digest())
}

/// Checks everything visible of an environment.
fn watch(environment: &mut Environment, step: u32) {
    let n_agents = environment.n_agents();
    let declared = environment.observed_names().len();
    let mut vector = vec![f32::NAN; declared];
    for agent in 0..n_agents {
        let mut simple = [f32::NAN; observe::layout::SIMPLE115];
        observe::simple115(environment.state(), agent, &mut simple).expect("an agent's simple115");
        assert!(
            simple.iter().all(|number| number.is_finite()),
            "simple115 of agent {agent}: {simple:?}"
        );
        let raw = observe::raw(environment.state(), agent).expect("an agent's raw observation");
        raw_is_sound(&raw);
        let mask = observe::action_mask(environment.state(), agent).expect("an agent's mask");
        assert!(mask[Action::Idle.index()], "idle may always be chosen");
        if declared > 0 {
            environment
                .observe_vector(agent, &mut vector)
                .expect("an agent's declared observation");
            assert!(
                vector.iter().all(|number| number.is_finite()),
                "observed by agent {agent}: {vector:?}"
            );
        }
        if step % 16 == 0 {
            let mut map = vec![7; observe::smm_size(observe::SMM_WIDTH, observe::SMM_HEIGHT)];
            observe::smm(
                environment.state(),
                agent,
                observe::SMM_WIDTH,
                observe::SMM_HEIGHT,
                &mut map,
            )
            .expect("an agent's map");
            assert!(map.iter().all(|&pixel| pixel == 0 || pixel == 255), "a map of 0 and 255");
        }
        let numbers = environment.terms(agent).iter().chain(environment.term_sums(agent));
        assert!(
            numbers.copied().all(f64::is_finite),
            "agent {agent}'s terms: {:?}",
            environment.terms(agent)
        );
    }
    assert!(
        environment.rewards().iter().all(|paid| paid.is_finite()),
        "rewards: {:?}",
        environment.rewards()
    );
    for (name, value) in environment.records() {
        records_are_sound(name, &value);
    }
    places_are_sound(environment);
}

fn records_are_sound(name: &str, value: &Recorded) {
    match value {
        Recorded::Number(number) => {
            assert!(number.is_none_or(f64::is_finite), "record `{name}`: {number:?}")
        }
        Recorded::PerAgent(each) => each.iter().for_each(|value| records_are_sound(name, value)),
        // A place or a step's value that can't be computed is NaN.
        Recorded::Place(_) | Recorded::Numbers(_) | Recorded::Places(_) => {}
    }
}

fn raw_is_sound(raw: &observe::Raw) {
    let ball = raw.ball.iter().chain(&raw.ball_direction).chain(&raw.ball_rotation);
    assert!(ball.copied().all(f64::is_finite), "the ball of a raw observation: {raw:?}");
    for side in [&raw.left, &raw.right] {
        let places =
            side.places.iter().chain(&side.directions).flatten().chain(&side.tired_factors);
        assert!(places.copied().all(f64::is_finite), "a side of a raw observation: {side:?}");
    }
}

fn places_are_sound(environment: &Environment) {
    let game = environment.state();
    let active: usize = Team::ALL.iter().map(|team| game.team(*team).count()).sum();
    assert!(active <= PLAYERS_MAX, "{active} players");
    let roster = environment.roster().present.iter().filter(|present| **present).count();
    assert!(active <= roster, "{active} of {roster} players are on the pitch");
    let (x, y) = (game.rim() + SLACK_M).into();
    for (id, player) in Team::ALL.iter().flat_map(|team| game.team(*team)) {
        assert!(
            player.pos.x.abs() <= x && player.pos.y.abs() <= y,
            "{id:?} stands at {}",
            player.pos
        );
        assert!(player.vel.is_finite(), "{id:?} runs at {}", player.vel);
    }
    let ball = game.ball;
    assert!(
        ball.vel.is_finite() && ball.spin.is_finite() && ball.pos.length() < BALL_MAX_M,
        "{ball:?}"
    );
    assert!(ball.pos.z > -0.01, "the ball is in the ground: {ball:?}");
    if let Some(owner) = game.owner {
        // A set piece of a team without players still names its first.
        let nobody = game.team(owner.team()).next().is_none();
        assert!(
            game.player(owner).active || nobody,
            "{owner:?} has the ball and is not on the pitch"
        );
    }
}
