//! The statements of a reward: conditions as guards, events as loops, payments and assignments as
//! effects.

use crate::ast::{
    Binding as Let, EventExpr, Expr, GiveStmt, GiveValue, Ident, ParamDecl, RewardStmt,
    RewardStmtKind, ScriptRef, Spanned,
};
use crate::check::types::Ty;
use crate::lower::script::{AskedHook, embed};
use crate::lower::value::LocalName;
use crate::lower::{Lower, param};
use crate::problem::facts::{Assigned, Names, Never, Rewards, Scopes};
use crate::problem::{Code, Guess, Problem};
use setpiece_scenario::pitch::STEP_S;
use setpiece_scenario::program::PAY_MAX;
use setpiece_scenario::{BinaryOp, Fold, FoldKind, Instr, Reg, RewardHook, UnaryOp};
use std::collections::BTreeMap;

/// What a step program pays into, and which scripts it asks.
pub(super) struct WrittenProgram {
    /// The labels of the terms.
    pub(super) terms: Vec<String>,
    /// The scripts; their arguments in registers of the builder.
    pub(super) hooks: Vec<RewardHook>,
}

/// What a scenario asks of every payment of a reward.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Payment {
    /// What it is multiplied by.
    pub(super) weight: Option<Reg>,
    /// Whether the agent receives it.
    pub(super) audience: Option<Reg>,
}

/// Writes the step program.
pub(super) struct RewardWriter<'l, 'c, 'w> {
    lower: &'l mut Lower<'c, 'w>,
    terms: Vec<String>,
    /// Where each label stands among them.
    places: BTreeMap<String, u32>,
    hooks: Vec<RewardHook>,
    /// The reward's parameters, which its scripts see.
    params: Vec<&'w ParamDecl>,
    /// What is paid to which agents; `None` if only the states are kept.
    payment: Option<Payment>,
    guard: Option<Reg>,
    /// Why the event around never happens.
    never: Option<Never>,
    unlabelled: usize,
}

impl<'l, 'c, 'w> RewardWriter<'l, 'c, 'w> {
    fn new(
        lower: &'l mut Lower<'c, 'w>,
        payment: Option<Payment>,
        params: Vec<&'w ParamDecl>,
    ) -> RewardWriter<'l, 'c, 'w> {
        let (terms, places, hooks) = (Vec::new(), BTreeMap::new(), Vec::new());
        RewardWriter {
            lower,
            terms,
            places,
            hooks,
            params,
            payment,
            guard: None,
            never: None,
            unlabelled: 0,
        }
    }

    /// Writes the statements, for what their names are bound to in the present scope; gives what it
    /// pays into.
    pub(super) fn write(
        lower: &'l mut Lower<'c, 'w>,
        statements: &[&'w RewardStmt],
        payment: Option<Payment>,
        params: Vec<&'w ParamDecl>,
    ) -> WrittenProgram {
        let mut writer = RewardWriter::new(lower, payment, params);
        // The step's `let`s come first, top to bottom: they see no assignment of this step.
        for statement in statements {
            if let RewardStmtKind::Let(binding) = &statement.kind {
                writer.bind_let(binding);
            }
        }
        for statement in statements {
            writer.statement(statement, true);
        }
        WrittenProgram { terms: writer.terms, hooks: writer.hooks }
    }

    /// Writes a reward that is a script: it pays into its terms, from the first on.
    pub(super) fn script_alone(
        lower: &'l mut Lower<'c, 'w>,
        script: &'w ScriptRef,
        labels: &[Spanned<String>],
        payment: Payment,
    ) -> Vec<RewardHook> {
        let mut writer = RewardWriter::new(lower, Some(payment), Vec::new());
        for (term, value) in (0..).zip(writer.script(script, labels)) {
            let value = writer.weighted(value);
            writer.lower.code.give(term, value, payment.audience);
        }
        writer.hooks
    }

    fn bind_let(&mut self, binding: &'w Let) {
        let lower = &mut *self.lower;
        let scope = lower.scope.clone();
        let ty = binding.ty.as_ref().map(|ty| param::declared_type(lower.world, ty));
        let value = match ty {
            Some(ty) => lower.want(&binding.value, ty),
            None => lower.expr(&binding.value),
        };
        let at = binding.name.span;
        lower.check_hides(&binding.name.node, at, &lower.scope);
        // A `let` that takes a state's name has been reported.
        if matches!(lower.scope.find(&binding.name.node), Some(LocalName::State { .. })) {
            return;
        }
        lower.scope.bind(
            &binding.name.node,
            LocalName::Expr { expr: &binding.value, scope, ty, now: Some(value), at },
        );
    }

    fn statement(&mut self, statement: &'w RewardStmt, is_top: bool) {
        match &statement.kind {
            RewardStmtKind::State(state) if !is_top => {
                self.lower
                    .report(Problem::new(state.name.span, Scopes::StateInBlock { of: "a reward" }));
            }
            RewardStmtKind::Let(binding) if !is_top => self.bind_let(binding),
            RewardStmtKind::Give(give) if self.payment.is_some() => {
                match self.payment.and_then(|payment| payment.audience) {
                    Some(audience) => self.guarded(audience, |writer| writer.give(give)),
                    None => self.give(give),
                }
            }
            RewardStmtKind::State(_)
            | RewardStmtKind::Let(_)
            | RewardStmtKind::Give(_)
            | RewardStmtKind::Broken => {}
            RewardStmtKind::On { events, when, body } => {
                for event in events {
                    self.on_event(event, when.as_ref(), |writer| writer.block(body));
                }
            }
            RewardStmtKind::When { condition, then, otherwise } => {
                let condition = self.lower.condition(condition);
                self.guarded(condition, |writer| writer.block(then));
                if let Some(otherwise) = otherwise {
                    let not = self.lower.code.unary(UnaryOp::Not, condition);
                    self.guarded(not, |writer| writer.block(otherwise));
                }
            }
            RewardStmtKind::Assign { name, value } => self.assign(name, value),
        }
    }

    fn block(&mut self, body: &'w [RewardStmt]) {
        let scope = self.lower.scope.clone();
        for statement in body {
            self.statement(statement, false);
        }
        self.lower.scope = scope;
    }

    fn guarded(&mut self, condition: Reg, f: impl FnOnce(&mut Self)) {
        let outer = self.guard;
        self.guard = Some(match outer {
            Some(guard) => self.lower.code.binary(BinaryOp::And, guard, condition),
            None => condition,
        });
        f(self);
        self.guard = outer;
    }

    /// Runs `f` once per matching event.
    fn on_event(
        &mut self,
        event: &'w EventExpr,
        when: Option<&'w Expr>,
        f: impl FnOnce(&mut Self),
    ) {
        if self.lower.event.is_some() {
            self.lower.report(Problem::new(event.span, Scopes::OnInsideOn));
            return;
        }
        let Some(matching) = self.lower.open_events(event) else { return };
        let scope = self.lower.scope.clone();
        self.never = self.lower.never_happens(&matching.filter);
        let outer = self.guard;
        let guards = [matching.guard, when.map(|when| self.lower.condition(when))];
        for guard in guards.into_iter().flatten() {
            self.guard = Some(match self.guard {
                Some(known) => self.lower.code.binary(BinaryOp::And, known, guard),
                None => guard,
            });
        }
        f(self);
        self.guard = outer;
        self.never = None;
        self.lower.scope = scope;
        self.lower
            .close_events(matching, Fold { kind: FoldKind::Nothing, value: None, guard: None });
    }

    fn give(&mut self, give: &'w GiveStmt) {
        let listed = match &give.value {
            GiveValue::Script { terms, .. } => terms.as_ref(),
            GiveValue::Expr(_) => None,
        };
        if give.label.is_none() && listed.is_none() {
            self.unlabelled += 1;
        }
        if let Some(label) = give.label.as_ref().filter(|label| label.node.trim().is_empty()) {
            self.lower.report(Problem::new(label.span, Rewards::EmptyLabel));
        }
        let terms: Vec<u32> = match (listed, &give.label) {
            (Some(terms), _) => terms.node.iter().map(|term| self.term(&term.node)).collect(),
            (None, Some(label)) => vec![self.term(&label.node)],
            (None, None) => vec![self.term(&self.unlabelled.to_string())],
        };
        let terms = terms.as_slice();
        if give.on.is_empty() {
            let when = give.when.as_ref().map(|when| self.lower.condition(when));
            match when {
                Some(when) => self.guarded(when, |writer| writer.pay_to(give, terms)),
                None => self.pay_to(give, terms),
            }
            return;
        }
        // All loops of a `give once on a or b` share one memory.
        let paid = give.once.map(|_| self.lower.code.new_cell());
        for event in &give.on {
            self.on_event(event, give.when.as_ref(), |writer| {
                writer.for_receiver(give, |writer| {
                    let values = writer.amounts(give);
                    match paid {
                        Some(cell) => writer.pay_once(terms, &values, cell),
                        None => writer.pay_all(terms, &values, writer.guard),
                    }
                });
            });
        }
    }

    fn term(&mut self, label: &str) -> u32 {
        let next = self.terms.len() as u32;
        let place = *self.places.entry(label.to_owned()).or_insert(next);
        if place == next {
            self.terms.push(label.to_owned());
        }
        place
    }

    /// Writes what is paid, for those that `to` names.
    fn for_receiver(&mut self, give: &'w GiveStmt, f: impl FnOnce(&mut Self)) {
        match give.to.as_ref().and_then(|to| self.lower.audience(to, "to")) {
            Some(receives) => self.guarded(receives, f),
            None => f(self),
        }
    }

    fn pay_to(&mut self, give: &'w GiveStmt, terms: &[u32]) {
        self.for_receiver(give, |writer| writer.pay(give, terms));
    }

    fn pay(&mut self, give: &'w GiveStmt, terms: &[u32]) {
        let values = self.amounts(give);
        match give.once {
            Some(_) if self.lower.code.in_loop() => {
                let cell = self.lower.code.new_cell();
                self.pay_once(terms, &values, cell);
            }
            Some(_) => {
                let guard = self.guard.unwrap_or_else(|| self.lower.code.bool(true));
                let first = self.lower.code.once(guard);
                self.pay_all(terms, &values, Some(first));
            }
            None => self.pay_all(terms, &values, self.guard),
        }
    }

    /// Pays each value into its term.
    fn pay_all(&mut self, terms: &[u32], values: &[Reg], guard: Option<Reg>) {
        for (&term, &value) in terms.iter().zip(values) {
            self.lower.code.give(term, value, guard);
        }
    }

    /// Pays at the first match, which may be one of several in a step.
    fn pay_once(&mut self, terms: &[u32], values: &[Reg], cell: u32) {
        let code = &mut self.lower.code;
        let paid = code.cell(cell);
        let open = code.unary(UnaryOp::Not, paid);
        let guard = match self.guard {
            Some(guard) => code.binary(BinaryOp::And, guard, open),
            None => open,
        };
        self.pay_all(terms, values, Some(guard));
        let code = &mut self.lower.code;
        let one = code.constant(1.0);
        code.assign(cell, one, Some(guard));
    }

    /// What is paid: one value for each of its terms.
    fn amounts(&mut self, give: &'w GiveStmt) -> Vec<Reg> {
        let mut values = match &give.value {
            GiveValue::Script { script, terms } => {
                let labels = terms.as_ref().map(|terms| terms.node.as_slice());
                self.script(script, labels.unwrap_or_default())
            }
            GiveValue::Expr(value) => {
                let reg = self.lower.want_reg(value, Ty::Number);
                self.check_payable(reg, value);
                self.check_pays(reg, value);
                vec![reg]
            }
        };
        for value in &mut values {
            if give.per_second {
                let step = self.lower.code.constant(STEP_S);
                *value = self.lower.code.binary(BinaryOp::Mul, *value, step);
            }
            *value = self.weighted(*value);
        }
        values
    }

    fn weighted(&mut self, value: Reg) -> Reg {
        match self.payment.and_then(|payment| payment.weight) {
            Some(weight) => self.lower.code.binary(BinaryOp::Mul, value, weight),
            None => value,
        }
    }

    /// The values of a script, one for each label, or one without: its hook is called before the
    /// step, once however often it is named.
    fn script(&mut self, script: &'w ScriptRef, labels: &[Spanned<String>]) -> Vec<Reg> {
        let args = self.lower.script_args(self.params.iter().copied(), false);
        let own: Vec<&str> = args.iter().map(|arg| arg.name.as_str()).collect();
        let terms: Vec<&str> = labels.iter().map(|label| label.node.as_str()).collect();
        let asked = AskedHook { name: "reward", own: &own, terms: &terms };
        let Some(index) = embed(self.lower, script, asked) else {
            return (0..labels.len().max(1)).map(|_| self.lower.code.unknown()).collect();
        };
        let known = self.hooks.iter().find(|hook| hook.script == index && hook.terms == terms);
        let cells = if let Some(hook) = known {
            hook.cells()
        } else {
            let cell = self.lower.code.new_cell();
            terms.iter().skip(1).for_each(|_| _ = self.lower.code.new_cell());
            let terms = terms.iter().map(|&term| term.to_owned()).collect();
            let hook = RewardHook { script: index, cell, terms, args };
            let cells = hook.cells();
            self.hooks.push(hook);
            cells
        };
        cells.map(|cell| self.lower.code.cell_before(cell)).collect()
    }

    /// Warns of a payment that never happens, in a reward that stands in its scenario: another's
    /// parameters may switch a part of it off.
    fn check_pays(&self, reg: Reg, value: &Expr) {
        if !self.lower.scope.scenario {
            return;
        }
        let nothing = self.lower.code.constant_of(reg) == Some(0.0);
        let guard = self.guard.filter(|guard| self.lower.never_holds(*guard));
        let why = match (self.never, guard) {
            (Some(why), _) => why,
            (None, Some(guard)) => self.lower.why_never(guard),
            (None, None) if nothing => Never::Nothing,
            (None, None) => return,
        };
        self.lower.report(Problem::new(value.span, Rewards::NeverPays { why }));
    }

    /// Reports a constant that is more than can be paid.
    fn check_payable(&self, reg: Reg, value: &Expr) {
        let code = &self.lower.code;
        let paid = code.constant_of(reg).or_else(|| match code.instr(reg) {
            // A division by zero has been reported.
            Some(&Instr::Binary(BinaryOp::Div, _, b)) if code.constant_of(b) == Some(0.0) => None,
            Some(&Instr::Binary(op, a, b)) => {
                Some(op.apply(code.constant_of(a)?, code.constant_of(b)?))
            }
            _ => None,
        });
        if paid.is_some_and(|paid| paid.is_nan() || paid.abs() > PAY_MAX) {
            let text = self.lower.world.text(value.span);
            self.lower.report(Problem::new(value.span, Rewards::MoreThanPayable { text }));
        }
    }

    fn assign(&mut self, name: &'w Ident, value: &'w Expr) {
        let Some(LocalName::State { cells, ty, .. }) = self.lower.scope.find(&name.node).cloned()
        else {
            self.not_a_state(name);
            self.lower.expr(value);
            return;
        };
        let regs = self.lower.want(value, ty).regs();
        for (cell, reg) in cells.iter().zip(regs) {
            self.lower.code.assign(*cell, reg, self.guard);
        }
    }

    fn not_a_state(&self, name: &Ident) {
        if self.lower.world.is_full(Code::UnknownName) {
            return;
        }
        let known = self.lower.scope.bindings();
        let states: Vec<&str> = known
            .iter()
            .filter(|(_, bound)| matches!(bound, LocalName::State { .. }))
            .map(|(name, _)| *name)
            .collect();
        let (is, guess) = if known.contains_key(name.node.as_str()) {
            (Assigned::ValueOfReward, Guess::default())
        } else {
            (Assigned::Nothing, Guess::similar_or(&name.node, &states, &[]))
        };
        self.lower.report(Problem::new(
            name.span,
            Names::NotAState { name: name.node.clone(), is, guess },
        ));
    }
}
