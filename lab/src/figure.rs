//! A figure: ours and the measured one, the allowed range, and whether it is inside.

use crate::explained::explanation;
use std::fmt::Write as _;

/// A row of the report: one figure of ours and theirs, or several of one scene. It is inside if all
/// of them are.
#[derive(Clone, Debug)]
pub(crate) struct Figure {
    /// What is measured.
    pub(crate) what: String,
    /// The figures of the row.
    pub(crate) parts: Vec<FigurePart>,
}

/// One figure of a row.
#[derive(Clone, Debug)]
pub(crate) struct FigurePart {
    /// Its name, if a row has several.
    pub(crate) name: String,
    /// Theirs, as measured.
    pub(crate) theirs: String,
    /// The allowed range of ours.
    pub(crate) range: [f64; 2],
    /// Ours.
    pub(crate) ours: f64,
}

impl FigurePart {
    /// A named figure that must equal theirs within a tolerance.
    pub(crate) fn around(name: &str, theirs: f64, give: f64, ours: f64) -> FigurePart {
        FigurePart {
            name: name.to_owned(),
            theirs: short(theirs),
            range: [theirs - give, theirs + give],
            ours,
        }
    }
}

/// The figures of a section of the measurements.
#[derive(Clone, Debug)]
pub(crate) struct Section {
    /// Its number there. Figures count from a hundred times that, and from the hundredth on from a
    /// thousand times that.
    pub(crate) number: u16,
    /// Its name.
    pub(crate) title: &'static str,
    /// How ours were measured.
    pub(crate) how: String,
    /// The figures, in order.
    pub(crate) figures: Vec<Figure>,
    /// Notes without a verdict.
    pub(crate) notes: Vec<String>,
}

impl Section {
    /// An empty section.
    pub(crate) fn new(number: u16, title: &'static str, how: impl Into<String>) -> Section {
        Section { number, title, how: how.into(), figures: Vec::new(), notes: Vec::new() }
    }

    /// Adds a figure that must lie within a range.
    pub(crate) fn within(
        &mut self,
        what: impl Into<String>,
        theirs: impl Into<String>,
        range: [f64; 2],
        ours: f64,
    ) {
        self.row(
            what,
            vec![FigurePart { name: String::new(), theirs: theirs.into(), range, ours }],
        );
    }

    /// Adds a row of several figures.
    pub(crate) fn row(&mut self, what: impl Into<String>, parts: Vec<FigurePart>) {
        self.figures.push(Figure { what: what.into(), parts });
    }

    /// Adds a figure that must equal theirs within a share.
    pub(crate) fn near(&mut self, what: impl Into<String>, theirs: f64, share: f64, ours: f64) {
        let give = theirs.abs() * share;
        self.within(what, short(theirs), [theirs - give, theirs + give], ours);
    }

    /// The number of its figure `index`.
    pub(crate) fn id(&self, index: usize) -> u32 {
        let number = u32::from(self.number);
        if index < 99 { number * 100 + 1 + index as u32 } else { number * 1000 + 1 + index as u32 }
    }

    /// Figures that are outside, with their numbers.
    pub(crate) fn outside(&self) -> impl Iterator<Item = (u32, &Figure)> {
        self.figures
            .iter()
            .enumerate()
            .filter(|(_, figure)| !figure.is_inside())
            .map(|(i, f)| (self.id(i), f))
    }

    /// The section as Markdown.
    pub(crate) fn markdown(&self) -> String {
        let mut text = format!("## {}. {}\n\n{}\n\n", self.number, self.title, self.how);
        text.push_str("| | figure | theirs | wanted | ours | |\n|---|---|---|---|---|---|\n");
        for (i, figure) in self.figures.iter().enumerate() {
            let id = self.id(i);
            let verdict = match explanation(figure) {
                _ if figure.is_inside() => "✓".to_owned(),
                None => "**outside**".to_owned(),
                Some(reasons) => {
                    let numbers: Vec<String> = reasons.iter().map(usize::to_string).collect();
                    format!("outside [{}](#explained)", numbers.join(", "))
                }
            };
            let _ = writeln!(
                text,
                "| C-{id} | {} | {} | {} | {} | {verdict} |",
                figure.what,
                figure.joined(|part| part.theirs.clone()),
                figure.wanted(),
                figure.ours()
            );
        }
        for line in &self.notes {
            let _ = write!(text, "\n{line}\n");
        }
        text
    }
}

impl Figure {
    /// Whether all figures are in their ranges.
    pub(crate) fn is_inside(&self) -> bool {
        self.parts.iter().all(FigurePart::is_inside)
    }

    /// The figures of the row that are outside.
    pub(crate) fn outside(&self) -> impl Iterator<Item = &FigurePart> {
        self.parts.iter().filter(|part| !part.is_inside())
    }

    /// The allowed ranges, in words.
    pub(crate) fn wanted(&self) -> String {
        self.joined(FigurePart::wanted)
    }

    /// Ours, in words.
    pub(crate) fn ours(&self) -> String {
        self.joined(|part| short(part.ours))
    }

    /// Joins a text of every part, in order.
    fn joined(&self, what: impl Fn(&FigurePart) -> String) -> String {
        self.parts.iter().map(what).collect::<Vec<_>>().join(" · ")
    }
}

impl FigurePart {
    /// Whether ours is in the range; NaN never is.
    fn is_inside(&self) -> bool {
        // Tolerates the rounding of a decimal limit.
        let slack = 1e-6;
        self.ours >= self.range[0] - slack && self.ours <= self.range[1] + slack
    }

    /// The allowed range, in words.
    fn wanted(&self) -> String {
        match self.range {
            [low, high] if low == f64::NEG_INFINITY => format!("≤ {}", short(high)),
            [low, high] if high == f64::INFINITY => format!("≥ {}", short(low)),
            [low, high] => format!("{} – {}", short(low), short(high)),
        }
    }
}

/// A number with three significant digits.
pub(crate) fn short(value: f64) -> String {
    if !value.is_finite() {
        return "none".to_owned();
    }
    let digits = match value.abs() {
        v if v >= 100.0 => 0,
        v if v >= 10.0 => 1,
        v if v >= 1.0 => 2,
        _ => 3,
    };
    let text = format!("{value:.digits$}");
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    }
}
