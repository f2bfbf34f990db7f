use super::layout::Layout;
use super::*;
use crate::football::begin;
use crate::state::PlayerId;
use crate::testing::scenario;
use glam::{Vec2, Vec3};
use setpiece_scenario::vocabulary::{Action, GameMode, Role, StickyAction, Team};

/// Two against one; agent 0 plays the left striker, agent 1 the right keeper.
fn game() -> Match {
    let scenario = scenario(&[
        (Team::Left, Role::GK, -54.4, 0.0),
        (Team::Left, Role::CF, 27.2, 8.36),
        (Team::Right, Role::GK, 54.4, 0.0),
    ]);
    let bindings = setpiece_scenario::Bindings::default();
    let roster = crate::draw::Roster::new(&scenario, &bindings, None).unwrap();
    let drawn =
        crate::draw::Drawer::new(&scenario).draw(&scenario, &bindings, &roster, 1, 0).unwrap();
    let mut game = begin::blank(&drawn);
    game.agents.clear();
    for (team, player) in [(Team::Left, 1), (Team::Right, 11)] {
        game.agents.push(AgentSlot {
            team,
            player: Some(PlayerId(player)),
            fixed: true,
            sticky: 0,
            steer: None,
            key: None,
        });
    }
    game.players[1].vel = Vec2::new(5.44, -8.36);
    game.ball.pos = Vec3::new(27.2, -8.36, 0.5);
    game.ball.vel = Vec3::new(0.0, 8.36, 2.0);
    game.owner = Some(PlayerId(1));
    game.score = [2, 1];
    game.mode = GameMode::Corner;
    game
}

fn near(found: &[f32], expected: &[f32]) {
    assert_eq!(found.len(), expected.len());
    for (at, (found, expected)) in found.iter().zip(expected).enumerate() {
        assert!((found - expected).abs() < 1e-5, "{at}: {found} for {expected}");
    }
}

#[test]
fn simple115_has_its_blocks() {
    let mut out = [9.0; layout::SIMPLE115];
    simple115v2(&game(), 0, &mut out).unwrap();
    near(&out[0..6], &[-1.0, 0.0, 0.5, 0.1, -1.0, -1.0]);
    near(&out[22..28], &[0.0, 0.0, 0.01, -0.01, -1.0, -1.0]);
    near(&out[44..48], &[1.0, 0.0, -1.0, -1.0]);
    near(&out[66..70], &[0.0, 0.0, -1.0, -1.0]);
    near(&out[88..97], &[0.5, -0.1, 0.5, 0.0, 0.01, 0.2, 0.0, 1.0, 0.0]);
    near(&out[97..100], &[0.0, 1.0, 0.0]);
    near(&out[108..115], &[0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0]);
}

#[test]
fn the_right_team_sees_itself_on_the_left() {
    let mut out = [9.0; layout::SIMPLE115];
    simple115v2(&game(), 1, &mut out).unwrap();
    near(&out[0..4], &[-1.0, 0.0, -1.0, -1.0]);
    near(&out[44..48], &[1.0, 0.0, -0.5, -0.1]);
    near(&out[66..70], &[0.0, 0.0, -0.01, 0.01]);
    near(&out[88..97], &[-0.5, 0.1, 0.5, 0.0, -0.01, 0.2, 0.0, 0.0, 1.0]);
    near(&out[97..100], &[1.0, 0.0, 0.0]);
    let raw = raw(&game(), 1).unwrap();
    assert_eq!(
        (raw.score, raw.ball_owned_team, raw.ball_owned_player, raw.active),
        ([1, 2], 1, 1, 0)
    );
    assert!(out.iter().all(|value| value.to_bits() != (-0.0f32).to_bits()));
}

#[test]
fn who_is_sent_off_is_missing() {
    let mut game = game();
    game.players[1].active = false;
    let mut out = [9.0; layout::SIMPLE115];
    simple115v2(&game, 0, &mut out).unwrap();
    near(&out[0..4], &[-1.0, 0.0, -1.0, -1.0]);
    let raw = raw(&game, 0).unwrap();
    assert_eq!(&raw.left.active[..], [true, false]);
    assert!((raw.left.places[1][0] - 0.5).abs() < 1e-6);
}

#[test]
fn blocks_cover_the_vector_and_bounds_hold() {
    let plain = || {
        let simple = [layout::simple115v2(), layout::simple115v2_sticky(), layout::simple115()];
        simple.into_iter().chain([layout::egocentric(2), layout::egocentric(11)])
    };
    for layout in plain().chain(plain().map(Layout::scaled)) {
        let mut next = 0;
        for block in &layout.blocks {
            assert_eq!(block.start, next);
            assert!(
                block.low.len() == block.high.len() && block.len.is_multiple_of(block.low.len()),
                "{block:?}"
            );
            next += block.len;
        }
        let (low, high) = layout.bounds();
        assert!(next == layout.len() && low.len() == next && high.len() == next);
    }
    assert_eq!((layout::simple115v2().len(), layout::simple115().len()), (115, 115));
    assert_eq!(layout::egocentric(11).len(), egocentric_size(11));
    let (low, high) = layout::simple115v2().bounds();
    let mut game = game();
    game.ball.pos = Vec3::new(1e6, -1e6, 1e6);
    game.ball.vel = Vec3::splat(-1e6);
    let mut out = [0.0; layout::SIMPLE115];
    simple115v2(&game, 0, &mut out).unwrap();
    for (at, value) in out.iter().enumerate() {
        assert!((low[at]..=high[at]).contains(value), "{at}: {value}");
    }
}

#[test]
fn the_map_has_four_planes() {
    let mut out = vec![7; smm_size(SMM_WIDTH, SMM_HEIGHT)];
    smm(&game(), 0, SMM_WIDTH, SMM_HEIGHT, &mut out).unwrap();
    let at = |column: usize, row: usize| &out[(row * SMM_WIDTH + column) * 4..][..4];
    // (0.5, 0.1): column 0.75 * 96, row (0.1 + 4/9) / (8/9) * 72 = 44.1.
    assert_eq!(at(72, 44), [255, 0, 0, 255]);
    assert_eq!(at(72, 27), [0, 0, 255, 0]);
    assert_eq!(at(0, 36), [255, 0, 0, 0]);
    assert_eq!(at(95, 36), [0, 255, 0, 0]);
    assert_eq!(out.iter().map(|byte| usize::from(*byte)).sum::<usize>(), 5 * 255);
    assert!(out.iter().all(|byte| matches!(byte, 0 | 255)));
}

#[test]
fn raw_tells_everything() {
    let mut game = game();
    game.agents[0].sticky = 1 << StickyAction::Sprint.index();
    let raw = raw(&game, 0).unwrap();
    assert_eq!(raw.left.places.len(), 2);
    assert_eq!(raw.right.roles[0], 0);
    assert_eq!(raw.left.roles[1], 9);
    assert_eq!((raw.active, raw.designated, raw.game_mode, raw.steps_left), (1, 1, 4, 50));
    assert_eq!(raw.sticky_actions, [0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0]);
    assert!(
        (raw.ball_direction[1] - 0.01).abs() < 1e-6 && (raw.ball_direction[2] - 0.2).abs() < 1e-6
    );
}

#[test]
fn sizes_and_agents_are_checked() {
    let game = game();
    assert_eq!(
        simple115v2(&game, 0, &mut [0.0; 3]),
        Err(ObserveError::Size { expected: 115, found: 3 })
    );
    assert_eq!(
        simple115v2(&game, 2, &mut [0.0; 115]),
        Err(ObserveError::Agent { agent: 2, n_agents: 2 })
    );
    assert!(smm(&game, 0, 96, 72, &mut [0; 5]).is_err());
    assert!(raw(&game, 5).is_err() && action_mask(&game, 5).is_err());
}

#[test]
fn the_mask_leaves_what_can_matter() {
    let mut game = game();
    game.ball.pos = game.players[1].pos.extend(0.11);
    game.last_touch = game.owner;
    // No kick is heard in the first step of a start.
    assert!(!action_mask(&game, 0).unwrap()[Action::Shot.index()]);
    game.tick = 10;
    game.agents[0].sticky = 1 << StickyAction::Right.index() | 1 << StickyAction::Sprint.index();
    let mask = action_mask(&game, 0).unwrap();
    let open = |action: Action| mask[action.index()];
    assert!(
        open(Action::Idle)
            && open(Action::Left)
            && open(Action::ReleaseDirection)
            && open(Action::Shot)
    );
    assert!(!open(Action::Right) && !open(Action::Sprint) && open(Action::ReleaseSprint));
    assert!(open(Action::Dribble) && !open(Action::ReleaseDribble) && !open(Action::Sliding));
    // The goalkeeper of the other side has no ball to pass.
    let mask = action_mask(&game, 1).unwrap();
    assert!(!mask[Action::ShortPass.index()] && mask[Action::Sliding.index()]);
    game.players[1].active = false;
    assert_eq!(action_mask(&game, 0).unwrap().iter().filter(|open| **open).count(), 1);
}

#[test]
fn simple115_has_no_gaps() {
    let game = game();
    let (mut old, mut new) = ([9.0; layout::SIMPLE115], [9.0; layout::SIMPLE115]);
    simple115(&game, 0, &mut old).unwrap();
    simple115v2(&game, 0, &mut new).unwrap();
    let n = game.squad.of(Team::Left).len();
    let m = game.squad.of(Team::Right).len();
    assert_eq!(old[..2 * n], new[..2 * n]);
    assert_eq!(old[2 * n..4 * n], new[22..22 + 2 * n]);
    assert_eq!(old[4 * n..4 * n + 2 * m], new[44..44 + 2 * m]);
    assert_eq!(old[4 * n + 2 * m..4 * (n + m)], new[66..66 + 2 * m]);
    assert!(old[4 * (n + m)..88].iter().all(|value| *value == -1.0));
    assert_eq!(old[88..], new[88..]);
}

#[test]
fn egocentric_is_seen_from_the_player() {
    let mut game = game();
    let team = 2;
    let mut out = vec![9.0; egocentric_size(team)];
    egocentric(&game, 0, team, &mut out).unwrap();
    let me = game.player(game.agents[0].player.unwrap());
    let ball = (game.ball.pos.truncate() - me.pos) / 54.4;
    near(&out[17..19], &ball.to_array());
    // The nearest teammate is `there`, and where they are.
    let mate = game.team(Team::Left).find(|(id, _)| Some(*id) != game.agents[0].player).unwrap().1;
    let way = (mate.pos - me.pos) / 54.4;
    near(&out[46..49], &[1.0, way.x, way.y]);
    let (low, high) = layout::egocentric(team).bounds();
    let within = |out: &[f32]| {
        out.iter()
            .zip(low.iter().zip(&high))
            .all(|(value, (low, high))| (low..=high).contains(&value))
    };
    assert!(within(&out));
    game.ball.pos = Vec3::new(1e6, -1e6, 1e6);
    game.ball.vel = Vec3::splat(-1e6);
    egocentric(&game, 0, team, &mut out).unwrap();
    assert!(within(&out));
    // The turned match looks the same to the other side's agent.
    let mut other = out.clone();
    egocentric(&game, 1, team, &mut other).unwrap();
    assert_ne!(out, other);
    game.agents[0].player = None;
    egocentric(&game, 0, team, &mut out).unwrap();
    assert!(out.iter().all(|value| *value == 0.0));
    assert_eq!(
        egocentric(&game, 0, team, &mut [0.0; 3]),
        Err(ObserveError::Size { expected: egocentric_size(team), found: 3 })
    );
}

#[test]
fn the_held_keys_stand_behind_simple115v2() {
    let mut game = game();
    game.agents[0].sticky = 1 << StickyAction::TopLeft.index()
        | 1 << StickyAction::Dribble.index()
        | 1 << StickyAction::TeamPressure.index();
    let (mut plain, mut sticky) = ([9.0; layout::SIMPLE115], [9.0; layout::SIMPLE115_STICKY]);
    simple115v2(&game, 0, &mut plain).unwrap();
    simple115v2_sticky(&game, 0, &mut sticky).unwrap();
    assert_eq!(sticky[..115], plain);
    assert_eq!(sticky[115..], [0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]);
    // They are those of GRF's `sticky_actions`, in its order.
    let raw = raw(&game, 0).unwrap();
    assert_eq!(
        sticky[115..],
        std::array::from_fn::<f32, 10, _>(|bit| f32::from(raw.sticky_actions[bit]))
    );
    // Each agent sees its own keys.
    simple115v2_sticky(&game, 1, &mut sticky).unwrap();
    assert_eq!(sticky[115..], [0.0; 10]);
    assert_eq!(
        simple115v2_sticky(&game, 0, &mut [0.0; 115]),
        Err(ObserveError::Size { expected: 125, found: 115 })
    );
}

#[test]
fn scaled_numbers_are_in_metres_and_seconds() {
    let mut game = game();
    game.agents[0].sticky = 1 << StickyAction::Right.index();
    let mut out = [9.0; layout::SIMPLE115_STICKY];
    scaled(&game, 0, Scaled::Simple115v2Sticky, 2, &mut out).unwrap();
    let [length, speed] = [|metres: f32| metres / 50.0, |mps: f32| mps / 10.0];
    near(&out[0..4], &[-54.4, 0.0, 27.2, 8.36].map(length));
    near(&out[22..26], &[0.0, 0.0, 5.44, -8.36].map(speed));
    near(&out[44..46], &[54.4, 0.0].map(length));
    near(
        &out[88..94],
        &[length(27.2), length(-8.36), 0.5 / 10.0, speed(0.0), speed(8.36), speed(2.0)],
    );
    // Flags stay as they are, and a missing player is 0.
    let mut plain = [9.0; layout::SIMPLE115_STICKY];
    simple115v2_sticky(&game, 0, &mut plain).unwrap();
    assert_eq!(out[94..], plain[94..]);
    for missing in [4..22, 26..44, 46..66, 68..88] {
        assert!(out[missing].iter().all(|value| *value == 0.0));
    }
    game.players[1].active = false;
    scaled(&game, 0, Scaled::Simple115v2Sticky, 2, &mut out).unwrap();
    assert_eq!((&out[2..4], &out[24..26]), (&[0.0; 2][..], &[0.0; 2][..]));
    // Without the keys it is the same.
    let mut short = [9.0; layout::SIMPLE115];
    scaled(&game, 0, Scaled::Simple115v2, 2, &mut short).unwrap();
    assert_eq!(short, out[..115]);
}

#[test]
fn scaled_egocentric_has_one_unit_of_length() {
    let game = game();
    for team in [2, 11] {
        let (mut plain, mut out) =
            (vec![9.0; egocentric_size(team)], vec![9.0; egocentric_size(team)]);
        egocentric(&game, 0, team, &mut plain).unwrap();
        scaled(&game, 0, Scaled::Egocentric, team, &mut out).unwrap();
        let factors = layout::egocentric(team).factors();
        let times: Vec<f32> =
            plain.iter().zip(&factors).map(|(value, factor)| value * factor).collect();
        assert_eq!(out, times);
    }
    let (me, ball) = (Vec2::new(27.2, 8.36), Vec2::new(27.2, -8.36));
    let mut out = vec![9.0; egocentric_size(2)];
    scaled(&game, 0, Scaled::Egocentric, 2, &mut out).unwrap();
    near(&out[0..4], &[27.2 / 50.0, 8.36 / 50.0, 0.544, -0.836]);
    near(&out[17..21], &[0.0, (ball - me).y / 50.0, 0.05, (ball - me).length() / 50.0]);
    let mate = Vec2::new(-54.4, 0.0) - me;
    near(&out[46..49], &[1.0, mate.x / 50.0, mate.y / 50.0]);
    near(&out[51..52], &[mate.length() / 50.0]);
}

#[test]
fn scaled_bounds_hold() {
    let mut game = game();
    game.ball.pos = Vec3::new(1e6, -1e6, 1e6);
    game.ball.vel = Vec3::splat(-1e6);
    game.players[1].vel = Vec2::splat(1e6);
    for (of, layout) in [
        (Scaled::Simple115v2, layout::simple115v2()),
        (Scaled::Simple115v2Sticky, layout::simple115v2_sticky()),
        (Scaled::Egocentric, layout::egocentric(2)),
    ] {
        let layout = layout.scaled();
        let (low, high) = layout.bounds();
        let mut out = vec![9.0; layout.len()];
        for agent in [0, 1] {
            scaled(&game, agent, of, 2, &mut out).unwrap();
            for (at, value) in out.iter().enumerate() {
                assert!((low[at]..=high[at]).contains(value), "{at}: {value}");
            }
        }
        assert_eq!(
            scaled(&game, 0, of, 2, &mut [0.0; 3]),
            Err(ObserveError::Size { expected: out.len(), found: 3 })
        );
    }
}

#[test]
fn flags_and_shares_are_never_scaled() {
    for layout in [layout::simple115v2_sticky(), layout::egocentric(11)] {
        for (plain, scaled) in layout.blocks.iter().zip(layout.clone().scaled().blocks) {
            let kept =
                ["one-hot", "flag", "flags", "share", "0 fresh", "flags of `sticky_actions`"];
            if kept.iter().any(|unit| plain.unit.starts_with(unit)) && plain.len != layout::OTHER {
                assert_eq!(
                    (&plain.low, &plain.high, plain.unit),
                    (&scaled.low, &scaled.high, scaled.unit)
                );
            }
            assert!(
                !scaled.unit.contains("54.4") && !scaled.unit.contains("normalised"),
                "{}",
                scaled.unit
            );
        }
    }
}

#[test]
fn what_has_no_units_of_its_own_has_no_scaled_form() {
    assert_eq!((Floats::Simple115.scaled(), Floats::Vector.scaled()), (None, None));
    for scaled in [Scaled::Simple115v2, Scaled::Simple115v2Sticky, Scaled::Egocentric] {
        assert_eq!(scaled.plain().scaled(), Some(Floats::Scaled(scaled)));
        assert_eq!(Floats::Scaled(scaled).scaled(), Some(Floats::Scaled(scaled)));
    }
}
