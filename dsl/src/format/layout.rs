//! Where lines end.

use super::pieces::{PieceKind, SourcePiece};
use super::print::{gap, width};
use super::{INDENT, WIDTH};
use setpiece_grammar::Rule;

/// A line: its pieces and how it stands.
#[derive(Clone, Debug)]
pub(super) struct FormatLine<'t> {
    /// Blanks before it.
    pub(super) indent: usize,
    /// Whether an empty line stands before it.
    pub(super) spaced: bool,
    /// What stands on it.
    pub(super) parts: Vec<LinePart<'t>>,
}

/// A piece on its line.
#[derive(Clone, Debug)]
pub(super) struct LinePart<'t> {
    /// The piece.
    pub(super) piece: SourcePiece<'t>,
    /// Its place among all pieces.
    index: usize,
    /// How many brackets are open around it.
    depth: usize,
    /// Whether a comma that the author left out goes before it.
    pub(super) comma: bool,
}

/// A block: what stands between two curly brackets.
struct BraceBlock {
    open: usize,
    close: usize,
    /// Whether its statements stand on lines of their own.
    broken: bool,
    /// The place of the block around it.
    parent: usize,
    /// Whether it holds `key: value`s, which commas separate on one line.
    fields: bool,
}

/// Words and signs that begin an expression or go on with one: only a comma tells which.
const JOINING: &[&str] = &["-", "+", "(", "[", ".", "noise", "delayed", "stack"];

struct LineLayout<'p, 't> {
    pieces: &'p [SourcePiece<'t>],
    /// The file first.
    blocks: Vec<BraceBlock>,
    /// Of every piece, the block that it stands in.
    block_of: Vec<usize>,
    /// Of every curly bracket, the block that it opens or closes.
    bracket_of: Vec<usize>,
    /// Whether a piece stands before a statement, or at the end of its block, rather than inside a
    /// statement.
    free: Vec<bool>,
    /// Line breaks that width asks for.
    wrapped: Vec<bool>,
}

/// Lays out the pieces of a text.
pub(super) fn lay_out<'t>(pieces: &[SourcePiece<'t>]) -> Vec<FormatLine<'t>> {
    let mut layout = LineLayout::new(pieces);
    // Every round opens a block or wraps a line, of which there are no more than pieces.
    for _ in 0..=pieces.len() {
        let lines = layout.lines();
        if !layout.narrow(&lines) {
            return lines;
        }
    }
    layout.lines()
}

impl<'p, 't> LineLayout<'p, 't> {
    fn new(pieces: &'p [SourcePiece<'t>]) -> LineLayout<'p, 't> {
        let mut blocks = vec![BraceBlock {
            open: usize::MAX,
            close: pieces.len(),
            broken: true,
            parent: 0,
            fields: false,
        }];
        let (mut current, mut block_of, mut bracket_of) =
            (0, Vec::with_capacity(pieces.len()), vec![0; pieces.len()]);
        for (index, piece) in pieces.iter().enumerate() {
            if piece.is(Rule::brace_close)
                && current != 0
                && let (Some(block), Some(bracket)) =
                    (blocks.get_mut(current), bracket_of.get_mut(index))
            {
                (block.close, *bracket) = (index, current);
                current = block.parent;
            }
            block_of.push(current);
            if piece.is(Rule::brace_open) {
                let fields = piece.within == Rule::fields;
                blocks.push(BraceBlock {
                    open: index,
                    close: pieces.len(),
                    broken: false,
                    parent: current,
                    fields,
                });
                current = blocks.len() - 1;
                if let Some(bracket) = bracket_of.get_mut(index) {
                    *bracket = current;
                }
            }
        }
        for block in blocks.iter_mut().skip(1) {
            let inside = pieces.get(block.open + 1..=block.close).unwrap_or_default();
            let breaks = |piece: &SourcePiece<'_>| {
                piece.newlines > 0 || piece.ends_line() || piece.text.contains('\n')
            };
            block.broken = inside.len() > 1 && inside.iter().any(breaks);
        }
        let mut free = vec![true; pieces.len()];
        let mut next = true;
        for (free, piece) in free.iter_mut().zip(pieces).rev() {
            // A comma between statements isn't printed: what follows it counts.
            if !piece.is_comment() && !piece.separates {
                next = piece.begins || piece.is(Rule::brace_close);
            }
            *free = next;
        }
        LineLayout {
            pieces,
            blocks,
            block_of,
            bracket_of,
            free,
            wrapped: vec![false; pieces.len()],
        }
    }

    fn is_broken(&self, block: usize) -> bool {
        self.blocks.get(block).is_some_and(|block| block.broken)
    }

    fn block(&self, index: usize) -> usize {
        self.block_of.get(index).copied().unwrap_or_default()
    }

    /// The block of a curly bracket.
    fn bracket(&self, index: usize) -> usize {
        self.bracket_of.get(index).copied().unwrap_or_default()
    }

    /// Whether a piece is printed: commas that mean nothing are not.
    fn is_shown(&self, index: usize) -> bool {
        let Some(piece) = self.pieces.get(index).filter(|piece| piece.is(Rule::comma)) else {
            return true;
        };
        let last = self
            .pieces
            .get(index + 1)
            .is_none_or(|next| next.closes() && (piece.separates || next.newlines == 0));
        let ends_line = piece.separates && self.is_broken(self.block(index));
        !(last || (ends_line && !self.could_go_on(index)))
    }

    /// Whether what follows a comma could be read as the rest of what stands before it.
    fn could_go_on(&self, comma: usize) -> bool {
        let mut behind = self.pieces.iter().skip(comma + 1).filter(|piece| !piece.is_comment());
        behind.next().is_some_and(|next| JOINING.contains(&next.text.as_ref()))
    }

    /// Whether a line begins with this piece, which follows `before`.
    fn breaks(&self, before: usize, before_breaks: bool, index: usize) -> bool {
        let (Some(last), Some(piece)) = (self.pieces.get(before), self.pieces.get(index)) else {
            return false;
        };
        if last.ends_line() || piece.is(Rule::doc) {
            return true;
        }
        if piece.is_comment() {
            return piece.newlines > 0;
        }
        if last.kind == PieceKind::BlockComment && piece.newlines == 0 && before_breaks {
            return false;
        }
        if piece.is(Rule::brace_close) {
            return self.is_broken(self.bracket(index));
        }
        if piece.begins {
            return self.is_broken(self.block(index));
        }
        if piece.is(Rule::brace_open) || (last.is(Rule::brace_close) && piece.is(Rule::kw_else)) {
            return last.kind == PieceKind::BlockComment && piece.newlines > 0;
        }
        let asked = piece.newlines > 0 || self.wrapped.get(index).copied().unwrap_or_default();
        asked && (last.kind == PieceKind::BlockComment || may_break(last, piece))
    }

    fn is_free(&self, index: usize) -> bool {
        self.free.get(index).copied().unwrap_or(true)
    }

    fn lines(&self) -> Vec<FormatLine<'t>> {
        let mut lines: Vec<FormatLine<'t>> = Vec::new();
        let mut frames = vec![OpenBracket { close: 0, inner: 0, curly: true, opened: true }];
        let (mut before, mut before_breaks) = (None, true);
        for (index, piece) in
            self.pieces.iter().enumerate().filter(|(index, _)| self.is_shown(*index))
        {
            let breaks = before.is_none_or(|before| self.breaks(before, before_breaks, index));
            if breaks {
                let indent =
                    frames.last().map_or(0, |frame| frame.indent(piece, self.is_free(index)));
                let spaced = before.is_some_and(|before| self.is_spaced(before, index));
                lines.push(FormatLine { indent, spaced, parts: Vec::new() });
            }
            let Some(line) = lines.last_mut() else { continue };
            let comma = piece.begins
                && self.blocks.get(self.block(index)).is_some_and(|block| block.fields)
                && !breaks
                && before
                    .and_then(|at| self.pieces.get(at))
                    .is_some_and(|last| !last.separates && !last.opens());
            if piece.closes() && frames.len() > 1 {
                frames.pop();
            }
            line.parts.push(LinePart { piece: piece.clone(), index, depth: frames.len(), comma });
            if piece.opens() {
                let opened = (index + 1..self.pieces.len())
                    .find(|next| self.is_shown(*next))
                    .is_some_and(|next| self.breaks(index, breaks, next));
                let curly = piece.is(Rule::brace_open);
                let outer =
                    frames.iter().rev().find(|frame| frame.curly).map_or(0, |frame| frame.inner);
                let close = if curly { outer } else { line.indent };
                frames.push(OpenBracket { close, inner: close + INDENT, curly, opened });
            }
            (before, before_breaks) = (Some(index), breaks);
        }
        lines
    }

    /// Whether an empty line stands between two lines: the author's, or one behind an item that is
    /// a block.
    fn is_spaced(&self, before: usize, index: usize) -> bool {
        let (Some(last), Some(piece)) = (self.pieces.get(before), self.pieces.get(index)) else {
            return false;
        };
        if last.opens() || last.is(Rule::doc) || piece.closes() || !self.is_free(index) {
            return false;
        }
        let item = last.is(Rule::brace_close) && self.block(index) == 0;
        piece.newlines > 1 || (item && self.is_broken(self.bracket(before)))
    }

    /// Opens a block or wraps a line that is too wide; whether there was one.
    fn narrow(&mut self, lines: &[FormatLine<'t>]) -> bool {
        let mut changed = false;
        for line in lines.iter().filter(|line| width(line) > WIDTH) {
            let mut depth = usize::MAX;
            let mut opened = false;
            for part in line.parts.iter().filter(|part| part.piece.is(Rule::brace_open)) {
                let bracket = self.bracket(part.index);
                if part.depth <= depth
                    && let Some(block) = self.blocks.get_mut(bracket)
                    && !block.broken
                    && block.close > block.open + 1
                {
                    (block.broken, depth, opened) = (true, part.depth, true);
                }
            }
            changed |= opened || self.wrap(line);
        }
        changed
    }

    /// Breaks a line at the last place that fits, as far outside of brackets as can be; whether
    /// there is one.
    fn wrap(&mut self, line: &FormatLine<'t>) -> bool {
        let mut column = line.indent;
        let mut best: Option<(bool, usize, usize)> = None;
        for pair in line.parts.windows(2) {
            let [last, part] = pair else { continue };
            column += last.piece.text.chars().count();
            let fits = column <= WIDTH;
            column += gap(&last.piece, part);
            if !may_break(&last.piece, &part.piece)
                || part.piece.is_comment()
                || part.piece.closes()
            {
                continue;
            }
            let better = match best {
                None => true,
                Some((fitted, depth, _)) if fits => !fitted || part.depth <= depth,
                Some((fitted, depth, _)) => !fitted && part.depth < depth,
            };
            if better {
                best = Some((fits, part.depth, part.index));
            }
        }
        let Some(slot) = best.and_then(|(_, _, index)| self.wrapped.get_mut(index)) else {
            return false;
        };
        !std::mem::replace(slot, true)
    }
}

/// An open bracket, or the file.
struct OpenBracket {
    /// The indentation of its closing bracket.
    close: usize,
    /// The indentation of what it holds.
    inner: usize,
    curly: bool,
    /// Whether a line ends behind the bracket.
    opened: bool,
}

impl OpenBracket {
    /// The indentation of a line that begins with a piece.
    fn indent(&self, piece: &SourcePiece<'_>, free: bool) -> usize {
        match (piece.closes(), self.curly) {
            (true, _) => self.close,
            (false, true)
                if piece.begins || piece.is(Rule::doc) || (piece.is_comment() && free) =>
            {
                self.inner
            }
            (false, false) if self.opened => self.inner,
            (false, false) => self.close + INDENT,
            (false, true) => self.inner + INDENT,
        }
    }
}

/// Whether a line inside a statement may end between two tokens: in brackets, and before the words
/// that join.
fn may_break(last: &SourcePiece<'_>, piece: &SourcePiece<'_>) -> bool {
    let PieceKind::Token(rule) = piece.kind else { return false };
    let in_brackets =
        matches!(last.kind, PieceKind::Token(Rule::paren_open | Rule::bracket_open | Rule::comma))
            || matches!(rule, Rule::paren_close | Rule::bracket_close);
    let joins = matches!(
        rule,
        Rule::kw_and
            | Rule::kw_or
            | Rule::kw_then
            | Rule::kw_else
            | Rule::kw_as
            | Rule::kw_on
            | Rule::kw_noise
            | Rule::kw_delayed
            | Rule::kw_stack
            | Rule::kw_when
            | Rule::kw_where
            | Rule::kw_with
            | Rule::kw_for
            | Rule::kw_extends
            | Rule::kw_facing
            | Rule::kw_jitter
            | Rule::add_op
            | Rule::mul_op
            | Rule::set_op
            | Rule::star
    );
    // `if`, `give` and their like don't stand alone, and an option's `on` is a value.
    let head = matches!(last.kind, PieceKind::Token(Rule::kw_give | Rule::kw_else | Rule::colon));
    in_brackets || (joins && !head) || last.is(Rule::equals)
}
