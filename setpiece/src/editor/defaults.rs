//! What the default of a parameter or a constant of a declared type may be.

use super::Analysis;
use super::completion::{Completion, PARAMETER, word, words_of};
use super::words::WordKind;
use crate::scenario::vocabulary::{Function, Type};

/// Functions of numbers alone. Others are drawn, or read the match: a default is neither.
const OF_NUMBERS: [Function; 15] = [
    Function::Abs,
    Function::Min,
    Function::Max,
    Function::Clamp,
    Function::Exp,
    Function::Log,
    Function::Pow,
    Function::Sqrt,
    Function::Floor,
    Function::Ceil,
    Function::Round,
    Function::Mod,
    Function::Sin,
    Function::Cos,
    Function::Smoothstep,
];

/// What a constant is, in a few words.
const CONSTANT: &str = "a constant";

impl Analysis {
    /// What may stand behind `param NAME: TYPE = `, also in brackets behind a name; none elsewhere.
    pub(super) fn defaults(&self, text: &str) -> Option<Vec<Completion>> {
        let own = || self.constants().into_iter();
        let words = |words: &[(&str, &str)]| -> Vec<Completion> {
            words.iter().map(|&(name, doc)| word(name, doc, "value")).chain(own()).collect()
        };
        Some(match declared(text)? {
            Type::Bool => words(&[("true", "it holds"), ("false", "it doesn't hold")]),
            Type::Team => words(&[("left", "the left team"), ("right", "the right team")]),
            Type::String => words(&[("\"\"", "a word")]),
            Type::Number
            | Type::Int
            | Type::Percent
            | Type::Length
            | Type::Duration
            | Type::Speed
            | Type::Angle => {
                let is_of_numbers =
                    |it: &Completion| OF_NUMBERS.iter().any(|known| known.name() == it.text);
                let functions = words_of(&[WordKind::Function]).filter(is_of_numbers);
                own().chain(functions).collect()
            }
            _ => return None,
        })
    }

    /// Parameters of the text, and the constants that it sees.
    fn constants(&self) -> Vec<Completion> {
        let parameters = self.own_names().into_iter().filter(|it| it.detail == PARAMETER);
        let constants = self.value_items().into_iter().filter(|it| it.detail == CONSTANT);
        parameters.chain(constants).collect()
    }
}

/// The type of the parameter or constant whose value is written at the end of a text.
fn declared(text: &str) -> Option<Type> {
    let head = text.trim_end().strip_suffix('=')?.trim_end();
    let (before, ty) = head.rsplit_once(':')?;
    let is_declared = before.trim_end().rsplit(['\n', ',', '(']).next().is_some_and(|own| {
        let mut words = own.split_whitespace();
        matches!((words.next(), words.next()), (Some("param" | "const"), _) | (Some(_), None))
    });
    is_declared.then(|| Type::from_name(ty.trim())).flatten()
}
