//! An agent's actions become what its player wants.

use crate::control::{assist, sticky};
use crate::event::Events;
use crate::football::body::{Intent, KickKind, KickPlan};
use crate::football::movement::{DRIBBLE_MPS, DRIBBLE_WITH_BALL_MPS, RUN_MPS, RUN_WITH_BALL_MPS, SPRINT_MPS};
use crate::football::{kick, slide, touch};
use crate::state::{Match, PlayerId, Steer};
use glam::Vec2;
use setpiece_scenario::vocabulary::{Action, GameMode};

/// A slower pace than this is standing, share of a sprint; chosen.
const STILL: f32 = 0.1;

/// What an agent holds.
#[derive(Clone, Copy, Debug)]
pub struct Held {
    /// Held keys.
    pub sticky: u16,
    /// A steered direction in the place of a held one.
    pub steer: Option<Steer>,
}

impl Held {
    /// The world direction, if one is held, and how fast it is run in, m/s.
    fn run(self, side: f32, has_ball: bool) -> (Option<Vec2>, f32) {
        if let Some(steer) = self.steer {
            let pace = steer.way.length();
            let direction = (pace > STILL).then(|| steer.way * (side / pace));
            return (direction, pace.min(1.0) * SPRINT_MPS);
        }
        let gait = match (sticky::sprints(self.sticky), sticky::dribbles(self.sticky), has_ball) {
            (true, ..) => SPRINT_MPS,
            (_, true, true) => DRIBBLE_WITH_BALL_MPS,
            (_, true, false) => DRIBBLE_MPS,
            (_, _, true) => RUN_WITH_BALL_MPS,
            _ => RUN_MPS,
        };
        (sticky::direction(self.sticky).map(|dir| dir * side), gait)
    }
}

/// Sets the intent and the planned kick of an agent's player.
pub fn drive(game: &mut Match, events: &mut Events, id: PlayerId, held: Held, action: Action) {
    let has_ball = game.owner == Some(id) || touch::controller(game) == Some(id);
    let (direction, gait) = held.run(id.team().side() as f32, has_ball);
    let chases = sticky::presses(held.sticky) && !may_play(game, id);
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
    } else if chases {
        Intent::Ball(SPRINT_MPS)
    } else {
        Intent::Run(wish)
    };
    let power = held.steer.map_or(0.0, |steer| steer.power);
    match action {
        Action::ShortPass => arm(game, id, KickKind::Short, direction, power),
        Action::LongPass => arm(game, id, KickKind::Long, direction, power),
        Action::HighPass => arm(game, id, KickKind::High, direction, power),
        Action::Shot => arm(game, id, KickKind::Shot, direction, power),
        Action::Sliding if may_slide(game, id) => slide::begin(game, events, id, direction),
        _ => {}
    }
}

/// Arms a kick, where the ball is his side's to play.
///
/// A steered pass of some power goes to a point, so far along its direction; any other finds a mate.
fn arm(game: &mut Match, id: PlayerId, kind: KickKind, dir: Option<Vec2>, power: f32) {
    if !may_arm(game, id, kind) {
        return;
    }
    let now = game.tick as i32;
    let from = game.player(id).pos;
    let point = dir.filter(|_| power > 0.0 && kind != KickKind::Shot).map(|dir| from + dir * (power * reach_m(kind)));
    let body = &mut game.players[id.index()].body;
    // A second press changes the kick, not its swing.
    let ready_at = body.kick.map_or(now + kick::swing(kind), |plan| plan.ready_at);
    body.kick = Some(KickPlan { kind, dir, mate: None, point, power, ready_at, until: now + kick::PATIENCE_TICKS });
}

/// How far a steered pass of full power goes, metres; chosen.
fn reach_m(kind: KickKind) -> f32 {
    match kind {
        KickKind::Short => 30.0,
        KickKind::High => 60.0,
        _ => 45.0,
    }
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
