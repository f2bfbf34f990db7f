//! Reasons why figures may be outside: by row, or by group of rows that share a cause.

use crate::figure::Figure;

/// A cause of figures outside, and their rows.
pub(crate) struct Reason {
    /// Rows: their name contains all the words of one of these.
    rows: &'static [&'static [&'static str]],
    /// The figures of these rows that it explains; all if empty.
    figures: &'static [&'static str],
    /// The cause, and the evidence.
    pub(crate) why: &'static str,
}

/// The reasons, in the order of their numbers.
pub(crate) const REASONS: &[Reason] = &[Reason {
    rows: &[&["kick: alone, stand short, then L:"], &["kick: alone, sprint high, then sprint:"]],
    figures: &["peak"],
    why: "A pass flies to one of two heights there, by the order in which the engine processes the teams \
          (`lab/data/README.md`: 0.9 and 2.0 m, 2.4 and 3.6 m here, each with a deviation under 0.3 m). The mean lies \
          between them; ours is near the one of odd seeds.",
}];

impl Reason {
    /// Whether it explains a figure of a row.
    fn explains(&self, row: &Figure, name: &str) -> bool {
        let named = self.rows.iter().any(|words| words.iter().all(|word| row.what.contains(word)));
        named && (self.figures.is_empty() || self.figures.contains(&name))
    }
}

/// The numbers of the reasons why a row is outside; none if one of its figures has no reason.
pub(crate) fn explanation(row: &Figure) -> Option<Vec<usize>> {
    let mut numbers = Vec::new();
    for part in row.outside() {
        let reason = REASONS.iter().position(|reason| reason.explains(row, &part.name))?;
        if !numbers.contains(&(reason + 1)) {
            numbers.push(reason + 1);
        }
    }
    Some(numbers)
}

/// Reasons that no longer explain anything.
pub(crate) fn idle<'a>(
    outside: impl Iterator<Item = &'a Figure> + Clone,
) -> impl Iterator<Item = String> {
    let used: Vec<usize> = outside.filter_map(explanation).flatten().collect();
    let idle = (1..).zip(REASONS).filter(move |(number, _)| !used.contains(number));
    idle.map(|(number, reason)| format!("reason {number} explains no row: {}", reason.why))
}
