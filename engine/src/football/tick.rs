//! One tick of 10 ms, in order.

use crate::football::{
    advantage, duel, forecast, keeper, kick, movement, past, possession, reach, referee, report,
    separation, slide, touch, whistle,
};
use crate::laps::Phase;
use crate::physics::{self, Contact, Scratch};
use crate::state::Match;
use crate::state::event::Events;
use glam::{Vec2, Vec3};
use setpiece_scenario::vocabulary::{EventKind, PitchMeasure, Rule};

/// How long opponents keep out of the circle while the kick-off isn't taken, ticks: as long as a
/// set piece waits for an agent.
const KICK_OFF_TICKS: u32 = 200;

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
    let about = touch::about(game);
    duel::contest(game, events, busy.legs, about);
    if !touch::play_ball(game, events, near, about) {
        past::off_body(game, events);
    }
    scratch.laps().end(Phase::Play);
    if !game.dead {
        let before = game.ball.pos;
        move_ball(game, events, scratch);
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
fn move_ball(game: &mut Match, events: &mut Events, scratch: &mut Scratch) {
    if game.play.hands.is_some() {
        return;
    }
    if let Some(set_piece) = game.play.set_piece {
        game.ball.pos = set_piece.spot.extend(game.ball.pos.z);
        game.ball.vel = Vec3::ZERO;
        return;
    }
    let full = game.rule(Rule::Physics);
    let (pitch, conditions) = (&game.pitch, &game.conditions);
    let met = physics::advance_ball(&mut game.ball, pitch, conditions, full, scratch);
    if met == Some(Contact::Woodwork) {
        let event = report::event(game, EventKind::Woodwork);
        events.push(match game.last_touch {
            Some(id) => event.by(id),
            None => event,
        });
    }
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
