//! Values while a program is written: a type and the registers that hold it.

use crate::ast::{Expr, FormationItem, Span};
use crate::check::types::Ty;
use setpiece_scenario::Reg;
use setpiece_scenario::vocabulary::Team;
use std::collections::BTreeMap;
use std::rc::Rc;

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
    Region(Rc<RegionValue>),
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

/// A part of the pitch; lengths in metres, world frame.
#[derive(Clone, Debug)]
pub(crate) enum RegionValue {
    /// Between two corners, in any order.
    Rect((Reg, Reg), (Reg, Reg)),
    /// A disc: centre and radius.
    Circle((Reg, Reg), Reg),
    /// A slice of a disc: from an angle on, as wide as another; radians, world frame.
    Sector {
        /// The tip.
        centre: (Reg, Reg),
        /// How far it reaches.
        radius: Reg,
        /// Where it begins.
        from: Reg,
        /// How wide it is, 0 to a full turn.
        width: Reg,
    },
    /// Between corners, in order.
    Polygon(Vec<(Reg, Reg)>),
    /// In one or the other.
    Union(Rc<RegionValue>, Rc<RegionValue>),
    /// In both.
    Intersection(Rc<RegionValue>, Rc<RegionValue>),
    /// In the first but not in the second.
    Difference(Rc<RegionValue>, Rc<RegionValue>),
}

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
            Repr::Region(region) => region.regs(),
            Repr::Nothing | Repr::Text(_) | Repr::Formation(_) => Vec::new(),
        }
    }
}

impl RegionValue {
    fn regs(&self) -> Vec<Reg> {
        let mut regs = Vec::new();
        self.map(&mut |reg| {
            regs.push(reg);
            reg
        });
        regs
    }

    /// The same shape with other registers.
    pub(crate) fn map(&self, f: &mut dyn FnMut(Reg) -> Reg) -> RegionValue {
        let pair = |(x, y): (Reg, Reg), f: &mut dyn FnMut(Reg) -> Reg| (f(x), f(y));
        match self {
            RegionValue::Rect(a, b) => RegionValue::Rect(pair(*a, f), pair(*b, f)),
            RegionValue::Circle(centre, radius) => {
                RegionValue::Circle(pair(*centre, f), f(*radius))
            }
            RegionValue::Sector { centre, radius, from, width } => RegionValue::Sector {
                centre: pair(*centre, f),
                radius: f(*radius),
                from: f(*from),
                width: f(*width),
            },
            RegionValue::Polygon(corners) => {
                RegionValue::Polygon(corners.iter().map(|&at| pair(at, f)).collect())
            }
            RegionValue::Union(a, b) => RegionValue::Union(Rc::new(a.map(f)), Rc::new(b.map(f))),
            RegionValue::Intersection(a, b) => {
                RegionValue::Intersection(Rc::new(a.map(f)), Rc::new(b.map(f)))
            }
            RegionValue::Difference(a, b) => {
                RegionValue::Difference(Rc::new(a.map(f)), Rc::new(b.map(f)))
            }
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
}

impl LocalName<'_> {
    /// Where it is declared, if that is known.
    pub(crate) fn declared(&self) -> Option<Span> {
        match self {
            LocalName::Value(_) => None,
            LocalName::Expr { at, .. } | LocalName::State { at, .. } => Some(*at),
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
