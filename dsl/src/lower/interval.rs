//! The least and greatest value a register can have, as far as parameters' ranges and draws tell.

mod kept;

use super::builder::Builder;
use setpiece_scenario::bounds::EVENTS_MAX;
use setpiece_scenario::pitch::{PLAYERS_MAX, STEP_S, STEPS_PER_S, TEAM_MAX};
use setpiece_scenario::vocabulary::Field;
use setpiece_scenario::{BinaryOp, Distribution, EventFilter, FoldKind, Instr, Over, Reg, UnaryOp};
use std::cell::{Cell, RefCell};

/// A closed interval.
pub(crate) type Interval = (f64, f64);

/// That of a condition that never holds.
const NEVER: Interval = (0.0, 0.0);

/// What a number of the match can be, generously: metres, m/s, radians. The ball may fly on a
/// little beyond the lines.
fn of_field(field: Field, in_play: &InPlay<'_>) -> Option<Interval> {
    Some(match field {
        Field::BallX | Field::PlayerX => (-80.0, 80.0),
        Field::BallY | Field::PlayerY => (-60.0, 60.0),
        Field::BallHeight => (0.0, in_play.highest_ball),
        Field::BallVx | Field::BallVy | Field::BallVz => (-100.0, 100.0),
        Field::PlayerVx | Field::PlayerVy => (-15.0, 15.0),
        Field::PlayerFatigue => (0.0, 1.0),
        Field::PlayerYellowCards => (0.0, 2.0),
        Field::Score => (0.0, u16::MAX.into()),
        Field::PlayerHeading => (-4.0, 4.0),
        _ => return None,
    })
}

/// The interval of a register, if it is bounded; `params` are the parameters' ranges, in order.
pub(crate) fn interval(code: &Builder, reg: Reg, params: &[Option<Interval>]) -> Option<Interval> {
    Search::new(code, params, None).bounded(reg, 0)
}

/// Whether a condition never holds, whatever happens in the match.
pub(crate) fn never_holds(
    code: &Builder,
    reg: Reg,
    params: &[Option<Interval>],
    in_play: InPlay<'_>,
) -> bool {
    Search::new(code, params, Some(in_play)).bounded(reg, 0) == Some(NEVER)
}

/// What is known of a match under way.
#[derive(Clone, Copy)]
pub(crate) struct InPlay<'a> {
    /// How long it lasts, seconds, if that is known.
    pub(crate) longest: Option<f64>,
    /// How long each of its rounds lasts, seconds, if that is known.
    pub(crate) longest_round: Option<f64>,
    /// How many rounds it has, if that is known.
    pub(crate) rounds: Option<f64>,
    /// Whether the parts of an `and` are looked at together.
    pub(crate) joint: bool,
    /// Whether it is known that what only grows is never less than at its beginning.
    pub(crate) counts_up: bool,
    /// Higher than the ball rises, metres.
    pub(crate) highest_ball: f64,
    /// Whether an event that passes a filter can happen.
    pub(crate) happens: &'a dyn Fn(&EventFilter) -> bool,
}

/// Most registers that are looked at: what is shared is looked at again and again.
const VISITS_MAX: u32 = 4_000;
/// Deepest nesting that is looked into.
const DEPTH_MAX: u32 = 64;
/// Most parts of an `and` that are looked at together.
const CONJUNCTS_MAX: usize = 16;

struct Search<'a> {
    code: &'a Builder,
    params: &'a [Option<Interval>],
    /// What the match can show, if that counts.
    in_play: Option<InPlay<'a>>,
    visits: Cell<u32>,
    /// The cells that are being looked at.
    cells: RefCell<Vec<u32>>,
}

impl<'a> Search<'a> {
    fn new(
        code: &'a Builder,
        params: &'a [Option<Interval>],
        in_play: Option<InPlay<'a>>,
    ) -> Search<'a> {
        let (visits, cells) = (Cell::new(VISITS_MAX), RefCell::default());
        Search { code, params, in_play, visits, cells }
    }
}

impl Search<'_> {
    fn bounded(&self, reg: Reg, depth: u32) -> Option<Interval> {
        self.visits.set(self.visits.get().checked_sub(1)?);
        if depth > DEPTH_MAX {
            return None;
        }
        let of = |reg: Reg| self.bounded(reg, depth + 1);
        let in_play = self.in_play.as_ref();
        let found = match self.code.instr(reg)? {
            Instr::Const(value) => (*value, *value),
            Instr::Param(index) => self.params.get(*index as usize).copied().flatten()?,
            Instr::Unary(UnaryOp::Side, _) if in_play.is_some() => (-1.0, 1.0),
            Instr::Unary(op, a) => unary(*op, of(*a)?)?,
            // One half that never holds is enough, whatever the other one is.
            Instr::Binary(BinaryOp::And, a, b)
                if of(*a) == Some(NEVER) || of(*b) == Some(NEVER) =>
            {
                NEVER
            }
            Instr::Binary(BinaryOp::And, a, b)
                if in_play.is_some_and(|known| known.joint) && self.exclude([*a, *b], depth) =>
            {
                NEVER
            }
            Instr::Binary(op, a, b) => binary(*op, of(*a)?, of(*b)?)?,
            Instr::Ever { of: holds, .. } if in_play.is_some() && of(*holds) == Some(NEVER) => {
                NEVER
            }
            Instr::Held { of: holds, seconds, .. } => {
                let too_long = in_play?.longest.zip(of(*seconds)).is_some_and(|(longest, held)| {
                    // The start counts, too.
                    (held.0 * STEPS_PER_S).round() > (longest * STEPS_PER_S).round() + 1.0
                });
                if too_long || of(*holds) == Some(NEVER) { NEVER } else { (0.0, 1.0) }
            }
            Instr::Round => (1.0, in_play?.rounds?),
            Instr::RoundElapsed => {
                let bounds = [in_play?.longest, in_play?.longest_round];
                (0.0, bounds.into_iter().flatten().reduce(f64::min)?)
            }
            Instr::Table { table, .. } => {
                let numbers = self.code.numbers_of(*table).iter();
                numbers.fold(None, |found: Option<Interval>, &number| {
                    let (low, high) = found.unwrap_or((number, number));
                    Some((low.min(number), high.max(number)))
                })?
            }
            Instr::Load { field: Field::Elapsed | Field::Remaining, .. } => {
                (0.0, in_play?.longest?)
            }
            Instr::Load { field, .. } => of_field(*field, in_play?)?,
            Instr::Cell(cell) => self.kept(*cell, depth)?,
            Instr::Each(each) => match (each.fold.kind, &each.over) {
                (FoldKind::Count, Over::Events(filter)) if !(in_play?.happens)(filter) => NEVER,
                _ if in_play.is_none() => return None,
                (FoldKind::Count, Over::Players { team, .. }) => {
                    let both = self.code.constant_of(*team).is_some_and(|team| team < 0.0);
                    (0.0, if both { PLAYERS_MAX } else { TEAM_MAX } as f64)
                }
                (FoldKind::Count, Over::Events(_)) => (0.0, EVENTS_MAX as f64),
                _ => return None,
            },
            Instr::Select(_, a, b) => {
                let (a, b) = (of(*a)?, of(*b)?);
                (a.0.min(b.0), a.1.max(b.1))
            }
            Instr::Random { from, .. } => match &**from {
                Distribution::Uniform(low, high)
                | Distribution::Integer(low, high)
                | Distribution::TruncatedNormal(_, _, low, high) => (of(*low)?.0, of(*high)?.1),
                Distribution::Normal(..) | Distribution::Weighted(_) => return None,
            },
            _ => return None,
        };
        (found.0.is_finite() && found.1.is_finite()).then_some(found)
    }

    /// Whether conditions can't hold in the same step.
    fn exclude(&self, parts: [Reg; 2], depth: u32) -> bool {
        let parts = self.conjuncts(parts);
        let is_denied = |part: &Reg| match self.code.instr(*part) {
            Some(Instr::Unary(UnaryOp::Not, of)) => parts.contains(of),
            _ => false,
        };
        let orders: Vec<Order> = parts.iter().flat_map(|part| self.orders(*part)).collect();
        let clash = |below: &Order, above: &Order| {
            let is_strict = below.strict || above.strict;
            if below.less == above.more {
                return is_strict;
            }
            let known = |reg: Reg| self.code.constant_of(reg);
            if let (Some(least), Some(most)) = (known(below.less), known(above.more)) {
                return least > most || least == most && is_strict;
            }
            let of = |reg: Reg| self.bounded(reg, depth + 1);
            of(below.less).zip(of(above.more)).is_some_and(|(least, most)| apart(most, least))
        };
        parts.iter().any(is_denied)
            || orders.iter().any(|below| {
                let mut ends = orders.iter().filter(|above| above.less == below.more);
                ends.any(|above| clash(below, above))
            })
    }

    /// What holds if all of some conditions do.
    fn conjuncts(&self, parts: [Reg; 2]) -> Vec<Reg> {
        let (mut open, mut found) = (parts.to_vec(), Vec::new());
        while let Some(part) = open.pop() {
            match self.code.instr(part) {
                Some(Instr::Binary(BinaryOp::And, a, b)) => open.extend([*a, *b]),
                _ => found.push(part),
            }
            if found.len() > CONJUNCTS_MAX {
                break;
            }
        }
        found
    }

    /// What a comparison says: which value isn't more than which.
    fn orders(&self, condition: Reg) -> Vec<Order> {
        let Some(&Instr::Binary(op, a, b)) = self.code.instr(condition) else { return Vec::new() };
        let order = |less, more, strict| Order { less, more, strict };
        match op {
            BinaryOp::Lt | BinaryOp::Le => vec![order(a, b, op == BinaryOp::Lt)],
            BinaryOp::Gt | BinaryOp::Ge => vec![order(b, a, op == BinaryOp::Gt)],
            BinaryOp::Eq => vec![order(a, b, false), order(b, a, false)],
            _ => Vec::new(),
        }
    }
}

/// `less < more`, or `less <= more`.
struct Order {
    less: Reg,
    more: Reg,
    strict: bool,
}

/// Until when a condition has held in every round, seconds after its beginning: if it is one that
/// time brings about.
pub(crate) fn longest_round(
    code: &Builder,
    condition: Reg,
    params: &[Option<Interval>],
) -> Option<f64> {
    let of = |condition| longest_round(code, condition, params);
    let is_time = |reg: Reg| matches!(code.instr(reg), Some(Instr::RoundElapsed));
    match code.instr(condition)? {
        Instr::Binary(BinaryOp::Or, a, b) => {
            [of(*a), of(*b)].into_iter().flatten().reduce(f64::min)
        }
        Instr::Binary(BinaryOp::And, a, b) => Some(of(*a)?.max(of(*b)?)),
        Instr::Binary(BinaryOp::Gt | BinaryOp::Ge, time, bound)
        | Instr::Binary(BinaryOp::Lt | BinaryOp::Le, bound, time)
            if is_time(*time) =>
        {
            Some(interval(code, *bound, params)?.1 + STEP_S)
        }
        _ => None,
    }
}

fn unary(op: UnaryOp, a: Interval) -> Option<Interval> {
    Some(match op {
        UnaryOp::Neg => (-a.1, -a.0),
        UnaryOp::Not => match truth(a) {
            Some(holds) => known(!holds),
            None => (0.0, 1.0),
        },
        UnaryOp::Abs if a.0 >= 0.0 => a,
        UnaryOp::Abs if a.1 <= 0.0 => (-a.1, -a.0),
        UnaryOp::Abs => (0.0, a.1.max(-a.0)),
        UnaryOp::Sqrt if a.0 >= 0.0 => (a.0.sqrt(), a.1.sqrt()),
        UnaryOp::Floor => (a.0.floor(), a.1.floor()),
        UnaryOp::Ceil => (a.0.ceil(), a.1.ceil()),
        UnaryOp::Round => (a.0.round(), a.1.round()),
        UnaryOp::Sin | UnaryOp::Cos => (-1.0, 1.0),
        _ => return None,
    })
}

fn binary(op: BinaryOp, a: Interval, b: Interval) -> Option<Interval> {
    Some(match op {
        BinaryOp::Add => (a.0 + b.0, a.1 + b.1),
        BinaryOp::Sub => (a.0 - b.1, a.1 - b.0),
        BinaryOp::Mul => corners(a, b, |x, y| x * y),
        BinaryOp::Div if b.0 > 0.0 || b.1 < 0.0 => corners(a, b, |x, y| x / y),
        BinaryOp::Min => (a.0.min(b.0), a.1.min(b.1)),
        BinaryOp::Max => (a.0.max(b.0), a.1.max(b.1)),
        BinaryOp::Lt if reaches(b, a) => known(false),
        BinaryOp::Gt if reaches(a, b) => known(false),
        BinaryOp::Lt | BinaryOp::Le => order(a, b),
        BinaryOp::Gt | BinaryOp::Ge => order(b, a),
        BinaryOp::Eq if apart(a, b) || apart(b, a) => known(false),
        BinaryOp::Ne if apart(a, b) || apart(b, a) => known(true),
        BinaryOp::And => match (truth(a), truth(b)) {
            (Some(false), _) | (_, Some(false)) => known(false),
            (Some(true), Some(true)) => known(true),
            _ => (0.0, 1.0),
        },
        BinaryOp::Or => match (truth(a), truth(b)) {
            (Some(true), _) | (_, Some(true)) => known(true),
            (Some(false), Some(false)) => known(false),
            _ => (0.0, 1.0),
        },
        BinaryOp::Eq | BinaryOp::Ne => (0.0, 1.0),
        BinaryOp::Mod if b.0 > 0.0 => (0.0, b.1),
        BinaryOp::Hypot => {
            let size =
                |a: Interval| if a.0 <= 0.0 && a.1 >= 0.0 { 0.0 } else { a.0.abs().min(a.1.abs()) };
            (size(a).hypot(size(b)), a.0.abs().max(a.1.abs()).hypot(b.0.abs().max(b.1.abs())))
        }
        _ => return None,
    })
}

/// What a condition with these values is, if it is always the same.
fn truth(a: Interval) -> Option<bool> {
    match a {
        (0.0, 0.0) => Some(false),
        (low, high) if low > 0.0 || high < 0.0 => Some(true),
        _ => None,
    }
}

fn known(holds: bool) -> Interval {
    let value = f64::from(u8::from(holds));
    (value, value)
}

/// `a < b`, `a <= b`.
fn order(a: Interval, b: Interval) -> Interval {
    if apart(a, b) {
        known(true)
    } else if apart(b, a) {
        known(false)
    } else {
        (0.0, 1.0)
    }
}

/// Whether `a` goes up to `b` and no further, both by whole numbers, which nothing rounds.
fn reaches(a: Interval, b: Interval) -> bool {
    a.1 <= b.0 && a.1.fract() == 0.0 && b.0.fract() == 0.0
}

/// Whether `a` lies below `b` by more than what rounding does.
fn apart(a: Interval, b: Interval) -> bool {
    b.0 - a.1 > 1e-9 * (1.0 + a.1.abs())
}

fn corners(a: Interval, b: Interval, f: impl Fn(f64, f64) -> f64) -> Interval {
    let values = [f(a.0, b.0), f(a.0, b.1), f(a.1, b.0), f(a.1, b.1)];
    values
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), &v| (low.min(v), high.max(v)))
}
