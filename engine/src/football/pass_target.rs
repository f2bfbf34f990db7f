//! Which teammate a pass is for, and the point that it is played to.

use crate::math;
use crate::state::player::{KickKind, KickPlan};
use crate::state::{Match, Player, PlayerId};
use glam::Vec2;

/// Where a pass goes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PassTarget {
    /// The receiver.
    pub mate: Option<PlayerId>,
    /// The point it is played to.
    pub point: Vec2,
}

/// How far ahead a held direction looks for a teammate, metres; a longer key press looks further.
/// (GRF's.)
fn look_ahead_m(plan: &KickPlan) -> f32 {
    let steep = match plan.kind {
        KickKind::Long => 0.65,
        KickKind::High => 0.55,
        _ => 0.7,
    };
    60.0 * libm::powf(plan.gauge(), steep).clamp(1.0 / 60.0, 1.0)
}

/// Where a player will be when a pass over this distance arrives.
pub fn lead(mate: &Player, distance_m: f32) -> Vec2 {
    let time = (0.3 + 0.05 * distance_m).clamp(0.0, 1.0);
    mate.pos + mate.vel * (0.7 * libm::powf(time, 0.7))
}

/// Chooses the receiver by GRF's rule (near the input's target point, and in its direction), or
/// takes the bot's choice.
pub fn choose(game: &Match, id: PlayerId, plan: &KickPlan) -> PassTarget {
    let player = game.player(id);
    let side = id.team().side() as f32;
    let mate = plan
        .mate
        .filter(|mate| game.player(*mate).active)
        .or_else(|| if plan.point.is_some() { None } else { best_mate(game, id, plan) });
    let point = match (plan.point, mate) {
        (Some(point), _) => point,
        (None, Some(mate)) => {
            let distance = game.player(mate).pos.distance(player.pos);
            let target = lead(game.player(mate), distance);
            if plan.kind == KickKind::Long {
                target + Vec2::new(0.2 * distance * side, 0.0)
            } else {
                target
            }
        }
        (None, None) => player.pos + plan.dir.unwrap_or(player.body.facing) * 25.0,
    };
    PassTarget { mate: mate.or_else(|| nearest_mate(game, id, point)), point }
}

/// The teammate that the input means.
fn best_mate(game: &Match, id: PlayerId, plan: &KickPlan) -> Option<PlayerId> {
    let player = game.player(id);
    let input = plan.dir.unwrap_or(player.body.facing);
    let from = player.pos + player.vel.normalize_or_zero() * 0.2;
    let look = from + input * look_ahead_m(plan);
    let mut best: Option<(f32, PlayerId)> = None;
    for (mate, other) in game.team(id.team()) {
        if mate == id {
            continue;
        }
        let target = lead(other, other.pos.distance(player.pos));
        let share = (target.distance(look) / 70.0).clamp(0.0, 1.0);
        // Neither the power nor the angle can lower this bound.
        if best.is_some_and(|(least, _)| 0.8 * share >= least) {
            continue;
        }
        let far = libm::powf(share, 0.8);
        if best.is_some_and(|(least, _)| 0.8 * far >= least) {
            continue;
        }
        let way = (target - from).normalize_or_zero();
        let angle = math::acos(way.dot(input).clamp(-1.0, 1.0));
        let rating = 0.8 * far + angle / std::f32::consts::PI;
        if best.is_none_or(|(least, _)| rating < least) {
            best = Some((rating, mate));
        }
    }
    best.map(|(_, mate)| mate)
}

/// The teammate nearest to a point.
fn nearest_mate(game: &Match, id: PlayerId, point: Vec2) -> Option<PlayerId> {
    let mut best: Option<(f32, PlayerId)> = None;
    for (mate, other) in game.team(id.team()) {
        let distance = other.pos.distance_squared(point);
        if mate != id && distance < 20.0 * 20.0 && best.is_none_or(|(least, _)| distance < least) {
            best = Some((distance, mate));
        }
    }
    best.map(|(_, mate)| mate)
}
