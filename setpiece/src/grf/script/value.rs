//! The values of a script, and its expressions.

use super::lines::PyToken;
use crate::scenario::vocabulary::{Role, Team};
use std::collections::BTreeMap;

/// How deep brackets are read.
const DEPTH_MAX: usize = 40;

/// A value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum PyValue {
    Flag(bool),
    Whole(i64),
    Number(f64),
    Team(Team),
    Role(Role),
    /// What `builder.config()` returns.
    Config,
    /// The script's argument.
    Builder,
}

impl PyValue {
    /// A finite number.
    pub(super) fn number(self) -> Option<f64> {
        let value = match self {
            PyValue::Number(value) => value,
            _ => self.whole()? as f64,
        };
        value.is_finite().then_some(value)
    }

    /// A whole number; flags are 0 and 1.
    pub(super) fn whole(self) -> Option<i64> {
        match self {
            PyValue::Whole(whole) => Some(whole),
            PyValue::Flag(flag) => Some(i64::from(flag)),
            _ => None,
        }
    }

    /// Whether it counts as true.
    pub(super) fn truth(self) -> Option<bool> {
        self.number().map(|value| value != 0.0)
    }

    /// A team, or its number.
    pub(super) fn team(self) -> Option<Team> {
        match self {
            PyValue::Team(team) => Some(team),
            _ => Team::ALL.get(usize::try_from(self.whole()?).ok()?).copied(),
        }
    }

    /// A role, or its number.
    pub(super) fn role(self) -> Option<Role> {
        match self {
            PyValue::Role(role) => Some(role),
            _ => Role::ALL.get(usize::try_from(self.whole()?).ok()?).copied(),
        }
    }
}

/// Where names have values.
pub(super) struct PyNames<'t> {
    /// The values of names.
    pub(super) values: BTreeMap<&'t str, PyValue>,
    /// What `EpisodeNumber()` returns.
    pub(super) episode: i64,
}

impl<'t> PyNames<'t> {
    /// The value of an expression; none if it can't be read.
    pub(super) fn value(&self, tokens: &[PyToken<'t>]) -> Option<PyValue> {
        let mut reader = PyReader { names: self, tokens, at: 0, depth: 0 };
        let value = reader.choice()?;
        (reader.at == tokens.len()).then_some(value)
    }

    fn name(&self, name: &str) -> Option<PyValue> {
        let known = self.values.get(name).copied();
        known.or_else(|| match name {
            "True" => Some(PyValue::Flag(true)),
            "False" => Some(PyValue::Flag(false)),
            _ => Role::from_name(name.strip_prefix("e_PlayerRole_")?).map(PyValue::Role),
        })
    }
}

/// Reads an expression from left to right.
struct PyReader<'r, 't> {
    names: &'r PyNames<'t>,
    tokens: &'r [PyToken<'t>],
    at: usize,
    depth: usize,
}

impl<'t> PyReader<'_, 't> {
    fn peek(&self) -> Option<PyToken<'t>> {
        self.tokens.get(self.at).copied()
    }

    fn takes(&mut self, token: PyToken<'_>) -> bool {
        let is_next = self.peek() == Some(token);
        self.at += usize::from(is_next);
        is_next
    }

    fn sign(&mut self, among: &[&str]) -> Option<&'t str> {
        match self.peek() {
            Some(PyToken::Sign(sign)) if among.contains(&sign) => {
                self.at += 1;
                Some(sign)
            }
            _ => None,
        }
    }

    /// `a if c else b`.
    fn choice(&mut self) -> Option<PyValue> {
        if self.depth == DEPTH_MAX {
            return None;
        }
        self.depth += 1;
        let mut value = self.either()?;
        if self.takes(PyToken::Word("if")) {
            let holds = self.either()?.truth()?;
            if !self.takes(PyToken::Word("else")) {
                return None;
            }
            let other = self.choice()?;
            value = if holds { value } else { other };
        }
        self.depth -= 1;
        Some(value)
    }

    fn either(&mut self) -> Option<PyValue> {
        let mut value = self.both()?;
        while self.takes(PyToken::Word("or")) {
            let other = self.both()?;
            value = if value.truth()? { value } else { other };
        }
        Some(value)
    }

    fn both(&mut self) -> Option<PyValue> {
        let mut value = self.negation()?;
        while self.takes(PyToken::Word("and")) {
            let other = self.negation()?;
            value = if value.truth()? { other } else { value };
        }
        Some(value)
    }

    fn negation(&mut self) -> Option<PyValue> {
        let mut count = 0;
        while self.takes(PyToken::Word("not")) {
            count += 1;
        }
        let value = self.comparison()?;
        Some(if count == 0 { value } else { PyValue::Flag(value.truth()? != (count % 2 == 1)) })
    }

    fn comparison(&mut self) -> Option<PyValue> {
        const SIGNS: &[&str] = &["==", "!=", "<=", ">=", "<", ">"];
        let value = self.sum()?;
        let Some(sign) = self.sign(SIGNS) else { return Some(value) };
        let other = self.sum()?;
        // Several in a row are read by Python in a way of its own.
        if self.sign(SIGNS).is_some() {
            return None;
        }
        let holds = match (value, other) {
            (PyValue::Team(one), PyValue::Team(two)) => compared(sign, &one, &two),
            (PyValue::Role(one), PyValue::Role(two)) => compared(sign, &one, &two),
            _ => compared(sign, &value.number()?, &other.number()?),
        };
        Some(PyValue::Flag(holds))
    }

    fn sum(&mut self) -> Option<PyValue> {
        let mut value = self.product()?;
        while let Some(sign) = self.sign(&["+", "-"]) {
            value = calculated(sign, value, self.product()?)?;
        }
        Some(value)
    }

    fn product(&mut self) -> Option<PyValue> {
        let mut value = self.signed()?;
        while let Some(sign) = self.sign(&["*", "/", "%", "//"]) {
            value = calculated(sign, value, self.signed()?)?;
        }
        Some(value)
    }

    fn signed(&mut self) -> Option<PyValue> {
        let mut is_negative = false;
        let mut has_sign = false;
        while let Some(sign) = self.sign(&["-", "+"]) {
            is_negative ^= sign == "-";
            has_sign = true;
        }
        let value = self.operand()?;
        if !has_sign {
            return Some(value);
        }
        if let PyValue::Number(value) = value {
            return Some(PyValue::Number(if is_negative { -value } else { value }));
        }
        let whole = value.whole()?;
        Some(PyValue::Whole(if is_negative { whole.checked_neg()? } else { whole }))
    }

    fn operand(&mut self) -> Option<PyValue> {
        let token = self.peek()?;
        self.at += 1;
        let value = match token {
            PyToken::Whole(whole) => PyValue::Whole(whole),
            PyToken::Number(value) => PyValue::Number(value),
            PyToken::Sign("(") => {
                let value = self.choice()?;
                self.takes(PyToken::Sign(")")).then_some(value)?
            }
            PyToken::Word("Team") if self.takes(PyToken::Sign(".")) => match self.word()? {
                "e_Left" => PyValue::Team(Team::Left),
                "e_Right" => PyValue::Team(Team::Right),
                _ => return None,
            },
            PyToken::Word("PlayerRole") if self.takes(PyToken::Sign(".")) => {
                let role = self.word()?.strip_prefix("e_PlayerRole_")?;
                PyValue::Role(Role::from_name(role)?)
            }
            PyToken::Word(name) => match self.names.name(name)? {
                PyValue::Builder if self.takes(PyToken::Sign(".")) => self.asked()?,
                value => value,
            },
            PyToken::Text | PyToken::Sign(_) | PyToken::Odd => return None,
        };
        // What is called, looked up or raised to a power isn't read.
        let goes_on = matches!(self.peek(), Some(PyToken::Sign("(" | "[" | "." | "**")));
        (!goes_on).then_some(value)
    }

    /// What a call of the builder returns.
    fn asked(&mut self) -> Option<PyValue> {
        let value = match self.word()? {
            "EpisodeNumber" => PyValue::Whole(self.names.episode),
            "config" | "ScenarioConfig" => PyValue::Config,
            _ => return None,
        };
        let is_call = self.takes(PyToken::Sign("(")) && self.takes(PyToken::Sign(")"));
        is_call.then_some(value)
    }

    fn word(&mut self) -> Option<&'t str> {
        let Some(PyToken::Word(word)) = self.peek() else { return None };
        self.at += 1;
        Some(word)
    }
}

fn compared<T: PartialOrd>(sign: &str, one: &T, two: &T) -> bool {
    match sign {
        "==" => one == two,
        "!=" => one != two,
        "<=" => one <= two,
        ">=" => one >= two,
        "<" => one < two,
        _ => one > two,
    }
}

/// What an operator computes, as Python does: whole numbers stay whole but for `/`.
pub(super) fn calculated(sign: &str, one: PyValue, two: PyValue) -> Option<PyValue> {
    if let (Some(one), Some(two)) = (one.whole(), two.whole())
        && sign != "/"
    {
        let whole = match sign {
            "+" => one.checked_add(two)?,
            "-" => one.checked_sub(two)?,
            "*" => one.checked_mul(two)?,
            "%" => {
                let rest = one.checked_rem(two)?;
                if rest != 0 && (rest < 0) != (two < 0) { rest + two } else { rest }
            }
            _ => {
                let rest = one.checked_rem(two)?;
                let is_below = rest != 0 && (rest < 0) != (two < 0);
                one.checked_div(two)? - i64::from(is_below)
            }
        };
        return Some(PyValue::Whole(whole));
    }
    let (one, two) = (one.number()?, two.number()?);
    let value = match sign {
        "+" => one + two,
        "-" => one - two,
        "*" => one * two,
        "/" if two != 0.0 => one / two,
        _ => return None,
    };
    value.is_finite().then_some(PyValue::Number(value))
}
