//! Behaviours: a state machine of nodes over one step program.
//!
//! Calls of other behaviours are written out, so that a player's behaviour is one list of nodes.
//! Arguments and conditions are registers of the program, which runs at every step; what is frozen
//! (`let`), remembered (`state`) or drawn lies in cells that nodes write when they are reached.

mod act;
mod statement;

use super::builder::RegisterLayout;
use super::step_world::StepWorld;
use super::value::{LiteralFrame, Scope};
use super::{Lower, ProgramStage};
use crate::ast::{Arg, BehaviorBody, BehaviorItem, Ident, Item, ItemKind, ScriptRef, Span};
use crate::check::types::Ty;
use crate::lower::known::{BehaviorUse, Draw, Scripted};
use crate::lower::script::{AskedHook, embed};
use crate::problem::facts::{Assigned, Behaviors, Names};
use crate::problem::{Guess, Problem};
use crate::source::FileId;
use setpiece_scenario::vocabulary::Primitive;
use setpiece_scenario::{Act, Ai, Behavior, Do, Node, PlayerSlot, Reg, Watch};

/// Most nodes that calls of behaviours may add up to.
const NODES_MAX: usize = 10_000;
/// Most calls that may be written out, and how deep they may lie in each other.
const CALLS_MAX: (usize, usize) = (2_000, 64);
/// Most interrupts, and calls with `until` or `for`, of one player's behaviour.
const WATCHES_MAX: usize = 500;

/// Lowers every behaviour that a player uses, and tells the players.
pub(crate) fn lower_behaviors<'w>(
    step: &StepWorld<'_, 'w>,
    uses: &[Scripted<'w>],
    players: &mut [PlayerSlot],
) -> Vec<Behavior> {
    let mut behaviors: Vec<Behavior> = Vec::new();
    for Scripted { index: player, which, used } in uses {
        let mut writer = BehaviorWriter::new(step);
        let name = match used {
            BehaviorUse::Named { item, args, scope, span } => {
                writer.lower.scope = scope.clone();
                writer.lower.streams.draw_for(&format!("behavior {}", item.name.node));
                writer.run(item, args, *span);
                item.name.node.clone()
            }
            BehaviorUse::Act { primitive, args, scope, span } => {
                writer.lower.scope = scope.clone();
                writer.lower.streams.draw_for(&format!("behavior {primitive}"));
                writer.alone(*primitive, args, *span);
                primitive.name().to_owned()
            }
            BehaviorUse::Script(script) => {
                writer.script(script, Vec::new());
                "script".to_owned()
            }
        };
        let behavior = writer.finish(name);
        let known = behaviors.iter().position(|known| *known == behavior);
        let index = known.unwrap_or_else(|| {
            behaviors.push(behavior);
            behaviors.len() - 1
        });
        if let Some(slot) = players.get_mut(*player) {
            let ai = slot.sometimes.get_mut(*which).map(|(_, ai)| ai);
            *ai.unwrap_or(&mut slot.ai) = Ai::Behavior(index as u32);
        }
    }
    check_unused(step);
    behaviors
}

/// Checks the behaviours of the root that no player of this scenario uses: their mistakes are
/// reported all the same.
fn check_unused(step: &StepWorld<'_, '_>) {
    let world = step.world;
    let root = FileId(0);
    let items = world.library.files.first().map_or(&[][..], |file| &file.items);
    for item in items {
        let ItemKind::Behavior(behavior) = &item.kind else { continue };
        if behavior.name.span.file != root || world.used.borrow().contains(&behavior.name.span) {
            continue;
        }
        lower_alone(step, behavior);
    }
}

/// Lowers a behaviour that nobody plays, for what is wrong with it.
pub(super) fn lower_alone<'w>(step: &StepWorld<'_, 'w>, behavior: &'w BehaviorItem) {
    let mut writer = BehaviorWriter::new(step);
    let mut scope = Scope::new(false, LiteralFrame::Own);
    writer.drawing(|writer| writer.lower.bind_any(&behavior.params, &mut scope));
    writer.body(behavior, scope);
}

/// Reports behaviours that hide a primitive.
pub(crate) fn report_names(items: &[Item], problems: &mut Vec<Problem>) {
    for item in items {
        let ItemKind::Behavior(BehaviorItem { name, .. }) = &item.kind else { continue };
        if Primitive::from_name(&name.node).is_some() {
            problems
                .push(Problem::new(name.span, Names::HidesPrimitive { name: name.node.clone() }));
        }
    }
}

/// A `state` of the behaviour that is being written.
struct State<'w> {
    name: &'w str,
    cells: Vec<u32>,
    ty: Ty,
}

/// Writes one player's behaviour.
struct BehaviorWriter<'c, 'w> {
    lower: Lower<'c, 'w>,
    nodes: Vec<Node>,
    watches: Vec<Watch>,
    states: Vec<State<'w>>,
    /// The names around the block that is being written.
    around: Scope<'w>,
    /// The behaviours under way: name, first node, and the nodes that leave it.
    calls: Vec<Call>,
    /// Behaviours written out so far.
    written: usize,
    too_large: bool,
}

struct Call {
    name: Span,
    from: usize,
    finishes: Vec<usize>,
}

impl<'c, 'w> BehaviorWriter<'c, 'w> {
    fn new(step: &'c StepWorld<'c, 'w>) -> BehaviorWriter<'c, 'w> {
        let mut lower = Lower::in_step(
            step,
            ProgramStage::Behavior(None),
            Scope::new(false, LiteralFrame::Own),
        );
        let us = lower.code.us();
        lower.team = Some(us);
        let (nodes, watches, states, calls) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        let around = lower.scope.clone();
        BehaviorWriter {
            lower,
            nodes,
            watches,
            states,
            around,
            calls,
            written: 0,
            too_large: false,
        }
    }

    /// Writes a behaviour out; its arguments are read in the present scope.
    fn run(&mut self, item: &'w BehaviorItem, args: &'w [Arg], span: Span) {
        if self.calls.iter().any(|call| call.name == item.name.span) {
            self.lower.report(Problem::new(
                span,
                Names::Recursion {
                    name: item.name.node.clone(),
                    declared: Some(item.name.span),
                    is_behavior: true,
                },
            ));
            return;
        }
        self.written += 1;
        let deep = self.written > CALLS_MAX.0 || self.calls.len() >= CALLS_MAX.1;
        if deep || self.nodes.len() > NODES_MAX || self.watches.len() > WATCHES_MAX {
            if !self.too_large {
                self.lower.report(Problem::new(
                    span,
                    Behaviors::TooLarge { name: item.name.node.clone() },
                ));
            }
            self.too_large = true;
            return;
        }
        let mut scope = Scope::new(false, LiteralFrame::Own);
        self.drawing(|writer| {
            writer.lower.bind_params(&item.name.node, &item.params, args, span, &mut scope, true);
        });
        self.lower.turn_angles(&item.params, &mut scope);
        self.body(item, scope);
    }

    fn body(&mut self, item: &'w BehaviorItem, scope: Scope<'w>) {
        let (outer, states) = (self.lower.scope.clone(), std::mem::take(&mut self.states));
        let around = std::mem::replace(&mut self.around, scope.clone());
        self.calls.push(Call {
            name: item.name.span,
            from: self.nodes.len(),
            finishes: Vec::new(),
        });
        match &item.body {
            BehaviorBody::Block(statements) => {
                self.lower.scope = scope;
                self.find_states(statements);
                self.block(statements, true);
            }
            BehaviorBody::Script(script) => {
                self.lower.scope = scope;
                let args = self.lower.script_args(&item.params, true);
                self.script(script, args);
            }
        }
        let end = self.nodes.len() as u32;
        if let Some(call) = self.calls.pop() {
            for at in call.finishes {
                self.patch(at, end);
            }
        }
        self.lower.scope = outer;
        self.states = states;
        self.around = around;
    }

    /// Runs `f`; the draws in what it reads happen before what comes next.
    fn drawing<T>(&mut self, f: impl FnOnce(&mut Self) -> T) -> T {
        let outer =
            std::mem::replace(&mut self.lower.stage, ProgramStage::Behavior(Some(Vec::new())));
        let result = f(self);
        let ProgramStage::Behavior(draws) = std::mem::replace(&mut self.lower.stage, outer) else {
            return result;
        };
        for Draw { cell, count, key, from } in draws.into_iter().flatten() {
            self.nodes.push(Node::Draw { cell, count, key, from });
        }
        result
    }

    fn script(&mut self, script: &'w ScriptRef, args: Vec<setpiece_scenario::ScriptArg>) {
        let own: Vec<&str> = args.iter().map(|arg| arg.name.as_str()).collect();
        let asked = AskedHook { name: "act", own: &own, terms: &[] };
        if let Some(script) = embed(&self.lower, script, asked) {
            let act = Act::Script { script, args };
            self.nodes.push(Node::Do(Do { act, sprint: false, until: None, seconds: None }));
        }
    }

    /// Tells a node where it jumps.
    fn patch(&mut self, at: usize, target: u32) {
        let node = self.nodes.get_mut(at);
        if let Some(Node::Branch { otherwise: to, .. } | Node::Jump(to) | Node::Finish { to, .. }) =
            node
        {
            *to = target;
        }
    }

    /// Reports an assignment to what is no state.
    fn not_a_state(&self, name: &Ident) {
        let states: Vec<&str> = self.states.iter().map(|state| state.name).collect();
        let is = if self.lower.scope.find(&name.node).is_some() {
            Assigned::Value
        } else {
            Assigned::Nothing
        };
        let guess = Guess::similar_or(&name.node, &states, &[]);
        self.lower.report(Problem::new(
            name.span,
            Names::NotAState { name: name.node.clone(), is, guess },
        ));
    }

    fn finish(self, name: String) -> Behavior {
        let mut behavior = Behavior {
            name,
            program: setpiece_scenario::Program::default(),
            nodes: self.nodes,
            watches: self.watches,
        };
        let mut roots: Vec<Reg> = Vec::new();
        behavior.regs_mut(&mut |reg| roots.push(*reg));
        let (program, layout): (_, RegisterLayout) = self.lower.code.finish(&roots);
        behavior.regs_mut(&mut |reg| *reg = layout.reg(*reg));
        behavior.program = program;
        behavior
    }
}
