//! Values while a program is written: a type and the registers that hold it.

use crate::ast::{Expr, FormationItem, Span};
use crate::check::types::Ty;
use crate::outline::Outline;
use setpiece_scenario::Reg;
use setpiece_scenario::vocabulary::Team;
use std::collections::BTreeMap;
use std::rc::Rc;
use std::sync::Arc;

/// A typed value.
#[derive(Clone, Debug)]
pub(crate) struct Value<'w> {
    /// Its type.
    pub(crate) ty: Ty,
    /// Where it is.
    pub(crate) repr: Repr<'w>,
}

/// Where a value is.
#[derive(Clone, Debug)]
pub(crate) enum Repr<'w> {
    /// Nowhere: of a broken expression, or of something that is its name (the ball, the score).
    Nothing,
    /// One register.
    One(Reg),
    /// Two: a point, vector or velocity along the ground.
    Two(Reg, Reg),
    /// Three: with a height.
    Three(Reg, Reg, Reg),
    /// A word that is written out.
    Text(String),
    /// One of some words, by its number.
    Choice(Reg, Rc<[String]>),
    /// Players.
    Set(SetValue),
    /// A part of the pitch.
    Region(Arc<RegionValue>),
    /// A list.
    List(Vec<Value<'w>>),
    /// A formation and what its parameters are bound to.
    Formation(&'w FormationItem),
}

/// Players of a team (-1: of both) without one of them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SetValue {
    /// The team.
    pub(crate) team: Reg,
    /// Who is left out.
    pub(crate) except: Option<Reg>,
}

/// A part of the pitch, in registers.
pub(crate) type RegionValue = Outline<Reg>;

impl<'w> Value<'w> {
    /// Of a broken expression; a problem has been reported.
    pub(crate) fn error() -> Value<'w> {
        Value { ty: Ty::Error, repr: Repr::Nothing }
    }

    /// Of one register.
    pub(crate) fn one(ty: Ty, reg: Reg) -> Value<'w> {
        Value { ty, repr: Repr::One(reg) }
    }

    /// Of two registers.
    pub(crate) fn two(ty: Ty, (x, y): (Reg, Reg)) -> Value<'w> {
        Value { ty, repr: Repr::Two(x, y) }
    }

    /// Of as many registers as it was kept in.
    pub(crate) fn of_regs(ty: Ty, regs: &[Reg]) -> Value<'w> {
        match *regs {
            [a] => Value::one(ty, a),
            [a, b] => Value::two(ty, (a, b)),
            [a, b, c] => Value { ty, repr: Repr::Three(a, b, c) },
            _ => Value::error(),
        }
    }

    /// Whether it can be kept from step to step: in a few numbers.
    pub(crate) fn is_held(&self) -> bool {
        matches!(self.repr, Repr::One(_) | Repr::Two(..) | Repr::Three(..))
    }

    /// Whether the expression was broken.
    pub(crate) fn is_error(&self) -> bool {
        self.ty == Ty::Error
    }

    /// The registers, in order.
    pub(crate) fn regs(&self) -> Vec<Reg> {
        match &self.repr {
            Repr::One(a) | Repr::Choice(a, _) => vec![*a],
            Repr::Two(a, b) => vec![*a, *b],
            Repr::Three(a, b, c) => vec![*a, *b, *c],
            Repr::Set(set) => [Some(set.team), set.except].into_iter().flatten().collect(),
            Repr::List(list) => list.iter().flat_map(Value::regs).collect(),
            Repr::Region(region) => region.numbers(),
            Repr::Nothing | Repr::Text(_) | Repr::Formation(_) => Vec::new(),
        }
    }
}

/// How literals and coordinates are read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum LiteralFrame {
    /// As the pitch lies.
    World,
    /// From the own goal, attacking towards +x.
    Own,
}

/// The names that an expression sees besides those of its file; cheap to copy.
#[derive(Clone)]
pub(crate) struct Scope<'w> {
    locals: Option<Rc<Local<'w>>>,
    /// Whether the scenario's parameters, `let`s and players are seen.
    pub(crate) scenario: bool,
    /// Whose named players are seen, in a formation.
    pub(crate) players_of: Option<Team>,
    /// How literals are read.
    pub(crate) frame: LiteralFrame,
}

struct Local<'w> {
    name: &'w str,
    binding: LocalName<'w>,
    next: Option<Rc<Local<'w>>>,
}

/// What a local name stands for.
#[derive(Clone)]
pub(crate) enum LocalName<'w> {
    /// A value of its own: the element of a loop.
    Value(Value<'w>),
    /// An expression, read in the scope where it was written; `now` is its value in the present
    /// program.
    Expr {
        /// The expression.
        expr: &'w Expr,
        /// Its scope.
        scope: Scope<'w>,
        /// The type it was declared with.
        ty: Option<Ty>,
        /// Its value, where it has been computed.
        now: Option<Value<'w>>,
        /// Where it is declared.
        at: Span,
    },
    /// A `state` of a reward.
    State {
        /// Its cells, one per register.
        cells: Rc<[u32]>,
        /// What they held when the step began.
        before: Rc<[Reg]>,
        /// Its type.
        ty: Ty,
        /// Where it is declared.
        at: Span,
    },
    /// A `state` of a behaviour.
    Kept {
        /// Its value.
        value: Value<'w>,
        /// Where it is declared.
        at: Span,
    },
}

impl LocalName<'_> {
    /// Where it is declared, if that is known.
    pub(crate) fn declared(&self) -> Option<Span> {
        match self {
            LocalName::Value(_) => None,
            LocalName::Expr { at, .. }
            | LocalName::State { at, .. }
            | LocalName::Kept { at, .. } => Some(*at),
        }
    }
}

impl<'w> Scope<'w> {
    /// No locals.
    pub(crate) fn new(scenario: bool, frame: LiteralFrame) -> Scope<'w> {
        Scope { locals: None, scenario, players_of: None, frame }
    }

    /// Adds a name.
    pub(crate) fn bind(&mut self, name: &'w str, binding: LocalName<'w>) {
        self.locals = Some(Rc::new(Local { name, binding, next: self.locals.take() }));
    }

    /// What a name stands for: the latest binding.
    pub(crate) fn find(&self, name: &str) -> Option<&LocalName<'w>> {
        let mut at = self.locals.as_deref();
        while let Some(local) = at {
            if local.name == name {
                return Some(&local.binding);
            }
            at = local.next.as_deref();
        }
        None
    }

    /// Every local name and what it stands for.
    pub(crate) fn bindings(&self) -> BTreeMap<&'w str, &LocalName<'w>> {
        let mut bindings = BTreeMap::new();
        let mut at = self.locals.as_deref();
        while let Some(local) = at {
            bindings.entry(local.name).or_insert(&local.binding);
            at = local.next.as_deref();
        }
        bindings
    }

    /// Every local name, the latest first.
    pub(crate) fn names(&self) -> Vec<&'w str> {
        let mut names = Vec::new();
        let mut at = self.locals.as_deref();
        while let Some(local) = at {
            names.push(local.name);
            at = local.next.as_deref();
        }
        names
    }
}

impl std::fmt::Debug for Scope<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_list().entries(self.names()).finish()
    }
}
