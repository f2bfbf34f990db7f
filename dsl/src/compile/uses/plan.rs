//! Names in suites, checks and curricula.

use super::Uses;
use super::scenario::record_of;
use crate::ast::{
    CheckItem, CheckStmtKind, CurriculumItem, CurriculumStmtKind, EpisodesExpr, Expr, ExprKind,
    GoalExpr, MeasureArg, MeasureRef, StageRule, SuiteItem, SuiteStmt, SuiteStmtKind,
};
use crate::resolve::Flat;

impl<'a> Uses<'a> {
    pub(super) fn suite(&mut self, item: &'a SuiteItem) {
        self.declare(&item.name);
        self.entries(&item.body);
    }

    fn entries(&mut self, body: &'a [SuiteStmt]) {
        for stmt in body {
            match &stmt.kind {
                SuiteStmtKind::Sweep { name, values, body } => {
                    self.exprs(values);
                    self.block(|uses| {
                        uses.bind(name);
                        uses.entries(body);
                    });
                }
                SuiteStmtKind::Entry(episodes) => drop(self.episodes(episodes)),
                SuiteStmtKind::Broken => {}
            }
        }
    }

    fn episodes(&mut self, written: &'a EpisodesExpr) -> Option<Flat<'a>> {
        let flat = self.played(&written.scenario);
        self.expr(&written.count);
        self.exprs(&written.seed);
        flat
    }

    pub(super) fn check(&mut self, item: &'a CheckItem) {
        let mut played = None;
        for stmt in &item.body {
            let CheckStmtKind::Play { episodes, agent, .. } = &stmt.kind else { continue };
            played = self.episodes(episodes);
            if let Some(agent) = agent {
                let _ = self.found(agent);
            }
        }
        for stmt in &item.body {
            match (&stmt.kind, &played) {
                (CheckStmtKind::Expect(goal), _) => self.goal(goal, played.as_ref()),
                (CheckStmtKind::Never(name), Some(flat)) => {
                    if let Some(at) = self.ending_of(flat, &name.node) {
                        self.refer(name.span, at);
                    }
                }
                _ => {}
            }
        }
    }

    pub(super) fn curriculum(&mut self, item: &'a CurriculumItem) {
        self.declare(&item.name);
        for stmt in &item.body {
            match &stmt.kind {
                CurriculumStmtKind::Stage { name, scenario, how } => {
                    self.declare(name);
                    self.block(|uses| {
                        if let StageRule::Adapt(adapt) = how {
                            uses.bind(&adapt.name);
                        }
                        let flat = uses.played(scenario);
                        uses.rule(how, flat.as_ref());
                    });
                }
                CurriculumStmtKind::Mix { current, earlier } => self.exprs([current, earlier]),
                CurriculumStmtKind::Broken => {}
            }
        }
    }

    fn rule(&mut self, how: &'a StageRule, flat: Option<&Flat<'a>>) {
        match how {
            StageRule::Forever => {}
            StageRule::Until(goals) => goals.iter().for_each(|goal| self.goal(goal, flat)),
            StageRule::Adapt(adapt) => {
                self.exprs([&adapt.from, &adapt.to]);
                self.measure(&adapt.measure, flat);
                self.domain(&adapt.band);
            }
        }
    }

    fn goal(&mut self, goal: &'a GoalExpr, flat: Option<&Flat<'a>>) {
        self.measure(&goal.measure, flat);
        self.expr(&goal.bound);
    }

    fn measure(&mut self, measure: &'a MeasureRef, flat: Option<&Flat<'a>>) {
        for arg in &measure.args {
            match arg {
                // `length` and its like are words.
                MeasureArg::Value(Expr { kind: ExprKind::Name(_), .. }) => {}
                MeasureArg::Named(_, value) | MeasureArg::Value(value) => self.expr(value),
                MeasureArg::Of(kind, name) => {
                    let known = flat.and_then(|flat| match kind.node.as_str() {
                        "record" => record_of(flat, &name.node),
                        "outcome" => self.ending_of(flat, &name.node),
                        _ => None,
                    });
                    if let Some(at) = known {
                        self.refer(name.span, at);
                    }
                }
            }
        }
    }
}
