//! The register program: the compiled form of everything computed in a scenario.
//!
//! A program is straight-line code over `f64` registers. **Instruction `i` writes register `i`**
//! and reads only earlier ones. So a program needs no register allocation, shares equal
//! subexpressions, and can be checked in one pass ([`crate::verify`]). The only control flow is
//! [`Instr::Each`], which runs the instructions after it once per player, event or number. Their
//! number is bounded, so every program ends.
//!
//! - Booleans are 0 and 1, teams 0 (left), 1 (right) and -1 (none), players are ids `team * 11 +
//!   index` or -1 (nobody).
//! - Values are SI in the world frame; a point takes two registers.
//! - An impossible result (a division by zero, the root of a negative number, a property of nobody,
//!   the least of an empty set) is NaN. NaN propagates through arithmetic, compares false, and
//!   stops at effects: a `Give` or `Assign` of NaN has no effect and counts as a fault. Selecting
//!   the other branch drops it.
//! - Temporal instructions and effects own memory *cells*, which live as long as the episode. Every
//!   temporal instruction runs exactly once per step, whatever guards the effects that use it.
//! - On the start state of an episode a step program runs once *silently*: temporal instructions
//!   see it, but effects don't happen.

use crate::table::Table;
use crate::vocabulary::{EventField, EventKind, Field, Qualifier};
use serde::{Deserialize, Serialize};

/// A register, named by the instruction that writes it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(transparent)]
pub struct Reg(pub u32);

impl Reg {
    /// The register as an index.
    #[inline]
    pub const fn index(self) -> usize {
        self.0 as usize
    }
}

/// A program and the memory it needs.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Program {
    /// The instructions, in order.
    pub code: Vec<Instr>,
    /// Number of memory cells, all 0 at reset until `init` code assigns them.
    pub cells: u32,
    /// Its tables of numbers.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub tables: Vec<Table>,
}

/// The most that one `give` pays. A step's reward is a float32, which can hold hundreds of millions
/// of these.
pub const PAY_MAX: f64 = 1.0e30;

impl Program {
    /// Whether a value of the program depends on the agent's player (`me`), so that it must run
    /// once per agent.
    pub fn uses_me(&self) -> bool {
        self.code.iter().any(|instr| matches!(instr, Instr::Me))
    }
}

/// Whether a load reads the current state or that of the last step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum When {
    /// The state after this step.
    #[default]
    Now,
    /// The state at the end of the previous step, after restarts.
    Prev,
}

/// One instruction. Instruction `i` writes register `i`; effects write 0 there.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Instr {
    /// A finite constant.
    Const(f64),
    /// A bound parameter of the scenario, by its index in
    /// [`Scenario::params`](crate::Scenario::params).
    Param(u32),
    /// A scenario `let`, by its index in [`Start::lets`](crate::Start::lets); not in the start
    /// program itself.
    Let(u32),
    /// The episode's index, counted since the last seeded reset.
    EpisodeIndex,
    /// The round of the episode, from 1 on.
    Round,
    /// Seconds since the round began.
    RoundElapsed,
    /// A unary operator.
    Unary(UnaryOp, Reg),
    /// A binary operator.
    Binary(BinaryOp, Reg, Reg),
    /// `if 0 then 1 else 2`.
    Select(Reg, Reg, Reg),
    /// A number of one of [`Program::tables`].
    Table {
        /// Which.
        table: u32,
        /// Share of its length.
        x: Reg,
        /// Share of its width.
        y: Reg,
        /// Whether it is linear between the centres of cells, else the number of the cell.
        #[serde(default, skip_serializing_if = "std::ops::Not::not")]
        linear: bool,
    },
    /// Whether the episode terminates in this step: 1 or 0. The limit doesn't terminate it.
    /// Rewards and records know it; endings, which decide it, and everything else read 0.
    Terminated,
    /// The team of the agent that is judged.
    Us,
    /// The player that the agent controls now, or -1.
    Me,
    /// A number of the match. `of` is a player or team; absent for the ball and the match.
    Load {
        /// The field.
        field: Field,
        /// The player or team.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        of: Option<Reg>,
        /// The current or the last state.
        #[serde(default, skip_serializing_if = "is_now")]
        when: When,
    },
    /// A field of the current event of the innermost `Each` over events.
    Event(EventField),
    /// A loop; see [`Each`].
    Each(Box<Each>),
    /// The value of a memory cell.
    Cell(u32),
    /// Whether `0` held in every step of the last `seconds`; the cell counts the consecutive steps.
    Held {
        /// The condition.
        of: Reg,
        /// The duration, seconds.
        seconds: Reg,
        /// Consecutive steps.
        cell: u32,
    },
    /// Whether the condition has held in any step so far.
    Ever {
        /// The condition.
        of: Reg,
        /// 1 once it has held.
        cell: u32,
    },
    /// Seconds since the condition last held, infinite before.
    Since {
        /// The condition.
        of: Reg,
        /// 0 before it has held, else 1 + the steps since.
        cell: u32,
    },
    /// Whether `of` held in every step until `release` first held (1 while undecided).
    Until {
        /// What must hold.
        of: Reg,
        /// What ends the obligation.
        release: Reg,
        /// 0 undecided, 1 released, 2 broken.
        cell: u32,
    },
    /// What the value was when the last step was judged, before any restart; in the silent run what
    /// it is. A value that can't be computed leaves the last one in place.
    Before {
        /// The value.
        of: Reg,
        /// The value in the last step.
        cell: u32,
    },
    /// 1 in the first step in which the condition holds, else 0; never in the silent run.
    Once {
        /// The condition.
        of: Reg,
        /// 1 once it has held.
        cell: u32,
    },
    /// Effect: pays `value` into a term of the reward.
    Give {
        /// The term's index in the reward's list.
        term: u32,
        /// The amount.
        value: Reg,
        /// Only if this holds.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        guard: Option<Reg>,
    },
    /// Effect: writes a memory cell; later instructions of this step see it.
    Assign {
        /// The cell.
        cell: u32,
        /// Its new value.
        value: Reg,
        /// Only if this holds.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        guard: Option<Reg>,
    },
    /// A random draw; only in the start program.
    Random {
        /// Key of the draw's own stream, together with (seed, index, attempt), so that a new draw
        /// doesn't change the others. It is a hash of what is drawn (the `let`'s name, the player's
        /// label or index) and of the draw's ordinal in it.
        key: u64,
        /// The distribution.
        from: Box<Distribution>,
    },
}

#[allow(clippy::trivially_copy_pass_by_ref, reason = "serde's signature")]
fn is_now(when: &When) -> bool {
    *when == When::Now
}

/// A loop over players, events or numbers: runs the next `body` instructions once per element.
///
/// While the body runs, the register of the `Each` itself holds the element (a player id, an
/// event's number, a number). Afterwards it holds the result of the fold. Registers written in the
/// body may only be read in the body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Each {
    /// The elements, in order: left before right, by index; events as they happened.
    pub over: Over,
    /// Number of instructions in the body.
    pub body: u32,
    /// The fold over the elements.
    pub fold: Fold,
}

/// The elements of an [`Each`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Over {
    /// The players on the pitch of a team (-1: of both), optionally without one of them.
    Players {
        /// The team; -1 for both.
        team: Reg,
        /// A player to leave out.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        except: Option<Reg>,
    },
    /// The events of this step that match a filter.
    Events(EventFilter),
    /// The numbers from 0 on, this many.
    Numbers(u32),
}

/// A filter for events.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct EventFilter {
    /// The kind.
    pub kind: EventKind,
    /// The required qualifier. The compiler writes a bare `pass` with `attempted`. For a bare set
    /// piece the award counts, for a bare `shot` the moment it is struck: the events without a
    /// qualifier.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub qualifier: Option<Qualifier>,
    /// The required team or player.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub by: Option<Who>,
    /// The required receiving team or player.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub to: Option<Who>,
}

/// A team or a player, as a filter.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Who {
    /// A team.
    Team(Reg),
    /// A player.
    Player(Reg),
}

/// The fold over the elements of an [`Each`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Fold {
    /// How values are combined.
    pub kind: FoldKind,
    /// The value per element; absent for `Count` and `Nothing`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub value: Option<Reg>,
    /// Only elements for which this holds.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub guard: Option<Reg>,
}

/// How the values of the elements are combined.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum FoldKind {
    /// Runs the loop only for its effects; the result is 0.
    Nothing,
    /// The number of elements.
    Count,
    /// The total; 0 without elements.
    Sum,
    /// The average; NaN without elements.
    Mean,
    /// The least; NaN without elements.
    Min,
    /// The greatest; NaN without elements.
    Max,
    /// Whether any value is true; false without elements.
    Any,
    /// Whether every value is true; true without elements.
    All,
    /// The element with the least value, the first of equals; -1 for none.
    ArgMin,
    /// The element with the greatest value, the first of equals; -1 for none.
    ArgMax,
}

/// A unary operator.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum UnaryOp {
    /// Negation.
    Neg,
    /// Logical not.
    Not,
    /// Absolute value.
    Abs,
    /// Square root; NaN below 0.
    Sqrt,
    /// e to the power.
    Exp,
    /// Natural logarithm; NaN at or below 0.
    Log,
    /// Rounded down.
    Floor,
    /// Rounded up.
    Ceil,
    /// Rounded to the nearest whole number, halves away from 0.
    Round,
    /// Sine of radians.
    Sin,
    /// Cosine of radians.
    Cos,
    /// +1 for team 0, -1 for team 1, NaN for none: converts own-frame lengths to world lengths and
    /// back.
    Side,
    /// The other team; -1 for none.
    OtherTeam,
    /// The team of a player; -1 for nobody.
    TeamOf,
    /// Whether a player is on the pitch (not -1 and active).
    Exists,
    /// An angle wrapped to -π..π.
    Wrap,
}

/// A binary operator.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum BinaryOp {
    /// Sum.
    Add,
    /// Difference.
    Sub,
    /// Product.
    Mul,
    /// Quotient; NaN for a zero divisor.
    Div,
    /// Remainder with the divisor's sign; NaN for a zero divisor.
    Mod,
    /// Power.
    Pow,
    /// The lesser.
    Min,
    /// The greater.
    Max,
    /// √(a² + b²).
    Hypot,
    /// Angle of the vector (b, a), as in `atan2(a, b)`.
    Atan2,
    /// Less than.
    Lt,
    /// At most.
    Le,
    /// Greater than.
    Gt,
    /// At least.
    Ge,
    /// Equal; two NaN aren't.
    Eq,
    /// Not equal; false if one is NaN.
    Ne,
    /// Logical and.
    And,
    /// Logical or.
    Or,
}

/// A distribution of the start program.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Distribution {
    /// Between two ends.
    Uniform(Reg, Reg),
    /// Mean and standard deviation.
    Normal(Reg, Reg),
    /// Mean, standard deviation, low and high end.
    TruncatedNormal(Reg, Reg, Reg, Reg),
    /// A whole number between two ends, both included.
    Integer(Reg, Reg),
    /// An index, by weights.
    Weighted(Vec<Reg>),
}

impl Program {
    /// Which registers are the same in every step of an episode, because they depend only on
    /// parameters and `let`s.
    pub fn fixed(&self) -> Vec<bool> {
        let mut fixed = vec![false; self.code.len()];
        let mut at = 0;
        while let Some(instr) = self.code.get(at) {
            let mut all = match instr {
                Instr::Unary(op, _) => *op != UnaryOp::Exists,
                Instr::Const(_)
                | Instr::Param(_)
                | Instr::Let(_)
                | Instr::EpisodeIndex
                | Instr::Binary(..)
                | Instr::Select(..)
                | Instr::Table { .. } => true,
                _ => false,
            };
            instr.operands(&mut |reg| all &= fixed.get(reg.index()).copied().unwrap_or_default());
            fixed[at] = all;
            // Registers in a loop depend on its elements.
            at += match instr {
                Instr::Each(each) => 1 + each.body as usize,
                _ => 1,
            };
        }
        fixed
    }
}

impl Instr {
    /// Whether it remembers earlier steps: an operator over time.
    pub fn looks_back(&self) -> bool {
        matches!(
            self,
            Instr::Held { .. }
                | Instr::Ever { .. }
                | Instr::Since { .. }
                | Instr::Until { .. }
                | Instr::Before { .. }
                | Instr::Once { .. }
        )
    }

    /// Calls `f` with every register that the instruction reads, except those of an `Each`'s fold,
    /// which are in its body.
    pub fn operands(&self, f: &mut dyn FnMut(Reg)) {
        match self {
            Instr::Const(_)
            | Instr::Param(_)
            | Instr::Let(_)
            | Instr::EpisodeIndex
            | Instr::Round
            | Instr::RoundElapsed
            | Instr::Terminated
            | Instr::Us
            | Instr::Me
            | Instr::Event(_)
            | Instr::Cell(_) => {}
            Instr::Unary(_, a) => f(*a),
            Instr::Binary(_, a, b) => {
                f(*a);
                f(*b);
            }
            Instr::Select(a, b, c) => {
                f(*a);
                f(*b);
                f(*c);
            }
            Instr::Table { x, y, .. } => {
                f(*x);
                f(*y);
            }
            Instr::Load { of, .. } => of.iter().for_each(|&reg| f(reg)),
            Instr::Each(each) => match &each.over {
                Over::Players { team, except } => {
                    f(*team);
                    if let Some(reg) = except {
                        f(*reg);
                    }
                }
                Over::Numbers(_) => {}
                Over::Events(filter) => {
                    for who in filter.by.iter().chain(&filter.to) {
                        match who {
                            Who::Team(reg) | Who::Player(reg) => f(*reg),
                        }
                    }
                }
            },
            Instr::Held { of, seconds, .. } => {
                f(*of);
                f(*seconds);
            }
            Instr::Ever { of, .. }
            | Instr::Since { of, .. }
            | Instr::Before { of, .. }
            | Instr::Once { of, .. } => f(*of),
            Instr::Until { of, release, .. } => {
                f(*of);
                f(*release);
            }
            Instr::Give { value, guard, .. } | Instr::Assign { value, guard, .. } => {
                f(*value);
                if let Some(reg) = guard {
                    f(*reg);
                }
            }
            Instr::Random { from, .. } => match &**from {
                Distribution::Uniform(a, b)
                | Distribution::Normal(a, b)
                | Distribution::Integer(a, b) => {
                    f(*a);
                    f(*b);
                }
                Distribution::TruncatedNormal(a, b, c, d) => {
                    for &reg in [a, b, c, d] {
                        f(reg);
                    }
                }
                Distribution::Weighted(weights) => weights.iter().for_each(|&reg| f(reg)),
            },
        }
    }

    /// The memory cell that the instruction uses.
    pub fn cell(&self) -> Option<u32> {
        match self {
            Instr::Cell(cell)
            | Instr::Held { cell, .. }
            | Instr::Ever { cell, .. }
            | Instr::Since { cell, .. }
            | Instr::Until { cell, .. }
            | Instr::Before { cell, .. }
            | Instr::Once { cell, .. }
            | Instr::Assign { cell, .. } => Some(*cell),
            _ => None,
        }
    }
}
