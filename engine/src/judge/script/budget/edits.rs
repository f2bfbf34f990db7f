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
    fn write(&mut self, (line, column): (usize, usize), length: usize) {
        self.written.push((line, column, length));
    }
}

/// Writes words into a text; `insertions` are bytes of it and what is inserted there, in order.
pub(in super::super) fn inserted<'w>(
    source: &str,
    insertions: impl Iterator<Item = (usize, &'w str)>,
) -> (String, Edits) {
    let mut text = String::with_capacity(source.len() + 64);
    let mut edits = Edits::default();
    let (mut copied, mut line, mut column) = (0, 1, 1);
    for (at, words) in insertions {
        let between = source.get(copied..at).unwrap_or_default();
        line += between.matches('\n').count();
        column = match between.rsplit_once('\n') {
            Some((_, rest)) => 1 + rest.chars().count(),
            None => column + between.chars().count(),
        };
        text.push_str(between);
        copied = at;
        edits.write((line, column), words.len());
        text.push_str(words);
        column += words.len();
    }
    text.push_str(source.get(copied..).unwrap_or_default());
    (text, edits)
}
