//! Tables of numbers over a part of the pitch.

use serde::{Deserialize, Serialize};

/// The most numbers of a table.
pub const TABLE_MAX: usize = 16_384;

/// Numbers over a rectangle, row by row.
///
/// Rows lie along y from its least value on, the numbers of a row along x from its least value on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Table {
    /// Numbers in a row, at least 1.
    pub columns: u32,
    /// All rows.
    pub values: Vec<f64>,
}

impl Table {
    /// The number at a place, given as shares of the rectangle's length and width. Outside, it is
    /// that of the nearest cell. NaN for a place that is NaN.
    #[inline]
    pub fn at(&self, x: f64, y: f64) -> f64 {
        if x.is_nan() || y.is_nan() {
            return f64::NAN;
        }
        let (columns, rows) = self.size();
        self.cell(cell(x, columns), cell(y, rows))
    }

    /// The number at a place, linear between the centres of the cells around it.
    #[inline]
    pub fn between(&self, x: f64, y: f64) -> f64 {
        if x.is_nan() || y.is_nan() {
            return f64::NAN;
        }
        let (columns, rows) = self.size();
        let ((left, right, along), (top, bottom, across)) = (around(x, columns), around(y, rows));
        let row = |row: usize| {
            let (a, b) = (self.cell(left, row), self.cell(right, row));
            a + (b - a) * along
        };
        let (a, b) = (row(top), row(bottom));
        a + (b - a) * across
    }

    /// Columns and rows.
    pub fn size(&self) -> (usize, usize) {
        let columns = (self.columns as usize).max(1);
        (columns, self.values.len() / columns)
    }

    fn cell(&self, column: usize, row: usize) -> f64 {
        let at = row * self.columns as usize + column;
        self.values.get(at).copied().unwrap_or(f64::NAN)
    }
}

/// The cell of a share. The cast saturates: nothing below 0.
fn cell(share: f64, cells: usize) -> usize {
    ((share * cells as f64) as usize).min(cells.saturating_sub(1))
}

/// The two cells between whose centres a share lies, and how far from the first to the second.
fn around(share: f64, cells: usize) -> (usize, usize, f64) {
    let last = cells.saturating_sub(1);
    let from_first = (share * cells as f64 - 0.5).clamp(0.0, last as f64);
    let first = (from_first as usize).min(last);
    (first, (first + 1).min(last), from_first - first as f64)
}

#[cfg(test)]
mod tests {
    use super::Table;

    #[test]
    fn a_place_has_the_number_of_its_cell() {
        let table = Table { columns: 3, values: vec![1.0, 2.0, 3.0, 4.0, 5.0, 6.0] };
        assert_eq!(table.at(0.0, 0.0), 1.0);
        assert_eq!(table.at(0.4, 0.4), 2.0);
        assert_eq!(table.at(1.0, 0.5), 6.0);
        assert_eq!([table.at(-9.0, 2.0), table.at(1.0e300, -1.0e300)], [4.0, 3.0]);
        assert!(table.at(f64::NAN, 0.5).is_nan() && table.between(0.5, f64::NAN).is_nan());
    }

    #[test]
    fn between_centres_it_is_linear() {
        let table = Table { columns: 2, values: vec![0.0, 1.0, 2.0, 3.0] };
        assert_eq!(table.between(0.25, 0.25), 0.0);
        assert_eq!(table.between(0.5, 0.25), 0.5);
        assert_eq!(table.between(0.5, 0.5), 1.5);
        assert_eq!(table.between(1.0, 1.0), 3.0);
        assert_eq!(table.between(-5.0, 1.0), 2.0);
    }
}
