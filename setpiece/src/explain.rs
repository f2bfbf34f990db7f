//! The pages of the error codes, `docs/errors/`, embedded.

use setpiece_dsl::problem::{Code, nearest};

/// File name and text of every page.
const PAGES: &[(&str, &str)] = include!(concat!(env!("OUT_DIR"), "/pages.rs"));

/// The page of a code, as Markdown: its meaning, an example, and the corrected example.
pub fn page(code: Code) -> Option<&'static str> {
    let name = format!("{code}.md");
    PAGES.iter().find(|(file, _)| *file == name).map(|(_, text)| *text)
}

/// The code most similar to a text that isn't a code.
pub fn similar(text: &str) -> Option<Code> {
    let names: Vec<String> = Code::ALL.iter().map(Code::to_string).collect();
    nearest(text, names.iter().map(String::as_str)).and_then(Code::from_text)
}
