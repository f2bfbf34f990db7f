//! What a reward remembers: its states, and the names that it gives.

use super::WrittenReward;
use super::writer::RewardWriter;
use crate::ast::{
    Binding as Let, Ident, RewardStmt, RewardStmtKind, RewardUse, RewardUseKind, Span,
};
use crate::check::types::Ty;
use crate::lower::value::{LocalName, Scope, Value};
use crate::lower::{Lower, ProgramStage, World, param};
use crate::problem::facts::{Names, Types};
use crate::problem::{Guess, Problem};
use setpiece_scenario::{Reg, When};

/// The states at the top of a reward.
pub(super) fn states<'w>(statements: &[&'w RewardStmt]) -> Vec<&'w Let> {
    let state = |statement: &&'w RewardStmt| match &statement.kind {
        RewardStmtKind::State(state) => Some(state),
        _ => None,
    };
    statements.iter().filter_map(state).collect()
}

/// Reports a name that a reward gives to two things: a child may give a parent's parameter another
/// default.
pub(super) fn check_names(world: &World<'_>, written: &WrittenReward<'_>) {
    let params = written.links.iter().flat_map(|(link, _)| &link.params).map(|param| &param.name);
    let mut known: Vec<&Ident> = params.collect();
    let statements = written.statements();
    for state in states(&statements) {
        declare(world, &state.name, &mut known);
    }
    check_lets(world, &statements, &mut known);
}

fn declare<'w>(world: &World<'_>, name: &'w Ident, known: &mut Vec<&'w Ident>) {
    if let Some(first) = known.iter().find(|first| first.node == name.node) {
        world.report(Problem::new(
            name.span,
            Names::DeclaredTwice { what: format!("`{}`", name.node), first: Some(first.span) },
        ));
    }
    known.push(name);
}

fn check_lets<'w>(world: &World<'_>, statements: &[&'w RewardStmt], known: &mut Vec<&'w Ident>) {
    let inner = |body: &'w [RewardStmt], known: &mut Vec<&'w Ident>| {
        let outer = known.len();
        check_lets(world, &body.iter().collect::<Vec<_>>(), known);
        known.truncate(outer);
    };
    for statement in statements {
        match &statement.kind {
            RewardStmtKind::Let(binding) => declare(world, &binding.name, known),
            RewardStmtKind::On { body, .. } => inner(body, known),
            RewardStmtKind::When { then, otherwise, .. } => {
                inner(then, known);
                inner(otherwise.as_deref().unwrap_or_default(), known);
            }
            _ => {}
        }
    }
}

impl<'w> Lower<'_, 'w> {
    /// The first value of a state.
    pub(super) fn first_value(&mut self, state: &'w Let) -> Value<'w> {
        let declared = state.ty.as_ref().map(|ty| param::declared_type(self.world, ty));
        let mut value = match declared {
            Some(ty) => self.want(&state.value, ty),
            None => self.expr(&state.value),
        };
        // The ball as a value is where it is.
        if value.ty == Ty::Ball {
            value = self.convert(value, Ty::Point, &state.value);
        }
        // `state x = 0` holds numbers, not whole ones alone.
        if value.ty == Ty::Int && declared.is_none() {
            value.ty = Ty::Number;
        }
        if value.is_error() || value.is_held() {
            return value;
        }
        self.fail(Problem::new(state.value.span, Types::NoState { ty: value.ty }))
    }

    /// Makes a state known to the statements.
    pub(super) fn bind_state(&mut self, state: &'w Let, cells: Vec<u32>, before: Vec<Reg>, ty: Ty) {
        let binding = LocalName::State {
            cells: cells.into(),
            before: before.into(),
            ty,
            at: state.name.span,
        };
        self.check_hides(&state.name.node, state.name.span, &self.scope);
        self.scope.bind(&state.name.node, binding);
    }

    /// Reports a reward that stands for a value, and says how its states are read.
    pub(crate) fn reward_is_no_value(&self, name: &str, span: Span) -> Value<'w> {
        let states = self.states_read(name);
        self.fail(Problem::new(span, Types::RewardIsNoValue { name: name.to_owned(), states }))
    }

    /// How the states of a reward of the scenario are read here; `None` where none can be, and of
    /// what is no reward.
    pub(crate) fn states_read(&self, name: &str) -> Option<Vec<String>> {
        let world = self.world;
        // The scenario knows it by its label.
        let named = |used: &RewardUse| match &used.what {
            RewardUseKind::Named(reference) => reference.bare() == name,
            _ => false,
        };
        let rewards = || world.flat.rewards.iter();
        let used = rewards().find(|(known, ..)| known == name);
        let used = used.or_else(|| rewards().find(|(_, used, _)| named(used)));
        let reads = matches!(self.stage, ProgramStage::Record | ProgramStage::Ending);
        used.filter(|_| reads && self.scope.scenario).map(|(known, used, stmt)| {
            let written = world.tentatively(|| super::written(world, used, stmt.span));
            let kept = written.iter().flat_map(|(written, _)| states(&written.statements()));
            kept.map(|state| format!("{known}.{}", state.name.node)).collect()
        })
    }

    /// `chain.n` in a record or an ending: a state of a reward that the scenario uses.
    ///
    /// The reading program keeps the reward's states itself: it has the reward's statements without
    /// its payments.
    pub(crate) fn state_of_reward(
        &mut self,
        name: &str,
        of: Span,
        member: &'w Ident,
    ) -> Option<Value<'w>> {
        if !matches!(self.stage, ProgramStage::Record | ProgramStage::Ending) {
            return None;
        }
        let (_, used, stmt) = self.world.flat.rewards.iter().find(|(known, ..)| known == name)?;
        let known = self.remembered.rewards.iter().find(|(known, _)| known == name);
        let known = known.map(|(_, scope)| scope.clone());
        let scope = known.unwrap_or_else(|| {
            let scope = self.seen_by_all(name, of, |lower| lower.remember(used, stmt.span));
            self.remembered.rewards.push((name.to_owned(), scope.clone()));
            scope
        });
        let Some(scope) = scope else {
            // Where there is no such reward, that has been reported.
            if matches!(used.what, RewardUseKind::Script { .. }) {
                self.report(Problem::new(
                    member.span,
                    Names::ScriptHasNoStates { reward: name.to_owned() },
                ));
            }
            return Some(Value::error());
        };
        if let Some(state @ LocalName::State { .. }) = scope.find(&member.node).cloned() {
            return Some(self.local(&member.node, state, of.to(member.span)));
        }
        let is_state = |name: &&str| matches!(scope.find(name), Some(LocalName::State { .. }));
        let states: Vec<&str> = scope.names().into_iter().filter(is_state).collect();
        let guess = if states.is_empty() {
            Guess::default()
        } else {
            Guess::similar_or_all(&member.node, &states)
        };
        let fact =
            Names::NoStateOfReward { reward: name.to_owned(), name: member.node.clone(), guess };
        Some(self.fail(Problem::new(member.span, fact)))
    }

    /// Writes a reward's statements without its payments, outside every loop; gives the scope with
    /// its states.
    fn remember(&mut self, used: &'w RewardUse, span: Span) -> Option<Scope<'w>> {
        let (written, _) = super::written(self.world, used, span)?;
        let loops = self.code.leave_loops();
        // Where both teams have agents, or none, it is kept for each of them.
        let for_each = self.side_with_agents().is_none();
        self.remembered.per_agent |= for_each;
        self.remembered.has_view |= for_each;
        let us = self.side_with_agents().map(|team| self.code.constant(team.index() as f64));
        let us = us.unwrap_or_else(|| self.code.us());
        let outer = (
            self.event.take(),
            std::mem::replace(&mut self.when, When::Now),
            self.team.replace(us),
        );
        let outer_scope = self.scope.clone();
        let statements = written.statements();
        let states = states(&statements);

        let reader = std::mem::replace(&mut self.stage, ProgramStage::Init);
        self.scope = written.bind(self);
        let firsts: Vec<Value<'w>> = states.iter().map(|state| self.first_value(state)).collect();
        self.stage = ProgramStage::Reward;
        self.scope = written.bind(self);
        // Cells begin at 0: another first value is put there in the first step.
        let begun = self.code.new_cell();
        let has_begun = self.code.cell_before(begun);
        let mut kept = vec![begun];
        for (state, first) in states.iter().zip(&firsts) {
            let (mut cells, mut before) = (Vec::new(), Vec::new());
            for reg in first.regs() {
                let cell = self.code.new_cell();
                let last = self.code.cell_before(cell);
                let known = if self.code.constant_of(reg) == Some(0.0) {
                    last
                } else {
                    let known = self.code.select(has_begun, last, reg);
                    self.code.assign(cell, known, None);
                    known
                };
                cells.push(cell);
                before.push(known);
            }
            kept.extend(&cells);
            self.bind_state(state, cells, before, first.ty);
        }
        let with_states = self.scope.clone();
        RewardWriter::write(self, &statements, None, Vec::new());
        let one = self.code.constant(1.0);
        self.code.assign(begun, one, None);
        for cell in kept {
            self.code.close_cell(cell);
        }
        self.stage = reader;
        (self.event, self.when, self.team) = outer;
        self.scope = outer_scope;
        self.code.return_to(loops);
        Some(with_states)
    }
}
