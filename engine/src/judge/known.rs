//! What programs and scripts know of an episode beside the match itself.

use crate::event::Event;
use crate::judge::machine::Input;
use crate::judge::script::{Params, Scene, Scripts};
use crate::judge::view::{Sight, View};
use crate::random::{Purpose, Stream};
use crate::start::Drawn;
use setpiece_scenario::vocabulary::Team;
use std::sync::Arc;

/// Parameters, `let`s, and the stream that scripts draw from.
#[derive(Clone, Debug)]
pub struct Known {
    scripts: Scripts,
    /// Whether a script is asked at all.
    scripted: bool,
    purpose: Purpose,
    random: Stream,
    params: Vec<f64>,
    /// The same as scripts see them.
    shown: Params,
    lets: Vec<f64>,
    seed: u64,
    index: u64,
}

impl Known {
    /// Nothing yet; `purpose` says which stream scripts draw from.
    pub fn new(scripts: Scripts, scripted: bool, purpose: Purpose) -> Known {
        Known {
            scripts,
            scripted,
            purpose,
            random: Stream::new(0, 0, purpose),
            params: Vec::new(),
            shown: Params::default(),
            lets: Vec::new(),
            seed: 0,
            index: 0,
        }
    }

    /// Begins an episode.
    pub fn begin(&mut self, drawn: &Drawn, params: &[f64]) {
        self.params.clear();
        self.params.extend_from_slice(params);
        if self.scripted {
            self.shown = self.scripts.params(params);
        }
        self.lets.clear();
        self.lets.extend_from_slice(&drawn.lets);
        (self.seed, self.index) = (drawn.seed, drawn.index);
        self.random = Stream::new(drawn.seed, drawn.index, self.purpose);
    }

    /// The scripts.
    pub fn scripts(&self) -> &Scripts {
        &self.scripts
    }

    /// The seed and the episode's index.
    pub fn key(&self) -> (u64, u64) {
        (self.seed, self.index)
    }

    /// What a program is shown, from a side, without events.
    pub fn input<'a>(&'a self, now: Sight<'a>, prev: &'a View, us: Team) -> Input<'a> {
        Input {
            now: Some(now),
            prev: Some(Sight::Kept(prev)),
            events: &[],
            params: &self.params,
            lets: &self.lets,
            index: self.index,
            us,
            silent: false,
        }
    }

    /// What scripts are shown; none where no script is asked.
    pub fn scene(&self, now: impl FnOnce() -> View, prev: &View, events: &[Event]) -> Option<Arc<Scene>> {
        let scene = || Scene::new(now(), *prev, events, self.shown.clone(), self.random.clone(), self.key());
        self.scripted.then(|| Arc::new(scene()))
    }

    /// Takes the stream back from a scene, as far as scripts have drawn from it.
    pub fn settle(&mut self, scene: Option<Arc<Scene>>) {
        if let Some(scene) = scene {
            self.random = scene.random();
        }
    }
}
