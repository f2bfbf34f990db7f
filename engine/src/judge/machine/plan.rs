//! A program prepared to run: what must run how often, and in which lanes.

use setpiece_scenario::vocabulary::Field;
use setpiece_scenario::{BinaryOp, Fold, Instr, Over, Program, Reg, Table, UnaryOp, When};
use std::ops::Range;

/// A program in the form that a [`Machine`](super::Machine) runs.
#[derive(Clone, Debug, Default)]
pub struct Plan {
    /// Instructions that depend only on parameters and `let`s: run once per episode.
    pub(super) once: Vec<PlanStep>,
    /// The others: run in every step.
    pub(super) each_step: Vec<PlanStep>,
    /// The instructions without an [`Op`] of their own.
    pub(super) rare: Vec<Instr>,
    pub(super) loops: Vec<Loop>,
    /// The program's tables.
    pub(super) tables: Vec<Table>,
    has_points: bool,
}

/// An instruction, small and flat, so that one jump reaches its code.
#[derive(Clone, Copy, Debug)]
pub(super) struct PlanStep {
    pub(super) op: Op,
    /// Whether every lane has the same value there, so that one is enough.
    pub(super) uniform: bool,
    /// Its register.
    pub(super) at: u32,
    /// Its operands; [`Op`] says which.
    pub(super) a: u32,
    pub(super) b: u32,
    pub(super) c: u32,
}

/// The operation of a step; every frequent instruction has its own.
///
/// Operands are registers, in the order of the instruction's.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Op {
    Add,
    Sub,
    Mul,
    Div,
    Min,
    Max,
    Hypot,
    Lt,
    Le,
    Gt,
    Ge,
    Eq,
    And,
    Or,
    Not,
    Neg,
    /// `if a then b else c`
    Select,
    BallX,
    BallY,
    BallOwner,
    /// `a`: the player.
    PlayerX,
    PlayerY,
    Me,
    /// `a`: the cell.
    Cell,
    /// `a`: the term; `b`: the value; `c`: the guard, or [`ALWAYS`].
    Give,
    /// `a`: the cell; `b`: the value; `c`: the guard, or [`ALWAYS`].
    Assign,
    /// `a`: the index in [`Plan::rare`].
    Rare,
    /// The same, for an instruction that runs once per step and remembers that.
    Temporal,
    /// `a`: the index in [`Plan::loops`].
    Loop,
    /// The same, for a loop over numbers that runs for [`POINTS`] of them at a time: its lanes are
    /// numbers.
    Points,
}

/// Replaces the guard if there is none.
pub(super) const ALWAYS: u32 = u32::MAX;

/// A loop and its body.
#[derive(Clone, Debug)]
pub(super) struct Loop {
    pub(super) over: Over,
    pub(super) fold: Fold,
    pub(super) body: Vec<PlanStep>,
    /// Of a loop of [`Op::Points`]: the registers that it reads from outside.
    pub(super) reads: Vec<u32>,
}

/// How many numbers a loop of [`Op::Points`] takes at a time.
pub const POINTS: usize = 12;

impl Plan {
    /// Prepares a verified program for this many lanes.
    pub fn of(program: &Program, lanes: usize) -> Plan {
        let code = &program.code;
        let mut same = vec![false; code.len()];
        spread(code, 0..code.len(), lanes == 1, &mut same);
        let mut reader = ProgramReader {
            code,
            one_lane: lanes == 1,
            same,
            points: None,
            plan: Plan { tables: program.tables.clone(), ..Plan::default() },
        };
        let fixed = program.fixed();
        let (mut once, mut each_step) = (Vec::new(), Vec::new());
        let mut at = 0;
        while at < code.len() {
            at = reader.read(at, if fixed[at] { &mut once } else { &mut each_step });
        }
        Plan { once, each_step, ..reader.plan }
    }

    /// Whether it has a loop of [`Op::Points`].
    pub fn has_points(&self) -> bool {
        self.has_points
    }
}

/// Marks the registers of some instructions that are the same in every lane. `one` is whether
/// players and cells are, too.
///
/// An effect reads every lane's guard, and a cell may have been written in one lane only.
fn spread(code: &[Instr], range: Range<usize>, one: bool, same: &mut [bool]) {
    let mut at = range.start;
    while at < range.end {
        let instr = &code[at];
        let mut all = one
            || !matches!(
                instr,
                Instr::Me | Instr::Cell(_) | Instr::Give { .. } | Instr::Assign { .. }
            );
        instr.operands(&mut |reg| all &= same[reg.index()]);
        let mut next = at + 1;
        if let Instr::Each(each) = instr {
            next += each.body as usize;
            // While the body runs, the register is the element.
            same[at] = true;
            spread(code, at + 1..next, one, same);
            for reg in each.fold.value.iter().chain(&each.fold.guard) {
                all &= same[reg.index()];
            }
        }
        same[at] = all;
        at = next;
    }
}

/// Whether nothing happens in the body of a loop besides its fold: the order in which its
/// instructions run doesn't matter.
fn is_pure(body: &[Instr]) -> bool {
    !body.iter().any(|instr| {
        instr.looks_back() || matches!(instr, Instr::Give { .. } | Instr::Assign { .. })
    })
}

/// Reads a program, including nested loops.
struct ProgramReader<'a> {
    code: &'a [Instr],
    one_lane: bool,
    /// Which registers are the same in every lane.
    same: Vec<bool>,
    /// The loop of [`Op::Points`] around the current instruction.
    points: Option<PointsLoop>,
    plan: Plan,
}

/// A loop of [`Op::Points`] that is being read.
struct PointsLoop {
    at: usize,
    /// The registers that its body reads from outside.
    reads: Vec<u32>,
    /// Cells that are read in its body: no step of it changes them.
    cells: Vec<PlanStep>,
}

impl PointsLoop {
    fn read(&mut self, reg: Reg) {
        if reg.index() < self.at && !self.reads.contains(&reg.0) {
            self.reads.push(reg.0);
        }
    }
}

impl ProgramReader<'_> {
    /// Adds the step of an instruction; returns the index of the next one.
    fn read(&mut self, at: usize, steps: &mut Vec<PlanStep>) -> usize {
        let instr = &self.code[at];
        if let Some(points) = &mut self.points {
            instr.operands(&mut |reg| points.read(reg));
            if let Instr::Cell(_) = instr {
                points.reads.push(at as u32);
                let step = self.simple(instr, at);
                self.points.iter_mut().for_each(|points| points.cells.push(step));
                return at + 1;
            }
        }
        let Instr::Each(each) = instr else {
            let step = self.simple(instr, at);
            steps.push(step);
            return at + 1;
        };
        let end = at + 1 + each.body as usize;
        let alike = self.same[at];
        let begins = self.points.is_none()
            && matches!(each.over, Over::Numbers(_))
            && (alike || self.one_lane)
            && is_pure(&self.code[at + 1..end]);
        if begins {
            self.points = Some(PointsLoop { at, reads: Vec::new(), cells: Vec::new() });
            self.same[at] = false;
            spread(self.code, at + 1..end, true, &mut self.same);
        }
        let mut body = Vec::new();
        let mut next = at + 1;
        while next < end {
            next = self.read(next, &mut body);
        }
        if let Some(points) = &mut self.points {
            each.fold.value.iter().chain(&each.fold.guard).for_each(|reg| points.read(*reg));
        }
        let mut reads = Vec::new();
        if begins && let Some(points) = self.points.take() {
            steps.extend(points.cells);
            reads = points.reads;
            self.same[at] = alike;
            self.plan.has_points = true;
        }
        let (over, fold) = (each.over.clone(), each.fold.clone());
        self.plan.loops.push(Loop { over, fold, body, reads });
        steps.push(PlanStep {
            op: if begins { Op::Points } else { Op::Loop },
            uniform: self.same[at],
            at: at as u32,
            a: self.plan.loops.len() as u32 - 1,
            b: 0,
            c: 0,
        });
        end
    }

    /// The step of an instruction that isn't a loop.
    fn simple(&mut self, instr: &Instr, at: usize) -> PlanStep {
        let guard = |guard: &Option<Reg>| guard.map_or(ALWAYS, |guard| guard.0);
        let (op, a, b, c) = match instr {
            Instr::Binary(op, a, b) if two(*op).is_some() => {
                (two(*op).unwrap_or(Op::Add), a.0, b.0, 0)
            }
            Instr::Unary(UnaryOp::Not, a) => (Op::Not, a.0, 0, 0),
            Instr::Unary(UnaryOp::Neg, a) => (Op::Neg, a.0, 0, 0),
            Instr::Select(a, b, c) => (Op::Select, a.0, b.0, c.0),
            Instr::Load { field: Field::BallX, when: When::Now, .. } => (Op::BallX, 0, 0, 0),
            Instr::Load { field: Field::BallY, when: When::Now, .. } => (Op::BallY, 0, 0, 0),
            Instr::Load { field: Field::BallOwner, when: When::Now, .. } => {
                (Op::BallOwner, 0, 0, 0)
            }
            Instr::Load { field: Field::PlayerX, of: Some(of), when: When::Now } => {
                (Op::PlayerX, of.0, 0, 0)
            }
            Instr::Load { field: Field::PlayerY, of: Some(of), when: When::Now } => {
                (Op::PlayerY, of.0, 0, 0)
            }
            Instr::Me => (Op::Me, 0, 0, 0),
            Instr::Cell(cell) => (Op::Cell, *cell, 0, 0),
            Instr::Give { term, value, guard: only } => (Op::Give, *term, value.0, guard(only)),
            Instr::Assign { cell, value, guard: only } => (Op::Assign, *cell, value.0, guard(only)),
            other => {
                self.plan.rare.push(other.clone());
                let op = if other.looks_back() { Op::Temporal } else { Op::Rare };
                (op, self.plan.rare.len() as u32 - 1, 0, 0)
            }
        };
        PlanStep { op, uniform: self.same[at], at: at as u32, a, b, c }
    }
}

/// The frequent binary operators.
fn two(op: BinaryOp) -> Option<Op> {
    Some(match op {
        BinaryOp::Add => Op::Add,
        BinaryOp::Sub => Op::Sub,
        BinaryOp::Mul => Op::Mul,
        BinaryOp::Div => Op::Div,
        BinaryOp::Min => Op::Min,
        BinaryOp::Max => Op::Max,
        BinaryOp::Hypot => Op::Hypot,
        BinaryOp::Lt => Op::Lt,
        BinaryOp::Le => Op::Le,
        BinaryOp::Gt => Op::Gt,
        BinaryOp::Ge => Op::Ge,
        BinaryOp::Eq => Op::Eq,
        BinaryOp::And => Op::And,
        BinaryOp::Or => Op::Or,
        BinaryOp::Mod | BinaryOp::Pow | BinaryOp::Atan2 | BinaryOp::Ne => return None,
    })
}
