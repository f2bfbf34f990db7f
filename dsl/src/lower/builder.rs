//! Builds a register program: shares equal values, folds constants, keeps loops apart.
//!
//! Registers are *virtual* here (numbered as they are made); [`Builder::finish`] drops what nothing
//! uses, lays the blocks out in order and tells where each register went. A pure instruction is put
//! into the outermost block in which its operands are known, so that what doesn't depend on the
//! element of a loop is computed once, before the loop.

mod layout;

use crate::ast::Span;
use setpiece_scenario::bounds::EVENTS_MAX;
use setpiece_scenario::pitch::PLAYERS_MAX;
use setpiece_scenario::{
    BinaryOp, Distribution, Each, EventField, Field, Fold, FoldKind, Instr, Over, Reg, Table,
    UnaryOp, When,
};
use std::collections::HashMap;

/// A block of instructions, by number: 0 is the prologue, 1 the root, others are bodies of loops.
pub(crate) type BlockId = usize;

const PROLOGUE: BlockId = 0;
const ROOT: BlockId = 1;

struct CodeNode {
    instr: Instr,
    block: BlockId,
    /// The body, of an `Each`.
    body: Option<BlockId>,
    /// Whether it depends on a broken expression.
    unknown: bool,
}

#[derive(Default)]
struct CodeBlock {
    nodes: Vec<u32>,
    known: HashMap<Key, u32>,
    owner: Option<u32>,
}

/// What makes two instructions of a block the same.
#[derive(Clone, PartialEq, Eq, Hash)]
enum Key {
    Const(u64),
    Param(u32),
    Let(u32),
    EpisodeIndex,
    Round,
    RoundElapsed,
    Terminated,
    Us,
    Me,
    Unary(UnaryOp, u32),
    Binary(BinaryOp, u32, u32),
    Select(u32, u32, u32),
    Table(u32, u32, u32, bool),
    Load(Field, Option<u32>, When),
    Event(usize),
    /// A cell and how often it had been written.
    Cell(u32, u32),
    Held(u32, u32),
    Ever(u32),
    Since(u32),
    Until(u32, u32),
    Before(u32),
}

/// The open blocks that a hoisted piece of code has left behind; see [`Builder::leave_loops`].
pub(crate) struct Loops(Vec<BlockId>);

/// A loop whose body is being written.
#[derive(Clone, Copy)]
pub(crate) struct OpenLoop {
    at: u32,
    body: BlockId,
}

impl OpenLoop {
    /// The register that holds the element while the body runs, and the result afterwards.
    pub(crate) fn element(&self) -> Reg {
        Reg(self.at)
    }
}

/// A program under construction.
pub(crate) struct Builder {
    nodes: Vec<CodeNode>,
    blocks: Vec<CodeBlock>,
    open: Vec<BlockId>,
    cells: Vec<CodeCell>,
    /// The tables and where they are declared.
    tables: Vec<(Span, Table)>,
}

/// A memory cell.
#[derive(Default)]
struct CodeCell {
    writes: Vec<CellWrite>,
    /// Whether nothing else ever writes it.
    is_closed: bool,
}

/// A write to a memory cell.
pub(crate) struct CellWrite {
    /// What is written.
    pub(crate) value: Reg,
    /// How often in a step at most.
    pub(crate) times: f64,
}

/// Where the virtual registers went.
pub(crate) struct RegisterLayout(Vec<Option<Reg>>);

impl RegisterLayout {
    /// The final register of a virtual one that was named as a root of `finish`.
    pub(crate) fn reg(&self, reg: Reg) -> Reg {
        self.0.get(reg.index()).copied().flatten().unwrap_or(Reg(0))
    }
}

impl Builder {
    /// An empty program.
    pub(crate) fn new() -> Builder {
        Builder {
            nodes: Vec::new(),
            blocks: vec![CodeBlock::default(), CodeBlock::default()],
            open: vec![ROOT],
            cells: Vec::new(),
            tables: Vec::new(),
        }
    }

    /// How many instructions it has so far.
    pub(crate) fn len(&self) -> usize {
        self.nodes.len()
    }

    /// A new memory cell.
    pub(crate) fn new_cell(&mut self) -> u32 {
        self.cells.push(CodeCell::default());
        self.cells.len() as u32 - 1
    }

    /// Says that a cell begins at 0 and that all that writes it has been written.
    pub(crate) fn close_cell(&mut self, cell: u32) {
        if let Some(cell) = self.cells.get_mut(cell as usize) {
            cell.is_closed = true;
        }
    }

    /// All that writes a cell, which begins at 0; `None` where that isn't known.
    pub(crate) fn writes_of(&self, cell: u32) -> Option<&[CellWrite]> {
        let cell = self.cells.get(cell as usize)?;
        cell.is_closed.then_some(&cell.writes)
    }

    /// The value of a register that is a constant.
    pub(crate) fn constant_of(&self, reg: Reg) -> Option<f64> {
        match self.nodes.get(reg.index())?.instr {
            Instr::Const(value) => Some(value),
            _ => None,
        }
    }

    /// The instruction that writes a register.
    pub(crate) fn instr(&self, reg: Reg) -> Option<&Instr> {
        self.nodes.get(reg.index()).map(|node| &node.instr)
    }

    /// Whether any instruction that a register depends on, itself included, passes a test.
    pub(crate) fn depends(&self, reg: Reg, test: &dyn Fn(&Instr) -> bool) -> bool {
        self.depends_through(reg, test, &|_| true)
    }

    /// The same, leaving out what loops look at that aren't entered.
    pub(crate) fn depends_through(
        &self,
        reg: Reg,
        test: &dyn Fn(&Instr) -> bool,
        enters: &dyn Fn(&Each) -> bool,
    ) -> bool {
        let mut seen = vec![false; self.nodes.len()];
        let mut stack = vec![reg];
        while let Some(reg) = stack.pop() {
            let (Some(node), Some(mark)) = (self.nodes.get(reg.index()), seen.get_mut(reg.index()))
            else {
                continue;
            };
            if std::mem::replace(mark, true) {
                continue;
            }
            if test(&node.instr) {
                return true;
            }
            node.instr.operands(&mut |operand| stack.push(operand));
            if let Instr::Each(each) = &node.instr
                && enters(each)
            {
                stack.extend(each.fold.value.iter().chain(&each.fold.guard));
            }
        }
        false
    }

    /// Whether a register can be read at the present place.
    pub(crate) fn is_visible(&self, reg: Reg) -> bool {
        self.nodes
            .get(reg.index())
            .is_some_and(|node| node.block == PROLOGUE || self.open.contains(&node.block))
    }

    /// Whether a loop is open at the present place.
    pub(crate) fn in_loop(&self) -> bool {
        self.open.len() > 1
    }

    /// How many loops are open at the present place.
    pub(crate) fn loops(&self) -> usize {
        self.open.len() - 1
    }

    /// Goes on writing outside every loop, until [`Builder::return_to`].
    pub(crate) fn leave_loops(&mut self) -> Loops {
        Loops(std::mem::replace(&mut self.open, vec![ROOT]))
    }

    /// Goes back into the loops.
    pub(crate) fn return_to(&mut self, loops: Loops) {
        self.open = loops.0;
    }

    /// A constant.
    pub(crate) fn constant(&mut self, value: f64) -> Reg {
        // -0 is folded, so that equal constants share a register.
        let value = if value == 0.0 || !value.is_finite() { 0.0 } else { value };
        self.shared(ROOT, Key::Const(value.to_bits()), Instr::Const(value))
    }

    /// A truth value.
    pub(crate) fn bool(&mut self, value: bool) -> Reg {
        self.constant(f64::from(u8::from(value)))
    }

    /// A parameter.
    pub(crate) fn param(&mut self, index: u32) -> Reg {
        self.shared(ROOT, Key::Param(index), Instr::Param(index))
    }

    /// The register of a broken expression: nothing is known of it, so that nothing more is found
    /// wrong with it.
    pub(crate) fn unknown(&mut self) -> Reg {
        self.param(u32::MAX)
    }

    /// Whether a register belongs to a broken expression.
    pub(crate) fn is_unknown(&self, reg: Reg) -> bool {
        self.nodes.get(reg.index()).is_some_and(|node| node.unknown)
    }

    /// A scenario `let`.
    pub(crate) fn scenario_let(&mut self, index: u32) -> Reg {
        self.shared(ROOT, Key::Let(index), Instr::Let(index))
    }

    /// The episode's index.
    pub(crate) fn episode_index(&mut self) -> Reg {
        self.shared(ROOT, Key::EpisodeIndex, Instr::EpisodeIndex)
    }

    /// The round of the episode, from 1 on.
    pub(crate) fn round(&mut self) -> Reg {
        self.shared(ROOT, Key::Round, Instr::Round)
    }

    /// The time since the round began.
    pub(crate) fn round_elapsed(&mut self) -> Reg {
        self.shared(ROOT, Key::RoundElapsed, Instr::RoundElapsed)
    }

    /// Whether the episode terminates in this step.
    pub(crate) fn terminated(&mut self) -> Reg {
        self.shared(ROOT, Key::Terminated, Instr::Terminated)
    }

    /// The judged agent's team.
    pub(crate) fn us(&mut self) -> Reg {
        self.shared(ROOT, Key::Us, Instr::Us)
    }

    /// The judged agent's player.
    pub(crate) fn me(&mut self) -> Reg {
        self.shared(ROOT, Key::Me, Instr::Me)
    }

    /// One operand; folded where it is constant and the result finite.
    pub(crate) fn unary(&mut self, op: UnaryOp, a: Reg) -> Reg {
        if let Some(folded) = self.constant_of(a).and_then(|a| op.fold(a)).filter(|v| v.is_finite())
        {
            return self.constant(folded);
        }
        match (op, self.instr(a)) {
            (UnaryOp::Neg, Some(&Instr::Unary(UnaryOp::Neg, b)))
            | (UnaryOp::OtherTeam, Some(&Instr::Unary(UnaryOp::OtherTeam, b))) => return b,
            // Who is judged plays for the team that is judged.
            (UnaryOp::TeamOf, Some(Instr::Me)) => return self.us(),
            _ => {}
        }
        self.shared(self.block_of(&[a]), Key::Unary(op, a.0), Instr::Unary(op, a))
    }

    /// Two operands; folded where they are constant and the result finite.
    pub(crate) fn binary(&mut self, op: BinaryOp, a: Reg, b: Reg) -> Reg {
        let (left, right) = (self.constant_of(a), self.constant_of(b));
        if let (Some(x), Some(y)) = (left, right)
            && let folded = op.apply(x, y)
            && folded.is_finite()
        {
            return self.constant(folded);
        }
        match (op, left, right) {
            (BinaryOp::Add | BinaryOp::Or, Some(0.0), _)
            | (BinaryOp::Mul | BinaryOp::And, Some(1.0), _) => return b,
            (BinaryOp::Add | BinaryOp::Sub | BinaryOp::Or, _, Some(0.0))
            | (BinaryOp::Mul | BinaryOp::Div | BinaryOp::And, _, Some(1.0)) => return a,
            (BinaryOp::And, Some(0.0), _) | (BinaryOp::And, _, Some(0.0)) => {
                return self.constant(0.0);
            }
            (BinaryOp::Or, Some(1.0), _) | (BinaryOp::Or, _, Some(1.0)) => {
                return self.constant(1.0);
            }
            _ => {}
        }
        let (a, b) = match op {
            BinaryOp::Add
            | BinaryOp::Mul
            | BinaryOp::And
            | BinaryOp::Or
            | BinaryOp::Eq
            | BinaryOp::Ne
                if b < a =>
            {
                (b, a)
            }
            _ => (a, b),
        };
        self.shared(self.block_of(&[a, b]), Key::Binary(op, a.0, b.0), Instr::Binary(op, a, b))
    }

    /// `if c then a else b`
    pub(crate) fn select(&mut self, c: Reg, a: Reg, b: Reg) -> Reg {
        match self.constant_of(c) {
            Some(0.0) => return b,
            Some(_) => return a,
            None if a == b => return a,
            None => {}
        }
        self.shared(self.block_of(&[c, a, b]), Key::Select(c.0, a.0, b.0), Instr::Select(c, a, b))
    }

    /// A table of the program by its declaration.
    pub(crate) fn known_table(&self, declared: Span) -> Option<u32> {
        let known = self.tables.iter().position(|(at, _)| *at == declared);
        known.map(|known| known as u32)
    }

    /// Adds a table.
    pub(crate) fn add_table(&mut self, declared: Span, table: Table) -> u32 {
        self.tables.push((declared, table));
        self.tables.len() as u32 - 1
    }

    /// The numbers of one of its tables.
    pub(crate) fn numbers_of(&self, table: u32) -> &[f64] {
        self.tables.get(table as usize).map_or(&[], |(_, table)| &table.values)
    }

    /// A number of a table at the shares of its length and width.
    pub(crate) fn look_up(&mut self, table: u32, (x, y): (Reg, Reg), linear: bool) -> Reg {
        if let (Some((_, known)), Some(x), Some(y)) =
            (self.tables.get(table as usize), self.constant_of(x), self.constant_of(y))
        {
            let value = if linear { known.between(x, y) } else { known.at(x, y) };
            return self.constant(value);
        }
        let block = self.block_of(&[x, y]);
        let key = Key::Table(table, x.0, y.0, linear);
        self.shared(block, key, Instr::Table { table, x, y, linear })
    }

    /// A number of the match.
    pub(crate) fn load(&mut self, field: Field, of: Option<Reg>, when: When) -> Reg {
        let block = of.map_or(ROOT, |reg| self.block_of(&[reg]));
        self.shared(
            block,
            Key::Load(field, of.map(|reg| reg.0), when),
            Instr::Load { field, of, when },
        )
    }

    /// A field of the present event; the caller knows that a loop over events is open.
    pub(crate) fn event(&mut self, field: EventField) -> Reg {
        let block =
            self.open.iter().rev().copied().find(|&b| self.is_event_body(b)).unwrap_or(ROOT);
        self.shared(block, Key::Event(field.index()), Instr::Event(field))
    }

    /// The present value of a cell.
    pub(crate) fn cell(&mut self, cell: u32) -> Reg {
        let version = self.cells.get(cell as usize).map_or(0, |cell| cell.writes.len() as u32);
        self.shared(self.here(), Key::Cell(cell, version), Instr::Cell(cell))
    }

    /// The value a cell had when the step began.
    pub(crate) fn cell_before(&mut self, cell: u32) -> Reg {
        self.shared(PROLOGUE, Key::Cell(cell, 0), Instr::Cell(cell))
    }

    /// `held`: outside every loop.
    pub(crate) fn held(&mut self, of: Reg, seconds: Reg) -> Reg {
        self.temporal(Key::Held(of.0, seconds.0), |cell| Instr::Held { of, seconds, cell })
    }

    /// `ever`: outside every loop.
    pub(crate) fn ever(&mut self, of: Reg) -> Reg {
        self.temporal(Key::Ever(of.0), |cell| Instr::Ever { of, cell })
    }

    /// `since`: outside every loop.
    pub(crate) fn since(&mut self, of: Reg) -> Reg {
        self.temporal(Key::Since(of.0), |cell| Instr::Since { of, cell })
    }

    /// `until`: outside every loop.
    pub(crate) fn until(&mut self, of: Reg, release: Reg) -> Reg {
        self.temporal(Key::Until(of.0, release.0), |cell| Instr::Until { of, release, cell })
    }

    /// What a value was when the last step was judged: outside every loop.
    pub(crate) fn value_before(&mut self, of: Reg) -> Reg {
        self.temporal(Key::Before(of.0), |cell| Instr::Before { of, cell })
    }

    /// `once`: outside every loop; each has its own memory.
    pub(crate) fn once(&mut self, of: Reg) -> Reg {
        let cell = self.new_cell();
        self.push(ROOT, Instr::Once { of, cell }, None)
    }

    /// A draw of its own stream: never shared.
    pub(crate) fn random(&mut self, key: u64, from: Distribution) -> Reg {
        self.push(self.here(), Instr::Random { key, from: Box::new(from) }, None)
    }

    /// Pays into a term.
    pub(crate) fn give(&mut self, term: u32, value: Reg, guard: Option<Reg>) {
        self.push(self.here(), Instr::Give { term, value, guard }, None);
    }

    /// Writes a cell.
    pub(crate) fn assign(&mut self, cell: u32, value: Reg, guard: Option<Reg>) {
        self.push(self.here(), Instr::Assign { cell, value, guard }, None);
        let times = self.open.iter().filter_map(|block| self.most_runs(*block)).product();
        if let Some(cell) = self.cells.get_mut(cell as usize) {
            cell.writes.push(CellWrite { value, times });
        }
    }

    /// How often the body of a loop runs at most.
    fn most_runs(&self, body: BlockId) -> Option<f64> {
        let owner = self.blocks.get(body)?.owner?;
        match &self.nodes.get(owner as usize)?.instr {
            Instr::Each(each) => Some(match each.over {
                Over::Players { .. } => PLAYERS_MAX as f64,
                Over::Events(_) => EVENTS_MAX as f64,
                Over::Numbers(n) => n.into(),
            }),
            _ => None,
        }
    }

    /// Opens a loop; everything until `close_loop` is its body.
    pub(crate) fn open_loop(&mut self, over: Over) -> OpenLoop {
        let body = self.blocks.len();
        let at = self.nodes.len() as u32;
        let fold = Fold { kind: FoldKind::Nothing, value: None, guard: None };
        self.nodes.push(CodeNode {
            instr: Instr::Each(Box::new(Each { over, body: 0, fold })),
            block: body,
            body: Some(body),
            unknown: false,
        });
        self.blocks.push(CodeBlock { owner: Some(at), ..CodeBlock::default() });
        self.open.push(body);
        OpenLoop { at, body }
    }

    /// Closes the innermost loop and gives its result.
    pub(crate) fn close_loop(&mut self, open: OpenLoop, fold: Fold) -> Reg {
        self.open.retain(|&block| block != open.body);
        let here = self.here();
        let mut unknown = fold.value.iter().chain(&fold.guard).any(|reg| self.is_unknown(*reg));
        if let Some(instr) = self.instr(open.element()) {
            instr.operands(&mut |reg| unknown |= self.is_unknown(reg));
        }
        if let Some(node) = self.nodes.get_mut(open.at as usize) {
            node.block = here;
            node.unknown = unknown;
            if let Instr::Each(each) = &mut node.instr {
                each.fold = fold;
            }
        }
        if let Some(block) = self.blocks.get_mut(here) {
            block.nodes.push(open.at);
        }
        Reg(open.at)
    }

    fn here(&self) -> BlockId {
        self.open.last().copied().unwrap_or(ROOT)
    }

    fn is_event_body(&self, block: BlockId) -> bool {
        let owner = self.blocks.get(block).and_then(|block| block.owner);
        owner.and_then(|at| self.nodes.get(at as usize)).is_some_and(
            |node| matches!(&node.instr, Instr::Each(each) if matches!(each.over, Over::Events(_))),
        )
    }

    /// The innermost block, of the open ones, that any of the operands needs.
    fn block_of(&self, operands: &[Reg]) -> BlockId {
        let depth = |reg: &Reg| {
            let block = self.nodes.get(reg.index()).map_or(ROOT, |node| node.block);
            self.open.iter().position(|&open| open == block).unwrap_or(0)
        };
        let deepest = operands.iter().map(depth).max().unwrap_or(0);
        self.open.get(deepest).copied().unwrap_or(ROOT)
    }

    fn shared(&mut self, block: BlockId, key: Key, instr: Instr) -> Reg {
        let known =
            |b: BlockId| self.blocks.get(b).and_then(|block| block.known.get(&key)).copied();
        if let Some(at) = known(block) {
            return Reg(at);
        }
        self.push(block, instr, Some(key))
    }

    fn temporal(&mut self, key: Key, make: impl FnOnce(u32) -> Instr) -> Reg {
        if let Some(&at) = self.blocks.get(ROOT).and_then(|block| block.known.get(&key)) {
            return Reg(at);
        }
        let cell = self.new_cell();
        self.push(ROOT, make(cell), Some(key))
    }

    fn push(&mut self, block: BlockId, instr: Instr, key: Option<Key>) -> Reg {
        let at = self.nodes.len() as u32;
        let mut unknown = matches!(instr, Instr::Param(u32::MAX));
        instr.operands(&mut |reg| unknown |= self.is_unknown(reg));
        self.nodes.push(CodeNode { instr, block, body: None, unknown });
        if let Some(block) = self.blocks.get_mut(block) {
            block.nodes.push(at);
            if let Some(key) = key {
                block.known.insert(key, at);
            }
        }
        Reg(at)
    }
}
