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
}

/// Says what is wrong, and what the marked text is.
pub(super) fn say(message: impl Into<String>, label: impl Into<String>) -> Said {
    Said {
        message: message.into(),
        label: label.into(),
        also: Vec::new(),
        help: None,
        names: Vec::new(),
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
