//! Turns an agent's actions into what its player wants.

use crate::control::{assist, sticky};
use crate::football::dribble_motion::{self, BRAKED};
use crate::football::pace::{
    DRIBBLE_MPS, DRIBBLE_WITH_BALL_MPS, RUN_MPS, RUN_WITH_BALL_MPS, SPRINT_MPS,
};
use crate::football::{kick, reach, slide};
use crate::state::event::Events;
use crate::state::player::{Intent, KickKind, KickPlan};
use crate::state::{Match, Player, PlayerId, Steer};
use glam::Vec2;
use setpiece_scenario::vocabulary::{Action, GameMode, Role};

/// A lower pace counts as standing, share of a sprint; chosen.
const STILL: f32 = 0.1;

/// The share of their speed that they keep per step while a leg follows through. Measured.
const FOLLOWING: f32 = 0.88;

/// What an agent holds.
#[derive(Clone, Copy, Debug)]
pub struct Held {
    /// Held keys.
    pub sticky: u16,
    /// A steered direction instead of a held one.
    pub steer: Option<Steer>,
    /// The kick whose key is still down since it requested that kick.
    pub key: Option<KickKind>,
}

impl Held {
    /// The held world direction, if any, and its speed, m/s.
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

/// Sets the intent and the planned kick of an agent's player. Returns the kick whose key is down
/// and has been processed.
pub fn drive(
    game: &mut Match,
    events: &mut Events,
    id: PlayerId,
    held: Held,
    action: Action,
) -> Option<KickKind> {
    let has_ball = game.owner == Some(id) || game.controller() == Some(id);
    let (direction, gait) = held.run(id.team().side() as f32, has_ball);
    let power = held.steer.map_or(0.0, |steer| steer.power);
    let kind = KickKind::of(action).filter(|_| hears_kicks(game, id));
    let key = match kind {
        Some(kind) if held.key == Some(kind) => held.key,
        Some(kind) => press(game, id, kind, direction, power).then_some(kind),
        None => None,
    };
    if action == Action::Sliding && may_slide(game, id) {
        slide::begin(game, events, id, direction);
    }
    let player = *game.player(id);
    let takes = game.play.set_piece.is_some_and(|set_piece| set_piece.taker == id);
    let chases = sticky::presses(held.sticky) && !may_play(game, id);
    let fetch = has_ball || player.body.kick.is_some() || assist::ball_is_theirs(game, id);
    let body = &mut game.players[id.index()].body;
    if let Some(plan) = &mut body.kick {
        plan.held = kind == Some(plan.kind);
        plan.dir = direction;
    }
    let waits = body.kick.is_some() && game.play.set_piece.is_none();
    let swings = body.kick.is_some_and(|plan| plan.swing.is_some()) && waits;
    let follows = (game.tick as i32) < body.follows_until;
    let kicks = follows || swings && has_ball;
    let wish = if follows {
        player.vel * FOLLOWING
    } else if kicks {
        player.vel
    } else if waits && has_ball {
        braked(&player, direction, gait)
    } else {
        direction.unwrap_or(Vec2::ZERO) * gait
    };
    if takes {
        // The taker of a set piece stands until the run-up.
        body.dribble = Vec2::ZERO;
        let runs = body.kick.is_some_and(|plan| !plan.held || plan.swing.is_some());
        body.intent = if runs { Intent::Ball(SPRINT_MPS) } else { Intent::Stand };
        return key;
    }
    // A player without a held direction lets a pass come; one who holds the pass's direction goes
    // to meet it.
    let meets =
        direction.is_some_and(|ahead| ahead.dot(game.ball.pos.truncate() - player.pos) > 0.0);
    let stands =
        !has_ball && !meets && player.body.kick.is_none() && reach::comes_to(game, &player);
    let meeting = if fetch && !has_ball { assist::meeting(game, id, wish) } else { None };
    let body = &mut game.players[id.index()].body;
    body.dribble = wish;
    body.intent = if kicks {
        Intent::Run(wish)
    } else if let Some((place, pace)) = meeting {
        Intent::Go(place, pace)
    } else if waits && has_ball {
        // However fast the ball rolls on, they stay with it.
        Intent::Ball(SPRINT_MPS)
    } else if fetch && stands {
        Intent::Stand
    } else if fetch {
        Intent::Ball(if has_ball {
            gait.max(if direction.is_some() { 0.0 } else { RUN_MPS })
        } else {
            SPRINT_MPS
        })
    } else if chases {
        Intent::Ball(SPRINT_MPS)
    } else {
        Intent::Run(wish)
    };
    key
}

/// The velocity of a player on the ball while a kick is requested. They keep their line and brake,
/// most if another direction is held. (GRF's.)
fn braked(player: &Player, direction: Option<Vec2>, gait: f32) -> Vec2 {
    let ahead = player.vel.normalize_or(player.body.facing);
    let most = gait * BRAKED * dribble_motion::braking(ahead, direction);
    ahead * player.vel.length().min(most)
}

/// Presses the key of a kick. Returns whether that requests the kick, or changes the requested one.
///
/// A short pass cancels a requested shot or lofted pass; any other key doesn't change it. (GRF's.)
/// A steered pass with some power goes to a point that far along its direction; any other finds a
/// teammate.
fn press(game: &mut Match, id: PlayerId, kind: KickKind, dir: Option<Vec2>, power: f32) -> bool {
    if !may_arm(game, id, kind) {
        return false;
    }
    if let Some(plan) = game.player(id).body.kick {
        if plan.kind != kind {
            game.players[id.index()].body.kick = None;
        }
        return true;
    }
    let from = game.player(id).pos;
    let point = dir
        .filter(|_| power > 0.0 && kind != KickKind::Shot)
        .map(|dir| from + dir * (power * reach_m(kind)));
    game.players[id.index()].body.kick =
        Some(KickPlan { dir, point, power, ..kick::pressed(kind, game.tick) });
    true
}

/// Whether a player reacts to the key of a kick: in the first step of a start only a keeper does.
/// (Measured: it goes to the keeper, whoever is controlled.)
fn hears_kicks(game: &Match, id: PlayerId) -> bool {
    game.tick > 0 || game.play.set_piece.is_some() || game.player(id).role == Role::GK
}

/// The distance of a steered pass at full power, metres; chosen.
fn reach_m(kind: KickKind) -> f32 {
    match kind {
        KickKind::Short => 30.0,
        KickKind::High => 60.0,
        _ => 45.0,
    }
}

/// Whether the key of a kick has an effect: the ball must be the player's to play, and a throw-in
/// must be a pass to a teammate. While a kick is requested, its own key stays effective, and a
/// short pass cancels a shot or lofted pass whose swing hasn't begun.
pub fn may_arm(game: &Match, id: PlayerId, kind: KickKind) -> bool {
    if let Some(plan) = game.player(id).body.kick {
        let ends = kind == KickKind::Short && matches!(plan.kind, KickKind::Shot | KickKind::High);
        return plan.kind == kind || ends && plan.swing.is_none() && game.play.set_piece.is_none();
    }
    let thrown = game.play.set_piece.is_some_and(|set_piece| set_piece.mode == GameMode::ThrowIn);
    hears_kicks(game, id)
        && may_play(game, id)
        && !(thrown && matches!(kind, KickKind::High | KickKind::Shot))
}

/// Whether a slide can be requested: opponents must have the ball, or be about to.
pub fn may_slide(game: &Match, id: PlayerId) -> bool {
    slide::may_begin(game, id) && !may_play(game, id)
}

/// Whether the ball is a player's to play: they have it, or are nearer to it than every opponent.
pub fn may_play(game: &Match, id: PlayerId) -> bool {
    if let Some(set_piece) = game.play.set_piece {
        return set_piece.taker == id;
    }
    if game.owner == Some(id) {
        return true;
    }
    let team = id.team();
    if let Some(owner) = game.controller() {
        return owner == id;
    }
    let rival =
        game.play.chaser[team.other().index()].map_or(9.0, |rival| game.player(rival).body.meet_s);
    game.player(id).body.meet_s <= rival + 0.1 && game.play.hands.is_none()
}
