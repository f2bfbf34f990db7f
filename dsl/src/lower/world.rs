//! What every program of a scenario is lowered against, and what is found on the way.

use super::interval::Interval;
use super::loaded_scripts::LoadedScripts;
use super::mirror::Mirror;
use super::param_info::ParamInfo;
use super::people::{Casting, Rostered};
use crate::ast::{Binding, Span};
use crate::parse::MAX_PROBLEMS;
use crate::problem::{Code, Problem};
use crate::resolve::{Flat, Library};
use std::cell::{Cell, RefCell};
use std::collections::{BTreeMap, BTreeSet};

/// What every program of a scenario is lowered against.
pub(crate) struct World<'w> {
    /// The files and their names.
    pub(crate) library: &'w Library,
    /// The scenario.
    pub(crate) flat: &'w Flat<'w>,
    /// Its parameters.
    pub(crate) params: Vec<ParamInfo<'w>>,
    /// Whether it is seen in a mirror.
    pub(crate) mirror: Mirror,
    /// Who plays players, whatever the text says.
    pub(crate) casting: &'w [Casting<'w>],
    /// Its players.
    pub(crate) roster: Vec<Rostered<'w>>,
    /// Whether the list of players was read without a mistake.
    pub(crate) whole_roster: bool,
    /// Scripts that are embedded so far.
    pub(crate) scripts: RefCell<Vec<setpiece_scenario::Script>>,
    /// Scripts as they were loaded.
    pub(crate) scripts_loaded: &'w LoadedScripts<'w>,
    /// What was found so far.
    pub(crate) problems: RefCell<Vec<Problem>>,
    /// Declarations that something refers to.
    pub(crate) used: RefCell<BTreeSet<Span>>,
    /// Declarations that use themselves, as was reported.
    pub(super) circular: RefCell<BTreeSet<Span>>,
    /// What may still be lowered.
    pub(crate) effort: &'w Effort,
    /// How many problems of each code were found.
    pub(super) counts: RefCell<BTreeMap<Code, usize>>,
    /// How many problems were found, also those that are not reported.
    pub(super) found: Cell<usize>,
    /// How many errors were reported.
    pub(super) errors: Cell<usize>,
    /// Whether something is tried out.
    pub(super) is_tentative: Cell<bool>,
}

/// One compilation may lower this much: expressions of every scenario of a file, each as often as
/// it is used, and the instructions that they become. The largest scenarios of the library take
/// some thousand.
pub(crate) const MAX_LOWERED: usize = 400_000;

/// What one compilation may still lower.
pub(crate) struct Effort(Cell<usize>);

impl Effort {
    /// That of a compilation that begins.
    pub(crate) fn new() -> Effort {
        Effort(Cell::new(MAX_LOWERED))
    }

    /// Takes some of it; `false` once it is spent.
    pub(crate) fn spend(&self, amount: usize) -> bool {
        self.0.set(self.0.get().saturating_sub(amount));
        !self.is_spent()
    }

    /// Whether nothing is left.
    pub(crate) fn is_spent(&self) -> bool {
        self.0.get() == 0
    }
}

impl<'w> World<'w> {
    /// Reports a problem, unless there are enough of its kind.
    pub(crate) fn report(&self, problem: Problem) {
        self.found.set(self.found.get() + 1);
        if self.is_tentative.get() {
            return;
        }
        self.errors.set(self.errors.get() + usize::from(problem.is_error()));
        let mut counts = self.counts.borrow_mut();
        let count = counts.entry(problem.code()).or_default();
        *count += 1;
        if *count <= MAX_PROBLEMS {
            self.problems.borrow_mut().push(problem);
        }
    }

    /// Whether another problem of this kind wouldn't be reported, so that its explanation can be
    /// skipped.
    pub(crate) fn is_full(&self, code: Code) -> bool {
        self.is_tentative.get()
            || self.counts.borrow().get(&code).is_some_and(|count| *count >= MAX_PROBLEMS)
    }

    /// How many problems were found so far: more of them afterwards say that what was read in
    /// between is wrong.
    pub(crate) fn found(&self) -> usize {
        self.found.get()
    }

    /// How many errors were reported so far. More of them afterwards say that no scenario comes
    /// out, and that what was read in between has no value of its own.
    pub(crate) fn errors(&self) -> usize {
        self.errors.get()
    }

    /// Runs `f` and reports no problem that it finds. The caller only tries something out that is
    /// also compiled elsewhere, where its problems are reported. Names that `f` refers to count as
    /// used.
    pub(crate) fn tentatively<T>(&self, f: impl FnOnce() -> T) -> T {
        let outer = self.is_tentative.replace(true);
        let result = f();
        self.is_tentative.set(outer);
        result
    }

    /// Notes that declarations use each other in a circle, which was reported.
    pub(super) fn note_circle(&self, circle: &[Span]) {
        if !self.is_tentative.get() {
            self.circular.borrow_mut().extend(circle);
        }
    }

    /// Whether a declaration is known to use itself.
    pub(super) fn is_circular(&self, declaration: Span) -> bool {
        self.circular.borrow().contains(&declaration)
    }

    /// Notes that a declaration is used.
    pub(crate) fn mark_used(&self, declaration: Span) {
        self.used.borrow_mut().insert(declaration);
    }

    /// Where the scenario declares a value of this name, players aside.
    pub(crate) fn declaration(&self, name: &str) -> Option<Span> {
        self.flat.declaration(name)
    }

    /// Whether the scenario has a value or player of this name.
    pub(crate) fn declares(&self, name: &str) -> bool {
        self.declaration(name).or_else(|| self.player(name)).is_some()
    }

    /// Where the scenario names a player so.
    pub(crate) fn player(&self, name: &str) -> Option<Span> {
        let named = self.roster.iter().filter_map(|player| player.name);
        named.into_iter().find(|known| known.node == name).map(|known| known.span)
    }

    /// Its record of this name.
    pub(crate) fn record(&self, name: &str) -> Option<&'w Binding> {
        self.flat.records.iter().copied().find(|known| known.name.node == name)
    }

    /// The ranges of the parameters, in order.
    pub(crate) fn ranges(&self) -> Vec<Option<Interval>> {
        self.params.iter().filter(|param| param.bound.is_none()).map(ParamInfo::interval).collect()
    }

    /// The author's text of a span, shortened to one line.
    pub(crate) fn text(&self, span: Span) -> String {
        let text = self.library.sources.text(span);
        let words: Vec<&str> = text.split_whitespace().collect();
        words.join(" ")
    }

    /// Whether a sign that compares numbers stands behind a span.
    pub(crate) fn is_compared(&self, span: Span) -> bool {
        self.text_behind(span).trim_start().starts_with(['<', '>', '=', '!'])
    }

    /// What stands behind a span in its file.
    pub(super) fn text_behind(&self, span: Span) -> &str {
        let text = self.library.sources.get(span.file).map_or("", |source| &source.text);
        text.get(span.end as usize..).unwrap_or_default()
    }

    /// An expression's text on one line, the same however the author has laid it out.
    pub(crate) fn laid_out(&self, span: Span) -> String {
        let text = self.library.sources.text(span);
        crate::format::one_line(text).unwrap_or_else(|| self.text(span))
    }
}
