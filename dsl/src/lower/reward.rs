//! Rewards: a program at every step that pays into terms, and one at reset that sets the states.

mod audience;
mod state;
mod writer;

use super::step_world::StepWorld;
use super::value::{LiteralFrame, Scope};
use super::{Lower, ProgramStage, World};
use crate::ast::{
    Arg, Expr, ExprKind, ItemKind, ParamDecl, Ref, RewardItem, RewardStmt, RewardUse,
    RewardUseKind, ScriptRef, Span, Spanned,
};
use crate::problem::facts::{Chance, Kind, Names, Rewards};
use crate::problem::{Guess, Problem};
use crate::resolve::reward_chain;
use crate::source::FileId;
use setpiece_scenario::{Program, Reg, Reward, RewardBody};
use state::{check_names, states};
use writer::RewardWriter;

/// The label of a script's one term, which has no name of its own.
const SCRIPT_TERM: &str = "script";

/// A reward as it is written.
pub(super) struct WrittenReward<'w> {
    /// Its parents, the root first, and itself, with their arguments; nothing where it stands in a
    /// scenario.
    links: Vec<(&'w RewardItem, &'w [Arg])>,
    /// Its statements where it stands in a scenario.
    inline: &'w [RewardStmt],
    /// What uses it.
    span: Span,
    /// Whether nothing does, so that its parameters have no values.
    is_alone: bool,
}

impl<'w> WrittenReward<'w> {
    fn inline(body: &'w [RewardStmt], span: Span) -> WrittenReward<'w> {
        WrittenReward { links: Vec::new(), inline: body, span, is_alone: false }
    }

    fn named(
        world: &World<'w>,
        item: &'w RewardItem,
        args: &'w [Arg],
        span: Span,
    ) -> WrittenReward<'w> {
        let mut found = Vec::new();
        let chain = reward_chain(world.library, item, &mut found);
        for problem in found {
            world.report(problem);
        }
        for (parent, _) in chain.iter().filter(|(link, _)| !std::ptr::eq(*link, item)) {
            world.mark_used(parent.name.span);
        }
        let arguments = |link: &'w RewardItem, reference: Option<&'w Ref>| match reference {
            _ if std::ptr::eq(link, item) => args,
            Some(reference) => reference.args.as_slice(),
            None => &[],
        };
        let links =
            chain.into_iter().map(|(link, reference)| (link, arguments(link, reference))).collect();
        WrittenReward { links, inline: &[], span, is_alone: false }
    }

    /// Its statements, parents' first.
    fn statements(&self) -> Vec<&'w RewardStmt> {
        self.links.iter().flat_map(|(link, _)| &link.body).chain(self.inline).collect()
    }

    /// Binds its parameters; in a step program their values are computed at once.
    fn bind(&self, lower: &mut Lower<'_, 'w>) -> Scope<'w> {
        let mut scope = Scope::new(self.links.is_empty(), LiteralFrame::Own);
        for (index, (link, args)) in self.links.iter().enumerate() {
            // Arguments are read where the reward is used: in the scenario, in the world's frame.
            let in_scenario = index + 1 == self.links.len();
            if in_scenario && self.is_alone {
                lower.bind_any(&link.params, &mut scope);
                continue;
            }
            let now = matches!(lower.stage, ProgramStage::Reward);
            lower.within(Scope::new(in_scenario, LiteralFrame::World), |lower| {
                lower.bind_params(&link.name.node, &link.params, args, self.span, &mut scope, now);
            });
        }
        scope
    }
}

/// Lowers a reward that a scenario uses.
pub(crate) fn lower_use<'w>(
    step: &StepWorld<'_, 'w>,
    name: &str,
    used: &'w RewardUse,
    span: Span,
) -> Option<Reward> {
    let world = step.world;
    if world.effort.is_spent() {
        return None;
    }
    if let Some(weight) = &used.weight {
        check_weight(world, weight, name);
    }
    match &used.what {
        RewardUseKind::Script { script, terms } => {
            let labels = terms.as_ref().map(|terms| terms.node.as_slice()).unwrap_or_default();
            Some(lower_script(step, name, (script, labels), used))
        }
        RewardUseKind::Inline { .. } | RewardUseKind::Named(_) => {
            let (written, doc) = written(world, used, span)?;
            Some(lower_written(step, name, doc, &written, Some(used)))
        }
    }
}

/// The statements of a reward that a scenario uses, and what it is for; `None` of a script, or
/// after a report.
pub(super) fn written<'w>(
    world: &World<'w>,
    used: &'w RewardUse,
    span: Span,
) -> Option<(WrittenReward<'w>, String)> {
    let reference = match &used.what {
        RewardUseKind::Script { .. } => return None,
        RewardUseKind::Inline { body, .. } => {
            return Some((WrittenReward::inline(body, span), String::new()));
        }
        RewardUseKind::Named(reference) => reference,
    };
    let name = &reference.name;
    // A parent's `reward NAME` means what the scenario's own file sees first: names bind late.
    let own = world.library.find(FileId(0), &name.node);
    let own = own
        .filter(|found| !name.node.contains('.') && matches!(found.item.kind, ItemKind::Reward(_)));
    let found = own.or_else(|| world.library.find(name.span.file, &name.node));
    let Some((found, ItemKind::Reward(item))) = found.map(|found| (found, &found.item.kind)) else {
        unknown_reward(world, &name.node, name.span);
        return None;
    };
    if let Some(problem) = world.library.ambiguous(span.file, &name.node, name.span) {
        world.report(problem);
        return None;
    }
    world.mark_used(found.name.span);
    let written = WrittenReward::named(world, item, &reference.args, reference.span);
    Some((written, found.item.doc.clone()))
}

fn unknown_reward(world: &World<'_>, name: &str, span: Span) {
    let known: Vec<&str> = world
        .library
        .visible(span.file)
        .filter(|(_, found)| matches!(found.item.kind, ItemKind::Reward(_)))
        .map(|(name, _)| name)
        .collect();
    let guess = Guess::similar_or_all(name, &known);
    world.report(Problem::new(
        span,
        Names::Unknown { kind: Kind::Reward, name: name.to_owned(), guess },
    ));
}

/// Warns of a weight that is 0, whatever the parameters are.
fn check_weight<'w>(world: &World<'w>, weight: &'w Expr, name: &str) {
    if matches!(weight.kind, ExprKind::Number { value: 0.0, .. }) {
        world.report(Problem::new(weight.span, Rewards::WeightZero { reward: name.to_owned() }));
    }
}

/// A reward that is a script: its terms, or one, `script`.
fn lower_script<'w>(
    step: &StepWorld<'_, 'w>,
    name: &str,
    (script, labels): (&'w ScriptRef, &[Spanned<String>]),
    used: &'w RewardUse,
) -> Reward {
    let mut lower =
        Lower::in_step(step, ProgramStage::Reward, Scope::new(true, LiteralFrame::World));
    let us = lower.code.us();
    lower.team = Some(us);
    let payment = lower.payment(Some(used));
    let hooks = RewardWriter::script_alone(&mut lower, script, labels, payment);
    let (step, _) = lower.code.finish(&[]);
    let init = Program { code: Vec::new(), cells: step.cells, ..Program::default() };
    let mut terms: Vec<String> = labels.iter().map(|label| label.node.clone()).collect();
    if terms.is_empty() {
        terms.push(SCRIPT_TERM.to_owned());
    }
    let body = RewardBody { init, step, terms, hooks };
    Reward { name: name.to_owned(), doc: String::new(), body }
}

/// Every named reward in sight whose parameters all have defaults, for `--reward NAME`.
pub(crate) fn lower_library(step: &StepWorld<'_, '_>) -> Vec<Reward> {
    let world = step.world;
    let file = world.flat.item.name.span.file;
    let mut rewards = Vec::new();
    for (name, found) in world.library.visible(file) {
        let ItemKind::Reward(item) = &found.item.kind else { continue };
        if world.library.ambiguous(file, name, item.name.span).is_some() {
            continue;
        }
        if item.params.iter().all(|param| param.default.is_some()) && !world.effort.is_spent() {
            let written = WrittenReward::named(world, item, &[], item.name.span);
            rewards.push(lower_written(step, name, found.item.doc.clone(), &written, None));
        }
    }
    rewards
}

/// Lowers a reward that no scenario uses, for what is wrong with it.
pub(super) fn lower_alone<'w>(step: &StepWorld<'_, 'w>, item: &'w RewardItem) {
    let written = WrittenReward::named(step.world, item, &[], item.name.span);
    let written = WrittenReward { is_alone: true, ..written };
    lower_written(step, &item.name.node, String::new(), &written, None);
}

fn lower_written<'w>(
    step: &StepWorld<'_, 'w>,
    name: &str,
    doc: String,
    written: &WrittenReward<'w>,
    used: Option<&'w RewardUse>,
) -> Reward {
    let world = step.world;
    let statements = written.statements();
    world.effort.spend(statements.len());
    check_names(world, written);
    let states = states(&statements);

    let mut init = Lower::in_step(step, ProgramStage::Init, Scope::new(false, LiteralFrame::Own));
    let us = init.code.us();
    init.team = Some(us);
    init.scope = written.bind(&mut init);
    let firsts: Vec<_> = states.iter().map(|state| init.first_value(state)).collect();
    for value in &firsts {
        for reg in value.regs() {
            let cell = init.code.new_cell();
            init.code.assign(cell, reg, None);
        }
    }

    let mut lower =
        Lower::in_step(step, ProgramStage::Reward, Scope::new(false, LiteralFrame::Own));
    let us = lower.code.us();
    lower.team = Some(us);
    // The first cells are the states', as in the program that sets them.
    let cells: Vec<Vec<u32>> = firsts
        .iter()
        .map(|first| first.regs().iter().map(|_| lower.code.new_cell()).collect())
        .collect();
    let payment = lower.payment(used);
    lower.scope = written.bind(&mut lower);
    for ((state, first), cells) in states.iter().zip(&firsts).zip(cells) {
        let before = cells.iter().map(|&cell| lower.code.cell_before(cell)).collect();
        lower.bind_state(state, cells, before, first.ty);
    }
    let params: Vec<&ParamDecl> = written.links.iter().flat_map(|(link, _)| &link.params).collect();
    let writer::WrittenProgram { terms, mut hooks } =
        RewardWriter::write(&mut lower, &statements, Some(payment), params);
    let (mut init, _) = init.code.finish(&[]);
    let roots: Vec<Reg> =
        hooks.iter().flat_map(|hook| &hook.args).flat_map(|arg| &arg.regs).copied().collect();
    let (step, layout) = lower.code.finish(&roots);
    let fixed = step.fixed();
    for arg in hooks.iter_mut().flat_map(|hook| &mut hook.args) {
        arg.regs.iter_mut().for_each(|reg| *reg = layout.reg(*reg));
        if arg.regs.iter().any(|reg| !fixed.get(reg.index()).copied().unwrap_or_default()) {
            world.report(Problem::new(
                written.span,
                Chance::ScriptParameterChanges { name: arg.name.clone() },
            ));
        }
    }
    init.cells = step.cells;
    Reward { name: name.to_owned(), doc, body: RewardBody { init, step, terms, hooks } }
}
