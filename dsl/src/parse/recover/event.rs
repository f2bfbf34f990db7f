//! Events and words over time that are misspelt.

use super::Wrong;
use crate::parse::reader::Reader;
use crate::problem::facts::{Kind, Names, ROUND, Syntax};
use crate::problem::{Guess, Problem, nearest};
use crate::source::Span;
use setpiece_grammar::Rule;
use setpiece_scenario::vocabulary::{
    Action, EventKind, Owner, PROPERTIES, Property, Qualifier, Type,
};

/// Words before `of` that look at a whole episode.
const OVER_TIME: &[&str] = &["count", "max", "min", "mean", "sum", "first", "last", "series"];

impl Reader<'_> {
    /// `on gaol by us`, `when gaol by us`, `coutn of goal`.
    pub(super) fn unknown_event(&self, wrong: &Wrong<'_>, word: &str) -> Option<Problem> {
        let at = wrong.token_at();
        let event = |rule: &Rule| matches!(rule, Rule::event | Rule::events | Rule::event_name);
        if wrong.positives.iter().any(event) && is_name(word) {
            if wrong.tokens.get(at + 1).is_some_and(|(_, next)| *next == "changes") {
                let when = match word {
                    ROUND => "when round_elapsed == 1 step".to_owned(),
                    _ => format!("when {word} changes"),
                };
                let fact = Syntax::ChangeNoEvent { name: word.to_owned(), when: when.clone() };
                let problem = Problem::new(self.at(wrong.at), fact);
                return Some(self.behind_on(problem, wrong, Condition { count: 2, when }));
            }
            let behind = wrong.tokens.get(at + 1..).unwrap_or_default();
            let (problem, condition) = no_event(word, behind, self.at(wrong.at));
            return Some(match condition {
                Some(condition) => self.behind_on(problem, wrong, condition),
                None => problem,
            });
        }
        let may_be = |name: &str| is_name(name) && !wrong.context.keywords().contains(&name);
        let (from, name) = wrong.tokens.get(at.checked_sub(1)?).filter(|(_, name)| may_be(name))?;
        let span = self.between(*from, from + name.len());
        if matches!(word, "by" | "to" | "from") || Qualifier::from_name(word).is_some() {
            nearest(name, names()).filter(|meant| meant != name)?;
            return Some(no_event(name, &[], span).0);
        }
        let meant = nearest(name, OVER_TIME.iter().copied())
            .filter(|meant| meant != name && word == "of")?;
        Some(Problem::new(span, Syntax::MisspeltOverTime { word: (*name).to_owned(), meant }))
    }

    /// A problem of words behind `on` that are a condition.
    fn behind_on(&self, problem: Problem, wrong: &Wrong<'_>, condition: Condition) -> Problem {
        let Condition { count, when } = condition;
        let at = wrong.token_at();
        let token = |at: usize| wrong.tokens.get(at).copied();
        let on = at.checked_sub(1).and_then(token).filter(|(_, word)| *word == "on");
        match (on, token(at + count - 1)) {
            (Some((from, _)), Some((last, word))) => {
                problem.rewriting(self.between(from, last + word.len()), when)
            }
            _ => problem,
        }
    }
}

/// What words behind `on` are, if they are no event.
struct Condition {
    /// How many tokens they are.
    count: usize,
    /// What stands for them and the `on`.
    when: String,
}

fn is_name(word: &str) -> bool {
    word.starts_with(|char: char| char.is_alphabetic() || char == '_')
        && !super::expect::is_reserved(word)
}

fn names() -> impl Iterator<Item = &'static str> {
    EventKind::ALL.iter().map(|kind| kind.name())
}

/// What is said of a word where an event is wanted, and the condition that it is, if it is one.
///
/// - `behind`: the tokens that follow it.
fn no_event(name: &str, behind: &[(usize, &str)], span: Span) -> (Problem, Option<Condition>) {
    let word = |at: usize| behind.get(at).map(|(_, word)| *word);
    // Who does it is in the condition.
    let count = |words: usize| words + if word(words - 1) == Some("by") { 2 } else { 0 };
    let state = |name: &str| {
        PROPERTIES.iter().any(|p| p.owner == Owner::Match && p.ty == Type::Bool && p.name == name)
    };
    if state(name) {
        let (count, when) = (count(1), format!("when {name}"));
        let fact = Syntax::StateNoEvent { name: name.to_owned(), when: when.clone() };
        return (Problem::new(span, fact), Some(Condition { count, when }));
    }
    let lasts = |p: &&Property| matches!(p.ty, Type::Bool | Type::Action);
    let mut of_player = PROPERTIES.iter().filter(|p| p.owner == Owner::Player).filter(lasts);
    if let Some(property) = of_player.find(|p| p.name == name) {
        let action = word(0).and_then(Action::from_name);
        let doer = (0..behind.len()).find(|at| word(*at) == Some("by")).and_then(|at| word(at + 1));
        let doer = doer.filter(|word| is_name(word)).unwrap_or("me");
        let (words, when) = if property.ty == Type::Action {
            let asked = action.unwrap_or(Action::Shot);
            (1 + usize::from(action.is_some()), format!("when {doer}.{name} == {asked}"))
        } else {
            (1, format!("when {doer}.{name}"))
        };
        let fact = Syntax::PropertyNoEvent { name: name.to_owned(), when: when.clone() };
        return (Problem::new(span, fact), Some(Condition { count: count(words), when }));
    }
    // `goal_by_us`
    let by = name
        .split_once("_by_")
        .filter(|(event, who)| EventKind::from_name(event).is_some() && !who.is_empty());
    let guess = match by {
        Some((event, who)) => Guess::sure(format!("{event} by {who}")),
        None => Guess::or_all(name, &names().collect::<Vec<_>>()),
    };
    (Problem::new(span, Names::Unknown { kind: Kind::Event, name: name.to_owned(), guess }), None)
}
