//! Slide tackles: the slide itself, and the ball or the legs that it meets.

use crate::football::{contact, foul, noise, report};
use crate::state::event::Events;
use crate::state::play::ticks_since;
use crate::state::player::Pose;
use crate::state::{Match, PlayerId, Squad};
use glam::Vec2;
use setpiece_scenario::vocabulary::{EventKind, Stat};
use std::ops::Range;

/// Ticks of a slide.
const SLIDE_TICKS: u8 = 60;
/// Ticks after which a slide has no force left.
const FORCE_TICKS: u8 = 42;
/// Ticks until the leg is out; before that it brings nobody down. (GRF's.)
const OUT_TICKS: u8 = 11;
/// The ticks of a slide in which the foot can meet the ball. (GRF's.)
const CONTACT_TICKS: Range<u8> = 18..33;
/// Speed at the start of a slide, m/s.
const SLIDE_MPS: f32 = 6.5;
/// How near a sliding foot must come to the ball, metres.
const REACH_M: f32 = 1.0;
/// How near a slide must come to bring a rival down, metres.
const LEGS_M: f32 = 0.45;

/// Whether a player can start a slide: on their feet, without the ball, while play is on.
pub fn may_begin(game: &Match, id: PlayerId) -> bool {
    let waits = game.play.set_piece.is_some() || game.play.hands.is_some();
    game.player(id).is_up() && game.owner != Some(id) && !waits
}

/// Starts a slide tackle in the direction of the run or towards the ball.
pub fn begin(game: &mut Match, events: &mut Events, id: PlayerId, dir: Option<Vec2>) {
    if !may_begin(game, id) {
        return;
    }
    let ball = game.ball.pos.truncate();
    let player = &mut game.players[id.index()];
    let to_ball = ball - player.pos;
    let near = to_ball.length_squared() < 3.0 * 3.0;
    let way = if near { to_ball } else { dir.unwrap_or(player.body.facing) };
    let way = way.normalize_or(player.body.facing);
    player.body.facing = way;
    player.vel = way * SLIDE_MPS.max(player.vel.length().min(7.5));
    player.body.kick = None;
    player.body.strike_pose(Pose::Sliding, SLIDE_TICKS);
    report::did(game, events, EventKind::Slide, id, None);
}

/// Lets every sliding player meet the ball or a rival. `slides`: the players that may be sliding.
pub fn resolve(game: &mut Match, events: &mut Events, slides: Squad) {
    for id in game.order_of(slides) {
        let player = game.player(id);
        if !player.active
            || player.body.pose != Pose::Sliding
            || player.body.pose_ticks < SLIDE_TICKS - FORCE_TICKS
        {
            continue;
        }
        if game.dead || game.play.hands.is_some() {
            return;
        }
        if ticks_since(game.tick, player.body.touched_at) <= 60 {
            continue;
        }
        let gone = SLIDE_TICKS.saturating_sub(player.body.pose_ticks);
        let foot = player.pos + player.body.facing * 0.5;
        let ball = game.ball.pos;
        let reaches = ball.z < 0.5 && foot.distance_squared(ball.truncate()) < REACH_M * REACH_M;
        if CONTACT_TICKS.contains(&gone) && reaches {
            let chance = 0.30 + 0.6 * player.skill(Stat::SlidingTackle);
            if noise::happens(game, chance / f32::from(CONTACT_TICKS.end - CONTACT_TICKS.start)) {
                take(game, events, id);
                continue;
            }
        }
        if gone >= OUT_TICKS {
            meet_legs(game, events, id);
        }
    }
}

/// Lets the sliding foot meet the ball.
fn take(game: &mut Match, events: &mut Events, id: PlayerId) {
    let player = *game.player(id);
    let rival = game.owner.filter(|owner| owner.team() != id.team());
    if rival.is_some() {
        report::did(game, events, EventKind::Tackle, id, rival);
    }
    let aside = noise::bell(game) * 0.3;
    let way = player.body.facing + Vec2::new(-player.body.facing.y, player.body.facing.x) * aside;
    contact::push(game, events, id, way * 6.0 - player.vel * 0.28, 1.0);
    game.play.kicked_by = None;
    if let Some(rival) = rival {
        game.players[rival.index()].body.ready_at = game.tick as i32 + 40;
    }
}

/// Lets the slide meet a rival's legs.
fn meet_legs(game: &mut Match, events: &mut Events, id: PlayerId) {
    let player = *game.player(id);
    let ball = game.ball.pos.truncate();
    let foot = player.pos + player.body.facing * 0.35;
    let hit = game.team(id.team().other()).find_map(|(rival, other)| {
        (other.is_on_feet() && other.pos.distance_squared(foot) < LEGS_M * LEGS_M).then_some((
            rival,
            other.pos,
            other.body.facing,
        ))
    });
    let Some((rival, pos, facing)) = hit else { return };
    game.players[rival.index()].fall(60.0);
    game.players[rival.index()].vel *= 0.5;
    if pos.distance_squared(ball) > 8.0 * 8.0 {
        return;
    }
    // A slide far from the ball, badly timed or from behind is worse; the worst is 2.
    let off = 0.5 * (foot.distance(ball) / 2.0).clamp(0.0, 1.0);
    let late = 0.5 * libm::powf(noise::roll(game), 0.7);
    let behind = 0.5 + 0.5 * facing.dot(player.body.facing);
    let severity = off + late + behind;
    foul::call(game, events, id, rival, severity);
}
