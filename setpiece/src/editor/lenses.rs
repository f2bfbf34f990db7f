//! What stands above a declaration: commands, and how often it is used.

use super::uses::NameUses;
use super::{Analysis, FilePlace, Workspace};
use crate::dsl::ast::{Ident, ItemKind};
use std::collections::BTreeSet;
use std::ops::Range;
use std::path::Path;

/// Something above a declaration.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Lens {
    /// The bytes of the declared name.
    pub range: Range<usize>,
    /// What it says.
    pub title: String,
    /// What it does.
    pub kind: LensKind,
}

/// What a lens does.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum LensKind {
    /// Plays episodes of a scenario.
    Run(String),
    /// Draws a start of a scenario.
    Draw(String),
    /// Runs a check.
    Check(String),
    /// Shows where something is used.
    Uses(Vec<FilePlace>),
}

impl Workspace {
    /// What stands above the declarations of a text.
    pub fn lenses(&mut self, path: &Path) -> Vec<Lens> {
        let Some(analysis) = self.analysis(path) else { return Vec::new() };
        let items = &analysis.tree.items;
        let counted = items.iter().filter_map(|item| counted(&item.kind));
        let names: BTreeSet<String> = counted.map(|name| name.node.clone()).collect();
        let uses = if names.is_empty() { NameUses::default() } else { self.uses(&names) };
        items.iter().flat_map(|item| above(path, &analysis, &uses, &item.kind)).collect()
    }
}

/// The name of an item whose uses are counted.
fn counted(kind: &ItemKind) -> Option<&Ident> {
    match kind {
        ItemKind::Scenario(it) if it.is_abstract => Some(&it.name),
        ItemKind::Reward(it) => Some(&it.name),
        ItemKind::Formation(it) => Some(&it.name),
        ItemKind::Ending(it) | ItemKind::Region(it) | ItemKind::Fn(it) => Some(&it.name),
        ItemKind::Behavior(it) => Some(&it.name),
        _ => None,
    }
}

/// What stands above an item.
fn above(path: &Path, analysis: &Analysis, uses: &NameUses, kind: &ItemKind) -> Vec<Lens> {
    let lens = |name: &Ident, title: &str, kind: LensKind| {
        let range = analysis.own(name.span)?;
        Some(Lens { range, title: title.to_owned(), kind })
    };
    let named = |name: &Ident| name.node.clone();
    let found = match kind {
        ItemKind::Check(it) => {
            vec![lens(&it.name, "run this check", LensKind::Check(named(&it.name)))]
        }
        ItemKind::Scenario(it) if !it.is_abstract => vec![
            lens(&it.name, "run 20 episodes", LensKind::Run(named(&it.name))),
            lens(&it.name, "draw a start", LensKind::Draw(named(&it.name))),
        ],
        _ => counted(kind)
            .map(|name| {
                let range = analysis.own(name.span)?;
                let own = FilePlace { path: path.to_owned(), range };
                let mut places = uses.places(own.clone()).all();
                places.retain(|place| *place != own);
                let title = match places.len() {
                    0 => "used nowhere here".to_owned(),
                    1 => "used once".to_owned(),
                    times => format!("used {times} times"),
                };
                lens(name, &title, LensKind::Uses(places))
            })
            .into_iter()
            .collect(),
    };
    found.into_iter().flatten().collect()
}
