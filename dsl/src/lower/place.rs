//! Where things are: at the start by their place statements, in the match by its state.

use super::mirror::Mirror;
use super::people::{Rostered, Scoped, Stand};
use super::seats::sharers;
use super::value::{LiteralFrame, Repr, Scope, Value};
use super::{Lower, ProgramStage};
use crate::ast::{BallStmt, Expr, Facing, Place, PlaceKind, Span};
use crate::check::types::Ty;
use crate::lower::known::OnDemand;
use crate::problem::Problem;
use crate::problem::facts::{Instead, Players};
use setpiece_scenario::vocabulary::Field;
use setpiece_scenario::{BinaryOp, Instr, Reg, UnaryOp};

/// What a place is seen from: the player or team that directions are relative to.
#[derive(Clone, Copy)]
enum Viewpoint {
    /// A player of the roster.
    Player(usize),
    /// Anything else: the attack direction of the team in whose block it stands.
    Team,
}

impl<'w> Lower<'_, 'w> {
    /// World metres of a point, player or the ball, now or a step ago.
    pub(crate) fn place_of(&mut self, value: &Value<'w>, span: Span) -> (Reg, Reg) {
        match (value.ty, &value.repr) {
            (_, Repr::Two(x, y) | Repr::Three(x, y, _)) => (*x, *y),
            (Ty::Player, Repr::One(reg)) if self.stage.is_step() => self.player_place(*reg),
            (Ty::Player, Repr::One(reg)) if matches!(self.stage, ProgramStage::Start(_)) => {
                self.start_place(*reg, span)
            }
            (Ty::Ball, _) if matches!(self.stage, ProgramStage::Start(_)) => self.ball_place(span),
            (Ty::Player | Ty::Ball, _) => {
                let (fx, fy, of) = match (value.ty, &value.repr) {
                    (Ty::Player, Repr::One(reg)) => (Field::PlayerX, Field::PlayerY, Some(*reg)),
                    _ => (Field::BallX, Field::BallY, None),
                };
                let text = self.world.text(span);
                let x = self.load(fx, of, &text, span);
                let Some(x) = x else { return self.nowhere() };
                (x, self.code.load(fy, of, self.when))
            }
            _ => self.nowhere(),
        }
    }

    /// The place of what has none: a problem has been reported.
    fn nowhere(&mut self) -> (Reg, Reg) {
        let unknown = self.code.unknown();
        (unknown, unknown)
    }

    /// A player's place in a step program.
    pub(crate) fn player_place(&mut self, player: Reg) -> (Reg, Reg) {
        (
            self.code.load(Field::PlayerX, Some(player), self.when),
            self.code.load(Field::PlayerY, Some(player), self.when),
        )
    }

    /// A player's start place; which player it is may be drawn.
    fn start_place(&mut self, player: Reg, span: Span) -> (Reg, Reg) {
        if let Some(index) = self.roster_index(player) {
            return self.place_of_seat(index, span);
        }
        if let Some(&Instr::Select(c, a, b)) = self.code.instr(player) {
            let (a, b) = (self.start_place(a, span), self.start_place(b, span));
            return (self.code.select(c, a.0, b.0), self.code.select(c, a.1, b.1));
        }
        self.report(Problem::new(span, Players::MayBeNobody { text: self.world.text(span) }));
        self.nowhere()
    }

    /// The start place of whoever has the place in the team of a player of the roster, who is the
    /// first there.
    pub(crate) fn place_of_seat(&mut self, index: usize, asked: Span) -> (Reg, Reg) {
        let places: Vec<_> = sharers(self.world, index)
            .map(|index| {
                let presence = self.shared_presence(index, asked);
                (presence, self.place_of_rostered(index, asked))
            })
            .collect();
        self.first_place(&places)
    }

    /// Whether a player takes part who shares their place in the team.
    fn shared_presence(&mut self, index: usize, asked: Span) -> Option<Reg> {
        let next = self.world.roster.get(index + 1);
        if !next.is_some_and(|next| next.instead) {
            return None;
        }
        let presence = self.presence_of(index, asked);
        presence.conditions().fold(None, |all, one| Some(self.both(all, one)))
    }

    /// The start place of a player of the roster, computed when it is first asked for.
    pub(crate) fn place_of_rostered(&mut self, index: usize, asked: Span) -> (Reg, Reg) {
        match self.start().and_then(|start| start.places.get(index).copied()) {
            Some(OnDemand::Done(place)) => return place,
            Some(OnDemand::Todo) => {}
            Some(OnDemand::Busy) => {
                self.cyclic(asked);
                return self.nowhere();
            }
            None => return self.nowhere(),
        }
        if let Some(slot) = self.start_mut().and_then(|start| start.places.get_mut(index)) {
            *slot = OnDemand::Busy;
        }
        let place = self.compute_player(index);
        if let Some(slot) = self.start_mut().and_then(|start| start.places.get_mut(index)) {
            *slot = OnDemand::Done(place);
        }
        place
    }

    fn cyclic(&self, asked: Span) {
        self.report(Problem::new(asked, Players::PlaceInCircle { text: self.world.text(asked) }));
    }

    /// The ball's start place.
    pub(crate) fn ball_place(&mut self, asked: Span) -> (Reg, Reg) {
        match self.start().map_or(OnDemand::Todo, |start| start.ball) {
            OnDemand::Done(place) => return place,
            OnDemand::Busy => {
                self.cyclic(asked);
                return self.nowhere();
            }
            OnDemand::Todo => {}
        }
        self.set_ball(OnDemand::Busy);
        let place = match self.world.flat.ball {
            Some((ball, _)) => self.drawing("ball", |lower| lower.compute_ball(ball)),
            None => self.place_of_start().unwrap_or_else(|| self.nowhere()),
        };
        self.set_ball(OnDemand::Done(place));
        place
    }

    fn set_ball(&mut self, ball: OnDemand<(Reg, Reg)>) {
        if let Some(start) = self.start_mut() {
            start.ball = ball;
        }
    }

    fn compute_ball(&mut self, ball: &'w BallStmt) -> (Reg, Reg) {
        let team = self.team.take();
        let scope = Scope::new(true, LiteralFrame::World);
        let place = self.within(scope, |lower| {
            let place = lower.place(&ball.place);
            lower.jittered(place, ball.jitter.as_ref())
        });
        self.team = team;
        place
    }

    fn compute_player(&mut self, index: usize) -> (Reg, Reg) {
        let world = self.world;
        let Some(player) = world.roster.get(index) else { return self.nowhere() };
        let name = player.stream();
        self.for_team(player.team.index() as f64, |lower| {
            lower.drawing(&name, |lower| {
                let place = lower.player_stand(player, &player.stand);
                let Some(receiving) = &player.receiving else { return place };
                // At a kick-off the team that is first has the layout of the kicking side.
                let other = lower.player_stand(player, receiving);
                let first = lower.first_team();
                let team = lower.code.constant(player.team.index() as f64);
                let kicks = lower.code.binary(BinaryOp::Eq, first, team);
                if let Some(slot) = lower.start_mut().and_then(|start| start.layouts.get_mut(index))
                {
                    *slot = Some((place, other));
                }
                (
                    lower.code.select(kicks, place.0, other.0),
                    lower.code.select(kicks, place.1, other.1),
                )
            })
        })
    }

    /// A player's place in one of their team's layouts.
    fn player_stand(&mut self, player: &Rostered<'w>, stand: &Stand<'w>) -> (Reg, Reg) {
        let (place, scope) = match stand {
            Stand::At(place, scope) => (*place, scope),
            Stand::Among(whole, stands) => {
                let conditions = self.formations_of(player.team, whole);
                let places: Vec<(Option<Reg>, (Reg, Reg))> = stands
                    .iter()
                    .map(|(which, stand)| {
                        let holds = conditions.get(*which).copied().flatten();
                        (holds, self.player_stand(player, stand))
                    })
                    .collect();
                return self.first_place(&places);
            }
        };
        let place = self.within(scope.clone(), |lower| {
            if let Some(place) = place {
                return lower.place(place);
            }
            let team = lower.code.constant(player.team.index() as f64);
            // The role is that of the mirrored player already.
            lower.zone(lower.world.mirror.role(player.role), team)
        });
        let Some(Scoped { it: jitter, scope }) = &player.jitter else { return place };
        self.within(scope.clone(), |lower| lower.jittered(place, Some(*jitter)))
    }

    /// The first of several places whose condition holds; the last has none that matters.
    fn first_place(&mut self, places: &[(Option<Reg>, (Reg, Reg))]) -> (Reg, Reg) {
        let mut listed = places.iter().rev();
        let Some(&(_, mut found)) = listed.next() else { return self.nowhere() };
        for &(holds, place) in listed {
            if let Some(holds) = holds {
                let x = self.code.select(holds, place.0, found.0);
                found = (x, self.code.select(holds, place.1, found.1));
            }
        }
        found
    }

    /// Runs `f` with a team in view.
    pub(crate) fn for_team<T>(&mut self, team: f64, f: impl FnOnce(&mut Self) -> T) -> T {
        let team = self.code.constant(team);
        let outer = self.team.replace(team);
        let result = f(self);
        self.team = outer;
        result
    }

    fn jittered(&mut self, place: (Reg, Reg), jitter: Option<&'w Expr>) -> (Reg, Reg) {
        match jitter {
            Some(radius) => {
                let reg = self.want_reg(radius, Ty::LENGTH);
                self.check_range(reg, (0.0, 60.0), "`jitter`", radius.span, "`0m..60m`");
                self.draw_in_disc(place, reg)
            }
            None => place,
        }
    }

    fn place(&mut self, place: &'w Place) -> (Reg, Reg) {
        match &place.kind {
            PlaceKind::At(point) => {
                let value = self.expr(point);
                if value.ty == Ty::Region {
                    let text = self.world.text(point.span);
                    let instead = Instead::In { text, place: place.span };
                    self.report(self.mismatch_with(value.ty, Ty::Point, point.span, instead));
                    return self.nowhere();
                }
                if value.ty.dim().is_some() {
                    let instead = Instead::PointInBrackets;
                    self.report(self.mismatch_with(value.ty, Ty::Point, point.span, instead));
                    return self.nowhere();
                }
                let value = self.convert(value, Ty::Point, point);
                self.pair(&value)
            }
            PlaceKind::In(region) => {
                let value = self.expr(region);
                if value.ty.is_place() {
                    let text = self.world.text(region.span);
                    let instead = Instead::At { text, place: place.span };
                    self.report(self.mismatch_with(value.ty, Ty::Region, region.span, instead));
                    return self.nowhere();
                }
                let drawn = self
                    .as_region(value, region)
                    .and_then(|found| self.draw_in(&found, region.span));
                drawn.unwrap_or_else(|| self.nowhere())
            }
            PlaceKind::Relative { direction, of, by } => {
                let from = self.expr(of);
                let view = match &from.repr {
                    Repr::One(reg) if from.ty == Ty::Player => {
                        self.roster_index(*reg).map_or(Viewpoint::Team, Viewpoint::Player)
                    }
                    _ => Viewpoint::Team,
                };
                let origin = self.convert(from, Ty::Point, of);
                let origin = self.pair(&origin);
                let length = self.want_reg(by, Ty::LENGTH);
                let ahead = self.ahead(view, of.span);
                let direction = match (direction.node.as_str(), self.world.mirror) {
                    ("right", Mirror::Flanks) => "left",
                    ("left", Mirror::Flanks) => "right",
                    (direction, _) => direction,
                };
                let (dx, dy) = match direction {
                    "ahead" => ahead,
                    "behind" => (
                        self.code.unary(UnaryOp::Neg, ahead.0),
                        self.code.unary(UnaryOp::Neg, ahead.1),
                    ),
                    "right" => (self.code.unary(UnaryOp::Neg, ahead.1), ahead.0),
                    _ => (ahead.1, self.code.unary(UnaryOp::Neg, ahead.0)),
                };
                self.moved(origin, (dx, dy), length)
            }
            PlaceKind::Between { a, b, at } => {
                let (p, q) = (self.want_point(a), self.want_point(b));
                let share = match at {
                    Some(at) => self.want_reg(at, Ty::Percent),
                    None => self.code.constant(0.5),
                };
                let way = (
                    self.code.binary(BinaryOp::Sub, q.0, p.0),
                    self.code.binary(BinaryOp::Sub, q.1, p.1),
                );
                self.moved(p, way, share)
            }
            PlaceKind::Beyond { of, by, from } => {
                let (p, q) = (self.want_point(from), self.want_point(of));
                let length = self.want_reg(by, Ty::LENGTH);
                let way = (
                    self.code.binary(BinaryOp::Sub, q.0, p.0),
                    self.code.binary(BinaryOp::Sub, q.1, p.1),
                );
                let distance = self.distance(p, q);
                let unit = (
                    self.code.binary(BinaryOp::Div, way.0, distance),
                    self.code.binary(BinaryOp::Div, way.1, distance),
                );
                self.moved(q, unit, length)
            }
            PlaceKind::Offset { from, along, by } => {
                let p = self.want_point(from);
                let angle = self.want_reg(along, Ty::ANGLE);
                let angle = self.turned_angle(angle);
                let length = self.want_reg(by, Ty::LENGTH);
                let way =
                    (self.code.unary(UnaryOp::Cos, angle), self.code.unary(UnaryOp::Sin, angle));
                self.moved(p, way, length)
            }
        }
    }

    fn moved(&mut self, from: (Reg, Reg), way: (Reg, Reg), by: Reg) -> (Reg, Reg) {
        let (dx, dy) = (
            self.code.binary(BinaryOp::Mul, way.0, by),
            self.code.binary(BinaryOp::Mul, way.1, by),
        );
        (self.code.binary(BinaryOp::Add, from.0, dx), self.code.binary(BinaryOp::Add, from.1, dy))
    }

    /// The unit vector that points ahead: the explicit facing of a player, else their team's
    /// attack.
    fn ahead(&mut self, view: Viewpoint, asked: Span) -> (Reg, Reg) {
        let world = self.world;
        let player = match view {
            Viewpoint::Player(index) => world.roster.get(index).map(|player| (index, player)),
            Viewpoint::Team => None,
        };
        if let Some((index, player)) = player {
            if player.facing.as_ref().is_some_and(|facing| !self.is_being_placed(facing.it)) {
                let heading = self.heading_of(index, asked);
                if let Some(heading) = heading {
                    return (
                        self.code.unary(UnaryOp::Cos, heading),
                        self.code.unary(UnaryOp::Sin, heading),
                    );
                }
            }
            let zero = self.code.constant(0.0);
            return (self.code.constant(player.team.side()), zero);
        }
        let side = match self.team {
            Some(team) => self.code.unary(UnaryOp::Side, team),
            None => self.code.constant(1.0),
        };
        (side, self.code.constant(0.0))
    }

    /// Whether a player faces what is just being placed: `ball behind striker` and
    /// `striker … facing ball` then mean the direction of the player's attack.
    fn is_being_placed(&self, facing: &Facing) -> bool {
        let crate::ast::ExprKind::Name(name) = &facing.target.kind else { return false };
        let Some(start) = self.start() else { return false };
        let roster = self.world.roster.iter().zip(&start.places);
        let mut placed =
            roster.filter(|(player, _)| player.name.is_some_and(|known| known.node == *name));
        (name == "ball" && start.ball == OnDemand::Busy)
            || placed.any(|(_, place)| *place == OnDemand::Busy)
    }

    /// The heading that a player of the roster faces, radians in the world frame.
    pub(crate) fn heading_of(&mut self, index: usize, asked: Span) -> Option<Reg> {
        match self.start()?.headings.get(index).copied()? {
            OnDemand::Done(heading) => return Some(heading),
            OnDemand::Busy => {
                self.cyclic(asked);
                return None;
            }
            OnDemand::Todo => {}
        }
        let world = self.world;
        let player = world.roster.get(index)?;
        let Scoped { it: facing, scope } = player.facing.as_ref()?;
        *self.start_mut()?.headings.get_mut(index)? = OnDemand::Busy;
        let heading = self.for_team(player.team.index() as f64, |lower| {
            let name = format!("{} facing", player.stream());
            lower.drawing(&name, |lower| {
                lower.within(scope.clone(), |lower| lower.facing(facing, index))
            })
        });
        *self.start_mut()?.headings.get_mut(index)? = OnDemand::Done(heading);
        Some(heading)
    }

    fn facing(&mut self, facing: &'w Facing, index: usize) -> Reg {
        let value = self.expr(&facing.target);
        let heading = if value.ty == Ty::ANGLE {
            let angle = self.reg(&value);
            self.turned_angle(angle)
        } else if value.ty.is_plain() {
            let instead = Instead::Facing { text: self.world.text(facing.target.span) };
            self.report(self.mismatch_with(value.ty, Ty::ANGLE, facing.target.span, instead));
            return self.code.constant(0.0);
        } else {
            let target = self.convert(value, Ty::Point, &facing.target);
            let target = self.pair(&target);
            let here = self.place_of_rostered(index, facing.target.span);
            let constant = |place: (Reg, Reg)| {
                Some((self.code.constant_of(place.0)?, self.code.constant_of(place.1)?))
            };
            let same = target == here
                || constant(target).is_some_and(|known| constant(here) == Some(known));
            if same && !self.code.is_unknown(here.0) {
                self.report(Problem::new(facing.target.span, Players::FacesItself));
            }
            let dx = self.code.binary(BinaryOp::Sub, target.0, here.0);
            let dy = self.code.binary(BinaryOp::Sub, target.1, here.1);
            self.code.binary(BinaryOp::Atan2, dy, dx)
        };
        if !facing.away {
            return heading;
        }
        let half_turn = self.code.constant(std::f64::consts::PI);
        let turned = self.code.binary(BinaryOp::Add, heading, half_turn);
        self.code.unary(UnaryOp::Wrap, turned)
    }
}
