//! A leaderboard: agents play all against all, and are rated by their matches.

mod elo;

pub use elo::{Elo, PairScore, elo};

use crate::agent::{ActingAgent, ChosenAgent, FittedAgent};
use crate::error::Error;
use crate::evaluate::refuse_endless;
use serde::Serialize;
use setpiece_engine::batch::{EpisodeError, Policy, run_episodes};
use setpiece_engine::digest;
use setpiece_engine::draw::{AgentsChoice, SideChoice};
use setpiece_engine::environment::{Environment, EnvironmentOptions};
use setpiece_scenario::Scenario;
use setpiece_scenario::vocabulary::{Action, Team};
use std::sync::Arc;

/// What to play.
#[derive(Clone, Debug)]
pub struct LeaderboardOptions {
    /// The agents, two or more.
    pub agents: Vec<ChosenAgent>,
    /// Matches of a pair with the first of it on the left; as many have it on the right.
    pub matches: u32,
    /// How many players an agent controls.
    pub players: u32,
    /// The seed of every match.
    pub seed: u64,
    /// Threads; the results don't depend on them.
    pub threads: usize,
}

/// Who is how good.
#[derive(Clone, Debug, Serialize)]
pub struct Leaderboard {
    /// The scenario's name.
    pub scenario: String,
    /// The seed of every match; a match's index is its place among all.
    pub seed: u64,
    /// Matches of a pair, on both sides together.
    pub matches_per_pair: u32,
    /// The agents, the best first.
    pub agents: Vec<RankedAgent>,
    /// The pairs, in the order of the agents that were given.
    pub pairs: Vec<PlayedPair>,
    /// The fingerprint of all matches' final states.
    pub digest: String,
}

/// An agent on a leaderboard.
#[derive(Clone, Debug, Serialize)]
pub struct RankedAgent {
    /// Its name; an agent that is given again is numbered: `bot (2)`.
    pub agent: String,
    /// Its rating.
    pub elo: Elo,
    /// Matches won.
    pub won: u32,
    /// Matches drawn.
    pub drawn: u32,
    /// Matches lost.
    pub lost: u32,
    /// Goals in all matches: its own, and the opponents'.
    pub goals: [u32; 2],
}

/// The matches of two agents.
#[derive(Clone, Debug, Serialize)]
pub struct PlayedPair {
    /// Their names.
    pub agents: [String; 2],
    /// What the first won, drew and lost.
    pub results: [u32; 3],
    /// Their goals.
    pub goals: [u32; 2],
}

/// A match: who is left, who is right.
#[derive(Clone, Copy, Debug)]
struct Fixture {
    /// The place of the pair.
    pair: usize,
    /// The agents' places, left and right.
    sides: [usize; 2],
    /// Whether the first agent of the pair is on the right.
    is_swapped: bool,
}

/// Every pair, first with one of it on the left, then with the other. An even number of matches
/// shares the kick-offs too: the sides take turns, match by match.
fn fixtures(agents: usize, matches: u32) -> (Vec<[usize; 2]>, Vec<Fixture>) {
    let pairs =
        (0..agents).flat_map(|first| (first + 1..agents).map(move |second| [first, second]));
    let pairs: Vec<[usize; 2]> = pairs.collect();
    let mut fixtures = Vec::new();
    for (pair, &[first, second]) in pairs.iter().enumerate() {
        for is_swapped in [false, true] {
            let sides = if is_swapped { [second, first] } else { [first, second] };
            fixtures.extend((0..matches).map(|_| Fixture { pair, sides, is_swapped }));
        }
    }
    (pairs, fixtures)
}

/// Two agents that play the match of an episode's index.
struct Opponents<'a> {
    fitted: &'a [FittedAgent],
    fixtures: &'a [Fixture],
    playing: Option<[ActingAgent; 2]>,
}

impl Policy for Opponents<'_> {
    fn begin(&mut self, environment: &Environment) {
        let fixture =
            usize::try_from(environment.index()).ok().and_then(|at| self.fixtures.get(at));
        let player = |side: usize| self.fitted.get(side).map(FittedAgent::player);
        let both = fixture.and_then(|it| Some([player(it.sides[0])?, player(it.sides[1])?]));
        self.playing = both.map(|mut both| {
            for agent in &mut both {
                agent.begin(environment);
            }
            both
        });
    }

    fn act(&mut self, environment: &Environment, agent: usize) -> Action {
        let team = environment.roster().agents.get(agent).map(|(team, _)| *team);
        match (&mut self.playing, team) {
            (Some([left, _]), Some(Team::Left)) => left.act(environment, agent),
            (Some([_, right]), Some(Team::Right)) => right.act(environment, agent),
            _ => Action::Idle,
        }
    }
}

/// Plays all matches. `after` is called after each, from any thread.
///
/// # Errors
/// [`Error::Environment`] if the scenario has too few players, [`Error::Policy`] or
/// [`Error::NoBaseline`] if an agent doesn't fit it, [`Error::Episode`] for the first match that
/// failed, [`Error::Threads`] if threads can't be started.
pub fn leaderboard(
    scenario: &Arc<Scenario>,
    options: &LeaderboardOptions,
    after: impl Fn() + Sync,
) -> Result<Leaderboard, Error> {
    refuse_endless(scenario)?;
    let side = || SideChoice::Count(options.players);
    let agents = AgentsChoice { sides: [side(), side()], fixed: None };
    let chosen = EnvironmentOptions { agents: Some(agents), ..EnvironmentOptions::default() };
    let environment = Environment::new(scenario.clone(), chosen).map_err(Error::Environment)?;
    let fitted = options.agents.iter().map(|agent| agent.fit(&environment));
    let fitted = fitted.collect::<Result<Vec<_>, _>>()?;
    let (pairs, fixtures) = fixtures(fitted.len(), options.matches);
    let (fitted, fixtures) = (&fitted[..], &fixtures[..]);
    let episodes = run_episodes(
        &environment,
        options.seed,
        0..fixtures.len() as u64,
        options.threads,
        |_| None,
        || Opponents { fitted, fixtures, playing: None },
        |_| after(),
    )
    .map_err(|why| Error::Threads(why.to_string()))?;
    let broken = |why: EpisodeError| Error::Episode(Box::new(why));
    let episodes = episodes.into_iter().collect::<Result<Vec<_>, _>>().map_err(broken)?;
    let names = names(&options.agents);
    let name = |agent: usize| names.get(agent).cloned().unwrap_or_default();
    let mut played: Vec<PlayedPair> = pairs
        .iter()
        .map(|&[first, second]| PlayedPair {
            agents: [name(first), name(second)],
            results: [0; 3],
            goals: [0; 2],
        })
        .collect();
    for (fixture, episode) in fixtures.iter().zip(&episodes) {
        let [left, right] = episode.score.map(u32::from);
        let [own, other] = if fixture.is_swapped { [right, left] } else { [left, right] };
        if let Some(pair) = played.get_mut(fixture.pair) {
            pair.goals = [pair.goals[0] + own, pair.goals[1] + other];
            pair.results[match own.cmp(&other) {
                std::cmp::Ordering::Greater => 0,
                std::cmp::Ordering::Equal => 1,
                std::cmp::Ordering::Less => 2,
            }] += 1;
        }
    }
    let digest = digest::of_all(episodes.iter().map(|episode| episode.digest));
    let scores: Vec<PairScore> = pairs
        .iter()
        .zip(&played)
        .map(|(&agents, pair)| PairScore { agents, results: pair.results })
        .collect();
    let ratings = elo(options.agents.len(), &scores);
    let mut ranked: Vec<RankedAgent> = ratings
        .into_iter()
        .enumerate()
        .map(|(at, elo)| ranked(name(at), at, elo, &pairs, &played))
        .collect();
    // Stable: of equals the first given stays first.
    ranked.sort_by(|a, b| b.elo.value.total_cmp(&a.elo.value));
    Ok(Leaderboard {
        scenario: scenario.name.clone(),
        seed: options.seed,
        matches_per_pair: 2 * options.matches,
        agents: ranked,
        pairs: played,
        digest: format!("{digest:016x}"),
    })
}

/// The agents' names; of equal ones, those behind the first have a number.
fn names(agents: &[ChosenAgent]) -> Vec<String> {
    let name = |(at, agent): (usize, &ChosenAgent)| {
        let before = agents.iter().take(at).filter(|other| other.name() == agent.name()).count();
        let name = agent.name();
        if before == 0 { name.to_owned() } else { format!("{name} ({})", before + 1) }
    };
    agents.iter().enumerate().map(name).collect()
}

/// What an agent did in all of its matches.
fn ranked(
    agent: String,
    at: usize,
    elo: Elo,
    pairs: &[[usize; 2]],
    played: &[PlayedPair],
) -> RankedAgent {
    let mut ranked = RankedAgent { agent, elo, won: 0, drawn: 0, lost: 0, goals: [0; 2] };
    for (&[first, second], pair) in pairs.iter().zip(played) {
        let ([won, drawn, lost], goals) = (pair.results, pair.goals);
        let (won, lost, goals) = if at == first {
            (won, lost, goals)
        } else if at == second {
            (lost, won, [goals[1], goals[0]])
        } else {
            continue;
        };
        ranked.won += won;
        ranked.drawn += drawn;
        ranked.lost += lost;
        ranked.goals = [ranked.goals[0] + goals[0], ranked.goals[1] + goals[1]];
    }
    ranked
}

#[cfg(test)]
mod tests {
    use super::fixtures;

    #[test]
    fn every_pair_meets_on_both_sides() {
        let (pairs, fixtures) = fixtures(3, 2);
        assert_eq!(pairs, [[0, 1], [0, 2], [1, 2]]);
        let sides: Vec<_> = fixtures.iter().map(|it| it.sides).collect();
        let twice = |a: usize, b: usize| [[a, b], [a, b], [b, a], [b, a]];
        assert_eq!(sides, [twice(0, 1), twice(0, 2), twice(1, 2)].concat());
    }
}
