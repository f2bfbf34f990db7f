//! `pitch { … }`: how long and wide it is, how large goals and penalty boxes are.

use crate::ast::Span;
use crate::check::options::PITCH;
use crate::lower::{Lower, fields};
use crate::problem::Problem;
use crate::problem::facts::{Bounds, Implied};
use setpiece_scenario::vocabulary::PitchFigure;
use setpiece_scenario::{BinaryOp, PitchSetting, Reg};

impl Lower<'_, '_> {
    /// The figures of the pitch that the scenario sets.
    pub(super) fn pitch_settings(&mut self) -> Vec<PitchSetting> {
        let mut settings = Vec::new();
        for field in self.world.flat.pitch.clone() {
            if !fields::is_known(self, field, PITCH, "`pitch`") {
                continue;
            }
            let Some(expr) = fields::expression(self, field) else { continue };
            let Some(figure) = PitchFigure::from_name(&field.key.node) else { continue };
            let Some(value) = self.figure_of_pitch(figure) else { continue };
            let (low, high) = figure.range();
            let shown = format!("`{low}m..{high}m`");
            if self.check_range(value, (low, high), &format!("`{figure}`"), expr.span, &shown) {
                self.check_within(figure, value, expr.span);
            }
            settings.push(PitchSetting { figure, value });
        }
        settings
    }

    /// A penalty box lies in its half of the pitch.
    fn check_within(&mut self, figure: PitchFigure, value: Reg, at: Span) {
        let Some((of, share)) = figure.within() else { return };
        let most = self.in_proportion(share * of.usual(), of);
        let room = self.code.binary(BinaryOp::Sub, most, value);
        match self.interval(room) {
            Some((low, _)) if low >= 0.0 => {}
            Some((_, high)) if high < 0.0 => {
                let text = self.world.text(at);
                self.report(Problem::new(at, Bounds::BoxTooLarge { figure, text }));
            }
            _ => {
                let zero = self.code.constant(0.0);
                let fits = self.code.binary(BinaryOp::Ge, room, zero);
                self.imply(fits, &Implied::BoxFits, Some(at));
            }
        }
    }
}
