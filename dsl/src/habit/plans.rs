//! The table of habits in suites, checks and curricula, one row each.

use super::row::HabitPlace::{Check, Curriculum, File, Suite};
use super::row::{Habit, row};

/// Every habit of a plan.
pub(super) const PLANS: &[Habit] = &[
    row(File, "check | _", "what a check expects stands in quotes: `check \"{1}\"`"),
    row(
        File,
        "check \"\" | of¦on¦for¦with :? _",
        "what is played stands in its block: `play {3} for 50 episodes`",
    ),
    row(Check, "play … | with _", "who plays stands before `for`: `play … with {1} for …`"),
    row(
        Check,
        "^ | scenario¦SCENARIO¦Scenario¦level¦task¦env¦on¦run :? _",
        "write `play {2} for 50 episodes`",
    ),
    row(
        Check,
        "^ | agent¦policy¦player¦ai¦by¦with :? _",
        "who plays stands behind the scenario: `play … with {2} for …`",
    ),
    row(
        Check,
        "^ | episodes¦runs¦n¦for¦count :? 9",
        "how many stands behind the scenario: `play … for {2} episodes`",
    ),
    row(Check, "^ | 9 episodes", "how many stands behind the scenario: `play … for {1} episodes`"),
    row(Check, "^ | seed¦seeds :? 9", "it stands behind the number of episodes: `play … seed {2}`"),
    row(Check, "^ | assert¦require¦ensure¦expects¦should :?", "write `expect …`"),
    row(Check, "^ | success_rate¦rate¦mean¦min¦max¦quantile¦never", "write `expect {1} …`"),
    row(
        Check,
        "expect _ | =",
        "what is expected is at least or at most: `expect {1} >= …`, `expect {1} <= …`",
    ),
    row(Suite, "^ | for _ in", "write `each {1} in …`"),
    row(
        Suite,
        "^ | play¦run¦scenario¦SCENARIO¦Scenario¦level¦task :? _",
        "write `{2} for 100 episodes`",
    ),
    row(
        Curriculum,
        "^ | play¦run¦scenario¦SCENARIO¦Scenario¦level¦task :? _",
        "write `stage first = {2}`",
    ),
    row(Curriculum, "stage _ | :¦{¦of¦is _", "write `stage {1} = {3}`"),
    row(Curriculum, "stage _ = … | when¦if¦while", "what ends a stage stands behind `until`"),
    row(
        Curriculum,
        "until … | for 9 episodes",
        "how many episodes are measured stands behind `last`: `success_rate(last: {1})`",
    ),
    row(Curriculum, "until … | and", "a stage ends when one of its goals holds: write `or`"),
];
