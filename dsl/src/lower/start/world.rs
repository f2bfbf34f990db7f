//! `world { … }`: gravity, the wind, and how the ball flies, bounces and rolls.

use crate::ast::Expr;
use crate::check::options::WORLD;
use crate::check::types::Ty;
use crate::lower::value::Repr;
use crate::lower::{Lower, fields};
use crate::problem::Problem;
use crate::problem::facts::{Instead, Types};
use setpiece_scenario::pitch::{BALL_SPEED_MAX_MPS, START_HEIGHT_MAX_M};
use setpiece_scenario::vocabulary::{WIND_MAX_MPS, WorldFigure};
use setpiece_scenario::{Reg, WorldSetting};

impl<'w> Lower<'_, 'w> {
    /// The figures of the world that the scenario sets.
    pub(super) fn world_settings(&mut self) -> Vec<WorldSetting> {
        let mut settings = Vec::new();
        let given = self.world.flat.world.clone();
        for field in given {
            let key = field.key.node.as_str();
            if !fields::is_known(self, field, WORLD, "`world`") {
                continue;
            }
            let Some(expr) = fields::expression(self, field) else { continue };
            self.drawing(&format!("world {key}"), |lower| match WorldFigure::from_name(key) {
                Some(figure) => settings.push(lower.figure(figure, expr)),
                None => settings.extend(lower.wind(expr)),
            });
        }
        settings
    }

    /// How high the ball rises at most, metres: from the highest start straight up, faster by what
    /// a wind adds, with nothing but gravity to slow it.
    pub(super) fn ball_ceiling(&self, settings: &[WorldSetting]) -> f64 {
        let range = |figure: WorldFigure| {
            let set = settings.iter().rfind(|setting| setting.figure == figure);
            let usual = (figure.usual(), figure.usual());
            set.map_or(usual, |set| self.interval(set.value).unwrap_or(figure.range()))
        };
        let wind = [WorldFigure::WindX, WorldFigure::WindY].map(|along| {
            let (low, high) = range(along);
            low.abs().max(high.abs())
        });
        let speed = BALL_SPEED_MAX_MPS + 2.0 * wind[0].hypot(wind[1]).min(WIND_MAX_MPS);
        let gravity = range(WorldFigure::Gravity).0.max(WorldFigure::Gravity.range().0);
        START_HEIGHT_MAX_M + speed * speed / (2.0 * gravity)
    }

    fn figure(&mut self, figure: WorldFigure, expr: &'w Expr) -> WorldSetting {
        let value = if figure == WorldFigure::Gravity {
            self.gravity(expr)
        } else {
            self.want_reg(expr, Ty::Number)
        };
        let (low, high) = figure.range();
        let shown = format!("`{low}..{high}`");
        self.check_range(value, (low, high), &format!("`{figure}`"), expr.span, &shown);
        WorldSetting { figure, value }
    }

    /// `gravity: 9.81`: accelerations have no unit in the language.
    fn gravity(&mut self, expr: &'w Expr) -> Reg {
        let value = self.expr(expr);
        if value.is_error() || value.ty.is_plain() {
            return self.reg(&value);
        }
        self.report(self.mismatch_with(value.ty, Ty::Number, expr.span, Instead::Gravity));
        self.code.unknown()
    }

    /// `wind: (4m/s, 0m/s)`
    fn wind(&mut self, expr: &'w Expr) -> [WorldSetting; 2] {
        let value = self.want(expr, Ty::Velocity);
        if let Repr::Three(..) = value.repr {
            self.report(Problem::new(expr.span, Types::WindIsLevel));
        }
        let (x, y) = self.pair(&value);
        let zero = self.code.constant(0.0);
        self.check_speed((x, y, zero), WIND_MAX_MPS, "the wind", expr.span);
        [(WorldFigure::WindX, x), (WorldFigure::WindY, y)]
            .map(|(figure, value)| WorldSetting { figure, value })
    }
}
