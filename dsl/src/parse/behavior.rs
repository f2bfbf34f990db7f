//! Statements of a behaviour.

use super::reader::{CstNode, CstNodes, Reader};
use super::recover::Context;
use crate::ast::{BehaviorStmt, BehaviorStmtKind, Chance, DoStmt, DoWhat, RepeatHow};
use crate::problem::Problem;
use crate::problem::facts::Names;
use crate::source::Span;
use setpiece_grammar::Rule;

impl Reader<'_> {
    /// The statements between a behaviour's or block's braces.
    pub(super) fn behavior_body(&mut self, node: CstNode<'_>) -> Vec<BehaviorStmt> {
        let span = self.span(&node);
        let read = |reader: &mut Self| {
            reader.list(node, Context::Behavior, Self::behavior_stmt, |span, _| BehaviorStmt {
                span,
                kind: BehaviorStmtKind::Broken,
            })
        };
        self.nested(span, read).unwrap_or_default()
    }

    fn behavior_stmt(&mut self, node: CstNode<'_>, span: Span, _doc: String) -> BehaviorStmt {
        let kind = node.into_inner().next().and_then(|node| self.behavior_stmt_kind(node));
        BehaviorStmt { span, kind: kind.unwrap_or(BehaviorStmtKind::Broken) }
    }

    fn behavior_stmt_kind(&mut self, node: CstNode<'_>) -> Option<BehaviorStmtKind> {
        let rule = node.as_rule();
        match rule {
            Rule::state => return self.binding(node).map(BehaviorStmtKind::State),
            Rule::let_stmt => return self.binding(node).map(BehaviorStmtKind::Let),
            Rule::do_stmt => return self.do_stmt(node).map(BehaviorStmtKind::Do),
            Rule::finish => return Some(BehaviorStmtKind::Finish),
            Rule::choose => {
                let chances = node.into_inner().filter(|child| child.as_rule() == Rule::chance);
                let chances = self.bounded(chances, "branches").into_iter();
                return Some(BehaviorStmtKind::Choose(
                    chances.filter_map(|chance| self.chance(chance)).collect(),
                ));
            }
            _ => {}
        }
        let mut nodes = CstNodes::of(node);
        Some(match rule {
            Rule::interrupt => {
                let condition =
                    nodes.seek(Rule::condition).map(|condition| self.expr(condition))?;
                BehaviorStmtKind::Interrupt { condition, body: self.take_body(&mut nodes)? }
            }
            Rule::repeat => {
                nodes.eat(Rule::kw_repeat);
                let how = match nodes.peek() {
                    Some(Rule::kw_until) => RepeatHow::Until(
                        nodes.seek(Rule::condition).map(|condition| self.expr(condition))?,
                    ),
                    Some(Rule::times) => {
                        let sum = CstNodes::of(nodes.next()?).seek(Rule::sum)?;
                        RepeatHow::Times(self.expr(sum))
                    }
                    _ => RepeatHow::Forever,
                };
                BehaviorStmtKind::Repeat { how, body: self.take_body(&mut nodes)? }
            }
            Rule::if_stmt => {
                let condition =
                    nodes.seek(Rule::condition).map(|condition| self.expr(condition))?;
                let mut arms = vec![(condition, self.take_body(&mut nodes)?)];
                let mut otherwise = Vec::new();
                for rest in self.bounded(nodes, "branches") {
                    let is_arm = rest.as_rule() == Rule::else_if;
                    let mut inner = CstNodes::of(rest);
                    if is_arm {
                        let condition =
                            inner.seek(Rule::condition).map(|condition| self.expr(condition))?;
                        arms.push((condition, self.take_body(&mut inner)?));
                    } else {
                        inner.eat(Rule::kw_else);
                        otherwise = self.take_body(&mut inner)?;
                    }
                }
                BehaviorStmtKind::If { arms, otherwise }
            }
            _ => {
                let name = nodes.want(Rule::ident)?;
                let name = self.assigned_name(&name);
                nodes.eat(Rule::equals);
                BehaviorStmtKind::Assign {
                    name,
                    value: nodes.next().map(|value| self.expr(value))?,
                }
            }
        })
    }

    fn take_body(&mut self, nodes: &mut CstNodes<'_>) -> Option<Vec<BehaviorStmt>> {
        nodes.want(Rule::behavior_body).map(|body| self.behavior_body(body))
    }

    /// `2: { … }`, `1: do shoot`
    fn chance(&mut self, node: CstNode<'_>) -> Option<Chance> {
        let mut nodes = CstNodes::of(node);
        let weight = nodes.want(Rule::sum).map(|weight| self.expr(weight))?;
        nodes.eat(Rule::colon);
        let what = nodes.next()?;
        let body = if what.as_rule() == Rule::behavior_body {
            self.behavior_body(what)
        } else {
            let span = self.span(&what);
            let kind = self.do_stmt(what).map_or(BehaviorStmtKind::Broken, BehaviorStmtKind::Do);
            vec![BehaviorStmt { span, kind }]
        };
        Some(Chance { weight, body })
    }

    fn do_stmt(&mut self, node: CstNode<'_>) -> Option<DoStmt> {
        let mut nodes = CstNodes::of(node);
        nodes.eat(Rule::kw_do);
        let what = nodes.next()?;
        let what = if what.as_rule() == Rule::script {
            DoWhat::Script(self.script(what)?)
        } else {
            let span = self.span(&what);
            let mut inner = CstNodes::of(what);
            let name = inner.want(Rule::act_name).map(|name| self.ident(&name))?;
            let args = inner.want(Rule::args).map(|args| self.args(args)).unwrap_or_default();
            DoWhat::Named { name, args, span }
        };
        let mut stmt = DoStmt { what, sprinting: None, until: None, duration: None };
        for clause in nodes {
            let span = self.span(&clause);
            let twice = match clause.as_rule() {
                Rule::kw_sprinting => stmt.sprinting.replace(span).is_some(),
                Rule::do_until => {
                    let condition = CstNodes::of(clause)
                        .seek(Rule::condition)
                        .map(|condition| self.expr(condition))?;
                    stmt.until.replace(condition).is_some()
                }
                _ => {
                    let duration = CstNodes::of(clause)
                        .seek(Rule::duration)
                        .map(|duration| self.expr(duration))?;
                    stmt.duration.replace(duration).is_some()
                }
            };
            if twice {
                self.push(Problem::new(span, Names::ClauseTwice));
            }
        }
        Some(stmt)
    }
}
