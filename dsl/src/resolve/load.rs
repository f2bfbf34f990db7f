//! Loads the files a root needs and says which names each of them sees.

use crate::ast::{
    CheckStmtKind, CurriculumStmtKind, File, FileId, Ident, Item, ItemKind, ParamDecl, Ref, Span,
    SuiteStmt, SuiteStmtKind,
};
use crate::index::Index;
use crate::parse::parse;
use crate::problem::Problem;
use crate::problem::facts::{Files, ImportLimit, Names};
use crate::source::{Source, SourceLoader, Sources};
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex};

/// The file whose names every other file sees without an import.
const PRELUDE: &str = "std/prelude.pitch";

/// Files may import each other this deep; a folder that is linked to itself would have no end.
pub(crate) const MAX_IMPORT_DEPTH: usize = 32;
/// A root may import this many files, those of its imports included, the library's apart.
pub(crate) const MAX_FILES: usize = 128;
/// Imported files and scripts may be this large together, bytes: as large as one file may be.
pub(crate) const MAX_IMPORTED_BYTES: usize = 1 << 20;
/// Longest prefix of a name by `import … as a`, bytes: those of imports of imports add up.
const PREFIX_MAX: usize = 256;

/// Every file of a compilation and the names that each sees.
pub(crate) struct Library {
    /// The texts.
    pub(crate) sources: Sources,
    /// The trees, by file.
    pub(crate) files: Vec<Arc<File>>,
    /// Names the loader was asked for, in order.
    pub(crate) inputs: Vec<String>,
    /// Scenarios that every file may extend without an import: name and path.
    pub(crate) scenarios: Vec<(String, String)>,
    imports: Vec<Vec<Import>>,
    prelude: Option<FileId>,
    /// Files of such scenarios, loaded because one of them is extended.
    extended: Vec<FileId>,
    seen: Vec<BTreeMap<String, Vec<ItemAt>>>,
    /// What editors want to know, if somebody asks. (A lock, because a prelude is shared.)
    pub(crate) index: Option<Mutex<Index>>,
}

#[derive(Clone)]
struct Import {
    file: FileId,
    alias: Option<String>,
}

/// An item, by file and place.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct ItemAt(FileId, usize);

/// A named item.
#[derive(Clone, Copy)]
pub(crate) struct NamedItem<'a> {
    /// The item.
    pub(crate) item: &'a Item,
    /// Its name.
    pub(crate) name: &'a Ident,
}

/// The files that every other one sees without an import, read once: parsing them is most of a
/// compilation.
pub struct Prelude {
    library: Library,
    problems: Vec<Problem>,
}

impl std::fmt::Debug for Prelude {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Prelude").field("files", &self.library.files.len()).finish_non_exhaustive()
    }
}

impl Prelude {
    /// Reads `std/prelude.pitch` and what it imports.
    pub fn load(loader: &dyn SourceLoader) -> Prelude {
        let (mut library, mut problems) = (Library::empty(loader), Vec::new());
        let mut loading = Loading::new(&mut library, loader, &mut problems);
        // The root's place: every file of the prelude has the same number in every compilation.
        loading.add(&Source { name: String::new(), text: "".into() });
        // A missing prelude is no mistake of the author's.
        if let Ok(source) = loader.load(PRELUDE, PRELUDE) {
            library.prelude = Some(loading.file(&source));
        }
        Prelude { library, problems }
    }
}

/// Loads a root and everything it imports; `guests` are texts that see what the root sees, and are
/// seen by nobody.
pub(crate) fn load(
    root: &Source,
    loader: &dyn SourceLoader,
    prelude: Option<&Prelude>,
    guests: &[Source],
    problems: &mut Vec<Problem>,
) -> (Library, Vec<FileId>) {
    let mut library = Library::empty(loader);
    library.inputs.push(root.name.clone());
    let own = prelude.is_none().then(|| Prelude::load(loader));
    let mut loading = Loading::new(&mut library, loader, problems);
    let id = loading.add(root);
    if let Some(prelude) = prelude.or(own.as_ref()) {
        loading.adopt(prelude);
    }
    loading.imports_of(id);
    let guests: Vec<FileId> = guests.iter().map(|guest| loading.guest(guest, id)).collect();
    loading.extended_scenarios();
    library.collect_names(&guests, problems);
    (library, guests)
}

struct Loading<'a> {
    library: &'a mut Library,
    loader: &'a dyn SourceLoader,
    problems: &'a mut Vec<Problem>,
    stack: Vec<FileId>,
    /// Files that are imported so far, and their bytes.
    files: usize,
    bytes: usize,
    /// Imports that found no file.
    missing: usize,
}

impl<'a> Loading<'a> {
    fn new(
        library: &'a mut Library,
        loader: &'a dyn SourceLoader,
        problems: &'a mut Vec<Problem>,
    ) -> Loading<'a> {
        Loading { library, loader, problems, stack: Vec::new(), files: 0, bytes: 0, missing: 0 }
    }
}

impl Loading<'_> {
    /// Loads the library's scenarios that some file extends or plays and no file declares.
    fn extended_scenarios(&mut self) {
        let mut next = 0;
        while let Some(file) = self.library.files.get(next) {
            next += 1;
            let mut wanted: Vec<&str> = Vec::new();
            file.items.iter().for_each(|item| scenarios_of(item, &mut wanted));
            let wanted: Vec<String> = wanted.into_iter().map(str::to_owned).collect();
            for name in wanted {
                let of_library = self.library.scenarios.iter().find(|(known, _)| *known == name);
                let Some(path) = of_library.map(|(_, path)| path.clone()) else { continue };
                if self.known(&path).is_some() {
                    continue;
                }
                let items = self.library.files.iter().flat_map(|file| &file.items);
                let declared = items.filter_map(item_name).any(|known| known.node == name);
                let Some(source) = Some(path)
                    .filter(|_| !declared)
                    .and_then(|path| self.loader.load(&path, &path).ok())
                else {
                    continue;
                };
                let file = self.file(&source);
                self.library.extended.push(file);
            }
        }
    }

    fn known(&self, name: &str) -> Option<FileId> {
        self.library.sources.iter().find(|(_, source)| source.name == name).map(|(id, _)| id)
    }

    /// Takes the files of the prelude behind the root.
    fn adopt(&mut self, prelude: &Prelude) {
        let read = &prelude.library;
        for ((_, source), (file, imports)) in
            read.sources.iter().zip(read.files.iter().zip(&read.imports)).skip(1)
        {
            self.library.sources.add(source.clone());
            self.library.files.push(file.clone());
            self.library.imports.push(imports.clone());
        }
        self.library.prelude = read.prelude;
        self.problems.extend(prelude.problems.iter().cloned());
        for input in &read.inputs {
            if !self.library.inputs.contains(input) {
                self.library.inputs.push(input.clone());
            }
        }
    }

    /// What a further file is too much for, if it is.
    fn too_much(&mut self, source: &Source, at: Span) -> Option<Problem> {
        if source.name.starts_with("std/") {
            return None;
        }
        self.files += 1;
        self.bytes += source.text.len();
        let limit = if self.stack.len() > MAX_IMPORT_DEPTH {
            ImportLimit::Depth(MAX_IMPORT_DEPTH)
        } else if self.files > MAX_FILES {
            ImportLimit::Files(MAX_FILES)
        } else if self.bytes > MAX_IMPORTED_BYTES {
            ImportLimit::Bytes(MAX_IMPORTED_BYTES)
        } else {
            return None;
        };
        Some(too_much(limit, at))
    }

    fn file(&mut self, source: &Source) -> FileId {
        let id = self.add(source);
        self.imports_of(id);
        id
    }

    fn add(&mut self, source: &Source) -> FileId {
        let id = self.library.sources.add(source.clone());
        let file = parse(source, id, self.problems);
        self.library.files.push(Arc::new(file));
        self.library.imports.push(Vec::new());
        id
    }

    fn guest(&mut self, source: &Source, root: FileId) -> FileId {
        let id = self.add(source);
        if let Some(list) = self.library.imports.get_mut(id.0 as usize) {
            list.push(Import { file: root, alias: None });
        }
        id
    }

    fn imports_of(&mut self, id: FileId) {
        let Some(file) = self.library.files.get(id.0 as usize).cloned() else { return };
        let from = self.library.sources.get(id).map_or(String::new(), |source| source.name.clone());
        let imports: Vec<_> = file
            .items
            .iter()
            .filter_map(|item| match &item.kind {
                ItemKind::Import { path, alias } => Some((path.clone(), alias.clone())),
                _ => None,
            })
            .collect();
        self.stack.push(id);
        for (path, alias) in imports {
            if self.missing > MAX_FILES {
                self.problems.push(too_much(ImportLimit::Missing(MAX_FILES), path.span));
                break;
            }
            let loaded = match self.loader.load(&path.node, &from) {
                Ok(loaded) => loaded,
                Err(error) => {
                    self.missing += 1;
                    self.library.inputs.extend(error.awaited);
                    let (why, similar) = (error.message, error.similar.into_iter().next());
                    self.problems.push(Problem::new(
                        path.span,
                        Files::Missing { why, similar, is_import: true },
                    ));
                    continue;
                }
            };
            if !self.library.inputs.contains(&loaded.name) {
                self.library.inputs.push(loaded.name.clone());
            }
            let known = self.known(&loaded.name);
            if known.is_none()
                && let Some(problem) = self.too_much(&loaded, path.span)
            {
                self.problems.push(problem);
                continue;
            }
            let imported = match known {
                Some(known) if self.stack.contains(&known) => {
                    self.problems.push(Problem::new(
                        path.span,
                        Files::ImportsItself { path: path.node.clone() },
                    ));
                    continue;
                }
                Some(known) => known,
                None => self.file(&loaded),
            };
            let import = Import { file: imported, alias: alias.map(|alias| alias.node) };
            if let Some(list) = self.library.imports.get_mut(id.0 as usize) {
                list.push(import);
            }
        }
        self.stack.pop();
    }
}

impl Library {
    fn empty(loader: &dyn SourceLoader) -> Library {
        Library {
            sources: Sources::default(),
            files: Vec::new(),
            inputs: Vec::new(),
            scenarios: loader.scenarios(),
            imports: Vec::new(),
            prelude: None,
            extended: Vec::new(),
            seen: Vec::new(),
            index: None,
        }
    }

    /// Notes something for editors, if one asks.
    pub(crate) fn note(&self, note: impl FnOnce(&mut Index)) {
        if let Some(index) = &self.index
            && let Ok(mut index) = index.lock()
        {
            note(&mut index);
        }
    }

    /// Notes that the name at `at` refers to a declaration. What isn't that name, such as a script
    /// that reads it, is left out; of a name with dots the last part is meant.
    pub(crate) fn refer(&self, at: Span, declaration: Span) {
        self.note(|index| {
            let (used, name) = (self.sources.text(at), self.sources.text(declaration));
            let Some(head) = used.strip_suffix(name).filter(|_| !name.is_empty()) else { return };
            if head.is_empty() || head.ends_with('.') {
                index.refer(Span { start: at.start + head.len() as u32, ..at }, declaration);
            }
        });
    }

    /// Notes that one declaration stands for another of the same name.
    pub(crate) fn relate(&self, one: Span, other: Span) {
        self.note(|index| {
            if self.sources.text(one) == self.sources.text(other) {
                index.relate(one, other);
            }
        });
    }

    /// An item that a file sees under a name.
    pub(crate) fn find(&self, file: FileId, name: &str) -> Option<NamedItem<'_>> {
        let at = self.seen.get(file.0 as usize)?.get(name)?.first()?;
        self.item(*at)
    }

    /// Reports a name that two imports of a file bring; `true` if there is something to report.
    pub(crate) fn ambiguous(&self, file: FileId, name: &str, span: Span) -> Option<Problem> {
        let places = self.seen.get(file.0 as usize)?.get(name)?;
        let (first, second) = (self.item(*places.first()?)?, self.item(*places.get(1)?)?);
        let of = |item: &NamedItem<'_>| {
            self.sources.get(item.name.span.file).map_or("", |file| file.name.as_str())
        };
        Some(Problem::new(
            span,
            Names::Ambiguous {
                name: name.to_owned(),
                files: (of(&first).to_owned(), of(&second).to_owned()),
            },
        ))
    }

    /// The file that another one imports under a name.
    pub(crate) fn imported_as(&self, file: FileId, alias: &str) -> Option<&str> {
        let mut imports = self.imports.get(file.0 as usize)?.iter();
        let import = imports.find(|import| import.alias.as_deref() == Some(alias))?;
        self.sources.get(import.file).map(|source| source.name.as_str())
    }

    /// Every name a file sees with its item, in the order of names.
    pub(crate) fn visible(&self, file: FileId) -> impl Iterator<Item = (&str, NamedItem<'_>)> {
        let seen = self.seen.get(file.0 as usize);
        seen.into_iter()
            .flatten()
            .filter_map(|(name, places)| Some((name.as_str(), self.item(*places.first()?)?)))
    }

    /// The item that a part of a file stands in.
    pub(crate) fn around(&self, part: Span) -> Option<NamedItem<'_>> {
        let items = &self.files.get(part.file.0 as usize)?.items;
        let at = items.iter().position(|item| item.span.holds(part))?;
        self.item(ItemAt(part.file, at))
    }

    fn item(&self, at: ItemAt) -> Option<NamedItem<'_>> {
        let item = self.files.get(at.0.0 as usize)?.items.get(at.1)?;
        Some(NamedItem { item, name: item_name(item)? })
    }

    fn collect_names(&mut self, guests: &[FileId], problems: &mut Vec<Problem>) {
        // A guest declares nothing: what it is made of would hide a name of the root's.
        let own = self.files.iter().map(|file| {
            if guests.contains(&file.id) { BTreeMap::new() } else { own_names(file, problems) }
        });
        let own: Vec<_> = own.collect();
        let mut seen = Vec::with_capacity(self.files.len());
        for id in 0..self.files.len() {
            let file = FileId(id as u32);
            let mut names = own.get(id).cloned().unwrap_or_default();
            let mut imported = BTreeMap::new();
            self.exports(file, &own, &mut vec![false; self.files.len()], "", &mut imported);
            merge(&mut names, imported);
            // The files of the prelude see each other through it, too.
            if let Some(prelude) = self.prelude {
                let mut given = own.get(prelude.0 as usize).cloned().unwrap_or_default();
                self.exports(prelude, &own, &mut vec![false; self.files.len()], "", &mut given);
                merge(&mut names, given);
            }
            for extended in &self.extended {
                merge(&mut names, own.get(extended.0 as usize).cloned().unwrap_or_default());
            }
            seen.push(names);
        }
        self.seen = seen;
    }

    /// Adds what the imports of a file bring, theirs included.
    fn exports(
        &self,
        file: FileId,
        own: &[BTreeMap<String, Vec<ItemAt>>],
        done: &mut Vec<bool>,
        prefix: &str,
        into: &mut BTreeMap<String, Vec<ItemAt>>,
    ) {
        if done.get(file.0 as usize) != Some(&false) {
            return;
        }
        if let Some(mark) = done.get_mut(file.0 as usize) {
            *mark = true;
        }
        for import in self.imports.get(file.0 as usize).into_iter().flatten() {
            let prefix = match &import.alias {
                Some(alias) => format!("{prefix}{alias}."),
                None => prefix.to_owned(),
            };
            if prefix.len() > PREFIX_MAX {
                continue;
            }
            for (name, places) in own.get(import.file.0 as usize).into_iter().flatten() {
                let list = into.entry(format!("{prefix}{name}")).or_default();
                for place in places {
                    if !list.contains(place) {
                        list.push(*place);
                    }
                }
            }
            self.exports(import.file, own, done, &prefix, into);
        }
    }
}

fn too_much(limit: ImportLimit, at: Span) -> Problem {
    Problem::new(at, Files::TooManyImports { limit })
}

/// What is nearer hides what is farther.
fn merge(names: &mut BTreeMap<String, Vec<ItemAt>>, farther: BTreeMap<String, Vec<ItemAt>>) {
    for (name, places) in farther {
        names.entry(name).or_insert(places);
    }
}

fn own_names(file: &File, problems: &mut Vec<Problem>) -> BTreeMap<String, Vec<ItemAt>> {
    let mut names: BTreeMap<String, Vec<ItemAt>> = BTreeMap::new();
    let mut spans: BTreeMap<&str, Span> = BTreeMap::new();
    for (index, item) in file.items.iter().enumerate() {
        let Some(name) = item_name(item) else { continue };
        distinct_params(item.kind.params(), problems);
        if let Some(first) = spans.get(name.node.as_str()) {
            problems.push(Problem::new(
                name.span,
                Names::DeclaredTwice { what: format!("`{}`", name.node), first: Some(*first) },
            ));
            continue;
        }
        spans.insert(&name.node, name.span);
        names.insert(name.node.clone(), vec![ItemAt(file.id, index)]);
    }
    names
}

/// The names of the scenarios that an item extends or plays.
fn scenarios_of<'a>(item: &'a Item, names: &mut Vec<&'a str>) {
    let mut add = |scenario: &'a Ref| names.push(scenario.name.node.as_str());
    match &item.kind {
        ItemKind::Scenario(scenario) => scenario.extends.iter().for_each(add),
        ItemKind::Suite(suite) => played(&suite.body, &mut add),
        ItemKind::Check(check) => check.body.iter().for_each(|stmt| {
            if let CheckStmtKind::Play { episodes, .. } = &stmt.kind {
                add(&episodes.scenario);
            }
        }),
        ItemKind::Curriculum(curriculum) => curriculum.body.iter().for_each(|stmt| {
            if let CurriculumStmtKind::Stage { scenario, .. } = &stmt.kind {
                add(scenario);
            }
        }),
        _ => {}
    }
}

/// The scenarios that the entries of a suite play.
fn played<'a>(body: &'a [SuiteStmt], add: &mut impl FnMut(&'a Ref)) {
    for stmt in body {
        match &stmt.kind {
            SuiteStmtKind::Sweep { body, .. } => played(body, add),
            SuiteStmtKind::Entry(episodes) => add(&episodes.scenario),
            SuiteStmtKind::Broken => {}
        }
    }
}

/// The name of an item, if it has one.
fn item_name(item: &Item) -> Option<&Ident> {
    match &item.kind {
        ItemKind::Scenario(scenario) => Some(&scenario.name),
        ItemKind::Reward(reward) => Some(&reward.name),
        ItemKind::Formation(formation) => Some(&formation.name),
        ItemKind::Const(binding) => Some(&binding.name),
        ItemKind::Fn(f) | ItemKind::Region(f) | ItemKind::Ending(f) => Some(&f.name),
        ItemKind::Behavior(behavior) => Some(&behavior.name),
        ItemKind::Table(table) => Some(&table.name),
        ItemKind::Suite(suite) => Some(&suite.name),
        ItemKind::Curriculum(curriculum) => Some(&curriculum.name),
        // Its name is a sentence, which nothing refers to.
        ItemKind::Check(_) | ItemKind::Import { .. } | ItemKind::Broken => None,
    }
}

/// Reports parameters of one name.
pub(super) fn distinct_params(params: &[ParamDecl], problems: &mut Vec<Problem>) {
    let mut known: BTreeMap<&str, Span> = BTreeMap::new();
    for ParamDecl { name, .. } in params {
        match known.get(name.node.as_str()) {
            Some(first) => problems.push(Problem::new(
                name.span,
                Names::DeclaredTwice { what: format!("`{}`", name.node), first: Some(*first) },
            )),
            None => drop(known.insert(&name.node, name.span)),
        }
    }
}
