//! What stands behind a dot: properties, landmarks, regions, coordinates.

use super::super::Lower;
use super::super::value::{Repr, Value};
use crate::ast::{Expr, ExprKind, Ident, Span};
use crate::check::names;
use crate::check::types::Ty;
use crate::problem::facts::{Calls, Like, Names, Scopes, Types};
use crate::problem::{Guess, Problem};
use setpiece_scenario::pitch::{X_SCALE_M, Y_SCALE_M};
use setpiece_scenario::vocabulary::{
    EventField, Field, Landmark, Owner, PROPERTIES, PitchFigure, PitchRegion, RegionName, Role,
};
use setpiece_scenario::{BinaryOp, Reg, UnaryOp};

impl<'w> Lower<'_, 'w> {
    pub(super) fn member(&mut self, of: &'w Expr, member: &'w Ident, span: Span) -> Value<'w> {
        match &of.kind {
            // `left.corner.top` is one name with a dot in it.
            ExprKind::Member(team, part) if is_team_part(&part.node, &member.node) => {
                let name = format!("{}.{}", part.node, member.node);
                return self.team_member(team, &name, part.span.to(member.span), span);
            }
            ExprKind::Name(name) if name == "event" && self.scope.find(name).is_none() => {
                return self.event_member(of.span, member);
            }
            ExprKind::Name(name) if is_pitch_part(name) && self.scope.find(name).is_none() => {
                let dotted = format!("{name}.{}", member.node);
                return match PitchRegion::from_name(&dotted) {
                    Some(region) => self.pitch_region(region),
                    None => self.no_pitch_region(&dotted, span),
                };
            }
            ExprKind::Name(name) if self.scope.find(name).is_none() => {
                if !self.world.declares(name)
                    && !names::is_value(name)
                    && let Some(state) = self.state_of_reward(name, of.span, member)
                {
                    return state;
                }
                if let Some(value) = self.imported(name, member, span) {
                    return value;
                }
            }
            _ => {}
        }
        let value = match &of.kind {
            ExprKind::Name(name) => self.name_before(name, of.span, true),
            _ => self.expr(of),
        };
        let name = member.node.as_str();
        if self.is_nobody(of) {
            return self.fail(Problem::new(
                span,
                Types::NobodyHasNoProperty { property: name.to_owned() },
            ));
        }
        match value.ty {
            Ty::Error => Value::error(),
            Ty::Team => self.member_of_team(&value, name, member.span, of.span),
            Ty::Ball => self.ball_member(&value, member, of.span, span),
            Ty::Player => self.player_member(&value, member, of.span, span),
            Ty::Score => self.score_member(member, span),
            Ty::Point | Ty::Vector | Ty::Velocity => match name {
                "x" | "y" => self.coordinate(&value, name),
                "metres" if value.ty == Ty::Point => self.metres(&value, of.span),
                "z" if matches!(value.repr, Repr::Three(..)) => {
                    let ty = if value.ty == Ty::Velocity { Ty::SPEED } else { Ty::LENGTH };
                    value.regs().get(2).map_or_else(Value::error, |&z| Value::one(ty, z))
                }
                _ if value.ty == Ty::Point => {
                    self.no_member(of.span, value.ty, member.span, name, &["x", "y", "metres"])
                }
                _ => self.no_member(of.span, value.ty, member.span, name, &["x", "y"]),
            },
            _ => self.no_member(of.span, value.ty, member.span, name, &[]),
        }
    }

    /// `defence.f_4_4_2`: an item of a file that was imported under a name.
    fn imported(&mut self, alias: &str, member: &Ident, span: Span) -> Option<Value<'w>> {
        let library = self.world.library;
        let dotted = format!("{alias}.{}", member.node);
        if let Some(value) = self.file_name(&dotted, span) {
            return Some(value);
        }
        let file = library.imported_as(span.file, alias)?;
        if self.scope.scenario && self.world.declares(alias) {
            return None;
        }
        let begins = format!("{alias}.");
        let known: Vec<&str> = library
            .visible(span.file)
            .map(|(name, _)| name)
            .filter(|name| name.starts_with(&begins))
            .collect();
        let guess = Guess::similar_or_all(&dotted, &known);
        let fact = Names::NotInFile { file: file.to_owned(), name: member.node.clone(), guess };
        Some(self.fail(Problem::new(member.span, fact)))
    }

    fn team_member(&mut self, team: &'w Expr, name: &str, at: Span, span: Span) -> Value<'w> {
        let value = self.expr(team);
        match value.ty {
            Ty::Error => Value::error(),
            Ty::Team => self.member_of_team(&value, name, at, team.span),
            ty => self.no_member(span, ty, at, name, &[]),
        }
    }

    /// Where a role of a team stands in the standard formation.
    pub(crate) fn zone(&mut self, role: Role, team: Reg) -> (Reg, Reg) {
        let (x, y) = self.world.mirror.role(role).zone();
        let side = self.code.unary(UnaryOp::Side, team);
        let x = self.in_proportion(x * X_SCALE_M, PitchFigure::Length);
        let y = self.in_proportion(y * Y_SCALE_M, PitchFigure::Width);
        (self.code.binary(BinaryOp::Mul, x, side), self.code.binary(BinaryOp::Mul, y, side))
    }

    pub(super) fn member_of_team(
        &mut self,
        team: &Value<'w>,
        name: &str,
        at: Span,
        of: Span,
    ) -> Value<'w> {
        let reg = self.reg(team);
        if let Some(landmark) = Landmark::from_name(name) {
            let side = self.code.unary(UnaryOp::Side, reg);
            let (x, y) = self.point_of_pitch(landmark.left());
            let y = self.picture_y(y);
            return Value::two(Ty::Point, (self.code.binary(BinaryOp::Mul, x, side), y));
        }
        if let Some(role) = name.strip_prefix("zone.").and_then(Role::from_name) {
            return Value::two(Ty::Point, self.zone(role, reg));
        }
        if let Some(region) = RegionName::from_name(name) {
            return self.team_region(region, reg);
        }
        if name == "score" {
            return self
                .load(Field::Score, Some(reg), "score", at)
                .map_or_else(Value::error, |r| Value::one(Ty::Int, r));
        }
        let mut known: Vec<&str> = Landmark::ALL.iter().map(|landmark| landmark.name()).collect();
        known.extend(RegionName::ALL.iter().map(|region| region.name()));
        known.extend(["zone.CM", "score"]);
        let text = self.world.text(of);
        if Role::from_name(name).is_some() {
            let fact = Names::PlayerByRole { team: text, role: name.to_owned() };
            return self.fail(Problem::new(at, fact));
        }
        let guess = Guess::or_all(name, &known);
        self.fail(Problem::new(at, Names::NoLandmark { team: text, name: name.to_owned(), guess }))
    }

    fn score_member(&mut self, member: &'w Ident, span: Span) -> Value<'w> {
        if !matches!(member.node.as_str(), "left" | "right" | "us" | "them") {
            return self.no_member(
                span,
                Ty::Score,
                member.span,
                &member.node,
                &["left", "right", "us", "them"],
            );
        }
        let team = self.name(&member.node, member.span);
        if team.is_error() {
            return team;
        }
        let reg = self.reg(&team);
        self.load(Field::Score, Some(reg), "score", span)
            .map_or_else(Value::error, |r| Value::one(Ty::Int, r))
    }

    fn ball_member(
        &mut self,
        value: &Value<'w>,
        member: &'w Ident,
        of: Span,
        span: Span,
    ) -> Value<'w> {
        let one = |field| (field, Ty::LENGTH);
        match member.node.as_str() {
            "x" | "y" => {
                let place = self.place_of(value, span);
                self.coordinate(&Value::two(Ty::Point, place), &member.node)
            }
            "metres" => self.metres(value, span),
            "height" => {
                let (field, ty) = one(Field::BallHeight);
                self.load(field, None, "height", span)
                    .map_or_else(Value::error, |r| Value::one(ty, r))
            }
            "owner" => self
                .load(Field::BallOwner, None, "owner", span)
                .map_or_else(Value::error, |r| Value::one(Ty::Player, r)),
            "velocity" => self.velocity(value, span),
            "speed" => {
                let flat = self.velocity(value, span);
                if flat.is_error() {
                    return flat;
                }
                let z = self.code.load(Field::BallVz, None, self.when);
                let (x, y) = self.pair(&flat);
                let ground = self.code.binary(BinaryOp::Hypot, x, y);
                Value::one(Ty::SPEED, self.code.binary(BinaryOp::Hypot, ground, z))
            }
            "heading" => {
                let flat = self.velocity(value, span);
                if flat.is_error() {
                    return flat;
                }
                let (x, y) = self.pair(&flat);
                let angle = self.code.binary(BinaryOp::Atan2, y, x);
                Value::one(Ty::ANGLE, self.turned_angle(angle))
            }
            name => self.no_property(of, Owner::Ball, Ty::Ball, member.span, name),
        }
    }

    fn player_member(
        &mut self,
        value: &Value<'w>,
        member: &'w Ident,
        of: Span,
        span: Span,
    ) -> Value<'w> {
        let reg = self.reg(value);
        let name = member.node.as_str();
        let (field, ty) = match name {
            "x" | "y" => {
                let place = self.place_of(value, span);
                return self.coordinate(&Value::two(Ty::Point, place), name);
            }
            "metres" => return self.metres(value, span),
            "team" => return Value::one(Ty::Team, self.code.unary(UnaryOp::TeamOf, reg)),
            "velocity" => return self.velocity(value, span),
            "speed" => {
                let velocity = self.velocity(value, span);
                if velocity.is_error() {
                    return velocity;
                }
                let (x, y) = self.pair(&velocity);
                return Value::one(Ty::SPEED, self.code.binary(BinaryOp::Hypot, x, y));
            }
            "heading" => {
                let Some(angle) = self.load(Field::PlayerHeading, Some(reg), name, span) else {
                    return Value::error();
                };
                return Value::one(Ty::ANGLE, self.turned_angle(angle));
            }
            "fatigue" => (Field::PlayerFatigue, Ty::Number),
            "yellow_cards" => (Field::PlayerYellowCards, Ty::Int),
            "role" => (Field::PlayerRole, Ty::Role),
            "active" => (Field::PlayerActive, Ty::Bool),
            "controlled" => (Field::PlayerControlled, Ty::Bool),
            "action" => (Field::PlayerAction, Ty::Action),
            "sprinting" => (Field::PlayerSprinting, Ty::Bool),
            "dribbling" => (Field::PlayerDribbling, Ty::Bool),
            _ => return self.no_property(of, Owner::Player, Ty::Player, member.span, name),
        };
        self.load(field, Some(reg), name, span).map_or_else(Value::error, |r| Value::one(ty, r))
    }

    /// A player's or the ball's velocity along the ground, world frame.
    pub(super) fn velocity(&mut self, value: &Value<'w>, span: Span) -> Value<'w> {
        let (fields, of) = match value.ty {
            Ty::Player => ((Field::PlayerVx, Field::PlayerVy), Some(self.reg(value))),
            _ => ((Field::BallVx, Field::BallVy), None),
        };
        let text = self.world.text(span);
        let Some(x) = self.load(fields.0, of, &text, span) else { return Value::error() };
        let y = self.code.load(fields.1, of, self.when);
        Value::two(Ty::Velocity, (x, y))
    }

    /// `.x`, `.y` in the reader's frame: normalised of a point, in its unit of a vector.
    fn coordinate(&mut self, value: &Value<'w>, name: &str) -> Value<'w> {
        let pair = self.pair(value);
        let (x, y) = self.turned(pair);
        let (reg, scale) = if name == "x" { (x, X_SCALE_M) } else { (y, Y_SCALE_M) };
        match value.ty {
            Ty::Vector => Value::one(Ty::LENGTH, reg),
            Ty::Velocity => Value::one(Ty::SPEED, reg),
            _ => {
                let scale = self.code.constant(scale);
                Value::one(Ty::Number, self.code.binary(BinaryOp::Div, reg, scale))
            }
        }
    }

    fn event_member(&mut self, event: Span, member: &'w Ident) -> Value<'w> {
        let Some(kind) = self.event else {
            return self.fail(Problem::new(event.to(member.span), Scopes::NoEvent));
        };
        let name = member.node.as_str();
        let has_nobody =
            (name == "by" && !kind.has_actor()) || (name == "to" && !kind.has_receiver());
        if has_nobody {
            let fact = Calls::AlwaysNobody { event: kind.to_string(), is_receiver: name == "to" };
            return self.fail(Problem::new(event.to(member.span), fact));
        }
        let (field, ty) = match name {
            "by" => (EventField::By, Ty::Player),
            "to" => (EventField::To, Ty::Player),
            "length" => (EventField::Length, Ty::LENGTH),
            "speed" => (EventField::Speed, Ty::SPEED),
            "at" => {
                let place = (self.code.event(EventField::X), self.code.event(EventField::Y));
                return Value::two(Ty::Point, place);
            }
            _ => {
                let known: Vec<&str> = EventField::NAMED.iter().map(|(name, _)| *name).collect();
                return self.no_member(event, Ty::Event, member.span, name, &known);
            }
        };
        Value::one(ty, self.code.event(field))
    }

    fn no_property(&self, of: Span, owner: Owner, ty: Ty, at: Span, name: &str) -> Value<'w> {
        let known: Vec<&str> =
            PROPERTIES.iter().filter(|p| p.owner == owner).map(|p| p.name).collect();
        self.no_member(of, ty, at, name, &known)
    }

    fn no_member(&self, of: Span, ty: Ty, at: Span, name: &str, known: &[&str]) -> Value<'w> {
        let text = self.world.text(of);
        let like = match (ty, name) {
            (Ty::Player | Ty::Team | Ty::Set, "has_ball" | "hasBall" | "has_possession") => {
                Like::HasBall { whole: of.to(at) }
            }
            (Ty::Player | Ty::Ball, "vx" | "vy" | "velocity.x" | "velocity.y") => Like::Velocity,
            (Ty::Player | Ty::Ball, "position" | "pos") => Like::Place,
            _ => Like::Other(Guess::similar_or_all(name, known)),
        };
        let fact = Names::NoProperty { text, noun: ty.noun(), name: name.to_owned(), like };
        self.fail(Problem::new(at, fact))
    }
}

/// Whether two names with a dot between them are one name of a team: `corner.top`, `goal.mouth`,
/// `zone.CM`.
fn is_team_part(head: &str, tail: &str) -> bool {
    let dotted = format!("{head}.{tail}");
    // The heads that are nothing by themselves: what is wrong behind them is reported as one name.
    matches!(head, "corner" | "zone") || RegionName::from_name(&dotted).is_some()
}

/// Whether a name is the first half of a region's that belongs to no team: `flank.top`.
fn is_pitch_part(name: &str) -> bool {
    PitchRegion::ALL
        .iter()
        .any(|region| region.name().split_once('.').is_some_and(|(head, _)| head == name))
}
