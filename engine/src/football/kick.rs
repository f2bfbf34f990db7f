//! Kicks: from the key to the moment at which the foot meets the ball.
//!
//! Leaves the choice of a pass's target to `pass_target`, how the ball leaves the foot to `pass` and `shot`.

use crate::football::pace::{RUN_MPS, SPRINT_MPS};
use crate::football::pass::Struck;
use crate::football::{contact, forecast, noise, offside, pass, pass_target, report, shot, switching, whistle};
use crate::math;
use crate::state::event::Events;
use crate::state::player::{KickKind, KickPlan, NEVER, Swing};
use crate::state::{Match, Player, PlayerId, Squad};
use glam::{Vec2, Vec3};
use setpiece_scenario::vocabulary::{EventKind, GameMode, Qualifier, Stat};

/// Ticks from the beginning of a bot's swing to the contact: a pass on the ground, a lofted one, a shot.
const SWING_TICKS: [i32; 3] = [28, 25, 22];
/// Ticks that a kick waits for the ball once its key is let go. (GRF's.)
pub const PATIENCE_TICKS: i32 = 200;
/// A key held for longer than this no longer keeps the swing from beginning, ticks. (GRF's.)
const CHARGE_TICKS: u8 = 50;
/// The gauge is full after so many ticks. (GRF's.)
const GAUGE_TICKS: u8 = 100;
/// A plan ends where the ball has got so much further away in a step, seconds. (GRF's.)
const LOST_S: f32 = 0.7;
/// A swing that has not met the ball after so many ticks begins again; chosen.
const MISSED_TICKS: i32 = 30;
/// How near the ball must be to be kicked, metres.
pub const KICK_M: f32 = 0.85;
/// How far from their path a ball may be at the contact for a player to begin the swing, metres; chosen.
const BEGIN_M: f32 = 1.3;
/// What share of their pace whoever begins a swing has on the way to the contact; chosen.
const BEGIN_PACE: f32 = 0.7;
/// How soon a sprinter shoots whose ball comes to their foot, ticks, and how near that is, metres; fitted to how soon shots
/// leave from many points of the stride.
const QUICK_TICKS: i32 = 48;
const REACH_M: f32 = 0.8;
/// How soon a ball that comes fast can be struck without being taken, ticks. Fitted to how late that can be asked for.
const FIRST_TIME_TICKS: std::ops::Range<i32> = 14..28;
/// The highest ball that is, metres, and how often that comes off: short, long and high passes, shots. Measured.
const FIRST_TIME_M: f32 = 0.9;
const FIRST_TIME: [f32; 4] = [0.75, 0.5, 0.2, 0.85];
/// The angle by which a pass may still be turned at the contact, radians. (GRF's.)
const TURN_RAD: f32 = 0.15 * std::f32::consts::PI;
/// A ball that comes faster than this is taken before it is kicked, m/s; chosen.
const TAKES_MPS: f32 = 8.0;
/// A swing begins for a ball that is no higher at the contact, metres; chosen.
const LOW_M: f32 = 0.5;
/// How near it must be to a leg that has been on its way to it, metres; chosen.
const STRETCH_M: f32 = 1.2;
/// For how many ticks a leg that has kicked follows through. Measured.
const FOLLOW_TICKS: i32 = 20;
/// Highest ball that can be volleyed, metres.
const VOLLEY_M: f32 = 1.2;

/// A kick that a bot decides on now: its swing begins at once.
pub fn planned(kind: KickKind, tick: u32) -> KickPlan {
    let now = tick as i32;
    let ticks = match kind {
        KickKind::Short | KickKind::Long => SWING_TICKS[0],
        KickKind::High => SWING_TICKS[1],
        KickKind::Shot | KickKind::Clear => SWING_TICKS[2],
    };
    let swing = Swing { ready_at: now + ticks, way: None, mate: None, runs: true };
    KickPlan { swing: Some(swing), until: now + PATIENCE_TICKS, ..asked(kind) }
}

/// A kick whose key goes down now.
pub fn pressed(kind: KickKind, tick: u32) -> KickPlan {
    KickPlan { held: true, until: tick as i32 + PATIENCE_TICKS, ..asked(kind) }
}

/// A set piece that a bot takes from now on.
pub fn taken(kind: KickKind, mode: GameMode, tick: u32) -> KickPlan {
    let swing = Swing { ready_at: tick as i32 + run_up_ticks(mode), way: None, mate: None, runs: true };
    KickPlan { swing: Some(swing), until: tick as i32 + PATIENCE_TICKS, ..asked(kind) }
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
        taken: false,
        meet_s: f32::MAX,
        swing: None,
        until: 0,
    }
}

impl KickPlan {
    /// How full the gauge is, 0..1: a key can't be pressed for less than 60 ms. (GRF's.)
    pub fn gauge(&self) -> f32 {
        ((f32::from(self.gauge_ticks) - 6.0) / 94.0).clamp(0.0, 1.0)
    }
}

/// Goes on with every kick that is asked for: gauges fill, swings begin, and whoever has the ball in reach at the end of
/// their swing kicks it; at most one kick a tick. `kicks`: who may have asked for one.
pub fn kick_ball(game: &mut Match, events: &mut Events, kicks: Squad) {
    let now = game.tick as i32;
    let mut kicked = false;
    for id in game.order_of(kicks) {
        let i = id.index();
        let Some(mut plan) = game.players[i].body.kick else { continue };
        if plan.held {
            plan.gauge_ticks = (plan.gauge_ticks + 1).min(GAUGE_TICKS);
            plan.until = now + PATIENCE_TICKS;
        }
        let meet_s = game.players[i].body.meet_s;
        let lost = plan.swing.is_none() && meet_s > plan.meet_s + LOST_S && game.play.set_piece.is_none();
        plan.meet_s = meet_s;
        if now > plan.until || lost || !game.players[i].active {
            game.players[i].body.kick = None;
            continue;
        }
        match plan.swing {
            Some(swing) if now >= swing.ready_at && !kicked && can_kick(game, id) => {
                game.players[i].body.kick = None;
                launch(game, events, id, plan);
                kicked = true;
                continue;
            }
            Some(swing) if now > swing.ready_at + MISSED_TICKS && swing.way.is_some() => plan.swing = None,
            Some(_) => {}
            None => plan.swing = first_time(game, id, &mut plan).or_else(|| begin(game, id, &plan)),
        }
        game.players[i].body.kick = Some(plan);
    }
}

/// Begins the swing of an agent's kick, once the key is let go (or held long enough) and the ball will be in reach at its
/// end.
fn begin(game: &Match, id: PlayerId, plan: &KickPlan) -> Option<Swing> {
    if plan.held && (plan.gauge_ticks <= CHARGE_TICKS || stays(game, plan.kind)) {
        return None;
    }
    let at_hand = game.play.set_piece.is_some() || game.play.hands.is_some();
    let player = game.player(id);
    if !at_hand && (must_take(game, id) || (game.tick as i32) < player.body.turned_at) {
        return None;
    }
    let (way, mate) = meant(game, id, plan);
    let ticks = match game.play.set_piece {
        Some(set_piece) => run_up_ticks(set_piece.mode),
        None if at_hand => at_hand_ticks(plan.kind),
        None => {
            let longest = swing_ticks(player, plan, way);
            soonest(game, id, plan, longest).unwrap_or(longest)
        }
    };
    let reaches = apart(game, id, ticks, BEGIN_PACE).is_some_and(|apart| apart <= BEGIN_M);
    let runs = at_hand || shot::runs(player);
    (at_hand || reaches).then_some(Swing { ready_at: game.tick as i32 + ticks, way: Some(way), mate, runs })
}

/// Whether a player takes the ball before they kick it, or is still taking it: it comes fast, from somebody else.
/// (Measured.)
fn must_take(game: &Match, id: PlayerId) -> bool {
    let player = game.player(id);
    if game.last_touch == Some(id) {
        return (game.tick as i32) < player.body.ready_at;
    }
    let meeting = game.ball.vel.truncate() - player.vel;
    meeting.length_squared() > TAKES_MPS * TAKES_MPS
}

/// Begins the swing at a ball that comes fast, if it will be struck without being taken before: how often that comes off
/// depends on the kick.
fn first_time(game: &mut Match, id: PlayerId, plan: &mut KickPlan) -> Option<Swing> {
    let free = game.play.set_piece.is_none() && game.play.hands.is_none();
    if plan.held || plan.taken || !free || game.last_touch == Some(id) || !must_take(game, id) {
        return None;
    }
    let player = game.player(id);
    let meets = |ticks: &i32| {
        let there = game.play.forecast.at(game.tick + *ticks as u32);
        let place = player.pos + player.vel * (*ticks as f32 * 0.01);
        there.z <= FIRST_TIME_M && place.distance_squared(there.truncate()) < REACH_M * REACH_M
    };
    let ticks = FIRST_TIME_TICKS.step_by(2).find(meets)?;
    let [short, long, high, shot] = FIRST_TIME;
    let often = match plan.kind {
        KickKind::Short => short,
        KickKind::Long => long,
        KickKind::High => high,
        KickKind::Shot | KickKind::Clear => shot,
    };
    plan.taken = !noise::happens(game, often);
    let (way, mate) = meant(game, id, plan);
    let runs = shot::runs(game.player(id));
    (!plan.taken).then_some(Swing { ready_at: game.tick as i32 + ticks, way: Some(way), mate, runs })
}

/// How far a player will be from the ball so many ticks from now, metres; `pace`: what share of their own is left to them
/// meanwhile. None for a ball that will be too high.
fn apart(game: &Match, id: PlayerId, ticks: i32, pace: f32) -> Option<f32> {
    let there = game.play.forecast.at(game.tick + ticks as u32);
    let player = game.player(id);
    let place = player.pos + player.vel * (ticks as f32 * 0.01 * pace);
    (there.z <= LOW_M).then(|| place.distance(there.truncate()))
}

/// Ticks after which a sprinter who shoots reaches the ball, if that is sooner than they would catch up with one just pushed.
fn soonest(game: &Match, id: PlayerId, plan: &KickPlan, longest: i32) -> Option<i32> {
    if plan.kind != KickKind::Shot || game.player(id).vel.length() < RUN_MPS {
        return None;
    }
    (QUICK_TICKS..longest).step_by(2).find(|&ticks| apart(game, id, ticks, 1.0).is_some_and(|apart| apart < REACH_M))
}

/// What a kick is meant for now: the way to it from the ball, world metres, and the mate.
fn meant(game: &Match, id: PlayerId, plan: &KickPlan) -> (Vec2, Option<PlayerId>) {
    let from = game.ball.pos.truncate();
    match plan.kind {
        KickKind::Shot => (shot::meant(game, id, plan) - from, None),
        KickKind::Clear => (plan.dir.unwrap_or(Vec2::new(id.team().side() as f32, 0.0)) * 30.0, None),
        _ => {
            let target = pass_target::choose(game, id, plan);
            (target.point - from, target.mate)
        }
    }
}

/// Whether the taker of a set piece stands for as long as the key is held, however long; a lofted pass and a throw begin.
/// (Measured.)
fn stays(game: &Match, kind: KickKind) -> bool {
    kind != KickKind::High && game.play.set_piece.is_some_and(|set_piece| set_piece.mode != GameMode::ThrowIn)
}

/// Ticks from the beginning of a run-up to the contact at a set piece. Measured.
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

/// Ticks of a swing at a rolling ball. Fitted to the measured steps after which kicks leave: a runner at full speed must
/// catch the ball first, less so the longer they have braked for it; a pass across or behind the body needs a turn.
fn swing_ticks(player: &Player, plan: &KickPlan, way: Vec2) -> i32 {
    let speed = player.vel.length();
    let walks = (speed / RUN_MPS).min(1.0);
    let braked = (f32::from(plan.gauge_ticks) - 10.0) / 30.0;
    let sprints = ((speed - RUN_MPS) / (SPRINT_MPS - RUN_MPS)).clamp(0.0, 1.0) * (1.0 - braked).clamp(0.0, 1.0);
    // [standing, walking, sprinting, less for a leg that is back already]
    let [stand, walk, sprint, back] = match plan.kind {
        KickKind::Short | KickKind::Long => [34.0, 28.0, 38.0, 0.0],
        KickKind::High => [24.0, 22.0, 26.0, 5.0],
        KickKind::Shot | KickKind::Clear => [25.0, 24.0, 54.0, 10.0],
    };
    let straight =
        stand + (walk - stand) * walks + (sprint - walk) * sprints - if plan.held { back * walks } else { 0.0 };
    let degrees = pass::off_run(player, way);
    let turn = match plan.kind {
        KickKind::Shot | KickKind::Clear => 15.0 * walks * ((degrees - 30.0) / 60.0).clamp(0.0, 1.0),
        _ => {
            (15.0 * walks + 6.0 * sprints) * ((degrees - 40.0) / 15.0).clamp(0.0, 1.0)
                + 2.0 * ((degrees - 60.0) / 120.0).clamp(0.0, 1.0)
        }
    };
    (straight + turn) as i32
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
    let stretched = player.body.kick.is_some_and(|plan| plan.swing.is_some_and(|swing| swing.way.is_some()));
    let reach_m = if stretched { STRETCH_M } else { KICK_M };
    if ball.z > VOLLEY_M || player.pos.distance_squared(ball.truncate()) > reach_m * reach_m {
        return false;
    }
    if (game.tick as i32) < player.body.ready_at {
        return false;
    }
    // A rival who dribbles the ball must be tackled first.
    game.controller().is_none_or(|owner| owner.team() == id.team())
}

/// Kicks.
pub(super) fn launch(game: &mut Match, events: &mut Events, id: PlayerId, plan: KickPlan) {
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
    let rough = roughness(game.player(id), game, plan.kind);
    let mut receiver = None;
    match plan.kind {
        KickKind::Shot => {
            let shot = if mode == Some(GameMode::FreeKick) {
                shot::over_wall(game, id, &plan)
            } else {
                shot::struck(game, id, &plan, rough)
            };
            send(game, id, shot);
        }
        KickKind::Clear => {
            let way = plan.dir.unwrap_or(Vec2::new(id.team().side() as f32, 0.0));
            let way = way + Vec2::new(-way.y, way.x) * (noise::bell(game) * 0.25);
            send(game, id, Struck { velocity: (way * 21.0).extend(10.0), spin: Vec3::ZERO });
        }
        _ => {
            let (way, mate) = refined(game, id, &plan);
            receiver = mate;
            let ball = if mode == Some(GameMode::ThrowIn) {
                pass::thrown(game, id, way)
            } else {
                pass::struck(game, id, &plan, way, rough, from_hands)
            };
            send(game, id, ball);
        }
    }
    contact::note(game, id, if exempt { contact::Touch::Exempt } else { contact::Touch::Played });
    // The kicker does not meet his own ball again at once.
    game.players[id.index()].body.ready_at = game.tick as i32 + 30;
    game.players[id.index()].body.follows_until = game.tick as i32 + FOLLOW_TICKS;
    game.mode = GameMode::Normal;
    if let Some(mode) = mode {
        let kind = whistle::event_of(mode);
        events.push(report::event(game, kind).by(id).qualified(Qualifier::Taken));
    }
    match plan.kind {
        KickKind::Shot => contact::shot_struck(game, events, id, from),
        _ => contact::pass_struck(game, events, id, receiver, from),
    }
    forecast::renew(game);
    if let Some(receiver) = receiver {
        switching::hand_to(game, receiver);
    }
    game.players[id.index()].body.touched_at = if exempt { NEVER } else { game.tick as i32 };
}

/// The way of a pass as the foot meets the ball, world metres, and the mate it is for.
///
/// What the keys mean now counts as far as the leg can still be turned to it; what lies further off comes too late. (GRF's.)
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
///
/// Who plays for the team that is not the early one turns it the wrong way: their passes float and their lofted balls and
/// shots dip. (GRF's: the team whose turn is second is played in a turned frame, which the spin is not turned back from.)
fn send(game: &mut Match, id: PlayerId, struck: Struck) {
    let turned = if id.team() == game.play.early { 1.0 } else { -1.0 };
    game.ball.pos.z = game.ball.pos.z.max(0.13);
    game.ball.vel = struck.velocity;
    game.ball.spin = (struck.spin.truncate() * turned).extend(struck.spin.z);
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
    // What a moving ball makes of a shot is reckoned with the shot.
    let moving = if kind == KickKind::Shot { 0.0 } else { ((relative - 4.0) / 25.0).clamp(0.0, 0.7) + high * 0.4 };
    // About 1 for the average player of the table.
    let hurry = 1.3 - 0.4 * player.skill(Stat::Calmness);
    (moving + far * 0.5 + near as f32 * 0.16 * hurry + pushed).clamp(0.0, 1.0)
}
