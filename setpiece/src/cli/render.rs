//! `setpiece render`: draws an episode as a sheet of frames, or one moment of it large.

use super::{FAULT, FINE, out::Out, playing::Playing};
use crate::Error;
use crate::dsl::problem::Code;
use crate::error::{FileFault, Packed};
use crate::files::{read_file, refuse_overwriting, write};
use crate::film::{FilmOptions, film, replayed};
use crate::replay::{REPLAY_MAX_BYTES, Replay};
use crate::sheet::{frame, sheet};
use clap::Args;
use std::path::PathBuf;

#[derive(Args, Debug)]
pub(crate) struct RenderArgs {
    #[command(flatten)]
    playing: Playing,
    /// Where to write the picture
    #[arg(short, long, value_name = "OUT.png")]
    output: PathBuf,
    /// The episode's index under the seed
    #[arg(short, long, value_name = "N", default_value_t = 0, allow_negative_numbers = true)]
    episode: u64,
    /// Draw one large moment: the state after this many steps, 0 for the start
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    step: Option<u32>,
}

/// Plays the episode and writes the picture.
pub(crate) fn render(args: &RenderArgs, out: &Out) -> Result<u8, Error> {
    let path = &args.output;
    if path.extension().is_none_or(|ending| !ending.eq_ignore_ascii_case("png")) {
        let message = format!("an episode is drawn as PNG, not as `{}`", path.display());
        let help = format!("name it `{}`", path.with_extension("png").display());
        out.fault(&Code::NoPicture.to_string(), &message, Some(&help));
        return Ok(FAULT);
    }
    let film = match crate::load_with(&args.playing.scenario, &out.loading()) {
        Err(Error::File { path: recorded, why: FileFault::Packed(Packed::Replay) }) => {
            refuse_overwriting(path, std::slice::from_ref(&recorded))?;
            replayed(&Replay::from_bytes(&read_file(&recorded, REPLAY_MAX_BYTES)?)?)?
        }
        loaded => {
            let loaded = loaded?;
            out.warnings(&loaded);
            refuse_overwriting(path, &loaded.inputs)?;
            let options = FilmOptions {
                seed: args.playing.seed,
                episode: args.episode,
                agent: args.playing.agent(),
                environment: args.playing.environment(&loaded)?,
                until_step: args.step,
            };
            film(&loaded.scenario, &options)?
        }
    };
    let (picture, shown) = match args.step {
        None => (sheet(&film), format!("{} steps", film.length())),
        Some(step) => {
            let length = film.length();
            let moment = film.moment_of(step).ok_or(Error::NoStep { step, length })?;
            (frame(&film, moment), format!("step {step}"))
        }
    };
    let fault = |why: String| Error::File { path: path.clone(), why: FileFault::Write(why) };
    let picture = picture.ok_or_else(|| fault("the picture is too large".to_owned()))?;
    write(path, picture.encode_png().map_err(|why| fault(why.to_string()))?)?;
    out.line(format!("{}, {} · {shown} → {}", film.name, film.origin, path.display()));
    Ok(FINE)
}
