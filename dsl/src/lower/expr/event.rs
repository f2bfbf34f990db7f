//! Events: as conditions, and as loops over the events of a step.

use super::super::builder::OpenLoop;
use super::super::value::{Repr, Value};
use super::super::{Lower, ProgramStage};
use crate::ast::{EventExpr, Expr};
use crate::check::types::Ty;
use crate::problem::facts::{Calls, Kind, Names, Scopes, Types};
use crate::problem::{Guess, Problem};
use crate::source::Span;
use setpiece_scenario::vocabulary::{EventField, EventKind, Landmark, Qualifier};
use setpiece_scenario::{BinaryOp, EventFilter, Fold, FoldKind, Over, Reg, When, Who};

/// A loop over the matching events that is being written.
#[derive(Clone)]
pub(crate) struct Matching {
    /// The loop.
    pub(crate) open: OpenLoop,
    /// Which events match.
    pub(crate) filter: EventFilter,
    /// What the place of the event must meet.
    pub(crate) guard: Option<Reg>,
    outer: Option<EventKind>,
}

impl<'w> Lower<'_, 'w> {
    /// An event as a condition: whether it happened in this step.
    pub(super) fn event_happened(&mut self, event: &'w EventExpr) -> Value<'w> {
        // Inside a loop over events the inner loop would hide the outer event, so the test is made
        // before it.
        let loops = self.code.leave_loops();
        let outer = self.event.take();
        let matching = self.open_events(event);
        let value = match matching {
            Some(matching) => {
                let guard = matching.guard;
                let count =
                    self.close_events(matching, Fold { kind: FoldKind::Count, value: None, guard });
                let zero = self.code.constant(0.0);
                Value::one(Ty::Bool, self.code.binary(BinaryOp::Gt, count, zero))
            }
            None => Value::error(),
        };
        self.event = outer;
        self.code.return_to(loops);
        value
    }

    /// Opens a loop over the events that match; `None` after a report.
    pub(crate) fn open_events(&mut self, event: &'w EventExpr) -> Option<Matching> {
        let filter = self.event_filter(event)?;
        debug_assert!(self.event.is_none());
        let kind = filter.kind;
        let open = self.code.open_loop(Over::Events(filter.clone()));
        let outer = self.event.replace(kind);
        let guard = event.from.as_deref().and_then(|region| {
            let region = self.region(region)?;
            let place = (self.code.event(EventField::X), self.code.event(EventField::Y));
            Some(self.inside(place, &region))
        });
        Some(Matching { open, filter, guard, outer })
    }

    /// Closes the loop over events.
    pub(crate) fn close_events(&mut self, matching: Matching, fold: Fold) -> Reg {
        self.event = matching.outer;
        self.code.close_loop(matching.open, fold)
    }

    fn event_filter(&mut self, event: &'w EventExpr) -> Option<EventFilter> {
        let name = event.name.node.as_str();
        let Some(kind) = EventKind::from_name(name) else {
            self.report({
                let guess = Guess::of(name, EventKind::ALL.iter().map(|kind| kind.name()));
                Problem::new(
                    event.name.span,
                    Names::Unknown { kind: Kind::Event, name: name.to_owned(), guess },
                )
            });
            return None;
        };
        if !self.stage.is_step() {
            self.report({
                let is_landmark =
                    Landmark::from_name(name).is_some() && event.span == event.name.span;
                Problem::new(
                    event.span,
                    Scopes::NothingHappened { event: name.to_owned(), is_landmark },
                )
            });
            return None;
        }
        if matches!(self.stage, ProgramStage::Observation) {
            self.report(Problem::new(event.span, Scopes::ObservationShowsState));
            return None;
        }
        if kind == EventKind::End
            && let Some(at) = self.remembered.ending_reads
        {
            self.report(Problem::new(at, Scopes::EndOfItself { event: event.span }));
            return None;
        }
        if self.when == When::Prev {
            self.report(Problem::new(event.span, Scopes::EventsForgotten));
            return None;
        }
        let qualifier = self.qualifier(kind, event)?;
        // Behind the event's words.
        let words = event.qualifier.as_ref().map_or(event.name.span, |it| it.span);
        let last = Span { start: words.end, ..words };
        if !kind.has_actor()
            && let Some(by) = &event.by
        {
            let fact = Calls::NobodyDoes { event: name.to_owned() };
            self.report(Problem::new(by.span, fact).rewriting(last.to(by.span), ""));
            return None;
        }
        if !kind.has_receiver()
            && let Some(to) = &event.to
        {
            let others: Vec<&str> = EventKind::ALL
                .iter()
                .filter(|kind| kind.has_receiver())
                .map(|kind| kind.name())
                .collect();
            let fact = Calls::ReachesNobody { event: name.to_owned(), others };
            let last = event.by.as_ref().map_or(last, |by| Span { start: by.span.end, ..last });
            self.report(Problem::new(to.span, fact).rewriting(last.to(to.span), ""));
            return None;
        }
        let by = event.by.as_deref().map(|who| self.who(who));
        let to = event.to.as_deref().map(|who| self.who(who));
        match (by, to) {
            (Some(None), _) | (_, Some(None)) => None,
            (by, to) => Some(EventFilter { kind, qualifier, by: by.flatten(), to: to.flatten() }),
        }
    }

    #[allow(
        clippy::option_option,
        reason = "outer: nothing was reported; inner: there is a qualifier"
    )]
    fn qualifier(&mut self, kind: EventKind, event: &EventExpr) -> Option<Option<Qualifier>> {
        let Some(qualifier) = &event.qualifier else {
            // A bare `pass` is one that was struck.
            return Some((kind == EventKind::Pass).then_some(Qualifier::Attempted));
        };
        let known = kind.qualifiers();
        if known.contains(&qualifier.node) {
            return Some(Some(qualifier.node));
        }
        let name = event.name.span;
        let (event, qualifier, span) =
            (event.name.node.clone(), qualifier.node.to_string(), qualifier.span);
        let is_alone = known.is_empty();
        let known = known.iter().map(|qualifier| qualifier.name()).collect();
        let end = name.end;
        let problem = Problem::new(span, Calls::NeverQualified { event, qualifier, known });
        self.report(if is_alone {
            problem.rewriting(Span { start: end, ..span }, "")
        } else {
            problem
        });
        None
    }

    fn who(&mut self, expr: &'w Expr) -> Option<Who> {
        let value = self.expr(expr);
        match (value.ty, &value.repr) {
            (Ty::Team, Repr::One(reg)) => Some(Who::Team(*reg)),
            (Ty::Player, Repr::One(reg)) => Some(Who::Player(*reg)),
            (Ty::Error, _) => None,
            (ty, _) => {
                let text = self.world.text(expr.span);
                self.report(Problem::new(
                    expr.span,
                    Types::NeitherTeamNorPlayer { found: ty, text },
                ));
                None
            }
        }
    }
}
