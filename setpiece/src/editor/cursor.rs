//! What is being written where a cursor stands, by the text before it: whole or broken.

use super::keywords::KeywordBlock;
use super::place::{SCENARIOS, SCRIPTS, TABLES};
use super::text::{code, ends_in_code, word_at};

/// A statement is looked for in this many lines above a cursor.
const LINES: usize = 12;

/// What is being written where the cursor stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum CursorPlace<'a> {
    /// Nothing can be completed: a comment, or a text in quotes.
    Nothing,
    /// The path, in quotes, of a file with this ending.
    File(&'static str),
    /// A file with this ending, in quotes that aren't written yet.
    Quoted(&'static str),
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
        let named_by = line.rsplit_once('"').map_or("", |(before, _)| last_word(before));
        return ending_behind(named_by).map_or(CursorPlace::Nothing, CursorPlace::File);
    }
    if !ends_in_code(before) {
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
    let last = last_word(trimmed);
    let block = block_around(before);
    let begins = trimmed.is_empty()
        || trimmed.ends_with(['{', '}'])
        || line.trim().is_empty()
        || (trimmed.ends_with(',') && is_of_options(block) && !is_in_list(before));
    let head = line.trim_start();
    if last == "extends" && head.starts_with("formation") {
        return CursorPlace::After("formation");
    }
    if matches!(last, "extends" | "reward" | "play" | "with") && !begins {
        return CursorPlace::After(last);
    }
    // `from` also joins a place: `beyond ball by 2m from `.
    let names_file = last != "from" || head.starts_with("table");
    if let Some(ending) = ending_behind(last).filter(|_| names_file && !begins) {
        return CursorPlace::Quoted(ending);
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
        (false, _) | (true, "choose" | "observe") => CursorPlace::Inside,
        (true, block) if is_of_options(block) => CursorPlace::Key(block),
        (true, block) => CursorPlace::Statement(block),
    }
}

/// The ending of the files that are named behind a word.
fn ending_behind(word: &str) -> Option<&'static str> {
    match word {
        "import" => Some(SCENARIOS),
        "script" => Some(SCRIPTS),
        "from" => Some(TABLES),
        _ => None,
    }
}

/// The word that a text ends in, without the blanks behind it.
pub(super) fn last_word(text: &str) -> &str {
    let trimmed = text.trim_end();
    trimmed.get(word_at(trimmed, trimmed.len())).unwrap_or_default()
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
            | "kickoff"
    )
}

/// Whether a text ends inside of round or square brackets that its last block opened.
fn is_in_list(before: &str) -> bool {
    let mut depth = 0_i32;
    for (_, sign) in code(before) {
        match sign {
            '(' | '[' => depth += 1,
            ')' | ']' => depth -= 1,
            '{' | '}' => depth = 0,
            _ => {}
        }
    }
    depth > 0
}

/// A block that is open at the end of a text.
#[derive(Clone, Copy, Debug)]
struct OpenBlock<'a> {
    /// The first word of its statement: `rules` of `rules { offside: off, `. `player` for a
    /// player's options.
    word: &'a str,
    /// The byte where its statement begins.
    head: usize,
    /// The byte where its inside begins.
    start: usize,
}

/// The blocks that are open at the end of a text, the innermost last.
fn open_blocks(before: &str) -> Vec<OpenBlock<'_>> {
    let (mut open, mut begin): (Vec<OpenBlock<'_>>, usize) = (Vec::new(), 0);
    for (at, sign) in code(before) {
        match sign {
            '\n' => begin = at + 1,
            '{' => {
                let outer = open.last().map_or("", |block| block.word);
                let head = before.get(begin..at).unwrap_or_default();
                let word = head_word(head.trim(), outer);
                open.push(OpenBlock { word, head: begin, start: at + 1 });
                begin = at + 1;
            }
            '}' => {
                open.pop();
                begin = at + 1;
            }
            _ => {}
        }
    }
    open
}

/// The word of a block by the head of its statement, and by the block around it.
fn head_word<'a>(head: &'a str, outer: &'a str) -> &'a str {
    let head = head.strip_prefix("abstract ").unwrap_or(head).trim_start();
    let first = head.get(word_at(head, 0)).unwrap_or_default();
    match (first, outer) {
        _ if head.ends_with("stats:") => "stats",
        (_, "team" | "formation") => "player",
        ("else", _) => outer,
        _ => first,
    }
}

/// The word of the block that is open at the end of a text; nothing outside every block.
fn block_around(before: &str) -> &str {
    open_blocks(before).last().map_or("", |block| block.word)
}

/// Whether a text ends outside of every block.
pub(super) fn is_outside(before: &str) -> bool {
    open_blocks(before).is_empty()
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
    let open = open_blocks(before);
    let Some(last) = open.last() else { return statement_lines("", before, 0) };
    if !matches!(last.word, "observe" | "choose") {
        return statement_lines(last.word, before, last.start);
    }
    // Their blocks are no lists of statements, but parts of one.
    let outer = open.len().checked_sub(2).and_then(|at| open.get(at));
    statement_lines(outer.map_or("", |outer| outer.word), before, last.head)
}

/// The end of a text from each of its last lines, but not from before a byte.
fn statement_lines<'a>(
    block: &'a str,
    before: &'a str,
    start: usize,
) -> Vec<UnfinishedStatement<'a>> {
    let inside = before.get(start..).unwrap_or_default();
    let lines = inside.rmatch_indices('\n').map(|(at, _)| at + 1).take(LINES);
    lines
        .chain([0])
        .filter_map(|at| Some(UnfinishedStatement { block, text: inside.get(at..)? }))
        .collect()
}

/// The kind of block at the end of a text.
pub(super) fn block_of(before: &str) -> KeywordBlock {
    KeywordBlock::of(block_around(before))
}

/// The part of an inline script before the end of a text, if it ends in one.
pub(super) fn inline_script(before: &str) -> Option<&str> {
    const MARK: &str = "\"\"\"";
    let at = before.rfind(MARK)?;
    let is_open = before.matches(MARK).count() % 2 == 1;
    is_open.then(|| before.get(at + MARK.len()..)).flatten()
}
