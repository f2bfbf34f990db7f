//! Statements of a behaviour: blocks, loops, choices, what is remembered.

use super::{BehaviorWriter, State};
use crate::ast::{BehaviorStmt, BehaviorStmtKind, Binding as Let, Chance, Expr, Ident, RepeatHow};
use crate::check::types::Ty;
use crate::lower::param;
use crate::lower::value::{LocalName, Scope, Value};
use crate::problem::Problem;
use crate::problem::facts::{Behaviors, Names, Scopes, Types};
use setpiece_scenario::{BinaryOp, Distribution, Node, Reg, Then, UnaryOp, Watch};

impl<'w> BehaviorWriter<'_, 'w> {
    /// Declares the states at the top of a behaviour and sets them.
    pub(super) fn find_states(&mut self, statements: &'w [BehaviorStmt]) {
        for statement in statements {
            let BehaviorStmtKind::State(state) = &statement.kind else { continue };
            if self.states.iter().any(|known| known.name == state.name.node) {
                self.lower.report(Problem::new(
                    state.name.span,
                    Names::DeclaredTwice {
                        what: format!("state `{}`", state.name.node),
                        first: None,
                    },
                ));
                continue;
            }
            self.state(state);
        }
    }

    fn state(&mut self, state: &'w Let) {
        let mut value = self.drawing(|writer| writer.typed(state));
        if value.ty == Ty::Int && state.ty.is_none() {
            value.ty = Ty::Number;
        }
        let regs = value.regs();
        let held = value.is_held();
        if !held && !value.is_error() {
            self.lower.report(Problem::new(state.value.span, Types::NoState { ty: value.ty }));
        }
        let cells: Vec<u32> = regs.iter().map(|_| self.lower.code.new_cell()).collect();
        let read: Vec<Reg> = cells.iter().map(|&cell| self.lower.code.cell(cell)).collect();
        let kept = if held { Value::of_regs(value.ty, &read) } else { Value::error() };
        let ty = kept.ty;
        self.nodes.push(Node::Let(cells.iter().copied().zip(regs).collect()));
        self.lower.check_hides_local(&state.name.node, state.name.span, &self.around);
        let kept = LocalName::Kept { value: kept, at: state.name.span };
        self.lower.scope.bind(&state.name.node, kept);
        self.states.push(State { name: &state.name.node, cells, ty });
    }

    /// The value of a `let` or `state`, of its declared type if it has one.
    fn typed(&mut self, binding: &'w Let) -> Value<'w> {
        let ty = binding.ty.as_ref().map(|ty| param::declared_type(self.lower.world, ty));
        let value = match ty {
            Some(ty) => self.lower.want(&binding.value, ty),
            None => self.lower.expr(&binding.value),
        };
        // The ball as a value is where it is.
        if value.ty == Ty::Ball {
            self.lower.convert(value, Ty::Point, &binding.value)
        } else {
            value
        }
    }

    /// Writes a block: its statements, then what may interrupt them, the first written last.
    pub(super) fn block(&mut self, statements: &'w [BehaviorStmt], is_top: bool) {
        if !self.lower.world.effort.spend(statements.len()) {
            return;
        }
        let scope = self.lower.scope.clone();
        // The states at the top belong to the block itself.
        let inner = if is_top { self.around.clone() } else { scope.clone() };
        let around = std::mem::replace(&mut self.around, inner);
        let from = self.nodes.len() as u32;
        let count = statements
            .iter()
            .filter(|s| matches!(s.kind, BehaviorStmtKind::Interrupt { .. }))
            .count();
        let first = self.watches.len();
        let blank = Watch { from, to: from, when: Reg(0), then: Then::Leave };
        self.watches.extend(std::iter::repeat_n(blank, count));
        let mut bodies: Vec<(&'w [BehaviorStmt], Scope<'w>)> = Vec::new();
        for statement in statements {
            if let BehaviorStmtKind::Interrupt { condition, body } = &statement.kind {
                let when = self.lower.condition(condition);
                if let Some(watch) = self.watches.get_mut(first + bodies.len()) {
                    watch.when = when;
                }
                bodies.push((body, self.lower.scope.clone()));
            } else {
                self.statement(statement, is_top);
            }
        }
        if !bodies.is_empty() {
            let skip = self.nodes.len();
            self.nodes.push(Node::Jump(0));
            for (index, (body, seen)) in bodies.into_iter().enumerate().rev() {
                let start = self.nodes.len() as u32;
                if let Some(watch) = self.watches.get_mut(first + index) {
                    (watch.to, watch.then) = (start, Then::Interrupt(start));
                }
                self.lower.scope = seen;
                self.block(body, false);
                self.nodes.push(Node::Return);
            }
            self.patch(skip, self.nodes.len() as u32);
        }
        self.lower.scope = scope;
        self.around = around;
    }

    fn statement(&mut self, statement: &'w BehaviorStmt, is_top: bool) {
        match &statement.kind {
            BehaviorStmtKind::State(state) if !is_top => {
                self.lower.report(Problem::new(
                    state.name.span,
                    Scopes::StateInBlock { of: "a behavior" },
                ));
            }
            BehaviorStmtKind::State(_)
            | BehaviorStmtKind::Interrupt { .. }
            | BehaviorStmtKind::Broken => {}
            BehaviorStmtKind::Let(binding) => self.freeze(binding),
            BehaviorStmtKind::Assign { name, value } => self.assign(name, value),
            BehaviorStmtKind::Do(stmt) => self.do_stmt(stmt),
            BehaviorStmtKind::Repeat { how, body } => self.repeat(how, body),
            BehaviorStmtKind::Choose(chances) => self.choose(chances, statement),
            BehaviorStmtKind::If { arms, otherwise } => self.if_stmt(arms, otherwise),
            BehaviorStmtKind::Finish => {
                let at = self.nodes.len();
                if let Some(call) = self.calls.last_mut() {
                    call.finishes.push(at);
                    self.nodes.push(Node::Finish { from: call.from as u32, to: 0 });
                }
            }
        }
    }

    /// `let x = …`: the value is frozen when the statement is reached.
    fn freeze(&mut self, binding: &'w Let) {
        let value = self.drawing(|writer| writer.typed(binding));
        let mut pairs = Vec::new();
        let code = &mut self.lower.code;
        let frozen = value.map(&mut |reg| {
            if code.constant_of(reg).is_some() || code.is_unknown(reg) {
                return reg;
            }
            let cell = code.new_cell();
            pairs.push((cell, reg));
            code.cell(cell)
        });
        if !pairs.is_empty() {
            self.nodes.push(Node::Let(pairs));
        }
        // A state may be hidden by what stands beside it, another `let` is bound again.
        let is_state = self.states.iter().any(|state| state.name == binding.name.node);
        let around = if is_state { &self.lower.scope } else { &self.around };
        self.lower.check_hides_local(&binding.name.node, binding.name.span, around);
        self.lower.scope.bind(&binding.name.node, LocalName::Value(frozen));
    }

    fn assign(&mut self, name: &'w Ident, value: &'w Expr) {
        let known = self
            .states
            .iter()
            .find(|state| state.name == name.node)
            .map(|state| (state.cells.clone(), state.ty));
        let Some((cells, ty)) = known else {
            self.not_a_state(name);
            self.drawing(|writer| writer.lower.expr(value));
            return;
        };
        let value = self.drawing(|writer| writer.lower.want(value, ty));
        let regs = value.regs();
        if regs.len() == cells.len() {
            self.nodes.push(Node::Assign(cells.into_iter().zip(regs).collect()));
        }
    }

    fn repeat(&mut self, how: &'w RepeatHow, body: &'w [BehaviorStmt]) {
        let mark = self.lower.code.new_cell();
        let counted = match how {
            RepeatHow::Times(times) => Some(self.count(times)),
            _ => None,
        };
        let to = self.nodes.len() as u32;
        self.nodes.push(Node::Mark(mark));
        let going = match how {
            RepeatHow::Forever => None,
            RepeatHow::Until(condition) => {
                let done = self.drawing(|writer| writer.lower.condition(condition));
                Some(self.lower.code.unary(UnaryOp::Not, done))
            }
            RepeatHow::Times(_) => counted.map(|(passed, times)| {
                let passed = self.lower.code.cell(passed);
                self.lower.code.binary(BinaryOp::Lt, passed, times)
            }),
        };
        let branch = going.map(|when| self.branch(when));
        if let Some((passed, _)) = counted {
            let (now, one) = (self.lower.code.cell(passed), self.lower.code.constant(1.0));
            let next = self.lower.code.binary(BinaryOp::Add, now, one);
            self.nodes.push(Node::Let(vec![(passed, next)]));
        }
        self.block(body, false);
        self.nodes.push(Node::Loop { to, mark });
        if let Some(branch) = branch {
            self.patch(branch, self.nodes.len() as u32);
        }
    }

    /// A counter of passes set to 0, and how many there are to be.
    fn count(&mut self, times: &'w Expr) -> (u32, Reg) {
        let wanted = self.drawing(|writer| writer.lower.want_reg(times, Ty::Int));
        self.lower.check_range(
            wanted,
            (0.0, 1.0e9),
            "the number of passes",
            times.span,
            "`0..1000000000`",
        );
        let (passed, limit) = (self.lower.code.new_cell(), self.lower.code.new_cell());
        let zero = self.lower.code.constant(0.0);
        self.nodes.push(Node::Let(vec![(passed, zero), (limit, wanted)]));
        (passed, self.lower.code.cell(limit))
    }

    /// Goes on if a condition holds; the place of the node, which still needs the place to go to
    /// otherwise.
    pub(super) fn branch(&mut self, when: Reg) -> usize {
        self.nodes.push(Node::Branch { when, otherwise: 0 });
        self.nodes.len() - 1
    }

    fn if_stmt(&mut self, arms: &'w [(Expr, Vec<BehaviorStmt>)], otherwise: &'w [BehaviorStmt]) {
        let mut ends = Vec::new();
        for (condition, body) in arms {
            let when = self.drawing(|writer| writer.lower.condition(condition));
            let branch = self.branch(when);
            self.block(body, false);
            ends.push(self.nodes.len());
            self.nodes.push(Node::Jump(0));
            self.patch(branch, self.nodes.len() as u32);
        }
        self.block(otherwise, false);
        self.land(&ends);
    }

    /// Lets jumps lead to here.
    fn land(&mut self, jumps: &[usize]) {
        let here = self.nodes.len() as u32;
        for &at in jumps {
            self.patch(at, here);
        }
    }

    fn choose(&mut self, chances: &'w [Chance], statement: &'w BehaviorStmt) {
        if chances.is_empty() {
            self.lower.report(Problem::new(statement.span, Behaviors::NoChoices));
            return;
        }
        let index = self.drawing(|writer| {
            let weights: Vec<(Reg, crate::source::Span)> = chances
                .iter()
                .map(|chance| {
                    (writer.lower.want_reg(&chance.weight, Ty::Number), chance.weight.span)
                })
                .collect();
            writer.lower.check_weights(&weights, statement.span);
            let weights = weights.into_iter().map(|(reg, _)| reg).collect();
            writer.lower.random(Distribution::Weighted(weights))
        });
        let mut ends = Vec::new();
        for (number, chance) in chances.iter().enumerate() {
            let number = self.lower.code.constant(number as f64);
            let chosen = self.lower.code.binary(BinaryOp::Eq, index, number);
            let branch = self.branch(chosen);
            self.block(&chance.body, false);
            ends.push(self.nodes.len());
            self.nodes.push(Node::Jump(0));
            self.patch(branch, self.nodes.len() as u32);
        }
        self.land(&ends);
    }
}
