//! Playing the ball without kicking it away: first touches, the touches of a dribble, headers on.
//!
//! Decides who touches a ball within reach and where it goes then; leaves duels for an owned ball to `duel`, hands to
//! `keeper`, what a touch means (passes, offside) to `flight` and `offside`.

use crate::event::Events;
use crate::football::body::{Intent, KickKind};
use crate::football::play::ticks_since;
use crate::football::{duel, flight, forecast, kick, noise};
use crate::math;
use crate::state::{Match, Player, PlayerId};
use glam::{Vec2, Vec3};
use setpiece_scenario::Ai;
use setpiece_scenario::pitch::{GOAL_HALF_WIDTH_M, HALF_LENGTH_M, HALF_WIDTH_M};
use setpiece_scenario::vocabulary::{EventKind, Rule, Stat};

/// How near his foot the ball must be for a dribbling touch, metres.
const FOOT_M: f32 = 0.65;
/// How far the sole reaches that stops it, metres; chosen.
const SOLE_M: f32 = 1.0;
/// Whoever wants to be slower than this with the ball stops it, m/s.
const STOPS_MPS: f32 = 0.3;
/// Faster than this nobody gets the sole on it, m/s.
pub(super) const SPRINTS_MPS: f32 = 6.0;
/// How far ahead the ball is touched walking (so fast, m/s) and sprinting, metres. Measured.
const WALKS_MPS: f32 = 5.1;
const CARRIED_M: [f32; 2] = [0.42, 0.64];
/// How near a player must be to take a free ball, metres.
const TRAP_M: f32 = 0.75;
/// A higher ball is headed, or left to come down, metres.
const CHEST_M: f32 = 1.25;
/// How near to a line a dribbler will push the ball, metres.
const LINE_CARE_M: f32 = 0.3;
/// Whom an agent drives minds a line until he is as near to it, metres; chosen.
const AT_LINE_M: f32 = 0.65;
/// How far a dribbling touch strays: next to nothing while nobody is near (measured: the same keys lead to the same place
/// within centimetres), more with an opponent about.
const FREE_WILD: f32 = 0.004;
const PRESSED_WILD: f32 = 0.09;
/// How far ahead of a standing player the ball is laid, metres. Measured.
const LAID_M: f32 = 0.4;
/// How whoever turns with the ball brakes, m/s²; chosen.
const TURN_MPS2: f32 = 14.0;
/// A turn has a smaller cosine than this; less sharp ones are run through; chosen.
const SHARP: f32 = 0.6;
/// How fast a trapped ball is drawn to the foot of a standing player, 1/s, and at most, m/s; fitted.
const SETTLES_PER_S: f32 = 4.0;
const SETTLED_MPS: f32 = 0.8;
/// How much faster than its player a trapped ball runs ahead at most, m/s. Measured of standing players.
const FOLLOWED_MPS: f32 = 3.6;
/// A ball met faster than this hops off the body that takes it, m/s; chosen.
const HOPS_MPS: f32 = 8.0;
/// Ticks until whoever has taken such a ball plays it again; fitted.
const TAKING_TICKS: i32 = 33;
/// A ball above this is not at the foot yet, metres: as of whoever owns it.
pub(super) const FOOT_HIGH_M: f32 = 0.5;
/// A dribbler's ball is no higher than this, metres; chosen: how high a trapped one hops.
const HIGH_M: f32 = 1.5;
/// How a player brakes and a slow ball rolls out, m/s².
const STOP_MPS2: f32 = 12.0;
const ROLL_MPS2: f32 = 1.75;
/// Ticks between two touches of one player.
const PAUSE_TICKS: i32 = 14;

/// Lets whoever can and will play the ball do so; at most one touch a tick.
pub fn play_ball(game: &mut Match, events: &mut Events) {
    if game.dead || game.play.hands.is_some() || game.play.set_piece.is_some() {
        return;
    }
    let ball = game.ball.pos;
    let flat = ball.truncate();
    let owner = game.owner.or_else(|| controller(game));
    let mut nearest: Option<(f32, PlayerId)> = None;
    for id in game.order() {
        let player = game.player(id);
        let distance = player.pos.distance_squared(flat);
        if distance > 1.1 * 1.1 || !player.is_up() || ball.z > player.body.height_m + 0.35 {
            continue;
        }
        if ball.z > CHEST_M && !heads(game, id) {
            continue;
        }
        if owner == Some(id) {
            // His own touch comes first; where he lets the ball be, a rival may try it.
            let stops = player.body.dribble.length_squared() < STOPS_MPS * STOPS_MPS
                && player.vel.length_squared() < SPRINTS_MPS * SPRINTS_MPS;
            let foot = if stops { SOLE_M } else { foot_m(game, player) };
            if distance <= foot * foot && ball.z < FOOT_HIGH_M && wants_ball(game, id) && dribble(game, events, id) {
                return;
            }
        } else if nearest.is_none_or(|(best, _)| distance < best) && wants_ball(game, id) {
            nearest = Some((distance, id));
        }
    }
    let Some((distance, id)) = nearest else { return };
    let near = libm::sqrtf(distance);
    if let Some(rival) = owner.filter(|rival| rival.team() != id.team()) {
        duel::challenge(game, events, id, rival, near);
    } else if near <= trap_m(game, id) && !about_to_kick(game, id) {
        trap(game, events, id);
    }
}

/// How near a player must be to take the free ball, metres: where both rest it is theirs from further away.
fn trap_m(game: &Match, id: PlayerId) -> f32 {
    let rests = game.player(id).vel.length_squared() + game.ball.vel.length_squared() < STOPS_MPS * STOPS_MPS;
    if rests { SOLE_M } else { TRAP_M }
}

/// How near a dribbler lets a ball come that rolls before them until they touch it again, metres; one that rolls otherwise
/// they touch from further away.
fn foot_m(game: &Match, player: &Player) -> f32 {
    let (ball, own) = (game.ball.vel.truncate(), player.vel);
    let along = ball.dot(own) > 0.94 * ball.length() * own.length() && player.body.dribble.dot(own) > 0.0;
    if along { carried_m(own.length()) } else { FOOT_M }
}

/// How far ahead of a runner at so many m/s the ball is when it is touched, metres. Measured.
fn carried_m(speed: f32) -> f32 {
    let sprints = ((speed - WALKS_MPS) / (SPRINTS_MPS + 1.5 - WALKS_MPS)).clamp(0.0, 1.0);
    CARRIED_M[0] + (CARRIED_M[1] - CARRIED_M[0]) * sprints
}

/// Whoever is dribbling the ball though it rolls free between two touches.
pub fn controller(game: &Match) -> Option<PlayerId> {
    let id = game.last_touch?;
    let player = game.player(id);
    let near = player.pos.distance_squared(game.ball.pos.truncate()) < 2.2 * 2.2;
    let own = game.play.pass.is_none() && game.play.shot.is_none();
    (player.active && near && own && game.ball.pos.z < HIGH_M).then_some(id)
}

/// Whether an agent, or a behaviour, presses for him.
fn is_driven(game: &Match, id: PlayerId) -> bool {
    game.play.driven & (1 << id.0) != 0
}

/// Whether he keeps the ball on the pitch: whom an agent drives does until he is at the line himself.
fn minds_lines(game: &Match, id: PlayerId) -> bool {
    let pos = game.player(id).pos.abs();
    let (x, y) = (HALF_LENGTH_M as f32 - AT_LINE_M, HALF_WIDTH_M as f32 - AT_LINE_M);
    !is_driven(game, id) || (pos.x < x && pos.y < y)
}

/// Whether a player would play the ball that is near him.
fn wants_ball(game: &Match, id: PlayerId) -> bool {
    let player = game.player(id);
    if (game.tick as i32) < player.body.ready_at {
        return false;
    }
    if player.ai == Ai::Lazy && !is_driven(game, id) {
        return false;
    }
    if game.last_touch == Some(id) {
        // What they have taken they let come down.
        return game.ball.pos.z < FOOT_HIGH_M && ticks_since(game.tick, player.body.touched_at) >= PAUSE_TICKS;
    }
    let Some(last) = game.last_touch else { return true };
    if last.team() != id.team() {
        return true;
    }
    // A mate's dribble and a mate's pass to somebody else are left alone.
    if controller(game) == Some(last) {
        return false;
    }
    match game.play.pass.and_then(|pass| pass.to) {
        Some(to) if to != id => game.play.chaser[id.team().index()] == Some(id),
        _ => game.play.shot.is_none() || matches!(player.body.intent, Intent::Ball(_)),
    }
}

/// Whether a player heads a high ball rather than let it come down: in a duel, to clear, or as his kick.
fn heads(game: &Match, id: PlayerId) -> bool {
    let player = game.player(id);
    let deep = player.pos.x * id.team().side() as f32 <= -25.0;
    let rival = || game.team(id.team().other()).any(|(_, rival)| rival.pos.distance_squared(player.pos) < 2.2 * 2.2);
    player.body.kick.is_some() || deep || rival()
}

/// Pushes the ball on in the way he wants to run, where it isn't rolling that way already; false where it is.
fn dribble(game: &mut Match, events: &mut Events, id: PlayerId) -> bool {
    let player = *game.player(id);
    let ball_vel = game.ball.vel.truncate();
    let armed = player.body.kick.is_some();
    let wish = if armed { player.body.dribble.clamp_length_max(2.5) } else { player.body.dribble };
    let speed = wish.length();
    let to_ball = game.ball.pos.truncate() - player.pos;
    if speed < STOPS_MPS {
        return rest(game, events, id);
    }
    let mut ahead = wish / speed;
    let rolling = ball_vel.length();
    if rolling > 1.0 {
        let cos = ball_vel.dot(ahead) / rolling;
        if cos > 0.94 && to_ball.dot(ahead) > 0.15 && ball_vel.dot(ahead) > player.vel.dot(ahead) + 0.2 {
            return false;
        }
        if speed > 6.0 && player.vel.length() > 5.5 && cos < 0.9 && cos > -0.6 {
            // At a sprint the ball is bent round by small angles.
            let left = if ball_vel.perp_dot(ahead) < 0.0 { -0.45 } else { 0.45 };
            let on = ball_vel / rolling;
            ahead = Vec2::new(on.x - on.y * left, on.y + on.x * left).normalize_or_zero();
        }
    }
    let care = Care { pressed: pressed(game, id), lines: minds_lines(game, id) };
    let velocity = touch_ahead(&player, to_ball, ahead, speed, &care);
    let wild = if care.pressed { PRESSED_WILD } else { FREE_WILD };
    let wild = wild * (0.9 - 0.6 * player.skill(Stat::Dribble)) * (0.4 + player.vel.length() / 8.0);
    let (aside, power) = (noise::bell(game) * wild, 1.0 + noise::bell(game) * wild);
    push(game, events, id, (velocity + Vec2::new(-velocity.y, velocity.x) * aside) * power, 0.0);
    true
}

/// Lays the ball where the player will come to a stand, a little ahead; false where it comes to rest there anyway.
fn rest(game: &mut Match, events: &mut Events, id: PlayerId) -> bool {
    let player = *game.player(id);
    let speed = player.vel.length();
    let stop = player.vel * (0.5 * speed / STOP_MPS2) + player.body.facing * LAID_M;
    let way = stop - (game.ball.pos.truncate() - player.pos);
    let wanted = way.normalize_or_zero() * libm::sqrtf(2.0 * ROLL_MPS2 * way.length());
    if (game.ball.vel.truncate() - wanted).length_squared() < 0.8 * 0.8 {
        return false;
    }
    push(game, events, id, wanted, 0.0);
    true
}

/// What a dribbler minds.
struct Care {
    /// An opponent who is about to get at him.
    pressed: bool,
    /// The lines: he doesn't push the ball over them.
    lines: bool,
}

/// The ball's velocity with which he meets it again a moment later, running at `speed` along `ahead`.
fn touch_ahead(player: &Player, to_ball: Vec2, ahead: Vec2, speed: f32, care: &Care) -> Vec2 {
    let own = player.vel.dot(ahead).max(0.0);
    // The stride that the next touch will find, rather than the one that is wanted.
    let pace = player.vel.length();
    let under_way = (pace / WALKS_MPS).min(1.0);
    let gait = (speed + 0.7 * (pace - speed) * under_way) / 8.0;
    let shy = if care.pressed { 0.8 } else { 1.0 };
    // Whoever turns carries the rest of their run on until they have braked it.
    let turns = player.vel.dot(ahead) < SHARP * pace;
    let rest = if turns { player.vel - ahead * own } else { Vec2::ZERO };
    let brakes = rest.length() / TURN_MPS2;
    let time = ((0.12 + 0.6 * gait * gait * gait * gait) * shy).max(brakes);
    let mean = own + ((speed.min(player.body.speed_top_mps) - own) * 0.5).clamp(-1.5, 2.0 * time);
    let free = ahead * (mean * (time - brakes) + carried_m(own)) + rest * (0.5 * brakes);
    let cut = if care.lines { within_lines(player.pos, free) } else { None };
    let place = cut.unwrap_or(free);
    let way = place - to_ball;
    let distance = way.length();
    let average = distance / time;
    // By a line it must stop there; else it rolls on until he meets it.
    let start = if cut.is_none() {
        average + 0.5 * (1.7 + 0.06 * average * average) * time
    } else {
        libm::sqrtf(2.0 * 1.7 * distance)
    };
    if distance > 0.01 { way * (start / distance) } else { Vec2::ZERO }
}

/// The way of a touch, cut; none where it doesn't take the ball off the pitch, or only into a goal.
fn within_lines(pos: Vec2, way: Vec2) -> Option<Vec2> {
    let (x, y) = (HALF_LENGTH_M as f32 - LINE_CARE_M, HALF_WIDTH_M as f32 - LINE_CARE_M);
    let to = pos + way;
    let x = if to.y.abs() < GOAL_HALF_WIDTH_M as f32 { x + 3.0 } else { x };
    let cut = to.clamp(Vec2::new(-x, -y), Vec2::new(x, y));
    (cut != to).then(|| cut - pos)
}

/// Whether an opponent is about to get at him.
pub fn pressed(game: &Match, id: PlayerId) -> bool {
    let pos = game.player(id).pos;
    game.team(id.team().other()).any(|(_, rival)| rival.pos.distance_squared(pos) < 2.0 * 2.0)
}

/// Whether he will meet the ball with the kick he has in mind, so that he need not take it down before.
fn about_to_kick(game: &Match, id: PlayerId) -> bool {
    let player = game.player(id);
    let Some(plan) = player.body.kick else { return false };
    let Some(swing) = plan.swing else { return false };
    let wait_s = (swing.ready_at - game.tick as i32).max(0) as f32 * 0.01;
    let apart = player.pos - game.ball.pos.truncate() + (player.vel - game.ball.vel.truncate()) * wait_s;
    apart.length_squared() <= kick::KICK_M * kick::KICK_M
}

/// Takes a free ball: how much of its speed stays is a matter of ball control.
fn trap(game: &mut Match, events: &mut Events, id: PlayerId) {
    let player = *game.player(id);
    let ball = game.ball;
    let meeting = (ball.vel - player.vel.extend(0.0)).length();
    let taken_from_rival = game.play.pass.is_some_and(|pass| pass.by.team() != id.team());
    if taken_from_rival || game.play.shot.is_some() {
        // A ball struck by the others: the faster, the harder to read.
        let reaction = player.skill(Stat::Reaction);
        let chance = (1.25 - 0.028 * meeting) * (0.5 + 0.5 * reaction) * (1.0 - 0.95 * surprise(game, reaction));
        if !noise::happens(game, chance) {
            game.players[id.index()].body.ready_at = game.tick as i32 + 40;
            return;
        }
    }
    if ball.pos.z > CHEST_M {
        header(game, events, id);
        return;
    }
    let control = player.skill(Stat::BallControl);
    let wildness = noise::roll(game);
    let from_mate = game.play.pass.is_some_and(|pass| pass.by.team() == id.team());
    let keep = if from_mate {
        0.0
    } else {
        ((meeting - 3.0) / 30.0).clamp(0.0, 1.0) * (0.85 - 0.55 * control) * (0.15 + 0.75 * wildness)
    };
    let wish = player.body.dribble;
    let to_ball = ball.pos.truncate() - player.pos;
    let care = Care { pressed: false, lines: minds_lines(game, id) };
    let ahead = wish.normalize_or_zero();
    let hard = meeting > HOPS_MPS;
    let soft = match (wish.length_squared() > 0.25, hard) {
        (true, _) => {
            let on = touch_ahead(&player, to_ball, ahead, wish.length().min(5.5), &care);
            // A hard one runs ahead no faster than the player can follow.
            if hard { on.clamp_length_max(player.vel.dot(ahead).max(0.0) + FOLLOWED_MPS) } else { on * 0.85 }
        }
        // Towards the foot, where it comes to rest.
        (false, true) => ((player.body.facing * LAID_M - to_ball) * SETTLES_PER_S).clamp_length_max(SETTLED_MPS),
        (false, false) => player.vel * 0.5,
    };
    let aside = noise::bell(game) * keep * 0.5;
    let left_over = ball.vel.truncate() * keep;
    let velocity = soft * (1.0 - keep) + left_over + Vec2::new(-left_over.y, left_over.x) * aside;
    push(game, events, id, velocity, if hard { hop_mps(meeting) } else { 0.0 });
    if hard {
        game.players[id.index()].body.ready_at = game.tick as i32 + TAKING_TICKS;
    }
}

/// How fast a ball rises from the body that takes it, m/s, by how fast they meet. Measured: taken at hip height it comes
/// down to the foot some .4 s later, after a head-on run some .9 s.
fn hop_mps(meeting: f32) -> f32 {
    let hard = ((meeting - 12.0) / 11.0).clamp(0.0, 1.2);
    0.4 + 2.2 * hard * libm::sqrtf(hard)
}

/// How much a ball just struck takes a player by surprise, 0..1: GRF's recency of the other's touch, over
/// 1000 - 500 · reaction ms.
fn surprise(game: &Match, reaction: f32) -> f32 {
    let since = game.last_touch.map_or(i32::MAX, |last| ticks_since(game.tick, game.player(last).body.touched_at));
    let window = 100.0 - 50.0 * reaction;
    libm::powf((1.0 - since as f32 / window).clamp(0.0, 1.0), 0.6)
}

/// Heads a high ball: on towards what he had in mind, else down in front of him.
fn header(game: &mut Match, events: &mut Events, id: PlayerId) {
    let player = *game.player(id);
    let side = id.team().side() as f32;
    let skill = player.skill(Stat::Header);
    let goal = Vec2::new(HALF_LENGTH_M as f32 * side, 0.0);
    let own_third = player.pos.x * side < -20.0;
    let plan = player.body.kick;
    let aimed = match plan.map(|plan| plan.kind) {
        Some(KickKind::Shot) => Some((goal, 15.0)),
        Some(_) => plan.and_then(|plan| plan.dir).map(|dir| (player.pos + dir * 15.0, 12.0)),
        None if own_third => Some((player.pos + Vec2::new(side * 20.0, math::sign_or(player.pos.y, side) * 8.0), 13.0)),
        None => None,
    };
    let (target, speed) = aimed.unwrap_or((player.pos + player.body.facing * 3.0, 3.5));
    let way = (target - player.pos).normalize_or_zero();
    let aside = noise::bell(game) * 0.25 * (1.3 - skill);
    let flat = (way + Vec2::new(-way.y, way.x) * aside) * speed;
    let rise = if speed > 10.0 { 1.5 + noise::bell(game) } else { -1.0 };
    let shot = plan.is_some_and(|plan| plan.kind == KickKind::Shot);
    let from = game.ball.pos;
    if !flight::touched(game, events, id, true) {
        return;
    }
    // Whoever jumped with him has lost this ball.
    let landing = game.tick as i32 + 40;
    game.each(game.squad, |other| {
        if other.pos.distance_squared(player.pos) < 1.5 * 1.5 {
            other.body.ready_at = landing;
        }
    });
    game.players[id.index()].body.kick = None;
    game.ball.vel = Vec3::new(flat.x, flat.y, if shot { -0.5 } else { rise });
    game.ball.spin = Vec3::ZERO;
    if shot {
        flight::shot_struck(game, events, id, from.truncate());
    }
    forecast::renew(game);
}

/// Touches the ball so that it leaves with a velocity.
pub fn push(game: &mut Match, events: &mut Events, id: PlayerId, velocity: Vec2, hop: f32) {
    if !flight::touched(game, events, id, false) {
        return;
    }
    let velocity = velocity.clamp_length_max(14.0);
    // A ball in the air is brought down.
    let fall = if game.ball.pos.z > 0.3 { game.ball.vel.z.min(0.0) - 1.0 } else { 0.0 };
    game.ball.vel = velocity.extend(if hop > 0.0 { hop } else { fall });
    game.ball.pos.z = game.ball.pos.z.max(0.11);
    // Rolling: the spin that belongs to the speed.
    game.ball.spin = Vec3::new(-velocity.y, velocity.x, 0.0) / 0.11;
    forecast::renew(game);
}

/// Whether a keeper may use his hands: not where an agent has him under `grf_keeper`, and not if he is lazy.
pub fn may_handle(game: &Match, id: PlayerId) -> bool {
    let driven = game.play.driven & (1 << id.0) != 0;
    let player = game.player(id);
    let bound = if driven { game.rule(Rule::GrfKeeper) } else { player.ai == Ai::Lazy };
    player.active && !bound
}

/// The event of a touch, by its height.
pub fn kind_of_touch(height_m: f32) -> EventKind {
    if height_m > 1.5 { EventKind::Header } else { EventKind::Touch }
}
