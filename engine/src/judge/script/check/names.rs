//! Checks the names that a script uses.
//!
//! A name is checked against its subject as far as the text shows it: for chains that begin at a
//! hook's arguments, at a loop over players or events, or at a `let` of such a chain. Any other
//! name must at least be known to the interface or to the script itself.

use super::super::api::{Subject, function, functions, members};
use super::super::hooks::{DONE, hook_arguments};
use super::super::imports::WRITTEN;
use super::super::place::word_at;
use super::{ScriptFault, ScriptFaultKind, ScriptNames, position_offset, suggest};
use rhai::{AST, ASTFlags, ASTNode, Expr, FnCallExpr, Namespace, Position, Stmt};
use setpiece_scenario::NamedKind;
use setpiece_scenario::vocabulary::{EventKind, Qualifier, Type};
use std::collections::BTreeMap;

/// The agent's own player, which only rewards and behaviours have.
const ME: &str = "me";

/// What can be read by name.
const NAMED_HELP: &str = "a script reads constants, regions and tables of its file; in a scenario also its players, `let`s, constants and regions";

/// The names of a module's functions with their numbers of arguments; none if it isn't known.
pub(super) type SharedFunctions = Option<Vec<(String, usize)>>;

/// What is known about a script's names.
pub(super) struct Names<'a> {
    source: &'a str,
    /// What variables hold; `None` if the text doesn't show it, or is ambiguous.
    variables: BTreeMap<String, Option<Subject>>,
    /// Keys of maps and of `this` that the script itself creates.
    keys: Vec<String>,
    /// Names and numbers of arguments.
    own_functions: Vec<(String, usize)>,
    /// What is imported under which name.
    aliases: BTreeMap<String, SharedFunctions>,
    hook: &'a str,
    known: ScriptNames<'a>,
    pub(super) faults: Vec<ScriptFault>,
}

impl<'a> Names<'a> {
    pub(super) fn of(
        source: &'a str,
        hook: &'a str,
        known: ScriptNames<'a>,
        ast: &AST,
        aliases: BTreeMap<String, SharedFunctions>,
    ) -> Names<'a> {
        let mut names = Names {
            source,
            variables: BTreeMap::new(),
            keys: Vec::new(),
            own_functions: ast
                .iter_functions()
                .map(|f| (f.name.to_owned(), f.params.len()))
                .collect(),
            aliases,
            hook,
            known,
            faults: Vec::new(),
        };
        for function in ast.iter_functions() {
            let subjects =
                if function.name == hook { hook_arguments(hook).unwrap_or_default() } else { &[] };
            for (at, parameter) in function.params.iter().enumerate() {
                // A helper's parameter with the name of a hook's argument holds the same thing.
                let by_name = hook_arguments(hook)
                    .unwrap_or_default()
                    .iter()
                    .find(|(name, _)| name == parameter);
                let subject = subjects.get(at).or(by_name).map(|(_, subject)| *subject);
                names.bind(parameter, subject);
            }
        }
        ast.walk(&mut |path: &[ASTNode]| {
            names.learn(path);
            true
        });
        names
    }

    fn bind(&mut self, name: &str, subject: Option<Subject>) {
        let entry = self.variables.entry(name.to_owned()).or_insert(subject);
        if *entry != subject {
            *entry = None;
        }
    }

    /// The first pass: collects what the script itself names.
    fn learn(&mut self, path: &[ASTNode]) {
        match path.last() {
            Some(ASTNode::Stmt(Stmt::Var(var, ..))) => {
                let subject = self.subject(&var.1, &mut |_, _, _| {});
                self.bind(&var.0.name, subject);
            }
            Some(ASTNode::Stmt(Stmt::For(each, _))) => {
                let subject = element(self.subject(&each.2.expr, &mut |_, _, _| {}));
                self.bind(&each.0.name, subject);
                if let Some(counter) = &each.1 {
                    self.bind(&counter.name, Some(Subject::Plain));
                }
            }
            Some(ASTNode::Stmt(Stmt::Assignment(assignment))) => {
                // From here on an assigned variable may hold anything.
                if let Expr::Variable(variable, ..) = &assignment.1.lhs {
                    self.bind(&variable.1, None);
                }
                self.learn_keys(&assignment.1.lhs);
            }
            Some(ASTNode::Expr(Expr::Map(map, _))) => {
                let keys = map.0.iter().map(|(key, _)| key.name.to_string());
                self.keys.extend(keys.chain(map.1.keys().map(ToString::to_string)));
            }
            // A map of constants is folded into one value.
            Some(ASTNode::Expr(Expr::DynamicConstant(value, _))) => {
                if let Some(map) = value.read_lock::<rhai::Map>() {
                    self.keys.extend(map.keys().map(ToString::to_string));
                }
            }
            _ => {}
        }
    }

    fn learn_keys(&mut self, assigned: &Expr) {
        match assigned {
            Expr::Property(property, _) => self.keys.push(property.2.to_string()),
            Expr::Dot(pair, ..) | Expr::Index(pair, ..) => {
                self.learn_keys(&pair.lhs);
                self.learn_keys(&pair.rhs);
            }
            _ => {}
        }
    }

    /// The second pass: checks every chain and call, from its beginning.
    pub(super) fn visit(&mut self, path: &[ASTNode]) {
        let Some(ASTNode::Expr(expr)) = path.last() else {
            match path.last() {
                Some(ASTNode::Stmt(Stmt::FnCall(call, position))) => {
                    self.check_call(call, false, *position);
                }
                Some(ASTNode::Stmt(Stmt::Assignment(assignment))) => {
                    self.check_assignment(&assignment.1.lhs);
                }
                _ => {}
            }
            return;
        };
        match expr {
            Expr::FnCall(call, position) => self.check_call(call, false, *position),
            Expr::Variable(variable, _, position) if !variable.2.is_empty() => {
                self.check_constant(&variable.2, &variable.1, *position);
            }
            Expr::MethodCall(call, position) => self.check_call(call, true, *position),
            Expr::Dot(..) | Expr::Index(..) => {
                let parent = path.len().checked_sub(2).and_then(|parent| path.get(parent));
                let is_inside = match parent {
                    Some(ASTNode::Expr(Expr::Dot(pair, ..) | Expr::Index(pair, ..))) => {
                        std::ptr::eq(&raw const pair.rhs, *expr)
                    }
                    _ => false,
                };
                if !is_inside {
                    let mut unknown = Vec::new();
                    self.subject(expr, &mut |of, name, position| {
                        unknown.push((of, name.to_owned(), position));
                    });
                    for (of, name, position) in unknown {
                        self.unknown_property(of, &name, position);
                    }
                }
            }
            _ => {}
        }
    }

    /// Checks the name of a call and its number of arguments.
    fn check_call(&mut self, call: &FnCallExpr, method: bool, position: Position) {
        if !call.namespace.is_empty() {
            self.check_qualified(call);
            return;
        }
        let name = call.name.as_str();
        let word = name.chars().all(|c| c.is_alphanumeric() || c == '_');
        if call.op_token.is_some() || !word || self.variables.contains_key(name) {
            return;
        }
        let mut own: Vec<usize> =
            self.own_functions.iter().filter(|own| own.0 == name).map(|own| own.1).collect();
        own.sort_unstable();
        if !own.is_empty() {
            // The value before the dot is the function's `this`.
            if !own.contains(&call.args.len()) {
                let help = format!("it is defined with {}", spelled(&own));
                self.push(position, arity(name, &own, call.args.len()), Some(help));
            }
            return;
        }
        if let Some(function) = function(name) {
            let found = call.args.len() + usize::from(method);
            if !function.takes.contains(&found) {
                let help = Some(function.about.to_owned());
                self.push(position, arity(name, function.takes, found), help);
            } else if name == "count" {
                let words = if method { &call.args[..] } else { &call.args[1..] };
                self.check_words(words);
            }
            return;
        }
        if functions().all(|known| known != name) {
            let own = self.own_functions.iter().map(|own| own.0.as_str());
            let help = suggest(name, functions().map(|known: &str| known).chain(own));
            self.push(position, format!("unknown function `{name}`"), help);
        }
    }

    /// Checks a call of a module's function.
    fn check_qualified(&mut self, call: &FnCallExpr) {
        let (alias, name) = (call.namespace.root(), call.name.as_str());
        let position = call.namespace.position();
        if call.namespace.path.len() > 1 {
            let help = Some(WRITTEN.to_owned());
            self.push(position, "a module's own imports can't be reached".to_owned(), help);
            return;
        }
        // A module that can't be found or read has been reported.
        let Some(Some(functions)) = self.aliases.get(alias) else { return };
        let mut takes: Vec<usize> =
            functions.iter().filter(|own| own.0 == name).map(|own| own.1).collect();
        takes.sort_unstable();
        let shown = format!("{alias}::{name}");
        if takes.is_empty() {
            let help = suggest(name, functions.iter().map(|own| own.0.as_str()));
            self.push(position, format!("unknown function `{shown}`"), help);
        } else if !takes.contains(&call.args.len()) {
            let help = Some(format!("it is defined with {}", spelled(&takes)));
            self.push(position, arity(&shown, &takes, call.args.len()), help);
        }
    }

    /// Reports what a module doesn't have: values.
    fn check_constant(&mut self, namespace: &Namespace, name: &str, position: Position) {
        let alias = namespace.root();
        if self.aliases.contains_key(alias) {
            let help = format!("write `fn {name}() {{ … }}` in it, and `{alias}::{name}()` here");
            self.push(position, "a module has only functions".to_owned(), Some(help));
        }
    }

    /// Checks the words of `count`: an event, a team.
    fn check_words(&mut self, words: &[Expr]) {
        let events: Vec<&str> = EventKind::ALL.iter().map(|kind| kind.name()).collect();
        for (noun, word, known) in
            [("event", words.first(), &events[..]), ("team", words.get(1), &["us", "them"])]
        {
            if let Some(Expr::StringConstant(word, position)) = word {
                let (first, qualifier) =
                    word.split_once(' ').map_or((word.as_str(), None), |(a, b)| (a, Some(b)));
                if known.contains(&first)
                    && (noun == "event" || qualifier.is_none())
                    && qualifier.is_none_or(|word| Qualifier::from_name(word).is_some())
                {
                    continue;
                }
                let help = suggest(word, known.iter().copied());
                self.push(*position, format!("no {noun} is called `{word}`"), help);
            }
        }
    }

    /// Reports assignments to the match, which can be read but not changed.
    fn check_assignment(&mut self, assigned: &Expr) {
        let mut root = assigned;
        while let Expr::Dot(pair, ..) | Expr::Index(pair, ..) = root {
            root = &pair.lhs;
        }
        let Expr::Variable(variable, _, position) = root else { return };
        let shown = match self.variables.get(variable.1.as_str()).copied().flatten() {
            // A list is the script's own copy.
            None
            | Some(
                Subject::Plain
                | Subject::Memory
                | Subject::Params
                | Subject::Named
                | Subject::Players
                | Subject::Events,
            ) => {
                return;
            }
            Some(shown) => shown,
        };
        if !std::ptr::eq(root, assigned) {
            let message = format!("a script can't change {}", shown.words());
            self.push(*position, message, Some("keep what should last in `this`".to_owned()));
        }
    }

    fn unknown_property(&mut self, of: Option<Subject>, name: &str, position: Position) {
        let candidates = members()
            .filter(|member| of.is_none_or(|of| member.of == of))
            .map(|member| member.name);
        let params = self.known.params.iter().filter(|_| of == Some(Subject::Params));
        let others = self.known.others.iter().filter(|_| of == Some(Subject::Named));
        let mut help = suggest(name, candidates.chain(params.chain(others).copied()));
        let message = match of {
            Some(Subject::State) if name == ME => {
                help = Some(
                    "go through `now.us.players`, or end by a condition on a player's name"
                        .to_owned(),
                );
                "nobody is `me` where an episode's end is judged".to_owned()
            }
            Some(Subject::Params) => format!("no parameter is called `{name}`"),
            Some(Subject::Named) if self.known.others.contains(&name) => {
                help = Some("a script reads players, points, teams, numbers, truth values, regions and tables".to_owned());
                format!("a script can't read a value of the kind of `{name}`")
            }
            Some(Subject::Named) => {
                help = help.or_else(|| Some(NAMED_HELP.to_owned()));
                format!("nothing that a script can read here is called `{name}`")
            }
            Some(of) => format!("{} has no property `{name}`", of.words()),
            None => format!("unknown property `{name}`"),
        };
        self.push(position, message, help);
    }

    fn push(&mut self, position: Position, message: String, help: Option<String>) {
        let range = word_at(self.source, position_offset(self.source, position));
        let kind = ScriptFaultKind::Name;
        self.faults.push(ScriptFault { kind, module: None, range, message, help });
    }

    /// The subject of an expression, as far as the text shows it. Names that it can't have are
    /// passed to `unknown`.
    fn subject(&self, expr: &Expr, unknown: &mut Unknown<'_>) -> Option<Subject> {
        match expr {
            Expr::Variable(variable, ..) => {
                self.variables.get(variable.1.as_str()).copied().flatten()
            }
            Expr::ThisPtr(_) => Some(Subject::Memory),
            Expr::Dot(pair, ..) => {
                let of = self.subject(&pair.lhs, unknown);
                self.chain(of, &pair.rhs, unknown)
            }
            Expr::Index(pair, flags, _) => {
                let of = self.subject(&pair.lhs, unknown);
                self.indexed(of, &pair.rhs, *flags, unknown)
            }
            _ => None,
        }
    }

    /// Continues along a chain; `rhs` is what follows the dot.
    fn chain(&self, of: Option<Subject>, rhs: &Expr, unknown: &mut Unknown<'_>) -> Option<Subject> {
        match rhs {
            Expr::Property(property, position) => {
                self.property(of, &property.2, *position, unknown)
            }
            Expr::Dot(pair, ..) => {
                let of = self.chain(of, &pair.lhs, unknown);
                self.chain(of, &pair.rhs, unknown)
            }
            Expr::Index(pair, flags, _) => {
                let of = self.chain(of, &pair.lhs, unknown);
                self.indexed(of, &pair.rhs, *flags, unknown)
            }
            _ => None,
        }
    }

    /// Continues after an index. Unless the chain is broken, the rest of it hangs on the index
    /// expression.
    fn indexed(
        &self,
        of: Option<Subject>,
        rhs: &Expr,
        flags: ASTFlags,
        unknown: &mut Unknown<'_>,
    ) -> Option<Subject> {
        let of = element(of);
        match rhs {
            Expr::Dot(pair, ..) if !flags.contains(ASTFlags::BREAK) => {
                self.chain(of, &pair.rhs, unknown)
            }
            Expr::Index(pair, inner, _) if !flags.contains(ASTFlags::BREAK) => {
                self.indexed(of, &pair.rhs, *inner, unknown)
            }
            _ => of,
        }
    }

    fn property(
        &self,
        of: Option<Subject>,
        name: &str,
        position: Position,
        unknown: &mut Unknown<'_>,
    ) -> Option<Subject> {
        let is_function = || functions().any(|known| known == name);
        match of {
            Some(Subject::Memory) => None,
            Some(of @ Subject::Params) => {
                if !self.known.params.contains(&name) && !is_function() {
                    unknown(Some(of), name, position);
                }
                None
            }
            Some(of @ Subject::Named) => {
                let known = self.known.named.iter().find(|(known, _)| *known == name);
                if known.is_none() && !is_function() {
                    unknown(Some(of), name, position);
                }
                known.map(|(_, kind)| subject_of(*kind))
            }
            Some(
                of @ (Subject::Players
                | Subject::Events
                | Subject::Region
                | Subject::Table
                | Subject::Plain),
            ) => {
                if !is_function() {
                    unknown(Some(of), name, position);
                }
                None
            }
            Some(of) => {
                let member = members().find(|member| member.of == of && member.name == name);
                if member.is_none() || (name == ME && of == Subject::State && self.hook == DONE) {
                    unknown(Some(of), name, position);
                }
                member.map(|member| member.gives)
            }
            None => {
                let known = self.keys.iter().any(|key| key == name)
                    || members().any(|member| member.name == name)
                    || is_function();
                if !known {
                    unknown(None, name, position);
                }
                None
            }
        }
    }
}

/// What a name stands for.
fn subject_of(kind: NamedKind) -> Subject {
    match kind {
        NamedKind::Value(Type::Player) => Subject::Player,
        NamedKind::Value(Type::Point) => Subject::Point,
        NamedKind::Value(_) => Subject::Plain,
        NamedKind::Region => Subject::Region,
        NamedKind::Table => Subject::Table,
    }
}

/// Says how many arguments a function takes, and how many it got.
fn arity(name: &str, takes: &[usize], found: usize) -> String {
    let noun = if takes == [1] { "argument" } else { "arguments" };
    format!("`{name}` takes {} {noun}, found {found}", spelled(takes))
}

fn spelled(numbers: &[usize]) -> String {
    numbers.iter().map(ToString::to_string).collect::<Vec<_>>().join(" or ")
}

/// Receives a name that its subject doesn't have.
type Unknown<'a> = dyn FnMut(Option<Subject>, &str, Position) + 'a;

/// The subject of an array's elements.
fn element(of: Option<Subject>) -> Option<Subject> {
    match of {
        Some(Subject::Players) => Some(Subject::Player),
        Some(Subject::Events) => Some(Subject::Event),
        _ => None,
    }
}
