//! Payments and endings that no match can bring about, and why.

use super::interval::{self, InPlay};
use super::value::{LiteralFrame, Scope};
use super::{Lower, ProgramStage};
use crate::problem::facts::{Because, Never};
use setpiece_scenario::pitch::{STEPS_PER_S, X_SCALE_M, Y_SCALE_M};
use setpiece_scenario::vocabulary::{EventKind, Field, PitchMeasure, Qualifier, Rule, Team};
use setpiece_scenario::{BinaryOp, Each, EventFilter, FoldKind, Instr, Over, Reg, UnaryOp, Who};
use std::cell::Cell;

impl Lower<'_, '_> {
    /// Why no event of the match passes a filter, if none does.
    pub(crate) fn never_happens(&self, filter: &EventFilter) -> Option<Never> {
        if let Some(rule) = self.switched_off(filter.kind) {
            return Some(Never::SwitchedOff(filter.kind, rule));
        }
        let (by, to) = (self.team_of(filter.by?)?, self.team_of(filter.to?)?);
        match filter.qualifier {
            Some(Qualifier::Completed) if by != to => Some(Never::CompletedToOpponent),
            Some(Qualifier::Intercepted) if by == to => Some(Never::InterceptedByMate),
            _ => None,
        }
    }

    /// The rule without which there is no such event, if the scenario switches it off whatever its
    /// parameters are.
    fn switched_off(&self, kind: EventKind) -> Option<Rule> {
        let off = |rule: Rule| self.is_off(rule).then_some(rule);
        // Fouls and handballs are what is punished.
        let offences = || off(Rule::Handball).and_then(|_| off(Rule::Fouls));
        match kind {
            EventKind::Offside => off(Rule::Offside),
            EventKind::Handball => off(Rule::Handball),
            EventKind::HalfTime => off(Rule::HalfTime),
            EventKind::Foul | EventKind::Advantage => off(Rule::Fouls),
            EventKind::YellowCard | EventKind::RedCard => off(Rule::Cards).or_else(offences),
            // The match may begin with one.
            EventKind::Penalty if self.world.flat.start.is_none() => {
                off(Rule::Penalties).or_else(offences)
            }
            _ => None,
        }
    }

    pub(super) fn team_of(&self, who: Who) -> Option<Team> {
        match who {
            Who::Team(reg) => self.known_team(reg),
            Who::Player(reg) => {
                let id = self.code.constant_of(reg)?;
                self.world
                    .roster
                    .iter()
                    .find(|player| f64::from(player.id) == id)
                    .map(|player| player.team)
            }
        }
    }

    pub(super) fn known_team(&self, reg: Reg) -> Option<Team> {
        match self.code.instr(reg)? {
            Instr::Const(index) if *index == 0.0 => Some(Team::Left),
            Instr::Const(index) if *index == 1.0 => Some(Team::Right),
            Instr::Us => self.side_with_agents(),
            Instr::Unary(UnaryOp::OtherTeam, team) => Some(match self.known_team(*team)? {
                Team::Left => Team::Right,
                Team::Right => Team::Left,
            }),
            _ => None,
        }
    }

    /// Whether a condition never holds, whatever happens in the match.
    pub(crate) fn never_holds(&self, reg: Reg) -> bool {
        self.never_holds_if(reg, |_| {})
    }

    /// The same with other knowledge of the match.
    fn never_holds_if(&self, reg: Reg, change: impl FnOnce(&mut InPlay<'_>)) -> bool {
        let mut in_play = InPlay {
            longest: self.longest(),
            longest_round: self.longest_round(reg),
            rounds: self.step.and_then(|step| step.rounds),
            joint: true,
            counts_up: true,
            highest_ball: self.highest_ball(),
            happens: &|filter| self.never_happens(filter).is_none(),
        };
        change(&mut in_play);
        interval::never_holds(&self.code, reg, &self.world.ranges(), in_play)
    }

    /// How long a round lasts at most, seconds, if that is known and a condition reads it.
    fn longest_round(&self, reg: Reg) -> Option<f64> {
        let (rounds, _) = self.world.flat.rounds?;
        let reads_round = |instr: &Instr| matches!(instr, Instr::RoundElapsed);
        let step = self.step.filter(|_| self.code.depends(reg, &reads_round))?;
        self.world.tentatively(|| {
            let scope = Scope::new(true, LiteralFrame::World);
            let mut lower = Lower::in_step(step, ProgramStage::Ending, scope);
            let ends = lower.condition(&rounds.when);
            interval::longest_round(&lower.code, ends, &self.world.ranges())
        })
    }

    /// How far the goal lines and touchlines lie from the centre at most, metres, if that is known.
    fn reach(&self) -> Option<[f64; 2]> {
        let step = self.step?;
        self.world.tentatively(|| {
            let scope = Scope::new(true, LiteralFrame::World);
            let mut lower = Lower::in_step(step, ProgramStage::Ending, scope);
            let mut most = |measure: PitchMeasure| {
                let line = lower.pitch_length(measure);
                Some(interval::interval(&lower.code, line, &self.world.ranges())?.1)
            };
            Some([most(PitchMeasure::HalfLength)?, most(PitchMeasure::HalfWidth)?])
        })
    }

    /// Why a condition never holds: the event that never happens, or the one thing that it looks
    /// at.
    pub(crate) fn why_never(&self, guard: Reg) -> Never {
        let missing = Cell::new(None);
        self.code.depends(guard, &|instr| {
            if let Instr::Each(each) = instr
                && let Over::Events(filter) = &each.over
            {
                missing.set(missing.get().or_else(|| self.never_happens(filter)));
            }
            false
        });
        if let Some(why) = missing.get() {
            return why;
        }
        let limit = self.longest().map(|seconds| Because::Limit(seconds * STEPS_PER_S));
        if !self.never_holds_if(guard, |known| known.joint = false) {
            return Never::Condition(Some(Because::Excluded));
        }
        if !self.never_holds_if(guard, |known| known.longest_round = None) {
            let round = self.longest_round(guard);
            return Never::Condition(round.map(|seconds| Because::Round(seconds * STEPS_PER_S)));
        }
        if !self.never_holds_if(guard, |known| known.longest = None) {
            return Never::Condition(limit);
        }
        if !self.never_holds_if(guard, |known| known.counts_up = false) {
            return Never::Condition(Some(Because::Count));
        }
        let reads = |fields: &[Field]| {
            let test = |instr: &Instr| match instr {
                Instr::Load { field, .. } => fields.contains(field),
                _ => false,
            };
            // Whatever is counted, the count has its own bounds.
            let enters = |each: &Each| each.fold.kind != FoldKind::Count;
            self.code.depends_through(guard, &test, &enters)
        };
        let reads_round = self.code.depends(guard, &|instr| matches!(instr, Instr::Round));
        let rounds = self.step.and_then(|step| step.rounds).map(Because::Rounds);
        let counts = self.code.depends(guard, &|instr| match instr {
            Instr::Each(each) => matches!(each.over, Over::Players { .. }),
            _ => false,
        });
        let is_normalised = self.code.depends(guard, &|instr| match instr {
            Instr::Binary(BinaryOp::Div, _, scale) => {
                let scale = self.code.constant_of(*scale);
                scale == Some(X_SCALE_M) || scale == Some(Y_SCALE_M)
            }
            _ => false,
        });
        let places = if is_normalised { Because::Places } else { Because::Metres(self.reach()) };
        let all = [
            (reads(PLACES), Some(places)),
            (reads(&[Field::BallVx, Field::BallVy, Field::BallVz]), Some(Because::BallSpeed)),
            (reads(&[Field::PlayerVx, Field::PlayerVy]), Some(Because::PlayerSpeed)),
            (reads(&[Field::PlayerYellowCards]), Some(Because::YellowCards)),
            (reads(&[Field::PlayerFatigue]), Some(Because::Fatigue)),
            (reads(&[Field::BallHeight]), Some(Because::BallHeight(self.highest_ball()))),
            (reads(&[Field::Score]), Some(Because::Count)),
            (reads_round, rounds),
            (reads(&[Field::Elapsed, Field::Remaining]), limit),
            (counts, Some(Because::Players)),
        ];
        let mut met = all.into_iter().filter(|(met, _)| *met);
        match (met.next(), met.next()) {
            (Some((_, Some(because))), None) => Never::Condition(Some(because)),
            (None, _) => Never::Condition(None),
            _ => Never::Several,
        }
    }
}

const PLACES: &[Field] = &[Field::BallX, Field::BallY, Field::PlayerX, Field::PlayerY];
