//! Regions: the named ones, constructors, and whether a point lies inside.

use super::super::Lower;
use super::super::mirror::Mirror;
use super::super::value::{LiteralFrame, RegionValue, Repr, Scope, Value};
use crate::ast::{Arg, Expr, ItemKind, Span};
use crate::check::types::Ty;
use crate::origins::RegionOrigin;
use crate::problem::facts::{Calls, Kind, Names};
use crate::problem::{Guess, Problem};
use setpiece_scenario::vocabulary::{
    Function, PitchMeasure, PitchRect, PitchRegion, RegionName, RegionShape,
};
use setpiece_scenario::{BinaryOp, Reg, UnaryOp};
use std::f64::consts::TAU;
use std::sync::Arc;

/// Most corners of a polygon.
const CORNERS_MAX: usize = 64;

impl<'w> Lower<'_, 'w> {
    /// Lowers a region; `None` after a report.
    pub(crate) fn region(&mut self, expr: &'w Expr) -> Option<Arc<RegionValue>> {
        let value = self.expr(expr);
        self.as_region(value, expr)
    }

    /// The region that a value is.
    pub(crate) fn as_region(
        &mut self,
        value: Value<'w>,
        expr: &'w Expr,
    ) -> Option<Arc<RegionValue>> {
        match self.convert(value, Ty::Region, expr).repr {
            Repr::Region(region) => Some(region),
            _ => None,
        }
    }

    /// The scenario's and the root file's regions that have a name and no parameters, as far as
    /// they are known at the start.
    pub(crate) fn named_regions(&mut self) -> Vec<RegionOrigin> {
        let world = self.world;
        let own = world.flat.regions.iter().map(|region| (*region, true));
        let root = world.library.files.first().map_or(&[][..], |file| &file.items);
        let items = root.iter().filter_map(|item| match &item.kind {
            ItemKind::Region(region) => Some((region, false)),
            _ => None,
        });
        let mut found = Vec::new();
        for (region, sees_scenario) in own.chain(items) {
            if !region.params.is_empty() {
                continue;
            }
            let (used, problems) = (world.used.borrow().clone(), world.found());
            let scope = Scope::new(sees_scenario, LiteralFrame::World);
            let shape =
                world.tentatively(|| self.within(scope, |lower| lower.region(&region.body)));
            // Drawing a region is no use of it.
            *world.used.borrow_mut() = used;
            if let Some(shape) = shape.filter(|_| world.found() == problems) {
                found.push(RegionOrigin { span: region.name.span, shape: (*shape).clone() });
            }
        }
        found
    }

    /// A region that belongs to no team.
    pub(super) fn pitch_region(&mut self, region: PitchRegion) -> Value<'w> {
        if let Some(rect) = region.rect() {
            let (a, b) = self.corners(rect);
            return value(RegionValue::Rect(
                (a.0, self.picture_y(a.1)),
                (b.0, self.picture_y(b.1)),
            ));
        }
        let (zero, radius) = (self.code.constant(0.0), self.pitch_length(PitchMeasure::Circle));
        value(RegionValue::Circle((zero, zero), radius))
    }

    pub(super) fn no_pitch_region(&self, name: &str, span: Span) -> Value<'w> {
        let known: Vec<&str> = PitchRegion::ALL.iter().map(|region| region.name()).collect();
        let guess = Guess::similar_or_all(name, &known);
        self.fail(Problem::new(
            span,
            Names::Unknown { kind: Kind::Region, name: name.to_owned(), guess },
        ))
    }

    /// A region of a team's end: the left team's shape, rotated for the right one.
    pub(super) fn team_region(&mut self, region: RegionName, team: Reg) -> Value<'w> {
        let side = self.code.unary(UnaryOp::Side, team);
        let left = match region.left_shape() {
            RegionShape::Rect(rect) => self.pitch_rect(rect),
            RegionShape::DiscWithout(centre, radius, rect) => {
                let centre = self.point_of_pitch(centre);
                let disc = RegionValue::Circle(centre, self.pitch_length(radius));
                RegionValue::Difference(Arc::new(disc), Arc::new(self.pitch_rect(rect)))
            }
        };
        value(self.at_side(&left, side))
    }

    /// A shape symmetric about the x axis at the left (+1) or the right (-1) end.
    fn at_side(&mut self, region: &RegionValue, side: Reg) -> RegionValue {
        let mut turn = |(x, y): (Reg, Reg)| (self.code.binary(BinaryOp::Mul, x, side), y);
        match region {
            RegionValue::Rect(a, b) => RegionValue::Rect(turn(*a), turn(*b)),
            RegionValue::Circle(centre, radius) => RegionValue::Circle(turn(*centre), *radius),
            RegionValue::Difference(a, b) => {
                let (a, b) = (self.at_side(a, side), self.at_side(b, side));
                RegionValue::Difference(Arc::new(a), Arc::new(b))
            }
            other => other.clone(),
        }
    }

    fn pitch_rect(&mut self, rect: PitchRect) -> RegionValue {
        let (from, to) = self.corners(rect);
        RegionValue::Rect(from, to)
    }

    pub(super) fn region_call(
        &mut self,
        function: Function,
        args: &'w [Arg],
        span: Span,
    ) -> Value<'w> {
        if function == Function::Polygon {
            return self.polygon(args, span);
        }
        let names: &[&str] = match function {
            Function::Rect => &["from", "to"],
            Function::Circle => &["centre", "radius"],
            _ => &["at", "radius", "from", "to"],
        };
        let Some(given) = self.arguments(function.name(), args, span, names, names.len()) else {
            return Value::error();
        };
        let given: Vec<&'w Expr> = given.into_iter().flatten().collect();
        match *given.as_slice() {
            [a, b] if function == Function::Rect => {
                let (a, b) = (self.want(a, Ty::Point), self.want(b, Ty::Point));
                if a.is_error() || b.is_error() {
                    return Value::error();
                }
                value(RegionValue::Rect(self.pair(&a), self.pair(&b)))
            }
            [centre, radius] => match self.disc(centre, radius) {
                Some((centre, radius)) => value(RegionValue::Circle(centre, radius)),
                None => Value::error(),
            },
            [at, radius, from, to] => {
                let disc = self.disc(at, radius);
                let (from, to) = (self.want(from, Ty::ANGLE), self.want(to, Ty::ANGLE));
                let Some((centre, radius)) = disc.filter(|_| !from.is_error() && !to.is_error())
                else {
                    return Value::error();
                };
                let (from, to) = (self.reg(&from), self.reg(&to));
                let width = self.width_of(from, to);
                // In a mirror of the flanks a slice is swept the other way round.
                let from =
                    self.turned_angle(if self.world.mirror == Mirror::Flanks { to } else { from });
                value(RegionValue::Sector { centre, radius, from, width })
            }
            _ => Value::error(),
        }
    }

    fn disc(&mut self, centre: &'w Expr, radius: &'w Expr) -> Option<((Reg, Reg), Reg)> {
        let (at, length) = (self.want(centre, Ty::Point), self.want(radius, Ty::LENGTH));
        if at.is_error() || length.is_error() {
            return None;
        }
        let length = self.reg(&length);
        self.check_range(length, (0.0, 200.0), "the radius", radius.span, "`0m..200m`");
        Some((self.pair(&at), length))
    }

    /// How wide a sector is that begins and ends at two angles: a full turn if they lie one apart.
    fn width_of(&mut self, from: Reg, to: Reg) -> Reg {
        let turn = self.code.constant(TAU);
        let apart = self.code.binary(BinaryOp::Sub, to, from);
        let full = self.code.constant(TAU - 1e-9);
        let is_full = self.code.binary(BinaryOp::Ge, apart, full);
        let rest = self.code.binary(BinaryOp::Mod, apart, turn);
        self.code.select(is_full, turn, rest)
    }

    fn polygon(&mut self, args: &'w [Arg], span: Span) -> Value<'w> {
        if !(3..=CORNERS_MAX).contains(&args.len()) {
            return self
                .fail(Problem::new(span, Calls::Corners { most: CORNERS_MAX, found: args.len() }));
        }
        let mut corners = Vec::new();
        for arg in args {
            if arg.key.is_some() || arg.binder.is_some() || arg.filter.is_some() {
                return self.fail(Problem::new(arg.span, Calls::CornerWithName));
            }
            let corner = self.want(&arg.value, Ty::Point);
            if corner.is_error() {
                return corner;
            }
            corners.push(self.pair(&corner));
        }
        value(RegionValue::Polygon(corners))
    }

    /// Notes a region that a requirement asks about.
    pub(super) fn note_asked_about(&mut self, region: &RegionValue, span: Span) {
        if let Some(start) = self.start_mut().filter(|start| start.is_requiring) {
            start.asked_about.push(RegionOrigin { span, shape: region.clone() });
        }
    }

    /// Whether a point lies in a region, its edge included but for a polygon's.
    pub(crate) fn inside(&mut self, place: (Reg, Reg), region: &RegionValue) -> Reg {
        match region {
            RegionValue::Rect(a, b) => {
                let x = self.between(place.0, a.0, b.0);
                let y = self.between(place.1, a.1, b.1);
                self.code.binary(BinaryOp::And, x, y)
            }
            RegionValue::Circle(centre, radius) => {
                let distance = self.distance(place, *centre);
                self.code.binary(BinaryOp::Le, distance, *radius)
            }
            RegionValue::Sector { centre, radius, from, width } => {
                let distance = self.distance(place, *centre);
                let near = self.code.binary(BinaryOp::Le, distance, *radius);
                let dx = self.code.binary(BinaryOp::Sub, place.0, centre.0);
                let dy = self.code.binary(BinaryOp::Sub, place.1, centre.1);
                let angle = self.code.binary(BinaryOp::Atan2, dy, dx);
                let (turn, over) =
                    (self.code.constant(TAU), self.code.binary(BinaryOp::Sub, angle, *from));
                let over = self.code.binary(BinaryOp::Mod, over, turn);
                let within = self.code.binary(BinaryOp::Le, over, *width);
                self.code.binary(BinaryOp::And, near, within)
            }
            RegionValue::Polygon(corners) => self.inside_polygon(place, corners),
            RegionValue::Union(a, b) => {
                let (a, b) = (self.inside(place, a), self.inside(place, b));
                self.code.binary(BinaryOp::Or, a, b)
            }
            RegionValue::Intersection(a, b) => {
                let (a, b) = (self.inside(place, a), self.inside(place, b));
                self.code.binary(BinaryOp::And, a, b)
            }
            RegionValue::Difference(a, b) => {
                let (a, b) = (self.inside(place, a), self.inside(place, b));
                let outside = self.code.unary(UnaryOp::Not, b);
                self.code.binary(BinaryOp::And, a, outside)
            }
            RegionValue::Either(condition, a, b) => {
                let (a, b) = (self.inside(place, a), self.inside(place, b));
                self.code.select(*condition, a, b)
            }
        }
    }

    /// The even-odd rule: how many edges a ray towards +x crosses.
    fn inside_polygon(&mut self, (x, y): (Reg, Reg), corners: &[(Reg, Reg)]) -> Reg {
        let mut inside = self.code.bool(false);
        for (p, q) in corners.iter().zip(corners.iter().cycle().skip(1)) {
            let from_above = self.code.binary(BinaryOp::Gt, p.1, y);
            let to_above = self.code.binary(BinaryOp::Gt, q.1, y);
            let spans = self.code.binary(BinaryOp::Ne, from_above, to_above);
            // The point lies left of the edge; multiplied out, so that nothing is divided by.
            let (dx, dy) = (
                self.code.binary(BinaryOp::Sub, q.0, p.0),
                self.code.binary(BinaryOp::Sub, q.1, p.1),
            );
            let (ox, oy) =
                (self.code.binary(BinaryOp::Sub, x, p.0), self.code.binary(BinaryOp::Sub, y, p.1));
            let (a, b) =
                (self.code.binary(BinaryOp::Mul, ox, dy), self.code.binary(BinaryOp::Mul, dx, oy));
            let (less, more) =
                (self.code.binary(BinaryOp::Lt, a, b), self.code.binary(BinaryOp::Gt, a, b));
            let left_of = self.code.select(to_above, less, more);
            let crosses = self.code.binary(BinaryOp::And, spans, left_of);
            inside = self.code.binary(BinaryOp::Ne, inside, crosses);
        }
        inside
    }

    /// Whether a value lies between two ends, given in any order.
    fn between(&mut self, value: Reg, a: Reg, b: Reg) -> Reg {
        let (low, high) =
            (self.code.binary(BinaryOp::Min, a, b), self.code.binary(BinaryOp::Max, a, b));
        let above = self.code.binary(BinaryOp::Ge, value, low);
        let below = self.code.binary(BinaryOp::Le, value, high);
        self.code.binary(BinaryOp::And, above, below)
    }
}

fn value<'w>(region: RegionValue) -> Value<'w> {
    Value { ty: Ty::Region, repr: Repr::Region(Arc::new(region)) }
}
