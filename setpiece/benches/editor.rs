//! How long an editor waits: reports after a key, and completion, on a text of 500 lines that
//! imports another one; and whether memory grows with the edits.
//!
//! `cargo bench --bench editor [-- EDITS]`
#![allow(
    clippy::expect_used,
    clippy::print_stdout,
    reason = "a bench prints, and fails by panicking"
)]

use setpiece::editor::Workspace;
use std::fmt::Write as _;
use std::path::Path;
use std::time::{Duration, Instant};

/// Lines of the text.
const LINES: usize = 500;
/// Keys, if no number is given.
const EDITS: usize = 1_000;

/// A text with scenarios, rewards and functions of ordinary length.
fn text() -> String {
    let mut text = "import \"shared.pitch\"\n".to_owned();
    let mut part = 0;
    while text.lines().count() < LINES {
        part += 1;
        let _ = write!(
            text,
            "
/// How near the ball is to a point.
fn near_{part}(p: point, far: length = 3m) = distance(ball, p) < far

/// Pays for passes, and for going forward.
reward chain_{part} {{
    state n = 0
    on pass completed by us {{ n = n + 1 }}
    give 0.1 * n on pass completed by us
    give 0.05 per second when me.x > 0.5 and me has ball
}}

/// An attack from the wing.
scenario attack_{part} extends academy {{
    param far: length = 20m in 10m..40m
    let side = choice(-1, 1)
    ball at (0.5, 0.2 * side)
    team left {{
        striker: CF at (0.45, 0)
        winger: RM at (0.48, 0.2 * side)
        CM at (0.3, 0.1)
    }}
    team right {{
        CB at right.goal + (-15m, 2m)
        CB at right.goal + (-15m, -2m)
    }}
    reward scoring
    reward chain_{part}
    reward pressing(within: 3m)
    require distance(ball, right.goal) > far
    end success through when near_{part}(right.goal, 8m)
    end limit 40s
}}
"
        );
    }
    text
}

fn main() {
    let edits = std::env::args().skip(1).find_map(|it| it.parse().ok()).unwrap_or(EDITS);
    let folder = Path::new("/nowhere/bench");
    let (path, shared) = (folder.join("attack.pitch"), folder.join("shared.pitch"));
    let mut workspace = Workspace::default();
    workspace.set(
        &shared,
        "reward pressing(within: length = 2m) {\n    give 0.1 per second when pressed(me, within: within)\n}\n",
    );
    let whole = text();
    workspace.set(&path, &whole);
    let found: usize = workspace.reports().values().map(Vec::len).sum();
    assert_eq!(found, 0, "the text is sound");
    println!("{} lines, {} bytes", whole.lines().count(), whole.len());
    let (mut reports, mut completions) = (Vec::new(), Vec::new());
    let mut early = 0;
    let typed = "\n    end success when ball in them.box and ball.speed > 3m/s\n";
    let spots: Vec<usize> = whole.match_indices("    end limit").map(|(at, _)| at).collect();
    for edit in 0..edits {
        // A line is typed letter by letter, in one scenario after the other.
        let spot = spots.get((edit / typed.len()) % spots.len()).copied().unwrap_or_default();
        let part = typed.get(..=edit % typed.len()).unwrap_or(typed);
        let (before, after) = whole.split_at(spot);
        let text = format!("{before}{part}{after}");
        let began = Instant::now();
        workspace.set(&path, &text);
        let count: usize = workspace.reports().values().map(Vec::len).sum();
        reports.push(began.elapsed());
        std::hint::black_box(count);
        let began = Instant::now();
        std::hint::black_box(workspace.complete(&path, spot + part.len()));
        completions.push(began.elapsed());
        if edit == edits / 10 {
            early = resident();
        }
    }
    for (what, mut times) in [("reports after a key", reports), ("completion", completions)] {
        times.sort();
        let at = |share: f64| {
            let at = ((times.len() as f64 * share) as usize).min(times.len().saturating_sub(1));
            times.get(at).copied().unwrap_or(Duration::ZERO)
        };
        println!("{what}: median {:.1?}, p95 {:.1?}, longest {:.1?}", at(0.5), at(0.95), at(1.0));
    }
    println!(
        "resident memory: {early} kB after a tenth of {edits} keys, {} kB after all",
        resident()
    );
}

/// The resident memory of this process, kB; 0 where the system doesn't say.
fn resident() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:"));
    line.and_then(|line| line.trim().trim_end_matches(" kB").parse().ok()).unwrap_or_default()
}
