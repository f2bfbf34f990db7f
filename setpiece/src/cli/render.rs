//! `setpiece render`: an episode as a video or as a sheet of frames, or one moment of it.

use super::common::{FAULT, FINE};
use super::{out::Out, playing::OneEpisode};
use crate::Error;
use crate::dsl::problem::Code;
use crate::error::{FileFault, Packed};
use crate::files::{read_file, refuse_overwriting, write};
use crate::film::{Film, FilmOptions, film, replayed};
use crate::picture;
use crate::render::{Camera, Options, PitchRegion, Renderer};
use crate::replay::{REPLAY_MAX_BYTES, Replay};
use crate::sheet::{frame, sheet};
use clap::{Args, ValueEnum};
#[cfg(feature = "video")]
use indicatif::{ProgressBar, ProgressStyle};
use std::path::PathBuf;
use tiny_skia::Pixmap;

#[derive(Args, Debug)]
pub(crate) struct RenderArgs {
    #[command(flatten)]
    one: OneEpisode,
    /// Where to write it: .mp4 or .gif for a video, .png for a sheet of frames, .svg for a moment
    #[arg(short, long, value_name = "OUT")]
    output: PathBuf,
    /// Draw one moment: the state after this many steps, 0 for the start
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    step: Option<u32>,
    /// Where a video or a moment is seen from [default: broadcast for a video]
    #[arg(long, value_enum)]
    camera: Option<CameraName>,
    /// Width and height of a video or a moment, pixels [default: 1280x720, a GIF 480x270]
    #[arg(long, value_name = "WxH", value_parser = size)]
    size: Option<(usize, usize)>,
    /// How much faster than the match a video runs
    #[arg(long, value_name = "X", default_value_t = 1.0, allow_negative_numbers = true)]
    speed: f64,
    /// The steps that a video shows [default: all]
    #[arg(long, value_name = "FROM..TO", value_parser = steps)]
    steps: Option<(u32, u32)>,
    /// How much room an MP4 takes
    #[arg(long, value_enum, default_value_t = QualityName::Medium)]
    quality: QualityName,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum CameraName {
    /// From the stand; it follows the ball
    Broadcast,
    /// The whole pitch from above
    Above,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum QualityName {
    /// The smallest files
    Low,
    /// Good for most uses
    Medium,
    /// The sharpest pictures
    High,
}

impl CameraName {
    fn camera(self) -> Camera {
        match self {
            CameraName::Broadcast => Camera::Broadcast,
            CameraName::Above => Camera::Above(PitchRegion::Whole),
        }
    }
}

fn size(text: &str) -> Result<(usize, usize), String> {
    let sides = text.split_once('x').and_then(|(width, height)| {
        Some((width.trim().parse().ok()?, height.trim().parse().ok()?))
    });
    sides.ok_or_else(|| "write it as WIDTHxHEIGHT, for example 1280x720".to_owned())
}

fn steps(text: &str) -> Result<(u32, u32), String> {
    let ends = text
        .split_once("..")
        .and_then(|(from, to)| Some((from.trim().parse().ok()?, to.trim().parse().ok()?)));
    ends.filter(|(from, to)| from <= to)
        .ok_or_else(|| "write it as FROM..TO, for example 20..80".to_owned())
}

/// What the name of the output asks for.
enum RenderTarget {
    Sheet,
    Plan,
    #[cfg(feature = "video")]
    Video(crate::video::VideoFormat),
}

impl RenderTarget {
    fn of(args: &RenderArgs) -> Option<RenderTarget> {
        let ending = args.output.extension()?.to_str()?.to_ascii_lowercase();
        #[cfg(feature = "video")]
        if let Some(format) = crate::video::VideoFormat::of_ending(&ending) {
            return Some(RenderTarget::Video(format));
        }
        match ending.as_str() {
            "png" => Some(RenderTarget::Sheet),
            "svg" => Some(RenderTarget::Plan),
            _ => None,
        }
    }
}

/// Plays the episode and writes the video or the picture.
pub(crate) fn render(args: &RenderArgs, out: &Out) -> Result<u8, Error> {
    let path = &args.output;
    let Some(wanted) = RenderTarget::of(args) else {
        let message = format!("an episode can't be drawn as `{}`", path.display());
        let [video, sheet] = ["mp4", "png"].map(|ending| path.with_extension(ending));
        let help = format!("name it `{}` or `{}`", video.display(), sheet.display());
        out.fault(&Code::NoPicture.to_string(), &message, Some(&help));
        return Ok(FAULT);
    };
    let playing = &args.one.playing;
    let film = match playing.load(out.loading()) {
        Err(Error::File { path: recorded, why: FileFault::Packed(Packed::Replay) })
            if playing.level.is_none() =>
        {
            refuse_overwriting(path, std::slice::from_ref(&recorded))?;
            replayed(&Replay::from_bytes(&read_file(&recorded, REPLAY_MAX_BYTES)?)?)?
        }
        loaded => {
            let loaded = loaded?;
            out.warnings(&loaded);
            refuse_overwriting(path, &loaded.inputs)?;
            let (seed, episode) = args.one.key();
            let options = FilmOptions {
                seed,
                episode,
                agent: playing.agent(),
                environment: playing.environment(&loaded)?,
                until_step: args.step.or(args.steps.map(|(_, to)| to)),
            };
            film(&loaded.scenario, &options)?
        }
    };
    let drawn = match wanted {
        RenderTarget::Sheet => picture_of(args, &film)?,
        RenderTarget::Plan => {
            let step = args.step.unwrap_or(0);
            let scene = &film.scenes[moment(&film, step)?];
            Ok((picture::svg(&film.name, &film.names, scene).into_bytes(), format!("step {step}")))
        }
        #[cfg(feature = "video")]
        RenderTarget::Video(format) => video_of(args, &film, format),
    };
    let (bytes, shown) = match drawn {
        Ok(drawn) => drawn,
        Err((why, help)) => {
            out.fault(&Code::NoPicture.to_string(), &why, help.as_deref());
            return Ok(FAULT);
        }
    };
    let kilobytes = bytes.len().div_ceil(1000);
    write(path, bytes)?;
    out.line(format!(
        "{}, {} · {shown} → {} ({kilobytes} kB)",
        film.name,
        film.origin,
        path.display()
    ));
    Ok(FINE)
}

/// The bytes of a file and what it shows, or what is wrong with the arguments and a help.
type DrawnFile = Result<(Vec<u8>, String), (String, Option<String>)>;

/// The index of the scene after this many steps.
fn moment(film: &Film, step: u32) -> Result<usize, Error> {
    film.moment_of(step).ok_or(Error::NoStep { step, length: film.length() })
}

/// A sheet, one large moment with its caption, or with a camera or a size the moment alone.
fn picture_of(args: &RenderArgs, film: &Film) -> Result<DrawnFile, Error> {
    let plain = args.camera.is_some() || args.size.is_some();
    let (picture, shown) = match args.step {
        None if plain => {
            let help = "draw one moment: `--step 20`, or write a video: `-o episode.mp4`";
            let why = "a sheet has its own size, and is seen from above".to_owned();
            return Ok(Err((why, Some(help.to_owned()))));
        }
        None => (sheet(film), format!("{} steps", film.length())),
        Some(step) if plain => {
            let (width, height) = args.size.unwrap_or((1280, 720));
            let camera = args.camera.unwrap_or(CameraName::Broadcast).camera();
            let mut renderer =
                match Renderer::new(width, height, Options { camera, ..Options::default() }) {
                    Ok(renderer) => renderer,
                    Err(why) => return Ok(Err((why.to_string(), None))),
                };
            let mut picture = Pixmap::new(width as u32, height as u32);
            let scene = &film.scenes[moment(film, step)?];
            if let Some(pixels) = &mut picture
                && let Err(why) = renderer.render(scene, pixels.data_mut())
            {
                return Ok(Err((why.to_string(), None)));
            }
            (picture, format!("step {step}"))
        }
        Some(step) => (frame(film, moment(film, step)?), format!("step {step}")),
    };
    let Some(picture) = picture else {
        return Ok(Err(("the picture is too large".to_owned(), None)));
    };
    Ok(match picture.encode_png() {
        Ok(bytes) => Ok((bytes, shown)),
        Err(why) => Err((why.to_string(), None)),
    })
}

/// A video, with a progress bar.
#[cfg(feature = "video")]
fn video_of(args: &RenderArgs, film: &Film, format: crate::video::VideoFormat) -> DrawnFile {
    use crate::video::{Quality, VideoError, VideoFormat, VideoOptions, video};
    if args.step.is_some() {
        let help = "`--steps 20..80` chooses a part of the episode".to_owned();
        return Err(("a video shows more than one step".to_owned(), Some(help)));
    }
    let usual = if format == VideoFormat::Gif { (480, 270) } else { (1280, 720) };
    let (from, to) = args.steps.unwrap_or((0, u32::MAX));
    let options = VideoOptions {
        size: args.size.unwrap_or(usual),
        camera: args.camera.unwrap_or(CameraName::Broadcast).camera(),
        speed: args.speed,
        steps: from..=to,
        quality: match args.quality {
            QualityName::Low => Quality::Low,
            QualityName::Medium => Quality::Medium,
            QualityName::High => Quality::High,
        },
    };
    let bar = ProgressBar::new(0);
    if let Ok(style) = ProgressStyle::with_template("{bar:30} {pos}/{len} frames  {eta}") {
        bar.set_style(style);
    }
    let mut frames = 0;
    let made = video(&film.scenes, format, &options, &mut |done, all| {
        frames = all;
        bar.set_length(all as u64);
        bar.set_position(done as u64);
    });
    bar.finish_and_clear();
    match made {
        Ok(bytes) => Ok((bytes, format!("{frames} frames"))),
        Err(why) => {
            let help = match why {
                VideoError::Odd { width, height } => {
                    let even = |side: usize| (side / 2 * 2).max(16);
                    Some(format!("write `--size {}x{}`", even(width), even(height)))
                }
                _ => None,
            };
            Err((why.to_string(), help))
        }
    }
}
