//! What programs and scripts may read of a match: the match itself, or a small copy that outlives
//! the step.

use crate::snapshot::{Archive, SnapshotError};
use crate::state::{Match, PlayerId};
pub use setpiece_scenario::operators::{player_index, team_of_number};
use setpiece_scenario::pitch::{HALF_LENGTH_M, PLAYERS_MAX, STEPS_PER_S, TEAM_MAX};
use setpiece_scenario::vocabulary::{Action, Field, GameMode, Owner, Role, StickyAction, Team};
use setpiece_scenario::{Instr, Program, When};
use std::ops::Range;

/// The readable data of a player; world frame, SI.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct PlayerView {
    /// Metres.
    pub pos: [f32; 2],
    /// m/s.
    pub vel: [f32; 2],
    /// Radians.
    pub heading_rad: f32,
    /// 0 fresh to 1 exhausted.
    pub fatigue: f32,
    /// Cards so far.
    pub yellow_cards: u8,
    /// The player's role.
    pub role: Role,
    /// Whether they belong to this episode's roster.
    pub present: bool,
    /// Whether they are on the pitch.
    pub active: bool,
    /// Whether an agent controls them.
    pub controlled: bool,
    /// Their action of the last step; idle before the first.
    pub action: Action,
    /// Whether they hold sprint.
    pub sprinting: bool,
    /// Whether they hold dribble.
    pub dribbling: bool,
}

/// The readable data of a match; world frame, SI.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct MatchView {
    /// The ball's centre, metres.
    pub ball: [f32; 3],
    /// The ball's velocity, m/s.
    pub ball_vel: [f32; 3],
    /// Who has it now.
    pub owner: Option<PlayerId>,
    /// The team that had it last.
    pub possession: Option<Team>,
    /// Both teams, by id.
    pub players: [PlayerView; PLAYERS_MAX],
    /// Goals, left and right.
    pub score: [u16; 2],
    /// Open play or a set piece.
    pub mode: GameMode,
    /// Whether play is stopped.
    pub dead: bool,
    /// Steps since the start.
    pub step: u32,
    /// The episode is truncated after this many steps.
    pub limit_steps: Option<u32>,
    /// The goal lines are at x = ± this, metres.
    pub half_length_m: f32,
}

impl MatchView {
    /// An empty pitch, for programs that run before the match.
    pub const EMPTY: MatchView = MatchView {
        ball: [0.0; 3],
        ball_vel: [0.0; 3],
        owner: None,
        possession: None,
        players: [PlayerView {
            pos: [0.0; 2],
            vel: [0.0; 2],
            heading_rad: 0.0,
            fatigue: 0.0,
            yellow_cards: 0,
            role: Role::GK,
            present: false,
            active: false,
            controlled: false,
            action: Action::Idle,
            sprinting: false,
            dribbling: false,
        }; PLAYERS_MAX],
        score: [0; 2],
        mode: GameMode::Normal,
        dead: false,
        step: 0,
        limit_steps: None,
        half_length_m: HALF_LENGTH_M as f32,
    };

    /// The view of a match's current state.
    pub fn of(game: &Match) -> MatchView {
        let players = std::array::from_fn(|i| PlayerView::of(game, PlayerId(i as u8)));
        let mut view = MatchView { players, ..MatchView::EMPTY };
        view.keep_but_players(game);
        for player in game.agents.iter().filter_map(|agent| agent.player) {
            view.players[player.index()].controlled = true;
        }
        view
    }

    /// Writes or reads the parts that [`ViewMemory`] names; the rest is never read later.
    pub(crate) fn archive(
        &mut self,
        name: &str,
        memory: ViewMemory,
        archive: &mut Archive<'_>,
    ) -> Result<(), SnapshotError> {
        match memory {
            ViewMemory::Nothing => Ok(()),
            ViewMemory::ButPlayers => {
                // The limit and the pitch are the match's, which a reset has shown.
                let MatchView {
                    ball,
                    ball_vel,
                    owner,
                    possession,
                    players,
                    score,
                    mode,
                    dead,
                    step,
                    limit_steps,
                    half_length_m,
                } = *self;
                let mut kept = (ball, ball_vel, owner, possession, score, mode, dead, step);
                archive.value(name, &mut kept)?;
                let (ball, ball_vel, owner, possession, score, mode, dead, step) = kept;
                *self = MatchView {
                    ball,
                    ball_vel,
                    owner,
                    possession,
                    players,
                    score,
                    mode,
                    dead,
                    step,
                    limit_steps,
                    half_length_m,
                };
                Ok(())
            }
            ViewMemory::All => archive.value(name, self),
        }
    }

    /// Copies the parts of a match that [`ViewMemory`] names, and leaves the rest.
    pub fn keep(&mut self, game: &Match, memory: ViewMemory) {
        match memory {
            ViewMemory::Nothing => {}
            ViewMemory::ButPlayers => self.keep_but_players(game),
            ViewMemory::All => *self = MatchView::of(game),
        }
    }

    fn keep_but_players(&mut self, game: &Match) {
        self.ball = game.ball.pos.into();
        self.ball_vel = game.ball.vel.into();
        self.owner = game.owner;
        self.possession = game.possession;
        self.score = game.score;
        self.mode = game.mode;
        self.dead = game.dead;
        self.step = game.step;
        self.limit_steps = game.limit_steps;
        self.half_length_m = game.goal().x;
    }

    /// The players on the pitch of a team, or of both, by id.
    pub fn on_pitch(&self, team: Option<Team>) -> impl Iterator<Item = (usize, &PlayerView)> {
        let ids = ids(team);
        let first = ids.start;
        self.players[ids]
            .iter()
            .enumerate()
            .filter(|(_, p)| p.active)
            .map(move |(i, p)| (first + i, p))
    }
}

/// How much of a state is remembered until the next step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum ViewMemory {
    /// Nothing: no program reads it.
    #[default]
    Nothing,
    /// Everything but the players.
    ButPlayers,
    /// Everything.
    All,
}

impl ViewMemory {
    /// The parts of the last state that a program reads.
    pub fn of(program: &Program) -> ViewMemory {
        let of = |instr: &Instr| match instr {
            Instr::Load { field, when: When::Prev, .. } => match (field, field.subject()) {
                // The line depends on players.
                (_, Owner::Player) | (Field::OffsideLine, _) => ViewMemory::All,
                _ => ViewMemory::ButPlayers,
            },
            _ => ViewMemory::Nothing,
        };
        program.code.iter().map(of).max().unwrap_or_default()
    }
}

/// A state to read: the match itself, or a copy.
#[derive(Clone, Copy, Debug)]
pub enum Sight<'a> {
    /// The current match.
    Live(&'a Match),
    /// A copy.
    Kept(&'a MatchView),
}

impl Sight<'_> {
    /// Whether a player is on the pitch.
    #[inline]
    pub fn is_active(self, index: usize) -> bool {
        match self {
            Sight::Live(game) => game.players[index].active,
            Sight::Kept(view) => view.players[index].active,
        }
    }

    /// The player of an id as programs write it. `None` for -1, for other values that aren't ids,
    /// and for empty slots.
    #[inline]
    fn listed(self, id: f64) -> Option<PlayerView> {
        let index = player_index(id)?;
        let player = match self {
            Sight::Live(game) => PlayerView::of(game, PlayerId(index as u8)),
            Sight::Kept(view) => view.players[index],
        };
        player.present.then_some(player)
    }

    /// The same of a player on the pitch: who is absent is nowhere and does nothing.
    #[inline]
    fn player(self, id: f64) -> Option<PlayerView> {
        self.listed(id).filter(|player| player.active)
    }

    fn is_controlled(self, id: f64) -> f64 {
        match (self, self.player(id)) {
            (_, None) => f64::NAN,
            (Sight::Kept(_), Some(player)) => player.controlled.into(),
            (Sight::Live(game), Some(_)) => {
                game.agents.iter().any(|agent| player_number(agent.player) == id).into()
            }
        }
    }

    /// Whether a program's number is a player on the pitch.
    #[inline]
    pub fn exists(self, id: f64) -> bool {
        player_index(id).is_some_and(|index| self.is_active(index))
    }

    #[inline]
    pub(super) fn ball(self) -> [f32; 3] {
        match self {
            Sight::Live(game) => game.ball.pos.into(),
            Sight::Kept(view) => view.ball,
        }
    }

    fn ball_vel(self) -> [f32; 3] {
        match self {
            Sight::Live(game) => game.ball.vel.into(),
            Sight::Kept(view) => view.ball_vel,
        }
    }

    #[inline]
    pub(super) fn owner(self) -> Option<PlayerId> {
        match self {
            Sight::Live(game) => game.owner,
            Sight::Kept(view) => view.owner,
        }
    }

    /// World x beyond which a team's players are offside, metres: the second-last opponent, the
    /// ball or the halfway line, whichever is nearest to the opponents' goal.
    pub fn offside_line_m(self, team: Team) -> f64 {
        let side = team.side();
        let (mut last, mut second) = (f64::NEG_INFINITY, f64::NEG_INFINITY);
        for index in ids(Some(team.other())).filter(|&index| self.is_active(index)) {
            let x = match self {
                Sight::Live(game) => game.players[index].pos.x,
                Sight::Kept(view) => view.players[index].pos[0],
            };
            let x = side * f64::from(x);
            if x > last {
                second = last;
                last = x;
            } else if x > second {
                second = x;
            }
        }
        side * second.max(side * f64::from(self.ball()[0])).max(0.0)
    }

    /// One number of the match as a program reads it; NaN if there is no such player or team.
    #[inline]
    pub fn load(self, field: Field, of: f64) -> f64 {
        match field {
            Field::BallX => self.ball()[0].into(),
            Field::BallY => self.ball()[1].into(),
            Field::BallHeight => self.ball()[2].into(),
            Field::BallVx => self.ball_vel()[0].into(),
            Field::BallVy => self.ball_vel()[1].into(),
            Field::BallVz => self.ball_vel()[2].into(),
            Field::BallOwner => player_number(self.owner()),
            Field::PlayerX => self.player(of).map_or(f64::NAN, |player| player.pos[0].into()),
            Field::PlayerY => self.player(of).map_or(f64::NAN, |player| player.pos[1].into()),
            Field::PlayerVx => self.player(of).map_or(f64::NAN, |player| player.vel[0].into()),
            Field::PlayerVy => self.player(of).map_or(f64::NAN, |player| player.vel[1].into()),
            Field::PlayerHeading => {
                self.player(of).map_or(f64::NAN, |player| player.heading_rad.into())
            }
            Field::PlayerFatigue => {
                self.player(of).map_or(f64::NAN, |player| player.fatigue.into())
            }
            Field::PlayerYellowCards => {
                self.listed(of).map_or(f64::NAN, |player| player.yellow_cards.into())
            }
            Field::PlayerRole => {
                self.listed(of).map_or(f64::NAN, |player| player.role.index() as f64)
            }
            Field::PlayerActive => self.listed(of).map_or(f64::NAN, |player| player.active.into()),
            Field::PlayerControlled => self.is_controlled(of),
            Field::PlayerAction | Field::PlayerSprinting | Field::PlayerDribbling => {
                self.load_of_acting(field, of)
            }
            Field::Possession
            | Field::Score
            | Field::TeamHasBall
            | Field::OffsideLine
            | Field::Elapsed
            | Field::Remaining
            | Field::GameMode
            | Field::BallDead => self.load_of_match(field, of),
        }
    }

    /// What a player does.
    #[inline(never)]
    fn load_of_acting(self, field: Field, of: f64) -> f64 {
        let Some(player) = self.player(of) else { return f64::NAN };
        match field {
            Field::PlayerAction => player.action.index() as f64,
            Field::PlayerSprinting => player.sprinting.into(),
            _ => player.dribbling.into(),
        }
    }

    /// The rarely read fields.
    #[inline(never)]
    fn load_of_match(self, field: Field, of: f64) -> f64 {
        let (possession, score, mode, dead, step, limit_steps) = match self {
            Sight::Live(game) => {
                (game.possession, game.score, game.mode, game.dead, game.step, game.limit_steps)
            }
            Sight::Kept(view) => {
                (view.possession, view.score, view.mode, view.dead, view.step, view.limit_steps)
            }
        };
        match (field, team_of_number(of)) {
            (Field::Possession, _) => team_number(possession),
            (Field::Score, Some(team)) => score[team.index()].into(),
            (Field::TeamHasBall, Some(team)) => {
                self.owner().is_some_and(|owner| owner.team() == team).into()
            }
            (Field::OffsideLine, Some(team)) => self.offside_line_m(team),
            (Field::Elapsed, _) => f64::from(step) / STEPS_PER_S,
            (Field::Remaining, _) => remaining_s(step, limit_steps),
            (Field::GameMode, _) => mode.index() as f64,
            (Field::BallDead, _) => dead.into(),
            _ => f64::NAN,
        }
    }
}

/// Seconds until the limit; infinite without one.
pub fn remaining_s(step: u32, limit_steps: Option<u32>) -> f64 {
    limit_steps.map_or(f64::INFINITY, |limit| f64::from(limit.saturating_sub(step)) / STEPS_PER_S)
}

impl PlayerView {
    /// The view of a player, without who controls them.
    #[inline]
    fn of(game: &Match, id: PlayerId) -> PlayerView {
        let player = game.player(id);
        let acting = &game.play.acting[id.index()];
        let holds = |key: StickyAction| acting.sticky >> key.index() & 1 == 1;
        PlayerView {
            pos: player.pos.into(),
            vel: player.vel.into(),
            heading_rad: player.heading_rad,
            fatigue: player.fatigue,
            yellow_cards: player.yellow_cards,
            role: player.role,
            present: game.squad.has(id),
            active: player.active,
            controlled: false,
            action: acting.played.unwrap_or(Action::Idle),
            sprinting: holds(StickyAction::Sprint),
            dribbling: holds(StickyAction::Dribble),
        }
    }
}

/// The ids of a team, or of both.
pub fn ids(team: Option<Team>) -> Range<usize> {
    match team {
        Some(team) => team.index() * TEAM_MAX..(team.index() + 1) * TEAM_MAX,
        None => 0..PLAYERS_MAX,
    }
}

/// A player id as programs write it: -1 for nobody.
pub fn player_number(id: Option<PlayerId>) -> f64 {
    id.map_or(-1.0, |id| id.index() as f64)
}

/// A team as programs write it: -1 for none.
pub fn team_number(team: Option<Team>) -> f64 {
    team.map_or(-1.0, |team| team.index() as f64)
}
