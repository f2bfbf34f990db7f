//! Kicks: when the foot meets the ball, and how the ball leaves it.
//!
//! Decides the ball's velocity and spin; leaves whom a pass is for to `pass_target`, where a shot goes to `shot`.

use crate::event::Events;
use crate::football::body::{KickKind, KickPlan, NEVER};
use crate::football::{flight, forecast, noise, offside, pass_target, report, shot, touch};
use crate::physics::constants::GRAVITY;
use crate::state::{Match, Player, PlayerId};
use glam::{Vec2, Vec3};
use setpiece_scenario::vocabulary::{EventKind, GameMode, Qualifier, Stat};

/// Ticks from the press to the contact: a pass on the ground, a lofted one, a shot.
pub const SWING_TICKS: [i32; 3] = [33, 28, 25];
/// Ticks of that which pass while an agent holds the key: a bot's kick needs none.
const PRESS_TICKS: i32 = 10;
/// Ticks that a kick waits for the ball.
pub const PATIENCE_TICKS: i32 = 200;
/// How near the ball must be to be kicked, metres.
pub const KICK_M: f32 = 0.85;
/// Backspin of a shot, rad/s: in flight it falls with 7.4 m/s², as measured.
const SHOT_BACKSPIN: f32 = 19.0;
/// How far a throw-in goes at most, metres; chosen.
const THROW_M: f32 = 25.0;
/// The height at which a throw-in comes to a mate, metres; chosen.
const CHEST_M: f32 = 1.0;
/// Highest ball that can be volleyed, metres.
const VOLLEY_M: f32 = 1.2;

/// The swing's length for a kind of kick, ticks.
pub fn swing(kind: KickKind) -> i32 {
    match kind {
        KickKind::Short | KickKind::Long => SWING_TICKS[0],
        KickKind::High => SWING_TICKS[1],
        KickKind::Shot | KickKind::Clear => SWING_TICKS[2],
    }
}

/// A kick that a bot decides on now: it swings like an agent's, but for the key.
pub fn planned(kind: KickKind, tick: u32) -> KickPlan {
    let now = tick as i32;
    let ready_at = now + swing(kind) - PRESS_TICKS;
    KickPlan { kind, dir: None, mate: None, point: None, power: 0.0, ready_at, until: now + PATIENCE_TICKS }
}

/// Kicks the ball for whoever has a kick ready and the ball in reach; at most one kick a tick.
pub fn kick_ball(game: &mut Match, events: &mut Events) {
    let now = game.tick as i32;
    for id in game.order() {
        let i = id.index();
        let Some(plan) = game.players[i].body.kick else { continue };
        if now > plan.until || !game.players[i].active {
            game.players[i].body.kick = None;
            continue;
        }
        if now >= plan.ready_at && can_kick(game, id) {
            game.players[i].body.kick = None;
            launch(game, events, id, plan);
            return;
        }
    }
}

/// Whether the ball is at his foot, and his to kick.
fn can_kick(game: &Match, id: PlayerId) -> bool {
    if game.dead || !game.player(id).is_up() {
        return false;
    }
    if let Some(set_piece) = game.play.set_piece {
        return set_piece.taker == id;
    }
    if let Some((keeper, _)) = game.play.hands {
        return keeper == id;
    }
    let player = game.player(id);
    let ball = game.ball.pos;
    if ball.z > VOLLEY_M || player.pos.distance_squared(ball.truncate()) > KICK_M * KICK_M {
        return false;
    }
    if (game.tick as i32) < player.body.ready_at {
        return false;
    }
    // A rival who dribbles the ball must be tackled first.
    touch::controller(game).is_none_or(|owner| owner.team() == id.team())
}

/// Kicks.
fn launch(game: &mut Match, events: &mut Events, id: PlayerId, plan: KickPlan) {
    let set_piece = game.play.set_piece;
    let from_hands = game.play.hands.is_some();
    let from = game.ball.pos.truncate();
    if !from_hands && !flight::touched(game, events, id, true) {
        return;
    }
    if from_hands {
        report::did(game, events, EventKind::Touch, id, None);
    }
    let mode = set_piece.map(|s| s.mode);
    game.play.hands = None;
    game.play.set_piece = None;
    let exempt = mode.is_some_and(offside::exempt);
    let rough = roughness(game.player(id), game, plan.kind);
    let mut receiver = None;
    match plan.kind {
        KickKind::Shot => {
            let velocity = if mode == Some(GameMode::FreeKick) {
                shot::over_wall(game, id, &plan)
            } else {
                shot::velocity(game, id, &plan, rough)
            };
            let flat = velocity.truncate().normalize_or_zero();
            send(game, velocity, Vec3::new(flat.y, -flat.x, 0.0) * SHOT_BACKSPIN);
        }
        KickKind::Clear => {
            let way = plan.dir.unwrap_or(Vec2::new(id.team().side() as f32, 0.0));
            let way = way + Vec2::new(-way.y, way.x) * (noise::bell(game) * 0.25);
            send(game, (way * 21.0).extend(10.0), Vec3::ZERO);
        }
        kind => {
            let target = pass_target::choose(game, id, &plan);
            receiver = target.mate;
            let velocity = match mode {
                Some(GameMode::ThrowIn) => throw_velocity(game, id, target.point),
                _ => pass_velocity(game, id, kind, target.point, rough, from_hands),
            };
            let spin = if kind == KickKind::High { backspin(velocity) } else { Vec3::ZERO };
            send(game, velocity, spin);
        }
    }
    flight::note(game, id, if exempt { flight::Touch::Exempt } else { flight::Touch::Played });
    // The kicker does not meet his own ball again at once.
    game.players[id.index()].body.ready_at = game.tick as i32 + 30;
    game.mode = GameMode::Normal;
    if let Some(mode) = mode {
        let kind = crate::football::restart::event_of(mode);
        events.push(report::event(game, kind).by(id).qualified(Qualifier::Taken));
    }
    match plan.kind {
        KickKind::Shot => flight::shot_struck(game, events, id, from),
        _ => flight::pass_struck(game, events, id, receiver, from),
    }
    forecast::renew(game);
    if let Some(receiver) = receiver {
        crate::control::switching::hand_to(game, receiver);
    }
    game.players[id.index()].body.touched_at = if exempt { NEVER } else { game.tick as i32 };
}

/// Gives the ball a velocity and spin.
fn send(game: &mut Match, velocity: Vec3, spin: Vec3) {
    game.ball.pos.z = game.ball.pos.z.max(0.13);
    game.ball.vel = velocity;
    game.ball.spin = spin;
}

/// How awkward the kick is, 0..1: a fast, high or far ball (less for who volleys well), an opponent near (less for a
/// calm man).
fn roughness(player: &Player, game: &Match, kind: KickKind) -> f32 {
    if game.play.set_piece.is_some() || game.play.hands.is_some() {
        return 0.0;
    }
    let relative = (game.ball.vel - player.vel.extend(0.0)).length();
    let far = (player.pos.distance(game.ball.pos.truncate()) - 0.5).max(0.0);
    let high = (game.ball.pos.z - 0.3).max(0.0);
    let near = game
        .players
        .iter()
        .filter(|rival| rival.active && rival.pos.distance_squared(player.pos) < 2.2 * 2.2)
        .count()
        .saturating_sub(1);
    let pushed = 3.0 * player.body.push_m;
    let moving = ((relative - 4.0) / 25.0).clamp(0.0, 0.7) + high * 0.4;
    // Both about 1 for the average player of the table.
    let volley = if kind == KickKind::Shot { 1.22 - 0.4 * player.skill(Stat::Volley) } else { 1.0 };
    let hurry = 1.3 - 0.4 * player.skill(Stat::Calmness);
    (moving * volley + far * 0.5 + near as f32 * 0.16 * hurry + pushed).clamp(0.0, 1.0)
}

/// The velocity of a pass to a point.
///
/// Speeds and rises are fitted to the measured kicks: 15 m/s over 11 m, 24 m/s from 22 m on; lofted 13 to 33 m/s.
fn pass_velocity(game: &mut Match, id: PlayerId, kind: KickKind, point: Vec2, rough: f32, by_hand: bool) -> Vec3 {
    let player = *game.player(id);
    let stat = if kind == KickKind::High { Stat::HighPass } else { Stat::ShortPass };
    let skill = player.skill(stat);
    let way = point - game.ball.pos.truncate();
    let distance = way.length().clamp(1.0, 60.0);
    let far = libm::powf(distance / 60.0, 1.4);
    let (level, rise) = if kind == KickKind::High {
        let rise = 0.39 - 0.07 * distance / 60.0;
        let speed = (0.97 * 36.0 * (1.15 * far + 0.3)).min(36.0);
        (speed / libm::sqrtf(1.0 + rise * rise), rise)
    } else {
        let speed = (0.97 * 36.0 * (1.8 * far + 0.3)).min(25.4);
        let speed = if by_hand { speed.min(15.0) } else { speed };
        (speed, 0.11 + 0.0055 * (distance - 12.0).clamp(0.0, 30.0))
    };
    // Measured passes without pressure hardly scatter; awkward ones and poor passers do.
    let wild = (0.015 + 0.26 * rough + 0.02 * (1.0 - player.body.level)) * (1.2 - 0.8 * skill);
    let aside = noise::bell(game) * wild;
    let power = 1.0 + noise::bell(game) * wild * 0.8;
    let ahead = way.normalize_or(player.body.facing);
    let flat = (ahead + Vec2::new(-ahead.y, ahead.x) * aside) * (level * power);
    flat.extend(level * rise * (1.0 + noise::bell(game) * wild))
}

/// The velocity of a throw-in: it comes down to a mate's chest at a point.
fn throw_velocity(game: &mut Match, id: PlayerId, point: Vec2) -> Vec3 {
    let way = point - game.ball.pos.truncate();
    let distance = way.length().clamp(2.0, THROW_M);
    let speed = 7.0 + 0.35 * distance;
    let time = distance / (0.95 * speed);
    let rise = (CHEST_M - game.ball.pos.z + 0.5 * GRAVITY * time * time) / time;
    let ahead = way.normalize_or(game.player(id).body.facing);
    let aside = Vec2::new(-ahead.y, ahead.x) * (noise::bell(game) * 0.02);
    ((ahead + aside) * speed).extend(rise)
}

/// The backspin that lifts a lofted pass, rad/s.
fn backspin(velocity: Vec3) -> Vec3 {
    let flat = velocity.truncate().normalize_or_zero();
    let slow = 22.0 / velocity.length().max(8.0);
    Vec3::new(flat.y, -flat.x, 0.0) * (15.0 * (slow * slow).clamp(0.5, 3.0))
}
