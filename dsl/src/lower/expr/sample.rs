//! Draws in regions, uniform by area.
//!
//! A rectangle, disc, sector or polygon is drawn directly. In a composed region a *candidate* is
//! drawn in a shape around it and accepted where it lies inside; [`CANDIDATES`] of them are written
//! one after the other, the first that is accepted counts, and that one is becomes a requirement of
//! the draw. So what else is drawn keeps its distribution.

use super::super::Lower;
use super::super::value::RegionValue;
use crate::ast::Span;
use crate::lower::interval::Interval;
use crate::lower::triangles::{is_flat, triangulate};
use crate::origins::RegionOrigin;
use crate::problem::Problem;
use crate::problem::facts::{Chance, Implied};
use setpiece_scenario::{BinaryOp, Distribution, Reg, UnaryOp};

/// How many candidates a draw in a composed region tries: at an acceptance of one half one start in
/// 65,536 finds none and is drawn again.
const CANDIDATES: usize = 16;

/// A point that was drawn, and whether it counts.
struct Candidate {
    place: (Reg, Reg),
    accepted: Option<Reg>,
}

impl Lower<'_, '_> {
    /// A point drawn uniformly in a region; `None` after a report.
    pub(crate) fn draw_in(&mut self, region: &RegionValue, span: Span) -> Option<(Reg, Reg)> {
        let is_empty =
            self.bounds(region).is_some_and(|axes| axes.iter().any(|(low, high)| low > high));
        if is_empty {
            let text = self.world.text(span);
            self.report(Problem::new(span, Chance::EmptyRegion { text }));
            return None;
        }
        if let Some(start) = self.start_mut() {
            start.drawn_in.push(RegionOrigin { span, shape: region.clone() });
        }
        let first = self.candidate(region, span)?;
        let Some(mut accepted) = first.accepted else { return Some(first.place) };
        let mut place = first.place;
        for _ in 1..CANDIDATES {
            let next = self.candidate(region, span)?;
            place = (
                self.code.select(accepted, place.0, next.place.0),
                self.code.select(accepted, place.1, next.place.1),
            );
            let also = next.accepted.unwrap_or(accepted);
            accepted = self.code.binary(BinaryOp::Or, accepted, also);
        }
        self.imply(accepted, &Implied::InRegion { text: self.world.text(span) }, Some(span));
        Some(place)
    }

    /// The least and greatest x and y that a point of a region can have, as far as they are known;
    /// the wrong way round where there is none.
    fn bounds(&self, region: &RegionValue) -> Option<[Interval; 2]> {
        let hull = |regs: &[Reg]| {
            let all: Option<Vec<Interval>> = regs.iter().map(|&reg| self.interval(reg)).collect();
            all?.into_iter().reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)))
        };
        let disc = |centre: (Reg, Reg), radius: Reg| {
            let (x, y, r) = (
                self.interval(centre.0)?,
                self.interval(centre.1)?,
                self.interval(radius)?.1.max(0.0),
            );
            Some([(x.0 - r, x.1 + r), (y.0 - r, y.1 + r)])
        };
        let both = |a: &RegionValue, b: &RegionValue, of: fn(Interval, Interval) -> Interval| {
            let ([ax, ay], [bx, by]) = (self.bounds(a)?, self.bounds(b)?);
            Some([of(ax, bx), of(ay, by)])
        };
        match region {
            RegionValue::Rect(a, b) => Some([hull(&[a.0, b.0])?, hull(&[a.1, b.1])?]),
            RegionValue::Circle(centre, radius) | RegionValue::Sector { centre, radius, .. } => {
                disc(*centre, *radius)
            }
            RegionValue::Polygon(corners) => {
                let (xs, ys): (Vec<Reg>, Vec<Reg>) = corners.iter().copied().unzip();
                Some([hull(&xs)?, hull(&ys)?])
            }
            RegionValue::Union(a, b) | RegionValue::Either(_, a, b) => {
                both(a, b, |a, b| (a.0.min(b.0), a.1.max(b.1)))
            }
            RegionValue::Intersection(a, b) => both(a, b, |a, b| (a.0.max(b.0), a.1.min(b.1))),
            RegionValue::Difference(a, _) => self.bounds(a),
        }
    }

    fn candidate(&mut self, region: &RegionValue, span: Span) -> Option<Candidate> {
        let direct = |place| Some(Candidate { place, accepted: None });
        match region {
            RegionValue::Rect(a, b) => direct(self.draw_in_rect(*a, *b)),
            RegionValue::Circle(centre, radius) => direct(self.draw_in_disc(*centre, *radius)),
            RegionValue::Sector { centre, radius, from, width } => {
                direct(self.draw_in_sector(*centre, *radius, *from, *width))
            }
            RegionValue::Polygon(corners) => self.draw_in_polygon(corners, span),
            RegionValue::Intersection(a, b) => {
                let (around, other) = if self.is_smaller(b, a) { (b, a) } else { (a, b) };
                let drawn = self.candidate(around, span)?;
                let inside = self.inside(drawn.place, other);
                Some(self.accepting(drawn, inside))
            }
            RegionValue::Difference(a, b) => {
                let drawn = self.candidate(a, span)?;
                let inside = self.inside(drawn.place, b);
                let outside = self.code.unary(UnaryOp::Not, inside);
                Some(self.accepting(drawn, outside))
            }
            RegionValue::Union(..) => self.draw_in_union(region, span),
            RegionValue::Either(condition, a, b) => {
                let (a, b) = (self.candidate(a, span)?, self.candidate(b, span)?);
                let place = (
                    self.code.select(*condition, a.place.0, b.place.0),
                    self.code.select(*condition, a.place.1, b.place.1),
                );
                if a.accepted.is_none() && b.accepted.is_none() {
                    return direct(place);
                }
                let yes = self.code.bool(true);
                let (a, b) = (a.accepted.unwrap_or(yes), b.accepted.unwrap_or(yes));
                let accepted = self.code.select(*condition, a, b);
                Some(Candidate { place, accepted: Some(accepted) })
            }
        }
    }

    fn accepting(&mut self, drawn: Candidate, also: Reg) -> Candidate {
        let accepted =
            drawn.accepted.map_or(also, |known| self.code.binary(BinaryOp::And, known, also));
        Candidate { place: drawn.place, accepted: Some(accepted) }
    }

    /// One of the parts by the area it is drawn in; what an earlier part holds, only that one may
    /// give.
    fn draw_in_union(&mut self, region: &RegionValue, span: Span) -> Option<Candidate> {
        let mut parts = Vec::new();
        flatten(region, &mut parts);
        let weights: Vec<Reg> = parts.iter().map(|part| self.drawn_area(part)).collect();
        let which = self.random(Distribution::Weighted(weights));
        let mut picked: Option<(Candidate, Reg)> = None;
        for (index, part) in parts.iter().enumerate().rev() {
            let mut drawn = self.candidate(part, span)?;
            for earlier in parts.iter().take(index) {
                let inside = self.inside(drawn.place, earlier);
                let outside = self.code.unary(UnaryOp::Not, inside);
                drawn = self.accepting(drawn, outside);
            }
            let yes = self.code.bool(true);
            let accepted = drawn.accepted.unwrap_or(yes);
            picked = Some(match picked {
                None => (drawn, accepted),
                Some((later, later_accepted)) => {
                    let index = self.code.constant(index as f64);
                    let this = self.code.binary(BinaryOp::Eq, which, index);
                    let place = (
                        self.code.select(this, drawn.place.0, later.place.0),
                        self.code.select(this, drawn.place.1, later.place.1),
                    );
                    let accepted = self.code.select(this, accepted, later_accepted);
                    (Candidate { place, accepted: Some(accepted) }, accepted)
                }
            });
        }
        picked.map(|(drawn, accepted)| Candidate { place: drawn.place, accepted: Some(accepted) })
    }

    /// Whether a region is surely drawn in less area than another.
    fn is_smaller(&mut self, a: &RegionValue, b: &RegionValue) -> bool {
        let (a, b) = (self.drawn_area(a), self.drawn_area(b));
        match (self.interval(a), self.interval(b)) {
            (Some(a), Some(b)) => a.1 < b.0,
            _ => false,
        }
    }

    /// The area in which the candidates of a region are drawn, m².
    fn drawn_area(&mut self, region: &RegionValue) -> Reg {
        match region {
            RegionValue::Rect(a, b) => {
                let (dx, dy) = (
                    self.code.binary(BinaryOp::Sub, b.0, a.0),
                    self.code.binary(BinaryOp::Sub, b.1, a.1),
                );
                let area = self.code.binary(BinaryOp::Mul, dx, dy);
                self.code.unary(UnaryOp::Abs, area)
            }
            RegionValue::Circle(_, radius) => {
                let turn = self.code.constant(std::f64::consts::TAU);
                self.slice_area(*radius, turn)
            }
            RegionValue::Sector { radius, width, .. } => self.slice_area(*radius, *width),
            RegionValue::Polygon(corners) => {
                let Some(known) = self.constant_corners(corners) else {
                    let (low, high) = self.box_around(corners);
                    return self.drawn_area(&RegionValue::Rect(low, high));
                };
                let area = triangulate(&known)
                    .unwrap_or_default()
                    .iter()
                    .map(|triangle| triangle.area)
                    .sum();
                self.code.constant(area)
            }
            RegionValue::Intersection(a, b) => {
                if self.is_smaller(b, a) {
                    self.drawn_area(b)
                } else {
                    self.drawn_area(a)
                }
            }
            RegionValue::Difference(a, _) => self.drawn_area(a),
            RegionValue::Either(condition, a, b) => {
                let (a, b) = (self.drawn_area(a), self.drawn_area(b));
                self.code.select(*condition, a, b)
            }
            RegionValue::Union(a, b) => {
                let (a, b) = (self.drawn_area(a), self.drawn_area(b));
                self.code.binary(BinaryOp::Add, a, b)
            }
        }
    }

    fn slice_area(&mut self, radius: Reg, width: Reg) -> Reg {
        let half = self.code.constant(0.5);
        let square = self.code.binary(BinaryOp::Mul, radius, radius);
        let slice = self.code.binary(BinaryOp::Mul, square, width);
        self.code.binary(BinaryOp::Mul, slice, half)
    }

    fn draw_in_rect(&mut self, a: (Reg, Reg), b: (Reg, Reg)) -> (Reg, Reg) {
        let mut along = |a: Reg, b: Reg| {
            let (low, high) =
                (self.code.binary(BinaryOp::Min, a, b), self.code.binary(BinaryOp::Max, a, b));
            self.random(Distribution::Uniform(low, high))
        };
        let x = along(a.0, b.0);
        (x, along(a.1, b.1))
    }

    /// A point drawn uniformly in a disc.
    pub(crate) fn draw_in_disc(&mut self, centre: (Reg, Reg), radius: Reg) -> (Reg, Reg) {
        let (from, turn) = (self.code.constant(0.0), self.code.constant(std::f64::consts::TAU));
        self.draw_in_sector(centre, radius, from, turn)
    }

    fn draw_in_sector(
        &mut self,
        centre: (Reg, Reg),
        radius: Reg,
        from: Reg,
        width: Reg,
    ) -> (Reg, Reg) {
        let (zero, one) = (self.code.constant(0.0), self.code.constant(1.0));
        let share = self.random(Distribution::Uniform(zero, one));
        let over = self.random(Distribution::Uniform(zero, width));
        let angle = self.code.binary(BinaryOp::Add, from, over);
        let root = self.code.unary(UnaryOp::Sqrt, share);
        let r = self.code.binary(BinaryOp::Mul, radius, root);
        let (cos, sin) =
            (self.code.unary(UnaryOp::Cos, angle), self.code.unary(UnaryOp::Sin, angle));
        let (dx, dy) =
            (self.code.binary(BinaryOp::Mul, r, cos), self.code.binary(BinaryOp::Mul, r, sin));
        (
            self.code.binary(BinaryOp::Add, centre.0, dx),
            self.code.binary(BinaryOp::Add, centre.1, dy),
        )
    }

    /// One of the polygon's triangles by its area, and a point in it; where the corners are not
    /// constant, a candidate of the rectangle around them.
    fn draw_in_polygon(&mut self, corners: &[(Reg, Reg)], span: Span) -> Option<Candidate> {
        let Some(known) = self.constant_corners(corners) else {
            let (low, high) = self.box_around(corners);
            let place = self.draw_in_rect(low, high);
            let inside = self.inside(place, &RegionValue::Polygon(corners.to_vec()));
            return Some(Candidate { place, accepted: Some(inside) });
        };
        let Some(triangles) = triangulate(&known) else {
            self.report(Problem::new(span, Chance::EmptyPolygon { is_flat: is_flat(&known) }));
            return None;
        };
        let weights: Vec<Reg> =
            triangles.iter().map(|triangle| self.code.constant(triangle.area)).collect();
        let which = self.random(Distribution::Weighted(weights));
        let mut corner = |nth: usize, axis: usize| {
            let mut picked = None;
            for (index, triangle) in triangles.iter().enumerate().rev() {
                let value = self.code.constant(triangle.corners[nth][axis]);
                let index = self.code.constant(index as f64);
                let this = self.code.binary(BinaryOp::Eq, which, index);
                picked = Some(picked.map_or(value, |later| self.code.select(this, value, later)));
            }
            picked
        };
        let a = (corner(0, 0)?, corner(0, 1)?);
        let b = (corner(1, 0)?, corner(1, 1)?);
        let c = (corner(2, 0)?, corner(2, 1)?);
        // Osada et al. 2002, equation 1: (1 - √u) a + √u (1 - v) b + √u v c.
        let (zero, one) = (self.code.constant(0.0), self.code.constant(1.0));
        let u = self.random(Distribution::Uniform(zero, one));
        let v = self.random(Distribution::Uniform(zero, one));
        let root = self.code.unary(UnaryOp::Sqrt, u);
        let first = self.code.binary(BinaryOp::Sub, one, root);
        let third = self.code.binary(BinaryOp::Mul, root, v);
        let second = self.code.binary(BinaryOp::Sub, root, third);
        let mut mix = |a: Reg, b: Reg, c: Reg| {
            let (a, b) = (
                self.code.binary(BinaryOp::Mul, first, a),
                self.code.binary(BinaryOp::Mul, second, b),
            );
            let (c, ab) =
                (self.code.binary(BinaryOp::Mul, third, c), self.code.binary(BinaryOp::Add, a, b));
            self.code.binary(BinaryOp::Add, ab, c)
        };
        let place = (mix(a.0, b.0, c.0), mix(a.1, b.1, c.1));
        Some(Candidate { place, accepted: None })
    }

    fn constant_corners(&self, corners: &[(Reg, Reg)]) -> Option<Vec<[f64; 2]>> {
        let known =
            |&(x, y): &(Reg, Reg)| Some([self.code.constant_of(x)?, self.code.constant_of(y)?]);
        corners.iter().map(known).collect()
    }

    /// The least and the greatest coordinates of some corners.
    fn box_around(&mut self, corners: &[(Reg, Reg)]) -> ((Reg, Reg), (Reg, Reg)) {
        let mut end = |op: BinaryOp, of: fn(&(Reg, Reg)) -> Reg| {
            let all = corners.iter().map(of).reduce(|a, b| self.code.binary(op, a, b));
            all.unwrap_or(Reg(0))
        };
        let low = (end(BinaryOp::Min, |at| at.0), end(BinaryOp::Min, |at| at.1));
        (low, (end(BinaryOp::Max, |at| at.0), end(BinaryOp::Max, |at| at.1)))
    }
}

fn flatten<'r>(region: &'r RegionValue, parts: &mut Vec<&'r RegionValue>) {
    match region {
        RegionValue::Union(a, b) => {
            flatten(a, parts);
            flatten(b, parts);
        }
        part => parts.push(part),
    }
}
