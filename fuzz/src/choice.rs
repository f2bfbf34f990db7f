//! Choices made from the fuzzer's bytes.

use arbitrary::Unstructured;

/// Reads choices from bytes; behind their end every choice is the first.
///
/// [`Unstructured`], whose errors can't arise here: it gives zeros where it has no more bytes, and
/// nothing is chosen from an empty range.
#[derive(Debug)]
pub struct Choices<'a>(Unstructured<'a>);

impl<'a> Choices<'a> {
    /// Reads choices from all of the bytes.
    pub fn new(bytes: &'a [u8]) -> Choices<'a> {
        Choices(Unstructured::new(bytes))
    }

    /// Whether all bytes are used.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// The next byte.
    pub fn byte(&mut self) -> u8 {
        self.0.arbitrary().unwrap_or_default()
    }

    /// The next two bytes.
    pub fn word(&mut self) -> u16 {
        self.0.arbitrary().unwrap_or_default()
    }

    /// A number below `n`.
    pub fn below(&mut self, n: usize) -> usize {
        self.0.int_in_range(0..=n.saturating_sub(1)).unwrap_or_default()
    }

    /// One of several.
    pub fn one<T: Copy>(&mut self, of: &[T]) -> T {
        of[self.below(of.len())]
    }

    /// True once in `n` times.
    pub fn rarely(&mut self, n: usize) -> bool {
        self.below(n) == n - 1
    }

    /// A number between two others, in 255 parts.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * f64::from(self.byte()) / 255.0
    }

    /// All remaining bytes.
    pub fn rest(&mut self) -> &'a [u8] {
        std::mem::replace(&mut self.0, Unstructured::new(&[])).take_rest()
    }
}

impl Clone for Choices<'_> {
    fn clone(&self) -> Self {
        Choices::new(self.0.peek_bytes(self.0.len()).unwrap_or_default())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn choices_are_made_byte_by_byte_and_end_at_the_first() {
        let mut choices = Choices::new(&[7, 1, 2, 9, 3, 4]);
        let mut again = choices.clone();
        assert_eq!((choices.byte(), choices.word(), choices.below(4)), (7, 0x0201, 1));
        assert_eq!(again.rest(), [7, 1, 2, 9, 3, 4]);
        assert_eq!(choices.rest(), [3, 4]);
        assert!(choices.is_empty());
        assert_eq!((choices.byte(), choices.below(9), choices.one(&["a", "b"])), (0, 0, "a"));
        assert_eq!(
            (choices.below(0), choices.between(1.0, 2.0), choices.rarely(3)),
            (0, 1.0, false)
        );
    }
}
