//! Reads the `ai`s that a caller brings from outside, each as a text of its own.

use crate::ast::{
    Expr, ExprKind, Field, FieldValue, Ident, ItemKind, ScenarioStmtKind, TeamStmtKind,
};
use crate::cast::{CAST_NAME, Cast, CastTarget};
use crate::lower::people::Casting;
use crate::problem::Problem;
use crate::problem::facts::Whole;
use crate::resolve::Library;
use crate::source::{FileId, Source, Span};
use setpiece_scenario::vocabulary::Team;
use setpiece_scenario::{Instr, Scenario, SideAgents};

/// What stands around the `ai` in its text.
const BEFORE: &str = "scenario cast { team left { each all { ai: ";
const AFTER: &str = " } } }";

/// The `all` and the `ai` that play everybody by what a name stands for.
pub(super) fn as_option(name: &Ident) -> (Ident, Field) {
    let spanned = |node: &str| Ident { node: node.to_owned(), span: name.span };
    let value = Expr { span: name.span, kind: ExprKind::Name(name.node.clone()) };
    (spanned("all"), Field { key: spanned("ai"), value: FieldValue::Expr(value) })
}

/// The players of a scenario's agents: all of a team whose agents change players.
pub(super) fn of_agents(scenario: &Scenario) -> Vec<CastTarget> {
    let of_side = |team: Team| -> Vec<CastTarget> {
        let side = scenario.agents.sides.get(team.index());
        match side {
            Some(SideAgents::Players(players)) => {
                players.iter().map(|place| CastTarget::Player(team, usize::from(*place))).collect()
            }
            Some(SideAgents::Count(number)) => {
                let none = scenario.start.program.code.get(number.index());
                let is_none = matches!(none, Some(Instr::Const(value)) if *value == 0.0);
                if is_none { Vec::new() } else { vec![CastTarget::Team(team)] }
            }
            Some(SideAgents::All) => vec![CastTarget::Team(team)],
            None => Vec::new(),
        }
    };
    Team::ALL.iter().flat_map(|team| of_side(*team)).collect()
}

/// The text that is read in a cast's place.
pub(super) fn source(cast: &Cast) -> Source {
    Source { name: CAST_NAME.to_owned(), text: format!("{BEFORE}{}{AFTER}", cast.ai).into() }
}

/// Reads the texts of a cast, which lie in the files `guests`.
pub(super) fn read<'a>(
    cast: &[Cast],
    guests: &[FileId],
    library: &'a Library,
    problems: &mut Vec<Problem>,
) -> Vec<Casting<'a>> {
    let mut casting = Vec::new();
    for (cast, file) in cast.iter().zip(guests) {
        match the_statement(library, *file).filter(|(_, field)| is_whole(field, cast)) {
            Some((who, field)) => casting.push(Casting { target: cast.target, who, field }),
            None if problems.iter().any(|problem| is_error_in(problem, *file)) => {}
            None => {
                let start = BEFORE.len() as u32;
                let span = Span { file: *file, start, end: start + cast.ai.len() as u32 };
                problems.push(Problem::new(span, Whole::NoSuchAi { text: cast.ai.clone() }));
            }
        }
    }
    casting
}

/// The one option of the one `each` of the one team of the one scenario, if the text has nothing
/// else.
fn the_statement(library: &Library, file: FileId) -> Option<(&Ident, &Field)> {
    let [item] = library.files.get(file.0 as usize)?.items.as_slice() else { return None };
    let ItemKind::Scenario(scenario) = &item.kind else { return None };
    let [stmt] = scenario.body.as_slice() else { return None };
    let ScenarioStmtKind::Team { body, .. } = &stmt.kind else { return None };
    let [stmt] = body.as_slice() else { return None };
    let TeamStmtKind::Each { who, fields } = &stmt.kind else { return None };
    let [field] = fields.as_slice() else { return None };
    Some((who, field))
}

/// Whether the option is all that the cast says, and not a part of it before a comment.
fn is_whole(field: &Field, cast: &Cast) -> bool {
    let end = (BEFORE.len() + cast.ai.trim_end().len()) as u32;
    match &field.value {
        FieldValue::Expr(expr) => expr.span.end == end,
        FieldValue::Script(script) => script.span.end == end,
        FieldValue::Fields(..) => false,
    }
}

fn is_error_in(problem: &Problem, file: FileId) -> bool {
    problem.is_error() && problem.place().file == file
}
