//! The last step of a builder: drops what nothing uses, and lays the blocks out in order.

use super::{BlockId, Builder, PROLOGUE, ROOT, RegisterLayout};
use setpiece_scenario::{
    Distribution, Each, EventFilter, Fold, Instr, Over, Program, Reg, Table, Who,
};

impl Builder {
    /// Lays the program out; `roots` are the registers whose values are wanted besides the effects.
    pub(crate) fn finish(self, roots: &[Reg]) -> (Program, RegisterLayout) {
        let live = self.live(roots);
        let mut out = LaidOutCode { code: Vec::new(), layout: vec![None; self.nodes.len()] };
        self.lay_out(PROLOGUE, &live, &mut out);
        self.lay_out(ROOT, &live, &mut out);
        let mut program =
            Program { code: out.code, cells: self.cells.len() as u32, tables: Vec::new() };
        self.keep_tables(&mut program);
        (program, RegisterLayout(out.layout))
    }

    /// Gives the program the tables that it reads.
    fn keep_tables(self, program: &mut Program) {
        let mut kept: Vec<Option<u32>> = vec![None; self.tables.len()];
        let mut number = 0;
        for instr in &mut program.code {
            if let Instr::Table { table, .. } = instr
                && let Some(slot) = kept.get_mut(*table as usize)
            {
                *table = *slot.get_or_insert_with(|| {
                    number += 1;
                    number - 1
                });
            }
        }
        let mut tables: Vec<(u32, Table)> = self
            .tables
            .into_iter()
            .zip(kept)
            .filter_map(|((_, table), kept)| Some((kept?, table)))
            .collect();
        tables.sort_by_key(|(kept, _)| *kept);
        program.tables = tables.into_iter().map(|(_, table)| table).collect();
    }

    fn live(&self, roots: &[Reg]) -> Vec<bool> {
        let mut live = vec![false; self.nodes.len()];
        let mut stack: Vec<Reg> = roots.to_vec();
        for (at, node) in self.nodes.iter().enumerate() {
            if matches!(node.instr, Instr::Give { .. } | Instr::Assign { .. }) {
                stack.push(Reg(at as u32));
            }
        }
        while let Some(reg) = stack.pop() {
            let (Some(node), Some(mark)) = (self.nodes.get(reg.index()), live.get_mut(reg.index()))
            else {
                continue;
            };
            if std::mem::replace(mark, true) {
                continue;
            }
            node.instr.operands(&mut |operand| stack.push(operand));
            if let Instr::Each(each) = &node.instr {
                stack.extend(each.fold.value.iter().chain(&each.fold.guard));
            }
            // What lies in a loop needs the loop.
            if let Some(owner) = self.blocks.get(node.block).and_then(|block| block.owner) {
                stack.push(Reg(owner));
            }
        }
        live
    }

    fn lay_out(&self, block: BlockId, live: &[bool], out: &mut LaidOutCode) {
        let Some(block) = self.blocks.get(block) else { return };
        for &at in &block.nodes {
            let at = at as usize;
            let Some(node) = self.nodes.get(at).filter(|_| live.get(at) == Some(&true)) else {
                continue;
            };
            let new = out.code.len();
            if let Some(slot) = out.layout.get_mut(at) {
                *slot = Some(Reg(new as u32));
            }
            let instr = out.renumbered(&node.instr);
            out.code.push(instr);
            if let Some(body) = node.body {
                self.lay_out(body, live, out);
                let length = (out.code.len() - new - 1) as u32;
                let fold = match &node.instr {
                    Instr::Each(each) => Some(Fold {
                        kind: each.fold.kind,
                        value: each.fold.value.map(|reg| out.place(reg)),
                        guard: each.fold.guard.map(|reg| out.place(reg)),
                    }),
                    _ => None,
                };
                if let (Some(Instr::Each(each)), Some(fold)) = (out.code.get_mut(new), fold) {
                    each.body = length;
                    each.fold = fold;
                }
            }
        }
    }
}

/// Code that is being laid out.
struct LaidOutCode {
    code: Vec<Instr>,
    layout: Vec<Option<Reg>>,
}

impl LaidOutCode {
    fn place(&self, reg: Reg) -> Reg {
        self.layout.get(reg.index()).copied().flatten().unwrap_or(Reg(0))
    }

    fn renumbered(&self, instr: &Instr) -> Instr {
        let p = |reg: &Reg| self.place(*reg);
        match instr {
            Instr::Unary(op, a) => Instr::Unary(*op, p(a)),
            Instr::Binary(op, a, b) => Instr::Binary(*op, p(a), p(b)),
            Instr::Select(a, b, c) => Instr::Select(p(a), p(b), p(c)),
            Instr::Load { field, of, when } => {
                Instr::Load { field: *field, of: of.as_ref().map(p), when: *when }
            }
            Instr::Table { table, x, y, linear } => {
                Instr::Table { table: *table, x: p(x), y: p(y), linear: *linear }
            }
            Instr::Each(each) => {
                let over = match &each.over {
                    Over::Numbers(number) => Over::Numbers(*number),
                    Over::Players { team, except } => {
                        Over::Players { team: p(team), except: except.as_ref().map(p) }
                    }
                    Over::Events(filter) => {
                        let who = |who: &Who| match who {
                            Who::Team(reg) => Who::Team(p(reg)),
                            Who::Player(reg) => Who::Player(p(reg)),
                        };
                        Over::Events(EventFilter {
                            kind: filter.kind,
                            qualifier: filter.qualifier,
                            by: filter.by.as_ref().map(who),
                            to: filter.to.as_ref().map(who),
                        })
                    }
                };
                Instr::Each(Box::new(Each { over, body: each.body, fold: each.fold.clone() }))
            }
            Instr::Held { of, seconds, cell } => {
                Instr::Held { of: p(of), seconds: p(seconds), cell: *cell }
            }
            Instr::Ever { of, cell } => Instr::Ever { of: p(of), cell: *cell },
            Instr::Since { of, cell } => Instr::Since { of: p(of), cell: *cell },
            Instr::Until { of, release, cell } => {
                Instr::Until { of: p(of), release: p(release), cell: *cell }
            }
            Instr::Before { of, cell } => Instr::Before { of: p(of), cell: *cell },
            Instr::Once { of, cell } => Instr::Once { of: p(of), cell: *cell },
            Instr::Give { term, value, guard } => {
                Instr::Give { term: *term, value: p(value), guard: guard.as_ref().map(p) }
            }
            Instr::Assign { cell, value, guard } => {
                Instr::Assign { cell: *cell, value: p(value), guard: guard.as_ref().map(p) }
            }
            Instr::Random { key, from } => {
                let from = match &**from {
                    Distribution::Uniform(a, b) => Distribution::Uniform(p(a), p(b)),
                    Distribution::Normal(a, b) => Distribution::Normal(p(a), p(b)),
                    Distribution::TruncatedNormal(a, b, c, d) => {
                        Distribution::TruncatedNormal(p(a), p(b), p(c), p(d))
                    }
                    Distribution::Integer(a, b) => Distribution::Integer(p(a), p(b)),
                    Distribution::Weighted(weights) => {
                        Distribution::Weighted(weights.iter().map(p).collect())
                    }
                };
                Instr::Random { key: *key, from: Box::new(from) }
            }
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
            | Instr::Cell(_) => instr.clone(),
        }
    }
}
