//! Runs register programs: rewards, endings and starts.
//!
//! [`setpiece_scenario::program`] defines the meaning of every instruction. A program runs for
//! several players of a team at once, each in a separate lane. Every register and cell holds `W`
//! numbers, and what is the same for all is computed once. In the same way a loop over numbers, for
//! the points of a grid, runs for [`POINTS`] of them at a time. A [`Machine`] borrows all it needs,
//! so running allocates nothing; registers and cells belong to the caller. Programs must have
//! passed [`setpiece_scenario::verify`].

mod chance;
mod each;
mod fold;
mod plan;

use crate::in_place::clone_in_place;
use crate::judge::view::{Sight, player_number, team_number, team_of_number};
use crate::state::PlayerId;
use crate::state::event::Event;
use plan::{ALWAYS, Op, PlanStep};
pub use plan::{POINTS, Plan};
pub use setpiece_scenario::operators::truth;
use setpiece_scenario::pitch::STEPS_PER_S;
use setpiece_scenario::program::PAY_MAX;
use setpiece_scenario::vocabulary::{EventField, EventKind, Field, Qualifier, Team};
use setpiece_scenario::{BinaryOp, EventFilter, Instr, Program, Reg, UnaryOp, When, Who};
use std::sync::Arc;

/// The input of a program.
#[derive(Clone, Copy)]
pub struct Input<'a> {
    /// The state after this step, before any restart. None in a start program, which may not read
    /// it.
    pub now: Option<Sight<'a>>,
    /// The state that the last step left behind, after its restart.
    pub prev: Option<Sight<'a>>,
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
    /// The round of the episode, from 1 on.
    pub round: u32,
    /// Steps from the episode's start to when it began.
    pub round_start: u32,
    /// Whether the episode terminates in this step; not yet known to endings.
    pub terminated: bool,
    /// Whether this is the start state: temporal instructions see it, but effects don't happen.
    pub silent: bool,
}

/// The occupants of the lanes: their players by number, -1 for nobody.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crew<const W: usize = 1> {
    /// The players.
    pub players: [f64; W],
    /// Which lanes are taken. Effects happen only in these.
    pub seated: [bool; W],
}

impl Crew {
    /// One lane, for a player or for nobody.
    pub fn one(player: Option<PlayerId>) -> Crew {
        Crew { players: [player_number(player)], seated: [true] }
    }
}

/// A running program: its input, and the memory it writes.
pub struct Machine<'a, const W: usize = 1> {
    /// The input.
    pub input: Input<'a>,
    /// The players it runs for.
    pub crew: Crew<W>,
    /// The program.
    pub plan: &'a Plan,
    /// Its registers.
    pub regs: &'a mut [[f64; W]],
    /// The same for loops whose lanes are numbers; empty if there are none.
    pub points: &'a mut [[f64; POINTS]],
    /// The program's memory cells.
    pub cells: &'a mut [[f64; W]],
    /// The payments of each term; [`Instr::Give`] adds here.
    pub terms: &'a mut [[f64; W]],
    /// Effects that were dropped because their value was impossible.
    pub faults: &'a mut u32,
    /// The key of draws; without it a draw is NaN.
    pub draws: Option<DrawKey>,
}

/// The key of one attempt's draws, besides the draw's own key.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DrawKey {
    /// The seed.
    pub seed: u64,
    /// The episode's index.
    pub index: u64,
    /// The number of the attempt at a start that meets its requirements.
    pub attempt: u32,
}

/// A program and its registers.
#[derive(Debug, Default)]
pub struct Registers<const W: usize = 1> {
    plan: Arc<Plan>,
    values: Vec<[f64; W]>,
    points: Vec<[f64; POINTS]>,
}

clone_in_place! {
    Registers<const W: usize> { plan, values, points }
}

impl<const W: usize> Registers<W> {
    /// Creates registers for a verified program.
    pub fn of(program: &Program) -> Registers<W> {
        let plan = Plan::of(program, W);
        let n = program.code.len();
        Registers {
            values: vec![[0.0; W]; n],
            points: vec![[0.0; POINTS]; if plan.has_points() { n } else { 0 }],
            plan: Arc::new(plan),
        }
    }

    /// The parts that a [`Machine`] needs: its plan, registers and points.
    pub fn parts(&mut self) -> (&Plan, &mut [[f64; W]], &mut [[f64; POINTS]]) {
        (&self.plan, &mut self.values, &mut self.points)
    }
}

impl<const W: usize> Registers<W> {
    /// The value of a register, in the first lane.
    pub fn value(&self, reg: Reg) -> f64 {
        self.values[reg.index()][0]
    }
}

impl Machine<'_> {
    /// The value of a register.
    pub fn value(&self, reg: Reg) -> f64 {
        self.regs[reg.index()][0]
    }
}

impl<const W: usize> Machine<'_, W> {
    /// Computes what is the same in every step of an episode, once, before its first
    /// [`Machine::run`].
    pub fn begin(&mut self) {
        self.block(&self.plan.once, None);
    }

    /// Runs the program for a step; its values are then in the registers.
    pub fn run(&mut self) {
        self.block(&self.plan.each_step, None);
    }

    /// Computes the values again after cells were written from outside, except those of temporal
    /// instructions, which run once per step.
    pub fn run_again(&mut self) {
        for step in self.plan.each_step.iter().filter(|step| step.op != Op::Temporal) {
            self.block(std::slice::from_ref(step), None);
        }
    }

    /// The first `N` lanes of a register.
    #[inline]
    fn lanes<const N: usize>(&self, reg: Reg) -> [f64; N] {
        let all = &self.regs[reg.index()];
        each_lane(|lane| all[lane])
    }

    /// Whether a register holds, in the first `N` lanes.
    #[inline]
    fn truths<const N: usize>(&self, reg: Reg) -> [bool; N] {
        let all = &self.regs[reg.index()];
        each_lane(|lane| truth(all[lane]))
    }

    /// The lanes in which an effect happens.
    #[inline]
    fn allowed(&self, guard: u32) -> [bool; W] {
        if self.input.silent {
            return [false; W];
        }
        if guard == ALWAYS {
            return self.crew.seated;
        }
        let holds = self.truths::<W>(Reg(guard));
        each_lane(|lane| self.crew.seated[lane] & holds[lane])
    }

    /// Runs instructions in order.
    fn block(&mut self, steps: &[PlanStep], event: Option<&Event>) {
        let plan = self.plan;
        for step in steps {
            match step.op {
                Op::Add => self.two(step, |a, b| BinaryOp::Add.apply(a, b)),
                Op::Sub => self.two(step, |a, b| BinaryOp::Sub.apply(a, b)),
                Op::Mul => self.two(step, |a, b| BinaryOp::Mul.apply(a, b)),
                Op::Div => self.two(step, |a, b| BinaryOp::Div.apply(a, b)),
                Op::Min => self.two(step, |a, b| BinaryOp::Min.apply(a, b)),
                Op::Max => self.two(step, |a, b| BinaryOp::Max.apply(a, b)),
                Op::Hypot => self.two(step, |a, b| BinaryOp::Hypot.apply(a, b)),
                Op::Lt => self.two(step, |a, b| BinaryOp::Lt.apply(a, b)),
                Op::Le => self.two(step, |a, b| BinaryOp::Le.apply(a, b)),
                Op::Gt => self.two(step, |a, b| BinaryOp::Gt.apply(a, b)),
                Op::Ge => self.two(step, |a, b| BinaryOp::Ge.apply(a, b)),
                Op::Eq => self.two(step, |a, b| BinaryOp::Eq.apply(a, b)),
                Op::And => self.two(step, |a, b| BinaryOp::And.apply(a, b)),
                Op::Or => self.two(step, |a, b| BinaryOp::Or.apply(a, b)),
                Op::Not => self.one(step, |a| UnaryOp::Not.apply(a, |_| false)),
                Op::Neg => self.one(step, |a| UnaryOp::Neg.apply(a, |_| false)),
                Op::Select => self.select(step),
                Op::BallX => {
                    self.all(step, self.input.now.map_or(f64::NAN, |now| now.ball()[0].into()));
                }
                Op::BallY => {
                    self.all(step, self.input.now.map_or(f64::NAN, |now| now.ball()[1].into()));
                }
                Op::BallOwner => self
                    .all(step, self.input.now.map_or(f64::NAN, |now| player_number(now.owner()))),
                Op::PlayerX => {
                    let now = self.input.now;
                    self.one(step, |of| now.map_or(f64::NAN, |now| now.load(Field::PlayerX, of)));
                }
                Op::PlayerY => {
                    let now = self.input.now;
                    self.one(step, |of| now.map_or(f64::NAN, |now| now.load(Field::PlayerY, of)));
                }
                Op::Me => self.regs[step.at as usize] = self.crew.players,
                Op::Cell => self.regs[step.at as usize] = self.cells[step.a as usize],
                Op::Give => self.give(step),
                Op::Assign => self.assign(step),
                Op::Rare => self.rare(step, &plan.rare[step.a as usize], event),
                Op::Temporal => {
                    self.regs[step.at as usize] = self.temporal(&plan.rare[step.a as usize]);
                }
                Op::Loop => {
                    let each = &plan.loops[step.a as usize];
                    let at = step.at as usize;
                    self.regs[at] = if step.uniform {
                        [self.each::<1>(each, at)[0]; W]
                    } else {
                        self.each::<W>(each, at)
                    };
                }
                Op::Points => {
                    let value = self.each_point(&plan.loops[step.a as usize], step.at as usize);
                    self.regs[step.at as usize] = [value; W];
                }
            }
        }
    }

    #[inline]
    fn all(&mut self, step: &PlanStep, value: f64) {
        self.regs[step.at as usize] = [value; W];
    }

    #[inline]
    fn one(&mut self, step: &PlanStep, f: impl Fn(f64) -> f64) {
        let a = self.regs[step.a as usize];
        self.regs[step.at as usize] =
            if W == 1 || !step.uniform { each_lane(|lane| f(a[lane])) } else { [f(a[0]); W] };
    }

    #[inline]
    fn two(&mut self, step: &PlanStep, f: impl Fn(f64, f64) -> f64) {
        let (a, b) = (&self.regs[step.a as usize], &self.regs[step.b as usize]);
        self.regs[step.at as usize] = if W == 1 || !step.uniform {
            each_lane(|lane| f(a[lane], b[lane]))
        } else {
            [f(a[0], b[0]); W]
        };
    }

    fn select(&mut self, step: &PlanStep) {
        let [c, a, b] = [step.a, step.b, step.c].map(|reg| self.regs[reg as usize]);
        self.regs[step.at as usize] =
            each_lane(|lane| if truth(c[lane]) { a[lane] } else { b[lane] });
    }

    /// The rare instructions.
    #[inline(never)]
    fn rare(&mut self, step: &PlanStep, instr: &Instr, event: Option<&Event>) {
        self.regs[step.at as usize] = if W == 1 || !step.uniform {
            self.pure::<W>(instr, event)
        } else {
            [self.pure::<1>(instr, event)[0]; W]
        };
    }

    /// The value of an instruction without memory, in the first `N` lanes.
    fn pure<const N: usize>(&self, instr: &Instr, event: Option<&Event>) -> [f64; N] {
        let input = &self.input;
        match instr {
            Instr::Const(value) => [*value; N],
            Instr::Param(index) => {
                [input.params.get(*index as usize).copied().unwrap_or(f64::NAN); N]
            }
            Instr::Let(index) => [input.lets.get(*index as usize).copied().unwrap_or(f64::NAN); N],
            Instr::EpisodeIndex => [input.index as f64; N],
            Instr::Round => [f64::from(input.round); N],
            Instr::RoundElapsed => {
                // In whole steps, so that a comparison with 2 s holds where it should.
                let elapsed = input.now.map_or(0.0, |now| now.load(Field::Elapsed, 0.0));
                let steps = libm::round(elapsed * STEPS_PER_S) - f64::from(input.round_start);
                [steps / STEPS_PER_S; N]
            }
            Instr::Unary(op, a) => {
                let exists = |player| input.now.is_some_and(|now| now.exists(player));
                self.lanes::<N>(*a).map(|a| op.apply(a, exists))
            }
            Instr::Binary(op, a, b) => {
                let (a, b) = (self.lanes::<N>(*a), self.lanes::<N>(*b));
                each_lane(|lane| op.apply(a[lane], b[lane]))
            }
            Instr::Select(c, a, b) => {
                let (c, a, b) = (self.lanes::<N>(*c), self.lanes::<N>(*a), self.lanes::<N>(*b));
                each_lane(|lane| if truth(c[lane]) { a[lane] } else { b[lane] })
            }
            Instr::Table { table, x, y, linear } => {
                let (x, y) = (self.lanes::<N>(*x), self.lanes::<N>(*y));
                let Some(table) = self.plan.tables.get(*table as usize) else {
                    return [f64::NAN; N];
                };
                each_lane(|lane| {
                    let (x, y) = (x[lane], y[lane]);
                    if *linear { table.between(x, y) } else { table.at(x, y) }
                })
            }
            Instr::Terminated => [f64::from(u8::from(input.terminated)); N],
            Instr::Us => [input.us.index() as f64; N],
            Instr::Me => each_lane(|lane| self.crew.players[lane]),
            Instr::Load { field, of, when } => {
                let seen = match when {
                    When::Now => input.now,
                    When::Prev => input.prev,
                };
                let Some(seen) = seen else { return [f64::NAN; N] };
                match of {
                    None => [seen.load(*field, 0.0); N],
                    Some(of) => self.lanes::<N>(*of).map(|of| seen.load(*field, of)),
                }
            }
            Instr::Event(field) => [event.map_or(f64::NAN, |event| event_field(event, *field)); N],
            Instr::Cell(cell) => {
                let cell = &self.cells[*cell as usize];
                each_lane(|lane| cell[lane])
            }
            Instr::Random { key, from } => [self.draw(*key, from); N],
            // `at` runs instructions with memory, effects and loops.
            Instr::Held { .. }
            | Instr::Ever { .. }
            | Instr::Since { .. }
            | Instr::Until { .. }
            | Instr::Before { .. }
            | Instr::Once { .. }
            | Instr::Give { .. }
            | Instr::Assign { .. }
            | Instr::Each(_) => [0.0; N],
        }
    }

    #[inline]
    fn give(&mut self, step: &PlanStep) {
        let (allowed, value) = (self.allowed(step.c), self.regs[step.b as usize]);
        let term = &mut self.terms[step.a as usize];
        for lane in 0..W {
            if allowed[lane] {
                if value[lane].abs() <= PAY_MAX {
                    term[lane] += value[lane];
                } else {
                    *self.faults += 1;
                }
            }
        }
    }

    #[inline]
    fn assign(&mut self, step: &PlanStep) {
        let (allowed, value) = (self.allowed(step.c), self.regs[step.b as usize]);
        let cell = &mut self.cells[step.a as usize];
        for lane in 0..W {
            if allowed[lane] {
                if value[lane].is_nan() {
                    *self.faults += 1;
                } else {
                    cell[lane] = value[lane];
                }
            }
        }
    }

    fn temporal(&mut self, instr: &Instr) -> [f64; W] {
        match instr {
            Instr::Held { of, seconds, cell } => {
                let (holds, seconds) = (self.truths::<W>(*of), self.lanes::<W>(*seconds));
                let runs = &mut self.cells[*cell as usize];
                each_lane(|lane| {
                    runs[lane] = if holds[lane] { runs[lane] + 1.0 } else { 0.0 };
                    let steps = libm::round(seconds[lane] * STEPS_PER_S).max(1.0);
                    (runs[lane] >= steps && !seconds[lane].is_nan()).into()
                })
            }
            Instr::Ever { of, cell } => {
                let holds = self.truths::<W>(*of);
                let held = &mut self.cells[*cell as usize];
                each_lane(|lane| {
                    if holds[lane] {
                        held[lane] = 1.0;
                    }
                    held[lane]
                })
            }
            Instr::Since { of, cell } => {
                let holds = self.truths::<W>(*of);
                let counts = &mut self.cells[*cell as usize];
                each_lane(|lane| {
                    let count = &mut counts[lane];
                    if holds[lane] {
                        *count = 1.0;
                    } else if *count > 0.0 {
                        *count += 1.0;
                    }
                    if *count > 0.0 { (*count - 1.0) / STEPS_PER_S } else { f64::INFINITY }
                })
            }
            Instr::Until { of, release, cell } => {
                let (holds, released) = (self.truths::<W>(*of), self.truths::<W>(*release));
                let states = &mut self.cells[*cell as usize];
                each_lane(|lane| {
                    let state = &mut states[lane];
                    if *state == 0.0 {
                        *state = match (released[lane], holds[lane]) {
                            (true, _) => 1.0,
                            (false, true) => 0.0,
                            (false, false) => 2.0,
                        };
                    }
                    (*state != 2.0).into()
                })
            }
            Instr::Before { of, cell } => {
                let (now, silent) = (self.lanes::<W>(*of), self.input.silent);
                let kept = &mut self.cells[*cell as usize];
                each_lane(|lane| {
                    let before = if silent { now[lane] } else { kept[lane] };
                    if !now[lane].is_nan() {
                        kept[lane] = now[lane];
                    }
                    before
                })
            }
            Instr::Once { of, cell } => {
                let (holds, silent) = (self.truths::<W>(*of), self.input.silent);
                let paid = &mut self.cells[*cell as usize];
                each_lane(|lane| {
                    let first = !silent && holds[lane] && paid[lane] == 0.0;
                    if first {
                        paid[lane] = 1.0;
                    }
                    first.into()
                })
            }
            _ => [0.0; W],
        }
    }

    fn passes(&self, filter: &EventFilter, event: &Event, lane: usize) -> bool {
        let value = |reg: Reg| self.regs[reg.index()][lane];
        filter.by.is_none_or(|who| match who {
            Who::Team(reg) => event.team.is_some() && event.team == team_of_number(value(reg)),
            Who::Player(reg) => {
                // An own goal counts for the other team, so it isn't a goal of its scorer.
                let own =
                    event.kind == EventKind::Goal && event.by.map(PlayerId::team) != event.team;
                is_player(event.by, value(reg)) && !own
            }
        }) && filter.to.is_none_or(|who| match who {
            Who::Team(reg) => {
                event.to.is_some() && event.to.map(PlayerId::team) == team_of_number(value(reg))
            }
            Who::Player(reg) => is_player(event.to, value(reg)),
        })
    }
}

/// What a function gives for each lane. Unlike the standard library's, it is compiled to
/// instructions for several lanes at once.
#[inline]
fn each_lane<T: Copy + Default, const N: usize>(mut f: impl FnMut(usize) -> T) -> [T; N] {
    let mut all = [T::default(); N];
    for (lane, value) in all.iter_mut().enumerate() {
        *value = f(lane);
    }
    all
}

/// Whether an event matches the kind and qualifier of a filter.
pub fn is_kind(filter: &EventFilter, event: &Event) -> bool {
    event.kind == filter.kind
        && match (filter.qualifier, filter.kind) {
            (Some(qualifier), _) => event.qualifier == Some(qualifier),
            // Without a qualifier, any end of the episode matches.
            (None, EventKind::End) => true,
            (None, EventKind::Pass) => event.qualifier == Some(Qualifier::Attempted),
            (None, _) => event.qualifier.is_none(),
        }
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
