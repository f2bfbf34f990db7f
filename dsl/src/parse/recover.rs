//! Lists of statements, and what is said about the parts of them that can't be read.

mod expect;
mod words;

use super::reader::{Node, Nodes, Reader, token};
use crate::problem::{Code, Problem, nearest};
use crate::source::Span;
use pest::Parser;
use pest::error::ErrorVariant;
use setpiece_grammar::{PitchParser, Rule};
use std::ops::Range;

pub(super) use words::Context;

/// Junk that was just told about.
struct Told {
    /// The indentation of its line.
    indent: usize,
}

impl Reader<'_> {
    /// Converts the statements of a list; junk becomes problems and what `broken` makes.
    pub(super) fn list<T>(
        &mut self,
        node: Node<'_>,
        context: Context,
        convert: impl Fn(&mut Self, Node<'_>, Span, String) -> T,
        broken: impl Fn(Span, String) -> T,
    ) -> Vec<T> {
        let mut statements = Vec::new();
        let mut doc = String::new();
        let mut before: Option<Range<usize>> = None;
        let mut told: Option<Told> = None;
        for child in Nodes::of(node) {
            let rule = child.as_rule();
            if rule == Rule::doc {
                super::item::add_doc(&mut doc, &child);
            } else if rule == Rule::junk {
                let range = self.range(&child);
                if self.is_full() || self.is_told(&range) {
                    statements.push(broken(self.span(&child), std::mem::take(&mut doc)));
                    before = None;
                    continue;
                }
                let indent = self.indent(range.start);
                // A further line of a statement that was told about is no news.
                if told.as_ref().is_none_or(|told| indent <= told.indent) {
                    let condemned = self.recover(context, range.clone(), before.clone());
                    if let Some(last) = statements.last_mut().filter(|_| condemned)
                        && let Some(before) = &before
                    {
                        *last = broken(self.between(before.start, before.end), String::new());
                    }
                    told = Some(Told {
                        indent: before.as_ref().map_or(indent, |before| indent.min(self.indent(before.start))),
                    });
                }
                statements.push(broken(self.span(&child), std::mem::take(&mut doc)));
                before = None;
            } else if rule == context.statement() {
                let span = self.span(&child);
                before = Some(self.range(&child));
                told = None;
                statements.push(convert(self, child, span, std::mem::take(&mut doc)));
            }
        }
        statements
    }

    /// The indentation of the line of an offset.
    fn indent(&self, at: usize) -> usize {
        let before = self.text.get(..at).unwrap_or_default();
        let line = before.rfind('\n').map_or(before, |newline| before.get(newline + 1..).unwrap_or_default());
        line.len() - line.trim_start_matches([' ', '\t']).len()
    }

    /// Re-reads junk to say what was expected, and reads the blocks in it for further problems.
    ///
    /// - `before`: the statement in front of it, which may be the one that goes wrong here; `true` if it means nothing.
    fn recover(&mut self, context: Context, junk: Range<usize>, before: Option<Range<usize>>) -> bool {
        let continued = before.filter(|before| !self.text.get(..before.end).unwrap_or_default().ends_with('}'));
        let start = continued.as_ref().map_or(junk.start, |before| before.start);
        let slice = self.text.get(start..junk.end).unwrap_or_default();
        if !self.spend(slice.len()) {
            let problem = self.expectation(context, &junk, None, junk.start, &[]);
            self.push(problem);
            return false;
        }
        let (at, positives) = match PitchParser::parse(context.probe(), slice) {
            Ok(_) => (junk.start, Vec::new()),
            Err(error) => {
                let (pest::error::InputLocation::Pos(at) | pest::error::InputLocation::Span((at, _))) = error.location;
                match error.variant {
                    ErrorVariant::ParsingError { positives, .. } => (start + at, positives),
                    ErrorVariant::CustomError { .. } => (junk.start, Vec::new()),
                }
            }
        };
        let mut at = at.max(junk.start);
        let mut positives = positives;
        // A lone word could always have been an option's key or a state: the word is the news, not the missing sign.
        let first = token(text_from(self.text, junk.start));
        let behind = self.text.get(junk.start + first.len()..at).is_some_and(|gap| gap.trim().is_empty());
        let lone = match context {
            Context::Fields => false,
            Context::Reward | Context::Behavior if positives == [Rule::equals] => {
                let further = if continued.is_some() { context.further() } else { &[] };
                nearest(first, context.keywords().iter().chain(further).copied()).is_some()
            }
            _ => positives == [Rule::colon],
        };
        if lone && behind {
            at = junk.start;
            positives.clear();
        }
        let problem = self.expectation(context, &junk, continued.as_ref(), at, &positives);
        let condemned = problem.code == Code::UnknownRole && continued.is_some();
        self.push(problem);
        self.read_block(context, &junk, at);
        condemned
    }

    /// Reads the block behind a head that went wrong, for the problems in it.
    fn read_block(&mut self, context: Context, junk: &Range<usize>, at: usize) {
        let text = self.text;
        let Some(brace) = text.get(at..junk.end).and_then(|rest| rest.find('{')).map(|brace| at + brace) else {
            return;
        };
        let first = token(text.get(junk.start..).unwrap_or_default());
        let Some(keyword) = nearest(first, context.keywords().iter().copied()) else { return };
        let Some(rule) = context.block_of(keyword) else { return };
        if !self.spend(junk.end - brace) {
            return;
        }
        let Ok(mut pairs) = PitchParser::parse(rule, text.get(brace..junk.end).unwrap_or_default()) else { return };
        let Some(node) = pairs.next() else { return };
        let (base, operators) = (std::mem::replace(&mut self.base, brace), std::mem::take(&mut self.operators));
        match rule {
            Rule::scenario_body => drop(self.scenario_body(node)),
            Rule::team_body => drop(self.team_body(node)),
            Rule::reward_body => drop(self.reward_body(node)),
            Rule::behavior_body => drop(self.behavior_body(node)),
            _ => drop(self.fields(node)),
        }
        self.base = base;
        self.operators = operators;
    }

    /// A problem of a word at the start of a statement, or nothing if the word may be right.
    fn misplaced(&self, context: Context, word: &str, at: usize) -> Option<Problem> {
        let span = self.at(at);
        let owner = Context::ALL.iter().find(|other| other.keywords().contains(&word))?;
        if context.keywords().contains(&word) {
            return None;
        }
        let message = format!("`{word}` can't stand in {}", context.name());
        Some(Problem::new(Code::Syntax, span, message, "not here").help(format!("it belongs in {}", owner.name())))
    }
}

fn text_from(text: &str, at: usize) -> &str {
    text.get(at..).unwrap_or_default()
}
