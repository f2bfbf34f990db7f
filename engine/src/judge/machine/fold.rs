//! How the values of a loop become one.

use setpiece_scenario::FoldKind;

/// A fold under way.
pub(super) struct Folding {
    kind: FoldKind,
    n: u32,
    value: f64,
    element: f64,
}

impl Folding {
    pub(super) fn new(kind: FoldKind) -> Folding {
        let value = match kind {
            FoldKind::All => 1.0,
            FoldKind::Min | FoldKind::ArgMin => f64::INFINITY,
            FoldKind::Max | FoldKind::ArgMax => f64::NEG_INFINITY,
            FoldKind::Nothing | FoldKind::Count | FoldKind::Sum | FoldKind::Mean | FoldKind::Any => 0.0,
        };
        Folding { kind, n: 0, value, element: -1.0 }
    }

    /// Takes an element and its value.
    pub(super) fn add(&mut self, element: f64, value: f64) {
        self.n += 1;
        match self.kind {
            FoldKind::Sum | FoldKind::Mean => self.value += value,
            FoldKind::Min if value < self.value || value.is_nan() => self.value = value,
            FoldKind::Max if value > self.value || value.is_nan() => self.value = value,
            FoldKind::Any if super::truth(value) => self.value = 1.0,
            FoldKind::All if !super::truth(value) => self.value = 0.0,
            // An impossible value compares false, so it is never the least or greatest.
            FoldKind::ArgMin if value < self.value => (self.value, self.element) = (value, element),
            FoldKind::ArgMax if value > self.value => (self.value, self.element) = (value, element),
            // An infinite value is still somebody's.
            FoldKind::ArgMin | FoldKind::ArgMax if self.element < 0.0 && value == self.value => self.element = element,
            // Counting needs no value; a value that is not extreme changes nothing.
            _ => {}
        }
    }

    /// What came of it.
    pub(super) fn result(&self) -> f64 {
        match self.kind {
            FoldKind::Nothing => 0.0,
            FoldKind::Count => self.n.into(),
            FoldKind::ArgMin | FoldKind::ArgMax => self.element,
            FoldKind::Mean | FoldKind::Min | FoldKind::Max if self.n == 0 => f64::NAN,
            FoldKind::Mean => self.value / f64::from(self.n),
            FoldKind::Sum | FoldKind::Any | FoldKind::All | FoldKind::Min | FoldKind::Max => self.value,
        }
    }
}
