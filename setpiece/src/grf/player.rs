//! The players of a script: where they stand, and how a text has them.

use super::recorded::{GrfPlayer, GrfScenario};
use crate::scenario::pitch::{HALF_LENGTH_M, X_SCALE_M, Y_SCALE_M};
use crate::scenario::vocabulary::{Role, Team};
use std::collections::BTreeSet;

/// Metres per unit of a player's x and y in a script: wider than the ball's and observations'.
const PLACED_M: [f64; 2] = [HALF_LENGTH_M, 84.96];
/// Metres below which two constant places overlap.
const OVERLAP_M: f64 = 0.3;

/// A player's place as observations show it, rounded to half a centimetre.
pub(super) fn observed(player: &GrfPlayer) -> [f64; 2] {
    let [x, y] = player.place;
    [rounded(x * PLACED_M[0] / X_SCALE_M), rounded(y * PLACED_M[1] / Y_SCALE_M)]
}

/// A number to four digits behind the point; of two equally near ones the even.
fn rounded(value: f64) -> f64 {
    format!("{value:.4}").parse().unwrap_or(value)
}

/// A player's place in metres, in the world's frame.
pub(super) fn metres(player: &GrfPlayer, team: Team) -> [f64; 2] {
    let [x, y] = player.place;
    [team.side() * x * PLACED_M[0], team.side() * y * PLACED_M[1]]
}

/// The players of a team who stand on somebody else's spot, by their index.
pub(super) fn crowded(recorded: &GrfScenario, team: Team) -> BTreeSet<usize> {
    let own: Vec<[f64; 2]> = recorded.team(team).iter().map(|it| metres(it, team)).collect();
    let other = team.other();
    let others = recorded.team(other).iter().map(|it| metres(it, other));
    let everybody: Vec<[f64; 2]> = own.iter().copied().chain(others).collect();
    let is_shared = |place: &[f64; 2]| {
        let near = |spot: &&[f64; 2]| (place[0] - spot[0]).hypot(place[1] - spot[1]) < OVERLAP_M;
        everybody.iter().filter(near).count() > 1
    };
    (0..own.len()).filter(|number| own.get(*number).is_some_and(is_shared)).collect()
}

/// A number as the language writes it.
pub(super) fn number(value: f64) -> String {
    format!("{}", value + 0.0)
}

/// One number, or two that take turns in even and odd episodes.
pub(super) fn either(even: f64, odd: f64) -> String {
    if even == odd { number(even) } else { format!("alternate({}, {})", number(even), number(odd)) }
}

/// The options behind a player's place.
pub(super) fn options(player: &GrfPlayer, is_crowded: bool) -> String {
    let mut options = Vec::new();
    if player.lazy {
        options.push("ai: lazy");
    }
    if !player.controllable {
        options.push("controllable: off");
    }
    if is_crowded {
        options.push("overlap: allowed");
    }
    if options.is_empty() { String::new() } else { format!(" {{ {} }}", options.join(", ")) }
}

/// What two players must share so that one can stand in the other's place.
pub(super) fn shape(player: &GrfPlayer) -> (Role, bool, bool) {
    (player.role, player.lazy, player.controllable)
}
