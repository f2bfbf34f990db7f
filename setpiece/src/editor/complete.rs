//! What may stand at a place of a text.

use super::completion::{
    Completion, CompletionKind, PARAMETER, joining, keys, keywords, word, words_of,
};
use super::cursor::{CursorPlace, context, inline_script};
use super::keywords::KeywordBlock;
use super::outline::flat;
use super::place::{SCRIPTS, is_script};
use super::removable::removed;
use super::text::word_at;
use super::within::further;
use super::words::{self, WordKind};
use super::{Analysis, Symbol, SymbolKind, Workspace, script};
use crate::dsl::ast::{Item, ItemKind};
use crate::dsl::parse::parse;
use crate::dsl::source::{FileId, SourceLoader};
use crate::files::FileLoader;
use crate::scenario::vocabulary::{
    AGENTS, EventField, Landmark, Owner, PROPERTIES, PitchRegion, Role,
};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

impl Workspace {
    /// What may stand at a byte of a text, in no order; the editor chooses by what is typed.
    pub fn complete(&mut self, path: &Path, offset: usize) -> Vec<Completion> {
        let Some(text) = self.file_text(path) else { return Vec::new() };
        let start = word_at(&text, offset).start;
        let before = text.get(..start.min(offset)).unwrap_or_default();
        let typed = text.get(start..offset).unwrap_or_default();
        if is_script(path) {
            let names = self.named_beside(path);
            return script::complete(before, &names);
        }
        let Some(analysis) = self.analysis(path) else { return Vec::new() };
        if let Some(inside) = inline_script(before) {
            return script::complete(inside, &analysis.own_names());
        }
        match context(before, typed) {
            CursorPlace::Nothing => Vec::new(),
            CursorPlace::File(ending) => {
                // What is written of the path already stays.
                let written = before.rsplit('"').next().unwrap_or_default();
                let mut files = self.files(path, ending);
                files.retain(|it| it.text.starts_with(written));
                for file in &mut files {
                    file.text.drain(..written.len());
                }
                files
            }
            CursorPlace::Member(of) => members(of),
            CursorPlace::Unit => words_of(&[WordKind::Unit]).collect(),
            CursorPlace::TopLevel => keywords(KeywordBlock::File),
            CursorPlace::Statement(block) => {
                let mut found = analysis.statements(block);
                found.extend(further(before));
                found
            }
            CursorPlace::Key(block) => keys(block),
            CursorPlace::Quoted(ending) => {
                let quoted = |it: Completion| Completion { text: format!("\"{}\"", it.text), ..it };
                let files = self.files(path, ending).into_iter().map(quoted);
                files.chain(joining("rhai").filter(|_| ending == SCRIPTS)).collect()
            }
            CursorPlace::After(what) => analysis.after(what),
            CursorPlace::Measure => words_of(&[WordKind::Measure]).collect(),
            CursorPlace::Inside => match removed(before) {
                Some((what, statement)) => analysis.removable(what, statement),
                None => analysis.inside(before),
            },
        }
    }
}

/// What may follow `BASE.`.
fn members(base: &str) -> Vec<Completion> {
    let owned = |owner: Owner| {
        PROPERTIES
            .iter()
            .filter(move |property| property.owner == owner)
            .map(|property| word(property.name, property.doc, property.ty.name()))
    };
    match base {
        "ball" => owned(Owner::Ball).collect(),
        "event" => EventField::NAMED
            .iter()
            .map(|(name, ty)| {
                let doc = EventField::from_name(name).map_or("where it was", EventField::doc);
                word(name, doc, ty.name())
            })
            .collect(),
        "left" | "right" | "us" | "them" | "own" => {
            // What the whole pitch has is nobody's.
            let places = words_of(&[WordKind::Place]);
            let has_sides = |it: &Completion| PitchRegion::from_name(&it.text).is_none();
            owned(Owner::Team).chain(places.filter(has_sides)).collect()
        }
        // `anna.metres.x`
        "metres" => owned(Owner::Ball).filter(|it| matches!(it.text.as_str(), "x" | "y")).collect(),
        // `left.zone.CB`
        "zone" => words_of(&[WordKind::Role]).collect(),
        // Every place has these; an area has nothing.
        place if place == "centre" || words::is(place, WordKind::Place) => {
            let is_landmark = place == "centre" || Landmark::from_name(place).is_some();
            let of_places = ["x", "y", "metres"];
            owned(Owner::Ball)
                .filter(|it| is_landmark && of_places.contains(&it.text.as_str()))
                .collect()
        }
        _ => owned(Owner::Player).collect(),
    }
}

impl Workspace {
    /// The files that can be named: in the text's folder and those in it, and of the library.
    fn files(&self, path: &Path, ending: &str) -> Vec<Completion> {
        let folder = path.parent().unwrap_or(Path::new(""));
        let relative = |file: PathBuf| {
            let parts = file.strip_prefix(folder).ok()?.iter().map(|part| part.to_str());
            Some(parts.collect::<Option<Vec<_>>>()?.join("/"))
        };
        let files = self.files_in(folder, ending).into_iter().filter(|it| it != path);
        let mut beside: Vec<String> = files.filter_map(relative).collect();
        // Those of the folder itself first.
        beside.sort_by_key(|name| (name.matches('/').count(), name.clone()));
        let file = |text: String, detail: &str| Completion {
            text,
            detail: detail.to_owned(),
            doc: String::new(),
            snippet: String::new(),
            kind: CompletionKind::File,
        };
        let beside = beside.into_iter().map(|name| {
            let is_deeper = name.contains('/');
            file(name, if is_deeper { "in a folder beside this file" } else { "beside this file" })
        });
        let library = FileLoader::library_texts().filter(|(name, _)| name.ends_with(ending));
        beside.chain(library.map(|(name, _)| file(name, "of the library"))).collect()
    }

    /// What the texts that use a script name.
    fn named_beside(&mut self, path: &Path) -> Vec<Completion> {
        let roots = self.roots(path);
        roots.iter().filter_map(|root| self.analysis(root)).flat_map(|it| it.own_names()).collect()
    }
}

impl Analysis {
    /// What a statement of this block begins with.
    fn statements(&self, block: &str) -> Vec<Completion> {
        match KeywordBlock::of(block) {
            KeywordBlock::Team => keys(block)
                .into_iter()
                .chain(keywords(KeywordBlock::Team))
                .chain(words_of(&[WordKind::Role]))
                .collect(),
            KeywordBlock::Within if block == "suite" => self.after("extends"),
            KeywordBlock::Within => self.values(),
            block => keywords(block),
        }
    }

    /// What may follow a word.
    pub(super) fn after(&self, what: &str) -> Vec<Completion> {
        let is_meant = |kind: &ItemKind| match what {
            "reward" => matches!(kind, ItemKind::Reward(_)),
            "formation" => matches!(kind, ItemKind::Formation(_)),
            "with" | "behavior" => matches!(kind, ItemKind::Behavior(_)),
            _ => matches!(kind, ItemKind::Scenario(_)),
        };
        let mut found: Vec<Completion> = self
            .items()
            .filter(|item| is_meant(&item.kind))
            .filter_map(|item| named(&item))
            .collect();
        if what == "with" {
            found.extend(AGENTS.map(|name| word(name, "", "an agent")));
        }
        if matches!(what, "extends" | "play") {
            let known = FileLoader::anywhere().scenarios().into_iter();
            let seen: BTreeSet<String> = found.iter().map(|it| it.text.clone()).collect();
            let unseen = known.filter(|(name, _)| !seen.contains(name));
            found.extend(unseen.map(|(name, _)| Completion {
                text: name,
                detail: "a scenario of the library".to_owned(),
                doc: String::new(),
                snippet: String::new(),
                kind: CompletionKind::Name,
            }));
        }
        found
    }

    /// The parameters, players and values of the text's scenarios.
    pub(super) fn own_names(&self) -> Vec<Completion> {
        let name = |symbol: &Symbol| {
            let kind = match symbol.kind {
                SymbolKind::Parameter => PARAMETER,
                // Who has no name can't be referred to.
                SymbolKind::Player if Role::from_name(&symbol.name).is_some() => return None,
                SymbolKind::Player => "a player",
                SymbolKind::Value => "a value",
                SymbolKind::Function => "a function or region",
                _ => return None,
            };
            Some(Completion {
                text: symbol.name.clone(),
                detail: kind.to_owned(),
                doc: String::new(),
                snippet: String::new(),
                kind: CompletionKind::Name,
            })
        };
        let symbols = self.symbols();
        let inside = symbols.iter().flat_map(|symbol| flat(&symbol.inside));
        inside.filter_map(name).collect()
    }

    /// The items that have a value.
    pub(super) fn value_items(&self) -> Vec<Completion> {
        let items = self.items().filter(|item| item.kind.is_value());
        items.filter_map(|item| named(&item)).collect()
    }

    /// The items of the text and of the files that it sees.
    pub(super) fn items(&self) -> impl Iterator<Item = Item> {
        let others = self.sources.iter().skip(1);
        let parsed = others.flat_map(|(_, source)| parse(source, FileId(0), &mut Vec::new()).items);
        self.tree.items.clone().into_iter().chain(parsed)
    }
}

/// An item under its name.
fn named(item: &Item) -> Option<Completion> {
    let name = match &item.kind {
        ItemKind::Scenario(it) => &it.name,
        ItemKind::Reward(it) => &it.name,
        ItemKind::Formation(it) => &it.name,
        ItemKind::Const(it) => &it.name,
        ItemKind::Fn(it) | ItemKind::Region(it) | ItemKind::Ending(it) => &it.name,
        ItemKind::Table(it) => &it.name,
        ItemKind::Behavior(it) => &it.name,
        _ => return None,
    };
    Some(Completion {
        text: name.node.clone(),
        detail: item.kind.noun().to_owned(),
        doc: item.doc.trim().to_owned(),
        snippet: String::new(),
        kind: CompletionKind::Name,
    })
}
