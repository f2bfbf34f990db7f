//! Names in scenarios.

use super::Uses;
use crate::ast::{
    EndCondition, EndStmt, Expr, ExprKind, Field, FieldValue, Ident, ItemKind, Ref, RewardUse,
    RewardUseKind, ScenarioItem, ScenarioStmt, ScenarioStmtKind, Span,
};
use crate::resolve::{Flat, arg_name, flatten, last_part, quoted};
use crate::source::FileId;

impl<'a> Uses<'a> {
    /// A scenario with what it inherits; `None` once that would cost too much.
    fn flat(&self, item: &'a ScenarioItem) -> Option<Flat<'a>> {
        if self.effort.is_spent() {
            return None;
        }
        let flat = flatten(self.library, item, &mut Vec::new());
        self.effort.spend(flat.size());
        Some(flat)
    }

    pub(super) fn scenario(&mut self, item: &'a ScenarioItem) {
        self.declare(&item.name);
        let Some(flat) = self.flat(item) else { return };
        let levels: Vec<&'a ScenarioItem> =
            flat.parents.iter().copied().chain(std::iter::once(item)).collect();
        self.late_rewards(&flat);
        self.scenario = Some(flat);
        for level in levels {
            self.level_players(level);
        }
        if let Some(parent) = &item.extends {
            let _ = self.found(&parent.name);
            self.arguments(parent, self.scenario.as_ref().map(params).unwrap_or_default());
        }
        self.params(&item.params);
        item.body.iter().for_each(|stmt| self.stmt(stmt, item));
    }

    /// Makes the players known that a scenario of the chain has: those of the formations that it
    /// names, then its own.
    fn level_players(&mut self, level: &'a ScenarioItem) {
        let outer = std::mem::replace(&mut self.is_silent, true);
        self.reached.clear();
        for stmt in &level.body {
            match &stmt.kind {
                ScenarioStmtKind::Team { body, .. } => {
                    for stmt in body {
                        self.team_stmt(stmt);
                    }
                }
                ScenarioStmtKind::Kickoff { fields, .. } => self.fields(fields),
                ScenarioStmtKind::Let(it) | ScenarioStmtKind::Const(it) => self.expr(&it.value),
                _ => {}
            }
        }
        self.is_silent = outer;
        for formation in std::mem::take(&mut self.reached) {
            self.players_of(formation);
        }
        for stmt in &level.body {
            if let ScenarioStmtKind::Team { body, .. } = &stmt.kind {
                self.named_players(body);
            }
        }
    }

    /// A parent's `reward NAME` means what the file of the child sees first: the two are one.
    fn late_rewards(&self, flat: &Flat<'a>) {
        for (_, used, _) in &flat.rewards {
            let RewardUseKind::Named(named) = &used.what else { continue };
            let (file, name) = (named.name.span.file, &named.name.node);
            let (own, theirs) = (self.library.find(FileId(0), name), self.library.find(file, name));
            if let (Some(own), Some(theirs)) = (own, theirs)
                && file != FileId(0)
                && own.name.span != theirs.name.span
                && matches!(own.item.kind, ItemKind::Reward(_))
            {
                self.relate(own.name.span, theirs.name.span);
            }
        }
    }

    /// Arguments by the names of a scenario's parameters.
    pub(super) fn arguments(&mut self, reference: &'a Ref, params: Vec<(&'a str, Span)>) {
        for arg in &reference.args {
            if let (Some(key), Some(name)) = (&arg.key, arg_name(arg))
                && let Some((_, at)) = params.iter().find(|(known, _)| *known == name)
            {
                self.refer(key.span, *at);
            }
            self.expr(&arg.value);
        }
    }

    /// A scenario that is played, with arguments.
    pub(super) fn played(&mut self, reference: &'a Ref) -> Option<Flat<'a>> {
        let item = self.found(&reference.name);
        let flat = match item.map(|item| &item.kind) {
            Some(ItemKind::Scenario(scenario)) => self.flat(scenario),
            _ => None,
        };
        self.arguments(reference, flat.as_ref().map(params).unwrap_or_default());
        flat
    }

    fn stmt(&mut self, stmt: &'a ScenarioStmt, item: &'a ScenarioItem) {
        match &stmt.kind {
            ScenarioStmtKind::Param(param) => self.params(std::slice::from_ref(param)),
            ScenarioStmtKind::Let(it)
            | ScenarioStmtKind::Const(it)
            | ScenarioStmtKind::Record(it) => self.binding(it),
            ScenarioStmtKind::LetTuple { names, value } => {
                for name in names {
                    self.declare(name);
                }
                self.expr(value);
            }
            ScenarioStmtKind::Region(region) => {
                self.declare(&region.name);
                self.function(region);
            }
            ScenarioStmtKind::Rules(fields)
            | ScenarioStmtKind::World(fields)
            | ScenarioStmtKind::Pitch(fields) => self.fields(fields),
            ScenarioStmtKind::Agents(fields) => fields.iter().for_each(|it| self.agents(it)),
            ScenarioStmtKind::Ball(ball) => {
                self.place(&ball.place);
                self.exprs(&ball.jitter);
                self.fields(&ball.fields);
            }
            ScenarioStmtKind::Team { body, .. } => {
                for stmt in body {
                    self.team_stmt(stmt);
                }
            }
            ScenarioStmtKind::Kickoff { first, fields } => {
                self.expr(first);
                self.fields(fields);
            }
            ScenarioStmtKind::Start { team, at, fields, .. } => {
                self.exprs(team.iter().chain(at));
                self.fields(fields);
            }
            ScenarioStmtKind::Reward(used) => self.reward(used),
            ScenarioStmtKind::End(end) => self.end(end),
            ScenarioStmtKind::Require { condition, probability, label } => {
                self.expr(condition);
                self.exprs(probability);
                label.iter().filter_map(quoted).for_each(|at| self.declare_at(at));
            }
            ScenarioStmtKind::Remove { what, name: Some(name) } => self.remove(what, name, item),
            ScenarioStmtKind::Rounds(rounds) => self.exprs([&rounds.count, &rounds.when]),
            ScenarioStmtKind::Substitute(it) => {
                self.exprs([&it.who, &it.when]);
                self.fields(&it.fields);
            }
            ScenarioStmtKind::Observe(lines) => {
                for it in lines {
                    self.expr(&it.value);
                    let more = [&it.noise, &it.when, &it.delay, &it.stack];
                    self.exprs(more.into_iter().flatten());
                }
            }
            ScenarioStmtKind::Remove { .. }
            | ScenarioStmtKind::Mirror(_)
            | ScenarioStmtKind::Broken => {}
        }
    }

    /// `left: [carrier]`
    fn agents(&mut self, field: &'a Field) {
        let FieldValue::Expr(expr) = &field.value else { return };
        match (field.key.node.as_str(), &expr.kind) {
            ("left" | "right", ExprKind::List(names)) => {
                for Expr { span, kind } in names {
                    if let ExprKind::Name(name) = kind {
                        self.player_name(name, *span);
                    }
                }
            }
            ("left" | "right", ExprKind::Name(name)) if name == "all" => {}
            ("left" | "right", _) => self.expr(expr),
            _ => {}
        }
    }

    fn reward(&mut self, used: &'a RewardUse) {
        used.label.iter().filter_map(quoted).for_each(|at| self.declare_at(at));
        self.exprs(&used.audience);
        self.exprs(&used.weight);
        match &used.what {
            RewardUseKind::Named(named) => self.reference(named),
            RewardUseKind::Inline { name, body } => {
                self.declare(name);
                self.reward_body(body);
            }
            RewardUseKind::Script { script, .. } => self.script(script),
        }
    }

    fn end(&mut self, end: &'a EndStmt) {
        let (label, condition) = match end {
            EndStmt::Limit(limit) => return self.expr(limit),
            EndStmt::When { label, condition, .. } => (label, condition),
        };
        match (label, condition) {
            (Some(label), None) => self.reference(label),
            (Some(label), Some(_)) => self.declare_at(last_part(label)),
            (None, _) => {}
        }
        match condition {
            Some(EndCondition::Expr(condition)) => self.expr(condition),
            Some(EndCondition::Script(script)) => self.script(script),
            None => {}
        }
    }

    /// `remove reward NAME`: what the parents have of this name.
    fn remove(&mut self, what: &Ident, name: &Ident, item: &'a ScenarioItem) {
        let parent = item.extends.as_ref().and_then(|parent| {
            let found = self.library.find(parent.name.span.file, &parent.name.node)?;
            match &found.item.kind {
                ItemKind::Scenario(scenario) => self.flat(scenario),
                _ => None,
            }
        });
        let Some(flat) = parent else { return };
        let labelled = |stmt: &&ScenarioStmt| match &stmt.kind {
            ScenarioStmtKind::Require { label: Some(label), .. } if label.node == name.node => {
                quoted(label)
            }
            _ => None,
        };
        let known = match what.node.as_str() {
            "reward" => self.reward_of(&flat, &name.node),
            "record" => record_of(&flat, &name.node),
            "end" => self.ending_of(&flat, &name.node),
            "substitute" => self.players.get(name.node.as_str()).copied(),
            "require" => flat.requires.iter().find_map(labelled),
            _ => None,
        };
        if let Some(known) = known {
            self.refer(name.span, known);
        }
    }
}

/// The parameters of a scenario.
fn params<'a>(flat: &Flat<'a>) -> Vec<(&'a str, Span)> {
    let known = flat.params.iter().map(|it| &it.decl.name);
    known.map(|name| (name.node.as_str(), name.span)).collect()
}

/// Where a record of a scenario is declared.
pub(super) fn record_of(flat: &Flat<'_>, name: &str) -> Option<Span> {
    flat.records.iter().find(|known| known.name.node == name).map(|known| known.name.span)
}
