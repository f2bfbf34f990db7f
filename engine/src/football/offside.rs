//! Offside: which players are beyond the line when the ball is touched, and who is caught at their
//! next touch.

use crate::football::{advantage, report, whistle};
use crate::state::event::Events;
use crate::state::{Match, PlayerId};
use glam::Vec2;
use setpiece_scenario::vocabulary::{EventKind, GameMode, Rule, Team};

/// A free kick for offside is taken at least this far inside the goal lines and the side lines,
/// metres.
const INSIDE_M: Vec2 = Vec2::new(3.0, 2.0);

/// The attackers' offside line, x in their own frame, metres: the second-last opponent or the ball,
/// never in their own half.
pub fn line(game: &Match, attackers: Team) -> f32 {
    line_in(game, attackers, 0.0)
}

/// The offside line a moment from now if everybody runs on; otherwise like [`line()`].
pub fn line_in(game: &Match, attackers: Team, ahead_s: f32) -> f32 {
    let side = attackers.side() as f32;
    let (mut last, mut second) = (f32::MIN, f32::MIN);
    for (_, rival) in game.team(attackers.other()) {
        let x = (rival.pos.x + rival.vel.x * ahead_s) * side;
        if x > last {
            second = last;
            last = x;
        } else if x > second {
            second = x;
        }
    }
    second.max(game.ball.pos.x * side).max(0.0)
}

/// Whether nobody can be offside at this kind of restart.
pub fn exempt(mode: GameMode) -> bool {
    matches!(mode, GameMode::ThrowIn | GameMode::Corner | GameMode::GoalKick)
}

/// The toucher's teammates who are beyond the line now, one bit each.
pub fn positions(game: &Match, toucher: PlayerId) -> u32 {
    if !game.rule(Rule::Offside) {
        return 0;
    }
    let team = toucher.team();
    let side = team.side() as f32;
    let line = line(game, team);
    game.team(team)
        .filter(|(id, player)| *id != toucher && player.pos.x * side > line)
        .fold(0, |bits, (id, _)| bits | 1 << id.0)
}

/// Calls offside if the toucher was in an offside position; play stops then.
pub fn caught(game: &mut Match, events: &mut Events, by: PlayerId) -> bool {
    let several = game.team(by.team().other()).count() > 1;
    if game.play.offside & (1 << by.0) == 0 || !several || !game.rule(Rule::Offside) {
        return false;
    }
    if advantage::called_back(game, events) {
        return true;
    }
    report::did(game, events, EventKind::Offside, by, None);
    let most = game.half() - INSIDE_M;
    let spot = game.player(by).pos.clamp(-most, most);
    whistle::stop(game, events, GameMode::FreeKick, by.team().other(), spot);
    true
}
