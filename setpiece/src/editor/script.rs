//! What may be written in a script, and what its words mean.

use super::completion::{Completion, CompletionKind, PARAMETER};
use crate::engine::judge::script::{Member, Subject, functions, interface, members};

/// What stands before a dot, as a chain of names: `ctx.params` in `ctx.params.`.
fn subject(chain: &str) -> Option<Subject> {
    let mut names = chain.split('.');
    let first = match names.next()? {
        "ctx" => Subject::Ctx,
        "now" | "prev" => Subject::State,
        "me" => Subject::Player,
        "events" => Subject::Events,
        _ => return None,
    };
    names.try_fold(first, |of, name| {
        members().find(|member| member.of == of && member.name == name).map(|member| member.gives)
    })
}

/// What may stand at the end of a script's text.
///
/// - `names`: what stands behind `now.named.` and `ctx.params.`.
pub(super) fn complete(before: &str, names: &[Completion]) -> Vec<Completion> {
    let of = |subject| {
        members().filter(move |member| member.of == subject).map(|member: Member| Completion {
            text: member.name.to_owned(),
            detail: member.gives.words().to_owned(),
            doc: member.doc.to_owned(),
            snippet: String::new(),
            kind: CompletionKind::Word,
        })
    };
    if let Some(before) = before.strip_suffix('.') {
        let is_chain = |sign: char| sign.is_alphanumeric() || matches!(sign, '_' | '.');
        let start = before.trim_end_matches(is_chain).len();
        let chain = before.get(start..).unwrap_or_default();
        return match subject(chain) {
            Some(Subject::Params) => {
                names.iter().filter(|it| it.detail == PARAMETER).cloned().collect()
            }
            Some(Subject::Named) => {
                names.iter().filter(|it| it.detail != PARAMETER).cloned().collect()
            }
            Some(found) => of(found).collect(),
            // A name of the script's own: a player most of the time.
            None => [Subject::Player, Subject::Ball, Subject::Team, Subject::Event]
                .into_iter()
                .flat_map(of)
                .collect(),
        };
    }
    let word = |text: &str, detail: &str, doc: &str| Completion {
        text: text.to_owned(),
        detail: detail.to_owned(),
        doc: doc.to_owned(),
        snippet: String::new(),
        kind: CompletionKind::Word,
    };
    let own = interface().map(|(name, about)| word(name, "function", about));
    let rhai = functions().map(|name| word(name, "function of Rhai", ""));
    let arguments = [
        ("ctx", "the context: parameters, names, memory"),
        ("now", "the match after this step"),
        ("prev", "the match before this step"),
        ("events", "what happened in this step"),
        ("me", "the agent's player, in `act`"),
    ];
    let hooks = [
        ("reward", "pays: `fn reward(ctx, now, prev, events)`"),
        ("done", "ends the episode: `fn done(ctx, now, prev, events)`"),
        ("act", "plays: `fn act(ctx, me, now)`"),
        ("reset", "begins: `fn reset(ctx)`"),
    ];
    let mut found: Vec<Completion> = own.collect();
    for completion in rhai {
        if !found.iter().any(|known| known.text == completion.text) {
            found.push(completion);
        }
    }
    found.extend(arguments.map(|(name, doc)| word(name, "argument of a hook", doc)));
    found.extend(hooks.map(|(name, doc)| word(name, "hook", doc)));
    found.extend(
        ["let", "if", "else", "for", "in", "while", "return", "fn", "switch", "const"]
            .map(|name| Completion { kind: CompletionKind::Keyword, ..word(name, "Rhai", "") }),
    );
    found
}

/// What a word of a script means.
pub(super) fn about(before: &str, word: &str) -> Option<String> {
    if let Some(before) = before.strip_suffix('.') {
        let is_chain = |sign: char| sign.is_alphanumeric() || matches!(sign, '_' | '.');
        let start = before.trim_end_matches(is_chain).len();
        let chain = before.get(start..).unwrap_or_default();
        let of = subject(chain);
        let found = members()
            .find(|member| member.name == word && of.is_none_or(|subject| member.of == subject));
        return found.map(|member| {
            format!("**{}**, of {}: {}", member.name, member.of.words(), member.doc)
        });
    }
    let function = interface().find(|(name, _)| *name == word);
    function.map(|(_, about)| format!("**{word}**: {about}"))
}
