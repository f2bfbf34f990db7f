//! Names in expressions.

use super::Uses;
use crate::ast::{
    Arg, EventExpr, Expr, ExprKind, FnItem, Ident, InfixOp, ItemKind, ParamDecl, RewardStmtKind,
    RewardUseKind, Span,
};
use crate::check::names;
use crate::resolve::{Named, arg_name, reward_chain, reward_declaration};
use setpiece_scenario::vocabulary::Function;

/// What stands before the colon of an argument.
#[derive(Clone, Copy)]
pub(super) enum ArgumentKeys<'a> {
    /// A parameter's name.
    Params(&'a [ParamDecl]),
    /// A word of the language.
    Words,
    /// A value.
    Values,
}

impl<'a> Uses<'a> {
    pub(super) fn expr(&mut self, expr: &'a Expr) {
        match &expr.kind {
            ExprKind::Number { .. }
            | ExprKind::Bool(_)
            | ExprKind::String(_)
            | ExprKind::Role(_)
            | ExprKind::Broken => {}
            ExprKind::Name(name) => self.name(name, expr.span),
            ExprKind::Member(of, member) => self.member(of, member, expr),
            ExprKind::Own(of)
            | ExprKind::Unary(_, of)
            | ExprKind::HasBall(of)
            | ExprKind::OverTime { of, .. } => self.expr(of),
            ExprKind::Tuple(parts) | ExprKind::List(parts) => {
                for part in parts {
                    self.expr(part);
                }
            }
            ExprKind::Call { name, args } => self.call(name, args),
            ExprKind::Binary(_, one, other) => {
                self.expr(one);
                self.expr(other);
            }
            ExprKind::If(condition, then, otherwise) => {
                for part in [condition, then, otherwise] {
                    self.expr(part);
                }
            }
            ExprKind::Changes(of, to) => {
                self.expr(of);
                if let Some(to) = to {
                    self.expr(to);
                }
            }
            ExprKind::Event(event) => self.event(event),
        }
    }

    pub(super) fn exprs(&mut self, exprs: impl IntoIterator<Item = &'a Expr>) {
        exprs.into_iter().for_each(|expr| self.expr(expr));
    }

    pub(super) fn event(&mut self, event: &'a EventExpr) {
        self.exprs([&event.by, &event.to, &event.from].into_iter().flatten().map(|it| &**it));
    }

    /// `x.y`: a state of a reward, an item of a file that was imported under a name, or a property.
    fn member(&mut self, of: &'a Expr, member: &'a Ident, whole: &'a Expr) {
        if let Some(path) = path_of(whole)
            && let Some((head, _)) = path.split_once('.')
            && self.meant(head).is_none()
        {
            if !names::is_value(head) && self.state_of(head, of.span, member) {
                return;
            }
            if self.found_at(&path, whole.span).is_some() {
                return;
            }
        }
        self.expr(of);
    }

    /// `reward.state`; `false` if the scenario has no such reward.
    fn state_of(&mut self, name: &str, of: Span, member: &Ident) -> bool {
        let library = self.library;
        let Some(flat) = &self.scenario else { return false };
        let Some((_, used, _)) = flat.rewards.iter().find(|(known, ..)| known == name) else {
            return false;
        };
        let used = *used;
        let mut bodies = Vec::new();
        match &used.what {
            RewardUseKind::Inline { body, .. } => bodies.push(body),
            RewardUseKind::Named(named) => {
                let found = library.find(named.name.span.file, &named.name.node);
                if let Some(ItemKind::Reward(reward)) = found.map(|found| &found.item.kind) {
                    let chain = reward_chain(library, reward, &mut Vec::new());
                    bodies.extend(chain.into_iter().map(|(link, _)| &link.body));
                }
            }
            RewardUseKind::Script { .. } => {}
        }
        if let Some(at) = reward_declaration(self.library, used) {
            self.refer(of, at);
        }
        let state = bodies.into_iter().flatten().find_map(|stmt| match &stmt.kind {
            RewardStmtKind::State(state) if state.name.node == member.node => Some(state),
            _ => None,
        });
        if let Some(state) = state {
            self.refer(member.span, state.name.span);
        }
        true
    }

    fn call(&mut self, name: &'a Ident, args: &'a [Arg]) {
        if let Some(item) = self.found(name) {
            return self.args(args, ArgumentKeys::Params(item.kind.params()));
        }
        if let Some(flat) = &self.scenario
            && let Some(Named::Region(at)) = flat.named(&name.node)
            && let Some(region) = flat.regions.get(at).copied()
        {
            self.refer(name.span, region.name.span);
            return self.args(args, ArgumentKeys::Params(&region.params));
        }
        let function = Function::from_name(&name.node);
        if function == Some(Function::Choice) {
            return self.args(args, ArgumentKeys::Values);
        }
        let goes_through =
            matches!(function, Some(Function::Count | Function::Any | Function::All));
        for arg in args {
            match &arg.value.kind {
                ExprKind::Binary(op, one, set)
                    if goes_through && arg.binder.is_none() && op.node == InfixOp::In =>
                {
                    self.each(one, set, arg);
                }
                _ => self.arg(arg, ArgumentKeys::Words),
            }
        }
    }

    /// `p in them where …`
    fn each(&mut self, one: &'a Expr, set: &'a Expr, arg: &'a Arg) {
        self.expr(set);
        self.block(|uses| {
            if let ExprKind::Name(name) = &one.kind {
                uses.declare_at(one.span);
                uses.locals.push((name, one.span));
            } else {
                uses.expr(one);
            }
            uses.exprs(&arg.filter);
        });
    }

    pub(super) fn args(&mut self, args: &'a [Arg], keys: ArgumentKeys<'a>) {
        for arg in args {
            self.arg(arg, keys);
        }
    }

    fn arg(&mut self, arg: &'a Arg, keys: ArgumentKeys<'a>) {
        if let Some(key) = &arg.key {
            match keys {
                ArgumentKeys::Params(params) => {
                    let named = params.iter().find(|it| Some(&*it.name.node) == arg_name(arg));
                    if let Some(param) = named {
                        self.refer(key.span, param.name.span);
                    }
                }
                ArgumentKeys::Words => {}
                ArgumentKeys::Values => self.expr(key),
            }
        }
        self.block(|uses| {
            if let Some((name, set)) = &arg.binder {
                uses.expr(set);
                uses.bind(name);
            }
            uses.expr(&arg.value);
            uses.exprs(&arg.filter);
        });
    }

    /// Parameters and a body that sees them.
    pub(super) fn function(&mut self, item: &'a FnItem) {
        self.block(|uses| {
            uses.params(&item.params);
            uses.locals.extend(item.params.iter().map(|it| (it.name.node.as_str(), it.name.span)));
            uses.expr(&item.body);
        });
    }
}

/// A name with dots.
pub(super) fn path_of(expr: &Expr) -> Option<String> {
    match &expr.kind {
        ExprKind::Name(name) => Some(name.clone()),
        ExprKind::Member(of, member) => Some(format!("{}.{}", path_of(of)?, member.node)),
        _ => None,
    }
}
