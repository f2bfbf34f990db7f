//! What a touch of the ball means: passes completed or intercepted, shots blocked, offside.

use crate::football::{forecast, offside, report, whistle};
use crate::math;
use crate::state::event::{Event, Events};
use crate::state::play::{Flight, Received};
use crate::state::{Match, PlayerId};
use glam::{Vec2, Vec3};
use setpiece_scenario::pitch::{BALL_RADIUS_M, TEAM_MAX};
use setpiece_scenario::vocabulary::{EventKind, Qualifier, Role, Team};

/// How much of its spin a ball keeps when it is pushed on. (GRF's.)
const KEPT_SPIN: f32 = 0.4;
/// The topspin of a push, rad/s per m/s, and what it loses at `BACKSPIN_MPS` or more, rad/s, by
/// which power of its speed. (GRF's.)
const TOPSPIN_PER_MPS: f32 = 2.0 * std::f32::consts::PI;
const BACKSPIN: f32 = 30.0;
const BACKSPIN_MPS: f32 = 10.0;
const BACKSPINS: f32 = 0.7;

/// A slower shot no longer counts as a shot, m/s; chosen.
const SPENT_MPS: f32 = 2.0;

/// Records that a player touches the ball. False if the touch was an offence that stops play.
pub fn touched(game: &mut Match, events: &mut Events, by: PlayerId, kick: bool) -> bool {
    if offside::caught(game, events, by) {
        return false;
    }
    let placed = game.play.set_piece.is_some();
    let kind = if placed { EventKind::Touch } else { kind_of_touch(game.ball.pos.z) };
    report::did(game, events, kind, by, None);
    if game.play.kick_off.is_some() {
        events.push(report::event(game, EventKind::Kickoff).by(by).qualified(Qualifier::Taken));
    }
    settle(game, events, by);
    note(game, by, Touch::Played);
    game.play.kicked_by = (placed || kick && game.ball.pos.z < 1.2).then_some(by);
    true
}

/// The event of a touch, by its height.
fn kind_of_touch(height_m: f32) -> EventKind {
    if height_m > 1.5 { EventKind::Header } else { EventKind::Touch }
}

/// Touches the ball so that it leaves with a given velocity.
pub fn push(game: &mut Match, events: &mut Events, id: PlayerId, velocity: Vec2, hop: f32) {
    if !touched(game, events, id, false) {
        return;
    }
    let velocity = velocity.clamp_length_max(14.0);
    // A ball in the air is brought down.
    let fall = if game.ball.pos.z > 0.3 { game.ball.vel.z.min(0.0) - 1.0 } else { 0.0 };
    game.ball.vel = velocity.extend(if hop > 0.0 { hop } else { fall });
    game.ball.pos.z = game.ball.pos.z.max(0.11);
    let spin = spun(game, id, pushed_spin(velocity) * (1.0 - KEPT_SPIN));
    game.ball.spin = game.ball.spin * KEPT_SPIN + spin;
    forecast::renew(game);
}

/// The spin that a push gives a ball, rad/s: less than that of one that rolls.
fn pushed_spin(velocity: Vec2) -> Vec3 {
    let speed = velocity.length();
    let back = BACKSPIN * math::pow((speed / BACKSPIN_MPS).min(1.0), BACKSPINS);
    (velocity.normalize_or_zero().perp() * (TOPSPIN_PER_MPS * speed - back)).extend(0.0)
}

/// The spin that a player's touch gives the ball.
///
/// For the team that isn't the early one it is turned the wrong way: its passes float, its lofted
/// balls and shots dip, and the grass brakes its dribblers' balls more. (GRF's: the team whose turn
/// is second is played in a turned frame, and the spin isn't turned back.)
pub fn spun(game: &Match, id: PlayerId, spin: Vec3) -> Vec3 {
    if id.team() == game.play.early { spin } else { Vec3::new(-spin.x, -spin.y, spin.z) }
}

/// Records that the ball sprang off a player or a keeper's hands: a shot is saved or blocked, and a
/// pass is over.
pub fn sprang(game: &mut Match, events: &mut Events, by: PlayerId) {
    if let Some(shot) = game.play.shot.take_if(|shot| shot.by.team() != by.team()) {
        let saved = game.player(by).role == Role::GK;
        if saved {
            report::did(game, events, EventKind::Save, by, Some(shot.by));
        }
        let verdict = if saved { Qualifier::OnTarget } else { Qualifier::Blocked };
        events.push(of_shot(game, EventKind::Shot, shot).qualified(verdict));
    }
    report::did(game, events, EventKind::Touch, by, None);
    game.play.pass = game.play.pass.filter(|pass| pass.by == by);
    note(game, by, Touch::Sprang);
    game.play.kicked_by = None;
}

/// Ends the pass or shot under way at its next touch.
fn settle(game: &mut Match, events: &mut Events, by: PlayerId) {
    let ball = game.ball.pos.truncate();
    if let Some(pass) = game.play.pass {
        if pass.by != by {
            let (qualifier, mate) = if pass.by.team() == by.team() {
                (Qualifier::Completed, true)
            } else {
                (Qualifier::Intercepted, false)
            };
            let length = ball.distance(pass.from);
            events.push(
                report::event(game, EventKind::Pass)
                    .by(pass.by)
                    .to(Some(by))
                    .qualified(qualifier)
                    .length(length),
            );
            if mate {
                game.play.received = Some(Received { from: pass.by, by, length_m: length });
            } else {
                report::did(game, events, EventKind::Interception, by, Some(pass.by));
            }
            game.play.pass = None;
        } else if game.tick > pass.tick + 20 {
            game.play.pass = None;
        }
    }
    if let Some(shot) = game.play.shot {
        if shot.by.team() != by.team() {
            // A shot that was already too slow wasn't blocked.
            let spent = game.ball.vel.length() < SPENT_MPS;
            let verdict = if spent { Qualifier::OffTarget } else { Qualifier::Blocked };
            events.push(of_shot(game, EventKind::Shot, shot).qualified(verdict));
            game.play.shot = None;
        } else if shot.by != by || game.tick > shot.tick + 20 {
            game.play.shot = None;
        }
    }
}

/// What a touch means for the offside rule.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Touch {
    /// The ball was played: offside positions are judged again.
    Played,
    /// The ball bounced off a player or a keeper's hands. That doesn't play opponents onside.
    Sprang,
    /// A throw-in, corner or goal kick: nobody is offside.
    Exempt,
}

/// Records the last toucher, and who is offside from now on.
pub fn note(game: &mut Match, by: PlayerId, touch: Touch) {
    // A kick is noted again once the ball has left.
    if game.last_touch != Some(by) || game.player(by).body.touched_at != game.tick as i32 {
        game.play.unseen = [game.ball.pos.truncate(), game.ball.vel.truncate()];
    }
    game.play.received = game.play.received.filter(|pass| pass.by == by);
    game.last_touch = Some(by);
    game.play.lead = by.team();
    game.players[by.index()].body.touched_at = game.tick as i32;
    whistle::end_kick_off(game);
    game.play.offside = match touch {
        Touch::Exempt => 0,
        Touch::Sprang if game.play.offside & team_bits(by.team().other()) != 0 => game.play.offside,
        Touch::Sprang | Touch::Played => offside::positions(game, by),
    };
}

/// A team's players, one bit each.
fn team_bits(team: Team) -> u32 {
    ((1 << TEAM_MAX) - 1) << (team.index() * TEAM_MAX)
}

/// Reports that a pass was struck.
pub fn pass_struck(
    game: &mut Match,
    events: &mut Events,
    by: PlayerId,
    to: Option<PlayerId>,
    from: Vec2,
) {
    let length = to.map_or(0.0, |to| game.player(to).pos.distance(from));
    game.play.pass = Some(Flight { by, to, from, tick: game.tick });
    game.play.shot = None;
    events.push(
        report::event(game, EventKind::Pass)
            .by(by)
            .to(to)
            .qualified(Qualifier::Attempted)
            .length(length),
    );
}

/// Reports that a shot was struck.
pub fn shot_struck(game: &mut Match, events: &mut Events, by: PlayerId, from: Vec2) {
    game.play.pass = None;
    let shot = Flight { by, to: None, from, tick: game.tick };
    game.play.shot = Some(shot);
    events.push(of_shot(game, EventKind::Shot, shot));
}

/// An event about a shot. Its place and length are those of the strike, whatever happened to the
/// shot later.
pub fn of_shot(game: &Match, kind: EventKind, shot: Flight) -> Event {
    let goal = game.goal() * shot.by.team().side() as f32;
    let at = shot.from.extend(BALL_RADIUS_M as f32);
    report::event(game, kind).by(shot.by).at(at).length(goal.distance(shot.from))
}
