//! `setpiece doc`: a scenario's page, and a picture of its start.

use super::common::{FAULT, FINE};
use super::out::Out;
use crate::dsl::problem::Code;
use crate::engine::batch::EpisodeError;
use crate::engine::environment::{Environment, EnvironmentOptions};
use crate::files::{refuse_overwriting, write};
use crate::render::Scene;
use crate::scene::of_match;
use crate::{Error, doc, film, picture};
use clap::Args;
use std::ffi::OsString;
use std::path::{Path, PathBuf};

#[derive(Args, Debug)]
pub(crate) struct DocArgs {
    /// A scenario of the library, a .pitch file or a compiled .pitchc file
    #[arg(value_name = "SCENARIO")]
    scenario: OsString,
    /// Where to write the page [default: standard output]
    #[arg(short, long, value_name = "OUT.md")]
    output: Option<PathBuf>,
    /// Also draw a start, as SVG
    #[arg(short, long, value_name = "OUT.svg")]
    picture: Option<PathBuf>,
    /// The seed of that start
    #[arg(short, long, value_name = "S", default_value_t = 0)]
    seed: u64,
}

/// Writes the page and the picture.
pub(crate) fn doc(args: &DocArgs, out: &Out) -> Result<u8, Error> {
    if let Some(path) =
        args.picture.as_ref().filter(|path| path.extension().is_none_or(|ending| ending != "svg"))
    {
        let message = format!("a picture is written as SVG, not as `{}`", path.display());
        let help = format!("name it `{}`", path.with_extension("svg").display());
        out.fault(&Code::NoPicture.to_string(), &message, Some(&help));
        return Ok(FAULT);
    }
    let loaded = crate::load_with(&args.scenario, &out.loading())?;
    out.warnings(&loaded);
    for path in [&args.output, &args.picture].into_iter().flatten() {
        refuse_overwriting(path, &loaded.inputs)?;
    }
    let options = EnvironmentOptions::default();
    let mut environment =
        Environment::new(loaded.scenario.clone(), options).map_err(Error::Environment)?;
    let drawn = environment.reset(Some(args.seed), Some(0)).and_then(|()| environment.start());
    let start = &drawn.map_err(|why| Error::Episode(Box::new(EpisodeError::Draw(why))))?;
    if let Some(path) = &args.picture {
        let mut scene = Scene::default();
        of_match(environment.state(), &mut scene);
        let names = film::names(&loaded.scenario);
        write(path, picture::svg(&loaded.scenario.name, &names, &scene))?;
    }
    let link = args.picture.as_deref().map(|path| linked(path, args.output.as_deref()));
    let page = doc::markdown(&loaded, start, link.as_deref());
    match &args.output {
        Some(path) => write(path, &page)?,
        None => out.text(&page),
    }
    Ok(FINE)
}

/// How a page refers to a picture: by its file name if both are in one folder.
fn linked(picture: &Path, page: Option<&Path>) -> String {
    let beside = page.is_some_and(|page| page.parent() == picture.parent());
    let name = picture.file_name().filter(|_| beside).map_or(picture.as_os_str(), |name| name);
    name.to_string_lossy().replace('\\', "/")
}
