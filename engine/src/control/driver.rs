//! An agent's actions become what its player wants.

use crate::control::{assist, sticky};
use crate::event::Events;
use crate::football::body::{Intent, KickKind, KickPlan};
use crate::football::movement::{DRIBBLE_MPS, DRIBBLE_WITH_BALL_MPS, RUN_MPS, RUN_WITH_BALL_MPS, SPRINT_MPS};
use crate::football::{kick, slide, touch};
use crate::state::{Match, PlayerId};
use glam::Vec2;
use setpiece_scenario::vocabulary::{Action, GameMode};

/// Sets the intent and the planned kick of an agent's player.
pub fn drive(game: &mut Match, events: &mut Events, id: PlayerId, held: u16, action: Action) {
    let side = id.team().side() as f32;
    let direction = sticky::direction(held).map(|dir| dir * side);
    let has_ball = game.owner == Some(id) || touch::controller(game) == Some(id);
    let gait = match (sticky::sprints(held), sticky::dribbles(held), has_ball) {
        (true, ..) => SPRINT_MPS,
        (_, true, true) => DRIBBLE_WITH_BALL_MPS,
        (_, true, false) => DRIBBLE_MPS,
        (_, _, true) => RUN_WITH_BALL_MPS,
        _ => RUN_MPS,
    };
    let wish = direction.unwrap_or(Vec2::ZERO) * gait;
    let fetch = has_ball || game.player(id).body.kick.is_some() || assist::ball_is_his(game, id);
    let near = game.player(id).pos.distance_squared(game.ball.pos.truncate()) < kick::KICK_M * kick::KICK_M;
    let body = &mut game.players[id.index()].body;
    if let Some(plan) = body.kick.as_mut().filter(|_| !near) {
        // Until his foot swings the direction is open.
        plan.dir = direction;
    }
    body.dribble = wish;
    body.intent = if fetch {
        Intent::Ball(if has_ball { gait.max(if direction.is_some() { 0.0 } else { RUN_MPS }) } else { SPRINT_MPS })
    } else {
        Intent::Run(wish)
    };
    match action {
        Action::ShortPass => arm(game, id, KickKind::Short, direction),
        Action::LongPass => arm(game, id, KickKind::Long, direction),
        Action::HighPass => arm(game, id, KickKind::High, direction),
        Action::Shot => arm(game, id, KickKind::Shot, direction),
        Action::Sliding if may_slide(game, id) => slide::begin(game, events, id, direction),
        _ => {}
    }
}

/// Arms a kick, where the ball is his side's to play.
fn arm(game: &mut Match, id: PlayerId, kind: KickKind, dir: Option<Vec2>) {
    if !may_arm(game, id, kind) {
        return;
    }
    let now = game.tick as i32;
    let body = &mut game.players[id.index()].body;
    // A second press changes the kick, not its swing.
    let ready_at = body.kick.map_or(now + kick::swing(kind), |plan| plan.ready_at);
    body.kick =
        Some(KickPlan { kind, dir, mate: None, point: None, power: 0.0, ready_at, until: now + kick::PATIENCE_TICKS });
}

/// Whether a kick can be asked for: the ball is his to play, and a throw-in is a pass to a mate.
pub fn may_arm(game: &Match, id: PlayerId, kind: KickKind) -> bool {
    let thrown = game.play.set_piece.is_some_and(|set_piece| set_piece.mode == GameMode::ThrowIn);
    may_play(game, id) && !(thrown && matches!(kind, KickKind::High | KickKind::Shot))
}

/// Whether a slide can be asked for: it is for a ball that the others have or will have first.
pub fn may_slide(game: &Match, id: PlayerId) -> bool {
    slide::may_begin(game, id) && !may_play(game, id)
}

/// Whether the ball is his to play: he has it, or is nearer to it than every rival.
pub fn may_play(game: &Match, id: PlayerId) -> bool {
    if let Some(set_piece) = game.play.set_piece {
        return set_piece.taker == id;
    }
    if game.owner == Some(id) {
        return true;
    }
    let team = id.team();
    if let Some(owner) = touch::controller(game) {
        return owner == id;
    }
    let rival = game.play.chaser[team.other().index()].map_or(9.0, |rival| game.player(rival).body.meet_s);
    game.player(id).body.meet_s <= rival + 0.1 && game.play.hands.is_none()
}
