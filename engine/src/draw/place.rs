//! What the pitch itself requires of a drawn start.

use super::{Drawer, Roster};
use arrayvec::ArrayVec;
use glam::Vec2;
use setpiece_scenario::Scenario;
use setpiece_scenario::pitch::{
    BALL_SPEED_MAX_MPS, BALL_SPIN_MAX, PLAYER_SPEED_MAX_MPS, PLAYERS_MAX, START_HEIGHT_MAX_M,
};
use setpiece_scenario::vocabulary::Team;

/// Least distance between two players if one of them was placed at random.
const MIN_GAP_M: f32 = 0.6;
/// The largest heading. A 32-bit float of this size still resolves a hundredth of a degree.
const HEADING_MAX_RAD: f64 = 1.0e3;
/// How far a number may exceed its bound. Texts are checked in 64 bits, but the match has 32.
const SLACK: f64 = 1.0e-3;

/// What can be wrong with a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum PlaceFault {
    /// A place, velocity or heading is NaN.
    Number,
    /// The ball is off the pitch.
    Ball,
    /// A player is off the pitch.
    Player,
    /// Two players overlap.
    Gap,
    /// A number that play can't continue from. Texts have narrower bounds, but files may hold
    /// anything.
    Bounds,
    /// Two players have the place of one. Texts that allow it aren't compiled, but files may hold
    /// anything.
    Seat,
}

impl PlaceFault {
    pub(super) const ALL: [PlaceFault; 6] = [
        PlaceFault::Number,
        PlaceFault::Ball,
        PlaceFault::Player,
        PlaceFault::Gap,
        PlaceFault::Bounds,
        PlaceFault::Seat,
    ];

    /// The requirement in words.
    pub(super) const fn words(self) -> &'static str {
        match self {
            PlaceFault::Number => "every place, velocity and heading is a number",
            PlaceFault::Ball => "the ball lies on the pitch",
            PlaceFault::Player => "every player stands on the pitch",
            PlaceFault::Gap => {
                "players placed at random keep 0.6 m from others, but for who may overlap"
            }
            PlaceFault::Bounds => {
                "the ball's height, speed and spin, and players' speeds and headings are within their bounds"
            }
            PlaceFault::Seat => "of players who take part instead of each other, one does at most",
        }
    }
}

impl Drawer {
    /// What is wrong with the places of this attempt, if anything.
    pub(super) fn misplaced(&self, scenario: &Scenario, roster: &Roster) -> Option<PlaceFault> {
        let start = &scenario.start;
        let ball = self.point((start.ball.x, start.ball.y));
        let (x, y) = self.pitch(scenario).rim();
        let rim = Vec2::new(x as f32, y as f32);
        let number = |reg| self.optional(reg).is_finite();
        let ball_moves =
            [start.ball.velocity, start.ball.spin].map(|vector| self.vector(vector).is_finite());
        if !ball.is_finite() || !number(start.ball.height) || ball_moves.contains(&false) {
            return Some(PlaceFault::Number);
        }
        if !on_pitch(ball, rim) {
            return Some(PlaceFault::Ball);
        }
        if !self.is_ball_bounded(scenario) {
            return Some(PlaceFault::Bounds);
        }
        let layouts = start.kickoff.iter().flat_map(|kickoff| &kickoff.places);
        if layouts.flat_map(|at| [at.kicking, at.receiving]).any(|at| self.point(at).is_nan()) {
            return Some(PlaceFault::Number);
        }
        // The earlier players: where they stand, whether that was drawn, and whether others may
        // stand there too.
        let mut placed: ArrayVec<(Vec2, bool, bool), PLAYERS_MAX> = ArrayVec::new();
        let mut last = None;
        for team in Team::ALL {
            for (id, slot) in scenario.team(*team).filter(|(id, slot)| {
                roster.present.get(*id) == Some(&true) && self.is_active(&slot.start)
            }) {
                if last.replace(id) == Some(id) {
                    return Some(PlaceFault::Seat);
                }
                let own = &slot.start;
                let at = self.point((own.x, own.y));
                let velocity = own.velocity.map_or(Vec2::ZERO, |velocity| self.point(velocity));
                if !at.is_finite() || !velocity.is_finite() || !number(own.heading) {
                    return Some(PlaceFault::Number);
                }
                if !on_pitch(at, rim) {
                    return Some(PlaceFault::Player);
                }
                let speed = f64::from(velocity.length());
                if speed > PLAYER_SPEED_MAX_MPS + SLACK
                    || self.optional(own.heading).abs() > HEADING_MAX_RAD
                {
                    return Some(PlaceFault::Bounds);
                }
                let random = self.is_random(own.x) || self.is_random(own.y);
                // Two fixed places may coincide, because the author wrote them.
                let crowded = placed.iter().any(|&(other, other_random, other_overlap)| {
                    (random || other_random)
                        && !(slot.overlap || other_overlap)
                        && at.distance(other) < MIN_GAP_M
                });
                if crowded {
                    return Some(PlaceFault::Gap);
                }
                placed.push((at, random, slot.overlap));
            }
        }
        None
    }

    /// Whether the ball's height, speed and spin are allowed in a start.
    fn is_ball_bounded(&self, scenario: &Scenario) -> bool {
        let ball = &scenario.start.ball;
        let [speed, spin] =
            [self.vector(ball.velocity).length(), self.vector(ball.spin).abs().max_element()];
        self.optional(ball.height) <= START_HEIGHT_MAX_M + SLACK
            && f64::from(speed) <= BALL_SPEED_MAX_MPS + SLACK
            && f64::from(spin) <= BALL_SPIN_MAX + SLACK
    }
}

/// Whether a place is on the pitch or the rim around it.
fn on_pitch(at: Vec2, rim: Vec2) -> bool {
    at.abs().cmple(rim).all()
}
