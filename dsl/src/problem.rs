//! Problems: facts that a stage finds, each with a stable code, a place and, at last, words.
//!
//! A stage makes a [`Problem`] from a fact (`facts/`), which has data and no words. Later stages
//! move, sort and drop problems by their facts and codes. Words are made when a report is rendered
//! ([`Problem::words`]).

mod code;
pub(crate) mod facts;
mod said;
mod script;
mod similar;
mod triage;

pub use code::{Code, Severity, Stage};
pub use said::{Elsewhere, Label, Rewrite, Words};
pub use script::{ScriptApi, ScriptProblem, ScriptSight};
pub(crate) use similar::Guess;
pub use similar::nearest;
pub(crate) use triage::triage;

pub use facts::{Cure, DryRun};

use crate::source::Span;
use facts::Fact;

/// A problem: a fact and its place.
#[derive(Clone, Debug, PartialEq)]
pub struct Problem {
    fact: Fact,
    span: Span,
    /// Where the scenario itself declares what the fact follows from, if its place is inherited.
    declared: Option<Span>,
    /// How its help is followed where it was found, beside what the fact knows.
    rewrites: Vec<Rewrite>,
}

impl Problem {
    /// A fact and where it was found.
    pub(crate) fn new(span: Span, fact: impl Into<Fact>) -> Problem {
        Problem { fact: fact.into(), span, declared: None, rewrites: Vec::new() }
    }

    /// What a dry run found, and where.
    pub fn of_dry_run(span: Span, found: DryRun) -> Problem {
        Problem::new(span, found)
    }

    /// Adds where the scenario itself declares what the fact follows from.
    #[must_use]
    pub(crate) fn declared_at(mut self, span: Span) -> Problem {
        self.declared = Some(span);
        self
    }

    /// Adds that its help is followed by a text in the place of another one.
    #[must_use]
    pub(crate) fn rewriting(self, span: Span, text: impl Into<String>) -> Problem {
        self.with_rewrite(Rewrite::one(span, text))
    }

    /// Adds a way to follow its help.
    #[must_use]
    pub(crate) fn with_rewrite(mut self, rewrite: Rewrite) -> Problem {
        self.rewrites.push(rewrite);
        self
    }

    /// What was found.
    pub(crate) fn fact(&self) -> &Fact {
        &self.fact
    }

    /// The stable code.
    pub fn code(&self) -> Code {
        self.fact.code()
    }

    /// How bad it is.
    pub fn severity(&self) -> Severity {
        self.code().severity()
    }

    /// Where it is.
    pub fn place(&self) -> Span {
        self.span
    }

    /// What a report says.
    pub fn words(&self) -> Words {
        let said = self.fact.words();
        let mut labels = vec![Label { span: self.span, text: said.label }];
        labels.extend(said.also);
        labels.extend(self.declared.map(|span| Label { span, text: "declared here".to_owned() }));
        let written = said
            .writes
            .into_iter()
            .map(|(span, text)| Rewrite::one(span.unwrap_or(self.span), text));
        let rewrites = self.rewrites.iter().cloned().chain(written).collect();
        Words {
            message: said.message,
            labels,
            help: said.help,
            rewrites,
            elsewhere: said.elsewhere,
        }
    }

    /// Whether it says that the file has nothing to run, or not what was asked for.
    pub fn misses_scenario(&self) -> bool {
        self.fact.misses_scenario()
    }

    /// Whether no scenario comes out because of it.
    pub(crate) fn is_error(&self) -> bool {
        self.severity() == Severity::Error
    }

    /// The names that its help suggests.
    pub(crate) fn suggested(&self) -> Vec<String> {
        self.fact.words().names
    }
}

/// Whether no scenario comes out because of one of them.
pub(crate) fn has_errors(problems: &[Problem]) -> bool {
    problems.iter().any(Problem::is_error)
}

/// How a word is written, from its line of documentation: what stands before the first `: ` outside
/// of brackets.
pub(crate) fn signature(doc: &str) -> &str {
    let mut depth = 0_i32;
    let end = doc.char_indices().find(|(at, sign)| {
        depth += i32::from(*sign == '(') - i32::from(*sign == ')');
        depth == 0 && doc.get(*at..).is_some_and(|rest| rest.starts_with(": "))
    });
    end.and_then(|(at, _)| doc.get(..at)).unwrap_or(doc)
}
