//! What players want to do: agents' actions and the built-in bot.
//!
//! Decides every player's intent and planned kick at the start of a step. `football` plays them
//! out.
//!
//! - [`sticky`] keeps held actions.
//! - [`driver`] turns an agent's actions into intents, with [`assist`], GRF's magnet.
//! - [`continuous`] reads continuous actions.
//! - [`behavior`] chooses actions for scripted players.
//! - [`bot`] plays everyone else, and [`tell`] expresses its play as actions.
//! - [`agents`] are ready-made agents.

pub mod agents;
pub mod assist;
pub mod behavior;
pub mod bot;
pub mod continuous;
pub mod driver;
pub mod sticky;
pub mod tell;

use crate::football::switching;
use crate::state::event::Events;
use crate::state::play::Acting;
use crate::state::player::KickKind;
use crate::state::{AgentSlot, Match, PlayerId};

use arrayvec::ArrayVec;
use setpiece_scenario::Ai;
use setpiece_scenario::pitch::PLAYERS_MAX;
use setpiece_scenario::vocabulary::{Action, Rule};
use tell::BeforeBots;

/// Steps that a set piece waits for an agent. (GRF's: the twentieth is hurried.)
const STALLING_STEPS: u16 = 19;

/// Applies the agents' actions and lets the bots decide. Sets every intent of the step, and which
/// key everyone pressed for it.
pub fn command(game: &mut Match, actions: &[Action], events: &mut Events) {
    let before = decide(game, actions, events);
    tell::record(game, &before);
}

/// The action that the bot would press for each agent if it played all of them now, by slot,
/// relative to the held actions. `game` holds the decided state afterwards and is no longer usable.
///
/// [`Action::Idle`] for an agent without a player. A player with a behaviour gets the behaviour's
/// action.
pub fn bot_actions(game: &mut Match) -> ArrayVec<Action, PLAYERS_MAX> {
    let held: ArrayVec<u16, PLAYERS_MAX> = game.agents.iter().map(|slot| slot.sticky).collect();
    let handed = [Action::BuiltinAi; PLAYERS_MAX];
    let before = decide(game, &handed, &mut Events::new());
    let press = |(slot, held): (&AgentSlot, &u16)| {
        let Some(id) = slot.player.filter(|id| game.player(*id).active) else {
            return Action::Idle;
        };
        let scripted =
            game.play.acting[id.index()].played.filter(|action| *action != Action::BuiltinAi);
        scripted.unwrap_or_else(|| tell::tell(game, &before, id, *held).press)
    };
    game.agents.iter().zip(&held).map(press).collect()
}

/// Decides every intent of the step, and returns what was under way before the bots decided.
fn decide(game: &mut Match, actions: &[Action], events: &mut Events) -> BeforeBots {
    game.play.led = [false; 2];
    game.play.rush = [false; 2];
    game.play.team_pressure = [false; 2];
    game.play.driven = 0;
    for acting in &mut game.play.acting {
        acting.played = None;
    }
    let slots = game.agents.len();
    for slot in 0..slots {
        let action = actions.get(slot).copied().unwrap_or(Action::Idle);
        if action == Action::Switch {
            switching::press(game, slot);
        }
        let agent = &mut game.agents[slot];
        agent.sticky = sticky::next(agent.sticky, action);
        if sticky::unsteers(action) {
            agent.steer = None;
        }
        let player = agent.player.filter(|id| game.players[id.index()].active);
        if let Some(id) = player.filter(|_| action != Action::BuiltinAi) {
            let team = agent.team.index();
            game.play.led[team] = true;
            game.play.rush[team] |= sticky::rushes(agent.sticky);
            game.play.team_pressure[team] |= sticky::team_presses(agent.sticky);
            game.play.driven |= 1 << id.0;
        }
    }
    for (team, slot) in
        game.teams().into_iter().flat_map(|team| (0..slots).map(move |slot| (team, slot)))
    {
        let agent = game.agents[slot];
        if agent.team != team {
            continue;
        }
        let action = actions.get(slot).copied().unwrap_or(Action::Idle);
        if let Some(id) =
            agent.player.filter(|id| action != Action::BuiltinAi && game.player(*id).active)
        {
            let acting = &mut game.play.acting[id.index()];
            *acting =
                Acting { played: Some(action), key: None, sticky: agent.sticky, chosen: None };
            let held = driver::Held { sticky: agent.sticky, steer: agent.steer, key: agent.key };
            game.agents[slot].key =
                driver::drive(game, events, id, held, hurry(game, id, action, held.key));
        } else {
            game.agents[slot].key = None;
            // A player handed to the bot holds no key.
            if let Some(plan) =
                agent.player.and_then(|id| game.players[id.index()].body.kick.as_mut())
            {
                plan.held = false;
            }
        }
    }
    drive_scripted(game, events);
    let before = BeforeBots::of(game);
    bot::think(game);
    before
}

/// Drives every player that no agent drives and that has a behaviour's action.
fn drive_scripted(game: &mut Match, events: &mut Events) {
    for id in game.order() {
        let i = id.index();
        if !matches!(game.players[i].ai, Ai::Behavior(_)) {
            continue;
        }
        let free = game.players[i].active && !game.is_driven(id);
        let acting = &mut game.play.acting[i];
        let Some(action) = acting.chosen.take().filter(|_| free) else {
            acting.sticky = 0;
            acting.key = None;
            continue;
        };
        acting.sticky = sticky::next(acting.sticky, action);
        acting.played = Some(action);
        if action != Action::BuiltinAi {
            let held = acting.sticky;
            game.play.driven |= 1 << id.0;
            let held = driver::Held { sticky: held, steer: None, key: game.play.acting[i].key };
            game.play.acting[i].key =
                driver::drive(game, events, id, held, hurry(game, id, action, held.key));
        }
    }
}

/// Takes a set piece for an agent who doesn't: presses a short pass once and releases it. A key
/// that was already down is released first. `key`: the kick whose key is down.
fn hurry(game: &Match, id: PlayerId, action: Action, key: Option<KickKind>) -> Action {
    let asked = game.player(id).body.kick.is_some();
    let waiting = game
        .play
        .set_piece
        .filter(|set_piece| set_piece.taker == id && game.rule(Rule::AntiStalling));
    match waiting.map_or(0, |set_piece| set_piece.waited_steps) {
        ..STALLING_STEPS => action,
        STALLING_STEPS if asked || key.is_none() => Action::ShortPass,
        _ if asked || key == Some(KickKind::Short) => Action::Idle,
        _ => Action::ShortPass,
    }
}
