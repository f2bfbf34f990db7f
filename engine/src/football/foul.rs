//! Fouls and cards: the price of a trip or a handball.

use crate::football::{advantage, noise, report, whistle};
use crate::state::event::Events;
use crate::state::play::Restart;
use crate::state::{Match, PlayerId};
use glam::Vec2;
use setpiece_scenario::PitchSize;
use setpiece_scenario::vocabulary::{EventKind, GameMode, PitchMeasure, Role, Rule, Team};
use std::ops::Range;

/// Severities above which a foul earns a yellow, and a red card. (GRF's.)
const YELLOW: f32 = 1.4;
const RED: f32 = 2.0;
/// A free kick is taken at least this far inside the goal lines and the side lines, metres.
const INSIDE_M: Vec2 = Vec2::new(3.0, 1.5);
/// The ball meets a player's arms at these heights, metres.
const ARMS_M: Range<f32> = 0.6..1.5;
/// The probability that a ball at this height hits an arm.
const HANDBALL: f32 = 0.04;

/// Calls a foul. Below severity 1 nothing happens; above, a free kick or penalty, and cards by
/// severity.
pub fn call(game: &mut Match, events: &mut Events, by: PlayerId, victim: PlayerId, severity: f32) {
    if let Some(restart) = note(game, events, by, victim, severity) {
        whistle::stop(game, events, restart.mode, restart.team, restart.spot);
    }
}

/// Calls a foul by a standing player, which may be let run if it isn't worth a card or a penalty.
pub fn call_or_let_run(
    game: &mut Match,
    events: &mut Events,
    by: PlayerId,
    victim: PlayerId,
    severity: f32,
) {
    match note(game, events, by, victim, severity) {
        Some(restart) if restart.mode == GameMode::FreeKick && severity <= YELLOW => {
            advantage::wait(game, by, victim, restart);
        }
        Some(restart) => whistle::stop(game, events, restart.mode, restart.team, restart.spot),
        None => {}
    }
}

/// Calls a handball, rarely, if the ball has bounced off a player at arm height. `shot`: the ball
/// was an opponent's shot, which earns a yellow card.
pub fn handball(game: &mut Match, events: &mut Events, by: PlayerId, shot: bool) {
    let (spot, height) = (game.ball.pos.truncate(), game.ball.pos.z);
    let own_keeper = game.player(by).role == Role::GK && in_box(&game.pitch, spot, by.team());
    if !game.rule(Rule::Handball) || game.dead || own_keeper || !ARMS_M.contains(&height) {
        return;
    }
    if !noise::happens(game, HANDBALL) {
        return;
    }
    report::did(game, events, EventKind::Handball, by, None);
    if shot && game.rule(Rule::Cards) {
        caution(game, events, by);
    }
    let restart = award(game, spot, by.team());
    whistle::stop(game, events, restart.mode, restart.team, restart.spot);
}

/// Calls a keeper who held the ball for too long: a free kick from the edge of the box.
pub fn held_too_long(game: &mut Match, events: &mut Events, by: PlayerId) {
    let (team, pos) = (by.team().other(), game.player(by).pos);
    let edge = box_edge(&game.pitch) * team.side() as f32;
    game.play.hands = None;
    whistle::stop(game, events, GameMode::FreeKick, team, Vec2::new(edge, pos.y));
}

/// Reports a foul, shows its card, and returns the restart if it is one.
fn note(
    game: &mut Match,
    events: &mut Events,
    by: PlayerId,
    victim: PlayerId,
    severity: f32,
) -> Option<Restart> {
    if !game.rule(Rule::Fouls) || severity <= 1.0 || game.dead {
        return None;
    }
    report::did(game, events, EventKind::Foul, by, Some(victim));
    if game.rule(Rule::Cards) {
        if severity > RED {
            dismiss(game, events, by);
        } else if severity > YELLOW {
            caution(game, events, by);
        }
    }
    Some(award(game, game.player(victim).pos, by.team()))
}

/// The penalty or free kick for an offence at a place.
fn award(game: &Match, spot: Vec2, offenders: Team) -> Restart {
    let team = offenders.other();
    if in_box(&game.pitch, spot, offenders) && game.rule(Rule::Penalties) {
        let ahead = game.pitch.measure(PitchMeasure::PenaltySpot);
        let x = (game.pitch.half_length() - ahead) as f32 * team.side() as f32;
        Restart { mode: GameMode::Penalty, team, spot: Vec2::new(x, 0.0) }
    } else {
        let most = game.half() - INSIDE_M;
        let spot = spot.clamp(-most, most);
        Restart { mode: GameMode::FreeKick, team, spot }
    }
}

/// How far the penalty boxes' edges are from the halfway line, metres.
fn box_edge(pitch: &PitchSize) -> f32 {
    (pitch.half_length() - pitch.measure(PitchMeasure::BoxDepth)) as f32
}

/// Whether a point is in a team's penalty box.
pub fn in_box(pitch: &PitchSize, point: Vec2, team: Team) -> bool {
    let half_width = pitch.measure(PitchMeasure::BoxHalfWidth) as f32;
    -point.x * team.side() as f32 > box_edge(pitch) && point.y.abs() < half_width
}

/// Shows a yellow card. A second one sends the player off, so the last player of a team doesn't get
/// it.
fn caution(game: &mut Match, events: &mut Events, by: PlayerId) {
    if game.player(by).yellow_cards > 0 && game.team(by.team()).count() <= 1 {
        return;
    }
    report::did(game, events, EventKind::YellowCard, by, None);
    let player = &mut game.players[by.index()];
    player.yellow_cards = player.yellow_cards.saturating_add(1);
    if player.yellow_cards >= 2 {
        dismiss(game, events, by);
    }
}

/// Sends a player off, unless nobody else is left in the team.
fn dismiss(game: &mut Match, events: &mut Events, by: PlayerId) {
    if game.team(by.team()).count() <= 1 {
        return;
    }
    report::did(game, events, EventKind::RedCard, by, None);
    let player = &mut game.players[by.index()];
    player.active = false;
    player.vel = Vec2::ZERO;
    player.body.kick = None;
    replace_keeper(game, by.team());
    if game.owner == Some(by) {
        game.owner = None;
    }
    for slot in &mut game.agents {
        if slot.player == Some(by) && !slot.fixed {
            slot.player = None;
        }
    }
}

/// Puts the first remaining teammate in goal if all keepers of a team have been sent off.
pub fn replace_keeper(game: &mut Match, team: Team) {
    let mut sent_off = None;
    for id in game.squad.of(team).ids() {
        let player = game.player(id);
        if player.role == Role::GK && player.active {
            return;
        }
        if player.role == Role::GK {
            sent_off = sent_off.or(Some(player.body));
        }
    }
    let successor = game.team(team).map(|(id, _)| id).next();
    if let (Some(keeper), Some(successor)) = (sent_off, successor) {
        let player = &mut game.players[successor.index()];
        player.role = Role::GK;
        player.body.kickoff = keeper.kickoff;
        player.body.mind.slot = keeper.mind.slot;
    }
}
