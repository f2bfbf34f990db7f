//! What a scenario pays: its rewards run for each agent, their terms kept apart.
//!
//! A reward lives once per agent: its memory and its terms are his. The agents of a team are judged together, each in a
//! lane of [`Lanes`], so that what doesn't depend on `me` is computed once for all. A script that reads nothing of `me`
//! is run once per team and its payment copied.

mod lanes;

use crate::judge::machine::Input;
use crate::judge::script::{Memory, Perspective, Scene, ScriptError, Scripts};
use crate::state::{Match, PlayerId};
use arrayvec::ArrayVec;
use lanes::{Lanes, Pass};
use setpiece_scenario::pitch::TEAM_MAX;
use setpiece_scenario::program::PAY_MAX;
use setpiece_scenario::vocabulary::Team;
use setpiece_scenario::{Reward, RewardBody};
use std::sync::Arc;

/// The label of a script's one term.
const SCRIPT_TERM: &str = "script";

/// The rewards of an environment, and what they have paid.
#[derive(Clone, Debug)]
pub struct RewardJudge {
    rewards: Arc<[Reward]>,
    names: Arc<[String]>,
    states: Vec<RewardState>,
    n_agents: usize,
    /// Agent by agent, the terms of this step.
    terms: Vec<f64>,
    /// Agent by agent, their sums over the episode.
    sums: Vec<f64>,
    paid: Vec<f32>,
    faults: u32,
}

/// The memory of one reward.
#[derive(Clone, Debug)]
struct RewardState {
    /// Its first term's place among all.
    first_term: usize,
    n_terms: usize,
    /// Of a program, team by team.
    lanes: [Option<Lanes>; 2],
    /// Whether a script lives per team rather than per agent.
    shared: bool,
    /// A script's memory, instance by instance.
    memories: Vec<Memory>,
}

/// An agent as the judge sees it.
#[derive(Clone, Copy)]
struct Judged {
    agent: usize,
    team: Team,
    me: Option<PlayerId>,
}

/// The agents of a team, in their order.
type Squad = ArrayVec<Judged, TEAM_MAX>;

impl RewardJudge {
    /// Prepares rewards for so many agents.
    pub fn new(rewards: Arc<[Reward]>, scripts: &Scripts, n_agents: usize) -> RewardJudge {
        let mut names = Vec::new();
        let mut states = Vec::with_capacity(rewards.len());
        for reward in rewards.iter() {
            let first_term = names.len();
            let (shared, n_memories) = match &reward.body {
                RewardBody::Program { terms, .. } => {
                    names.extend(terms.iter().map(|label| format!("{}/{label}", reward.name)));
                    (false, 0)
                }
                RewardBody::Script { script, .. } => {
                    names.push(format!("{}/{SCRIPT_TERM}", reward.name));
                    let shared = !scripts.uses_me(*script);
                    (shared, if shared { Team::ALL.len() } else { n_agents })
                }
            };
            states.push(RewardState {
                first_term,
                n_terms: names.len() - first_term,
                lanes: [None, None],
                shared,
                memories: vec![Memory::default(); n_memories],
            });
        }
        let n_terms = names.len();
        RewardJudge {
            rewards,
            names: names.into(),
            states,
            n_agents,
            terms: vec![0.0; n_agents * n_terms],
            sums: vec![0.0; n_agents * n_terms],
            paid: vec![0.0; n_agents],
            faults: 0,
        }
    }

    /// What each agent was paid in this step.
    pub fn paid(&self) -> &[f32] {
        &self.paid
    }

    /// The terms' names, `reward/label`, in the order of the values.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// An agent's terms of this step; empty for no such agent.
    pub fn terms(&self, agent: usize) -> &[f64] {
        let n = self.names.len();
        self.terms.get(agent * n..(agent + 1) * n).unwrap_or_default()
    }

    /// An agent's terms, summed over the episode; empty for no such agent.
    pub fn sums(&self, agent: usize) -> &[f64] {
        let n = self.names.len();
        self.sums.get(agent * n..(agent + 1) * n).unwrap_or_default()
    }

    /// Payments of this episode that were stopped because their value was impossible.
    pub fn faults(&self) -> u32 {
        self.faults
    }

    /// Begins an episode: `input` shows the start state.
    pub fn reset(&mut self, game: &Match, input: &Input<'_>) {
        self.faults = 0;
        self.sums.fill(0.0);
        self.clear_step();
        let rewards = self.rewards.clone();
        let squads = self.squads(game);
        for (state, reward) in self.states.iter_mut().zip(rewards.iter()) {
            state.memories.fill(Memory::default());
            let RewardBody::Program { init, step, .. } = &reward.body else { continue };
            for ((lanes, squad), team) in state.lanes.iter_mut().zip(&squads).zip(Team::ALL) {
                if squad.is_empty() {
                    *lanes = None;
                    continue;
                }
                if lanes.as_ref().is_none_or(|lanes| !lanes.seats(squad.len())) {
                    *lanes = Some(Lanes::new(init, step, state.n_terms, squad.len()));
                }
                let Some(lanes) = lanes else { continue };
                let input = Input { us: *team, ..*input };
                lanes.clear();
                lanes.run(&players(squad), &input, Pass::Init, &mut self.faults);
                lanes.run(&players(squad), &input, Pass::Silent, &mut self.faults);
            }
        }
        self.clear_step();
    }

    /// Judges a step; `scene` shows it to scripts.
    ///
    /// # Errors
    /// The first hook that failed.
    pub fn step(
        &mut self,
        game: &Match,
        input: &Input<'_>,
        scene: Option<(&Scripts, &Arc<Scene>)>,
    ) -> Result<(), ScriptError> {
        self.clear_step();
        let rewards = self.rewards.clone();
        let squads = self.squads(game);
        for (which, reward) in rewards.iter().enumerate() {
            match (&reward.body, scene) {
                (RewardBody::Program { .. }, _) => {
                    for (team, squad) in Team::ALL.iter().zip(&squads) {
                        self.program(which, squad, &Input { us: *team, ..*input });
                    }
                }
                (RewardBody::Script { script, weight }, Some((scripts, scene))) => {
                    for squad in &squads {
                        self.script(which, squad, |perspective, memory| {
                            Ok(scripts.reward(*script, scene, perspective, memory)? * weight)
                        })?;
                    }
                }
                (RewardBody::Script { .. }, None) => {}
            }
        }
        self.pay();
        Ok(())
    }

    fn clear_step(&mut self) {
        self.terms.fill(0.0);
        self.paid.fill(0.0);
    }

    /// The agents of each team.
    fn squads(&self, game: &Match) -> [Squad; 2] {
        let mut squads = [Squad::new(), Squad::new()];
        for (agent, slot) in game.agents.iter().take(self.n_agents).enumerate() {
            let me = slot.player.filter(|player| game.players[player.index()].active);
            // A team has no more agents than players.
            let _ = squads[slot.team.index()].try_push(Judged { agent, team: slot.team, me });
        }
        squads
    }

    /// Runs a program for a team's agents.
    fn program(&mut self, which: usize, squad: &Squad, input: &Input<'_>) {
        let n_all = self.names.len();
        let state = &mut self.states[which];
        let Some(lanes) = &mut state.lanes[input.us.index()] else { return };
        lanes.run(&players(squad), input, Pass::Step, &mut self.faults);
        for (lane, judged) in squad.iter().enumerate() {
            let at = judged.agent * n_all + state.first_term;
            lanes.paid(lane, &mut self.terms[at..at + state.n_terms]);
        }
    }

    /// Runs a script for a team's agents: for each, or for the first and all.
    fn script(
        &mut self,
        which: usize,
        squad: &Squad,
        mut hook: impl FnMut(Perspective, &mut Memory) -> Result<f64, ScriptError>,
    ) -> Result<(), ScriptError> {
        let state = &mut self.states[which];
        let mut value = 0.0;
        for (place, judged) in squad.iter().enumerate() {
            if place == 0 || !state.shared {
                let perspective = Perspective { us: judged.team, me: judged.me, agent: judged.agent };
                let instance = if state.shared { judged.team.index() } else { judged.agent };
                let Some(memory) = state.memories.get_mut(instance) else { continue };
                value = hook(perspective, memory)?;
                if value.is_nan() || value.abs() > PAY_MAX {
                    self.faults += 1;
                    value = 0.0;
                }
            }
            self.terms[judged.agent * self.names.len() + state.first_term] += value;
        }
        Ok(())
    }

    fn pay(&mut self) {
        for (sum, term) in self.sums.iter_mut().zip(&self.terms) {
            *sum += term;
        }
        let n = self.names.len();
        for (agent, paid) in self.paid.iter_mut().enumerate() {
            let total: f64 = self.terms[agent * n..(agent + 1) * n].iter().sum();
            *paid = total as f32;
        }
    }
}

/// The agents' players.
fn players(squad: &Squad) -> ArrayVec<Option<PlayerId>, TEAM_MAX> {
    squad.iter().map(|judged| judged.me).collect()
}

#[cfg(test)]
mod tests;
