//! What the names of a text stand for: a parameter, a player, a reward.

use super::report::is_scenario;
use super::symbols::{flat, of_file};
use super::{Analysis, SymbolKind};
use crate::dsl::parse::parse;
use crate::dsl::source::Span;
use std::collections::BTreeMap;
use std::path::Path;

impl Analysis {
    /// The kind of every declaration of the text's files, by the place of its name.
    pub(super) fn kinds(&self) -> BTreeMap<Span, SymbolKind> {
        let mut kinds = BTreeMap::new();
        for (file, source) in self.sources.iter() {
            if file.0 > 0 && !is_scenario(Path::new(&source.name)) {
                continue;
            }
            let parsed;
            let symbols = if file.0 == 0 {
                self.symbols()
            } else {
                parsed = of_file(&parse(source, file, &mut Vec::new()));
                &parsed
            };
            for symbol in flat(symbols) {
                let (start, end) = (symbol.range.start as u32, symbol.range.end as u32);
                kinds.insert(Span { file, start, end }, symbol.kind);
            }
        }
        kinds
    }

    /// The innermost thing with a name around a byte that is of one of these kinds.
    pub(super) fn around(&self, offset: usize, kinds: &[SymbolKind]) -> Option<super::Symbol> {
        let holds = |it: &&super::Symbol| {
            kinds.contains(&it.kind) && it.whole.start <= offset && offset <= it.whole.end
        };
        flat(self.symbols()).into_iter().filter(holds).min_by_key(|it| it.whole.len()).cloned()
    }
}
