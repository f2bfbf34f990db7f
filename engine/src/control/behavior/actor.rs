//! One player's progress through the nodes of their behaviour.

use super::perform::{Wish, WishStep, perform};
use crate::in_place::clone_in_place;
use crate::judge::machine::{DrawKey, Machine, truth};
use crate::judge::script::{Argument, HookScene, Memory, Perspective, ScriptError, Scripts, Shelf};
use crate::judge::view::player_index;
use crate::snapshot::{Archive, SnapshotError};
use crate::state::{Match, PlayerId};
use glam::Vec2;
use setpiece_scenario::pitch::STEPS_PER_S;
use setpiece_scenario::vocabulary::Action;
use setpiece_scenario::{Act, Behavior, Do, Node, Reg, Then, Watch};
use std::sync::Arc;

/// The most nodes in one step: more than any terminating behaviour needs, so that a damaged file
/// costs little.
const NODES_PER_STEP: u32 = 100_000;

/// A scripted player and their memory.
#[derive(Debug)]
pub struct Actor {
    /// The player.
    pub player: PlayerId,
    /// Their behaviour, by its index in the scenario.
    pub plan: usize,
    /// The memory of the behaviour's program.
    pub cells: Vec<[f64; 1]>,
    /// Where they are in it.
    pub thread: Thread,
}

clone_in_place! {
    Actor { player, plan, cells, thread }
}

/// A player's place in their behaviour.
#[derive(Debug)]
pub struct Thread {
    player: PlayerId,
    at: NodeProgress,
    /// What was interrupted, innermost last.
    interrupted: Vec<NodeProgress>,
    /// Steps so far.
    steps: u32,
    /// The last step in which each watch redirected the player; at most once per step.
    turned: Vec<u32>,
    /// One per script, by its node.
    memories: Vec<(u32, Memory)>,
}

clone_in_place! {
    Thread { player, at, interrupted, steps, turned, memories }
}

/// A node and how far it is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub struct NodeProgress {
    /// The node.
    pub node: u32,
    /// Steps spent on it.
    pub steps: u32,
    /// Whether its kick or slide has been requested.
    pub pressed: bool,
}

impl NodeProgress {
    fn at(node: u32) -> NodeProgress {
        NodeProgress { node, ..NodeProgress::default() }
    }
}

impl Actor {
    /// Creates a player before their first episode.
    pub fn new(player: PlayerId, plan: usize, behavior: &Behavior) -> Actor {
        let scripts = behavior.nodes.iter().enumerate().filter_map(|(at, node)| match node {
            Node::Do(Do { act: Act::Script { .. }, .. }) => Some((at as u32, Memory::default())),
            _ => None,
        });
        let thread = Thread {
            player,
            at: NodeProgress::default(),
            interrupted: Vec::with_capacity(behavior.watches.len()),
            steps: 0,
            turned: vec![0; behavior.watches.len()],
            memories: scripts.collect(),
        };
        Actor { player, plan, cells: vec![[0.0]; behavior.program.cells as usize], thread }
    }

    /// Begins an episode.
    pub fn reset(&mut self, behavior: &Behavior) {
        self.cells.fill([0.0]);
        for node in &behavior.nodes {
            if let Node::Let(pairs) = node {
                // Values read before they are frozen are empty.
                for (cell, _) in pairs {
                    self.cells[*cell as usize] = [f64::NAN];
                }
            }
        }
        self.thread.at = NodeProgress::default();
        self.thread.interrupted.clear();
        self.thread.steps = 0;
        self.thread.turned.fill(0);
        self.thread.memories.iter_mut().for_each(|(_, memory)| *memory = Memory::default());
    }

    /// Writes or reads what the player remembers.
    pub(crate) fn archive(
        &mut self,
        archive: &mut Archive<'_>,
        shelf: &mut Shelf,
    ) -> Result<(), SnapshotError> {
        let Thread { player: _, at, interrupted, steps, turned, memories } = &mut self.thread;
        archive.slots("cells", &mut self.cells)?;
        archive.value("at", at)?;
        archive.value("interrupted", interrupted)?;
        archive.value("steps", steps)?;
        archive.slots("turned", turned)?;
        memories.iter_mut().try_for_each(|(_, memory)| memory.archive("this", archive, shelf))
    }
}

/// The values that a behaviour sees in a step.
pub struct BehaviorMind<'a> {
    machine: Machine<'a>,
    /// Whether a cell was written since the registers were computed.
    stale: bool,
    seed: u64,
    index: u64,
    player: PlayerId,
}

impl<'a> BehaviorMind<'a> {
    /// Creates the values of a player; see [`Self::see`].
    pub fn new(machine: Machine<'a>, seed: u64, index: u64, player: PlayerId) -> BehaviorMind<'a> {
        BehaviorMind { machine, stale: false, seed, index, player }
    }

    /// Computes every value of the step.
    pub fn see(&mut self) {
        self.machine.begin();
        self.machine.run();
    }

    fn value(&mut self, reg: Reg) -> f64 {
        if std::mem::take(&mut self.stale) {
            self.machine.run_again();
        }
        self.machine.value(reg)
    }

    fn truth(&mut self, reg: Reg) -> bool {
        truth(self.value(reg))
    }

    fn point(&mut self, x: Reg, y: Reg) -> Vec2 {
        Vec2::new(self.value(x) as f32, self.value(y) as f32)
    }

    fn player(&mut self, reg: Reg) -> Option<PlayerId> {
        player_index(self.value(reg)).map(|index| PlayerId(index as u8))
    }

    /// Writes cells, all at once. `stopped`: impossible values are dropped.
    fn write(&mut self, pairs: &[(u32, Reg)], stopped: bool) {
        if let Some((_, first)) = pairs.first() {
            self.value(*first);
        }
        for (cell, reg) in pairs {
            let value = self.machine.value(*reg);
            if stopped && value.is_nan() {
                *self.machine.faults += 1;
            } else {
                self.machine.cells[*cell as usize] = [value];
            }
        }
        self.stale = true;
    }

    fn draw(&mut self, node: &Node) {
        let Node::Draw { cell, count, key, from } = node else { return };
        if std::mem::take(&mut self.stale) {
            self.machine.run_again();
        }
        let [drawn] = self.machine.cells[*count as usize];
        self.machine.cells[*count as usize] = [drawn + 1.0];
        // Players of one behaviour draw independently.
        let own =
            key.wrapping_add((u64::from(self.player.0) + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15));
        self.machine.draws =
            Some(DrawKey { seed: self.seed, index: self.index, attempt: drawn as u32 });
        self.machine.cells[*cell as usize] = [self.machine.draw(own, from)];
        self.stale = true;
    }
}

impl Thread {
    /// Chooses the action of a step.
    ///
    /// # Errors
    /// An `act` hook that failed.
    pub fn step(
        &mut self,
        plan: &Behavior,
        mind: &mut BehaviorMind<'_>,
        game: &Match,
        scene: Option<(&Scripts, &Arc<HookScene>)>,
    ) -> Result<Action, ScriptError> {
        let first = self.steps == 0;
        self.steps += 1;
        if self.at.node as usize >= plan.nodes.len() {
            return Ok(Action::BuiltinAi);
        }
        if first {
            self.begin(plan, mind);
        }
        // Watches are checked before anything the player would do.
        self.look_out(plan, mind);
        for _ in 0..NODES_PER_STEP {
            let Some(node) = plan.nodes.get(self.at.node as usize) else {
                return Ok(Action::BuiltinAi);
            };
            match node {
                Node::Do(_) if self.look_out(plan, mind) => {}
                Node::Do(doing) => match self.act(doing, mind, game, scene)? {
                    Some(action) => return Ok(action),
                    None => self.next(),
                },
                Node::Let(pairs) => {
                    mind.write(pairs, false);
                    self.next();
                }
                Node::Assign(pairs) => {
                    mind.write(pairs, true);
                    self.next();
                }
                Node::Draw { .. } => {
                    mind.draw(node);
                    self.next();
                }
                Node::Branch { when, otherwise } => {
                    if mind.truth(*when) {
                        self.next();
                    } else {
                        self.at = NodeProgress::at(*otherwise);
                    }
                }
                Node::Jump(to) => self.at = NodeProgress::at(*to),
                Node::Mark(cell) => {
                    mind.machine.cells[*cell as usize] = [f64::from(self.steps)];
                    self.next();
                }
                Node::Loop { to, mark } => {
                    let [began] = mind.machine.cells[*mark as usize];
                    self.at = NodeProgress::at(*to);
                    if began == f64::from(self.steps) {
                        return Ok(Action::Idle);
                    }
                }
                Node::Return => {
                    self.at = self.interrupted.pop().unwrap_or(NodeProgress::at(u32::MAX));
                }
                Node::Finish { from, to } => self.leave(*from, *to),
            }
        }
        Ok(Action::Idle)
    }

    fn next(&mut self) {
        self.at = NodeProgress::at(self.at.node + 1);
    }

    /// Sets the states before anything reads them.
    fn begin(&mut self, plan: &Behavior, mind: &mut BehaviorMind<'_>) {
        while let Some(node) = plan.nodes.get(self.at.node as usize) {
            match node {
                Node::Let(pairs) => mind.write(pairs, false),
                Node::Draw { .. } => mind.draw(node),
                _ => return,
            }
            self.next();
        }
    }

    /// Lets the first watch that holds redirect the player, each at most once per step. Returns
    /// whether one did.
    fn look_out(&mut self, plan: &Behavior, mind: &mut BehaviorMind<'_>) -> bool {
        let (here, now) = (self.at.node, self.steps);
        let mut open = plan.watches.iter().zip(&mut self.turned);
        let holds = |(watch, turned): &(&Watch, &mut u32)| {
            (watch.from..watch.to).contains(&here) && **turned != now && mind.truth(watch.when)
        };
        let Some((watch, turned)) = open.find(holds) else { return false };
        *turned = now;
        match watch.then {
            Then::Interrupt(body) if self.interrupted.len() < plan.watches.len() => {
                self.interrupted.push(self.at);
                self.at = NodeProgress::at(body);
            }
            Then::Interrupt(_) => {}
            Then::Leave => self.leave(watch.from, watch.to),
        }
        true
    }

    /// Continues after a part of the behaviour, with whatever was interrupted in it.
    fn leave(&mut self, from: u32, to: u32) {
        while self.interrupted.last().is_some_and(|frame| (from..to).contains(&frame.node)) {
            self.interrupted.pop();
        }
        self.at = NodeProgress::at(to);
    }

    /// Runs an action of a `do`; `None` once it has ended.
    fn act(
        &mut self,
        doing: &Do,
        mind: &mut BehaviorMind<'_>,
        game: &Match,
        scene: Option<(&Scripts, &Arc<HookScene>)>,
    ) -> Result<Option<Action>, ScriptError> {
        if doing.until.is_some_and(|until| mind.truth(until)) {
            return Ok(None);
        }
        if let Some(seconds) = doing.seconds {
            // The cast saturates; an impossible value is no time at all.
            let steps = libm::round(mind.value(seconds) * STEPS_PER_S) as u32;
            if self.at.steps >= steps {
                return Ok(None);
            }
        }
        let wish = match &doing.act {
            Act::MoveTo(x, y) => Wish::MoveTo(mind.point(*x, *y)),
            Act::Run(angle) => Wish::Run(mind.value(*angle) as f32),
            Act::DribbleTo(x, y) => Wish::DribbleTo(mind.point(*x, *y)),
            Act::PassTo(mate) => Wish::Pass(Action::ShortPass, mind.player(*mate)),
            Act::HighPassTo(mate) => Wish::Pass(Action::HighPass, mind.player(*mate)),
            Act::LongPassTo(mate) => Wish::Pass(Action::LongPass, mind.player(*mate)),
            Act::Shoot(at) => Wish::Shoot(at.map(|(x, y)| mind.point(x, y))),
            Act::Tackle => Wish::Tackle,
            Act::Slide => Wish::Slide,
            Act::Mark(who) => Wish::Mark(mind.player(*who)),
            Act::Press => Wish::Press,
            Act::Hold => Wish::Hold,
            Act::Bot => Wish::Bot,
            Act::Script { script, args } => {
                let Some((scripts, scene)) = scene else { return Ok(None) };
                let arguments: Vec<Argument<'_>> = args
                    .iter()
                    .map(|arg| {
                        let value = |mind: &mut BehaviorMind<'_>, i: usize| {
                            arg.regs.get(i).map_or(0.0, |reg| mind.value(*reg))
                        };
                        Argument {
                            name: &arg.name,
                            ty: arg.ty,
                            values: [value(mind, 0), value(mind, 1)],
                        }
                    })
                    .collect();
                let node = self.at.node;
                let Some((_, memory)) = self.memories.iter_mut().find(|(at, _)| *at == node) else {
                    return Ok(None);
                };
                let perspective =
                    Perspective { us: self.player.team(), me: Some(self.player), agent: 0 };
                let action = scripts.act(*script, scene, perspective, &arguments, memory)?;
                self.at.steps += 1;
                return Ok(Some(action));
            }
        };
        match perform(game, self.player, wish, doing.sprint, &mut self.at) {
            WishStep::Act(action) => {
                self.at.steps += 1;
                Ok(Some(action))
            }
            WishStep::Ended => Ok(None),
            WishStep::Impossible => {
                *mind.machine.faults += 1;
                Ok(None)
            }
        }
    }
}
