//! `setpiece leaderboard`: agents play all against all, and are rated.

use super::agent::AgentParser;
use super::common::FINE;
use super::out::{Out, StyledText};
use super::playing::ThreadsArg;
use crate::Error;
use crate::agent::ChosenAgent;
use crate::leaderboard::{Leaderboard, LeaderboardOptions, leaderboard};
use clap::{Args, ValueEnum, builder::RangedU64ValueParser};
use std::ffi::OsString;

#[derive(Args, Debug)]
pub(crate) struct LeaderboardArgs {
    /// Who plays: two or more
    #[arg(value_name = "AGENT", required = true, num_args = 2.., value_parser = AgentParser)]
    agents: Vec<ChosenAgent>,
    /// What is played: a scenario of the library, a .pitch file or a compiled .pitchc file
    #[arg(long, value_name = "SCENARIO", default_value = "11_vs_11_kaggle")]
    scenario: OsString,
    /// Matches of a pair on each side; an even number also shares the kick-offs
    #[arg(short = 'n', long, value_name = "N", default_value_t = 10, value_parser = RangedU64ValueParser::<u32>::new().range(1..=100_000))]
    matches: u32,
    /// How many players an agent controls; the bot plays the others
    #[arg(short, long, value_name = "N", default_value_t = 1, value_parser = RangedU64ValueParser::<u32>::new().range(1..=11))]
    players: u32,
    /// The seed; the same seed gives the same matches
    #[arg(short, long, value_name = "S", default_value_t = 0, allow_negative_numbers = true)]
    seed: u64,
    #[command(flatten)]
    threads: ThreadsArg,
    /// The output format
    #[arg(long, value_enum, default_value_t = LeaderboardFormat::Text)]
    format: LeaderboardFormat,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum LeaderboardFormat {
    /// A table
    Text,
    /// One JSON object
    Json,
}

/// Plays all matches and prints the table.
pub(crate) fn leaderboard_command(args: &LeaderboardArgs, out: &Out) -> Result<u8, Error> {
    let loaded = crate::load_with(&args.scenario, &out.loading())?;
    out.warnings(&loaded);
    let options = LeaderboardOptions {
        agents: args.agents.clone(),
        matches: args.matches,
        players: args.players,
        seed: args.seed,
        threads: args.threads.count(),
    };
    let agents = args.agents.len() as u64;
    let total = agents * (agents - 1) * u64::from(args.matches);
    let bar = super::common::bar(total, "{bar:40} {pos}/{len} matches  {eta} left");
    let board = leaderboard(&loaded.scenario, &options, || bar.inc(1));
    bar.finish_and_clear();
    let board = board?;
    match args.format {
        LeaderboardFormat::Json => out.line(serde_json::to_string(&board).unwrap_or_default()),
        LeaderboardFormat::Text => text(&board, args.players, out),
    }
    Ok(FINE)
}

fn text(board: &Leaderboard, players: u32, out: &Out) {
    let width = board.agents.iter().map(|it| it.agent.chars().count()).max().unwrap_or(0).max(5);
    let matches = board.matches_per_pair;
    let each = if players == 1 { "1 player".to_owned() } else { format!("{players} players") };
    let about = format!("  {matches} matches of each pair, {each} each, seed {}", board.seed);
    out.line(StyledText::default().bold(&board.scenario).text(&about));
    out.line("");
    let head = format!("      {:width$}   Elo  95 % interval   won  drawn  lost   goals", "agent");
    out.line(StyledText::default().dim(&head));
    for (place, it) in board.agents.iter().enumerate() {
        let interval = format!("[{:.0}, {:.0}]", it.elo.low, it.elo.high);
        let goals = format!("{} : {}", it.goals[0], it.goals[1]);
        out.line(format!(
            "  {:>2}  {:width$}  {:>4.0}  {interval:13}  {:>4}  {:>5}  {:>4}   {goals}",
            place + 1,
            it.agent,
            it.elo.value,
            it.won,
            it.drawn,
            it.lost,
        ));
    }
}
