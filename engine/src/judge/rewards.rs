//! What a scenario pays: its rewards run for each agent, their terms kept apart.
//!
//! A reward lives once per agent: its memory and its terms are his. One that reads nothing of `me` gives every agent
//! of a team the same, so it is run once per team and copied.

use crate::judge::machine::{Input, Machine, Registers};
use crate::judge::script::{Memory, Perspective, Scene, ScriptError, Scripts};
use crate::state::{Match, PlayerId};
use arrayvec::ArrayVec;
use setpiece_scenario::pitch::PLAYERS_MAX;
use setpiece_scenario::program::PAY_MAX;
use setpiece_scenario::vocabulary::Team;
use setpiece_scenario::{Program, Reward, RewardBody};
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
    /// Whether it lives per team rather than per agent.
    shared: bool,
    /// Cells per instance.
    n_cells: usize,
    /// Of the first values, and of every step.
    init: Registers,
    step: Registers,
    /// Instance by instance.
    cells: Vec<f64>,
    /// A script's memory, instance by instance.
    memories: Vec<Memory>,
}

/// An agent as the judge sees it.
#[derive(Clone, Copy)]
struct Judged {
    agent: usize,
    team: Team,
    me: Option<PlayerId>,
    /// Whether he is the first of his team: what is shared is run for him.
    first: bool,
}

/// Which program of a reward is run.
#[derive(Clone, Copy)]
enum Pass {
    /// Its first values.
    Init,
    /// The start state, for what looks back later: nothing is paid.
    Silent,
    /// A step.
    Step,
}

impl RewardJudge {
    /// Prepares rewards for so many agents.
    pub fn new(rewards: Arc<[Reward]>, scripts: &Scripts, n_agents: usize) -> RewardJudge {
        let mut names = Vec::new();
        let mut states = Vec::with_capacity(rewards.len());
        for reward in rewards.iter() {
            let first_term = names.len();
            let (shared, n_cells, init, step) = match &reward.body {
                RewardBody::Program { init, step, terms } => {
                    names.extend(terms.iter().map(|label| format!("{}/{label}", reward.name)));
                    (!step.uses_me(), step.cells as usize, Registers::of(init), Registers::of(step))
                }
                RewardBody::Script { script, .. } => {
                    names.push(format!("{}/{SCRIPT_TERM}", reward.name));
                    (!scripts.uses_me(*script), 0, Registers::default(), Registers::default())
                }
            };
            let instances = if shared { Team::ALL.len() } else { n_agents };
            let is_script = matches!(reward.body, RewardBody::Script { .. });
            states.push(RewardState {
                first_term,
                n_terms: names.len() - first_term,
                shared,
                n_cells,
                init,
                step,
                cells: vec![0.0; instances * n_cells],
                memories: vec![Memory::default(); if is_script { instances } else { 0 }],
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
        for state in &mut self.states {
            state.cells.fill(0.0);
            state.memories.fill(Memory::default());
        }
        let rewards = self.rewards.clone();
        let all = self.judged(game);
        for (which, reward) in rewards.iter().enumerate() {
            if let RewardBody::Program { init, step, .. } = &reward.body {
                for judged in self.instances(which, &all) {
                    self.run(which, init, judged, input, Pass::Init);
                    self.run(which, step, judged, input, Pass::Silent);
                }
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
        let all = self.judged(game);
        for (which, reward) in rewards.iter().enumerate() {
            for judged in self.instances(which, &all) {
                match (&reward.body, scene) {
                    (RewardBody::Program { step, .. }, _) => self.run(which, step, judged, input, Pass::Step),
                    (RewardBody::Script { script, weight }, Some((scripts, scene))) => {
                        let perspective = Perspective { us: judged.team, me: judged.me, agent: judged.agent };
                        let instance = self.instance(which, judged);
                        if let Some(memory) = self.states[which].memories.get_mut(instance) {
                            let value = scripts.reward(*script, scene, perspective, memory)?;
                            let at = judged.agent * self.names.len() + self.states[which].first_term;
                            if (value * weight).abs() <= PAY_MAX {
                                self.terms[at] += value * weight;
                            } else {
                                self.faults += 1;
                            }
                        }
                    }
                    (RewardBody::Script { .. }, None) => {}
                }
            }
            if self.states[which].shared {
                self.share(which, game);
            }
        }
        self.pay();
        Ok(())
    }

    fn clear_step(&mut self) {
        self.terms.fill(0.0);
        self.paid.fill(0.0);
    }

    /// The agents, in their order.
    fn judged(&self, game: &Match) -> ArrayVec<Judged, PLAYERS_MAX> {
        let mut seen = [false; 2];
        let agents = game.agents.iter().take(self.n_agents).enumerate();
        let judged = agents.map(|(agent, slot)| Judged {
            agent,
            team: slot.team,
            me: slot.player.filter(|player| game.players[player.index()].active),
            first: !std::mem::replace(&mut seen[slot.team.index()], true),
        });
        judged.collect()
    }

    /// The agents a reward runs for: every one, or the first of each team.
    fn instances<'j>(&self, which: usize, all: &'j [Judged]) -> impl Iterator<Item = Judged> + use<'j> {
        let shared = self.states[which].shared;
        all.iter().copied().filter(move |judged| !shared || judged.first)
    }

    fn instance(&self, which: usize, judged: Judged) -> usize {
        if self.states[which].shared { judged.team.index() } else { judged.agent }
    }

    fn run(&mut self, which: usize, program: &Program, judged: Judged, input: &Input<'_>, pass: Pass) {
        let instance = self.instance(which, judged);
        let n_all = self.names.len();
        let state = &mut self.states[which];
        let at = judged.agent * n_all + state.first_term;
        let registers = if matches!(pass, Pass::Init) { &mut state.init } else { &mut state.step };
        let (regs, begin) = registers.parts();
        let mut machine = Machine {
            input: Input { us: judged.team, me: judged.me, silent: matches!(pass, Pass::Silent), ..*input },
            regs,
            cells: &mut state.cells[instance * state.n_cells..(instance + 1) * state.n_cells],
            terms: &mut self.terms[at..at + state.n_terms],
            faults: &mut self.faults,
            draws: None,
        };
        machine.run_from(program, begin);
    }

    /// Copies a shared reward's terms from the first agent of each team to the others.
    fn share(&mut self, which: usize, game: &Match) {
        let n_all = self.names.len();
        let (first_term, n_terms) = (self.states[which].first_term, self.states[which].n_terms);
        for team in Team::ALL {
            let mut agents = game
                .agents
                .iter()
                .take(self.n_agents)
                .enumerate()
                .filter(|(_, slot)| slot.team == *team)
                .map(|(i, _)| i);
            if let Some(first) = agents.next() {
                let from = first * n_all + first_term;
                for agent in agents {
                    self.terms.copy_within(from..from + n_terms, agent * n_all + first_term);
                }
            }
        }
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

#[cfg(test)]
mod tests;
