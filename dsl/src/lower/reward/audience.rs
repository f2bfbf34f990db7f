//! Who receives what is paid: `reward x for striker`, `give 1 to event.by`.
//!
//! Every agent is judged for itself, so a receiver is a condition: is the agent's player among
//! those who are named?

use super::writer::Payment;
use crate::ast::{EventExpr, Expr, ExprKind, RewardUse};
use crate::check::types::Ty;
use crate::lower::Lower;
use crate::lower::value::{LiteralFrame, Repr, Scope, Value};
use crate::problem::Problem;
use crate::problem::facts::{Calls, Rewards, Types};
use setpiece_scenario::vocabulary::{EventField, EventKind, Field};
use setpiece_scenario::{BinaryOp, Fold, FoldKind, Reg, Who};

impl<'w> Lower<'_, 'w> {
    /// The weight and the receivers that a scenario gives to a reward.
    pub(super) fn payment(&mut self, used: Option<&'w RewardUse>) -> Payment {
        let Some(used) = used else { return Payment::default() };
        self.within(Scope::new(true, LiteralFrame::World), |lower| Payment {
            weight: used.weight.as_ref().map(|weight| lower.want_reg(weight, Ty::Number)),
            audience: used.audience.as_ref().and_then(|who| lower.audience(who, "for")),
        })
    }

    /// Whether the agent is among those who are named; `None` after a report.
    ///
    /// - `word`: the word before the names.
    pub(super) fn audience(&mut self, who: &'w Expr, word: &'static str) -> Option<Reg> {
        match &who.kind {
            ExprKind::List(list) => {
                if list.is_empty() {
                    self.report(Problem::new(who.span, Rewards::NoReceiver { word }));
                }
                let each: Vec<Option<Reg>> =
                    list.iter().map(|one| self.audience(one, word)).collect();
                let each = each.into_iter().collect::<Option<Vec<Reg>>>()?;
                return each.into_iter().reduce(|a, b| self.code.binary(BinaryOp::Or, a, b));
            }
            ExprKind::Event(event) => return self.did_it(event),
            ExprKind::Name(name) if self.is_nobody(who) || name == "none" => {
                self.report(Problem::new(who.span, Rewards::NoReceiver { word }));
                return None;
            }
            ExprKind::Name(name)
                if (is_view(name) || is_everyone(name) && !self.world.declares(name))
                    && self.scope.find(name).is_none() =>
            {
                let name = name.clone();
                self.report(Problem::new(who.span, Rewards::ReceiverOfView { name, word }));
                return None;
            }
            _ => {}
        }
        let value = self.expr(who);
        let me = self.code.me();
        match (value.ty, &value.repr) {
            (Ty::Error, _) => None,
            (Ty::Team, Repr::One(team)) => {
                self.check_paid(Who::Team(*team), who);
                let us = self.code.us();
                Some(self.code.binary(BinaryOp::Eq, us, *team))
            }
            (Ty::Player, Repr::One(player)) => {
                self.check_paid(Who::Player(*player), who);
                let same = self.code.binary(BinaryOp::Eq, me, *player);
                if self.code.constant_of(*player).is_some() {
                    return Some(same);
                }
                // Nobody isn't an agent whose player is off the pitch.
                let zero = self.code.constant(0.0);
                let is_somebody = self.code.binary(BinaryOp::Ge, me, zero);
                Some(self.code.binary(BinaryOp::And, same, is_somebody))
            }
            (Ty::Role, Repr::One(role)) => {
                let mine = self.code.load(Field::PlayerRole, Some(me), self.when);
                Some(self.code.binary(BinaryOp::Eq, mine, *role))
            }
            (Ty::Set, Repr::Set(set)) => Some(self.in_set(me, *set)),
            _ => self.not_a_receiver(&value, who),
        }
    }

    fn not_a_receiver(&mut self, value: &Value<'w>, who: &Expr) -> Option<Reg> {
        let text = self.world.text(who.span);
        self.report(Problem::new(who.span, Types::NoReceiver { found: value.ty, text }));
        None
    }

    /// Whether the agent's player did what happened in this step.
    fn did_it(&mut self, event: &'w EventExpr) -> Option<Reg> {
        let loops = self.code.leave_loops();
        let outer = self.event.take();
        let done = self.open_events(event).map(|matching| {
            if !matching.filter.kind.has_actor() {
                let name = event.name.node.clone();
                self.report(Problem::new(event.span, Calls::NobodyDoes { event: name }));
            }
            let (by, me) = (self.code.event(EventField::By), self.code.me());
            let mine = self.code.binary(BinaryOp::Eq, by, me);
            let zero = self.code.constant(0.0);
            let is_somebody = self.code.binary(BinaryOp::Ge, me, zero);
            let mut value = self.code.binary(BinaryOp::And, mine, is_somebody);
            if matching.filter.kind == EventKind::Goal {
                // A goal into the own net isn't its scorer's.
                let (team, us) = (self.code.event(EventField::ByTeam), self.code.us());
                let ours = self.code.binary(BinaryOp::Eq, team, us);
                value = self.code.binary(BinaryOp::And, value, ours);
            }
            let guard = matching.guard;
            let fold = Fold { kind: FoldKind::Any, value: Some(value), guard };
            self.close_events(matching, fold)
        });
        self.event = outer;
        self.code.return_to(loops);
        done
    }

    /// Warns of a team that has no agents, and of its players.
    fn check_paid(&self, paid: Who, who: &Expr) {
        if let (Some(team), Some(side)) = (self.team_of(paid), self.side_with_agents())
            && team != side
        {
            self.report(Problem::new(who.span, Rewards::PaysNobody { team }));
        }
    }
}

/// Whether a word of other languages stands for every agent.
fn is_everyone(name: &str) -> bool {
    matches!(name, "all" | "everyone" | "everybody" | "anyone")
}

/// Whether a name is read from the view of each agent.
fn is_view(name: &str) -> bool {
    matches!(name, "us" | "them" | "me" | "mates" | "players")
}
