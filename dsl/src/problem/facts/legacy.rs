use super::{Fact, facts};
use crate::problem::said::{Said, say};
use crate::problem::{Code, Guess, Problem};
use crate::source::Span;

facts! {
    /// Facts in words.
    pub(crate) Legacy {
        /// In words.
        Said { code: Code, said: Said } = *code => said.clone(),
    }
}

impl Problem {
    pub(crate) fn legacy(code: Code, span: Span, message: impl Into<String>, label: impl Into<String>) -> Problem {
        Problem::new(span, Legacy::Said { code, said: say(message, label) })
    }
    fn edit(mut self, f: impl FnOnce(Said) -> Said) -> Problem {
        let said = self.fact.words();
        self.fact = Fact::Legacy(Legacy::Said { code: self.fact.code(), said: f(said) });
        self
    }
    pub(crate) fn given_twice(what: &str, again: Span, first: Span) -> Problem {
        Problem::legacy(Code::DuplicateOption, again, format!("{what} is given twice"), "given again here")
            .label(first, "first given here")
            .help("leave one of them out")
    }
    pub(crate) fn declared_twice(what: &str, again: Span, first: Span) -> Problem {
        Problem::legacy(Code::DuplicateName, again, format!("{what} is declared twice"), "declared again here")
            .label(first, "first declared here")
            .help("choose another name for one of them")
    }
    pub(crate) fn label(self, span: Span, text: impl Into<String>) -> Problem {
        self.edit(|said| said.at(&span, text))
    }
    pub(crate) fn help(self, help: impl Into<String>) -> Problem {
        self.edit(|said| said.help(help))
    }
    pub(crate) fn did_you_mean<'a>(self, found: &str, candidates: impl IntoIterator<Item = &'a str>) -> Problem {
        self.edit(|said| said.guess(&Guess::of(found, candidates), ""))
    }
    pub(crate) fn one_of(self, found: &str, known: &[&str]) -> Problem {
        self.edit(|said| said.guess(&Guess::or_all(found, known), "it can be"))
    }
    pub(crate) fn has_help(&self) -> bool {
        self.fact.words().help.is_some()
    }
}
