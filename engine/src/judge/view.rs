//! What programs and scripts may read of a match: a small copy, made once per step.

use crate::state::{Match, PlayerId};
use setpiece_scenario::pitch::{PLAYERS_MAX, STEPS_PER_S, TEAM_MAX};
use setpiece_scenario::vocabulary::{Field, GameMode, Role, Team};

/// What may be read of a player; world frame, SI.
#[derive(Clone, Copy, Debug, PartialEq)]
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
    /// His role.
    pub role: Role,
    /// Belongs to this episode's roster.
    pub present: bool,
    /// Is on the pitch.
    pub active: bool,
    /// An agent controls him.
    pub controlled: bool,
}

/// What may be read of a match; world frame, SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
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
    /// Play is stopped.
    pub dead: bool,
    /// Steps since the start.
    pub step: u32,
    /// Truncation after so many steps.
    pub limit_steps: Option<u32>,
}

impl View {
    /// A pitch without anybody: what a program that runs before the match sees.
    pub const EMPTY: View = View {
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
        }; PLAYERS_MAX],
        score: [0; 2],
        mode: GameMode::Normal,
        dead: false,
        step: 0,
        limit_steps: None,
    };

    /// The view of a match as it stands.
    pub fn of(game: &Match) -> View {
        let mut view = View {
            ball: game.ball.pos.into(),
            ball_vel: game.ball.vel.into(),
            owner: game.owner,
            possession: game.possession,
            players: game.players.each_ref().map(|player| PlayerView {
                pos: player.pos.into(),
                vel: player.vel.into(),
                heading_rad: player.heading_rad,
                fatigue: player.fatigue,
                yellow_cards: player.yellow_cards,
                role: player.role,
                present: player.present,
                active: player.active,
                controlled: false,
            }),
            score: game.score,
            mode: game.mode,
            dead: game.dead,
            step: game.step,
            limit_steps: game.limit_steps,
        };
        for player in game.agents.iter().filter_map(|agent| agent.player) {
            view.players[player.index()].controlled = true;
        }
        view
    }

    /// The player of an id as programs write it; `None` for -1, for what is no id, and where nobody is.
    pub fn player(&self, id: f64) -> Option<&PlayerView> {
        let index = player_index(id)?;
        self.players.get(index).filter(|player| player.present)
    }

    /// The players on the pitch of a team, or of both, by id.
    pub fn on_pitch(&self, team: Option<Team>) -> impl Iterator<Item = (usize, &PlayerView)> {
        let range = match team {
            Some(team) => team.index() * TEAM_MAX..(team.index() + 1) * TEAM_MAX,
            None => 0..PLAYERS_MAX,
        };
        let first = range.start;
        self.players[range].iter().enumerate().filter(|(_, p)| p.active).map(move |(i, p)| (first + i, p))
    }

    /// World x beyond which a team's players are offside, metres: the second-last opponent, the ball or the halfway
    /// line, whichever is nearest to the opponents' goal.
    pub fn offside_line_m(&self, team: Team) -> f64 {
        let side = team.side();
        let (mut last, mut second) = (f64::NEG_INFINITY, f64::NEG_INFINITY);
        for (_, player) in self.on_pitch(Some(team.other())) {
            let x = side * f64::from(player.pos[0]);
            if x > last {
                second = last;
                last = x;
            } else if x > second {
                second = x;
            }
        }
        side * second.max(side * f64::from(self.ball[0])).max(0.0)
    }

    /// One number of the match as a program reads it; NaN of nobody, and of no team.
    pub fn load(&self, field: Field, of: f64) -> f64 {
        match field {
            Field::BallX => self.ball[0].into(),
            Field::BallY => self.ball[1].into(),
            Field::BallHeight => self.ball[2].into(),
            Field::BallVx => self.ball_vel[0].into(),
            Field::BallVy => self.ball_vel[1].into(),
            Field::BallVz => self.ball_vel[2].into(),
            Field::BallOwner => player_number(self.owner),
            Field::Possession => team_number(self.possession),
            Field::Score => team_of_number(of).map_or(f64::NAN, |team| self.score[team.index()].into()),
            Field::TeamHasBall => match team_of_number(of) {
                Some(team) => self.owner.is_some_and(|owner| owner.team() == team).into(),
                None => f64::NAN,
            },
            Field::OffsideLine => team_of_number(of).map_or(f64::NAN, |team| self.offside_line_m(team)),
            Field::Elapsed => f64::from(self.step) / STEPS_PER_S,
            Field::Remaining => self.remaining_s(),
            Field::GameMode => self.mode.index() as f64,
            Field::BallDead => self.dead.into(),
            Field::PlayerX
            | Field::PlayerY
            | Field::PlayerVx
            | Field::PlayerVy
            | Field::PlayerHeading
            | Field::PlayerFatigue
            | Field::PlayerYellowCards
            | Field::PlayerRole
            | Field::PlayerActive
            | Field::PlayerControlled => self.player(of).map_or(f64::NAN, |player| player.load(field)),
        }
    }

    /// Seconds until the limit; infinite without one.
    pub fn remaining_s(&self) -> f64 {
        match self.limit_steps {
            Some(limit) => f64::from(limit.saturating_sub(self.step)) / STEPS_PER_S,
            None => f64::INFINITY,
        }
    }
}

impl PlayerView {
    fn load(&self, field: Field) -> f64 {
        match field {
            Field::PlayerX => self.pos[0].into(),
            Field::PlayerY => self.pos[1].into(),
            Field::PlayerVx => self.vel[0].into(),
            Field::PlayerVy => self.vel[1].into(),
            Field::PlayerHeading => self.heading_rad.into(),
            Field::PlayerFatigue => self.fatigue.into(),
            Field::PlayerYellowCards => self.yellow_cards.into(),
            Field::PlayerRole => self.role.index() as f64,
            Field::PlayerActive => self.active.into(),
            Field::PlayerControlled => self.controlled.into(),
            _ => f64::NAN,
        }
    }
}

/// A player id as an index; `None` for -1 and for what is no id.
pub fn player_index(id: f64) -> Option<usize> {
    let index = id as i64;
    (index as f64 == id && (0..PLAYERS_MAX as i64).contains(&index)).then_some(index as usize)
}

/// A player id as programs write it: -1 for nobody.
pub fn player_number(id: Option<PlayerId>) -> f64 {
    id.map_or(-1.0, |id| id.index() as f64)
}

/// A team as programs write it: -1 for none.
pub fn team_number(team: Option<Team>) -> f64 {
    team.map_or(-1.0, |team| team.index() as f64)
}

/// The team a program's number means.
pub fn team_of_number(number: f64) -> Option<Team> {
    if number == 0.0 {
        Some(Team::Left)
    } else if number == 1.0 {
        Some(Team::Right)
    } else {
        None
    }
}
