//! A parameter, checked.

use super::interval::Interval;
use crate::ast::{Expr, Ident};
use crate::check::types::Ty;
use setpiece_scenario::Param;
use setpiece_scenario::vocabulary::Type;
use std::rc::Rc;

/// A parameter, checked.
pub(crate) struct ParamInfo<'w> {
    /// What the scenario carries.
    pub(crate) param: Param,
    /// Its type in expressions.
    pub(crate) ty: Ty,
    /// Its words, if it is a string.
    pub(crate) choices: Rc<[String]>,
    /// Where it is declared.
    pub(crate) name: &'w Ident,
    /// Its place among the scenario's parameters.
    pub(crate) index: u32,
    /// Instead of a parameter: a child's argument that is drawn or computed.
    pub(crate) bound: Option<&'w Expr>,
    /// The type it was declared with.
    pub(crate) declared: Option<Ty>,
}

impl ParamInfo<'_> {
    /// Least and greatest value.
    pub(crate) fn interval(&self) -> Option<Interval> {
        if let (Some(least), Some(greatest)) = (
            self.param.values.iter().copied().reduce(f64::min),
            self.param.values.iter().copied().reduce(f64::max),
        ) {
            return Some((least, greatest));
        }
        match self.param.ty {
            Type::Bool => Some((0.0, 1.0)),
            Type::Team => Some((-1.0, 1.0)),
            _ => self.param.range,
        }
    }
}
