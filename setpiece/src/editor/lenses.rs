//! What stands above a declaration: commands, and how often it is used.

use super::{Analysis, FilePlace, Workspace};
use crate::dsl::ast::ItemKind;
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
        analysis
            .tree
            .items
            .iter()
            .flat_map(|item| self.above(path, &analysis, &item.kind))
            .collect()
    }

    fn above(&mut self, path: &Path, analysis: &Analysis, kind: &ItemKind) -> Vec<Lens> {
        let (name, is_counted) = match kind {
            ItemKind::Scenario(it) => (&it.name, it.is_abstract),
            ItemKind::Check(it) => (&it.name, false),
            ItemKind::Reward(it) => (&it.name, true),
            ItemKind::Formation(it) => (&it.name, true),
            ItemKind::Ending(it) | ItemKind::Region(it) | ItemKind::Fn(it) => (&it.name, true),
            ItemKind::Behavior(it) => (&it.name, true),
            _ => return Vec::new(),
        };
        let Some(range) = analysis.own(name.span) else { return Vec::new() };
        let lens = |title: &str, kind| Lens { range: range.clone(), title: title.to_owned(), kind };
        let named = || name.node.clone();
        match kind {
            ItemKind::Check(_) => vec![lens("run this check", LensKind::Check(named()))],
            ItemKind::Scenario(it) if !it.is_abstract => vec![
                lens("run 20 episodes", LensKind::Run(named())),
                lens("draw a start", LensKind::Draw(named())),
            ],
            _ if is_counted => {
                let mut uses = self.references(path, range.start);
                uses.retain(|place| place.path != path || place.range != range);
                let title = match uses.len() {
                    0 => "used nowhere here".to_owned(),
                    1 => "used once".to_owned(),
                    times => format!("used {times} times"),
                };
                vec![lens(&title, LensKind::Uses(uses))]
            }
            _ => Vec::new(),
        }
    }
}
