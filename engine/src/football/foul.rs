//! Fouls and cards: what a trip costs.

use crate::event::Events;
use crate::football::{noise, referee, report};
use crate::state::{Match, PlayerId};
use glam::Vec2;
use setpiece_scenario::pitch::{BOX_DEPTH_M, BOX_HALF_WIDTH_M, HALF_LENGTH_M, PENALTY_SPOT_M};
use setpiece_scenario::vocabulary::{EventKind, GameMode, Role, Rule, Stat, Team};

/// Severity above which a foul earns a yellow card.
const YELLOW: f32 = 1.4;
/// Severity above which a foul earns a red card.
const RED: f32 = 1.97;

/// Whether a failed tackle brings the victim down.
pub fn trips(game: &mut Match, id: PlayerId, rival: PlayerId) -> bool {
    let clumsy = 1.25 - game.player(id).skill(Stat::StandingTackle);
    let steady = 0.5 + 0.5 * game.player(rival).skill(Stat::Balance);
    let chance = 0.035 * clumsy / steady;
    noise::roll(game) < chance && game.rule(Rule::Stochastic)
}

/// Calls a foul of a severity: below 1 nothing, then a free kick or penalty, cards by severity.
pub fn call(game: &mut Match, events: &mut Events, by: PlayerId, victim: PlayerId, severity: f32) {
    if !game.rule(Rule::Fouls) || severity <= 1.0 || game.dead {
        return;
    }
    report::did(game, events, EventKind::Foul, by, Some(victim));
    if game.rule(Rule::Cards) {
        if severity > RED {
            dismiss(game, events, by);
        } else if severity > YELLOW {
            caution(game, events, by);
        }
    }
    let spot = game.player(victim).pos;
    let team = victim.team();
    if in_box(spot, by.team()) && game.rule(Rule::Penalties) {
        let side = team.side() as f32;
        let penalty = Vec2::new((HALF_LENGTH_M - PENALTY_SPOT_M) as f32 * side, 0.0);
        referee::stop(game, events, GameMode::Penalty, team, penalty);
    } else {
        let spot = spot.clamp(Vec2::new(-52.0, -34.5), Vec2::new(52.0, 34.5));
        referee::stop(game, events, GameMode::FreeKick, team, spot);
    }
}

/// Whether a point is in a team's penalty box.
pub fn in_box(point: Vec2, team: Team) -> bool {
    let depth = (HALF_LENGTH_M - BOX_DEPTH_M) as f32;
    -point.x * team.side() as f32 > depth && point.y.abs() < BOX_HALF_WIDTH_M as f32
}

/// Shows yellow; the second sends off.
fn caution(game: &mut Match, events: &mut Events, by: PlayerId) {
    report::did(game, events, EventKind::YellowCard, by, None);
    let player = &mut game.players[by.index()];
    player.yellow_cards = player.yellow_cards.saturating_add(1);
    if player.yellow_cards >= 2 {
        dismiss(game, events, by);
    }
}

/// Sends a player off, unless he is the last of his team.
fn dismiss(game: &mut Match, events: &mut Events, by: PlayerId) {
    report::did(game, events, EventKind::RedCard, by, None);
    if game.team(by.team()).count() <= 1 {
        return;
    }
    let player = &mut game.players[by.index()];
    player.active = false;
    player.vel = Vec2::ZERO;
    player.body.kick = None;
    if player.role == Role::GK {
        // The first mate left goes in goal.
        let heir = game.team(by.team()).map(|(id, _)| id).next();
        if let Some(heir) = heir {
            game.players[heir.index()].role = Role::GK;
        }
    }
    if game.owner == Some(by) {
        game.owner = None;
    }
    for slot in &mut game.agents {
        if slot.player == Some(by) && !slot.fixed {
            slot.player = None;
        }
    }
}
