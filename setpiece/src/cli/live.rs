//! `setpiece run --live`: episodes in the terminal, at the pace of the match.

use super::common::FINE;
use super::out::{Out, StyledText};
use crate::drawing::drawn;
use crate::engine::batch::{EpisodeError, Policy, STEPS_MAX};
use crate::engine::environment::{Environment, Scratch};
use crate::run::RunOptions;
use crate::scenario::pitch::STEPS_PER_S;
use crate::scenario::{Action, Scenario};
use crate::{Error, Loaded};
use std::sync::Arc;
use std::time::{Duration, Instant};

/// The time of a step.
const STEP: Duration = Duration::from_millis(100);
/// The lines of a frame: the pitch with its border, and two of text.
const LINES: usize = 23;
/// The width of the lines of text, that of the pitch with its border.
const WIDTH: usize = 69;
/// How long the end of an episode stays.
const END: Duration = Duration::from_secs(1);

/// Plays every episode before the user's eyes.
pub(crate) fn live(loaded: &Loaded, options: &RunOptions, out: &Out) -> Result<u8, Error> {
    let scenario: &Arc<Scenario> = &loaded.scenario;
    let fault = |why| Error::Episode(Box::new(why));
    let mut environment = Environment::new(scenario.clone(), options.environment.clone())
        .map_err(Error::Environment)?;
    let mut policy = options.agent.fit(&environment)?.player();
    let mut scratch = Scratch::default();
    let mut actions = vec![Action::Idle; environment.n_agents()];
    let mut again = false;
    for episode in options.episodes.clone() {
        environment
            .reset(Some(options.seed), Some(episode))
            .map_err(|why| fault(EpisodeError::Draw(why)))?;
        policy.begin(&environment);
        let mut due = Instant::now();
        show(&environment, episode, again, out);
        again = true;
        while environment.is_running() {
            for (agent, action) in actions.iter_mut().enumerate() {
                *action = policy.act(&environment, agent);
            }
            environment
                .step(&actions, &mut scratch)
                .map_err(|why| fault(EpisodeError::Step(why)))?;
            due += STEP;
            std::thread::sleep(due.saturating_duration_since(Instant::now()));
            show(&environment, episode, true, out);
            if environment.is_running() && environment.steps() >= STEPS_MAX {
                return Err(fault(EpisodeError::Endless(STEPS_MAX)));
            }
        }
        std::thread::sleep(END);
    }
    Ok(FINE)
}

/// Draws the present over the last frame; where nobody watches, below it.
fn show(environment: &Environment, episode: u64, over: bool, out: &Out) {
    if over {
        out.up(LINES);
    }
    let pitch = drawn(environment.judged_state()).into_iter();
    out.line(
        pitch.fold(StyledText::default(), |text, (sign, paint)| {
            text.paint(&sign.to_string(), paint)
        }),
    );
    let [left, right] = environment.score();
    let seconds = f64::from(environment.steps()) / STEPS_PER_S;
    let end = environment.outcome().map_or(String::new(), |outcome| format!("  {}", outcome.label));
    out.line(padded(&format!("  episode {episode}  {seconds:.1} s  {left} : {right}{end}")));
    let paid = environment.term_names().iter().zip(environment.term_sums(0));
    let paid: Vec<String> = paid.map(|(name, sum)| format!("{sum:+.3} {name}")).collect();
    out.line(padded(&format!("  {}", paid.join("  "))));
}

/// A line that covers the one below it, and never breaks.
fn padded(text: &str) -> String {
    let short: String = text.chars().take(WIDTH).collect();
    format!("{short:WIDTH$}")
}
