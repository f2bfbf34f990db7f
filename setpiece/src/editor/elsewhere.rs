//! Statements that a help asks for elsewhere than in the place of the marked text.

use super::edits::Edit;
use super::fixes::Try;
use super::report::TextReport;
use super::text::{brackets, code, line_around};
use super::{Analysis, Symbol, SymbolKind};
use crate::dsl::problem::Elsewhere;
use std::ops::Range;
use std::path::Path;

/// Words of blocks of a scenario that hold options alone: an empty one says nothing.
const OF_OPTIONS: [&str; 4] = ["rules", "world", "pitch", "agents"];

/// What a report's help asks for elsewhere, as a change of the text; none if it asks for nothing,
/// or if there is no such place.
pub(super) fn elsewhere(analysis: &Analysis, path: &Path, report: &TextReport) -> Option<Try> {
    let marked = report.place.range.clone();
    let around = |kinds: &[SymbolKind]| analysis.around(marked.start, kinds);
    let above = |around: Option<Symbol>, statement: &str| {
        Some(Try {
            title: format!("write `{statement}` above"),
            edits: vec![at_top(analysis, path, &around?, statement)?],
        })
    };
    match report.elsewhere.as_ref()? {
        Elsewhere::OfScenario(statement) => above(around(&[SymbolKind::Scenario]), statement),
        Elsewhere::OfBody(statement) => {
            above(around(&[SymbolKind::Reward, SymbolKind::Behavior]), statement)
        }
        Elsewhere::Setting(block, key, value) => {
            let scenario = around(&[SymbolKind::Scenario])?;
            setting(analysis, path, &scenario, block, &format!("{key}: {value}"))
        }
        Elsewhere::Moved(block) => {
            let scenario = around(&[SymbolKind::Scenario])?;
            let option = option_at(&analysis.text, marked.start)?;
            let written = analysis.text.get(option.clone())?;
            let moved = setting(analysis, path, &scenario, block, written)?;
            let gone = without(&analysis.text, option)?;
            Some(Try {
                title: format!("move it to `{block} {{ … }}`"),
                edits: moved.edits.into_iter().chain([Edit::replace(path, gone, "")]).collect(),
            })
        }
        Elsewhere::Named => named(analysis, path, &marked),
    }
}

/// An option in a block of a scenario that it has already: its value, or one more. Otherwise the
/// block at the top.
///
/// `option`: `KEY: VALUE`.
fn setting(
    analysis: &Analysis,
    path: &Path,
    scenario: &Symbol,
    block: &str,
    option: &str,
) -> Option<Try> {
    let statement = format!("{block} {{ {option} }}");
    let (name, value) = option.split_once(':')?;
    let text = analysis.text.get(scenario.whole.clone())?;
    let head = format!("{block} {{");
    let Some(begin) = text.find(&head) else {
        return Some(Try {
            title: format!("write `{statement}` above"),
            edits: vec![at_top(analysis, path, scenario, &statement)?],
        });
    };
    let begin = scenario.whole.start + begin + head.len();
    let inside = analysis.text.get(begin..)?.split('}').next()?;
    let edit = match inside.find(&format!("{name}:")) {
        None => {
            let comma = if inside.trim().is_empty() { "" } else { "," };
            Edit::replace(path, begin..begin, format!(" {option}{comma}"))
        }
        Some(known) => {
            let from = known + name.len() + 1;
            let old = inside.get(from..)?.split([',', '\n']).next()?.trim_end();
            Edit::replace(path, begin + from..begin + from + old.len(), value)
        }
    };
    Some(Try { title: format!("write `{statement}`"), edits: vec![edit] })
}

/// An option with its value, from the byte where its key begins.
fn option_at(text: &str, key: usize) -> Option<Range<usize>> {
    let mut depth = 0_u32;
    let mut end = key;
    for (at, sign) in code(text.get(key..)?) {
        match sign {
            '(' | '[' | '{' => depth += 1,
            ')' | ']' | '}' if depth > 0 => depth -= 1,
            ',' | '\n' | '}' if depth == 0 => break,
            _ => {}
        }
        if !sign.is_whitespace() {
            end = key + at + sign.len_utf8();
        }
    }
    text.get(key..end)?.contains(':').then_some(key..end)
}

/// What goes with an option that is taken out of its braces: its comma, or the braces that would be
/// empty, with their line if nothing else stands in it.
fn without(text: &str, option: Range<usize>) -> Option<Range<usize>> {
    let is_around = |open: usize, close: usize| open < option.start && option.end <= close;
    let pairs = brackets(text).into_iter().filter(|it| is_around(it.open, it.close));
    let pair = pairs.max_by_key(|it| it.open)?;
    let before = text.get(pair.open + 1..option.start)?;
    let behind = text.get(option.end..pair.close)?;
    let behind = behind.strip_suffix('}').unwrap_or(behind);
    if !before.trim().is_empty() || !behind.trim().is_empty() {
        let kept = behind.trim_start().strip_prefix(',').map(str::trim_start);
        return Some(match kept {
            Some(kept) => option.start..option.end + behind.len() - kept.len(),
            None => pair.open + 1 + before.trim_end().trim_end_matches(',').len()..option.end,
        });
    }
    let head = text.get(..pair.open)?.trim_end();
    let line = line_around(text, head.len());
    let word = head.rsplit(['\n', '{', '}']).next().unwrap_or_default().trim_start();
    if word.starts_with("team ") {
        return Some(option);
    }
    if !OF_OPTIONS.contains(&word) {
        return Some(head.len()..pair.close);
    }
    let end = line_around(text, pair.close).end;
    let is_alone = text.get(pair.close..end)?.trim().is_empty();
    let begins = head.len() - word.len();
    let is_alone = is_alone && text.get(line.start..begins)?.trim().is_empty();
    Some(if is_alone { line.start..end } else { begins..pair.close })
}

/// A draw as a `let` of the scenario around it.
fn named(analysis: &Analysis, path: &Path, range: &Range<usize>) -> Option<Try> {
    let value = analysis.text.get(range.clone())?;
    let scenario = analysis.around(range.start, &[SymbolKind::Scenario])?;
    let is_taken = |name: &str| analysis.text.contains(name);
    let mut names = (2..100).map(|nth| format!("drawn_{nth}"));
    let first = Some("drawn".to_owned()).filter(|name| !is_taken(name));
    let name = first.or_else(|| names.find(|name| !is_taken(name)))?;
    let statement = format!("let {name} = {value}");
    Some(Try {
        title: format!("draw it with `{statement}`"),
        edits: vec![
            at_top(analysis, path, &scenario, &statement)?,
            Edit::replace(path, range.clone(), name),
        ],
    })
}

/// A statement as the first one of a block.
fn at_top(analysis: &Analysis, path: &Path, around: &Symbol, statement: &str) -> Option<Edit> {
    let head = analysis.text.get(around.range.end..around.whole.end)?;
    let (brace, _) = code(head).find(|(_, sign)| *sign == '{')?;
    let at = around.range.end + brace + 1;
    let line = line_around(&analysis.text, around.whole.start);
    let line = analysis.text.get(line)?;
    let indent = line.get(..line.len() - line.trim_start().len())?;
    let is_block = analysis.text.get(at..)?.trim_start_matches([' ', '\r']).starts_with('\n');
    let text =
        if is_block { format!("\n{indent}    {statement}") } else { format!(" {statement} ") };
    Some(Edit::replace(path, at..at, text))
}
