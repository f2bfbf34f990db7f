//! The compiled scenario.

use crate::behavior::{Behavior, ScriptArg};
use crate::dimension::Dimension;
use crate::module::ScriptModule;
use crate::named::NamedValue;
use crate::params::Param;
use crate::program::{Program, Reg};
use crate::vocabulary::{PitchFigure, Role, Rule, StartKind, Stat, Team, Verdict, WorldFigure};
use serde::{Deserialize, Serialize};

/// A compiled scenario: self-contained, with its parameters still symbolic.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Scenario {
    /// The name in the file.
    pub name: String,
    /// The documentation written above it; its first line is the title.
    #[serde(default)]
    pub doc: String,
    /// The parameters, in source order, the parents' first.
    #[serde(default)]
    pub params: Vec<Param>,
    /// Rhai scripts, by the ids that rewards, endings and players use.
    #[serde(default)]
    pub scripts: Vec<Script>,
    /// The roster: the left team's players before the right's, each in source order, at most 11 a
    /// team.
    pub players: Vec<PlayerSlot>,
    /// Who is controlled by agents.
    pub agents: Agents,
    /// How an episode starts.
    pub start: Start,
    /// The rewards that are paid unless the user requests others.
    #[serde(default)]
    pub rewards: Vec<Reward>,
    /// Other named rewards in scope whose parameters all have defaults; `--reward NAME` can request
    /// them.
    #[serde(default)]
    pub library: Vec<Reward>,
    /// When an episode ends.
    pub endings: Endings,
    /// The metrics of an episode.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub records: Vec<Record>,
    /// The scenario's own observation, if it declares one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub observation: Option<Observation>,
    /// What scripted players do, by the ids that players use.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub behaviors: Vec<Behavior>,
}

impl Scenario {
    /// The first line of the documentation.
    pub fn title(&self) -> &str {
        self.doc.lines().next().unwrap_or_default()
    }

    /// The players of a team with their ids (`team * 11 + index`), in source order.
    pub fn team(&self, team: Team) -> impl Iterator<Item = (usize, &PlayerSlot)> {
        self.seats(team).flat_map(|(id, slots)| slots.iter().map(move |slot| (id, slot)))
    }

    /// A team's places with their ids, and who may have each: one player, or several, and at most
    /// one of them takes part in an episode.
    pub fn seats(&self, team: Team) -> impl Iterator<Item = (usize, &[PlayerSlot])> {
        let base = team.index() * crate::pitch::TEAM_MAX;
        // The left team comes first.
        let from = self.players.partition_point(|slot| slot.team < team);
        let to = self.players.partition_point(|slot| slot.team <= team);
        let of_team = self.players.get(from..to).unwrap_or_default();
        let seats = of_team.chunk_by(|_, next| next.instead);
        seats.enumerate().map(move |(seat, slots)| (base + seat, slots))
    }

    /// A reward by its name, among those paid and those in scope.
    pub fn reward(&self, name: &str) -> Option<&Reward> {
        self.library.iter().chain(&self.rewards).find(|reward| reward.name == name)
    }
}

/// A Rhai script, embedded.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Script {
    /// The path as written, for messages.
    pub name: String,
    /// Line and column of the file at which the text begins, from 1.
    #[serde(default = "at_the_top")]
    pub at: (u32, u32),
    /// The text.
    pub source: String,
    /// What it may read by name.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub named: Vec<NamedValue>,
    /// The modules that it imports, and those that they import.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub modules: Vec<ScriptModule>,
}

impl Script {
    /// Bytes of its text and its modules.
    pub fn n_bytes(&self) -> usize {
        self.source.len() + self.modules.iter().map(|module| module.source.len()).sum::<usize>()
    }
}

fn at_the_top() -> (u32, u32) {
    (1, 1)
}

/// A player of the roster.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PlayerSlot {
    /// The team.
    pub team: Team,
    /// Whether they share a place in the team with the player before them. An episode has at most
    /// one of the two.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub instead: bool,
    /// The role.
    pub role: Role,
    /// The name before the role, if any. It is also the id of their agent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Who plays them if no agent does.
    #[serde(default)]
    pub ai: Ai,
    /// Who does instead where a register of the start program holds; the first that does.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub sometimes: Vec<(Reg, Ai)>,
    /// Whether an agent may control them.
    pub controllable: bool,
    /// Whether a draw may put them on another player's spot.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub overlap: bool,
    /// Statistics that replace the table's, each a register of the start program, 0..1.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub stats: Vec<(Stat, Reg)>,
    /// Where and how they start.
    pub start: PlayerStart,
}

impl PlayerSlot {
    /// Everyone who may play them.
    pub fn played_by(&self) -> impl Iterator<Item = Ai> {
        self.sometimes.iter().map(|(_, ai)| *ai).chain([self.ai])
    }
}

/// Who plays a player if no agent does.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Ai {
    /// The built-in bot.
    #[default]
    Bot,
    /// Stands still and holds their place, but plays a ball that comes to them.
    Hold,
    /// Brakes to a stop and faces the ball (GRF's `lazy`).
    Lazy,
    /// A behaviour or script of the scenario, by its index in [`Scenario::behaviors`].
    Behavior(u32),
}

/// A player's start; every register belongs to the start program.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PlayerStart {
    /// World x, metres.
    pub x: Reg,
    /// World y, metres.
    pub y: Reg,
    /// World heading, radians; towards the ball if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub heading: Option<Reg>,
    /// World velocity, m/s; 0 if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub velocity: Option<(Reg, Reg)>,
    /// 0 fresh to 1 exhausted; fresh if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub fatigue: Option<Reg>,
    /// Cards at the start; none if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub yellow_cards: Option<Reg>,
    /// Their own difficulty; the team's if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub difficulty: Option<Reg>,
    /// Whether they take part; depends only on parameters. Always if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub present: Option<Reg>,
    /// Whether they are on the pitch in this episode; may be drawn. Always if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub active: Option<Reg>,
}

/// Who is controlled by agents, and what the others do.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Agents {
    /// Left and right.
    pub sides: [SideAgents; 2],
    /// What teammates without an agent do.
    #[serde(default)]
    pub others: Others,
    /// Whether the controlled player changes.
    #[serde(default)]
    pub switching: Switching,
}

/// The agents of a side.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum SideAgents {
    /// This many: a register of the start program that depends only on parameters.
    Count(Reg),
    /// One per controllable player.
    All,
    /// These players, by their index in the team.
    Players(Vec<u8>),
}

/// What teammates without an agent do.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Others {
    /// The bot plays them.
    #[default]
    Bot,
    /// They stand still.
    Hold,
}

/// Whether the controlled player changes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Switching {
    /// By GRF's rules if fewer agents than players are requested, else fixed.
    #[default]
    Auto,
    /// Never.
    Fixed,
}

/// How an episode starts: a program that runs at reset, and the meaning of its registers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Start {
    /// The program; it may draw.
    pub program: Program,
    /// The scenario's `let`s, for step programs.
    #[serde(default)]
    pub lets: Vec<Reg>,
    /// The ball.
    pub ball: BallStart,
    /// The kind of start.
    pub kind: StartKind,
    /// The team that takes it (a team register); the one nearest to the ball if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub taker: Option<Reg>,
    /// Goals at the start, left and right; 0 if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub score: Option<(Reg, Reg)>,
    /// Time on the clock at the start, seconds; 0 if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub elapsed: Option<Reg>,
    /// The layouts of kick-offs; without it kick-offs use the start places.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub kickoff: Option<Kickoff>,
    /// The difficulty of both teams' bots, 0..1.
    pub difficulty: [Reg; 2],
    /// The rules that differ from their defaults, or may.
    #[serde(default)]
    pub rules: Vec<RuleSetting>,
    /// The figures of the world that differ from the usual ones, or may.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub world: Vec<WorldSetting>,
    /// The figures of the pitch that differ from the usual ones, or may.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub pitch: Vec<PitchSetting>,
    /// The episode is truncated after this many seconds; never if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub limit: Option<Reg>,
    /// The number of rounds: one if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rounds: Option<Reg>,
    /// The requirements on a drawn start.
    #[serde(default)]
    pub requires: Vec<Require>,
}

/// The ball's start; every register belongs to the start program.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct BallStart {
    /// World x, metres.
    pub x: Reg,
    /// World y, metres.
    pub y: Reg,
    /// Height of its lowest point above the ground, metres; 0 if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub height: Option<Reg>,
    /// World velocity, m/s; 0 if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub velocity: Option<(Reg, Reg, Reg)>,
    /// World spin, rad/s; 0 if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub spin: Option<(Reg, Reg, Reg)>,
    /// A player register: the owner at the start.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub owner: Option<Reg>,
}

/// The layouts of kick-offs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Kickoff {
    /// The team that kicks off first: a team register. The start places already follow it.
    pub first: Reg,
    /// One entry per player of the roster, in its order.
    pub places: Vec<KickoffPlaces>,
}

/// Where a player stands at a kick-off, world metres, as registers of the start program.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct KickoffPlaces {
    /// When their team kicks off.
    pub kicking: (Reg, Reg),
    /// When the other team does.
    pub receiving: (Reg, Reg),
}

/// A rule and its value, a register of the start program that depends only on parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct RuleSetting {
    /// Which rule.
    pub rule: Rule,
    /// Its value; see [`Rule::default_value`].
    pub value: Reg,
}

/// A figure of the world and its value, a register of the start program, which may be drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct WorldSetting {
    /// Which figure.
    pub figure: WorldFigure,
    /// Its value; see [`WorldFigure::usual`] and [`WorldFigure::range`].
    pub value: Reg,
}

/// A figure of the pitch and its value, a register of the start program, which may be drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PitchSetting {
    /// Which figure.
    pub figure: PitchFigure,
    /// Its value, metres; see [`PitchFigure::usual`] and [`PitchFigure::range`].
    pub value: Reg,
}

/// A requirement on a drawn start.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Require {
    /// What must hold.
    pub condition: Reg,
    /// The probability that it is required; always if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub probability: Option<Reg>,
    /// The author's words: the label, else the text of the condition.
    pub label: String,
}

/// A reward, evaluated in every step for each agent.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Reward {
    /// The name in reports of its terms: the `as` name, else the reward's own.
    pub name: String,
    /// The first lines of its documentation.
    #[serde(default)]
    pub doc: String,
    /// The programs.
    pub body: RewardBody,
}

impl Reward {
    /// The names of its terms: `reward/label`.
    pub fn term_names(&self) -> impl Iterator<Item = String> + '_ {
        self.body.terms.iter().map(|label| format!("{}/{label}", self.name))
    }
}

/// The programs of a reward. The weight is already multiplied in.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct RewardBody {
    /// Runs once at reset: assigns the `state` cells.
    pub init: Program,
    /// Runs in every step; shares its cells with `init`.
    pub step: Program,
    /// The labels of the terms, in source order.
    pub terms: Vec<String>,
    /// Scripts whose values the step reads.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub hooks: Vec<RewardHook>,
}

/// A script's `reward` hook: called before the reward's step, which finds its result in cells.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct RewardHook {
    /// The script.
    pub script: u32,
    /// The cell for its result; the first of them if it has several terms.
    pub cell: u32,
    /// The keys of the map that the hook returns, each with a cell of its own, in their order. A
    /// hook without them returns a number.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub terms: Vec<String>,
    /// The reward's arguments, which are fixed for an episode; `ctx.params` has them in addition to
    /// the scenario's parameters.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub args: Vec<ScriptArg>,
}

impl RewardHook {
    /// The cells of its result.
    pub fn cells(&self) -> std::ops::Range<u32> {
        self.cell..self.cell.saturating_add(self.terms.len().max(1) as u32)
    }
}

/// When an episode ends: one program, and its conditions in order.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Endings {
    /// Runs in every step, from the side that has agents (`us`), or the left one.
    pub program: Program,
    /// In source order, the parents' first. The first that holds ends the episode.
    pub list: Vec<Ending>,
    /// Whether the round is over, if the episode has several.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub round: Option<Reg>,
    /// Players who are replaced.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub substitutions: Vec<Substitution>,
}

/// A player who is replaced, once in an episode; every register belongs to the endings' program.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Substitution {
    /// Whose place in the team the other one takes: `team * 11 + index`.
    pub player: u8,
    /// When.
    pub when: Reg,
    /// Fatigue of the one who comes on, 0..1; fresh if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub fatigue: Option<Reg>,
    /// Their difficulty, 0..1; as before if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub difficulty: Option<Reg>,
    /// Their statistics, 0..1; the others are as before.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub stats: Vec<(Stat, Reg)>,
}

impl Substitution {
    /// Its registers.
    pub fn regs_mut(&mut self) -> impl Iterator<Item = &mut Reg> {
        let stats = self.stats.iter_mut().map(|(_, reg)| reg);
        let options = self.fatigue.iter_mut().chain(&mut self.difficulty);
        std::iter::once(&mut self.when).chain(options).chain(stats)
    }
}

/// The outcome of an episode that reached its limit.
pub const LIMIT: &str = "limit";
/// The outcome of an episode whose last round is over.
pub const ROUNDS: &str = "rounds";

/// One way to end.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Ending {
    /// Success or failure.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub verdict: Option<Verdict>,
    /// Its name, as in `info["outcome"]`.
    pub label: String,
    /// The condition, a register of the endings' program.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub when: Option<Reg>,
    /// Or a script's `done` hook.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub script: Option<u32>,
}

/// A metric of an episode: a program that runs in every step after the rewards, and the registers
/// of the metric so far.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Record {
    /// Its name, as in `info["records"]`.
    pub name: String,
    /// Runs in every step; once per agent if it reads `me`.
    pub program: Program,
    /// One register, or two for a place.
    pub values: Vec<Reg>,
    /// Whether every step's value is kept instead of the last one's.
    #[serde(default)]
    pub series: bool,
    /// The unit of a quantity; a place is in normalised numbers.
    #[serde(default, skip_serializing_if = "Dimension::is_none")]
    pub unit: Dimension,
}

/// An observation that a scenario declares: a program run for each agent, one register per number.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Observation {
    /// Runs after every step and reset, in the agent's own frame; it has no memory cells. What it
    /// draws is new in every step and for every agent.
    pub program: Program,
    /// The numbers, in order.
    pub values: Vec<ObservedValue>,
    /// How many steps the numbers look back at most. At 0 nothing is kept.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub history: u32,
}

#[allow(clippy::trivially_copy_pass_by_ref, reason = "serde's signature")]
fn is_zero(steps: &u32) -> bool {
    *steps == 0
}

impl Observation {
    /// The registers that are kept in every step, each once.
    pub fn columns(&self) -> Vec<Reg> {
        let all = self.values.iter().flat_map(|value| [Some(value.value), value.delay]);
        let mut columns: Vec<Reg> = all.flatten().collect();
        columns.sort_unstable();
        columns.dedup();
        columns
    }
}

/// A number of an [`Observation`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ObservedValue {
    /// The label, else the author's text; with its age in a stack.
    pub name: String,
    /// Its register.
    pub value: Reg,
    /// How late it is seen, seconds.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub delay: Option<Reg>,
    /// How many steps older than the delay it is.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub ago: u32,
}
