//! Suites, checks and curricula.

use super::reader::{CstNode, CstNodes, Reader};
use super::recover::Context;
use crate::ast::{
    AdaptExpr, CheckStmt, CheckStmtKind, CurriculumStmt, CurriculumStmtKind, EpisodesExpr,
    GoalExpr, MeasureArg, MeasureRef, Ref, StageRule, SuiteStmt, SuiteStmtKind,
};
use crate::source::Span;
use setpiece_grammar::Rule;

impl Reader<'_> {
    /// The statements between a suite's braces, or those of an `each`.
    pub(super) fn suite_body(&mut self, node: CstNode<'_>) -> Vec<SuiteStmt> {
        let span = self.span(&node);
        let read = |reader: &mut Self| {
            reader.list(node, Context::Suite, Self::suite_stmt, |span, _| SuiteStmt {
                span,
                kind: SuiteStmtKind::Broken,
            })
        };
        self.nested(span, read).unwrap_or_default()
    }

    fn suite_stmt(&mut self, node: CstNode<'_>, span: Span, _doc: String) -> SuiteStmt {
        let kind = node.into_inner().next().and_then(|node| self.suite_stmt_kind(node));
        SuiteStmt { span, kind: kind.unwrap_or(SuiteStmtKind::Broken) }
    }

    fn suite_stmt_kind(&mut self, node: CstNode<'_>) -> Option<SuiteStmtKind> {
        let is_sweep = node.as_rule() == Rule::sweep;
        let mut nodes = CstNodes::of(node);
        if !is_sweep {
            let scenario = nodes.seek(Rule::reference).and_then(|node| self.reference(node))?;
            return self.episodes(scenario, &mut nodes).map(SuiteStmtKind::Entry);
        }
        let name = nodes.seek(Rule::ident).map(|name| self.value_name(&name))?;
        let values = nodes.seek(Rule::list)?.into_inner();
        let values = values.filter(|value| value.as_rule() == Rule::expr);
        let values = self.bounded(values, "values").into_iter().map(|value| self.expr(value));
        let values = values.collect();
        let body = nodes.seek(Rule::suite_body).map(|body| self.suite_body(body))?;
        Some(SuiteStmtKind::Sweep { name, values, body })
    }

    /// `for N episodes [seed S]`, of a scenario.
    fn episodes(&mut self, scenario: Ref, nodes: &mut CstNodes<'_>) -> Option<EpisodesExpr> {
        let count = nodes.seek(Rule::episodes).and_then(|node| self.only_sum(node))?;
        let seed = nodes.want(Rule::seeded).and_then(|node| self.only_sum(node));
        Some(EpisodesExpr { scenario, count, seed })
    }

    /// The sum of a phrase such as `seed 5`.
    fn only_sum(&mut self, node: CstNode<'_>) -> Option<crate::ast::Expr> {
        CstNodes::of(node).seek(Rule::sum).map(|sum| self.expr(sum))
    }

    /// The statements between a check's braces.
    pub(super) fn check_body(&mut self, node: CstNode<'_>) -> Vec<CheckStmt> {
        self.list(node, Context::Check, Self::check_stmt, |span, _| CheckStmt {
            span,
            kind: CheckStmtKind::Broken,
        })
    }

    fn check_stmt(&mut self, node: CstNode<'_>, span: Span, _doc: String) -> CheckStmt {
        let kind = node.into_inner().next().and_then(|node| self.check_stmt_kind(node));
        CheckStmt { span, kind: kind.unwrap_or(CheckStmtKind::Broken) }
    }

    fn check_stmt_kind(&mut self, node: CstNode<'_>) -> Option<CheckStmtKind> {
        let is_play = node.as_rule() == Rule::play;
        let mut nodes = CstNodes::of(node);
        if is_play {
            let scenario = nodes.seek(Rule::reference).and_then(|node| self.reference(node))?;
            let agent = nodes.eat(Rule::kw_with).then(|| nodes.want(Rule::path)).flatten();
            let agent = agent.map(|agent| self.ident(&agent));
            let episodes = self.episodes(scenario, &mut nodes)?;
            let over_params = nodes.eat(Rule::over_params);
            return Some(CheckStmtKind::Play { episodes, agent, over_params });
        }
        nodes.eat(Rule::kw_expect);
        if nodes.eat(Rule::kw_never) {
            return nodes.want(Rule::path).map(|name| CheckStmtKind::Never(self.ident(&name)));
        }
        nodes.want(Rule::goal).and_then(|goal| self.goal(goal)).map(CheckStmtKind::Expect)
    }

    /// `MEASURE < BOUND`
    fn goal(&mut self, node: CstNode<'_>) -> Option<GoalExpr> {
        let span = self.span(&node);
        let mut nodes = CstNodes::of(node);
        let measure = nodes.want(Rule::measure).and_then(|measure| self.measure(measure))?;
        let comparison = nodes.want(Rule::cmp_op).map(|sign| self.ident(&sign))?;
        let bound = nodes.want(Rule::sum).map(|bound| self.expr(bound))?;
        Some(GoalExpr { measure, comparison, bound, span })
    }

    fn measure(&mut self, node: CstNode<'_>) -> Option<MeasureRef> {
        let span = self.span(&node);
        let mut nodes = CstNodes::of(node);
        let name = nodes.want(Rule::word).map(|name| self.ident(&name))?;
        let args = nodes.want(Rule::measure_args).map(|args| {
            let args = args.into_inner().filter(|arg| arg.as_rule() == Rule::measure_arg);
            let args = self.bounded(args, "arguments").into_iter();
            args.filter_map(|arg| self.measure_arg(arg)).collect()
        });
        Some(MeasureRef { name, args: args.unwrap_or_default(), span })
    }

    fn measure_arg(&mut self, node: CstNode<'_>) -> Option<MeasureArg> {
        let mut nodes = CstNodes::of(node);
        let Some(word) = nodes.want(Rule::word).map(|word| self.ident(&word)) else {
            return nodes.want(Rule::sum).map(|value| MeasureArg::Value(self.expr(value)));
        };
        if nodes.eat(Rule::colon) {
            let value = nodes.want(Rule::sum).map(|value| self.expr(value))?;
            return Some(MeasureArg::Named(word, value));
        }
        let of = nodes.next()?;
        let of = if of.as_rule() == Rule::string { self.string(&of) } else { self.ident(&of) };
        Some(MeasureArg::Of(word, of))
    }

    /// The statements between a curriculum's braces.
    pub(super) fn curriculum_body(&mut self, node: CstNode<'_>) -> Vec<CurriculumStmt> {
        self.list(node, Context::Curriculum, Self::curriculum_stmt, |span, _| CurriculumStmt {
            span,
            kind: CurriculumStmtKind::Broken,
        })
    }

    fn curriculum_stmt(&mut self, node: CstNode<'_>, span: Span, _doc: String) -> CurriculumStmt {
        let kind = node.into_inner().next().and_then(|node| self.curriculum_stmt_kind(node));
        CurriculumStmt { span, kind: kind.unwrap_or(CurriculumStmtKind::Broken) }
    }

    fn curriculum_stmt_kind(&mut self, node: CstNode<'_>) -> Option<CurriculumStmtKind> {
        let is_stage = node.as_rule() == Rule::stage;
        let mut nodes = CstNodes::of(node);
        if !is_stage {
            let current = nodes.seek(Rule::sum).map(|share| self.expr(share))?;
            let earlier = nodes.seek(Rule::sum).map(|share| self.expr(share))?;
            return Some(CurriculumStmtKind::Mix { current, earlier });
        }
        let name = nodes.seek(Rule::ident).map(|name| self.ident(&name))?;
        let scenario = nodes.seek(Rule::reference).and_then(|node| self.reference(node))?;
        let how = match nodes.next() {
            Some(until) if until.as_rule() == Rule::stage_until => {
                let goals = until.into_inner().filter(|goal| goal.as_rule() == Rule::goal);
                let goals = self.bounded(goals, "goals").into_iter();
                StageRule::Until(goals.filter_map(|goal| self.goal(goal)).collect())
            }
            Some(adapt) => {
                let mut nodes = CstNodes::of(adapt);
                StageRule::Adapt(Box::new(AdaptExpr {
                    name: nodes.seek(Rule::ident).map(|name| self.value_name(&name))?,
                    from: nodes.seek(Rule::sum).map(|from| self.expr(from))?,
                    to: nodes.seek(Rule::sum).map(|to| self.expr(to))?,
                    measure: nodes.seek(Rule::measure).and_then(|node| self.measure(node))?,
                    band: nodes.seek(Rule::range).and_then(|range| self.range_of(range))?,
                }))
            }
            None => StageRule::Forever,
        };
        Some(CurriculumStmtKind::Stage { name, scenario, how })
    }
}
