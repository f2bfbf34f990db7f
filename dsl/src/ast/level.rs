//! Suites, checks and curricula: what is said about many episodes.

use super::{Domain, Expr, Ident, Ref, Span, Spanned};

/// `suite NAME { … }`
#[derive(Clone, Debug, PartialEq)]
pub struct SuiteItem {
    /// Its name.
    pub name: Ident,
    /// Its entries.
    pub body: Vec<SuiteStmt>,
}

/// A statement of a suite.
#[derive(Clone, Debug, PartialEq)]
pub struct SuiteStmt {
    /// Its span.
    pub span: Span,
    /// What it is.
    pub kind: SuiteStmtKind,
}

/// What a statement of a suite is.
#[derive(Clone, Debug, PartialEq)]
pub enum SuiteStmtKind {
    /// `each NAME in [a, b] { … }`
    Sweep {
        /// The name that the body sees.
        name: Ident,
        /// Its values.
        values: Vec<Expr>,
        /// What is repeated for each of them.
        body: Vec<SuiteStmt>,
    },
    /// `SCENARIO(args) for N episodes [seed S]`
    Entry(EpisodesExpr),
    /// Something that could not be read.
    Broken,
}

/// Episodes of a scenario.
#[derive(Clone, Debug, PartialEq)]
pub struct EpisodesExpr {
    /// The scenario and its arguments.
    pub scenario: Ref,
    /// How many.
    pub count: Expr,
    /// Their seed, if written.
    pub seed: Option<Expr>,
}

/// `check "WHAT HOLDS" { … }`
#[derive(Clone, Debug, PartialEq)]
pub struct CheckItem {
    /// What holds, in words.
    pub name: Spanned<String>,
    /// Its statements.
    pub body: Vec<CheckStmt>,
}

/// A statement of a check.
#[derive(Clone, Debug, PartialEq)]
pub struct CheckStmt {
    /// Its span.
    pub span: Span,
    /// What it is.
    pub kind: CheckStmtKind,
}

/// What a statement of a check is.
#[derive(Clone, Debug, PartialEq)]
pub enum CheckStmtKind {
    /// `play SCENARIO(args) [with AGENT] for N episodes [seed S] [over params]`
    Play {
        /// What is played.
        episodes: EpisodesExpr,
        /// The agent that plays every slot.
        agent: Option<Ident>,
        /// Whether parameters are drawn from their ranges.
        over_params: bool,
    },
    /// `expect MEASURE < BOUND`
    Expect(GoalExpr),
    /// `expect never OUTCOME`
    Never(Ident),
    /// Something that could not be read.
    Broken,
}

/// A measure and its bound.
#[derive(Clone, Debug, PartialEq)]
pub struct GoalExpr {
    /// What is measured.
    pub measure: MeasureRef,
    /// `<`, `<=`, `>`, `>=`, `==`, `!=`
    pub comparison: Spanned<String>,
    /// The bound.
    pub bound: Expr,
    /// All of it.
    pub span: Span,
}

/// `success_rate`, `mean(length)`, `quantile(term "pass", 90%)`, `success_rate(last: 200)`
#[derive(Clone, Debug, PartialEq)]
pub struct MeasureRef {
    /// Its name.
    pub name: Ident,
    /// What stands in its brackets.
    pub args: Vec<MeasureArg>,
    /// All of it.
    pub span: Span,
}

/// What stands in the brackets of a measure.
#[derive(Clone, Debug, PartialEq)]
pub enum MeasureArg {
    /// `last: 200`
    Named(Ident, Expr),
    /// `term "pass"`, `record passes`, `outcome goal`
    Of(Ident, Spanned<String>),
    /// `length`, `90%`
    Value(Expr),
}

/// `curriculum NAME { … }`
#[derive(Clone, Debug, PartialEq)]
pub struct CurriculumItem {
    /// Its name.
    pub name: Ident,
    /// Its statements.
    pub body: Vec<CurriculumStmt>,
}

/// A statement of a curriculum.
#[derive(Clone, Debug, PartialEq)]
pub struct CurriculumStmt {
    /// Its span.
    pub span: Span,
    /// What it is.
    pub kind: CurriculumStmtKind,
}

/// What a statement of a curriculum is.
#[derive(Clone, Debug, PartialEq)]
pub enum CurriculumStmtKind {
    /// `stage NAME = SCENARIO(args) …`
    Stage {
        /// Its name.
        name: Ident,
        /// What is played.
        scenario: Ref,
        /// What ends it, or how it adapts.
        how: StageRule,
    },
    /// `mix current: 80%, earlier: 20%`
    Mix {
        /// The share of the present stage.
        current: Expr,
        /// The share of the stages before it.
        earlier: Expr,
    },
    /// Something that could not be read.
    Broken,
}

/// What ends a stage, or how it adapts.
#[derive(Clone, Debug, PartialEq)]
pub enum StageRule {
    /// Nothing ends it.
    Forever,
    /// `until A or B`
    Until(Vec<GoalExpr>),
    /// `adapt NAME from LOW to HIGH keeping MEASURE in LOW..HIGH`
    Adapt(Box<AdaptExpr>),
}

/// `adapt NAME from LOW to HIGH keeping MEASURE in LOW..HIGH`
#[derive(Clone, Debug, PartialEq)]
pub struct AdaptExpr {
    /// The name that the arguments see.
    pub name: Ident,
    /// Where it begins.
    pub from: Expr,
    /// Where it leads.
    pub to: Expr,
    /// What is measured.
    pub measure: MeasureRef,
    /// Where the measure is kept.
    pub band: Domain,
}
