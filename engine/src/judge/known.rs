//! What programs and scripts know of an episode besides the match itself.

use crate::in_place::clone_in_place;
use crate::judge::machine::Input;
use crate::judge::script::{EpisodeNames, HookScene, Scripts, Shelf};
use crate::judge::view::{MatchView, Sight};
use crate::random::{Purpose, Stream};
use crate::snapshot::{Archive, SnapshotError};
use crate::state::event::Event;
use setpiece_scenario::vocabulary::Team;
use std::sync::Arc;

/// The data of an episode besides its match.
#[derive(Clone, Copy, Debug)]
pub struct Given<'a> {
    /// The seed of its streams.
    pub seed: u64,
    /// Its index, also part of their key.
    pub index: u64,
    /// The parameters' values.
    pub params: &'a [f64],
    /// The drawn `let`s.
    pub lets: &'a [f64],
    /// Its round, from 1 on.
    pub round: u32,
    /// How many rounds it has.
    pub rounds: u32,
    /// Steps from the episode's start to when the round began.
    pub round_start: u32,
}

/// Parameters, `let`s, and what scripts may read.
#[derive(Debug)]
pub struct Known {
    scripts: Scripts,
    /// Whether any script runs.
    scripted: bool,
    purpose: Purpose,
    params: Vec<f64>,
    /// What scripts may read, with their parameters and their stream; none if no script runs.
    scene: Option<Arc<HookScene>>,
    lets: Vec<f64>,
    seed: u64,
    index: u64,
    round: u32,
    rounds: u32,
    round_start: u32,
}

clone_in_place! {
    Known { scripts, scripted, purpose, params, scene, lets, seed, index, round, rounds,
        round_start }
}

impl Known {
    /// Creates it empty. `purpose` is the stream that scripts draw from.
    pub fn new(scripts: Scripts, scripted: bool, purpose: Purpose) -> Known {
        Known {
            scripts,
            scripted,
            purpose,
            params: Vec::new(),
            scene: None,
            lets: Vec::new(),
            seed: 0,
            index: 0,
            round: 1,
            rounds: 1,
            round_start: 0,
        }
    }

    /// Begins an episode.
    pub fn begin(&mut self, given: &Given<'_>) {
        let Given { seed, index, params, .. } = *given;
        self.params.clear();
        self.params.extend_from_slice(params);
        (self.seed, self.index) = (seed, index);
        self.scene = None;
        self.begin_round(given);
        self.scene = self.scripted.then(|| {
            let random = Stream::new(seed, index, self.purpose);
            let (nothing, shown) = (MatchView::EMPTY, self.scripts.params(params));
            let scene = HookScene::new(nothing, nothing, &[], shown, random, self.key());
            Arc::new(scene.in_episode(self.names()))
        });
    }

    /// Begins a round of the episode: its `let`s are drawn again.
    pub fn begin_round(&mut self, given: &Given<'_>) {
        self.lets.clear();
        self.lets.extend_from_slice(given.lets);
        (self.round, self.rounds) = (given.round, given.rounds);
        self.round_start = given.round_start;
        self.rename();
    }

    /// Lets scripts read the names of this round.
    fn rename(&mut self) {
        self.scene = self.scene.take().map(|scene| Arc::new(scene.renamed(self.names())));
    }

    /// What scripts read by name in this round.
    fn names(&self) -> Arc<EpisodeNames> {
        self.scripts.names(&self.params, &self.lets, (self.round, self.round_start))
    }

    /// Whether the episode has no more rounds.
    pub(crate) fn is_last_round(&self) -> bool {
        self.round >= self.rounds
    }

    /// Writes or reads what scripts are shown; the rest is known since the episode began.
    pub(crate) fn archive(
        &mut self,
        archive: &mut Archive<'_>,
        shelf: &mut Shelf,
    ) -> Result<(), SnapshotError> {
        shelf.archive("scene", &mut self.scene, archive)?;
        if archive.is_reading() && self.scripted {
            shelf.name(&self.names());
        }
        if self.scene.is_some() == self.scripted {
            return Ok(());
        }
        Err(SnapshotError::damaged("scene", "is not what the scenario's scripts need"))
    }

    /// What the episode was given; no numbers before the first episode.
    pub(crate) fn given(&self) -> Given<'_> {
        Given {
            seed: self.seed,
            index: self.index,
            params: &self.params,
            lets: &self.lets,
            round: self.round,
            rounds: self.rounds,
            round_start: self.round_start,
        }
    }

    /// Replaces the scripts.
    pub fn adopt(&mut self, scripts: Scripts) {
        self.scripts = scripts;
        self.rename();
    }

    /// The scripts.
    pub fn scripts(&self) -> &Scripts {
        &self.scripts
    }

    /// The seed and the episode's index.
    pub fn key(&self) -> (u64, u64) {
        (self.seed, self.index)
    }

    /// The input of a program, as seen from a side, without events.
    pub fn input<'a>(&'a self, now: Sight<'a>, prev: &'a MatchView, us: Team) -> Input<'a> {
        Input {
            now: Some(now),
            prev: Some(Sight::Kept(prev)),
            events: &[],
            params: &self.params,
            lets: &self.lets,
            index: self.index,
            round: self.round,
            round_start: self.round_start,
            us,
            terminated: false,
            silent: false,
        }
    }

    /// Shows a step to scripts; none if no script runs.
    ///
    /// A script may keep in its memory what it was shown, and a clone of the environment shares it.
    /// The next step then gets a new scene.
    pub fn show(
        &mut self,
        now: impl FnOnce() -> MatchView,
        prev: &MatchView,
        events: &[Event],
    ) -> Option<Arc<HookScene>> {
        let scene = self.scene.as_mut()?;
        match Arc::get_mut(scene) {
            Some(scene) => scene.show(now(), prev, events),
            None => *scene = Arc::new(scene.followed_by(now(), prev, events)),
        }
        Some(scene.clone())
    }
}
