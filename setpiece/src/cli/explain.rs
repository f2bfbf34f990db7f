//! `setpiece explain`: the page of an error code.

use super::common::{FAULT, FINE};
use super::out::{Out, StyledText};
use crate::dsl::problem::{Code, Severity};
use crate::explain::{page, similar};

/// Prints the page of a code, or the list of codes.
pub(crate) fn explain(wanted: Option<&str>, out: &Out) -> u8 {
    let Some(wanted) = wanted else {
        for code in Code::ALL {
            let severity = if code.severity() == Severity::Error { "error" } else { "warning" };
            let line = StyledText::default().bold(&format!("{code:6}"));
            out.line(line.text(&format!("  {severity:7}  {}", code.title())));
        }
        return FINE;
    };
    let Some(text) = Code::from_text(wanted).and_then(page) else {
        let help = similar(wanted).map(|code| format!("did you mean `{code}`?"));
        let help = help.unwrap_or_else(|| "`setpiece explain` lists the codes".to_owned());
        out.fault(
            &Code::UnknownCode.to_string(),
            &format!("no report has the code `{wanted}`"),
            Some(&help),
        );
        return FAULT;
    };
    let mut in_block = false;
    for line in text.lines() {
        if line.starts_with("```") {
            in_block = !in_block;
        } else if in_block {
            out.line(format!("    {line}").trim_end());
        } else if let Some(title) = line.strip_prefix("# ") {
            out.line(StyledText::default().bold(title));
        } else {
            out.line(line);
        }
    }
    FINE
}
