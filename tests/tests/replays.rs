//! A replay plays the episode again, bit for bit, and reports if it can't.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

use setpiece::engine::control::continuous;
use setpiece::engine::environment::{
    AgentsChoice, Environment, EnvironmentOptions, Scratch, SideChoice,
};
use setpiece::engine::random::{Purpose, Stream};
use setpiece::replay::{Recorder, Replay};
use setpiece::scenario::Action;

fn environment(name: &str) -> Environment {
    let sides = [SideChoice::Count(2), SideChoice::Count(1)];
    let options = EnvironmentOptions {
        agents: Some(AgentsChoice { sides, fixed: None }),
        ..EnvironmentOptions::default()
    };
    Environment::new(setpiece::load(name).unwrap().scenario, options).unwrap()
}

/// Plays an episode with keys and with numbers, and records it.
fn played(name: &str, seed: u64, steps: u32) -> (Environment, Recorder, Vec<u64>) {
    let (mut environment, mut recorder, mut scratch) =
        (environment(name), Recorder::default(), Scratch::default());
    environment.reset(Some(seed), Some(3)).unwrap();
    recorder.begin(None);
    let mut stream = Stream::new(seed, 0, Purpose::Agent);
    let mut digests = vec![environment.digest()];
    while environment.is_running() && environment.steps() < steps {
        let mut actions = Vec::new();
        for agent in 0..environment.n_agents() {
            let mut number = || stream.below(2001) as f32 / 1000.0 - 1.0;
            let numbers = [number(), number(), number(), number().abs()];
            let (steer, action) = continuous::decode(numbers).unwrap();
            let steer = (agent == 1).then_some(steer);
            environment.steer(agent, steer);
            let key = Action::from_index(stream.below(Action::FULL_SET as u32) as usize).unwrap();
            let action = if agent == 1 { action } else { key };
            recorder.note(action, steer);
            actions.push(action);
        }
        environment.step(&actions, &mut scratch).unwrap();
        digests.push(environment.digest());
    }
    (environment, recorder, digests)
}

#[test]
fn an_episode_is_played_again_bit_for_bit() {
    for (name, seed) in
        [("academy_3_vs_1_with_keeper", 1), ("11_vs_11_stochastic", 2), ("academy_corner", 3)]
    {
        let (environment, recorder, digests) = played(name, seed, 300);
        let bytes = Replay::of(&environment, &recorder).unwrap().to_bytes().unwrap();
        let mut again = Vec::new();
        let replay = Replay::from_bytes(&bytes).unwrap();
        let end = replay.play(|environment, _| again.push(environment.digest())).unwrap();
        assert_eq!(again, digests, "{name}");
        assert_eq!((end.score(), end.steps()), (environment.score(), environment.steps()));
        assert_eq!(end.term_sums(0), environment.term_sums(0));
        assert!(bytes.len() < 40_000, "{name}: {} bytes", bytes.len());
    }
}

#[test]
fn one_that_begins_in_a_snapshot_begins_there_again() {
    let (mut past, ..) = played("11_vs_11_stochastic", 5, 40);
    let snapshot = past.snapshot().unwrap();
    past.reset_from(&snapshot, Some(9), Some(0)).unwrap();
    let mut recorder = Recorder::default();
    recorder.begin(Some(&snapshot));
    let mut scratch = Scratch::default();
    for _ in 0..20 {
        (0..3).for_each(|_| recorder.note(Action::BuiltinAi, None));
        past.step(&[Action::BuiltinAi; 3], &mut scratch).unwrap();
    }
    let replay = Replay::of(&past, &recorder).unwrap();
    assert_eq!(replay.play(|_, _| ()).unwrap().digest(), past.digest());
}

#[test]
fn what_is_no_replay_is_reported() {
    let (environment, recorder, _) = played("academy_3_vs_1_with_keeper", 1, 20);
    let replay = Replay::of(&environment, &recorder).unwrap();
    let bytes = replay.to_bytes().unwrap();
    let refused = |bytes: &[u8]| Replay::from_bytes(bytes).unwrap_err().to_string();
    assert_eq!(refused(b"{}"), "not a replay: its header isn't recognised");
    for cut in 0..bytes.len() {
        assert!(Replay::from_bytes(&bytes[..cut]).is_err(), "cut at {cut}");
    }
    for at in 0..bytes.len() {
        let mut changed = bytes.clone();
        changed[at] ^= 0x41;
        assert!(Replay::from_bytes(&changed).is_err(), "changed at {at}");
    }
    let mut other = replay.clone();
    other.digest ^= 1;
    let why = other.play(|_, _| ()).unwrap_err().to_string();
    assert_eq!(why, format!("step {}: this build diverges from the recording", replay.length));
    assert!(Replay::of(&environment, &Recorder::default()).is_err(), "what was not recorded");
}
