//! What the last seconds were like: where the ball was, and which team was nearer to it.

use crate::state::{Match, PlayerId};
use glam::Vec2;
use setpiece_scenario::vocabulary::Team;

/// Places of the ball that are kept, and how many steps apart they are.
const PLACES: usize = 20;
const APART_STEPS: u32 = 2;
const APART_S: f32 = 0.1 * APART_STEPS as f32;
/// The nearness of a team that alone is near the ball, and of the other.
const NEAR: f32 = 1.5;
const FAR: f32 = 0.5;
/// What a team's nearness to the ball fades by in a step. (GRF's, of ten ticks.)
const FADES: f32 = 0.0489;
/// What is added to both teams' times to the ball before they are compared, seconds. (GRF's.)
const CALM_S: f32 = 1.5;
/// How much of a player's mean speed a step is.
const TIRES: f32 = 0.02;
/// How many steps the average side covers. (GRF's.)
const SIDE_STEPS: u8 = 60;
/// No team is further ahead in the ball's last minute, seconds.
const MINUTE_S: f32 = 60.0;

/// The last seconds of a match.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Recent {
    /// Where the ball was, in a ring.
    places: [Vec2; PLACES],
    /// Which place is the next to be written, and how many are.
    next: u8,
    count: u8,
    /// How near each team was to the ball, compared with the other: 0.5 far to 1.5 near, fading over two seconds.
    pub nearness: [f32; 2],
    /// How much nearer the left team was over the last six seconds, -1..1, and over how many steps that is.
    side: f32,
    side_steps: u8,
    /// How many seconds longer the left team had the ball lately, -60..60.
    pub minute_s: f32,
    /// By team, the mate who comes forward to help whoever has the ball.
    pub helper: [Option<PlayerId>; 2],
}

impl Recent {
    /// Before anything has happened.
    pub const fn blank() -> Recent {
        Recent {
            places: [Vec2::ZERO; PLACES],
            next: 0,
            count: 0,
            nearness: [1.0; 2],
            side: 0.0,
            side_steps: 0,
            minute_s: 0.0,
            helper: [None; 2],
        }
    }

    /// Where the ball, which is at `ball` now, was on average over each of the last moments.
    pub fn ball_means(&self, ball: Vec2) -> BallMeans {
        let count = usize::from(self.count).min(PLACES);
        let mut means = BallMeans { means: [ball; PLACES + 1], count };
        let (mut sum, mut at) = (ball, usize::from(self.next) % PLACES);
        for (places, mean) in means.means.iter_mut().enumerate().skip(1).take(count) {
            at = if at == 0 { PLACES - 1 } else { at - 1 };
            sum += self.places[at];
            *mean = sum / (places + 1) as f32;
        }
        means
    }

    /// How much nearer a team was to the ball over the last six seconds, -1..1.
    pub fn side_of(&self, team: Team) -> f32 {
        self.side * team.side() as f32
    }
}

/// Where the ball was on average over spells of every length up to four seconds: summed once for all who ask.
#[derive(Clone, Copy, Debug)]
pub struct BallMeans {
    /// Over so many places before the present one.
    means: [Vec2; PLACES + 1],
    /// How many places are known.
    count: usize,
}

impl BallMeans {
    /// Over so many seconds, at most four, world metres.
    pub fn over(&self, seconds: f32) -> Vec2 {
        self.means[((seconds / APART_S) as usize).min(self.count)]
    }
}

/// A start, and the moment in which play goes on after a stop: whose the ball is counts as having had it, or whoever is
/// sooner at it. (GRF's.)
pub fn begin(game: &mut Match) {
    let [left, right] = soonest(game);
    let sooner = if left < right { Team::Left } else { Team::Right };
    let team = holder(game).or(game.play.kick_off).unwrap_or(sooner);
    let recent = &mut game.play.recent;
    (recent.next, recent.count) = (0, 0);
    recent.nearness = [FAR; 2];
    recent.nearness[team.index()] = NEAR;
}

/// The team that has the ball to itself: in hands, or at a set piece.
fn holder(game: &Match) -> Option<Team> {
    match (game.play.hands, game.play.set_piece) {
        (Some((keeper, _)), _) => Some(keeper.team()),
        (_, Some(set_piece)) => Some(set_piece.team),
        _ => None,
    }
}

/// In how many seconds each team is at the ball, and some.
fn soonest(game: &Match) -> [f32; 2] {
    [Team::Left, Team::Right].map(|team| {
        game.team(team).fold(f32::MAX, |least, (_, player)| least.min(player.body.meet_s)).min(60.0) + CALM_S
    })
}

/// Takes a step in.
pub fn remember(game: &mut Match) {
    let soonest = soonest(game);
    let holder = holder(game);
    let ahead = match game.possession {
        Some(team) => 0.1 * team.side() as f32,
        None => 0.0,
    };
    let ball = game.ball.pos.truncate();
    let step = game.step;
    game.each(game.squad, |player| {
        player.body.mean_mps += (player.vel.length() - player.body.mean_mps) * TIRES;
    });
    let recent = &mut game.play.recent;
    for (team, nearness) in recent.nearness.iter_mut().enumerate() {
        let now = (soonest[1 - team] / soonest[team]).clamp(FAR, NEAR);
        *nearness = match holder {
            Some(held) => {
                if held.index() == team {
                    NEAR
                } else {
                    FAR
                }
            }
            None => *nearness + (now - *nearness) * FADES,
        };
    }
    recent.side_steps = recent.side_steps.saturating_add(1).min(SIDE_STEPS);
    recent.side += (recent.nearness[0] - recent.nearness[1] - recent.side) / f32::from(recent.side_steps);
    recent.minute_s = (recent.minute_s + ahead).clamp(-MINUTE_S, MINUTE_S);
    if step.is_multiple_of(APART_STEPS) {
        let next = usize::from(recent.next) % PLACES;
        recent.places[next] = ball;
        recent.next = ((next + 1) % PLACES) as u8;
        recent.count = recent.count.saturating_add(1).min(PLACES as u8);
    }
}
