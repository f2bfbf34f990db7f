//! The hooks that a script may have.

use super::api::Subject;

/// Called once, before the first step.
pub(super) const RESET: &str = "reset";
/// Pays a reward.
pub(super) const REWARD: &str = "reward";
/// Ends an episode.
pub(super) const DONE: &str = "done";

/// The arguments of a hook; `None` if it isn't a hook.
pub(super) fn hook_arguments(hook: &str) -> Option<&'static [(&'static str, Subject)]> {
    const STEP: &[(&str, Subject)] = &[
        ("ctx", Subject::Ctx),
        ("now", Subject::State),
        ("prev", Subject::State),
        ("events", Subject::Events),
    ];
    match hook {
        "reward" | "done" => Some(STEP),
        "act" => Some(&[("ctx", Subject::Ctx), ("me", Subject::Player), ("now", Subject::State)]),
        "reset" => Some(&[("ctx", Subject::Ctx)]),
        _ => None,
    }
}
