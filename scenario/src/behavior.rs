//! Behaviours: what a scripted player does, as a small state machine over one register program.
//!
//! The program is run once at every step before the player acts; its registers give every condition and argument of
//! the behaviour. The nodes are gone through in order: some end a step with an action ([`Node::Do`]), the others take
//! no time. Calls of other behaviours are written out where they are called. Jumps lead forward only, but for
//! [`Node::Loop`], which costs a step if its pass has cost none: so every step ends.
//!
//! A node that writes a cell is seen by what follows in the same step: the program's values are computed anew, but for
//! those of temporal instructions, which happen once a step.

use crate::program::{Distribution, Program, Reg};
use crate::vocabulary::Type;
use serde::{Deserialize, Serialize};

/// A behaviour with its arguments, as a player uses it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Behavior {
    /// Its name, for messages.
    pub name: String,
    /// Run at every step, on the state before it; `me` is the player, `us` his team.
    pub program: Program,
    /// What is done, in order; behind the last one the bot plays him.
    pub nodes: Vec<Node>,
    /// What may turn him away, the first wins: outer blocks before inner ones, each in the order written.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub watches: Vec<Watch>,
}

/// One thing of a behaviour; targets are places in its list of nodes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Node {
    /// Acts, a step at a time, until it ends.
    Do(Do),
    /// Writes cells with the registers' present values, all at once.
    Let(Vec<(u32, Reg)>),
    /// The same for a `state`: an impossible value (NaN) is stopped and counted.
    Assign(Vec<(u32, Reg)>),
    /// Draws a value into a cell.
    Draw {
        /// The cell.
        cell: u32,
        /// A cell that counts the draws, so that each is another.
        count: u32,
        /// Names the draw's own stream, keyed by (seed, index, count, key and player).
        key: u64,
        /// From what.
        from: Distribution,
    },
    /// Goes on if the condition holds, else jumps.
    Branch {
        /// The condition.
        when: Reg,
        /// Where to else, forward.
        otherwise: u32,
    },
    /// Jumps forward.
    Jump(u32),
    /// Writes the present step's number into a cell: a pass of a loop begins.
    Mark(u32),
    /// Jumps back to the `Mark` of a loop; waits a step if the pass has cost none.
    Loop {
        /// Where the pass began.
        to: u32,
        /// The cell of its `Mark`.
        mark: u32,
    },
    /// An interrupt ends: what it interrupted resumes.
    Return,
    /// Leaves the behaviour that lies in `from..to`, whatever it had interrupted.
    Finish {
        /// Its first node.
        from: u32,
        /// Behind its last one.
        to: u32,
    },
}

/// `do …`: one primitive until it ends.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Do {
    /// What he does.
    pub act: Act,
    /// Whether he sprints.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub sprint: bool,
    /// Ends as soon as this holds.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub until: Option<Reg>,
    /// Ends after so many seconds.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub seconds: Option<Reg>,
}

/// What a player does; places are world metres, angles world radians, players ids.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Act {
    /// Runs to a place; ends within a metre of it.
    MoveTo(Reg, Reg),
    /// Runs that way.
    Run(Reg),
    /// Takes the ball to a place; ends there, and without the ball.
    DribbleTo(Reg, Reg),
    /// A short pass to a mate.
    PassTo(Reg),
    /// A lofted pass to a mate.
    HighPassTo(Reg),
    /// A pass ahead of a mate.
    LongPassTo(Reg),
    /// A shot, at a point of the goal if one is meant.
    Shoot(Option<(Reg, Reg)>),
    /// Challenges for the ball on his feet, for at most a second.
    Tackle,
    /// One slide tackle.
    Slide,
    /// Stays between an opponent and the own goal.
    Mark(Reg),
    /// Goes for the ball while the others have it or nobody has.
    Press,
    /// Stands; `wait` is the same.
    Hold,
    /// The bot plays him.
    Bot,
    /// A script's `act` hook says.
    Script {
        /// Which script.
        script: u32,
        /// The behaviour's arguments: `ctx.params` bears them beside the scenario's parameters.
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
    /// Its registers: two for a point.
    pub regs: Vec<Reg>,
}

/// What may turn a player away from what he does, while he is at a node of `from..to`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Watch {
    /// First node.
    pub from: u32,
    /// Behind the last one.
    pub to: u32,
    /// As soon as this holds before a step.
    pub when: Reg,
    /// What happens.
    pub then: Then,
}

/// What a watch does.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Then {
    /// Does what stands at this node up to its `Return`, and resumes.
    Interrupt(u32),
    /// Goes on behind `to`.
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
                Distribution::Uniform(a, b) | Distribution::Normal(a, b) | Distribution::Integer(a, b) => {
                    [a, b].into_iter().for_each(f);
                }
                Distribution::TruncatedNormal(a, b, c, d) => [a, b, c, d].into_iter().for_each(f),
                Distribution::Weighted(weights) => weights.iter_mut().for_each(f),
            },
            Node::Branch { when, .. } => f(when),
            Node::Jump(_) | Node::Mark(_) | Node::Loop { .. } | Node::Return | Node::Finish { .. } => {}
        }
    }
}

impl Act {
    fn regs_mut(&mut self, f: &mut dyn FnMut(&mut Reg)) {
        match self {
            Act::MoveTo(x, y) | Act::DribbleTo(x, y) | Act::Shoot(Some((x, y))) => [x, y].into_iter().for_each(f),
            Act::Run(reg) | Act::PassTo(reg) | Act::HighPassTo(reg) | Act::LongPassTo(reg) | Act::Mark(reg) => f(reg),
            Act::Script { args, .. } => args.iter_mut().flat_map(|arg| &mut arg.regs).for_each(f),
            Act::Shoot(None) | Act::Tackle | Act::Slide | Act::Press | Act::Hold | Act::Bot => {}
        }
    }
}
