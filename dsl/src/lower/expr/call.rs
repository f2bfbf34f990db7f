//! Calls: how arguments meet parameters, and who is called.

use super::super::value::{LiteralFrame, LocalName, Scope, Value};
use super::super::{Lower, ProgramStage, param};
use crate::ast::{Arg, Expr, ExprKind, FnItem, Ident, InfixOp, ItemKind, ParamDecl, Span};
use crate::check::types::Ty;
use crate::problem::facts::{Calls, Form, Names, NotAFunction};
use crate::problem::{Code, Guess, Problem, signature};
use crate::resolve::{Named, arg_name};
use setpiece_scenario::vocabulary::Function;

/// What functions of the language are called elsewhere.
const ELSEWHERE: &[(&str, &str)] = &[
    ("gauss", "normal"),
    ("gaussian", "normal"),
    ("rand", "uniform"),
    ("random", "uniform"),
    ("randint", "integer"),
    ("randn", "normal"),
    ("dist", "distance"),
    ("ln", "log"),
    ("len", "count"),
    ("size", "count"),
    ("average", "mean"),
    ("closest", "nearest"),
    ("farthest", "max_by"),
    ("argmin", "min_by"),
    ("argmax", "max_by"),
];
/// What stands behind a value that is observed.
const CLAUSES: &[(&str, &str)] = &[
    ("noise", "noise normal(0, 0.3m)"),
    ("noisy", "noise normal(0, 0.3m)"),
    ("delayed", "delayed 0.3s"),
    ("delay", "delayed 0.3s"),
    ("stack", "stack 4"),
];

impl<'w> Lower<'_, 'w> {
    pub(super) fn call(&mut self, name: &'w Ident, args: &'w [Arg], span: Span) -> Value<'w> {
        let library = self.world.library;
        if let Some(found) = library.find(name.span.file, &name.node) {
            if let Some(problem) = library.ambiguous(name.span.file, &name.node, name.span) {
                return self.fail(problem);
            }
            self.world.mark_used(found.name.span);
            match &found.item.kind {
                ItemKind::Fn(item) => return self.call_fn(item, args, span),
                ItemKind::Region(item) => return self.call_region(item, args, span, false),
                ItemKind::Table(item) => return self.call_table(item, args, span),
                _ => {}
            }
        }
        if self.scope.scenario
            && let Some(Named::Region(at)) = self.world.flat.named(&name.node)
            && let Some(region) = self.world.flat.regions.get(at)
        {
            self.world.mark_used(region.name.span);
            return self.call_region(region, args, span, true);
        }
        if let Some(function) = Function::from_name(&name.node) {
            return self.function(function, name, args, span);
        }
        if self.world.is_full(Code::UnknownFunction) {
            return Value::error();
        }
        let of_file = library.visible(name.span.file);
        let mut known: Vec<&str> = of_file
            .filter(|(_, found)| {
                matches!(
                    found.item.kind,
                    ItemKind::Fn(_) | ItemKind::Region(_) | ItemKind::Table(_)
                )
            })
            .map(|(name, _)| name)
            .collect();
        known.extend(Function::ALL.iter().map(|function| function.name()));
        let text = &name.node;
        let is_value =
            self.scope.find(text).is_some() || (self.scope.scenario && self.world.declares(text));
        let item = library.find(name.span.file, text).map(|found| found.item.kind.noun());
        let known_as = |table: &[(&str, &'static str)]| {
            table.iter().find(|(known, _)| known == text).map(|(_, ours)| *ours)
        };
        let is_observed = matches!(self.stage, ProgramStage::Observation);
        let other = match (item, known_as(ELSEWHERE), known_as(CLAUSES).filter(|_| is_observed)) {
            _ if is_value => NotAFunction::Value { call: span },
            (Some(noun), ..) => NotAFunction::Item(noun),
            (None, Some(ours), _) => NotAFunction::Foreign(ours),
            (None, None, Some(written)) => NotAFunction::Clause(written),
            (None, None, None) => NotAFunction::Unknown(Guess::of(text, known)),
        };
        self.fail(Problem::new(name.span, Names::NoFunction { name: text.clone(), other }))
    }

    /// Calls a `fn` of a file: its body is read with the caller's frame and view.
    fn call_fn(&mut self, item: &'w FnItem, args: &'w [Arg], span: Span) -> Value<'w> {
        let mut scope = Scope::new(false, self.scope.frame);
        self.bind_params(&item.name.node, &item.params, args, span, &mut scope, true);
        let ty = item.ty.as_ref().map(|ty| param::declared_type(self.world, ty));
        let value = self.inline(item.name.span, span, |lower| {
            lower.within(scope, |lower| match ty {
                Some(ty) => lower.want(&item.body, ty),
                None => lower.expr(&item.body),
            })
        });
        value.unwrap_or_else(Value::error)
    }

    /// Calls a `region`: it lies in the world's frame, whoever calls it; a region of the scenario
    /// sees its values.
    fn call_region(
        &mut self,
        item: &'w FnItem,
        args: &'w [Arg],
        span: Span,
        of_scenario: bool,
    ) -> Value<'w> {
        let mut scope = Scope::new(of_scenario, LiteralFrame::World);
        self.bind_params(&item.name.node, &item.params, args, span, &mut scope, true);
        self.turn_angles(&item.params, &mut scope);
        let value = self.inline(item.name.span, span, |lower| {
            lower.within(scope, |lower| lower.want(&item.body, Ty::Region))
        });
        value.unwrap_or_else(Value::error)
    }

    /// Angles that were read in the present frame are read in the one of the scope they are bound
    /// in.
    pub(crate) fn turn_angles(&mut self, params: &'w [ParamDecl], scope: &mut Scope<'w>) {
        if self.scope.frame == scope.frame {
            return;
        }
        for decl in params {
            if let Some(LocalName::Expr { now: Some(value), .. }) =
                scope.find(&decl.name.node).cloned()
                && value.ty == Ty::ANGLE
            {
                let read = self.reg(&value);
                let world = self.turned_angle(read);
                let turned = self.in_frame(scope.frame, |lower| lower.turned_angle(world));
                self.world.mark_used(decl.name.span);
                scope.bind(&decl.name.node, LocalName::Value(Value::one(Ty::ANGLE, turned)));
            }
        }
    }

    /// Binds declared parameters to arguments (read here) or defaults (read in the declaration's
    /// scope).
    ///
    /// With `now` the values are computed at once; otherwise wherever they are used.
    pub(crate) fn bind_params(
        &mut self,
        callee: &str,
        params: &'w [ParamDecl],
        args: &'w [Arg],
        span: Span,
        scope: &mut Scope<'w>,
        now: bool,
    ) {
        let names: Vec<&str> = params.iter().map(|param| param.name.node.as_str()).collect();
        let required = 0;
        let Some(given) = self.arguments(callee, args, span, &names, required) else {
            for param in params {
                scope.bind(&param.name.node, LocalName::Value(Value::error()));
            }
            return;
        };
        for (param, given) in params.iter().zip(given) {
            self.check_hides(&param.name.node, param.name.span, scope);
            let declared = param.ty.as_ref().map(|ty| param::declared_type(self.world, ty));
            let (expr, home) = match (given, &param.default) {
                (Some(expr), _) => (expr, self.scope.clone()),
                (None, Some(default)) => (default, Scope::new(false, LiteralFrame::World)),
                (None, None) => {
                    self.report(Problem::new(
                        span,
                        Calls::Missing {
                            callee: callee.to_owned(),
                            parameter: param.name.node.clone(),
                            form: Form::Named,
                        },
                    ));
                    scope.bind(&param.name.node, LocalName::Value(Value::error()));
                    continue;
                }
            };
            // The default tells the type of an argument.
            let ty = declared.or_else(|| self.default_type(param));
            let computed = |lower: &mut Self| {
                lower.within(home.clone(), |lower| match ty {
                    Some(ty) => lower.want(expr, ty),
                    None => lower.expr(expr),
                })
            };
            let value = now.then(|| computed(self));
            let found = self.world.found();
            if let Some(domain) = &param.domain {
                let value = value.clone();
                let value = value.unwrap_or_else(|| self.world.tentatively(|| computed(self)));
                self.check_domain(&value, domain, expr, &param.name.node);
            }
            // What a wrong argument would do further on is no news.
            let wrong = self.world.found() > found;
            let value = value.map(|value| if wrong { Value::error() } else { value });
            scope.bind(
                &param.name.node,
                LocalName::Expr { expr, scope: home, ty, now: value, at: param.name.span },
            );
        }
    }

    /// The type that a parameter's default has, for numbers.
    fn default_type(&mut self, param: &'w ParamDecl) -> Option<Ty> {
        let default = param.default.as_ref()?;
        let home = Scope::new(false, LiteralFrame::World);
        let value = self.world.tentatively(|| self.within(home, |lower| lower.expr(default)));
        match value.ty {
            // `= 1` leaves open whether whole numbers are meant.
            Ty::Int => Some(Ty::Number),
            ty if ty.dim().is_some() || ty == Ty::Bool => Some(ty),
            _ => None,
        }
    }

    /// Reports a number outside of the range that a parameter declares.
    pub(crate) fn check_domain(
        &mut self,
        value: &Value<'w>,
        domain: &'w crate::ast::Domain,
        expr: &Expr,
        name: &str,
    ) {
        let crate::ast::Domain::Range(low, high) = domain else { return };
        if value.ty.dim().is_none() {
            return;
        }
        let home = Scope::new(false, LiteralFrame::World);
        let (least, greatest) = self.within(home, |lower| (lower.expr(low), lower.expr(high)));
        let (least, greatest) = (self.reg(&least), self.reg(&greatest));
        let (Some(least), Some(greatest)) =
            (self.code.constant_of(least), self.code.constant_of(greatest))
        else {
            return;
        };
        let shown = format!("`{}..{}`", self.world.text(low.span), self.world.text(high.span));
        let reg = self.reg(value);
        self.check_range(reg, (least, greatest), &format!("`{name}`"), expr.span, &shown);
    }

    /// Sorts arguments by parameter: by place, or by name; reports what doesn't fit.
    pub(crate) fn arguments(
        &mut self,
        callee: &str,
        args: &'w [Arg],
        span: Span,
        names: &[&str],
        required: usize,
    ) -> Option<Vec<Option<&'w Expr>>> {
        let mut given: Vec<Option<&'w Expr>> = vec![None; names.len()];
        let mut next = 0;
        for (nth, arg) in args.iter().enumerate() {
            if arg.binder.is_some() || arg.filter.is_some() {
                let least = (callee == Function::Nearest.name()).then(|| self.least_of(arg, args));
                let least = least.map(|least| (span, least));
                let fact = Calls::NoPlayers { callee: callee.to_owned(), least };
                self.report(Problem::new(arg.span, fact));
                return None;
            }
            let at = match (&arg.key, arg_name(arg)) {
                (None, _) => {
                    next += 1;
                    next - 1
                }
                (Some(key), name) => {
                    let name = name.unwrap_or_default();
                    let Some(at) = names.iter().position(|known| *known == name) else {
                        let text = self.world.text(key.span);
                        let guess = Guess::similar_or_all(name, names);
                        let fact = Calls::NoParameter { callee: callee.to_owned(), text, guess };
                        self.report(Problem::new(key.span, fact));
                        return None;
                    };
                    at
                }
            };
            match given.get_mut(at) {
                Some(slot @ None) => *slot = Some(&arg.value),
                Some(Some(first)) => {
                    let first = first.span;
                    let name = names.get(at).copied().unwrap_or_default();
                    self.report(Problem::new(
                        arg.span,
                        Calls::GivenTwice { parameter: name.to_owned(), first },
                    ));
                    return None;
                }
                None => {
                    let names = names.iter().map(|&name| name.to_owned()).collect();
                    let fact = Calls::TooMany {
                        callee: callee.to_owned(),
                        names,
                        signature: of_builtin(callee),
                    };
                    let problem = Problem::new(arg.span, fact);
                    // With the comma before it.
                    let before = nth.checked_sub(1).and_then(|before| args.get(before));
                    self.report(match before {
                        Some(before) => {
                            let from = Span { start: before.span.end, ..before.span };
                            problem.rewriting(from.to(arg.span), "")
                        }
                        None => problem.rewriting(arg.span, ""),
                    });
                    return None;
                }
            }
        }
        let missing = given.iter().take(required).position(Option::is_none);
        if let Some(name) = missing.and_then(|at| names.get(at)) {
            let form = of_builtin(callee).map_or(Form::Unknown, Form::Builtin);
            let fact =
                Calls::Missing { callee: callee.to_owned(), parameter: (*name).to_owned(), form };
            self.report(Problem::new(span, fact));
            return None;
        }
        Some(given)
    }
}

impl Lower<'_, '_> {
    /// How the nearest of some players is written: `nearest(p for p in them)` and its like.
    fn least_of(&self, arg: &Arg, args: &[Arg]) -> String {
        let text = |expr: &Expr| self.world.text(expr.span);
        let (name, set) = match (&arg.binder, &arg.value.kind) {
            (Some((name, set)), _) => (name.node.clone(), text(set)),
            (None, ExprKind::Binary(op, name, set)) if op.node == InfixOp::In => {
                (text(name), text(set))
            }
            (None, _) => ("p".to_owned(), text(&arg.value)),
        };
        let filter = arg.filter.as_ref().map_or(String::new(), |c| format!(" where {}", text(c)));
        let to = args.iter().find(|arg| arg_name(arg) == Some("to"));
        let to = to.map_or_else(|| "ball".to_owned(), |to| text(&to.value));
        format!("min_by(distance({name}, {to}) for {name} in {set}{filter})")
    }
}

/// How a function of the language is written.
fn of_builtin(name: &str) -> Option<String> {
    Function::from_name(name).map(|function| signature(function.doc()).to_owned())
}
