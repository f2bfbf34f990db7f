//! The chains of rewards and formations that extend each other.

use super::load::Library;
use crate::ast::{FormationItem, ItemKind, Ref, RewardItem};
use crate::problem::facts::Names;
use crate::problem::{Guess, Problem};

/// Most parents of a scenario, reward or formation: a base, its variants and their levels are a
/// handful.
pub(crate) const MAX_PARENTS: usize = 32;

/// A link of a chain: the item, and the reference by which its child names it.
pub(crate) type ParentChain<'a, T> = Vec<(&'a T, Option<&'a Ref>)>;

/// A reward and its parents, the root first.
pub(crate) fn reward_chain<'a>(
    library: &'a Library,
    reward: &'a RewardItem,
    problems: &mut Vec<Problem>,
) -> ParentChain<'a, RewardItem> {
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
) -> ParentChain<'a, FormationItem> {
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
    kind: &'static str,
    extends: impl Fn(&'a T) -> Option<&'a Ref>,
    pick: impl Fn(&'a ItemKind) -> Option<&'a T>,
    problems: &mut Vec<Problem>,
) -> ParentChain<'a, T> {
    let mut chain: ParentChain<'a, T> = vec![(from, None)];
    let mut at = from;
    while let Some(parent_ref) = extends(at) {
        let name = &parent_ref.name;
        let Some(parent) =
            library.find(name.span.file, &name.node).and_then(|found| pick(&found.item.kind))
        else {
            let given = library
                .scenarios
                .iter()
                .filter(|_| kind == "scenario")
                .map(|(name, _)| name.as_str());
            let candidates = library
                .visible(name.span.file)
                .filter(|(_, found)| {
                    pick(&found.item.kind).is_some_and(|other| !std::ptr::eq(other, at))
                })
                .map(|(name, _)| name)
                .chain(given);
            let other =
                library.find(name.span.file, &name.node).map(|other| other.item.kind.noun());
            let guess =
                if other.is_none() { Guess::of(&name.node, candidates) } else { Guess::default() };
            let fact = Names::NoParent { kind, name: name.node.clone(), other, guess };
            problems.push(Problem::new(name.span, fact));
            break;
        };
        if let Some(begin) = chain.iter().position(|(known, _)| std::ptr::eq(*known, parent)) {
            // Whoever meets the circle tells of it at the same place.
            let circle = chain.iter().skip(begin + 1).filter_map(|(_, reference)| *reference);
            let first =
                circle.map(|reference| &reference.name).chain([name]).min_by_key(|name| name.span);
            let name = first.unwrap_or(name);
            problems
                .push(Problem::new(name.span, Names::ExtendsItself { name: name.node.clone() }));
            break;
        }
        if chain.len() > MAX_PARENTS {
            let at = extends(from).map_or(name.span, |parent| parent.name.span);
            problems.push(Problem::new(at, Names::TooManyParents { kind, most: MAX_PARENTS }));
            break;
        }
        chain.push((parent, Some(parent_ref)));
        at = parent;
    }
    chain.reverse();
    chain
}
