//! What can be read of an environment: its scenario and choices, the agents, rewards, records,
//! observations, the state, how the episode ended.

use super::{Environment, EnvironmentOptions, apply_physics};
use crate::control;
use crate::draw::{DrawError, Roster, player_name};
use crate::judge::{Outcome, Recorded};
use crate::observe::layout::{self, Layout};
use crate::observe::{self, Floats, ObserveError};
use crate::start::Drawn;
use crate::state::event::Event;
use crate::state::{AgentSlot, Match, PlayerId};
use crate::statistics::Statistics;
use crate::step;
use arrayvec::ArrayVec;
use setpiece_scenario::pitch::{PLAYERS_MAX, TEAM_MAX};
use setpiece_scenario::vocabulary::Action;
use setpiece_scenario::{Bindings, Scenario};
use std::sync::Arc;

impl Environment {
    /// The scenario.
    pub fn scenario(&self) -> &Arc<Scenario> {
        &self.scenario
    }

    /// The scenario's digest; 0 if no file could hold the scenario.
    pub fn scenario_digest(&self) -> u64 {
        self.scenario_digest
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
        step::hand_over(&mut game);
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

    /// The numbers of the scenario's own observation that could not be computed in this episode
    /// (such as a division by zero), and how often; they were shown as 0. Without `delayed` and
    /// `stack`, only what was asked for is counted.
    pub fn observed_faults(&self) -> impl Iterator<Item = (&str, u32)> {
        self.judge.observed_faults()
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

    /// The round of the episode, from 1 on.
    pub fn round(&self) -> u32 {
        self.judge.given().round
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
