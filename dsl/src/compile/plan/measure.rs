//! Measures and their bounds.

use super::{Planner, scope};
use crate::ast::{Expr, ExprKind, GoalExpr, Ident, MeasureArg, MeasureRef};
use crate::check::types::Ty;
use crate::problem::Guess;
use crate::problem::facts::Plans as Facts;
use setpiece_scenario::plan::{self, Comparison, Measure, Quantity};
use setpiece_scenario::vocabulary::{
    EventKind, MeasureWord, Owner, PROPERTIES, QuantityWord, Type,
};
use setpiece_scenario::{LIMIT, ROUNDS, Reward, Scenario};

/// What can be measured.
const MEASURES: &[&str] = MeasureWord::NAMES;
/// The numbers of an episode.
const QUANTITIES: &[&str] = QuantityWord::NAMES;
/// The most episodes that a curriculum looks back on.
const LAST_MAX: u64 = 1_000_000;

/// Whether every share of episodes compares so with a bound, or none does.
fn decided(comparison: Comparison, bound: f64) -> Option<bool> {
    match comparison {
        Comparison::Greater if bound >= 1.0 => Some(false),
        Comparison::Less if bound <= 0.0 => Some(false),
        Comparison::GreaterEqual if bound <= 0.0 => Some(true),
        Comparison::LessEqual if bound >= 1.0 => Some(true),
        _ => None,
    }
}

impl<'w> Planner<'_, 'w> {
    /// A measure and its bound.
    pub(super) fn goal(
        &mut self,
        written: &'w GoalExpr,
        scenario: &Scenario,
        in_curriculum: bool,
    ) -> Option<plan::MeasureGoal> {
        let (measure, last, unit) = self.measure(&written.measure, scenario, in_curriculum)?;
        let comparison = Comparison::from_sign(&written.comparison.node)?;
        let bound = self.bound(&written.bound, unit)?;
        let span = written.measure.span.to(written.bound.span);
        let text = self.world.text(span);
        match measure {
            Measure::SuccessRate | Measure::Rate(_) => {
                if let Some(always) = decided(comparison, bound) {
                    self.report(span, Facts::ShareBound { text, always });
                    return None;
                }
            }
            Measure::Steps | Measure::Episodes if comparison == Comparison::Equal => {
                let counted = written.measure.name.node.clone();
                self.report(span, Facts::CountBound { text, counted });
                return None;
            }
            _ => {}
        }
        Some(plan::MeasureGoal { measure, last, comparison, bound })
    }

    /// `never OUTCOME`
    pub(super) fn never(&mut self, name: &Ident, scenario: &Scenario) -> Option<plan::MeasureGoal> {
        let outcome = self.outcome(&name.node, name, scenario)?;
        Some(plan::MeasureGoal {
            measure: Measure::Rate(outcome),
            last: None,
            comparison: Comparison::Equal,
            bound: 0.0,
        })
    }

    /// The bound of a measure, in SI units.
    pub(super) fn bound(&mut self, expr: &'w Expr, ty: Ty) -> Option<f64> {
        if ty == Ty::Percent {
            self.share(expr, "the bound")
        } else {
            self.constant(expr, &scope(), ty)
        }
    }

    /// What is measured, over how many of the latest episodes, and what its bound is written in.
    pub(super) fn measure(
        &mut self,
        written: &'w MeasureRef,
        scenario: &Scenario,
        in_curriculum: bool,
    ) -> Option<(Measure, Option<u32>, Ty)> {
        let name = &written.name;
        let mut args: Vec<&'w MeasureArg> = Vec::new();
        let mut last = None;
        for arg in &written.args {
            match arg {
                MeasureArg::Named(key, value) if key.node == "last" => {
                    let count = self.whole(value, &scope(), "`last`", 1, LAST_MAX)?;
                    if !in_curriculum {
                        let text = self.world.text(key.span.to(value.span));
                        self.report(key.span.to(value.span), Facts::OnlyInCurricula { text });
                        return None;
                    }
                    last = Some(count as u32);
                }
                arg => args.push(arg),
            }
        }
        let (measure, unit) = match (name.node.as_str(), args.as_slice()) {
            ("success_rate", []) => (Measure::SuccessRate, Ty::Percent),
            ("rate", [MeasureArg::Of(kind, of)]) if kind.node == "outcome" => {
                let outcome = self.outcome(&of.node, of, scenario)?;
                (Measure::Rate(outcome), Ty::Percent)
            }
            ("mean" | "min" | "max", [of]) => {
                let (quantity, unit) = self.quantity(of, scenario, (&name.node, ""))?;
                let measure = match name.node.as_str() {
                    "mean" => Measure::Mean(quantity),
                    "min" => Measure::Min(quantity),
                    _ => Measure::Max(quantity),
                };
                (measure, unit)
            }
            ("quantile", [of, MeasureArg::Value(share)]) => {
                let more = format!(", {}", self.world.text(share.span));
                let (quantity, unit) = self.quantity(of, scenario, ("quantile", &more))?;
                (Measure::Quantile(quantity, self.share(share, "the quantile")?), unit)
            }
            ("steps", []) if in_curriculum => (Measure::Steps, Ty::Int),
            ("episodes", []) if in_curriculum => (Measure::Episodes, Ty::Int),
            ("steps" | "episodes", []) => {
                self.report(name.span, Facts::OnlyInCurricula { text: name.node.clone() });
                return None;
            }
            (known, _) if MEASURES.contains(&known) => {
                let form = form(known);
                self.report(written.span, Facts::MeasureForm { name: known.to_owned(), form });
                return None;
            }
            (other, _) => {
                let named = other.to_owned();
                let fact = if is_record(other, scenario) {
                    let form = format!("mean(record {other})");
                    Facts::IsRecord { name: named, form }
                } else if scenario.endings.list.iter().any(|ending| ending.label == other) {
                    Facts::IsOutcome { name: named, form: format!("rate(outcome {other})") }
                } else if other == "median" {
                    Facts::Median
                } else {
                    let records = scenario.records.iter().map(|record| record.name.as_str());
                    let known: Vec<&str> = MEASURES.iter().copied().chain(records).collect();
                    let guess = Guess::similar_or(other, &known, MEASURES).read_as(|meant| {
                        let record = format!("mean(record {meant})");
                        Some(if is_record(meant, scenario) { record } else { meant.to_owned() })
                    });
                    Facts::NoMeasure { name: named, guess }
                };
                self.report(name.span, fact);
                return None;
            }
        };
        Some((measure, last, unit))
    }

    /// - `measure`, `more`: what stands before it and behind it.
    fn quantity(
        &mut self,
        arg: &'w MeasureArg,
        scenario: &Scenario,
        (measure, more): (&str, &str),
    ) -> Option<(Quantity, Ty)> {
        let (span, text) = match arg {
            MeasureArg::Of(kind, of) if kind.node == "record" => {
                let known: Vec<&str> =
                    scenario.records.iter().map(|record| record.name.as_str()).collect();
                self.known("record", of, &known, scenario)?;
                let record = scenario.records.iter().find(|record| record.name == of.node)?;
                let what = match (record.series, record.values.len()) {
                    (true, _) => Some("a series"),
                    (_, 1) => None,
                    _ => Some("a place"),
                };
                if let Some(what) = what {
                    self.report(of.span, Facts::NoNumber { name: of.node.clone(), what });
                    return None;
                }
                let quantity = Quantity::Record(of.node.clone(), record.unit);
                return Some((quantity, Ty::with_dim(record.unit)));
            }
            MeasureArg::Of(kind, of) if kind.node == "term" => {
                let terms: Vec<String> =
                    scenario.rewards.iter().flat_map(Reward::term_names).collect();
                let known: Vec<&str> = terms.iter().map(String::as_str).collect();
                self.known("term", of, &known, scenario)?;
                return Some((Quantity::Term(of.node.clone()), Ty::Number));
            }
            MeasureArg::Value(Expr { kind: ExprKind::Name(name), span }) => {
                match name.as_str() {
                    "length" => return Some((Quantity::Length, Ty::DURATION)),
                    "return" => return Some((Quantity::Return, Ty::Number)),
                    "score" => return Some((Quantity::Score, Ty::Number)),
                    _ => {}
                }
                if is_record(name, scenario) {
                    let form = format!("{measure}(record {name}{more})");
                    self.report(*span, Facts::IsRecord { name: name.clone(), form });
                    return None;
                }
                (*span, name.clone())
            }
            MeasureArg::Value(expr) => (expr.span, self.world.text(expr.span)),
            MeasureArg::Of(word, of) => {
                let span = word.span.to(of.span);
                (span, self.world.text(span))
            }
            MeasureArg::Named(word, value) => {
                let span = word.span.to(value.span);
                (span, self.world.text(span))
            }
        };
        let records = scenario.records.iter().map(|record| record.name.as_str());
        let known: Vec<&str> = QUANTITIES.iter().copied().chain(records).collect();
        let guess = Guess::similar_or(&text, &known, QUANTITIES).read_as(|meant| {
            let record = format!("record {meant}");
            Some(if is_record(meant, scenario) { record } else { meant.to_owned() })
        });
        self.report(span, Facts::NoQuantity { text, guess });
        None
    }

    /// An outcome that the scenario can have.
    fn outcome(&mut self, outcome: &str, at: &Ident, scenario: &Scenario) -> Option<String> {
        let mut known: Vec<&str> =
            scenario.endings.list.iter().map(|ending| ending.label.as_str()).collect();
        if scenario.start.limit.is_some() {
            known.push(LIMIT);
        }
        if scenario.endings.round.is_some() {
            known.push(ROUNDS);
        }
        if let Some(seen) = seen(outcome).filter(|_| !known.contains(&outcome)) {
            let (scenario, name) = (scenario.name.clone(), outcome.to_owned());
            let known = known.iter().map(|known| (*known).to_owned()).collect();
            self.report(at.span, Facts::NoOutcome { scenario, name, known, seen });
            return None;
        }
        self.known("outcome", at, &known, scenario)?;
        Some(outcome.to_owned())
    }

    fn known(
        &mut self,
        what: &'static str,
        name: &Ident,
        known: &[&str],
        scenario: &Scenario,
    ) -> Option<()> {
        if known.contains(&name.node.as_str()) {
            return Some(());
        }
        let guess = Guess::similar_or_all(&name.node, known);
        let scenario = scenario.name.clone();
        self.report(name.span, Facts::NoSuch { scenario, what, name: name.node.clone(), guess });
        None
    }
}

/// How a record notes what a match has under a name: a condition or an event.
fn seen(name: &str) -> Option<String> {
    let of_match = PROPERTIES.iter().filter(|property| property.owner == Owner::Match);
    if of_match.filter(|property| property.ty == Type::Bool).any(|property| property.name == name) {
        return Some(format!("ever({name})"));
    }
    EventKind::from_name(name).map(|kind| format!("count of {kind}"))
}

/// Whether a name is that of a record. (The name of a reward's term has a `/`, so it is a string.)
fn is_record(name: &str, scenario: &Scenario) -> bool {
    scenario.records.iter().any(|record| record.name == name)
}

/// How a measure is written.
fn form(measure: &str) -> &'static str {
    match measure {
        "success_rate" => "success_rate",
        "rate" => "rate(outcome NAME)",
        "mean" => "mean(length)",
        "min" => "min(return)",
        "max" => "max(record NAME)",
        "quantile" => "quantile(length, 90%)",
        "steps" => "steps",
        _ => "episodes",
    }
}
