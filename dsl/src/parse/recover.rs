//! Lists of statements, and what is said about the parts of them that can't be read.

mod event;
mod expect;
mod tokens;
mod unit;
mod words;

use super::reader::{CstNode, CstNodes, Reader, token};
use crate::problem::facts::Syntax;
use crate::problem::{Problem, nearest};
use crate::source::Span;
use pest::Parser;
use pest::error::{ErrorVariant, InputLocation};
use setpiece_grammar::{PitchParser, Rule};
use std::ops::Range;

pub(super) use words::Context;
pub use words::statement_words;

/// Junk that was just reported about.
struct Reported {
    /// The indentation of its line.
    indent: usize,
}

/// A statement that can't be read, and where it stops making sense.
struct Wrong<'t> {
    context: Context,
    junk: Range<usize>,
    /// The statement in front that the junk may go on with.
    before: Option<Range<usize>>,
    /// Where the grammar can't go on, and what it wants there.
    at: usize,
    positives: Vec<Rule>,
    /// The tokens of the statement, with those before the junk that belong to it.
    tokens: Vec<(usize, &'t str)>,
    /// The junk's first token.
    first: usize,
    /// Whether `at` was met inside of its token.
    inside: bool,
}

impl Wrong<'_> {
    /// The token that holds `at`, or the number of tokens if none does.
    fn token_at(&self) -> usize {
        match self.tokens.partition_point(|(from, _)| *from <= self.at).checked_sub(1) {
            Some(index) if self.at < self.junk.end => index,
            _ => self.tokens.len(),
        }
    }
}

/// What is said about junk.
struct Finding {
    problem: Problem,
    /// Whether a new statement begins with the junk, so that the one before is as good as it looks.
    fresh: bool,
    /// Whether it surely goes on with the statement before it.
    goes_on: bool,
}

impl Finding {
    fn new(problem: Problem) -> Finding {
        Finding { problem, fresh: false, goes_on: false }
    }
}

impl Reader<'_> {
    /// Converts the statements of a list; junk becomes problems and what `broken` makes.
    pub(super) fn list<T>(
        &mut self,
        node: CstNode<'_>,
        context: Context,
        convert: impl Fn(&mut Self, CstNode<'_>, Span, String) -> T,
        broken: impl Fn(Span, String) -> T,
    ) -> Vec<T> {
        let mut statements = Vec::new();
        let mut doc = String::new();
        let mut before: Option<Range<usize>> = None;
        let mut reported: Option<Reported> = None;
        let mut taken = 0;
        for child in CstNodes::of(node) {
            let rule = child.as_rule();
            if matches!(rule, Rule::junk) || rule == context.statement() {
                let at = child.as_span().start() + self.base;
                if !self.has_room(taken, self.at(at), context.list()) {
                    break;
                }
                taken += 1;
            }
            if rule == Rule::doc {
                super::item::add_doc(&mut doc, &child);
            } else if rule == Rule::junk {
                let range = self.range(&child);
                self.lose(range.clone());
                let indent = self.indent(range.start);
                let quiet = self.is_full() || self.is_reported(&range);
                // A further line of a statement that was reported about is no news.
                let condemned = if quiet {
                    before.as_ref().is_some_and(|before| self.belongs(before, &range))
                } else if reported.as_ref().is_none_or(|reported| indent <= reported.indent) {
                    reported = Some(Reported {
                        indent: before
                            .as_ref()
                            .map_or(indent, |before| indent.min(self.indent(before.start))),
                    });
                    self.recover(context, &range, before.as_ref())
                } else {
                    false
                };
                if let (true, Some(before), Some(last)) =
                    (condemned, &before, statements.last_mut())
                {
                    self.lose(before.clone());
                    *last = broken(self.between(before.start, before.end), String::new());
                }
                statements.push(broken(self.span(&child), std::mem::take(&mut doc)));
                before = None;
            } else if rule == context.statement() {
                let span = self.span(&child);
                before = Some(self.range(&child));
                reported = None;
                statements.push(convert(self, child, span, std::mem::take(&mut doc)));
            }
        }
        statements
    }

    /// Whether junk goes on with the statement before it: on its line, or with a word or sign that
    /// begins no statement.
    fn belongs(&self, before: &Range<usize>, junk: &Range<usize>) -> bool {
        let first = token(text(self.text, junk.clone()));
        let unit = first.starts_with("step")
            && text(self.text, before.clone()).ends_with(|char: char| char.is_ascii_digit());
        !text(self.text, before.end..junk.start).contains('\n')
            || unit
            || first.starts_with(|char: char| "=.,:*/+-<>!?&|%^([{".contains(char))
            || PitchParser::parse(Rule::continuing, first).is_ok()
    }

    /// Re-reads junk to say what was expected, and reads the blocks in it for further problems.
    ///
    /// - `before`: the statement in front of it, which may be the one that goes wrong here; `true`
    ///   if it means nothing.
    fn recover(
        &mut self,
        context: Context,
        junk: &Range<usize>,
        before: Option<&Range<usize>>,
    ) -> bool {
        let whole = before.filter(|before| !text(self.text, 0..before.end).ends_with('}'));
        let start = whole.map_or(junk.start, |before| before.start);
        let slice = text(self.text, start..junk.end);
        let (mut at, mut positives) = (junk.start, Vec::new());
        if self.spend(slice.len())
            && let Err(error) = PitchParser::parse(context.probe(), slice)
            && let ErrorVariant::ParsingError { positives: wanted, .. } = error.variant
        {
            let (InputLocation::Pos(met) | InputLocation::Span((met, _))) = error.location;
            (at, positives) = (self.next_token((start + met).max(junk.start)), wanted);
        }
        let belonging = before.filter(|before| self.belongs(before, junk));
        let tokens = self.tokens(belonging.map_or(junk.start, |before| before.start)..junk.end);
        let first = tokens.partition_point(|(from, _)| *from < junk.start);
        let wrong = Wrong {
            context,
            junk: junk.clone(),
            before: whole.cloned(),
            at,
            positives,
            tokens,
            first,
            inside: false,
        };
        let Finding { problem, fresh, goes_on } = self.explain(wrong);
        let condemned = belonging.is_some() && !fresh && (whole.is_some() || goes_on);
        self.push(problem);
        self.read_block(context, junk, at);
        condemned
    }

    /// Reads the block behind a head that went wrong, for the problems in it.
    fn read_block(&mut self, context: Context, junk: &Range<usize>, at: usize) {
        let text = self.text;
        let Some(brace) =
            text.get(at..junk.end).and_then(|rest| rest.find('{')).map(|brace| at + brace)
        else {
            return;
        };
        let first = token(text.get(junk.start..).unwrap_or_default());
        let Some(keyword) = nearest(first, context.keywords().iter().copied()) else { return };
        let Some(rule) = context.block_of(keyword) else { return };
        if !self.spend(junk.end - brace) {
            return;
        }
        let Ok(mut pairs) = PitchParser::parse(rule, text.get(brace..junk.end).unwrap_or_default())
        else {
            return;
        };
        let Some(node) = pairs.next() else { return };
        let (base, operators) =
            (std::mem::replace(&mut self.base, brace), std::mem::take(&mut self.operators));
        match rule {
            Rule::scenario_body => drop(self.scenario_body(node)),
            Rule::team_body => drop(self.team_body(node)),
            Rule::reward_body => drop(self.reward_body(node)),
            Rule::behavior_body => drop(self.behavior_body(node)),
            Rule::suite_body => drop(self.suite_body(node)),
            Rule::check_body => drop(self.check_body(node)),
            Rule::curriculum_body => drop(self.curriculum_body(node)),
            _ => drop(self.fields(node)),
        }
        self.base = base;
        self.operators = operators;
    }

    /// A problem of a word at the start of a statement, or nothing if the word may be right.
    fn misplaced(
        &self,
        context: Context,
        word: &str,
        at: usize,
        habit: Option<&str>,
    ) -> Option<Problem> {
        let span = self.at(at);
        // What may stand in a file and in a scenario belongs in the scenario around.
        let owner = std::iter::once(Context::Scenario)
            .chain(Context::ALL)
            .find(|other| other.keywords().contains(&word))?;
        if context.keywords().contains(&word) {
            return None;
        }
        let (word, habit) = (word.to_owned(), habit.map(str::to_owned));
        Some(Problem::new(
            span,
            Syntax::Misplaced { word, place: context.name(), owner: owner.name(), habit },
        ))
    }
}

fn text(text: &str, range: Range<usize>) -> &str {
    text.get(range).unwrap_or_default()
}
