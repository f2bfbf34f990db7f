//! Tables: numbers over a part of the pitch, and how they are looked up.

use super::Lower;
use super::script::named_file;
use super::value::{LiteralFrame, RegionValue, Scope, Value};
use crate::ast::{Arg, Expr, ExprKind, Span, Spanned, TableItem, TableRows};
use crate::check::types::Ty;
use crate::problem::Problem;
use crate::problem::facts::Tables;
use setpiece_scenario::table::TABLE_MAX;
use setpiece_scenario::vocabulary::PitchRegion;
use setpiece_scenario::{BinaryOp, Reg, Table};

/// A rectangle in the reader's frame: the corner with the least x and y, and the other one.
#[derive(Clone, Copy)]
pub(crate) struct Rectangle {
    pub(super) low: (Reg, Reg),
    pub(super) high: (Reg, Reg),
}

impl<'w> Lower<'_, 'w> {
    /// `xt(ball)`, `xt(ball, linear)`: the number at a place, in the reader's frame.
    pub(super) fn call_table(
        &mut self,
        item: &'w TableItem,
        args: &'w [Arg],
        span: Span,
    ) -> Value<'w> {
        let is_plain =
            |arg: &&Arg| arg.key.is_none() && arg.binder.is_none() && arg.filter.is_none();
        let plain = args.iter().take_while(is_plain).count() == args.len();
        let is_linear = |how: &Expr| matches!(&how.kind, ExprKind::Name(word) if word == "linear");
        let (at, linear) = match args {
            [at] if plain => (&at.value, false),
            [at, how] if plain && is_linear(&how.value) => (&at.value, true),
            [at, how]
                if plain
                    && !is_linear(&at.value)
                    && matches!(how.value.kind, ExprKind::Name(_)) =>
            {
                let (name, word) = (item.name.node.clone(), self.world.text(how.value.span));
                return self.fail(Problem::new(how.value.span, Tables::HowWord { name, word }));
            }
            _ => {
                let name = item.name.node.clone();
                return self.fail(Problem::new(span, Tables::Arguments { name }));
            }
        };
        let place = self.want_point(at);
        self.look_up(item, place, linear)
            .map_or_else(Value::error, |number| Value::one(Ty::Number, number))
    }

    /// The number at a place of the world's frame; `None` after a report.
    pub(super) fn look_up(
        &mut self,
        item: &'w TableItem,
        place: (Reg, Reg),
        linear: bool,
    ) -> Option<Reg> {
        let place = self.turned(place);
        let over = self.rectangle(item.over.as_ref());
        let (table, over) = (self.table_of(item)?, over?);
        let x = self.share_of(place.0, over.low.0, over.high.0);
        let y = self.share_of(place.1, over.low.1, over.high.1);
        Some(self.code.look_up(table, (x, y), linear))
    }

    /// How far a coordinate is from one to another.
    fn share_of(&mut self, at: Reg, low: Reg, high: Reg) -> Reg {
        let from = self.code.binary(BinaryOp::Sub, at, low);
        let whole = self.code.binary(BinaryOp::Sub, high, low);
        self.code.binary(BinaryOp::Div, from, whole)
    }

    /// A rectangle, the pitch if nothing is written; `None` after a report.
    pub(crate) fn rectangle(&mut self, over: Option<&'w Expr>) -> Option<Rectangle> {
        let (a, b) = match over {
            None => {
                let pitch = PitchRegion::Pitch.rect()?;
                self.corners(pitch)
            }
            Some(over) => {
                let region = self.region(over)?;
                let RegionValue::Rect(a, b) = *region else {
                    let text = self.world.text(over.span);
                    self.report(Problem::new(over.span, Tables::NoRectangle { text }));
                    return None;
                };
                (a, b)
            }
        };
        let (a, b) = (self.turned(a), self.turned(b));
        let mut end = |op| (self.code.binary(op, a.0, b.0), self.code.binary(op, a.1, b.1));
        Some(Rectangle { low: end(BinaryOp::Min), high: end(BinaryOp::Max) })
    }

    /// The program's number of a table; `None` after a report.
    pub(crate) fn table_of(&mut self, item: &'w TableItem) -> Option<u32> {
        if let Some(known) = self.code.known_table(item.name.span) {
            return Some(known);
        }
        let table = match &item.rows {
            TableRows::Written(rows) => self.written_table(rows)?,
            TableRows::File(path) => self.table_file(path)?,
        };
        Some(self.code.add_table(item.name.span, table))
    }

    fn written_table(&self, rows: &'w Expr) -> Option<Table> {
        let ExprKind::List(list) = &rows.kind else {
            self.report(Problem::new(rows.span, Tables::NoRows));
            return None;
        };
        let mut lower = Lower::constant(self.world, Scope::new(false, LiteralFrame::World));
        let found = self.world.found();
        let mut read = ReadRows::default();
        for row in list {
            let ExprKind::List(numbers) = &row.kind else {
                self.report(Problem::new(row.span, Tables::NoRows));
                return None;
            };
            let mut values = Vec::new();
            for number in numbers {
                let reg = lower.want_reg(number, Ty::Number);
                match lower.code.constant_of(reg) {
                    Some(value) => values.push(value),
                    None if self.world.found() > found || lower.code.is_unknown(reg) => {
                        return None;
                    }
                    None => {
                        let text = self.world.text(number.span);
                        self.report(Problem::new(number.span, Tables::NoNumber { text }));
                        return None;
                    }
                }
            }
            self.add_row(&mut read, values, row.span)?;
        }
        self.whole(read, rows.span)
    }

    /// Reads comma-separated values; without commas, semicolons or blanks separate. A line has one
    /// kind of separator.
    fn table_file(&self, path: &Spanned<String>) -> Option<Table> {
        let world = self.world;
        let file = named_file(world, path)?;
        let text = &world.library.sources.get(file)?.text;
        let mut read = ReadRows::default();
        let mut start = 0;
        for line in text.split_inclusive('\n') {
            let span = |at: usize, length: usize| Span {
                file,
                start: (start + at) as u32,
                end: (start + at + length) as u32,
            };
            let content = line.trim_end();
            let mut values = Vec::new();
            let mut at = 0;
            let by = [';', ','].into_iter().find(|by| content.contains(*by));
            let separates = |c: char| by.map_or(c.is_whitespace(), |by| c == by);
            if content.trim_start().starts_with('#') || content.trim().is_empty() {
                start += line.len();
                continue;
            }
            for cell in content.split(separates) {
                let blanks = cell.len() - cell.trim_start().len();
                let word = span(at + blanks, cell.trim().len());
                at += cell.len()
                    + content[at + cell.len()..].chars().next().map_or(0, char::len_utf8);
                // Several blanks are one separator; several commas have nothing between them.
                if cell.is_empty() && by.is_none() {
                    continue;
                }
                match cell.trim_start_matches('\u{feff}').trim().parse::<f64>() {
                    Ok(value) if value.is_finite() => values.push(value),
                    _ => {
                        let text = cell.trim().to_owned();
                        self.report(Problem::new(word, Tables::NoNumberInFile { text }));
                        return None;
                    }
                }
            }
            if !values.is_empty() {
                self.add_row(&mut read, values, span(0, content.len()))?;
            }
            start += line.len();
        }
        self.whole(read, path.span)
    }

    fn add_row(&self, read: &mut ReadRows, values: Vec<f64>, row: Span) -> Option<()> {
        if read.columns != 0 && values.len() != read.columns {
            let fact = Tables::UnequalRows { found: values.len(), wanted: read.columns };
            self.report(Problem::new(row, fact));
            return None;
        }
        read.columns = values.len();
        read.values.extend(values);
        if read.values.len() > TABLE_MAX {
            self.report(Problem::new(row, Tables::TooLarge { most: TABLE_MAX }));
            return None;
        }
        Some(())
    }

    fn whole(&self, read: ReadRows, at: Span) -> Option<Table> {
        if read.values.is_empty() {
            self.report(Problem::new(at, Tables::NoRows));
            return None;
        }
        Some(Table { columns: read.columns as u32, values: read.values })
    }
}

/// The rows of a table so far.
#[derive(Default)]
struct ReadRows {
    columns: usize,
    values: Vec<f64>,
}
