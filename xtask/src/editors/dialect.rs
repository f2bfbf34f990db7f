//! What editors call the captures of the grammar's queries, whose names are Neovim's.

/// The queries that an editor reads, and the names that differ.
pub(super) struct Dialect {
    queries: &'static [&'static str],
    names: &'static [(&'static str, &'static str)],
}

/// Neovim's own names.
pub(super) const NEOVIM: Dialect =
    Dialect { queries: &["highlights", "folds", "indents", "locals", "injections"], names: &[] };

/// Helix: <https://docs.helix-editor.com/themes.html>,
/// <https://docs.helix-editor.com/guides/indent.html>.
pub(super) const HELIX: Dialect = Dialect {
    queries: &["highlights", "indents", "locals", "tags", "injections"],
    names: &[
        ("boolean", "constant.builtin.boolean"),
        ("comment.documentation", "comment.block.documentation"),
        ("function.call", "function"),
        ("indent.begin", "indent"),
        ("indent.branch", "outdent"),
        ("indent.end", "_end"),
        ("local.definition", "local.definition.variable"),
        ("number", "constant.numeric"),
        ("property", "variable.other.member"),
        ("type.definition", "type"),
    ],
};

/// Zed: <https://zed.dev/docs/extensions/languages>.
pub(super) const ZED: Dialect = Dialect {
    queries: &["highlights", "indents", "injections"],
    names: &[
        ("comment.documentation", "comment.doc"),
        ("function.call", "function"),
        ("indent.begin", "indent"),
        ("indent.branch", "_branch"),
        ("indent.end", "end"),
        ("keyword.control", "keyword"),
        ("type.definition", "type"),
    ],
};

impl Dialect {
    /// Whether the editor reads a query.
    pub(super) fn has(&self, query: &str) -> bool {
        self.queries.contains(&query)
    }

    /// A query with the editor's names.
    pub(super) fn translated(&self, query: &str) -> String {
        let mut parts = query.split('@');
        let mut text = parts.next().unwrap_or_default().to_owned();
        for part in parts {
            let is_name = |letter: char| letter.is_alphanumeric() || "._-".contains(letter);
            let (name, rest) = part.split_at(part.find(|c| !is_name(c)).unwrap_or(part.len()));
            let known = self.names.iter().find(|(ours, _)| *ours == name);
            text.push('@');
            text.push_str(known.map_or(name, |(_, theirs)| theirs));
            text.push_str(rest);
        }
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whole_names_are_translated() {
        let query =
            "(a) @number\n(_ \"{\" \"}\" @indent.end) @indent.begin ; number\n(#eq? @number \"1\")";
        let expected = "(a) @constant.numeric\n(_ \"{\" \"}\" @_end) @indent ; number\n(#eq? @constant.numeric \"1\")";
        assert_eq!(HELIX.translated(query), expected);
        assert_eq!(NEOVIM.translated(query), query);
        assert_eq!(HELIX.translated("(a) @number.float"), "(a) @number.float");
    }

    #[test]
    fn every_name_of_a_dialect_is_used_by_a_query() {
        let folder = crate::shell::root().join("grammar/tree-sitter/queries");
        for dialect in [&HELIX, &ZED] {
            let queries = dialect.queries.iter().map(|query| {
                let path = folder.join(format!("{query}.scm"));
                crate::shell::read(&path).expect("a query of the grammar")
            });
            let all: String = queries.collect();
            for (ours, _) in dialect.names {
                let is_there = |end: &str| all.contains(&format!("@{ours}{end}"));
                assert!(["\n", ")", " "].iter().any(|end| is_there(end)), "@{ours}");
            }
        }
    }
}
