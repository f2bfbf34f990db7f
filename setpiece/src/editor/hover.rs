//! What is said about the thing under the cursor.

use super::cursor::{block_of, inline_script};
use super::keywords::KEYWORDS;
use super::place::is_script;
use super::senses::sense;
use super::text::{brackets, ends_in_code, word_at};
use super::words;
use super::{Analysis, FilePlace, Workspace, script};
use crate::dsl::index::ValueFact;
use crate::engine::environment::{Environment, EnvironmentOptions};
use crate::film;
use crate::render::Scene;
use crate::scenario::pitch::{HALF_LENGTH_M, to_normalised};
use crate::scene::of_match;
use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::ops::Range;
use std::path::Path;

/// Words about a place of a text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Hover {
    /// Markdown.
    pub text: String,
    /// The bytes that it is about.
    pub range: Range<usize>,
}

impl Workspace {
    /// What is known of the name, word or expression at a byte of a text.
    pub fn hover(&mut self, path: &Path, offset: usize) -> Option<Hover> {
        let text = self.file_text(path)?;
        let word = word_at(&text, offset);
        let before = text.get(..word.start).unwrap_or_default();
        let of_script = if is_script(path) { Some(before) } else { inline_script(before) };
        if let Some(before) = of_script {
            let about = script::about(before, text.get(word.clone())?)?;
            return Some(Hover { text: about, range: word });
        }
        if !ends_in_code(before) {
            return None;
        }
        let declaration = self.declaration(path, offset);
        let analysis = self.analysis(path)?;
        let range = word_at(&analysis.text, offset);
        let fact = analysis.value_around(offset);
        let mut parts: Vec<String> = Vec::new();
        if let Some(declaration) = declaration {
            parts.extend(analysis.declared(&declaration));
        } else {
            parts.extend(self.meant(path, offset));
        }
        if let Some((_, value)) = &fact {
            parts.push(shown(value));
            parts.extend(analysis.drawn(offset));
            parts.extend(analysis.beside(value));
        }
        let range = if range.is_empty() { fact.map(|(at, _)| at)? } else { range };
        (!parts.is_empty()).then(|| Hover { text: parts.join("\n\n"), range })
    }

    /// What the word at a byte means. Of several meanings those are given of what may be written
    /// there.
    fn meant(&mut self, path: &Path, offset: usize) -> Vec<String> {
        let Some(text) = self.file_text(path) else { return Vec::new() };
        let range = word_at(&text, offset);
        let word = text.get(range.clone()).unwrap_or_default();
        if let Some((doc, page)) = sense(&text, range.start, word) {
            return vec![said(word, doc, page)];
        }
        let mut known = meanings(text.get(..range.start).unwrap_or_default(), word);
        if known.len() > 1 {
            let offered = self.complete(path, range.start);
            let is_offered = |meaning: &Meaning| {
                offered.iter().any(|it| it.text == word && it.doc == meaning.doc)
            };
            if known.iter().any(is_offered) {
                known.retain(is_offered);
            }
        }
        known.into_iter().map(Meaning::said).collect()
    }
}

impl Analysis {
    /// The mean and the range of what is drawn around a byte.
    fn drawn(&self, offset: usize) -> Option<String> {
        let calls =
            brackets(&self.text).into_iter().filter(|it| it.open <= offset && offset < it.close);
        let here = word_at(&self.text, offset);
        let calls = calls.map(|it| it.open).chain(std::iter::once(here.end));
        calls.filter_map(|open| self.distribution(open)).next_back()
    }

    /// What a distribution gives, by where the brackets of its call open.
    fn distribution(&self, open: usize) -> Option<String> {
        let close = brackets(&self.text).into_iter().find(|it| it.open == open)?.close;
        let name = self.text.get(word_at(&self.text, open))?;
        let written = self.text.get(open + 1..close.checked_sub(1)?)?;
        let mut at = open + 1;
        let mut numbers = Vec::new();
        for argument in written.split(',') {
            let blank = argument.len() - argument.trim_start().len();
            let (start, end) = (at + blank, at + argument.trim_end().len());
            let fact = self
                .index
                .values()
                .find_map(|(span, fact)| (self.own(span)? == (start..end)).then_some(fact))?;
            let &[value] = fact.constants.as_slice() else { return None };
            numbers.push((value, fact.ty.as_str()));
            at += argument.len() + 1;
        }
        let ty = numbers.first()?.1;
        let say = |value: f64| quantity(value, ty).unwrap_or_else(|| rounded(value).to_string());
        match (name, numbers.as_slice()) {
            ("uniform" | "integer", &[(low, _), (high, _)]) => Some(format!(
                "mean {}, from {} to {}",
                say(0.5 * (low + high)),
                say(low),
                say(high)
            )),
            ("normal", &[(mean, _), (sd, _)]) => Some(format!(
                "mean {}, 95% from {} to {}",
                say(mean),
                say(mean - 1.96 * sd),
                say(mean + 1.96 * sd)
            )),
            ("truncated_normal", &[(mean, _), _, (low, _), (high, _)]) => {
                Some(format!("around {}, from {} to {}", say(mean), say(low), say(high)))
            }
            _ => None,
        }
    }

    /// Who stands at a point at the start, and how far from their goal.
    fn beside(&self, fact: &ValueFact) -> Option<String> {
        let &[x, y] = fact.constants.as_slice() else { return None };
        if !fact.is_point {
            return None;
        }
        let goal = |side: f64| (x - side * HALF_LENGTH_M).hypot(y);
        let mut text = format!(
            "{}m from the left goal, {}m from the right one",
            rounded_to(goal(-1.0), 1),
            rounded_to(goal(1.0), 1)
        );
        let near =
            self.standing()?.into_iter().filter(|(at, _)| (at[0] - x).hypot(at[1] - y) < NEAR_M);
        let names: Vec<String> = near.map(|(_, name)| name).collect();
        if !names.is_empty() {
            let _ = write!(text, "; here stands {}", names.join(", "));
        }
        Some(text)
    }

    /// Everyone in the first start of the text's last scenario: where, and who.
    fn standing(&self) -> Option<Vec<([f64; 2], String)>> {
        let loaded = self.loaded.as_ref()?;
        let mut environment =
            Environment::new(loaded.scenario.clone(), EnvironmentOptions::default()).ok()?;
        environment.reset(Some(0), Some(0)).ok()?;
        let mut scene = Scene::default();
        of_match(environment.state(), &mut scene);
        let names = film::names(&loaded.scenario);
        let players = scene.players.iter().filter(|player| player.present).map(|player| {
            let name = names.get(crate::scene::player_id(player.id).index());
            let team = ["left", "right"][player.id.team.index()];
            let name = name.filter(|name| !name.is_empty()).cloned();
            let name = name.unwrap_or_else(|| format!("{:?}", player.role));
            (player.pos.map(f64::from), format!("{name} ({team})"))
        });
        Some(players.collect())
    }

    /// The smallest expression around a byte, with what is known of it.
    fn value_around(&self, offset: usize) -> Option<(Range<usize>, &ValueFact)> {
        let mut around: Vec<(Range<usize>, &ValueFact)> = self
            .index
            .values()
            .filter_map(|(span, fact)| Some((self.own(span)?, fact)))
            .filter(|(own, _)| own.start <= offset && offset <= own.end)
            .collect();
        around.sort_by_key(|(own, _)| own.len());
        // A coordinate says little without the other one.
        let mut around = around.into_iter();
        let first = around.next()?;
        let is_literal = self.text.get(first.0.clone())?.parse::<f64>().is_ok();
        match around.next() {
            Some(next) if is_literal && next.1.is_point => Some(next),
            _ => Some(first),
        }
    }

    /// The first line of a declaration, and the comment above it.
    fn declared(&self, declaration: &FilePlace) -> Option<String> {
        let name = crate::files::name_of(&declaration.path);
        let (_, source) = self.sources.iter().find(|(_, source)| source.name == name)?;
        let before = source.text.get(..declaration.range.start)?;
        let start = before.rfind('\n').map_or(0, |at| at + 1);
        let line = source.text.get(start..)?.lines().next()?.trim();
        let line = within_brackets(&source.text, declaration.range.start).unwrap_or(line);
        let comments = before.get(..start)?.lines().rev();
        let mut doc: Vec<&str> =
            comments.map_while(|line| line.trim().strip_prefix("///")).map(str::trim).collect();
        doc.reverse();
        let mut text = format!("```pitch\n{line}\n```");
        if !doc.is_empty() {
            let _ = write!(text, "\n\n{}", doc.join("\n"));
        }
        Some(text)
    }
}

/// What stands between the commas around a name in round brackets: the declaration of a parameter.
/// None if it is the name alone.
fn within_brackets(text: &str, at: usize) -> Option<&str> {
    let all = brackets(text);
    let around = all.iter().filter(|it| it.open < at && at < it.close).max_by_key(|it| it.open)?;
    let inner = around.open + 1..around.close.saturating_sub(1);
    if !text.get(around.open..)?.starts_with('(') {
        return None;
    }
    let is_free = |comma: &usize| {
        !all.iter().any(|it| {
            it.open >= inner.start && it.open < *comma && *comma < it.close && it.open > around.open
        })
    };
    let commas = text.get(inner.clone())?.match_indices(',').map(|(comma, _)| inner.start + comma);
    let commas: Vec<usize> = commas.filter(is_free).collect();
    let start = commas.iter().copied().rfind(|comma| *comma < at).map_or(inner.start, |it| it + 1);
    let end = commas.iter().copied().find(|comma| *comma >= at).unwrap_or(inner.end);
    let whole = text.get(start..end)?.trim();
    (whole != text.get(word_at(text, at))?).then_some(whole)
}

/// How near to a point somebody stands there, metres.
const NEAR_M: f64 = 0.5;

/// A meaning of a word.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Meaning {
    word: &'static str,
    doc: &'static str,
    /// The page of the reference.
    page: &'static str,
}

impl Meaning {
    fn said(self) -> String {
        said(self.word, self.doc, self.page)
    }
}

/// A word, what it means, and the page of the reference.
fn said(word: &str, doc: &str, name: &str) -> String {
    format!("**{word}**: {doc} ([{name}]({}))", page(name))
}

/// All that a word of the language may mean; a keyword that several blocks have, in this block.
fn meanings(before: &str, word: &str) -> Vec<Meaning> {
    let block = block_of(before);
    let keywords = || KEYWORDS.iter().filter(|known| known.name == word);
    let keyword = keywords().find(|known| known.block == block).or_else(|| keywords().next_back());
    let keyword = keyword.map(|it| Meaning { word: it.name, doc: it.doc, page: it.page });
    let of_tables = words::all().filter(|known| known.name == word);
    let of_tables = of_tables.map(|it| Meaning { word: it.name, doc: it.doc, page: it.page });
    let mut found: Vec<Meaning> = keyword.into_iter().chain(of_tables).collect();
    let mut seen = BTreeSet::new();
    found.retain(|it| seen.insert(it.doc));
    found
}

/// The address of a page of the reference.
fn page(name: &str) -> String {
    format!("{}/language/{}/", crate::DOCS, name.trim_end_matches(".md"))
}

fn rounded_to(value: f64, digits: i32) -> f64 {
    let scale = 10_f64.powi(digits);
    (value * scale).round() / scale + 0.0
}

fn rounded(value: f64) -> f64 {
    rounded_to(value, 3)
}

/// A number of a type as it is written; none for other types.
fn quantity(value: f64, ty: &str) -> Option<String> {
    Some(match ty {
        "a length" => format!("{}m", rounded(value)),
        "a duration" => format!("{}s, {} steps", rounded(value), rounded(value * 10.0)),
        "a speed" => format!("{}m/s", rounded(value)),
        "an angle" => format!("{}deg", rounded(value.to_degrees())),
        "a percentage" => format!("{}%", rounded(100.0 * value)),
        "a number" | "a whole number" => rounded(value).to_string(),
        _ => return None,
    })
}

/// The type of an expression, and its value if it is a constant.
fn shown(fact: &ValueFact) -> String {
    match *fact.constants.as_slice() {
        [x, y] if fact.is_point => {
            let (u, v) = to_normalised(x, y);
            let [x, y, u, v] = [x, y, u, v].map(rounded);
            format!("{}: ({x}m, {y}m), normalised ({u}, {v})", fact.ty)
        }
        [value] => match quantity(value, &fact.ty) {
            Some(shown) => format!("{}: {shown}", fact.ty),
            None => fact.ty.clone(),
        },
        _ => fact.ty.clone(),
    }
}
