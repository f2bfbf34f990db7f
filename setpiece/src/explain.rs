//! The pages of the error codes, `docs/errors/`, embedded.

use setpiece_dsl::problem::{Code, nearest};

/// File name and text of every page.
const PAGES: &[(&str, &str)] = include!(concat!(env!("OUT_DIR"), "/pages.rs"));

/// The page of a code, as Markdown: what it means, a text that earns it, and the text mended.
pub fn page(code: Code) -> Option<&'static str> {
    let name = format!("{code}.md");
    PAGES.iter().find(|(file, _)| *file == name).map(|(_, text)| *text)
}

/// The code most like a text that is none.
pub fn similar(text: &str) -> Option<Code> {
    let names: Vec<String> = Code::ALL.iter().map(Code::to_string).collect();
    nearest(text, names.iter().map(String::as_str)).and_then(Code::from_text)
}
