//! The words of a report, and how facts put them together.

use super::similar::{Guess, Meant};
use crate::source::Span;

/// A place of a problem and what is to be said about it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Label {
    /// Where.
    pub span: Span,
    /// What; may be empty for the primary label.
    pub text: String,
}

/// What a report says.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Words {
    /// One clause, lower case, no full stop, the author's text in backticks.
    pub message: String,
    /// Where; the first is the primary one.
    pub labels: Vec<Label>,
    /// What to write instead.
    pub help: Option<String>,
    /// The same as changes of the text, as far as it is known where they go; the likeliest first.
    pub rewrites: Vec<Rewrite>,
    /// A statement that the help asks for elsewhere than in the place of the marked text.
    pub elsewhere: Option<Elsewhere>,
}

/// A statement that a help asks for elsewhere than in the place of the marked text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Elsewhere {
    /// A statement of the scenario.
    OfScenario(String),
    /// A statement at the top of the reward or the behaviour.
    OfBody(String),
    /// An option of a block of the scenario, with its value: the block, the key, the value.
    Setting(&'static str, String, String),
    /// The marked option and its value, in this block of the scenario.
    Moved(&'static str),
    /// The marked value as a `let` of the scenario, and its name in the place of the value.
    Named,
}

/// A way to follow a help.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Rewrite {
    /// What is written; empty if something is left out.
    pub says: String,
    /// Where it may go, the likeliest first: texts in the place of others.
    pub places: Vec<Vec<(Span, String)>>,
}

impl Rewrite {
    /// A text in the place of another one.
    pub(crate) fn one(span: Span, text: impl Into<String>) -> Rewrite {
        let text = text.into();
        Rewrite { says: text.trim().to_owned(), places: vec![vec![(span, text)]] }
    }
}

/// The words of a fact, which doesn't know where it was found.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Said {
    pub(super) message: String,
    /// What the marked text is; may be empty.
    pub(super) label: String,
    /// Further places.
    pub(super) also: Vec<Label>,
    pub(super) help: Option<String>,
    /// Names that the help suggests.
    pub(super) names: Vec<String>,
    /// Texts that stand for others once the help is followed; for the marked one if none is named.
    pub(super) writes: Vec<(Option<Span>, String)>,
    /// What the help asks for elsewhere.
    pub(super) elsewhere: Option<Elsewhere>,
}

/// Says what is wrong, and what the marked text is.
pub(super) fn say(message: impl Into<String>, label: impl Into<String>) -> Said {
    Said {
        message: message.into(),
        label: label.into(),
        also: Vec::new(),
        help: None,
        names: Vec::new(),
        writes: Vec::new(),
        elsewhere: None,
    }
}

impl Said {
    /// Marks a further place.
    pub(super) fn at(mut self, span: &Span, text: impl Into<String>) -> Said {
        self.also.push(Label { span: *span, text: text.into() });
        self
    }

    /// Says what to write instead.
    pub(super) fn help(mut self, help: impl Into<String>) -> Said {
        self.help = Some(help.into());
        self
    }

    /// Says to write something in the place of the marked text.
    pub(super) fn write(self, text: impl Into<String>) -> Said {
        let text = text.into();
        self.help(format!("write `{text}`")).writing(None, text)
    }

    /// Notes how the help is followed: by a text in the place of another one, or of the marked one.
    pub(super) fn writing(mut self, span: Option<Span>, text: impl Into<String>) -> Said {
        self.writes.push((span, text.into()));
        self
    }

    /// Notes a statement that the help asks for elsewhere.
    pub(super) fn elsewhere(mut self, statement: Elsewhere) -> Said {
        self.elsewhere = Some(statement);
        self
    }

    /// The same as [`Said::writing`], if there is such a text.
    pub(super) fn writing_if(self, found: Option<(Span, &String)>) -> Said {
        match found {
            Some((span, text)) => self.writing(Some(span), text),
            None => self,
        }
    }

    /// Notes a name that the help suggests.
    pub(super) fn suggesting(mut self, name: &str) -> Said {
        self.names.push(name.to_owned());
        self
    }

    /// Says "did you mean", or `listed` and the names that there are.
    pub(super) fn guess(mut self, guess: &Guess, listed: &str) -> Said {
        match &guess.meant {
            Some(Meant::Habit(help)) => self.help(help.as_str()),
            Some(Meant::Name(name)) => {
                self.names.push(name.clone());
                self.help(format!("did you mean `{name}`?"))
            }
            None if guess.known.is_empty() => self,
            None => {
                self.names.extend(guess.known.iter().cloned());
                let names = guess.known.join("`, `");
                self.help(format!("{listed} `{names}`"))
            }
        }
    }
}
