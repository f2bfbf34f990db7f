//! Names in rewards, behaviours and formations.

use super::Uses;
use super::expr::{ArgumentKeys, path_of};
use crate::ast::{
    BehaviorBody, BehaviorItem, BehaviorStmt, BehaviorStmtKind, DoStmt, DoWhat, Expr, ExprKind,
    Field, FieldValue, FormationItem, GiveStmt, GiveValue, Ident, ItemKind, Place, PlaceKind,
    PlayerStmt, Ref, RepeatHow, RewardItem, RewardStmt, RewardStmtKind, Span, TeamStmt,
    TeamStmtKind,
};
use crate::resolve::{formation_chain, reward_chain};
use setpiece_scenario::vocabulary::Primitive;

impl<'a> Uses<'a> {
    /// An item by its name, with arguments by the names of its parameters.
    pub(super) fn reference(&mut self, reference: &'a Ref) {
        let found = self.found(&reference.name);
        let keys =
            found.map_or(ArgumentKeys::Words, |item| ArgumentKeys::Params(item.kind.params()));
        self.args(&reference.args, keys);
    }

    pub(super) fn reward_item(&mut self, item: &'a RewardItem) {
        self.declare(&item.name);
        item.extends.iter().for_each(|parent| self.reference(parent));
        self.params(&item.params);
        for (link, _) in reward_chain(self.library, item, &mut Vec::new()) {
            for param in &link.params {
                let (name, at) = (param.name.node.as_str(), param.name.span);
                if let Some((_, earlier)) = self.locals.iter().find(|(known, _)| *known == name) {
                    self.relate(at, *earlier);
                }
                self.locals.push((name, at));
            }
            if std::ptr::eq(link, item) {
                continue;
            }
            // A child sees what its parents keep.
            for stmt in &link.body {
                if let RewardStmtKind::State(it) | RewardStmtKind::Let(it) = &stmt.kind {
                    self.locals.push((&it.name.node, it.name.span));
                }
            }
        }
        self.reward_body(&item.body);
    }

    /// Statements of a reward; its states are known before the first of them.
    pub(super) fn reward_body(&mut self, body: &'a [RewardStmt]) {
        self.block(|uses| {
            for stmt in body {
                if let RewardStmtKind::State(state) = &stmt.kind {
                    uses.bind(&state.name);
                }
            }
            for stmt in body {
                uses.reward_stmt(stmt);
            }
        });
    }

    fn reward_stmt(&mut self, stmt: &'a RewardStmt) {
        let within = |uses: &mut Self, body: &'a [RewardStmt]| {
            uses.block(|uses| body.iter().for_each(|stmt| uses.reward_stmt(stmt)));
        };
        match &stmt.kind {
            RewardStmtKind::State(state) => self.expr(&state.value),
            RewardStmtKind::Let(binding) => {
                self.expr(&binding.value);
                self.bind(&binding.name);
            }
            RewardStmtKind::Give(give) => self.give(give),
            RewardStmtKind::On { events, when, body } => {
                for event in events {
                    self.event(event);
                }
                self.exprs(when);
                within(self, body);
            }
            RewardStmtKind::When { condition, then, otherwise } => {
                self.expr(condition);
                within(self, then);
                if let Some(body) = otherwise {
                    within(self, body);
                }
            }
            RewardStmtKind::Assign { name, value } => self.assign(name, value),
            RewardStmtKind::Broken => {}
        }
    }

    fn give(&mut self, give: &'a GiveStmt) {
        match &give.value {
            GiveValue::Expr(value) => self.expr(value),
            GiveValue::Script { script, .. } => self.script(script),
        }
        self.exprs(&give.to);
        give.on.iter().for_each(|event| self.event(event));
        self.exprs(&give.when);
    }

    fn assign(&mut self, name: &Ident, value: &'a Expr) {
        let state = self.locals.iter().rev().find(|(known, _)| *known == name.node);
        if let Some((_, at)) = state {
            self.refer(name.span, *at);
        }
        self.expr(value);
    }

    pub(super) fn behavior(&mut self, item: &'a BehaviorItem) {
        self.declare(&item.name);
        self.params(&item.params);
        self.locals.extend(item.params.iter().map(|it| (it.name.node.as_str(), it.name.span)));
        match &item.body {
            BehaviorBody::Script(script) => self.script(script),
            BehaviorBody::Block(body) => self.behavior_body(body),
        }
    }

    fn behavior_body(&mut self, body: &'a [BehaviorStmt]) {
        self.block(|uses| {
            for stmt in body {
                if let BehaviorStmtKind::State(state) = &stmt.kind {
                    uses.bind(&state.name);
                }
            }
            for stmt in body {
                uses.behavior_stmt(stmt);
            }
        });
    }

    fn behavior_stmt(&mut self, stmt: &'a BehaviorStmt) {
        match &stmt.kind {
            BehaviorStmtKind::State(state) => self.expr(&state.value),
            BehaviorStmtKind::Let(binding) => {
                self.expr(&binding.value);
                self.bind(&binding.name);
            }
            BehaviorStmtKind::Assign { name, value } => self.assign(name, value),
            BehaviorStmtKind::Do(act) => self.act(act),
            BehaviorStmtKind::Interrupt { condition, body } => {
                self.expr(condition);
                self.behavior_body(body);
            }
            BehaviorStmtKind::Repeat { how, body } => {
                if let RepeatHow::Until(it) | RepeatHow::Times(it) = how {
                    self.expr(it);
                }
                self.behavior_body(body);
            }
            BehaviorStmtKind::Choose(chances) => {
                for chance in chances {
                    self.expr(&chance.weight);
                    self.behavior_body(&chance.body);
                }
            }
            BehaviorStmtKind::If { arms, otherwise } => {
                for (condition, body) in arms {
                    self.expr(condition);
                    self.behavior_body(body);
                }
                self.behavior_body(otherwise);
            }
            BehaviorStmtKind::Finish | BehaviorStmtKind::Broken => {}
        }
    }

    fn act(&mut self, act: &'a DoStmt) {
        match &act.what {
            DoWhat::Named { name, args, .. } => {
                let keys = if Primitive::from_name(&name.node).is_some() {
                    ArgumentKeys::Words
                } else {
                    self.found(name)
                        .map_or(ArgumentKeys::Words, |it| ArgumentKeys::Params(it.kind.params()))
                };
                self.args(args, keys);
            }
            DoWhat::Script(script) => self.script(script),
        }
        self.exprs(&act.until);
        self.exprs(&act.duration);
    }

    pub(super) fn formation(&mut self, item: &'a FormationItem) {
        self.declare(&item.name);
        item.extends.iter().for_each(|parent| self.reference(parent));
        self.params(&item.params);
        self.locals.extend(item.params.iter().map(|it| (it.name.node.as_str(), it.name.span)));
        self.players_of(item);
        item.body.iter().for_each(|stmt| self.team_stmt(stmt));
    }

    /// Makes the players of a formation known, its parents' included.
    pub(super) fn players_of(&mut self, item: &'a FormationItem) {
        for (link, _) in formation_chain(self.library, item, &mut Vec::new()) {
            self.named_players(&link.body);
        }
    }

    /// Makes the players of some statements known. One that had the name before stands for the same
    /// player.
    pub(super) fn named_players(&mut self, body: &'a [TeamStmt]) {
        for stmt in body {
            let TeamStmtKind::Player(PlayerStmt { name: Some(name), .. }) = &stmt.kind else {
                continue;
            };
            let known = self.players.insert(&name.node, name.span);
            if let Some(known) = known.filter(|known| *known != name.span) {
                self.relate(name.span, known);
            }
        }
    }

    pub(super) fn team_stmt(&mut self, stmt: &'a TeamStmt) {
        match &stmt.kind {
            TeamStmtKind::Player(player) => {
                player.name.iter().for_each(|name| self.declare(name));
                self.player(player);
            }
            TeamStmtKind::Override { who, change } => {
                self.player_name(&who.node, who.span);
                self.player(change);
            }
            TeamStmtKind::Each { fields, .. } => self.fields(fields),
            TeamStmtKind::Field(field) => self.field(field),
            TeamStmtKind::Absent(_) | TeamStmtKind::Broken => {}
        }
    }

    pub(super) fn player_name(&self, name: &str, at: Span) {
        if let Some(known) = self.players.get(name) {
            self.refer(at, *known);
        }
    }

    fn player(&mut self, player: &'a PlayerStmt) {
        self.exprs(&player.maybe);
        player.place.iter().for_each(|place| self.place(place));
        self.exprs(player.facing.as_ref().map(|facing| &facing.target));
        self.exprs(&player.jitter);
        self.exprs(&player.when);
        self.fields(&player.fields);
    }

    pub(super) fn place(&mut self, place: &'a Place) {
        match &place.kind {
            PlaceKind::At(it) | PlaceKind::In(it) => self.expr(it),
            PlaceKind::Relative { of, by, .. } => self.exprs([of, by]),
            PlaceKind::Between { a, b, at } => self.exprs([a, b].into_iter().chain(at)),
            PlaceKind::Beyond { of, by, from } => self.exprs([of, by, from]),
            PlaceKind::Offset { from, along, by } => self.exprs([from, along, by]),
        }
    }

    pub(super) fn fields(&mut self, fields: &'a [Field]) {
        for field in fields {
            self.field(field);
        }
    }

    fn field(&mut self, field: &'a Field) {
        match (field.key.node.as_str(), &field.value) {
            ("overlap", _) => {}
            ("ai", FieldValue::Expr(expr)) => self.ai(expr),
            (_, FieldValue::Expr(expr)) => self.expr(expr),
            (_, FieldValue::Fields(fields, _)) => self.fields(fields),
            (_, FieldValue::Script(script)) => self.script(script),
        }
    }

    /// What plays a player: a behaviour of the file, if it is no word of the language.
    fn ai(&mut self, expr: &'a Expr) {
        let (name, at, args) = match &expr.kind {
            ExprKind::Call { name, args } => (Some(name.node.clone()), name.span, args.as_slice()),
            _ => (path_of(expr), expr.span, &[][..]),
        };
        let Some(name) = name else { return };
        let is_built_in = args.is_empty() && matches!(name.as_str(), "bot" | "hold" | "lazy");
        let is_behavior = !is_built_in
            && self
                .library
                .find(at.file, &name)
                .is_some_and(|found| matches!(found.item.kind, ItemKind::Behavior(_)));
        let found = if is_behavior { self.found_at(&name, at) } else { None };
        self.args(
            args,
            found.map_or(ArgumentKeys::Words, |item| ArgumentKeys::Params(item.kind.params())),
        );
    }
}
