//! One match and its judge, as an agent sees them.
//!
//! Puts the judge into the order of a step ([`step`]): it judges the state after ten ticks of play,
//! before the restart that a stop requires. So observations show the restart, but rewards don't. It
//! holds everything that lives as long as an episode. A clone continues like the original,
//! [`snapshot`] turns one into bytes, and [`hindsight`] starts a new episode in an old state.

mod error;
mod fits;
mod hindsight;
mod snapshot;
mod stopped;

pub use crate::draw::{AgentsChoice, SideChoice};
pub use crate::physics::Scratch;
pub use error::{EnvironmentError, ResetError, StepError};

use crate::control;
use crate::control::behavior::Actors;
use crate::draw::{DrawError, Drawer, Roster, player_name};
use crate::in_place::clone_in_place;
use crate::judge::script::Scripts;
use crate::judge::{Given, Judge, Outcome, Recorded};
use crate::laps::Phase;
use crate::observe::layout::{self, Layout};
use crate::observe::{self, Floats, ObserveError};
use crate::start::Drawn;
use crate::state::event::{Event, Events};
use crate::state::{AgentSlot, Match, PlayerId, Steer};
use crate::statistics::Statistics;
use crate::step;
use arrayvec::ArrayVec;
use setpiece_scenario::pitch::{PLAYERS_MAX, TEAM_MAX};
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
        self.stopped.note(&self.game);
        scratch.laps().end(Phase::Judge);
        step::go_on(&mut self.game);
        scratch.laps().end(Phase::Reach);
        self.judge.settle(&self.game);
        scratch.laps().end(Phase::Judge);
        let truncated = outcome.as_ref().is_some_and(|outcome| outcome.truncated);
        let terminated = outcome.is_some() && !truncated;
        self.running = outcome.is_none();
        self.outcome = outcome;
        Ok(StepResult { terminated, truncated })
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

    /// The scenario.
    pub fn scenario(&self) -> &Arc<Scenario> {
        &self.scenario
    }

    /// The user's choices besides the scenario.
    pub fn options(&self) -> &EnvironmentOptions {
        &self.options
    }

    /// The parameters.
    pub fn bindings(&self) -> &Bindings {
        &self.bindings
    }

    /// The players who take part.
    pub fn roster(&self) -> &Roster {
        &self.roster
    }

    /// How many agents act.
    pub fn n_agents(&self) -> usize {
        self.roster.agents.len()
    }

    /// The agents' ids, in their order: a player's name, else `left_CM_1`; `left_0` if the player
    /// changes.
    pub fn agent_ids(&self) -> &[String] {
        &self.ids
    }

    /// A player's name, else their team, role and number among the team's players of that role
    /// (`left_CM_1`). None if the slot is empty.
    pub fn player_name(&self, player: PlayerId) -> Option<String> {
        let present = self.roster.present.get(player.index()).copied().unwrap_or_default();
        present.then(|| player_name(&self.scenario, player.team(), player))
    }

    /// The agents' slots: team, player, held actions.
    pub fn agents(&self) -> &[AgentSlot] {
        &self.game.agents
    }

    /// What a player pressed in the last step, in the own frame of their team: their agent's
    /// action, else their behaviour's, else the bot's play expressed as an action.
    ///
    /// The bot's presses form a stream: each is relative to what the earlier ones hold. `None` if
    /// nobody plays the player (off the pitch, `ai: lazy`). [`Action::BuiltinAi`] if the behaviour
    /// hands over to the bot.
    pub fn action_of(&self, player: PlayerId) -> Option<Action> {
        self.game.play.acting.get(player.index()).and_then(|acting| acting.played)
    }

    /// What the bot would press for an agent in the next step: see [`Self::bot_actions`]. `None`
    /// for unknown agents.
    pub fn bot_action(&self, agent: usize) -> Option<Action> {
        self.bot_actions().get(agent).copied()
    }

    /// What the bot would press for each agent if the next step handed all of them to it
    /// ([`Action::BuiltinAi`]). Each action continues what the agent's slot holds now. A player
    /// with a behaviour gets the behaviour's action. [`Action::Idle`] for an agent without a
    /// player.
    ///
    /// Decides on a copy: neither the match nor its random numbers change.
    pub fn bot_actions(&self) -> ArrayVec<Action, PLAYERS_MAX> {
        let mut game = self.game.clone();
        if self.started && !self.actors.is_empty() {
            let handed = [Action::BuiltinAi; PLAYERS_MAX];
            // A failing script is reported by the step itself. Here its player is treated as the
            // bot's.
            let _ = self.actors.clone().choose(&mut game, self.events(), &handed);
        }
        control::bot_actions(&mut game)
    }

    /// The reward of each agent in the last step.
    pub fn rewards(&self) -> &[f32] {
        self.judge.rewards().paid()
    }

    /// The reward terms' names, `reward/label`.
    pub fn term_names(&self) -> &[String] {
        self.judge.rewards().names()
    }

    /// An agent's terms of the last step, in the order of their names.
    pub fn terms(&self, agent: usize) -> &[f64] {
        self.judge.rewards().terms(agent)
    }

    /// An agent's terms summed over the episode, in the order of their names.
    pub fn term_sums(&self, agent: usize) -> &[f64] {
        self.judge.rewards().sums(agent)
    }

    /// Dropped payments of the episode: their value was impossible (such as a division by zero).
    pub fn faults(&self) -> u32 {
        self.judge.rewards().faults() + self.actors.faults()
    }

    /// The values of the scenario's records so far, in source order.
    pub fn records(&self) -> impl Iterator<Item = (&str, Recorded)> {
        self.judge.records().values()
    }

    /// The names of the numbers of the scenario's own observation (`observe vector`), in order;
    /// empty without one.
    pub fn observed_names(&self) -> Vec<String> {
        self.judge.observed_names()
    }

    /// The layout of an observation's numbers.
    pub fn layout(&self, floats: Floats) -> Layout {
        match floats {
            Floats::Simple115 => layout::simple115(),
            Floats::Simple115v2 => layout::simple115v2(),
            Floats::Simple115v2Sticky => layout::simple115v2_sticky(),
            Floats::Egocentric => layout::egocentric(self.larger_team()),
            Floats::Vector => layout::declared(&self.observed_names()),
            Floats::Scaled(scaled) => self.layout(scaled.plain()).scaled(),
        }
    }

    /// Writes an observation for an agent.
    ///
    /// # Errors
    /// [`ObserveError`] for unknown agents, or an `out` of another length.
    pub fn observe(
        &mut self,
        floats: Floats,
        agent: usize,
        out: &mut [f32],
    ) -> Result<(), ObserveError> {
        match floats {
            Floats::Simple115 => observe::simple115(&self.game, agent, out),
            Floats::Simple115v2 => observe::simple115v2(&self.game, agent, out),
            Floats::Simple115v2Sticky => observe::simple115v2_sticky(&self.game, agent, out),
            Floats::Egocentric => observe::egocentric(&self.game, agent, self.larger_team(), out),
            Floats::Vector => self.observe_vector(agent, out),
            Floats::Scaled(scaled) => {
                observe::scaled(&self.game, agent, scaled, self.larger_team(), out)
            }
        }
    }

    /// The number of players of the larger team.
    fn larger_team(&self) -> usize {
        let count = |players: &[bool]| players.iter().filter(|present| **present).count();
        let (left, right) = self.roster.present.split_at(TEAM_MAX);
        count(left).max(count(right))
    }

    /// Writes the scenario's own observation for an agent: quantities in SI units, places
    /// normalised, own frame.
    ///
    /// # Errors
    /// [`ObserveError`] for unknown agents, or an `out` of another length.
    pub fn observe_vector(&mut self, agent: usize, out: &mut [f32]) -> Result<(), ObserveError> {
        let n_agents = self.game.agents.len();
        if agent >= n_agents {
            return Err(ObserveError::Agent { agent, n_agents });
        }
        let found = out.len();
        if self.judge.observe(&self.game, agent, out) {
            return Ok(());
        }
        Err(ObserveError::Size { expected: self.judge.observed_names().len(), found })
    }

    /// The events of the last step, in order.
    pub fn events(&self) -> &[Event] {
        self.events.as_slice().get(..self.judged).unwrap_or_default()
    }

    /// How the episode ended, if it has.
    pub fn outcome(&self) -> Option<&Outcome> {
        self.outcome.as_ref()
    }

    /// The ending that already held when the episode began, if any.
    pub fn ends_at_start(&self) -> Option<&str> {
        self.judge.endings().holds_at_start()
    }

    /// Whether a reset has been tried.
    pub fn has_begun(&self) -> bool {
        self.begun
    }

    /// Whether the episode can be stepped.
    pub fn is_running(&self) -> bool {
        self.running
    }

    /// The current match, after any restart.
    pub fn state(&self) -> &Match {
        &self.game
    }

    /// The match as the last step was judged. If play was stopped in it, this is the state before
    /// the restart.
    pub fn judged_state(&self) -> &Match {
        self.stopped.get().unwrap_or(&self.game)
    }

    /// The start that the scenario draws for the current seed, index and parameters (0 and 0 before
    /// the first episode). It isn't the start of an episode begun from a snapshot.
    ///
    /// # Errors
    /// [`DrawError`] if no start meets the scenario's requirements.
    pub fn start(&mut self) -> Result<Drawn, DrawError> {
        let (scenario, bindings, roster) = (&self.scenario, &self.bindings, &self.roster);
        let mut drawn = self.drawer.draw(scenario, bindings, roster, self.seed, self.index)?;
        apply_physics(&mut drawn, self.options.physics);
        Ok(drawn)
    }

    /// Goals, left and right.
    pub fn score(&self) -> [u16; 2] {
        self.game.score
    }

    /// Steps since the episode's start.
    pub fn steps(&self) -> u32 {
        self.game.step
    }

    /// The seed.
    pub fn seed(&self) -> u64 {
        self.seed
    }

    /// The episode's index.
    pub fn index(&self) -> u64 {
        self.index
    }

    /// The episode is truncated after this many steps.
    pub fn limit_steps(&self) -> Option<u32> {
        self.game.limit_steps
    }

    /// The figures of the episode so far.
    pub fn statistics(&self) -> &Statistics {
        &self.statistics
    }

    /// A fingerprint of the current state.
    pub fn digest(&self) -> u64 {
        crate::digest::of_match(&self.game)
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
