//! The raw observation: GRF's dictionary as a struct.

use super::frame::SideFrame;
use super::{ObserveError, slot};
use crate::state::{Match, PlayerId};
use arrayvec::ArrayVec;
use setpiece_scenario::pitch::{STEPS_PER_S, TEAM_MAX, X_SCALE_M, Y_SCALE_M};
use setpiece_scenario::vocabulary::{StickyAction, Team};

/// One side of a raw observation, by place in the roster.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RawTeam {
    /// `*_team`: normalised places.
    pub places: ArrayVec<[f64; 2], TEAM_MAX>,
    /// `*_team_direction`: normalised displacements per step.
    pub directions: ArrayVec<[f64; 2], TEAM_MAX>,
    /// `*_team_tired_factor`: 0 fresh to 1 exhausted.
    pub tired_factors: ArrayVec<f64, TEAM_MAX>,
    /// `*_team_yellow_card`: whether the player has a card.
    pub yellow_cards: ArrayVec<bool, TEAM_MAX>,
    /// `*_team_active`: still on the pitch.
    pub active: ArrayVec<bool, TEAM_MAX>,
    /// `*_team_roles`: GRF's numbers.
    pub roles: ArrayVec<i64, TEAM_MAX>,
}

/// A raw observation in the reader's frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Raw {
    /// `ball`: normalised x, y; z in metres.
    pub ball: [f64; 3],
    /// `ball_direction`: displacement per step.
    pub ball_direction: [f64; 3],
    /// `ball_rotation`: rotation per millisecond, in GRF's scale; not turned for the right team.
    pub ball_rotation: [f64; 3],
    /// `ball_owned_team`: -1 nobody, 0 us, 1 them.
    pub ball_owned_team: i64,
    /// `ball_owned_player`: the owner's index in their team, or -1.
    pub ball_owned_player: i64,
    /// `left_team…`: the own side.
    pub left: RawTeam,
    /// `right_team…`: the opponents.
    pub right: RawTeam,
    /// `designated`: the own team's best placed player for the ball, or -1.
    pub designated: i64,
    /// `active`: the agent's player, or -1.
    pub active: i64,
    /// `sticky_actions`: the held actions.
    pub sticky_actions: [u8; StickyAction::ALL.len()],
    /// `score`: ours and theirs.
    pub score: [i64; 2],
    /// `steps_left`: until the limit; -1 without one.
    pub steps_left: i64,
    /// `game_mode`: GRF's number.
    pub game_mode: i64,
}

/// Builds agent `agent`'s raw observation.
///
/// # Errors
/// [`ObserveError::Agent`] for unknown agents.
pub fn raw(game: &Match, agent: usize) -> Result<Raw, ObserveError> {
    let slot = slot(game, agent)?;
    let mut raw = raw_of(game, slot.team);
    let frame = SideFrame { game, us: slot.team };
    raw.active = number(slot.player.and_then(|player| frame.place(player)));
    raw.sticky_actions = std::array::from_fn(|bit| u8::from(slot.sticky >> bit & 1 == 1));
    if game.agents.iter().filter(|other| other.team == slot.team).count() == 1 {
        raw.designated = raw.active;
    }
    Ok(raw)
}

/// The raw observation of a side without an agent: no player is `active`, nothing is held.
pub fn raw_of(game: &Match, us: Team) -> Raw {
    let frame = SideFrame { game, us };
    let owner = frame.owner();
    let [left, right] = frame.teams().map(|team| side(frame, team));
    let spin = game.ball.spin.to_array().map(|rad_s| f64::from(rad_s) / 1000.0 / STEPS_PER_S);
    let [ours, theirs] = frame.teams().map(|team| i64::from(game.score[team.index()]));
    Raw {
        ball: frame.ball(),
        ball_direction: frame.ball_stride(),
        ball_rotation: [spin[0] / X_SCALE_M, spin[1] / Y_SCALE_M, spin[2]].map(|turn| turn + 0.0),
        ball_owned_team: number(owner.map(|(team, _)| team)),
        ball_owned_player: number(owner.map(|(_, place)| place)),
        left,
        right,
        designated: number(designated(frame).and_then(|player| frame.place(player))),
        active: -1,
        sticky_actions: [0; StickyAction::ALL.len()],
        score: [ours, theirs],
        steps_left: game.limit_steps.map_or(-1, |limit| i64::from(limit.saturating_sub(game.step))),
        game_mode: game.mode.index() as i64,
    }
}

fn side(frame: SideFrame<'_>, team: Team) -> RawTeam {
    let mut side = RawTeam::default();
    for (_, player) in frame.roster(team) {
        side.places.push(frame.place_of(player.pos));
        side.directions.push(frame.stride_of(player.vel));
        side.tired_factors.push(player.fatigue.into());
        // Any card counts, as in GRF.
        side.yellow_cards.push(player.yellow_cards > 0 || !player.active);
        side.active.push(player.active);
        side.roles.push(player.role.index() as i64);
    }
    side
}

/// The own player who has the ball, or the one nearest to it.
fn designated(frame: SideFrame<'_>) -> Option<PlayerId> {
    if let Some(owner) = frame.game.owner.filter(|owner| owner.team() == frame.us) {
        return Some(owner);
    }
    let ball = frame.game.ball.pos.truncate();
    let active = frame.roster(frame.us).filter(|(_, player)| player.active);
    active
        .min_by(|(_, a), (_, b)| {
            a.pos.distance_squared(ball).total_cmp(&b.pos.distance_squared(ball))
        })
        .map(|(id, _)| id)
}

fn number(place: Option<usize>) -> i64 {
    place.map_or(-1, |place| place as i64)
}
