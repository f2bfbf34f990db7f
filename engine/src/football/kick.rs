//! Kicks: from the key to the moment when the foot meets the ball.
//!
//! `pass_target` chooses a pass's target. `pass` and `shot` decide how the ball leaves the foot.

use crate::football::pass::Struck;
use crate::football::swing::ChosenSwing;
use crate::football::{
    contact, dribble_motion, forecast, leg, offside, pass, pass_target, report, shot, swing,
    switching, whistle,
};
use crate::math;
use crate::physics::constants::BALL_RADIUS;
use crate::state::event::Events;
use crate::state::player::{KickKind, KickPlan, NEVER, Swing};
use crate::state::{Match, PlayerId, Squad};
use glam::{Vec2, Vec3};
use setpiece_scenario::vocabulary::{EventKind, GameMode, Qualifier};

/// Ticks that a kick waits for the ball after its key is released. (GRF's.)
pub const PATIENCE_TICKS: i32 = 200;
/// A key held for longer than this no longer delays the swing, ticks. (GRF's.)
const CHARGE_TICKS: u8 = 50;
/// Ticks until the gauge is full. (GRF's.)
const GAUGE_TICKS: u8 = 100;
/// A plan ends if the ball has become this much harder to reach within a step, seconds. (GRF's.)
const LOST_S: f32 = 0.7;
/// The same for a ball that its player has pushed on; fitted.
const OWN_LOST_S: f32 = 0.95;
/// The contact may still turn a pass by this angle, radians. (GRF's.)
const TURN_RAD: f32 = 0.15 * std::f32::consts::PI;
/// Ticks of a leg's follow-through after a kick. Measured.
const FOLLOW_TICKS: i32 = 34;
/// A way to clear the ball.
struct Clearance {
    kind: KickKind,
    /// Where to: this far the way it is cleared, and this far up the pitch, metres.
    to_m: f32,
    on_m: f32,
    /// Of a shot.
    power: f32,
}

/// Ways to clear the ball, in the order in which they are tried. (GRF's.)
const CLEARED: [Clearance; 3] = [
    Clearance { kind: KickKind::High, to_m: 42.0, on_m: 0.0, power: 0.0 },
    Clearance { kind: KickKind::Shot, to_m: 30.0, on_m: 0.0, power: 0.6 },
    Clearance { kind: KickKind::Long, to_m: 48.0, on_m: 9.6, power: 0.0 },
];
/// Ticks until a player whose swing has missed the ball can begin another; chosen.
const MISSED_TICKS: i32 = 20;

/// A kick that a bot decides on now; its swing begins as soon as one meets the ball.
pub fn planned(kind: KickKind, tick: u32) -> KickPlan {
    KickPlan { until: tick as i32 + PATIENCE_TICKS, ..asked(kind) }
}

/// A kick whose key is pressed now.
pub fn pressed(kind: KickKind, tick: u32) -> KickPlan {
    KickPlan { held: true, until: tick as i32 + PATIENCE_TICKS, ..asked(kind) }
}

/// A set piece that a bot takes from now on.
pub fn taken(kind: KickKind, mode: GameMode, tick: u32) -> KickPlan {
    let swing = begun(kind, tick as i32 + run_up_ticks(mode));
    KickPlan { swing: Some(swing), until: tick as i32 + PATIENCE_TICKS, ..asked(kind) }
}

/// A speed in 0.1 m/s, below [`Swing::RUN`].
fn dmps(mps: f32) -> u8 {
    (mps * 10.0).round().clamp(0.0, f32::from(Swing::RUN - 1)) as u8
}

/// A swing at a ball that waits for it.
fn begun(kind: KickKind, ready_at: i32) -> Swing {
    Swing {
        kind,
        ready_at,
        way: None,
        place: Vec3::ZERO,
        mate: None,
        end_dmps: Swing::RUN,
        left_m: 0.0,
        stroke: None,
    }
}

fn asked(kind: KickKind) -> KickPlan {
    KickPlan {
        kind,
        dir: None,
        mate: None,
        point: None,
        power: 0.0,
        gauge_ticks: 0,
        held: false,
        meet_s: f32::MAX,
        swing: None,
        until: 0,
    }
}

impl KickPlan {
    /// How full the gauge is, 0..1. A key press counts for at least 60 ms. (GRF's.)
    pub fn gauge(&self) -> f32 {
        ((f32::from(self.gauge_ticks) - 6.0) / 94.0).clamp(0.0, 1.0)
    }
}

/// Advances every requested kick.
///
/// Gauges fill and swings begin. A player with the ball in reach at the end of their swing kicks
/// it. At most one kick happens per tick. `kicks`: the players that may have requested one.
pub fn kick_ball(game: &mut Match, events: &mut Events, kicks: Squad) {
    let now = game.tick as i32;
    let mut kicked = false;
    for id in game.order_of(kicks) {
        let i = id.index();
        let Some(mut plan) = game.players[i].body.kick else { continue };
        if plan.held {
            plan.gauge_ticks = plan.gauge_ticks.saturating_add(1).min(GAUGE_TICKS);
            plan.until = now + PATIENCE_TICKS;
        }
        let meet_s = game.players[i].body.meet_s;
        let later_s = if game.last_touch == Some(id) { OWN_LOST_S } else { LOST_S };
        let lost =
            plan.swing.is_none() && meet_s > plan.meet_s + later_s && game.play.set_piece.is_none();
        plan.meet_s = meet_s;
        if now > plan.until || lost || !game.players[i].active {
            game.players[i].body.kick = None;
            continue;
        }
        match plan.swing {
            Some(swing) if now >= swing.ready_at && !kicked => match missed_share(game, id, &swing)
            {
                Some(missed) => {
                    game.players[i].body.kick = None;
                    strike(game, events, id, plan, missed);
                    kicked = true;
                    continue;
                }
                None if swing.stroke.is_some() => {
                    // The leg has passed the ball.
                    plan.swing = None;
                    game.players[i].body.ready_at = now + MISSED_TICKS;
                }
                None => {}
            },
            Some(_) => {}
            None => {
                if let Some(begun) = begin(game, id, &plan) {
                    plan = begun;
                    if plan.swing.is_some_and(|swing| swing.stroke.is_some()) {
                        // The swing takes the place of the motion of a dribble.
                        let body = &mut game.players[i].body;
                        (body.lunge, body.ready_at) = (None, now);
                    }
                }
            }
        }
        game.players[i].body.kick = Some(plan);
    }
}

/// Begins the swing of a kick. The key must be released (or held long enough), and a swing must
/// meet the ball. A clearance becomes the first kick that has one.
fn begin(game: &Match, id: PlayerId, plan: &KickPlan) -> Option<KickPlan> {
    if plan.held && (plan.gauge_ticks <= CHARGE_TICKS || stays(game, plan.kind)) {
        return None;
    }
    let at_hand = game.play.set_piece.is_some() || game.play.hands.is_some();
    let may = at_hand || is_free(game, id) && looks(game, id);
    if !may {
        return None;
    }
    if plan.kind == KickKind::Clear && !at_hand {
        let kicks = clearances(game, id, plan);
        let begun = kicks.iter().find_map(|kick| swung(game, id, kick))?;
        return Some(KickPlan { kind: KickKind::Clear, ..begun });
    }
    if !at_hand {
        return swung(game, id, plan);
    }
    let (way, mate) = meant(game, id, plan);
    let ticks =
        game.play.set_piece.map_or(at_hand_ticks(plan.kind), |piece| run_up_ticks(piece.mode));
    let swing = Swing { way: Some(way), mate, ..begun(plan.kind, game.tick as i32 + ticks) };
    Some(KickPlan { swing: Some(swing), ..*plan })
}

/// A kick with the swing that meets the ball, if there is one.
fn swung(game: &Match, id: PlayerId, plan: &KickPlan) -> Option<KickPlan> {
    let (way, mate) = meant(game, id, plan);
    let ChosenSwing { motion, place, stroke } = swing::find(game, id, plan.kind, way)?;
    let pace = game.player(id).vel.length();
    let target = game.ball.pos.truncate() + way;
    let swing = Swing {
        way: Some(target - place.truncate()),
        mate,
        end_dmps: dmps(motion.end_mps(pace)),
        left_m: motion.way_m(pace),
        place,
        stroke: Some(stroke),
        ..begun(plan.kind, game.tick as i32 + motion.ticks)
    };
    Some(KickPlan { swing: Some(swing), ..*plan })
}

/// The kicks that clear a ball, in the order in which they are tried: a lofted pass, a shot, a
/// ground pass. (GRF's.)
fn clearances(game: &Match, id: PlayerId, plan: &KickPlan) -> [KickPlan; 3] {
    let side = Vec2::new(id.team().side() as f32, 0.0);
    let way = plan.dir.unwrap_or(side);
    let from = game.player(id).pos;
    CLEARED.map(|Clearance { kind, to_m, on_m, power }| KickPlan {
        kind,
        point: Some(from + way * to_m + side * on_m),
        power,
        ..*plan
    })
}

/// Whether a player looks now whether a swing meets the ball: every other tick, the teams by turns.
/// (GRF's.)
pub(super) fn looks(game: &Match, id: PlayerId) -> bool {
    (game.tick + u32::from(id.team() != game.play.early)).is_multiple_of(2)
}

/// Whether a player can begin a swing: not in a motion, but for one of a dribble before its touch.
/// (GRF's.)
fn is_free(game: &Match, id: PlayerId) -> bool {
    let now = game.tick as i32;
    let player = game.player(id);
    match player.body.lunge {
        Some(lunge) if lunge.until() > now => dribble_motion::has_yet_to_touch(&lunge, now),
        _ => now >= player.body.ready_at && player.is_up(),
    }
}

/// What a kick aims at now: the way from the ball, world metres, and the teammate.
fn meant(game: &Match, id: PlayerId, plan: &KickPlan) -> (Vec2, Option<PlayerId>) {
    let from = game.ball.pos.truncate();
    if plan.kind == KickKind::Shot {
        return (shot::meant(game, id, plan) - from, None);
    }
    let target = pass_target::choose(game, id, plan);
    (target.point - from, target.mate)
}

/// Whether the taker of a set piece stands for as long as the key is held. A lofted pass and a
/// throw begin earlier. (Measured.)
fn stays(game: &Match, kind: KickKind) -> bool {
    kind != KickKind::High
        && game.play.set_piece.is_some_and(|set_piece| set_piece.mode != GameMode::ThrowIn)
}

/// Ticks from the start of a run-up to the contact at a set piece. Measured.
fn run_up_ticks(mode: GameMode) -> i32 {
    match mode {
        GameMode::ThrowIn => 22,
        GameMode::Penalty => 64,
        _ => 52,
    }
}

/// Ticks of a kick out of a keeper's hands.
fn at_hand_ticks(kind: KickKind) -> i32 {
    if matches!(kind, KickKind::Short | KickKind::Long) { 34 } else { 24 }
}

/// How much a swing that arrives now misses the ball that it is made for, 0..1. None if it can't
/// kick it.
fn missed_share(game: &Match, id: PlayerId, swing: &Swing) -> Option<f32> {
    if game.dead || !game.player(id).is_up() {
        return None;
    }
    if let Some(set_piece) = game.play.set_piece {
        return (set_piece.taker == id).then_some(0.0);
    }
    if let Some((keeper, _)) = game.play.hands {
        return (keeper == id).then_some(0.0);
    }
    leg::missed_share(game, swing.place)
}

/// Kicks a ball that has come off the swing's place by a share of what a leg allows for: so much of
/// its own way it keeps. (GRF's.)
fn strike(game: &mut Match, events: &mut Events, id: PlayerId, plan: KickPlan, missed: f32) {
    let before = game.ball;
    launch(game, events, id, plan);
    if missed > 0.0 {
        game.ball.vel = game.ball.vel.lerp(before.vel, missed);
        game.ball.spin = game.ball.spin.lerp(before.spin, missed);
        forecast::renew(game);
    }
}

/// Kicks.
fn launch(game: &mut Match, events: &mut Events, id: PlayerId, plan: KickPlan) {
    let clears = plan.kind == KickKind::Clear;
    let plan = KickPlan { kind: plan.swing.map_or(plan.kind, |swing| swing.kind), ..plan };
    let set_piece = game.play.set_piece;
    let from_hands = game.play.hands.is_some();
    let from = game.ball.pos.truncate();
    if !from_hands && !contact::touched(game, events, id, true) {
        return;
    }
    if from_hands {
        report::did(game, events, EventKind::Touch, id, None);
    }
    let mode = set_piece.map(|s| s.mode);
    game.play.hands = None;
    game.play.set_piece = None;
    let exempt = mode.is_some_and(offside::exempt);
    let mut receiver = None;
    let struck = if plan.kind != KickKind::Shot {
        let (way, mate) = refined(game, id, &plan);
        receiver = mate.filter(|_| !clears);
        if mode == Some(GameMode::ThrowIn) {
            pass::thrown(game, id, way)
        } else {
            pass::struck(game, id, &plan, way, from_hands)
        }
    } else if mode == Some(GameMode::FreeKick) {
        shot::over_wall(game, id, &plan)
    } else {
        shot::struck(game, id, &plan)
    };
    send(game, id, struck);
    contact::note(game, id, if exempt { contact::Touch::Exempt } else { contact::Touch::Played });
    // The kicker can't meet the same ball again at once.
    game.players[id.index()].body.ready_at = game.tick as i32 + 30;
    game.players[id.index()].body.follows_until = game.tick as i32 + FOLLOW_TICKS;
    game.mode = GameMode::Normal;
    if let Some(mode) = mode {
        let kind = whistle::event_of(mode);
        events.push(report::event(game, kind).by(id).qualified(Qualifier::Taken));
    }
    match plan.kind {
        KickKind::Shot if !clears => contact::shot_struck(game, events, id, from),
        _ => contact::pass_struck(game, events, id, receiver, from),
    }
    forecast::renew(game);
    if let Some(receiver) = receiver {
        switching::hand_to(game, receiver);
    }
    game.players[id.index()].body.touched_at = if exempt { NEVER } else { game.tick as i32 };
}

/// The way of a pass as the foot meets the ball, world metres, and its receiver.
///
/// The keys that are held now count as far as the leg can still turn. Anything further off comes
/// too late. (GRF's.)
fn refined(game: &Match, id: PlayerId, plan: &KickPlan) -> (Vec2, Option<PlayerId>) {
    let (now, mate) = meant(game, id, plan);
    let Some(swing) = plan.swing else { return (now, mate) };
    let Some(was) = swing.way else { return (now, mate) };
    let angle = math::atan2(was.perp_dot(now), was.dot(now));
    if angle.abs() <= TURN_RAD {
        return (now, mate);
    }
    if angle.abs() >= 2.0 * TURN_RAD {
        return (was, swing.mate);
    }
    let turned = math::unit(TURN_RAD * math::sign_or(angle, 1.0)).rotate(was);
    let share = TURN_RAD / angle.abs();
    let length = was.length() * (1.0 - share) + now.length() * share;
    (turned.normalize_or_zero() * length, mate)
}

/// Gives the ball a velocity and spin.
fn send(game: &mut Match, id: PlayerId, struck: Struck) {
    let Struck { velocity, spin, kept_spin } = struck;
    game.ball.vel = velocity;
    game.ball.pos.z = game.ball.pos.z.max(BALL_RADIUS);
    game.ball.spin = game.ball.spin * kept_spin + contact::spun(game, id, spin);
}
