//! What was expected, in the author's words.

use super::{Context, Finding, Wrong, text};
use crate::habit::{self, BRACKET_APART, Begins, HabitPiece, HabitRewrite};
use crate::parse::reader::{Reader, reserved, token};
use crate::problem::facts::{Hint, Syntax};
use crate::problem::{Guess, Problem, Rewrite, nearest};
use crate::source::Span;
use setpiece_grammar::{Rule, keyword, noun};
use setpiece_scenario::vocabulary::Role;
use std::ops::Range;

/// Words that follow a role.
pub(super) const AFTER_ROLE: &[&str] = &[
    "at", "in", "ahead", "behind", "left", "right", "between", "beyond", "offset", "absent",
    "facing", "jitter", "when", "{",
];

impl Reader<'_> {
    /// The problem of a text that stops making sense.
    pub(super) fn explain(&self, mut wrong: Wrong<'_>) -> Finding {
        if let Some(found) = self.habit(&mut wrong) {
            return found;
        }
        let first = wrong.junk.start;
        if wrong.is_lone_word() || self.unit(first).is_some_and(|_| wrong.before.is_some()) {
            wrong.at = first;
            wrong.positives.clear();
        }
        let outside = wrong.at >= wrong.junk.end;
        let word = self.word(wrong.at);
        self.unit(wrong.at)
            .or_else(|| self.unknown_event(&wrong, word))
            .map(Finding::new)
            .or_else(|| if outside { None } else { self.role_or_keyword(&wrong, word) })
            .or_else(|| self.reserved_name(&wrong, word).map(Finding::new))
            .unwrap_or_else(|| {
                let hint = wrong.named_role().unwrap_or_else(|| wrong.form());
                Finding::new(self.expected(&wrong, hint))
            })
    }

    /// A habit of another language, at the place where nothing fits or at the junk's beginning.
    fn habit(&self, wrong: &mut Wrong<'_>) -> Option<Finding> {
        let apart = |from: usize| text(self.text, 0..from).ends_with(char::is_whitespace);
        let words: Vec<&str> = wrong
            .tokens
            .iter()
            .map(|&(from, word)| match word {
                "(" if apart(from) => BRACKET_APART,
                _ => word,
            })
            .collect();
        let met = wrong.token_at();
        let (at, found) = habit::of_text(wrong.context.place(), &words, met, wrong.first)?;
        if let Some((from, word)) = wrong.tokens.get(at) {
            if at != met {
                wrong.positives.clear();
            } else if *from < wrong.at && !word.is_ascii() {
                // In the middle of a name.
                wrong.positives = vec![Rule::ident];
            }
            wrong.inside = *from < wrong.at && at == met;
            wrong.at = *from;
        }
        let starts = wrong.at == wrong.junk.start;
        let is_new = starts && found.begins == Begins::New;
        let misplaced =
            || self.misplaced(wrong.context, self.word(wrong.at), wrong.at, Some(&found.help));
        let problem = if is_new { misplaced() } else { None };
        let mut problem =
            problem.unwrap_or_else(|| self.expected(wrong, Hint::Habit(found.help.clone())));
        for rewrite in found.rewrites {
            problem = problem.with_rewrite(self.rewrite(&wrong.tokens, rewrite));
        }
        let (fresh, goes_on) = (found.begins == Begins::New, found.begins == Begins::Before);
        Some(Finding { problem, fresh, goes_on })
    }

    /// A way to follow a habit's help, in the text.
    fn rewrite(&self, tokens: &[(usize, &str)], rewrite: HabitRewrite) -> Rewrite {
        let ends = |range: Range<usize>| -> Option<Range<usize>> {
            let (from, _) = tokens.get(range.start).filter(|_| !range.is_empty())?;
            let (last, word) = tokens.get(range.end.checked_sub(1)?)?;
            Some(*from..last + word.trim_start().len())
        };
        let place = |(range, pieces): (Range<usize>, Vec<HabitPiece>)| {
            let mut bytes = ends(range)?;
            let mut written = String::new();
            for piece in pieces {
                match piece {
                    HabitPiece::Text(text) => written.push_str(&text),
                    HabitPiece::Kept(kept) => {
                        written.push_str(ends(kept).map_or("", |kept| text(self.original(), kept)));
                    }
                    HabitPiece::Rest(from) => {
                        let line = text(self.text, bytes.end..self.text.len());
                        let line = bytes.end + line.find('\n').unwrap_or(line.len());
                        let count =
                            tokens.iter().skip(from).take_while(|(at, _)| *at < line).count();
                        let rest = ends(from..from + count)?;
                        bytes.end = rest.end;
                        written.push_str(text(self.original(), rest));
                    }
                }
            }
            let mut written = written.trim_end().to_owned();
            // `!ball_dead` is `not ball_dead`.
            let is_word = |sign: char| sign.is_alphanumeric() || sign == '_';
            let behind = text(self.text, bytes.end..self.text.len());
            if written.ends_with(is_word) && behind.starts_with(is_word) {
                written.push(' ');
            }
            Some(vec![(self.between(bytes.start, bytes.end), written)])
        };
        Rewrite {
            says: rewrite.says,
            places: rewrite.places.into_iter().filter_map(place).collect(),
        }
    }

    /// That something else was expected.
    fn expected(&self, wrong: &Wrong<'_>, hint: Hint) -> Problem {
        let at = wrong.at;
        let whole = wrong.tokens.get(wrong.token_at()).filter(|(from, _)| *from == at);
        let word = whole.map_or_else(|| self.word(at), |(_, word)| *word);
        let starts = at == wrong.junk.start && !wrong.inside;
        let wanted = if starts
            && !(wrong.before.is_some() && wrong.positives.is_empty())
            && !is_name(&wrong.positives)
        {
            vec![noun(wrong.context.statement())]
        } else {
            // What could stand behind any statement is no news.
            let any = |rule: &&Rule| {
                starts && (**rule == Rule::comma || **rule == wrong.context.statement())
            };
            let wanted: Vec<Rule> =
                wrong.positives.iter().filter(|rule| !any(rule)).copied().collect();
            nouns(wrong.context, &wanted)
        };
        if let Some((from, last)) = wrong.tokens.last()
            && at >= wrong.junk.end
            && (word.is_empty() || text(self.text, *from..at).contains('\n'))
        {
            let fact = Syntax::Unfinished { wanted, last: (*last).to_owned(), hint };
            return Problem::new(self.between(*from, from + last.len()), fact);
        }
        let fact = Syntax::Expected { wanted, found: word.to_owned(), begins: starts, hint };
        Problem::new(self.between(at, at + word.len()), fact)
    }

    /// The word or sign at an offset.
    fn word(&self, at: usize) -> &str {
        token(text(self.text, at..self.text.len()))
    }

    /// Misspelt and misplaced keywords, and unknown roles.
    fn role_or_keyword(&self, wrong: &Wrong<'_>, word: &str) -> Option<Finding> {
        let Wrong { context, junk, at, positives, .. } = wrong;
        let (context, at, before) = (*context, *at, wrong.before.as_ref());
        if !word.starts_with(|char: char| char.is_alphabetic() || char == '_') {
            return self.unknown_role_of_field(context, before, word).map(Finding::new);
        }
        let fresh = |problem| Finding { fresh: true, ..Finding::new(problem) };
        let behind = self.word(self.next_token(at + word.len()));
        let starts = at == junk.start;
        let ahead = text(self.text, junk.start..at).trim_end();
        let counted = !ahead.is_empty() && ahead.bytes().all(|byte| byte.is_ascii_digit());
        let continuing = positives.iter().filter_map(|rule| keyword(*rule));
        if context == Context::Team && (starts || counted) {
            if let Some(problem) = self.unknown_role_of_field(context, before, word) {
                return Some(Finding::new(problem));
            }
            let like_role = word.len() <= 4 && word.bytes().all(|byte| byte.is_ascii_uppercase());
            let followed = AFTER_ROLE.contains(&behind) && Role::from_name(word).is_none();
            let keyword =
                nearest(word, context.keywords().iter().copied().chain(AFTER_ROLE.iter().copied()));
            let is_misplaced = starts && self.misplaced(context, word, at, None).is_some();
            if like_role || counted || (followed && keyword.is_none() && !is_misplaced) {
                return Some(fresh(Self::unknown_role(word, self.at(at))));
            }
        }
        if starts {
            if let Some(problem) = self.misplaced(context, word, at, None) {
                return Some(fresh(problem));
            }
            let further = if before.is_some() { context.further() } else { &[] };
            let all = context.keywords().iter().chain(further).copied();
            let all = all.chain(continuing.filter(|_| before.is_some()));
            let meant = nearest(word, all).filter(|meant| *meant != word)?;
            let problem = self.misspelt(vec![noun(context.statement())], word, at, meant);
            return Some(Finding {
                fresh: context.keywords().contains(&meant),
                ..Finding::new(problem)
            });
        }
        let meant = nearest(word, continuing).filter(|meant| *meant != word)?;
        Some(Finding::new(self.misspelt(nouns(context, positives), word, at, meant)))
    }

    fn misspelt(
        &self,
        wanted: Vec<&'static str>,
        word: &str,
        at: usize,
        meant: &'static str,
    ) -> Problem {
        Problem::new(self.at(at), Syntax::Misspelt { wanted, word: word.to_owned(), meant })
    }

    fn unknown_role(word: &str, span: Span) -> Problem {
        let roles: Vec<&str> = Role::ALL.iter().map(|role| role.name()).collect();
        Problem::new(
            span,
            Syntax::UnknownRole { word: word.to_owned(), guess: Guess::or_all(word, &roles) },
        )
    }

    /// `striker: CFF at …` reads as an option `striker` and goes wrong at `at`.
    fn unknown_role_of_field(
        &self,
        context: Context,
        before: Option<&Range<usize>>,
        word: &str,
    ) -> Option<Problem> {
        if context != Context::Team || !AFTER_ROLE.contains(&word) {
            return None;
        }
        let text = self.text.get(before?.clone())?;
        let (_, value) = text.split_once(':')?;
        let value = value.trim();
        if token(value) != value
            || Role::from_name(value).is_some()
            || !value.starts_with(|char: char| char.is_alphabetic())
        {
            return None;
        }
        let end = before?.end;
        Some(Self::unknown_role(value, self.between(end - value.len(), end)))
    }

    /// A reserved word or role where a name is wanted.
    fn reserved_name(&self, wrong: &Wrong<'_>, word: &str) -> Option<Problem> {
        // Where a label may stand, so may `when`.
        let name = is_name(&wrong.positives) && !wrong.positives.contains(&Rule::kw_when);
        let role = Role::from_name(word).is_some();
        (name && (role || is_reserved(word)))
            .then(|| reserved(word, self.at(wrong.at), if role { "roles" } else { "the language" }))
    }
}

impl Wrong<'_> {
    /// How the statement under way is written.
    fn form(&self) -> Hint {
        let word = |index: usize| self.tokens.get(index).map_or("", |(_, word)| *word);
        let form = match (self.positives.as_slice(), word(0), word(1)) {
            (wanted, ..) if wanted.contains(&Rule::kw_else) || wanted == [Rule::kw_then] => {
                Some("if c then a else b")
            }
            (_, "end", "limit") => Some("end limit 400 steps"),
            (_, first, _) => self.context.form(first),
        };
        form.map_or(Hint::None, Hint::Form)
    }

    /// A word right before a role: the player's name, or their number by a parameter.
    fn named_role(&self) -> Option<Hint> {
        let at = self.token_at();
        let (_, role) = self.tokens.get(at).filter(|(_, word)| Role::from_name(word).is_some())?;
        let is_first = self.context == Context::Team && at == self.first + 1;
        let (_, name) = self.tokens.get(self.first).filter(|_| is_first)?;
        Some(Hint::Habit(format!(
            "a name stands before a colon: `{name}: {role} …`; how many is a number of digits, as in `2 {role}`"
        )))
    }

    /// A lone word could always have been an option's key or a state: the word is the news, not the
    /// missing sign.
    fn is_lone_word(&self) -> bool {
        let Some((from, first)) = self.tokens.get(self.first) else { return false };
        let next = self.tokens.get(self.first + 1).map_or(usize::MAX, |(next, _)| *next);
        if *from != self.junk.start || self.at == *from || self.at > next {
            return false;
        }
        let elsewhere =
            |word: &str| Context::ALL.iter().any(|other| other.keywords().contains(&word));
        let keywords = self.context.keywords();
        match self.context {
            Context::Fields => false,
            Context::Reward | Context::Behavior if self.positives == [Rule::equals] => {
                let further = if self.before.is_some() { self.context.further() } else { &[] };
                let near = nearest(first, keywords.iter().chain(further).copied());
                near.is_some() || elsewhere(first) || self.first > 0
            }
            _ => {
                // `striker CF at …` lacks its colon.
                let role = self
                    .tokens
                    .get(self.first + 1)
                    .is_some_and(|(_, next)| Role::from_name(next).is_some());
                let named = role && nearest(first, keywords.iter().copied()).is_none();
                self.positives == [Rule::colon] && !named && !keywords.contains(first)
            }
        }
    }
}

/// Whether a name may stand here.
fn is_name(positives: &[Rule]) -> bool {
    positives.iter().any(|rule| matches!(rule, Rule::ident | Rule::free_name | Rule::path))
}

/// Whether a word is reserved everywhere.
pub(super) fn is_reserved(word: &str) -> bool {
    use pest::Parser;
    setpiece_grammar::PitchParser::parse(Rule::reserved, word)
        .is_ok_and(|mut pairs| pairs.as_str().len() == word.len() && pairs.next().is_some())
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

/// What was expected, each noun once.
fn nouns(context: Context, positives: &[Rule]) -> Vec<&'static str> {
    let mut nouns: Vec<&str> = Vec::new();
    for rule in positives.iter().filter(|rule| !goes_on(**rule)) {
        if !nouns.contains(&noun(*rule)) {
            nouns.push(noun(*rule));
        }
    }
    if nouns.is_empty() {
        nouns.push(noun(if let [only] = positives { *only } else { context.statement() }));
    }
    nouns
}
