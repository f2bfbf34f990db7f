//! Loads a scenario from a name, a path, a text or a compiled file.

use crate::baseline::unplayable;
use crate::error::{Error, Failure, FileFault, Packed};
use crate::files::{
    FileLoader, SOURCE_MAX_BYTES, into_text, is_compiled, most_bytes, name_of, path_of, read_file,
};
use crate::script_api::EngineScripts;
use crate::stdlib;
use setpiece_dsl::problem::{Problem, Severity, nearest};
use setpiece_dsl::source::{Source, Sources, Span};
pub use setpiece_dsl::{Cast, CastTarget};
use setpiece_dsl::{CompileOptions, CompileOutcome, Origins, Prelude, compile};
use setpiece_scenario::file::{self, binary};
use setpiece_scenario::{Bindings, Scenario, Team};
use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::sync::{Arc, OnceLock};

/// A scenario and where it came from.
#[derive(Clone, Debug)]
pub struct Loaded {
    /// The scenario.
    pub scenario: Arc<Scenario>,
    /// Warnings of its compilation.
    pub warnings: Vec<Problem>,
    /// The files they point into.
    pub sources: Sources,
    /// The place of the scenario's name; none for a compiled file.
    pub origin: Option<Span>,
    /// The places of its parts; empty for a compiled file.
    pub origins: Origins,
    /// The files on disk that it was loaded from, for a watcher.
    pub inputs: Vec<PathBuf>,
    /// The behaviours that its file sees and that need no argument; none for a compiled file.
    pub behaviors: Vec<String>,
    /// The checks of its file that can't be played; a dry run reports them.
    pub unplayable: Vec<Problem>,
}

/// A scenario of the standard library.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Entry {
    /// Its name.
    pub name: String,
    /// The first line of its documentation.
    pub title: String,
    /// Players of the left and the right team.
    pub players: [usize; 2],
}

/// The scenarios of the standard library, by name.
pub fn list() -> Vec<Entry> {
    let mut entries: Vec<Entry> = stdlib::scenarios()
        .filter_map(|(name, source)| {
            let scenario = compile_source(source, &LoadOptions::default()).ok()?.scenario;
            Some(Entry {
                name: name.to_owned(),
                title: scenario.title().to_owned(),
                players: [Team::Left, Team::Right].map(|team| scenario.team(team).count()),
            })
        })
        .collect();
    entries.sort_by(|a, b| a.name.cmp(&b.name));
    entries
}

/// Options for loading a scenario.
#[derive(Clone, Copy, Debug, Default)]
pub struct LoadOptions<'a> {
    /// The scenario that is wanted of a text; its last that isn't abstract if absent.
    pub scenario: Option<&'a str>,
    /// Replaces who plays some players, whatever the text says.
    pub cast: &'a [Cast],
    /// Whether imports and scripts may be outside the root file's folder (for a text from memory:
    /// outside the working directory). The library may always be imported.
    pub allow_outside: bool,
    /// Whether the start program also computes the regions, for `origins.regions`.
    pub regions: bool,
}

/// Loads a scenario by its name in the library, or from a `.pitch` or compiled `.pitchc` file.
///
/// # Errors
/// [`Error`], for every problem with a name, a file or its content.
pub fn load(name_or_path: impl AsRef<OsStr>) -> Result<Loaded, Error> {
    load_with(name_or_path, &LoadOptions::default())
}

/// From this length on, the beginning of a scenario's name is enough for a suggestion, bytes.
const BEGUN_LEAST: usize = 4;

/// Like [`load`], with a cast that plays players.
///
/// # Errors
/// Like [`load_with`].
pub fn load_cast(name_or_path: impl AsRef<OsStr>, cast: &[Cast]) -> Result<Loaded, Error> {
    load_with(name_or_path, &LoadOptions { cast, ..LoadOptions::default() })
}

/// Like [`load`], with options.
///
/// # Errors
/// Like [`load`], and [`Error::Cast`] for a compiled file with a cast, because such a file can't be
/// changed.
pub fn load_with(
    name_or_path: impl AsRef<OsStr>,
    options: &LoadOptions<'_>,
) -> Result<Loaded, Error> {
    let path = Path::new(name_or_path.as_ref());
    // A path that isn't Unicode must be a file: all names are Unicode.
    let Some(name_or_path) = path.to_str() else { return load_file_with(path, options) };
    if let Some(source) = stdlib::scenario(name_or_path) {
        return compile_source(source, options);
    }
    let looks_like_path = name_or_path.contains(['/', '\\'])
        || path.extension().is_some_and(|ending| ending == "pitch" || ending == "pitchc");
    if looks_like_path || path.exists() {
        return load_file_with(path, options);
    }
    // Only runnable scenarios; bases that others extend aren't useful suggestions.
    let known = list();
    let names = || known.iter().map(|entry| entry.name.as_str());
    let similar = nearest(name_or_path, names()).or_else(|| begun(name_or_path, names()));
    let similar = similar.map(str::to_owned);
    Err(Error::Unknown { name: name_or_path.to_owned(), similar })
}

/// The name whose beginning was given, with or without underscores. A typo is allowed if more than
/// one word was given, for many names begin with the same one.
fn begun<'a>(given: &str, names: impl Iterator<Item = &'a str> + Clone) -> Option<&'a str> {
    let joined = |name: &str| name.replace('_', "");
    let beginning = joined(given);
    if beginning.len() < BEGUN_LEAST {
        return None;
    }
    let words = given.split('_').count();
    let cut = |name: &str| name.split('_').take(words).collect::<Vec<_>>().join("_");
    let alike = || {
        let cuts: Vec<_> = names.clone().map(cut).collect();
        let near = nearest(given, cuts.iter().map(String::as_str).filter(|_| words > 1))?;
        names.clone().find(|name| cut(name) == near)
    };
    names.clone().find(|name| joined(name).starts_with(&beginning)).or_else(alike)
}

/// Loads a `.pitch` or a compiled file; its first bytes show which it is.
///
/// # Errors
/// Like [`load`].
pub fn load_file(path: &Path) -> Result<Loaded, Error> {
    load_file_with(path, &LoadOptions::default())
}

fn load_file_with(path: &Path, options: &LoadOptions<'_>) -> Result<Loaded, Error> {
    let compiled = is_compiled(path);
    let bytes = read_file(path, most_bytes(path))?;
    let format = |why| Error::Format { path: path.to_owned(), why };
    if binary::CONTAINER.marks(&bytes) {
        return of_file(binary::from_bytes(&bytes).map_err(format)?, path, options);
    }
    if let Some(kind) = Packed::of(&bytes) {
        return Err(Error::File { path: path.to_owned(), why: FileFault::Packed(kind) });
    }
    let text = into_text(bytes, path)?;
    if compiled || text.starts_with("{\"format\"") {
        return of_file(file::from_json(&text).map_err(format)?, path, options);
    }
    compile_source(Source { name: name_of(path), text: text.into() }, options)
}

/// A scenario from a compiled file.
fn of_file(scenario: Scenario, path: &Path, options: &LoadOptions<'_>) -> Result<Loaded, Error> {
    if let Some(cast) = options.cast.first() {
        return Err(Error::Cast { ai: cast.ai.clone() });
    }
    if let Some(wanted) = options.scenario.filter(|wanted| *wanted != scenario.name) {
        let similar = Some(scenario.name.clone());
        return Err(Error::Unknown { name: wanted.to_owned(), similar });
    }
    Ok(Loaded { inputs: vec![path.to_owned()], ..Loaded::without_text(scenario) })
}

impl Loaded {
    /// The regions of a start that has been drawn: where each is written, and its shape.
    ///
    /// They are there if they were asked for: [`LoadOptions::regions`].
    #[cfg(feature = "editor")]
    pub(crate) fn regions(
        &self,
        drawer: &setpiece_engine::draw::Drawer,
    ) -> impl Iterator<Item = (Span, setpiece_dsl::Outline<f64>)> {
        let shape = |region: &setpiece_dsl::RegionOrigin| {
            region.shape.map(&mut |reg| drawer.register(reg).unwrap_or_default()).drawn()
        };
        self.origins.regions.iter().map(move |region| (region.span, shape(region)))
    }

    /// A compiled scenario, whose text is unknown.
    pub fn without_text(scenario: impl Into<Arc<Scenario>>) -> Loaded {
        Loaded {
            scenario: scenario.into(),
            warnings: Vec::new(),
            sources: Sources::default(),
            origin: None,
            origins: Origins::default(),
            inputs: Vec::new(),
            behaviors: Vec::new(),
            unplayable: Vec::new(),
        }
    }
}

/// Compiles a text; `name` is its name in reports.
///
/// # Errors
/// [`Error::Compile`] with every report; [`Error::File`] if it is larger than a file may be.
pub fn compile_text(text: &str, name: &str) -> Result<Loaded, Error> {
    compile_text_with(text, name, &LoadOptions::default())
}

/// Like [`compile_text`], with a cast that plays players.
///
/// # Errors
/// Like [`compile_text`].
pub fn compile_text_cast(text: &str, name: &str, cast: &[Cast]) -> Result<Loaded, Error> {
    compile_text_with(text, name, &LoadOptions { cast, ..LoadOptions::default() })
}

/// Like [`compile_text`], with options.
///
/// # Errors
/// Like [`compile_text`].
pub fn compile_text_with(
    text: &str,
    name: &str,
    options: &LoadOptions<'_>,
) -> Result<Loaded, Error> {
    if text.len() as u64 > SOURCE_MAX_BYTES {
        return Err(Error::File {
            path: name.into(),
            why: FileFault::TooLarge { max: SOURCE_MAX_BYTES },
        });
    }
    compile_source(Source { name: name.to_owned(), text: text.into() }, options)
}

/// The result of a check.
#[derive(Clone, Debug)]
pub struct Checked {
    /// Errors and warnings, in order.
    pub problems: Vec<Problem>,
    /// The files they point into.
    pub sources: Sources,
    /// The files on disk that were read or looked for.
    pub inputs: Vec<PathBuf>,
}

/// Compiles a name, a path or a file only for its problems. A file of rewards or formations, which
/// has nothing to run, is checked as if a scenario used it.
///
/// # Errors
/// Like [`load`], except that problems of the text are returned, in order.
pub fn check(name_or_path: impl AsRef<OsStr>) -> Result<Checked, Error> {
    check_with(name_or_path, &LoadOptions::default())
}

/// Like [`check`], with options.
///
/// # Errors
/// Like [`check`].
pub fn check_with(
    name_or_path: impl AsRef<OsStr>,
    options: &LoadOptions<'_>,
) -> Result<Checked, Error> {
    let failure = match load_with(name_or_path, options) {
        Ok(loaded) => {
            let problems = crate::probe::probe(&loaded, None);
            return Ok(Checked { problems, sources: loaded.sources, inputs: loaded.inputs });
        }
        Err(Error::Compile(failure)) => failure,
        Err(error) => return Err(error),
    };
    let root = failure.sources.iter().next().map(|(_, source)| source.clone());
    if let Some(root) = root.clone().filter(|_| failure.lacks_scenario()) {
        let outcome = compiled(root, options, true);
        if !outcome.problems.iter().any(Problem::misses_scenario) {
            let unplayable = unplayable(&outcome);
            return Ok(Checked {
                problems: [outcome.problems, unplayable].concat(),
                sources: outcome.sources,
                inputs: failure.inputs,
            });
        }
    }
    let loader = root.as_ref().map(|root| loader(&root.name, options));
    let user = root
        .zip(loader)
        .and_then(|(root, loader)| user_of_parts(&root, &loader, &failure.problems));
    let (problems, sources) = match user {
        Some(user) => (user.problems, user.sources),
        None => (failure.problems, failure.sources),
    };
    Ok(Checked { problems, sources, inputs: failure.inputs })
}

/// Compiles what uses every part of a root that has rewards or formations alone, for the problems
/// of the parts. None if it has something else, or if more is wrong with it than that it has
/// nothing to run.
///
/// - `problems`: those of the root by itself.
pub(crate) fn user_of_parts(
    root: &Source,
    loader: &FileLoader,
    problems: &[Problem],
) -> Option<CompileOutcome> {
    let mut errors = problems.iter().filter(|problem| problem.severity() == Severity::Error);
    let only_parts = errors.all(Problem::misses_scenario);
    if !only_parts || root.name.contains('"') {
        return None;
    }
    let formations = setpiece_dsl::parts(&root.text)?;
    let mut user = format!("import \"{}\"\n", root.name);
    let teams = formations.iter().map(|name| format!("team left {{ formation: {name} }}"));
    for (index, team) in teams.chain(["team left { CM at (-0.1, 0) }".to_owned()]).enumerate() {
        user.push_str(&format!(
            "scenario part_{index} {{ ball at centre  {team}  end limit 1 step }}\n"
        ));
    }
    let source = Source { name: "<check>".to_owned(), text: user.into() };
    Some(compile(source, loader, &compile_options()))
}

/// The loader of the files that a root imports.
fn loader(root: &str, options: &LoadOptions<'_>) -> FileLoader {
    if options.allow_outside { FileLoader::anywhere() } else { FileLoader::beside(root) }
}

/// Compiles a root; `plans_suffice`: whether it may have suites and checks alone.
pub(crate) fn compiled(
    source: Source,
    options: &LoadOptions<'_>,
    plans_suffice: bool,
) -> CompileOutcome {
    let loader = loader(&source.name, options);
    let options = CompileOptions {
        scenario: options.scenario.map(str::to_owned),
        cast: options.cast,
        regions: options.regions,
        plans_suffice,
        ..compile_options()
    };
    compile(source, &loader, &options)
}

/// Those of some sources' names that are files on disk.
pub(crate) fn on_disk(names: &[String]) -> Vec<PathBuf> {
    names.iter().filter(|name| is_on_disk(name)).map(|name| path_of(name)).collect()
}

/// The text of a `.pitch` file.
pub(crate) fn source_of(path: &Path) -> Result<Source, Error> {
    let text = into_text(read_file(path, SOURCE_MAX_BYTES)?, path)?;
    Ok(Source { name: name_of(path), text: text.into() })
}

fn compile_source(source: Source, options: &LoadOptions<'_>) -> Result<Loaded, Error> {
    let outcome = compiled(source, options, false);
    let (inputs, unplayable) = (on_disk(&outcome.inputs), unplayable(&outcome));
    let (problems, sources) = (outcome.problems, outcome.sources);
    match outcome.scenario {
        Some(scenario) => Ok(Loaded {
            scenario: Arc::new(scenario),
            warnings: problems
                .into_iter()
                .filter(|problem| problem.severity() == Severity::Warning)
                .collect(),
            sources,
            origin: outcome.origins.scenario,
            origins: outcome.origins,
            inputs,
            behaviors: outcome.behaviors,
            unplayable,
        }),
        None => Err(Error::Compile(Box::new(Failure { problems, sources, inputs }))),
    }
}

/// The options of a compilation. The library's prelude is read once per process.
pub(crate) fn compile_options() -> CompileOptions<'static> {
    static PRELUDE: OnceLock<Prelude> = OnceLock::new();
    let prelude = PRELUDE.get_or_init(|| Prelude::load(&FileLoader::anywhere()));
    CompileOptions {
        scenario: None,
        prelude: Some(prelude),
        scripts: Some(&EngineScripts),
        cast: &[],
        plans_suffice: false,
        regions: false,
        index: false,
    }
}

/// Whether a source's name is a path, not in the library and not a text from memory.
fn is_on_disk(name: &str) -> bool {
    !name.starts_with("std/") && !name.starts_with('<')
}

/// Binds `name=value` pairs to a scenario's parameters. Values are written as in the language.
///
/// # Errors
/// [`Error::Param`] for the first pair that can't be bound.
pub fn bind<'a>(
    scenario: &Scenario,
    pairs: impl IntoIterator<Item = (&'a str, &'a str)>,
) -> Result<Bindings, Error> {
    let mut bindings = Bindings::defaults(&scenario.params);
    for (name, value) in pairs {
        bindings.set_text(&scenario.params, name, value).map_err(|why| Error::Param {
            similar: nearest(name, scenario.params.iter().map(|param| param.name.as_str()))
                .filter(|similar| *similar != name)
                .map(str::to_owned),
            why,
        })?;
    }
    Ok(bindings)
}
