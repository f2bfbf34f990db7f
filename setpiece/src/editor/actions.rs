//! Helps of reports that apply themselves.

use super::Analysis;
use std::ops::Range;

/// A change that mends a problem.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fix {
    /// What it does, in words.
    pub title: String,
    /// The bytes that are replaced.
    pub range: Range<usize>,
    /// What stands there then.
    pub text: String,
    /// The code of the problem.
    pub code: String,
}

impl Analysis {
    /// What mends the problems that touch some bytes of the text.
    pub fn fixes(&self, within: Range<usize>) -> Vec<Fix> {
        let touches = |own: &Range<usize>| own.start <= within.end && within.start <= own.end;
        self.problems
            .iter()
            .filter_map(|problem| Some((problem, self.own(problem.place()).filter(touches)?)))
            .filter_map(|(problem, range)| {
                let help = problem.words().help?;
                let meant = help.strip_prefix("did you mean `")?.strip_suffix("`?")?;
                Some(Fix {
                    title: format!("write `{meant}`"),
                    range,
                    text: meant.to_owned(),
                    code: problem.code().to_string(),
                })
            })
            .collect()
    }
}
