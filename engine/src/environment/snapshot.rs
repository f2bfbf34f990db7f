//! Snapshots of an environment, and episodes that begin from one.

use super::fits::fits;
use super::{Environment, ResetError, bound};
use crate::draw::Roster;
use crate::judge::script::Shelf;
use crate::judge::{Given, Outcome};
use crate::snapshot::{About, Archive, Opened, SnapshotError, write};
use crate::state::Match;
use setpiece_scenario::Bindings;
use setpiece_scenario::vocabulary::Verdict;
use std::sync::Arc;

impl Environment {
    /// Encodes the episode between two steps as bytes. They hold everything that a later step or
    /// its infos depend on, including random streams and the memory of rewards, records and
    /// scripts.
    ///
    /// # Errors
    /// [`SnapshotError::Unkept`] if a script's memory holds a function.
    ///
    /// # Determinism
    /// Equal states give equal bytes.
    pub fn snapshot(&self) -> Result<Vec<u8>, SnapshotError> {
        // Writing goes through the same mutable calls as reading, hence the copy.
        let mut copy = self.clone();
        write(&self.about(), &self.game, |archive| copy.archive(archive))
    }

    /// Continues from a snapshot of any environment with the same scenario, rewards and agents. The
    /// parameters of the next episodes are also the snapshot's.
    ///
    /// # Errors
    /// [`SnapshotError`] for bytes that aren't a snapshot, or one that doesn't fit. Nothing has
    /// changed then.
    pub fn restore(&mut self, snapshot: &[u8]) -> Result<(), SnapshotError> {
        let opened = Opened::of(snapshot)?;
        let its = &opened.about;
        if its.digest != self.scenario_digest {
            let expected = self.scenario.name.clone();
            return Err(SnapshotError::Scenario { found: its.scenario.clone(), expected });
        }
        if !self.reward_names().eq(&its.rewards) {
            let expected = self.reward_names().cloned().collect();
            return Err(SnapshotError::Rewards { found: its.rewards.clone(), expected });
        }
        fits(&opened.game, &self.roster)?;
        self.admit("bindings", &its.bindings)?;
        let mut restored = self.clone();
        restored.idle(&opened);
        opened.read_episode(|archive| restored.archive(archive))?;
        *self = restored;
        Ok(())
    }

    /// Begins a new episode in the state of a snapshot. Places, ball, everything under way, score,
    /// cards, fatigue and the clock are the snapshot's. Rules, difficulty, limit and the players'
    /// control are this scenario's, which may be another than the snapshot's. Rewards, records,
    /// steps and random numbers start as at a [reset](Self::reset).
    ///
    /// # Errors
    /// [`ResetError`] for bytes that aren't a snapshot, or one with other players or agents
    /// (nothing has changed then), and as [`reset`](Self::reset).
    pub fn reset_from(
        &mut self,
        snapshot: &[u8],
        seed: Option<u64>,
        index: Option<u64>,
    ) -> Result<(), ResetError> {
        let past = self.past(snapshot)?;
        Ok(self.begin(seed, index, Some(&past))?)
    }

    /// The match of a snapshot that an episode can begin from.
    pub(super) fn past(&self, snapshot: &[u8]) -> Result<Match, SnapshotError> {
        let Opened { about, game, .. } = Opened::of(snapshot)?;
        fits(&game, &self.roster)?;
        if about.started { Ok(game) } else { Err(SnapshotError::NotBegun) }
    }

    /// What a snapshot of this environment belongs to.
    fn about(&self) -> About {
        About {
            digest: self.scenario_digest,
            scenario: self.scenario.name.clone(),
            rewards: self.reward_names().cloned().collect(),
            started: self.started,
            begun: self.begun,
            seed: self.seed,
            index: self.index,
            bindings: self.bindings.0.clone(),
        }
    }

    /// The rewards that are paid.
    fn reward_names(&self) -> impl Iterator<Item = &String> {
        self.judge.rewards().list().iter().map(|reward| &reward.name)
    }

    /// Applies a snapshot without an episode around its match.
    fn idle(&mut self, opened: &Opened<'_>) {
        self.game.clone_from(&opened.game);
        let about = &opened.about;
        (self.started, self.begun, self.seed, self.index) =
            (about.started, about.begun, about.seed, about.index);
        if self.bindings.0 != about.bindings {
            self.bindings = Arc::new(Bindings(about.bindings.clone()));
        }
        self.running = false;
        self.stopped.forget();
        self.outcome = None;
        self.events.clear();
        self.judged = 0;
    }

    /// Writes or reads the episode around the match: the scenes that scripts have kept, then what
    /// leads to them.
    fn archive(&mut self, archive: &mut Archive<'_>) -> Result<(), SnapshotError> {
        let mut shelf = Shelf::default();
        archive.in_order(
            &mut shelf,
            |shelf, archive| shelf.archive_scenes(archive),
            |shelf, archive| self.archive_episode(archive, shelf),
        )
    }

    /// Writes or reads all but the scenes.
    fn archive_episode(
        &mut self,
        archive: &mut Archive<'_>,
        shelf: &mut Shelf,
    ) -> Result<(), SnapshotError> {
        // The key is not the environment's where a later reset found no start.
        let Given { mut seed, mut index, params, lets, mut round, mut rounds, mut round_start } =
            self.judge.given();
        let (mut params, mut lets) = (params.to_vec(), lets.to_vec());
        archive.value("seed", &mut seed)?;
        archive.value("index", &mut index)?;
        archive.value("params", &mut params)?;
        // Before the first episode there are none; the scenario fixes how many are read.
        lets.resize(self.scenario.start.lets.len(), 0.0);
        archive.slots("lets", &mut lets)?;
        archive.value("round", &mut round)?;
        archive.value("rounds", &mut rounds)?;
        archive.value("round_start", &mut round_start)?;
        if archive.is_reading() {
            self.admit("params", &params)?;
            let given =
                Given { seed, index, params: &params, lets: &lets, round, rounds, round_start };
            self.judge.reset(&self.game, &given);
            self.actors.reset(&self.game, &given);
        }
        self.judge.archive(archive, shelf)?;
        archive.part("actors", |archive| self.actors.archive(archive, shelf))?;
        archive.value("events", &mut self.events)?;
        let mut judged = self.judged as u32;
        archive.value("judged", &mut judged)?;
        self.judged = judged as usize;
        archive.value("statistics", &mut self.statistics)?;
        archive.value("running", &mut self.running)?;
        self.stopped.archive(archive)?;
        if let Some(stopped) = self.stopped.get() {
            fits(stopped, &self.roster)?;
        }
        let said =
            |outcome: &Outcome| (outcome.label.to_string(), outcome.verdict, outcome.truncated);
        let mut outcome: Option<(String, Option<Verdict>, bool)> = self.outcome.as_ref().map(said);
        archive.value("outcome", &mut outcome)?;
        self.outcome = outcome.map(|(label, verdict, truncated)| Outcome {
            label: label.into(),
            verdict,
            truncated,
        });
        Ok(())
    }

    /// Checks parameters that were read: they must be allowed, and keep the same players and
    /// agents.
    fn admit(&self, name: &str, values: &[f64]) -> Result<(), SnapshotError> {
        if values == self.bindings.0 {
            return Ok(());
        }
        let wrong = |why: String| SnapshotError::damaged(name, format!("can't be bound: {why}"));
        let bindings = bound(&self.scenario, Some(&Bindings(values.to_vec())))
            .map_err(|why| wrong(why.to_string()))?;
        match Roster::new(&self.scenario, &bindings, self.options.agents.as_ref()) {
            Ok(roster) if roster == self.roster => Ok(()),
            _ => Err(wrong("other players or agents would take part".to_owned())),
        }
    }
}

#[cfg(test)]
mod tests;
