//! Scripts of Google Research Football that stand in a text, as scenarios.

use super::Workspace;
use super::actions::{Action, ActionKind, free_name};
use super::cursor::is_outside;
use super::edits::Edit;
use super::place::is_script;
use super::text::ends_in_code;
use crate::compile_text;
use crate::files::name_of;
use crate::grf::{GrfFault, GrfScript, identifier, scripts};
use std::ops::Range;
use std::path::Path;

impl Workspace {
    /// The script that some bytes touch as a scenario that compiles, named like the file; none if
    /// there is no script, or nothing in it can be read.
    pub(super) fn translation(&self, path: &Path, within: &Range<usize>) -> Option<Action> {
        if is_script(path) {
            return None;
        }
        let text = self.file_text(path)?;
        let blanks_behind = |end: usize| {
            let behind = text.get(end..).unwrap_or_default();
            text.len() - behind.trim_start().len()
        };
        // After pasting, the cursor stands in the blanks behind a script.
        let mut range = scripts(&text)
            .into_iter()
            .find(|range| range.start <= within.end && within.start <= blanks_behind(range.end))?;
        let (before, behind) = (text.get(..range.start)?, text.get(range.end..)?);
        if !ends_in_code(before) || !is_outside(before) {
            return None;
        }
        let title = "turn the script of Google Research Football into a scenario";
        let refused = |reason: String| {
            Some(Action {
                title: title.to_owned(),
                kind: ActionKind::Fix,
                edits: Vec::new(),
                code: None,
                refused: Some(reason),
            })
        };
        let script = match GrfScript::read(text.get(range.clone())?) {
            Ok(script) => script,
            Err(GrfFault::Empty) => return None,
            Err(fault) => return refused(fault.to_string()),
        };
        let is_last = behind.trim().is_empty();
        if is_last {
            range.end = text.len();
        }
        let stem = identifier(&path.file_stem().unwrap_or_default().to_string_lossy());
        // A word of the language is no name; nor is one that a formation of the text has.
        let names = [stem.clone(), format!("{stem}_scenario"), format!("{stem}_script")];
        let others = format!("{before}\n{behind}");
        let mut reason = None;
        let written = names.iter().find_map(|name| {
            let name = free_name(&others, name);
            let layouts = ["kicking", "receiving"].map(|role| format!("{name}_{role}"));
            if layouts.iter().any(|layout| free_name(&others, layout) != *layout) {
                return None;
            }
            let written = match script.to_pitch(&name) {
                Ok(written) => written,
                Err(fault) => {
                    reason = Some(format!("{fault}: {}", fault.help()));
                    return None;
                }
            };
            let compiled = compile_text(&written, &name_of(path));
            reason = compiled.as_ref().err().map(ToString::to_string);
            compiled.is_ok().then_some(written)
        });
        let Some(written) = written else { return refused(reason?) };
        let title = match script.left_out.len() {
            0 => title.to_owned(),
            1 => format!("{title}, without a line that can't be read"),
            count => format!("{title}, without {count} lines that can't be read"),
        };
        let written = if is_last { &written } else { written.trim_end() };
        let ends = if text.contains("\r\n") { "\r\n" } else { "\n" };
        let written = written.replace('\n', ends);
        Some(Action {
            title,
            kind: ActionKind::Fix,
            edits: vec![Edit::replace(path, range, written)],
            code: None,
            refused: None,
        })
    }
}
