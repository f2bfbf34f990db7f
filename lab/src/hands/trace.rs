//! An episode step by step, as an agent of Google Research Football sees it.

use super::keys::{KeyPlan, Keys};
use super::stage::RecordedScene;
use crate::pitch::{LabError, Trial, script};
use setpiece::engine::state::{Match, PlayerId};
use setpiece::scenario::vocabulary::{Action, Role, Team};

/// Modes in which the drop-in shows a ball without an owner.
const OWNERLESS: [usize; 5] = [1, 2, 3, 4, 6];
/// The mode of a kick-off, which the drop-in shows as play.
const KICK_OFF: usize = 1;
/// Steps after which a pending set piece is taken for the agents.
const STALLED: u32 = 20;
/// Steps after which its taker is sent the other way.
const TURNING: u32 = 30;

/// One moment; metres in the frame of the pitch, y towards the bottom.
#[derive(Clone, Debug)]
pub(super) struct TraceMoment {
    /// Place of the ball; the last is its height.
    pub(super) ball: [f64; 3],
    /// Its current horizontal velocity, m/s.
    pub(super) vel: [f64; 2],
    /// Its horizontal speed since the last moment, m/s.
    pub(super) speed: f64,
    /// The owner's team: -1 nobody, 0 left, 1 right.
    pub(super) owner: i8,
    /// The owner's index in the team.
    pub(super) who: usize,
    /// `game_mode`.
    pub(super) mode: usize,
    /// Players of both teams.
    pub(super) teams: [Vec<[f64; 2]>; 2],
    /// Roles of both teams.
    pub(super) roles: [Vec<Role>; 2],
    /// Each agent's press in the step that led here; empty at the start.
    pub(super) pressed: Vec<Action>,
    /// Each agent's player: the index in its team.
    pub(super) active: Vec<usize>,
    /// Goals.
    pub(super) score: [u16; 2],
}

impl TraceMoment {
    fn of(game: &Match, pressed: Vec<Action>, before: Option<&TraceMoment>) -> TraceMoment {
        let ball = game.ball.pos.to_array().map(f64::from);
        let team = |team| {
            let ids = game.squad.of(team).ids();
            ids.map(|id| game.player(id)).map(|p| (p.pos.to_array().map(f64::from), p.role)).unzip()
        };
        let (left, left_roles) = team(Team::Left);
        let (right, right_roles) = team(Team::Right);
        let mode = game.mode.index();
        let owner = game.owner.filter(|_| !OWNERLESS.contains(&mode));
        TraceMoment {
            ball,
            vel: game.ball.vel.truncate().to_array().map(f64::from),
            speed: before.map_or(0.0, |b| (ball[0] - b.ball[0]).hypot(ball[1] - b.ball[1]) * 10.0),
            owner: owner.map_or(-1, |id| i8::from(id.team() == Team::Right)),
            who: owner.map_or(usize::MAX, PlayerId::in_team),
            mode: if mode == KICK_OFF { 0 } else { mode },
            teams: [left, right],
            roles: [left_roles, right_roles],
            pressed,
            active: game
                .agents
                .iter()
                .map(|slot| slot.player.map_or(0, PlayerId::in_team))
                .collect(),
            score: game.score,
        }
    }

    /// Where an agent's player is.
    pub(super) fn player(&self, agent: usize, team: usize) -> [f64; 2] {
        self.teams[team][self.active[agent]]
    }

    /// How far a place is from the ball.
    pub(super) fn ball_from(&self, at: [f64; 2]) -> f64 {
        (self.ball[0] - at[0]).hypot(self.ball[1] - at[1])
    }

    /// Whether a team's player has the ball.
    pub(super) fn owned_by(&self, team: i8, player: usize) -> bool {
        self.owner == team && self.who == player
    }

    /// The ball's current horizontal speed, m/s.
    pub(super) fn velocity(&self) -> f64 {
        self.vel[0].hypot(self.vel[1])
    }

    /// The ball's direction, degrees, positive towards the top.
    pub(super) fn degrees(&self) -> f64 {
        (-self.vel[1]).atan2(self.vel[0]).to_degrees()
    }

    /// The index of a team's player nearest to a place, among those that count.
    pub(super) fn nearest(
        &self,
        team: usize,
        at: [f64; 2],
        counts: impl Fn(usize) -> bool,
    ) -> usize {
        let players = self.teams[team].iter().enumerate().filter(|(i, _)| counts(*i));
        players
            .min_by(|(_, a), (_, b)| apart(**a, at).total_cmp(&apart(**b, at)))
            .map_or(0, |(i, _)| i)
    }
}

/// 1 for true, 0 for false.
pub(super) fn yes(holds: bool) -> f64 {
    f64::from(u8::from(holds))
}

/// The first step from one on in which a condition holds.
pub(super) fn first(
    trace: &[TraceMoment],
    from: usize,
    holds: impl Fn(&TraceMoment) -> bool,
) -> Option<usize> {
    trace.iter().enumerate().skip(from).find(|(_, view)| holds(view)).map(|(step, _)| step)
}

/// The first step in which a kicked ball is under way: nobody owns it, and it moved faster than 9
/// m/s.
pub(super) fn leaves(trace: &[TraceMoment]) -> Option<usize> {
    first(trace, 1, |view| view.owner == -1 && view.speed > 9.0)
}

/// The speed of a left player in the step to this one, m/s.
pub(super) fn pace(trace: &[TraceMoment], step: usize, player: usize) -> Option<f64> {
    let before = trace.get(step.checked_sub(1)?)?;
    Some(apart(trace.get(step)?.teams[0][player], before.teams[0][player]) * 10.0)
}

/// The distance of two places.
pub(super) fn apart(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

/// The settings of one episode.
pub(super) struct Take<'a> {
    pub(super) scene: &'a RecordedScene,
    pub(super) plans: &'a [KeyPlan],
    pub(super) difficulty: [f64; 2],
    pub(super) steps: u32,
    pub(super) stop: &'a [String],
}

/// Plays an episode: the start, then every step.
pub(super) fn play(take: &Take<'_>, episode: u64) -> Result<Vec<TraceMoment>, LabError> {
    let mut trial = Trial::new(script(&take.scene.source(episode, take.difficulty))?, episode)?;
    let left = take.scene.agents()[0];
    let mirrored = take.scene.mirrored(episode);
    let mut hands: Vec<Keys<'_>> = take
        .plans
        .iter()
        .enumerate()
        .map(|(agent, plan)| Keys::new(plan, agent, usize::from(agent >= left), mirrored))
        .collect();
    let mut trace = vec![TraceMoment::of(trial.state(), Vec::new(), None)];
    let mut waiting = 0;
    for _ in 0..take.steps {
        let view = &trace[trace.len() - 1];
        let mut actions =
            hands.iter_mut().map(|hand| hand.press(view)).collect::<Result<Vec<_>, _>>()?;
        if waiting >= STALLED {
            for (agent, action) in actions.iter_mut().enumerate() {
                *action = hurried(view, agent, usize::from(agent >= left), waiting);
            }
        }
        if !trial.step_all(&actions)? {
            break;
        }
        let next = TraceMoment::of(trial.state(), actions, Some(view));
        waiting = if next.mode == 0 { 0 } else { waiting + 1 };
        trace.push(next);
        if stops(&trace, take.stop)? {
            break;
        }
    }
    Ok(trace)
}

/// The drop-in's press for an agent while a set piece waits for too long.
fn hurried(view: &TraceMoment, agent: usize, team: usize, waiting: u32) -> Action {
    if waiting == STALLED {
        return Action::ShortPass;
    }
    match view.owned_by(team as i8, view.active[agent]) {
        true if waiting < TURNING => Action::Right,
        true => Action::Left,
        false => Action::Idle,
    }
}

/// Whether an episode stops here.
fn stops(trace: &[TraceMoment], words: &[String]) -> Result<bool, LabError> {
    let now = trace.len() - 1;
    for words in words {
        let (word, number) = words.split_once(' ').unwrap_or((words, "0"));
        let number: usize = number.parse().map_err(|_| format!("`{words}` wants a number"))?;
        let past = |first: Option<usize>| first.is_some_and(|first| now >= first + number);
        let owned =
            |team: i8| trace.iter().skip(1).position(|view| view.owner == team).map(|at| at + 1);
        let holds = match word {
            "goal" => trace[now].score != trace[0].score,
            "out" => trace[now].mode != 0,
            "lost" => past(owned(1)),
            "won" => past(owned(0)),
            "over" => {
                let stopped = trace.iter().position(|view| view.mode != 0);
                past(stopped.and_then(|from| {
                    trace[from..].iter().position(|view| view.mode == 0).map(|at| at + from)
                }))
            }
            _ => return Err(format!("no stop `{words}`")),
        };
        if holds {
            return Ok(true);
        }
    }
    Ok(false)
}
