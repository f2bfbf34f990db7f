//! Rewards: a program at every step that pays into terms, and one at reset that sets the states.

use super::value::{Binding, Frame, Scope, Value};
use super::{Lower, Stage, World, fold, param};
use crate::ast::{
    Arg, Binding as Let, EventExpr, Expr, GiveStmt, RewardItem, RewardStmt, RewardStmtKind, RewardUse, RewardUseKind,
    Span,
};
use crate::check::types::Ty;
use crate::problem::{Code, Problem};
use crate::resolve::reward_chain;
use crate::source::FileId;
use setpiece_scenario::program::PAY_MAX;
use setpiece_scenario::{BinaryOp, Fold, FoldKind, Instr, Reg, Reward, RewardBody, UnaryOp};

/// A reward's statements with what its parameters are bound to.
struct Body<'w> {
    /// Statements, parents' first.
    statements: Vec<&'w RewardStmt>,
    /// The parameters' scope.
    scope: Scope<'w>,
}

/// Lowers a reward that a scenario uses.
pub(crate) fn lower_use<'w>(world: &World<'w>, name: &str, used: &'w RewardUse, span: Span) -> Option<Reward> {
    match &used.what {
        RewardUseKind::Script(script) => {
            let index = super::script::embed(world, script, "reward")?;
            let weight = match &used.weight {
                Some(weight) => constant_weight(world, weight)?,
                None => 1.0,
            };
            Some(Reward {
                name: name.to_owned(),
                doc: String::new(),
                body: RewardBody::Script { script: index, weight },
            })
        }
        RewardUseKind::Inline { body, .. } => {
            let body = Body { statements: body.iter().collect(), scope: Scope::new(true, Frame::Own) };
            Some(lower_body(
                world,
                name,
                String::new(),
                &|_| body.scope.clone(),
                &body.statements,
                used.weight.as_ref(),
            ))
        }
        RewardUseKind::Named(reference) => {
            // A parent's `reward NAME` means what the scenario's own file sees first: names bind late.
            let own = world.library.find(FileId(0), &reference.name.node);
            let late = !reference.name.node.contains('.');
            let own = own.filter(|found| late && matches!(found.item.kind, crate::ast::ItemKind::Reward(_)));
            let found = own.or_else(|| world.library.find(reference.name.span.file, &reference.name.node));
            let item = found.and_then(|found| match &found.item.kind {
                crate::ast::ItemKind::Reward(reward) => Some((found, reward)),
                _ => None,
            });
            let Some((found, item)) = item else {
                unknown_reward(world, &reference.name.node, reference.name.span);
                return None;
            };
            if let Some(problem) = world.library.ambiguous(span.file, &reference.name.node, reference.name.span) {
                world.report(problem);
                return None;
            }
            world.mark_used(found.name.span);
            let doc = found.item.doc.clone();
            Some(lower_named(world, name, doc, item, &reference.args, reference.span, used.weight.as_ref()))
        }
    }
}

fn unknown_reward(world: &World<'_>, name: &str, span: Span) {
    let known: Vec<&str> = world
        .library
        .visible(span.file)
        .filter(|(_, found)| matches!(found.item.kind, crate::ast::ItemKind::Reward(_)))
        .map(|(name, _)| name)
        .collect();
    let problem = Problem::new(Code::UnknownName, span, format!("no reward is called `{name}`"), "not known");
    let near = crate::problem::nearest(name, known.iter().copied()).is_some();
    world.report(if near {
        problem.did_you_mean(name, known)
    } else {
        problem.help(format!("declare it, `reward {name} {{ give … }}`, or use one of `{}`", known.join("`, `")))
    });
}

fn constant_weight<'w>(world: &World<'w>, weight: &'w Expr) -> Option<f64> {
    let mut lower = Lower::new(world, Stage::Constant, Scope::new(true, Frame::World));
    let reg = lower.want_reg(weight, Ty::Number);
    let found = lower.code.constant_of(reg);
    if found.is_none() && !lower.code.is_unknown(reg) {
        world.report(
            Problem::new(Code::NotConstant, weight.span, "the weight of a script must be a number", "")
                .help("multiply inside the script, or write a plain number"),
        );
    }
    found
}

/// Every named reward in sight whose parameters all have defaults, for `--reward NAME`.
pub(crate) fn lower_library(world: &World<'_>) -> Vec<Reward> {
    let file = world.flat.item.name.span.file;
    let mut rewards = Vec::new();
    for (name, found) in world.library.visible(file) {
        let crate::ast::ItemKind::Reward(item) = &found.item.kind else { continue };
        if world.library.ambiguous(file, name, item.name.span).is_some() {
            continue;
        }
        if item.params.iter().all(|param| param.default.is_some()) {
            rewards.push(lower_named(world, name, found.item.doc.clone(), item, &[], item.name.span, None));
        }
    }
    rewards
}

fn lower_named<'w>(
    world: &World<'w>,
    name: &str,
    doc: String,
    item: &'w RewardItem,
    args: &'w [Arg],
    span: Span,
    weight: Option<&'w Expr>,
) -> Reward {
    let mut found = Vec::new();
    let chain = reward_chain(world.library, item, &mut found);
    for problem in found {
        world.report(problem);
    }
    let statements: Vec<&RewardStmt> = chain.iter().flat_map(|(link, _)| &link.body).collect();
    let bind = |lower: &mut Lower<'_, 'w>| {
        // Arguments are read where the reward is used: in the scenario, in the world's frame.
        let now = lower.stage == Stage::Reward;
        let mut scope = Scope::new(false, Frame::Own);
        for (link, reference) in &chain {
            let own = std::ptr::eq(*link, item);
            let args = if own { args } else { reference.map_or(&[][..], |reference| reference.args.as_slice()) };
            let home = if own { Scope::new(true, Frame::World) } else { Scope::new(false, Frame::World) };
            lower.within(home, |lower| {
                lower.bind_params(&link.name.node, &link.params, args, span, &mut scope, now);
            });
        }
        scope
    };
    lower_body(world, name, doc, &bind, &statements, weight)
}

fn lower_body<'w>(
    world: &World<'w>,
    name: &str,
    doc: String,
    bind: &dyn Fn(&mut Lower<'_, 'w>) -> Scope<'w>,
    statements: &[&'w RewardStmt],
    weight: Option<&'w Expr>,
) -> Reward {
    let states: Vec<&'w Let> = statements
        .iter()
        .filter_map(|statement| match &statement.kind {
            RewardStmtKind::State(state) => Some(state),
            _ => None,
        })
        .collect();
    check_states(world, &states);

    let mut init = Lower::new(world, Stage::Init, Scope::new(false, Frame::Own));
    let us = init.code.us();
    init.team = Some(us);
    init.scope = bind(&mut init);
    let mut types = Vec::new();
    for state in &states {
        let cell = init.code.new_cell();
        let value = init.state(state);
        let reg = init.reg(&value);
        init.code.assign(cell, reg, None);
        types.push(value.ty);
    }

    let lower = Lower::new(world, Stage::Reward, Scope::new(false, Frame::Own));
    let mut writer = Writer { lower, terms: Vec::new(), weight: None, guard: None, unlabelled: 0, states: Vec::new() };
    writer.begin(bind, weight);
    for (state, ty) in states.iter().zip(types) {
        let cell = writer.lower.code.new_cell();
        writer.states.push((&state.name.node, cell, ty));
        writer.lower.scope.bind(&state.name.node, Binding::State { cell, ty });
    }
    // The step's `let`s come first, top to bottom: they see no assignment of this step.
    for statement in statements {
        if let RewardStmtKind::Let(binding) = &statement.kind {
            writer.bind_let(binding);
        }
    }
    for statement in statements {
        writer.statement(statement, true);
    }
    let terms = writer.terms;
    let (mut init, _) = init.code.finish(&[]);
    let (step, _) = writer.lower.code.finish(&[]);
    init.cells = step.cells;
    Reward { name: name.to_owned(), doc, body: RewardBody::Program { init, step, terms } }
}

fn check_states(world: &World<'_>, states: &[&Let]) {
    for (index, state) in states.iter().enumerate() {
        if let Some(first) = states.iter().take(index).find(|first| first.name.node == state.name.node) {
            world.report(
                Problem::new(
                    Code::DuplicateName,
                    state.name.span,
                    format!("state `{}` is declared twice", state.name.node),
                    "declared again here",
                )
                .label(first.name.span, "first declared here"),
            );
        }
    }
}

impl<'w> Lower<'_, 'w> {
    /// The first value of a state.
    fn state(&mut self, state: &'w Let) -> Value<'w> {
        let declared = state.ty.as_ref().map(|ty| param::declared_type(self.world, ty));
        let value = match declared {
            Some(ty) => self.want(&state.value, ty),
            None => self.expr(&state.value),
        };
        // `state x = 0` holds numbers, not whole ones alone.
        let ty = if value.ty == Ty::Int && declared.is_none() { Ty::Number } else { value.ty };
        match value.repr {
            super::value::Repr::One(reg) => Value::one(ty, reg),
            _ if value.is_error() => value,
            _ => self.fail(
                Problem::new(Code::NotYet, state.value.span, format!("a state can't be {} yet", ty.noun()), "")
                    .help("keep its parts in states of their own"),
            ),
        }
    }
}

/// Writes the step program.
struct Writer<'c, 'w> {
    lower: Lower<'c, 'w>,
    terms: Vec<String>,
    weight: Option<Reg>,
    guard: Option<Reg>,
    unlabelled: usize,
    states: Vec<(&'w str, u32, Ty)>,
}

impl<'w> Writer<'_, 'w> {
    fn begin(&mut self, bind: &dyn Fn(&mut Lower<'_, 'w>) -> Scope<'w>, weight: Option<&'w Expr>) {
        let us = self.lower.code.us();
        self.lower.team = Some(us);
        self.weight = weight.map(|weight| {
            let scope = Scope::new(true, Frame::World);
            self.lower.within(scope, |lower| lower.want_reg(weight, Ty::Number))
        });
        let scope = bind(&mut self.lower);
        self.lower.scope = scope;
    }

    fn bind_let(&mut self, binding: &'w Let) {
        let lower = &mut self.lower;
        let scope = lower.scope.clone();
        let ty = binding.ty.as_ref().map(|ty| param::declared_type(lower.world, ty));
        let value = match ty {
            Some(ty) => lower.want(&binding.value, ty),
            None => lower.expr(&binding.value),
        };
        let at = binding.name.span;
        lower.scope.bind(&binding.name.node, Binding::Expr { expr: &binding.value, scope, ty, now: Some(value), at });
    }

    fn statement(&mut self, statement: &'w RewardStmt, is_top: bool) {
        match &statement.kind {
            RewardStmtKind::State(state) if !is_top => {
                self.lower.report(
                    Problem::new(Code::WrongScope, state.name.span, "a `state` stands at the top of a reward", "")
                        .help("move it above the block"),
                );
            }
            RewardStmtKind::Let(binding) if !is_top => self.bind_let(binding),
            RewardStmtKind::State(_) | RewardStmtKind::Let(_) | RewardStmtKind::Broken => {}
            RewardStmtKind::Give(give) => self.give(give),
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
    fn on_event(&mut self, event: &'w EventExpr, when: Option<&'w Expr>, f: impl FnOnce(&mut Self)) {
        if self.lower.event.is_some() {
            self.lower.report(
                Problem::new(Code::WrongScope, event.span, "an `on` stands inside another one", "")
                    .help("write the inner event as a condition: `when goal by us { … }`"),
            );
            return;
        }
        let Some(matching) = self.lower.open_events(event) else { return };
        let scope = self.lower.scope.clone();
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
        self.lower.scope = scope;
        self.lower.close_events(matching, Fold { kind: FoldKind::Nothing, value: None, guard: None });
    }

    fn give(&mut self, give: &'w GiveStmt) {
        if give.label.is_none() {
            self.unlabelled += 1;
        }
        if let Some(label) = give.label.as_ref().filter(|label| label.node.trim().is_empty()) {
            self.lower.report(
                Problem::new(Code::OutOfRange, label.span, "a label has at least one letter", "")
                    .help("say in a word what is paid: `give 1 on goal by us as \"goal\"`"),
            );
        }
        let label = give.label.as_ref().map_or_else(|| self.unlabelled.to_string(), |label| label.node.clone());
        let term = self.term(label);
        if give.on.is_empty() {
            let when = give.when.as_ref().map(|when| self.lower.condition(when));
            match when {
                Some(when) => self.guarded(when, |writer| writer.pay(give, term)),
                None => self.pay(give, term),
            }
            return;
        }
        // All loops of a `give once on a or b` share one memory.
        let paid = give.once.map(|_| self.lower.code.new_cell());
        for event in &give.on {
            self.on_event(event, give.when.as_ref(), |writer| {
                let value = writer.amount(give);
                match paid {
                    Some(cell) => writer.pay_once(term, value, cell),
                    None => writer.lower.code.give(term, value, writer.guard),
                }
            });
        }
    }

    fn term(&mut self, label: String) -> u32 {
        let known = self.terms.iter().position(|term| *term == label);
        known.unwrap_or_else(|| {
            self.terms.push(label);
            self.terms.len() - 1
        }) as u32
    }

    fn pay(&mut self, give: &'w GiveStmt, term: u32) {
        let value = self.amount(give);
        match give.once {
            Some(_) if self.lower.code.in_loop() => {
                let cell = self.lower.code.new_cell();
                self.pay_once(term, value, cell);
            }
            Some(_) => {
                let guard = self.guard.unwrap_or_else(|| self.lower.code.bool(true));
                let first = self.lower.code.once(guard);
                self.lower.code.give(term, value, Some(first));
            }
            None => self.lower.code.give(term, value, self.guard),
        }
    }

    /// Pays at the first match, which may be one of several in a step.
    fn pay_once(&mut self, term: u32, value: Reg, cell: u32) {
        let code = &mut self.lower.code;
        let paid = code.cell(cell);
        let open = code.unary(UnaryOp::Not, paid);
        let guard = match self.guard {
            Some(guard) => code.binary(BinaryOp::And, guard, open),
            None => open,
        };
        code.give(term, value, Some(guard));
        let one = code.constant(1.0);
        code.assign(cell, one, Some(guard));
    }

    fn amount(&mut self, give: &'w GiveStmt) -> Reg {
        let value = self.lower.want(&give.value, Ty::Number);
        let mut reg = self.lower.reg(&value);
        self.check_payable(reg, &give.value);
        if give.per_second {
            let step = self.lower.code.constant(0.1);
            reg = self.lower.code.binary(BinaryOp::Mul, reg, step);
        }
        match self.weight {
            Some(weight) => self.lower.code.binary(BinaryOp::Mul, reg, weight),
            None => reg,
        }
    }

    /// Reports a constant that is more than can be paid.
    fn check_payable(&self, reg: Reg, value: &Expr) {
        let code = &self.lower.code;
        let paid = code.constant_of(reg).or_else(|| match code.instr(reg) {
            Some(&Instr::Binary(op, a, b)) => fold::binary(op, code.constant_of(a)?, code.constant_of(b)?),
            _ => None,
        });
        if paid.is_some_and(|paid| paid.is_nan() || paid.abs() > PAY_MAX) {
            let text = self.lower.world.text(value.span);
            self.lower.report(
                Problem::new(Code::OutOfRange, value.span, format!("`{text}` is more than can be paid"), "")
                    .help("rewards are small numbers: `give 1`"),
            );
        }
    }

    fn assign(&mut self, name: &'w crate::ast::Ident, value: &'w Expr) {
        let known = self.states.iter().find(|(state, _, _)| *state == name.node).copied();
        let Some((_, cell, ty)) = known else {
            let problem = Problem::new(
                Code::UnknownName,
                name.span,
                format!("no `state` is called `{}`", name.node),
                "can't be assigned",
            );
            let states: Vec<&str> = self.states.iter().map(|(state, _, _)| *state).collect();
            let near = crate::problem::nearest(&name.node, states.iter().copied()).is_some();
            self.lower.report(if near {
                problem.did_you_mean(&name.node, states)
            } else if self.lower.scope.find(&name.node).is_some() {
                problem.help("only a `state` is assigned")
            } else {
                problem.help(format!("declare it at the top: `state {} = 0`", name.node))
            });
            self.lower.expr(value);
            return;
        };
        let reg = self.lower.want_reg(value, ty);
        self.lower.code.assign(cell, reg, self.guard);
    }
}
