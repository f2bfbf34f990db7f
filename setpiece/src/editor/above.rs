//! Statements that a help asks for beside the marked one.

use super::edits::Edit;
use super::fixes::Try;
use super::report::TextReport;
use super::text::{code, line_around};
use super::{Analysis, Symbol, SymbolKind};
use std::ops::Range;
use std::path::Path;

/// A rule in the `rules` of a scenario that it has already: its value, or one more.
///
/// `statement`: `rules { RULE: VALUE }`.
fn rule_written(
    analysis: &Analysis,
    path: &Path,
    scenario: &Symbol,
    statement: &str,
) -> Option<Edit> {
    let rule = statement.strip_prefix("rules {")?.strip_suffix('}')?.trim();
    let (name, value) = rule.split_once(':')?;
    let text = analysis.text.get(scenario.whole.clone())?;
    let begin = text.find("rules {")? + "rules {".len();
    let inside = text.get(begin..)?.split('}').next()?;
    let begin = scenario.whole.start + begin;
    let Some(known) = inside.find(&format!("{name}:")) else {
        return Some(Edit::replace(path, begin..begin, format!(" {rule},")));
    };
    let from = known + name.len() + 1;
    let old = inside.get(from..)?.split([',', '\n']).next()?.trim_end();
    Some(Edit::replace(path, begin + from..begin + from + old.len(), value))
}

/// A statement that a help asks for beside the marked one: at the top of the scenario, reward or
/// behaviour around it.
pub(super) fn above(
    analysis: &Analysis,
    path: &Path,
    report: &TextReport,
    help: &str,
) -> Option<Try> {
    let rest = help.split_once("never happens: write `").map(|(_, rest)| rest);
    let is_rule = rest.is_some();
    let is_top = ["declare it at the top: `", "take the other one out, `"]
        .iter()
        .find_map(|words| help.strip_prefix(words));
    let is_rule = is_rule || help.starts_with("take the other");
    let rest = rest.or(is_top)?;
    let statement = rest.split('`').next()?;
    let kinds: &[SymbolKind] =
        if is_rule { &[SymbolKind::Scenario] } else { &[SymbolKind::Reward, SymbolKind::Behavior] };
    let around = analysis.around(report.place.range.start, kinds)?;
    if is_rule && let Some(edit) = rule_written(analysis, path, &around, statement) {
        return Some(Try { title: format!("write `{statement}`"), edits: vec![edit] });
    }
    Some(Try {
        title: format!("write `{statement}` above"),
        edits: vec![at_top(analysis, path, &around, statement)?],
    })
}

/// A draw as a `let` of the scenario around it.
pub(super) fn drawn(analysis: &Analysis, path: &Path, range: &Range<usize>) -> Option<Try> {
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
