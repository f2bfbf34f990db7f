//! Finds the ends of expressions and the names of functions in a script's text, which Rhai's syntax
//! tree doesn't contain.

use std::ops::Range;

/// The places of the names of the functions that a text defines.
pub(super) fn definitions(text: &str) -> Vec<Range<usize>> {
    let bytes = text.as_bytes();
    let (mut found, mut at) = (Vec::new(), 0);
    while let Some(&byte) = bytes.get(at) {
        at = match byte {
            b'"' | b'\'' => quote_end(bytes, at),
            b'`' => interpolated_end(text, at),
            b'#' => raw_text_end(text, at),
            b'/' => comment_end(text, at),
            b'(' | b'[' | b'{' => end_of(text, at + 1, |_| false) + 1,
            _ if is_letter(byte) => {
                let end = word_end(bytes, at);
                if &bytes[at..end] == b"fn" {
                    let name = defined_name(text, end);
                    let end = name.end.max(end);
                    found.extend((!name.is_empty()).then_some(name));
                    end
                } else {
                    end
                }
            }
            _ => at + 1,
        };
    }
    found
}

/// The name after `fn`: the last word before the parameters, behind the type of `this` if there is
/// one.
fn defined_name(text: &str, start: usize) -> Range<usize> {
    let bytes = text.as_bytes();
    let (mut name, mut at) = (start..start, start);
    while let Some(&byte) = bytes.get(at) {
        at = match byte {
            b'"' => quote_end(bytes, at),
            b'/' => comment_end(text, at),
            b'.' => at + 1,
            _ if byte.is_ascii_whitespace() => at + 1,
            _ if is_letter(byte) => {
                name = at..word_end(bytes, at);
                name.end
            }
            _ => return name,
        };
    }
    name
}

fn is_letter(byte: u8) -> bool {
    byte.is_ascii_alphanumeric() || byte == b'_'
}

fn word_end(bytes: &[u8], start: usize) -> usize {
    let letters = bytes[start..].iter().take_while(|byte| is_letter(**byte)).count();
    start + letters
}

/// The byte after an expression: at a closing bracket that didn't open in it, or at a `,` or `;`
/// outside any.
pub(super) fn expression_end(text: &str, start: usize) -> usize {
    end_of(text, start, |byte| matches!(byte, b',' | b';'))
}

/// The bracket that closes the one at `open`.
pub(super) fn closing_bracket(text: &str, open: usize) -> Option<usize> {
    let end = end_of(text, open + 1, |_| false);
    (end < text.len()).then_some(end)
}

/// The first closing bracket without an opening one, or a byte that `stops` outside all brackets.
fn end_of(text: &str, start: usize, stops: impl Fn(u8) -> bool) -> usize {
    let bytes = text.as_bytes();
    let mut depth = 0usize;
    let mut at = start;
    while let Some(&byte) = bytes.get(at) {
        at = match byte {
            b'"' | b'\'' => quote_end(bytes, at),
            b'`' => interpolated_end(text, at),
            b'#' => raw_text_end(text, at),
            b'/' => comment_end(text, at),
            b'(' | b'[' | b'{' => {
                depth += 1;
                at + 1
            }
            b')' | b']' | b'}' if depth == 0 => return at,
            b')' | b']' | b'}' => {
                depth -= 1;
                at + 1
            }
            byte if depth == 0 && stops(byte) => return at,
            _ => at + 1,
        };
    }
    bytes.len()
}

/// The byte after a string in quotes.
fn quote_end(bytes: &[u8], start: usize) -> usize {
    let quote = bytes[start];
    let mut at = start + 1;
    while let Some(&byte) = bytes.get(at) {
        match byte {
            b'\\' => at += 2,
            byte if byte == quote => return at + 1,
            _ => at += 1,
        }
    }
    bytes.len()
}

/// The byte after a string in backticks, whose `${…}` hold expressions.
fn interpolated_end(text: &str, start: usize) -> usize {
    let bytes = text.as_bytes();
    let mut at = start + 1;
    while let Some(&byte) = bytes.get(at) {
        match byte {
            b'`' => return at + 1,
            b'$' if bytes.get(at + 1) == Some(&b'{') => at = end_of(text, at + 2, |_| false) + 1,
            _ => at += 1,
        }
    }
    bytes.len()
}

/// The byte after a string between `#"` and `"#` with as many `#`, or after a `#` of something
/// else.
fn raw_text_end(text: &str, start: usize) -> usize {
    let rest = &text[start..];
    let hashes = rest.bytes().take_while(|&byte| byte == b'#').count();
    if rest.as_bytes().get(hashes) != Some(&b'"') {
        return start + hashes;
    }
    let close = format!("\"{}", "#".repeat(hashes));
    let body = start + hashes + 1;
    text[body..].find(&close).map_or(text.len(), |found| body + found + close.len())
}

/// The byte after a comment, or after a `/` of something else.
fn comment_end(text: &str, start: usize) -> usize {
    let rest = &text[start..];
    if rest.starts_with("//") {
        return rest.find(['\n', '\r']).map_or(text.len(), |end| start + end);
    }
    if !rest.starts_with("/*") {
        return start + 1;
    }
    let bytes = rest.as_bytes();
    let (mut depth, mut at) = (0usize, 0);
    while at < bytes.len() {
        match &bytes[at..(at + 2).min(bytes.len())] {
            b"/*" => (depth, at) = (depth + 1, at + 2),
            b"*/" => {
                (depth, at) = (depth - 1, at + 2);
                if depth == 0 {
                    return start + at;
                }
            }
            _ => at += 1,
        }
    }
    text.len()
}
