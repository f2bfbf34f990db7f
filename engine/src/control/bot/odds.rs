//! How likely a ball reaches the place that it is played to. (GRF's figures.)

use crate::control::bot::TeamView;
use crate::football::pace::SPRINT_MPS;
use crate::state::player::KickKind;
use crate::state::{Match, PlayerId};
use glam::Vec2;
use setpiece_scenario::vocabulary::{Role, Team};

/// A lofted ball needs at least this distance, metres.
const LOFTED_M: f32 = 10.0;
/// How much further than the receiver a ball into space goes, a share of the way.
const INTO_SPACE: f32 = 0.2;
/// Between these shares of its way nobody reaches a lofted ball. From half of it on, taking it down
/// needs more time, seconds.
const OVERHEAD: std::ops::Range<f32> = 0.2..0.65;
const TAKES_DOWN_S: f32 = 2.5;
/// The extra danger of a lofted ball.
const LOFTED: f32 = 0.4;
/// Opponents within this distance take space away, metres, and this many take all of it.
const SAFE_M: f32 = 5.0;
const CROWD: f32 = 2.5;
/// A generous bound on the error of a distance, metres.
const ROUNDING_M: f32 = 0.01;

/// How much room a team has at a world point after this many seconds, 0..1.
pub fn free_space(game: &Match, team: Team, point: Vec2, seconds: f32) -> f32 {
    let runs_m = SPRINT_MPS * (seconds - 0.2).max(0.0);
    let rivals = game.team(team.other()).filter(|(_, rival)| rival.role != Role::GK);
    let safe_m = runs_m + SAFE_M + ROUNDING_M;
    let crowd = rivals.fold(0.0, |sum, (_, rival)| {
        let way = rival.pos + rival.vel * 0.2 - point;
        let far = way.length_squared() > safe_m * safe_m;
        sum + 1.0 - if far { 1.0 } else { ((way.length() - runs_m).max(0.0) / SAFE_M).min(1.0) }
    });
    1.0 - (crowd / CROWD).min(1.0)
}

/// How likely a pass reaches a teammate, 0..1.
pub fn of_pass(game: &Match, view: &TeamView, id: PlayerId, mate: PlayerId, kind: KickKind) -> f32 {
    let (player, other) = (game.player(id), game.player(mate));
    let distance = other.pos.distance(player.pos);
    if kind == KickKind::High && distance < LOFTED_M {
        return 0.0;
    }
    let mut to = (other.pos + other.vel * (0.7 + 0.03 * distance).min(0.5)) * view.side;
    if kind == KickKind::Long {
        to.x += INTO_SPACE * distance;
    }
    of_way(game, view, id, to, kind, 1.0)
}

/// How likely a ball to a point of the own frame gets there, 0..1. `speed`: how much faster it is
/// than a pass.
pub fn of_way(
    game: &Match,
    view: &TeamView,
    id: PlayerId,
    to: Vec2,
    kind: KickKind,
    speed: f32,
) -> f32 {
    let player = game.player(id);
    let from = (player.pos + player.vel * 0.12) * view.side;
    let way = to - from;
    let length = way.length().max(0.1);
    let lofted = kind == KickKind::High;
    let mut danger = if lofted { LOFTED } else { 0.0 };
    for (_, rival) in game.team(view.team.other()) {
        let place = (rival.pos + rival.vel * 0.2) * view.side - from;
        let along = place.dot(way) / (length * length);
        if !(0.0..=1.2).contains(&along) || lofted && OVERHEAD.contains(&along) {
            continue;
        }
        let rival_s = (place.perp_dot(way).abs() / length + 1.0) / SPRINT_MPS;
        let taken_s = if lofted && along > 0.5 { TAKES_DOWN_S } else { 0.0 };
        let ball_s = (0.7 + length * along.min(1.0) * along * 0.03 + taken_s) / speed;
        danger += (ball_s - rival_s + 0.5).clamp(0.0, 1.0);
        if danger >= 1.0 {
            return 0.0;
        }
    }
    1.0 - danger
}
