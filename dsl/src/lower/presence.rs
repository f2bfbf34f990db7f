//! Whether a player takes part: `when …`, `maybe 30%`, and a drawn number of players.

use super::known::OnDemand;
use super::people::{Formations, Numbered, Presence};
use super::seats::sharers;
use super::{Lower, World};
use crate::ast::Span;
use crate::check::types::Ty;
use crate::problem::Problem;
use crate::problem::facts::Players;
use setpiece_scenario::vocabulary::Team;
use setpiece_scenario::{BinaryOp, Distribution, Instr, Reg};

impl<'w> Lower<'_, 'w> {
    /// What decides whether a player of the roster takes part, computed when it is first asked for.
    pub(crate) fn presence_of(&mut self, index: usize, asked: Span) -> Presence {
        match self.start().and_then(|start| start.presence.get(index).copied()) {
            Some(OnDemand::Done(presence)) => return presence,
            Some(OnDemand::Todo) => {}
            Some(OnDemand::Busy) => {
                let text = self.world.text(asked);
                self.report(Problem::new(asked, Players::PresenceInCircle { text }));
                return Presence::default();
            }
            None => return Presence::default(),
        }
        self.set_presence(index, OnDemand::Busy);
        let presence = self.compute_presence(index);
        self.set_presence(index, OnDemand::Done(presence));
        presence
    }

    /// Whether a player of the roster takes part, in the start program.
    pub(crate) fn exists_at_start(&mut self, player: Reg, asked: Span) -> Option<Reg> {
        self.start()?;
        let first = self.roster_index(player)?;
        let mut any = None;
        for index in sharers(self.world, first) {
            let yes = self.code.bool(true);
            let conditions = self.presence_of(index, asked);
            let all = conditions
                .conditions()
                .fold(yes, |all, one| self.code.binary(BinaryOp::And, all, one));
            any = Some(any.map_or(all, |any| self.code.binary(BinaryOp::Or, any, all)));
        }
        any
    }

    fn set_presence(&mut self, index: usize, presence: OnDemand<Presence>) {
        if let Some(slot) = self.start_mut().and_then(|start| start.presence.get_mut(index)) {
            *slot = presence;
        }
    }

    fn compute_presence(&mut self, index: usize) -> Presence {
        let world: &'_ World<'w> = self.world;
        let Some(player) = world.roster.get(index) else { return Presence::default() };
        let (scope, stream) = (player.scope.clone(), player.stream());
        self.for_team(player.team.index() as f64, |lower| {
            lower.within(scope, |lower| {
                let mut presence = Presence::default();
                if let Some(formations) = &player.formations {
                    let reg = lower.of_formations(player.team, formations);
                    if lower.is_drawn(reg) {
                        presence.active = Some(reg);
                    } else {
                        presence.present = Some(reg);
                    }
                }
                if let Some(when) = player.when {
                    let share = |lower: &Self, ty| {
                        let share = lower.world.text(when.span);
                        (ty == Ty::Percent)
                            .then(|| (format!("maybe {share} {} …", player.role), None))
                    };
                    let reg = lower.drawing(&format!("{stream} when"), |lower| {
                        lower.condition_or(when, share)
                    });
                    if lower.is_drawn(reg) {
                        presence.active = Some(lower.both(presence.active, reg));
                    } else {
                        presence.present = Some(lower.both(presence.present, reg));
                    }
                }
                if let Some(share) = player.maybe {
                    let reg = lower.drawing(&format!("{stream} maybe"), |lower| {
                        let value = lower.want_reg(share, Ty::Percent);
                        lower.check_range(value, (0.0, 1.0), "the share", share.span, "`0%..100%`");
                        let (zero, one) = (lower.code.constant(0.0), lower.code.constant(1.0));
                        let roll = lower.random(Distribution::Uniform(zero, one));
                        lower.code.binary(BinaryOp::Lt, roll, value)
                    });
                    presence.active = Some(lower.both(presence.active, reg));
                }
                if let Some(numbered) = player.numbered.filter(|it| it.before >= it.least) {
                    let number = lower.number_of(player.team, player.span, numbered, &stream);
                    let before = lower.code.constant(numbered.before.into());
                    let reg = lower.code.binary(BinaryOp::Gt, number, before);
                    presence.active = Some(lower.both(presence.active, reg));
                }
                presence
            })
        })
    }

    /// Whether an episode has one of these formations.
    fn of_formations(&mut self, team: Team, formations: &Formations<'w>) -> Reg {
        let conditions = self.formations_of(team, formations.whole);
        let mut which = formations.which.iter();
        let meant = which.by_ref().filter_map(|which| conditions.get(*which).copied().flatten());
        let any = meant.reduce(|one, other| self.code.binary(BinaryOp::Or, one, other));
        any.unwrap_or_else(|| self.code.constant(1.0))
    }

    fn is_drawn(&self, reg: Reg) -> bool {
        let drawn = |instr: &Instr| {
            matches!(instr, Instr::Random { .. } | Instr::EpisodeIndex | Instr::Round)
        };
        self.code.depends(reg, &drawn)
    }

    /// How many players a statement has in this episode: one draw for all its copies.
    fn number_of(&mut self, team: Team, span: Span, numbered: Numbered, stream: &str) -> Reg {
        let known = self.start().and_then(|start| {
            start.numbers.iter().find(|(of, at, _)| (*of, *at) == (team, span)).map(|known| known.2)
        });
        known.unwrap_or_else(|| {
            let ends = (numbered.least.into(), numbered.most.into());
            let ends = (self.code.constant(ends.0), self.code.constant(ends.1));
            let number = self.drawing(&format!("{stream} number"), |lower| {
                lower.random(Distribution::Integer(ends.0, ends.1))
            });
            if let Some(start) = self.start_mut() {
                start.numbers.push((team, span, number));
            }
            number
        })
    }
}
