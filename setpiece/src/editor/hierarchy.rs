//! What extends what, and what uses what.

use super::outline::{flat, of_file};
use super::{FilePlace, Symbol, SymbolKind, Workspace};
use crate::dsl::ast::{ItemKind, Ref};
use crate::dsl::parse::parse;
use crate::dsl::source::{FileId, Source};
use crate::files::name_of;
use std::collections::BTreeMap;
use std::ops::Range;
use std::path::Path;

/// An item of a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ItemNode {
    /// Its name.
    pub name: String,
    /// What it is.
    pub kind: SymbolKind,
    /// The place of its name.
    pub place: FilePlace,
    /// The bytes of all of it.
    pub whole: Range<usize>,
}

/// An item that uses another one, or is used by it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ItemUses {
    /// The other item.
    pub node: ItemNode,
    /// The bytes of the uses, in the file of the one that uses.
    pub at: Vec<Range<usize>>,
}

impl Workspace {
    /// The item whose name stands at a byte, or is meant there.
    pub fn node(&mut self, path: &Path, offset: usize) -> Option<ItemNode> {
        let place = self.declaration(path, offset)?;
        self.node_at(&place)
    }

    /// The item that is declared somewhere.
    fn node_at(&self, place: &FilePlace) -> Option<ItemNode> {
        let symbols = self.items_of(&place.path);
        let found = flat(&symbols).into_iter().find(|it| it.range == place.range)?;
        Some(ItemNode {
            name: found.name.clone(),
            kind: found.kind,
            place: place.clone(),
            whole: found.whole.clone(),
        })
    }

    /// What a file declares.
    pub(super) fn items_of(&self, path: &Path) -> Vec<Symbol> {
        let Some(text) = self.file_text(path) else { return Vec::new() };
        let source = Source { name: name_of(path), text };
        of_file(&parse(&source, FileId(0), &mut Vec::new()))
    }

    /// What an item extends.
    pub fn parents(&mut self, node: &ItemNode) -> Vec<ItemNode> {
        let Some(analysis) = self.analysis(&node.place.path) else { return Vec::new() };
        let mut refs = analysis.tree.items.iter().filter_map(|item| {
            let (name, parent) = extends(&item.kind)?;
            (analysis.own(name) == Some(node.place.range.clone())).then_some(parent)
        });
        let Some(parent) = refs.next().and_then(|parent| analysis.own(parent.name.span)) else {
            return Vec::new();
        };
        self.node(&node.place.path, parent.end).into_iter().collect()
    }

    /// What extends an item, in the open texts and the files beside them.
    pub fn children(&mut self, node: &ItemNode) -> Vec<ItemNode> {
        let mut children = Vec::new();
        for used in self.references(&node.place.path, node.place.range.start) {
            let Some(analysis) = self.analysis(&used.path) else { continue };
            let mut names = analysis.tree.items.iter().filter_map(|item| {
                let (name, parent) = extends(&item.kind)?;
                let at = analysis.own(parent.name.span)?;
                (at.end == used.range.end).then(|| analysis.own(name)).flatten()
            });
            if let Some(range) = names.next() {
                children.extend(self.node_at(&FilePlace { path: used.path.clone(), range }));
            }
        }
        children
    }

    /// The items that use one.
    pub fn callers(&mut self, node: &ItemNode) -> Vec<ItemUses> {
        let mut calls: Vec<ItemUses> = Vec::new();
        for used in self.references(&node.place.path, node.place.range.start) {
            if used == node.place {
                continue;
            }
            let symbols = self.items_of(&used.path);
            let holds = |it: &&Symbol| it.whole.contains(&used.range.start);
            let Some(user) = symbols.iter().find(holds) else { continue };
            let place = FilePlace { path: used.path.clone(), range: user.range.clone() };
            match calls.iter_mut().find(|call| call.node.place == place) {
                Some(call) => call.at.push(used.range),
                None => calls.push(ItemUses {
                    node: ItemNode {
                        name: user.name.clone(),
                        kind: user.kind,
                        place,
                        whole: user.whole.clone(),
                    },
                    at: vec![used.range],
                }),
            }
        }
        calls
    }

    /// The items that one uses.
    pub fn callees(&mut self, node: &ItemNode) -> Vec<ItemUses> {
        let Some(analysis) = self.analysis(&node.place.path) else { return Vec::new() };
        let mut found: BTreeMap<(std::path::PathBuf, usize), ItemUses> = BTreeMap::new();
        for (at, declared) in analysis.index.uses() {
            let own = analysis.own(at).filter(|own| node.whole.contains(&own.start));
            let (Some(own), Some(place)) = (own, analysis.place(declared)) else { continue };
            let inside = place.path == node.place.path && node.whole.contains(&place.range.start);
            if inside {
                continue;
            }
            let Some(target) = self.node_at(&place) else { continue };
            let key = (place.path.clone(), place.range.start);
            found.entry(key).or_insert(ItemUses { node: target, at: Vec::new() }).at.push(own);
        }
        found.into_values().collect()
    }
}

/// The place of an item's name, and what it extends.
fn extends(kind: &ItemKind) -> Option<(crate::dsl::ast::Span, &Ref)> {
    match kind {
        ItemKind::Scenario(it) => Some((it.name.span, it.extends.as_ref()?)),
        ItemKind::Reward(it) => Some((it.name.span, it.extends.as_ref()?)),
        ItemKind::Formation(it) => Some((it.name.span, it.extends.as_ref()?)),
        _ => None,
    }
}
