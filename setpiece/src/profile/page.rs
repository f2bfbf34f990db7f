//! A profile as a page: HTML with pictures inside, which needs no other file and no network.
//!
//! Pitches follow the habits of analysts' plots: the team attacks to the right, passes are arrows
//! in a colour for completed and one for failed ones, goals are larger than other shots.

use super::{Profile, ProfilePass, ProfileShot};
use crate::measure::Estimate;
use crate::picture::{escaped, pitch_svg, view};
use setpiece_scenario::Verdict;
use std::fmt::Write as _;

/// The longest side of a cell of the heat map, metres.
const CELL_M: f64 = 4.0;
/// A colour for what succeeded, and one for what failed: distinguishable with every kind of colour
/// vision, and on grass.
const GOOD: &str = "#ffd166";
const BAD: &str = "#ef476f";
/// The radius of a goal and of another shot, metres.
const SHOT_M: [f64; 2] = [1.5, 0.9];
/// Whose touches, passes and shots are shown.
const WHOSE: &str = "Touches, passes and shots are those of the players that the agent controls at \
    the time. Teammates that it doesn't control are left out.";
const STYLE: &str = "
:root { color-scheme: light dark; }
body { font: 16px/1.5 system-ui, sans-serif; max-width: 72rem; margin: 2rem auto; padding: 0 1rem; }
h1 { margin-bottom: 0; }
.pitches { display: grid; grid-template-columns: repeat(auto-fit, minmax(22rem, 1fr)); gap: 1.5rem; }
.tables { display: grid; grid-template-columns: repeat(auto-fit, minmax(18rem, 1fr)); gap: 2rem; }
figure { margin: 0; }
figure svg { width: 100%; height: auto; }
figcaption, .dim { opacity: 0.75; }
table { border-collapse: collapse; width: 100%; }
td { padding: 0.1rem 0.5rem 0.1rem 0; white-space: nowrap; }
td.number { text-align: right; font-variant-numeric: tabular-nums; }
td.bar { width: 50%; }
td.bar div { background: #2f6df6; height: 0.7rem; border-radius: 0.2rem; }
";

/// Writes the page of a scenario.
pub fn page(profile: &Profile) -> String {
    document(&format!("{} in {}", profile.agent, profile.scenario), &part(profile))
}

/// Writes the page of a suite: a part for each entry.
pub fn suite_page(suite: &str, profiles: &[Profile]) -> String {
    let agent = profiles.first().map_or("", |profile| &profile.agent);
    let parts = profiles.iter().map(|profile| {
        format!("<section>\n<h2>{}</h2>\n{}</section>\n", escaped(&profile.scenario), part(profile))
    });
    document(&format!("{agent} in {suite}"), &parts.collect::<String>())
}

fn document(title: &str, body: &str) -> String {
    format!(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width\">\n<title>{0}</title>\n\
         <style>{STYLE}</style>\n</head>\n<body>\n<h1>{0}</h1>\n<p>{WHOSE}</p>\n{body}\
         </body>\n</html>\n",
        escaped(title),
    )
}

/// The figures, pitches and tables of a scenario.
fn part(profile: &Profile) -> String {
    let mut html = format!("<p class=\"dim\">{}</p>\n", escaped(&about(profile)));
    html += "<div class=\"pitches\">\n";
    let n = profile.episodes.max(1) as f64;
    let per = |count: usize| format!("{:.1} an episode", count as f64 / n);
    figure(&mut html, profile, "Touches", &per(profile.touches.len()), &heat(profile));
    let completed = profile.passes.iter().filter(|pass| pass.completed).count();
    let share = 100.0 * completed as f64 / profile.passes.len().max(1) as f64;
    let about = match profile.passes.len() {
        0 => "none".to_owned(),
        count => format!("{}, {share:.0} % completed (yellow)", per(count)),
    };
    figure(&mut html, profile, "Passes", &about, &passes(&profile.passes));
    let goals = profile.shots.iter().filter(|shot| is_goal(shot)).count();
    let about = match profile.shots.len() {
        0 => "none".to_owned(),
        count => format!("{}, {goals} of {count} are goals (large, yellow)", per(count)),
    };
    figure(&mut html, profile, "Shots", &about, &shots(&profile.shots));
    html += "</div>\n<div class=\"tables\">\n";
    let ends = profile.ends.iter().map(|(name, verdict, count)| {
        let verdict = match verdict {
            Some(Verdict::Success) => " (success)",
            Some(Verdict::Failure) => " (failure)",
            None => "",
        };
        (format!("{name}{verdict}"), f64::from(*count) / n)
    });
    table(&mut html, "How episodes end", ends);
    let all = profile.actions.iter().map(|(_, count)| count).sum::<u64>().max(1) as f64;
    let actions = profile.actions.iter();
    let actions = actions.map(|(action, count)| (action.name().to_owned(), *count as f64 / all));
    table(&mut html, "Actions, as shares of all steps", actions);
    html += "<section>\n<h2>Rewards</h2>\n<table>\n";
    for (name, paid) in &profile.terms {
        let name = escaped(name);
        let _ = writeln!(html, "<tr><td>{name}</td><td class=\"number\">{paid:+.3}</td></tr>");
    }
    html + "</table>\n</section>\n</div>\n"
}

/// The figures under the title.
fn about(profile: &Profile) -> String {
    let shown = |what: &str, it: &Option<Estimate>, factor: f64, unit: &str| {
        it.map_or(String::new(), |it| {
            let [value, low, high] = [it.value, it.low, it.high].map(|it| it * factor);
            format!(" · {what} {value:.2}{unit} [{low:.2}, {high:.2}]")
        })
    };
    format!(
        "{} episodes of the seed {}{}{} · 95 % intervals in brackets",
        profile.episodes,
        profile.seed,
        shown("mean score", &profile.score, 1.0, ""),
        shown("mean length", &profile.length, 1.0, " s"),
    )
}

fn figure(html: &mut String, profile: &Profile, name: &str, about: &str, over: &str) {
    let picture = pitch_svg(name, &profile.pitch, over);
    let _ = writeln!(
        html,
        "<figure>\n<h2>{name}</h2>\n{picture}<figcaption>{} · attacking to the right</figcaption>\n</figure>",
        escaped(about)
    );
}

/// Shares with bars, as a table.
fn table(html: &mut String, name: &str, rows: impl Iterator<Item = (String, f64)>) {
    let _ = writeln!(html, "<section>\n<h2>{name}</h2>\n<table>");
    for (name, share) in rows {
        let percent = 100.0 * share;
        let _ = writeln!(
            html,
            "<tr><td>{}</td><td class=\"number\">{percent:.1} %</td><td class=\"bar\">\
             <div style=\"width: {percent:.1}%\"></div></td></tr>",
            escaped(&name)
        );
    }
    *html += "</table>\n</section>\n";
}

/// The touches by cell: the more, the more opaque.
fn heat(profile: &Profile) -> String {
    let [left, top, width, height] = view(&profile.pitch);
    let [columns, rows] = [width, height].map(|side| (side / CELL_M).ceil().max(1.0) as usize);
    let [wide, high] = [width / columns as f64, height / rows as f64];
    let mut counts = vec![0_u32; columns * rows];
    for [x, y] in &profile.touches {
        let column = ((f64::from(*x) - left) / wide).clamp(0.0, columns as f64 - 1.0) as usize;
        let row = ((f64::from(*y) - top) / high).clamp(0.0, rows as f64 - 1.0) as usize;
        counts[row * columns + column] += 1;
    }
    let most = counts.iter().copied().max().unwrap_or(0).max(1);
    let mut svg = String::new();
    for (at, &count) in counts.iter().enumerate().filter(|(_, count)| **count > 0) {
        // Few touches are seen beside many.
        let opacity = (f64::from(count) / f64::from(most)).sqrt();
        let (x, y) = (left + (at % columns) as f64 * wide, top + (at / columns) as f64 * high);
        let _ = writeln!(
            svg,
            "<rect x=\"{x:.2}\" y=\"{y:.2}\" width=\"{wide:.2}\" height=\"{high:.2}\" \
             fill=\"{BAD}\" fill-opacity=\"{opacity:.2}\"><title>{count}</title></rect>"
        );
    }
    svg
}

fn passes(passes: &[ProfilePass]) -> String {
    let mut svg = String::new();
    for (id, colour) in [("completed", GOOD), ("failed", BAD)] {
        let _ = writeln!(
            svg,
            "<marker id=\"{id}\" viewBox=\"0 0 4 4\" refX=\"3.5\" refY=\"2\" markerWidth=\"5\" \
             markerHeight=\"5\" orient=\"auto\"><path d=\"M0 0L4 2L0 4Z\" fill=\"{colour}\"/></marker>"
        );
    }
    for ProfilePass { from, to, completed } in passes {
        let (id, colour) = if *completed { ("completed", GOOD) } else { ("failed", BAD) };
        let _ = writeln!(
            svg,
            "<line x1=\"{:.1}\" y1=\"{:.1}\" x2=\"{:.1}\" y2=\"{:.1}\" stroke=\"{colour}\" \
             stroke-width=\"0.35\" stroke-opacity=\"0.6\" marker-end=\"url(#{id})\"/>",
            from[0], from[1], to[0], to[1]
        );
    }
    svg
}

fn shots(shots: &[ProfileShot]) -> String {
    let mut svg = String::new();
    // Goals last, over the others.
    for is_last in [false, true] {
        for shot in shots.iter().filter(|shot| is_goal(shot) == is_last) {
            let (radius, colour) = if is_last { (SHOT_M[0], GOOD) } else { (SHOT_M[1], BAD) };
            let outcome = if is_last { "goal" } else { shot.outcome };
            let _ = writeln!(
                svg,
                "<circle cx=\"{:.1}\" cy=\"{:.1}\" r=\"{radius}\" fill=\"{colour}\" \
                 fill-opacity=\"0.7\" stroke=\"#222\" stroke-width=\"0.15\"><title>{outcome}</title></circle>",
                shot.at[0], shot.at[1]
            );
        }
    }
    svg
}

fn is_goal(shot: &ProfileShot) -> bool {
    shot.outcome == "successful"
}
