//! One match and its judge, as an agent sees them.
//!
//! Puts the judge into the order of a step ([`step`]): it judges the state after ten ticks of play,
//! before the restart that a stop requires. So observations show the restart, but rewards don't. It
//! holds everything that lives as long as an episode. A clone continues like the original,
//! [`snapshot`] turns one into bytes, and [`hindsight`] starts a new episode in an old state.

mod error;
mod fits;
mod hindsight;
mod read;
mod snapshot;
mod stopped;

pub use crate::draw::{AgentsChoice, SideChoice};
pub use crate::physics::Scratch;
pub use error::{EnvironmentError, ResetError, StepError};

use crate::control::behavior::Actors;
use crate::draw::{DrawError, Drawer, Roster, player_name};
use crate::football::substitution;
use crate::in_place::clone_in_place;
use crate::judge::script::Scripts;
use crate::judge::{Given, Judge, Outcome};
use crate::laps::Phase;
use crate::start::Drawn;
use crate::state::event::Events;
use crate::state::{Match, PlayerId, Steer};
use crate::statistics::Statistics;
use crate::step;
use setpiece_scenario::vocabulary::{Action, Rule, Team};
use setpiece_scenario::{Bindings, Reward, Scenario};
use std::sync::Arc;
use stopped::Stopped;

/// A user's choices besides the scenario.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct EnvironmentOptions {
    /// The parameters; their defaults if absent.
    pub bindings: Option<Bindings>,
    /// Named rewards instead of the scenario's own.
    pub rewards: Option<Vec<String>>,
    /// How the ball's contacts are found, instead of the scenario's choice.
    pub physics: Option<Physics>,
    /// Agents instead of the scenario's own.
    pub agents: Option<AgentsChoice>,
    /// A [snapshot](Environment::snapshot) whose state every episode begins in, instead of the
    /// scenario's start.
    pub from: Option<Arc<[u8]>>,
}

/// How the ball's contacts are found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub enum Physics {
    /// Rapier runs only if the ball comes near something hard.
    Gated,
    /// Rapier runs on every tick.
    Full,
}

/// How a step affected the episode.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct StepResult {
    /// An ending held.
    pub terminated: bool,
    /// The limit was reached.
    pub truncated: bool,
}

/// One environment.
#[derive(Debug)]
pub struct Environment {
    scenario: Arc<Scenario>,
    scenario_digest: u64,
    options: Arc<EnvironmentOptions>,
    /// The state that every episode begins in, if the options have one.
    past: Option<Arc<Match>>,
    bindings: Arc<Bindings>,
    roster: Roster,
    ids: Arc<[String]>,
    drawer: Drawer,
    game: Match,
    /// Where play was stopped in the last step.
    stopped: Stopped,
    judge: Judge,
    actors: Actors,
    events: Events,
    /// How many of the events belong to the step just played.
    judged: usize,
    statistics: Statistics,
    /// Whether the episode can be stepped.
    running: bool,
    /// Whether a reset has been tried.
    begun: bool,
    /// Whether that reset found a start.
    started: bool,
    outcome: Option<Outcome>,
    seed: u64,
    index: u64,
}

clone_in_place! {
    Environment {
        scenario, scenario_digest, options, past, bindings, roster, ids, drawer, game, stopped,
        judge, actors, events, judged, statistics, running, begun, started, outcome, seed, index,
    }
}

impl Environment {
    /// Prepares an environment; it must be reset before its first step.
    ///
    /// # Errors
    /// [`EnvironmentError`] for a reward, parameter or number of agents that the scenario doesn't
    /// have, a script that isn't valid Rhai, or an unusable snapshot (unreadable, or with other
    /// players or agents).
    pub fn new(
        scenario: Arc<Scenario>,
        options: EnvironmentOptions,
    ) -> Result<Environment, EnvironmentError> {
        let bindings = bound(&scenario, options.bindings.as_ref())?;
        let scripts = Scripts::compile(&scenario)?;
        let rewards = chosen_rewards(&scenario, options.rewards.as_deref())?;
        let roster = Roster::new(&scenario, &bindings, options.agents.as_ref())?;
        let actors = Actors::new(&scenario, &roster, scripts.clone());
        let judge = Judge::new(&scenario, rewards, scripts, roster.agents.len());
        let mut drawer = Drawer::new(&scenario);
        let mut drawn = drawer.draw_unchecked(&scenario, &bindings, &roster);
        apply_physics(&mut drawn, options.physics);
        let game = step::begin(&drawn);
        let mut environment = Environment {
            ids: agent_ids(&scenario, &roster),
            stopped: Stopped::new(&game),
            game,
            scenario_digest: digest_of(&scenario),
            past: None,
            scenario,
            options: Arc::new(options),
            bindings: Arc::new(bindings),
            roster,
            drawer,
            judge,
            actors,
            events: Events::new(),
            judged: 0,
            statistics: Statistics::default(),
            running: false,
            begun: false,
            started: false,
            outcome: None,
            seed: 0,
            index: 0,
        };
        let from = environment.options.from.clone();
        environment.past = from.map(|from| environment.past(&from)).transpose()?.map(Arc::new);
        Ok(environment)
    }

    /// Begins an episode.
    ///
    /// - `seed`: restarts the count of episodes; without it the seed stays the same.
    /// - `index`: the episode of the seed. The default is 0 after a seed, and the next episode
    ///   without one.
    ///
    /// # Errors
    /// [`DrawError`] if no start meets the scenario's requirements. The environment must then be
    /// reset again.
    pub fn reset(&mut self, seed: Option<u64>, index: Option<u64>) -> Result<(), DrawError> {
        let past = self.past.clone();
        self.begin(seed, index, past.as_deref())
    }

    /// Begins an episode at a start that the scenario draws, or in an old state.
    fn begin(
        &mut self,
        seed: Option<u64>,
        index: Option<u64>,
        past: Option<&Match>,
    ) -> Result<(), DrawError> {
        self.index = match (seed, index) {
            (_, Some(index)) => index,
            (Some(_), None) => 0,
            (None, None) if self.begun => self.index.wrapping_add(1),
            (None, None) => self.index,
        };
        self.seed = seed.unwrap_or(self.seed);
        self.begun = true;
        self.running = false;
        self.stopped.forget();
        self.outcome = None;
        self.events.clear();
        self.judged = 0;
        let drawn = self.start()?;
        self.game = step::begin(&drawn);
        if let Some(past) = past {
            self.game = hindsight::begin_from(past, &self.game);
        }
        self.started = true;
        let given = Given {
            seed: self.seed,
            index: self.index,
            params: &self.bindings.0,
            lets: &drawn.lets,
            round: 1,
            rounds: drawn.rounds,
            round_start: self.game.step,
        };
        self.judge.reset(&self.game, &given);
        self.actors.reset(&self.game, &given);
        self.statistics = Statistics::begin(&self.game);
        self.running = true;
        Ok(())
    }

    /// Plays one step: `actions[i]` is agent i's, in the own frame of its team.
    ///
    /// # Errors
    /// [`StepError`] if the episode has ended or has not begun, if there isn't one action per agent
    /// (then nothing is played), or if a script failed (which ends the episode).
    pub fn step(
        &mut self,
        actions: &[Action],
        scratch: &mut Scratch,
    ) -> Result<StepResult, StepError> {
        if !self.running {
            return Err(StepError::NotRunning { begun: self.begun });
        }
        if actions.len() != self.game.agents.len() {
            return Err(StepError::Actions {
                found: actions.len(),
                expected: self.game.agents.len(),
            });
        }
        scratch.laps().start();
        step::hand_over(&mut self.game);
        let before = self.events.as_slice().get(..self.judged).unwrap_or_default();
        if let Err(error) = self.actors.choose(&mut self.game, before, actions) {
            self.running = false;
            return Err(StepError::Script(Box::new(error)));
        }
        self.events.forget(self.judged);
        step::play(&mut self.game, actions, &mut self.events, scratch);
        let judged = self.judge.step(&self.game, &mut self.events);
        self.judged = self.events.as_slice().len();
        self.statistics.observe(&self.game, self.events.as_slice());
        let outcome = match judged {
            Ok(outcome) => outcome,
            Err(error) => {
                self.running = false;
                return Err(StepError::Script(Box::new(error)));
            }
        };
        let game = &mut self.game;
        self.judge.substitutions(&mut |coming| substitution::come_on(game, coming));
        self.stopped.note(&self.game);
        scratch.laps().end(Phase::Judge);
        if self.judge.is_round_over() && outcome.is_none() {
            if let Err(error) = self.begin_round() {
                self.running = false;
                return Err(StepError::Draw(Box::new(error)));
            }
        } else {
            step::go_on(&mut self.game);
        }
        scratch.laps().end(Phase::Reach);
        self.judge.settle(&self.game);
        scratch.laps().end(Phase::Judge);
        let truncated = outcome.as_ref().is_some_and(|outcome| outcome.truncated);
        let terminated = outcome.is_some() && !truncated;
        self.running = outcome.is_none();
        self.outcome = outcome;
        Ok(StepResult { terminated, truncated })
    }

    /// Begins the next round of the episode: a start is drawn again. Score and clock go on, and so
    /// does what is measured and paid; behaviours begin again, and nothing is held.
    fn begin_round(&mut self) -> Result<(), DrawError> {
        let Given { seed, index, params, round, rounds, .. } = self.judge.given();
        let params = Bindings(params.to_vec());
        let (key, round) = ((seed, index), round + 1);
        let mut drawn =
            self.drawer.draw_round(&self.scenario, &params, &self.roster, key, round)?;
        apply_physics(&mut drawn, self.options.physics);
        drawn.steps_before = self.game.step;
        drawn.elapsed_steps = self.game.elapsed_at_start;
        drawn.score = self.game.score;
        drawn.limit_steps = self.game.limit_steps;
        self.game = step::begin(&drawn);
        let round_start = self.game.step;
        let (params, lets) = (&params.0, &drawn.lets);
        let given = Given { seed, index, params, lets, round, rounds, round_start };
        self.judge.begin_round(&self.game, &given);
        self.actors.reset(&self.game, &given);
        Ok(())
    }

    /// Ends the episode now, for a reason of the caller's own, as an ending of the scenario would.
    /// It replaces a limit reached in the same step. No-op before an episode's first step, and
    /// after an ending of the scenario.
    pub fn end(&mut self, outcome: Outcome) {
        let ended = self.outcome.as_ref().is_some_and(|outcome| !outcome.truncated);
        if self.started && self.game.step > 0 && !ended {
            self.running = false;
            self.outcome = Some(outcome);
        }
    }

    /// Steers an agent's player from the next step on, with any angle and pace, instead of a held
    /// direction. Lasts until a direction is pressed. No-op for unknown agents.
    pub fn steer(&mut self, agent: usize, steer: Option<Steer>) {
        if let Some(slot) = self.game.agents.get_mut(agent) {
            slot.steer = steer;
        }
    }

    /// Replaces the scripts by those of another version of the scenario, at once and with their
    /// memory. False, without any effect, if anything else differs.
    ///
    /// # Errors
    /// [`EnvironmentError`] for a script that isn't valid Rhai.
    pub fn adopt_scripts(&mut self, scenario: &Arc<Scenario>) -> Result<bool, EnvironmentError> {
        if scenario.scripts.len() != self.scenario.scripts.len() {
            return Ok(false);
        }
        let same = Scenario { scripts: self.scenario.scripts.clone(), ..Scenario::clone(scenario) }
            == *self.scenario;
        if same {
            let scripts = Scripts::compile(scenario)?;
            self.actors.adopt(scripts.clone());
            self.judge.adopt(scripts);
            self.scenario = scenario.clone();
            self.scenario_digest = digest_of(scenario);
        }
        Ok(same)
    }

    /// Sets the parameters from the next reset on.
    ///
    /// # Errors
    /// [`EnvironmentError`] if a value isn't allowed, or if players or agents would change.
    pub fn set_bindings(&mut self, bindings: &Bindings) -> Result<(), EnvironmentError> {
        let bindings = bound(&self.scenario, Some(bindings))?;
        let roster = Roster::new(&self.scenario, &bindings, self.options.agents.as_ref())?;
        if roster != self.roster {
            return Err(EnvironmentError::Roster);
        }
        self.bindings = Arc::new(bindings);
        Ok(())
    }
}

/// The scenario's digest; 0 if no file could hold the scenario.
fn digest_of(scenario: &Scenario) -> u64 {
    setpiece_scenario::file::digest(scenario).unwrap_or_default()
}

fn bound(scenario: &Scenario, bindings: Option<&Bindings>) -> Result<Bindings, EnvironmentError> {
    let Some(bindings) = bindings else { return Ok(Bindings::defaults(&scenario.params)) };
    if bindings.0.len() != scenario.params.len() {
        let (found, expected) = (bindings.0.len(), scenario.params.len());
        return Err(EnvironmentError::Bindings { found, expected });
    }
    for (param, &value) in scenario.params.iter().zip(&bindings.0) {
        param.admit(value)?;
    }
    Ok(bindings.clone())
}

fn chosen_rewards(
    scenario: &Scenario,
    names: Option<&[String]>,
) -> Result<Arc<[Reward]>, EnvironmentError> {
    let Some(names) = names else { return Ok(scenario.rewards.clone().into()) };
    if let Some(twice) = names
        .iter()
        .enumerate()
        .find(|(at, name)| names.iter().take(*at).any(|other| other == *name))
    {
        return Err(EnvironmentError::RewardTwice(twice.1.clone()));
    }
    let chosen = names.iter().map(|name| {
        scenario.reward(name).cloned().ok_or_else(|| {
            let mut known: Vec<String> = scenario
                .library
                .iter()
                .chain(&scenario.rewards)
                .map(|reward| reward.name.clone())
                .collect();
            known.sort();
            known.dedup();
            EnvironmentError::Reward { name: name.clone(), known }
        })
    });
    chosen.collect()
}

fn apply_physics(drawn: &mut Drawn, physics: Option<Physics>) {
    if let Some(physics) = physics {
        drawn.rules[Rule::Physics.index()] = match physics {
            Physics::Gated => 0.0,
            Physics::Full => 1.0,
        };
    }
}

fn agent_ids(scenario: &Scenario, roster: &Roster) -> Arc<[String]> {
    let mut roaming = [0usize; 2];
    let id = |&(team, player): &(Team, Option<PlayerId>)| {
        if let Some(player) = player {
            return player_name(scenario, team, player);
        }
        roaming[team.index()] += 1;
        format!("{team}_{}", roaming[team.index()] - 1)
    };
    roster.agents.iter().map(id).collect()
}

#[cfg(test)]
mod tests;
