//! Expressions: the flat tokens of an `expr`, `set` or `sum` become a tree by precedence.

use super::MAX_OPERATORS;
use super::reader::{CstNode, CstNodes, Reader};
use crate::ast::{Arg, Expr, ExprKind, Ident, InfixOp, PrefixOp, Spanned};
use crate::problem::Problem;
use crate::problem::facts::{Syntax, Types};
use crate::source::Span;
use setpiece_grammar::Rule;
use setpiece_scenario::vocabulary::{Role, Unit};

impl Reader<'_> {
    /// Any expression, whatever rule wraps it.
    pub(super) fn expr(&mut self, node: CstNode<'_>) -> Expr {
        let span = self.span(&node);
        match node.as_rule() {
            Rule::expr | Rule::set | Rule::sum | Rule::over_what | Rule::factor => {
                self.flat(node, span)
            }
            Rule::switch => Expr { span, kind: ExprKind::Bool(node.as_str().starts_with("on")) },
            _ => match node.into_inner().next() {
                Some(inner) => self.expr(inner),
                None => broken(span),
            },
        }
    }

    /// Takes the next child if it is of `rule`, as an expression.
    pub(super) fn take_expr(&mut self, nodes: &mut CstNodes<'_>, rule: Rule) -> Option<Expr> {
        nodes.want(rule).map(|node| self.expr(node))
    }

    /// An expression's own operators, counted against the limit that bounds the tree's height.
    fn flat(&mut self, node: CstNode<'_>, span: Span) -> Expr {
        let weight =
            node.clone().into_inner().filter(|child| child.as_rule() != Rule::operand).count()
                as u32
                + 1;
        if self.operators + weight > MAX_OPERATORS {
            self.push(Problem::new(span, Syntax::TooManyOperators { most: MAX_OPERATORS }));
            return broken(span);
        }
        self.operators += weight;
        let mut nodes = CstNodes::of(node);
        let expr = if nodes.eat(Rule::kw_if) {
            self.conditional(&mut nodes, span)
        } else {
            self.or(&mut nodes, span)
        };
        self.operators -= weight;
        expr
    }

    /// `if` is taken; the arms of `else if` hang in each other.
    fn conditional(&mut self, nodes: &mut CstNodes<'_>, span: Span) -> Expr {
        let mut arms = Vec::new();
        let mut last = None;
        while let Some(node) = nodes.want(Rule::expr) {
            let expr = self.expr(node);
            if nodes.eat(Rule::kw_then) {
                let then =
                    nodes.want(Rule::expr).map_or_else(|| broken(span), |node| self.expr(node));
                arms.push((expr, then));
                nodes.eat(Rule::kw_else);
                nodes.eat(Rule::kw_if);
            } else {
                last = Some(expr);
            }
        }
        let last = last.unwrap_or_else(|| broken(span));
        let n = arms.len();
        arms.into_iter().rev().enumerate().fold(last, |otherwise, (at, (condition, then))| {
            let begin = if at + 1 == n { span } else { condition.span };
            Expr {
                span: begin.to(otherwise.span),
                kind: ExprKind::If(Box::new(condition), Box::new(then), Box::new(otherwise)),
            }
        })
    }

    fn or(&mut self, nodes: &mut CstNodes<'_>, within: Span) -> Expr {
        let mut left = self.and(nodes, within);
        while let Some(op) = nodes.want(Rule::kw_or) {
            let right = self.and(nodes, within);
            left = self.binary(InfixOp::Or, &op, left, right);
        }
        left
    }

    fn and(&mut self, nodes: &mut CstNodes<'_>, within: Span) -> Expr {
        let mut left = self.not(nodes, within);
        while let Some(op) = nodes.want(Rule::kw_and) {
            let right = self.not(nodes, within);
            left = self.binary(InfixOp::And, &op, left, right);
        }
        left
    }

    fn not(&mut self, nodes: &mut CstNodes<'_>, within: Span) -> Expr {
        let mut nots = Vec::new();
        while let Some(not) = nodes.want(Rule::kw_not) {
            nots.push(self.span(&not));
        }
        let operand = self.comparison(nodes, within);
        nots.into_iter().rev().fold(operand, |operand, not| Expr {
            span: not.to(operand.span),
            kind: ExprKind::Unary(PrefixOp::Not, Box::new(operand)),
        })
    }

    fn comparison(&mut self, nodes: &mut CstNodes<'_>, within: Span) -> Expr {
        let first = self.union(nodes, within);
        let mut last = first.span;
        let (mut comparison, mut middle) = (None, 0);
        while let Some(rule) = nodes.peek().filter(|rule| is_comparison(*rule)) {
            let Some(op) = nodes.next() else { break };
            let op_span = self.span(&op);
            if comparison.is_some() {
                let mut end = op_span;
                // The rest is read and forgotten.
                while let Some(rest) = nodes.next_if_not_logical() {
                    end = end.to(self.span(&rest));
                }
                let all = first.span.to(end);
                let fact = Syntax::ComparisonChain { first: first.span.to(last) };
                let middle = Span { start: middle, end: op_span.start, ..op_span };
                let again = format!(
                    "and {} ",
                    self.original()
                        .get(middle.start as usize..middle.end as usize)
                        .unwrap_or_default()
                        .trim()
                );
                let before_it = Span { end: op_span.start, ..op_span };
                self.push(Problem::new(op_span, fact).rewriting(before_it, again));
                return broken(all);
            }
            middle = op_span.end;
            let built = self.comparison_tail(rule, &op, &first, nodes, within);
            last = built.span;
            comparison = Some(built);
        }
        comparison.unwrap_or(first)
    }

    /// What follows the first operand of a comparison; its operator is taken.
    fn comparison_tail(
        &mut self,
        rule: Rule,
        op: &CstNode<'_>,
        first: &Expr,
        nodes: &mut CstNodes<'_>,
        within: Span,
    ) -> Expr {
        let op_span = self.span(op);
        match rule {
            Rule::kw_has => {
                let end = nodes.want(Rule::kw_ball).map_or(op_span, |ball| self.span(&ball));
                Expr { span: first.span.to(end), kind: ExprKind::HasBall(Box::new(first.clone())) }
            }
            Rule::kw_changes => {
                let to = nodes.eat(Rule::kw_to).then(|| self.union(nodes, within));
                let end = to.as_ref().map_or(op_span, |to| to.span);
                Expr {
                    span: first.span.to(end),
                    kind: ExprKind::Changes(Box::new(first.clone()), to.map(Box::new)),
                }
            }
            _ => {
                let operator = match op.as_str() {
                    "==" => InfixOp::Eq,
                    "!=" => InfixOp::Ne,
                    "<" => InfixOp::Lt,
                    "<=" => InfixOp::Le,
                    ">" => InfixOp::Gt,
                    ">=" => InfixOp::Ge,
                    _ => InfixOp::In,
                };
                let right = self.union(nodes, within);
                self.binary(operator, op, first.clone(), right)
            }
        }
    }

    fn union(&mut self, nodes: &mut CstNodes<'_>, within: Span) -> Expr {
        let mut left = self.sum(nodes, within);
        while let Some(op) = nodes.want(Rule::set_op) {
            let operator = if op.as_str() == "|" { InfixOp::Union } else { InfixOp::Intersection };
            let right = self.sum(nodes, within);
            left = self.binary(operator, &op, left, right);
        }
        left
    }

    fn sum(&mut self, nodes: &mut CstNodes<'_>, within: Span) -> Expr {
        let mut left = self.product(nodes, within);
        while let Some(op) = nodes.want(Rule::add_op) {
            let operator = if op.as_str() == "+" { InfixOp::Add } else { InfixOp::Sub };
            let right = self.product(nodes, within);
            left = self.binary(operator, &op, left, right);
        }
        left
    }

    fn product(&mut self, nodes: &mut CstNodes<'_>, within: Span) -> Expr {
        let mut left = self.operand(nodes, within);
        while let Some(op) = nodes.want(Rule::mul_op) {
            let operator = if op.as_str() == "*" { InfixOp::Mul } else { InfixOp::Div };
            let right = self.operand(nodes, within);
            left = self.binary(operator, &op, left, right);
        }
        left
    }

    fn binary(&self, operator: InfixOp, op: &CstNode<'_>, left: Expr, right: Expr) -> Expr {
        let op = Spanned { node: operator, span: self.span(op) };
        Expr {
            span: left.span.to(right.span),
            kind: ExprKind::Binary(op, Box::new(left), Box::new(right)),
        }
    }

    /// `-x.y.z`: the members bind first.
    fn operand(&mut self, nodes: &mut CstNodes<'_>, within: Span) -> Expr {
        let Some(node) = nodes.want(Rule::operand) else { return broken(within) };
        let span = self.span(&node);
        let weight = node.clone().into_inner().count() as u32;
        if self.operators + weight > MAX_OPERATORS {
            self.push(Problem::new(span, Syntax::TooManyOperators { most: MAX_OPERATORS }));
            return broken(span);
        }
        self.operators += weight;
        let mut nodes = CstNodes::of(node);
        let mut signs = Vec::new();
        while let Some(sign) = nodes.want(Rule::sign) {
            let op = if sign.as_str() == "-" { PrefixOp::Neg } else { PrefixOp::Plus };
            signs.push((op, self.span(&sign)));
        }
        let mut expr = nodes.next().map_or_else(|| broken(within), |node| self.primary(node));
        while nodes.eat(Rule::dot) {
            let Some(member) = nodes.want(Rule::word) else { break };
            let member = self.ident(&member);
            expr = Expr {
                span: expr.span.to(member.span),
                kind: ExprKind::Member(Box::new(expr), member),
            };
        }
        for (op, sign) in signs.into_iter().rev() {
            expr = Expr { span: sign.to(expr.span), kind: ExprKind::Unary(op, Box::new(expr)) };
        }
        self.operators -= weight;
        expr
    }

    fn primary(&mut self, node: CstNode<'_>) -> Expr {
        let span = self.span(&node);
        let kind = match node.as_rule() {
            Rule::quantity => return self.quantity(node),
            Rule::boolean => ExprKind::Bool(node.as_str() == "true"),
            Rule::string => ExprKind::String(self.string(&node).node),
            Rule::ident => ExprKind::Name(node.as_str().to_owned()),
            Rule::role => Role::from_name(node.as_str()).map_or(ExprKind::Broken, ExprKind::Role),
            Rule::list => {
                let items = node.into_inner().filter(|child| child.as_rule() == Rule::expr);
                let items = self.bounded(items, "values").into_iter();
                ExprKind::List(items.map(|item| self.expr(item)).collect())
            }
            Rule::paren => return self.paren(node, span),
            Rule::own => self.own(node, span),
            Rule::call => {
                let mut nodes = CstNodes::of(node);
                let Some(name) = nodes.want(Rule::callee).map(|name| self.ident(&name)) else {
                    return broken(span);
                };
                ExprKind::Call {
                    name,
                    args: nodes.want(Rule::args).map(|args| self.args(args)).unwrap_or_default(),
                }
            }
            Rule::event | Rule::end_event => match self.event(node) {
                Some(event) => ExprKind::Event(Box::new(event)),
                None => ExprKind::Broken,
            },
            Rule::over_time => {
                let mut nodes = CstNodes::of(node);
                let Some(kind) = nodes.want(Rule::over_kind).map(|kind| self.ident(&kind)) else {
                    return broken(span);
                };
                nodes.eat(Rule::kw_of);
                let of = nodes.next().map_or_else(
                    || broken(span),
                    |of| {
                        if of.as_rule() == Rule::over_what {
                            self.expr(of)
                        } else {
                            self.primary(of)
                        }
                    },
                );
                ExprKind::OverTime { kind, of: Box::new(of) }
            }
            _ => ExprKind::Broken,
        };
        Expr { span, kind }
    }

    fn quantity(&mut self, node: CstNode<'_>) -> Expr {
        let span = self.span(&node);
        let mut nodes = CstNodes::of(node);
        let Some(number) = nodes.want(Rule::number) else { return broken(span) };
        let text = number.as_str();
        let value = text.replace('_', "").parse::<f64>().unwrap_or(f64::INFINITY);
        if !value.is_finite() {
            let digits = text.bytes().filter(u8::is_ascii_digit).count();
            self.push(Problem::new(span, Types::TooManyDigits { digits }));
            return broken(span);
        }
        let unit = nodes.next().and_then(|unit| match unit.as_str() {
            "step" => Some(Unit::Step),
            "episode" => Some(Unit::Episode),
            unit => Unit::from_name(unit),
        });
        let is_int = text.bytes().all(|byte| byte.is_ascii_digit() || byte == b'_');
        Expr { span, kind: ExprKind::Number { value, is_int, unit } }
    }

    /// One expression in brackets is itself, two or three are a point.
    fn paren(&mut self, node: CstNode<'_>, span: Span) -> Expr {
        let mut items: Vec<Expr> = Vec::new();
        for child in node.into_inner().filter(|child| child.as_rule() == Rule::expr) {
            items.push(self.expr(child));
        }
        if items.len() == 1 {
            return items.pop().map_or_else(|| broken(span), |item| Expr { span, kind: item.kind });
        }
        Expr { span, kind: ExprKind::Tuple(items) }
    }

    /// `own (x, y)` or `own.a.b`: the whole path is read in the own frame.
    fn own(&mut self, node: CstNode<'_>, span: Span) -> ExprKind {
        let mut path: Option<Expr> = None;
        for child in node.into_inner() {
            match child.as_rule() {
                Rule::paren => {
                    let span = self.span(&child);
                    path = Some(self.paren(child, span));
                }
                Rule::word => {
                    let word = self.ident(&child);
                    path = Some(match path {
                        None => Expr { span: word.span, kind: ExprKind::Name(word.node) },
                        Some(left) => Expr {
                            span: left.span.to(word.span),
                            kind: ExprKind::Member(Box::new(left), word),
                        },
                    });
                }
                _ => {}
            }
        }
        ExprKind::Own(Box::new(path.unwrap_or_else(|| broken(span))))
    }

    /// The arguments in a pair of brackets.
    pub(super) fn args(&mut self, node: CstNode<'_>) -> Vec<Arg> {
        let args = node.into_inner().filter(|child| child.as_rule() == Rule::arg);
        self.bounded(args, "arguments").into_iter().filter_map(|arg| self.arg(arg)).collect()
    }

    fn arg(&mut self, node: CstNode<'_>) -> Option<Arg> {
        let span = self.span(&node);
        let mut nodes = CstNodes::of(node);
        if let Some(word) = nodes.want(Rule::word) {
            nodes.eat(Rule::colon);
            let kind = match word.as_str() {
                "true" | "on" => ExprKind::Bool(true),
                "false" | "off" => ExprKind::Bool(false),
                name => Role::from_name(name)
                    .map_or_else(|| ExprKind::Name(name.to_owned()), ExprKind::Role),
            };
            let key = Expr { span: self.span(&word), kind };
            let value = nodes.next().map(|value| self.expr(value))?;
            return Some(Arg { span, key: Some(key), value, binder: None, filter: None });
        }
        let mut value = nodes.next().map(|value| self.expr(value))?;
        let mut key = None;
        if nodes.eat(Rule::colon) {
            key = Some(std::mem::replace(&mut value, self.take_expr(&mut nodes, Rule::expr)?));
        }
        let binder = nodes.want(Rule::binder).and_then(|binder| self.binder(binder));
        let filter = nodes
            .want(Rule::filter)
            .and_then(|filter| CstNodes::of(filter).seek(Rule::expr))
            .map(|filter| self.expr(filter));
        Some(Arg { span, key, value, binder, filter })
    }

    fn binder(&mut self, node: CstNode<'_>) -> Option<(Ident, Expr)> {
        let mut nodes = CstNodes::of(node);
        let name = nodes.seek(Rule::ident)?;
        let name = self.value_name(&name);
        let set = nodes.seek(Rule::set)?;
        Some((name, self.expr(set)))
    }
}

impl<'i> CstNodes<'i> {
    /// The next token unless it is `and` or `or`.
    fn next_if_not_logical(&mut self) -> Option<CstNode<'i>> {
        match self.peek() {
            None | Some(Rule::kw_and | Rule::kw_or) => None,
            Some(_) => self.next(),
        }
    }
}

fn is_comparison(rule: Rule) -> bool {
    matches!(rule, Rule::cmp_op | Rule::kw_in | Rule::kw_has | Rule::kw_changes)
}

/// An expression that could not be read.
pub(super) fn broken(span: Span) -> Expr {
    Expr { span, kind: ExprKind::Broken }
}
