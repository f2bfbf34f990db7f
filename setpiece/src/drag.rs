//! Dragging: the two numbers of a place in the text, for somebody who moves a player or the ball
//! in a picture of the start.
//!
//! A place is moved only if it is what the picture shows: two numbers that the scenario's own text
//! gives to this player. What is computed, inherited or written in another file is left alone, and
//! a sentence says why.

mod numbers;
mod statement;

use crate::Loaded;
use crate::engine::draw::Drawer;
use crate::render::scene::Id;
use crate::scenario::{PitchSize, PlayerSlot, Scenario};
use crate::scene::team;
use numbers::Written;
use statement::Statement;
use std::ops::Range;

/// How far a place may lie from its numbers by rounding, metres.
const NEAR_M: f64 = 0.01;

/// Some bytes of a text, and what stands there instead.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct NewNumber {
    /// The bytes.
    pub(crate) range: Range<usize>,
    /// The number, with its unit.
    pub(crate) text: String,
}

/// What is taken by the hand: a player or the ball, in the latest start that was drawn.
#[derive(Clone, Copy, Debug)]
pub(crate) struct HeldThing {
    /// Which of the scenario's players; none for the ball.
    index: Option<usize>,
    /// Where they were drawn, metres.
    from: [f64; 2],
    /// The pitch of that start.
    pitch: PitchSize,
}

impl HeldThing {
    /// A player of a start, or the ball; none if there is no such player.
    ///
    /// `drawer`: what has drawn the start, whether it meets its requirements or not.
    pub(crate) fn of(
        scenario: &Scenario,
        drawer: &Drawer,
        player: Option<Id>,
    ) -> Option<HeldThing> {
        let index = match player {
            Some(id) => Some(index_of(scenario, id)?),
            None => None,
        };
        let (x, y) = match index.and_then(|index| scenario.players.get(index)) {
            Some(slot) => (slot.start.x, slot.start.y),
            None => (scenario.start.ball.x, scenario.start.ball.y),
        };
        let from = [drawer.register(x)?, drawer.register(y)?];
        Some(HeldThing { index, from, pitch: drawer.pitch(scenario) })
    }

    /// What is to be written so that it stands elsewhere.
    ///
    /// - `loaded`: the last good scenario.
    /// - `to`: metres, in the world's frame; what lies off the pitch is put on its rim.
    ///
    /// # Errors
    /// A sentence for the user, if the place isn't two plain numbers of this text.
    pub(crate) fn moved(
        &self,
        loaded: &Loaded,
        text: &str,
        to: [f64; 2],
    ) -> Result<[NewNumber; 2], String> {
        if to.iter().any(|metres| !metres.is_finite()) {
            return Err("a place is two numbers".to_owned());
        }
        let half = [self.pitch.half_length(), self.pitch.half_width()];
        let to = [0, 1].map(|axis| to[axis].clamp(-half[axis], half[axis]));
        // A text that has changed since the last good one has its statements elsewhere.
        if loaded.sources.iter().next().is_some_and(|(_, source)| *source.text != *text) {
            return Err("mend the text first: the picture is of the last good one".to_owned());
        }
        let slots = &loaded.scenario.players;
        if self.index.and_then(|at| slots.get(at + 1)).is_some_and(|next| next.instead) {
            return Err("players of several formations share this place: edit the text".to_owned());
        }
        let statement = Statement::of(loaded, self.slot(loaded))?;
        let computed = || {
            "this place is computed, so there are no numbers to change: edit the text".to_owned()
        };
        let place = statement.place.clone().ok_or_else(computed)?;
        let written = Written::of(text, place).ok_or_else(computed)?;
        let scale = statement.scale(&written, &self.pitch);
        let metres = written.metres(text).ok_or_else(computed)?;
        let strays = [0, 1].map(|axis| self.from[axis] - metres[axis] * scale[axis]);
        if !statement.is_jittered && strays.iter().any(|stray| stray.abs() > NEAR_M) {
            return Err("another statement gives this place: edit the text".to_owned());
        }
        if let Some(other) = self.other_team(loaded) {
            return Err(format!(
                "{other} has the same formation, whose player would move, too: edit the text"
            ));
        }
        // Who is jittered is moved by as much as they were dragged: the same draw puts them there.
        let strays = if statement.is_jittered { strays } else { [0.0; 2] };
        let most = [0, 1].map(|axis| half[axis] / scale[axis].abs());
        Ok(written.with([0, 1].map(|axis| (to[axis] - strays[axis]) / scale[axis]), most))
    }

    /// The other team, if one of its players has the same statement.
    fn other_team(&self, loaded: &Loaded) -> Option<String> {
        let (index, own) = self.slot(loaded)?;
        let spans = &loaded.origins.players;
        let written = spans.get(index)?;
        let slots = spans.iter().zip(&loaded.scenario.players);
        let mut others = slots.filter(|(span, slot)| *span == written && slot.team != own.team);
        others.next().map(|(_, slot)| format!("the {} team", slot.team.name()))
    }

    fn slot<'a>(&self, loaded: &'a Loaded) -> Option<(usize, &'a PlayerSlot)> {
        let index = self.index?;
        Some((index, loaded.scenario.players.get(index)?))
    }
}

/// A text with numbers replaced.
pub(crate) fn rewritten(text: &str, [x, y]: &[NewNumber; 2]) -> String {
    let mut text = text.to_owned();
    // From the back, so that the first range stays right.
    for number in [y, x] {
        text.replace_range(number.range.clone(), &number.text);
    }
    text
}

/// Which of a scenario's players somebody in a picture is: of several who share a place in the
/// team, the first.
fn index_of(scenario: &Scenario, id: Id) -> Option<usize> {
    let players = scenario.players.iter().enumerate();
    let mut of_team = players.filter(|(_, slot)| slot.team == team(id.team) && !slot.instead);
    of_team.nth(usize::from(id.slot)).map(|(at, _)| at)
}
