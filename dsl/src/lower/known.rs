//! What the programs keep while they are written: each kind of program has its own.

use super::people::Presence;
use super::value::{Scope, Value};
use crate::ast::{Arg, BehaviorItem, ScriptRef, Span};
use crate::origins::{RegionOrigin, RequireOrigin};
use setpiece_scenario::vocabulary::{PitchFigure, Primitive, StartKind, Team};
use setpiece_scenario::{Ai, Distribution, Reg, Require, When};
use std::collections::BTreeMap;

/// A player's places at kick-offs: when their team kicks off, and when the others do.
pub(crate) type Layouts = ((Reg, Reg), (Reg, Reg));

/// What the start program knows so far.
#[derive(Default)]
pub(crate) struct StartState<'w> {
    /// Start places by roster.
    pub(crate) places: Vec<OnDemand<(Reg, Reg)>>,
    /// Headings by roster.
    pub(crate) headings: Vec<OnDemand<Reg>>,
    /// Layouts of kick-offs by roster: kicking, receiving.
    pub(crate) layouts: Vec<Option<Layouts>>,
    /// What decides whether they take part, by roster.
    pub(crate) presence: Vec<OnDemand<Presence>>,
    /// The drawn numbers of players, by their team and statement.
    pub(crate) numbers: Vec<(Team, Span, Reg)>,
    /// When each of a team's formations is meant, by the expression that chooses one.
    pub(crate) formations: Vec<(Team, Span, Vec<Option<Reg>>)>,
    /// The ball's place.
    pub(crate) ball: OnDemand<(Reg, Reg)>,
    /// What must hold of values that are known at the draw only.
    pub(crate) implied: Vec<(Require, RequireOrigin)>,
    /// The pitch's figures that are lowered, by their index.
    pub(crate) pitch: [Option<Reg>; PitchFigure::ALL.len()],
    /// The regions in which something is drawn.
    pub(crate) drawn_in: Vec<RegionOrigin>,
    /// Whether a requirement is being lowered.
    pub(crate) is_requiring: bool,
    /// The regions that requirements ask about.
    pub(crate) asked_about: Vec<RegionOrigin>,
    /// The `let`s that are lowered; none where one is being lowered.
    pub(crate) lets: BTreeMap<&'w str, Option<Value<'w>>>,
    /// The team that kicks off first, if somebody asked.
    pub(crate) first: Option<Reg>,
    /// How play begins, and who takes a set piece.
    pub(crate) kind: Option<(StartKind, Option<Reg>)>,
}

/// The streams that draws come from.
#[derive(Default)]
pub(crate) struct Streams {
    pub(super) drawing: String,
    draws: BTreeMap<String, u32>,
}

impl Streams {
    /// The name of what is being drawn.
    pub(crate) fn drawing(&self) -> &str {
        &self.drawing
    }

    /// Says what is drawn from now on; gives what was drawn before.
    pub(crate) fn draw_for(&mut self, name: &str) -> String {
        std::mem::replace(&mut self.drawing, name.to_owned())
    }

    /// The next draw's ordinal in its stream.
    pub(crate) fn next_draw(&mut self) -> u32 {
        let ordinal = self.draws.entry(self.drawing.clone()).or_default();
        *ordinal += 1;
        *ordinal - 1
    }
}

/// A thing whose place is found on demand.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum OnDemand<T> {
    /// Nobody asked yet.
    #[default]
    Todo,
    /// Being computed: whoever asks now closes a circle.
    Busy,
    /// Known.
    Done(T),
}

/// What a program of a step keeps of the scenario's rewards and records.
#[derive(Default)]
pub(crate) struct Remembered<'w> {
    /// The rewards whose states it reads, each with their scope; `None` after a report.
    pub(crate) rewards: Vec<(String, Option<Scope<'w>>)>,
    /// The records that it reads, each as it is or as it was a step ago.
    pub(crate) records: Vec<(&'w str, When, Value<'w>)>,
    /// Whether it must be kept for each agent, whatever it reads.
    pub(crate) per_agent: bool,
    /// Whether it has read an agent's own view: that agent or their team.
    pub(crate) has_view: bool,
    /// Where an ending reads what is being written: a record, or a reward's state.
    pub(crate) ending_reads: Option<Span>,
}

/// Who plays a player without an agent.
#[derive(Clone)]
pub(crate) enum PlayedBy<'w> {
    /// One of the built-in ones.
    BuiltIn(Ai),
    /// A behaviour of the text.
    Behavior(BehaviorUse<'w>),
}

/// A behaviour and who uses it: a player by the roster, and which of their alternatives it is.
pub(crate) struct Scripted<'w> {
    /// The player.
    pub(crate) index: usize,
    /// The alternative.
    pub(crate) which: usize,
    /// The behaviour.
    pub(crate) used: BehaviorUse<'w>,
}

/// What a player's `ai` names.
#[derive(Clone)]
pub(crate) enum BehaviorUse<'w> {
    /// A behaviour.
    Named {
        /// Which.
        item: &'w BehaviorItem,
        /// The arguments.
        args: &'w [Arg],
        /// In which scope they are read.
        scope: Scope<'w>,
        /// The whole expression.
        span: Span,
    },
    /// What a `do` does, from the first step to the last.
    Act {
        /// Which act.
        primitive: Primitive,
        /// The arguments.
        args: &'w [Arg],
        /// In which scope they are read.
        scope: Scope<'w>,
        /// The whole expression.
        span: Span,
    },
    /// A script.
    Script(&'w ScriptRef),
}

/// A draw that happens when a statement is reached.
pub(crate) struct Draw {
    /// Where the value goes.
    pub(crate) cell: u32,
    /// How often it has been drawn.
    pub(crate) count: u32,
    /// The name of its stream.
    pub(crate) key: u64,
    /// From what.
    pub(crate) from: Distribution,
}
