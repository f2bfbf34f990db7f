//! One tick of 10 ms, in order.

use crate::football::{
    advantage, contact, duel, forecast, foul, keeper, kick, movement, offside, possession, reach,
    referee, report, separation, slide, touch, whistle,
};
use crate::laps::Phase;
use crate::physics::{self, BallObstacle, Contact, Scratch};
use crate::state::event::Events;
use crate::state::play::ticks_since;
use crate::state::player::Swing;
use crate::state::{Match, PlayerId, Squad};
use arrayvec::ArrayVec;
use glam::{Vec2, Vec3};
use setpiece_scenario::pitch::PLAYERS_MAX;
use setpiece_scenario::vocabulary::{EventKind, PitchMeasure, Role, Rule};

/// How long opponents keep out of the circle while the kick-off isn't taken, ticks: as long as a
/// set piece waits for an agent.
const KICK_OFF_TICKS: u32 = 200;
/// The most bodies that the ball can meet in a tick.
const BODIES_MAX: usize = 8;

/// Plays one tick.
pub fn advance(game: &mut Match, events: &mut Events, scratch: &mut Scratch) {
    forecast::refresh(game);
    let even = game.tick.is_multiple_of(2);
    if even {
        reach::refresh(game);
    }
    scratch.laps().end(Phase::Reach);
    if even {
        separation::separate(game, events);
    }
    let busy = movement::advance(game);
    keep_circle(game);
    scratch.laps().end(Phase::Movement);
    keeper::use_hands(game, events);
    slide::resolve(game, events, busy.slides);
    kick::kick_ball(game, events, busy.kicks);
    let near = touch::near(game);
    duel::contest(game, events, busy.legs, touch::about(game));
    touch::play_ball(game, events, near);
    scratch.laps().end(Phase::Play);
    if !game.dead {
        let before = game.ball.pos;
        move_ball(game, events, scratch, near);
        scratch.laps().end(Phase::Physics);
        possession::update(game, events);
        referee::judge(game, events, before);
        if !game.dead {
            advantage::watch(game, events);
        }
        scratch.laps().end(Phase::Referee);
    }
    game.tick += 1;
}

/// Moves a ball that nobody holds.
fn move_ball(game: &mut Match, events: &mut Events, scratch: &mut Scratch, near: Squad) {
    if game.play.hands.is_some() {
        return;
    }
    if let Some(set_piece) = game.play.set_piece {
        game.ball.pos = set_piece.spot.extend(game.ball.pos.z);
        game.ball.vel = Vec3::ZERO;
        return;
    }
    let bodies = near_bodies(game, near);
    let full = game.rule(Rule::Physics);
    let (pitch, conditions) = (&game.pitch, &game.conditions);
    match physics::advance_ball(&mut game.ball, pitch, conditions, &bodies, full, scratch) {
        Some(Contact::Woodwork) => {
            let event = report::event(game, EventKind::Woodwork);
            events.push(match game.last_touch {
                Some(id) => event.by(id),
                None => event,
            });
            game.play.save = [None; 2];
        }
        Some(Contact::Body(i)) if (i as usize) < PLAYERS_MAX => {
            let by = PlayerId(i);
            // A player hit by the ball has touched it.
            if offside::caught(game, events, by) {
                return;
            }
            let shot = game.play.shot.is_some_and(|shot| shot.by.team() != by.team());
            contact::deflected(game, events, by);
            foul::handball(game, events, by, shot);
            forecast::renew(game);
        }
        _ => {}
    }
}

/// The bodies among those nearby that a free, fast ball may meet in this tick.
fn near_bodies(game: &Match, near: Squad) -> ArrayVec<BallObstacle, BODIES_MAX> {
    let mut bodies = ArrayVec::new();
    let ball = game.ball;
    if ball.vel.length_squared() < 25.0 || ball.pos.z > 2.3 || game.controller().is_some() {
        return bodies;
    }
    let flat = ball.pos.truncate();
    for id in game.order_of(near) {
        let player = game.player(id);
        if !player.active || bodies.is_full() {
            continue;
        }
        let lately = ticks_since(game.tick, player.body.touched_at) < 30;
        // In the box a keeper meets the ball with the hands or not at all.
        let planned = game.play.save[id.team().index()]
            .is_some_and(|save| !save.reaches || save.at_tick != u32::MAX);
        let by_hand =
            planned && player.role == Role::GK && foul::in_box(&game.pitch, flat, id.team());
        // Whoever swings at the ball lets it come to the foot.
        let swings = player
            .body
            .kick
            .and_then(|plan| plan.swing)
            .is_some_and(|swing| swing.end_dmps != Swing::RUN);
        if !lately && !by_hand && !swings {
            bodies.push(BallObstacle {
                id: id.0,
                pos: player.pos,
                vel: player.vel,
                height_m: player.body.height_m,
            });
        }
    }
    bodies
}

/// Keeps opponents out of the centre circle until the kick-off has been taken.
fn keep_circle(game: &mut Match) {
    let Some(team) = game.play.kick_off.filter(|_| game.rule(Rule::KickoffCircle)) else { return };
    let waited = game.tick.saturating_sub(game.play.kick_off_tick);
    if game.rule(Rule::AntiStalling) && waited > KICK_OFF_TICKS {
        // A team that doesn't take the kick-off in time gives it up.
        whistle::end_kick_off(game);
        return;
    }
    let radius = game.measure(PitchMeasure::Circle);
    game.each(game.squad.of(team.other()), |player| {
        if player.pos.length() < radius {
            player.pos =
                player.pos.normalize_or(Vec2::new(-(team.other().side() as f32), 0.0)) * radius;
        }
    });
}
