//! Items of a file that nothing uses: each is lowered once, for what is wrong with it in every use.
//!
//! Nothing is known of their parameters but the types. A warning depends on how an item is used, so
//! errors alone are kept.

use super::step_world::StepWorld;
use super::value::{LiteralFrame, LocalName, Scope, Value};
use super::{Lower, ProgramStage, behavior, ending, param, reward};
use crate::ast::{FnItem, Item, ItemKind, ParamDecl, Span};
use crate::check::types::Ty;
use crate::lower::known::StartState;
use crate::problem::Problem;
use setpiece_scenario::vocabulary::EventKind;
use std::cmp::Reverse;

/// Who may call a function or region: the stages of their programs, the likeliest first.
#[derive(Clone, Copy)]
enum Caller {
    Reward,
    /// A reward's `on` block.
    OnEvent,
    Behavior,
    Start,
}

/// Lowers an item, formations aside, and gives the errors in it.
pub(crate) fn check_alone<'w>(step: &StepWorld<'_, 'w>, item: &'w Item) -> Vec<Problem> {
    match &item.kind {
        ItemKind::Const(binding) => found_by(step, || {
            let scope = Scope::new(false, LiteralFrame::World);
            Lower::constant(step.world, scope).constant_item(binding, binding.name.span);
        }),
        ItemKind::Fn(item) => as_called(step, item, None, Scope::new(false, LiteralFrame::Own)),
        ItemKind::Region(item) => {
            as_called(step, item, Some(Ty::Region), Scope::new(false, LiteralFrame::World))
        }
        ItemKind::Table(item) => found_by(step, || {
            let mut lower = Caller::Reward.program(step);
            lower.rectangle(item.over.as_ref());
            lower.table_of(item);
        }),
        ItemKind::Ending(item) => found_by(step, || ending::lower_alone(step, item)),
        ItemKind::Reward(item) => found_by(step, || reward::lower_alone(step, item)),
        ItemKind::Behavior(item) => found_by(step, || behavior::lower_alone(step, item)),
        _ => Vec::new(),
    }
}

/// Reports the errors in a scenario's own regions that nothing in it uses.
pub(crate) fn check_regions(step: &StepWorld<'_, '_>) {
    let world = step.world;
    for region in &world.flat.regions {
        let name = region.name.span;
        if !world.flat.is_own(name) || world.used.borrow().contains(&name) {
            continue;
        }
        // What an unused region alone reads stays unused.
        let used = world.used.borrow().clone();
        let scope = Scope::new(true, LiteralFrame::World);
        let found = as_called(step, region, Some(Ty::Region), scope);
        world.used.replace(used);
        world.problems.borrow_mut().extend(found);
    }
}

/// The errors that a part reports.
fn found_by(step: &StepWorld<'_, '_>, part: impl FnOnce()) -> Vec<Problem> {
    let world = step.world;
    world.counts.take();
    let kept = world.problems.take();
    part();
    let mut found = world.problems.replace(kept);
    found.retain(Problem::is_error);
    found
}

/// How far a caller gets: it finds little that another one wouldn't, and little at all, and that
/// late.
fn reach(found: &[Problem]) -> (usize, usize, Reverse<Option<Span>>) {
    let of_caller = |problem: &&Problem| problem.code().depends_on_caller();
    let first = found.iter().map(Problem::place).min();
    (found.iter().filter(of_caller).count(), found.len(), Reverse(first))
}

/// The errors of a function or region: none if one of its callers finds none, else those of the
/// caller that gets furthest.
fn as_called<'w>(
    step: &StepWorld<'_, 'w>,
    item: &'w FnItem,
    ty: Option<Ty>,
    around: Scope<'w>,
) -> Vec<Problem> {
    let mut best: Option<Vec<Problem>> = None;
    let circular = step.world.circular.take();
    for caller in [Caller::Reward, Caller::OnEvent, Caller::Behavior, Caller::Start] {
        // What one caller found circular, the next one finds again.
        step.world.circular.replace(circular.clone());
        let found = found_by(step, || {
            let mut lower = caller.program(step);
            let mut scope = around.clone();
            lower.bind_any(&item.params, &mut scope);
            let written = item.ty.as_ref().map(|ty| param::declared_type(step.world, ty));
            lower.within(scope, |lower| match ty.or(written) {
                Some(ty) => lower.want(&item.body, ty),
                None => lower.expr(&item.body),
            });
        });
        if best.as_ref().is_none_or(|best| reach(&found) < reach(best)) {
            best = Some(found);
        }
        if best.as_ref().is_some_and(Vec::is_empty) {
            break;
        }
    }
    best.unwrap_or_default()
}

impl Caller {
    /// An empty program of it.
    fn program<'c, 'w>(self, step: &'c StepWorld<'c, 'w>) -> Lower<'c, 'w> {
        let scope = Scope::new(false, LiteralFrame::Own);
        let stage = match self {
            Caller::Reward | Caller::OnEvent => ProgramStage::Reward,
            Caller::Behavior => ProgramStage::Behavior(Some(Vec::new())),
            Caller::Start => return Lower::of_start(step.world, scope, StartState::default()),
        };
        let mut lower = Lower::in_step(step, stage, scope);
        lower.team = Some(lower.code.us());
        if matches!(self, Caller::OnEvent) {
            // A pass has everything that an event may have.
            lower.event = Some(EventKind::Pass);
        }
        lower
    }
}

impl<'w> Lower<'_, 'w> {
    /// Binds declared parameters to values of which the types alone are known.
    pub(super) fn bind_any(&mut self, params: &'w [ParamDecl], scope: &mut Scope<'w>) {
        for decl in params {
            let value = self.any_value(decl);
            self.check_hides(&decl.name.node, decl.name.span, scope);
            scope.bind(&decl.name.node, LocalName::Value(value));
        }
    }

    /// A value of a parameter's type of which nothing is known; its default where that has no
    /// numbers.
    fn any_value(&mut self, decl: &'w ParamDecl) -> Value<'w> {
        let declared = decl.ty.as_ref().map(|ty| param::declared_type(self.world, ty));
        let default = decl.default.as_ref().map(|default| {
            self.within(Scope::new(false, LiteralFrame::World), |lower| match declared {
                Some(ty) => lower.want(default, ty),
                None => lower.expr(default),
            })
        });
        if let (Some(expr), Some(value), Some(domain)) = (&decl.default, &default, &decl.domain) {
            self.check_domain(value, domain, expr, &decl.name.node);
        }
        let ty = match (declared, &default) {
            (Some(ty), _) => ty,
            (None, Some(value)) => value.ty,
            (None, None) => Ty::Error,
        };
        let unknown = self.code.unknown();
        match ty {
            Ty::Point | Ty::Vector | Ty::Velocity => Value::two(ty, (unknown, unknown)),
            Ty::Bool | Ty::Int | Ty::Player | Ty::Team | Ty::Role | Ty::Mode | Ty::Action => {
                Value::one(ty, unknown)
            }
            ty if ty.dim().is_some() => Value::one(ty, unknown),
            _ => default.unwrap_or_else(Value::error),
        }
    }
}
