//! What nests without brackets: `if if if …`, `count of pass by …`. The grammar goes as deep as
//! such a chain is long.

use super::Scanner;
use crate::parse::MAX_NESTED;
use crate::problem::facts::Syntax;

/// How deep the grammar stands in an expression, at most.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Chain {
    /// `if`s around.
    ifs: u32,
    /// Phrases around, such as `by …`, since the last word that ends them all.
    phrases: u32,
    /// Where the line of the first word that was too deep begins.
    too_deep: Option<usize>,
}

impl Chain {
    fn depth(self) -> u32 {
        self.ifs + self.phrases
    }
}

impl Scanner<'_> {
    /// Counts a word that nests what follows it; returns the word's end.
    pub(super) fn word(&mut self, at: usize, word: &[u8]) -> usize {
        let end = at + word.len().max(1);
        let Chain { ifs, too_deep, .. } = self.chain;
        match word {
            b"if" | b"of" | b"by" | b"to" | b"from" if self.chain.depth() >= MAX_NESTED => {
                if too_deep.is_none() {
                    self.chain.too_deep = Some(self.line_from);
                    self.problem(at, word.len(), Syntax::NestedExpression { most: MAX_NESTED });
                }
                self.mends.extend((at..end).map(|at| (at, b' ')));
            }
            b"if" => self.chain = Chain { ifs: ifs + 1, phrases: 0, too_deep },
            b"of" | b"by" | b"to" | b"from" => self.chain.phrases += 1,
            b"and" | b"or" | b"then" | b"else" => {
                self.unchain(at, Chain { ifs, phrases: 0, too_deep });
            }
            // No expression goes on behind these.
            b"as" | b"at" | b"facing" | b"give" | b"jitter" | b"let" | b"on" | b"once"
            | b"require" | b"state" | b"when" | b"with" => self.unchain(at, self.outer()),
            _ => {}
        }
        end
    }

    /// Signs that end an expression; returns the sign's end.
    pub(super) fn sign(&mut self, at: usize, byte: u8, rest: &[u8]) -> usize {
        match byte {
            b'=' if rest.starts_with(b"==") => return at + 2,
            b'!' | b'<' | b'>' if rest.get(1) == Some(&b'=') => return at + 2,
            b',' | b':' | b'=' => self.unchain(at, self.outer()),
            _ => {}
        }
        at + 1
    }

    /// The chain at the start of the innermost bracket.
    fn outer(&self) -> Chain {
        self.open
            .last()
            .filter(|open| open.byte != b'{')
            .map_or_else(Chain::default, |open| open.chain)
    }

    /// Goes back to a chain; one that was too deep is reported about and ends here.
    pub(super) fn unchain(&mut self, at: usize, to: Chain) {
        if let Some(from) = self.chain.too_deep.filter(|_| to.depth() < MAX_NESTED) {
            self.scan.reported.push(from..at + 1);
            self.chain = Chain { too_deep: None, ..to };
        } else {
            self.chain = Chain { too_deep: self.chain.too_deep, ..to };
        }
    }
}
