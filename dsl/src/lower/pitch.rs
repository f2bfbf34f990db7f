//! How large the pitch is, in every program: constants, or values of the start.

use super::step_world::LetSource;
use super::value::{LiteralFrame, Scope};
use super::{Lower, ProgramStage};
use crate::ast::{Expr, Field, FieldValue};
use crate::check::types::Ty;
use crate::problem::Problem;
use crate::problem::facts::Chance;
use setpiece_scenario::pitch_size::RIM_BEYOND_M;
use setpiece_scenario::vocabulary::{Along, PitchFigure, PitchMeasure, PitchRect};
use setpiece_scenario::{BinaryOp, Reg};

impl<'w> Lower<'_, 'w> {
    /// A measure of the pitch, metres.
    pub(crate) fn pitch_length(&mut self, measure: PitchMeasure) -> Reg {
        self.in_proportion(measure.usual(), measure.follows())
    }

    /// A length or width of the usual pitch in proportion to a figure of this one, metres.
    pub(crate) fn in_proportion(&mut self, usual_m: f64, to: PitchFigure) -> Reg {
        let usual = self.code.constant(usual_m);
        let Some(value) = self.unusual_figure(to) else { return usual };
        let (product, of) = (self.code.binary(BinaryOp::Mul, value, usual), to.usual());
        let of = self.code.constant(of);
        self.code.binary(BinaryOp::Div, product, of)
    }

    /// A point of the pitch, metres.
    pub(crate) fn point_of_pitch(&mut self, (x, y): (Along, Along)) -> (Reg, Reg) {
        (self.coordinate_of_pitch(x), self.coordinate_of_pitch(y))
    }

    /// The corners of a rectangle of the pitch, metres.
    pub(crate) fn corners(&mut self, [from, to]: PitchRect) -> ((Reg, Reg), (Reg, Reg)) {
        (self.point_of_pitch(from), self.point_of_pitch(to))
    }

    fn coordinate_of_pitch(&mut self, Along { plus, minus }: Along) -> Reg {
        let mut value = |measure: Option<PitchMeasure>| match measure {
            Some(measure) => self.pitch_length(measure),
            None => self.code.constant(0.0),
        };
        if plus.is_some() && minus.is_none() {
            return value(plus);
        }
        let (plus, minus) = (value(plus), value(minus));
        self.code.binary(BinaryOp::Sub, plus, minus)
    }

    /// One measure less another, metres.
    pub(crate) fn less(&mut self, plus: PitchMeasure, minus: PitchMeasure) -> Reg {
        self.coordinate_of_pitch(Along { plus: Some(plus), minus: Some(minus) })
    }

    /// How far players may go along each axis, metres.
    pub(crate) fn rim(&mut self) -> (Reg, Reg) {
        let mut beyond = |measure: PitchMeasure, by: f64| {
            let (line, by) = (self.pitch_length(measure), self.code.constant(by));
            self.code.binary(BinaryOp::Add, line, by)
        };
        let x = beyond(PitchMeasure::HalfLength, RIM_BEYOND_M.0);
        (x, beyond(PitchMeasure::HalfWidth, RIM_BEYOND_M.1))
    }

    /// A figure that the scenario sets, or that follows one it sets, metres.
    fn unusual_figure(&mut self, figure: PitchFigure) -> Option<Reg> {
        self.figure_of_pitch(figure).or_else(|| {
            let of = figure.follows()?;
            self.unusual_figure(of)?;
            Some(self.in_proportion(figure.usual(), of))
        })
    }

    /// A figure that the scenario sets, metres.
    pub(crate) fn figure_of_pitch(&mut self, figure: PitchFigure) -> Option<Reg> {
        if self.step.is_some() {
            return self.step_figure(figure);
        }
        if let Some(known) = self.start().and_then(|start| *start.pitch.get(figure.index())?) {
            return Some(known);
        }
        let (field, expr) = self.written_figure(figure)?;
        let (team, scope) = (self.team.take(), Scope::new(true, LiteralFrame::World));
        let value = self.inline(field.key.span, expr.span, |lower| {
            let lowered = |lower: &mut Self| {
                lower.drawing(&format!("pitch {figure}"), |lower| lower.want_reg(expr, Ty::LENGTH))
            };
            lower.within(scope, |lower| match lower.stage {
                // It is reported where the start is lowered.
                ProgramStage::Constant => lower.world.tentatively(|| lowered(lower)),
                _ => lowered(lower),
            })
        });
        self.team = team;
        let value = value.unwrap_or_else(|| self.code.unknown());
        if let Some(known) = self.start_mut().and_then(|s| s.pitch.get_mut(figure.index())) {
            *known = Some(value);
        } else if self.code.constant_of(value).is_none() {
            self.report(Problem::new(expr.span, Chance::SizeInConstant { figure }));
        }
        Some(value)
    }

    /// The field that sets a figure, and its expression.
    fn written_figure(&self, figure: PitchFigure) -> Option<(&'w Field, &'w Expr)> {
        let given = self.world.flat.pitch.iter().copied();
        given.filter(|field| field.key.node == figure.name()).find_map(|field| match &field.value {
            FieldValue::Expr(expr) => Some((field, expr)),
            _ => None,
        })
    }

    /// A figure in a program of a step.
    fn step_figure(&mut self, figure: PitchFigure) -> Option<Reg> {
        let source = self.step?.pitch.get(figure.index()).copied().flatten()?;
        Some(self.read(source))
    }

    /// What a program of a step reads of the start.
    pub(super) fn read(&mut self, source: LetSource) -> Reg {
        match source {
            LetSource::Constant(value) => self.code.constant(value),
            LetSource::Param(index) => self.code.param(index),
            LetSource::Let(index) => self.code.scenario_let(index),
        }
    }
}
