//! Many episodes, played one at a time so that pages are answered in between.

use super::message::SummaryReply;
use super::stage::{StudioStage, fault};
use crate::engine::batch::{EpisodeError, EpisodeSummary, run_episode};
use crate::engine::environment::{Environment, Scratch};
use crate::run::summarise;

/// Episodes that are being played.
pub(super) struct RunningSummary {
    stage: StudioStage,
    environment: Environment,
    scratch: Scratch,
    seed: u64,
    episodes: u32,
    played: Vec<Result<EpisodeSummary, EpisodeError>>,
}

impl RunningSummary {
    /// Begins with the first episode of a seed.
    ///
    /// # Errors
    /// A sentence, if nothing ends an episode, or the parameters don't fit.
    pub(super) fn begin(
        stage: StudioStage,
        seed: u64,
        episodes: u32,
    ) -> Result<RunningSummary, String> {
        let scenario = &stage.scenario;
        if scenario.endings.list.is_empty() && scenario.start.limit.is_none() {
            return Err(fault(EpisodeError::Endless(0)));
        }
        let (environment, scratch) = (stage.environment()?, Scratch::default());
        Ok(RunningSummary { stage, environment, scratch, seed, episodes, played: Vec::new() })
    }

    /// Plays the next episode; false if there is none left. One without a start counts as an
    /// outcome.
    ///
    /// # Errors
    /// A sentence, if the player fails.
    pub(super) fn play_one(&mut self) -> Result<bool, String> {
        let index = self.played.len() as u64;
        if index >= u64::from(self.episodes) {
            return Ok(false);
        }
        let (environment, player) = (&mut self.environment, &mut self.stage.player);
        self.played.push(run_episode(environment, self.seed, index, player, &mut self.scratch));
        self.stage.check()?;
        Ok(true)
    }

    /// What the episodes came to.
    pub(super) fn reply(self) -> SummaryReply {
        let summary = summarise(self.played, &self.environment, 0.0);
        SummaryReply {
            episodes: self.episodes,
            outcomes: summary.outcomes.into_iter().map(|(name, _, count)| (name, count)).collect(),
            mean_return: summary.mean_return,
            score: summary.score,
            terms: summary.terms,
            records: summary
                .records
                .into_iter()
                .map(|record| (record.name, record.mean, record.unit.to_string()))
                .collect(),
        }
    }
}
