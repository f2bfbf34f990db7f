//! Counts the copies that a script makes.
//!
//! Rhai copies a value wherever a variable is read as a whole, and has no callback for it. So
//! scripts are compiled with a call of [`COUNTED`] around whatever may be large ([`Class`]):
//! variables and chains read as a whole, and values put into a list or map. Long bodies and caught
//! errors are counted by separate calls. Ordinary hooks hold numbers and players; their text stays
//! unchanged.
//!
//! Rhai's syntax tree can be read but not written, so the calls are inserted into the text.
//! [`Edits`] maps places in it back to the author's text.

use super::super::chain::{Link, closure, links};
use super::super::functions::{ANONYMOUS, ScriptFunction, functions};
use super::super::limits::{COUNTED, WORKED};
use super::super::scan::{closing_bracket, expression_end};
use super::super::words;
use super::class::{Class, Classes, Pointers};
use super::edits::{Edits, inserted};
use super::{CAUGHT_OPERATIONS, CAUGHT_WAITING_OPERATIONS};
use rhai::{AST, ASTNode, Expr, FnCallExpr, Position, Stmt, StmtBlock};
use std::collections::BTreeSet;

/// Nodes of a body that count as one operation, because Rhai's bytecode counts only loops and
/// calls.
const NODES_PER_OPERATION: usize = 4;
/// Nodes of a body that are covered by the operation of its loop.
const NODES_FREE: usize = 32;
/// Nodes that indexing a string counts as: its characters are scanned.
const INDEX_NODES: usize = 16;
/// Nodes that searching a string counts as.
const SEARCH_NODES: usize = 64;
/// Nodes that building a string counts as.
const TEXT_NODES: usize = 32;
/// Nodes that an assignment into a list or map counts as in the tree walker, which checks the whole
/// content.
const STORE_NODES: usize = 128;

/// Operators that fail for a number and a list or map.
const ARITHMETIC: &[&str] = &["+", "-", "*", "/", "%", "**"];

/// Functions that copy their arguments and that Rhai implements without a native function.
const COPYING: &[&str] = &["call", CURRY, "Fn", "is_shared", "type_of"];

/// Binds an argument of a function.
const CURRY: &str = "curry";

/// Inserts counting calls into a script's text.
///
/// # Errors
/// A place that Rhai finds elsewhere: it stores lines and columns in two bytes, and has its own
/// line ends.
pub(in super::super) fn count_copies(
    source: &str,
    ast: &AST,
) -> Result<(String, Edits), (usize, usize)> {
    let functions = functions(ast);
    let pointers = pointers(ast, &functions);
    let classes = Classes::of(&functions, pointers);
    let lines =
        std::iter::once(0).chain(source.match_indices('\n').map(|(at, _)| at + 1)).collect();
    let mut writer = CopyWriter {
        source,
        lines,
        classes,
        walked: pointers.any,
        function: 0,
        insertions: Vec::new(),
        lost: None,
    };
    for (at, function) in functions.iter().enumerate() {
        writer.function = at;
        writer.statements(&function.body);
        if writer.classes.is_called(at)
            && let Some(body) = bodies(ast, function).next()
        {
            let nodes = writer.statements_nodes(&function.body);
            writer.count_nodes(body, nodes);
        }
    }
    match writer.lost {
        Some(place) => Err(place),
        None => Ok(writer.written()),
    }
}

/// The starts of a function's bodies.
fn bodies<'a>(ast: &'a AST, function: &'a ScriptFunction) -> impl Iterator<Item = Position> + 'a {
    let same =
        |name: &str, n_params: usize| name == function.name && n_params == function.params.len();
    ast.iter_fn_def()
        .filter(move |found| same(&found.name, found.params.len()))
        .map(|found| found.body.start_position())
}

fn pointers(ast: &AST, functions: &[ScriptFunction]) -> Pointers {
    let names: BTreeSet<&str> = functions.iter().map(|function| function.name.as_str()).collect();
    let mut pointers = Pointers {
        any: functions.iter().any(|own| own.name.starts_with(ANONYMOUS)),
        by_name: false,
    };
    ast.walk(&mut |path: &[ASTNode]| {
        pointers.by_name |= match path.last() {
            Some(ASTNode::Expr(Expr::FnCall(call, _)) | ASTNode::Stmt(Stmt::FnCall(call, _))) => {
                call.name == "Fn"
            }
            Some(ASTNode::Expr(Expr::Variable(variable, ..))) => {
                names.contains(variable.1.as_str())
            }
            _ => false,
        };
        true
    });
    pointers.any |= pointers.by_name;
    pointers
}

struct CopyWriter<'a> {
    source: &'a str,
    /// The starts of its lines.
    lines: Vec<usize>,
    classes: Classes<'a>,
    /// Whether the tree walker runs it.
    walked: bool,
    /// The current function.
    function: usize,
    /// Start, end of the enclosed text, and the inserted text.
    insertions: Vec<(usize, usize, String)>,
    /// A place that isn't where Rhai says.
    lost: Option<(usize, usize)>,
}

impl CopyWriter<'_> {
    fn offset(&mut self, position: Position) -> Option<usize> {
        let (line, column) = words::line_column(position)?;
        let start = *self.lines.get(line - 1)?;
        let rest = self.source.get(start..)?;
        let found = rest.char_indices().nth(column.saturating_sub(1)).map(|(at, _)| start + at);
        if found.is_none() {
            self.lost.get_or_insert((line, column));
        }
        found
    }

    /// The byte of a position, if the text continues there as expected.
    fn offset_of(&mut self, position: Position, expected: &str) -> Option<usize> {
        let at = self.offset(position)?;
        if self.source.get(at..).is_some_and(|rest| rest.starts_with(expected)) {
            return Some(at);
        }
        self.lost = self.lost.or(words::line_column(position));
        None
    }

    /// Counts what stands between two bytes.
    fn count(&mut self, start: usize, end: usize) {
        if start < end {
            self.insertions.push((start, end, format!("{COUNTED}(")));
            self.insertions.push((end, end, ")".to_owned()));
        }
    }

    /// Inserts a call after the `{` of a block.
    fn call_first(&mut self, block: Position, call: String) {
        if let Some(at) = self.offset_of(block, "{") {
            self.insertions.push((at + 1, at + 1, call));
        }
    }

    fn count_nodes(&mut self, block: Position, nodes: usize) {
        if nodes > NODES_FREE {
            self.call_first(block, format!(" {WORKED}({});", nodes / NODES_PER_OPERATION));
        }
    }

    fn class(&self, expr: &Expr) -> Class {
        self.classes.class(self.function, expr)
    }

    fn statements(&mut self, statements: &[Stmt]) {
        for statement in statements {
            self.statement(statement);
        }
    }

    fn block(&mut self, block: &StmtBlock) {
        self.statements(block.statements());
    }

    fn looped(&mut self, body: &StmtBlock) {
        let nodes = self.statements_nodes(body.statements());
        self.count_nodes(body.position(), nodes);
        self.block(body);
    }

    fn statement(&mut self, statement: &Stmt) {
        match statement {
            Stmt::Expr(expr) | Stmt::BreakLoop(Some(expr), ..) | Stmt::Return(Some(expr), ..) => {
                self.value(expr);
            }
            Stmt::FnCall(call, _) => self.call(call),
            Stmt::Block(block) => self.block(block),
            Stmt::If(flow, _) => {
                self.value(&flow.expr);
                self.block(&flow.body);
                self.block(&flow.branch);
            }
            Stmt::Switch(switch, _) => {
                self.value(&switch.0);
                for case in &switch.1.expressions {
                    self.value(&case.lhs);
                    self.value(&case.rhs);
                }
            }
            Stmt::While(flow, _) | Stmt::Do(flow, ..) => {
                self.value(&flow.expr);
                self.looped(&flow.body);
            }
            Stmt::For(each, _) => {
                self.value(&each.2.expr);
                self.looped(&each.2.body);
            }
            Stmt::Var(var, ..) => self.value(&var.1),
            Stmt::Assignment(assignment) => {
                let (operator, sides) = &**assignment;
                match &sides.lhs {
                    place @ Expr::Variable(..)
                        if operator.is_op_assignment() && self.class(place) <= Class::Text =>
                    {
                        self.operand(&sides.rhs);
                    }
                    Expr::Variable(..) | Expr::ThisPtr(_) => self.value(&sides.rhs),
                    place => {
                        self.place(place);
                        self.stored(place, operator.position(), &sides.rhs);
                    }
                }
            }
            Stmt::TryCatch(flow, _) => {
                self.block(&flow.body);
                let operations =
                    if self.walked { CAUGHT_WAITING_OPERATIONS } else { CAUGHT_OPERATIONS };
                self.call_first(flow.branch.position(), format!(" {WORKED}({operations});"));
                self.block(&flow.branch);
            }
            _ => {}
        }
    }

    /// Handles a value assigned into a list or map. A script names only few of them, so these calls
    /// are few.
    fn stored(&mut self, place: &Expr, operator: Position, value: &Expr) {
        self.value(value);
        let spelled = links(place).1.iter().all(|step| matches!(step, Link::Property(..)));
        let least = if spelled { Class::Squad } else { Class::Text };
        let counted = matches!(value, Expr::Variable(..) | Expr::ThisPtr(_))
            && self.class(value) >= Class::Squad;
        if counted || closure(value).is_some() || self.class(value) < least {
            return;
        }
        if let Some(at) = self.offset(operator) {
            let length =
                self.source.get(at..).unwrap_or_default().find('=').map_or(0, |sign| sign + 1);
            let start = at + length;
            self.count(start, expression_end(self.source, start));
        }
    }

    /// Handles the target of an assignment. A string that becomes a key of a map is stored.
    fn place(&mut self, expr: &Expr) {
        let (_, steps) = links(expr);
        for step in steps {
            if let Link::Index(index, bracket) = step {
                self.value(index);
                if self.class(index) == Class::Text
                    && let Some((start, end)) = self.brackets(bracket)
                {
                    self.count(start, end);
                }
            }
        }
    }

    /// Handles a value that is read as a whole.
    fn value(&mut self, expr: &Expr) {
        self.value_from(expr, Class::Squad);
    }

    /// Counts a value from a class on.
    fn value_from(&mut self, expr: &Expr, least: Class) {
        if closure(expr).is_some() {
            self.closure(expr);
            return;
        }
        if self.class(expr) >= least {
            match expr {
                Expr::Variable(variable, ..) if variable.2.is_empty() => {
                    if let Some(start) = self.offset_of(expr.position(), &variable.1) {
                        self.count(start, start + variable.1.len());
                    }
                }
                Expr::ThisPtr(position) => {
                    if let Some(start) = self.offset_of(*position, "this") {
                        self.count(start, start + "this".len());
                    }
                }
                // Reading a list of players creates a new one.
                Expr::Dot(..) | Expr::Index(..) if self.class(expr) > Class::Squad => {
                    self.chain_value(expr);
                }
                _ => {}
            }
        }
        self.inside(expr);
    }

    /// Handles an operand of a number or a string. A list or map fails there, and a caught error is
    /// counted.
    fn operand(&mut self, expr: &Expr) {
        match expr {
            Expr::Coalesce(list, _) => list.iter().for_each(|item| self.operand(item)),
            _ => self.inside(expr),
        }
    }

    /// Handles a closure that shares variables which may lead back to it.
    fn closure(&mut self, expr: &Expr) {
        let captured = closure(expr).map_or(&[][..], |(_, captured)| captured);
        if captured.iter().all(|variable| self.class(variable) <= Class::Text) {
            return;
        }
        let Expr::Stmt(block) = expr else { return };
        let begins = match block.statements() {
            [_, Stmt::Expr(inner)] => inner.position(),
            [_, Stmt::FnCall(_, position)] => *position,
            _ => return,
        };
        if let Some(start) = self.offset_of(begins, "|") {
            let parameters =
                self.source.get(start + 1..).and_then(|rest| rest.find('|')).unwrap_or_default();
            self.count(start, expression_end(self.source, start + 1 + parameters + 1));
        }
    }

    /// Counts a chain up to a call of `curry`, which copies what the function has captured.
    fn curried(&mut self, root: &Expr, name: Position) {
        let name = self.offset_of(name, CURRY);
        let open = name.and_then(|name| Some(name + self.source.get(name..)?.find('(')?));
        let close = open.and_then(|open| closing_bracket(self.source, open));
        if let (Some(begins), Some(close)) = (self.offset(root.position()), close) {
            self.count(begins, close + 1);
        }
    }

    /// Handles a chain that ends in a part of a list or map.
    fn chain_value(&mut self, expr: &Expr) {
        let (root, _) = links(expr);
        let Some(end) = self.chain_end(expr) else { return };
        let begins = match root {
            Expr::FnCall(call, _) => call.op_token.is_none(),
            _ => matches!(
                root,
                Expr::Variable(..) | Expr::ThisPtr(_) | Expr::Array(..) | Expr::Map(..)
            ),
        };
        // An operator's result isn't shared.
        if begins && let Some(start) = self.offset(root.position()) {
            self.count(start, end);
        }
    }

    /// The byte after a chain; none if it ends in a call, whose result isn't shared.
    fn chain_end(&mut self, expr: &Expr) -> Option<usize> {
        let (mut last, mut here) = (None, expr);
        while let Expr::Dot(pair, options, position) | Expr::Index(pair, options, position) = here {
            last = Some((&pair.rhs, *position, matches!(here, Expr::Index(..))));
            if options.contains(rhai::ASTFlags::BREAK) {
                break;
            }
            here = &pair.rhs;
            if !matches!(here, Expr::Dot(..) | Expr::Index(..)) {
                break;
            }
        }
        match last? {
            (Expr::Property(property, position), _, false) => {
                let start = self.offset_of(*position, &property.2)?;
                Some(start + property.2.len())
            }
            (_, position, true) => self.brackets(position).map(|(_, close)| close + 1),
            _ => None,
        }
    }

    /// The range between the brackets that open at a place.
    fn brackets(&mut self, position: Position) -> Option<(usize, usize)> {
        let at = self.offset(position)?;
        let open = at + self.source.get(at..)?.find('[')?;
        closing_bracket(self.source, open).map(|close| (open + 1, close))
    }

    /// Handles the parts of an expression.
    fn inside(&mut self, expr: &Expr) {
        match expr {
            Expr::Array(items, _) => items.iter().for_each(|item| self.value(item)),
            Expr::Map(map, _) => map.0.iter().for_each(|(_, item)| self.value(item)),
            Expr::And(list, _) | Expr::Or(list, _) | Expr::Coalesce(list, _) => {
                list.iter().for_each(|item| self.value(item));
            }
            Expr::Stmt(block) => self.block(block),
            Expr::FnCall(call, _) => self.call(call),
            Expr::Dot(..) | Expr::Index(..) => {
                let (root, steps) = links(expr);
                if !matches!(root, Expr::Variable(..) | Expr::ThisPtr(_)) {
                    self.inside(root);
                }
                for step in steps {
                    match step {
                        Link::Property(..) => {}
                        Link::Index(index, _) => self.value(index),
                        Link::Method(call, name) => {
                            if call.name == CURRY {
                                self.curried(root, name);
                            }
                            self.arguments(call, 0);
                        }
                    }
                }
            }
            _ => {}
        }
    }

    fn call(&mut self, call: &FnCallExpr) {
        let own = self.classes.own(&call.name, call.args.len()).is_some();
        if call.op_token.is_some() && ARITHMETIC.contains(&call.name.as_str()) {
            let smallest = call.args.iter().map(|argument| self.class(argument)).min();
            for argument in &call.args {
                match smallest {
                    Some(Class::Short) => self.operand(argument),
                    // Removing one string from another is counted wherever it stands.
                    _ => self.value_from(
                        argument,
                        if call.name == "-" { Class::Text } else { Class::Squad },
                    ),
                }
            }
        } else if call.op_token.is_some() || own {
            call.args.iter().for_each(|argument| self.value(argument));
        } else {
            // Rhai's functions may change their first argument in place.
            if let Some(first) = call.args.first() {
                if [CURRY, "type_of"].contains(&call.name.as_str()) {
                    self.value(first);
                } else {
                    self.inside_or_closure(first);
                }
            }
            self.arguments(call, 1);
        }
    }

    /// Handles arguments from `first` on. Arguments of Rhai's functions are counted with their
    /// work.
    fn arguments(&mut self, call: &FnCallExpr, first: usize) {
        let copied = self.walked || COPYING.contains(&call.name.as_str());
        let copied = copied || self.classes.own(&call.name, call.args.len()).is_some();
        for argument in call.args.iter().skip(first) {
            if copied { self.value(argument) } else { self.inside_or_closure(argument) }
        }
    }

    fn inside_or_closure(&mut self, expr: &Expr) {
        if closure(expr).is_some() { self.closure(expr) } else { self.inside(expr) }
    }

    /// The nodes of a body, without nested loops, which count for themselves.
    fn statements_nodes(&self, statements: &[Stmt]) -> usize {
        statements.iter().map(|statement| self.statement_nodes(statement)).sum()
    }

    fn statement_nodes(&self, statement: &Stmt) -> usize {
        let block = |block: &StmtBlock| self.statements_nodes(block.statements());
        1 + match statement {
            Stmt::Expr(expr) | Stmt::BreakLoop(Some(expr), ..) | Stmt::Return(Some(expr), ..) => {
                self.nodes(expr)
            }
            Stmt::FnCall(call, _) => call.args.iter().map(|argument| self.nodes(argument)).sum(),
            Stmt::Block(inner) => block(inner),
            Stmt::If(flow, _) => self.nodes(&flow.expr) + block(&flow.body) + block(&flow.branch),
            Stmt::TryCatch(flow, _) => block(&flow.body) + block(&flow.branch),
            Stmt::Switch(switch, _) => {
                let cases = switch.1.expressions.iter();
                self.nodes(&switch.0)
                    + cases.map(|case| self.nodes(&case.lhs) + self.nodes(&case.rhs)).sum::<usize>()
            }
            Stmt::While(flow, _) | Stmt::Do(flow, ..) => self.nodes(&flow.expr),
            Stmt::For(each, _) => {
                let subject = &each.2.expr;
                self.nodes(subject)
                    + if self.class(subject) == Class::Text { SEARCH_NODES } else { 0 }
            }
            Stmt::Var(var, ..) => self.nodes(&var.1),
            Stmt::Assignment(assignment) => {
                let sides = &assignment.1;
                let stored = self.walked && !matches!(sides.lhs, Expr::Variable(..));
                self.nodes(&sides.lhs)
                    + self.nodes(&sides.rhs)
                    + if stored { STORE_NODES } else { 0 }
            }
            _ => 0,
        }
    }

    fn nodes(&self, expr: &Expr) -> usize {
        let all = |list: &[Expr]| list.iter().map(|item| self.nodes(item)).sum::<usize>();
        1 + match expr {
            Expr::Array(items, _) => all(items),
            Expr::InterpolatedString(items, _) => TEXT_NODES + all(items),
            Expr::Map(map, _) => map.0.iter().map(|(_, item)| 4 + self.nodes(item)).sum(),
            Expr::And(list, _) | Expr::Or(list, _) | Expr::Coalesce(list, _) => all(list),
            Expr::Stmt(block) => self.statements_nodes(block.statements()),
            Expr::FnCall(call, _) => {
                let searched = if call.op_token.is_some() && call.name == "contains" {
                    SEARCH_NODES
                } else {
                    0
                };
                let short = call.args.iter().all(|argument| self.class(argument) == Class::Short);
                searched + if short { 0 } else { call.args.len() } + all(&call.args)
            }
            Expr::Dot(..) | Expr::Index(..) => {
                let (root, steps) = links(expr);
                let mut class = self.class(root);
                let mut nodes = self.nodes(root);
                for step in &steps {
                    nodes += match step {
                        Link::Property(..) => 1,
                        Link::Method(call, _) => all(&call.args),
                        Link::Index(index, _) if class == Class::Short => self.nodes(index),
                        Link::Index(index, _) => INDEX_NODES + self.nodes(index),
                    };
                    class = self.classes.step(class, step);
                }
                nodes
            }
            _ => 0,
        }
    }

    /// Builds the text with all insertions. Of those that begin at the same byte, the longest comes
    /// first.
    fn written(mut self) -> (String, Edits) {
        self.insertions.sort_by_key(|(at, end, _)| (*at, at != end, usize::MAX - end));
        inserted(self.source, self.insertions.iter().map(|(at, _, words)| (*at, words.as_str())))
    }
}
