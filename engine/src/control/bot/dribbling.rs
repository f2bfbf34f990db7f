//! Where a player runs with the ball: opponents and lines repel, the goal attracts. (GRF's
//! figures, in proportion to the pitch.)

use crate::control::bot::TeamView;
use crate::control::bot::formation::mindset;
use crate::control::bot::off_ball;
use crate::control::bot::support::Forces;
use crate::math;
use crate::state::{Match, PlayerId};
use glam::Vec2;

/// Positions are predicted this far ahead, seconds.
const AHEAD_S: f32 = 0.25;
/// How many opponents repel, how strongly, and from how far, metres.
const RIVALS: usize = 5;
const RIVAL: (f32, f32) = (2.0, 10.0);
/// How strongly lines repel and from how far, how far outside they count as lying, metres, and how
/// that fades, eighths.
const LINE: (f32, f64) = (4.0, 20.0);
const LINE_OUT_M: f64 = 5.0;
const LINE_FADES: u32 = 6;
/// The goal's y as a share of the player's, so that it attracts only partly towards the middle.
const TO_MIDDLE: f32 = 0.28;
/// Running speed for a force of one, m/s.
const FORCE_MPS: f32 = 20.8;

/// The velocity that a player wants with the ball, world m/s. `shy`: how much opponents count.
pub fn way(game: &Match, view: &TeamView, id: PlayerId, shy: f32) -> Vec2 {
    let player = game.player(id);
    let own = player.pos * view.side;
    let pitch = &game.pitch;
    let mut forces = Forces::at(own + player.vel * view.side * AHEAD_S);
    let scale = pitch.scale() as f32;
    for rival in view.board.nearest::<RIVALS>(view.team.other(), player.pos, None) {
        let rival = game.player(rival);
        forces.push::<8>(
            (rival.pos + rival.vel * AHEAD_S) * view.side,
            RIVAL.0 * shy,
            RIVAL.1 * scale,
        );
    }
    let half = game.half();
    let along = |usual_m: f64| pitch.along(usual_m) as f32;
    let across = |usual_m: f64| pitch.across(usual_m) as f32;
    let side_line = Vec2::new(own.x, math::sign_or(own.y, 1.0) * (half.y + across(LINE_OUT_M)));
    let goal_line = Vec2::new(math::sign_or(own.x, 1.0) * (half.x + along(LINE_OUT_M)), own.y);
    forces.push::<LINE_FADES>(side_line, LINE.0, across(LINE.1));
    forces.push::<LINE_FADES>(goal_line, LINE.0, along(LINE.1));
    let near = (own.x.abs() / half.x).min(1.0);
    let goal = Vec2::new(half.x, own.y * TO_MIDDLE * 0.5 * (1.0 - near * near));
    let mind = mindset(game.player(player.body.mind.fills).role);
    forces.draw(goal, 0.725 + 0.05 * mind, 1.0);
    let force = forces.mean();
    force.normalize_or_zero() * (view.side * off_ball::pace(force.length() * FORCE_MPS))
}
