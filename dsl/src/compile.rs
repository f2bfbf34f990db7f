//! The compiler's entry: a root file in, a scenario and everything that is wrong with it out.

mod alone;
mod cast;
mod plan;
mod scripts;
mod unused;
mod uses;

use crate::ast::{File, Ident, Item, ItemKind, ScenarioItem, Span};
use crate::cast::Cast;
use crate::index::Index;
use crate::lower::alone::check_regions;
use crate::lower::loaded_scripts::LoadedScripts;
use crate::lower::mirror::Mirror;
use crate::lower::param_info::ParamInfo;
use crate::lower::people::Casting;
use crate::lower::{
    Effort, MAX_LOWERED, World, behavior, dead, ending, hidden, observation, record, reward, start,
};
use crate::origins::Origins;
use crate::parse::MAX_PROBLEMS;
use crate::problem::facts::{Chance, Whole};
use crate::problem::{Code, Guess, Problem, ScriptApi, has_errors, triage};
use crate::resolve::{Library, NamedItem, Prelude, flatten, load};
use crate::source::{FileId, Source, SourceLoader, Sources};
use setpiece_scenario::Scenario;
use setpiece_scenario::bounds::{self, Excess, Part};
use setpiece_scenario::plan::Plans;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::{Arc, Mutex};
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
    /// Whether a file may have suites, checks and curricula alone, and no scenario.
    pub plans_suffice: bool,
    /// Whether the start program also computes the regions, for [`Origins::regions`].
    pub regions: bool,
    /// Whether the facts for editors are gathered: [`CompileOutcome::index`].
    pub index: bool,
}

/// What came out.
#[derive(Clone, Debug)]
pub struct CompileOutcome {
    /// The scenario, if no problem is an error and the file has one.
    pub scenario: Option<Scenario>,
    /// The file's suites, checks and curricula, exactly when no problem is an error.
    pub plans: Option<Plans>,
    /// Where each of the checks names its agent, if it does.
    pub check_agents: Vec<Option<Span>>,
    /// Everything that was found, by file, place and code.
    pub problems: Vec<Problem>,
    /// The syntax tree of the root.
    pub tree: Option<File>,
    /// Every file that was read, in the order they were loaded.
    pub sources: Sources,
    /// The names of the files a watcher should watch, scripts included.
    pub inputs: Vec<String>,
    /// Where the parts of the scenario stand.
    pub origins: Origins,
    /// What is known of places of the text, if that was asked for.
    pub index: Index,
    /// The behaviours that the root file sees and that need no argument, by name.
    pub behaviors: Vec<String>,
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
    library.index = options.index.then(Mutex::default);
    let mut scripts = LoadedScripts::new(options.scripts);
    scripts::load(&mut library, &mut scripts, loader, &mut problems);
    let casting = cast::read(options.cast, &guests, &library, &mut problems);

    let items = library.files.first().map_or(&[][..], |file| &file.items);
    let candidates: Vec<(&ScenarioItem, &str)> = items
        .iter()
        .filter_map(|item| match &item.kind {
            ItemKind::Scenario(scenario) => Some((scenario, item.doc.as_str())),
            _ => None,
        })
        .collect();
    let has_plans = items.iter().any(|item| is_plan(&item.kind));
    let wanted = if has_plans && options.plans_suffice && options.scenario.is_none() {
        concrete(&candidates).next_back()
    } else {
        pick(&candidates, options.scenario.as_deref(), items, &library, &mut problems)
    };
    let effort = Effort::new();
    let mut compilation = Compilation {
        library: &library,
        scripts: &scripts,
        effort: &effort,
        regions: options.regions,
        lowered: BTreeMap::new(),
        played: wanted.iter().map(|item| item.name.span).collect(),
        problems,
        unused: Unused::default(),
    };
    compilation.scenarios(&candidates, wanted, &casting);
    let nothing = nothing();
    let (plans, check_agents) =
        if has_plans { compilation.plans(items, &nothing) } else { Default::default() };
    compilation.alone(items, &nothing);
    let Compilation { mut lowered, played, mut problems, unused, .. } = compilation;
    behavior::report_names(items, &mut problems);
    if options.index {
        uses::note(&library, &scripts, &Effort::new(), items);
    }
    unused.report(items, &mut problems);

    let lost = library.files.iter().flat_map(|file| &file.lost).map(String::as_str).collect();
    let mut problems = triage(problems, &library.sources, &lost);
    for (scenario, origins) in played.iter().filter_map(|name| lowered.get(name)) {
        if !has_errors(&problems) {
            problems.extend(unfit(scenario, origins));
        }
    }
    let failed = has_errors(&problems);
    let (scenario, origins) = match wanted.and_then(|item| lowered.remove(&item.name.span)) {
        Some((scenario, origins)) => ((!failed).then(|| Arc::unwrap_or_clone(scenario)), origins),
        None => (None, Origins::default()),
    };
    let plays_alone = |found: &NamedItem<'_>| match &found.item.kind {
        ItemKind::Behavior(behavior) => behavior.params.iter().all(|param| param.default.is_some()),
        _ => false,
    };
    let seen = library.visible(FileId(0)).filter(|(_, found)| plays_alone(found));
    let behaviors = seen.map(|(name, _)| name.to_owned()).collect();
    CompileOutcome {
        behaviors,
        scenario,
        plans: (!failed).then_some(plans),
        check_agents,
        index: library.index.and_then(|index| index.into_inner().ok()).unwrap_or_default(),
        problems,
        tree: library.files.into_iter().next().map(Arc::unwrap_or_clone),
        inputs: library.inputs,
        sources: library.sources,
        origins,
    }
}

/// A compilation under way.
struct Compilation<'a> {
    library: &'a Library,
    scripts: &'a LoadedScripts<'a>,
    effort: &'a Effort,
    /// Whether regions are computed.
    regions: bool,
    /// The scenarios that are compiled so far, by the place of their name.
    lowered: BTreeMap<Span, (Arc<Scenario>, Origins)>,
    /// Those that are wanted, or played by a plan.
    played: BTreeSet<Span>,
    problems: Vec<Problem>,
    unused: Unused,
}

impl<'a> Compilation<'a> {
    /// Compiles the scenarios of the root, until enough is wrong.
    fn scenarios(
        &mut self,
        candidates: &[(&'a ScenarioItem, &'a str)],
        wanted: Option<&ScenarioItem>,
        casting: &'a [Casting<'a>],
    ) {
        let parents = parents(self.library, candidates);
        for &(item, doc) in candidates {
            if item.is_abstract {
                let before = self.problems.len();
                self.one(item, doc, &[]);
                // What is missing, a child in sight may bring.
                let has_child = parents.contains(&item.name.span);
                let found = self.problems.split_off(before);
                self.problems.extend(found.into_iter().filter(|problem| {
                    let is_late = has_child && problem.fact().child_may_bring();
                    !problem.code().may_be_echo() && !is_late
                }));
            } else {
                let is_wanted = wanted.is_some_and(|wanted| std::ptr::eq(wanted, item));
                let lowered = self.one(item, doc, if is_wanted { casting } else { &[] });
                self.lowered.insert(item.name.span, lowered);
            }
            if is_enough(self.effort, item, &mut self.problems) {
                break;
            }
        }
    }

    /// Compiles the suites, checks and curricula of some items, and finds where each check names
    /// its agent; `nothing` is a scenario that says nothing.
    fn plans(
        &mut self,
        items: &'a [Item],
        nothing: &'a ScenarioItem,
    ) -> (Plans, Vec<Option<Span>>) {
        let (library, scripts, effort) = (self.library, self.scripts, self.effort);
        let flat = flatten(library, nothing, &mut Vec::new());
        let world = World::new(library, &flat, Mirror::Off, &[], scripts, effort);
        let (plans, check_agents) = plan::Planner::new(&world, &mut |item, doc, ai| {
            self.played.insert(item.name.span);
            let known = self.lowered.get(&item.name.span).map(|(scenario, _)| scenario.clone());
            let scenario = known.unwrap_or_else(|| {
                let (scenario, origins) = self.one(item, doc, &[]);
                self.lowered.insert(item.name.span, (scenario.clone(), origins));
                scenario
            });
            let Some(ai) = ai else { return scenario };
            let (who, field) = cast::as_option(ai);
            let targets = cast::of_agents(&scenario).into_iter();
            let casting: Vec<Casting<'_>> =
                targets.map(|target| Casting { target, who: &who, field: &field }).collect();
            self.one(item, doc, &casting).0
        })
        .plans(items);
        self.problems.extend(world.problems.take());
        self.unused.use_all(world.used.take());
        (plans, check_agents)
    }

    /// Compiles one scenario.
    fn one<'i>(
        &mut self,
        item: &'i ScenarioItem,
        doc: &str,
        casting: &'i [Casting<'i>],
    ) -> (Arc<Scenario>, Origins)
    where
        'a: 'i,
    {
        let mut flat = flatten(self.library, item, &mut self.problems);
        self.effort.spend(SCENARIO_EFFORT + flat.size());
        let mirror = Mirror::of(flat.mirror, &mut self.problems);
        if mirror == Mirror::Ends {
            flat.teams.swap(0, 1);
        }
        let world = World::new(self.library, &flat, mirror, casting, self.scripts, self.effort);
        let start::LoweredStart { start, mut players, agents, step, behaviors, requires, regions } =
            start::lower_start(&world, self.regions);
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
        dead::check_scenario(&world);
        dead::check_constants(&world);
        check_regions(&step);
        self.unused.declare(&world);

        let origins = Origins {
            scenario: Some(item.name.span),
            params: free(&world).map(|param| param.name.span).collect(),
            players: world.roster.iter().map(|player| player.span).collect(),
            ball: flat.ball.map(|(_, span)| span),
            rewards: reward_spans,
            endings: flat.ends.iter().map(|end| end.span).collect(),
            records: flat.records.iter().map(|record| record.name.span).collect(),
            mirror: flat.mirror.map(|word| word.span),
            observation: flat.observed.map(|(_, span)| span),
            requires,
            regions,
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
        self.problems.extend(
            world.problems.take().into_iter().map(|problem| located_in_child(&world, problem)),
        );
        self.unused.use_all(world.used.take());
        (Arc::new(scenario), origins)
    }
}

/// The scenarios that others extend, by the places of their names.
fn parents(library: &Library, all: &[(&ScenarioItem, &str)]) -> BTreeSet<Span> {
    let parent_of = |item: &ScenarioItem| {
        let name = &item.extends.as_ref()?.name;
        match &library.find(name.span.file, &name.node)?.item.kind {
            ItemKind::Scenario(parent) => Some(parent),
            _ => None,
        }
    };
    let mut parents = BTreeSet::new();
    for (item, _) in all {
        let mut at = parent_of(item);
        while let Some(parent) = at.filter(|parent| parents.insert(parent.name.span)) {
            at = parent_of(parent);
        }
    }
    parents
}

/// A scenario that says nothing.
fn nothing() -> ScenarioItem {
    let span = Span { file: FileId(0), start: 0, end: 0 };
    ScenarioItem {
        is_abstract: true,
        name: Ident { node: String::new(), span },
        params: Vec::new(),
        extends: None,
        body: Vec::new(),
    }
}

/// Why the engine wouldn't run a scenario.
fn unfit(scenario: &Scenario, origins: &Origins) -> Option<Problem> {
    if let Err(excess) = bounds::check(scenario) {
        return Some(too_costly(&scenario.name, excess, origins));
    }
    // Only a program beyond every bound gets here: what is small enough passes by construction.
    let fault = setpiece_scenario::verify::verify(scenario).err()?;
    let span = origins.scenario.unwrap_or(Span { file: FileId(0), start: 0, end: 0 });
    Some(Problem::new(span, Whole::CantRun { scenario: scenario.name.clone(), fault }))
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

/// Whether an item says something about many episodes.
fn is_plan(kind: &ItemKind) -> bool {
    matches!(kind, ItemKind::Suite(_) | ItemKind::Check(_) | ItemKind::Curriculum(_))
}

/// The scenarios of a file that can be played.
fn concrete<'a>(
    candidates: &[(&'a ScenarioItem, &str)],
) -> impl DoubleEndedIterator<Item = &'a ScenarioItem> {
    candidates.iter().map(|(item, _)| *item).filter(|item| !item.is_abstract)
}

/// The scenario that comes out: the named one, else the last that is not abstract.
fn pick<'a>(
    candidates: &[(&'a ScenarioItem, &str)],
    wanted: Option<&str>,
    items: &[Item],
    library: &Library,
    problems: &mut Vec<Problem>,
) -> Option<&'a ScenarioItem> {
    let found = match wanted {
        Some(name) => concrete(candidates).find(|item| item.name.node == name),
        None => concrete(candidates).next_back(),
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
    let names: Vec<&str> = concrete(candidates).map(|item| item.name.node.as_str()).collect();
    // The command plays suites by their names, too.
    let suites = items.iter().filter_map(|item| match &item.kind {
        ItemKind::Suite(suite) => Some(suite.name.node.as_str()),
        _ => None,
    });
    let suites: Vec<&str> = suites.collect();
    problems.push(match (wanted, candidates.first()) {
        (Some(wanted), _) if !names.is_empty() => {
            let guess = Guess::similar_or(wanted, &[&names[..], &suites].concat(), &names);
            let (wanted, suites) = (wanted.to_owned(), suites.into_iter().map(str::to_owned));
            let suites = suites.collect();
            Problem::new(start, Whole::NoSuchScenario { file, wanted, guess, suites })
        }
        (Some(wanted), None) if !suites.is_empty() => {
            let guess = Guess::similar_or_all(wanted, &suites);
            Problem::new(start, Whole::NoSuchSuite { file, wanted: wanted.to_owned(), guess })
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

/// Points from a problem in what is inherited to what the scenario itself declares and is named
/// there.
fn located_in_child<'w>(world: &World<'w>, problem: Problem) -> Problem {
    let span = problem.place();
    if !world.flat.is_inherited(span) {
        return problem;
    }
    // What disagrees with a value may be what the child declares.
    let labels = problem.words().labels;
    let texts = labels.iter().map(|label| world.library.sources.text(label.span));
    let split = |text: &'w str| text.split(|c: char| !c.is_alphanumeric() && c != '_');
    let words: Vec<&str> = texts.flat_map(split).collect();
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
    let record = |word| world.record(word).map(|record| record.name.span);
    let own = words
        .into_iter()
        .filter_map(|word| world.declaration(word).or_else(|| record(word)))
        .find(|at| world.flat.is_own(*at));
    match own {
        Some(at) => problem.declared_at(at),
        None => problem,
    }
}

/// The parameters that a match may still bind.
fn free<'a, 'w>(world: &'a World<'w>) -> impl Iterator<Item = &'a ParamInfo<'w>> {
    world.params.iter().filter(|param| param.bound.is_none())
}
