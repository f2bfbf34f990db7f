//! Points on a grid, for loops: `sum(xt(p) for p in grid(16, 12))`.

use super::super::Lower;
use super::super::table::Rectangle;
use super::super::value::Value;
use crate::ast::{Arg, Expr, ExprKind};
use crate::check::types::Ty;
use crate::problem::Problem;
use crate::problem::facts::Calls;
use setpiece_scenario::vocabulary::Function;
use setpiece_scenario::{BinaryOp, Reg, UnaryOp};

/// The most points of a grid.
const POINTS_MAX: f64 = 4096.0;

/// The centres of the cells of a grid, numbered row by row.
#[derive(Clone, Copy)]
pub(super) struct Grid {
    columns: f64,
    rows: f64,
    over: Rectangle,
}

/// The arguments of `grid(…)`, if a set is one.
pub(super) fn as_grid(set: &Expr) -> Option<&[Arg]> {
    match &set.kind {
        ExprKind::Call { name, args } if name.node == Function::Grid.name() => Some(args),
        _ => None,
    }
}

impl Grid {
    /// How many points it has.
    pub(super) fn points(&self) -> u32 {
        (self.columns * self.rows) as u32
    }
}

impl<'w> Lower<'_, 'w> {
    /// Reads a grid; `None` after a report.
    pub(super) fn grid(&mut self, set: &'w Expr, args: &'w [Arg]) -> Option<Grid> {
        let names = ["columns", "rows", "region"];
        let given = self.arguments(Function::Grid.name(), args, set.span, &names, 2)?;
        let &[columns, rows, region] = given.as_slice() else { return None };
        let mut side = |expr: Option<&'w Expr>| {
            let expr = expr?;
            let reg = self.want_reg(expr, Ty::Int);
            let known = self.code.constant_of(reg).filter(|&n| (1.0..=POINTS_MAX).contains(&n));
            if known.is_none() && !self.code.is_unknown(reg) {
                self.report(Problem::new(expr.span, Calls::GridSide { most: POINTS_MAX }));
            }
            known
        };
        let (columns, rows) = (side(columns)?, side(rows)?);
        if columns * rows > POINTS_MAX {
            self.report(Problem::new(set.span, Calls::GridSide { most: POINTS_MAX }));
            return None;
        }
        Some(Grid { columns, rows, over: self.rectangle(region)? })
    }

    /// A point of a grid by its number; none for nobody's number.
    pub(super) fn grid_point(&mut self, grid: &Grid, number: Reg) -> Value<'w> {
        let columns = self.code.constant(grid.columns);
        let row = self.code.binary(BinaryOp::Div, number, columns);
        let row = self.code.unary(UnaryOp::Floor, row);
        // Whole numbers as small as these are divided and multiplied without an error.
        let before = self.code.binary(BinaryOp::Mul, row, columns);
        let column = self.code.binary(BinaryOp::Sub, number, before);
        let mut along = |cell: Reg, cells: f64, low: Reg, high: Reg| {
            let cells = self.code.constant(cells);
            let whole = self.code.binary(BinaryOp::Sub, high, low);
            let size = self.code.binary(BinaryOp::Div, whole, cells);
            let half = self.code.constant(0.5);
            let half = self.code.binary(BinaryOp::Mul, size, half);
            let first = self.code.binary(BinaryOp::Add, low, half);
            let from = self.code.binary(BinaryOp::Mul, cell, size);
            self.code.binary(BinaryOp::Add, first, from)
        };
        let x = along(column, grid.columns, grid.over.low.0, grid.over.high.0);
        let y = along(row, grid.rows, grid.over.low.1, grid.over.high.1);
        Value::two(Ty::Point, self.turned((x, y)))
    }

    /// The point that a loop has chosen: impossible if it chose none.
    pub(super) fn chosen_point(&mut self, grid: &Grid, number: Reg) -> Value<'w> {
        let zero = self.code.constant(0.0);
        let any = self.code.binary(BinaryOp::Ge, number, zero);
        let none = self.code.binary(BinaryOp::Div, zero, zero);
        let number = self.code.select(any, number, none);
        self.grid_point(grid, number)
    }
}
