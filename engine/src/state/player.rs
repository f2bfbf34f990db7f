//! A player: the public state, and the internal [`Body`] with statistics, intents and what the body
//! does.

use glam::{Vec2, Vec3};
use setpiece_scenario::Ai;
use setpiece_scenario::pitch::{PLAYERS_MAX, TEAM_MAX};
use setpiece_scenario::vocabulary::{Action, Role, Stat, Team};

/// A tick long before every match.
pub const NEVER: i32 = -100_000;

/// A player: `team * 11 + index`.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, serde::Serialize, serde::Deserialize,
)]
#[serde(try_from = "u8")]
pub struct PlayerId(pub u8);

impl TryFrom<u8> for PlayerId {
    type Error = &'static str;

    fn try_from(id: u8) -> Result<PlayerId, &'static str> {
        if usize::from(id) < PLAYERS_MAX {
            Ok(PlayerId(id))
        } else {
            Err("a player's id is below 22")
        }
    }
}

impl PlayerId {
    /// The id of a team's player.
    pub fn new(team: Team, index: usize) -> PlayerId {
        PlayerId((team.index() * TEAM_MAX + index) as u8)
    }

    /// As an index into [`Match::players`](super::Match::players).
    pub const fn index(self) -> usize {
        self.0 as usize
    }

    /// The player's team.
    pub const fn team(self) -> Team {
        if self.index() < TEAM_MAX { Team::Left } else { Team::Right }
    }

    /// The player's index in the team, source order.
    pub const fn in_team(self) -> usize {
        self.index() % TEAM_MAX
    }
}

/// A player's public state. What `football` needs besides is in `body`.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Player {
    /// Whether they are on the pitch: in the squad and not sent off.
    pub active: bool,
    /// The role.
    pub role: Role,
    /// Who plays them if no agent does.
    pub ai: Ai,
    /// Whether an agent may control them.
    pub controllable: bool,
    /// World metres.
    pub pos: Vec2,
    /// m/s.
    pub vel: Vec2,
    /// The direction they face, world radians.
    pub heading_rad: f32,
    /// 0 fresh to 1 exhausted.
    pub fatigue: f32,
    /// Cards so far.
    pub yellow_cards: u8,
    /// 0..1.
    pub difficulty: f32,
    /// The internal state of `football` and `control`.
    pub body: Body,
}

/// A player's internal state.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Body {
    /// Raw statistics by [`Stat::index`], 0..1.
    #[serde(with = "crate::floats")]
    pub stats: [f32; Stat::ALL.len()],
    /// 0.3 + 0.7 · difficulty: the share of their statistics that counts.
    pub level: f32,
    /// Top speed without the ball, m/s.
    pub speed_top_mps: f32,
    /// Metres.
    pub height_m: f32,
    /// Where they stand when their own team kicks off, and when the other team does.
    pub kickoff: [Vec2; 2],
    /// The unit vector that they face, world.
    pub facing: Vec2,
    /// Where they want to go.
    pub intent: Intent,
    /// The velocity that they want with the ball at their feet, world m/s.
    pub dribble: Vec2,
    /// A kick that they want to make, as soon as possible.
    pub kick: Option<KickPlan>,
    /// What the body does.
    pub pose: Pose,
    /// Ticks until the pose ends.
    pub pose_ticks: u8,
    /// How far others have pushed them lately, metres, at most 0.1.
    pub push_m: f32,
    /// Ticks spent so far on setting off.
    pub lag_ticks: i8,
    /// Tick of their last touch.
    pub touched_at: i32,
    /// Tick before which they may not try for the ball: the end of a motion or of a rest.
    pub ready_at: i32,
    /// Tick until which a leg that has kicked follows through.
    pub follows_until: i32,
    /// A leg that is out for the ball: a rival's, a free one or their own.
    pub lunge: Option<Lunge>,
    /// Whether the left foot leads, once their motion is over.
    pub left_leads: bool,
    /// Where they can first meet the ball.
    pub meet: Vec2,
    /// Seconds until then.
    pub meet_s: f32,
    /// Mean speed over about the last ten seconds, m/s.
    pub mean_mps: f32,
    /// The bot's plans for them.
    pub mind: Mind,
}

/// Where a player wants to go.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub enum Intent {
    /// Brake to a stop.
    Stand,
    /// Run at a world velocity, m/s.
    Run(Vec2),
    /// Run to a world point with at most this speed, m/s, and stop there.
    Go(Vec2, f32),
    /// Run to the ball with at most this speed, m/s, and dribble once they have it.
    Ball(f32),
}

/// The pose of a body.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub enum Pose {
    /// On their feet.
    Up,
    /// Losing their balance, towards this speed.
    Stumbling {
        /// 0.1 m/s.
        to_dmps: u8,
    },
    /// Sliding along the ground.
    Sliding,
    /// Lying after a fall, a slide or a dive.
    Down,
    /// A keeper in the air.
    Diving,
}

/// A kind of kick.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub enum KickKind {
    /// On the ground, to a teammate's feet.
    Short,
    /// On the ground, ahead of a teammate.
    Long,
    /// Lofted.
    High,
    /// At goal.
    Shot,
    /// Away, anywhere forward.
    Clear,
}

impl KickKind {
    /// The kick that an action requests.
    pub fn of(action: Action) -> Option<KickKind> {
        match action {
            Action::ShortPass => Some(KickKind::Short),
            Action::LongPass => Some(KickKind::Long),
            Action::HighPass => Some(KickKind::High),
            Action::Shot => Some(KickKind::Shot),
            _ => None,
        }
    }
}

/// A requested kick: it waits for the key's release, then for the ball, then for the swing.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct KickPlan {
    /// What kind.
    pub kind: KickKind,
    /// The direction held now, world, unit; none: the way the player faces.
    pub dir: Option<Vec2>,
    /// The intended receiver, if the bot has chosen one.
    pub mate: Option<PlayerId>,
    /// The target point, if the bot has chosen one.
    pub point: Option<Vec2>,
    /// 0..1 of the power of a bot's shot or of a steered kick; 0 leaves it to the gauge.
    pub power: f32,
    /// Ticks for which the key has been held: the gauge.
    pub gauge_ticks: u8,
    /// Whether the key is held in this step.
    pub held: bool,
    /// Seconds until the player meets the ball, as last computed. A ball that gets away ends the
    /// plan.
    pub meet_s: f32,
    /// The swing, once it has begun.
    pub swing: Option<Swing>,
    /// Tick after which the plan is dropped.
    pub until: i32,
}

/// The swing of a leg, with the kick as planned when it began.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Swing {
    /// The kick that it makes: what is planned, or what it clears the ball with.
    pub kind: KickKind,
    /// First tick at which the foot can meet the ball.
    pub ready_at: i32,
    /// Where the foot or head is to meet the ball, world metres.
    pub place: Vec3,
    /// The way of the ball from there to the target, world metres; none at a set piece that a bot
    /// takes.
    pub way: Option<Vec2>,
    /// The receiver when it began.
    pub mate: Option<PlayerId>,
    /// How fast the player is at its end, 0.1 m/s; [`Swing::RUN`] leaves their run to them.
    pub end_dmps: u8,
    /// How far they still run until then, metres.
    pub left_m: f32,
    /// What the leg can do; none if no swing was chosen: at a set piece, out of the hands.
    pub stroke: Option<Stroke>,
}

/// What a leg can do in a swing.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Stroke {
    /// The share of the player's strength that it uses, 0..1.
    pub power: f32,
    /// How hard it is, 0..1.
    pub hard: f32,
    /// The way that the ball goes most easily, world, unit.
    pub natural: Vec2,
    /// How the body counts as moving at the contact of a shot, world, m/s.
    pub body: Vec2,
}

impl Swing {
    /// The end of a swing in which the player runs as they want.
    pub const RUN: u8 = u8::MAX;
}

/// What a leg does with a ball that it meets.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub enum Aim {
    /// Takes it along.
    Carry,
    /// Pokes it away from a rival.
    Poke,
    /// Slides into it.
    Slide,
}

/// A leg on its way to the ball, and back.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Lunge {
    /// The tick at which the foot is there.
    pub at: i32,
    /// How many ticks before that the leg went out.
    pub out: u8,
    /// How many ticks after that the player is free again.
    pub back: u8,
    /// Whether the other foot leads afterwards.
    pub changes_feet: bool,
    /// What for.
    pub aim: Aim,
    /// Where the ball was expected when it began, world metres. The place moves with a body that is
    /// pushed.
    pub place: Vec3,
    /// Whether the player comes out of it along their old run.
    pub brakes: bool,
    /// How fast they come out of it, 0.1 m/s.
    pub out_dmps: u8,
    /// How fast they are at the touch, 0.1 m/s, if they run straight on until then.
    pub at_dmps: Option<u8>,
    /// The velocity that they wanted when it began, world m/s.
    pub wish: Vec2,
    /// How far the body moves besides its run in each tick before the touch, world metres.
    pub steps_before: Vec2,
    /// The same after the touch.
    pub steps_after: Vec2,
}

impl Lunge {
    /// The tick in which the leg went out.
    pub fn from(&self) -> i32 {
        self.at - i32::from(self.out)
    }

    /// The tick in which the player is free again.
    pub fn until(&self) -> i32 {
        self.at + i32::from(self.back)
    }
}

/// The bot's plans for a player.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Mind {
    /// The slot of their number in the team's block, own frame: x -1 (back) to 1 (front), y -1..1
    /// (+ is down the picture).
    pub slot: Vec2,
    /// The player whose slot and role they fill now.
    pub fills: PlayerId,
    /// The opponent they mark.
    pub mark: Option<PlayerId>,
    /// The step until which they make a run forward.
    pub run_until_step: u32,
    /// Step of their next decision with the ball.
    pub decide_at_step: u32,
}

impl Body {
    /// Whether a leg swings at a ball that doesn't wait for it.
    pub fn swings(&self) -> bool {
        self.kick.is_some_and(|plan| plan.swing.is_some_and(|swing| swing.stroke.is_some()))
    }

    /// An empty body, before `begin` fills it in.
    pub const fn blank() -> Body {
        Body {
            stats: [0.75; Stat::ALL.len()],
            level: 1.0,
            speed_top_mps: 7.8,
            height_m: 1.8,
            kickoff: [Vec2::ZERO; 2],
            facing: Vec2::X,
            intent: Intent::Stand,
            dribble: Vec2::ZERO,
            kick: None,
            pose: Pose::Up,
            pose_ticks: 0,
            push_m: 0.0,
            lag_ticks: 0,
            touched_at: NEVER,
            ready_at: NEVER,
            follows_until: NEVER,
            lunge: None,
            left_leads: false,
            meet: Vec2::ZERO,
            meet_s: 9.0,
            mean_mps: 0.0,
            mind: Mind {
                slot: Vec2::ZERO,
                fills: PlayerId(0),
                mark: None,
                run_until_step: 0,
                decide_at_step: 0,
            },
        }
    }

    /// Takes a pose for this many ticks.
    pub fn strike_pose(&mut self, pose: Pose, ticks: u8) {
        self.pose = pose;
        self.pose_ticks = ticks;
    }
}

impl Player {
    /// Ticks that a knock costs: fewer for a resilient player, exactly `ticks` for the average of
    /// the table.
    pub fn shaken(&self, ticks: f32) -> f32 {
        ticks * (1.3 - 0.4 * self.skill(Stat::Resilience))
    }

    /// Makes the player fall for this many ticks.
    pub fn fall(&mut self, ticks: f32) {
        let ticks = self.shaken(ticks);
        self.body.strike_pose(Pose::Down, ticks as u8);
    }

    /// A statistic's current value: raw · (0.3 + 0.7 difficulty) · (0.7 + 0.3 freshness).
    pub fn skill(&self, stat: Stat) -> f32 {
        self.body.stats[stat.index()] * self.body.level * (1.0 - 0.3 * self.fatigue)
    }

    /// Whether the player is on their feet on the pitch and can act.
    pub fn is_up(&self) -> bool {
        self.active && self.body.pose == Pose::Up
    }

    /// Whether the player is on their feet on the pitch, even if stumbling.
    pub fn is_on_feet(&self) -> bool {
        self.active && matches!(self.body.pose, Pose::Up | Pose::Stumbling { .. })
    }
}
