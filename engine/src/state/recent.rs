//! The memory of the last seconds: where the ball was, and which team was nearer to it.

use super::PlayerId;
use glam::Vec2;
use setpiece_scenario::vocabulary::Team;

/// How many places of the ball are kept, and how many steps apart they are.
const PLACES: usize = 20;
const APART_STEPS: u32 = 2;
const APART_S: f32 = 0.1 * APART_STEPS as f32;
/// The nearness of a team that is near the ball unopposed, and of the other.
const NEAR: f32 = 1.5;
const FAR: f32 = 0.5;
/// How much a team's nearness to the ball decays per step. (GRF's, of ten ticks.)
const FADES: f32 = 0.0489;
/// Number of steps in the average of `side`. (GRF's.)
const SIDE_STEPS: u8 = 60;
/// The largest lead of a team in the ball's last minute, seconds.
const MINUTE_S: f32 = 60.0;

/// The last seconds of a match.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Recent {
    /// Recent places of the ball, in a ring.
    places: [Vec2; PLACES],
    /// The index of the next place to write, and how many are valid.
    next: u8,
    count: u8,
    /// How near each team was to the ball, relative to the other: 0.5 far to 1.5 near, fading over
    /// two seconds.
    pub nearness: [f32; 2],
    /// How much nearer the left team was over the last six seconds, -1..1, and over how many steps.
    side: f32,
    side_steps: u8,
    /// How many seconds longer the left team had the ball recently, -60..60.
    pub minute_s: f32,
    /// By team, the teammate who comes forward to support the player on the ball.
    pub helper: [Option<PlayerId>; 2],
}

impl Recent {
    /// The empty memory.
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

    /// Resets the memory: nothing is known of the ball, and a team counts as having had it.
    pub fn begin(&mut self, team: Team) {
        (self.next, self.count) = (0, 0);
        self.nearness = [FAR; 2];
        self.nearness[team.index()] = NEAR;
    }

    /// Adds a step, at the end of which the ball is at `ball`.
    ///
    /// - `soonest`: how far in time each team is from the ball, seconds;
    /// - `holder`: the team that has the ball uncontested;
    /// - `possession`: the team that had it last.
    pub fn remember(
        &mut self,
        step: u32,
        ball: Vec2,
        soonest: [f32; 2],
        holder: Option<Team>,
        possession: Option<Team>,
    ) {
        for (team, nearness) in self.nearness.iter_mut().enumerate() {
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
        self.side_steps = self.side_steps.saturating_add(1).min(SIDE_STEPS);
        self.side += (self.nearness[0] - self.nearness[1] - self.side) / f32::from(self.side_steps);
        let ahead = match possession {
            Some(team) => 0.1 * team.side() as f32,
            None => 0.0,
        };
        self.minute_s = (self.minute_s + ahead).clamp(-MINUTE_S, MINUTE_S);
        if step.is_multiple_of(APART_STEPS) {
            let next = usize::from(self.next) % PLACES;
            self.places[next] = ball;
            self.next = ((next + 1) % PLACES) as u8;
            self.count = self.count.saturating_add(1).min(PLACES as u8);
        }
    }

    /// The ball's mean places over recent spells of each length. The ball is at `ball` now.
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

/// The ball's mean place over spells of every length up to four seconds, computed once for
/// everyone.
#[derive(Clone, Copy, Debug)]
pub struct BallMeans {
    /// Index n: over the last n places and the current one.
    means: [Vec2; PLACES + 1],
    /// How many places are known.
    count: usize,
}

impl BallMeans {
    /// The mean over the last seconds (at most four), world metres.
    pub fn over(&self, seconds: f32) -> Vec2 {
        self.means[((seconds / APART_S) as usize).min(self.count)]
    }
}
