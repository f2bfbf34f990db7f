//! What was expected, in the author's words.

use super::Context;
use crate::parse::reader::{Reader, reserved, token};
use crate::problem::{Code, Problem, nearest};
use crate::source::Span;
use setpiece_grammar::{Rule, keyword, noun};
use setpiece_scenario::vocabulary::{Role, Unit};
use std::ops::Range;

/// Words that follow a role.
pub(super) const AFTER_ROLE: &[&str] = &[
    "at", "in", "ahead", "behind", "left", "right", "between", "beyond", "offset", "absent", "facing", "jitter",
    "when", "{",
];

impl Reader<'_> {
    /// The problem of a text that stops making sense at `at`.
    pub(super) fn expectation(
        &self,
        context: Context,
        junk: &Range<usize>,
        before: Option<&Range<usize>>,
        at: usize,
        positives: &[Rule],
    ) -> Problem {
        let at = self.next_token(at);
        let word = token(self.text.get(at..).unwrap_or_default());
        let outside = at >= junk.end;
        let special = self
            .unit(at)
            .or_else(|| if outside { None } else { self.role_or_keyword(context, junk, before, at, word, positives) })
            .or_else(|| self.reserved_name(at, word, positives));
        if let Some(problem) = special {
            return problem;
        }
        let starts = at == junk.start;
        let wanted = if starts && !(before.is_some() && positives.is_empty()) {
            noun(context.statement()).to_owned()
        } else {
            list(context, positives)
        };
        let found = if word.is_empty() { "the end of the file".to_owned() } else { format!("`{word}`") };
        let label = if starts { "no statement begins like this" } else { "this can't stand here" };
        let problem = Problem::new(Code::Syntax, self.at(at), format!("expected {wanted}, found {found}"), label);
        let (done, rest) = self.text.split_at_checked(at).unwrap_or_default();
        hint(problem, word, done, rest)
    }

    /// The offset of the next token behind blanks and comments.
    fn next_token(&self, mut at: usize) -> usize {
        loop {
            let rest = self.text.get(at..).unwrap_or_default();
            let blank = rest.len() - rest.trim_start_matches([' ', '\t', '\r', '\n', ';', '\u{FEFF}', '\u{A0}']).len();
            at += blank;
            match self.comment_at(at) {
                Some(end) => at = end,
                None => return at,
            }
        }
    }

    /// `5mm`, and `5 m`: a number whose unit is not one or does not touch it.
    fn unit(&self, at: usize) -> Option<Problem> {
        let text = self.text;
        let before = text.get(..at)?;
        let word = token(text.get(at..)?);
        if !word.starts_with(|char: char| char.is_alphabetic()) {
            return None;
        }
        let line = before.get(before.rfind('\n').map_or(0, |newline| newline + 1)..)?;
        let digits = line.trim_end_matches([' ', '\t']);
        let number_len =
            digits.len() - digits.trim_end_matches(|char: char| char.is_ascii_digit() || char == '.').len();
        let number = digits.get(digits.len() - number_len..)?;
        let part_of_name =
            digits.get(..digits.len() - number_len)?.ends_with(|char: char| char.is_alphanumeric() || char == '_');
        if !number.ends_with(|char: char| char.is_ascii_digit()) || part_of_name {
            return None;
        }
        let touches = digits.len() == line.len();
        if touches {
            let start = at - number.len();
            let word = if word == "km" && text.get(at..)?.starts_with("km/") { "km/" } else { word };
            let span = self.between(start, at + word.len());
            let units = Unit::ALL.iter().map(|unit| unit.name());
            let known: Vec<_> = units.clone().map(|unit| format!("`{unit}`")).collect();
            let problem = Problem::new(Code::Syntax, span, format!("unknown unit `{word}`"), "no unit has this name");
            return Some(match nearest(word, units).filter(|_| meant(word).is_none()) {
                Some(unit) => problem.help(format!("did you mean `{number}{}{unit}`?", blank_before(unit))),
                None if meant(word).is_some() => {
                    problem.help(format!("did you mean `{number}{}`?", meant(word).unwrap_or_default()))
                }
                None => problem.help(format!("the units are {}", known.join(", "))),
            });
        }
        let Some(unit) = Unit::from_name(word) else {
            let counted =
                nearest(word.trim_end_matches(|char: char| char.is_ascii_digit()), ["step", "steps", "episodes"]);
            let counted = counted.filter(|_| word.len() >= 4)?;
            let message = format!("unknown unit `{word}`");
            let help = format!("did you mean `{number} {}`?", if counted == "step" { "steps" } else { counted });
            return Some(Problem::new(Code::Syntax, self.at(at), message, "no unit has this name").help(help));
        };
        let gap = line.len() - digits.len();
        let span = self.between(at - gap - number.len(), at + word.len());
        Some(
            Problem::new(
                Code::Syntax,
                span,
                format!("the unit `{}` must touch its number", unit.name()),
                "a blank between them",
            )
            .help(format!("write `{number}{}`", unit.name())),
        )
    }

    /// Misspelt and misplaced keywords, and unknown roles.
    fn role_or_keyword(
        &self,
        context: Context,
        junk: &Range<usize>,
        before: Option<&Range<usize>>,
        at: usize,
        word: &str,
        positives: &[Rule],
    ) -> Option<Problem> {
        if !word.starts_with(|char: char| char.is_alphabetic() || char == '_') {
            return self.unknown_role_of_field(context, before, word);
        }
        let behind = token(self.text.get(self.next_token(at + word.len())..).unwrap_or_default());
        let starts = at == junk.start;
        let ahead = self.text.get(junk.start..at).unwrap_or_default().trim_end();
        let counted = !ahead.is_empty() && ahead.bytes().all(|byte| byte.is_ascii_digit());
        let continuing = positives.iter().filter_map(|rule| keyword(*rule));
        if context == Context::Team && (starts || counted) {
            if let Some(problem) = self.unknown_role_of_field(context, before, word) {
                return Some(problem);
            }
            let like_role = word.len() <= 4 && word.bytes().all(|byte| byte.is_ascii_uppercase());
            let followed = AFTER_ROLE.contains(&behind) && Role::from_name(word).is_none();
            let keyword = nearest(word, context.keywords().iter().copied().chain(AFTER_ROLE.iter().copied()));
            if like_role || counted || (followed && keyword.is_none()) {
                return Some(Self::unknown_role(word, self.at(at)));
            }
        }
        if starts {
            if let Some(problem) = self.misplaced(context, word, at) {
                return Some(problem);
            }
            let further = if before.is_some() { context.further() } else { &[] };
            let all = context.keywords().iter().chain(further).copied();
            let all = all.chain(continuing.filter(|_| before.is_some()));
            let meant = nearest(word, all).filter(|meant| *meant != word)?;
            return Some(self.misspelt(noun(context.statement()), word, at, meant));
        }
        let meant = nearest(word, continuing).filter(|meant| *meant != word)?;
        Some(self.misspelt(&list(context, positives), word, at, meant))
    }

    fn misspelt(&self, wanted: &str, word: &str, at: usize, meant: &str) -> Problem {
        let message = format!("expected {wanted}, found `{word}`");
        Problem::new(Code::Syntax, self.at(at), message, "no such word here").help(format!("did you mean `{meant}`?"))
    }

    fn unknown_role(word: &str, span: Span) -> Problem {
        let roles = Role::ALL.iter().map(|role| role.name());
        let problem = Problem::new(Code::UnknownRole, span, format!("unknown role `{word}`"), "no role has this name");
        match nearest(word, roles.clone()) {
            Some(role) => problem.help(format!("did you mean `{role}`?")),
            None => problem.help(format!("the roles are {}", roles.collect::<Vec<_>>().join(", "))),
        }
    }

    /// `striker: CFF at …` reads as an option `striker` and goes wrong at `at`.
    fn unknown_role_of_field(&self, context: Context, before: Option<&Range<usize>>, word: &str) -> Option<Problem> {
        if context != Context::Team || !AFTER_ROLE.contains(&word) {
            return None;
        }
        let text = self.text.get(before?.clone())?;
        let (_, value) = text.split_once(':')?;
        let value = value.trim();
        if token(value) != value || !value.starts_with(|char: char| char.is_alphabetic()) {
            return None;
        }
        let end = before?.end;
        Some(Self::unknown_role(value, self.between(end - value.len(), end)))
    }

    /// A reserved word or role where a name is wanted.
    fn reserved_name(&self, at: usize, word: &str, positives: &[Rule]) -> Option<Problem> {
        let name = positives.iter().any(|rule| matches!(rule, Rule::ident | Rule::free_name));
        let role = Role::from_name(word).is_some();
        (name && (role || is_reserved(word)))
            .then(|| reserved(word, self.at(at), if role { "roles" } else { "the language" }))
    }
}

/// The unit behind another language's name for it.
fn meant(word: &str) -> Option<&'static str> {
    Some(match word {
        "degree" | "degrees" => "deg",
        "radian" | "radians" => "rad",
        "sec" | "secs" | "second" | "seconds" => "s",
        "msec" | "millis" => "ms",
        "meter" | "meters" | "metre" | "metres" => "m",
        "kmh" | "kph" => "km/h",
        "mps" => "m/s",
        "percent" => "%",
        _ => return None,
    })
}

/// Whether a word is reserved everywhere.
fn is_reserved(word: &str) -> bool {
    use pest::Parser;
    setpiece_grammar::PitchParser::parse(Rule::reserved, word)
        .is_ok_and(|mut pairs| pairs.as_str().len() == word.len() && pairs.next().is_some())
}

/// `steps` and `episodes` stand apart from their number.
fn blank_before(unit: &str) -> &'static str {
    if unit.len() > 4 { " " } else { "" }
}

/// Rules that only go on with what is complete already.
fn goes_on(rule: Rule) -> bool {
    use Rule as R;
    matches!(
        rule,
        R::EOI
            | R::sign
            | R::add_op
            | R::mul_op
            | R::set_op
            | R::cmp_op
            | R::dot
            | R::kw_and
            | R::kw_or
            | R::kw_not
            | R::kw_in
            | R::kw_has
            | R::kw_changes
            | R::doc
            | R::unit
            | R::long_unit
            | R::over_kind
            | R::kw_own
            | R::star
    )
}

/// At most four of what was expected: "a point, `,` or `)`".
fn list(context: Context, positives: &[Rule]) -> String {
    let mut nouns: Vec<&str> = Vec::new();
    let wanted = positives.iter().filter(|rule| !goes_on(**rule));
    for rule in wanted {
        if !nouns.contains(&noun(*rule)) {
            nouns.push(noun(*rule));
        }
    }
    match nouns.as_slice() {
        [] => return noun(context.statement()).to_owned(),
        [only] => return (*only).to_owned(),
        _ => {}
    }
    // Things before words before brackets; examples only when there is room.
    nouns.sort_by_key(|noun| noun.starts_with('`'));
    nouns.truncate(4);
    let plain: Vec<&str> = nouns.iter().map(|noun| noun.split(", for example").next().unwrap_or(noun)).collect();
    match plain.split_last() {
        Some((last, rest)) => format!("{} or {last}", rest.join(", ")),
        None => String::new(),
    }
}

/// Help for habits of other languages.
fn hint(problem: Problem, word: &str, done: &str, rest: &str) -> Problem {
    let help = match word {
        // One of them joins regions.
        "&" if done.ends_with('&') => "write `and`",
        "|" if done.ends_with('|') => "write `or`",
        "&&" => "write `and`",
        "||" => "write `or`",
        "!" => "write `not`",
        "=" if rest.starts_with("= ") || rest.starts_with('=') => "to compare two values write `==`",
        "." if rest[1..].starts_with(|char: char| char.is_ascii_digit()) => "write the 0 before the point: `0.5`",
        "%" => "`%` is a unit; for the remainder write `mod(a, b)`",
        "///" => "a `///` comment stands above a statement; write `//` elsewhere",
        "'" => "words stand between double quotes: `\"…\"`",
        _ => return problem,
    };
    problem.help(help)
}
