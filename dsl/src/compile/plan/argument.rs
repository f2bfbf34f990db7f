//! The arguments of a scenario that is played.

use super::{Planner, scope};
use crate::ast::{Expr, ExprKind, Ident, Ref, Span};
use crate::check::types::Ty;
use crate::lower::Lower;
use crate::lower::value::{Repr, Scope};
use crate::problem::facts::{Bounds, Calls, Names, Plans as Facts};
use crate::problem::{Guess, Problem};
use crate::resolve::arg_name;
use setpiece_scenario::{Bindings, Param, Scenario};
use std::collections::BTreeMap;

impl<'w> Planner<'_, 'w> {
    /// Binds the arguments of a reference to a scenario's parameters.
    pub(super) fn arguments(
        &mut self,
        written: &'w Ref,
        scenario: &Scenario,
        scope: &Scope<'w>,
        bindings: &mut Bindings,
    ) {
        let mut given: BTreeMap<&str, Span> = BTreeMap::new();
        for arg in &written.args {
            let Some(name) = arg_name(arg) else {
                let callee = written.name.node.clone();
                self.world.report(Problem::new(arg.span, Calls::ByName { callee }));
                continue;
            };
            if let Some(first) = given.insert(name, arg.span) {
                let fact = Calls::GivenTwice { parameter: name.to_owned(), first };
                self.world.report(Problem::new(arg.span, fact));
                continue;
            }
            let params = scenario.params.iter();
            let Some(at) = params.clone().position(|param| param.name == name) else {
                let span = arg.key.as_ref().map_or(arg.span, |key| key.span);
                let guess = Guess::of(name, params.map(|param| param.name.as_str()));
                let parent = written.name.node.clone();
                let fact = Names::NoParentParameter { parent, name: name.to_owned(), guess };
                self.world.report(Problem::new(span, fact));
                continue;
            };
            if let (Some(param), Some(slot)) = (scenario.params.get(at), bindings.0.get_mut(at))
                && let Some(value) = self.argument(param, &arg.value, scope)
            {
                self.admit(param, value, &arg.value);
                *slot = value;
            }
        }
    }

    fn argument(&mut self, param: &Param, expr: &'w Expr, scope: &Scope<'w>) -> Option<f64> {
        if param.choices.is_empty() {
            return self.constant(expr, scope, Ty::of(param.ty));
        }
        let mut lower = Lower::constant(self.world, scope.clone());
        let value = lower.want(expr, Ty::String);
        let Repr::Text(word) = value.repr else {
            if !value.is_error() {
                self.not_constant(expr);
            }
            return None;
        };
        let index = param.choices.iter().position(|choice| *choice == word);
        if index.is_none() {
            let guess = Guess::of(&word, param.choices.iter().map(String::as_str));
            let parameter = Some(param.name.clone());
            self.world
                .report(Problem::new(expr.span, Names::NoneOfItsWords { word, parameter, guess }));
        }
        index.map(|index| index as f64)
    }

    /// Reports a value that a parameter may not have.
    pub(super) fn admit(&self, param: &Param, value: f64, expr: &Expr) {
        if param.admit(value).is_err() {
            let fact = Bounds::OutsideDomain {
                text: self.world.text(expr.span),
                allowed: param.allowed(),
                parameter: param.name.clone(),
                is_argument: true,
            };
            self.world.report(Problem::new(expr.span, fact));
        }
    }

    /// The parameters that an adapted name is handed to.
    pub(super) fn adapted(
        &mut self,
        name: &Ident,
        written: &'w Ref,
        scenario: &Scenario,
    ) -> Option<Vec<usize>> {
        let mut params = Vec::new();
        for arg in &written.args {
            let is_name =
                matches!(&arg.value.kind, ExprKind::Name(argument) if *argument == name.node);
            if is_name && let Some(key) = arg_name(arg) {
                params.extend(scenario.params.iter().position(|param| param.name == key));
            } else if self.reads(&arg.value, name) {
                self.report(arg.value.span, Facts::AdaptsPart { name: name.node.clone() });
                return None;
            }
        }
        if params.is_empty() {
            let scenario = written.name.node.clone();
            self.report(name.span, Facts::AdaptsNothing { name: name.node.clone(), scenario });
            return None;
        }
        Some(params)
    }

    /// Whether an expression reads a name that nothing else has.
    fn reads(&self, expr: &'w Expr, name: &Ident) -> bool {
        let text = self.world.text(expr.span);
        let is_word = |letter: char| letter.is_alphanumeric() || letter == '_';
        let mut words = text.split(|letter| !is_word(letter));
        let mut lower = Lower::constant(self.world, scope());
        words.any(|word| word == name.node)
            && self.world.tentatively(|| lower.expr(expr)).is_error()
    }
}
