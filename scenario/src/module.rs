//! Modules: texts with functions that scripts import.

use serde::{Deserialize, Serialize};

/// The ending of a module's file.
const ENDING: &str = ".rhai";
/// The most modules of one script.
pub const MODULES_MAX: usize = 16;

/// A module of a script, embedded.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ScriptModule {
    /// Its path from the script's folder.
    pub name: String,
    /// The text.
    pub source: String,
}

/// The name of the module that `import "PATH"` means in a module, or in the script itself, which
/// has no name. `None` if it is no path of a module.
///
/// A path leads to the folder of the importing file or below: words of letters, digits, `_` and `-`
/// between slashes.
pub fn module_name(importer: &str, path: &str) -> Option<String> {
    let path = path.strip_suffix(ENDING).unwrap_or(path);
    let is_word = |word: &str| {
        !word.is_empty()
            && word.bytes().all(|byte| byte.is_ascii_alphanumeric() || matches!(byte, b'_' | b'-'))
    };
    let folder = importer.rfind('/').map_or("", |slash| &importer[..=slash]);
    path.split('/').all(is_word).then(|| format!("{folder}{path}{ENDING}"))
}

#[cfg(test)]
mod tests {
    use super::module_name;

    #[test]
    fn a_module_lies_in_the_importers_folder_or_below() {
        assert_eq!(module_name("", "lib").as_deref(), Some("lib.rhai"));
        assert_eq!(module_name("", "lib.rhai").as_deref(), Some("lib.rhai"));
        assert_eq!(module_name("a/b.rhai", "c-1/d_2").as_deref(), Some("a/c-1/d_2.rhai"));
        for path in [
            "", "/lib", "../lib", "a/../lib", "./lib", "a//b", "c:lib", "a\\b", "lib.txt", "a b",
            "é",
        ] {
            assert_eq!(module_name("", path), None, "{path}");
        }
    }
}
