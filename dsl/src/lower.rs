//! Trees to programs: expressions are typed and lowered in one pass, so that a value is its type
//! and its registers.
//!
//! A broken part yields a value of type `Error`, which agrees with everything; as soon as one
//! problem is an error no scenario comes out, so what such a value's registers hold does not
//! matter.

pub(crate) mod agents;
pub(crate) mod alone;
mod alternatives;
mod begin;
pub(crate) mod behavior;
pub(crate) mod builder;
pub(crate) mod cases;
mod casting;
pub(crate) mod dead;
pub(crate) mod ending;
pub(crate) mod expr;
mod fields;
mod formations;
pub(crate) mod hidden;
mod implies;
pub(crate) mod interval;
mod known;
mod layouts;
pub(crate) mod loaded_scripts;
pub(crate) mod mirror;
mod mirrored;
mod named;
mod never;
pub(crate) mod observation;
pub(crate) mod param;
pub(crate) mod param_info;
pub(crate) mod people;
mod pitch;
pub(crate) mod place;
mod presence;
pub(crate) mod record;
pub(crate) mod reward;
pub(crate) mod roster;
pub(crate) mod script;
mod seats;
pub(crate) mod start;
pub(crate) mod step;
pub(crate) mod step_world;
mod substitute;
mod table;
pub(crate) mod team;
pub(crate) mod triangles;
pub(crate) mod value;
mod whole;
mod world;

pub(crate) use world::{Effort, MAX_LOWERED, World};

use crate::ast::{Expr, Span};
use crate::check::types::Ty;
use crate::origins::RequireOrigin;
use crate::problem::Problem;
use crate::problem::facts::{Bounds, Calls, Chance, Implied, Instead, Names, Types};
use builder::Builder;
use interval::Interval;
use known::{Draw, Remembered, StartState, Streams};
use mirror::Mirror;
use setpiece_scenario::vocabulary::EventKind;
use setpiece_scenario::{BinaryOp, Reg, Require, When};
use step_world::StepWorld;
use value::{LiteralFrame, Repr, Scope, Value};

/// What kind of program is written, which decides what it may read; with what this kind alone
/// keeps.
pub(crate) enum ProgramStage<'w> {
    /// Nothing but constants.
    Constant,
    /// The draw of a start; with its places and `let`s.
    Start(Box<StartState<'w>>),
    /// The first values of a reward's states.
    Init,
    /// A reward, at every step.
    Reward,
    /// The endings, at every step.
    Ending,
    /// A record, at every step.
    Record,
    /// The scenario's observation, after every step and reset.
    Observation,
    /// What a scripted player does, at every step; with the draws of the statement that is being
    /// written, `None` where nothing may be drawn.
    Behavior(Option<Vec<Draw>>),
}

impl ProgramStage<'_> {
    /// Whether the match is under way.
    pub(crate) fn is_step(&self) -> bool {
        matches!(
            self,
            ProgramStage::Reward
                | ProgramStage::Ending
                | ProgramStage::Record
                | ProgramStage::Observation
                | ProgramStage::Behavior(_)
        )
    }

    /// Whether it judges the match at every step, so that it may look at the whole episode.
    pub(crate) fn judges(&self) -> bool {
        matches!(self, ProgramStage::Reward | ProgramStage::Ending | ProgramStage::Record)
    }

    /// Whether it runs for an agent or a player, so that there is a `me`.
    pub(crate) fn has_me(&self) -> bool {
        matches!(
            self,
            ProgramStage::Reward
                | ProgramStage::Record
                | ProgramStage::Observation
                | ProgramStage::Behavior(_)
        )
    }
}

/// Writes one program.
pub(crate) struct Lower<'c, 'w> {
    /// The scenario around it.
    pub(crate) world: &'c World<'w>,
    /// What is known of the start, in a program of a step.
    step: Option<&'c StepWorld<'c, 'w>>,
    /// The program.
    pub(crate) code: Builder,
    /// Its kind.
    pub(crate) stage: ProgramStage<'w>,
    /// The names in sight.
    pub(crate) scope: Scope<'w>,
    /// The team whose view it is, if any.
    pub(crate) team: Option<Reg>,
    /// Whether state is read as it is or as it was a step ago.
    pub(crate) when: When,
    /// The event of the `on` block around, if any.
    pub(crate) event: Option<EventKind>,
    /// The streams that draws come from.
    pub(crate) streams: Streams,
    /// What it reads of the rewards' memory and of the records.
    pub(crate) remembered: Remembered<'w>,
    depth: u32,
    inlining: Vec<Span>,
    inlined: u32,
    /// How many instructions were taken from the world's effort.
    paid: usize,
}

/// Deepest expression, parents of names included.
const DEPTH_MAX: u32 = 200;
/// Most uses of `fn`, `const` and `region` in one program.
const INLINED_MAX: u32 = 10_000;

impl<'c, 'w> Lower<'c, 'w> {
    /// An empty program of what is known now.
    pub(crate) fn constant(world: &'c World<'w>, scope: Scope<'w>) -> Lower<'c, 'w> {
        Lower::new(world, None, ProgramStage::Constant, scope)
    }

    /// An empty program of what is drawn or computed at the start.
    pub(crate) fn of_start(
        world: &'c World<'w>,
        scope: Scope<'w>,
        state: StartState<'w>,
    ) -> Lower<'c, 'w> {
        Lower::new(world, None, ProgramStage::Start(Box::new(state)), scope)
    }

    /// What is known of the start; `None` in any other program.
    pub(crate) fn start(&self) -> Option<&StartState<'w>> {
        match &self.stage {
            ProgramStage::Start(state) => Some(state),
            _ => None,
        }
    }

    /// The same, to note more.
    pub(crate) fn start_mut(&mut self) -> Option<&mut StartState<'w>> {
        match &mut self.stage {
            ProgramStage::Start(state) => Some(state),
            _ => None,
        }
    }

    /// An empty program of a step, or of what is kept from step to step.
    pub(crate) fn in_step(
        step: &'c StepWorld<'c, 'w>,
        stage: ProgramStage<'w>,
        scope: Scope<'w>,
    ) -> Lower<'c, 'w> {
        debug_assert!(stage.is_step() || matches!(stage, ProgramStage::Init));
        Lower::new(step.world, Some(step), stage, scope)
    }

    fn new(
        world: &'c World<'w>,
        step: Option<&'c StepWorld<'c, 'w>>,
        stage: ProgramStage<'w>,
        scope: Scope<'w>,
    ) -> Lower<'c, 'w> {
        Lower {
            world,
            step,
            code: Builder::new(),
            stage,
            scope,
            team: None,
            when: When::Now,
            event: None,
            streams: Streams::default(),
            remembered: Remembered::default(),
            depth: 0,
            inlining: Vec::new(),
            inlined: 0,
            paid: 0,
        }
    }

    /// Reports a problem.
    pub(crate) fn report(&self, problem: Problem) {
        self.world.report(problem);
    }

    /// Reports a problem and gives the value of what is broken.
    pub(crate) fn fail(&self, problem: Problem) -> Value<'w> {
        self.world.report(problem);
        Value::error()
    }

    /// Pays for an expression and for the instructions since the last one; `false` once too much
    /// was lowered.
    fn pay(&mut self) -> bool {
        let made = self.code.len();
        let new = made.saturating_sub(self.paid);
        self.paid = made;
        self.world.effort.spend(1 + new)
    }

    /// Runs `f` in another scope.
    pub(crate) fn within<T>(&mut self, scope: Scope<'w>, f: impl FnOnce(&mut Self) -> T) -> T {
        let outer = std::mem::replace(&mut self.scope, scope);
        let result = f(self);
        self.scope = outer;
        result
    }

    /// Runs `f` in the own frame or the world's.
    pub(crate) fn in_frame<T>(&mut self, frame: LiteralFrame, f: impl FnOnce(&mut Self) -> T) -> T {
        let outer = std::mem::replace(&mut self.scope.frame, frame);
        let result = f(self);
        self.scope.frame = outer;
        result
    }

    /// Whether a definition is being written.
    pub(crate) fn is_inlining(&self, item: Span) -> bool {
        self.inlining.contains(&item)
    }

    /// Guards against definitions that use themselves, and against programs without bounds.
    pub(crate) fn inline<T>(
        &mut self,
        item: Span,
        at: Span,
        f: impl FnOnce(&mut Self) -> T,
    ) -> Option<T> {
        self.inlined += 1;
        let text = self.world.text(item);
        if self.world.is_circular(item) {
            return None;
        }
        if let Some(begin) = self.inlining.iter().position(|outer| *outer == item) {
            self.report(Problem::new(
                at,
                Names::Recursion { name: text, declared: Some(item), is_behavior: false },
            ));
            self.world.note_circle(self.inlining.get(begin..).unwrap_or_default());
            return None;
        }
        if self.inlined > INLINED_MAX {
            if self.inlined == INLINED_MAX + 1 {
                self.report(Problem::new(at, Calls::TooLarge { name: text }));
            }
            return None;
        }
        self.inlining.push(item);
        let result = f(self);
        self.inlining.pop();
        Some(result)
    }

    /// Lowers an expression of a wanted type.
    pub(crate) fn want(&mut self, expr: &'w Expr, wanted: Ty) -> Value<'w> {
        let value = self.beside(wanted, expr);
        self.convert(value, wanted, expr)
    }

    /// Lowers an expression of a wanted type into one register.
    pub(crate) fn want_reg(&mut self, expr: &'w Expr, wanted: Ty) -> Reg {
        let value = self.want(expr, wanted);
        self.reg(&value)
    }

    /// Lowers a place into its two registers, metres in the world frame.
    pub(crate) fn want_point(&mut self, expr: &'w Expr) -> (Reg, Reg) {
        let value = self.want(expr, Ty::Point);
        self.pair(&value)
    }

    /// The register of a value of one register.
    pub(crate) fn reg(&mut self, value: &Value<'w>) -> Reg {
        match value.repr {
            Repr::One(reg) | Repr::Choice(reg, _) => reg,
            _ => self.code.unknown(),
        }
    }

    /// The registers of a value of two.
    pub(crate) fn pair(&mut self, value: &Value<'w>) -> (Reg, Reg) {
        match value.repr {
            Repr::Two(x, y) | Repr::Three(x, y, _) => (x, y),
            _ => {
                let unknown = self.code.unknown();
                (unknown, unknown)
            }
        }
    }

    /// Makes a value one of the wanted type, or reports what it is instead.
    pub(crate) fn convert(&mut self, value: Value<'w>, wanted: Ty, expr: &'w Expr) -> Value<'w> {
        if value.is_error() || value.ty == wanted {
            return value;
        }
        match (wanted, &value.repr) {
            (Ty::Point, _) if self.is_nobody(expr) => {
                return self.fail(Problem::new(expr.span, Types::NobodyHasNoPlace));
            }
            (Ty::Point, _) if value.ty.is_place() => {
                let place = self.place_of(&value, expr.span);
                return Value::two(Ty::Point, place);
            }
            // `(2m, 0m)` is a point or a vector, as its place wants.
            (Ty::Vector, Repr::Two(x, y)) if value.ty == Ty::Point && expr::is_tuple(expr) => {
                return Value::two(Ty::Vector, (*x, *y));
            }
            (Ty::Set, Repr::One(team)) if value.ty == Ty::Team => {
                let set = value::SetValue { team: *team, except: None };
                return Value { ty: Ty::Set, repr: Repr::Set(set) };
            }
            // A whole constant is a whole number, however it was computed.
            (Ty::Int, Repr::One(reg))
                if value.ty == Ty::Number
                    && self.code.constant_of(*reg).is_some_and(|v| v.fract() == 0.0) =>
            {
                return Value::one(Ty::Int, *reg);
            }
            _ => {}
        }
        if value.ty.fits(wanted) {
            return Value { ty: wanted, repr: value.repr };
        }
        let metres = (wanted == Ty::LENGTH && value.ty.is_plain())
            .then(|| self.written_in_metres(expr))
            .flatten();
        let instead = match metres {
            Some(text) => Instead::Metres { text },
            None if (wanted, value.ty) == (Ty::Int, Ty::Number) => self.made_whole(expr),
            None => Instead::Usual,
        };
        self.fail(self.mismatch_with(value.ty, wanted, expr.span, instead))
    }

    /// "expected a length, found `3s` (a duration)".
    pub(crate) fn mismatch(&self, found: Ty, wanted: Ty, span: Span) -> Problem {
        self.mismatch_with(found, wanted, span, Instead::Usual)
    }

    /// The same with a better form to write.
    pub(crate) fn mismatch_with(
        &self,
        found: Ty,
        wanted: Ty,
        span: Span,
        instead: Instead,
    ) -> Problem {
        Problem::new(span, Types::Mismatch { wanted, found, text: self.world.text(span), instead })
    }

    /// +1 or -1 where the own frame is read, `None` where it is the world's.
    pub(crate) fn side(&mut self) -> Option<Reg> {
        match (self.scope.frame, self.team, self.world.mirror) {
            (LiteralFrame::Own, Some(team), _) => {
                Some(self.code.unary(setpiece_scenario::UnaryOp::Side, team))
            }
            (_, _, Mirror::Ends) => Some(self.code.constant(-1.0)),
            _ => None,
        }
    }

    /// The interval of a register, where it is known.
    pub(crate) fn interval(&self, reg: Reg) -> Option<Interval> {
        interval::interval(&self.code, reg, &self.world.ranges())
    }

    /// Reports a value that may be outside its range; what isn't known now becomes a requirement of
    /// the draw. `false` after a report.
    pub(crate) fn check_range(
        &mut self,
        reg: Reg,
        range: Interval,
        what: &str,
        span: Span,
        shown: &str,
    ) -> bool {
        match self.interval(reg) {
            Some((low, high)) if low >= range.0 && high <= range.1 => {}
            Some(_) => {
                let text = self.world.text(span);
                self.report(Problem::new(
                    span,
                    Bounds::Outside { what: what.to_owned(), text, shown: shown.to_owned() },
                ));
                return false;
            }
            None => {
                let (low, high) = (self.code.constant(range.0), self.code.constant(range.1));
                let above = self.code.binary(BinaryOp::Ge, reg, low);
                let below = self.code.binary(BinaryOp::Le, reg, high);
                let inside = self.code.binary(BinaryOp::And, above, below);
                let implied = Implied::Inside { what: what.to_owned(), shown: shown.to_owned() };
                self.imply(inside, &implied, Some(span));
            }
        }
        true
    }

    /// Reports a velocity above the greatest speed, m/s; what isn't known now becomes a requirement
    /// of the draw.
    pub(crate) fn check_speed(
        &mut self,
        (x, y, z): (Reg, Reg, Reg),
        greatest: f64,
        what: &str,
        span: Span,
    ) {
        let ground = self.code.binary(BinaryOp::Hypot, x, y);
        let speed = self.code.binary(BinaryOp::Hypot, ground, z);
        if self.interval(speed).is_some_and(|(_, high)| high <= greatest) {
            return;
        }
        if self.interval(speed).is_some_and(|(low, _)| low > greatest) {
            self.report(Problem::new(
                span,
                Bounds::TooFast { what: what.to_owned(), most_mps: greatest },
            ));
            return;
        }
        let limit = self.code.constant(greatest);
        let slower = self.code.binary(BinaryOp::Le, speed, limit);
        let implied = Implied::Slower { what: what.to_owned(), most_mps: greatest };
        self.imply(slower, &implied, Some(span));
    }

    /// Makes a condition a requirement of the draw, unless it is known to hold; outside the start
    /// there is none.
    ///
    /// - `span`: the part that implies it, where it is one part.
    pub(crate) fn imply(&mut self, condition: Reg, implied: &Implied, span: Option<Span>) {
        let known =
            self.code.is_unknown(condition) || self.code.constant_of(condition) == Some(1.0);
        if let Some(start) = self.start_mut().filter(|_| !known) {
            let require = Require { condition, probability: None, label: implied.label() };
            start.implied.push((require, RequireOrigin { span, help: Some(implied.help()) }));
        }
    }

    /// Reports a value that must be known before the start but is drawn.
    pub(crate) fn check_not_drawn(&self, reg: Reg, what: &str, span: Span) {
        let drawn = |instr: &setpiece_scenario::Instr| {
            matches!(
                instr,
                setpiece_scenario::Instr::Random { .. }
                    | setpiece_scenario::Instr::EpisodeIndex
                    | setpiece_scenario::Instr::Round
            )
        };
        if self.code.depends(reg, &drawn) {
            self.report(Problem::new(span, Chance::Drawn { what: what.to_owned() }));
        }
    }
}
