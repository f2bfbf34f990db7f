//! What can be told of a script before it runs: its grammar, its hook, the names it uses.
//!
//! A name is checked against what it belongs to as far as that is plain from the text: chains that begin at a hook's
//! arguments, at a loop over players or events, or at a `let` of such a chain. Any other name must at least be one that
//! the interface or the script itself knows.

use super::api::{Subject, functions, members};
use super::host;
use super::place::{definition, offset, word_at};
use rhai::{AST, ASTFlags, ASTNode, Expr, Position, Stmt};
use std::collections::BTreeMap;
use std::ops::Range;

/// Least similarity of a suggestion.
const SIMILAR: f64 = 0.6;

/// What kind of fault a script has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ScriptFaultKind {
    /// The text is not Rhai.
    Syntax,
    /// The hook is missing, or takes other arguments.
    Hook,
    /// A property, function or variable that nothing has.
    Name,
}

/// A fault of a script.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ScriptFault {
    /// What kind.
    pub kind: ScriptFaultKind,
    /// Where, in bytes of the script.
    pub range: Range<usize>,
    /// What is wrong, in one clause.
    pub message: String,
    /// What to write instead.
    pub help: Option<String>,
}

/// The arguments of a hook; `None` for no hook.
fn hook_arguments(hook: &str) -> Option<&'static [(&'static str, Subject)]> {
    const STEP: &[(&str, Subject)] =
        &[("ctx", Subject::Ctx), ("now", Subject::State), ("prev", Subject::State), ("events", Subject::Events)];
    match hook {
        "reward" | "done" => Some(STEP),
        "act" => Some(&[("ctx", Subject::Ctx), ("me", Subject::Player), ("now", Subject::State)]),
        "reset" => Some(&[("ctx", Subject::Ctx)]),
        _ => None,
    }
}

/// Finds what is wrong with a script that is to serve as `hook` (`reward`, `done`, `act` or `reset`) and finds these names
/// in `ctx.params`.
///
/// Faults are in the order of the text; a script that is not Rhai has one.
pub fn check_script(source: &str, hook: &str, params: &[&str]) -> Vec<ScriptFault> {
    let ast = match host::engine().compile(source) {
        Ok(ast) => ast,
        Err(error) => {
            let start = position_offset(source, error.position());
            let (kind, help) = match error.err_type() {
                rhai::ParseErrorType::VariableUndefined(name) => {
                    let arguments = hook_arguments(hook).unwrap_or_default().iter().map(|(name, _)| *name);
                    (ScriptFaultKind::Name, suggest(name, arguments.chain(["this"])))
                }
                _ => (ScriptFaultKind::Syntax, None),
            };
            let message = host::parse_message(&error);
            return vec![ScriptFault { kind, range: word_at(source, start), message, help }];
        }
    };
    let mut faults: Vec<ScriptFault> = check_hook(source, hook, &ast).into_iter().collect();
    faults.extend(check_reset(source, &ast));
    faults.extend(check_top_level(source, &ast));
    let mut names = Names::of(source, hook, params, &ast);
    ast.walk(&mut |path: &[ASTNode]| {
        names.visit(path);
        true
    });
    faults.append(&mut names.faults);
    faults.sort_by_key(|fault| fault.range.start);
    faults.dedup();
    faults
}

/// Whether a script asks about the agent's own player.
pub(super) fn mentions_me(ast: &AST) -> bool {
    !ast.walk(&mut |path: &[ASTNode]| {
        !matches!(path.last(), Some(ASTNode::Expr(Expr::Property(property, _))) if matches!(&*property.2, "me" | "agent"))
    })
}

/// Whether a script looks at the events that its hook is given.
pub(super) fn mentions_events(ast: &AST, hook: &str) -> bool {
    let arguments = hook_arguments(hook).unwrap_or_default();
    let Some(place) = arguments.iter().position(|(_, subject)| *subject == Subject::Events) else { return false };
    let defined = ast.iter_functions().find(|f| f.name == hook && f.params.len() == arguments.len());
    let Some(events) = defined.and_then(|f| f.params.get(place).copied()) else { return false };
    !ast.walk(&mut |path: &[ASTNode]| {
        !matches!(path.last(), Some(ASTNode::Expr(Expr::Variable(variable, ..))) if variable.1 == events)
    })
}

fn check_hook(source: &str, hook: &str, ast: &AST) -> Option<ScriptFault> {
    let arguments = hook_arguments(hook)?;
    let wanted = arguments.iter().map(|(name, _)| *name).collect::<Vec<_>>().join(", ");
    let defined: Vec<usize> = ast.iter_functions().filter(|f| f.name == hook).map(|f| f.params.len()).collect();
    if defined.contains(&arguments.len()) {
        return None;
    }
    let help = Some(format!("write `fn {hook}({wanted}) {{ … }}`"));
    let kind = ScriptFaultKind::Hook;
    Some(match defined.first() {
        None => ScriptFault {
            kind,
            range: 0..source.lines().next().map_or(0, str::len),
            message: format!("the script has no function `{hook}`"),
            help,
        },
        Some(found) => ScriptFault {
            kind,
            range: definition(source, hook).unwrap_or(0..0),
            message: format!("`{hook}` takes {} arguments, found {found}", arguments.len()),
            help,
        },
    })
}

/// A script may have a `reset` beside its hook; with other arguments it would never be called.
fn check_reset(source: &str, ast: &AST) -> Option<ScriptFault> {
    ast.iter_functions().any(|f| f.name == "reset").then(|| check_hook(source, "reset", ast)).flatten()
}

/// Nothing runs a script's statements outside its functions.
fn check_top_level(source: &str, ast: &AST) -> Option<ScriptFault> {
    let statement = ast.statements().iter().find(|statement| !matches!(statement, Stmt::Noop(_)))?;
    Some(ScriptFault {
        kind: ScriptFaultKind::Hook,
        range: word_at(source, position_offset(source, statement.position())),
        message: "statements outside functions never run".to_owned(),
        help: Some("write them into a function; what lasts between steps is kept in `this`".to_owned()),
    })
}

/// What is known of a script's names.
struct Names<'a> {
    source: &'a str,
    /// What variables hold; `None` where the text doesn't tell, or tells twice.
    variables: BTreeMap<String, Option<Subject>>,
    /// Keys of maps and of `this` that the script itself makes.
    keys: Vec<String>,
    own_functions: Vec<String>,
    params: &'a [&'a str],
    faults: Vec<ScriptFault>,
}

impl<'a> Names<'a> {
    fn of(source: &'a str, hook: &str, params: &'a [&'a str], ast: &AST) -> Names<'a> {
        let mut names = Names {
            source,
            variables: BTreeMap::new(),
            keys: Vec::new(),
            own_functions: ast.iter_functions().map(|f| f.name.to_owned()).collect(),
            params,
            faults: Vec::new(),
        };
        for function in ast.iter_functions() {
            let subjects = if function.name == hook { hook_arguments(hook).unwrap_or_default() } else { &[] };
            for (at, parameter) in function.params.iter().enumerate() {
                // A helper's parameter with an argument's name holds what the hook's does.
                let by_name = hook_arguments(hook).unwrap_or_default().iter().find(|(name, _)| name == parameter);
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

    /// First pass: what the script itself names.
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
                // An assigned variable may hold anything from here on.
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

    /// Second pass: every chain and call, from its beginning.
    fn visit(&mut self, path: &[ASTNode]) {
        let Some(ASTNode::Expr(expr)) = path.last() else {
            if let Some(ASTNode::Stmt(Stmt::FnCall(call, position))) = path.last() {
                self.check_call(&call.name, call.op_token.is_some(), *position);
            }
            return;
        };
        match expr {
            Expr::FnCall(call, position) | Expr::MethodCall(call, position) => {
                self.check_call(&call.name, call.op_token.is_some(), *position);
            }
            Expr::Dot(..) | Expr::Index(..) => {
                let inside = path.len().checked_sub(2).and_then(|parent| path.get(parent)).is_some_and(|parent| {
                    matches!(parent, ASTNode::Expr(Expr::Dot(pair, ..) | Expr::Index(pair, ..)) if std::ptr::eq(&raw const pair.rhs, *expr))
                });
                if !inside {
                    let mut unknown = Vec::new();
                    self.subject(expr, &mut |of, name, position| unknown.push((of, name.to_owned(), position)));
                    for (of, name, position) in unknown {
                        self.unknown_property(of, &name, position);
                    }
                }
            }
            _ => {}
        }
    }

    fn check_call(&mut self, name: &str, operator: bool, position: Position) {
        let word = name.chars().all(|c| c.is_alphanumeric() || c == '_');
        let known = operator || !word || functions().any(|known| known == name);
        if known || self.own_functions.iter().any(|own| own == name) || self.variables.contains_key(name) {
            return;
        }
        let own = self.own_functions.iter().map(String::as_str);
        let help = suggest(name, functions().map(|known: &str| known).chain(own));
        self.push(position, format!("unknown function `{name}`"), help);
    }

    fn unknown_property(&mut self, of: Option<Subject>, name: &str, position: Position) {
        let candidates = members().filter(|member| of.is_none_or(|of| member.of == of)).map(|member| member.name);
        let params = self.params.iter().copied().filter(|_| of == Some(Subject::Params));
        let help = suggest(name, candidates.chain(params));
        let message = match of {
            Some(Subject::Params) => format!("the scenario has no parameter `{name}`"),
            Some(of) => format!("{} has no property `{name}`", of.words()),
            None => format!("unknown property `{name}`"),
        };
        self.push(position, message, help);
    }

    fn push(&mut self, position: Position, message: String, help: Option<String>) {
        let range = word_at(self.source, position_offset(self.source, position));
        self.faults.push(ScriptFault { kind: ScriptFaultKind::Name, range, message, help });
    }

    /// What an expression gives, as far as the text tells; names it can't have are handed to `unknown`.
    fn subject(&self, expr: &Expr, unknown: &mut Unknown<'_>) -> Option<Subject> {
        match expr {
            Expr::Variable(variable, ..) => self.variables.get(variable.1.as_str()).copied().flatten(),
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

    /// Goes on along a chain: `rhs` is what stands after the dot.
    fn chain(&self, of: Option<Subject>, rhs: &Expr, unknown: &mut Unknown<'_>) -> Option<Subject> {
        match rhs {
            Expr::Property(property, position) => self.property(of, &property.2, *position, unknown),
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

    /// Goes on behind an index: without a break, the rest of the chain hangs on the index expression.
    fn indexed(&self, of: Option<Subject>, rhs: &Expr, flags: ASTFlags, unknown: &mut Unknown<'_>) -> Option<Subject> {
        let of = element(of);
        match rhs {
            Expr::Dot(pair, ..) if !flags.contains(ASTFlags::BREAK) => self.chain(of, &pair.rhs, unknown),
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
                if !self.params.contains(&name) && !is_function() {
                    unknown(Some(of), name, position);
                }
                None
            }
            Some(of @ (Subject::Players | Subject::Events | Subject::Plain)) => {
                if !is_function() {
                    unknown(Some(of), name, position);
                }
                None
            }
            Some(of) => {
                let member = members().find(|member| member.of == of && member.name == name);
                if member.is_none() {
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

/// Takes a name that its subject doesn't have.
type Unknown<'a> = dyn FnMut(Option<Subject>, &str, Position) + 'a;

/// What an array's elements are.
fn element(of: Option<Subject>) -> Option<Subject> {
    match of {
        Some(Subject::Players) => Some(Subject::Player),
        Some(Subject::Events) => Some(Subject::Event),
        _ => None,
    }
}

pub(super) fn suggest<'a>(name: &str, candidates: impl Iterator<Item = &'a str>) -> Option<String> {
    let scored = candidates.map(|candidate| (strsim::normalized_damerau_levenshtein(name, candidate), candidate));
    let best = scored.filter(|(score, _)| *score >= SIMILAR).fold(None, |best: Option<(f64, &str)>, next| match best {
        Some(best) if best.0 >= next.0 => Some(best),
        _ => Some(next),
    });
    best.map(|(_, candidate)| format!("did you mean `{candidate}`?"))
}

fn position_offset(source: &str, position: Position) -> usize {
    match host::line_column(position) {
        Some((line, column)) => offset(source, line, column),
        None => source.len(),
    }
}
