//! The compiler's entry: a root file in, a scenario and everything that is wrong with it out.

mod cast;
mod scripts;
mod unused;

use crate::ast::{ItemKind, ScenarioItem, Span};
use crate::cast::Cast;
use crate::lower::casting::Casting;
use crate::lower::mirror::Mirror;
use crate::lower::script::LoadedScripts;
use crate::lower::{
    Effort, MAX_LOWERED, World, behavior, ending, hidden, observation, param, record, reward, start,
};
use crate::origins::Origins;
use crate::parse::MAX_PROBLEMS;
use crate::problem::facts::{Chance, Whole};
use crate::problem::{Code, Guess, Problem, ScriptApi, has_errors, triage};
use crate::resolve::{Library, Prelude, flatten, load};
use crate::source::{FileId, Source, SourceLoader, Sources};
use setpiece_scenario::Scenario;
use setpiece_scenario::bounds::{self, Excess, Part};
use unused::Unused;

/// What a caller may choose.
#[derive(Clone, Default)]
pub struct CompileOptions<'a> {
    /// The scenario that is wanted; the file's last that is not abstract if absent.
    pub scenario: Option<String>,
    /// The prelude, where it has been read already; else the loader is asked for it.
    pub prelude: Option<&'a Prelude>,
    /// Checks scripts; without it they are embedded unread.
    pub scripts: Option<&'a dyn ScriptApi>,
    /// Who plays players, whatever the text says; of several for one player the last wins.
    pub cast: &'a [Cast],
}

/// What came out.
#[derive(Clone, Debug)]
pub struct CompileOutcome {
    /// The scenario, exactly when no problem is an error.
    pub scenario: Option<Scenario>,
    /// Everything that was found, by file, place and code.
    pub problems: Vec<Problem>,
    /// Every file that was read, in the order they were loaded.
    pub sources: Sources,
    /// The names of the files a watcher should watch, scripts included.
    pub inputs: Vec<String>,
    /// Where the parts of the scenario stand.
    pub origins: Origins,
}

/// The formations of a text that need no argument; `None` if it declares nothing at all.
pub fn parts(text: &str) -> Option<Vec<String>> {
    let source = Source { name: String::new(), text: text.into() };
    let file = crate::parse::parse(&source, FileId(0), &mut Vec::new());
    let declares = |kind: &ItemKind| !matches!(kind, ItemKind::Import { .. } | ItemKind::Broken);
    file.items.iter().any(|item| declares(&item.kind)).then(|| {
        let formation = |kind: &ItemKind| match kind {
            ItemKind::Formation(item)
                if item.params.iter().all(|param| param.default.is_some()) =>
            {
                Some(item.name.node.clone())
            }
            _ => None,
        };
        file.items.iter().filter_map(|item| formation(&item.kind)).collect()
    })
}

/// Compiles a root file and everything it imports.
///
/// Every scenario of the root that is not abstract is checked; the wanted one, or the last, comes
/// out.
#[allow(
    clippy::needless_pass_by_value,
    reason = "a caller has no more use for the root, which the outcome holds"
)]
pub fn compile(
    root: Source,
    loader: &dyn SourceLoader,
    options: &CompileOptions<'_>,
) -> CompileOutcome {
    let mut problems = Vec::new();
    let texts: Vec<Source> = options.cast.iter().map(cast::source).collect();
    let (mut library, guests) = load(&root, loader, options.prelude, &texts, &mut problems);
    let mut scripts = LoadedScripts::new(options.scripts);
    scripts::load(&mut library, &mut scripts, loader, &mut problems);
    let casting = cast::read(options.cast, &guests, &library, &mut problems);

    let mut chosen = None;
    let root_items: Vec<_> =
        library.files.first().map_or(&[][..], |file| &file.items).iter().collect();
    let mut candidates: Vec<(&ScenarioItem, &str)> = Vec::new();
    for item in root_items {
        match &item.kind {
            ItemKind::Scenario(scenario) => candidates.push((scenario, &item.doc)),
            ItemKind::Reserved { keyword } => problems.push(not_yet(&keyword.node, keyword.span)),
            _ => {}
        }
    }
    let mut unused = Unused::default();
    let wanted = pick(&candidates, options.scenario.as_deref(), &library, &mut problems);
    let effort = Effort::new();
    for (item, doc) in &candidates {
        if item.is_abstract {
            let mut found = Vec::new();
            compile_one(&library, &scripts, &[], item, doc, &effort, &mut found, &mut unused);
            // What is missing, a child may bring.
            found.retain(|problem| {
                !problem.code().may_be_echo() && problem.code() != Code::UnknownName
            });
            problems.append(&mut found);
            if is_enough(&effort, item, &mut problems) {
                break;
            }
            continue;
        }
        let is_wanted = wanted.is_some_and(|wanted| std::ptr::eq(wanted, *item));
        let casting = if is_wanted { casting.as_slice() } else { &[] };
        let lowered = compile_one(
            &library,
            &scripts,
            casting,
            item,
            doc,
            &effort,
            &mut problems,
            &mut unused,
        );
        if is_wanted {
            chosen = Some(lowered);
        }
        if is_enough(&effort, item, &mut problems) {
            break;
        }
    }

    if let Some(root) = library.files.first() {
        behavior::report_names(&root.items, &mut problems);
        unused.report(&root.items, &mut problems);
    }

    let lost = library.files.iter().flat_map(|file| &file.lost).map(String::as_str).collect();
    let mut problems = triage(problems, &library.sources, &lost);
    if let Some((scenario, origins)) = &chosen
        && !has_errors(&problems)
        && let Err(excess) = bounds::check(scenario)
    {
        problems.push(too_costly(&scenario.name, excess, origins));
    }
    if let Some((scenario, origins)) = &chosen
        && !has_errors(&problems)
        && let Err(fault) = setpiece_scenario::verify::verify(scenario)
    {
        // Only a program beyond every bound gets here: what is small enough passes by construction.
        let span = origins.scenario.unwrap_or(Span { file: FileId(0), start: 0, end: 0 });
        problems
            .push(Problem::new(span, Whole::CantRun { scenario: scenario.name.clone(), fault }));
    }
    let failed = has_errors(&problems);
    let (scenario, origins) = match chosen {
        Some((scenario, origins)) => ((!failed).then_some(scenario), origins),
        None => (None, Origins::default()),
    };
    CompileOutcome {
        scenario,
        problems,
        inputs: library.inputs.clone(),
        sources: library.sources,
        origins,
    }
}

/// What a scenario costs above its limits, reported where most of it stands.
fn too_costly(name: &str, excess: Excess, origins: &Origins) -> Problem {
    let span = match excess.part {
        Part::Reward(at) => origins.rewards.get(at).copied(),
        Part::Record(at) => origins.records.get(at).copied(),
        Part::Endings => origins.endings.first().copied(),
        Part::Observation => origins.observation,
        Part::Scenario | Part::Start | Part::Library(_) | Part::Behavior(_) => None,
    };
    let is_part = span.is_some();
    let span = span.or(origins.scenario).unwrap_or(Span { file: FileId(0), start: 0, end: 0 });
    Problem::new(span, Whole::TooCostly { scenario: name.to_owned(), excess, is_part })
}

fn not_yet(what: &str, span: Span) -> Problem {
    Problem::new(span, Whole::NotYet { keyword: what.to_owned() })
}

/// The scenario that comes out: the named one, else the last that is not abstract.
fn pick<'a>(
    candidates: &[(&'a ScenarioItem, &str)],
    wanted: Option<&str>,
    library: &Library,
    problems: &mut Vec<Problem>,
) -> Option<&'a ScenarioItem> {
    let concrete = || candidates.iter().map(|(item, _)| *item).filter(|item| !item.is_abstract);
    let found = match wanted {
        Some(name) => concrete().find(|item| item.name.node == name),
        None => concrete().next_back(),
    };
    if found.is_some() {
        return found;
    }
    // A file that can't be read at all has its report already.
    if candidates.is_empty() && has_errors(problems) {
        return None;
    }
    let start = Span { file: FileId(0), start: 0, end: 0 };
    let file = library.sources.get(FileId(0)).map_or(String::new(), |source| source.name.clone());
    let names: Vec<&str> = concrete().map(|item| item.name.node.as_str()).collect();
    problems.push(match (wanted, candidates.first()) {
        (Some(wanted), _) if !names.is_empty() => {
            let guess = Guess::similar_or_all(wanted, &names);
            Problem::new(start, Whole::NoSuchScenario { file, wanted: wanted.to_owned(), guess })
        }
        (_, Some((item, _))) => Problem::new(
            item.name.span,
            Whole::OnlyAbstract { file, first: item.name.node.clone() },
        ),
        (_, None) => Problem::new(start, Whole::NoScenario { file }),
    });
    None
}

/// What a scenario costs by itself, in expressions.
const SCENARIO_EFFORT: usize = 100;

/// A compilation that has found so many problems looks at no further scenario.
const ENOUGH_PROBLEMS: usize = 8 * MAX_PROBLEMS;

/// Whether no further scenario is looked at; reports a compilation that is larger than any may be.
fn is_enough(effort: &Effort, item: &ScenarioItem, problems: &mut Vec<Problem>) -> bool {
    if effort.is_spent() {
        problems.push(Problem::new(
            item.name.span,
            Whole::TooManyExpressions { scenario: item.name.node.clone(), most: MAX_LOWERED },
        ));
    }
    effort.is_spent() || (problems.len() > ENOUGH_PROBLEMS && has_errors(problems))
}

#[allow(
    clippy::too_many_arguments,
    reason = "what a scenario is made of, and where its findings go"
)]
fn compile_one<'a>(
    library: &'a Library,
    scripts: &'a LoadedScripts<'a>,
    casting: &'a [Casting<'a>],
    item: &'a ScenarioItem,
    doc: &'a str,
    effort: &'a Effort,
    problems: &mut Vec<Problem>,
    unused: &mut Unused,
) -> (Scenario, Origins) {
    let mut flat = flatten(library, item, problems);
    effort.spend(SCENARIO_EFFORT + flat.size());
    let mirror = Mirror::of(flat.mirror, problems);
    if mirror == Mirror::Ends {
        flat.teams.swap(0, 1);
    }
    let world = World::new(library, &flat, mirror, casting, scripts, effort);
    let start::LoweredStart { start, mut players, agents, step, behaviors, origins: requires } =
        start::lower_start(&world);
    hidden::check_scenario(&world);
    let mut rewards = Vec::new();
    let mut reward_spans = Vec::new();
    for (name, used, stmt) in &flat.rewards {
        if let Some(reward) = reward::lower_use(&step, name, used, stmt.span) {
            rewards.push(reward);
            reward_spans.push(stmt.span);
        }
    }
    let endings = ending::lower_endings(&step);
    let records = record::lower_records(&step);
    let observation = observation::lower_observation(&step);
    let library_rewards = reward::lower_library(&step);
    let behaviors = behavior::lower_behaviors(&step, &behaviors, &mut players);
    unused.declare(&world);

    let origins = Origins {
        scenario: Some(item.name.span),
        params: free(&world).map(|param| param.name.span).collect(),
        players: world.roster.iter().map(|player| player.span).collect(),
        rewards: reward_spans,
        endings: flat.ends.iter().map(|end| end.span).collect(),
        records: flat.records.iter().map(|record| record.name.span).collect(),
        observation: flat.observed.map(|(_, span)| span),
        requires,
    };
    let scenario = Scenario {
        name: item.name.node.clone(),
        doc: doc.to_owned(),
        params: free(&world).map(|param| param.param.clone()).collect(),
        scripts: world.scripts.take(),
        players,
        agents,
        start,
        rewards,
        library: library_rewards,
        endings,
        records,
        observation,
        behaviors,
    };
    problems
        .extend(world.problems.take().into_iter().map(|problem| located_in_child(&world, problem)));
    unused.use_all(world.used.take());
    (scenario, origins)
}

/// Points from a problem in what is inherited to what the scenario itself declares and is named
/// there.
fn located_in_child(world: &World<'_>, problem: Problem) -> Problem {
    let span = problem.place();
    if !world.flat.is_inherited(span) {
        return problem;
    }
    let text = world.library.sources.text(span);
    let words: Vec<&str> = text.split(|c: char| !c.is_alphanumeric() && c != '_').collect();
    // What a child hands in is what can't be drawn, not what the parent does with it.
    let mut bound = world.params.iter().filter_map(|param| Some((param.name, param.bound?)));
    if let Some((name, argument)) = bound.find(|(name, _)| words.contains(&name.node.as_str()))
        && problem.code() == Code::NotConstant
    {
        let because = Box::new(problem.fact().clone());
        return Problem::new(
            argument.span,
            Chance::ArgumentDrawn { name: name.node.clone(), because, used: span },
        );
    }
    let own = words
        .into_iter()
        .filter_map(|word| world.declaration(word))
        .find(|at| world.flat.is_own(*at));
    match own {
        Some(at) => problem.declared_at(at),
        None => problem,
    }
}

/// The parameters that a match may still bind.
fn free<'a, 'w>(world: &'a World<'w>) -> impl Iterator<Item = &'a param::ParamInfo<'w>> {
    world.params.iter().filter(|param| param.bound.is_none())
}
