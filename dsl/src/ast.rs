//! The syntax tree: what an author wrote, with the span of every part, before any name means anything.
//!
//! The parser never fails: what it can't read becomes `Broken` and a problem. Constructs that the grammar has but that
//! a stage does not support yet still have their node, so that the stage can say so.

pub use crate::source::{FileId, Span};
use setpiece_scenario::vocabulary::{Qualifier, Role, Unit};

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
    /// `ending NAME [(…)] = …`
    Ending(FnItem),
    /// `behavior NAME …`: kept as text until the language's next widening.
    Behavior {
        /// Its name.
        name: Ident,
    },
    /// `curriculum`, `suite`, `check`: reserved.
    Reserved {
        /// The keyword.
        keyword: Ident,
    },
    /// Something that could not be read; a problem tells why.
    Broken,
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
    /// `remove reward|end|require|record NAME`, `remove ball`
    Remove {
        /// What kind of thing.
        what: Ident,
        /// Its name.
        name: Option<Ident>,
    },
    /// `mirror: flanks`
    Mirror(Ident),
    /// `observe vector { … }`
    Observe(Vec<(Expr, Option<Spanned<String>>)>),
    /// Something that could not be read; a problem tells why.
    Broken,
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
    /// An expression; `on` and `off` are [`ExprKind::Bool`].
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

/// A statement of a team or formation.
#[derive(Clone, Debug, PartialEq)]
pub struct TeamStmt {
    /// Its span.
    pub span: Span,
    /// What it is.
    pub kind: TeamStmtKind,
}

/// What a statement of a team is.
#[derive(Clone, Debug, PartialEq)]
pub enum TeamStmtKind {
    /// `[NAME:] [3] ROLE [PLACE] …`
    Player(PlayerStmt),
    /// `place NAME|ROLE PLACE …`
    Override {
        /// Who.
        who: Ident,
        /// What changes.
        change: PlayerStmt,
    },
    /// `each outfield|all|ROLE { … }`
    Each {
        /// Whom.
        who: Ident,
        /// Their defaults.
        fields: Vec<Field>,
    },
    /// `GK absent`
    Absent(Spanned<Role>),
    /// `difficulty: …`, `formation: …`
    Field(Field),
    /// Something that could not be read; a problem tells why.
    Broken,
}

/// A player.
#[derive(Clone, Debug, PartialEq)]
pub struct PlayerStmt {
    /// The name before the colon.
    pub name: Option<Ident>,
    /// How many.
    pub count: Option<Spanned<u32>>,
    /// The role; in a `place` override whatever stands for it.
    pub role: Spanned<Role>,
    /// Where.
    pub place: Option<Place>,
    /// `facing …`
    pub facing: Option<Facing>,
    /// `jitter …`
    pub jitter: Option<Expr>,
    /// `when …`: over parameters only.
    pub when: Option<Expr>,
    /// Options.
    pub fields: Vec<Field>,
}

/// `facing [away from] …`
#[derive(Clone, Debug, PartialEq)]
pub struct Facing {
    /// `away from`
    pub away: bool,
    /// A point, or an angle.
    pub target: Expr,
}

/// A place.
#[derive(Clone, Debug, PartialEq)]
pub struct Place {
    /// All of it.
    pub span: Span,
    /// Which form.
    pub kind: PlaceKind,
}

/// The forms of a place.
#[derive(Clone, Debug, PartialEq)]
pub enum PlaceKind {
    /// `at POINT`
    At(Expr),
    /// `in REGION`
    In(Expr),
    /// `ahead of X by D`, `behind X by D`, `left of X by D`, `right of X by D`
    Relative {
        /// `ahead`, `behind`, `left` or `right`.
        direction: Ident,
        /// Of whom.
        of: Expr,
        /// How far.
        by: Expr,
    },
    /// `between A and B [at S]`
    Between {
        /// From.
        a: Expr,
        /// To.
        b: Expr,
        /// The share of the way; half if absent.
        at: Option<Expr>,
    },
    /// `beyond X by D from Y`
    Beyond {
        /// What lies between.
        of: Expr,
        /// How far beyond.
        by: Expr,
        /// Seen from where.
        from: Expr,
    },
    /// `offset from X along ANGLE by D`
    Offset {
        /// From.
        from: Expr,
        /// Along.
        along: Expr,
        /// How far.
        by: Expr,
    },
}

/// A named reward.
#[derive(Clone, Debug, PartialEq)]
pub struct RewardItem {
    /// Its name.
    pub name: Ident,
    /// Its parameters.
    pub params: Vec<ParamDecl>,
    /// The parent.
    pub extends: Option<Ref>,
    /// Its statements.
    pub body: Vec<RewardStmt>,
}

/// `reward …` in a scenario.
#[derive(Clone, Debug, PartialEq)]
pub struct RewardUse {
    /// What is used.
    pub what: RewardUseKind,
    /// `as "x"`
    pub label: Option<Spanned<String>>,
    /// `* 0.5`
    pub weight: Option<Expr>,
}

/// What a scenario's `reward` uses.
#[derive(Clone, Debug, PartialEq)]
pub enum RewardUseKind {
    /// A named one.
    Named(Ref),
    /// One written here.
    Inline {
        /// Its name.
        name: Ident,
        /// Its statements.
        body: Vec<RewardStmt>,
    },
    /// A script.
    Script(ScriptRef),
}

/// A statement of a reward.
#[derive(Clone, Debug, PartialEq)]
pub struct RewardStmt {
    /// Its span.
    pub span: Span,
    /// What it is.
    pub kind: RewardStmtKind,
}

/// What a statement of a reward is.
#[derive(Clone, Debug, PartialEq)]
pub enum RewardStmtKind {
    /// `state x = 0`
    State(Binding),
    /// `let x = …`
    Let(Binding),
    /// `give …`
    Give(GiveStmt),
    /// `on EVENTS [when C] { … }`
    On {
        /// Any of these.
        events: Vec<EventExpr>,
        /// `when …`
        when: Option<Expr>,
        /// The block.
        body: Vec<RewardStmt>,
    },
    /// `when C { … } [else …]`
    When {
        /// The condition.
        condition: Expr,
        /// Where it holds.
        then: Vec<RewardStmt>,
        /// Where it doesn't; `else when` is a block of one statement.
        otherwise: Option<Vec<RewardStmt>>,
    },
    /// `x = …`
    Assign {
        /// The state.
        name: Ident,
        /// Its new value.
        value: Expr,
    },
    /// Something that could not be read; a problem tells why.
    Broken,
}

/// `give VALUE [per second] [once] [on EVENTS] [when C] [as "label"]`
#[derive(Clone, Debug, PartialEq)]
pub struct GiveStmt {
    /// How much.
    pub value: Expr,
    /// `per second`
    pub per_second: bool,
    /// `once`
    pub once: Option<Span>,
    /// `on …`; empty if absent.
    pub on: Vec<EventExpr>,
    /// `when …`
    pub when: Option<Expr>,
    /// `as "…"`
    pub label: Option<Spanned<String>>,
}

/// `end …`
#[derive(Clone, Debug, PartialEq)]
pub enum EndStmt {
    /// `end limit 400 steps`
    Limit(Expr),
    /// `end [success|failure] [LABEL] [when C | script …]`
    When {
        /// `success` or `failure`.
        verdict: Option<Ident>,
        /// The label, or a named `ending` with arguments.
        label: Option<Ref>,
        /// What ends it.
        condition: Option<EndCondition>,
    },
}

/// What ends an episode.
#[derive(Clone, Debug, PartialEq)]
pub enum EndCondition {
    /// `when C`
    Expr(Expr),
    /// `script …`
    Script(ScriptRef),
}

/// An event: `pass completed by us to me from them.box`.
#[derive(Clone, Debug, PartialEq)]
pub struct EventExpr {
    /// All of it.
    pub span: Span,
    /// Its name, known to be an event.
    pub name: Ident,
    /// `completed`, `on_target`, …
    pub qualifier: Option<Spanned<Qualifier>>,
    /// `by …`
    pub by: Option<Box<Expr>>,
    /// `to …`
    pub to: Option<Box<Expr>>,
    /// `from REGION`
    pub from: Option<Box<Expr>>,
}

/// An expression.
#[derive(Clone, Debug, PartialEq)]
pub struct Expr {
    /// Its span.
    pub span: Span,
    /// What it is.
    pub kind: ExprKind,
}

/// What an expression is.
#[derive(Clone, Debug, PartialEq)]
pub enum ExprKind {
    /// `0.5`, `12m`, `400 steps`; the value as written, not yet SI.
    Number {
        /// As written.
        value: f64,
        /// Whether it was written without a point or exponent.
        is_int: bool,
        /// Its unit.
        unit: Option<Unit>,
    },
    /// `true`, `false`, `on`, `off`
    Bool(bool),
    /// `"words"`
    String(String),
    /// A name, `left` and `right` included.
    Name(String),
    /// A role as a value: `p.role == CB`
    Role(Role),
    /// `x.y`
    Member(Box<Expr>, Ident),
    /// `own …`: read in the own frame.
    Own(Box<Expr>),
    /// `(x, y)` or `(x, y, z)`
    Tuple(Vec<Expr>),
    /// `[a, b]`
    List(Vec<Expr>),
    /// `f(…)`, `a.b(…)`: the callee is dotted names.
    Call {
        /// The callee.
        name: Ident,
        /// The arguments.
        args: Vec<Arg>,
    },
    /// `-x`, `+x`, `not x`
    Unary(UnaryOp, Box<Expr>),
    /// `a + b`, `a < b`, `a and b`, …
    Binary(Spanned<BinaryOp>, Box<Expr>, Box<Expr>),
    /// `if c then a else b`
    If(Box<Expr>, Box<Expr>, Box<Expr>),
    /// `X has ball`
    HasBall(Box<Expr>),
    /// `X changes [to Y]`
    Changes(Box<Expr>, Option<Box<Expr>>),
    /// An event as a condition.
    Event(Box<EventExpr>),
    /// `count of pass completed by left`, `max of me.speed`: records only.
    OverTime {
        /// `count`, `max`, …
        kind: Ident,
        /// Of what.
        of: Box<Expr>,
    },
    /// Something that could not be read; a problem tells why.
    Broken,
}

/// An argument: `key: value`, `value`, `value for x in set where c`, `x in set where c`.
#[derive(Clone, Debug, PartialEq)]
pub struct Arg {
    /// All of it.
    pub span: Span,
    /// The key before the colon, an expression (a plain name for named arguments, any value for weights).
    pub key: Option<Expr>,
    /// The value.
    pub value: Expr,
    /// `for x in set`
    pub binder: Option<(Ident, Expr)>,
    /// `where c`
    pub filter: Option<Expr>,
}

/// An operator of one operand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum UnaryOp {
    /// `-`
    Neg,
    /// `+`
    Plus,
    /// `not`
    Not,
}

/// An operator of two operands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs, reason = "each is the operator it is named after")]
pub enum BinaryOp {
    Add,
    Sub,
    Mul,
    Div,
    Lt,
    Le,
    Gt,
    Ge,
    Eq,
    Ne,
    And,
    Or,
    In,
    Union,
    Intersection,
}
