//! Checks a behaviour's state machine.

use super::{below, visible};
use crate::behavior::{Act, Behavior, Do, Node, Then};

/// The most nodes of one behaviour.
const NODES_MAX: usize = 20_000;
/// The most watches of one behaviour; each is checked in every step.
const WATCHES_MAX: usize = 1_000;

/// Checks the nodes and watches; the program is checked separately.
pub(super) fn verify_nodes(behavior: &Behavior, n_scripts: usize) -> Result<(), String> {
    let n = behavior.nodes.len();
    if n > NODES_MAX || behavior.watches.len() > WATCHES_MAX {
        return Err("too large".to_owned());
    }
    let cell = |cell: u32| below("memory cell", cell, behavior.program.cells as usize);
    for (at, node) in behavior.nodes.iter().enumerate() {
        let forward = |to: u32| {
            let ahead = to as usize > at && to as usize <= n;
            if ahead { Ok(()) } else { Err(format!("node {at} jumps to {to}, which is not ahead")) }
        };
        match node {
            Node::Do(Do { act: Act::Script { script, .. }, .. }) => {
                below("script", *script, n_scripts)?;
            }
            Node::Do(_) | Node::Return => {}
            Node::Let(pairs) | Node::Assign(pairs) => {
                pairs.iter().try_for_each(|(to, _)| cell(*to))?;
            }
            Node::Draw { cell: to, count, .. } => cell(*to).and_then(|()| cell(*count))?,
            Node::Branch { otherwise, .. } => forward(*otherwise)?,
            Node::Jump(to) => forward(*to)?,
            Node::Mark(mark) => cell(*mark)?,
            Node::Loop { to, mark } => {
                cell(*mark)?;
                if *to as usize >= at {
                    return Err(format!("the loop at {at} does not lead back"));
                }
            }
            Node::Finish { from, to } => {
                forward(*to)?;
                if *from as usize > at {
                    return Err(format!("node {at} leaves what it is not in"));
                }
            }
        }
    }
    for watch in &behavior.watches {
        let target = match watch.then {
            Then::Interrupt(body) => body,
            Then::Leave => watch.to,
        };
        if watch.from > watch.to || target < watch.to || target as usize > n {
            return Err("a watch leads nowhere".to_owned());
        }
    }
    let mut seen = Ok(());
    behavior.clone().regs_mut(&mut |reg| {
        if seen.is_ok() {
            seen = visible(&behavior.program, *reg);
        }
    });
    seen
}
