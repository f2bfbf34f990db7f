//! The syntax tree: what an author wrote, with the span of every part, before any name means
//! anything.
//!
//! The parser never fails: what it can't read becomes `Broken` and a problem. Constructs that the
//! grammar has but that a stage does not support yet still have their node, so that the stage can
//! say so.

mod behavior;
mod expr;
mod level;
mod reward;
mod scenario;
mod team;

pub use crate::source::{FileId, Span};
pub use behavior::*;
pub use expr::*;
pub use level::*;
pub use reward::*;
pub use scenario::*;
pub use team::*;

/// Something and where it stands.
#[derive(Clone, Debug, PartialEq)]
pub struct Spanned<T> {
    /// The thing.
    pub node: T,
    /// Its span: trimmed of blanks and comments.
    pub span: Span,
}

/// A name.
pub type Ident = Spanned<String>;

/// A parsed file.
#[derive(Clone, Debug, PartialEq)]
pub struct File {
    /// Which file.
    pub id: FileId,
    /// The items, in order.
    pub items: Vec<Item>,
    /// Names that are declared where the text could not be read.
    pub lost: std::collections::BTreeSet<String>,
}

/// A top-level item.
#[derive(Clone, Debug, PartialEq)]
pub struct Item {
    /// The text of the `///` lines above it, without the slashes.
    pub doc: String,
    /// Its span, doc comments excluded.
    pub span: Span,
    /// What it is.
    pub kind: ItemKind,
}

/// What an item is.
#[derive(Clone, Debug, PartialEq)]
pub enum ItemKind {
    /// `import "path" [as name]`
    Import {
        /// The path as written.
        path: Spanned<String>,
        /// The name it is bound to.
        alias: Option<Ident>,
    },
    /// `[abstract] scenario NAME …`
    Scenario(ScenarioItem),
    /// `reward NAME …`
    Reward(RewardItem),
    /// `formation NAME …`
    Formation(FormationItem),
    /// `const NAME = …`
    Const(Binding),
    /// `fn NAME(…) = …`
    Fn(FnItem),
    /// `region NAME [(…)] = …`
    Region(FnItem),
    /// `table NAME [over REGION] = …`
    Table(TableItem),
    /// `ending NAME [(…)] = …`
    Ending(FnItem),
    /// `behavior NAME …`
    Behavior(BehaviorItem),
    /// `suite NAME …`
    Suite(SuiteItem),
    /// `check "…" …`
    Check(CheckItem),
    /// `curriculum NAME …`
    Curriculum(CurriculumItem),
    /// Something that could not be read; a problem tells why.
    Broken,
}

impl ItemKind {
    /// What it is in a sentence: "a reward".
    pub fn noun(&self) -> &'static str {
        match self {
            ItemKind::Scenario(_) => "a scenario",
            ItemKind::Reward(_) => "a reward",
            ItemKind::Formation(_) => "a formation",
            ItemKind::Const(_) => "a constant",
            ItemKind::Fn(_) => "a function",
            ItemKind::Region(_) => "a region",
            ItemKind::Table(_) => "a table",
            ItemKind::Ending(_) => "an ending",
            ItemKind::Behavior(_) => "a behavior",
            ItemKind::Suite(_) => "a suite",
            ItemKind::Check(_) => "a check",
            ItemKind::Curriculum(_) => "a curriculum",
            ItemKind::Import { .. } | ItemKind::Broken => "something else",
        }
    }

    /// Whether its name stands for a value in expressions.
    pub fn is_value(&self) -> bool {
        matches!(
            self,
            ItemKind::Const(_)
                | ItemKind::Fn(_)
                | ItemKind::Region(_)
                | ItemKind::Table(_)
                | ItemKind::Formation(_)
        )
    }

    /// The parameters in its brackets.
    pub fn params(&self) -> &[ParamDecl] {
        match self {
            ItemKind::Scenario(item) => &item.params,
            ItemKind::Reward(item) => &item.params,
            ItemKind::Formation(item) => &item.params,
            ItemKind::Fn(item) | ItemKind::Region(item) | ItemKind::Ending(item) => &item.params,
            ItemKind::Behavior(item) => &item.params,
            ItemKind::Import { .. }
            | ItemKind::Const(_)
            | ItemKind::Table(_)
            | ItemKind::Suite(_)
            | ItemKind::Check(_)
            | ItemKind::Curriculum(_)
            | ItemKind::Broken => &[],
        }
    }
}

/// A table of numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct TableItem {
    /// Its name.
    pub name: Ident,
    /// The part of the pitch that it covers; all of it if absent.
    pub over: Option<Expr>,
    /// Its numbers.
    pub rows: TableRows,
}

/// Where a table's numbers come from.
#[derive(Clone, Debug, PartialEq)]
pub enum TableRows {
    /// A list of lists.
    Written(Expr),
    /// A file of comma-separated values.
    File(Spanned<String>),
}

/// A scenario.
#[derive(Clone, Debug, PartialEq)]
pub struct ScenarioItem {
    /// Whether it may only be extended.
    pub is_abstract: bool,
    /// Its name; may begin with digits.
    pub name: Ident,
    /// Parameters in brackets.
    pub params: Vec<ParamDecl>,
    /// The parent.
    pub extends: Option<Ref>,
    /// The body.
    pub body: Vec<ScenarioStmt>,
}

/// A name with arguments: `parent(q: p)`.
#[derive(Clone, Debug, PartialEq)]
pub struct Ref {
    /// The name.
    pub name: Ident,
    /// The arguments.
    pub args: Vec<Arg>,
    /// All of it.
    pub span: Span,
}

impl Ref {
    /// The name without the one of its import: `shape` of `a.shape`.
    pub fn bare(&self) -> &str {
        self.name.node.rsplit('.').next().unwrap_or_default()
    }
}

/// A parameter's declaration.
#[derive(Clone, Debug, PartialEq)]
pub struct ParamDecl {
    /// The `///` lines above it.
    pub doc: String,
    /// Its name.
    pub name: Ident,
    /// Its type, if written; `player?` keeps its question mark.
    pub ty: Option<Ident>,
    /// Its default.
    pub default: Option<Expr>,
    /// What it may be.
    pub domain: Option<Domain>,
    /// All of it.
    pub span: Span,
}

/// What a parameter may be.
#[derive(Clone, Debug, PartialEq)]
pub enum Domain {
    /// `in low..high`
    Range(Expr, Expr),
    /// `in [a, b, c]`
    List(Vec<Expr>, Span),
}

/// `let NAME [: type] = expr`, `const …`, `state …`, `record …`.
#[derive(Clone, Debug, PartialEq)]
pub struct Binding {
    /// Its name.
    pub name: Ident,
    /// Its type, if written.
    pub ty: Option<Ident>,
    /// Its value.
    pub value: Expr,
}

impl Binding {
    /// From its name to the end of its value.
    pub fn whole(&self) -> Span {
        self.name.span.to(self.value.span)
    }
}

/// A pure function, region or ending.
#[derive(Clone, Debug, PartialEq)]
pub struct FnItem {
    /// Its name.
    pub name: Ident,
    /// Its parameters.
    pub params: Vec<ParamDecl>,
    /// The result's type, if written.
    pub ty: Option<Ident>,
    /// Its body.
    pub body: Expr,
}

/// A formation.
#[derive(Clone, Debug, PartialEq)]
pub struct FormationItem {
    /// Its name.
    pub name: Ident,
    /// Its parameters.
    pub params: Vec<ParamDecl>,
    /// The parent.
    pub extends: Option<Ref>,
    /// Its players, in the own frame.
    pub body: Vec<TeamStmt>,
}
