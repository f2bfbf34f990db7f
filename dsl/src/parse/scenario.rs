//! Statements of a scenario.

use super::reader::{CstNode, CstNodes, Reader};
use super::recover::Context;
use crate::ast::{
    BallStmt, EndCondition, EndStmt, Observed, RewardUse, RewardUseKind, Rounds, ScenarioStmt,
    ScenarioStmtKind, Spanned, Substitute,
};
use crate::problem::Problem;
use crate::problem::facts::Names;
use crate::source::Span;
use setpiece_grammar::Rule;

impl Reader<'_> {
    /// The statements between a scenario's braces.
    pub(super) fn scenario_body(&mut self, node: CstNode<'_>) -> Vec<ScenarioStmt> {
        self.list(node, Context::Scenario, Self::scenario_stmt, |span, doc| ScenarioStmt {
            doc,
            span,
            kind: ScenarioStmtKind::Broken,
        })
    }

    fn scenario_stmt(&mut self, node: CstNode<'_>, span: Span, mut doc: String) -> ScenarioStmt {
        let kind = node.into_inner().next().and_then(|node| self.scenario_stmt_kind(node, &doc));
        if let Some(ScenarioStmtKind::Param(_)) = &kind {
            doc.clear();
        }
        ScenarioStmt { doc, span, kind: kind.unwrap_or(ScenarioStmtKind::Broken) }
    }

    /// `substitute PLAYER when CONDITION [{ … }]`
    fn substitute(&mut self, nodes: &mut CstNodes<'_>) -> Option<Substitute> {
        let who = self.take_expr(nodes, Rule::sum)?;
        nodes.eat(Rule::kw_when);
        let when = self.take_expr(nodes, Rule::condition)?;
        Some(Substitute { who, when, fields: self.take_fields(nodes) })
    }

    /// `rounds N when CONDITION`
    fn rounds(&mut self, nodes: &mut CstNodes<'_>) -> Option<Rounds> {
        let count = self.take_expr(nodes, Rule::sum)?;
        nodes.eat(Rule::kw_when);
        Some(Rounds { count, when: self.take_expr(nodes, Rule::condition)? })
    }

    fn scenario_stmt_kind(&mut self, node: CstNode<'_>, doc: &str) -> Option<ScenarioStmtKind> {
        let rule = node.as_rule();
        match rule {
            Rule::let_stmt => return self.binding(node).map(ScenarioStmtKind::Let),
            Rule::constant => return self.binding(node).map(ScenarioStmtKind::Const),
            Rule::record => return self.record(node).map(ScenarioStmtKind::Record),
            Rule::region => return self.function(node).map(ScenarioStmtKind::Region),
            _ => {}
        }
        let mut nodes = CstNodes::of(node);
        let keyword = nodes.next()?;
        Some(match rule {
            Rule::param_stmt => {
                let param = nodes.want(Rule::param)?;
                ScenarioStmtKind::Param(self.param(param, doc.to_owned())?)
            }
            Rule::tuple_let => {
                let mut names = Vec::new();
                while nodes.peek().is_some_and(|rule| rule != Rule::equals) {
                    names.extend(nodes.next().filter(|node| node.as_rule() == Rule::ident));
                }
                let names = self.bounded(names.into_iter(), "names");
                let names = names.iter().map(|name| self.value_name(name)).collect();
                ScenarioStmtKind::LetTuple {
                    names,
                    value: nodes.seek(Rule::expr).map(|value| self.expr(value))?,
                }
            }
            Rule::rules => ScenarioStmtKind::Rules(self.take_fields(&mut nodes)),
            Rule::world => ScenarioStmtKind::World(self.take_fields(&mut nodes)),
            Rule::pitch => ScenarioStmtKind::Pitch(self.take_fields(&mut nodes)),
            Rule::agents => ScenarioStmtKind::Agents(self.take_fields(&mut nodes)),
            Rule::ball => {
                let place = nodes.want(Rule::place)?;
                let place = self.place(place)?;
                let jitter = self.jitter(&mut nodes);
                ScenarioStmtKind::Ball(BallStmt {
                    place,
                    jitter,
                    fields: self.take_fields(&mut nodes),
                })
            }
            Rule::team => {
                let team = nodes.next().map(|team| self.ident(&team))?;
                let body = nodes.want(Rule::team_body)?;
                ScenarioStmtKind::Team { team, body: self.team_body(body) }
            }
            Rule::kickoff => ScenarioStmtKind::Kickoff {
                first: self.take_expr(&mut nodes, Rule::expr)?,
                fields: self.take_fields(&mut nodes),
            },
            Rule::start => {
                let kind = nodes.want(Rule::ident).map(|kind| self.ident(&kind))?;
                let team = if nodes.eat(Rule::kw_for) {
                    self.take_expr(&mut nodes, Rule::actor)
                } else {
                    None
                };
                let at = if nodes.eat(Rule::kw_at) {
                    self.take_expr(&mut nodes, Rule::point)
                } else {
                    None
                };
                ScenarioStmtKind::Start { kind, team, at, fields: self.take_fields(&mut nodes) }
            }
            Rule::reward_use => self.reward_use(&mut nodes)?,
            Rule::end => ScenarioStmtKind::End(self.end(nodes.next()?)?),
            Rule::substitute => ScenarioStmtKind::Substitute(self.substitute(&mut nodes)?),
            Rule::rounds => ScenarioStmtKind::Rounds(self.rounds(&mut nodes)?),
            Rule::require => {
                let condition = self.take_expr(&mut nodes, Rule::condition)?;
                let probability = if nodes.eat(Rule::kw_with) {
                    self.take_expr(&mut nodes, Rule::factor)
                } else {
                    None
                };
                ScenarioStmtKind::Require { condition, probability, label: self.label(&mut nodes) }
            }
            Rule::remove => {
                let what = nodes.next().map(|what| self.ident(&what))?;
                let name = match nodes.next() {
                    Some(name) if name.as_rule() == Rule::string => Some(self.string(&name)),
                    name => name.map(|name| self.ident(&name)),
                };
                ScenarioStmtKind::Remove { what, name }
            }
            Rule::mirror => {
                ScenarioStmtKind::Mirror(nodes.seek(Rule::ident).map(|what| self.ident(&what))?)
            }
            Rule::observe => {
                debug_assert_eq!(keyword.as_rule(), Rule::kw_observe, "the keyword stands first");
                let observed = nodes.filter(|node| node.as_rule() == Rule::observed);
                let observed = self.bounded(observed, "values").into_iter();
                ScenarioStmtKind::Observe(observed.filter_map(|node| self.observed(node)).collect())
            }
            _ => return None,
        })
    }

    /// `record NAME = expr`: its name lives apart from values.
    fn record(&mut self, node: CstNode<'_>) -> Option<crate::ast::Binding> {
        let mut nodes = CstNodes::of(node);
        let name = nodes.seek(Rule::ident).map(|name| self.ident(&name))?;
        let value = nodes.seek(Rule::expr).map(|value| self.expr(value))?;
        Some(crate::ast::Binding { name, ty: None, value })
    }

    fn observed(&mut self, node: CstNode<'_>) -> Option<Observed> {
        let mut nodes = CstNodes::of(node);
        let value = self.take_expr(&mut nodes, Rule::expr)?;
        let mut line =
            Observed { value, noise: None, when: None, delay: None, stack: None, label: None };
        while nodes.peek() == Some(Rule::sight) {
            let Some(clause) = nodes.next().and_then(|sight| CstNodes::of(sight).next()) else {
                break;
            };
            let rule = clause.as_rule();
            let Some(inner) = CstNodes::of(clause).last() else { break };
            let given = self.expr(inner);
            let (slot, word) = match rule {
                Rule::noise => (&mut line.noise, "noise"),
                Rule::seen_when => (&mut line.when, "when"),
                Rule::delayed => (&mut line.delay, "delayed"),
                _ => (&mut line.stack, "stack"),
            };
            let span = given.span;
            if let Some(first) = slot.replace(given) {
                let (what, first) = (format!("`{word}`"), first.span);
                self.push(Problem::new(span, Names::GivenTwice { what, first }));
            }
        }
        line.label = self.label(&mut nodes);
        Some(line)
    }

    /// `as "x"`
    pub(super) fn label(&self, nodes: &mut CstNodes<'_>) -> Option<Spanned<String>> {
        let label = nodes.want(Rule::label)?;
        CstNodes::of(label).seek(Rule::string).map(|words| self.string(&words))
    }

    fn reward_use(&mut self, nodes: &mut CstNodes<'_>) -> Option<ScenarioStmtKind> {
        let node = nodes.next()?;
        let mut audience = None;
        let mut what = match node.as_rule() {
            Rule::script => RewardUseKind::Script { script: self.script(node)?, terms: None },
            Rule::reference => RewardUseKind::Named(self.reference(node)?),
            _ => {
                let mut inner = CstNodes::of(node);
                let name = inner.want(Rule::ident).map(|name| self.ident(&name))?;
                audience = self.clause(&mut inner, Rule::audience);
                let body = inner.want(Rule::reward_body)?;
                RewardUseKind::Inline { name, body: self.reward_body(body) }
            }
        };
        let audience = audience.or_else(|| self.clause(nodes, Rule::audience));
        let label = self.label(nodes);
        match (self.terms(nodes), &mut what) {
            (named, RewardUseKind::Script { terms, .. }) => *terms = named,
            (named, _) => self.refuse_terms(named),
        }
        let weight =
            nodes.want(Rule::weight).and_then(|weight| CstNodes::of(weight).seek(Rule::factor));
        Some(ScenarioStmtKind::Reward(RewardUse {
            what,
            audience,
            label,
            weight: weight.map(|weight| self.expr(weight)),
        }))
    }

    fn end(&mut self, node: CstNode<'_>) -> Option<EndStmt> {
        let limit = node.as_rule() == Rule::end_limit;
        let mut nodes = CstNodes::of(node);
        if limit {
            return nodes.seek(Rule::sum).map(|limit| EndStmt::Limit(self.expr(limit)));
        }
        let verdict = nodes.want(Rule::verdict).map(|verdict| self.ident(&verdict));
        let label = nodes.want(Rule::reference).and_then(|label| self.reference(label));
        let condition =
            match nodes.want(Rule::trigger).and_then(|trigger| CstNodes::of(trigger).last()) {
                Some(script) if script.as_rule() == Rule::script => {
                    Some(EndCondition::Script(self.script(script)?))
                }
                Some(condition) => Some(EndCondition::Expr(self.expr(condition))),
                None => None,
            };
        Some(EndStmt::When { verdict, label, condition })
    }
}
