//! Imports and scripts: files that are missing, too many or too large, and what the engine says of
//! scripts.

use super::facts;
use crate::problem::Code;
use crate::problem::said::say;

facts! {
    /// Facts about files.
    pub(crate) Files {
        /// A file that can't be loaded, in the loader's words; `is_import`: it is imported, else it
        /// is a script's or a table's.
        Missing { why: String, similar: Option<String>, is_import: bool } = Code::FileMissing => {
            let said = say(why.as_str(), if *is_import { "imported here" } else { "named here" });
            match similar {
                Some(similar) => said.help(format!("did you mean `{similar}`?")),
                None => said,
            }
        },
        /// Imports lead in a circle.
        ImportsItself { path: String } = Code::ImportCycle =>
            say(format!("`{path}` imports itself, by way of this line"), "closes the circle")
                .help("move what both files need into a third one"),
        /// More imports than a compilation reads.
        TooManyImports { limit: ImportLimit } = Code::TooMuch =>
            say(limit.words(), "one too many").help("import less, or join some of the files"),
        /// More scripts than a compilation reads.
        TooManyScripts { limit: ScriptLimit } = Code::TooMuch =>
            say(limit.words(), "one too many").help("join some of the scripts: a file may hold several hooks"),
        /// A script that is longer than one may be.
        LongScript { most: usize, has_modules: bool } = Code::TooMuch => {
            let whole = if *has_modules { " with its modules" } else { "" };
            say(format!("this script{whole} is larger than {} KiB", most >> 10), "too long")
                .help("divide it: each hook may have a file of its own")
        },
        /// What can't be the path of a module.
        NotAModule { path: String } = Code::FileMissing =>
            say(format!("`{path}` can't be a module"), "imported here")
                .help("a module lies beside the script or in a folder below: `import \"lib\" as lib;` reads `lib.rhai`"),
        /// What the engine says of a script, in its words.
        Script { code: Code, message: String, help: Option<String> } = *code => {
            let said = say(message.as_str(), "");
            match help {
                Some(help) => said.help(help.as_str()),
                None => said,
            }
        },
    }
}

/// A limit of imports.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum ImportLimit {
    /// Files that are missing.
    Missing(usize),
    /// Files inside of files.
    Depth(usize),
    /// Files.
    Files(usize),
    /// Bytes of all files.
    Bytes(usize),
}

impl ImportLimit {
    fn words(self) -> String {
        match self {
            ImportLimit::Missing(most) => format!("more than {most} imports find no file"),
            ImportLimit::Depth(most) => format!("files import each other more than {most} deep"),
            ImportLimit::Files(most) => format!("more than {most} files are imported"),
            ImportLimit::Bytes(most) => {
                format!("imported files are larger than {} MiB together", most >> 20)
            }
        }
    }
}

/// A limit of scripts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum ScriptLimit {
    /// Files.
    Files(usize),
    /// Bytes of all, each as often as it is used.
    Bytes(usize),
    /// Modules of one script.
    Modules(usize),
}

impl ScriptLimit {
    fn words(self) -> String {
        match self {
            ScriptLimit::Files(most) => format!("more than {most} script files are named"),
            ScriptLimit::Bytes(most) => {
                format!("the scripts are larger than {} MiB together", most >> 20)
            }
            ScriptLimit::Modules(most) => format!("a script has more than {most} modules"),
        }
    }
}
