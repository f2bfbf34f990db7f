//! Names: of locals, the scenario, the file, and the language itself, in this order.

use super::super::value::{LiteralFrame, LocalName, Repr, Scope, SetValue, Value};
use super::super::{Lower, ProgramStage};
use crate::ast::{Expr, ExprKind, FormationItem, ItemKind, Span};
use crate::check::names;
use crate::check::types::Ty;
use crate::problem::facts::{BeforeOutside, Chance, Names, Scopes, Types, Use, ViewOutside};
use crate::problem::{Code, Guess, Problem};
use crate::resolve::Named;
use setpiece_scenario::vocabulary::{
    EventField, EventKind, Field, Owner, PROPERTIES, PitchRegion, Property, Role, Team,
};
use setpiece_scenario::{Reg, UnaryOp, When};

impl<'w> Lower<'_, 'w> {
    /// A name that stands for a value.
    pub(super) fn name(&mut self, name: &'w str, span: Span) -> Value<'w> {
        self.name_before(name, span, false)
    }

    /// The same; `has_member`: a property of it is asked for.
    pub(super) fn name_before(&mut self, name: &'w str, span: Span, has_member: bool) -> Value<'w> {
        if let Some(binding) = self.scope.find(name).cloned() {
            return self.local(name, binding, span);
        }
        if self.scope.scenario
            && let Some(value) = self.scenario_name(name, span)
        {
            return value;
        }
        if let Some(team) = self.scope.players_of
            && let Some(value) = self.player_name(name, Some(team))
        {
            return value;
        }
        if self.scope.scenario
            && !names::is_value(name)
            && let Some(value) = self.recorded(name, span)
        {
            return value;
        }
        if let Some(value) = self.file_name(name, span) {
            return value;
        }
        if let Some(value) = self.builtin(name, span) {
            return value;
        }
        if self.world.is_full(Code::UnknownName) {
            return Value::error();
        }
        if self.scope.scenario && self.world.flat.rewards.iter().any(|(known, ..)| known == name) {
            return self.reward_is_no_value(name, span);
        }
        let mut candidates = self.names_in_sight(span);
        let is_compared = !has_member
            && matches!(self.stage, ProgramStage::Ending)
            && self.world.is_compared(span);
        // An event is no number.
        if matches!(self.stage, ProgramStage::Reward | ProgramStage::Ending) && !is_compared {
            candidates.extend(EventKind::ALL.iter().map(|kind| kind.name().to_owned()));
        }
        if matches!(self.stage, ProgramStage::Observation) {
            let sight = ["noise", "delayed", "stack"].into_iter().filter(|word| *word != name);
            candidates.extend(sight.map(str::to_owned));
        }
        if let Some(fact) = self.of_the_scenario(name, span) {
            return self.fail(Problem::new(span, fact));
        }
        let replaced = self.world.flat.teams.iter().flat_map(|team| &team.replaced);
        let replaced = replaced.filter(|_| self.scope.scenario);
        if let Some(&(_, by)) = replaced.into_iter().find(|(known, _)| *known == name) {
            let (name, child) = (name.to_owned(), self.world.flat.item.name.node.clone());
            return self.fail(Problem::new(span, Names::ReplacedPlayer { name, child, by }));
        }
        let mut guess = Guess::of(name, candidates.iter().map(String::as_str));
        if !has_member {
            guess = guess.read_as(|meant| match self.states_read(meant) {
                Some(states) => states.first().cloned(),
                None => Some(meant.to_owned()),
            });
        }
        self.fail(Problem::new(
            span,
            Names::NoValue {
                name: name.to_owned(),
                guess,
                late: self.scope.scenario,
                records: is_compared && self.scope.scenario,
            },
        ))
    }

    /// How a name of the scenario reaches the item of a file that `span` stands in.
    fn of_the_scenario(&mut self, name: &'w str, span: Span) -> Option<Names> {
        let world = self.world;
        if self.scope.scenario || !(world.declares(name) || world.record(name).is_some()) {
            return None;
        }
        let around = world.library.around(span);
        let form = around.and_then(|around| {
            let (head, use_of) = match &around.item.kind {
                ItemKind::Behavior(_) => ("behavior", "ai: "),
                ItemKind::Reward(_) => ("reward", "reward "),
                ItemKind::Ending(_) => ("ending", "end "),
                ItemKind::Fn(_) => ("fn", ""),
                ItemKind::Region(_) => ("region", ""),
                ItemKind::Formation(_) => ("formation", "formation: "),
                _ => return None,
            };
            let scope = Scope::new(true, LiteralFrame::World);
            let value = world.tentatively(|| self.within(scope, |lower| lower.name(name, span)));
            let ty = value.ty.written().map_or(String::new(), |ty| format!(": {ty}"));
            let params = around.item.kind.params();
            let ends = params.first().zip(params.last());
            let known = ends.map(|(first, last)| world.text(first.span.to(last.span)));
            let (known, more) =
                known.map_or((String::new(), ""), |known| (format!("{known}, "), "…, "));
            let item = &around.name.node;
            Some((
                format!("{head} {item}({known}{name}{ty})"),
                format!("{use_of}{item}({more}{name}: {name})"),
            ))
        });
        let noun = around.map_or("", |around| around.item.kind.noun());
        Some(Names::OfTheScenario { name: name.to_owned(), noun, form })
    }

    pub(crate) fn local(&mut self, name: &str, binding: LocalName<'w>, span: Span) -> Value<'w> {
        let value = match binding {
            LocalName::Value(value) | LocalName::Kept { value, .. } => value,
            LocalName::State { cells, before, ty, at } => {
                self.world.mark_used(at);
                match self.when {
                    When::Now => {
                        let now: Vec<Reg> =
                            cells.iter().map(|&cell| self.code.cell(cell)).collect();
                        Value::of_regs(ty, &now)
                    }
                    When::Prev => Value::of_regs(ty, &before),
                }
            }
            LocalName::Expr { expr, scope, ty, now, at } => {
                self.world.mark_used(at);
                let known = now.filter(|_| self.when == When::Now);
                known.unwrap_or_else(|| {
                    let value = self.inline(at, span, |lower| {
                        lower.within(scope, |lower| match ty {
                            Some(ty) => lower.want(expr, ty),
                            None => lower.expr(expr),
                        })
                    });
                    value.unwrap_or_else(Value::error)
                })
            }
        };
        if value.regs().iter().all(|&reg| self.code.is_visible(reg)) {
            return value;
        }
        self.fail(Problem::new(span, Scopes::ChangesWithinStep { name: name.to_owned() }))
    }

    pub(in super::super) fn scenario_name(
        &mut self,
        name: &'w str,
        span: Span,
    ) -> Option<Value<'w>> {
        let world = self.world;
        let named = world.flat.named(name);
        if let Some(Named::Param(at)) = named
            && let Some(info) = world.params.get(at)
        {
            world.mark_used(info.name.span);
            if info.bound.is_some() {
                return Some(self.scenario_let(name, span));
            }
            let reg = self.code.param(info.index);
            let repr = if info.ty == Ty::String {
                Repr::Choice(reg, info.choices.clone())
            } else {
                Repr::One(reg)
            };
            let repr = if info.ty == Ty::Error { Repr::Nothing } else { repr };
            return Some(Value { ty: info.ty, repr });
        }
        if let Some(Named::Let(at)) = named
            && let Some(binding) = world.flat.lets.get(at)
        {
            world.mark_used(binding.name.span);
            return Some(self.scenario_let(name, span));
        }
        if let Some(Named::Tuple(at, index)) = named
            && let Some(known) = world.flat.tuples.get(at).and_then(|(names, _)| names.get(index))
        {
            world.mark_used(known.span);
            return Some(self.scenario_let(name, span));
        }
        if let Some(Named::Const(at)) = named
            && let Some(binding) = world.flat.consts.get(at)
        {
            world.mark_used(binding.name.span);
            return Some(self.constant_item(binding, span));
        }
        if let Some(Named::Region(at)) = named
            && let Some(region) = world.flat.regions.get(at)
        {
            world.mark_used(region.name.span);
            let scope = Scope::new(true, LiteralFrame::World);
            let value = self.inline(region.name.span, span, |lower| {
                lower.within(scope, |lower| lower.want(&region.body, Ty::Region))
            });
            return Some(value.unwrap_or_else(Value::error));
        }
        self.player_name(name, None)
    }

    /// The round of the episode: the first one without `rounds`.
    fn round(&mut self, span: Span) -> Value<'w> {
        if !self.stage.is_step() && !matches!(self.stage, ProgramStage::Start(_)) {
            let (name, by) = ("round".to_owned(), BeforeOutside::Constant);
            return self.fail(Problem::new(span, Scopes::NotYetKnown { name, by }));
        }
        let several = self.world.flat.rounds.is_some();
        let round = if several { self.code.round() } else { self.code.constant(1.0) };
        Value::one(Ty::Int, round)
    }

    /// A player of the roster, or of one team.
    fn player_name(&mut self, name: &str, team: Option<Team>) -> Option<Value<'w>> {
        let mut players =
            self.world.roster.iter().filter(|player| team.is_none_or(|team| player.team == team));
        let player = players.find(|player| player.name.is_some_and(|known| known.node == name))?;
        if let Some(declared) = player.name {
            self.world.mark_used(declared.span);
        }
        Some(Value::one(Ty::Player, self.code.constant(f64::from(player.id))))
    }

    pub(in super::super) fn file_name(&mut self, name: &str, span: Span) -> Option<Value<'w>> {
        let library = self.world.library;
        let found = library.find(span.file, name)?;
        if let Some(problem) = library.ambiguous(span.file, name, span) {
            return Some(self.fail(problem));
        }
        self.world.mark_used(found.name.span);
        let noun = found.item.kind.noun();
        let no_value =
            |cure| Problem::new(span, Types::NotAValue { name: name.to_owned(), noun, cure });
        Some(match &found.item.kind {
            ItemKind::Const(binding) => self.constant_item(binding, span),
            ItemKind::Region(region) if region.params.is_empty() => {
                let scope = Scope::new(false, LiteralFrame::World);
                let at = region.name.span;
                let value = self.inline(at, span, |lower| {
                    lower.within(scope, |lower| lower.want(&region.body, Ty::Region))
                });
                value.unwrap_or_else(Value::error)
            }
            ItemKind::Formation(formation) => formation_value(formation),
            ItemKind::Fn(_) | ItemKind::Region(_) | ItemKind::Table(_) => {
                self.fail(no_value(Some(Use::Called)))
            }
            // A scenario or a reward may bear the name of a property; the property is meant here.
            _ if names::is_value(name) => return None,
            ItemKind::Reward(_)
                if matches!(self.stage, ProgramStage::Record | ProgramStage::Ending) =>
            {
                self.reward_is_no_value(name, span)
            }
            ItemKind::Behavior(_) => self.fail(no_value(Some(Use::Given))),
            _ => self.fail(no_value(None)),
        })
    }

    pub(crate) fn constant_item(
        &mut self,
        binding: &'w crate::ast::Binding,
        span: Span,
    ) -> Value<'w> {
        let ty = binding.ty.as_ref().map(|ty| super::super::param::declared_type(self.world, ty));
        let scope = Scope::new(false, LiteralFrame::World);
        // Whoever reads it, a constant is computed before anything else is known.
        let outer = (std::mem::replace(&mut self.stage, ProgramStage::Constant), self.team.take());
        let found = self.world.found();
        let value = self.inline(binding.name.span, span, |lower| {
            lower.within(scope, |lower| match ty {
                Some(ty) => lower.want(&binding.value, ty),
                None => lower.expr(&binding.value),
            })
        });
        (self.stage, self.team) = outer;
        // What can't be computed has been reported.
        let is_sound = self.world.found() == found;
        let value = value.filter(|_| is_sound).unwrap_or_else(Value::error);
        if value.regs().iter().any(|&reg| self.code.is_unknown(reg)) {
            return Value::error();
        }
        if value.regs().iter().any(|&reg| self.code.constant_of(reg).is_none()) {
            return self.fail(Problem::new(
                binding.value.span,
                Chance::NoConstant { name: binding.name.node.clone() },
            ));
        }
        value
    }

    fn builtin(&mut self, name: &str, span: Span) -> Option<Value<'w>> {
        let team = |reg: Reg| Value::one(Ty::Team, reg);
        Some(match name {
            "left" => team(self.code.constant(self.world.mirror.team(Team::Left).index() as f64)),
            "right" => team(self.code.constant(self.world.mirror.team(Team::Right).index() as f64)),
            "none" => team(self.code.constant(-1.0)),
            "nobody" => Value::one(Ty::Player, self.code.constant(-1.0)),
            "ball" => Value { ty: Ty::Ball, repr: Repr::Nothing },
            "event" => {
                let parts: Vec<String> =
                    EventField::NAMED.iter().map(|(part, _)| format!("event.{part}")).collect();
                self.fail(Problem::new(span, Types::EventIsNoValue { parts: parts.join("`, `") }))
            }
            "score" => Value { ty: Ty::Score, repr: Repr::Nothing },
            "round" => self.round(span),
            "round_elapsed" => {
                // Reports where the match is not known.
                if self.load(Field::Elapsed, None, name, span).is_none() {
                    return Some(Value::error());
                }
                Value::one(Ty::DURATION, self.code.round_elapsed())
            }
            "centre" => {
                let zero = self.code.constant(0.0);
                Value::two(Ty::Point, (zero, zero))
            }
            "pitch" | "centre_circle" => self.pitch_region(PitchRegion::from_name(name)?),
            "players" => {
                let both = self.code.constant(-1.0);
                Value { ty: Ty::Set, repr: Repr::Set(SetValue { team: both, except: None }) }
            }
            "us" => match self.team {
                Some(reg) if self.stage.is_step() => team(reg),
                _ => self.no_view(name, span),
            },
            "them" => match self.team {
                Some(reg) if self.stage.is_step() => team(self.code.unary(UnaryOp::OtherTeam, reg)),
                _ => self.no_view(name, span),
            },
            "me" if self.stage.has_me() => {
                self.remembered.has_view = true;
                Value::one(Ty::Player, self.code.me())
            }
            "mates" if self.stage.has_me() => match self.team {
                Some(us) => {
                    self.remembered.has_view = true;
                    let me = self.code.me();
                    Value { ty: Ty::Set, repr: Repr::Set(SetValue { team: us, except: Some(me) }) }
                }
                None => self.no_view(name, span),
            },
            "me" | "mates" => self.no_view(name, span),
            _ => {
                let property = names::match_property(name)?;
                self.match_value(property, span)
            }
        })
    }

    /// Whether `nobody` is written.
    pub(crate) fn is_nobody(&self, expr: &Expr) -> bool {
        matches!(&expr.kind, ExprKind::Name(name) if name == "nobody" && self.scope.find(name).is_none())
    }

    fn no_view(&self, name: &str, span: Span) -> Value<'w> {
        let why = match (&self.stage, name) {
            (ProgramStage::Ending | ProgramStage::Record, "us" | "them") => ViewOutside::BothTeams,
            (ProgramStage::Init, _) => ViewOutside::BeforeFirstStep,
            _ => ViewOutside::OutsideRewards,
        };
        self.fail(Problem::new(span, Scopes::NoView { name: name.to_owned(), why }))
    }

    fn match_value(&mut self, property: &'static Property, span: Span) -> Value<'w> {
        let field = match property.name {
            "possession" => Field::Possession,
            "elapsed" => Field::Elapsed,
            "remaining" => Field::Remaining,
            "game_mode" => Field::GameMode,
            _ => Field::BallDead,
        };
        match self.load(field, None, property.name, span) {
            Some(reg) => Value::one(Ty::of(property.ty), reg),
            None => Value::error(),
        }
    }

    /// Reads a number of the match; reports it where no match is under way.
    pub(crate) fn load(
        &mut self,
        field: Field,
        of: Option<Reg>,
        name: &str,
        span: Span,
    ) -> Option<Reg> {
        if self.stage.is_step() {
            return Some(self.code.load(field, of, self.when));
        }
        let by = match self.stage {
            ProgramStage::Constant => BeforeOutside::Constant,
            ProgramStage::Init => BeforeOutside::State,
            _ => BeforeOutside::Start,
        };
        self.report(Problem::new(span, Scopes::NotYetKnown { name: name.to_owned(), by }));
        None
    }

    /// Every name that could stand here.
    pub(crate) fn names_in_sight(&self, span: Span) -> Vec<String> {
        let mut known: Vec<String> = self.scope.names().into_iter().map(str::to_owned).collect();
        if let Some(team) = self.scope.players_of {
            let players = self.world.roster.iter().filter(|player| player.team == team);
            known.extend(players.filter_map(|player| player.name.map(|name| name.node.clone())));
        }
        if self.scope.scenario {
            let world = self.world;
            known.extend(world.params.iter().map(|param| param.name.node.clone()));
            known.extend(world.flat.lets.iter().map(|binding| binding.name.node.clone()));
            let shuffled = world.flat.tuples.iter().flat_map(|(names, _)| *names);
            known.extend(shuffled.map(|name| name.node.clone()));
            known.extend(world.flat.consts.iter().map(|binding| binding.name.node.clone()));
            known.extend(world.flat.regions.iter().map(|region| region.name.node.clone()));
            known.extend(
                world.roster.iter().filter_map(|player| player.name.map(|name| name.node.clone())),
            );
        }
        if self.scope.scenario && self.stage.judges() {
            known.extend(self.world.flat.records.iter().map(|record| record.name.node.clone()));
        }
        if matches!(self.stage, ProgramStage::Record | ProgramStage::Ending) {
            known.extend(self.world.flat.rewards.iter().map(|(name, ..)| name.clone()));
        }
        let visible = self.world.library.visible(span.file);
        known.extend(
            visible
                .filter(|(_, found)| found.item.kind.is_value())
                .map(|(name, _)| name.to_owned()),
        );
        known.extend(names::values().map(str::to_owned));
        known.extend(Role::ALL.iter().map(|role| role.name().to_owned()));
        let of_match = PROPERTIES.iter().filter(|property| property.owner == Owner::Match);
        known.extend(of_match.map(|property| property.name.to_owned()));
        known
    }

    /// A player of the roster by its register, if it is constant.
    pub(crate) fn roster_index(&self, player: Reg) -> Option<usize> {
        let id = self.code.constant_of(player)?;
        self.world.roster.iter().position(|rostered| f64::from(rostered.id) == id)
    }
}

fn formation_value(formation: &FormationItem) -> Value<'_> {
    Value { ty: Ty::Formation, repr: Repr::Formation(formation) }
}
