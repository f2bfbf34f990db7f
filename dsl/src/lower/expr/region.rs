//! Regions: constructors, and whether a point lies inside.

use super::super::Lower;
use super::super::value::{RegionValue, Repr, Value};
use crate::ast::{Arg, Expr, Span};
use crate::check::types::Ty;
use setpiece_scenario::vocabulary::Function;
use setpiece_scenario::{BinaryOp, Reg, UnaryOp};
use std::rc::Rc;

impl<'w> Lower<'_, 'w> {
    /// Lowers a region; `None` after a report.
    pub(crate) fn region(&mut self, expr: &'w Expr) -> Option<Rc<RegionValue>> {
        match self.want(expr, Ty::Region).repr {
            Repr::Region(region) => Some(region),
            _ => None,
        }
    }

    pub(super) fn region_call(&mut self, function: Function, args: &'w [Arg], span: Span) -> Value<'w> {
        let names: &[&str] = if function == Function::Rect { &["from", "to"] } else { &["centre", "radius"] };
        let Some(given) = self.arguments(function.name(), args, span, names, 2) else { return Value::error() };
        let &[Some(a), Some(b)] = given.as_slice() else { return Value::error() };
        let first = self.want(a, Ty::Point);
        let second = self.want(b, if function == Function::Rect { Ty::Point } else { Ty::LENGTH });
        if first.is_error() || second.is_error() {
            return Value::error();
        }
        let corner = self.pair(&first);
        let region = match function {
            Function::Rect => RegionValue::Rect(corner, self.pair(&second)),
            _ => RegionValue::Circle(corner, self.reg(&second)),
        };
        Value { ty: Ty::Region, repr: Repr::Region(Rc::new(region)) }
    }

    /// Whether a point lies in a region, its edge included.
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
        }
    }

    /// Whether a value lies between two ends, given in any order.
    fn between(&mut self, value: Reg, a: Reg, b: Reg) -> Reg {
        let (low, high) = (self.code.binary(BinaryOp::Min, a, b), self.code.binary(BinaryOp::Max, a, b));
        let above = self.code.binary(BinaryOp::Ge, value, low);
        let below = self.code.binary(BinaryOp::Le, value, high);
        self.code.binary(BinaryOp::And, above, below)
    }
}
