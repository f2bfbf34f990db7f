//! The statements of a team, merged with those it inherits.

use super::{Adding, replace};
use crate::ast::{Field, Ident, ScenarioStmt, ScenarioStmtKind, TeamStmt, TeamStmtKind};
use crate::problem::facts::{Kind, Names, Players};
use crate::problem::{Guess, Problem};
use setpiece_scenario::vocabulary::Team;

impl<'a> Adding<'a, '_> {
    /// A team's players are replaced as soon as the child writes any of them.
    pub(super) fn begin_teams(&mut self, body: &[ScenarioStmt]) {
        for stmt in body {
            let ScenarioStmtKind::Team { team, body } = &stmt.kind else { continue };
            let Some(team) = Team::from_name(&team.node) else { continue };
            let writes = |stmt: &TeamStmt| match &stmt.kind {
                TeamStmtKind::Player(_) => true,
                TeamStmtKind::Field(field) => field.key.node == "formation",
                _ => false,
            };
            if let Some(first) = body.iter().find(|stmt| writes(stmt)) {
                self.flat.kickoff = None;
                if let Some(team) = self.flat.teams.get_mut(team.index()) {
                    let names =
                        team.players.drain(..).filter_map(|(player, _)| player.name.as_ref());
                    team.replaced.extend(names.map(|name| (name.node.as_str(), first.span)));
                    team.overrides.clear();
                    team.absent.clear();
                    team.fields.retain(|field| field.key.node != "formation");
                }
            }
        }
    }

    pub(super) fn team(&mut self, team: &'a Ident, body: &'a [TeamStmt]) {
        let Some(index) = Team::from_name(&team.node).map(Team::index) else {
            self.problems.push(Problem::new(
                team.span,
                Names::Unknown {
                    kind: Kind::Team,
                    name: team.node.clone(),
                    guess: Guess::default(),
                },
            ));
            return;
        };
        for stmt in body {
            let TeamStmtKind::Absent(role) = &stmt.kind else { continue };
            let placed = body.iter().find(|other| match &other.kind {
                TeamStmtKind::Player(player) => player.role.node == role.node,
                _ => false,
            });
            if let Some(placed) = placed {
                self.problems.push(Problem::new(
                    role.span,
                    Players::AbsentAndPlaced { role: role.node.to_string(), placed: placed.span },
                ));
            }
        }
        for stmt in body {
            if let TeamStmtKind::Field(field) = &stmt.kind {
                self.key_once(if index == 0 { "team left" } else { "team right" }, &field.key);
            }
            let Some(flat) = self.flat.teams.get_mut(index) else { return };
            match &stmt.kind {
                TeamStmtKind::Player(player) => flat.players.push((player, stmt.span)),
                TeamStmtKind::Override { who, change } => {
                    flat.overrides.retain(|(known, _)| known.node != who.node);
                    flat.overrides.push((who, change));
                }
                TeamStmtKind::Each { who, fields } => flat.each.push((who, fields)),
                TeamStmtKind::Absent(role) => flat.absent.push(role.clone()),
                TeamStmtKind::Field(field) => {
                    let same = |known: &&&Field| known.key.node == field.key.node;
                    let known = flat.fields.iter().find(same).copied();
                    flat.rewritten.extend(known.map(|known| (known, field)));
                    replace(&mut flat.fields, field, false, |field| &field.key.node);
                }
                TeamStmtKind::Broken => {}
            }
        }
    }
}
