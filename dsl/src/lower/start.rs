//! The start program: `let`s, places, the ball, rules and requirements.

mod fields;
mod football;
mod kind;
mod pitch;
mod remap;
mod world;

use super::agents::{lower_agents, side_with_agents};
use super::builder::RegisterLayout;
use super::known::{OnDemand, PlayedBy, Scripted, StartState};
use super::people::Rostered;
use super::step_world::{LetSlot, LetSource, PitchSources, StepWorld};
use super::team::{PlayerOptions, lower_difficulty, lower_player_options};
use super::value::{LiteralFrame, Scope, Value};
use super::{Lower, ProgramStage, World};
use crate::ast::{Expr, ScenarioStmtKind, Span};
use crate::check::types::Ty;
use crate::origins::{RegionOrigin, RequireOrigin};
use crate::problem::Problem;
use crate::problem::facts::{Bounds, Chance, Names};
use crate::resolve::Named;
use remap::{map_agents, map_slot, map_start};
use setpiece_scenario::pitch::{LONGEST_S, STEP_S};
use setpiece_scenario::vocabulary::{PitchFigure, Team};
use setpiece_scenario::{
    Agents, Ai, BallStart, Kickoff, KickoffPlaces, PlayerSlot, PlayerStart, Reg, Require, Start,
};
use std::collections::BTreeMap;

/// The most rounds of an episode.
const ROUNDS_MAX: f64 = 10_000.0;

/// A lowered start and what belongs to it.
pub(crate) struct LoweredStart<'c, 'w> {
    /// The start.
    pub(crate) start: Start,
    /// The roster.
    pub(crate) players: Vec<PlayerSlot>,
    /// The agents.
    pub(crate) agents: Agents,
    /// What the programs of a step know beside the world.
    pub(crate) step: StepWorld<'c, 'w>,
    /// The behaviours that players use.
    pub(crate) behaviors: Vec<Scripted<'w>>,
    /// Where its requirements come from.
    pub(crate) requires: Vec<RequireOrigin>,
    /// Its regions, if they are wanted.
    pub(crate) regions: Vec<RegionOrigin>,
}

/// Lowers the start; `with_regions`: whether its program also computes the regions.
pub(crate) fn lower_start<'c, 'w>(
    world: &'c World<'w>,
    with_regions: bool,
) -> LoweredStart<'c, 'w> {
    let scope = Scope::new(true, LiteralFrame::World);
    let n = world.roster.len();
    let (places, headings, layouts) =
        (vec![OnDemand::Todo; n], vec![OnDemand::Todo; n], vec![None; n]);
    let presence = vec![OnDemand::Todo; n];
    let mut lower = Lower::of_start(
        world,
        scope,
        StartState { places, headings, layouts, presence, ..StartState::default() },
    );

    lower.scenario_lets();
    if world.flat.kickoff.is_some() {
        lower.first_team();
    }
    let (kind, taker) = lower.start_kind();
    let places: Vec<(Reg, Reg)> =
        (0..n).map(|i| lower.place_of_rostered(i, roster_span(world, i))).collect();
    let headings: Vec<Option<Reg>> =
        (0..n).map(|i| lower.heading_of(i, roster_span(world, i))).collect();
    let ball = lower.ball();
    lower.check_kickoff_ball(kind, ball.as_ref());
    let options: Vec<PlayerOptions<'w>> =
        (0..n).filter_map(|index| lower_player_options(&mut lower, index)).collect();
    let difficulty =
        [lower_difficulty(&mut lower, Team::Left), lower_difficulty(&mut lower, Team::Right)];
    let agents = lower_agents(&mut lower, &options);
    let side = side_with_agents(&lower, &agents, &options);
    let rules = lower.rules();
    let settings = lower.world_settings();
    let highest_ball = lower.ball_ceiling(&settings);
    let pitch = lower.pitch_settings();
    let limit = lower.limit();
    let rounds = lower.rounds();
    let (score, elapsed) = lower.start_fields();
    let mut requires = lower.requires();
    football::check_places(&mut lower, &places, &options, ball.as_ref());
    let kickoff = lower.kickoff(&places);
    let written = world.flat.requires.iter().map(|stmt| match &stmt.kind {
        ScenarioStmtKind::Require { condition, .. } => {
            RequireOrigin { span: Some(condition.span), help: None }
        }
        _ => RequireOrigin::default(),
    });
    let named = if with_regions { lower.named_regions() } else { Vec::new() };
    let state = lower.start_mut().map(std::mem::take).unwrap_or_default();
    // What depends on one player of several has as many shapes as players.
    let is_one = |region: &RegionOrigin| {
        region.shape.numbers().iter().all(|number| lower.code.is_visible(*number))
    };
    let asked_about = state.asked_about.into_iter().filter(is_one);
    let others = state.drawn_in.into_iter().chain(asked_about).filter(|_| with_regions);
    let regions: Vec<RegionOrigin> = named.into_iter().chain(others).collect();
    let (mut implied, of_implied): (Vec<_>, Vec<_>) = state.implied.into_iter().unzip();
    let of_requires = written.chain(of_implied).collect();
    requires.append(&mut implied);

    let (lets, pitch_sources, let_regs) = lower.let_slots(state.lets, state.pitch);
    let mut wanted: Vec<Reg> = Vec::new();
    let mut collect = |reg: Reg| {
        wanted.push(reg);
        reg
    };
    let ball = ball.unwrap_or_else(|| {
        let zero = lower.code.constant(0.0);
        BallStart { x: zero, y: zero, height: None, velocity: None, spin: None, owner: None }
    });
    let start = Start {
        program: setpiece_scenario::Program::default(),
        lets: let_regs,
        ball,
        kind,
        taker,
        score,
        elapsed,
        kickoff,
        difficulty,
        rules,
        world: settings,
        pitch,
        limit,
        rounds,
        requires,
    };
    let (players, behaviors) = slots(world, &places, &headings, options);
    map_start(&start, &mut collect);
    for slot in &players {
        map_slot(slot, &mut collect);
    }
    map_agents(&agents, &mut collect);
    wanted.extend(regions.iter().flat_map(|region| region.shape.numbers()));

    let (program, layout) = lower.code.finish(&wanted);
    let place = |layout: &RegisterLayout, reg: Reg| layout.reg(reg);
    let mut start = map_start(&start, &mut |reg| place(&layout, reg));
    start.program = program;
    let players =
        players.iter().map(|slot| map_slot(slot, &mut |reg| place(&layout, reg))).collect();
    let agents = map_agents(&agents, &mut |reg| place(&layout, reg));
    let step = StepWorld::new(world, &start, lets, pitch_sources, side, highest_ball);
    let regions = laid_out(&regions, &layout);
    LoweredStart { start, players, agents, step, behaviors, requires: of_requires, regions }
}

/// Regions in the registers of the finished program.
fn laid_out(regions: &[RegionOrigin], layout: &RegisterLayout) -> Vec<RegionOrigin> {
    let region = |region: &RegionOrigin| RegionOrigin {
        span: region.span,
        shape: region.shape.map(&mut |reg| layout.reg(reg)),
    };
    regions.iter().map(region).collect()
}

fn roster_span(world: &World<'_>, index: usize) -> Span {
    let own = world.flat.item.name.span;
    world.roster.get(index).map_or(own, |player| player.span)
}

fn slots<'w>(
    world: &World<'w>,
    places: &[(Reg, Reg)],
    headings: &[Option<Reg>],
    options: Vec<PlayerOptions<'w>>,
) -> (Vec<PlayerSlot>, Vec<Scripted<'w>>) {
    let (mut slots, mut behaviors) = (Vec::new(), Vec::new());
    for (index, (((player, place), heading), option)) in
        world.roster.iter().zip(places).zip(headings).zip(options).enumerate()
    {
        let mut played = Vec::new();
        for (which, (when, by)) in option.ai.into_iter().enumerate() {
            match by {
                PlayedBy::BuiltIn(ai) => played.push((when, ai)),
                PlayedBy::Behavior(used) => {
                    behaviors.push(Scripted { index, which, used });
                    // Its number is known when it is written.
                    played.push((when, Ai::Bot));
                }
            }
        }
        let ai = played.pop().map_or(Ai::Bot, |(_, ai)| ai);
        let sometimes = played.into_iter().filter_map(|(when, ai)| Some((when?, ai))).collect();
        slots.push(PlayerSlot {
            team: player.team,
            role: player.role,
            instead: player.instead,
            // A formation that both teams use names two players alike; then neither bears the name
            // alone.
            name: player.name.map(|name| name.node.clone()).filter(|name| {
                let same =
                    |other: &&Rostered<'_>| other.name.is_some_and(|other| other.node == *name);
                world.roster.iter().filter(|player| !player.instead).filter(same).count() == 1
            }),
            ai,
            sometimes,
            controllable: option.controllable,
            overlap: option.overlap,
            stats: option.stats,
            start: PlayerStart {
                x: place.0,
                y: place.1,
                heading: *heading,
                velocity: option.velocity,
                fatigue: option.fatigue,
                yellow_cards: option.yellow_cards,
                difficulty: option.difficulty,
                present: option.presence.present,
                active: option.presence.active,
            },
        });
    }
    (slots, behaviors)
}

impl<'w> Lower<'_, 'w> {
    /// Runs `f` while draws belong to the stream called `name`.
    pub(crate) fn drawing<T>(&mut self, name: &str, f: impl FnOnce(&mut Self) -> T) -> T {
        let outer = self.streams.draw_for(name);
        let result = f(self);
        self.streams.drawing = outer;
        result
    }

    /// Computes every `let` of the scenario, and what its children bind parameters to.
    fn scenario_lets(&mut self) {
        let world = self.world;
        let bound = world.params.iter().filter(|param| param.bound.is_some());
        let tuples = world.flat.tuples.iter().flat_map(|(names, _)| *names);
        let names = bound
            .map(|param| param.name)
            .chain(world.flat.lets.iter().map(|binding| &binding.name))
            .chain(tuples);
        for name in names {
            self.scenario_let(&name.node, name.span);
        }
    }

    /// The value of a `let` of the scenario, or of a parameter that is bound by a child.
    pub(crate) fn scenario_let(&mut self, name: &'w str, asked: Span) -> Value<'w> {
        match self.stage {
            ProgramStage::Start(_) => {}
            ProgramStage::Constant => {
                return self
                    .fail(Problem::new(asked, Chance::ComputedAtReset { name: name.to_owned() }));
            }
            ProgramStage::Init
            | ProgramStage::Reward
            | ProgramStage::Ending
            | ProgramStage::Record
            | ProgramStage::Observation
            | ProgramStage::Behavior(_) => {
                return self.step_let(name);
            }
        }
        match self.start().and_then(|start| start.lets.get(name)) {
            Some(Some(value)) => return value.clone(),
            Some(None) => {
                return self.fail(Problem::new(
                    asked,
                    Names::Recursion { name: name.to_owned(), declared: None, is_behavior: false },
                ));
            }
            None => {}
        }
        let world = self.world;
        let named = world.flat.named(name);
        if let Some(Named::Tuple(at, _)) = named
            && let Some((names, expr)) = world.flat.tuples.get(at)
        {
            return self.shuffled_let(name, names, expr);
        }
        let (mut binding, mut bound) = (None, None);
        match named {
            Some(Named::Let(at)) => binding = world.flat.lets.get(at),
            Some(Named::Param(at)) => bound = world.params.get(at),
            _ => {}
        }
        let (expr, ty): (&'w Expr, _) = match (binding, bound) {
            (Some(binding), _) => {
                let ty = binding.ty.as_ref().map(|ty| super::param::declared_type(world, ty));
                (&binding.value, ty)
            }
            (None, Some(param)) => match param.bound {
                Some(expr) => (expr, param.declared),
                None => return Value::error(),
            },
            (None, None) => return Value::error(),
        };
        self.set_let(name, None);
        let team = self.team.take();
        let value = self.within(Scope::new(true, LiteralFrame::World), |lower| {
            lower.drawing(&format!("let {name}"), |lower| match ty {
                Some(ty) => lower.want(expr, ty),
                None => lower.expr(expr),
            })
        });
        self.team = team;
        if let Some((range, domain)) =
            bound.and_then(|param| Some((param.param.range?, param.name)))
            && binding.is_none()
            && value.ty.dim().is_some()
        {
            let reg = self.reg(&value);
            let allowed = match world.flat.named(&domain.node) {
                Some(Named::Param(at)) => world.flat.params.get(at),
                _ => None,
            };
            if let Some(crate::ast::Domain::Range(low, high)) =
                allowed.and_then(|param| param.domain)
            {
                let shown = format!("`{}..{}`", world.text(low.span), world.text(high.span));
                self.check_range(reg, range, &format!("`{name}`"), expr.span, &shown);
            }
        }
        self.set_let(name, Some(value.clone()));
        value
    }

    /// `let (a, b) = shuffle(x, y)`: all its names at once, from the stream of the first.
    fn shuffled_let(
        &mut self,
        name: &'w str,
        names: &'w [crate::ast::Ident],
        expr: &'w Expr,
    ) -> Value<'w> {
        for one in names {
            self.set_let(&one.node, None);
        }
        let team = self.team.take();
        let stream = names.first().map_or(name, |first| first.node.as_str());
        let values = self.within(Scope::new(true, LiteralFrame::World), |lower| {
            lower.drawing(&format!("let {stream}"), |lower| lower.shuffle(expr, names.len()))
        });
        self.team = team;
        for (index, one) in names.iter().enumerate() {
            let value = values
                .as_ref()
                .and_then(|values| values.get(index))
                .cloned()
                .unwrap_or_else(Value::error);
            self.set_let(&one.node, Some(value));
        }
        self.start()
            .and_then(|start| start.lets.get(name).cloned().flatten())
            .unwrap_or_else(Value::error)
    }

    fn set_let(&mut self, name: &'w str, value: Option<Value<'w>>) {
        if let Some(start) = self.start_mut() {
            start.lets.insert(name, value);
        }
    }

    fn let_slots(
        &self,
        lets: BTreeMap<&'w str, Option<Value<'w>>>,
        pitch: [Option<Reg>; PitchFigure::ALL.len()],
    ) -> (Vec<LetSlot<'w>>, PitchSources, Vec<Reg>) {
        let mut regs: Vec<Reg> = Vec::new();
        let mut slots = Vec::new();
        let mut source = |reg: Reg| match self.code.instr(reg) {
            Some(setpiece_scenario::Instr::Const(value)) => LetSource::Constant(*value),
            Some(setpiece_scenario::Instr::Param(index)) => LetSource::Param(*index),
            _ => {
                regs.push(reg);
                LetSource::Let(regs.len() as u32 - 1)
            }
        };
        for (name, value) in lets {
            let Some(value) = value else { continue };
            let parts = value.regs().into_iter().map(|reg| (reg, source(reg))).collect();
            slots.push(LetSlot { name, value, parts });
        }
        let pitch = pitch.map(|figure| figure.map(&mut source));
        (slots, pitch, regs)
    }

    /// The team that kicks off first.
    pub(crate) fn first_team(&mut self) -> Reg {
        if let Some(first) = self.start().and_then(|start| start.first) {
            return first;
        }
        let first = match self.world.flat.kickoff {
            Some((expr, _, _)) => {
                let team = self.team.take();
                let scope = Scope::new(true, LiteralFrame::World);
                let first = self.within(scope, |lower| {
                    lower.drawing("kickoff", |lower| lower.want_reg(expr, Ty::Team))
                });
                self.team = team;
                first
            }
            None => self.code.constant(0.0),
        };
        if let Some(start) = self.start_mut() {
            start.first = Some(first);
        }
        first
    }

    fn kickoff(&mut self, places: &[(Reg, Reg)]) -> Option<Kickoff> {
        self.world.flat.kickoff?;
        let layouts =
            self.start()?.layouts.iter().zip(places).map(|(layout, place)| match layout {
                Some((kicking, receiving)) => {
                    KickoffPlaces { kicking: *kicking, receiving: *receiving }
                }
                None => KickoffPlaces { kicking: *place, receiving: *place },
            });
        let places = layouts.collect();
        Some(Kickoff { first: self.first_team(), places })
    }

    fn rounds(&mut self) -> Option<Reg> {
        let (rounds, _) = self.world.flat.rounds?;
        let reg = self.want_reg(&rounds.count, Ty::Int);
        let what = "the number of rounds";
        self.check_not_drawn(reg, what, rounds.count.span);
        self.check_range(reg, (1.0, ROUNDS_MAX), what, rounds.count.span, "`1..10000`");
        Some(reg)
    }

    fn limit(&mut self) -> Option<Reg> {
        let (expr, _) = self.world.flat.limit?;
        let reg = self.want_reg(expr, Ty::DURATION);
        self.check_not_drawn(reg, "the limit", expr.span);
        if self.check_range(
            reg,
            (STEP_S, LONGEST_S),
            "the limit",
            expr.span,
            "`1 step..1000000 steps`",
        ) {
            self.check_steps(reg, "the limit", expr.span);
        }
        Some(reg)
    }

    /// Reports a constant duration that is no whole number of steps.
    pub(crate) fn check_steps(&self, reg: Reg, what: &str, span: Span) {
        let Some(steps) = self.code.constant_of(reg).map(|seconds| seconds / STEP_S) else {
            return;
        };
        if (steps - steps.round()).abs() > 1e-6 {
            let text = self.world.text(span);
            self.report(Problem::new(
                span,
                Bounds::NotWholeSteps { what: what.to_owned(), text, steps },
            ));
        }
    }

    fn requires(&mut self) -> Vec<Require> {
        let mut requires = Vec::new();
        for stmt in &self.world.flat.requires {
            let ScenarioStmtKind::Require { condition, probability, label } = &stmt.kind else {
                continue;
            };
            if let Some(start) = self.start_mut() {
                start.is_requiring = true;
            }
            let met = self.drawing("require", |lower| lower.condition(condition));
            if let Some(start) = self.start_mut() {
                start.is_requiring = false;
            }
            let probability = probability.as_ref().map(|expr| {
                let reg = self.want_reg(expr, Ty::Percent);
                self.check_range(reg, (0.0, 1.0), "the probability", expr.span, "`0%..100%`");
                reg
            });
            let words = label
                .as_ref()
                .map_or_else(|| self.world.text(condition.span), |label| label.node.clone());
            if self.interval(met) == Some((0.0, 0.0)) && probability.is_none() {
                self.report(Problem::new(
                    condition.span,
                    Chance::NeverMet { label: words.clone() },
                ));
            }
            requires.push(Require { condition: met, probability, label: words });
        }
        requires
    }
}
