//! What a row of the tables of habits is.

/// Where a habit is met.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum HabitPlace {
    /// A name that nothing has.
    Name,
    /// Text that can't be read, in any list of statements.
    Anywhere,
    /// The same, outside of everything.
    File,
    /// In a scenario.
    Scenario,
    /// In a team or formation.
    Team,
    /// In a reward.
    Reward,
    /// In a behaviour.
    Behavior,
    /// In a suite.
    Suite,
    /// In a check.
    Check,
    /// In a curriculum.
    Curriculum,
    /// Among options.
    Fields,
}

/// A row of the table.
pub(super) struct Habit {
    pub(super) place: HabitPlace,
    /// The tokens; `|` stands before the one that can't be read, `^ |` where the unreadable text
    /// begins.
    ///
    /// `_` is a name, `""` a string, `9` a number, `±9` one with or without a minus, `9a` a number
    /// with letters, `é` a word of other letters, `ROLE` a role, `EVENT` an event, `␣(` a bracket
    /// behind a blank, `a¦b` one of two, `a*` what begins with `a`, `a?` what may stand there, `*`
    /// any token and `\*` that sign, `…` any number of them, `$` the end.
    pub(super) seen: &'static str,
    /// What to write; `{1}` is the first that was not spelt out in `seen`.
    pub(super) write: &'static str,
}

/// A row.
pub(super) const fn row(place: HabitPlace, seen: &'static str, write: &'static str) -> Habit {
    Habit { place, seen, write }
}
