//! A layout that begins with a kick-off, which a text can repeat after a goal.

use super::player::{crowded, metres, number, observed, options, shape};
use super::recorded::{GrfPlayer, GrfScenario};
use crate::scenario::vocabulary::Team;
use std::collections::BTreeSet;

/// A kick-off with a player within this many metres of the ball leaves everybody in place.
const AT_THE_BALL_M: f64 = 2.0;

/// A kick-off by one team or by both alternately, with the layouts of both parts.
pub(super) struct GrfKickoff<'r> {
    /// Who kicks off in even and in odd episodes.
    by: [Team; 2],
    kicking: &'r [GrfPlayer],
    receiving: &'r [GrfPlayer],
    crowded: BTreeSet<usize>,
}

impl GrfKickoff<'_> {
    /// The kick-off of two layouts; none if they aren't one. The layouts must have one shape.
    pub(super) fn of<'r>(even: &'r GrfScenario, odd: &GrfScenario) -> Option<GrfKickoff<'r>> {
        let by = [kicker(even)?, kicker(odd)?];
        if even.end_episode_on_out_of_play {
            return None;
        }
        let (kicking, receiving) = (even.team(by[0]), even.team(by[0].other()));
        let is_alike = kicking.iter().map(shape).eq(receiving.iter().map(shape))
            && odd.team(by[1]) == kicking
            && odd.team(by[1].other()) == receiving;
        let crowded = || &crowded(even, Team::Left) | &crowded(even, Team::Right);
        is_alike.then(|| GrfKickoff { by, kicking, receiving, crowded: crowded() })
    }

    /// The statement of the scenario; `stem` begins the formations' names.
    pub(super) fn statement(&self, stem: &str) -> String {
        let [even, odd] = self.by.map(Team::name);
        let by = if even == odd { even.to_owned() } else { format!("alternate({even}, {odd})") };
        format!("    kickoff {by} {{ kicking: {stem}_kicking, receiving: {stem}_receiving }}")
    }

    /// The lines of the two formations.
    pub(super) fn formations(&self, name: &str, stem: &str) -> Vec<String> {
        let point = |player: &GrfPlayer| {
            let [x, y] = observed(player).map(number);
            format!("    {} at ({x}, {y})", player.role.name())
        };
        let mut lines = vec![
            format!("/// The team that kicks off in {name}."),
            format!("formation {stem}_kicking {{"),
        ];
        lines.extend(self.kicking.iter().enumerate().map(|(index, player)| {
            format!("{}{}", point(player), options(player, self.crowded.contains(&index)))
        }));
        lines.extend([
            "}".to_owned(),
            String::new(),
            format!("/// The other team in {name}."),
            format!("formation {stem}_receiving {{"),
        ]);
        lines.extend(self.receiving.iter().map(point));
        lines.extend(["}".to_owned(), String::new()]);
        lines
    }
}

/// The team with the player at the ball if the ball lies on the centre spot.
fn kicker(recorded: &GrfScenario) -> Option<Team> {
    if recorded.ball_position != [0.0, 0.0] {
        return None;
    }
    let [left, right] = [Team::Left, Team::Right].map(|team| {
        let places = recorded.team(team).iter().map(|player| metres(player, team));
        places.map(|[x, y]| x.hypot(y)).fold(f64::INFINITY, f64::min)
    });
    if left.min(right) > AT_THE_BALL_M || left == right {
        return None;
    }
    Some(if left < right { Team::Left } else { Team::Right })
}
