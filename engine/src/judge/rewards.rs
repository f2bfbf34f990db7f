//! What a scenario pays: its rewards run for each agent, with separate terms.
//!
//! Every agent has an instance of each reward, with its own memory and terms. The agents of a team
//! are judged together, each in a lane of [`Lanes`], so that what doesn't depend on `me` is
//! computed once for all. Scripts are called first and leave their values in cells. A script that
//! reads nothing of `me` is called once per team, and its value is copied.

mod lanes;

use crate::in_place::clone_in_place;
use crate::judge::machine::Input;
use crate::judge::script::{
    Argument, HookScene, Memory, Perspective, RewardAsked, ScriptError, Scripts, Shelf,
};
use crate::snapshot::{Archive, SnapshotError};
use crate::state::{Match, PlayerId};
use arrayvec::ArrayVec;
use lanes::{LaneStage, Lanes};
use setpiece_scenario::pitch::TEAM_MAX;
use setpiece_scenario::vocabulary::Team;
use setpiece_scenario::{Reward, RewardBody, RewardHook};
use std::sync::Arc;

/// The rewards of an environment, and what they have paid.
#[derive(Debug)]
pub struct RewardJudge {
    rewards: Arc<[Reward]>,
    names: Arc<[String]>,
    states: Vec<RewardState>,
    n_agents: usize,
    /// The terms of this step, agent by agent.
    terms: Vec<f64>,
    /// Their sums over the episode, agent by agent.
    sums: Vec<f64>,
    paid: Vec<f32>,
    faults: u32,
}

clone_in_place! {
    RewardJudge { rewards, names, states, n_agents, terms, sums, paid, faults }
}

/// The memory of one reward.
#[derive(Debug)]
struct RewardState {
    /// The index of its first term among all terms.
    first_term: usize,
    n_terms: usize,
    /// One entry per team.
    lanes: [Option<Lanes>; 2],
    hooks: Vec<HookState>,
}

clone_in_place! {
    RewardState { first_term, n_terms, lanes, hooks }
}

/// The memory of one script of a reward.
#[derive(Debug)]
struct HookState {
    /// Whether it has one instance per team instead of one per agent.
    shared: bool,
    /// What it returned last, one number for each of its terms.
    values: Vec<f64>,
    /// One entry per instance.
    memories: Vec<Memory>,
}

clone_in_place! {
    HookState { shared, values, memories }
}

/// An agent as the judge sees it.
#[derive(Clone, Copy)]
struct Judged {
    agent: usize,
    team: Team,
    me: Option<PlayerId>,
}

/// The agents of a team, in their order.
type TeamAgents = ArrayVec<Judged, TEAM_MAX>;

impl RewardJudge {
    /// Prepares rewards for this many agents.
    pub fn new(rewards: Arc<[Reward]>, scripts: &Scripts, n_agents: usize) -> RewardJudge {
        let mut names = Vec::new();
        let mut states = Vec::with_capacity(rewards.len());
        for reward in rewards.iter() {
            let first_term = names.len();
            names.extend(reward.term_names());
            let hook =
                |hook: &RewardHook| HookState::new(hook, !scripts.uses_me(hook.script), n_agents);
            states.push(RewardState {
                first_term,
                n_terms: names.len() - first_term,
                lanes: [None, None],
                hooks: reward.body.hooks.iter().map(hook).collect(),
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

    /// Replaces the scripts. A script that starts or stops running per agent loses its memory.
    pub fn adopt(&mut self, scripts: &Scripts) {
        for (state, reward) in self.states.iter_mut().zip(self.rewards.iter()) {
            for (state, hook) in state.hooks.iter_mut().zip(&reward.body.hooks) {
                let shared = !scripts.uses_me(hook.script);
                if shared != state.shared {
                    *state = HookState::new(hook, shared, self.n_agents);
                }
            }
        }
    }

    /// The rewards, in their order.
    pub fn list(&self) -> &[Reward] {
        &self.rewards
    }

    /// The reward of each agent in this step.
    pub fn paid(&self) -> &[f32] {
        &self.paid
    }

    /// The terms' names, `reward/label`, in the order of the values.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// An agent's terms of this step; empty for unknown agents.
    pub fn terms(&self, agent: usize) -> &[f64] {
        let n = self.names.len();
        self.terms.get(agent * n..(agent + 1) * n).unwrap_or_default()
    }

    /// An agent's terms, summed over the episode; empty for unknown agents.
    pub fn sums(&self, agent: usize) -> &[f64] {
        let n = self.names.len();
        self.sums.get(agent * n..(agent + 1) * n).unwrap_or_default()
    }

    /// Payments of this episode that were dropped because their value was impossible.
    pub fn faults(&self) -> u32 {
        self.faults
    }

    /// Begins an episode; `input` shows the start state.
    pub fn reset(&mut self, game: &Match, input: &Input<'_>) {
        self.faults = 0;
        self.sums.fill(0.0);
        self.clear_step();
        let rewards = self.rewards.clone();
        let sides = self.sides(game);
        for (state, reward) in self.states.iter_mut().zip(rewards.iter()) {
            state.hooks.iter_mut().for_each(|hook| hook.memories.fill(Memory::default()));
            let RewardBody { init, step, .. } = &reward.body;
            for ((lanes, side), team) in state.lanes.iter_mut().zip(&sides).zip(Team::ALL) {
                if side.is_empty() {
                    *lanes = None;
                    continue;
                }
                if lanes.as_ref().is_none_or(|lanes| !lanes.seats(side.len())) {
                    *lanes = Some(Lanes::new(init, step, state.n_terms, side.len()));
                }
                let Some(lanes) = lanes else { continue };
                let input = Input { us: *team, ..*input };
                lanes.clear();
                lanes.run(&players(side), &input, LaneStage::Init, &mut self.faults);
                lanes.run(&players(side), &input, LaneStage::Silent, &mut self.faults);
            }
        }
        self.clear_step();
    }

    /// Computes again what no step of a round changes.
    pub fn renew(&mut self, game: &Match, input: &Input<'_>) {
        let sides = self.sides(game);
        for state in &mut self.states {
            for ((lanes, side), team) in state.lanes.iter_mut().zip(&sides).zip(Team::ALL) {
                let Some(lanes) = lanes else { continue };
                let input = Input { us: *team, ..*input };
                lanes.run(&players(side), &input, LaneStage::Renew, &mut self.faults);
            }
        }
    }

    /// Writes or reads what was paid and what is remembered; on the way in [`Self::reset`] has come
    /// before.
    pub(crate) fn archive(
        &mut self,
        archive: &mut Archive<'_>,
        shelf: &mut Shelf,
    ) -> Result<(), SnapshotError> {
        for state in &mut self.states {
            for lanes in state.lanes.iter_mut().flatten() {
                lanes.archive(archive)?;
            }
            for memory in state.hooks.iter_mut().flat_map(|hook| &mut hook.memories) {
                memory.archive("this", archive, shelf)?;
            }
        }
        archive.slots("terms", &mut self.terms)?;
        archive.slots("sums", &mut self.sums)?;
        archive.slots("paid", &mut self.paid)?;
        archive.value("faults", &mut self.faults)
    }

    /// Judges a step; `scene` shows it to scripts.
    ///
    /// # Errors
    /// The first hook that failed.
    pub fn step(
        &mut self,
        game: &Match,
        input: &Input<'_>,
        scene: Option<(&Scripts, &Arc<HookScene>)>,
    ) -> Result<(), ScriptError> {
        self.clear_step();
        let rewards = self.rewards.clone();
        let sides = self.sides(game);
        for (which, reward) in rewards.iter().enumerate() {
            for (team, side) in Team::ALL.iter().zip(&sides) {
                self.run(which, &reward.body.hooks, side, &Input { us: *team, ..*input }, scene)?;
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
    fn sides(&self, game: &Match) -> [TeamAgents; 2] {
        let mut sides = [TeamAgents::new(), TeamAgents::new()];
        for (agent, slot) in game.agents.iter().take(self.n_agents).enumerate() {
            let me = slot.player.filter(|player| game.players[player.index()].active);
            // A team has no more agents than players.
            let _ = sides[slot.team.index()].try_push(Judged { agent, team: slot.team, me });
        }
        sides
    }

    /// Runs a reward for a team's agents, its scripts first.
    fn run(
        &mut self,
        which: usize,
        hooks: &[RewardHook],
        side: &TeamAgents,
        input: &Input<'_>,
        scene: Option<(&Scripts, &Arc<HookScene>)>,
    ) -> Result<(), ScriptError> {
        let n_all = self.names.len();
        let state = &mut self.states[which];
        let Some(lanes) = &mut state.lanes[input.us.index()] else { return Ok(()) };
        if let Some((scripts, scene)) = scene {
            for (hook, state) in hooks.iter().zip(&mut state.hooks) {
                state.call(hook, side, lanes, scripts, scene)?;
            }
        }
        lanes.run(&players(side), input, LaneStage::Step, &mut self.faults);
        for (lane, judged) in side.iter().enumerate() {
            let at = judged.agent * n_all + state.first_term;
            lanes.paid(lane, &mut self.terms[at..at + state.n_terms]);
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

impl HookState {
    fn new(hook: &RewardHook, shared: bool, n_agents: usize) -> HookState {
        let n_memories = if shared { Team::ALL.len() } else { n_agents };
        let values = vec![0.0; hook.cells().len()];
        HookState { shared, values, memories: vec![Memory::default(); n_memories] }
    }

    /// Calls a script for a team's agents: for each, or for the first on behalf of all.
    fn call(
        &mut self,
        hook: &RewardHook,
        side: &TeamAgents,
        lanes: &mut Lanes,
        scripts: &Scripts,
        scene: &Arc<HookScene>,
    ) -> Result<(), ScriptError> {
        let arguments: Vec<Argument<'_>> = hook
            .args
            .iter()
            .map(|arg| {
                let value = |at: usize| arg.regs.get(at).map_or(0.0, |reg| lanes.fixed(*reg));
                Argument { name: &arg.name, ty: arg.ty, values: [value(0), value(1)] }
            })
            .collect();
        for (lane, judged) in side.iter().enumerate() {
            if lane == 0 || !self.shared {
                let perspective =
                    Perspective { us: judged.team, me: judged.me, agent: judged.agent };
                let instance = if self.shared { judged.team.index() } else { judged.agent };
                let Some(memory) = self.memories.get_mut(instance) else { continue };
                let asked = RewardAsked { terms: &hook.terms, arguments: &arguments };
                scripts.reward_terms(
                    hook.script,
                    scene,
                    perspective,
                    asked,
                    memory,
                    &mut self.values,
                )?;
            }
            for (cell, &value) in hook.cells().zip(&self.values) {
                lanes.remember(cell, lane, value);
            }
        }
        Ok(())
    }
}

/// The agents' players.
fn players(side: &TeamAgents) -> ArrayVec<Option<PlayerId>, TEAM_MAX> {
    side.iter().map(|judged| judged.me).collect()
}

#[cfg(test)]
mod tests;
