//! Properties that hold after every step of any match.

mod bodies;
mod film;
mod goal;
mod law;
#[cfg(test)]
mod tests;
mod waiting;

use crate::pitch::LabError;
use film::TickMemory;
use setpiece::engine::environment::Scratch;
use setpiece::engine::state::Match;
use setpiece::engine::state::event::Event;
use setpiece::scenario::vocabulary::{Action, EventKind};
use waiting::Waiting;

/// What a step covered.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Seen {
    pub(super) goals: u64,
    pub(super) set_pieces: u64,
    pub(super) cards: u64,
}

/// A step: the actions and their result.
pub(super) struct Step<'a> {
    /// The agents' actions.
    pub(super) actions: &'a [Action],
    /// The state that was judged, before any restart.
    pub(super) judged: &'a Match,
    /// The state after a restart.
    pub(super) after: &'a Match,
    /// The events, in order.
    pub(super) events: &'a [Event],
}

/// The memory from step to step.
pub(super) struct Witness {
    before: Match,
    film: TickMemory,
    waiting: Waiting,
}

/// An error unless a condition holds.
fn must(holds: bool, why: impl FnOnce() -> String) -> Result<(), LabError> {
    if holds { Ok(()) } else { Err(why()) }
}

impl Witness {
    /// Begins at a start.
    pub(super) fn new(start: &Match) -> Result<Witness, LabError> {
        bodies::sound(start)?;
        Ok(Witness {
            before: start.clone(),
            film: TickMemory::default(),
            waiting: Waiting::default(),
        })
    }

    /// Checks a step.
    pub(super) fn see(&mut self, step: &Step, scratch: &mut Scratch) -> Result<Seen, LabError> {
        use EventKind::{
            Corner, FreeKick, Goal, GoalKick, Kickoff, Penalty, RedCard, ThrowIn, YellowCard,
        };
        for game in [step.judged, step.after] {
            bodies::sound(game)?;
        }
        bodies::hold(&self.before, step.judged)?;
        law::hold(&self.before, step)?;
        self.waiting.hold(step)?;
        self.film.watch(&self.before, step, scratch)?;
        let of = |kinds: &[EventKind]| {
            step.events
                .iter()
                .filter(|event| kinds.contains(&event.kind) && event.qualifier.is_none())
                .count() as u64
        };
        self.before.clone_from(step.after);
        Ok(Seen {
            goals: of(&[Goal]),
            set_pieces: of(&[Corner, FreeKick, GoalKick, Kickoff, Penalty, ThrowIn]),
            cards: of(&[YellowCard, RedCard]),
        })
    }
}
