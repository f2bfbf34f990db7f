//! Parsing: every construct, every trap, and the words of every report.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

#[path = "parse/robust.rs"]
mod robust;
#[path = "parse/traps.rs"]
mod traps;
#[path = "parse/words.rs"]
mod words;

use setpiece_dsl::ast::{File, ItemKind, RewardStmt, ScenarioStmt, TeamStmt, TeamStmtKind};
use setpiece_dsl::ast::{PlayerStmt, ScenarioStmtKind};
use setpiece_dsl::parse::parse;
use setpiece_dsl::problem::Problem;
use setpiece_dsl::source::{FileId, Source, Sources};

const EVERYTHING: &str = include_str!("parse/everything.pitch");

fn read(text: &str) -> (File, Vec<Problem>) {
    let mut problems = Vec::new();
    let file =
        parse(&Source { name: "test.pitch".into(), text: text.into() }, FileId(0), &mut problems);
    (file, problems)
}

/// The problems as `SP0101 message`.
fn reported(text: &str) -> Vec<String> {
    read(text)
        .1
        .iter()
        .map(|problem| format!("{} {}", problem.code(), problem.words().message))
        .collect()
}

fn sources(text: &str) -> Sources {
    let mut sources = Sources::default();
    sources.add(Source { name: "test.pitch".into(), text: text.into() });
    sources
}

/// The statements of the only scenario, which must be read without a problem.
fn scenario(body: &str) -> Vec<ScenarioStmt> {
    let text = format!("scenario s {{\n{body}\n}}");
    let (file, problems) = read(&text);
    assert_eq!(problems, [], "{text}");
    match file.items.into_iter().next().map(|item| item.kind) {
        Some(ItemKind::Scenario(scenario)) => scenario.body,
        other => panic!("no scenario: {other:?}"),
    }
}

fn team(body: &str) -> Vec<TeamStmt> {
    match scenario(&format!("team left {{\n{body}\n}}"))
        .into_iter()
        .next()
        .map(|statement| statement.kind)
    {
        Some(ScenarioStmtKind::Team { body, .. }) => body,
        other => panic!("no team: {other:?}"),
    }
}

fn player(text: &str) -> PlayerStmt {
    match team(text).into_iter().next().map(|statement| statement.kind) {
        Some(TeamStmtKind::Player(player)) => player,
        other => panic!("no player: {other:?}"),
    }
}

fn reward(body: &str) -> Vec<RewardStmt> {
    let text = format!("reward r {{\n{body}\n}}");
    let (file, problems) = read(&text);
    assert_eq!(problems, [], "{text}");
    match file.items.into_iter().next().map(|item| item.kind) {
        Some(ItemKind::Reward(reward)) => reward.body,
        other => panic!("no reward: {other:?}"),
    }
}

#[test]
fn everything_is_read() {
    let (file, problems) = read(EVERYTHING);
    assert_eq!(problems, []);
    assert_eq!(file.items.len(), 15);
    assert!(!format!("{file:?}").contains("Broken"));
}

#[test]
fn every_event_and_qualifier_of_the_vocabulary_is_read() {
    use setpiece_scenario::vocabulary::{EventKind, Qualifier, Role, Unit};
    for event in EventKind::ALL {
        assert_eq!(reward(&format!("give 1 on {event} when a")).len(), 1, "{event}");
        for qualifier in event.qualifiers() {
            assert_eq!(
                reward(&format!("give 1 on {event} {qualifier} when a")).len(),
                1,
                "{event} {qualifier}"
            );
        }
    }
    assert_eq!(Qualifier::ALL.len(), 9);
    for role in Role::ALL {
        assert_eq!(player(role.name()).role.node, *role);
    }
    for unit in Unit::ALL {
        let gap = if unit.name().len() > 4 { " " } else { "" };
        assert_eq!(scenario(&format!("let x = 5{gap}{unit}")).len(), 1, "{unit}");
    }
}

#[test]
fn line_endings_and_a_byte_order_mark_make_no_difference() {
    let crlf = EVERYTHING.replace('\n', "\r\n");
    let (file, problems) = read(&crlf);
    assert_eq!((file.items.len(), problems), (15, vec![]));
    assert_eq!(
        file.items.first().map(|item| item.doc.as_str()),
        Some("Every construct of the language once.\nSecond line.")
    );
    let (file, problems) = read(&format!("\u{FEFF}{EVERYTHING}"));
    assert_eq!((file.items.len(), problems), (15, vec![]));
}
