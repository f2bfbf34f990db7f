//! The rules of the grammar around a byte: for editors, which explain what stands there.

use super::scan;
use crate::source::FileId;
use pest::Parser;
use pest::iterators::Pairs;
use setpiece_grammar::{PitchParser, Rule};

/// The rules that hold a byte of a text, the outermost first; nothing where it can't be read.
pub fn rules_around(text: &str, offset: usize) -> Vec<Rule> {
    let scan = scan::scan(text, FileId(0));
    let Ok(pairs) = PitchParser::parse(Rule::file, &scan.text) else { return Vec::new() };
    let mut found = Vec::new();
    let mut level: Option<Pairs<'_, Rule>> = Some(pairs);
    while let Some(mut pairs) = level.take() {
        let around = pairs.find(|pair| {
            let span = pair.as_span();
            span.start() <= offset && offset < span.end()
        });
        level = around.map(|pair| {
            found.push(pair.as_rule());
            pair.into_inner()
        });
    }
    found
}

#[cfg(test)]
mod tests {
    use super::rules_around;
    use setpiece_grammar::Rule;

    #[test]
    fn the_innermost_rule_comes_last() {
        let text = "scenario a { ball left of centre by 2m team left { } }";
        let around = |word: &str| rules_around(text, text.find(word).unwrap_or_default());
        let [.., outer, inner] = *around("of centre") else { panic!("nothing around") };
        assert_eq!((outer, inner), (Rule::relative, Rule::kw_of));
        assert!(around("left {").contains(&Rule::team));
        assert_eq!(rules_around("scenario {", 9), rules_around("((", 0), "what is no text");
    }
}
