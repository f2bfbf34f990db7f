//! What a team's bots know of the game in a step.

use crate::control::bot::board::Board;
use crate::control::bot::mark;
use crate::football::{offside, reach};
use crate::math::share;
use crate::state::recent::BallMeans;
use crate::state::{Match, PlayerId};
use glam::Vec2;
use setpiece_scenario::vocabulary::Team;

/// The offside line is predicted this far ahead, seconds. (GRF's.)
const LINE_AHEAD_S: f32 = 0.24;
/// Teammates keep out of the ball's path at these ticks from now. (GRF's.)
const WAY_TICKS: [u32; 4] = [20, 35, 50, 65];
/// Steps of a match of 90 minutes.
const WHOLE_MATCH_STEPS: f32 = 3000.0;

/// What a team's bots know of the game in a step.
#[derive(Clone, Copy, Debug)]
pub struct TeamView {
    /// The team.
    pub team: Team,
    /// +1 if the team attacks towards +x.
    pub side: f32,
    /// The ball, own frame, metres.
    pub ball: Vec2,
    /// The player who has the ball or dribbles it.
    pub owner: Option<PlayerId>,
    /// The player who has the ball, or will have it first.
    pub action: Option<PlayerId>,
    /// Whether the team reaches the ball sooner than the other.
    pub best: bool,
    /// How near the team was to the ball recently, relative to the other: 0.5 far to 1.5 near.
    pub nearness: f32,
    /// How the last six seconds shift the block, -1..1: forward for a team that had the ball.
    pub lately: f32,
    /// How much the team dares, 0..1: more when behind, late in the match, and with the ball.
    pub daring: f32,
    /// The line behind which the team doesn't fall back, own frame x, metres.
    pub trap_x: f32,
    /// The offside line for us a moment from now, own frame x, metres.
    pub line_x: f32,
    /// Future places of the ball, own frame, metres.
    pub ways: [Vec2; 4],
    /// Recent places of the ball.
    pub means: BallMeans,
    /// Where everyone stands.
    pub board: Board,
}

impl TeamView {
    /// Computes what both teams know now.
    pub fn of_both(game: &Match) -> [TeamView; 2] {
        let (board, means) =
            (Board::of(game), game.play.recent.ball_means(game.ball.pos.truncate()));
        [Team::Left, Team::Right].map(|team| TeamView::of(game, team, board, means))
    }

    /// Computes what a team knows now.
    fn of(game: &Match, team: Team, board: Board, means: BallMeans) -> TeamView {
        let side = team.side() as f32;
        let owner = game.on_ball();
        let soonest = [team, team.other()].map(|team| TeamView::soonest(game, team));
        let mut view = TeamView {
            team,
            side,
            ball: game.ball.pos.truncate() * side,
            owner,
            action: owner.or_else(|| reach::first(game)).or(game.play.last_owner),
            best: match owner {
                Some(owner) => owner.team() == team,
                None => soonest[0] < soonest[1],
            },
            nearness: game.play.recent.nearness[team.index()],
            lately: lately(game, team),
            daring: daring(game, team),
            trap_x: 0.0,
            line_x: offside::line_in(game, team, LINE_AHEAD_S),
            ways: WAY_TICKS.map(|ticks| game.play.forecast.at(game.tick + ticks).truncate() * side),
            means,
            board,
        };
        view.trap_x = mark::trap_x(game, &view);
        view
    }

    /// Seconds until a team reaches the ball.
    pub(super) fn soonest(game: &Match, team: Team) -> f32 {
        game.play.chaser[team.index()].map_or(f32::MAX, |id| game.player(id).body.meet_s)
    }

    /// Where the action is, own frame: the place of the player who has the ball or will have it.
    pub fn action_at(&self, game: &Match) -> Vec2 {
        self.action.map_or(self.ball, |id| game.player(id).pos * self.side)
    }

    /// The opponent who has the ball, or would be the first of their team to have it.
    pub fn rival(&self, game: &Match) -> Option<PlayerId> {
        self.owner
            .filter(|id| id.team() != self.team)
            .or(game.play.chaser[self.team.other().index()])
    }

    /// How near the team was to the ball recently, as seen by a player. For one who goes for the
    /// ball, the present counts more the nearer the ball is. (GRF's.)
    pub fn nearness_of(&self, game: &Match, id: PlayerId) -> f32 {
        if game.play.chaser[self.team.index()] != Some(id) {
            return self.nearness;
        }
        let ball = game.play.forecast.at(game.tick + 30).truncate();
        let far = share(ball.distance(game.player(id).pos), 2.0, 14.0);
        let calm = |team| TeamView::soonest(game, team).min(60.0) + 1.5;
        let now = calm(self.team.other()) / calm(self.team);
        now + (self.nearness - now) * far * far
    }

    /// Whether the team has the ball or is about to.
    pub fn attacks(&self, game: &Match) -> bool {
        if let Some(owner) = self.owner {
            return owner.team() == self.team;
        }
        if let Some(pass) = game.play.pass {
            return pass.by.team() == self.team;
        }
        match game.possession {
            Some(team) => team == self.team,
            // Nobody has had it yet: the team that will be there first.
            None => {
                TeamView::soonest(game, self.team) <= TeamView::soonest(game, self.team.other())
            }
        }
    }
}

/// How the last six seconds shift the block, -1..1. (GRF's right team, against which agents play,
/// has the wrong sign here: its line comes forward when its opponents have the ball. So does a team
/// without agents here.)
fn lately(game: &Match, team: Team) -> f32 {
    let lately = game.play.recent.side_of(team);
    let is_wrong = !game.has_agents(team) && game.has_agents(team.other());
    if is_wrong { -lately } else { lately }
}

/// How much a team dares, 0..1. (GRF's; a match of 3000 steps is 90 minutes.)
fn daring(game: &Match, team: Team) -> f32 {
    let behind = game.score[team.other().index()] as f32 - game.score[team.index()] as f32;
    let behind = (0.5 + 0.25 * behind).clamp(0.0, 1.0);
    let played = ((game.elapsed_at_start + game.step) as f32 / WHOLE_MATCH_STEPS).min(1.0);
    let late = 0.5 + 0.5 * played;
    let had = game.play.recent.minute_s * team.side() as f32 / 60.0;
    0.5 * (0.5 + (behind - 0.5) * late) + 0.5 * (0.5 + 0.5 * had)
}
