//! A masked action has no effect, and an unmasked one can have one.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

use setpiece::engine::environment::{Environment, EnvironmentOptions, Scratch};
use setpiece::engine::observe::action_mask;
use setpiece::engine::random::{Purpose, Stream};
use setpiece::engine::state::Match;
use setpiece::engine::state::event::Events;
use setpiece::engine::state::play::Acting;
use setpiece::engine::step;
use setpiece::scenario::vocabulary::{Action, GameMode};

/// A scenario that starts with a set piece, with an agent on each side.
fn starting(set_piece: &str) -> String {
    format!(
        "scenario set_pieces extends academy {{
            start {set_piece}
            agents {{ left: 1, right: 1 }}
            team left {{ GK at own (-1, 0)  CM at (0, 0.3)  CF at (0.4, 0.2) }}
            team right {{ GK at own (-1, 0)  CB at (0.5, 0)  CM at (0.2, 0.2) }}
            remove end out
            remove end possession
            end limit 30 steps
        }}"
    )
}

/// The match after a step in which one agent acts and the others idle, without the record of
/// presses.
fn after(game: &Match, agent: usize, action: Action, scratch: &mut Scratch) -> Match {
    let mut copy = game.clone();
    let actions: Vec<Action> =
        (0..game.agents.len()).map(|i| if i == agent { action } else { Action::Idle }).collect();
    step::hand_over(&mut copy);
    step::play(&mut copy, &actions, &mut Events::new(), scratch);
    for acting in &mut copy.play.acting {
        *acting = Acting::default();
    }
    copy
}

#[test]
fn a_masked_action_changes_nothing_and_an_unmasked_one_can() {
    let mut scratch = Scratch::default();
    let (mut masked, mut modes) = (0u32, [0u32; 7]);
    let (mut open, mut mattered) = ([0u32; Action::FULL_SET], [0u32; Action::FULL_SET]);
    for (name, seed) in [
        ("academy_3_vs_1_with_keeper", 1),
        ("academy_corner", 2),
        ("11_vs_11_stochastic", 3),
        ("11_vs_11_easy_stochastic", 4),
        ("academy_run_to_score_with_keeper", 5),
        ("5_vs_5", 6),
        ("throw_in for choice(left, right) at (uniform(-0.5, 0.5), 0.43)", 7),
        ("goal_kick for choice(left, right)", 8),
    ] {
        let set_piece = name.contains(" for ");
        let loaded = if set_piece {
            setpiece::compile_text(&starting(name), "<test>")
        } else {
            setpiece::load(name)
        };
        let scenario = loaded.unwrap_or_else(|error| panic!("{error}")).scenario;
        let mut environment = Environment::new(scenario, EnvironmentOptions::default()).unwrap();
        environment.reset(Some(seed), None).unwrap();
        let mut stream = Stream::new(seed, 0, Purpose::Agent);
        let mut played = 0;
        while played < 700 {
            if !environment.is_running() {
                environment.reset(None, None).unwrap();
            }
            let agents = environment.n_agents();
            let game: Match = environment.state().clone();
            for agent in 0..agents {
                let mask = action_mask(&game, agent).unwrap();
                let idle = after(&game, agent, Action::Idle, &mut scratch);
                for (action, allowed) in Action::ALL.iter().zip(mask) {
                    let same = after(&game, agent, *action, &mut scratch) == idle;
                    if allowed {
                        open[action.index()] += 1;
                        mattered[action.index()] += u32::from(!same);
                    } else {
                        assert!(
                            same,
                            "{name}, step {}, {:?}: {action:?} is masked",
                            game.step, game.mode
                        );
                        masked += 1;
                    }
                }
            }
            modes[game.mode.index()] += 1;
            let actions: Vec<Action> = (0..agents)
                .map(|_| {
                    let bot = stream.below(3) > 0;
                    let random =
                        Action::from_index(stream.below(Action::FULL_SET as u32) as usize).unwrap();
                    if bot { Action::BuiltinAi } else { random }
                })
                .collect();
            environment.step(&actions, &mut scratch).unwrap();
            played += 1;
        }
    }
    assert!(masked > 10_000);
    assert!(
        modes[GameMode::ThrowIn.index()] > 0 && modes[GameMode::GoalKick.index()] > 0,
        "{modes:?}"
    );
    // Keys that release themselves have nothing to release.
    let nothing = Action::ALL.iter().filter(|action| action.doc().starts_with("nothing"));
    assert!(
        nothing.clone().count() == 6 && nothing.clone().all(|action| open[action.index()] == 0)
    );
    assert!(open[Action::Switch.index()] > 0);
    for action in
        Action::ALL.iter().filter(|action| open[action.index()] > 0 && **action != Action::Idle)
    {
        let (open, mattered) = (open[action.index()], mattered[action.index()]);
        let rarely = *action == Action::BuiltinAi;
        assert!(
            mattered > if rarely { 0 } else { open / 2 },
            "{action:?} was open {open} times and mattered {mattered} times"
        );
    }
}
