//! Finds and loads every script, module and table that the files name.

use crate::ast::{
    BehaviorBody, BehaviorStmt, BehaviorStmtKind, DoStmt, DoWhat, EndCondition, EndStmt,
    FieldValue, GiveStmt, GiveValue, ItemKind, RewardStmt, RewardStmtKind, RewardUseKind,
    ScenarioStmtKind, ScriptRef, ScriptSource, TableItem, TableRows, TeamStmt, TeamStmtKind,
};
use crate::lower::loaded_scripts::{ImportingText, LoadedScripts};
use crate::problem::Problem;
use crate::problem::facts::Files;
use crate::resolve::Library;
use crate::source::{Source, SourceLoader};

/// Loads every script and table that a file names, so that reports can show its text.
pub(super) fn load(
    library: &mut Library,
    scripts: &mut LoadedScripts<'_>,
    loader: &dyn SourceLoader,
    problems: &mut Vec<Problem>,
) {
    let (mut named, mut tables) = (Vec::new(), Vec::new());
    for item in library.files.iter().flat_map(|file| &file.items) {
        match &item.kind {
            ItemKind::Formation(formation) => of_team(&formation.body, &mut named),
            ItemKind::Reward(reward) => of_reward(&reward.body, &mut named),
            ItemKind::Behavior(behavior) => match &behavior.body {
                BehaviorBody::Block(body) => of_behavior(body, &mut named),
                BehaviorBody::Script(script) => named.push(script),
            },
            ItemKind::Table(TableItem { rows: TableRows::File(path), .. }) => tables.push(path),
            ItemKind::Scenario(scenario) => {
                for stmt in &scenario.body {
                    match &stmt.kind {
                        ScenarioStmtKind::Reward(used) => match &used.what {
                            RewardUseKind::Script { script, .. } => named.push(script),
                            RewardUseKind::Inline { body, .. } => of_reward(body, &mut named),
                            RewardUseKind::Named(_) => {}
                        },
                        ScenarioStmtKind::End(EndStmt::When {
                            condition: Some(EndCondition::Script(script)),
                            ..
                        }) => named.push(script),
                        ScenarioStmtKind::Team { body, .. } => of_team(body, &mut named),
                        _ => {}
                    }
                }
            }
            _ => {}
        }
    }
    let named: Vec<ScriptSource> = named.into_iter().map(|script| script.source.clone()).collect();
    let of_script = |script: &'_ ScriptSource| match script {
        ScriptSource::File(path) => Some(path.clone()),
        ScriptSource::Inline(_) => None,
    };
    let files: Vec<_> =
        named.iter().filter_map(of_script).chain(tables.into_iter().cloned()).collect();
    for path in &files {
        if let Some(limit) = scripts.limit() {
            problems.push(Problem::new(path.span, Files::TooManyScripts { limit }));
            break;
        }
        let from = path.span.file;
        let from_name =
            library.sources.get(from).map_or(String::new(), |source| source.name.clone());
        let (sources, inputs) = (&mut library.sources, &mut library.inputs);
        let awaited = scripts.load(from, &from_name, &path.node, loader, &mut |source: Source| {
            if !inputs.contains(&source.name) {
                inputs.push(source.name.clone());
            }
            sources.add(source)
        });
        library.inputs.extend(awaited);
    }
    for script in &named {
        let text = match script {
            ScriptSource::Inline(text) => Some(ImportingText {
                file: text.span.file,
                start: text.span.start,
                text: text.node.as_str().into(),
            }),
            ScriptSource::File(path) => {
                let file = scripts.find(path.span.file, &path.node);
                let file = file.and_then(|found| found.as_ref().ok()).copied();
                file.and_then(|file| {
                    let text = library.sources.get(file)?.text.clone();
                    Some(ImportingText { file, start: 0, text })
                })
            }
        };
        if let Some(text) = text {
            scripts.load_modules(&text, library, loader, problems);
        }
    }
}

fn of_reward<'a>(body: &'a [RewardStmt], named: &mut Vec<&'a ScriptRef>) {
    for stmt in body {
        match &stmt.kind {
            RewardStmtKind::Give(GiveStmt { value: GiveValue::Script { script, .. }, .. }) => {
                named.push(script);
            }
            RewardStmtKind::On { body, .. } => of_reward(body, named),
            RewardStmtKind::When { then, otherwise, .. } => {
                of_reward(then, named);
                of_reward(otherwise.as_deref().unwrap_or_default(), named);
            }
            _ => {}
        }
    }
}

fn of_behavior<'a>(body: &'a [BehaviorStmt], named: &mut Vec<&'a ScriptRef>) {
    use BehaviorStmtKind as Kind;
    for stmt in body {
        match &stmt.kind {
            Kind::Do(DoStmt { what: DoWhat::Script(script), .. }) => named.push(script),
            Kind::Interrupt { body, .. } | Kind::Repeat { body, .. } => of_behavior(body, named),
            Kind::Choose(chances) => {
                for chance in chances {
                    of_behavior(&chance.body, named);
                }
            }
            Kind::If { arms, otherwise } => {
                for (_, body) in arms {
                    of_behavior(body, named);
                }
                of_behavior(otherwise, named);
            }
            _ => {}
        }
    }
}

fn of_team<'a>(body: &'a [TeamStmt], named: &mut Vec<&'a ScriptRef>) {
    for stmt in body {
        let fields = match &stmt.kind {
            TeamStmtKind::Player(player) => &player.fields,
            TeamStmtKind::Override { change, .. } => &change.fields,
            TeamStmtKind::Each { fields, .. } => fields,
            _ => continue,
        };
        for field in fields {
            if let FieldValue::Script(script) = &field.value {
                named.push(script);
            }
        }
    }
}
