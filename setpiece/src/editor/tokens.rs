//! What the names of a text are, for colours that know more than words.

use super::{Analysis, SymbolKind};
use crate::dsl::source::FileId;
use std::collections::BTreeMap;
use std::ops::Range;

/// A name with what it is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Token {
    /// The bytes.
    pub range: Range<usize>,
    /// What it is.
    pub kind: TokenKind,
    /// Whether it is declared here.
    pub is_declaration: bool,
    /// Whether the library declares it.
    pub is_of_library: bool,
}

/// What a name is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TokenKind {
    /// A scenario, suite, check or curriculum.
    Scenario,
    /// A reward or ending.
    Reward,
    /// A formation.
    Formation,
    /// A function, region or behaviour.
    Function,
    /// A parameter.
    Parameter,
    /// A value that stays as it is.
    Value,
    /// A player.
    Player,
}

impl TokenKind {
    /// Every kind, in order.
    pub const ALL: [TokenKind; 7] = [
        TokenKind::Scenario,
        TokenKind::Reward,
        TokenKind::Formation,
        TokenKind::Function,
        TokenKind::Parameter,
        TokenKind::Value,
        TokenKind::Player,
    ];

    fn of(kind: SymbolKind) -> Option<TokenKind> {
        Some(match kind {
            SymbolKind::Scenario | SymbolKind::Plan => TokenKind::Scenario,
            SymbolKind::Reward | SymbolKind::Ending => TokenKind::Reward,
            SymbolKind::Formation => TokenKind::Formation,
            SymbolKind::Function | SymbolKind::Behavior => TokenKind::Function,
            SymbolKind::Parameter => TokenKind::Parameter,
            SymbolKind::Value => TokenKind::Value,
            SymbolKind::Player => TokenKind::Player,
            SymbolKind::Team => return None,
        })
    }
}

impl Analysis {
    /// The names of the text in order, none overlapping another.
    pub fn tokens(&self) -> Vec<Token> {
        let kinds = self.kinds();
        let mut found: BTreeMap<usize, Token> = BTreeMap::new();
        for (span, kind) in kinds.iter().filter(|(span, _)| span.file == FileId(0)) {
            let (Some(kind), Some(range)) = (TokenKind::of(*kind), self.own(*span)) else {
                continue;
            };
            let text = self.text.get(range.clone()).unwrap_or_default();
            // The words of a check are no name.
            let is_name = text.chars().all(|sign| sign.is_alphanumeric() || sign == '_');
            // A player without a name stands under the role.
            let is_role = kind == TokenKind::Player
                && crate::scenario::vocabulary::Role::from_name(text).is_some();
            if is_name && !is_role {
                let token = Token { range, kind, is_declaration: true, is_of_library: false };
                found.insert(token.range.start, token);
            }
        }
        for (at, declared) in self.index.uses() {
            let (Some(own), Some(kind)) = (self.own(at), kinds.get(&declared)) else { continue };
            let Some(kind) = TokenKind::of(*kind) else { continue };
            let length = (declared.end - declared.start) as usize;
            let range = own.end.saturating_sub(length)..own.end;
            let is_of_library = self
                .sources
                .get(declared.file)
                .is_some_and(|source| source.name.starts_with("std/"));
            found.entry(range.start).or_insert(Token {
                range,
                kind,
                is_declaration: false,
                is_of_library,
            });
        }
        let mut end = 0;
        let mut tokens: Vec<Token> = found.into_values().collect();
        tokens.retain(|token| {
            let fits = token.range.start >= end;
            if fits {
                end = token.range.end;
            }
            fits
        });
        tokens
    }
}
