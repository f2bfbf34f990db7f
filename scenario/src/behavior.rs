//! Behaviours: what a scripted player does, as a small state machine with one register program.
//!
//! The program runs once in every step, before the player acts. Its registers give every condition
//! and argument of the behaviour. The nodes run in order: some end a step with an action
//! ([`Node::Do`]), the others take no time. Calls of other behaviours are inlined. Jumps lead only
//! forward, except [`Node::Loop`], which takes a step if its iteration has taken none. So every
//! step ends.
//!
//! A node that writes a cell affects what follows in the same step: the program's values are
//! computed again, except those of temporal instructions, which run once per step.

use crate::program::{Distribution, Program, Reg};
use crate::vocabulary::Type;
use serde::{Deserialize, Serialize};

/// A behaviour with its arguments, as a player uses it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Behavior {
    /// Its name, for messages.
    pub name: String,
    /// Runs in every step, on the state before it. `me` is the player, `us` their team.
    pub program: Program,
    /// What the player does, in order. After the last node the bot plays them.
    pub nodes: Vec<Node>,
    /// What may redirect the player. The first that holds wins: outer blocks before inner ones,
    /// each in source order.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub watches: Vec<Watch>,
}

/// One instruction of a behaviour. Targets are indices in its list of nodes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Node {
    /// Acts, one step at a time, until it ends.
    Do(Do),
    /// Writes the registers' current values into cells, all at once.
    Let(Vec<(u32, Reg)>),
    /// The same for a `state`. An impossible value (NaN) is dropped and counted.
    Assign(Vec<(u32, Reg)>),
    /// Draws a value into a cell.
    Draw {
        /// The cell.
        cell: u32,
        /// A cell that counts the draws, so that each differs.
        count: u32,
        /// Key of the draw's own stream, together with (seed, index, count and player).
        key: u64,
        /// The distribution.
        from: Distribution,
    },
    /// Continues if the condition holds, else jumps.
    Branch {
        /// The condition.
        when: Reg,
        /// The target otherwise, forward.
        otherwise: u32,
    },
    /// Jumps forward.
    Jump(u32),
    /// Writes the current step's number into a cell at the start of a loop's iteration.
    Mark(u32),
    /// Jumps back to the `Mark` of a loop; waits a step if the iteration has taken none.
    Loop {
        /// The start of the iteration.
        to: u32,
        /// The cell of its `Mark`.
        mark: u32,
    },
    /// Ends an interrupt; what it interrupted resumes.
    Return,
    /// Leaves the behaviour in `from..to`, with everything that it had interrupted.
    Finish {
        /// Its first node.
        from: u32,
        /// The node after its last one.
        to: u32,
    },
}

/// `do …`: one primitive until it ends.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Do {
    /// The primitive.
    pub act: Act,
    /// Whether the player sprints.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub sprint: bool,
    /// Ends as soon as this holds.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub until: Option<Reg>,
    /// Ends after this many seconds.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub seconds: Option<Reg>,
}

/// What a player does. Places are world metres, angles world radians, players ids.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Act {
    /// Runs to a place; ends within a metre of it.
    MoveTo(Reg, Reg),
    /// Runs in a direction.
    Run(Reg),
    /// Takes the ball to a place; ends there, or when the ball is lost.
    DribbleTo(Reg, Reg),
    /// A short pass to a teammate.
    PassTo(Reg),
    /// A lofted pass to a teammate.
    HighPassTo(Reg),
    /// A pass ahead of a teammate.
    LongPassTo(Reg),
    /// A shot, at a point of the goal if one is given.
    Shoot(Option<(Reg, Reg)>),
    /// Challenges for the ball on their feet, for at most a second.
    Tackle,
    /// One slide tackle.
    Slide,
    /// Stays between an opponent and the own goal.
    Mark(Reg),
    /// Goes for the ball while the team doesn't have it.
    Press,
    /// Stands; `wait` is the same.
    Hold,
    /// Lets the bot play the player.
    Bot,
    /// Does what a script's `act` hook returns.
    Script {
        /// The script's index.
        script: u32,
        /// The behaviour's arguments; `ctx.params` has them in addition to the scenario's
        /// parameters.
        #[serde(default, skip_serializing_if = "Vec::is_empty")]
        args: Vec<ScriptArg>,
    },
}

/// An argument of a behaviour that is a script.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ScriptArg {
    /// Its name.
    pub name: String,
    /// Its type.
    pub ty: Type,
    /// Its registers; two for a point.
    pub regs: Vec<Reg>,
}

/// What may redirect a player who is at a node of `from..to`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Watch {
    /// First node.
    pub from: u32,
    /// The node after the last one.
    pub to: u32,
    /// Applies as soon as this holds before a step.
    pub when: Reg,
    /// What it does.
    pub then: Then,
}

/// What a watch does.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Then {
    /// Runs this node and the following ones up to `Return`, then resumes.
    Interrupt(u32),
    /// Continues after `to`.
    Leave,
}

impl Behavior {
    /// Calls `f` with every register that nodes and watches read.
    pub fn regs_mut(&mut self, f: &mut dyn FnMut(&mut Reg)) {
        for node in &mut self.nodes {
            node.regs_mut(f);
        }
        for watch in &mut self.watches {
            f(&mut watch.when);
        }
    }
}

impl Node {
    /// Calls `f` with every register the node reads.
    pub fn regs_mut(&mut self, f: &mut dyn FnMut(&mut Reg)) {
        match self {
            Node::Do(doing) => {
                doing.until.iter_mut().chain(&mut doing.seconds).for_each(&mut *f);
                doing.act.regs_mut(f);
            }
            Node::Let(pairs) | Node::Assign(pairs) => pairs.iter_mut().for_each(|(_, reg)| f(reg)),
            Node::Draw { from, .. } => match from {
                Distribution::Uniform(a, b)
                | Distribution::Normal(a, b)
                | Distribution::Integer(a, b) => {
                    [a, b].into_iter().for_each(f);
                }
                Distribution::TruncatedNormal(a, b, c, d) => [a, b, c, d].into_iter().for_each(f),
                Distribution::Weighted(weights) => weights.iter_mut().for_each(f),
            },
            Node::Branch { when, .. } => f(when),
            Node::Jump(_)
            | Node::Mark(_)
            | Node::Loop { .. }
            | Node::Return
            | Node::Finish { .. } => {}
        }
    }
}

impl Act {
    fn regs_mut(&mut self, f: &mut dyn FnMut(&mut Reg)) {
        match self {
            Act::MoveTo(x, y) | Act::DribbleTo(x, y) | Act::Shoot(Some((x, y))) => {
                [x, y].into_iter().for_each(f);
            }
            Act::Run(reg)
            | Act::PassTo(reg)
            | Act::HighPassTo(reg)
            | Act::LongPassTo(reg)
            | Act::Mark(reg) => f(reg),
            Act::Script { args, .. } => args.iter_mut().flat_map(|arg| &mut arg.regs).for_each(f),
            Act::Shoot(None) | Act::Tackle | Act::Slide | Act::Press | Act::Hold | Act::Bot => {}
        }
    }
}
