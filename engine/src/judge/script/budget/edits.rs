//! Where the text that runs differs from the author's.

/// Where a text differs from the author's.
#[derive(Debug, Default)]
pub(in super::super) struct Edits {
    /// Line, column in the new text, and characters; in order.
    written: Vec<(usize, usize, usize)>,
}

impl Edits {
    /// Maps a place in the text to the author's text.
    pub(in super::super) fn original(&self, (line, column): (usize, usize)) -> (usize, usize) {
        let first = self.written.partition_point(|written| written.0 < line);
        let before = self.written[first..]
            .iter()
            .take_while(|written| written.0 == line && written.1 < column);
        let shift: usize = before.map(|&(_, at, length)| length.min(column - at)).sum();
        (line, column - shift)
    }

    /// Notes characters that are written at a place of the new text, behind all others.
    pub(super) fn write(&mut self, (line, column): (usize, usize), length: usize) {
        self.written.push((line, column, length));
    }
}
