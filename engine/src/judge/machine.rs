//! Runs register programs: rewards, endings and starts.
//!
//! The meaning of every instruction is that of [`setpiece_scenario::program`]. A [`Machine`] borrows all it needs, so
//! running allocates nothing; registers and cells belong to the caller. Programs must have passed
//! [`setpiece_scenario::verify`].

mod fold;
mod operators;

use crate::event::Event;
use crate::judge::view::{View, player_index, player_number, team_number, team_of_number};
use crate::random::Stream;
use crate::state::PlayerId;
use fold::Folding;
pub use operators::truth;
use operators::{binary, unary};
use setpiece_scenario::pitch::STEPS_PER_S;
use setpiece_scenario::program::PAY_MAX;
use setpiece_scenario::vocabulary::{EventField, EventKind, Qualifier, Team};
use setpiece_scenario::{Distribution, Each, EventFilter, Instr, Over, Program, Reg, When, Who};

/// What a program reads.
#[derive(Clone, Copy)]
pub struct Input<'a> {
    /// The state after this step, before any restart.
    pub now: &'a View,
    /// The state that the step before left behind, after its restart.
    pub prev: &'a View,
    /// This step's events.
    pub events: &'a [Event],
    /// The bound parameters.
    pub params: &'a [f64],
    /// The drawn `let`s.
    pub lets: &'a [f64],
    /// The episode's index.
    pub index: u64,
    /// The team judged for.
    pub us: Team,
    /// The agent's player; nobody while he is off the pitch.
    pub me: Option<PlayerId>,
    /// On the start state: temporal instructions see it, effects don't happen.
    pub silent: bool,
}

/// A program at work: its input, and the memory it writes.
pub struct Machine<'a> {
    /// What it reads.
    pub input: Input<'a>,
    /// At least as many registers as the program has instructions.
    pub regs: &'a mut [f64],
    /// The program's memory cells.
    pub cells: &'a mut [f64],
    /// What each term was paid; [`Instr::Give`] adds here.
    pub terms: &'a mut [f64],
    /// Effects that were stopped because their value was impossible.
    pub faults: &'a mut u32,
    /// What draws are keyed by; without it a draw is NaN.
    pub draws: Option<DrawKey>,
}

/// What the draws of one attempt are keyed by, beside their own names.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DrawKey {
    /// The seed.
    pub seed: u64,
    /// The episode's index.
    pub index: u64,
    /// Which attempt at a start that meets its requirements.
    pub attempt: u32,
}

/// Registers of one program, its constants written once: programs begin with them.
#[derive(Clone, Debug, Default)]
pub struct Registers {
    values: Vec<f64>,
    begin: usize,
}

impl Registers {
    /// Registers for a verified program.
    pub fn of(program: &Program) -> Registers {
        let mut values = vec![0.0; program.code.len()];
        let mut begin = 0;
        for (slot, instr) in values.iter_mut().zip(&program.code) {
            let Instr::Const(value) = instr else { break };
            *slot = *value;
            begin += 1;
        }
        Registers { values, begin }
    }

    /// The registers, and where a run begins.
    pub fn parts(&mut self) -> (&mut [f64], usize) {
        (&mut self.values, self.begin)
    }

    /// The value of a register.
    pub fn value(&self, reg: Reg) -> f64 {
        self.values[reg.index()]
    }
}

impl Machine<'_> {
    /// Runs a verified program once; its values stand in `regs` afterwards.
    pub fn run(&mut self, program: &Program) {
        self.run_from(program, 0);
    }

    /// Runs a program whose first instructions have been run before: see [`Registers`].
    pub fn run_from(&mut self, program: &Program, begin: usize) {
        self.block(&program.code, begin, program.code.len(), None);
    }

    /// Computes the values anew after cells were written from outside, but for those of temporal instructions: they
    /// happen once a step.
    pub fn run_again(&mut self, program: &Program) {
        let code = &program.code;
        let mut at = 0;
        while at < code.len() {
            match &code[at] {
                Instr::Each(each) => {
                    self.each(code, at, each, None);
                    at += each.body as usize;
                }
                Instr::Held { .. }
                | Instr::Ever { .. }
                | Instr::Since { .. }
                | Instr::Until { .. }
                | Instr::Once { .. } => {}
                instr => self.regs[at] = self.instr(instr, None),
            }
            at += 1;
        }
    }

    /// The value of a register.
    pub fn value(&self, reg: Reg) -> f64 {
        self.regs[reg.index()]
    }

    fn truth(&self, reg: Reg) -> bool {
        truth(self.value(reg))
    }

    fn allowed(&self, guard: Option<Reg>) -> bool {
        !self.input.silent && guard.is_none_or(|guard| self.truth(guard))
    }

    fn block(&mut self, code: &[Instr], from: usize, to: usize, event: Option<&Event>) {
        let mut at = from;
        while at < to {
            if let Instr::Each(each) = &code[at] {
                self.each(code, at, each, event);
                at += 1 + each.body as usize;
            } else {
                self.regs[at] = self.instr(&code[at], event);
                at += 1;
            }
        }
    }

    fn instr(&mut self, instr: &Instr, event: Option<&Event>) -> f64 {
        match instr {
            Instr::Const(value) => *value,
            Instr::Param(index) => self.input.params.get(*index as usize).copied().unwrap_or(f64::NAN),
            Instr::Let(index) => self.input.lets.get(*index as usize).copied().unwrap_or(f64::NAN),
            Instr::EpisodeIndex => self.input.index as f64,
            Instr::Unary(op, a) => unary(*op, self.value(*a), self.input.now),
            Instr::Binary(op, a, b) => binary(*op, self.value(*a), self.value(*b)),
            Instr::Select(c, a, b) => self.value(if self.truth(*c) { *a } else { *b }),
            Instr::Us => self.input.us.index() as f64,
            Instr::Me => player_number(self.input.me),
            Instr::Load { field, of, when } => {
                let view = match when {
                    When::Now => self.input.now,
                    When::Prev => self.input.prev,
                };
                view.load(*field, of.map_or(0.0, |of| self.value(of)))
            }
            Instr::Event(field) => event.map_or(f64::NAN, |event| event_field(event, *field)),
            Instr::Cell(cell) => self.cells[*cell as usize],
            Instr::Held { .. }
            | Instr::Ever { .. }
            | Instr::Since { .. }
            | Instr::Until { .. }
            | Instr::Once { .. } => self.temporal(instr),
            Instr::Give { term, value, guard } => {
                if self.allowed(*guard) {
                    let value = self.value(*value);
                    if value.abs() <= PAY_MAX {
                        self.terms[*term as usize] += value;
                    } else {
                        *self.faults += 1;
                    }
                }
                0.0
            }
            Instr::Assign { cell, value, guard } => {
                if self.allowed(*guard) {
                    let value = self.value(*value);
                    if value.is_nan() {
                        *self.faults += 1;
                    } else {
                        self.cells[*cell as usize] = value;
                    }
                }
                0.0
            }
            Instr::Random { key, from } => self.draw(*key, from),
            // Loops are run by `block`.
            Instr::Each(_) => 0.0,
        }
    }

    fn temporal(&mut self, instr: &Instr) -> f64 {
        match instr {
            Instr::Held { of, seconds, cell } => {
                let run = if self.truth(*of) { self.cells[*cell as usize] + 1.0 } else { 0.0 };
                self.cells[*cell as usize] = run;
                let steps = libm::round(self.value(*seconds) * STEPS_PER_S).max(1.0);
                (run >= steps && !self.value(*seconds).is_nan()).into()
            }
            Instr::Ever { of, cell } => {
                if self.truth(*of) {
                    self.cells[*cell as usize] = 1.0;
                }
                self.cells[*cell as usize]
            }
            Instr::Since { of, cell } => {
                let held = self.truth(*of);
                let count = &mut self.cells[*cell as usize];
                if held {
                    *count = 1.0;
                } else if *count > 0.0 {
                    *count += 1.0;
                }
                if *count > 0.0 { (*count - 1.0) / STEPS_PER_S } else { f64::INFINITY }
            }
            Instr::Until { of, release, cell } => {
                let (of, release) = (self.truth(*of), self.truth(*release));
                let state = &mut self.cells[*cell as usize];
                if *state == 0.0 {
                    *state = if release {
                        1.0
                    } else if of {
                        0.0
                    } else {
                        2.0
                    };
                }
                (*state != 2.0).into()
            }
            Instr::Once { of, cell } => {
                let first = !self.input.silent && self.truth(*of) && self.cells[*cell as usize] == 0.0;
                if first {
                    self.cells[*cell as usize] = 1.0;
                }
                first.into()
            }
            _ => 0.0,
        }
    }

    fn each(&mut self, code: &[Instr], at: usize, each: &Each, event: Option<&Event>) {
        let (from, to) = (at + 1, at + 1 + each.body as usize);
        let mut folding = Folding::new(each.fold.kind);
        match &each.over {
            Over::Players { team, except } => {
                let wanted = self.value(*team);
                let team = team_of_number(wanted);
                let except = except.and_then(|except| player_index(self.value(except)));
                if team.is_some() || wanted == -1.0 {
                    let now = self.input.now;
                    for (id, _) in now.on_pitch(team).filter(|(id, _)| Some(*id) != except) {
                        self.regs[at] = id as f64;
                        self.block(code, from, to, event);
                        self.fold(each, id as f64, &mut folding);
                    }
                }
            }
            Over::Events(filter) => {
                let events = self.input.events;
                for (number, event) in events.iter().enumerate() {
                    if self.passes(filter, event) {
                        self.regs[at] = number as f64;
                        self.block(code, from, to, Some(event));
                        self.fold(each, number as f64, &mut folding);
                    }
                }
            }
        }
        self.regs[at] = folding.result();
    }

    fn fold(&self, each: &Each, element: f64, folding: &mut Folding) {
        if each.fold.guard.is_none_or(|guard| self.truth(guard)) {
            folding.add(element, each.fold.value.map_or(0.0, |value| self.value(value)));
        }
    }

    fn passes(&self, filter: &EventFilter, event: &Event) -> bool {
        let qualified = match (filter.qualifier, filter.kind) {
            (Some(qualifier), _) => event.qualifier == Some(qualifier),
            // However the episode ends, it ends.
            (None, EventKind::End) => true,
            (None, EventKind::Pass) => event.qualifier == Some(Qualifier::Attempted),
            (None, _) => event.qualifier.is_none(),
        };
        event.kind == filter.kind
            && qualified
            && filter.by.is_none_or(|who| match who {
                Who::Team(reg) => event.team.is_some() && event.team == team_of_number(self.value(reg)),
                Who::Player(reg) => {
                    // An own goal rises the other team's score: it is no goal of its scorer's.
                    let own = event.kind == EventKind::Goal && event.by.map(PlayerId::team) != event.team;
                    is_player(event.by, self.value(reg)) && !own
                }
            })
            && filter.to.is_none_or(|who| match who {
                Who::Team(reg) => event.to.is_some() && event.to.map(PlayerId::team) == team_of_number(self.value(reg)),
                Who::Player(reg) => is_player(event.to, self.value(reg)),
            })
    }

    /// Draws from the stream of a key; the distribution's registers have their present values.
    pub fn draw(&self, key: u64, from: &Distribution) -> f64 {
        let Some(draws) = self.draws else { return f64::NAN };
        let random = &mut Stream::of_draw(draws.seed, draws.index, draws.attempt, key);
        let regs = &*self.regs;
        let value = |reg: &Reg| regs[reg.index()];
        match from {
            Distribution::Uniform(low, high) => {
                let (low, high) = (value(low), value(high));
                low + (high - low) * random.unit_f64()
            }
            Distribution::Normal(mean, sd) => value(mean) + value(sd) * random.normal(),
            Distribution::TruncatedNormal(mean, sd, low, high) => {
                truncated_normal(random, value(mean), value(sd), value(low), value(high))
            }
            Distribution::Integer(low, high) => {
                let (low, high) = (libm::ceil(value(low)), libm::floor(value(high)));
                if low <= high {
                    (low + libm::floor(random.unit_f64() * (high - low + 1.0))).min(high)
                } else {
                    f64::NAN
                }
            }
            Distribution::Weighted(weights) => {
                let weight = |reg: &Reg| value(reg).max(0.0);
                let total: f64 = weights.iter().map(weight).sum();
                let mut left = random.unit_f64() * total;
                let mut chosen = f64::NAN;
                for (index, reg) in weights.iter().enumerate() {
                    if weight(reg) > 0.0 {
                        chosen = index as f64;
                        left -= weight(reg);
                        if left < 0.0 {
                            break;
                        }
                    }
                }
                chosen
            }
        }
    }
}

/// Most attempts at a draw between the ends before the nearer end is taken.
const TRUNCATED_ATTEMPTS: usize = 1000;

fn truncated_normal(random: &mut Stream, mean: f64, sd: f64, low: f64, high: f64) -> f64 {
    if low.is_nan() || high.is_nan() || low > high {
        return f64::NAN;
    }
    for _ in 0..TRUNCATED_ATTEMPTS {
        let value = mean + sd * random.normal();
        if value.is_nan() || (low..=high).contains(&value) {
            return value;
        }
    }
    mean.clamp(low, high)
}

fn is_player(player: Option<PlayerId>, number: f64) -> bool {
    player.is_some_and(|player| player.index() as f64 == number)
}

fn event_field(event: &Event, field: EventField) -> f64 {
    match field {
        EventField::By => player_number(event.by),
        EventField::To => player_number(event.to),
        EventField::X => event.at.x.into(),
        EventField::Y => event.at.y.into(),
        EventField::Length => event.length_m.into(),
        EventField::Speed => event.speed_mps.into(),
        EventField::ByTeam => team_number(event.team),
    }
}

#[cfg(test)]
mod tests;
