//! What is drawn: one plain value per moment, which an episode, a replay and a snapshot can all
//! give.
//!
//! World frame, as in the engine: the origin is the centre spot, +x points at the right team's
//! goal, +y at the bottom of the picture (the touch line nearer to the camera), z up. Lengths are
//! metres, times seconds, speeds m/s. Every number may have any value: what can't be shown is drawn
//! at the nearest place that can.

use serde::{Deserialize, Serialize};

/// A moment of a match.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Scene {
    /// Steps of 100 ms since the episode's start. Legs and flags move with it.
    pub step: u32,
    /// The share of the way to the next step, 0..1, for scenes between two steps.
    pub between: f32,
    /// The measures of the pitch.
    pub pitch: Pitch,
    /// The ball.
    pub ball: SceneBall,
    /// Everyone of both squads, in any order.
    pub players: Vec<ScenePlayer>,
    /// The teams' names on the scoreboard, left and right.
    pub names: [String; 2],
    /// Goals, left and right.
    pub score: [u16; 2],
    /// The match's clock, seconds.
    pub clock_s: f32,
    /// Open play, or the set piece that is waiting.
    pub mode: Mode,
    /// The team that takes the set piece.
    pub mode_team: Option<Side>,
    /// The team that had the ball last.
    pub possession: Option<Side>,
    /// What has just happened, for the banner.
    pub news: Vec<News>,
    /// The rewards of this step by term.
    pub rewards: Vec<Term>,
    /// Ball and players were placed since the scene before: nothing connects the two, so no trail
    /// does.
    pub placed: bool,
}

impl Default for Scene {
    fn default() -> Scene {
        Scene {
            step: 0,
            between: 0.0,
            pitch: Pitch::default(),
            ball: SceneBall::default(),
            players: Vec::new(),
            names: ["LEFT".to_owned(), "RIGHT".to_owned()],
            score: [0, 0],
            clock_s: 0.0,
            mode: Mode::Normal,
            mode_team: None,
            possession: None,
            news: Vec::new(),
            rewards: Vec::new(),
            placed: false,
        }
    }
}

impl Scene {
    /// The player who has the ball.
    pub fn owner(&self) -> Option<&ScenePlayer> {
        self.ball
            .owner
            .and_then(|id| self.players.iter().find(|player| player.id == id && player.present))
    }
}

/// The measures of a pitch, metres.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Pitch {
    /// From goal line to goal line.
    pub length_m: f32,
    /// From touch line to touch line.
    pub width_m: f32,
    /// Between the posts' centres.
    pub goal_width_m: f32,
    /// Height of the crossbar's centre.
    pub goal_height_m: f32,
    /// Depth of the net behind the line.
    pub goal_depth_m: f32,
    /// Depth of the penalty box.
    pub box_depth_m: f32,
    /// Width of the penalty box.
    pub box_width_m: f32,
    /// Depth of the goal area.
    pub six_yard_depth_m: f32,
    /// Width of the goal area.
    pub six_yard_width_m: f32,
    /// Distance of the penalty spot from the goal line.
    pub spot_m: f32,
    /// Radius of the centre circle and of the D.
    pub circle_m: f32,
}

impl Default for Pitch {
    fn default() -> Pitch {
        Pitch {
            length_m: 110.0,
            width_m: 72.0,
            goal_width_m: 7.4,
            goal_height_m: 2.5,
            goal_depth_m: 2.55,
            box_depth_m: 16.5,
            box_width_m: 40.3,
            six_yard_depth_m: 5.5,
            six_yard_width_m: 18.32,
            spot_m: 11.0,
            circle_m: 9.15,
        }
    }
}

/// The ball.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct SceneBall {
    /// Its centre.
    pub pos: [f32; 3],
    /// m/s.
    pub vel: [f32; 3],
    /// rad/s about the three axes.
    pub spin: [f32; 3],
    /// Who has it.
    pub owner: Option<Id>,
}

/// A team, by the goal that it defends.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Side {
    /// Defends the goal at −x.
    #[default]
    Left,
    /// Defends the goal at +x.
    Right,
}

impl Side {
    /// 0 for the left team, 1 for the right one.
    pub const fn index(self) -> usize {
        self as usize
    }
}

/// A player's identity: the team and the place in the team's list.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Id {
    /// The team.
    pub team: Side,
    /// Place in the team, from 0.
    pub slot: u8,
}

/// A player.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct ScenePlayer {
    /// Who it is.
    pub id: Id,
    /// The number on the shirt.
    pub number: u8,
    /// The role; keepers wear another kit.
    pub role: Role,
    /// Where they stand.
    pub pos: [f32; 2],
    /// How far their feet are above the ground.
    pub height_m: f32,
    /// m/s.
    pub vel: [f32; 2],
    /// The direction they face; its length doesn't matter.
    pub facing: [f32; 2],
    /// What the body does.
    pub posture: Posture,
    /// How far the posture has come, 0..1.
    pub progress: f32,
    /// 0 fresh to 1 exhausted.
    pub tired: f32,
    /// Yellow cards so far.
    pub yellow_cards: u8,
    /// On the pitch. `false` for a player who was sent off.
    pub present: bool,
    /// An agent plays them; a ring shows it.
    pub agent: bool,
}

impl Default for ScenePlayer {
    fn default() -> ScenePlayer {
        ScenePlayer {
            id: Id::default(),
            number: 0,
            role: Role::CM,
            pos: [0.0; 2],
            height_m: 0.0,
            vel: [0.0; 2],
            facing: [1.0, 0.0],
            posture: Posture::Upright,
            progress: 0.0,
            tired: 0.0,
            yellow_cards: 0,
            present: true,
            agent: false,
        }
    }
}

/// A player's role.
#[allow(missing_docs, reason = "the usual abbreviations")]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Role {
    GK,
    CB,
    LB,
    RB,
    DM,
    #[default]
    CM,
    LM,
    RM,
    AM,
    CF,
}

/// What a body does.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Posture {
    /// Stands, walks or runs, by the speed.
    #[default]
    Upright,
    /// Loses balance.
    Stumbling,
    /// Slides along the ground, feet first.
    Sliding,
    /// Lies on the ground.
    Fallen,
    /// Jumps, for a header or a catch.
    Jumping,
    /// Dives along the velocity, hands first.
    Diving,
    /// Kicks with the right foot.
    Kicking,
}

/// Open play, or the set piece that is waiting.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Mode {
    /// Open play.
    #[default]
    Normal,
    /// A kick-off.
    KickOff,
    /// A goal kick.
    GoalKick,
    /// A free kick.
    FreeKick,
    /// A corner.
    Corner,
    /// A throw-in.
    ThrowIn,
    /// A penalty.
    Penalty,
}

impl Mode {
    /// Its name on the scoreboard; empty in open play.
    pub const fn caption(self) -> &'static str {
        match self {
            Mode::Normal => "",
            Mode::KickOff => "KICK-OFF",
            Mode::GoalKick => "GOAL KICK",
            Mode::FreeKick => "FREE KICK",
            Mode::Corner => "CORNER",
            Mode::ThrowIn => "THROW-IN",
            Mode::Penalty => "PENALTY",
        }
    }
}

/// Something that has just happened.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct News {
    /// What.
    pub kind: NewsKind,
    /// The team that scored, or whose player is meant.
    pub team: Side,
    /// The player's shirt number.
    pub number: Option<u8>,
    /// How many steps ago.
    pub age_steps: u32,
}

/// The kinds of news, the more important ones last.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum NewsKind {
    /// A foul was whistled.
    Foul,
    /// A player was offside.
    Offside,
    /// A yellow card.
    YellowCard,
    /// A red card.
    RedCard,
    /// A goal.
    Goal,
}

/// A part of a step's reward.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Term {
    /// Its name, such as `shaping/pass`.
    pub name: String,
    /// What it paid in this step.
    pub value: f32,
}
