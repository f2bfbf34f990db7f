//! Tables of numbers.

use super::facts;
use crate::problem::Code;
use crate::problem::said::say;

facts! {
    /// Facts about tables.
    pub(crate) Tables {
        /// A table that is no list of rows.
        NoRows = Code::WrongType =>
            say("expected rows of numbers", "")
                .help("write `[[0.1, 0.2], [0.3, 0.4]]`, or `from \"file.csv\"`"),
        /// A part of a row that is no number.
        NoNumber { text: String } = Code::WrongType =>
            say(format!("`{text}` is not known before the first episode"), "")
                .help("write a number or a `const`"),
        /// A word of a file that is no number.
        NoNumberInFile { text: String } = Code::WrongType =>
            say(
                if text.is_empty() { "a number is missing".to_owned() } else { format!("`{text}` is no number") },
                "",
            )
            .help("the file has numbers alone, `0.5` and not `0,5`, and no header; a line that begins with `#` is left out"),
        /// Rows of different lengths.
        UnequalRows { found: usize, wanted: usize } = Code::WrongArguments =>
            say(format!("this row has {found} {}, the first has {wanted}", if *found == 1 { "number" } else { "numbers" }), "")
                .help("give every row the same length"),
        /// More numbers than a table may have.
        TooLarge { most: usize } = Code::TooMuch =>
            say(format!("a table has at most {most} numbers"), "one too many").help("use larger cells"),
        /// A region that is no rectangle.
        NoRectangle { text: String } = Code::WrongType =>
            say(format!("`{text}` is no rectangle"), "").help("write `pitch`, `right.half` or `rect(from, to)`"),
        /// A second argument that is another word than `linear`.
        HowWord { name: String, word: String } = Code::WrongArguments =>
            say(format!("`{name}` is never looked up `{word}`"), "only `linear` stands here")
                .help(format!("write `{name}(…, linear)` to have it between the cells' centres, or leave it out")),
        /// A table is called with something else than a place.
        Arguments { name: String } = Code::WrongArguments =>
            say(format!("`{name}` is looked up at one place"), "")
                .help(format!("write `{name}(ball)`, or `{name}(ball, linear)` to have it between the cells' centres")),
    }
}
