//! The judge: what an episode is worth, and when it ends.
//!
//! Decides rewards and endings from what happened in a step; never changes the match. For each step
//! it gets a [`MatchView`] of the state before any restart, the view that the last step left behind
//! (after its restart), and the step's events. Endings are judged first, in their order. The one
//! that holds adds the event `end`, which the rewards of that last step see.
//!
//! - [`view`]: the part of a match that programs and scripts may read.
//! - [`machine`]: runs register programs.
//! - [`known`]: what programs and scripts know of an episode besides the view.
//! - [`rewards`], [`endings`]: what the scenario pays, and how it ends.
//! - [`records`], [`observation`]: what it measures, and what it shows its agents.
//! - [`script`]: the same, by Rhai hooks.

pub mod endings;
pub mod known;
pub mod machine;
pub mod observation;
pub mod records;
pub mod rewards;
pub mod script;
pub mod view;

pub use endings::{EndingJudge, Outcome};
pub use machine::Machine;
pub use records::{RecordJudge, Recorded};
pub use rewards::RewardJudge;
pub use script::{
    ScriptError, ScriptFault, ScriptFaultKind, ScriptNames, check_script, script_imports,
};
pub use view::{MatchView, Sight, ViewMemory};

use crate::in_place::clone_in_place;
use crate::judge::script::Shelf;
use crate::random::Purpose;
use crate::snapshot::{Archive, SnapshotError};
use crate::state::event::Events;
use crate::state::{ComingOn, Match};
pub use known::Given;
use known::Known;
use machine::Input;
use observation::ObservationJudge;
use script::{HookScene, Scripts};
use setpiece_scenario::{Endings, Reward, Scenario};
use std::sync::Arc;

/// The judge of one environment.
#[derive(Debug)]
pub struct Judge {
    endings: EndingJudge,
    rewards: RewardJudge,
    records: RecordJudge,
    observation: Option<ObservationJudge>,
    known: Known,
    prev: MatchView,
    /// How much of the state is kept in `prev`.
    memory: ViewMemory,
    /// The value of `prev` in the step just judged, if there is an observation that may compare
    /// with it.
    before: Option<Box<MatchView>>,
}

clone_in_place! {
    Judge { endings, rewards, records, observation, known, prev, memory, before }
}

impl Judge {
    /// Prepares a judge that pays `rewards` to this many agents.
    pub fn new(
        scenario: &Scenario,
        rewards: Arc<[Reward]>,
        scripts: Scripts,
        n_agents: usize,
    ) -> Judge {
        let endings: Arc<Endings> = Arc::new(scenario.endings.clone());
        let scripted = rewards.iter().any(|reward| !reward.body.hooks.is_empty())
            || endings.list.iter().any(|ending| ending.script.is_some());
        Judge {
            endings: EndingJudge::new(endings),
            rewards: RewardJudge::new(rewards.clone(), &scripts, n_agents),
            records: RecordJudge::new(&scenario.records, n_agents),
            observation: scenario
                .observation
                .as_ref()
                .map(|observation| ObservationJudge::new(observation, n_agents)),
            known: Known::new(scripts, scripted, Purpose::Script),
            memory: if scripted { ViewMemory::All } else { memory(scenario, &rewards) },
            prev: MatchView::EMPTY,
            before: scenario.observation.is_some().then(|| Box::new(MatchView::EMPTY)),
        }
    }

    /// Replaces the scripts.
    pub fn adopt(&mut self, scripts: Scripts) {
        self.rewards.adopt(&scripts);
        self.known.adopt(scripts);
    }

    /// The records and what they have measured.
    pub fn records(&self) -> &RecordJudge {
        &self.records
    }

    /// The names of the declared observation's numbers; none without one.
    pub fn observed_names(&self) -> Vec<String> {
        self.observation.iter().flat_map(ObservationJudge::names).map(str::to_owned).collect()
    }

    /// Writes the declared observation of an agent. `false` if there is none of that length.
    pub fn observe(&mut self, game: &Match, agent: usize, out: &mut [f32]) -> bool {
        let (Some(observation), Some(before)) = (&mut self.observation, &self.before) else {
            return false;
        };
        if out.len() != observation.names().len() || agent >= game.agents.len() {
            return false;
        }
        let input = self.known.input(Sight::Live(game), before, endings::judged_side(game));
        observation.write(game, agent, &input, self.known.key().0, out);
        true
    }

    /// The numbers of the declared observation that could not be computed in this episode, and how
    /// often.
    pub fn observed_faults(&self) -> impl Iterator<Item = (&str, u32)> {
        self.observation.iter().flat_map(ObservationJudge::faults)
    }

    /// The rewards and what they have paid.
    pub fn rewards(&self) -> &RewardJudge {
        &self.rewards
    }

    /// The endings.
    pub fn endings(&self) -> &EndingJudge {
        &self.endings
    }

    /// Begins an episode; the match is at its start.
    pub fn reset(&mut self, game: &Match, given: &Given<'_>) {
        self.known.begin(given);
        self.prev = MatchView::of(game);
        if let Some(before) = &mut self.before {
            **before = self.prev;
        }
        let input = self.known.input(Sight::Live(game), &self.prev, endings::judged_side(game));
        self.endings.reset(&input);
        self.rewards.reset(game, &input);
        self.records.reset(game, &input);
        if let Some(observation) = &mut self.observation {
            observation.reset(game, &input, given.seed);
        }
    }

    /// Writes or reads an episode's memory; on the way in [`Self::reset`] has come before.
    pub(crate) fn archive(
        &mut self,
        archive: &mut Archive<'_>,
        shelf: &mut Shelf,
    ) -> Result<(), SnapshotError> {
        self.prev.archive("prev", self.memory, archive)?;
        if let (Some(observation), Some(before)) = (&mut self.observation, &mut self.before) {
            before.archive("before", self.memory, archive)?;
            archive.part("observation", |archive| observation.archive(archive))?;
        }
        self.known.archive(archive, shelf)?;
        archive.part("endings", |archive| self.endings.archive(archive, shelf))?;
        archive.part("rewards", |archive| self.rewards.archive(archive, shelf))?;
        archive.part("records", |archive| self.records.archive(archive))
    }

    /// What the episode was given; no numbers before the first episode.
    pub(crate) fn given(&self) -> Given<'_> {
        self.known.given()
    }

    /// Judges a step; `game` is the state before any restart. If the episode ends, the event `end`
    /// is added.
    ///
    /// # Errors
    /// A hook that failed; the episode can't continue.
    pub fn step(
        &mut self,
        game: &Match,
        events: &mut Events,
    ) -> Result<Option<Outcome>, ScriptError> {
        let side = endings::judged_side(game);
        let mut scene = self.known.show(|| MatchView::of(game), &self.prev, events.as_slice());
        let input = Input {
            events: events.as_slice(),
            ..self.known.input(Sight::Live(game), &self.prev, side)
        };
        let last = self.known.is_last_round();
        let outcome = self.endings.step(game, &input, last, shown(&self.known, scene.as_ref()))?;
        if let Some(outcome) = &outcome {
            endings::announce(outcome, game, events);
            drop(scene);
            scene = self.known.show(|| MatchView::of(game), &self.prev, events.as_slice());
        }
        let input = Input {
            events: events.as_slice(),
            terminated: outcome.as_ref().is_some_and(|outcome| !outcome.truncated),
            ..self.known.input(Sight::Live(game), &self.prev, side)
        };
        self.rewards.step(game, &input, shown(&self.known, scene.as_ref()))?;
        self.records.step(game, &input);
        Ok(outcome)
    }

    /// Calls `make` for each substitution whose time has come in the step just judged.
    pub fn substitutions(&mut self, make: &mut dyn FnMut(&ComingOn)) {
        self.endings.substitutions(make);
    }

    /// Whether the step just judged ended a round that another one follows.
    pub fn is_round_over(&self) -> bool {
        self.endings.is_round_over() && !self.known.is_last_round()
    }

    /// Begins a further round; the match is at its start. What was measured, paid and remembered
    /// goes on.
    pub fn begin_round(&mut self, game: &Match, given: &Given<'_>) {
        self.known.begin_round(given);
        let input = self.known.input(Sight::Live(game), &self.prev, endings::judged_side(game));
        self.endings.renew(&input);
        self.rewards.renew(game, &input);
        self.records.renew(&input);
    }

    /// Remembers the state that the step leaves behind, after its restart: the next step's `prev`.
    pub fn settle(&mut self, game: &Match) {
        if let Some(before) = &mut self.before {
            **before = self.prev;
        }
        self.prev.keep(game, self.memory);
        if let (Some(observation), Some(before)) = (&mut self.observation, &self.before) {
            let side = endings::judged_side(game);
            let input = self.known.input(Sight::Live(game), before, side);
            observation.step(game, &input, self.known.key().0);
        }
    }
}

/// What a judge's scripts may read.
fn shown<'a>(
    known: &'a Known,
    scene: Option<&'a Arc<HookScene>>,
) -> Option<(&'a Scripts, &'a Arc<HookScene>)> {
    scene.map(|scene| (known.scripts(), scene))
}

/// How much of a state must be kept for the next step's `prev`.
fn memory(scenario: &Scenario, rewards: &[Reward]) -> ViewMemory {
    let of = |reward: &Reward| ViewMemory::of(&reward.body.step);
    let programs = scenario.records.iter().map(|record| &record.program);
    let programs =
        programs.chain(scenario.observation.iter().map(|observation| &observation.program));
    let programs = programs.chain([&scenario.endings.program]);
    programs.map(ViewMemory::of).chain(rewards.iter().map(of)).max().unwrap_or_default()
}

#[cfg(test)]
mod tests;
