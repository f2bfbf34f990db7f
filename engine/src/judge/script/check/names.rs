//! Checks the names that a script uses.
//!
//! A name is checked against its subject as far as the text shows it: for chains that begin at a
//! hook's arguments, at a loop over players or events, at a parameter of a closure that a list of
//! players or events calls, or at a `let` of such a chain. Any other name must at least be known to
//! the interface or to the script itself.

use super::super::api::{self, Subject, function, members};
use super::super::chain::{Link, closure, links};
use super::super::functions::{ANONYMOUS, ScriptFunction, functions};
use super::super::hooks::{DONE, hook_arguments};
use super::super::imports::WRITTEN;
use super::super::place::word_at;
use super::{FAULTS_MAX, ScriptFault, ScriptFaultKind, ScriptNames, position_offset, suggest};
use rhai::{AST, ASTNode, Expr, FnCallExpr, Namespace, Position, Stmt};
use setpiece_scenario::NamedKind;
use setpiece_scenario::vocabulary::{EventKind, Qualifier, Type};
use std::collections::BTreeMap;

/// After this many rounds, nothing more is learnt about closures in closures.
const ROUNDS_MAX: usize = 8;

/// How Rhai binds what a closure captures.
const CURRY: &str = "curry";

/// The agent's own player, which only rewards and behaviours have.
const ME: &str = "me";

/// What can be read by name.
const NAMED_HELP: &str = "a script reads constants, regions and tables of its file; in a scenario also its players, `let`s, constants and regions";

/// The names of a module's functions with their numbers of arguments; none if it isn't known.
pub(super) type SharedFunctions = Option<Vec<(String, usize)>>;

/// What is known about a script's names.
pub(super) struct Names<'a> {
    source: &'a str,
    functions: Vec<ScriptFunction>,
    /// What the variables of each function hold; `None` if the text doesn't show it, or is
    /// ambiguous.
    variables: Vec<BTreeMap<String, Option<Subject>>>,
    /// The function that is looked at.
    here: usize,
    /// Whether something has been learnt about a variable.
    moved: bool,
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
            functions: Vec::new(),
            variables: Vec::new(),
            here: 0,
            moved: true,
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
        let functions = functions(ast);
        names.variables = vec![BTreeMap::new(); functions.len()];
        let arguments = hook_arguments(hook).unwrap_or_default();
        for (at, function) in functions.iter().enumerate() {
            // What a closure gets is known where it stands.
            if function.name.starts_with(ANONYMOUS) {
                continue;
            }
            let subjects = if function.name == hook { arguments } else { &[] };
            for (place, parameter) in function.params.iter().enumerate() {
                // A helper's parameter with the name of a hook's argument holds the same thing.
                let by_name = arguments.iter().find(|(name, _)| name == parameter);
                let subject = subjects.get(place).or(by_name).map(|(_, subject)| *subject);
                names.bind(at, parameter, subject);
            }
        }
        // What is learnt about a function reaches the closures in it in the next round.
        for _ in 0..ROUNDS_MAX {
            if !std::mem::take(&mut names.moved) {
                break;
            }
            names.each(&functions, |names, path| names.learn(&functions, path));
        }
        names.functions = functions;
        names
    }

    /// Visits every node of the functions.
    fn each(
        &mut self,
        functions: &[ScriptFunction],
        mut visit: impl FnMut(&mut Names<'a>, &[ASTNode<'_>]),
    ) {
        for (at, function) in functions.iter().enumerate() {
            self.here = at;
            for statement in &function.body {
                statement.walk(&mut Vec::new(), &mut |path: &[ASTNode<'_>]| {
                    visit(self, path);
                    self.faults.len() < FAULTS_MAX
                });
            }
        }
    }

    /// Checks every chain and call.
    pub(super) fn check(&mut self) {
        let functions = std::mem::take(&mut self.functions);
        self.each(&functions, Names::visit);
    }

    fn bind(&mut self, function: usize, name: &str, subject: Option<Subject>) {
        let Some(known) = self.variables.get_mut(function) else { return };
        if !known.contains_key(name) {
            known.insert(name.to_owned(), subject);
            self.moved = true;
        } else if let Some(entry) = known.get_mut(name)
            && entry.is_some()
            && *entry != subject
        {
            *entry = None;
            self.moved = true;
        }
    }

    /// What a variable holds.
    fn variable(&self, name: &str) -> Option<Subject> {
        self.variables.get(self.here)?.get(name).copied().flatten()
    }

    /// Binds the parameters of a closure: first what it captures, then what its caller hands over.
    fn bind_closure(
        &mut self,
        functions: &[ScriptFunction],
        expr: &Expr,
        given: impl Fn(usize) -> Option<Subject>,
    ) {
        let Some((name, captured)) = closure(expr) else { return };
        let Some(at) = functions.iter().position(|own| own.name == name) else { return };
        for (place, parameter) in functions[at].params.iter().enumerate() {
            let subject = match captured.get(place) {
                Some(variable) => self.subject(variable, &mut |_, _, _| {}),
                None => given(place - captured.len().min(place)),
            };
            self.bind(at, parameter, subject);
        }
    }

    /// The first pass: collects what the script itself names.
    fn learn(&mut self, functions: &[ScriptFunction], path: &[ASTNode<'_>]) {
        match path.last() {
            Some(ASTNode::Stmt(Stmt::Var(var, ..))) => {
                let subject = self.subject(&var.1, &mut |_, _, _| {});
                self.bind(self.here, &var.0.name, subject);
            }
            Some(ASTNode::Stmt(Stmt::For(each, _))) => {
                let subject = element(self.subject(&each.2.expr, &mut |_, _, _| {}));
                self.bind(self.here, &each.0.name, subject);
                if let Some(counter) = &each.1 {
                    self.bind(self.here, &counter.name, Some(Subject::Plain));
                }
            }
            Some(ASTNode::Stmt(Stmt::Assignment(assignment))) => {
                // From here on an assigned variable may hold anything.
                if let Expr::Variable(variable, ..) = &assignment.1.lhs {
                    self.bind(self.here, &variable.1, None);
                }
                self.learn_keys(&assignment.1.lhs);
            }
            Some(ASTNode::Expr(chain @ (Expr::Dot(..) | Expr::Index(..)))) if !is_inside(path) => {
                let (root, links) = links(chain);
                let mut of = self.subject(root, &mut |_, _, _| {});
                for link in &links {
                    if let Link::Method(call, _) = link {
                        for argument in &call.args {
                            let given = |place| handed(of, &call.name, place);
                            self.bind_closure(functions, argument, given);
                        }
                    }
                    of = self.step(of, link, &mut |_, _, _| {});
                }
            }
            Some(ASTNode::Expr(Expr::FnCall(call, _)) | ASTNode::Stmt(Stmt::FnCall(call, _)))
                if call.op_token.is_none() && call.name != CURRY =>
            {
                // A call of a list's function by its name has the list first.
                let of = call.args.first().and_then(|list| self.subject(list, &mut |_, _, _| {}));
                for argument in &call.args {
                    let given = |place| handed(of, &call.name, place);
                    self.bind_closure(functions, argument, given);
                }
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
    fn visit(&mut self, path: &[ASTNode<'_>]) {
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
            Expr::Dot(..) | Expr::Index(..) if !is_inside(path) => {
                let mut unknown = Vec::new();
                self.subject(expr, &mut |of, name, position| {
                    unknown.push((of, name.to_owned(), position));
                });
                for (of, name, position) in unknown {
                    self.unknown_property(of, &name, position);
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
        if call.op_token.is_some() || !word || self.holds(name) {
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
        if api::functions().all(|known| known != name) {
            let own = self.own_functions.iter().map(|own| own.0.as_str());
            let known = api::functions().map(|known: &str| known).chain(own);
            let called = self.known.called_as(self.source, position, name);
            let help = called.or_else(|| suggest(name, known));
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
        let shown = match self.variable(&variable.1) {
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
            Some(of) => {
                let is_named = of == Subject::State && self.known.others.contains(&name);
                let named = is_named.then(|| format!("write `named.{name}`"));
                help = named.or_else(|| api::elsewhere(of, name, self.hook != DONE)).or(help);
                format!("{} has no property `{name}`", of.words())
            }
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
            Expr::Variable(variable, ..) => self.variable(&variable.1),
            Expr::ThisPtr(_) => Some(Subject::Memory),
            Expr::FnCall(call, _) if call.op_token.is_none() => {
                let of = call.args.first().and_then(|first| self.subject(first, &mut |_, _, _| {}));
                self.given_by(of, &call.name)
            }
            Expr::Dot(..) | Expr::Index(..) => {
                let (root, links) = links(expr);
                let of = self.subject(root, unknown);
                links.iter().fold(of, |of, link| self.step(of, link, unknown))
            }
            _ => None,
        }
    }

    /// Continues along a chain.
    fn step(
        &self,
        of: Option<Subject>,
        link: &Link<'_>,
        unknown: &mut Unknown<'_>,
    ) -> Option<Subject> {
        match link {
            Link::Property(name, position) => self.property(of, name, *position, unknown),
            Link::Index(..) => element(of),
            Link::Method(call, _) => self.given_by(of, &call.name),
        }
    }

    /// What a function gives for its first argument.
    fn given_by(&self, of: Option<Subject>, name: &str) -> Option<Subject> {
        if self.own_functions.iter().any(|own| own.0 == name) {
            return None;
        }
        match (of?, name) {
            (list @ (Subject::Players | Subject::Events), "filter") => Some(list),
            (Subject::Players | Subject::Events, "find" | "pop" | "shift") => element(of),
            (Subject::Players, "nearest") => Some(Subject::Player),
            (Subject::State, "point") => Some(Subject::Point),
            _ => None,
        }
    }

    /// Whether the function has a variable of this name.
    fn holds(&self, name: &str) -> bool {
        self.variables.get(self.here).is_some_and(|known| known.contains_key(name))
    }

    fn property(
        &self,
        of: Option<Subject>,
        name: &str,
        position: Position,
        unknown: &mut Unknown<'_>,
    ) -> Option<Subject> {
        let is_function = || api::functions().any(|known| known == name);
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

/// Whether a link of a chain is visited, and not its beginning.
fn is_inside(path: &[ASTNode<'_>]) -> bool {
    match path {
        [.., ASTNode::Expr(Expr::Dot(pair, ..) | Expr::Index(pair, ..)), ASTNode::Expr(expr)] => {
            std::ptr::eq(&raw const pair.rhs, *expr)
        }
        _ => false,
    }
}

/// What a list's function hands to a closure's parameter.
fn handed(of: Option<Subject>, name: &str, place: usize) -> Option<Subject> {
    let elements = match name {
        "all" | "any" | "filter" | "find" | "find_map" | "index_of" | "map" | "retain"
        | "drain" | "some" => 0..1,
        "reduce" | "reduce_rev" => 1..2,
        "dedup" | "order" | "order_by" | "sort" | "sort_by" => 0..2,
        _ => return None,
    };
    // Behind the elements comes their index.
    let of = element(of)?;
    if elements.contains(&place) {
        return Some(of);
    }
    (place == elements.end).then_some(Subject::Plain)
}

/// The subject of an array's elements.
fn element(of: Option<Subject>) -> Option<Subject> {
    match of {
        Some(Subject::Players) => Some(Subject::Player),
        Some(Subject::Events) => Some(Subject::Event),
        _ => None,
    }
}
