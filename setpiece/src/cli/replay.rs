//! `setpiece replay`: plays a recorded episode again, and describes or converts it.

use super::common::{FINE, USAGE};
use super::out::Out;
use crate::Error;
use crate::engine::environment::Environment;
use crate::engine::state::PlayerId;
use crate::files::read_file;
use crate::replay::{REPLAY_MAX_BYTES, Replay};
use crate::scenario::pitch::{PLAYERS_MAX, to_normalised};
use crate::scenario::{Action, Qualifier, Team};
use crate::tracking::{Tracking, TrackingForm};
use clap::error::ErrorKind;
use clap::{Args, Command, ValueEnum};
use serde_json::{Map, Value, json};
use std::path::PathBuf;

#[derive(Args, Debug)]
pub(crate) struct ReplayArgs {
    /// A recorded episode (.pitchr)
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// The output format
    #[arg(long, value_enum, default_value_t = ReplayFormat::Text)]
    format: ReplayFormat,
    /// Where the files of `cdf` and `csv` are written
    #[arg(
        short,
        long,
        value_name = "FOLDER",
        required_if_eq_any = [("format", "cdf"), ("format", "csv")]
    )]
    output: Option<PathBuf>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum ReplayFormat {
    /// In a few lines
    Text,
    /// One JSON object per line, for the start and for every step
    Jsonl,
    /// Common Data Format: tracking and events, ten frames per second; needs -o
    Cdf,
    /// Tables of tracking and events; needs -o
    Csv,
}

impl ReplayFormat {
    /// The form of the files, for a format that is one of files.
    fn form(self) -> Option<TrackingForm> {
        match self {
            ReplayFormat::Text | ReplayFormat::Jsonl => None,
            ReplayFormat::Cdf => Some(TrackingForm::Cdf),
            ReplayFormat::Csv => Some(TrackingForm::Csv),
        }
    }
}

/// Plays the episode.
pub(crate) fn replay(args: &ReplayArgs, out: &Out) -> Result<u8, Error> {
    let folder = match (&args.output, args.format.form()) {
        (Some(folder), Some(form)) => Some((folder, form)),
        (Some(_), None) => {
            let command = ReplayArgs::augment_args(Command::new("setpiece replay"));
            let why = "`-o` is for `--format cdf` and `--format csv`; this format is printed";
            let _ =
                command.bin_name("setpiece replay").error(ErrorKind::ArgumentConflict, why).print();
            return Ok(USAGE);
        }
        (None, _) => None,
    };
    let replay = Replay::from_bytes(&read_file(&args.file, REPLAY_MAX_BYTES)?)?;
    if let Some((folder, form)) = folder {
        let tracking = Tracking::of(&replay)?;
        for path in tracking.save(folder, form)? {
            out.line(path.display().to_string());
        }
        return Ok(FINE);
    }
    let as_jsonl = args.format == ReplayFormat::Jsonl;
    let environment = replay.play(|environment, actions| {
        if as_jsonl {
            out.line(moment(environment, actions).to_string());
        }
    })?;
    if !as_jsonl {
        summary(&replay, &environment, out);
    }
    Ok(FINE)
}

fn summary(replay: &Replay, environment: &Environment, out: &Out) {
    let [left, right] = environment.score();
    let outcome = environment
        .outcome()
        .map_or_else(|| "not ended".to_owned(), |outcome| outcome.label.to_string());
    out.line(format!(
        "{}  seed {}, episode {}",
        environment.scenario().name,
        replay.seed,
        replay.index
    ));
    out.line(format!("  {outcome} after {} steps, {left} : {right}", replay.length));
    for (agent, id) in environment.agent_ids().iter().enumerate() {
        let sums = environment.term_names().iter().zip(environment.term_sums(agent));
        let terms: Vec<String> = sums.map(|(name, sum)| format!("{name} {sum:+.3}")).collect();
        out.line(format!("  {id}  {}", terms.join("  ")));
    }
    out.line(format!("  digest {:016x}, as it was", replay.digest));
}

/// A moment in the world's frame: places normalised, heights in metres.
fn moment(environment: &Environment, actions: &[Action]) -> Value {
    let game = environment.state();
    let place = |x: f32, y: f32| {
        let (x, y) = to_normalised(x.into(), y.into());
        [round(x), round(y)]
    };
    let name = |id: PlayerId| environment.player_name(id);
    let mut players = Map::new();
    for id in (0..PLAYERS_MAX as u8).map(PlayerId) {
        if let (Some(name), player) = (name(id), game.player(id))
            && player.active
        {
            players.insert(name, json!(place(player.pos.x, player.pos.y)));
        }
    }
    let [x, y] = place(game.ball.pos.x, game.ball.pos.y);
    let pressed: Map<String, Value> = environment
        .agent_ids()
        .iter()
        .zip(actions)
        .map(|(id, action)| (id.clone(), json!(action.name())))
        .collect();
    let events: Vec<Value> = environment
        .events()
        .iter()
        .map(|event| {
            json!({
                "kind": event.kind.name(),
                "qualifier": event.qualifier.map(Qualifier::name),
                "team": event.team.map(Team::name),
                "by": event.by.and_then(name),
                "to": event.to.and_then(name),
                "at": place(event.at.x, event.at.y),
            })
        })
        .collect();
    json!({
        "step": environment.steps(),
        "actions": pressed,
        "rewards": if actions.is_empty() { &[] } else { environment.rewards() },
        "score": environment.score(),
        "game_mode": game.mode.name(),
        "ball": [x, y, round(game.ball.pos.z.into())],
        "owner": game.owner.and_then(name),
        "players": players,
        "events": events,
        "outcome": environment.outcome().map(|outcome| outcome.label.to_string()),
    })
}

/// Rounds a number for readers.
fn round(value: f64) -> f64 {
    (value * 1e5).round() / 1e5
}
