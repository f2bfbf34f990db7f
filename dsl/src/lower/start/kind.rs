//! `start corner for left`: the kind of start, who takes it, and where the ball lies then.

use crate::ast::{Ident, ScenarioStmtKind, Span};
use crate::check::types::Ty;
use crate::lower::Lower;
use crate::lower::mirror::Mirror;
use crate::lower::value::{LiteralFrame, Scope};
use crate::problem::facts::{Kind, Names, Starts};
use crate::problem::{Guess, Problem};
use setpiece_scenario::vocabulary::{PitchMeasure, StartKind, Team};
use setpiece_scenario::{BallStart, BinaryOp, Reg, UnaryOp};

impl Lower<'_, '_> {
    /// The kind of start and the team that takes it; read once.
    pub(in crate::lower) fn start_kind(&mut self) -> (StartKind, Option<Reg>) {
        if let Some(known) = self.start().and_then(|start| start.kind) {
            return known;
        }
        let implied =
            if self.world.flat.kickoff.is_some() { StartKind::Kickoff } else { StartKind::Open };
        // Whoever asks while the team is being computed must not ask for ever.
        self.set_kind((implied, None));
        let found = self.read_kind(implied);
        self.set_kind(found);
        found
    }

    fn set_kind(&mut self, kind: (StartKind, Option<Reg>)) {
        if let Some(start) = self.start_mut() {
            start.kind = Some(kind);
        }
    }

    fn read_kind(&mut self, implied: StartKind) -> (StartKind, Option<Reg>) {
        let first = (implied == StartKind::Kickoff).then(|| self.first_team());
        let Some(stmt) = self.world.flat.start else { return (implied, first) };
        let ScenarioStmtKind::Start { kind, team, at, .. } = &stmt.kind else {
            return (implied, first);
        };
        let Some(found) = StartKind::from_name(&kind.node) else {
            self.report({
                let guess = Guess::of(&kind.node, StartKind::ALL.iter().map(|kind| kind.name()));
                Problem::new(
                    kind.span,
                    Names::Unknown { kind: Kind::Start, name: kind.node.clone(), guess },
                )
            });
            return (implied, first);
        };
        if let Some(at) = at.as_ref().filter(|_| !has_place(found)) {
            self.report(Problem::new(at.span, Starts::NoPlaceOfItsOwn { kind: found }));
        }
        if team.is_none()
            && matches!(found, StartKind::Corner | StartKind::GoalKick | StartKind::Penalty)
        {
            self.report(Problem::new(kind.span, Starts::WhoseIsIt { kind: found }));
        }
        if let Some(team) = team.as_ref().filter(|_| found == StartKind::Open) {
            self.report(Problem::new(team.span, Starts::OpenForATeam { kind: kind.span }));
        }
        self.check_ball_statement(found, kind, at.as_ref().map(|at| at.span));
        let scope = Scope::new(true, LiteralFrame::World);
        let team = team.as_ref().map(|team| {
            let outer = self.team.take();
            let reg = self.within(scope, |lower| {
                lower.drawing("start", |lower| lower.want_reg(team, Ty::Team))
            });
            self.team = outer;
            if found != StartKind::Open && self.code.constant_of(reg) == Some(-1.0) {
                self.report(Problem::new(team.span, Starts::BelongsToATeam { kind: found }));
            }
            self.check_taker(found, reg, team.span);
            reg
        });
        (found, team.or(first.filter(|_| found == StartKind::Kickoff)))
    }

    /// Somebody must be there to take it.
    fn check_taker(&self, kind: StartKind, team: Reg, at: Span) {
        let index = self.code.constant_of(team).filter(|index| *index >= 0.0);
        let Some(team) = index.and_then(|index| Team::ALL.get(index as usize)) else { return };
        if kind != StartKind::Open && self.world.roster.iter().all(|player| player.team != *team) {
            self.report(Problem::new(at, Starts::NobodyTakesIt { team: *team, kind }));
        }
    }

    /// A set piece lays the ball down itself.
    fn check_ball_statement(&self, kind: StartKind, word: &Ident, at: Option<Span>) {
        let Some((ball, span)) = self.world.flat.ball else { return };
        let start = word.span;
        match kind {
            StartKind::Open | StartKind::Kickoff => {}
            StartKind::Corner | StartKind::GoalKick | StartKind::Penalty => {
                self.report(Problem::new(span, Starts::LaysBallItself { kind, start }));
            }
            StartKind::FreeKick | StartKind::ThrowIn if at.is_some() => {
                self.report(Problem::new(span, Starts::PlaceTwice { kind, start }));
            }
            StartKind::FreeKick | StartKind::ThrowIn => {
                let moving = |key: &str| matches!(key, "velocity" | "height" | "spin" | "owner");
                if let Some(field) = ball.fields.iter().find(|field| moving(&field.key.node)) {
                    self.report(Problem::new(field.key.span, Starts::BallLiesStill { kind }));
                }
            }
        }
    }

    /// At a kick-off the ball lies still on the centre spot.
    pub(in crate::lower) fn check_kickoff_ball(&self, kind: StartKind, lies: Option<&BallStart>) {
        let (Some((ball, span)), Some(lies)) = (self.world.flat.ball, lies) else { return };
        let at_centre = [lies.x, lies.y].iter().all(|reg| self.code.constant_of(*reg) == Some(0.0));
        if kind != StartKind::Kickoff || (at_centre && ball.fields.is_empty()) {
            return;
        }
        let word = self.world.flat.start.map_or(self.world.flat.item.name.span, |stmt| stmt.span);
        self.report(Problem::new(span, Starts::KickOffLaysBall { start: word }));
    }

    /// Where the ball lies where no `ball …` says so; `None` after a report.
    pub(in crate::lower) fn place_of_start(&mut self) -> Option<(Reg, Reg)> {
        let (kind, team) = self.start_kind();
        let world = self.world;
        let stmt = world.flat.start.map(|stmt| &stmt.kind);
        if let Some(ScenarioStmtKind::Start { at: Some(at), .. }) = stmt
            && has_place(kind)
        {
            let outer = self.team.take();
            let scope = Scope::new(true, LiteralFrame::World);
            let place =
                self.within(scope, |lower| lower.drawing("ball", |lower| lower.want_point(at)));
            self.team = outer;
            self.check_place_of_start(kind, team, place, at.span);
            return Some(place);
        }
        let x = match kind {
            StartKind::Kickoff => self.code.constant(0.0),
            StartKind::Corner => self.pitch_length(PitchMeasure::HalfLength),
            StartKind::Penalty => self.less(PitchMeasure::HalfLength, PitchMeasure::PenaltySpot),
            StartKind::GoalKick => self.less(PitchMeasure::GoalKickSpot, PitchMeasure::HalfLength),
            StartKind::Open | StartKind::FreeKick | StartKind::ThrowIn => {
                let name = &world.flat.item.name;
                self.report(Problem::new(
                    name.span,
                    Starts::NoBall { scenario: name.node.clone(), kind },
                ));
                return None;
            }
        };
        let mut y = self.code.constant(0.0);
        if kind == StartKind::Corner {
            let aside = self.pitch_length(PitchMeasure::HalfWidth);
            y = self.code.unary(UnaryOp::Neg, aside);
        }
        let y = self.picture_y(y);
        Some(match team {
            Some(team) => {
                let side = self.code.unary(UnaryOp::Side, team);
                (self.code.binary(BinaryOp::Mul, x, side), y)
            }
            None => (x, y),
        })
    }
}

impl Lower<'_, '_> {
    /// Reports a corner whose place is known and lies elsewhere.
    fn check_place_of_start(
        &mut self,
        kind: StartKind,
        team: Option<Reg>,
        place: (Reg, Reg),
        span: Span,
    ) {
        let lines = [PitchMeasure::HalfLength, PitchMeasure::HalfWidth];
        let [line_x, line_y] = lines.map(|measure| self.pitch_length(measure));
        let [Some(x), Some(y), Some(line_x), Some(line_y)] =
            [place.0, place.1, line_x, line_y].map(|reg| self.code.constant_of(reg))
        else {
            return;
        };
        let side = match team.and_then(|team| self.code.constant_of(team)) {
            Some(0.0) => Team::Left.side(),
            Some(1.0) => Team::Right.side(),
            _ => x.signum(),
        };
        let on_side_line = (y.abs() - line_y).abs() <= NEAR_M;
        let on_byline = (x * side - line_x).abs() <= NEAR_M;
        if kind == StartKind::Corner && !(on_side_line && on_byline) {
            let end =
                if (side > 0.0) == (self.world.mirror != Mirror::Ends) { "right" } else { "left" };
            self.report(Problem::new(span, Starts::NoCorner { end }));
        }
    }

    /// Where the author says that the ball lies, and at what start: by `ball …`, or by the `at …`
    /// of a free kick or throw-in. A corner's only tells which of the two.
    pub(crate) fn said_place(&self) -> Option<(StartKind, Span)> {
        let (kind, at) = match self.world.flat.start.map(|stmt| &stmt.kind) {
            Some(ScenarioStmtKind::Start { kind, at, .. }) => {
                (StartKind::from_name(&kind.node)?, at.as_ref())
            }
            _ => (StartKind::Open, None),
        };
        let at = at
            .filter(|_| matches!(kind, StartKind::FreeKick | StartKind::ThrowIn))
            .map(|at| at.span);
        let ball = self.world.flat.ball.map(|(stmt, _)| stmt.place.span);
        ball.or(at).map(|span| (kind, span))
    }
}

/// How far from its line the ball of a corner or throw-in may be said to lie; it is put on the
/// line.
pub(super) const NEAR_M: f64 = 1.5;

/// Whether `at …` says where it is: a corner's tells which of the two.
fn has_place(kind: StartKind) -> bool {
    matches!(kind, StartKind::Corner | StartKind::FreeKick | StartKind::ThrowIn)
}
