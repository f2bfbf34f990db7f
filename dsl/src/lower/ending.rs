//! Endings: one program, and its conditions in order.

use super::script::{AskedHook, embed};
use super::step_world::StepWorld;
use super::substitute::lower_substitute;
use super::value::{LiteralFrame, Scope};
use super::{Lower, ProgramStage};
use crate::ast::{EndCondition, FnItem, ItemKind, Span};
use crate::problem::facts::{Kind, Names, Rewards};
use crate::problem::{Guess, Problem, nearest};
use crate::resolve::FlatEnding;
use setpiece_scenario::vocabulary::Verdict;
use setpiece_scenario::{Ending, Endings, Reg, Substitution};

/// Lowers the endings but for the limit.
pub(crate) fn lower_endings(step: &StepWorld<'_, '_>) -> Endings {
    let world = step.world;
    let scope = Scope::new(true, LiteralFrame::World);
    let mut lower = Lower::in_step(step, ProgramStage::Ending, scope);
    if let Some(team) = step.agents {
        let team = lower.code.constant(team.index() as f64);
        lower.team = Some(team);
    }
    let mut list = Vec::new();
    for ending in &world.flat.ends {
        list.extend(lower_ending(&mut lower, ending).map(|lowered| (lowered, ending.span)));
    }
    check_come_about(&lower, &list);
    let mut substitutions: Vec<_> = world
        .flat
        .substitutes
        .iter()
        .filter_map(|said| lower_substitute(&mut lower, said))
        .collect();
    let mut round = world.flat.rounds.map(|(rounds, _)| lower.condition(&rounds.when));
    if let (Some(when), Some((_, span))) = (round, world.flat.rounds) {
        check_rounds(&lower, when, span, &list);
    }
    if list.is_empty() && world.flat.limit.is_none() && round.is_none() {
        let name = &world.flat.item.name;
        world.report(Problem::new(name.span, Rewards::NeverEnds { scenario: name.node.clone() }));
    }
    let mut list: Vec<Ending> = list.into_iter().map(|(ending, _)| ending).collect();
    let wanted: Vec<Reg> = list.iter().filter_map(|ending| ending.when).chain(round).collect();
    let of_substitutions: Vec<Reg> = substitutions
        .iter_mut()
        .flat_map(|substitution| substitution.regs_mut().map(|reg| *reg).collect::<Vec<_>>())
        .collect();
    let wanted = [wanted, of_substitutions].concat();
    let (program, layout) = lower.code.finish(&wanted);
    for ending in &mut list {
        ending.when = ending.when.map(|reg| layout.reg(reg));
    }
    round = round.map(|reg| layout.reg(reg));
    for reg in substitutions.iter_mut().flat_map(Substitution::regs_mut) {
        *reg = layout.reg(*reg);
    }
    Endings { program, list, round, substitutions }
}

/// Warns of endings that no match comes to. What an abstract scenario says, its children may
/// change.
fn check_come_about(lower: &Lower<'_, '_>, list: &[(Ending, Span)]) {
    let flat = lower.world.flat;
    if flat.item.is_abstract {
        return;
    }
    let is_known = |when: &Reg| !lower.code.is_unknown(*when);
    for (at, (ending, span)) in list.iter().enumerate() {
        let Some(when) = ending.when.filter(is_known).filter(|_| flat.is_own(*span)) else {
            continue;
        };
        let label = || ending.label.clone();
        if lower.never_holds(when) {
            let fact = Rewards::NeverComes { label: label(), why: lower.why_never(when) };
            lower.report(Problem::new(*span, fact));
            continue;
        }
        let mut earlier = list.iter().take(at);
        let first =
            earlier.find(|(earlier, _)| earlier.when.is_some_and(|own| lower.implies(when, own)));
        if let Some((earlier, at)) = first {
            let fact = Rewards::Forestalled {
                label: label(),
                earlier: earlier.label.clone(),
                at: *at,
                is_inherited: flat.is_inherited(*at),
            };
            lower.report(Problem::new(*span, fact));
            continue;
        }
        let earlier = list.iter().take(at);
        let earlier: Vec<(Reg, &str)> = earlier
            .filter_map(|(earlier, _)| Some((earlier.when?, earlier.label.as_str())))
            .filter(|(when, _)| !lower.code.is_unknown(*when))
            .collect();
        if let Some(earlier) = together(lower, when, &earlier) {
            let mut them = list.iter().take(at).filter(|(one, _)| earlier.contains(&one.label));
            let is_inherited = them.all(|(_, at)| flat.is_inherited(*at));
            let fact = Rewards::ForestalledTogether { label: label(), earlier, is_inherited };
            lower.report(Problem::new(*span, fact));
        }
    }
}

/// The endings of which one holds in every way in which a condition does.
fn together(lower: &Lower<'_, '_>, when: Reg, earlier: &[(Reg, &str)]) -> Option<Vec<String>> {
    let mut all: Vec<String> = Vec::new();
    for way in lower.ways(when) {
        let names = lower.forestalling(way, earlier);
        if names.is_empty() {
            return None;
        }
        for name in names {
            if !all.iter().any(|known| known == name) {
                all.push(name.to_owned());
            }
        }
    }
    Some(all)
}

/// Warns of rounds that never end in one of their ways, since endings end the episode then.
fn check_rounds(lower: &Lower<'_, '_>, when: Reg, span: Span, list: &[(Ending, Span)]) {
    let flat = lower.world.flat;
    if flat.item.is_abstract || !flat.is_own(span) || lower.code.is_unknown(when) {
        return;
    }
    let endings: Vec<(Reg, &str)> = list
        .iter()
        .filter_map(|(ending, _)| Some((ending.when?, ending.label.as_str())))
        .filter(|(when, _)| !lower.code.is_unknown(*when))
        .collect();
    let mut earlier: Vec<String> = Vec::new();
    for way in lower.ways(when) {
        for label in lower.forestalling(way, &endings) {
            if !earlier.iter().any(|known| known == label) {
                earlier.push(label.to_owned());
            }
        }
    }
    if !earlier.is_empty() {
        lower.report(Problem::new(span, Rewards::NoNextRound { earlier }));
    }
}

/// Lowers an ending that no scenario uses, for what is wrong with it; some team has the agents.
pub(super) fn lower_alone<'w>(step: &StepWorld<'_, 'w>, item: &'w FnItem) {
    let mut scope = Scope::new(false, LiteralFrame::World);
    let mut lower = Lower::in_step(step, ProgramStage::Ending, scope.clone());
    lower.team = Some(lower.code.us());
    lower.bind_any(&item.params, &mut scope);
    lower.within(scope, |lower| lower.condition(&item.body));
}

fn lower_ending<'w>(lower: &mut Lower<'_, 'w>, ending: &FlatEnding<'w>) -> Option<Ending> {
    let verdict = match ending.verdict {
        Some(word) => Verdict::from_name(&word.node),
        None => None,
    };
    if let (Some(label), None) = (ending.label, verdict)
        && let Some(meant) =
            nearest(&label.name.node, Verdict::ALL.iter().map(|verdict| verdict.name()))
    {
        let name = &label.name.node;
        lower.report(Problem::new(
            label.name.span,
            Names::LikeAVerdict { label: name.clone(), meant },
        ));
    }
    let label = match (ending.label, verdict) {
        (Some(label), _) => label.bare().to_owned(),
        (None, Some(verdict)) => verdict.name().to_owned(),
        (None, None) => "end".to_owned(),
    };
    let mut lowered = Ending { verdict, label, when: None, script: None };
    match (ending.condition, ending.label) {
        (Some(EndCondition::Expr(condition)), _) => lowered.when = Some(lower.condition(condition)),
        (Some(EndCondition::Script(source)), _) => {
            let asked = AskedHook { name: "done", ..AskedHook::default() };
            lowered.script = Some(embed(lower, source, asked)?);
        }
        (None, Some(reference)) => {
            let found = lower.world.library.find(reference.name.span.file, &reference.name.node);
            let item = found.and_then(|found| match &found.item.kind {
                ItemKind::Ending(item) => Some((found.name.span, item)),
                _ => None,
            });
            let Some((at, item)) = item else {
                let known: Vec<&str> = lower
                    .world
                    .library
                    .visible(reference.name.span.file)
                    .filter(|(_, found)| matches!(found.item.kind, ItemKind::Ending(_)))
                    .map(|(name, _)| name)
                    .collect();
                let name = &reference.name.node;
                let guess = Guess::similar_or(name, &known, &[]);
                let fact = Names::Unknown { kind: Kind::Ending, name: name.clone(), guess };
                lower.report(Problem::new(reference.name.span, fact));
                return None;
            };
            lower.world.mark_used(at);
            let mut scope = Scope::new(false, LiteralFrame::World);
            lower.bind_params(
                &item.name.node,
                &item.params,
                &reference.args,
                reference.span,
                &mut scope,
                true,
            );
            let reg = lower.within(scope, |lower| lower.condition(&item.body));
            lowered.when = Some(reg);
        }
        (None, None) => {
            lower.report(Problem::new(ending.span, Rewards::EndsWhen));
            return None;
        }
    }
    Some(lowered)
}
