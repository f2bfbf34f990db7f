//! What the pitch itself requires of a drawn start.

use super::{Drawer, Roster};
use arrayvec::ArrayVec;
use glam::Vec2;
use setpiece_scenario::Scenario;
use setpiece_scenario::pitch::{PLAYERS_MAX, RIM_X_M, RIM_Y_M};
use setpiece_scenario::vocabulary::Team;

/// Least distance between two players of whom one was placed at random.
const MIN_GAP_M: f32 = 0.6;

/// What can be wrong with a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Fault {
    /// A place, velocity or heading is no number.
    Number,
    /// The ball lies off the pitch.
    Ball,
    /// A player stands off the pitch.
    Player,
    /// Two players stand in each other.
    Gap,
}

impl Fault {
    pub(super) const ALL: [Fault; 4] = [Fault::Number, Fault::Ball, Fault::Player, Fault::Gap];

    /// The requirement, in words.
    pub(super) const fn words(self) -> &'static str {
        match self {
            Fault::Number => "every place, velocity and heading is a number",
            Fault::Ball => "the ball lies on the pitch",
            Fault::Player => "every player stands on the pitch",
            Fault::Gap => "players placed at random keep 0.6 m from others, but for who may overlap",
        }
    }
}

impl Drawer {
    /// What is wrong with the places of the present attempt, if anything.
    pub(super) fn misplaced(&self, scenario: &Scenario, roster: &Roster) -> Option<Fault> {
        let start = &scenario.start;
        let ball = self.point((start.ball.x, start.ball.y));
        let number = |reg| self.optional(reg).is_finite();
        let ball_moves = [start.ball.velocity, start.ball.spin].map(|vector| self.vector(vector).is_finite());
        if !ball.is_finite() || !number(start.ball.height) || ball_moves.contains(&false) {
            return Some(Fault::Number);
        }
        if !on_pitch(ball) {
            return Some(Fault::Ball);
        }
        // Where the men before him stand, whether they were drawn there, and whether others may stand there too.
        let mut placed: ArrayVec<(Vec2, bool, bool), PLAYERS_MAX> = ArrayVec::new();
        for team in Team::ALL {
            for (_, slot) in scenario.team(*team).filter(|&(id, _)| roster.present.get(id) == Some(&true)) {
                let own = &slot.start;
                let at = self.point((own.x, own.y));
                let velocity = own.velocity.map_or(Vec2::ZERO, |velocity| self.point(velocity));
                if !at.is_finite() || !velocity.is_finite() || !number(own.heading) {
                    return Some(Fault::Number);
                }
                if !on_pitch(at) {
                    return Some(Fault::Player);
                }
                let random = self.is_random(own.x) || self.is_random(own.y);
                // Two fixed places may coincide: the author wrote them so.
                let crowded = placed.iter().any(|&(other, other_random, other_overlap)| {
                    (random || other_random) && !(slot.overlap || other_overlap) && at.distance(other) < MIN_GAP_M
                });
                if crowded {
                    return Some(Fault::Gap);
                }
                placed.push((at, random, slot.overlap));
            }
        }
        None
    }
}

/// Whether a place lies on the pitch or the rim around it.
fn on_pitch(at: Vec2) -> bool {
    at.x.abs() <= RIM_X_M as f32 && at.y.abs() <= RIM_Y_M as f32
}
