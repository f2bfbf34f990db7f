//! The keys of an agent: a list of keys, each pressed every step until a condition holds.

use super::trace::{TraceMoment, apart};
use crate::pitch::LabError;
use setpiece::scenario::vocabulary::Action;

/// The eight directions, from the right via the top.
const WAYS: [Action; 8] = [
    Action::Right,
    Action::TopRight,
    Action::Top,
    Action::TopLeft,
    Action::Left,
    Action::BottomLeft,
    Action::Bottom,
    Action::BottomRight,
];

/// The scripted agent shoots when it owns the ball within this distance of the goal, metres.
const SHOT_M: f64 = 16.0;

/// A condition as recorded: a number of steps, or words.
#[derive(Clone, Debug, serde::Deserialize)]
#[serde(untagged)]
enum Until {
    Steps(u32),
    Words(String),
}

/// The presses of one agent.
pub(super) type KeyPlan = Vec<KeyPhase>;

/// A key and how long it is pressed.
#[derive(Clone, Debug, serde::Deserialize)]
pub(super) struct KeyPhase(String, Until);

/// An agent working through a plan.
pub(super) struct Keys<'a> {
    plan: &'a [KeyPhase],
    agent: usize,
    /// 0 left, 1 right.
    team: usize,
    mirrored: bool,
    at: usize,
    pressed: u32,
    /// The scripted agent's held direction, and whether it holds sprint.
    held: Option<Action>,
    sprints: bool,
}

impl<'a> Keys<'a> {
    /// At the start of a plan.
    pub(super) fn new(plan: &'a [KeyPhase], agent: usize, team: usize, mirrored: bool) -> Keys<'a> {
        Keys { plan, agent, team, mirrored, at: 0, pressed: 0, held: None, sprints: false }
    }

    /// The key of the next step.
    pub(super) fn press(&mut self, view: &TraceMoment) -> Result<Action, LabError> {
        while let Some(KeyPhase(_, until)) = self.plan.get(self.at) {
            if self.at + 1 == self.plan.len() || !self.holds(until, view)? {
                break;
            }
            self.at += 1;
            self.pressed = 0;
        }
        let KeyPhase(key, _) = self.plan.get(self.at).ok_or("an agent without keys")?;
        self.pressed += 1;
        let side = if self.team == 0 { 1.0 } else { -1.0 };
        let me = view.player(self.agent, self.team);
        let towards = |[x, y]: [f64; 2]| {
            let eighth =
                (-(y - me[1]) * side).atan2((x - me[0]) * side) / std::f64::consts::FRAC_PI_4;
            WAYS[(eighth.round() as i64).rem_euclid(8) as usize]
        };
        Ok(match key.as_str() {
            "chase" => towards([view.ball[0], view.ball[1]]),
            "goal" => towards([54.4 * side, 0.0]),
            "scripted" => {
                let goal = [54.4 * side, 0.0];
                let owned = view.owned_by(self.team as i8, view.active[self.agent]);
                let way = towards(if owned { goal } else { [view.ball[0], view.ball[1]] });
                if owned && apart(goal, me) < SHOT_M {
                    Action::Shot
                } else if self.held != Some(way) {
                    self.held = Some(way);
                    way
                } else if self.sprints {
                    Action::Idle
                } else {
                    self.sprints = true;
                    Action::Sprint
                }
            }
            key if self.mirrored => mirror(action(key)?),
            key => action(key)?,
        })
    }

    /// Whether a condition holds.
    fn holds(&self, until: &Until, view: &TraceMoment) -> Result<bool, LabError> {
        let words = match until {
            Until::Steps(steps) => return Ok(self.pressed >= *steps),
            Until::Words(words) => words,
        };
        let (word, number) = words.split_once(' ').unwrap_or((words, "0"));
        let number: f64 = number.parse().map_err(|_| format!("`{words}` wants a number"))?;
        let me = view.player(self.agent, self.team);
        let away = |at: &[f64; 2]| (at[0] - me[0]).hypot(at[1] - me[1]);
        let owned = view.owner == self.team as i8;
        Ok(match word {
            "end" => false,
            "owned" | "mine" => owned && view.who == view.active[self.agent],
            "team" => owned,
            "near" => {
                view.teams[1 - self.team].iter().map(away).fold(f64::INFINITY, f64::min) <= number
            }
            "ball" => away(&[view.ball[0], view.ball[1]]) <= number,
            "fast" => view.speed >= number,
            "x" => owned && view.ball[0] * if self.team == 0 { 1.0 } else { -1.0 } >= number * 54.4,
            "stopped" => view.mode != 0,
            "play" => view.mode == 0,
            _ => return Err(format!("no condition `{words}`")),
        })
    }
}

/// The action of a recorded key.
pub(super) fn action(key: &str) -> Result<Action, LabError> {
    Ok(match key {
        "idle" => Action::Idle,
        "long_pass" => Action::LongPass,
        "high_pass" => Action::HighPass,
        "short_pass" => Action::ShortPass,
        "shot" => Action::Shot,
        "sprint" => Action::Sprint,
        "release_direction" => Action::ReleaseDirection,
        "release_sprint" => Action::ReleaseSprint,
        "sliding" => Action::Sliding,
        "dribble" => Action::Dribble,
        "release_dribble" => Action::ReleaseDribble,
        "builtin_ai" => Action::BuiltinAi,
        key => direction(key).ok_or_else(|| format!("no key `{key}`"))?,
    })
}

/// A direction mirrored top to bottom; other keys unchanged.
fn mirror(key: Action) -> Action {
    let at = WAYS.iter().position(|way| *way == key);
    at.map_or(key, |at| WAYS[(8 - at) % 8])
}

/// The action of a direction's name in the recorded files; none for a released one.
fn direction(name: &str) -> Option<Action> {
    Some(match name {
        "right" => Action::Right,
        "left" => Action::Left,
        "top" => Action::Top,
        "bottom" => Action::Bottom,
        "top_right" => Action::TopRight,
        "bottom_right" => Action::BottomRight,
        "top_left" => Action::TopLeft,
        "bottom_left" => Action::BottomLeft,
        _ => return None,
    })
}
