//! Reduces the values of a loop to one, lane by lane.

use super::{each_lane, truth};
use setpiece_scenario::FoldKind;

/// A fold in progress.
pub(super) struct Folding<const N: usize> {
    kind: FoldKind,
    n: [u32; N],
    value: [f64; N],
    element: [f64; N],
}

impl<const N: usize> Folding<N> {
    pub(super) fn new(kind: FoldKind) -> Folding<N> {
        let value = match kind {
            FoldKind::All => 1.0,
            FoldKind::Min | FoldKind::ArgMin => f64::INFINITY,
            FoldKind::Max | FoldKind::ArgMax => f64::NEG_INFINITY,
            FoldKind::Nothing
            | FoldKind::Count
            | FoldKind::Sum
            | FoldKind::Mean
            | FoldKind::Any => 0.0,
        };
        Folding { kind, n: [0; N], value: [value; N], element: [-1.0; N] }
    }

    /// Adds an element and its values, in the lanes that count it.
    #[inline]
    pub(super) fn add(&mut self, element: f64, counts: [bool; N], values: [f64; N]) {
        for (n, counts) in self.n.iter_mut().zip(counts) {
            *n += u32::from(counts);
        }
        match self.kind {
            FoldKind::Nothing | FoldKind::Count => {}
            FoldKind::Sum | FoldKind::Mean => self.each(counts, values, |sum, value| sum + value),
            FoldKind::Min => {
                self.each(counts, values, |least, value| {
                    if value < least || value.is_nan() { value } else { least }
                });
            }
            FoldKind::Max => {
                self.each(counts, values, |most, value| {
                    if value > most || value.is_nan() { value } else { most }
                });
            }
            FoldKind::Any => {
                self.each(counts, values, |any, value| if truth(value) { 1.0 } else { any });
            }
            FoldKind::All => {
                self.each(counts, values, |all, value| if truth(value) { all } else { 0.0 });
            }
            FoldKind::ArgMin => self.choose(element, counts, values, |value, least| value < least),
            FoldKind::ArgMax => self.choose(element, counts, values, |value, most| value > most),
        }
    }

    #[inline]
    fn each(&mut self, counts: [bool; N], values: [f64; N], f: impl Fn(f64, f64) -> f64) {
        self.value = each_lane(|lane| {
            let changed = f(self.value[lane], values[lane]);
            if counts[lane] { changed } else { self.value[lane] }
        });
    }

    /// Takes the element if its value is better. An impossible value compares false, so it is never
    /// the least or greatest; an infinite one can be.
    #[inline]
    fn choose(
        &mut self,
        element: f64,
        counts: [bool; N],
        values: [f64; N],
        better: impl Fn(f64, f64) -> bool,
    ) {
        for lane in 0..N {
            let (value, best) = (values[lane], self.value[lane]);
            if counts[lane] && (better(value, best) || (self.element[lane] < 0.0 && value == best))
            {
                (self.value[lane], self.element[lane]) = (value, element);
            }
        }
    }

    /// The result.
    pub(super) fn result(&self) -> [f64; N] {
        each_lane(|lane| match self.kind {
            FoldKind::Nothing => 0.0,
            FoldKind::Count => self.n[lane].into(),
            FoldKind::ArgMin | FoldKind::ArgMax => self.element[lane],
            FoldKind::Mean | FoldKind::Min | FoldKind::Max if self.n[lane] == 0 => f64::NAN,
            FoldKind::Mean => self.value[lane] / f64::from(self.n[lane]),
            FoldKind::Sum | FoldKind::Any | FoldKind::All | FoldKind::Min | FoldKind::Max => {
                self.value[lane]
            }
        })
    }
}
