//! The referee: goals and balls out of play. Stops play and names the restart.

use crate::football::{advantage, contact, report, whistle};
use crate::physics::{self, Line};
use crate::state::event::Events;
use crate::state::{Match, PlayerId};
use glam::{Vec2, Vec3};
use setpiece_scenario::vocabulary::{EventKind, GameMode, PitchMeasure, Qualifier, Team};

/// A throw-in is taken at least this far from a goal line, metres. (GRF's.)
const THROW_IN_X_M: f64 = 0.6;

/// Judges a tick in which the ball came from `before`.
pub fn judge(game: &mut Match, events: &mut Events, before: Vec3) {
    if game.dead || game.play.set_piece.is_some() {
        return;
    }
    if let Some(goal_of) = physics::crossed_goal_line(&game.pitch, before, game.ball.pos) {
        goal(game, events, goal_of.other());
    } else if let Some(line) = physics::left_pitch(&game.pitch, game.ball.pos)
        && !advantage::called_back(game, events)
    {
        out(game, events, line);
    }
}

/// Awards a goal.
fn goal(game: &mut Match, events: &mut Events, scorers: Team) {
    let shot = game.play.shot.take().filter(|shot| shot.by.team() == scorers);
    if let Some(shot) = shot {
        events.push(contact::of_shot(game, EventKind::Shot, shot).qualified(Qualifier::OnTarget));
    }
    let scorer = game.last_touch;
    let score = &mut game.score[scorers.index()];
    *score = score.saturating_add(1);
    let mut base = report::event(game, EventKind::Goal).team(scorers);
    if let Some(shot) = shot {
        let struck = contact::of_shot(game, EventKind::Goal, shot);
        base = base.at(struck.at).length(struck.length_m);
    }
    if let Some(id) = scorer.filter(|id| id.team() != scorers) {
        let own = report::event(game, EventKind::OwnGoal).team(scorers);
        events.push(own.by(id));
    }
    events.push(match scorer {
        Some(id) => base.by(id),
        None => base,
    });
    let received = game.play.received.filter(|pass| pass.by.team() == scorers);
    if let Some(pass) = received.filter(|pass| scorer == Some(pass.by)) {
        let assist = report::event(game, EventKind::Assist).by(pass.from).to(scorer);
        events.push(assist.length(pass.length_m));
    }
    if game.play.advantage.is_some_and(|advantage| advantage.restart.team == scorers) {
        advantage::played(game, events);
    }
    whistle::stop(game, events, GameMode::KickOff, scorers.other(), Vec2::ZERO);
}

/// Handles a ball that left the pitch.
fn out(game: &mut Match, events: &mut Events, line: Line) {
    let (ball, half) = (game.ball.pos, game.half());
    if let Some(shot) = game.play.shot.take() {
        events.push(contact::of_shot(game, EventKind::Shot, shot).qualified(Qualifier::OffTarget));
    }
    let last = game.last_touch.map_or(game.play.lead, PlayerId::team);
    let out = report::event(game, EventKind::OutOfPlay);
    events.push(match game.last_touch {
        Some(id) => out.by(id),
        None => out,
    });
    if let Line::Goal(defenders) = line {
        if last == defenders {
            let top = if ball.y < 0.0 { -1.0 } else { 1.0 };
            let corner = Vec2::new(half.x * ball.x.signum(), half.y * top);
            whistle::stop(game, events, GameMode::Corner, defenders.other(), corner);
        } else {
            let ahead = game.pitch.measure(PitchMeasure::GoalKickSpot);
            let spot = (game.pitch.half_length() - ahead) as f32 * ball.x.signum();
            let spot = Vec2::new(spot, 0.0);
            whistle::stop(game, events, GameMode::GoalKick, defenders, spot);
        }
    } else {
        let most = (game.pitch.half_length() - THROW_IN_X_M) as f32;
        let spot = Vec2::new(ball.x.clamp(-most, most), half.y * ball.y.signum());
        whistle::stop(game, events, GameMode::ThrowIn, last.other(), spot);
    }
}
