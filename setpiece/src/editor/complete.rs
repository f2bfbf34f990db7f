//! What may stand at a place of a text.

use super::text::word_at;
use super::words::{self, WordKind};
use super::{Analysis, Symbol, SymbolKind, Workspace};
use crate::dsl::ast::{Item, ItemKind};
use crate::dsl::parse::parse;
use crate::dsl::source::{FileId, SourceLoader};
use crate::files::FileLoader;
use crate::scenario::vocabulary::{EventField, Owner, PROPERTIES, Team, Unit};
use std::path::Path;

/// Something that may be written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Completion {
    /// What is written.
    pub text: String,
    /// What it is, in a few words.
    pub detail: String,
    /// What it means; may be empty.
    pub doc: String,
    /// Its kind.
    pub kind: CompletionKind,
}

/// What kind of thing is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CompletionKind {
    /// A word that begins or joins a statement.
    Keyword,
    /// A name that a file declares.
    Name,
    /// A word of the language's tables.
    Word,
    /// The key of an option.
    Key,
    /// A file that can be imported.
    File,
}

/// What is being written where the cursor stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Context<'a> {
    /// Nothing can be completed: a comment, or a text in quotes.
    Nothing,
    /// The path of an `import`.
    Import,
    /// What follows a dot; with the word before it.
    Member(&'a str),
    /// The unit of a number.
    Unit,
    /// An item of the file.
    TopLevel,
    /// The first word of a statement in this block.
    Statement(&'a str),
    /// The key of an option in this block.
    Key(&'a str),
    /// What follows this word: `extends`, `reward`, `formation`.
    After(&'a str),
    /// An expression, or another part of a statement.
    Inside,
}

const ITEMS: &[&str] = &[
    "abstract",
    "behavior",
    "check",
    "const",
    "curriculum",
    "ending",
    "fn",
    "formation",
    "import",
    "region",
    "reward",
    "scenario",
    "suite",
    "table",
];
const IN_SCENARIO: &[&str] = &[
    "agents",
    "ball",
    "const",
    "end",
    "kickoff",
    "let",
    "mirror",
    "observe",
    "param",
    "pitch",
    "record",
    "region",
    "remove",
    "require",
    "reward",
    "rounds",
    "rules",
    "start",
    "substitute",
    "team",
    "world",
];
const IN_TEAM: &[&str] = &["absent", "difficulty", "each", "formation", "maybe", "place"];
const IN_REWARD: &[&str] = &["give", "let", "on", "state", "when"];
const IN_BEHAVIOR: &[&str] =
    &["choose", "do", "else", "if", "interrupt", "let", "repeat", "state", "wait", "when"];

impl Workspace {
    /// What may stand at a byte of a text, in no order; the editor chooses by what is typed.
    pub fn complete(&mut self, path: &Path, offset: usize) -> Vec<Completion> {
        let Some(analysis) = self.analysis(path) else { return Vec::new() };
        let start = word_at(&analysis.text, offset).start;
        let before = analysis.text.get(..start.min(offset)).unwrap_or_default();
        let typed = analysis.text.get(start..offset).unwrap_or_default();
        match context(before, typed) {
            Context::Nothing => Vec::new(),
            Context::Import => library_files(),
            Context::Member(of) => members(of),
            Context::Unit => {
                Unit::ALL.iter().map(|unit| word(unit.name(), unit.doc(), "unit")).collect()
            }
            Context::TopLevel => keywords(ITEMS),
            Context::Statement(block) => analysis.statements(block),
            Context::Key(block) => keys(block),
            Context::After(what) => analysis.after(what),
            Context::Inside => analysis.values(),
        }
    }
}

/// What is written at the end of a text; `typed`: the part of the word that stands there already.
fn context<'a>(before: &'a str, typed: &str) -> Context<'a> {
    let line = before.rsplit('\n').next().unwrap_or_default();
    let quoted = line.matches('"').count() % 2 == 1;
    if quoted {
        let is_import = line.trim_start().starts_with("import");
        return if is_import { Context::Import } else { Context::Nothing };
    }
    if line.contains("//") {
        return Context::Nothing;
    }
    if let Some(base) = before.strip_suffix('.') {
        let range = word_at(base, base.len());
        return Context::Member(base.get(range).unwrap_or_default());
    }
    if typed.starts_with(|char: char| char.is_ascii_digit()) {
        return Context::Unit;
    }
    let trimmed = before.trim_end();
    let last = trimmed.get(word_at(trimmed, trimmed.len())).unwrap_or_default();
    let block = block_around(before);
    let begins = trimmed.is_empty()
        || trimmed.ends_with(['{', '}'])
        || line.trim().is_empty()
        || (trimmed.ends_with(',') && is_of_options(block));
    if matches!(last, "extends" | "reward" | "play" | "with") && !begins {
        return Context::After(last);
    }
    if trimmed.ends_with("formation:") {
        return Context::After("formation");
    }
    match (begins, block) {
        (true, "") => Context::TopLevel,
        (true, block) if is_of_options(block) => Context::Key(block),
        (true, block) => Context::Statement(block),
        (false, _) => Context::Inside,
    }
}

/// Whether the block of this word has options instead of statements.
fn is_of_options(block: &str) -> bool {
    matches!(block, "rules" | "world" | "pitch" | "agents" | "ball" | "start" | "stats" | "player")
}

/// The first word of the statement whose block is open at the end of a text: `rules` in
/// `rules { offside: off, `. `player` for a player's options; nothing outside every block.
fn block_around(before: &str) -> &str {
    let mut depth = 0;
    for (at, char) in before.char_indices().rev() {
        match char {
            '}' => depth += 1,
            '{' if depth > 0 => depth -= 1,
            '{' => {
                let head = before.get(..at).unwrap_or_default();
                let begin = head.rfind(['\n', '{', '}']).map_or(0, |at| at + 1);
                let head = head.get(begin..).unwrap_or_default().trim_start();
                let head = head.strip_prefix("abstract ").unwrap_or(head).trim_start();
                let first = head.get(word_at(head, 0)).unwrap_or_default();
                let outer = before.get(..begin).unwrap_or_default();
                let is_player = !is_head(first)
                    && block_around(outer.trim_end_matches('{')) == "team"
                    || block_around(outer) == "team";
                return if head.trim_end().ends_with("stats:") {
                    "stats"
                } else if is_player {
                    "player"
                } else {
                    first
                };
            }
            _ => {}
        }
    }
    ""
}

/// Whether a word begins an item or a statement with a block.
fn is_head(word: &str) -> bool {
    ITEMS.contains(&word) || IN_SCENARIO.contains(&word)
}

fn keywords(words: &[&str]) -> Vec<Completion> {
    let keyword = |word: &&str| Completion {
        text: (*word).to_owned(),
        detail: "statement".to_owned(),
        doc: String::new(),
        kind: CompletionKind::Keyword,
    };
    words.iter().map(keyword).collect()
}

fn word(text: &str, doc: &str, detail: &str) -> Completion {
    Completion {
        text: text.to_owned(),
        detail: detail.to_owned(),
        doc: doc.to_owned(),
        kind: CompletionKind::Word,
    }
}

/// The words of some kinds.
fn words_of(kinds: &[WordKind]) -> impl Iterator<Item = Completion> {
    let kinds = kinds.to_vec();
    words::all().filter(move |known| kinds.contains(&known.kind)).map(|known| {
        let detail = match known.kind {
            WordKind::Role => "role",
            WordKind::Event => "event",
            WordKind::Qualifier => "kind of event",
            WordKind::Function => "function",
            WordKind::Property => "property",
            WordKind::Place => "place",
            WordKind::Option => "option",
            WordKind::Stat => "ability",
            WordKind::Act => "act",
            WordKind::Action => "action",
            WordKind::Mode => "mode",
            WordKind::Type => "type",
        };
        word(known.name, known.doc, detail)
    })
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
        "event" => EventField::ALL
            .iter()
            .map(|field| word(field.name(), field.doc(), "of the event"))
            .collect(),
        "left" | "right" | "us" | "them" | "own" => {
            owned(Owner::Team).chain(words_of(&[WordKind::Place])).collect()
        }
        _ => owned(Owner::Player).collect(),
    }
}

/// The keys of a block of options.
fn keys(block: &str) -> Vec<Completion> {
    let page = match block {
        "rules" => "start.md",
        "world" => "world.md",
        "pitch" => "pitch.md",
        _ => "",
    };
    let of_tables =
        words::all().filter(|known| known.kind == WordKind::Option && known.page == page);
    let stats = words::all().filter(|known| known.kind == WordKind::Stat && block == "stats");
    let own: &[&str] = match block {
        "agents" => &["left", "right", "others", "switching"],
        "ball" => &["velocity", "height", "spin", "owner"],
        "start" => &["score", "elapsed"],
        "player" => &[
            "ai",
            "difficulty",
            "controllable",
            "stats",
            "fatigue",
            "yellow_cards",
            "velocity",
            "overlap",
        ],
        "rules" => &["half_time", "physics"],
        _ => &[],
    };
    of_tables
        .chain(stats)
        .map(|known| word(known.name, known.doc, "option"))
        .chain(own.iter().map(|name| word(name, "", "option")))
        .map(|key| Completion { kind: CompletionKind::Key, ..key })
        .collect()
}

/// The files of the library.
fn library_files() -> Vec<Completion> {
    let mut files: Vec<String> =
        FileLoader::anywhere().scenarios().into_iter().map(|(_, path)| path).collect();
    files.sort();
    files.dedup();
    let file = |path: String| Completion {
        text: path,
        detail: "of the library".to_owned(),
        doc: String::new(),
        kind: CompletionKind::File,
    };
    files.into_iter().map(file).collect()
}

impl Analysis {
    /// What a statement of this block begins with.
    fn statements(&self, block: &str) -> Vec<Completion> {
        match block {
            "scenario" => keywords(IN_SCENARIO),
            "team" | "formation" => {
                keywords(IN_TEAM).into_iter().chain(words_of(&[WordKind::Role])).collect()
            }
            "reward" | "on" | "when" => keywords(IN_REWARD),
            "behavior" | "repeat" | "choose" | "interrupt" => {
                keywords(IN_BEHAVIOR).into_iter().chain(words_of(&[WordKind::Act])).collect()
            }
            "check" => keywords(&["expect", "play"]),
            "curriculum" => keywords(&["mix", "stage"]),
            "suite" => self.after("extends"),
            _ => self.values(),
        }
    }

    /// What may follow a word.
    fn after(&self, what: &str) -> Vec<Completion> {
        let is_meant = |kind: &ItemKind| match what {
            "reward" => matches!(kind, ItemKind::Reward(_)),
            "formation" => matches!(kind, ItemKind::Formation(_)),
            "with" => matches!(kind, ItemKind::Behavior(_)),
            _ => matches!(kind, ItemKind::Scenario(_)),
        };
        let mut found: Vec<Completion> = self
            .items()
            .filter(|item| is_meant(&item.kind))
            .filter_map(|item| named(&item))
            .collect();
        if matches!(what, "extends" | "play") {
            let known = FileLoader::anywhere().scenarios().into_iter();
            found.extend(known.map(|(name, _)| Completion {
                text: name,
                detail: "a scenario of the library".to_owned(),
                doc: String::new(),
                kind: CompletionKind::Name,
            }));
        }
        found
    }

    /// What may stand in an expression.
    fn values(&self) -> Vec<Completion> {
        let name = |symbol: &Symbol| {
            let kind = match symbol.kind {
                SymbolKind::Parameter => "a parameter",
                SymbolKind::Player => "a player",
                SymbolKind::Value => "a value",
                SymbolKind::Function => "a function or region",
                _ => return None,
            };
            Some(Completion {
                text: symbol.name.clone(),
                detail: kind.to_owned(),
                doc: String::new(),
                kind: CompletionKind::Name,
            })
        };
        let mut own = Vec::new();
        let symbols = self.symbols();
        for symbol in &symbols {
            let inside = symbol.inside.iter();
            let deeper = symbol.inside.iter().flat_map(|inner| &inner.inside);
            own.extend(inside.chain(deeper).filter_map(name));
        }
        let is_value = |kind: &ItemKind| {
            matches!(
                kind,
                ItemKind::Const(_) | ItemKind::Fn(_) | ItemKind::Region(_) | ItemKind::Table(_)
            )
        };
        let items = self.items().filter(|item| is_value(&item.kind));
        own.extend(items.filter_map(|item| named(&item)));
        let of_match = PROPERTIES.iter().filter(|property| property.owner == Owner::Match);
        own.extend(of_match.map(|property| word(property.name, property.doc, property.ty.name())));
        own.extend(Team::ALL.iter().map(|team| word(team.name(), team.doc(), "team")));
        for (text, doc) in [
            ("us", "the own team"),
            ("them", "the other team"),
            ("me", "the agent's player, or the player of the behaviour"),
            ("mates", "the own team without the player"),
            ("ball", "the ball"),
            ("nobody", "no player"),
        ] {
            own.push(word(text, doc, "in the match"));
        }
        use WordKind::{Event, Function, Mode, Place, Qualifier, Role};
        own.extend(words_of(&[Function, Event, Qualifier, Place, Role, Mode]));
        own
    }

    /// The items of the text and of the files that it sees.
    fn items(&self) -> impl Iterator<Item = Item> {
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
        kind: CompletionKind::Name,
    })
}
