//! The chains of rewards and formations that extend each other.

use super::load::Library;
use crate::ast::{FormationItem, ItemKind, Ref, RewardItem};
use crate::problem::{Code, Problem};

/// Most parents of a scenario, reward or formation: a base, its variants and their levels are a handful.
pub(crate) const MAX_PARENTS: usize = 32;

/// A link of a chain: the item, and the reference by which its child names it.
pub(crate) type Chain<'a, T> = Vec<(&'a T, Option<&'a Ref>)>;

/// A reward and its parents, the root first.
pub(crate) fn reward_chain<'a>(
    library: &'a Library,
    reward: &'a RewardItem,
    problems: &mut Vec<Problem>,
) -> Chain<'a, RewardItem> {
    chain(
        library,
        reward,
        "reward",
        |item| item.extends.as_ref(),
        |kind| match kind {
            ItemKind::Reward(reward) => Some(reward),
            _ => None,
        },
        problems,
    )
}

/// A formation and its parents, the root first.
pub(crate) fn formation_chain<'a>(
    library: &'a Library,
    formation: &'a FormationItem,
    problems: &mut Vec<Problem>,
) -> Chain<'a, FormationItem> {
    chain(
        library,
        formation,
        "formation",
        |item| item.extends.as_ref(),
        |kind| match kind {
            ItemKind::Formation(formation) => Some(formation),
            _ => None,
        },
        problems,
    )
}

/// Follows `extends` from an item to its root, and gives the items root first.
pub(super) fn chain<'a, T>(
    library: &'a Library,
    from: &'a T,
    noun: &str,
    extends: impl Fn(&'a T) -> Option<&'a Ref>,
    pick: impl Fn(&'a ItemKind) -> Option<&'a T>,
    problems: &mut Vec<Problem>,
) -> Chain<'a, T> {
    let mut chain: Chain<'a, T> = vec![(from, None)];
    let mut at = from;
    while let Some(parent_ref) = extends(at) {
        let name = &parent_ref.name;
        let Some(parent) = library.find(name.span.file, &name.node).and_then(|found| pick(&found.item.kind)) else {
            let given = library.scenarios.iter().filter(|_| noun == "scenario").map(|(name, _)| name.as_str());
            let candidates = library
                .visible(name.span.file)
                .filter(|(_, found)| pick(&found.item.kind).is_some_and(|other| !std::ptr::eq(other, at)))
                .map(|(name, _)| name)
                .chain(given);
            let message = format!("no {noun} is called `{}`", name.node);
            let problem = Problem::legacy(Code::UnknownParent, name.span, message, "extends this");
            problems.push(match library.find(name.span.file, &name.node) {
                Some(other) => problem.help(format!("`{}` is {}", name.node, other.item.kind.noun())),
                None => problem.did_you_mean(&name.node, candidates),
            });
            break;
        };
        if let Some(begin) = chain.iter().position(|(known, _)| std::ptr::eq(*known, parent)) {
            // Whoever meets the circle tells of it at the same place.
            let circle = chain.iter().skip(begin + 1).filter_map(|(_, reference)| *reference);
            let first = circle.map(|reference| &reference.name).chain([name]).min_by_key(|name| name.span);
            let name = first.unwrap_or(name);
            problems.push(
                Problem::legacy(
                    Code::ExtendsCycle,
                    name.span,
                    format!("`{}` extends itself", name.node),
                    "closes the circle",
                )
                .help("take one `extends` of the circle away"),
            );
            break;
        }
        if chain.len() > MAX_PARENTS {
            let message = format!("a {noun} has more than {MAX_PARENTS} parents");
            let at = extends(from).map_or(name.span, |parent| parent.name.span);
            problems.push(
                Problem::legacy(Code::TooMuch, at, message, "too many")
                    .help("join some of them: a child may change everything that it inherits"),
            );
            break;
        }
        chain.push((parent, Some(parent_ref)));
        at = parent;
    }
    chain.reverse();
    chain
}
