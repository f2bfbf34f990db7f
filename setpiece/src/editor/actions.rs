//! Changes of a text that an editor offers.

use super::edits::Edit;
use super::report::TextReport;
use super::{Analysis, SymbolKind, Workspace};
use crate::dsl::ast::{ItemKind, ScenarioStmt, ScenarioStmtKind};
use crate::dsl::problem::Code;
use crate::scenario::pitch::{X_SCALE_M, Y_SCALE_M};
use std::ops::Range;
use std::path::Path;

/// A change that is offered.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Action {
    /// What it does, in words.
    pub title: String,
    /// What it is for.
    pub kind: ActionKind,
    /// The change.
    pub edits: Vec<Edit>,
    /// The code of the problem that it mends.
    pub code: Option<Code>,
    /// Why it can't be done; it has no edits then.
    pub refused: Option<String>,
}

/// What a change is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ActionKind {
    /// It mends a problem.
    Fix,
    /// It mends everything that can be mended.
    FixAll,
    /// It gives something a name.
    Extract,
    /// It says the same otherwise.
    Rewrite,
}

impl Workspace {
    /// What may be changed where some bytes are selected; none of it leads to another problem.
    /// [`Workspace::fix_all`] has what mends the whole text.
    pub fn actions(&mut self, path: &Path, within: Range<usize>) -> Vec<Action> {
        // Whoever pastes a script wants none of its lines mended.
        let translation = self.translation(path, &within);
        if translation.as_ref().is_some_and(|it| it.refused.is_none()) {
            return translation.into_iter().collect();
        }
        let Some(analysis) = self.analysis(path) else { return Vec::new() };
        let mut actions = self.fixes(path, &within);
        actions.extend(translation);
        // What is wrong is mended first.
        if analysis.errors_at(path, &within) {
            return actions;
        }
        let others = [
            analysis.other_units(path, &within),
            analysis.parameter(path, &within),
            analysis.region(path, &within),
            analysis.formation(path, &within),
            analysis.wrapped(path, &within),
        ];
        actions.extend(others.into_iter().flatten().filter(|it| self.is_harmless(path, &it.edits)));
        actions
    }

    /// Whether nothing is wrong after some edits that wasn't before.
    fn is_harmless(&mut self, path: &Path, edits: &[Edit]) -> bool {
        let mut after = self.after(edits);
        let (Some(was), Some(is)) = (self.analysis(path), after.analysis(path)) else {
            return false;
        };
        let alike = |one: &TextReport, other: &TextReport| {
            one.code == other.code && one.message == other.message
        };
        let of = |analysis: &Analysis, report: &TextReport| {
            analysis.reports.iter().filter(|it| alike(it, report)).count()
        };
        is.reports.iter().all(|report| of(&is, report) <= of(&was, report))
    }
}

impl Analysis {
    /// A place of two plain numbers in the other unit: normalised as metres, or metres as
    /// normalised.
    fn other_units(&self, path: &Path, within: &Range<usize>) -> Option<Action> {
        if self.has_own_pitch() {
            return None;
        }
        let (range, _) = self.value_where(within.start, |text| text.starts_with('('))?;
        let inner = self.text.get(range.clone())?.strip_prefix('(')?.strip_suffix(')')?;
        let (x, y) = inner.split_once(',')?;
        let (x, y) = (x.trim(), y.trim());
        let scales = [X_SCALE_M, Y_SCALE_M];
        let number = |value: f64, digits: i32| {
            let scale = 10_f64.powi(digits);
            (value * scale).round() / scale + 0.0
        };
        let metres = |text: &str| text.strip_suffix('m').and_then(|it| it.parse::<f64>().ok());
        let (title, text) = if let (Ok(x), Ok(y)) = (x.parse::<f64>(), y.parse::<f64>()) {
            let [x, y] = [number(x * scales[0], 2), number(y * scales[1], 2)];
            ("write the place in metres", format!("({x}m, {y}m)"))
        } else {
            let [x, y] = [number(metres(x)? / scales[0], 4), number(metres(y)? / scales[1], 4)];
            ("write the place normalised", format!("({x}, {y})"))
        };
        Some(Action {
            title: format!("{title}: `{text}`"),
            kind: ActionKind::Rewrite,
            edits: vec![Edit::replace(path, range, text)],
            code: None,
            refused: None,
        })
    }

    /// Whether a scenario of the text, or the compiled one, has a pitch of another size.
    fn has_own_pitch(&self) -> bool {
        let is_pitch = |stmt: &ScenarioStmt| matches!(stmt.kind, ScenarioStmtKind::Pitch(_));
        let written = self.tree.items.iter().any(|item| match &item.kind {
            ItemKind::Scenario(it) => it.body.iter().any(is_pitch),
            _ => false,
        });
        written || self.loaded.as_ref().is_some_and(|it| !it.scenario.start.pitch.is_empty())
    }

    /// A constant of a scenario as a parameter.
    fn parameter(&self, path: &Path, within: &Range<usize>) -> Option<Action> {
        let scenario = self.around(within.start, &[SymbolKind::Scenario])?;
        let (range, fact) = self.value_where(within.start, |text| {
            text.starts_with(|sign: char| sign.is_ascii_digit() || sign == '.')
        })?;
        if fact.constants.len() != 1 || range.start < scenario.range.end {
            return None;
        }
        let value = self.text.get(range.clone())?;
        let ty = match fact.ty.as_str() {
            "a whole number" => "int",
            "a number" | "a percentage" => "number",
            "a length" => "length",
            "a duration" => "duration",
            "a speed" => "speed",
            "an angle" => "angle",
            _ => return None,
        };
        let name = self.free_name("value");
        let at = self.body_of(&scenario.whole)?;
        Some(Action {
            title: format!("make `{value}` a parameter"),
            kind: ActionKind::Extract,
            edits: vec![
                Edit::replace(path, at..at, format!("\n    param {name}: {ty} = {value}")),
                Edit::replace(path, range, name),
            ],
            code: None,
            refused: None,
        })
    }

    /// A region that is written where it is used, under a name.
    fn region(&self, path: &Path, within: &Range<usize>) -> Option<Action> {
        let scenario = self.around(within.start, &[SymbolKind::Scenario])?;
        // A reward and a team have frames of their own, in which a region of the scenario isn't.
        if self.around(within.start, &[SymbolKind::Reward, SymbolKind::Team]).is_some() {
            return None;
        }
        let (range, _) = self
            .index
            .values()
            .filter_map(|(span, fact)| Some((self.own(span)?, fact)))
            .filter(|(own, fact)| {
                fact.ty == "a region" && own.start <= within.start && within.end <= own.end
            })
            .max_by_key(|(own, _)| own.len())?;
        let value = self.text.get(range.clone())?;
        // A name is one already.
        if value.chars().all(|sign| sign.is_alphanumeric() || matches!(sign, '_' | '.')) {
            return None;
        }
        let name = self.free_name("area");
        let at = self.body_of(&scenario.whole)?;
        Some(Action {
            title: "give the region a name".to_owned(),
            kind: ActionKind::Extract,
            edits: vec![
                Edit::replace(path, at..at, format!("\n    region {name} = {value}")),
                Edit::replace(path, range, name),
            ],
            code: None,
            refused: None,
        })
    }

    /// The players of the left team as a formation of the file.
    fn formation(&self, path: &Path, within: &Range<usize>) -> Option<Action> {
        let scenario = self.around(within.start, &[SymbolKind::Scenario])?;
        let team = self.around(within.start, &[SymbolKind::Team])?;
        // A formation is stretched to the pitch.
        if team.name != "team left" || team.inside.is_empty() || self.has_own_pitch() {
            return None;
        }
        let first = team.inside.first()?.whole.start;
        let last = team.inside.last()?.whole.end;
        let body = self.text.get(first..last)?;
        let name = self.free_name("shape");
        let players: String = body.lines().map(|line| format!("    {}\n", line.trim())).collect();
        let above = self.text.get(..scenario.whole.start)?;
        // Above the comment of the scenario.
        let comment: usize = above
            .lines()
            .rev()
            .take_while(|line| line.trim_start().starts_with("///"))
            .map(|line| line.len() + 1)
            .sum();
        let at = above.len().saturating_sub(comment);
        Some(Action {
            title: "make a formation of these players".to_owned(),
            kind: ActionKind::Extract,
            edits: vec![
                Edit::replace(path, at..at, format!("formation {name} {{\n{players}}}\n\n")),
                Edit::replace(path, first..last, format!("formation: {name}")),
            ],
            code: None,
            refused: None,
        })
    }

    /// The selected lines of a reward inside `when … { }`.
    fn wrapped(&self, path: &Path, within: &Range<usize>) -> Option<Action> {
        self.around(within.start, &[SymbolKind::Reward])?;
        if within.is_empty() {
            return None;
        }
        let start = super::text::line_around(&self.text, within.start).start;
        let end = super::text::line_around(&self.text, within.end.saturating_sub(1)).end;
        let lines = self.text.get(start..end)?;
        let indent: String = lines.chars().take_while(|sign| *sign == ' ').collect();
        let inside: String = lines.lines().map(|line| format!("    {line}\n")).collect();
        Some(Action {
            title: "do this only `when …`".to_owned(),
            kind: ActionKind::Rewrite,
            edits: vec![Edit::replace(
                path,
                start..end,
                format!("{indent}when me has ball {{\n{inside}{indent}}}\n"),
            )],
            code: None,
            refused: None,
        })
    }

    /// The smallest expression around a byte whose text is as wanted.
    fn value_where(
        &self,
        offset: usize,
        wanted: impl Fn(&str) -> bool,
    ) -> Option<(Range<usize>, &crate::dsl::index::ValueFact)> {
        self.index
            .values()
            .filter_map(|(span, fact)| Some((self.own(span)?, fact)))
            .filter(|(own, _)| own.start <= offset && offset <= own.end)
            .filter(|(own, _)| self.text.get(own.clone()).is_some_and(&wanted))
            .min_by_key(|(own, _)| own.len())
    }

    /// The byte behind the brace that opens a block.
    fn body_of(&self, whole: &Range<usize>) -> Option<usize> {
        let block = super::text::brackets(&self.text);
        let opens = |open: usize| self.text.get(open..).is_some_and(|it| it.starts_with('{'));
        let mut inside = block.iter().filter(|it| whole.contains(&it.open) && opens(it.open));
        inside.next().map(|it| it.open + 1)
    }

    fn free_name(&self, word: &str) -> String {
        free_name(&self.text, word)
    }
}

/// A name that a text doesn't have: the word, or the word with a number.
pub(super) fn free_name(text: &str, word: &str) -> String {
    let is_free = |name: &String| {
        !text.split(|sign: char| !(sign.is_alphanumeric() || sign == '_')).any(|it| it == name)
    };
    let numbered = (2..).map(|number| format!("{word}_{number}"));
    std::iter::once(word.to_owned()).chain(numbered).find(is_free).unwrap_or_default()
}
