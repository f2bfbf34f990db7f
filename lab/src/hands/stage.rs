//! A recorded scene's start: everybody's place in each episode, as a scenario's text.

use crate::pitch::LabError;
use setpiece::scenario::vocabulary::Role;
use std::fmt::Write as _;

/// A player as recorded: role, x, y in the frame of the pitch, flags.
type RecordedPlayer = (String, f64, f64, String);

/// A scene as recorded.
#[derive(Clone, Debug, serde::Deserialize)]
pub(super) struct RecordedScene {
    left: Vec<RecordedPlayer>,
    right: Vec<RecordedPlayer>,
    ball: [f64; 2],
    /// Largest offset of an episode's start.
    #[serde(default)]
    jitter: [f64; 2],
    /// Whether the ball moves with the start's offset.
    #[serde(default = "yes")]
    ball_jitter: bool,
    /// Whether odd episodes are mirrored top to bottom.
    #[serde(default)]
    mirror: bool,
    #[serde(default)]
    offside: bool,
    /// Agents of both teams.
    agents: [usize; 2],
}

fn yes() -> bool {
    true
}

impl RecordedScene {
    /// The number of agents, those of the left team first.
    pub(super) fn agents(&self) -> [usize; 2] {
        self.agents
    }

    /// Whether an episode is mirrored top to bottom.
    pub(super) fn mirrored(&self, episode: u64) -> bool {
        self.mirror && episode % 2 == 1
    }

    /// The roles of both teams' players.
    pub(super) fn roles(&self) -> Result<[Vec<Role>; 2], LabError> {
        let of = |players: &[RecordedPlayer]| {
            let roles = players
                .iter()
                .map(|(name, ..)| Role::from_name(name).ok_or_else(|| format!("no role `{name}`")));
            roles.collect::<Result<Vec<_>, _>>()
        };
        Ok([of(&self.left)?, of(&self.right)?])
    }

    /// The scenario of an episode between teams of these difficulties.
    pub(super) fn source(&self, episode: u64, difficulty: [f64; 2]) -> String {
        let offset = offset(episode, self.jitter);
        let mirror = if self.mirrored(episode) { -1.0 } else { 1.0 };
        let place = |x: f64, y: f64, moved: bool| {
            let [dx, dy] = if moved { offset } else { [0.0; 2] };
            format!("({:.5}, {:.5})", x + dx, mirror * (y + dy))
        };
        let mut text = format!(
            "scenario recorded {{\n rules {{ offside: {}, kickoff_circle: off, stochastic: on }}\n agents {{ left: {}, right: {} }}\n ball at {}\n",
            if self.offside { "on" } else { "off" },
            self.agents[0],
            self.agents[1],
            place(self.ball[0], self.ball[1], self.ball_jitter),
        );
        for (name, players, difficulty) in
            [("left", &self.left, difficulty[0]), ("right", &self.right, difficulty[1])]
        {
            let _ = writeln!(text, " team {name} {{ difficulty: {difficulty}");
            for (role, x, y, flags) in players {
                let has = |flag: &str| flags.split_whitespace().any(|word| word == flag);
                let ai = if has("lazy") { "lazy" } else { "bot" };
                let controllable = if has("nobody") { "off" } else { "on" };
                let place = place(*x, *y, has("jitter"));
                let _ = writeln!(
                    text,
                    "  {role} at {place} {{ ai: {ai}, controllable: {controllable} }}"
                );
            }
            text.push_str(" }\n");
        }
        text.push_str(" end limit 3000 steps\n}");
        text
    }
}

/// The offset of an episode's start: a sequence that fills the rectangle evenly.
fn offset(episode: u64, largest: [f64; 2]) -> [f64; 2] {
    let at = |step: f64| 2.0 * (0.5 + (episode + 1) as f64 * step).fract() - 1.0;
    [largest[0] * at(0.754_877_666_2), largest[1] * at(0.569_840_291)]
}
