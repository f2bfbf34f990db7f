//! A scenario with everything it inherits, as one list of parts.
//!
//! Root first. A child's `ball`, `limit`, player list, and whatever bears the same name replace the
//! parent's; fields merge key by key; unnamed endings, requirements and new rewards are added;
//! `remove` acts on the parents' result.

mod names;
mod remove;
mod team;

use super::load::{Library, distinct_params};
use super::parts::chain;
use crate::ast::{
    Arg, BallStmt, Binding, EndStmt, Expr, Field, FnItem, Ident, ItemKind, Observed, ParamDecl,
    PlayerStmt, Ref, RewardUse, RewardUseKind, Rounds, ScenarioItem, ScenarioStmt,
    ScenarioStmtKind, Span, Spanned, Substitute,
};
use crate::problem::facts::{Calls, Names, Types};
use crate::problem::{Guess, Problem};
pub(crate) use names::{ending_declaration, last_part, quoted, reward_declaration, reward_name};
use setpiece_scenario::vocabulary::Role;
use std::collections::btree_map::Entry;
use std::collections::{BTreeMap, BTreeSet};

/// A scenario with everything it inherits.
pub(crate) struct Flat<'a> {
    /// The scenario itself.
    pub(crate) item: &'a ScenarioItem,
    /// Parameters, parents' first.
    pub(crate) params: Vec<FlatParam<'a>>,
    /// `let`s, parents' first.
    pub(crate) lets: Vec<&'a Binding>,
    /// `const`s of the body.
    pub(crate) consts: Vec<&'a Binding>,
    /// Regions of the body.
    pub(crate) regions: Vec<&'a FnItem>,
    /// `rules { }`
    pub(crate) rules: Vec<&'a Field>,
    /// `world { }`
    pub(crate) world: Vec<&'a Field>,
    /// `pitch { }`
    pub(crate) pitch: Vec<&'a Field>,
    /// `agents { }`
    pub(crate) agents: Vec<&'a Field>,
    /// The ball.
    pub(crate) ball: Option<(&'a BallStmt, Span)>,
    /// Left and right.
    pub(crate) teams: [FlatTeam<'a>; 2],
    /// `kickoff`: who is first, and the layouts.
    pub(crate) kickoff: Option<(&'a Expr, &'a [Field], Span)>,
    /// `start …`
    pub(crate) start: Option<&'a ScenarioStmt>,
    /// Rewards, with the name each is known by.
    pub(crate) rewards: Vec<(String, &'a RewardUse, &'a ScenarioStmt)>,
    /// Endings but for the limit.
    pub(crate) ends: Vec<FlatEnding<'a>>,
    /// `end limit`
    pub(crate) limit: Option<(&'a Expr, Span)>,
    /// `rounds …`
    pub(crate) rounds: Option<(&'a Rounds, Span)>,
    /// `substitute …`
    pub(crate) substitutes: Vec<&'a Substitute>,
    /// Requirements.
    pub(crate) requires: Vec<&'a ScenarioStmt>,
    /// Records.
    pub(crate) records: Vec<&'a Binding>,
    /// `observe vector { … }`
    pub(crate) observed: Option<(&'a [Observed], Span)>,
    /// `let (a, b) = shuffle(…)`
    pub(crate) tuples: Vec<(&'a [Ident], &'a Expr)>,
    /// `mirror: flanks`
    pub(crate) mirror: Option<&'a Ident>,
    /// What it extends, the root first.
    pub(crate) parents: Vec<&'a ScenarioItem>,
    /// Where the values that have a name stand.
    names: BTreeMap<&'a str, Named>,
}

/// The list of a [`Flat`] in which a value stands, and its place there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Named {
    /// In `params`.
    Param(usize),
    /// In `lets`.
    Let(usize),
    /// In `tuples`, and which of its names.
    Tuple(usize, usize),
    /// In `consts`.
    Const(usize),
    /// In `regions`.
    Region(usize),
}

impl<'a> Flat<'a> {
    /// The value of a name; parameters hide `let`s, and so on in the order of [`Named`].
    pub(crate) fn named(&self, name: &str) -> Option<Named> {
        self.names.get(name).copied()
    }

    /// Notes where every name stands.
    fn index(&mut self) {
        let params =
            self.params.iter().enumerate().map(|(at, param)| (&param.decl.name, Named::Param(at)));
        let lets =
            self.lets.iter().enumerate().map(|(at, binding)| (&binding.name, Named::Let(at)));
        let tuples = self.tuples.iter().enumerate().flat_map(|(at, (names, _))| {
            names.iter().enumerate().map(move |(index, name)| (name, Named::Tuple(at, index)))
        });
        let consts =
            self.consts.iter().enumerate().map(|(at, binding)| (&binding.name, Named::Const(at)));
        let regions =
            self.regions.iter().enumerate().map(|(at, region)| (&region.name, Named::Region(at)));
        let mut names: BTreeMap<&'a str, Named> = BTreeMap::new();
        for (name, at) in params.chain(lets).chain(tuples).chain(consts).chain(regions) {
            names.entry(&name.node).or_insert(at);
        }
        self.names = names;
    }

    /// How many parts it has: what going through it costs.
    pub(crate) fn size(&self) -> usize {
        let bodies = self.parents.iter().map(|parent| parent.body.len() + parent.params.len());
        bodies.sum::<usize>() + self.item.body.len() + self.item.params.len()
    }

    /// Whether a part stands in the scenario itself, not in one that it extends.
    pub(crate) fn is_own(&self, part: Span) -> bool {
        holds(self.item, part)
    }

    /// Whether a part stands in a scenario that it extends.
    pub(crate) fn is_inherited(&self, part: Span) -> bool {
        self.parents.iter().any(|parent| holds(parent, part))
    }
}

fn holds(item: &ScenarioItem, part: Span) -> bool {
    item.body
        .iter()
        .map(|stmt| stmt.span)
        .chain(item.params.iter().map(|param| param.span))
        .any(|own| own.holds(part))
}

/// A parameter: its declaration, and the argument or newer default that stands for the declared
/// one.
#[derive(Clone, Copy)]
pub(crate) struct FlatParam<'a> {
    /// Where it was first declared.
    pub(crate) decl: &'a ParamDecl,
    /// A newer default.
    pub(crate) value: Option<&'a Expr>,
    /// A newer domain.
    pub(crate) domain: Option<&'a crate::ast::Domain>,
    /// Whether `value` is an argument of `extends`, which may be drawn or computed.
    pub(crate) is_argument: bool,
}

/// A team.
#[derive(Clone, Default)]
pub(crate) struct FlatTeam<'a> {
    /// `difficulty`, `formation`.
    pub(crate) fields: Vec<&'a Field>,
    /// Explicit players.
    pub(crate) players: Vec<(&'a PlayerStmt, Span)>,
    /// `place …`
    pub(crate) overrides: Vec<(&'a Ident, &'a PlayerStmt)>,
    /// `each …`
    pub(crate) each: Vec<(&'a Ident, &'a [Field])>,
    /// `GK absent`
    pub(crate) absent: Vec<Spanned<Role>>,
    /// Options of a parent that a child writes again: the parent's and the child's.
    pub(crate) rewritten: Vec<(&'a Field, &'a Field)>,
    /// The names of a parent's players that a child's own players replace, and the first of these.
    pub(crate) replaced: Vec<(&'a str, Span)>,
}

/// An ending.
pub(crate) struct FlatEnding<'a> {
    /// `success` or `failure`.
    pub(crate) verdict: Option<&'a Ident>,
    /// Its label, or a named `ending`.
    pub(crate) label: Option<&'a Ref>,
    /// What ends it.
    pub(crate) condition: Option<&'a crate::ast::EndCondition>,
    /// Its span.
    pub(crate) span: Span,
}

/// Collects what a scenario says and inherits.
pub(crate) fn flatten<'a>(
    library: &'a Library,
    item: &'a ScenarioItem,
    problems: &mut Vec<Problem>,
) -> Flat<'a> {
    let links = chain(
        library,
        item,
        "scenario",
        |item| item.extends.as_ref(),
        |kind| match kind {
            ItemKind::Scenario(scenario) => Some(scenario),
            _ => None,
        },
        problems,
    );
    let mut flat = Flat {
        item,
        params: Vec::new(),
        lets: Vec::new(),
        consts: Vec::new(),
        regions: Vec::new(),
        rules: Vec::new(),
        world: Vec::new(),
        pitch: Vec::new(),
        agents: Vec::new(),
        ball: None,
        teams: Default::default(),
        kickoff: None,
        start: None,
        rewards: Vec::new(),
        ends: Vec::new(),
        limit: None,
        rounds: None,
        substitutes: Vec::new(),
        requires: Vec::new(),
        records: Vec::new(),
        observed: None,
        tuples: Vec::new(),
        mirror: None,
        names: BTreeMap::new(),
        parents: links
            .iter()
            .map(|(parent, _)| *parent)
            .filter(|parent| !std::ptr::eq(*parent, item))
            .collect(),
    };
    let mut known = BTreeSet::new();
    let mut declared = BTreeMap::new();
    for (level, (scenario, _)) in links.iter().enumerate() {
        let own = BTreeMap::new();
        let mut adding = Adding {
            library,
            flat: &mut flat,
            problems,
            is_child: level > 0,
            own,
            known: &mut known,
            declared: &mut declared,
        };
        adding.removals(&scenario.body);
        adding.begin_teams(&scenario.body);
        for param in &scenario.params {
            adding.param(param);
        }
        for stmt in &scenario.body {
            adding.stmt(stmt);
        }
        // The reference by which the next child names this one carries its arguments.
        if let Some((_, Some(reference))) =
            links.get(level).filter(|(_, reference)| reference.is_some())
        {
            adding.arguments(reference);
        }
    }
    flat.index();
    flat
}

struct Adding<'a, 'f> {
    library: &'a Library,
    flat: &'f mut Flat<'a>,
    problems: &'f mut Vec<Problem>,
    is_child: bool,
    /// Names that this scenario has declared itself.
    own: BTreeMap<(&'static str, String), Span>,
    /// What any of the parents has ever named: most names are new, and needn't be looked for.
    known: &'f mut BTreeSet<(&'static str, &'a str)>,
    /// Where a scenario of the chain was the first to declare a value, record, reward or ending.
    declared: &'f mut BTreeMap<(&'static str, String), Span>,
}

impl<'a> Adding<'a, '_> {
    /// The fields of a block whose keys replace the parents', one by one.
    fn merge(
        &mut self,
        block: &'static str,
        fields: &'a [Field],
        list: for<'f> fn(&'f mut Flat<'a>) -> &'f mut Vec<&'a Field>,
    ) {
        for field in fields {
            self.key_once(block, &field.key);
            let is_new = self.known.insert((block, &field.key.node));
            replace(list(self.flat), field, is_new, |f| &f.key.node);
        }
    }

    fn stmt(&mut self, stmt: &'a ScenarioStmt) {
        match &stmt.kind {
            ScenarioStmtKind::Param(param) => self.param(param),
            ScenarioStmtKind::Let(binding) => {
                self.declare(&binding.name);
                let is_new = self.known.insert(("let", &binding.name.node));
                replace(&mut self.flat.lets, binding, is_new, |b| &b.name.node);
            }
            ScenarioStmtKind::Const(binding) => {
                self.declare(&binding.name);
                let is_new = self.known.insert(("const", &binding.name.node));
                replace(&mut self.flat.consts, binding, is_new, |b| &b.name.node);
            }
            ScenarioStmtKind::Region(region) => {
                self.declare(&region.name);
                distinct_params(&region.params, self.problems);
                let is_new = self.known.insert(("region", &region.name.node));
                replace(&mut self.flat.regions, region, is_new, |r| &r.name.node);
            }
            ScenarioStmtKind::Rules(fields) => self.merge("rules", fields, |flat| &mut flat.rules),
            ScenarioStmtKind::World(fields) => self.merge("world", fields, |flat| &mut flat.world),
            ScenarioStmtKind::Pitch(fields) => self.merge("pitch", fields, |flat| &mut flat.pitch),
            ScenarioStmtKind::Agents(fields) => {
                self.merge("agents", fields, |flat| &mut flat.agents);
            }
            ScenarioStmtKind::Ball(ball) => {
                self.only_once("the ball", stmt.span);
                self.flat.ball = Some((ball, stmt.span));
            }
            ScenarioStmtKind::Team { team, body } => self.team(team, body),
            ScenarioStmtKind::Kickoff { first, fields } => {
                self.only_once("`kickoff`", stmt.span);
                for team in &mut self.flat.teams {
                    team.players.clear();
                    team.fields.retain(|field| field.key.node != "formation");
                }
                self.flat.kickoff = Some((first, fields, stmt.span));
            }
            ScenarioStmtKind::Start { .. } => {
                self.only_once("`start`", stmt.span);
                self.flat.start = Some(stmt);
            }
            ScenarioStmtKind::Reward(reward) => self.reward(reward, stmt),
            ScenarioStmtKind::End(end) => self.end(end, stmt.span),
            ScenarioStmtKind::Require { .. } => self.flat.requires.push(stmt),
            ScenarioStmtKind::LetTuple { names, value } => {
                for name in names {
                    self.declare(name);
                    self.flat.lets.retain(|known| known.name.node != name.node);
                }
                let redeclared = |known: &[Ident]| {
                    known.iter().any(|one| names.iter().any(|n| n.node == one.node))
                };
                self.flat.tuples.retain(|(known, _)| !redeclared(known));
                self.flat.tuples.push((names, value));
            }
            ScenarioStmtKind::Record(binding) => self.record(binding),
            ScenarioStmtKind::Substitute(substitute) => self.flat.substitutes.push(substitute),
            ScenarioStmtKind::Rounds(rounds) => {
                self.only_once("`rounds`", stmt.span);
                self.flat.rounds = Some((rounds, stmt.span));
            }
            ScenarioStmtKind::Mirror(kind) => {
                self.only_once("`mirror`", stmt.span);
                self.flat.mirror = Some(kind);
            }
            ScenarioStmtKind::Observe(observed) => {
                self.only_once("`observe vector`", stmt.span);
                self.flat.observed = Some((observed, stmt.span));
            }
            ScenarioStmtKind::Remove { .. } | ScenarioStmtKind::Broken => {}
        }
    }

    /// Records have names of their own: they stand apart from values.
    fn record(&mut self, binding: &'a Binding) {
        let name = &binding.name;
        self.relate("record", &name.node, name.span);
        if let Some(first) = self.earlier("record", &name.node, name.span) {
            self.problems.push(Problem::new(
                name.span,
                Names::DeclaredTwice {
                    what: format!("record `{}`", name.node),
                    first: Some(first),
                },
            ));
            return;
        }
        let is_new = self.known.insert(("record", &name.node));
        replace(&mut self.flat.records, binding, is_new, |known| &known.name.node);
    }

    /// Where this scenario has named such a thing so before; else notes that it does here.
    fn earlier(&mut self, kind: &'static str, name: &str, span: Span) -> Option<Span> {
        match self.own.entry((kind, name.to_owned())) {
            Entry::Occupied(first) => Some(*first.get()),
            Entry::Vacant(free) => {
                free.insert(span);
                None
            }
        }
    }

    /// Declares a name that expressions may use.
    fn declare(&mut self, name: &'a Ident) {
        self.relate("value", &name.node, name.span);
        if let Some(first) = self.earlier("value", &name.node, name.span) {
            self.problems.push(Problem::new(
                name.span,
                Names::DeclaredTwice { what: format!("`{}`", name.node), first: Some(first) },
            ));
        }
    }

    fn only_once(&mut self, what: &'static str, span: Span) {
        if let Some(first) = self.earlier(what, "", span) {
            self.problems
                .push(Problem::new(span, Names::GivenTwice { what: what.to_owned(), first }));
        }
    }

    /// A key of a group that may be written in several pairs of braces.
    fn key_once(&mut self, group: &'static str, key: &Ident) {
        if let Some(first) = self.earlier(group, &key.node, key.span) {
            self.problems.push(Problem::new(
                key.span,
                Names::GivenTwice { what: format!("`{}`", key.node), first },
            ));
        }
    }

    fn param(&mut self, param: &'a ParamDecl) {
        self.declare(&param.name);
        let is_new = self.known.insert(("param", &param.name.node));
        let mut params = self.flat.params.iter_mut();
        let known = params.find(|known| !is_new && known.decl.name.node == param.name.node);
        match known {
            Some(known) if self.is_child => {
                let same = match (&param.ty, &known.decl.ty) {
                    (Some(new), Some(old)) => new.node == old.node,
                    _ => true,
                };
                if same {
                    if param.default.is_some() {
                        known.value = param.default.as_ref();
                        known.is_argument = false;
                    }
                    known.domain = param.domain.as_ref().or(known.domain);
                } else if let Some(ty) = &param.ty {
                    self.problems.push(Problem::new(
                        ty.span,
                        Types::OtherTypeInParent {
                            name: param.name.node.clone(),
                            parent: known.decl.span,
                        },
                    ));
                }
            }
            Some(_) => {}
            None => self.flat.params.push(FlatParam {
                decl: param,
                value: param.default.as_ref(),
                domain: param.domain.as_ref(),
                is_argument: false,
            }),
        }
    }

    fn arguments(&mut self, reference: &'a Ref) {
        let mut given: BTreeMap<&str, Span> = BTreeMap::new();
        let params = self.flat.params.iter().enumerate();
        let places: BTreeMap<&str, usize> =
            params.rev().map(|(at, param)| (param.decl.name.node.as_str(), at)).collect();
        for arg in &reference.args {
            let Some(name) = arg_name(arg) else {
                self.problems.push(Problem::new(
                    arg.span,
                    Calls::ByName { callee: reference.name.node.clone() },
                ));
                continue;
            };
            if let Some(first) = given.get(name) {
                self.problems.push(Problem::new(
                    arg.span,
                    Calls::GivenTwice { parameter: name.to_owned(), first: *first },
                ));
                continue;
            }
            given.insert(name, arg.span);
            if let Some(param) = places.get(name).and_then(|at| self.flat.params.get_mut(*at)) {
                param.value = Some(&arg.value);
                param.is_argument = true;
                continue;
            }
            let known = places.keys().copied();
            let span = arg.key.as_ref().map_or(arg.span, |key| key.span);
            let (parent, guess) = (reference.name.node.clone(), Guess::of(name, known));
            self.problems.push(Problem::new(
                span,
                Names::NoParentParameter { parent, name: name.to_owned(), guess },
            ));
        }
    }

    fn reward(&mut self, reward: &'a RewardUse, stmt: &'a ScenarioStmt) {
        let name = reward_name(reward);
        if let Some(at) = reward_declaration(self.library, reward) {
            self.relate("reward", &name, at);
        }
        let known = self.flat.rewards.iter().position(|(known, _, _)| *known == name);
        if let Some(first) = self.earlier("reward", &name, stmt.span) {
            let what = match &reward.what {
                RewardUseKind::Named(named) => named.name.node.as_str(),
                RewardUseKind::Inline { name, .. } => name.node.as_str(),
                RewardUseKind::Script { .. } => "script …",
            };
            self.problems.push(Problem::new(
                stmt.span,
                Names::RewardTwice { name: name.clone(), what: what.to_owned(), first },
            ));
            return;
        }
        match known.and_then(|at| self.flat.rewards.get_mut(at)) {
            Some(slot) => *slot = (name, reward, stmt),
            None => self.flat.rewards.push((name, reward, stmt)),
        }
    }

    fn end(&mut self, end: &'a EndStmt, span: Span) {
        let (verdict, label, condition) = match end {
            EndStmt::Limit(limit) => {
                self.only_once("`end limit`", span);
                self.flat.limit = Some((limit, span));
                return;
            }
            EndStmt::When { verdict, label, condition } => (verdict, label, condition),
        };
        let ending = FlatEnding {
            verdict: verdict.as_ref(),
            label: label.as_ref(),
            condition: condition.as_ref(),
            span,
        };
        let Some(label) = label else {
            self.flat.ends.push(ending);
            return;
        };
        let name = label.bare();
        if let Some(at) = ending_declaration(self.library, label, condition.is_some()) {
            self.relate("end", name, at);
        }
        if let Some(first) = self.earlier("end", name, span) {
            self.problems.push(Problem::new(
                label.name.span,
                Names::EndingTwice { name: name.to_owned(), first },
            ));
            return;
        }
        let known = self
            .flat
            .ends
            .iter_mut()
            .find(|known| known.label.is_some_and(|known| known.bare() == name));
        match known {
            Some(slot) => *slot = ending,
            None => self.flat.ends.push(ending),
        }
    }
}

/// The name of a named argument.
pub(crate) fn arg_name(arg: &Arg) -> Option<&str> {
    match &arg.key.as_ref()?.kind {
        crate::ast::ExprKind::Name(name) => Some(name),
        _ => None,
    }
}

/// Puts a part in the place of one of its name, or behind all; `is_new`: none has its name.
fn replace<'a, T>(list: &mut Vec<&'a T>, new: &'a T, is_new: bool, name: impl Fn(&T) -> &str) {
    match list.iter_mut().find(|known| !is_new && name(known) == name(new)) {
        Some(slot) => *slot = new,
        None => list.push(new),
    }
}
