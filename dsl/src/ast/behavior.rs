//! Behaviours: scripted players.

use super::{Arg, Binding, Expr, Ident, ParamDecl, ScriptRef, Span};

/// `behavior NAME(params) …`
#[derive(Clone, Debug, PartialEq)]
pub struct BehaviorItem {
    /// Its name.
    pub name: Ident,
    /// Its parameters.
    pub params: Vec<ParamDecl>,
    /// What it does.
    pub body: BehaviorBody,
}

/// What a behaviour does.
#[derive(Clone, Debug, PartialEq)]
pub enum BehaviorBody {
    /// Statements, one after the other.
    Block(Vec<BehaviorStmt>),
    /// What a script's `act` hook says.
    Script(ScriptRef),
}

/// A statement of a behaviour.
#[derive(Clone, Debug, PartialEq)]
pub struct BehaviorStmt {
    /// Its span.
    pub span: Span,
    /// What it is.
    pub kind: BehaviorStmtKind,
}

/// What a statement of a behaviour is.
#[derive(Clone, Debug, PartialEq)]
pub enum BehaviorStmtKind {
    /// `state x = 0`
    State(Binding),
    /// `let x = …`: frozen when it is reached.
    Let(Binding),
    /// `x = …`
    Assign {
        /// The state.
        name: Ident,
        /// Its new value.
        value: Expr,
    },
    /// `do …`
    Do(DoStmt),
    /// `interrupt when C { … }`
    Interrupt {
        /// The condition.
        condition: Expr,
        /// What is done then.
        body: Vec<BehaviorStmt>,
    },
    /// `repeat [until C | N times] { … }`
    Repeat {
        /// When it ends.
        how: RepeatHow,
        /// What is repeated.
        body: Vec<BehaviorStmt>,
    },
    /// `choose { 2: … 1: … }`
    Choose(Vec<Chance>),
    /// `if C { … } else if D { … } else { … }`
    If {
        /// The conditions and their blocks, in order.
        arms: Vec<(Expr, Vec<BehaviorStmt>)>,
        /// Where none holds.
        otherwise: Vec<BehaviorStmt>,
    },
    /// `finish`
    Finish,
    /// Something that could not be read; a problem tells why.
    Broken,
}

/// When a `repeat` ends.
#[derive(Clone, Debug, PartialEq)]
pub enum RepeatHow {
    /// Never by itself.
    Forever,
    /// Before a pass, as soon as this holds.
    Until(Expr),
    /// After so many passes.
    Times(Expr),
}

/// One way that a `choose` may go.
#[derive(Clone, Debug, PartialEq)]
pub struct Chance {
    /// Its weight.
    pub weight: Expr,
    /// What is done.
    pub body: Vec<BehaviorStmt>,
}

/// `do WHAT [sprinting] [until C] [for D]`
#[derive(Clone, Debug, PartialEq)]
pub struct DoStmt {
    /// What is done.
    pub what: DoWhat,
    /// `sprinting`
    pub sprinting: Option<Span>,
    /// `until …`
    pub until: Option<Expr>,
    /// `for …`
    pub duration: Option<Expr>,
}

/// What a `do` does.
#[derive(Clone, Debug, PartialEq)]
pub enum DoWhat {
    /// A primitive or another behaviour.
    Named {
        /// Its name.
        name: Ident,
        /// The arguments.
        args: Vec<Arg>,
        /// Name and arguments.
        span: Span,
    },
    /// A script's `act` hook.
    Script(ScriptRef),
}
