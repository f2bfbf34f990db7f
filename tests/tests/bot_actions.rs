//! The bot's play is expressed as actions, and pressing them plays about as well as the bot.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

use setpiece::engine::control::sticky;
use setpiece::engine::environment::{Environment, EnvironmentOptions, Scratch};
use setpiece::engine::state::PlayerId;
use setpiece::scenario::{Action, Verdict};
use setpiece_tests::environment as written;

const EPISODES: u64 = 100;
const KICKS: [Action; 4] = [Action::ShortPass, Action::LongPass, Action::HighPass, Action::Shot];

/// Three agents, whose players never change, against two.
const THREE: &str = "scenario s {
    agents { left: [anna, bert, carl] }
    ball at (0.62, 0)
    team left {
        GK at (-1, 0)
        anna: CM at (0.6, 0)
        bert: CM at (0.7, 0.2)
        carl: CM at (0.7, -0.2)
    }
    team right { GK at (1, 0) CB at (0.75, 0) }
    end limit 100 steps
}";

fn environment(name: &str) -> Environment {
    Environment::new(setpiece::load(name).unwrap().scenario, EnvironmentOptions::default()).unwrap()
}

fn all(environment: &Environment, action: Action) -> Vec<Action> {
    vec![action; environment.n_agents()]
}

/// The share of successful episodes if `act` plays the agents.
fn success(name: &str, mut act: impl FnMut(u64, &Environment) -> Vec<Action>) -> f64 {
    let (mut environment, mut scratch) = (environment(name), Scratch::default());
    let mut won = 0;
    for index in 0..EPISODES {
        environment.reset(Some(1), Some(index)).unwrap();
        while environment.is_running() {
            let actions = act(index, &environment);
            environment.step(&actions, &mut scratch).unwrap();
        }
        won += u32::from(
            environment.outcome().and_then(|outcome| outcome.verdict) == Some(Verdict::Success),
        );
    }
    f64::from(won) / EPISODES as f64
}

/// The actions of the bot that plays agent 0, by episode.
fn streams(name: &str) -> Vec<Vec<Action>> {
    let (mut environment, mut scratch) = (environment(name), Scratch::default());
    let mut streams = Vec::new();
    for index in 0..EPISODES {
        environment.reset(Some(1), Some(index)).unwrap();
        let mut stream = Vec::new();
        while environment.is_running() {
            environment.step(&all(&environment, Action::BuiltinAi), &mut scratch).unwrap();
            let player = environment.agents()[0].player.unwrap();
            stream.push(environment.action_of(player).unwrap());
        }
        streams.push(stream);
    }
    streams
}

#[test]
fn what_is_recorded_of_a_bot_scores_as_it_does() {
    for name in ["academy_empty_goal_close", "academy_empty_goal", "academy_run_to_score"] {
        let streams = streams(name);
        let bot = success(name, |_, environment| all(environment, Action::BuiltinAi));
        let replayed = success(name, |index, environment| {
            vec![
                streams[index as usize]
                    .get(environment.steps() as usize)
                    .copied()
                    .unwrap_or(Action::Idle),
            ]
        });
        assert!(replayed > bot - 0.15, "{name}: {replayed}, the bot {bot}");
    }
}

#[test]
fn who_presses_what_the_bot_would_scores_about_as_it_does() {
    for (name, least) in [
        ("academy_empty_goal_close", 0.9),
        // A shot requested by a key leaves later than a bot's, closer to the line.
        ("academy_empty_goal", 0.75),
        ("academy_run_to_score", 0.9),
        // With a keeper it matters that an agent's shots are softer than the bot's, and that its
        // kicks wait for the key.
        ("academy_3_vs_1_with_keeper", 0.2),
    ] {
        let bot = success(name, |_, environment| all(environment, Action::BuiltinAi));
        let asked = success(name, |_, environment| environment.bot_actions().to_vec());
        assert!(asked >= least * bot, "{name}: {asked}, the bot {bot}");
    }
}

#[test]
fn what_the_bot_would_press_is_what_is_recorded_when_it_plays() {
    let (mut environment, mut scratch) = (written(THREE), Scratch::default());
    let (mut kicks, mut compared) = (0, 0);
    for index in 0..60 {
        environment.reset(Some(1), Some(index)).unwrap();
        while environment.is_running() {
            let before = environment.digest();
            let actions = environment.bot_actions();
            assert_eq!(environment.digest(), before, "asking changes nothing");
            assert_eq!(environment.bot_action(1), Some(actions[1]));
            assert_eq!(environment.bot_action(3), None);
            let mut handed = environment.clone();
            handed.step(&all(&environment, Action::BuiltinAi), &mut scratch).unwrap();
            for (slot, action) in handed.agents().iter().zip(&actions) {
                assert_eq!(
                    handed.action_of(slot.player.unwrap()),
                    Some(*action),
                    "step {}",
                    environment.steps()
                );
                assert_eq!(slot.sticky, 0, "handing over releases what is held");
                kicks += u32::from(KICKS.contains(action));
                compared += 1;
            }
            environment.step(&actions, &mut scratch).unwrap();
        }
    }
    assert!(kicks > 10 && compared > 500, "{kicks} of {compared}");
}

#[test]
fn asking_with_behaviors_leaves_them_where_they_are() {
    let text = "behavior run_about() { state n = 0  repeat { n = n + 1  do run(uniform(0deg, 360deg)) for 0.4s } }
        scenario s {
            agents { left: [anna] }
            ball at (0, 0)
            team left { anna: CM at (0, 0.1) { ai: run_about }  CM at (-0.2, 0) { ai: run_about } }
            team right { GK at (1, 0) CB at (0.4, 0) }
            end limit 60 steps
        }";
    let (mut asked, mut unasked, mut scratch) = (written(text), written(text), Scratch::default());
    asked.reset(Some(2), None).unwrap();
    unasked.reset(Some(2), None).unwrap();
    while asked.is_running() {
        let action = asked.bot_action(0);
        asked.step(&[Action::BuiltinAi], &mut scratch).unwrap();
        unasked.step(&[Action::BuiltinAi], &mut scratch).unwrap();
        assert_eq!((asked.action_of(PlayerId(0)), asked.digest()), (action, unasked.digest()));
    }
}

#[test]
fn a_bots_presses_are_a_stream() {
    let (mut environment, mut scratch) = (environment("11_vs_11_stochastic"), Scratch::default());
    environment.reset(Some(1), None).unwrap();
    let mut held = [0u16; 22];
    let mut kicked_at = [-100i32; 22];
    let (mut actions, mut again) = ([0u32; 20], 0);
    for step in 0..1500i32 {
        environment.step(&[Action::BuiltinAi], &mut scratch).unwrap();
        for id in 0..22u8 {
            let Some(action) = environment.action_of(PlayerId(id)) else { continue };
            let i = usize::from(id);
            assert!(!sticky::holds(held[i], action), "{action:?} is pressed once");
            held[i] = sticky::next(held[i], action);
            if KICKS.contains(&action) {
                again += u32::from(step <= kicked_at[i] + 1);
                kicked_at[i] = step;
            }
            actions[action.index()] += 1;
        }
    }
    let kicks: u32 = KICKS.iter().map(|kick| actions[kick.index()]).sum();
    // A key is pressed again at once only if its player has lost the ball and won it back.
    assert!(again * 20 < kicks, "a kick is reported once: {again} of {kicks} again");
    assert!(
        kicks > 20
            && actions[Action::Sprint.index()] > 50
            && actions[Action::BuiltinAi.index()] == 0,
        "{actions:?}"
    );
    assert_eq!(
        actions[Action::Idle.index()..].iter().sum::<u32>(),
        22 * 1500,
        "every player has an action in every step"
    );
}

#[test]
fn nobody_tells_of_the_lazy() {
    let mut environment =
        written(&THREE.replace("CB at (0.75, 0)", "CB at (0.75, 0) { ai: lazy }"));
    environment.reset(Some(1), None).unwrap();
    assert_eq!(environment.action_of(PlayerId(0)), None, "nothing has been played");
    environment.step(&all(&environment, Action::BuiltinAi), &mut Scratch::default()).unwrap();
    assert!(
        environment.action_of(PlayerId(0)).is_some()
            && environment.action_of(PlayerId(11)).is_some()
    );
    assert_eq!(environment.action_of(PlayerId(12)), None);
}
