//! The scenarios that a scenario extends.

use crate::dsl::ast::{Item, ItemKind, ScenarioItem};

/// How many parents are followed.
const PARENTS_MAX: usize = 32;

/// A scenario and those that it extends, the nearest first.
///
/// - `parent`: finds the one that a scenario extends.
pub(super) fn with_parents<T>(own: T, parent: impl Fn(&T) -> Option<T>) -> impl Iterator<Item = T> {
    std::iter::successors(Some(own), parent).take(1 + PARENTS_MAX)
}

/// A scenario of some items.
pub(super) fn scenario_named<'a>(items: &'a [Item], name: &str) -> Option<&'a ScenarioItem> {
    items.iter().find_map(|item| match &item.kind {
        ItemKind::Scenario(it) if it.name.node == name => Some(it),
        _ => None,
    })
}
