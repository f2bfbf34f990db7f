//! The match as the last stop of play left it, before the restart.

use crate::snapshot::{Archive, SnapshotError};
use crate::state::Match;

/// The match in which the last step stopped play. Its memory is reused for the next stop.
#[derive(Debug)]
pub(super) struct Stopped {
    game: Box<Match>,
    /// Whether play was stopped in the last step; otherwise the match is an old one.
    now: bool,
}

impl Clone for Stopped {
    fn clone(&self) -> Stopped {
        Stopped { game: self.game.clone(), now: self.now }
    }

    fn clone_from(&mut self, from: &Stopped) {
        self.now = from.now;
        if from.now {
            self.game.clone_from(&from.game);
        }
    }
}

impl Stopped {
    /// Creates it without a stop; `game` may be any match.
    pub(super) fn new(game: &Match) -> Stopped {
        Stopped { game: Box::new(game.clone()), now: false }
    }

    /// Records that play continues.
    pub(super) fn forget(&mut self) {
        self.now = false;
    }

    /// Keeps a match in which play was just stopped.
    pub(super) fn note(&mut self, game: &Match) {
        self.now = game.dead;
        if game.dead {
            (*self.game).clone_from(game);
        }
    }

    /// The match, if play was stopped in the last step.
    pub(super) fn get(&self) -> Option<&Match> {
        self.now.then_some(&self.game)
    }

    /// Writes or reads the match.
    pub(super) fn archive(&mut self, archive: &mut Archive<'_>) -> Result<(), SnapshotError> {
        archive.value("was_stopped", &mut self.now)?;
        if self.now {
            archive.value("stopped", &mut *self.game)?;
        }
        Ok(())
    }
}
