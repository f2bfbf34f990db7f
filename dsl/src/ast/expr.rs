//! Expressions.

use super::{EventExpr, Ident, Span, Spanned};
use setpiece_scenario::vocabulary::{Role, Unit};

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
    Unary(PrefixOp, Box<Expr>),
    /// `a + b`, `a < b`, `a and b`, …
    Binary(Spanned<InfixOp>, Box<Expr>, Box<Expr>),
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
    /// The key before the colon, an expression (a plain name for named arguments, any value for
    /// weights).
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
pub enum PrefixOp {
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
pub enum InfixOp {
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
