//! Scripted players: behaviours and scripts choose their actions, as agents do.
//!
//! Decides each scripted player's action from the state before a step, in roster order.
//! [`driver`](super::driver) decides what an action means. A player driven by an agent is left to
//! the agent, and their behaviour pauses. Inside: [`actor`] steps through a behaviour's nodes,
//! [`perform`] turns a primitive into actions, [`steer`] chooses among the eight directions.

pub mod actor;
pub mod perform;
pub mod steer;

use crate::draw::Roster;
use crate::in_place::clone_in_place;
use crate::judge::known::{Given, Known};
use crate::judge::machine::{Crew, Input, Machine, Registers};
use crate::judge::script::{ScriptError, Scripts, Shelf};
use crate::judge::view::{MatchView, Sight};
use crate::random::Purpose;
use crate::snapshot::{Archive, SnapshotError};
use crate::state::event::Event;
use crate::state::{Match, PlayerId};
use actor::{Actor, BehaviorMind};
use setpiece_scenario::vocabulary::{Action, Team};
use setpiece_scenario::{Act, Ai, Behavior, Do, Node, Scenario};
use std::sync::Arc;

/// The scripted players of an environment.
#[derive(Debug)]
pub struct Actors {
    plans: Arc<[Behavior]>,
    list: Vec<Actor>,
    known: Known,
    /// One per plan.
    regs: Vec<Registers>,
    prev: MatchView,
    faults: u32,
}

clone_in_place! {
    Actors { plans, list, known, regs, prev, faults }
}

impl Actors {
    /// Prepares the scripted players of a roster.
    pub fn new(scenario: &Scenario, roster: &Roster, scripts: Scripts) -> Actors {
        let mut list = Vec::new();
        let mut scripted = false;
        for team in Team::ALL {
            for (id, slot) in scenario.team(*team) {
                if !roster.present.get(id).copied().unwrap_or_default() {
                    continue;
                }
                for ai in slot.played_by() {
                    let Ai::Behavior(which) = ai else { continue };
                    let Some(plan) = scenario.behaviors.get(which as usize) else { continue };
                    let same =
                        |actor: &Actor| (actor.player.index(), actor.plan) == (id, which as usize);
                    if list.iter().any(same) {
                        continue;
                    }
                    scripted |= plan
                        .nodes
                        .iter()
                        .any(|node| matches!(node, Node::Do(Do { act: Act::Script { .. }, .. })));
                    list.push(Actor::new(PlayerId(id as u8), which as usize, plan));
                }
            }
        }
        Actors {
            plans: scenario.behaviors.clone().into(),
            list,
            known: Known::new(scripts, scripted, Purpose::Behavior),
            regs: scenario.behaviors.iter().map(|plan| Registers::of(&plan.program)).collect(),
            prev: MatchView::EMPTY,
            faults: 0,
        }
    }

    /// Whether no player is scripted.
    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// Replaces the scripts.
    pub fn adopt(&mut self, scripts: Scripts) {
        self.known.adopt(scripts);
    }

    /// Values of this episode that were dropped because they were impossible.
    pub fn faults(&self) -> u32 {
        self.faults
    }

    /// Begins an episode; the match is at its start.
    pub fn reset(&mut self, game: &Match, given: &Given<'_>) {
        if self.list.is_empty() {
            return;
        }
        self.known.begin(given);
        self.prev = MatchView::of(game);
        self.faults = 0;
        for actor in &mut self.list {
            actor.reset(&self.plans[actor.plan]);
        }
    }

    /// Writes or reads what they remember; on the way in [`Self::reset`] has come before.
    pub(crate) fn archive(
        &mut self,
        archive: &mut Archive<'_>,
        shelf: &mut Shelf,
    ) -> Result<(), SnapshotError> {
        if self.list.is_empty() {
            return Ok(());
        }
        self.known.archive(archive, shelf)?;
        archive.value("prev", &mut self.prev)?;
        archive.value("faults", &mut self.faults)?;
        self.list.iter_mut().try_for_each(|actor| actor.archive(archive, shelf))
    }

    /// Chooses every scripted player's action: writes
    /// [`Acting::chosen`](crate::state::play::Acting) of the match.
    ///
    /// - `events`: those of the last step.
    /// - `actions`: the agents' actions of this step, by slot.
    ///
    /// # Errors
    /// An `act` hook that failed; the episode can't continue.
    pub fn choose(
        &mut self,
        game: &mut Match,
        events: &[Event],
        actions: &[Action],
    ) -> Result<(), ScriptError> {
        if self.list.is_empty() {
            return Ok(());
        }
        let now = MatchView::of(game);
        let scene = self.known.show(|| now, &self.prev, events);
        let (seed, index) = self.known.key();
        let plans = self.plans.clone();
        for actor in &mut self.list {
            let id = actor.player;
            // Of several behaviours that a player may have, the episode has drawn one.
            if game.player(id).ai != Ai::Behavior(actor.plan as u32) {
                continue;
            }
            game.play.acting[id.index()].chosen = None;
            if !game.player(id).active {
                continue;
            }
            let plan = &plans[actor.plan];
            let (program, regs, points) = self.regs[actor.plan].parts();
            let machine = Machine {
                input: Input {
                    events,
                    ..self.known.input(Sight::Kept(&now), &self.prev, id.team())
                },
                crew: Crew::one(Some(id)),
                plan: program,
                regs,
                points,
                cells: &mut actor.cells,
                terms: &mut [],
                faults: &mut self.faults,
                draws: None,
            };
            let mut mind = BehaviorMind::new(machine, seed, index, id);
            mind.see();
            let driven = game
                .agents
                .iter()
                .zip(actions)
                .any(|(slot, action)| slot.player == Some(id) && *action != Action::BuiltinAi);
            if !driven {
                let scene = scene.as_ref().map(|scene| (self.known.scripts(), scene));
                let chosen = actor.thread.step(plan, &mut mind, game, scene)?;
                game.play.acting[id.index()].chosen = Some(chosen);
            }
        }
        self.prev = now;
        Ok(())
    }
}
