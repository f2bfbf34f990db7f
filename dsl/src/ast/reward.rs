//! Rewards, endings and events.

use super::{Binding, Expr, Ident, ParamDecl, Ref, ScriptRef, Span, Spanned};
use setpiece_scenario::vocabulary::Qualifier;

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
    /// `for …`: who receives it.
    pub audience: Option<Expr>,
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
    Script {
        /// Which.
        script: ScriptRef,
        /// `as ["…", "…"]`: what the keys of its map are.
        terms: Option<TermList>,
    },
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

/// How much is given.
#[derive(Clone, Debug, PartialEq)]
pub enum GiveValue {
    /// As an expression says.
    Expr(Expr),
    /// As a script's `reward` hook says.
    Script {
        /// Which.
        script: ScriptRef,
        /// `as ["…", "…"]`: what the keys of its map are.
        terms: Option<TermList>,
    },
}

/// `give VALUE [to WHO] [per second] [once] [on EVENTS] [when C] [as "label"]`
#[derive(Clone, Debug, PartialEq)]
pub struct GiveStmt {
    /// How much.
    pub value: GiveValue,
    /// `to …`: who receives it.
    pub to: Option<Expr>,
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

/// The names of a script's terms, in brackets; at least one.
pub type TermList = Spanned<Vec<Spanned<String>>>;

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
