//! What players want to do: agents' actions, the built-in bot, and who is whose.
//!
//! Decides every player's intent and planned kick at the start of a step; leaves to `football` what comes of them.
//! Inside: [`sticky`] keeps held actions, [`switching`] gives slots their players, [`driver`] turns an agent's actions
//! into intents (with [`assist`], GRF's magnet), [`behavior`] chooses such actions for scripted players, [`bot`] plays
//! everyone else, [`agents`] are ready-made agents.

pub mod agents;
pub mod assist;
pub mod behavior;
pub mod bot;
pub mod driver;
pub mod sticky;
pub mod switching;

use crate::event::Events;
use crate::football::{forecast, reach};
use crate::state::{Match, PlayerId};

use setpiece_scenario::vocabulary::{Action, Rule};

pub use bot::bot_action;

/// Steps that a set piece may wait for an agent.
const STALLING_STEPS: u16 = 20;

/// Before a step: who can be at the ball first, and which player each agent has in it.
pub fn prepare(game: &mut Match) {
    forecast::refresh(game);
    reach::assess(game);
    switching::update(game);
}

/// Takes the agents' actions and lets the bots decide: every intent of the step.
pub fn command(game: &mut Match, actions: &[Action], events: &mut Events) {
    game.play.led = [false; 2];
    game.play.driven = 0;
    for acting in &mut game.play.acting {
        acting.played = None;
    }
    let slots = game.agents.len();
    for slot in 0..slots {
        let action = actions.get(slot).copied().unwrap_or(Action::Idle);
        let agent = &mut game.agents[slot];
        agent.sticky = sticky::next(agent.sticky, action);
        if action != Action::BuiltinAi {
            game.play.led[agent.team.index()] = true;
            if let Some(id) = agent.player {
                game.play.driven |= 1 << id.0;
            }
        }
    }
    for (team, slot) in game.teams().into_iter().flat_map(|team| (0..slots).map(move |slot| (team, slot))) {
        let agent = game.agents[slot];
        if agent.team != team {
            continue;
        }
        let action = actions.get(slot).copied().unwrap_or(Action::Idle);
        if let Some(id) = agent.player.filter(|id| action != Action::BuiltinAi && game.player(*id).active) {
            game.play.acting[id.index()].played = Some(action);
            let action = hurry(game, id, action);
            driver::drive(game, events, id, agent.sticky, action);
        }
    }
    drive_scripted(game, events);
    bot::think(game, events);
}

/// Drives everyone for whom a behaviour has chosen an action and whom no agent drives.
fn drive_scripted(game: &mut Match, events: &mut Events) {
    for id in game.order() {
        let i = id.index();
        let bit = 1 << i;
        let free = game.players[i].active && game.play.driven & bit == 0;
        let acting = &mut game.play.acting[i];
        let Some(action) = acting.chosen.take().filter(|_| free) else {
            acting.sticky = 0;
            continue;
        };
        acting.sticky = sticky::next(acting.sticky, action);
        acting.played = Some(action);
        if action != Action::BuiltinAi {
            let held = acting.sticky;
            game.play.driven |= bit;
            let action = hurry(game, id, action);
            driver::drive(game, events, id, held, action);
        }
    }
}

/// A set piece that an agent doesn't take is taken for it.
fn hurry(game: &Match, id: PlayerId, action: Action) -> Action {
    let late =
        game.play.set_piece.is_some_and(|set_piece| set_piece.taker == id && set_piece.waited_steps >= STALLING_STEPS);
    if late && game.rule(Rule::AntiStalling) { Action::ShortPass } else { action }
}
