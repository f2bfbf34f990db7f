//! The functions of a script, with their statements.

use rhai::{AST, ASTNode, Position, Stmt};

/// A function of a script, with its statements.
pub(super) struct ScriptFunction {
    pub(super) name: String,
    pub(super) params: Vec<String>,
    pub(super) body: Vec<Stmt>,
}

/// Rhai's prefix for the names of closures' functions.
pub(super) const ANONYMOUS: &str = "anon$";

/// The functions of a script, in text order. Functions that differ only in the type of `this` are
/// one.
pub(super) fn functions(ast: &AST) -> Vec<ScriptFunction> {
    let mut list: Vec<(Position, ScriptFunction)> = Vec::new();
    for found in ast.iter_fn_def() {
        let (name, n_params) = (found.name.as_str(), found.params.len());
        let begins = found.body.start_position();
        if let Some(known) =
            list.iter_mut().find(|(_, known)| known.name == name && known.params.len() == n_params)
        {
            known.0 = known.0.min(begins);
            continue;
        }
        let mut alone = ast.clone_functions_only();
        alone.retain_functions(|_, _, other, others| other == name && others == n_params);
        let mut body = Vec::new();
        alone.walk(&mut |path: &[ASTNode]| {
            if let [ASTNode::Stmt(statement)] = path {
                body.push((*statement).clone());
            }
            true
        });
        let params = found.params.iter().map(ToString::to_string).collect();
        list.push((begins, ScriptFunction { name: name.to_owned(), params, body }));
    }
    list.sort_by_key(|(begins, _)| *begins);
    list.into_iter().map(|(_, function)| function).collect()
}
