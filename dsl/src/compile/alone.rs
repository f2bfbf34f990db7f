//! What is wrong with items of the root that nothing uses.

use super::{Compilation, nothing};
use crate::ast::{
    Expr, ExprKind, Field, FieldValue, FormationItem, Item, ItemKind, ScenarioItem, ScenarioStmt,
    ScenarioStmtKind, Spanned, TeamStmt, TeamStmtKind,
};
use crate::lower::mirror::Mirror;
use crate::lower::{World, alone, start};
use crate::problem::{Code, Problem};
use crate::resolve::flatten;

impl<'a> Compilation<'a> {
    /// Checks what no scenario or plan has lowered, in a scenario that says nothing.
    pub(super) fn alone(&mut self, items: &'a [Item], nothing: &'a ScenarioItem) {
        let has_scenario = items.iter().any(|item| matches!(item.kind, ItemKind::Scenario(_)));
        let unused: Vec<&Item> = items
            .iter()
            .filter(|item| match &item.kind {
                ItemKind::Const(binding) => !self.unused.is_used(binding.name.span),
                ItemKind::Fn(item) | ItemKind::Region(item) | ItemKind::Ending(item) => {
                    !self.unused.is_used(item.name.span)
                }
                ItemKind::Table(item) => !self.unused.is_used(item.name.span),
                ItemKind::Formation(item) => !self.unused.is_used(item.name.span),
                // Every scenario lowers those that it can, used or not.
                ItemKind::Behavior(item) => !has_scenario && !self.unused.is_used(item.name.span),
                ItemKind::Reward(item) => {
                    let is_lowered = item.params.iter().all(|param| param.default.is_some());
                    !(self.unused.is_used(item.name.span) || has_scenario && is_lowered)
                }
                _ => false,
            })
            .collect();
        if unused.is_empty() {
            return;
        }
        let flat = flatten(self.library, nothing, &mut Vec::new());
        let world = World::new(self.library, &flat, Mirror::Off, &[], self.scripts, self.effort);
        let lowered = world.tentatively(|| start::lower_start(&world, false));
        for item in unused {
            if self.effort.is_spent() {
                return;
            }
            match &item.kind {
                ItemKind::Formation(formation) => self.formation(formation),
                _ => self.problems.extend(alone::check_alone(&lowered.step, item)),
            }
        }
    }

    /// Checks a formation as the one of a team.
    fn formation(&mut self, formation: &FormationItem) {
        let span = formation.name.span;
        let key = Spanned { node: "formation".to_owned(), span };
        let value = Expr { span, kind: ExprKind::Name(formation.name.node.clone()) };
        let field = Field { key, value: FieldValue::Expr(value) };
        let body = vec![TeamStmt { span, kind: TeamStmtKind::Field(field) }];
        let team = Spanned { node: "left".to_owned(), span };
        let kind = ScenarioStmtKind::Team { team, body };
        let mut user = nothing();
        user.body = vec![ScenarioStmt { doc: String::new(), span, kind }];

        let mut found = Vec::new();
        let flat = flatten(self.library, &user, &mut found);
        let world = World::new(self.library, &flat, Mirror::Off, &[], self.scripts, self.effort);
        drop(start::lower_start(&world, false));
        found.extend(world.problems.take());
        // What is wrong at the name is wrong with the user alone: it hands nothing in. How many
        // play is the team's affair, too: it may declare some of them absent.
        let is_own = |problem: &Problem| {
            problem.is_error()
                && !problem.code().may_be_echo()
                && problem.code() != Code::TooManyPlayers
                && problem.place() != span
        };
        let empty = nothing().name.span;
        found.retain(|problem| is_own(problem) && problem.place() != empty);
        self.problems.extend(found);
    }
}
