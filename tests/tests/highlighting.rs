//! The editors' grammars agree with the pest grammar. `grammar/setpiece.tmLanguage.json` is run as
//! in an editor over every text of the repository, and the word lists of
//! `grammar/tree-sitter/grammar.js` are compared.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

use pest::Parser;
use regex::bytes::{Regex, RegexBuilder};
use serde_json::Value;
use setpiece_grammar::{PitchParser, Rule};
use setpiece_scenario::vocabulary::{EventKind, Function, Qualifier, Role, Type, Unit};
use std::collections::BTreeSet;
use std::ops::Range;
use std::path::{Path, PathBuf};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn read(path: &str) -> String {
    std::fs::read_to_string(root().join(path)).unwrap()
}

/// A pattern of the editors' grammar.
struct Pattern {
    begin: Regex,
    /// Scopes of the whole, and of its groups.
    scope: String,
    groups: Vec<(usize, String)>,
    /// Its end; a `match` has none.
    end: Option<Regex>,
    /// What is skipped inside it: an escaped quote doesn't end a string.
    inner: Vec<Regex>,
}

impl Pattern {
    /// Its end in a line, from a place inside it.
    fn end_in(&self, line: &[u8], from: usize) -> Option<usize> {
        let mut at = from;
        loop {
            let end = self.end.as_ref()?.find_at(line, at)?;
            let over = self
                .inner
                .iter()
                .filter_map(|inner| inner.find_at(line, at))
                .min_by_key(regex::bytes::Match::start);
            match over.filter(|over| over.start() < end.start()) {
                Some(over) => at = over.end(),
                None => return Some(end.end()),
            }
        }
    }
}

fn regex(text: &str) -> Regex {
    RegexBuilder::new(text).unicode(false).build().unwrap_or_else(|why| panic!("{text}: {why}"))
}

/// The patterns in order, with includes resolved.
fn patterns(grammar: &Value, list: &Value, into: &mut Vec<Pattern>) {
    for entry in list.as_array().unwrap() {
        if let Some(name) = entry["include"].as_str() {
            let name = name.strip_prefix('#').expect("an include of this grammar");
            patterns(grammar, &grammar["repository"][name]["patterns"], into);
            continue;
        }
        let groups = entry["captures"].as_object().into_iter().flatten();
        into.push(Pattern {
            begin: regex(entry["match"].as_str().or(entry["begin"].as_str()).unwrap()),
            scope: entry["name"].as_str().unwrap_or_default().to_owned(),
            groups: groups
                .map(|(n, group)| (n.parse().unwrap(), group["name"].as_str().unwrap().to_owned()))
                .collect(),
            end: entry["end"].as_str().map(regex),
            inner: entry["patterns"]
                .as_array()
                .into_iter()
                .flatten()
                .filter_map(|p| p["match"].as_str().map(regex))
                .collect(),
        });
    }
}

/// An editor's highlighter.
struct Highlighter(Vec<Pattern>);

impl Highlighter {
    fn new() -> Highlighter {
        let grammar: Value =
            serde_json::from_str(&read("grammar/setpiece.tmLanguage.json")).unwrap();
        let mut all = Vec::new();
        patterns(&grammar, &grammar["patterns"], &mut all);
        assert!(all.len() > 15);
        Highlighter(all)
    }

    /// The scope of every byte, line by line: the earliest match wins, and among equals the first
    /// pattern's.
    fn scopes(&self, text: &str) -> Vec<&str> {
        let mut scopes = vec![""; text.len()];
        let (mut start, mut open): (usize, Option<&Pattern>) = (0, None);
        for line in text.split_inclusive('\n') {
            let bytes = line.trim_end_matches(['\n', '\r']).as_bytes();
            let mut at = 0;
            loop {
                if let Some(pattern) = open {
                    let end = pattern.end_in(bytes, at);
                    let until = end.unwrap_or(bytes.len());
                    scopes[start + at..start + until].fill(&pattern.scope);
                    at = until;
                    if end.is_none() {
                        break;
                    }
                    open = None;
                }
                let first = |(index, pattern): (usize, &Pattern)| {
                    pattern.begin.find_at(bytes, at).map(|found| (found.start(), index))
                };
                let Some((_, index)) = self.0.iter().enumerate().filter_map(first).min() else {
                    break;
                };
                let pattern = &self.0[index];
                let found = pattern.begin.captures_at(bytes, at).unwrap();
                let whole = found.get(0).unwrap();
                assert!(!whole.is_empty(), "{} matches nothing", pattern.begin);
                scopes[start + whole.start()..start + whole.end()].fill(&pattern.scope);
                for (group, scope) in &pattern.groups {
                    if let Some(part) = found.get(*group) {
                        scopes[start + part.start()..start + part.end()].fill(scope);
                    }
                }
                at = whole.end();
                open = pattern.end.is_some().then_some(pattern);
            }
            start += line.len();
        }
        scopes
    }
}

fn files(folder: &Path, into: &mut Vec<PathBuf>) {
    for path in std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
        if path.is_dir() {
            files(&path, into);
        } else if path.extension().is_some_and(|ending| ending == "pitch") {
            into.push(path);
        }
    }
}

/// Every text of the repository that pest parses, and the specification's files case by case.
fn texts() -> Vec<String> {
    let mut paths = Vec::new();
    for folder in ["stdlib-scenarios", "examples", "dsl/tests", "tests/spec"] {
        files(&root().join(folder), &mut paths);
    }
    let mut texts = Vec::new();
    for path in paths {
        let mut part = String::new();
        for line in std::fs::read_to_string(path).unwrap().lines() {
            if line.starts_with("--- ") || line.starts_with("+++ ") {
                texts.push(std::mem::take(&mut part));
            } else {
                part += line;
                part.push('\n');
            }
        }
        texts.push(part);
    }
    assert!(texts.len() > 150);
    texts
}

/// The required scope of a pest token; `None` for names, which may have any.
fn wanted(rule: Rule, text: &str) -> Option<&'static [&'static str]> {
    Some(match rule {
        Rule::doc => &["comment.block.documentation"],
        Rule::string | Rule::raw_string => &["string."],
        Rule::role => &["constant.language.role"],
        Rule::boolean => &["constant.language.boolean"],
        Rule::number => &["constant.numeric"],
        Rule::unit | Rule::long_unit => &["keyword.other.unit"],
        Rule::over_kind => &["support.function"],
        Rule::callee if Function::from_name(text).is_some() => &["support.function"],
        // Some events are also keywords of statements.
        Rule::event_name => &["support.constant.event", "keyword."],
        Rule::qualifier => &["support.constant.qualifier", "keyword."],
        _ if format!("{rule:?}").starts_with("kw_") => &["keyword."],
        _ => return None,
    })
}

#[test]
fn every_token_that_pest_sees_is_highlighted_as_what_it_is() {
    let highlighter = Highlighter::new();
    let (mut seen, mut rules) = (0, BTreeSet::new());
    for text in texts() {
        let Ok(tokens) = PitchParser::parse(Rule::file, &text) else { continue };
        let scopes = highlighter.scopes(&text);
        let mut last = 0;
        for token in tokens.flatten() {
            let (rule, range) = (token.as_rule(), token.as_span().start()..token.as_span().end());
            if rule == Rule::junk {
                // What pest doesn't split has no tokens; neither has what could not be parsed.
                last = last.max(range.end);
                continue;
            }
            let Some(wanted) = wanted(rule, token.as_str()).filter(|_| range.start >= last) else {
                continue;
            };
            let bytes = text[range.clone()].bytes().zip(&scopes[range.clone()]);
            for (_, found) in bytes.filter(|(byte, _)| !matches!(byte, b'\n' | b'\r')) {
                let fits = wanted.iter().any(|scope| found.starts_with(scope));
                assert!(
                    fits,
                    "`{}` ({rule:?}) is `{found}`, not {wanted:?}, in\n{text}",
                    token.as_str()
                );
            }
            seen += 1;
            rules.insert(format!("{rule:?}"));
        }
        for comment in comments(&text) {
            let at = comment.start;
            assert!(
                scopes[comment].iter().all(|scope| scope.starts_with("comment.")),
                "{at} in\n{text}"
            );
        }
    }
    assert!(seen > 4000 && rules.len() > 60, "{seen} tokens of {} rules", rules.len());
}

/// The comments of a text without `//` in strings.
fn comments(text: &str) -> Vec<Range<usize>> {
    let mut found = Vec::new();
    let mut at = 0;
    while let Some(rest) = text.get(at..).filter(|rest| !rest.is_empty()) {
        let comment = rest.starts_with("//") || rest.starts_with("/*");
        let length = if rest.starts_with("//") {
            rest.find(['\n', '\r']).unwrap_or(rest.len())
        } else if rest.starts_with("/*") {
            rest.find("*/").map_or(rest.len(), |end| end + 2)
        } else if let Some(raw) = rest.strip_prefix("\"\"\"") {
            raw.find("\"\"\"").map_or(rest.len(), |end| end + 6)
        } else if let Some(string) = rest.strip_prefix('"') {
            string.find(['"', '\n']).map_or(rest.len(), |end| end + 2)
        } else {
            rest.chars().next().map_or(1, char::len_utf8)
        };
        if comment && !rest[..length].contains('\n') {
            found.push(at..at + length);
        }
        at += length;
    }
    found
}

/// The quoted words of a rule of the pest grammar.
fn words_of(rule: &str) -> BTreeSet<String> {
    let pest = read("grammar/src/setpiece.pest");
    let head = regex(&format!(r"(?m)^{rule}\s*=\s*[@$_!]?\{{"));
    let start = head.find(pest.as_bytes()).unwrap_or_else(|| panic!("no rule {rule}")).end();
    let end = start + pest[start..].find("\n}").min(pest[start..].find("}\n")).unwrap();
    quoted(&pest[start..end])
}

/// Words between double quotes.
fn quoted(text: &str) -> BTreeSet<String> {
    let word = regex(r#""([A-Za-z_%/]+)""#);
    word.captures_iter(text.as_bytes())
        .map(|found| String::from_utf8(found[1].to_vec()).unwrap())
        .collect()
}

/// Every keyword of the pest grammar.
fn keywords() -> BTreeSet<String> {
    let pest = read("grammar/src/setpiece.pest");
    let rule = regex(r#"(?m)^kw_\w+\s*=\s*@\{ "(\w+)""#);
    let words = rule
        .captures_iter(pest.as_bytes())
        .map(|found| String::from_utf8(found[1].to_vec()).unwrap());
    let mut words: BTreeSet<String> = words.chain(words_of("reserved")).collect();
    for boolean in ["true", "false"] {
        words.remove(boolean);
    }
    assert!(words.len() > 60);
    words
}

/// Python's lexer reads the grammar from its package, which has a copy of it.
#[test]
fn the_python_package_has_the_same_grammar() {
    let (grammar, copy) =
        (read("grammar/setpiece.tmLanguage.json"), "python/setpiece/pitch.tmLanguage.json");
    if std::env::var_os("SETPIECE_BLESS").is_some() {
        std::fs::write(root().join(copy), &grammar).unwrap();
    }
    assert!(read(copy) == grammar, "{copy} is another one: SETPIECE_BLESS=1 copies it");
}

fn names<T: Copy>(all: &[T], name: impl Fn(T) -> &'static str) -> BTreeSet<String> {
    all.iter().map(|word| name(*word).to_owned()).collect()
}

#[test]
fn every_word_of_the_vocabulary_has_its_colour() {
    let highlighter = Highlighter::new();
    let scope = |text: &str, at: usize| highlighter.scopes(text)[at].to_owned();
    let is = |word: &str, text: &str, at: usize, kind: &str| {
        let found = scope(text, at);
        assert!(found.starts_with(kind), "`{word}` is `{found}`, not `{kind}`");
    };
    let keywords = keywords();
    for word in &keywords {
        is(word, word, 0, "keyword.");
    }
    for word in names(Role::ALL, Role::name) {
        is(&word, &word, 0, "constant.language.role");
    }
    for word in names(EventKind::ALL, EventKind::name).difference(&keywords) {
        is(word, &format!("on {word}"), 3, "support.constant.event");
    }
    for word in names(Qualifier::ALL, Qualifier::name).difference(&keywords) {
        is(word, &format!("on pass {word}"), 8, "support.constant.qualifier");
    }
    for word in names(Function::ALL, Function::name) {
        is(&word, &format!("{word}(x)"), 0, "support.function");
    }
    for word in names(Type::ALL, Type::name) {
        is(&word, &format!("x: {word}"), 3, "support.type");
    }
    for word in words_of("unit").into_iter().chain(words_of("long_unit")) {
        let text = if words_of("unit").contains(&word) {
            format!("12{word}")
        } else {
            format!("12 {word}")
        };
        is(&word, &text, text.len() - 1, "keyword.other.unit");
        is("12", &text, 0, "constant.numeric");
    }
    assert!(
        names(Unit::ALL, Unit::name)
            .is_subset(&words_of("unit").union(&words_of("long_unit")).cloned().collect())
    );
}

/// A `const NAME = [ … ]` of the tree-sitter grammar.
fn list(grammar: &str, name: &str) -> BTreeSet<String> {
    let start =
        grammar.find(&format!("const {name} = [")).unwrap_or_else(|| panic!("no list {name}"));
    quoted(&grammar[start..start + grammar[start..].find("];").unwrap()])
}

#[test]
fn the_words_of_the_tree_sitter_grammar_are_those_of_pest() {
    let grammar = read("grammar/tree-sitter/grammar.js");
    for (name, rule) in [
        ("ROLES", "role"),
        ("EVENTS", "event_name"),
        ("QUALIFIERS", "qualifier"),
        ("UNITS", "unit"),
        ("LONG_UNITS", "long_unit"),
        ("OVER_TIME", "over_kind"),
    ] {
        assert_eq!(list(&grammar, name), words_of(rule), "{name}");
    }
    let rules = &grammar[grammar.find("rules: {").unwrap()..];
    let known: BTreeSet<String> =
        keywords().into_iter().chain(["true".into(), "false".into()]).collect();
    // The names of fields aren't words of the language.
    let mut used = quoted(&rules.replace("field(\"", "field("));
    used.retain(|word| word.bytes().any(|byte| byte.is_ascii_alphabetic()));
    let missing: Vec<_> = known.difference(&used).collect();
    let strange: Vec<_> = used.difference(&known).collect();
    assert!(missing.is_empty() && strange.is_empty(), "missing {missing:?}, strange {strange:?}");
}

#[test]
fn the_queries_of_tree_sitter_name_what_its_grammar_has() {
    let grammar = read("grammar/tree-sitter/grammar.js");
    for query in ["highlights", "folds", "indents", "locals", "tags", "injections"] {
        let query = read(&format!("grammar/tree-sitter/queries/{query}.scm"));
        let mut patterns = 0;
        for found in regex(r"\(([a-z][a-z_]+|_)[ )]").captures_iter(query.as_bytes()) {
            let node = String::from_utf8(found[1].to_vec()).unwrap();
            let is_rule = node == "_" || grammar.contains(&format!("\n    {node}: ("));
            assert!(is_rule, "no rule {node}");
            patterns += 1;
        }
        // A script's text is the one thing that is injected.
        assert!(patterns >= if query.contains("@injection") { 1 } else { 3 });
    }
    let coloured = quoted(&read("grammar/tree-sitter/queries/highlights.scm"));
    for word in keywords() {
        assert!(coloured.contains(&word), "`{word}` has no colour");
    }
}
