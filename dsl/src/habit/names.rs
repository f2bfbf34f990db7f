//! The table of habits in names that nothing has, one row each.

use super::row::HabitPlace::Name;
use super::row::{Habit, row};

/// Every habit of a name.
pub(super) const NAMES: &[Habit] = &[
    row(Name, "True¦TRUE¦yes¦Yes", "write `true`, or `on`"),
    row(Name, "False¦FALSE¦no¦No", "write `false`, or `off`"),
    row(Name, "None¦null¦nil¦NULL¦undefined", "write `nobody` for no player, `none` for no team"),
    row(Name, "self¦this", "write `me`"),
    row(Name, "idle", "an action is known by what holds it: `state a: action = idle`"),
    row(Name, "s2", "m/s² is written as a number: `9.81`"),
    row(Name, "e_PlayerRole_*", "write `{1}`"),
    row(Name, "e_Left¦Team_Left", "write `left`"),
    row(Name, "e_Right¦Team_Right", "write `right`"),
    row(Name, "box¦six_yard¦half¦third¦penalty_spot¦byline", "it belongs to a team: `left.{1}`"),
    row(Name, "center", "write `centre`"),
    row(Name, "penalty_area¦penalty_box¦eighteen_yard_box", "write `box`, as in `right.box`"),
    row(Name, "goal_area¦six_yard_box", "write `six_yard`, as in `right.six_yard`"),
    row(Name, "home¦away", "the teams are `left` and `right`; a reward has `us` and `them`"),
    row(
        Name,
        "opponent¦opponents¦enemy¦enemies",
        "write `them` in a reward, `left` or `right` elsewhere",
    ),
    row(Name, "all¦everyone¦everybody¦anyone", "sets of players are `us`, `them` and `players`"),
    row(Name, "teammates¦team_mates", "write `mates`, or `us` for `me`, too"),
    row(
        Name,
        "seen¦visible",
        "an angle of view is a condition: `… when sees(me, ball, within: 120deg)`",
    ),
    row(
        Name,
        "keeper¦goalkeeper¦goalie",
        "the role is `GK`; a player's own name stands before it: `{1}: GK at …`",
    ),
    row(Name, "scorer", "who scores is `event.by` after `on goal`; `give 1 to goal` pays them"),
    row(
        Name,
        "passer¦assister",
        "who passes is `event.by` after `on pass`; `give 1 to assist` pays who has prepared a goal",
    ),
    row(Name, "end", "`end` is an event only after `on`: `give 1 on end`"),
];

/// Types of other languages, and ours.
pub(super) const TYPES: &[(&[&str], &str)] = &[
    (&["float", "double", "real", "num", "f32", "f64"], "number"),
    (&["integer", "i32", "uint", "count"], "int"),
    (&["boolean", "flag", "switch"], "bool"),
    (&["probability", "share", "chance", "ratio"], "percent"),
    (&["distance", "metre", "metres", "meter", "meters"], "length"),
    (&["time", "seconds", "steps", "step", "second"], "duration"),
    (&["velocity", "pace"], "speed"),
    (&["degrees", "radians", "direction"], "angle"),
    (&["position", "place", "location", "coordinate"], "point"),
    (&["area", "zone"], "region"),
    (&["str", "text"], "string"),
    (&["players", "list", "array"], "set"),
];
