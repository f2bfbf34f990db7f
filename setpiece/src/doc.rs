//! The documentation of a scenario, as Markdown.

use crate::baseline::{CardScore, baseline_file};
use crate::load::Loaded;
use setpiece_engine::start::Drawn;
use setpiece_scenario::pitch::to_normalised;
use setpiece_scenario::vocabulary::{PitchFigure, Rule, WorldFigure};
use setpiece_scenario::{Ai, Others, Param, Reward, Scenario, Team};
use std::fmt::Write as _;

/// Describes a scenario: title, description, parameters, players of one start, rewards, endings,
/// records, the policy in the box, rules, the pitch, the world. `picture` is the path of a picture
/// of that start, relative to the page.
pub fn markdown(loaded: &Loaded, start: &Drawn, picture: Option<&str>) -> String {
    let scenario = &*loaded.scenario;
    let mut page = format!("# {}\n\n", scenario.name);
    if !scenario.doc.trim().is_empty() {
        let _ = writeln!(page, "{}\n", scenario.doc.trim());
    }
    if let Some(picture) = picture {
        let _ =
            writeln!(page, "![A start of {}]({})\n", scenario.name, picture.replace(' ', "%20"));
    }
    parameters(&mut page, &scenario.params);
    players(&mut page, scenario, start);
    rewards(&mut page, scenario);
    endings(&mut page, loaded, start);
    measured(&mut page, scenario);
    baseline(&mut page, scenario);
    rules(&mut page, start);
    pitch(&mut page, scenario, start);
    world(&mut page, scenario, start);
    page.truncate(page.trim_end().len());
    page + "\n"
}

/// The card of the policy in the box, if the scenario has one.
fn baseline(page: &mut String, scenario: &Scenario) {
    let Some(card) = baseline_file(scenario).ok().and_then(|file| file.card()) else { return };
    let CardScore { episodes, mean, low, high } = card.score;
    let _ = writeln!(
        page,
        "## Baseline\n\n`--agent baseline` plays it: mean score {mean:.2} [{low:.2}, {high:.2}] of \
         {episodes} episodes.\n"
    );
    for words in [card.words.does, card.words.weaknesses] {
        if !words.is_empty() {
            let _ = writeln!(page, "{words}\n");
        }
    }
}

/// A row of a table.
fn row(page: &mut String, cells: &[&str]) {
    let cells: Vec<String> = cells.iter().map(|cell| one_line(cell).replace('|', "\\|")).collect();
    let _ = writeln!(page, "| {} |", cells.join(" | "));
}

fn head(page: &mut String, cells: &[&str]) {
    row(page, cells);
    row(page, &vec!["---"; cells.len()]);
}

fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

fn code(text: &str) -> String {
    format!("`{text}`")
}

fn parameters(page: &mut String, params: &[Param]) {
    if params.is_empty() {
        return;
    }
    page.push_str("## Parameters\n\n");
    head(page, &["name", "type", "default", "allowed", ""]);
    for param in params {
        let [name, ty] = [&param.name, param.ty.name()].map(code);
        row(page, &[&name, &ty, &code(&param.show(param.default)), &param.allowed(), &param.doc]);
    }
    page.push('\n');
}

fn players(page: &mut String, scenario: &Scenario, start: &Drawn) {
    page.push_str("## Players\n\n");
    let place = |x: f32, y: f32| {
        let (x, y) = to_normalised(f64::from(x), f64::from(y));
        // Three decimals, and no -0.
        let [x, y] = [x, y].map(|value| (value * 1000.0).round() / 1000.0 + 0.0);
        format!("({x}, {y})")
    };
    head(page, &["team", "name", "role", "place in one start", "without an agent"]);
    for team in Team::ALL {
        for (id, slot) in scenario.team(*team).filter(|(_, slot)| !slot.instead) {
            let drawn = start.players.get(id).and_then(Option::as_ref);
            let at = drawn.map_or("absent".to_owned(), |player| place(player.pos.x, player.pos.y));
            let ai = match (&drawn.map_or(slot.ai, |player| player.ai), start.others) {
                (Ai::Bot, Others::Bot) => "bot",
                (Ai::Bot, Others::Hold) | (Ai::Hold, _) => "holds their place",
                (Ai::Lazy, _) => "lazy",
                _ => "scripted",
            };
            row(
                page,
                &[team.name(), slot.name.as_deref().unwrap_or_default(), slot.role.name(), &at, ai],
            );
        }
    }
    let count = |team: Team| start.agents.iter().filter(|agent| agent.team == team).count();
    let _ = writeln!(
        page,
        "\nThe ball lies at {}. Agents play {} of the left team and {} of the right.\n",
        place(start.ball_pos.x, start.ball_pos.y),
        count(Team::Left),
        count(Team::Right)
    );
}

fn rewards(page: &mut String, scenario: &Scenario) {
    page.push_str("## Rewards\n\n");
    if scenario.rewards.is_empty() {
        page.push_str("None.\n\n");
    }
    for reward in &scenario.rewards {
        describe(page, reward);
    }
    let named: Vec<String> = scenario
        .library
        .iter()
        .filter(|reward| scenario.rewards.iter().all(|paid| paid.name != reward.name))
        .map(|reward| code(&reward.name))
        .collect();
    if !named.is_empty() {
        let _ = writeln!(page, "In scope too: {}.\n", named.join(", "));
    }
}

fn describe(page: &mut String, reward: &Reward) {
    let _ = writeln!(page, "### {}\n", reward.name);
    if !reward.doc.trim().is_empty() {
        let _ = writeln!(page, "{}\n", reward.doc.trim());
    }
    let terms: Vec<String> =
        reward.body.terms.iter().map(|term| code(&format!("{}/{term}", reward.name))).collect();
    let _ = writeln!(page, "Terms: {}\n", terms.join(", "));
}

fn endings(page: &mut String, loaded: &Loaded, start: &Drawn) {
    page.push_str("## Endings\n\n");
    for (index, ending) in loaded.scenario.endings.list.iter().enumerate() {
        let verdict = ending.verdict.map_or(String::new(), |verdict| format!(" ({verdict})"));
        // A compiled scenario doesn't contain the author's text.
        let words = loaded.origins.endings.get(index).map_or("", |span| loaded.sources.text(*span));
        let words =
            if words.is_empty() { String::new() } else { format!(": `{}`", one_line(words)) };
        let _ = writeln!(page, "- **{}**{verdict}{words}", ending.label);
    }
    if let Some(steps) = start.limit_steps {
        let _ = writeln!(page, "- after {steps} steps ({} s)", f64::from(steps) / 10.0);
    }
    page.push('\n');
}

/// Records, and the scenario's own observation.
fn measured(page: &mut String, scenario: &Scenario) {
    if !scenario.records.is_empty() {
        page.push_str("## Records\n\n");
        for record in &scenario.records {
            let series = if record.series { ", a value for every step" } else { "" };
            let unit = record.unit.to_string();
            let unit = if unit.is_empty() { unit } else { format!(", in {unit}") };
            let _ = writeln!(page, "- {}{unit}{series}", code(&record.name));
        }
        page.push('\n');
    }
    if let Some(observation) = &scenario.observation {
        let names: Vec<String> =
            observation.values.iter().map(|value| code(&one_line(&value.name))).collect();
        let _ =
            writeln!(page, "## Observation\n\n{} numbers: {}.\n", names.len(), names.join(", "));
    }
}

fn rules(page: &mut String, start: &Drawn) {
    page.push_str("## Rules\n\n");
    head(page, &["rule", "", ""]);
    for (rule, value) in Rule::ALL.iter().zip(start.rules) {
        let shown = match rule {
            Rule::HalfTime if value > 0.0 => format!("{value} steps"),
            Rule::Physics => if value > 0.0 { "full" } else { "gated" }.to_owned(),
            _ => if value > 0.0 { "on" } else { "off" }.to_owned(),
        };
        row(page, &[&code(rule.name()), &shown, rule.doc()]);
    }
}

/// What a scenario sets in `pitch { }`, as the start has it.
fn pitch(page: &mut String, scenario: &Scenario, start: &Drawn) {
    if scenario.start.pitch.is_empty() {
        return;
    }
    page.push_str("\n## Pitch\n\n");
    head(page, &["figure", "in this start, m", "usual, m", ""]);
    for &figure in PitchFigure::ALL {
        if scenario.start.pitch.iter().any(|setting| setting.figure == figure) {
            let shown = format!("{:.3}", start.pitch.figure(figure));
            let usual = figure.usual().to_string();
            row(page, &[&code(figure.name()), &shown, &usual, figure.doc()]);
        }
    }
}

/// What a scenario sets in `world { }`, as the start has it.
fn world(page: &mut String, scenario: &Scenario, start: &Drawn) {
    if scenario.start.world.is_empty() {
        return;
    }
    page.push_str("\n## World\n\n");
    head(page, &["figure", "in this start", "usual", ""]);
    let drawn = start.conditions.figures();
    for &figure in WorldFigure::ALL {
        if scenario.start.world.iter().any(|setting| setting.figure == figure) {
            let shown = format!("{:.3}", drawn[figure.index()]);
            let usual = figure.usual().to_string();
            row(page, &[&code(figure.name()), &shown, &usual, figure.doc()]);
        }
    }
}
