//! What a memory cell can hold: a count grows from 0, a peak is one of the values seen so far.

use super::{InPlay, Interval, Search};
use crate::lower::builder::CellWrite;
use setpiece_scenario::pitch::STEPS_PER_S;
use setpiece_scenario::{BinaryOp, Instr, Reg};

/// More steps than any episode has that ends without a limit.
const STEPS_WITHOUT_LIMIT: f64 = 1.0e12;

/// What a write makes of a cell: it adds to the value, replaces it, or does one of both.
#[derive(Clone, Copy)]
struct Change {
    added: Option<Interval>,
    put: Option<Interval>,
}

impl Search<'_> {
    /// The interval of a cell in a match under way.
    pub(super) fn kept(&self, cell: u32, depth: u32) -> Option<Interval> {
        let in_play = self.in_play.as_ref()?;
        let writes = self.code.writes_of(cell)?;
        if self.cells.borrow().contains(&cell) {
            return None;
        }
        self.cells.borrow_mut().push(cell);
        let found = self.held(in_play, cell, writes, depth);
        self.cells.borrow_mut().pop();
        found
    }

    fn held(
        &self,
        in_play: &InPlay<'_>,
        cell: u32,
        writes: &[CellWrite],
        depth: u32,
    ) -> Option<Interval> {
        let steps = in_play.longest.map(|seconds| (seconds * STEPS_PER_S).round());
        let steps = steps.unwrap_or(STEPS_WITHOUT_LIMIT);
        // Cells begin at 0.
        let (mut put, mut added) = ((0.0_f64, 0.0_f64), (0.0, 0.0));
        for write in writes {
            let change = self.change(write.value, cell, depth)?;
            let (low, high) = change.put.unwrap_or_default();
            put = (put.0.min(low), put.1.max(high));
            let (low, high) = change.added.unwrap_or_default();
            added = (added.0 + write.times * low.min(0.0), added.1 + write.times * high.max(0.0));
        }
        if !in_play.counts_up && added.0 == 0.0 && added.1 > 0.0 {
            added.0 = -added.1;
        }
        Some((put.0 + steps * added.0, put.1 + steps * added.1))
    }

    /// What writing a value into a cell does to it.
    fn change(&self, value: Reg, cell: u32, depth: u32) -> Option<Change> {
        self.visits.set(self.visits.get().checked_sub(1)?);
        let depth = depth + 1;
        if depth > super::DEPTH_MAX {
            return None;
        }
        let of = |value: Reg| self.change(value, cell, depth);
        let both = |a: Option<Interval>, b: Option<Interval>, f: fn(f64, f64) -> f64| {
            a.zip(b).map(|(a, b)| (f(a.0, b.0), f(a.1, b.1)))
        };
        Some(match self.code.instr(value)? {
            Instr::Cell(same) if *same == cell => Change { added: Some((0.0, 0.0)), put: None },
            Instr::Binary(op @ (BinaryOp::Add | BinaryOp::Sub), a, b) => {
                let (mut a, mut b) = (of(*a)?, of(*b)?);
                if *op == BinaryOp::Sub {
                    if b.added.is_some() {
                        return None;
                    }
                    b.put = b.put.map(|(low, high)| (-high, -low));
                } else if b.added.is_some() {
                    std::mem::swap(&mut a, &mut b);
                }
                if b.added.is_some() {
                    return None;
                }
                let sum = |one| both(one, b.put, |a, b| a + b);
                Change { added: sum(a.added), put: sum(a.put) }
            }
            Instr::Binary(BinaryOp::Min | BinaryOp::Max, a, b) | Instr::Select(_, a, b) => {
                let (a, b) = (of(*a)?, of(*b)?);
                let either = |a: Option<Interval>, b: Option<Interval>| match (a, b) {
                    (Some(a), Some(b)) => Some((a.0.min(b.0), a.1.max(b.1))),
                    (one, other) => one.or(other),
                };
                Change { added: either(a.added, b.added), put: either(a.put, b.put) }
            }
            _ => Change { added: None, put: Some(self.bounded(value, depth)?) },
        })
    }
}
