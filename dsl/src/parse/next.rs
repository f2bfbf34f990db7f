//! What the grammar would read next: for editors, which complete an unfinished statement.

use super::recover::Context;
use pest::Parser;
use pest::error::{ErrorVariant, InputLocation};
use setpiece_grammar::{PitchParser, Rule, keyword};

/// Something that may stand next.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NextPart {
    /// This word.
    Keyword(&'static str),
    /// Where something stands: `at …`, `ahead of …`.
    Place,
    /// An event of the match.
    Event,
    /// What an event may be: `completed`.
    Qualifier,
    /// A football role.
    Role,
    /// A type of a parameter.
    Type,
    /// What a player of a behaviour does.
    Act,
    /// The unit of the number that stands there.
    Unit,
    /// A name.
    Name,
    /// A value that is no condition: a point, a length, a player.
    Operand,
    /// A value or a condition.
    Value,
}

/// What may stand next in the statement that ends a block's text; nothing if the text can't be read
/// up to its end.
///
/// - `block`: the word that begins the block, `scenario`; empty for a file.
pub fn next_parts(block: &str, statement: &str) -> Vec<NextPart> {
    // No token begins with this character.
    const END: char = '\u{1}';
    let text = format!("{statement}{END}");
    let Err(error) = PitchParser::parse(Context::of_block(block).probe(), &text) else {
        return Vec::new();
    };
    let (InputLocation::Pos(at) | InputLocation::Span((at, _))) = error.location;
    match error.variant {
        ErrorVariant::ParsingError { positives, .. } if at == statement.len() => {
            positives.into_iter().flat_map(parts_of).collect()
        }
        _ => Vec::new(),
    }
}

/// What a rule may begin with; nothing for signs, and for the statement that could follow.
fn parts_of(rule: Rule) -> Vec<NextPart> {
    let words: &[&str] = match rule {
        Rule::place => return vec![NextPart::Place],
        Rule::event_name | Rule::event | Rule::events => return vec![NextPart::Event],
        Rule::qualifier => return vec![NextPart::Qualifier],
        Rule::role | Rule::beside_role => return vec![NextPart::Role],
        Rule::type_name => return vec![NextPart::Type],
        Rule::act | Rule::act_name => return vec![NextPart::Act],
        Rule::unit | Rule::long_unit => return vec![NextPart::Unit],
        Rule::ident | Rule::path => return vec![NextPart::Name],
        Rule::operand | Rule::arg => return vec![NextPart::Operand],
        Rule::expr | Rule::value | Rule::param_default => return vec![NextPart::Value],
        Rule::end_when => &["success", "failure", "when", "script"],
        Rule::trigger => &["when", "script"],
        Rule::sight => &["noise", "when", "delayed", "stack"],
        Rule::removed => &["reward", "end", "require", "record", "substitute"],
        Rule::removed_whole => &["ball", "rounds", "world", "pitch", "start", "observe"],
        _ => return keyword(rule).map(NextPart::Keyword).into_iter().collect(),
    };
    words.iter().copied().map(NextPart::Keyword).collect()
}

#[cfg(test)]
mod tests {
    use super::NextPart::{
        self, Event, Keyword, Name, Operand, Place, Qualifier, Role, Unit, Value,
    };
    use super::next_parts;

    #[test]
    fn the_grammar_says_what_may_follow() {
        let cases: [(&str, &str, &[NextPart]); 15] = [
            ("scenario", "ball ", &[Place]),
            ("scenario", "ball at ", &[Operand]),
            ("scenario", "team ", &[Keyword("left"), Keyword("right")]),
            ("scenario", "remove end ", &[Name]),
            ("scenario", "let x = ", &[Value]),
            ("reward", "give 0.1 on ", &[Event]),
            ("reward", "give 0.1 on pass by ", &[Operand]),
            ("reward", "give 0.1 on pass\n    when ", &[Value]),
            ("reward", "give 0.1 * closing(ball, ", &[Operand]),
            ("check", "play academy with ", &[Name]),
            ("agents", "left: ", &[Keyword("script"), Value]),
            ("scenario", "param p: bool = ", &[Value]),
            // Text that can't be read has nothing behind it.
            ("reward", "give give ", &[]),
            ("scenario", "give 1 ", &[]),
            ("scenario", "ball at \u{1}", &[]),
        ];
        for (block, text, expected) in cases {
            assert_eq!(next_parts(block, text), expected, "{text}");
        }
        let some = |block, text, expected: &[NextPart]| {
            let found = next_parts(block, text);
            assert!(expected.iter().all(|it| found.contains(it)), "{text}: {found:?}");
        };
        some("scenario", "end ", &[Keyword("limit"), Keyword("success"), Keyword("when")]);
        some("scenario", "end limit 400 ", &[Unit]);
        some("reward", "give 0.1 on pass ", &[Qualifier, Keyword("by"), Keyword("when")]);
        some("team", "mid: ", &[Role]);
        some("team", "CM ", &[Place, Keyword("jitter"), Keyword("absent")]);
    }
}
