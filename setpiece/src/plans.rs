//! Loads the suites, checks and curricula of a file, and those of the library.

use crate::error::{Error, Failure};
use crate::load::{self, LoadOptions};
use crate::stdlib;
use setpiece_dsl::problem::nearest;
use setpiece_dsl::problem::{Problem, Severity};
use setpiece_dsl::source::{Source, Sources};
use setpiece_scenario::plan::{Curriculum, Plans, Suite};
use std::path::{Path, PathBuf};

/// The file of the library's suites and curricula.
const PLANS: &str = "suites.pitch";

/// What a file says about many episodes.
#[derive(Clone, Debug)]
pub struct LoadedPlans {
    /// The suites, checks and curricula.
    pub plans: Plans,
    /// Warnings of its compilation.
    pub warnings: Vec<Problem>,
    /// The files they point into.
    pub sources: Sources,
    /// The files on disk that it was loaded from.
    pub inputs: Vec<PathBuf>,
}

/// Where plans stand.
#[derive(Clone, Debug)]
pub enum PlansOf {
    /// In the library.
    Library,
    /// In a text.
    Text(String),
    /// In a `.pitch` file.
    File(PathBuf),
}

/// A curriculum by its name, which the library may have too; without a name the only one that
/// stands there.
///
/// # Errors
/// Those of [`load_plans`], and [`Error::NoPlan`].
pub fn curriculum_of(
    of: &PlansOf,
    name: Option<&str>,
    allow_outside: bool,
) -> Result<Curriculum, Error> {
    let found = plans_of(of, name, allow_outside)?.into_iter().flat_map(|plans| plans.curricula);
    only("curriculum", found.map(|it| (it.name.clone(), it)).collect(), name)
}

/// The same of a suite.
///
/// # Errors
/// Those of [`curriculum_of`].
pub fn suite_of(of: &PlansOf, name: Option<&str>, allow_outside: bool) -> Result<Suite, Error> {
    let found = plans_of(of, name, allow_outside)?.into_iter().flat_map(|plans| plans.suites);
    only("suite", found.map(|it| (it.name.clone(), it)).collect(), name)
}

/// The plans that stand somewhere; behind them those of the library, if a name may be one of it.
fn plans_of(of: &PlansOf, name: Option<&str>, allow_outside: bool) -> Result<Vec<Plans>, Error> {
    let options = LoadOptions { allow_outside, ..LoadOptions::default() };
    let mut plans = match of {
        PlansOf::Library => Vec::new(),
        PlansOf::Text(text) => {
            let source = Source { name: "<text>".to_owned(), text: text.as_str().into() };
            vec![of_source(source, &options)?.plans]
        }
        PlansOf::File(path) => vec![load_plans(path, &options)?.plans],
    };
    if name.is_some() || matches!(of, PlansOf::Library) {
        plans.push(library_plans()?);
    }
    Ok(plans)
}

/// The plan of a name, or the only one.
fn only<T>(what: &'static str, found: Vec<(String, T)>, name: Option<&str>) -> Result<T, Error> {
    let (known, mut found): (Vec<String>, Vec<T>) = found.into_iter().unzip();
    let place = match name {
        Some(name) => known.iter().position(|known| known == name),
        None => (known.len() == 1).then_some(0),
    };
    if let Some(at) = place {
        return Ok(found.swap_remove(at));
    }
    let similar = name.and_then(|name| nearest(name, known.iter().map(String::as_str)));
    let similar = similar.map(str::to_owned);
    Err(Error::NoPlan { what, name: name.map(str::to_owned), known, similar })
}

/// Loads the plans of a `.pitch` file.
///
/// # Errors
/// [`Error::File`] if it can't be read, [`Error::Compile`] if it has errors.
pub fn load_plans(path: &Path, options: &LoadOptions<'_>) -> Result<LoadedPlans, Error> {
    of_source(load::source_of(path)?, options)
}

/// Loads the plans of a text; `name` is its name in reports.
///
/// # Errors
/// [`Error::Compile`] if it has errors.
pub fn plans_of_text(text: &str, name: &str) -> Result<LoadedPlans, Error> {
    let source = Source { name: name.to_owned(), text: text.into() };
    of_source(source, &LoadOptions::default())
}

/// The suites and curricula of the library.
///
/// # Errors
/// [`Error::Compile`] if the library has errors.
pub fn library_plans() -> Result<Plans, Error> {
    let Some(source) = stdlib::file(PLANS) else { return Ok(Plans::default()) };
    Ok(of_source(source, &LoadOptions::default())?.plans)
}

fn of_source(source: Source, options: &LoadOptions<'_>) -> Result<LoadedPlans, Error> {
    let outcome = load::compiled(source, options, true);
    let inputs = load::on_disk(&outcome.inputs);
    let (problems, sources) = (outcome.problems, outcome.sources);
    match outcome.plans {
        Some(plans) => {
            let is_warning = |problem: &Problem| problem.severity() == Severity::Warning;
            let warnings = problems.into_iter().filter(is_warning).collect();
            Ok(LoadedPlans { plans, warnings, sources, inputs })
        }
        None => Err(Error::Compile(Box::new(Failure { problems, sources, inputs }))),
    }
}
