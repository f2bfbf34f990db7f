//! How many starts the requirements of a scenario refuse.

use crate::Loaded;
use crate::engine::draw::{Drawer, Roster};
use crate::scenario::Bindings;

/// Attempts at a start that show it.
const ATTEMPTS: u32 = 300;
/// From this share on, an author hears of it as of something that may be meant otherwise. What
/// refuses less is a number beside the text.
const WORTH_SAYING: f64 = 0.5;

/// What attempts at the starts of a scenario show.
pub(super) struct Refusals {
    /// Attempts made.
    pub(super) attempts: u32,
    /// Attempts that met every requirement.
    met: u32,
    /// Attempts that each requirement was the first to refuse, in order.
    pub(super) by: Vec<u32>,
    /// What failed most often, in the author's words or the pitch's.
    pub(super) hardest: Option<String>,
}

impl Refusals {
    /// Those of a scenario with its usual parameters.
    pub(super) fn of(loaded: &Loaded) -> Option<Refusals> {
        let scenario = &loaded.scenario;
        let bindings = Bindings::defaults(&scenario.params);
        let roster = Roster::new(scenario, &bindings, None).ok()?;
        let found =
            Drawer::new(scenario).acceptance(scenario, &bindings, &roster, ATTEMPTS, u32::MAX);
        let (attempts, met) = (found.attempts, found.met);
        Some(Refusals { attempts, met, by: found.refused, hardest: found.hardest })
    }

    /// The share of so many attempts, 0..1.
    pub(super) fn share(&self, count: u32) -> f64 {
        f64::from(count) / f64::from(self.attempts.max(1))
    }

    /// Whether so many refused attempts are a report, and not only a number beside the text.
    pub(super) fn is_worth_saying(&self, count: u32) -> bool {
        self.share(count) >= WORTH_SAYING
    }

    /// The attempts that were refused.
    pub(super) fn all(&self) -> u32 {
        self.attempts - self.met
    }

    /// How many starts a reset draws on average, in words.
    pub(super) fn draws(&self) -> String {
        let draws = f64::from(self.attempts) / f64::from(self.met.max(1));
        if draws < 9.95 { format!("{draws:.1}") } else { format!("{draws:.0}") }
    }
}
