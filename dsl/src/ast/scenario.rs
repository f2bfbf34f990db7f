//! Scenarios: their statements, options, the ball.

use super::{
    Binding, EndStmt, Expr, FnItem, Ident, ParamDecl, Place, RewardUse, Span, Spanned, TeamStmt,
};

/// A statement of a scenario.
#[derive(Clone, Debug, PartialEq)]
pub struct ScenarioStmt {
    /// The `///` lines above it.
    pub doc: String,
    /// Its span.
    pub span: Span,
    /// What it is.
    pub kind: ScenarioStmtKind,
}

/// What a statement of a scenario is.
#[derive(Clone, Debug, PartialEq)]
pub enum ScenarioStmtKind {
    /// `param …`
    Param(ParamDecl),
    /// `let …`
    Let(Binding),
    /// `let (a, b, c) = shuffle(p, q, r)`
    LetTuple {
        /// The names, two or more.
        names: Vec<Ident>,
        /// What they share out.
        value: Expr,
    },
    /// `const …`
    Const(Binding),
    /// `region …`
    Region(FnItem),
    /// `rules { … }`
    Rules(Vec<Field>),
    /// `world { … }`
    World(Vec<Field>),
    /// `pitch { … }`
    Pitch(Vec<Field>),
    /// `agents { … }`
    Agents(Vec<Field>),
    /// `ball PLACE …`
    Ball(BallStmt),
    /// `team left|right { … }`
    Team {
        /// Which.
        team: Ident,
        /// Its statements.
        body: Vec<TeamStmt>,
    },
    /// `kickoff EXPR { kicking: F, receiving: G }`
    Kickoff {
        /// The team that kicks off first.
        first: Expr,
        /// The layouts.
        fields: Vec<Field>,
    },
    /// `start KIND [for TEAM] [at POINT] { … }`
    Start {
        /// The kind.
        kind: Ident,
        /// Who takes it.
        team: Option<Expr>,
        /// Where.
        at: Option<Expr>,
        /// `score`, `elapsed`.
        fields: Vec<Field>,
    },
    /// `reward …`
    Reward(RewardUse),
    /// `end …`
    End(EndStmt),
    /// `require …`
    Require {
        /// What must hold.
        condition: Expr,
        /// `with 80%`
        probability: Option<Expr>,
        /// `as "label"`
        label: Option<Spanned<String>>,
    },
    /// `record NAME = …`
    Record(Binding),
    /// `remove reward|end|require|record|substitute NAME`, `remove ball|rounds|world|start|observe`
    Remove {
        /// What kind of thing.
        what: Ident,
        /// Its name.
        name: Option<Ident>,
    },
    /// `rounds N when …`
    Rounds(Rounds),
    /// `substitute PLAYER when …`
    Substitute(Substitute),
    /// `mirror: flanks`
    Mirror(Ident),
    /// `observe vector { … }`
    Observe(Vec<Observed>),
    /// Something that could not be read; a problem tells why.
    Broken,
}

/// A line of `observe vector`.
#[derive(Clone, Debug, PartialEq)]
pub struct Observed {
    /// What is seen.
    pub value: Expr,
    /// `noise …`: what is added.
    pub noise: Option<Expr>,
    /// `when …`: whether it is seen.
    pub when: Option<Expr>,
    /// `delayed …`: how late.
    pub delay: Option<Expr>,
    /// `stack …`: how many steps of it.
    pub stack: Option<Expr>,
    /// `as "x"`
    pub label: Option<Spanned<String>>,
}

/// `key: value`
#[derive(Clone, Debug, PartialEq)]
pub struct Field {
    /// The key.
    pub key: Ident,
    /// The value.
    pub value: FieldValue,
}

/// The value of a field.
#[derive(Clone, Debug, PartialEq)]
pub enum FieldValue {
    /// An expression; `on` and `off` are [`super::ExprKind::Bool`].
    Expr(Expr),
    /// `{ … }`
    Fields(Vec<Field>, Span),
    /// `script …`
    Script(ScriptRef),
}

/// `script "file.rhai"` or `script rhai """…"""`.
#[derive(Clone, Debug, PartialEq)]
pub struct ScriptRef {
    /// All of it.
    pub span: Span,
    /// Where its text is.
    pub source: ScriptSource,
}

/// Where a script's text is.
#[derive(Clone, Debug, PartialEq)]
pub enum ScriptSource {
    /// In a file beside this one.
    File(Spanned<String>),
    /// Here: the span is the text's own.
    Inline(Spanned<String>),
}

/// The ball.
#[derive(Clone, Debug, PartialEq)]
pub struct BallStmt {
    /// Where it lies.
    pub place: Place,
    /// `jitter 1m`
    pub jitter: Option<Expr>,
    /// `velocity`, `height`, `spin`, `owner`.
    pub fields: Vec<Field>,
}

/// Several rounds in one episode.
#[derive(Clone, Debug, PartialEq)]
pub struct Rounds {
    /// How many.
    pub count: Expr,
    /// When one is over.
    pub when: Expr,
}

/// A player who is replaced.
#[derive(Clone, Debug, PartialEq)]
pub struct Substitute {
    /// Who.
    pub who: Expr,
    /// When.
    pub when: Expr,
    /// What is said of the one who comes on.
    pub fields: Vec<Field>,
}
