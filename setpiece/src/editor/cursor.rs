//! What is being written where a cursor stands, by the text before it: whole or broken.

use super::keywords::{KEYWORDS, KeywordBlock};
use super::text::word_at;

/// A statement is looked for in this many lines above a cursor.
const LINES: usize = 12;

/// What is being written where the cursor stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum CursorPlace<'a> {
    /// Nothing can be completed: a comment, or a text in quotes.
    Nothing,
    /// The path of an `import`.
    Import,
    /// What follows a dot; with the word before it.
    Member(&'a str),
    /// The unit of a number.
    Unit,
    /// An item of the file.
    TopLevel,
    /// The first word of a statement in this block.
    Statement(&'a str),
    /// The key of an option in this block.
    Key(&'a str),
    /// What follows this word: `extends`, `reward`, `formation`.
    After(&'a str),
    /// What a check or a curriculum measures.
    Measure,
    /// An expression, or another part of a statement.
    Inside,
}

/// What is written at the end of a text; `typed`: the part of the word that stands there already.
pub(super) fn context<'a>(before: &'a str, typed: &str) -> CursorPlace<'a> {
    let line = before.rsplit('\n').next().unwrap_or_default();
    let quoted = line.matches('"').count() % 2 == 1;
    if quoted {
        let is_import = line.trim_start().starts_with("import");
        return if is_import { CursorPlace::Import } else { CursorPlace::Nothing };
    }
    if line.contains("//") {
        return CursorPlace::Nothing;
    }
    if let Some(base) = before.strip_suffix('.') {
        let range = word_at(base, base.len());
        return CursorPlace::Member(base.get(range).unwrap_or_default());
    }
    if typed.starts_with(|char: char| char.is_ascii_digit()) {
        return CursorPlace::Unit;
    }
    let trimmed = before.trim_end();
    let last = trimmed.get(word_at(trimmed, trimmed.len())).unwrap_or_default();
    let block = block_around(before);
    let begins = trimmed.is_empty()
        || trimmed.ends_with(['{', '}'])
        || line.trim().is_empty()
        || (trimmed.ends_with(',') && is_of_options(block));
    if matches!(last, "extends" | "reward" | "play" | "with") && !begins {
        return CursorPlace::After(last);
    }
    if trimmed.ends_with("formation:") {
        return CursorPlace::After("formation");
    }
    match (begins, block) {
        (false, "check" | "curriculum")
            if matches!(last, "expect" | "until" | "or" | "keeping") =>
        {
            CursorPlace::Measure
        }
        (true, "") => CursorPlace::TopLevel,
        (true, block) if is_of_options(block) => CursorPlace::Key(block),
        (true, block) => CursorPlace::Statement(block),
        (false, _) => CursorPlace::Inside,
    }
}

/// Whether the block of this word has options instead of statements.
fn is_of_options(block: &str) -> bool {
    matches!(
        block,
        "rules"
            | "world"
            | "pitch"
            | "agents"
            | "ball"
            | "start"
            | "stats"
            | "player"
            | "substitute"
    )
}

/// The first word of the statement whose block is open at the end of a text: `rules` in
/// `rules { offside: off, `. `player` for a player's options; nothing outside every block.
fn block_around(before: &str) -> &str {
    open_block(before).0
}

/// The word of the block that is open at the end of a text, and where its inside begins.
fn open_block(before: &str) -> (&str, usize) {
    let mut depth = 0;
    for (at, char) in before.char_indices().rev() {
        match char {
            '}' => depth += 1,
            '{' if depth > 0 => depth -= 1,
            '{' => {
                let head = before.get(..at).unwrap_or_default();
                let begin = head.rfind(['\n', '{', '}']).map_or(0, |at| at + 1);
                let head = head.get(begin..).unwrap_or_default().trim_start();
                let head = head.strip_prefix("abstract ").unwrap_or(head).trim_start();
                let first = head.get(word_at(head, 0)).unwrap_or_default();
                let outer = before.get(..begin).unwrap_or_default();
                let is_player = !is_head(first)
                    && block_around(outer.trim_end_matches('{')) == "team"
                    || block_around(outer) == "team";
                let word = if head.trim_end().ends_with("stats:") {
                    "stats"
                } else if is_player {
                    "player"
                } else if first == "else" {
                    block_around(outer)
                } else {
                    first
                };
                return (word, at + 1);
            }
            _ => {}
        }
    }
    ("", 0)
}

/// The end of a text from where its last statement may begin.
#[derive(Clone, Copy, Debug)]
pub(super) struct UnfinishedStatement<'a> {
    /// The word of the block that it stands in.
    pub(super) block: &'a str,
    /// The text from there on.
    pub(super) text: &'a str,
}

/// Where the last statement of a text may begin, the latest line first.
pub(super) fn unfinished(before: &str) -> Vec<UnfinishedStatement<'_>> {
    let (mut block, mut start) = open_block(before);
    if block == "observe" {
        // Its block is no list of statements, but a part of one.
        let head = before.get(..start).unwrap_or_default();
        (block, start) = ("scenario", head.rfind(block).unwrap_or(start));
    }
    let inside = before.get(start..).unwrap_or_default();
    let lines = inside.rmatch_indices('\n').map(|(at, _)| at + 1).take(LINES);
    lines
        .chain([0])
        .filter_map(|at| Some(UnfinishedStatement { block, text: inside.get(at..)? }))
        .collect()
}

/// The kind of block at the end of a text.
pub(super) fn block_of(before: &str) -> KeywordBlock {
    match block_around(before) {
        "" => KeywordBlock::File,
        "scenario" => KeywordBlock::Scenario,
        "team" | "formation" => KeywordBlock::Team,
        "reward" | "on" | "when" => KeywordBlock::Reward,
        "behavior" | "repeat" | "choose" | "interrupt" => KeywordBlock::Behavior,
        "check" => KeywordBlock::Check,
        "curriculum" => KeywordBlock::Curriculum,
        _ => KeywordBlock::Within,
    }
}

/// Whether a word begins an item or a statement with a block.
fn is_head(word: &str) -> bool {
    KEYWORDS.iter().any(|known| {
        known.name == word && matches!(known.block, KeywordBlock::File | KeywordBlock::Scenario)
    })
}

/// The part of an inline script before the end of a text, if it ends in one.
pub(super) fn inline_script(before: &str) -> Option<&str> {
    const MARK: &str = "\"\"\"";
    let at = before.rfind(MARK)?;
    let is_open = before.matches(MARK).count() % 2 == 1;
    is_open.then(|| before.get(at + MARK.len()..)).flatten()
}
