//! What a scenario says in braces about its start: its kind, the ball, the rules.

use crate::ast::{BallStmt, Expr, ExprKind, Field, ScenarioStmtKind, Span};
use crate::check::options::{BALL, START};
use crate::check::types::Ty;
use crate::lower::value::Repr;
use crate::lower::{Lower, fields};
use crate::problem::facts::{Bounds, Instead, Names, Starts, Types};
use crate::problem::{Guess, Problem};
use setpiece_scenario::pitch::{
    BALL_SPEED_MAX_MPS, BALL_SPIN_MAX, GOALS_MAX, LONGEST_S, START_HEIGHT_MAX_M, STEP_S,
    STEPS_PER_S,
};
use setpiece_scenario::vocabulary::Rule;
use setpiece_scenario::{BallStart, BinaryOp, Reg, RuleSetting, UnaryOp};

/// Beyond this nobody has the ball, metres.
const AT_HIS_FEET_M: f64 = 2.0;

impl<'w> Lower<'_, 'w> {
    pub(super) fn start_fields(&mut self) -> (Option<(Reg, Reg)>, Option<Reg>) {
        let Some(stmt) = self.world.flat.start else { return (None, None) };
        let ScenarioStmtKind::Start { fields, .. } = &stmt.kind else { return (None, None) };
        let (mut score, mut elapsed) = (None, None);
        for field in fields::known_fields(self, fields, START, "`start`") {
            let Some(expr) = fields::expression(self, field) else { continue };
            if field.key.node == "elapsed" {
                let reg = self.want_reg(expr, Ty::DURATION);
                self.check_range(
                    reg,
                    (0.0, LONGEST_S),
                    "`elapsed`",
                    expr.span,
                    "`0 steps..1000000 steps`",
                );
                self.check_steps(reg, "`elapsed`", expr.span);
                elapsed = Some(reg);
                continue;
            }
            let ExprKind::List(parts) = &expr.kind else {
                self.report(Problem::new(expr.span, Types::NoScore));
                continue;
            };
            let &[left, right] = &parts.iter().collect::<Vec<_>>()[..] else {
                self.report(Problem::new(expr.span, Starts::ScoreOfTwo));
                continue;
            };
            let goals = (self.want_reg(left, Ty::Int), self.want_reg(right, Ty::Int));
            self.check_range(
                goals.0,
                (0.0, GOALS_MAX.into()),
                "a team's score",
                left.span,
                "`0..99`",
            );
            self.check_range(
                goals.1,
                (0.0, GOALS_MAX.into()),
                "a team's score",
                right.span,
                "`0..99`",
            );
            score = Some(goals);
        }
        (score, elapsed)
    }

    pub(super) fn ball(&mut self) -> Option<BallStart> {
        let name = &self.world.flat.item.name;
        let at = self.world.flat.ball.map(|(_, span)| span).or(self
            .world
            .flat
            .start
            .map(|stmt| stmt.span));
        let (x, y) = self.ball_place(at.unwrap_or(name.span));
        if self.code.is_unknown(x) && self.world.flat.ball.is_none() {
            return None;
        }
        let mut start = BallStart { x, y, height: None, velocity: None, spin: None, owner: None };
        if let Some((ball, _)) = self.world.flat.ball {
            self.ball_fields(ball, &mut start);
        }
        Some(start)
    }

    fn ball_fields(&mut self, ball: &'w BallStmt, start: &mut BallStart) {
        for field in fields::known_fields(self, &ball.fields, BALL, "the ball") {
            let Some(expr) = fields::expression(self, field) else { continue };
            let name = format!("ball {}", field.key.node);
            self.drawing(&name, |lower| match field.key.node.as_str() {
                "velocity" => {
                    let value = lower.want(expr, Ty::Velocity);
                    let zero = lower.code.constant(0.0);
                    let velocity = match value.repr {
                        Repr::Three(x, y, z) => (x, y, z),
                        Repr::Two(x, y) => (x, y, zero),
                        _ => (zero, zero, zero),
                    };
                    lower.check_speed(velocity, BALL_SPEED_MAX_MPS, "the ball", expr.span);
                    start.velocity = Some(velocity);
                }
                "height" => {
                    let reg = lower.want_reg(expr, Ty::LENGTH);
                    lower.check_range(
                        reg,
                        (0.0, START_HEIGHT_MAX_M),
                        "the ball's height",
                        expr.span,
                        "`0m..50m`",
                    );
                    start.height = Some(reg);
                }
                "owner" => {
                    let owner = lower.want_reg(expr, Ty::Player);
                    lower.check_owner(owner, (start.x, start.y), expr.span);
                    start.owner = Some(owner);
                }
                _ => start.spin = lower.spin(expr),
            });
        }
    }

    /// Whoever is too far from the ball doesn't have it.
    fn check_owner(&mut self, owner: Reg, ball: (Reg, Reg), at: Span) {
        let Some(index) = self.roster_index(owner) else { return };
        let place = self.place_of_seat(index, at);
        let [Some(x), Some(y), Some(ball_x), Some(ball_y)] =
            [place.0, place.1, ball.0, ball.1].map(|reg| self.code.constant_of(reg))
        else {
            return;
        };
        let apart = ((x - ball_x).powi(2) + (y - ball_y).powi(2)).sqrt();
        if apart > AT_HIS_FEET_M {
            let name = self.world.text(at);
            self.report(Problem::new(at, Starts::OwnerFarAway { name, apart_m: apart }));
        }
    }

    /// `spin: (0, 0, 30)`: radians per second about x, y and z.
    fn spin(&mut self, expr: &'w Expr) -> Option<(Reg, Reg, Reg)> {
        if let ExprKind::Tuple(parts) = &expr.kind
            && let [x, y, z] = parts.as_slice()
        {
            let mut about = |expr: &'w Expr| {
                let reg = self.want_reg(expr, Ty::Number);
                self.check_range(
                    reg,
                    (-BALL_SPIN_MAX, BALL_SPIN_MAX),
                    "the spin",
                    expr.span,
                    "`-200..200`",
                );
                reg
            };
            let spin = (about(x), about(y), about(z));
            return Some(self.mirrored_spin(spin));
        }
        self.report(Problem::new(expr.span, Types::NoSpin));
        None
    }

    pub(super) fn rules(&mut self) -> Vec<RuleSetting> {
        let mut settings = Vec::new();
        let fields = self.world.flat.rules.clone();
        for field in fields {
            let Some(rule) = Rule::from_name(&field.key.node) else {
                if fields::block_of(&field.key.node).is_some() {
                    fields::is_known(self, field, &[], "`rules`");
                    continue;
                }
                self.report({
                    let known: Vec<&str> = Rule::ALL.iter().map(|rule| rule.name()).collect();
                    let guess = Guess::or_all(&field.key.node, &known);
                    Problem::new(
                        field.key.span,
                        Names::NoRule { option: field.key.node.clone(), guess },
                    )
                });
                continue;
            };
            if let Some(value) = self.rule_value(rule, field) {
                self.check_not_drawn(value, &format!("`{rule}`"), field.key.span);
                settings.push(RuleSetting { rule, value });
            }
        }
        settings
    }

    fn rule_value(&mut self, rule: Rule, field: &'w Field) -> Option<Reg> {
        let expr = fields::expression(self, field)?;
        match (rule, &expr.kind) {
            (Rule::Physics, ExprKind::Name(name)) if name == "gated" || name == "full" => {
                Some(self.code.bool(name == "full"))
            }
            (Rule::Physics, _) => {
                let text = self.world.text(expr.span);
                self.report(Problem::new(expr.span, Bounds::Physics { text }));
                None
            }
            (Rule::HalfTime, ExprKind::Bool(false)) => Some(self.code.constant(0.0)),
            (Rule::HalfTime, _) => {
                let value = self.expr(expr);
                let reg = self.reg(&value);
                let steps = match value.ty {
                    Ty::Error => return None,
                    Ty::Int => reg,
                    Ty::DURATION => {
                        self.check_steps(reg, "`half_time`", expr.span);
                        let step = self.code.constant(STEP_S);
                        let steps = self.code.binary(BinaryOp::Div, reg, step);
                        self.code.unary(UnaryOp::Round, steps)
                    }
                    ty => {
                        self.report(self.mismatch_with(
                            ty,
                            Ty::DURATION,
                            expr.span,
                            Instead::HalfTime,
                        ));
                        return None;
                    }
                };
                let most = LONGEST_S * STEPS_PER_S;
                self.check_range(
                    steps,
                    (0.0, most),
                    "`half_time`",
                    expr.span,
                    "`0 steps..1000000 steps`",
                );
                Some(steps)
            }
            _ => {
                let value = self.expr(expr);
                if value.ty == Ty::Bool || value.is_error() {
                    return Some(self.reg(&value));
                }
                let text = self.world.text(expr.span);
                self.report(Problem::new(
                    expr.span,
                    Types::NeitherOnNorOff { rule: rule.name(), found: value.ty, text },
                ));
                None
            }
        }
    }
}
