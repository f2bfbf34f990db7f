//! The figures of a profile as JSON, for programs.

use super::Profile;
use serde_json::{Value, json};

/// What a page shows, as data: places in metres, attacking towards +x with +y on the right.
pub fn figures(profile: &Profile) -> Value {
    let passes = profile.passes.iter();
    let passes =
        passes.map(|pass| json!({ "from": pass.from, "to": pass.to, "completed": pass.completed }));
    let shots = profile.shots.iter().map(|shot| json!({ "at": shot.at, "outcome": shot.outcome }));
    let ends = profile.ends.iter().map(|(name, verdict, count)| {
        let verdict = verdict.map(|verdict| verdict.to_string());
        json!({ "name": name, "verdict": verdict, "count": count })
    });
    let actions = profile.actions.iter();
    let actions = actions.map(|(action, count)| (action.name().to_owned(), json!(count)));
    let terms = profile.terms.iter().map(|(name, paid)| (name.clone(), json!(paid)));
    json!({
        "scenario": profile.scenario,
        "agent": profile.agent,
        "episodes": profile.episodes,
        "seed": profile.seed,
        "score": profile.score,
        "length_s": profile.length,
        "ends": ends.collect::<Vec<_>>(),
        "actions": actions.collect::<serde_json::Map<_, _>>(),
        "terms": terms.collect::<serde_json::Map<_, _>>(),
        "touches": profile.touches,
        "passes": passes.collect::<Vec<_>>(),
        "shots": shots.collect::<Vec<_>>(),
        "pitch": { "length": profile.pitch.length_m, "width": profile.pitch.width_m },
    })
}
