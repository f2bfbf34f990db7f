//! Turns a scenario, its parameters and a seed into one concrete start.
//!
//! Decides where everybody stands when an episode begins. It runs the scenario's start program,
//! checks the requirements of the author and of the pitch, and redraws everything until all of them
//! hold. `football` decides what a start means for the game.

mod params;
mod place;
mod roster;

pub use params::{draw_params, mutate_params};
pub(crate) use roster::player_name;
pub use roster::{AgentsChoice, Roster, RosterError, SideChoice};

use crate::in_place::clone_in_place;
use crate::judge::machine::{Crew, DrawKey, Input, Machine, Registers, truth};
use crate::judge::view::{player_index, team_of_number};
use crate::physics::Conditions;
use crate::random::Stream;
use crate::start::{Drawn, DrawnAgent, DrawnPlayer};
use crate::state::PlayerId;
use glam::{Vec2, Vec3};
use setpiece_scenario::bounds::start_work;
use setpiece_scenario::pitch::{
    BALL_RADIUS_M, GOALS_MAX, LONGEST_S, PLAYERS_MAX, STEPS_PER_S, YELLOW_CARDS_MAX,
};
use setpiece_scenario::vocabulary::{Rule, Team};
use setpiece_scenario::{Ai, Bindings, PitchSize, PlayerSlot, PlayerStart, Reg, Scenario};
use std::sync::Arc;

/// The most attempts to find a start that meets its requirements.
pub const ATTEMPTS_MAX: u32 = 10_000;
/// The most instructions that are run for one start, so that large programs get fewer attempts.
const WORK_MAX: u64 = 1 << 28;
/// The attempt whose streams toss the coins of `require … with P`. Coins are tossed once per start,
/// so they belong to no attempt.
const COIN_ATTEMPT: u32 = u32::MAX;

/// How often single attempts at a start meet the requirements.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Acceptance {
    /// Attempts made.
    pub attempts: u32,
    /// Attempts that met every requirement.
    pub met: u32,
    /// The requirement that failed most often, if one did, in the author's words or the pitch's.
    pub hardest: Option<String>,
    /// Attempts that each of the author's requirements refused, in order. Each attempt counts for
    /// the first that it fails.
    pub refused: Vec<u32>,
}

impl Acceptance {
    /// The share of attempts that met every requirement, 0..1.
    pub fn rate(&self) -> f64 {
        f64::from(self.met) / f64::from(self.attempts.max(1))
    }
}

/// No start was found that meets the requirements.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{} (seed {seed}, episode {index})", self.what())]
pub struct DrawError {
    /// The requirement that failed most often, in the author's words or the pitch's.
    pub requirement: String,
    /// In how many attempts it failed.
    pub failures: u32,
    /// How many attempts were made.
    pub attempts: u32,
    /// The seed.
    pub seed: u64,
    /// The episode's index.
    pub index: u64,
}

impl DrawError {
    fn what(&self) -> String {
        let DrawError { requirement, failures, attempts, .. } = self;
        match attempts {
            1 => format!("no start: `{requirement}` does not hold"),
            _ => format!(
                "no start in {attempts} attempts: `{requirement}` failed in {failures} of them"
            ),
        }
    }
}

/// Draws starts of one scenario. It keeps its registers, so that a draw allocates little.
#[derive(Debug, Default)]
pub struct Drawer {
    regs: Registers,
    failures: Vec<u32>,
    /// Whether a register depends on a draw; shared by the copies of an environment.
    random: Arc<[bool]>,
    attempts_max: u32,
    /// Of which round it draws the start, from 1 on.
    round: u32,
}

clone_in_place! {
    Drawer { regs, failures, random, attempts_max, round }
}

impl Drawer {
    /// Prepares the draws of a scenario.
    pub fn new(scenario: &Scenario) -> Drawer {
        let program = &scenario.start.program;
        let mut random: Vec<bool> = Vec::with_capacity(program.code.len());
        for instr in &program.code {
            let mut tainted = matches!(instr, setpiece_scenario::Instr::Random { .. });
            instr.operands(&mut |reg| {
                tainted |= random.get(reg.index()).copied().unwrap_or_default();
            });
            random.push(tainted);
        }
        Drawer {
            regs: Registers::of(program),
            failures: vec![0; scenario.start.requires.len() + place::PlaceFault::ALL.len()],
            random: random.into(),
            attempts_max: (WORK_MAX / start_work(scenario)).clamp(1, ATTEMPTS_MAX.into()) as u32,
            round: 1,
        }
    }

    /// Draws the start of an episode.
    ///
    /// # Errors
    /// [`DrawError`] if no attempt met every requirement.
    ///
    /// # Determinism
    /// Depends only on its arguments. A new draw in the scenario doesn't change the others.
    pub fn draw(
        &mut self,
        scenario: &Scenario,
        bindings: &Bindings,
        roster: &Roster,
        seed: u64,
        index: u64,
    ) -> Result<Drawn, DrawError> {
        self.draw_round(scenario, bindings, roster, (seed, index), 1)
    }

    /// Draws the start of a round of an episode; that of the first one is [`Self::draw`]'s.
    ///
    /// # Errors
    /// [`DrawError`] if no attempt met every requirement.
    pub fn draw_round(
        &mut self,
        scenario: &Scenario,
        bindings: &Bindings,
        roster: &Roster,
        (own_seed, index): (u64, u64),
        round: u32,
    ) -> Result<Drawn, DrawError> {
        let seed = Stream::seed_of_round(own_seed, round);
        self.round = round;
        self.failures.fill(0);
        self.begin(bindings, DrawKey { seed, index, attempt: 0 });
        let attempts = if self.random.contains(&true) { self.attempts_max } else { 1 };
        for attempt in 0..attempts {
            self.run(bindings, DrawKey { seed, index, attempt });
            match self.failed(scenario, roster, seed, index) {
                None => return Ok(self.start(scenario, roster, seed, index)),
                Some(which) => {
                    self.failures[which] += 1;
                    if !self.is_drawn(scenario, which) {
                        return Err(self.error(scenario, own_seed, index, 1));
                    }
                }
            }
        }
        Err(self.error(scenario, own_seed, index, attempts))
    }

    /// Estimates how often an attempt at a start succeeds, with one attempt for each of many
    /// episodes.
    ///
    /// - `attempts`: the most attempts.
    /// - `enough`: the estimate ends after this many successes.
    pub fn acceptance(
        &mut self,
        scenario: &Scenario,
        bindings: &Bindings,
        roster: &Roster,
        attempts: u32,
        enough: u32,
    ) -> Acceptance {
        self.failures.fill(0);
        let attempts = attempts.min(self.attempts_max);
        let mut found = Acceptance { attempts: 0, met: 0, hardest: None, refused: Vec::new() };
        while found.attempts < attempts && found.met < enough {
            let index = u64::from(found.attempts);
            let draws = DrawKey { seed: 0, index, attempt: 0 };
            self.begin(bindings, draws);
            self.run(bindings, draws);
            match self.failed(scenario, roster, 0, index) {
                None => found.met += 1,
                Some(which) => self.failures[which] += 1,
            }
            found.attempts += 1;
        }
        if found.met < found.attempts {
            found.hardest = Some(self.error(scenario, 0, 0, found.attempts).requirement);
        }
        found.refused = self.failures[..scenario.start.requires.len()].to_vec();
        found
    }

    /// Whether a requirement may hold in another attempt.
    fn is_drawn(&self, scenario: &Scenario, which: usize) -> bool {
        scenario.start.requires.get(which).is_none_or(|require| self.is_random(require.condition))
    }

    /// Describes why no start was found.
    fn error(&self, scenario: &Scenario, seed: u64, index: u64, attempts: u32) -> DrawError {
        let (which, failures) = self
            .failures
            .iter()
            .copied()
            .enumerate()
            // The first of equals, so that the message is stable.
            .fold((0, 0), |best, (which, n)| if n > best.1 { (which, n) } else { best });
        let requirement = match scenario.start.requires.get(which) {
            Some(require) => require.label.clone(),
            None => {
                place::PlaceFault::ALL[which - scenario.start.requires.len()].words().to_owned()
            }
        };
        DrawError { requirement, failures, attempts, seed, index }
    }

    /// A start that wasn't checked against the requirements, for use before the first episode.
    pub fn draw_unchecked(
        &mut self,
        scenario: &Scenario,
        bindings: &Bindings,
        roster: &Roster,
    ) -> Drawn {
        let draws = DrawKey { seed: 0, index: 0, attempt: 0 };
        self.begin(bindings, draws);
        self.run(bindings, draws);
        self.start(scenario, roster, 0, 0)
    }

    /// Computes what no draw changes.
    fn begin(&mut self, bindings: &Bindings, draws: DrawKey) {
        let mut faults = 0;
        self.machine(bindings, draws, &mut faults).begin();
    }

    /// Runs the start program for an attempt.
    fn run(&mut self, bindings: &Bindings, draws: DrawKey) {
        let mut faults = 0;
        self.machine(bindings, draws, &mut faults).run();
    }

    /// The machine of the start program. Its values are in the registers afterwards.
    fn machine<'a>(
        &'a mut self,
        bindings: &'a Bindings,
        draws: DrawKey,
        faults: &'a mut u32,
    ) -> Machine<'a> {
        let (plan, regs, points) = self.regs.parts();
        Machine {
            input: Input {
                now: None,
                prev: None,
                events: &[],
                params: &bindings.0,
                lets: &[],
                index: draws.index,
                round: self.round,
                round_start: 0,
                us: Team::Left,
                terminated: false,
                silent: false,
            },
            crew: Crew::one(None),
            plan,
            regs,
            points,
            cells: &mut [],
            terms: &mut [],
            faults,
            draws: Some(draws),
        }
    }

    /// The requirement that this attempt fails, if any; the author's are checked before the
    /// pitch's.
    fn failed(&self, scenario: &Scenario, roster: &Roster, seed: u64, index: u64) -> Option<usize> {
        let requires = &scenario.start.requires;
        let own = (0..requires.len()).find(|&which| self.is_unmet(scenario, which, seed, index));
        own.or_else(|| {
            self.misplaced(scenario, roster).map(|fault| requires.len() + fault as usize)
        })
    }

    /// Whether the last attempt at the start of an episode fails one of the author's requirements.
    ///
    /// - `which`: its place among them; no other one is failed.
    pub fn is_unmet(&self, scenario: &Scenario, which: usize, seed: u64, index: u64) -> bool {
        scenario.start.requires.get(which).is_some_and(|require| {
            let asked = require.probability.is_none_or(|probability| {
                let coin = Stream::of_draw(seed, index, COIN_ATTEMPT, which as u64).unit_f64();
                coin < self.value(probability)
            });
            asked && !truth(self.value(require.condition))
        })
    }

    /// What a register of the start program held in the last draw, if it has that register.
    pub fn register(&self, reg: Reg) -> Option<f64> {
        (reg.index() < self.random.len()).then(|| self.value(reg))
    }

    fn value(&self, reg: Reg) -> f64 {
        self.regs.value(reg)
    }

    fn optional(&self, reg: Option<Reg>) -> f64 {
        reg.map_or(0.0, |reg| self.value(reg))
    }

    fn is_random(&self, reg: Reg) -> bool {
        self.random.get(reg.index()).copied().unwrap_or_default()
    }

    fn point(&self, (x, y): (Reg, Reg)) -> Vec2 {
        Vec2::new(self.value(x) as f32, self.value(y) as f32)
    }

    /// Where a player stands: on the pitch or its rim, even if a compiled file says otherwise.
    fn place(&self, pitch: &PitchSize, at: (Reg, Reg)) -> Vec2 {
        let (x, y) = pitch.rim();
        let rim = Vec2::new(x as f32, y as f32);
        self.point(at).clamp(-rim, rim)
    }

    fn vector(&self, vector: Option<(Reg, Reg, Reg)>) -> Vec3 {
        vector.map_or(Vec3::ZERO, |(x, y, z)| {
            Vec3::new(self.value(x) as f32, self.value(y) as f32, self.value(z) as f32)
        })
    }

    fn share(&self, reg: Reg) -> f32 {
        let value = self.value(reg) as f32;
        if value.is_nan() { 0.0 } else { value.clamp(0.0, 1.0) }
    }

    fn steps(&self, seconds: Reg) -> u32 {
        // The cast saturates: nothing below 0.
        libm::round(self.value(seconds).min(LONGEST_S) * STEPS_PER_S) as u32
    }

    /// The concrete start that the registers describe.
    fn start(&self, scenario: &Scenario, roster: &Roster, seed: u64, index: u64) -> Drawn {
        let start = &scenario.start;
        let mut rules: [f64; Rule::ALL.len()] =
            std::array::from_fn(|i| Rule::ALL[i].default_value());
        for setting in &start.rules {
            rules[setting.rule.index()] = self.value(setting.value);
        }
        let goals = |reg: Reg| (self.value(reg) as u16).min(GOALS_MAX);
        let height_m = self.optional(start.ball.height).max(0.0) as f32 + BALL_RADIUS_M as f32;
        let pitch = self.pitch(scenario);
        let difficulty = start.difficulty.map(|reg| self.share(reg));
        Drawn {
            seed,
            index,
            players: self.players(scenario, roster, &pitch, difficulty),
            ball_pos: self.point((start.ball.x, start.ball.y)).extend(height_m),
            ball_vel: self.vector(start.ball.velocity),
            ball_spin: self.vector(start.ball.spin),
            owner: start.ball.owner.and_then(|owner| {
                let index = player_index(self.value(owner))?;
                self.takes_part(scenario, index).then_some(PlayerId(index as u8))
            }),
            kind: start.kind,
            taker: start.taker.and_then(|taker| team_of_number(self.value(taker))),
            first_kickoff: start
                .kickoff
                .as_ref()
                .and_then(|kickoff| team_of_number(self.value(kickoff.first))),
            score: start.score.map_or([0; 2], |(left, right)| [goals(left), goals(right)]),
            elapsed_steps: start.elapsed.map_or(0, |elapsed| self.steps(elapsed)),
            difficulty,
            rules,
            conditions: Conditions::with(
                start.world.iter().map(|setting| (setting.figure, self.value(setting.value))),
            ),
            pitch,
            limit_steps: start.limit.map(|limit| self.steps(limit)),
            rounds: start.rounds.map_or(1, |rounds| self.value(rounds).max(1.0) as u32),
            steps_before: 0,
            others: scenario.agents.others,
            agents: roster.agents.iter().map(|&(team, fixed)| DrawnAgent { team, fixed }).collect(),
            lets: start.lets.iter().map(|&reg| self.value(reg)).collect(),
        }
    }

    /// How large the pitch is in the latest attempt, whether it meets the requirements or not.
    pub fn pitch(&self, scenario: &Scenario) -> PitchSize {
        let settings = scenario.start.pitch.iter();
        PitchSize::with(
            settings.filter_map(|setting| Some((setting.figure, self.register(setting.value)?))),
        )
    }

    /// Whether a player takes part in this episode.
    fn takes_part(&self, scenario: &Scenario, id: usize) -> bool {
        let mut of_both = Team::ALL.iter().flat_map(|team| scenario.team(*team));
        of_both.any(|(other, slot)| other == id && self.is_active(&slot.start))
    }

    /// Whether the parameters let a player take part.
    fn is_present(&self, start: &PlayerStart) -> bool {
        start.present.is_none_or(|present| truth(self.value(present)))
    }

    /// Whether they take part in this episode.
    fn is_active(&self, start: &PlayerStart) -> bool {
        self.is_present(start) && start.active.is_none_or(|active| truth(self.value(active)))
    }

    fn played_by(&self, slot: &PlayerSlot) -> Ai {
        let mut sometimes = slot.sometimes.iter();
        sometimes.find(|(when, _)| truth(self.value(*when))).map_or(slot.ai, |(_, ai)| *ai)
    }

    fn players(
        &self,
        scenario: &Scenario,
        roster: &Roster,
        pitch: &PitchSize,
        difficulty: [f32; 2],
    ) -> [Option<DrawnPlayer>; PLAYERS_MAX] {
        let mut players = [const { None }; PLAYERS_MAX];
        let mut place_of = scenario.start.kickoff.iter().flat_map(|kickoff| &kickoff.places);
        for team in Team::ALL {
            for (id, slot) in scenario.team(*team) {
                // In roster order, as the places are.
                let kickoff = place_of
                    .next()
                    .map(|at| [self.place(pitch, at.kicking), self.place(pitch, at.receiving)]);
                let start = &slot.start;
                // Of those who share a place, the one who takes part; the first if nobody does.
                if id >= PLAYERS_MAX
                    || !roster.present[id]
                    || !self.is_present(start)
                    || players[id].is_some() && !self.is_active(start)
                {
                    continue;
                }
                players[id] = Some(DrawnPlayer {
                    role: slot.role,
                    ai: self.played_by(slot),
                    controllable: slot.controllable,
                    active: self.is_active(start),
                    pos: self.place(pitch, (start.x, start.y)),
                    vel: start.velocity.map_or(Vec2::ZERO, |velocity| self.point(velocity)),
                    heading_rad: start.heading.map(|heading| self.value(heading) as f32),
                    fatigue: start.fatigue.map_or(0.0, |fatigue| self.share(fatigue)),
                    yellow_cards: (self.optional(start.yellow_cards) as u8).min(YELLOW_CARDS_MAX),
                    difficulty: start
                        .difficulty
                        .map_or(difficulty[team.index()], |own| self.share(own)),
                    stats: slot.stats.iter().map(|&(stat, reg)| (stat, self.share(reg))).collect(),
                    kickoff,
                });
            }
        }
        players
    }
}

#[cfg(test)]
mod tests;
