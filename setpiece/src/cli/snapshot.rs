//! `setpiece snapshot`: the state of an episode after some steps, as a file.

use super::common::FINE;
use super::{out::Out, playing::OneEpisode};
use crate::Error;
use crate::agent::ActingAgent;
use crate::engine::batch::{EpisodeError, Policy};
use crate::engine::environment::{Environment, Scratch};
use crate::files::{refuse_overwriting, write};
use crate::scenario::Action;
use clap::Args;
use std::path::PathBuf;

#[derive(Args, Debug)]
pub(crate) struct SnapshotArgs {
    #[command(flatten)]
    one: OneEpisode,
    /// Where to write it
    #[arg(short, long, value_name = "OUT.pitchs")]
    output: PathBuf,
    /// The number of steps of 0.1 s to play
    #[arg(long, value_name = "N", default_value_t = 0, allow_negative_numbers = true)]
    step: u32,
}

/// Plays to the step and writes the snapshot.
pub(crate) fn snapshot(args: &SnapshotArgs, out: &Out) -> Result<u8, Error> {
    let playing = &args.one.playing;
    let loaded = playing.load(out.loading())?;
    out.warnings(&loaded);
    refuse_overwriting(&args.output, &loaded.inputs)?;
    let options = playing.environment(&loaded)?;
    let mut environment =
        Environment::new(loaded.scenario.clone(), options).map_err(Error::Environment)?;
    let broken = |why: EpisodeError| Error::Episode(Box::new(why));
    let (seed, episode) = args.one.key();
    environment.reset(Some(seed), Some(episode)).map_err(|why| broken(why.into()))?;
    let agent = playing.agent().fit(&environment)?.player();
    play(&mut environment, agent, args.step).map_err(broken)?;
    if environment.steps() < args.step {
        return Err(Error::NoStep { step: args.step, length: environment.steps() });
    }
    let bytes = environment.snapshot().map_err(Error::Snapshot)?;
    write(&args.output, &bytes)?;
    let [left, right] = environment.score();
    let at = format!("{} at step {}, {left} : {right}", loaded.scenario.name, environment.steps());
    out.line(format!("{at} → {} ({} bytes)", args.output.display(), bytes.len()));
    Ok(FINE)
}

/// Plays to a step, or to the end of the episode.
fn play(
    environment: &mut Environment,
    mut policy: ActingAgent,
    step: u32,
) -> Result<(), EpisodeError> {
    let mut scratch = Scratch::default();
    policy.begin(environment);
    let mut actions = vec![Action::Idle; environment.n_agents()];
    while environment.is_running() && environment.steps() < step {
        for (agent, action) in actions.iter_mut().enumerate() {
            *action = policy.act(environment, agent);
        }
        environment.step(&actions, &mut scratch)?;
    }
    Ok(())
}
