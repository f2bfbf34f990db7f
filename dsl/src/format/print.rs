//! Lines in text: blanks between tokens, and columns of labels and comments.

use super::WIDTH;
use super::layout::{FormatLine, LinePart};
use super::pieces::{PieceKind, SourcePiece};
use setpiece_grammar::Rule;

/// Widest gap before a column.
const GAP_MAX: usize = 4;

/// A line in text: what stands before its columns, its label, its comment.
struct TextRow {
    indent: usize,
    spaced: bool,
    main: String,
    label: Option<AlignedColumn>,
    comment: Option<AlignedColumn>,
}

/// Something at the end of a line that may stand in a column with those above and below.
struct AlignedColumn {
    text: String,
    /// Blanks before it: the author's, then the layout's.
    gap: usize,
}

/// The text of some lines.
pub(super) fn print(lines: &[FormatLine<'_>]) -> String {
    let mut rows: Vec<TextRow> = lines.iter().map(row).collect();
    let main = |row: &TextRow| row.indent + row.main.chars().count();
    align(&mut rows, |row| row.label.as_mut(), main);
    align(
        &mut rows,
        |row| row.comment.as_mut(),
        |row| main(row) + shown(row.label.as_ref()).chars().count(),
    );
    let mut text = String::new();
    for row in &rows {
        if row.spaced {
            text.push('\n');
        }
        let line =
            [row.main.as_str(), &shown(row.label.as_ref()), &shown(row.comment.as_ref())].concat();
        text.push_str(&" ".repeat(row.indent));
        text.push_str(line.trim_end());
        text.push('\n');
    }
    text
}

fn shown(column: Option<&AlignedColumn>) -> String {
    column.map_or(String::new(), |column| " ".repeat(column.gap) + &column.text)
}

fn row(line: &FormatLine<'_>) -> TextRow {
    let mut parts = line.parts.as_slice();
    let mut comment = None;
    if let [rest @ .., last] = parts
        && last.piece.kind == PieceKind::LineComment
        && !rest.is_empty()
    {
        comment = Some(AlignedColumn { text: last.piece.text.to_string(), gap: last.piece.blanks });
        parts = rest;
    }
    let mut label = None;
    if let [rest @ .., word, name] = parts
        && word.piece.is(Rule::kw_as)
        && name.piece.is(Rule::string)
        && !rest.is_empty()
    {
        let gap = if word.piece.newlines == 0 { word.piece.blanks } else { 1 };
        label = Some(AlignedColumn { text: format!("as {}", name.piece.text), gap });
        parts = rest;
    }
    TextRow { indent: line.indent, spaced: line.spaced, main: joined(parts), label, comment }
}

fn joined(parts: &[LinePart<'_>]) -> String {
    let mut text = String::new();
    for (index, part) in parts.iter().enumerate() {
        if let Some(last) = index.checked_sub(1).and_then(|before| parts.get(before)) {
            if part.comma {
                text.push(',');
            }
            text.push_str(if spaced(&last.piece, &part.piece) { " " } else { "" });
        }
        text.push_str(&part.piece.text);
    }
    text
}

/// Pieces on one line, without comments.
pub(super) fn one_line(pieces: &[SourcePiece<'_>]) -> String {
    let mut tokens = pieces.iter().filter(|piece| !piece.is_comment()).peekable();
    let (mut text, mut last): (String, Option<&SourcePiece<'_>>) = (String::new(), None);
    while let Some(piece) = tokens.next() {
        // A comma behind the last of a list belongs to lists of several lines.
        if piece.is(Rule::comma) && tokens.peek().is_some_and(|next| next.closes()) {
            continue;
        }
        if last.is_some_and(|last| spaced(last, piece)) {
            text.push(' ');
        }
        text.push_str(&piece.text);
        last = Some(piece);
    }
    text
}

/// Columns of a line without the comment at its end, the widest of its rows.
pub(super) fn width(line: &FormatLine<'_>) -> usize {
    let mut width = line.indent;
    for (index, part) in line.parts.iter().enumerate() {
        if part.piece.kind == PieceKind::LineComment || part.piece.text.contains('\n') {
            break;
        }
        if let Some(last) = index.checked_sub(1).and_then(|before| line.parts.get(before)) {
            width += gap(&last.piece, part);
        }
        width += part.piece.text.chars().count();
    }
    width
}

/// Columns between two pieces of a line.
pub(super) fn gap(last: &SourcePiece<'_>, part: &LinePart<'_>) -> usize {
    usize::from(spaced(last, &part.piece)) + usize::from(part.comma)
}

/// Whether a blank stands between two pieces of a line.
fn spaced(last: &SourcePiece<'_>, piece: &SourcePiece<'_>) -> bool {
    let (PieceKind::Token(before), PieceKind::Token(rule)) = (last.kind, piece.kind) else {
        return true;
    };
    let touches = match rule {
        Rule::paren_close
        | Rule::bracket_close
        | Rule::comma
        | Rule::colon
        | Rule::dot
        | Rule::range_dots => true,
        Rule::paren_open => {
            matches!(piece.within, Rule::args | Rule::params | Rule::measure_args)
        }
        Rule::brace_close => before == Rule::brace_open,
        _ => false,
    };
    let holds = matches!(
        before,
        Rule::paren_open | Rule::bracket_open | Rule::dot | Rule::range_dots | Rule::sign
    );
    !touches && !holds
}

/// Puts the ends of neighbouring rows into one column where the author began one, by two blanks or
/// more.
fn align(
    rows: &mut [TextRow],
    column: impl Fn(&mut TextRow) -> Option<&mut AlignedColumn>,
    before: impl Fn(&TextRow) -> usize,
) {
    let mut from = 0;
    while from < rows.len() {
        let Some(first) = rows.get_mut(from) else { return };
        let indent = first.indent;
        if column(first).is_none() {
            from += 1;
            continue;
        }
        let mut to = from + 1;
        while rows
            .get_mut(to)
            .is_some_and(|row| row.indent == indent && !row.spaced && column(row).is_some())
        {
            to += 1;
        }
        if let Some(run) = rows.get_mut(from..to) {
            align_run(run, &column, &before);
        }
        from = to;
    }
}

fn align_run(
    run: &mut [TextRow],
    column: &impl Fn(&mut TextRow) -> Option<&mut AlignedColumn>,
    before: &impl Fn(&TextRow) -> usize,
) {
    let (mut widest, mut gap, mut end, mut begun) = (0, 0, 0, false);
    for row in run.iter_mut() {
        let width = before(row);
        let Some(column) = column(row) else { continue };
        if width > widest {
            (widest, gap) = (width, column.gap);
        }
        begun |= column.gap > 1;
        end = end.max(column.text.chars().count());
    }
    let gap = gap.clamp(2, GAP_MAX);
    let aligned = begun && run.len() > 1 && widest + gap + end <= WIDTH;
    for row in run {
        let width = before(row);
        if let Some(column) = column(row) {
            column.gap = if aligned { widest + gap - width } else { 1 };
        }
    }
}
