//! A program prepared to run: what must run how often, and in which lanes.

use setpiece_scenario::vocabulary::Field;
use setpiece_scenario::{BinaryOp, Fold, Instr, Over, Program, Reg, Table, UnaryOp, When};

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
}

/// Replaces the guard if there is none.
pub(super) const ALWAYS: u32 = u32::MAX;

/// A loop and its body.
#[derive(Clone, Debug)]
pub(super) struct Loop {
    pub(super) over: Over,
    pub(super) fold: Fold,
    pub(super) body: Vec<PlanStep>,
}

impl Plan {
    /// Prepares a verified program.
    pub fn of(program: &Program) -> Plan {
        let mut reader = ProgramReader {
            code: &program.code,
            uniform: vec![false; program.code.len()],
            open: Vec::new(),
            plan: Plan { tables: program.tables.clone(), ..Plan::default() },
        };
        let fixed = program.fixed();
        let mut at = 0;
        while at < program.code.len() {
            let (step, next) = reader.step(at);
            let plan = &mut reader.plan;
            if fixed[at] { &mut plan.once } else { &mut plan.each_step }.push(step);
            at = next;
        }
        reader.plan
    }
}

/// Reads a program, including nested loops.
struct ProgramReader<'a> {
    code: &'a [Instr],
    uniform: Vec<bool>,
    /// The loops around the current instruction.
    open: Vec<usize>,
    plan: Plan,
}

impl ProgramReader<'_> {
    /// The step of an instruction, and the index of the next one.
    fn step(&mut self, at: usize) -> (PlanStep, usize) {
        let instr = &self.code[at];
        let Instr::Each(each) = instr else {
            self.uniform[at] = self.is_uniform(instr);
            return (self.simple(instr, at), at + 1);
        };
        let mut uniform = true;
        instr.operands(&mut |reg| uniform &= self.is_the_same(reg));
        let end = at + 1 + each.body as usize;
        self.open.push(at);
        let mut body = Vec::new();
        let mut next = at + 1;
        while next < end {
            let (step, after) = self.step(next);
            body.push(step);
            next = after;
        }
        for reg in each.fold.value.iter().chain(&each.fold.guard) {
            uniform &= self.is_the_same(*reg);
        }
        self.open.pop();
        self.uniform[at] = uniform;
        self.plan.loops.push(Loop { over: each.over.clone(), fold: each.fold.clone(), body });
        let step = PlanStep {
            op: Op::Loop,
            uniform,
            at: at as u32,
            a: self.plan.loops.len() as u32 - 1,
            b: 0,
            c: 0,
        };
        (step, end)
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
        PlanStep { op, uniform: self.uniform[at], at: at as u32, a, b, c }
    }

    fn is_uniform(&self, instr: &Instr) -> bool {
        // A cell may have been written in one lane only, and an effect reads every lane's guard.
        let mut uniform = !matches!(
            instr,
            Instr::Me | Instr::Cell(_) | Instr::Give { .. } | Instr::Assign { .. }
        );
        instr.operands(&mut |reg| uniform &= self.is_the_same(reg));
        uniform
    }

    /// Whether a register is the same in every lane. A loop's register is its element while its
    /// body runs.
    fn is_the_same(&self, reg: Reg) -> bool {
        self.open.contains(&reg.index())
            || self.uniform.get(reg.index()).copied().unwrap_or_default()
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
