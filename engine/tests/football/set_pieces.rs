//! Set pieces compared with those of Google Research Football: who stands where, and how long they
//! take.

use crate::Bench;
use crate::layouts::{Layout, drawn};
use glam::Vec2;
use setpiece_engine::football::restart::place;
use setpiece_engine::football::switching;
use setpiece_engine::state::PlayerId;
use setpiece_engine::state::play::Restart;
use setpiece_engine::state::player::KickKind;
use setpiece_scenario::Ai;
use setpiece_scenario::vocabulary::{Action, GameMode, Rule, Team};

type Eleven = [(f32, f32); 11];

/// A set piece of the right team as measured, metres: the ball, the left team and the right team by
/// number.
struct Measured {
    mode: GameMode,
    ball: (f32, f32),
    left: Eleven,
    right: Eleven,
}

const MEASURED: [Measured; 5] = [
    Measured {
        mode: GameMode::GoalKick,
        ball: (50.6, 0.0),
        left: [
            (-53.9, 0.0),
            (-18.4, -19.4),
            (-22.0, -6.3),
            (-22.0, 6.3),
            (-18.4, 19.4),
            (-7.5, -10.5),
            (-11.5, 0.0),
            (-7.5, 10.5),
            (-3.3, -21.4),
            (5.5, 0.0),
            (-3.3, 21.4),
        ],
        right: [
            (52.8, 0.0),
            (22.5, 19.4),
            (27.5, 6.3),
            (27.5, -6.3),
            (22.5, -19.4),
            (7.2, 10.5),
            (12.6, 0.0),
            (7.2, -10.5),
            (1.3, 21.4),
            (-10.8, 0.0),
            (1.3, -21.4),
        ],
    },
    Measured {
        mode: GameMode::ThrowIn,
        ball: (-4.1, -36.0),
        left: [
            (-53.9, 0.0),
            (-18.7, -32.6),
            (-26.2, -23.3),
            (-28.7, -10.4),
            (-25.6, 7.1),
            (-7.7, -28.8),
            (-12.8, -19.8),
            (-10.2, -8.3),
            (-4.7, -34.3),
            (4.7, -19.5),
            (-5.8, 8.1),
        ],
        right: [
            (53.9, 0.0),
            (12.8, 7.0),
            (18.7, -11.6),
            (16.4, -24.9),
            (7.2, -33.7),
            (-3.6, -9.3),
            (-0.5, -21.2),
            (-3.8, -30.0),
            (-7.7, 8.3),
            (-14.9, -20.2),
            (-4.2, -36.3),
        ],
    },
    Measured {
        mode: GameMode::FreeKick,
        ball: (4.1, 27.4),
        left: [
            (-53.9, 0.0),
            (-29.2, -17.0),
            (-34.1, -4.5),
            (-33.0, 6.6),
            (-26.3, 18.0),
            (-16.5, -6.7),
            (-18.9, 2.5),
            (-14.3, 11.5),
            (-14.2, -17.9),
            (-4.9, 4.3),
            (-10.2, 20.6),
        ],
        right: [
            (53.9, 0.0),
            (6.4, 27.4),
            (9.8, 10.1),
            (10.3, -0.3),
            (4.6, -13.7),
            (-3.9, 13.3),
            (-1.9, 6.0),
            (-5.4, -4.1),
            (-7.3, 20.1),
            (-24.0, 3.2),
            (-10.2, -16.9),
        ],
    },
    Measured {
        mode: GameMode::Corner,
        ball: (-55.0, 36.0),
        left: [
            (-53.9, 0.0),
            (-51.7, -7.0),
            (-52.1, 0.2),
            (-52.2, 4.2),
            (-51.9, 9.1),
            (-51.8, -1.8),
            (-52.2, 2.4),
            (-52.0, 5.5),
            (-50.3, -9.3),
            (-39.4, 1.6),
            (-50.8, 10.9),
        ],
        right: [
            (53.9, 0.0),
            (-29.4, 13.4),
            (-19.3, 4.9),
            (-18.9, -3.5),
            (-28.3, -12.7),
            (-50.2, 6.0),
            (-48.6, 1.8),
            (-49.5, -2.8),
            (-56.9, 37.3),
            (-51.4, 2.1),
            (-48.6, -9.7),
        ],
    },
    Measured {
        mode: GameMode::Penalty,
        ball: (-44.0, 0.0),
        left: [
            (-53.9, 0.0),
            (-38.0, -19.4),
            (-37.1, -6.8),
            (-37.1, 6.8),
            (-38.0, 19.4),
            (-38.0, -10.1),
            (-34.3, 0.0),
            (-38.0, 10.1),
            (-38.0, -21.6),
            (-31.2, 0.0),
            (-38.0, 21.6),
        ],
        right: [
            (53.9, 0.0),
            (-8.8, 20.0),
            (2.5, 6.2),
            (2.5, -6.2),
            (-8.8, -20.0),
            (-34.7, 10.5),
            (-27.7, 0.0),
            (-34.7, -10.5),
            (-38.0, 22.3),
            (-41.0, 0.0),
            (-38.0, -22.3),
        ],
    },
];

/// A match in which a set piece has just been awarded.
fn awarded(mode: GameMode, team: Team, spot: Vec2) -> Bench {
    let mut bench = Bench::new(Layout::Eleven, 0);
    place(&mut bench.game, Restart { mode, team, spot });
    bench
}

#[test]
fn everybody_stands_where_they_were_measured() {
    for Measured { mode, ball, left, right } in &MEASURED {
        // The right team's, and the left team's by turning the pitch.
        for (team, turn) in [(Team::Right, 1.0), (Team::Left, -1.0)] {
            let bench = awarded(*mode, team, Vec2::from(*ball) * turn);
            let (left, right) = if team == Team::Right { (left, right) } else { (right, left) };
            let mut far = 0.0;
            for (i, place) in left.iter().chain(right).enumerate() {
                let away = bench.game.players[i].pos.distance(Vec2::from(*place) * turn);
                assert!(
                    away < 0.9,
                    "{mode} of {team}: {i} stands {away} m away, at {}",
                    bench.game.players[i].pos
                );
                far += away / 22.0;
            }
            assert!(far < 0.2, "{mode} of {team}: {far} m away on average");
        }
    }
}

/// The steps that show the set piece's mode.
fn shown(mode: GameMode, team: Team, spot: Vec2, mut action: impl FnMut(usize) -> Action) -> usize {
    let mut bench = awarded(mode, team, spot);
    (1..60)
        .find(|step| {
            bench.step(action(*step));
            bench.game.mode == GameMode::Normal
        })
        .unwrap_or(60)
}

const SPOTS: [(GameMode, Vec2); 5] = [
    (GameMode::GoalKick, Vec2::new(-50.6, 0.0)),
    (GameMode::Corner, Vec2::new(55.0, 36.0)),
    (GameMode::FreeKick, Vec2::new(4.0, 10.0)),
    (GameMode::Penalty, Vec2::new(44.0, 0.0)),
    (GameMode::ThrowIn, Vec2::new(5.0, 36.0)),
];

#[test]
fn a_bots_run_up_takes_as_long_as_measured() {
    for (mode, spot) in SPOTS {
        let measured = match mode {
            GameMode::ThrowIn => 3,
            GameMode::Penalty => 7,
            _ => 6,
        };
        for (team, turn) in [(Team::Left, 1.0), (Team::Right, -1.0)] {
            let steps = shown(mode, team, spot * turn, |_| Action::BuiltinAi);
            assert_eq!(steps, measured, "{mode}: the bot of {team}");
        }
    }
}

#[test]
fn an_agents_run_up_takes_as_long_as_measured() {
    let keys = [Action::ShortPass, Action::HighPass, Action::Shot];
    for (mode, spot) in SPOTS {
        let throw = mode == GameMode::ThrowIn;
        for key in keys {
            // A throw-in is a short pass, whatever key is pressed.
            let heard = !throw || key == Action::ShortPass;
            let once = |at: usize| move |step: usize| if step == at { key } else { Action::Idle };
            // A penalty's run-up is a step longer.
            let longer = usize::from(mode == GameMode::Penalty);
            let stalled = if throw { 23 } else { 26 + longer };
            let run_up = match mode {
                GameMode::ThrowIn => 4,
                GameMode::Penalty => 8,
                _ => 7,
            };
            let after = |waited: usize| if heard { waited + run_up } else { stalled };
            assert_eq!(
                shown(mode, Team::Left, spot, once(1)),
                after(0),
                "{mode}: {key:?} pressed at once"
            );
            assert_eq!(
                shown(mode, Team::Left, spot, once(6)),
                after(5),
                "{mode}: {key:?} pressed late"
            );
            let held = match key {
                Action::ShortPass if throw => 8,
                Action::HighPass if !throw => 11 + longer,
                // The short pass that is pressed for them releases the key.
                Action::Shot if !throw => 25 + longer,
                _ => stalled,
            };
            assert_eq!(shown(mode, Team::Left, spot, |_| key), held, "{mode}: {key:?} held");
        }
        let stalled = if throw { 23 } else { 26 + usize::from(mode == GameMode::Penalty) };
        assert_eq!(
            shown(mode, Team::Left, spot, |_| Action::Idle),
            stalled,
            "{mode}: nothing pressed"
        );
    }
}

#[test]
fn nobody_takes_a_set_piece_by_walking() {
    for (mode, spot) in SPOTS {
        let mut bench = awarded(mode, Team::Left, spot);
        let taker = bench.game.owner.unwrap();
        bench.game.agents[0].player = Some(taker);
        let before = bench.game.player(taker).pos;
        for action in [Action::Right, Action::Sprint, Action::Bottom, Action::Idle] {
            bench.step(action);
        }
        assert!(before.distance(bench.game.player(taker).pos) < 0.05, "{mode}");
        assert_eq!(bench.game.mode, mode);
    }
}

#[test]
fn the_lazy_never_take_a_set_piece_without_anti_stalling() {
    for stalling in [1.0, 0.0] {
        let mut start = drawn(Layout::Eleven, 0);
        start.rules[Rule::AntiStalling.index()] = stalling;
        for player in start.players.iter_mut().skip(11).flatten() {
            player.ai = Ai::Lazy;
        }
        let mut bench = Bench::of(&start);
        place(
            &mut bench.game,
            Restart { mode: GameMode::Penalty, team: Team::Right, spot: Vec2::new(-44.0, 0.0) },
        );
        for _ in 0..60 {
            bench.step(Action::Idle);
        }
        assert_eq!(bench.game.mode == GameMode::Penalty, stalling == 0.0);
    }
}

#[test]
fn after_a_restart_an_agent_plays_whoever_is_nearest_to_the_ball() {
    let bench = awarded(GameMode::GoalKick, Team::Left, Vec2::new(-50.6, 0.0));
    assert_eq!(bench.game.agents[0].player, Some(PlayerId(0)), "the keeper takes it");
    let bench = awarded(GameMode::Corner, Team::Right, Vec2::new(-55.0, 36.0));
    assert_eq!(bench.game.agents[0].player, Some(PlayerId(10)));
    let mut bench = awarded(GameMode::Penalty, Team::Right, Vec2::new(-44.0, 0.0));
    for number in 1..11 {
        bench.game.players[number].pos.x = 20.0;
    }
    switching::reassign(&mut bench.game);
    assert_eq!(bench.game.agents[0].player, Some(PlayerId(0)), "keepers too");
}

#[test]
fn a_key_that_has_been_down_since_before_takes_no_set_piece_but_it_is_taken_in_time() {
    for mode in [GameMode::ThrowIn, GameMode::FreeKick, GameMode::GoalKick] {
        let mut bench = awarded(mode, Team::Left, Vec2::new(-20.0, 30.0));
        bench.game.agents[0].key = Some(KickKind::Short);
        let taken = (1..60).find(|_| {
            bench.step(Action::ShortPass);
            bench.game.mode == GameMode::Normal
        });
        assert!(taken.is_some_and(|step| (5..40).contains(&step)), "{mode}: {taken:?}");
    }
}
