//! Estimates how large the values of a script's expressions can be, from its text.
//!
//! The text is enough for most hooks: numbers, players, the ball. Anything that isn't clear from
//! the text is treated as large.

use super::super::api::{Subject, members};
use super::super::chain::{Link, closure, links};
use super::super::functions::{ANONYMOUS, ScriptFunction};
use super::super::hooks::hook_arguments;
use rhai::{Expr, FnCallExpr, Stmt, StmtBlock};
use std::collections::{BTreeMap, BTreeSet};

/// How large a value can be.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Class {
    /// A number, truth value, short word, or thing of the match.
    Short,
    /// Possibly a string.
    Text,
    /// A list of players or events.
    Squad,
    /// Possibly a list, map or function.
    Any,
}

/// Operators that return a number or a bool.
const NUMERIC: &[&str] = &["==", "!=", "<", "<=", ">", ">=", "!", "contains", "..", "..="];

/// Functions that return a number, a bool or a thing of the match.
const SHORT: &[&str] = &[
    "abs",
    "acos",
    "acosh",
    "angle",
    "asin",
    "asinh",
    "atan",
    "atan2",
    "atanh",
    "bytes",
    "ceiling",
    "clamp",
    "contains",
    "cos",
    "cosh",
    "count",
    "distance",
    "exp",
    "floor",
    "fraction",
    "grf_distance",
    "hypot",
    "index_of",
    "int",
    "is_empty",
    "is_even",
    "is_finite",
    "is_infinite",
    "is_nan",
    "is_odd",
    "is_zero",
    "len",
    "ln",
    "log",
    "log10",
    "nearest",
    "parse_float",
    "parse_int",
    "point",
    "pow",
    "pressed",
    "random",
    "round",
    "sign",
    "sin",
    "sinh",
    "smoothstep",
    "speed",
    "sqrt",
    "tan",
    "tanh",
    "to_degrees",
    "to_float",
    "to_int",
    "to_radians",
];

/// Functions that return a string or a number.
const TEXT: &[&str] = &["max", "min", "to_string", "type_of"];

/// Methods that don't change their list.
const READING: &[&str] = &[
    "all",
    "contains",
    "count",
    "filter",
    "find",
    "find_map",
    "for_each",
    "index_of",
    "is_empty",
    "len",
    "map",
    "nearest",
    "reduce",
    "reduce_rev",
    "some",
];

/// List methods that call a closure with each element.
const EACH: &[&str] = &["all", "filter", "find", "find_map", "for_each", "map", "some"];

/// What is known about a script's variables and functions.
pub(super) struct Classes<'a> {
    functions: &'a [ScriptFunction],
    /// The classes of the variables of each function.
    variables: Vec<BTreeMap<String, Class>>,
    /// The class of each function's result.
    gives: Vec<Class>,
    /// Whether functions are used as values, so that the text doesn't show where they are called.
    has_closures: bool,
    /// Functions that the script itself calls.
    called: BTreeSet<usize>,
    /// Whether functions are called by name.
    by_name: bool,
    /// Variables that are changed in place.
    changed: BTreeSet<String>,
    /// Variables that a closure assigns to, in any scope.
    escaped: BTreeSet<String>,
    moved: bool,
}

/// How a script uses functions as values.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Pointers {
    /// Whether it has closures, or functions called by name from a string.
    pub(super) any: bool,
    /// Whether functions are called by name from a string.
    pub(super) by_name: bool,
}

/// After this many rounds, remaining assumptions about variables are dropped.
const ROUNDS_MAX: usize = 8;

impl<'a> Classes<'a> {
    pub(super) fn of(functions: &'a [ScriptFunction], pointers: Pointers) -> Classes<'a> {
        let mut classes = Classes {
            functions,
            variables: vec![BTreeMap::new(); functions.len()],
            gives: vec![Class::Short; functions.len()],
            has_closures: pointers.any,
            by_name: pointers.by_name,
            called: BTreeSet::new(),
            changed: BTreeSet::new(),
            escaped: BTreeSet::new(),
            moved: true,
        };
        for (at, function) in functions.iter().enumerate() {
            let subjects = hook_arguments(&function.name).unwrap_or_default();
            for (place, param) in function.params.iter().enumerate() {
                let class = match subjects.get(place) {
                    Some((_, Subject::Events)) if subjects.len() == function.params.len() => {
                        Class::Squad
                    }
                    Some(_) if subjects.len() == function.params.len() => Class::Short,
                    // Hooks are called from outside, but a script's own functions only by its own
                    // calls.
                    _ if subjects.is_empty() && !pointers.by_name => Class::Short,
                    _ => Class::Any,
                };
                classes.variables[at].insert(param.clone(), class);
            }
        }
        // Starts from optimistic assumptions and corrects them until nothing contradicts them.
        for _ in 0..ROUNDS_MAX {
            if !std::mem::take(&mut classes.moved) {
                return classes;
            }
            for (at, function) in functions.iter().enumerate() {
                let given = classes.statements(at, &function.body);
                classes.give(at, given);
            }
        }
        classes.variables.iter_mut().for_each(BTreeMap::clear);
        classes.gives.fill(Class::Any);
        classes
    }

    /// The script's own function that a call refers to.
    pub(super) fn own(&self, name: &str, n_arguments: usize) -> Option<usize> {
        self.functions.iter().position(|own| own.name == name && own.params.len() == n_arguments)
    }

    /// Whether the script itself calls a function.
    pub(super) fn is_called(&self, function: usize) -> bool {
        let is_closure = self.functions[function].name.starts_with(ANONYMOUS);
        !is_closure && (self.by_name || self.called.contains(&function))
    }

    fn give(&mut self, at: usize, class: Class) {
        if class > self.gives[at] {
            self.gives[at] = class;
            self.moved = true;
        }
    }

    fn bind(&mut self, at: usize, name: &str, class: Class) {
        let known = self.variables[at].entry(name.to_owned()).or_insert(Class::Short);
        if class > *known {
            *known = class;
            self.moved = true;
        }
    }

    fn change(&mut self, root: &Expr) {
        if let Expr::Variable(variable, ..) = root {
            self.moved |= self.changed.insert(variable.1.to_string());
        }
    }

    /// Analyses statements, and returns the class of the last.
    fn statements(&mut self, at: usize, statements: &[Stmt]) -> Class {
        statements.iter().fold(Class::Short, |_, statement| self.statement(at, statement))
    }

    fn block(&mut self, at: usize, block: &StmtBlock) -> Class {
        self.statements(at, block.statements())
    }

    fn statement(&mut self, at: usize, statement: &Stmt) -> Class {
        match statement {
            Stmt::Expr(expr) | Stmt::BreakLoop(Some(expr), ..) => self.look(at, expr),
            Stmt::FnCall(call, _) => self.call(at, call),
            Stmt::Block(block) => self.block(at, block),
            Stmt::If(flow, _) => {
                self.look(at, &flow.expr);
                self.block(at, &flow.body).max(self.block(at, &flow.branch))
            }
            Stmt::Switch(switch, _) => {
                self.look(at, &switch.0);
                let cases = switch.1.expressions.iter();
                cases.fold(Class::Short, |class, case| {
                    self.look(at, &case.lhs);
                    class.max(self.look(at, &case.rhs))
                })
            }
            Stmt::While(flow, _) | Stmt::Do(flow, ..) => {
                self.look(at, &flow.expr);
                self.block(at, &flow.body);
                Class::Any
            }
            Stmt::For(each, _) => {
                let class = match self.look(at, &each.2.expr) {
                    Class::Any => Class::Any,
                    _ => Class::Short,
                };
                self.bind(at, &each.0.name, class);
                if let Some(counter) = &each.1 {
                    self.bind(at, &counter.name, Class::Short);
                }
                self.block(at, &each.2.body);
                Class::Any
            }
            Stmt::Var(var, ..) => {
                let class = self.look(at, &var.1);
                self.bind(at, &var.0.name, class);
                Class::Short
            }
            Stmt::Assignment(assignment) => {
                let class = self.look(at, &assignment.1.rhs);
                let lhs = &assignment.1.lhs;
                match lhs {
                    // Adding to a number, string or list doesn't change its type.
                    Expr::Variable(variable, ..)
                        if self.functions[at].name.starts_with(ANONYMOUS) =>
                    {
                        self.moved |= self.escaped.insert(variable.1.to_string());
                    }
                    Expr::Variable(variable, ..) if assignment.0.is_op_assignment() => {
                        let known = self.class(at, lhs);
                        self.bind(
                            at,
                            &variable.1,
                            if known == Class::Short { class.min(Class::Text) } else { known },
                        );
                    }
                    Expr::Variable(variable, ..) => self.bind(at, &variable.1, class),
                    _ => {
                        self.look(at, lhs);
                        self.change(links(lhs).0);
                    }
                }
                Class::Short
            }
            Stmt::TryCatch(flow, _) => {
                if let Expr::Variable(variable, ..) = &flow.expr {
                    self.bind(at, &variable.1, Class::Any);
                }
                self.block(at, &flow.body).max(self.block(at, &flow.branch))
            }
            Stmt::Return(Some(expr), ..) => {
                let class = self.look(at, expr);
                self.give(at, class);
                Class::Short
            }
            _ => Class::Short,
        }
    }

    /// Analyses an expression, and returns its class.
    fn look(&mut self, at: usize, expr: &Expr) -> Class {
        if closure(expr).is_some() {
            self.closure(at, expr, Class::Any);
            return Class::Any;
        }
        match expr {
            Expr::FnCall(call, _) => return self.call(at, call),
            Expr::Stmt(block) => return self.block(at, block),
            Expr::Array(items, _) | Expr::InterpolatedString(items, _) => {
                items.iter().for_each(|item| _ = self.look(at, item));
            }
            Expr::Map(map, _) => map.0.iter().for_each(|(_, item)| _ = self.look(at, item)),
            Expr::And(list, _) | Expr::Or(list, _) | Expr::Coalesce(list, _) => {
                list.iter().for_each(|item| _ = self.look(at, item));
            }
            Expr::Dot(..) | Expr::Index(..) => {
                let (root, links) = links(expr);
                let mut class = self.look(at, root);
                for link in &links {
                    let of = class;
                    class = self.step(of, link);
                    match link {
                        Link::Method(call, _) => {
                            self.arguments(at, call);
                            let of_players =
                                of == Class::Squad && EACH.contains(&call.name.as_str());
                            let element = if of_players { Class::Short } else { Class::Any };
                            call.args
                                .iter()
                                .for_each(|argument| self.closure(at, argument, element));
                            if !READING.contains(&call.name.as_str()) {
                                self.change(root);
                            }
                        }
                        Link::Index(index, _) => _ = self.look(at, index),
                        Link::Property(..) => {}
                    }
                }
            }
            _ => {}
        }
        self.class(at, expr)
    }

    /// A closure's captured variables are its function's first parameters; the caller provides the
    /// others.
    fn closure(&mut self, at: usize, expr: &Expr, given: Class) {
        let Some((name, captured)) = closure(expr) else { return };
        let Some(own) = self.functions.iter().position(|own| own.name == name) else { return };
        for (place, param) in self.functions[own].params.iter().enumerate() {
            let class =
                captured.get(place).map_or(given, |variable| match self.class(at, variable) {
                    Class::Squad => Class::Any,
                    class => class,
                });
            self.bind(own, param, class);
        }
    }

    fn call(&mut self, at: usize, call: &FnCallExpr) -> Class {
        self.arguments(at, call);
        if let Some(first) = call.args.first()
            && call.op_token.is_none()
            && self.own(&call.name, call.args.len()).is_none()
            && !READING.contains(&call.name.as_str())
        {
            self.change(first);
        }
        call.args.iter().for_each(|argument| self.closure(at, argument, Class::Any));
        self.call_class(at, call)
    }

    /// Analyses an argument. A closure's caller decides what the closure receives.
    fn argument(&mut self, at: usize, expr: &Expr) -> Class {
        if closure(expr).is_some() { Class::Any } else { self.look(at, expr) }
    }

    /// Binds the arguments of a call of the script's own function to its parameters.
    fn arguments(&mut self, at: usize, call: &FnCallExpr) {
        let classes: Vec<Class> =
            call.args.iter().map(|argument| self.argument(at, argument)).collect();
        if call.op_token.is_some() {
            return;
        }
        if let Some(own) = self.own(&call.name, classes.len()) {
            self.called.insert(own);
            for (place, class) in classes.into_iter().enumerate() {
                let name = self.functions[own].params[place].clone();
                // A list of players may be changed there.
                self.bind(own, &name, if class == Class::Squad { Class::Any } else { class });
            }
        }
    }

    /// The class of an expression.
    pub(super) fn class(&self, at: usize, expr: &Expr) -> Class {
        match expr {
            Expr::StringConstant(..) | Expr::InterpolatedString(..) => Class::Text,
            Expr::BoolConstant(..)
            | Expr::IntegerConstant(..)
            | Expr::FloatConstant(..)
            | Expr::CharConstant(..)
            | Expr::Unit(..)
            | Expr::And(..)
            | Expr::Or(..) => Class::Short,
            Expr::Variable(variable, ..) if variable.2.is_empty() => {
                match self.variables[at].get(variable.1.as_str()).copied().unwrap_or(Class::Any) {
                    _ if self.escaped.contains(variable.1.as_str()) => Class::Any,
                    Class::Squad if self.changed.contains(variable.1.as_str()) => Class::Any,
                    class => class,
                }
            }
            Expr::Coalesce(list, _) => {
                list.iter().map(|item| self.class(at, item)).max().unwrap_or(Class::Any)
            }
            Expr::FnCall(call, _) => self.call_class(at, call),
            Expr::Dot(..) | Expr::Index(..) => {
                let (root, links) = links(expr);
                links.iter().fold(self.class(at, root), |class, link| self.step(class, link))
            }
            Expr::Stmt(block) => {
                block.statements().last().map_or(Class::Short, |last| self.tail_class(at, last))
            }
            _ => Class::Any,
        }
    }

    fn tail_class(&self, at: usize, statement: &Stmt) -> Class {
        let block = |block: &StmtBlock| {
            block.statements().last().map_or(Class::Short, |last| self.tail_class(at, last))
        };
        match statement {
            Stmt::Expr(expr) => self.class(at, expr),
            Stmt::FnCall(call, _) => self.call_class(at, call),
            Stmt::If(flow, _) | Stmt::TryCatch(flow, _) => {
                block(&flow.body).max(block(&flow.branch))
            }
            Stmt::Switch(switch, _) => {
                let cases = switch.1.expressions.iter();
                cases.map(|case| self.class(at, &case.rhs)).max().unwrap_or(Class::Short)
            }
            Stmt::Block(inner) => block(inner),
            Stmt::While(..) | Stmt::Do(..) | Stmt::For(..) => Class::Any,
            _ => Class::Short,
        }
    }

    /// The class of a link of a chain.
    pub(super) fn step(&self, of: Class, link: &Link<'_>) -> Class {
        match link {
            Link::Property(name, _) => match (of, gives(name)) {
                (Class::Any, _) => Class::Any,
                (Class::Squad, _) => Class::Short,
                (_, Some(Subject::Players)) => Class::Squad,
                (_, Some(Subject::Events | Subject::Params | Subject::Memory) | None) => Class::Any,
                _ => Class::Short,
            },
            Link::Index(..) if of == Class::Any => Class::Any,
            Link::Index(..) => Class::Short,
            // A map may hold a function of any name.
            Link::Method(..) if self.has_closures && of == Class::Any => Class::Any,
            Link::Method(call, _) => self.named_class(&call.name, call.args.len()),
        }
    }

    fn named_class(&self, name: &str, n_arguments: usize) -> Class {
        if let Some(own) = self.own(name, n_arguments) {
            return self.gives[own];
        }
        if SHORT.contains(&name) {
            Class::Short
        } else if TEXT.contains(&name) {
            Class::Text
        } else {
            Class::Any
        }
    }

    fn call_class(&self, at: usize, call: &FnCallExpr) -> Class {
        let name = call.name.as_str();
        if call.op_token.is_none() {
            return self.named_class(name, call.args.len());
        }
        if NUMERIC.contains(&name) {
            return Class::Short;
        }
        let operands = call.args.iter().map(|operand| self.class(at, operand));
        match (name, operands.clone().min(), operands.max()) {
            (_, _, Some(Class::Short)) => Class::Short,
            // Lists and maps can only be added to lists and maps.
            ("+", Some(Class::Squad | Class::Any), _) => Class::Any,
            _ => Class::Text,
        }
    }
}

/// The subject of a property of the match.
fn gives(name: &str) -> Option<Subject> {
    members().find(|member| member.name == name).map(|member| member.gives)
}
