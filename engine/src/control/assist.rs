//! GRF's magnet: a controlled player runs to a ball that is theirs, whatever direction is held.
//! Scripted players without an agent do exactly what their script says.

use crate::football::pace::SPRINT_MPS;
use crate::math;
use crate::state::{Match, PlayerId};
use glam::Vec2;
use setpiece_scenario::vocabulary::Rule;
use std::f32::consts::{FRAC_PI_2, PI};

/// A player whose lead over the rivals' time to the ball is less than this share takes the soonest
/// meeting with it. (GRF's.)
const HASTE: f32 = 1.1;
/// Added to both times before they are compared, seconds. (GRF's.)
const ADDED_S: f32 = 0.2;
/// The soonest meeting must take at least this share of a meeting's time. (GRF's.)
const SOONEST: f32 = 0.35;
/// Higher balls are not met, metres. (GRF's.)
const HIGH_M: f32 = 1.0;
/// Speed (m/s) per metre of distance to a place. (GRF's.)
const PER_S: f32 = 2.6;
/// The number of distinct angles to the ball's path in a full turn. (GRF's.)
const ANGLES: f32 = 16.0;
/// A meeting this soon is the touch itself, seconds; chosen.
const TOUCH_S: f32 = 0.25;
/// How long a player's own movement continues, seconds; how near the ball must come to be played,
/// metres; and the share of their top speed that they reach. The same as wherever a meeting is
/// computed.
const CARRIED_S: f32 = 0.12;
const REACH_M: f32 = 0.45;
const PACE: f32 = 0.94;

/// Whether the ball is the player's to get: they are their team's nearest, and no rival has it or
/// reaches it much sooner.
pub fn ball_is_theirs(game: &Match, id: PlayerId) -> bool {
    let controlled = game.agents.iter().any(|slot| slot.player == Some(id));
    if !controlled
        || !game.rule(Rule::Assist)
        || game.play.set_piece.is_some()
        || game.play.hands.is_some()
    {
        return false;
    }
    let team = id.team();
    let receiver = game.play.pass.is_some_and(|pass| pass.to == Some(id));
    if game.play.chaser[team.index()] != Some(id) && !receiver {
        return false;
    }
    if game.controller().is_some_and(|owner| owner != id) {
        return false;
    }
    let rival =
        game.play.chaser[team.other().index()].map_or(9.0, |rival| game.player(rival).body.meet_s);
    receiver || game.player(id).body.meet_s < rival + 0.2
}

/// Where a player with time to spare meets an approaching ball, and how fast they go there, m/s.
/// None if there is no time to spare, or if the ball is already there. (GRF's.)
///
/// Of all meetings it takes the one most like the held direction, with a slight preference for the
/// one nearest to the ball's path. Whoever is about to kick takes the soonest.
pub fn meeting(game: &Match, id: PlayerId, wish: Vec2) -> Option<(Vec2, f32)> {
    let player = game.player(id);
    let rival = game.play.chaser[id.team().other().index()]
        .map_or(9.0, |rival| game.player(rival).body.meet_s);
    let soonest_s = player.body.meet_s;
    let kicks = player.body.kick.is_some();
    let spare = kicks || rival + ADDED_S >= HASTE * (soonest_s + ADDED_S);
    if soonest_s < TOUCH_S || !spare {
        return None;
    }
    let ball = game.ball.pos.truncate();
    let way = (game.play.forecast.at(game.tick + 100).truncate() - ball).try_normalize()?;
    let ahead = turned_to(wish.normalize_or(player.body.facing), -way);
    let wanted = ahead * wish.length();
    let along = (player.pos - ball).dot(way);
    let nearest = ball + way * along;
    let comes = {
        let at = |seconds: f32| {
            game.play.forecast.at(game.tick.saturating_add((100.0 * seconds) as u32)).truncate()
        };
        (at(soonest_s + 0.1) - at(soonest_s)).normalize_or(ahead)
    };
    let top = PACE * player.body.speed_top_mps;
    let from = player.pos + player.vel * CARRIED_S;
    let mut best: Option<(f32, Vec2, f32)> = None;
    for (time_s, point) in
        game.play.forecast.from(game.tick).filter(|(time_s, _)| *time_s >= soonest_s)
    {
        let place = point.truncate();
        let out = crate::physics::left_pitch(&game.pitch, point).is_some();
        if !out && point.z >= HIGH_M {
            continue;
        }
        let needs_s = ((place.distance(from) - REACH_M) / top).max(0.0) + CARRIED_S;
        if out || needs_s > time_s {
            if out {
                break;
            }
            continue;
        }
        let to = place - player.pos;
        let run = to.normalize_or_zero() * (to.length() * PER_S).min(SPRINT_MPS);
        let alike = 1.0 - (wanted.distance(run) / SPRINT_MPS).min(1.0);
        let turn = math::atan2(ahead.perp_dot(run), ahead.dot(run)).abs();
        let straight = 1.0 - (turn / FRAC_PI_2).min(1.0);
        let near = 1.0 - (nearest.distance(place) / (2.0 * SPRINT_MPS)).min(1.0);
        let rating = 0.4 * alike + 0.6 * straight + 0.1 * near;
        if best.is_none_or(|(least, ..)| rating > least) {
            best = Some((
                rating,
                place,
                (needs_s / time_s.max(0.05)).min(1.0) * player.body.speed_top_mps,
            ));
        }
        // Later meetings run after the ball, or keep it waiting.
        if kicks || to.dot(comes) > 0.0 || soonest_s < SOONEST * time_s {
            break;
        }
    }
    best.map(|(_, place, pace)| (place, pace))
}

/// Rounds a direction to the nearest of the distinct angles relative to another.
fn turned_to(direction: Vec2, other: Vec2) -> Vec2 {
    let angle = math::atan2(other.perp_dot(direction), other.dot(direction));
    math::unit((angle * (ANGLES / (2.0 * PI))).round() * (2.0 * PI / ANGLES)).rotate(other)
}
