//! `do …`: primitives, calls of behaviours, scripts.

use super::BehaviorWriter;
use crate::ast::{Arg, BehaviorItem, DoStmt, DoWhat, Expr, Ident, ItemKind, Span};
use crate::check::types::Ty;
use crate::lower::script::{AskedHook, embed};
use crate::problem::facts::{Behaviors, Kind, Names};
use crate::problem::{Guess, Problem, signature};
use setpiece_scenario::pitch::{LONGEST_S, STEPS_PER_S};
use setpiece_scenario::vocabulary::{Field, Primitive};
use setpiece_scenario::{Act, BinaryOp, Do, Node, Reg, Then, UnaryOp, Watch, When};

impl<'w> BehaviorWriter<'_, 'w> {
    pub(super) fn do_stmt(&mut self, stmt: &'w DoStmt) {
        let (name, args, span) = match &stmt.what {
            DoWhat::Named { name, args, span } => (name, args.as_slice(), *span),
            DoWhat::Script(script) => {
                self.refuse_sprint(stmt, "a script");
                let asked = AskedHook { name: "act", ..AskedHook::default() };
                let index = embed(&self.lower, script, asked);
                let (until, seconds) = self.clauses(stmt);
                if let Some(script) = index {
                    let act = Act::Script { script, args: Vec::new() };
                    self.nodes.push(Node::Do(Do { act, sprint: false, until, seconds }));
                }
                return;
            }
        };
        if let Some(primitive) = Primitive::from_name(&name.node) {
            self.primitive(primitive, stmt, args, span);
            return;
        }
        let library = self.lower.world.library;
        if let Some(found) = library.find(name.span.file, &name.node)
            && let ItemKind::Behavior(item) = &found.item.kind
        {
            if let Some(problem) = library.ambiguous(name.span.file, &name.node, name.span) {
                self.lower.report(problem);
                return;
            }
            self.lower.world.mark_used(found.name.span);
            self.call(item, stmt, args, span);
            return;
        }
        self.unknown(name);
    }

    fn unknown(&self, name: &Ident) {
        let visible = self.lower.world.library.visible(name.span.file);
        let mut known: Vec<&str> = visible
            .filter(|(_, found)| matches!(found.item.kind, ItemKind::Behavior(_)))
            .map(|(name, _)| name)
            .collect();
        known.extend(Primitive::ALL.iter().map(|primitive| primitive.name()));
        let all: Vec<&str> = Primitive::ALL.iter().map(|primitive| primitive.name()).collect();
        let guess = Guess::similar_or(&name.node, &known, &all);
        let fact = Names::Unknown { kind: Kind::Act, name: name.node.clone(), guess };
        self.lower.report(Problem::new(name.span, fact));
    }

    fn primitive(&mut self, primitive: Primitive, stmt: &'w DoStmt, args: &'w [Arg], span: Span) {
        if !primitive.runs() {
            self.refuse_sprint(stmt, &format!("`{primitive}`"));
        }
        if primitive == Primitive::Wait && stmt.duration.is_none() {
            let given = args.first().map(|arg| self.lower.world.text(arg.value.span));
            self.lower.report(Problem::new(span, Behaviors::WaitHowLong { given }));
            return;
        }
        let done = self.drawing(|writer| {
            let act = writer.act("do", primitive, args, span);
            let (until, seconds) = writer.clauses(stmt);
            act.map(|act| Do { act, sprint: stmt.sprinting.is_some(), until, seconds })
        });
        self.nodes.extend(done.map(Node::Do));
    }

    /// One act, without a statement around it.
    pub(super) fn alone(&mut self, primitive: Primitive, args: &'w [Arg], span: Span) {
        let act = self.drawing(|writer| writer.act("ai:", primitive, args, span));
        let alone = |act| Node::Do(Do { act, sprint: false, until: None, seconds: None });
        self.nodes.extend(act.map(alone));
    }

    fn refuse_sprint(&self, stmt: &DoStmt, what: &str) {
        let Some(at) = stmt.sprinting else { return };
        let runs: Vec<&str> =
            Primitive::ALL.iter().filter(|known| known.runs()).map(|known| known.name()).collect();
        self.lower.report(Problem::new(at, Behaviors::NoSprint { what: what.to_owned(), runs }));
    }

    /// `until C`, `for D`
    fn clauses(&mut self, stmt: &'w DoStmt) -> (Option<Reg>, Option<Reg>) {
        let until = stmt.until.as_ref().map(|condition| self.lower.condition(condition));
        let seconds = stmt.duration.as_ref().map(|duration| {
            let reg = self.lower.want_reg(duration, Ty::DURATION);
            self.lower.check_range(
                reg,
                (0.0, LONGEST_S),
                "the duration",
                duration.span,
                "`0s..100000s`",
            );
            reg
        });
        (until, seconds)
    }

    /// - `head`: what stands before it.
    fn act(
        &mut self,
        head: &'static str,
        primitive: Primitive,
        args: &'w [Arg],
        span: Span,
    ) -> Option<Act> {
        use Primitive as P;
        let names: &[&str] = match primitive {
            P::MoveTo | P::DribbleTo => &["to"],
            P::Run => &["angle"],
            P::PassTo | P::HighPassTo | P::LongPassTo | P::Mark => &["player"],
            P::Shoot => &["at"],
            P::Tackle | P::Slide | P::Press | P::Hold | P::Wait | P::Bot => &[],
        };
        let given = self.lower.arguments(primitive.name(), args, span, names, 0)?;
        let first = given.first().copied().flatten();
        if first.is_none() && !names.is_empty() && primitive != P::Shoot {
            let is_player = *names == ["player"];
            self.lower.report(Problem::new(
                span,
                Behaviors::NoTarget {
                    head,
                    primitive: primitive.name(),
                    is_player,
                    signature: signature(primitive.doc()),
                },
            ));
            return None;
        }
        Some(match (primitive, first) {
            (P::MoveTo, Some(to)) => self.place(to, Act::MoveTo),
            (P::DribbleTo, Some(to)) => self.place(to, Act::DribbleTo),
            (P::Run, Some(angle)) => {
                let own = self.lower.want_reg(angle, Ty::ANGLE);
                Act::Run(self.lower.turned_angle(own))
            }
            (P::PassTo, Some(mate)) => Act::PassTo(self.lower.want_reg(mate, Ty::Player)),
            (P::HighPassTo, Some(mate)) => Act::HighPassTo(self.lower.want_reg(mate, Ty::Player)),
            (P::LongPassTo, Some(mate)) => Act::LongPassTo(self.lower.want_reg(mate, Ty::Player)),
            (P::Mark, Some(who)) => Act::Mark(self.lower.want_reg(who, Ty::Player)),
            (P::Shoot, at) => Act::Shoot(at.map(|at| self.lower.want_point(at))),
            (P::Tackle, _) => Act::Tackle,
            (P::Slide, _) => Act::Slide,
            (P::Press, _) => Act::Press,
            (P::Bot, _) => Act::Bot,
            _ => Act::Hold,
        })
    }

    fn place(&mut self, to: &'w Expr, act: fn(Reg, Reg) -> Act) -> Act {
        let (x, y) = self.lower.want_point(to);
        act(x, y)
    }

    /// Writes another behaviour out, left as soon as its `until` holds or its `for` is over.
    fn call(&mut self, item: &'w BehaviorItem, stmt: &'w DoStmt, args: &'w [Arg], span: Span) {
        self.refuse_sprint(stmt, "a behavior");
        let (until, seconds) = self.drawing(|writer| writer.clauses(stmt));
        let began = seconds.map(|_| {
            let (cell, now) = (self.lower.code.new_cell(), self.elapsed());
            self.nodes.push(Node::Let(vec![(cell, now)]));
            cell
        });
        let over = match (began, seconds) {
            (Some(began), Some(seconds)) => Some(self.is_over(began, seconds)),
            _ => None,
        };
        let leaves = match (until, over) {
            (Some(until), Some(over)) => Some(self.lower.code.binary(BinaryOp::Or, until, over)),
            (until, over) => until.or(over),
        };
        let Some(leaves) = leaves else {
            self.run(item, args, span);
            return;
        };
        let stays = self.lower.code.unary(UnaryOp::Not, leaves);
        let branch = self.branch(stays);
        let (watch, from) = (self.watches.len(), self.nodes.len() as u32);
        self.watches.push(Watch { from, to: from, when: leaves, then: Then::Leave });
        self.run(item, args, span);
        let end = self.nodes.len() as u32;
        if let Some(watch) = self.watches.get_mut(watch) {
            watch.to = end;
        }
        self.patch(branch, end);
    }

    fn elapsed(&mut self) -> Reg {
        self.lower.code.load(Field::Elapsed, None, When::Now)
    }

    /// Whether so many steps have passed since the time in a cell.
    fn is_over(&mut self, began: u32, seconds: Reg) -> Reg {
        let now = self.elapsed();
        let code = &mut self.lower.code;
        let (began, per_s) = (code.cell(began), code.constant(STEPS_PER_S));
        let passed = code.binary(BinaryOp::Sub, now, began);
        let steps = |code: &mut crate::lower::builder::Builder, seconds: Reg| {
            let steps = code.binary(BinaryOp::Mul, seconds, per_s);
            code.unary(UnaryOp::Round, steps)
        };
        let (passed, wanted) = (steps(code, passed), steps(code, seconds));
        code.binary(BinaryOp::Ge, passed, wanted)
    }
}
