//! The reader's frame: which team is their own, and how the world is turned for them.

use crate::state::{Match, Player, PlayerId};
use glam::{Vec2, Vec3};
use setpiece_scenario::pitch::{STEPS_PER_S, X_SCALE_M, Y_SCALE_M};
use setpiece_scenario::vocabulary::Team;

/// A match seen from one side.
#[derive(Clone, Copy)]
pub(super) struct SideFrame<'a> {
    pub(super) game: &'a Match,
    pub(super) us: Team,
}

impl<'a> SideFrame<'a> {
    /// Both teams, the own one first.
    pub(super) fn teams(self) -> [Team; 2] {
        [self.us, self.us.other()]
    }

    /// The players of a team's roster, in source order.
    pub(super) fn roster(self, team: Team) -> impl Iterator<Item = (PlayerId, &'a Player)> {
        self.game.squad.of(team).ids().map(move |id| (id, self.game.player(id)))
    }

    /// A player's index in the roster of their team.
    pub(super) fn place(self, player: PlayerId) -> Option<usize> {
        self.roster(player.team()).position(|(id, _)| id == player)
    }

    fn side(self) -> f64 {
        self.us.side()
    }

    /// Normalised place.
    pub(super) fn place_of(self, metres: Vec2) -> [f64; 2] {
        // Adding 0 folds -0.0.
        [
            self.side() * f64::from(metres.x) / X_SCALE_M + 0.0,
            self.side() * f64::from(metres.y) / Y_SCALE_M + 0.0,
        ]
    }

    /// Normalised displacement per step.
    pub(super) fn stride_of(self, mps: Vec2) -> [f64; 2] {
        self.place_of(mps).map(|length| length / STEPS_PER_S)
    }

    /// The ball: normalised x and y, height in metres.
    pub(super) fn ball(self) -> [f64; 3] {
        let ball = self.game.ball.pos;
        let [x, y] = self.place_of(ball.truncate());
        [x, y, ball.z.into()]
    }

    /// The ball's displacement per step.
    pub(super) fn ball_stride(self) -> [f64; 3] {
        let velocity: Vec3 = self.game.ball.vel;
        let [x, y] = self.stride_of(velocity.truncate());
        [x, y, f64::from(velocity.z) / STEPS_PER_S]
    }

    /// Who has the ball: 0 for the own team, 1 for the other, and their index in its roster.
    pub(super) fn owner(self) -> Option<(usize, usize)> {
        let owner = self.game.owner?;
        let team = usize::from(owner.team() != self.us);
        Some((team, self.place(owner)?))
    }
}
