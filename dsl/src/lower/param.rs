//! A scenario's parameters.

use super::value::{LiteralFrame, Repr, Scope, Value};
use super::{Lower, World};
use crate::ast::{Domain, Expr, Ident, Span};
use crate::check::types::Ty;
use crate::lower::param_info::ParamInfo;
use crate::problem::facts::{Bounds, Chance, Kind, Names, Types};
use crate::problem::{Guess, Problem};
use crate::resolve::FlatParam;
use setpiece_scenario::Param;
use setpiece_scenario::vocabulary::Type;
use std::rc::Rc;

/// The type a declaration names; reports an unknown one.
pub(crate) fn declared_type(world: &World<'_>, ty: &Ident) -> Ty {
    match Type::from_name(ty.node.trim_end_matches('?')) {
        Some(Type::Behavior) | None => {
            let known: Vec<&str> =
                Type::ALL.iter().filter(|ty| **ty != Type::Behavior).map(|ty| ty.name()).collect();
            let guess = Guess::of_type(&ty.node, &known);
            world.report(Problem::new(
                ty.span,
                Names::Unknown { kind: Kind::Type, name: ty.node.clone(), guess },
            ));
            Ty::Error
        }
        Some(ty) => Ty::of(ty),
    }
}

/// Checks every parameter of the scenario; the world has none yet.
pub(super) fn lower_params<'w>(world: &World<'w>) -> Vec<ParamInfo<'w>> {
    let mut index = 0;
    let mut params = Vec::new();
    for param in &world.flat.params {
        let mut info = lower_param(world, param);
        info.index = index;
        index += u32::from(info.bound.is_none());
        params.push(info);
    }
    params
}

fn lower_param<'w>(world: &World<'w>, flat: &'w FlatParam<'w>) -> ParamInfo<'w> {
    let decl = flat.decl;
    // A type that there is not has been reported. Levels may bind what the value is.
    let named = decl.ty.as_ref().map(|ty| declared_type(world, ty));
    let declared = named.filter(|ty| *ty != Ty::Error);
    let mut info = ParamInfo {
        param: Param {
            name: decl.name.node.clone(),
            doc: decl.doc.clone(),
            ty: Type::Number,
            default: 0.0,
            range: None,
            choices: Vec::new(),
            values: Vec::new(),
        },
        ty: Ty::Error,
        choices: Rc::from([]),
        name: &decl.name,
        index: 0,
        bound: None,
        declared,
    };
    let Some(expr) = flat.value else {
        if world.flat.item.is_abstract {
            return info;
        }
        world.report(Problem::new(
            decl.name.span,
            Bounds::NoValue { parameter: decl.name.node.clone() },
        ));
        return info;
    };
    if flat.is_argument && !is_constant(world, expr) {
        info.bound = Some(expr);
        if let (Some(ty), Some(Domain::Range(low, high))) =
            (declared.filter(|ty| ty.dim().is_some()), flat.domain)
            && let (Some(low), Some(high)) = (constant(world, low, ty), constant(world, high, ty))
        {
            info.param.range = Some((low, high));
        }
        return info;
    }
    let mut lower = Lower::constant(world, Scope::new(false, LiteralFrame::World));
    let value = match declared {
        Some(ty) => lower.want(expr, ty),
        None => lower.expr(expr),
    };
    info.ty = value.ty;
    // A number's default may be written without a point.
    if value.ty == Ty::Int && declared.is_none() && in_fractions(flat.domain) {
        info.ty = Ty::Number;
    }
    if value.is_error() {
        return info;
    }
    let Some(ty) = info.ty.param() else {
        world.report(Problem::new(expr.span, Types::NoParameter { ty: value.ty }));
        return info;
    };
    info.param.ty = ty;
    match &value.repr {
        Repr::Text(text) => choices(world, &mut info, text, expr.span, flat.domain),
        Repr::One(reg) => match lower.code.constant_of(*reg) {
            Some(default) => {
                info.param.default = default;
                domain(world, &mut info, expr.span, flat);
            }
            None => world.report(not_constant(world, expr)),
        },
        _ => {}
    }
    if named == Some(Ty::Error) {
        info.ty = Ty::Error;
    }
    info
}

fn not_constant(world: &World<'_>, expr: &Expr) -> Problem {
    Problem::new(expr.span, Chance::DefaultNotConstant { text: world.text(expr.span) })
}

fn is_constant<'w>(world: &World<'w>, expr: &'w Expr) -> bool {
    // Where it is no constant its names are the scenario's, not those that are in sight here.
    let used = world.used.take();
    let mut lower = Lower::constant(world, Scope::new(false, LiteralFrame::World));
    let value = world.tentatively(|| lower.expr(expr));
    *world.used.borrow_mut() = used;
    match value.repr {
        Repr::Text(_) => true,
        Repr::One(reg) => lower.code.constant_of(reg).is_some(),
        _ => false,
    }
}

/// Whether a range is written with fractions.
fn in_fractions(domain: Option<&Domain>) -> bool {
    let fraction =
        |expr: &Expr| matches!(expr.kind, crate::ast::ExprKind::Number { is_int: false, .. });
    match domain {
        Some(Domain::Range(low, high)) => fraction(low) || fraction(high),
        Some(Domain::List(values, _)) => values.iter().any(fraction),
        None => false,
    }
}

fn constant<'w>(world: &World<'w>, expr: &'w Expr, ty: Ty) -> Option<f64> {
    let mut lower = Lower::constant(world, Scope::new(false, LiteralFrame::World));
    let value: Value<'w> = lower.want(expr, ty);
    match value.repr {
        Repr::One(reg) => {
            let found = lower.code.constant_of(reg);
            if found.is_none() {
                world.report(not_constant(world, expr));
            }
            found
        }
        _ => None,
    }
}

fn domain<'w>(world: &World<'w>, info: &mut ParamInfo<'w>, default: Span, flat: &FlatParam<'w>) {
    let (domain, is_argument) = (flat.domain, flat.is_argument);
    match domain {
        None => return,
        Some(Domain::Range(low, high)) => {
            let (Some(least), Some(greatest)) =
                (constant(world, low, info.ty), constant(world, high, info.ty))
            else {
                return;
            };
            if least > greatest {
                let span = low.span.to(high.span);
                world.report(Problem::new(span, Bounds::EmptyRange { text: world.text(span) }));
                return;
            }
            info.param.range = Some((least, greatest));
        }
        Some(Domain::List(values, _)) => {
            info.param.values =
                values.iter().filter_map(|value| constant(world, value, info.ty)).collect();
            if info.param.values.len() < values.len() {
                info.param.values.clear();
                return;
            }
        }
    }
    if info.param.admit(info.param.default).is_err() {
        let allowed = match domain {
            Some(Domain::Range(low, high)) => {
                format!("{}..{}", world.text(low.span), world.text(high.span))
            }
            Some(Domain::List(_, span)) => world.text(*span),
            None => String::new(),
        };
        world.report(Problem::new(
            default,
            Bounds::OutsideDomain {
                text: world.text(default),
                allowed,
                parameter: info.param.name.clone(),
                is_argument,
            },
        ));
    }
}

/// A string parameter is the place of its word in the list of words it may be.
fn choices<'w>(
    world: &World<'w>,
    info: &mut ParamInfo<'w>,
    default: &str,
    at: Span,
    domain: Option<&'w Domain>,
) {
    let mut words = Vec::new();
    match domain {
        Some(Domain::List(values, _)) => {
            for value in values {
                let mut lower = Lower::constant(world, Scope::new(false, LiteralFrame::World));
                if let Repr::Text(word) = lower.want(value, Ty::String).repr {
                    words.push(word);
                }
            }
        }
        Some(Domain::Range(low, high)) => {
            world.report(Problem::new(low.span.to(high.span), Types::WordsHaveNoRange));
            return;
        }
        None => words.push(default.to_owned()),
    }
    match words.iter().position(|word| word == default) {
        Some(index) => info.param.default = index as f64,
        None => world.report({
            let guess = Guess::of(default, words.iter().map(String::as_str));
            let parameter = Some(info.param.name.clone());
            Problem::new(at, Names::NoneOfItsWords { word: default.to_owned(), parameter, guess })
        }),
    }
    info.choices = Rc::from(words.clone());
    info.param.choices = words;
}
