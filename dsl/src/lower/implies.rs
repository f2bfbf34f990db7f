//! Whether a condition holds whenever another one does, as far as their form tells.

use super::Lower;
use setpiece_scenario::vocabulary::Team;
use setpiece_scenario::{BinaryOp, Each, EventFilter, FoldKind, Instr, Over, Reg, Who};

/// Deepest nesting that is looked into.
const DEPTH_MAX: u32 = 12;

impl Lower<'_, '_> {
    /// Whether `b` surely holds whenever `a` does.
    pub(super) fn implies(&self, a: Reg, b: Reg) -> bool {
        self.implies_within(a, b, DEPTH_MAX)
    }

    fn implies_within(&self, a: Reg, b: Reg, depth: u32) -> bool {
        let Some(depth) = depth.checked_sub(1) else { return false };
        let of = |a: Reg, b: Reg| self.implies_within(a, b, depth);
        if a == b {
            return true;
        }
        let parts = |reg: Reg| match self.code.instr(reg) {
            Some(&Instr::Binary(op, left, right)) => Some((op, left, right)),
            _ => None,
        };
        match (parts(a), parts(b)) {
            (Some((BinaryOp::Or, p, q)), _) => of(p, b) && of(q, b),
            (_, Some((BinaryOp::And, r, s))) => of(a, r) && of(a, s),
            (_, Some((BinaryOp::Or, r, s))) if of(a, r) || of(a, s) => true,
            (Some((BinaryOp::And, p, q)), _) => of(p, b) || of(q, b),
            (Some(one), Some(other)) => self.is_narrower(one, other),
            _ => false,
        }
    }

    /// The conditions of which one holds when a condition does.
    pub(super) fn ways(&self, condition: Reg) -> Vec<Reg> {
        match self.code.instr(condition) {
            Some(&Instr::Binary(BinaryOp::Or, a, b)) => [self.ways(a), self.ways(b)].concat(),
            _ => vec![condition],
        }
    }

    /// The names of those conditions of which one holds whenever another one does: one alone, or
    /// one for each team.
    pub(super) fn forestalling<'n>(&self, way: Reg, all: &[(Reg, &'n str)]) -> Vec<&'n str> {
        if let Some((_, name)) = all.iter().find(|(when, _)| self.implies(way, *when)) {
            return vec![*name];
        }
        let happened = |reg: Reg| match self.code.instr(reg) {
            Some(Instr::Binary(BinaryOp::Gt, count, zero))
                if self.code.constant_of(*zero) == Some(0.0) =>
            {
                self.events_counted(*count).map(|each| &each.over)
            }
            _ => None,
        };
        let of_team = |team: Team| {
            let mut all = all.iter();
            let found = all.find(|(when, _)| {
                let Some((Over::Events(ends), Over::Events(way))) =
                    happened(*when).zip(happened(way))
                else {
                    return false;
                };
                let of = ends.by.and_then(|by| match by {
                    Who::Team(by) => self.known_team(by),
                    Who::Player(_) => None,
                });
                way.by.is_none()
                    && of == Some(team)
                    && self.passes(
                        &Over::Events(EventFilter { by: ends.by, ..way.clone() }),
                        &Over::Events(ends.clone()),
                    )
            });
            found.map(|(_, name)| *name)
        };
        match [Team::Left, Team::Right].map(of_team) {
            [Some(left), Some(right)] => vec![left, right],
            _ => Vec::new(),
        }
    }

    /// The same of two comparisons: of the same value with two bounds, or of events that happened.
    fn is_narrower(&self, a: (BinaryOp, Reg, Reg), b: (BinaryOp, Reg, Reg)) -> bool {
        let ((x, value, bound), (y, other, limit)) = (a, b);
        let (Some(bound), Some(limit)) =
            (self.code.constant_of(bound), self.code.constant_of(limit))
        else {
            return false;
        };
        if value == other {
            let is_strict = |op: BinaryOp| matches!(op, BinaryOp::Gt | BinaryOp::Lt);
            let beyond = match (x, y) {
                (BinaryOp::Gt | BinaryOp::Ge, BinaryOp::Gt | BinaryOp::Ge) => bound - limit,
                (BinaryOp::Lt | BinaryOp::Le, BinaryOp::Lt | BinaryOp::Le) => limit - bound,
                _ => return false,
            };
            return beyond > 0.0 || beyond == 0.0 && (is_strict(x) || !is_strict(y));
        }
        let happened = (x, y) == (BinaryOp::Gt, BinaryOp::Gt) && (bound, limit) == (0.0, 0.0);
        let (Some(narrow), Some(wide)) = (self.events_counted(value), self.events_counted(other))
        else {
            return false;
        };
        happened && wide.fold.guard.is_none() && self.passes(&narrow.over, &wide.over)
    }

    /// A count of events.
    fn events_counted(&self, reg: Reg) -> Option<&Each> {
        match self.code.instr(reg)? {
            Instr::Each(each)
                if matches!(each.over, Over::Events(_)) && each.fold.kind == FoldKind::Count =>
            {
                Some(each)
            }
            _ => None,
        }
    }

    /// Whether every event of one kind is one of another.
    fn passes(&self, narrow: &Over, wide: &Over) -> bool {
        let (Over::Events(narrow), Over::Events(wide)) = (narrow, wide) else { return false };
        let EventFilter { kind, qualifier, by, to } = *wide;
        // Without a qualifier an event of its own is meant, not all of them.
        (narrow.kind, narrow.qualifier) == (kind, qualifier)
            && self.is_of(narrow.by, by)
            && self.is_of(narrow.to, to)
    }

    fn is_of(&self, narrow: Option<Who>, wide: Option<Who>) -> bool {
        match (narrow, wide) {
            (_, None) => true,
            (Some(one), Some(all)) if one == all => true,
            (Some(one), Some(Who::Team(team))) => {
                self.team_of(one).is_some_and(|of| self.known_team(team) == Some(of))
            }
            _ => false,
        }
    }
}
