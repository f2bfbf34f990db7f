//! Suites, checks and curricula: trees to plans.
//!
//! A plan plays compiled scenarios. So this stands above the compilation of one scenario, which it
//! asks for by item.

mod agents;
mod argument;
mod measure;

use crate::ast::{
    AdaptExpr, CheckItem, CheckStmtKind, CurriculumItem, CurriculumStmtKind, Domain, EpisodesExpr,
    Expr, Ident, Item, ItemKind, Ref, ScenarioItem, Span, StageRule, SuiteItem, SuiteStmt,
    SuiteStmtKind,
};
use crate::check::types::Ty;
use crate::lower::value::{LiteralFrame, LocalName, Repr, Scope};
use crate::lower::{Lower, World};
use crate::problem::facts::Plans as Facts;
use crate::problem::{Guess, Problem};
use setpiece_scenario::plan::{self, EPISODES_MAX, Plans};
use setpiece_scenario::vocabulary::{AGENTS, Primitive};
use setpiece_scenario::{Bindings, Scenario};
use std::sync::Arc;

/// Suites of a file may have this many entries together, every `each` written out.
const ENTRIES_MAX: usize = 4_096;
/// What plays players without a behaviour.
const BUILT_IN: [&str; 2] = ["hold", "lazy"];
/// The greatest seed: the greatest whole number that every format keeps exactly.
const SEED_MAX: u64 = (1 << 53) - 1;

/// Compiles the scenario of an item, once for all of its uses; or once more for a check in which
/// what an `ai` may be plays the agents.
pub(super) type CompileItem<'c, 'w> =
    dyn FnMut(&'w ScenarioItem, &'w str, Option<&'w Ident>) -> Arc<Scenario> + 'c;

/// Turns the plans of a file into data.
pub(super) struct Planner<'c, 'w> {
    /// A world without a scenario: plans see what their file sees.
    world: &'c World<'w>,
    compile: &'c mut CompileItem<'c, 'w>,
    entries: usize,
    /// Where each check names its agent, if it does.
    check_agents: Vec<Option<Span>>,
}

impl<'c, 'w> Planner<'c, 'w> {
    pub(super) fn new(
        world: &'c World<'w>,
        compile: &'c mut CompileItem<'c, 'w>,
    ) -> Planner<'c, 'w> {
        Planner { world, compile, entries: 0, check_agents: Vec::new() }
    }

    /// The plans of some items, and where each check names its agent.
    pub(super) fn plans(mut self, items: &'w [Item]) -> (Plans, Vec<Option<Span>>) {
        let mut plans = Plans::default();
        for item in items {
            match &item.kind {
                ItemKind::Suite(suite) => plans.suites.push(self.suite(suite, &item.doc)),
                ItemKind::Check(check) => plans.checks.extend(self.check(check, item.span)),
                ItemKind::Curriculum(curriculum) => {
                    plans.curricula.push(self.curriculum(curriculum, &item.doc));
                }
                _ => {}
            }
        }
        (plans, self.check_agents)
    }

    fn suite(&mut self, item: &'w SuiteItem, doc: &str) -> plan::Suite {
        if item.body.is_empty() {
            self.report(item.name.span, Facts::EmptySuite { name: item.name.node.clone() });
        }
        let mut entries = Vec::new();
        self.entries(&item.body, &scope(), &mut entries);
        plan::Suite { name: item.name.node.clone(), doc: doc.to_owned(), entries }
    }

    fn entries(
        &mut self,
        body: &'w [SuiteStmt],
        scope: &Scope<'w>,
        entries: &mut Vec<plan::PlannedEpisodes>,
    ) {
        for stmt in body {
            match &stmt.kind {
                SuiteStmtKind::Entry(episodes) => {
                    self.entries += 1;
                    if self.entries > ENTRIES_MAX {
                        if self.entries == ENTRIES_MAX + 1 {
                            self.report(stmt.span, Facts::TooMany { most: ENTRIES_MAX });
                        }
                        return;
                    }
                    entries.extend(self.episodes(episodes, scope, None));
                }
                SuiteStmtKind::Sweep { name, values, body } => {
                    if values.is_empty() {
                        self.report(name.span, Facts::EmptySweep { name: name.node.clone() });
                    }
                    for value in values {
                        let mut inner = scope.clone();
                        let named = LocalName::Expr {
                            expr: value,
                            scope: scope.clone(),
                            ty: None,
                            now: None,
                            at: name.span,
                        };
                        inner.bind(&name.node, named);
                        self.entries(body, &inner, entries);
                        if self.entries > ENTRIES_MAX {
                            return;
                        }
                    }
                }
                SuiteStmtKind::Broken => {}
            }
        }
    }

    fn episodes(
        &mut self,
        written: &'w EpisodesExpr,
        scope: &Scope<'w>,
        ai: Option<&'w Ident>,
    ) -> Option<plan::PlannedEpisodes> {
        let played = self.played(&written.scenario, scope, ai);
        let count = self.whole(&written.count, scope, "the number of episodes", 1, EPISODES_MAX);
        let seed = match &written.seed {
            Some(seed) => self.whole(seed, scope, "the seed", 0, SEED_MAX),
            None => Some(0),
        };
        Some(plan::PlannedEpisodes { played: played?, count: count?, seed: seed? })
    }

    fn played(
        &mut self,
        written: &'w Ref,
        scope: &Scope<'w>,
        ai: Option<&'w Ident>,
    ) -> Option<plan::Played> {
        let scenario = self.scenario(written, ai)?;
        let mut bindings = Bindings::defaults(&scenario.params);
        let found = self.world.found();
        self.arguments(written, &scenario, scope, &mut bindings);
        (self.world.found() == found).then_some(plan::Played { scenario, bindings })
    }

    /// The scenario that a reference names.
    fn scenario(&mut self, written: &'w Ref, ai: Option<&'w Ident>) -> Option<Arc<Scenario>> {
        let (name, span) = (written.name.node.as_str(), written.name.span);
        let library = self.world.library;
        let found = library.find(span.file, name);
        if let Some(problem) = library.ambiguous(span.file, name, span) {
            self.world.report(problem);
            return None;
        }
        let Some(ItemKind::Scenario(item)) = found.map(|found| &found.item.kind) else {
            let visible = library.visible(span.file);
            let scenarios = visible.filter_map(|(name, found)| match &found.item.kind {
                ItemKind::Scenario(scenario) if !scenario.is_abstract => Some(name),
                _ => None,
            });
            let given = library.scenarios.iter().map(|(name, _)| name.as_str());
            let other = found.map(|found| found.item.kind.noun());
            let guess = match other {
                None => Guess::of(name, scenarios.chain(given)),
                Some(_) => Guess::default(),
            };
            self.report(span, Facts::NoScenario { name: name.to_owned(), other, guess });
            return None;
        };
        if item.is_abstract {
            self.report(span, Facts::Abstract { name: name.to_owned() });
            return None;
        }
        let doc = found.map_or("", |found| found.item.doc.as_str());
        Some((self.compile)(item, doc, ai))
    }

    fn check(&mut self, item: &'w CheckItem, span: Span) -> Option<plan::Check> {
        let mut play: Option<(&'w EpisodesExpr, Option<&'w Ident>, bool, Span)> = None;
        for stmt in &item.body {
            let CheckStmtKind::Play { episodes, agent, over_params } = &stmt.kind else { continue };
            match play {
                Some((.., first)) => self.report(stmt.span, Facts::PlayTwice { first }),
                None => play = Some((episodes, agent.as_ref(), *over_params, stmt.span)),
            }
        }
        let is_whole = !item.body.iter().any(|stmt| matches!(stmt.kind, CheckStmtKind::Broken));
        let Some((episodes, agent, over_params, _)) = play else {
            if is_whole {
                self.report(span, Facts::NothingPlayed { name: item.name.node.clone() });
            }
            return None;
        };
        let place = agent.map(|agent| agent.span);
        let ai = agent.filter(|agent| !AGENTS.contains(&agent.node.as_str()));
        let agent = match agent {
            Some(agent) => self.agent(agent),
            None => Some("bot".to_owned()),
        };
        let episodes = self.episodes(episodes, &scope(), ai.filter(|_| agent.is_some()))?;
        let scenario = episodes.played.scenario.clone();
        let mut expectations = Vec::new();
        for stmt in &item.body {
            let goal = match &stmt.kind {
                CheckStmtKind::Expect(goal) => self.goal(goal, &scenario, false),
                CheckStmtKind::Never(name) => self.never(name, &scenario),
                CheckStmtKind::Play { .. } | CheckStmtKind::Broken => continue,
            };
            let text = self.world.text(stmt.span);
            let text = text.strip_prefix("expect ").unwrap_or(&text).to_owned();
            expectations.extend(goal.map(|goal| plan::Expectation { text, goal }));
        }
        if is_whole && !item.body.iter().any(|stmt| is_expectation(&stmt.kind)) {
            self.report(span, Facts::NothingExpected { name: item.name.node.clone() });
        }
        let agent = agent?;
        self.check_agents.push(place);
        Some(plan::Check {
            name: item.name.node.clone(),
            episodes,
            agent,
            over_params,
            expectations,
        })
    }

    /// A ready-made agent, or what may stand behind `ai:`.
    fn agent(&mut self, name: &Ident) -> Option<String> {
        let library = self.world.library;
        let is_behavior = |kind: &ItemKind| matches!(kind, ItemKind::Behavior(_));
        let found = library.find(name.span.file, &name.node);
        if AGENTS.contains(&name.node.as_str())
            || BUILT_IN.contains(&name.node.as_str())
            || Primitive::from_name(&name.node).is_some()
            || found.is_some_and(|found| is_behavior(&found.item.kind))
        {
            return Some(name.node.clone());
        }
        let behaviors = library
            .visible(name.span.file)
            .filter(|(_, found)| is_behavior(&found.item.kind))
            .map(|(name, _)| name);
        let known: Vec<&str> = AGENTS.into_iter().chain(behaviors).collect();
        let guess = Guess::similar_or_all(&name.node, &known);
        self.report(name.span, Facts::NoAgent { name: name.node.clone(), guess });
        None
    }

    fn curriculum(&mut self, item: &'w CurriculumItem, doc: &str) -> plan::Curriculum {
        let mut stages: Vec<plan::CurriculumStage> = Vec::new();
        let mut current = 1.0;
        let mut mixed: Option<Span> = None;
        let mut endless: Option<&'w Ident> = None;
        let mut names: Vec<&'w Ident> = Vec::new();
        let mut crew: Option<(Span, [usize; 2])> = None;
        for stmt in &item.body {
            match &stmt.kind {
                CurriculumStmtKind::Stage { name, scenario, how } => {
                    if let Some(before) = endless {
                        let (name, before) = (name.node.clone(), before.node.clone());
                        self.report(stmt.span, Facts::NeverReached { name, before });
                    }
                    if let Some(first) = names.iter().find(|known| known.node == name.node) {
                        self.declared_twice(name, first.span);
                    }
                    names.push(name);
                    if matches!(how, StageRule::Forever) {
                        endless = Some(name);
                    }
                    let stage = self.stage(name, scenario, how);
                    let found = stage.as_ref().and_then(|stage| agents::agents_of(&stage.played));
                    if let (Some(found), Some((first, known))) = (found, crew)
                        && found != known
                    {
                        let (stage, known) = (name.node.clone(), (first, known));
                        self.report(scenario.name.span, Facts::OtherAgents { stage, found, known });
                    }
                    crew = crew.or(found.map(|found| (scenario.name.span, found)));
                    stages.extend(stage);
                }
                CurriculumStmtKind::Mix { current: now, earlier } => {
                    if let Some(first) = mixed {
                        self.report(stmt.span, Facts::MixTwice { first });
                    }
                    mixed = Some(stmt.span);
                    let shares = (self.share(now, "a share"), self.share(earlier, "a share"));
                    if let (Some(now), Some(earlier)) = shares {
                        current = now;
                        if (now + earlier - 1.0).abs() > 1e-9 {
                            self.report(stmt.span, Facts::Mix { sum: now + earlier });
                        }
                    }
                }
                CurriculumStmtKind::Broken => {}
            }
        }
        if item.body.is_empty() || (names.is_empty() && mixed.is_some()) {
            self.report(item.name.span, Facts::NoStage { name: item.name.node.clone() });
        }
        plan::Curriculum { name: item.name.node.clone(), doc: doc.to_owned(), stages, current }
    }

    fn stage(
        &mut self,
        name: &Ident,
        written: &'w Ref,
        how: &'w StageRule,
    ) -> Option<plan::CurriculumStage> {
        let mut scope = scope();
        if let StageRule::Adapt(adapt) = how {
            let AdaptExpr { name, from, .. } = &**adapt;
            let at = name.span;
            let begun = scope.clone();
            let named = LocalName::Expr { expr: from, scope: begun, ty: None, now: None, at };
            scope.bind(&name.node, named);
        }
        let played = self.played(written, &scope, None)?;
        let how = match how {
            StageRule::Forever => plan::StageHow::Forever,
            StageRule::Until(goals) => plan::StageHow::Until(
                goals.iter().filter_map(|goal| self.goal(goal, &played.scenario, true)).collect(),
            ),
            StageRule::Adapt(adapt) => {
                let AdaptExpr { name, from, to, measure, band } = &**adapt;
                let measured_in = measure;
                let params = self.adapted(name, written, &played.scenario)?;
                let ty = params
                    .first()
                    .and_then(|at| played.scenario.params.get(*at))
                    .map_or(Ty::Number, |param| Ty::of(param.ty));
                let (measure, last, unit) = self.measure(measure, &played.scenario, true)?;
                let Domain::Range(low, high) = band else { return None };
                let bounds = (self.bound(low, unit), self.bound(high, unit));
                if let (Some(least), Some(most)) = bounds
                    && least >= most
                {
                    let (low, high) = (self.world.text(low.span), self.world.text(high.span));
                    self.report(measured_in.span, Facts::EmptyBand { low, high });
                }
                let (low, high) = bounds;
                let empty = self::scope();
                let ends = (self.constant(from, &empty, ty), self.constant(to, &empty, ty));
                if ends.0.is_some() && ends.0 == ends.1 {
                    let text = self.world.text(to.span);
                    self.report(from.span.to(to.span), Facts::AdaptsNowhere { text });
                }
                for (value, at) in [(ends.0, from), (ends.1, to)] {
                    for param in &params {
                        let Some(param) = played.scenario.params.get(*param) else { continue };
                        self.admit(param, value?, at);
                    }
                }
                plan::StageHow::Adapt(plan::Adapt {
                    params,
                    from: ends.0?,
                    to: ends.1?,
                    measure,
                    last,
                    band: (low?, high?),
                })
            }
        };
        Some(plan::CurriculumStage { name: name.node.clone(), played, how })
    }

    fn declared_twice(&self, name: &Ident, first: Span) {
        let what = format!("`{}`", name.node);
        let fact = crate::problem::facts::Names::DeclaredTwice { what, first: Some(first) };
        self.world.report(Problem::new(name.span, fact));
    }

    /// A whole number between two others.
    fn whole(
        &mut self,
        expr: &'w Expr,
        scope: &Scope<'w>,
        what: &'static str,
        least: u64,
        most: u64,
    ) -> Option<u64> {
        let value = self.constant(expr, scope, Ty::Int)?;
        if value.fract() == 0.0 && (least as f64..=most as f64).contains(&value) {
            return Some(value as u64);
        }
        let text = self.world.text(expr.span);
        self.report(expr.span, Facts::Count { what, text, least, most });
        None
    }

    fn share(&mut self, expr: &'w Expr, what: &'static str) -> Option<f64> {
        let value = self.constant(expr, &scope(), Ty::Percent)?;
        if (0.0..=1.0).contains(&value) {
            return Some(value);
        }
        let text = self.world.text(expr.span);
        self.report(expr.span, Facts::Share { what, text });
        None
    }

    /// The value of a constant of a type, in SI units.
    fn constant(&mut self, expr: &'w Expr, scope: &Scope<'w>, ty: Ty) -> Option<f64> {
        let mut lower = Lower::constant(self.world, scope.clone());
        let value = lower.want(expr, ty);
        match value.repr {
            _ if value.is_error() => None,
            Repr::One(reg) => {
                let found = lower.code.constant_of(reg);
                if found.is_none() {
                    self.not_constant(expr);
                }
                found
            }
            _ => {
                self.not_constant(expr);
                None
            }
        }
    }

    fn not_constant(&self, expr: &Expr) {
        self.report(expr.span, Facts::NotConstant { text: self.world.text(expr.span) });
    }

    fn report(&self, span: Span, fact: Facts) {
        self.world.report(Problem::new(span, fact));
    }
}

fn is_expectation(kind: &CheckStmtKind) -> bool {
    matches!(kind, CheckStmtKind::Expect(_) | CheckStmtKind::Never(_))
}

/// What a plan sees besides its file.
fn scope<'w>() -> Scope<'w> {
    Scope::new(false, LiteralFrame::World)
}
