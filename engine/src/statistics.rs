//! Figures of a match that tell football from a scramble.
//!
//! Computed from the state and the events of every step, before restarts.

use crate::state::event::Event;
use crate::state::{Match, PlayerId};
use setpiece_scenario::pitch::{PLAYERS_MAX, STEPS_PER_S};
use setpiece_scenario::vocabulary::{EventKind, PitchMeasure, Qualifier, Role, Team};

/// Players nearer than this to the ball crowd it.
const CROWD_M: f32 = 8.0;
/// No player runs further in a step; a longer way was a placement.
const RUN_MAX_M: f32 = 1.5;

/// Figures of one team.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct TeamStatistics {
    /// Passes struck.
    pub passes_attempted: u32,
    /// Passes that a teammate received.
    pub passes_completed: u32,
    /// Shots struck.
    pub shots: u32,
    /// Shots on target.
    pub shots_on_target: u32,
    /// Goals.
    pub goals: u32,
    /// Standing tackles that won the ball.
    pub tackles: u32,
    /// Interceptions.
    pub interceptions: u32,
    /// Fouls.
    pub fouls: u32,
    /// Offsides.
    pub offsides: u32,
    /// Yellow cards.
    pub yellow_cards: u32,
    /// Red cards.
    pub red_cards: u32,
    /// Throw-ins awarded.
    pub throw_ins: u32,
    /// Corners awarded.
    pub corners: u32,
    /// Goal kicks awarded.
    pub goal_kicks: u32,
    /// Free kicks awarded.
    pub free_kicks: u32,
    /// Penalties awarded.
    pub penalties: u32,
    /// Metres run by all its players.
    pub distance_m: f64,
    /// Steps in which the team had the ball last.
    pub possession_steps: u32,
}

/// Figures of a match, counted as it is played.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Statistics {
    teams: [TeamStatistics; 2],
    steps: u32,
    /// Steps in which nobody had the ball.
    loose_steps: u32,
    /// Spells of possession that began.
    spells: u32,
    possession: Option<Team>,
    /// Share of the outfield near the ball, summed over steps.
    crowd_sum: f64,
    /// Steps with the ball in the left, middle and right third.
    thirds: [u32; 3],
    positions: [[f32; 2]; PLAYERS_MAX],
}

impl Default for Statistics {
    fn default() -> Statistics {
        Statistics {
            teams: [TeamStatistics::default(); 2],
            steps: 0,
            loose_steps: 0,
            spells: 0,
            possession: None,
            crowd_sum: 0.0,
            thirds: [0; 3],
            positions: [[0.0; 2]; PLAYERS_MAX],
        }
    }
}

/// The final figures of one match.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize)]
pub struct MatchStatistics {
    /// Left and right.
    pub teams: [TeamStatistics; 2],
    /// Steps played.
    pub steps: u32,
    /// Passes struck by both.
    pub passes: u32,
    /// Share of them that were completed; 0 without passes.
    pub pass_completion: f64,
    /// Shots by both.
    pub shots: u32,
    /// Goals by both.
    pub goals: u32,
    /// Spells of possession.
    pub spells: u32,
    /// Mean steps until the other team has the ball.
    pub possession_spell: f64,
    /// Share of the steps in which nobody has the ball.
    pub nobody_owns: f64,
    /// Share of the outfield players within 8 m of the ball, on average.
    pub crowding: f64,
    /// Share of the steps with the ball in the left, middle and right third.
    pub thirds: [f64; 3],
}

impl Statistics {
    /// Starts counting a match.
    pub fn begin(game: &Match) -> Statistics {
        Statistics {
            positions: game.players.each_ref().map(|player| player.pos.into()),
            possession: game.possession,
            spells: game.possession.is_some().into(),
            ..Statistics::default()
        }
    }

    /// Counts a step: the state before any restart, and its events.
    pub fn observe(&mut self, game: &Match, events: &[Event]) {
        self.steps += 1;
        for event in events {
            self.count(event);
        }
        self.loose_steps += u32::from(game.owner.is_none());
        if let Some(team) = game.possession {
            self.teams[team.index()].possession_steps += 1;
            if self.possession != Some(team) {
                self.spells += 1;
            }
            self.possession = Some(team);
        }
        let ball = game.ball.pos.truncate();
        let third = game.pitch.measure(PitchMeasure::HalfMiddle) as f32;
        self.thirds[usize::from(ball.x > -third) + usize::from(ball.x > third)] += 1;
        let (mut outfield, mut near) = (0u32, 0u32);
        for (id, player) in
            game.squad.ids().map(|id| (id, game.player(id))).filter(|(_, player)| player.active)
        {
            if player.role != Role::GK {
                outfield += 1;
                near += u32::from(player.pos.distance(ball) < CROWD_M);
            }
            let ran = player.pos.distance(self.positions[id.index()].into());
            if ran <= RUN_MAX_M {
                self.teams[id.team().index()].distance_m += f64::from(ran);
            }
            self.positions[id.index()] = player.pos.into();
        }
        if outfield > 0 {
            self.crowd_sum += f64::from(near) / f64::from(outfield);
        }
    }

    fn count(&mut self, event: &Event) {
        let Some(team) = event.team.or(event.by.map(PlayerId::team)) else { return };
        let own = &mut self.teams[team.index()];
        let counter = match (event.kind, event.qualifier) {
            (EventKind::Pass, Some(Qualifier::Attempted)) => &mut own.passes_attempted,
            (EventKind::Pass, Some(Qualifier::Completed)) => &mut own.passes_completed,
            (EventKind::Shot, None) => &mut own.shots,
            (EventKind::Shot, Some(Qualifier::OnTarget)) => &mut own.shots_on_target,
            (EventKind::Goal, _) => &mut own.goals,
            (EventKind::Tackle, _) => &mut own.tackles,
            (EventKind::Interception, _) => &mut own.interceptions,
            (EventKind::Foul, _) => &mut own.fouls,
            (EventKind::Offside, _) => &mut own.offsides,
            (EventKind::YellowCard, _) => &mut own.yellow_cards,
            (EventKind::RedCard, _) => &mut own.red_cards,
            (EventKind::ThrowIn, None) => &mut own.throw_ins,
            (EventKind::Corner, None) => &mut own.corners,
            (EventKind::GoalKick, None) => &mut own.goal_kicks,
            (EventKind::FreeKick, None) => &mut own.free_kicks,
            (EventKind::Penalty, None) => &mut own.penalties,
            _ => return,
        };
        *counter += 1;
    }

    /// The figures so far.
    pub fn summary(&self) -> MatchStatistics {
        let both = |of: fn(&TeamStatistics) -> u32| self.teams.iter().map(of).sum::<u32>();
        let share = |part: f64, of: u32| if of == 0 { 0.0 } else { part / f64::from(of) };
        let passes = both(|team| team.passes_attempted);
        let possession = both(|team| team.possession_steps);
        MatchStatistics {
            teams: self.teams,
            steps: self.steps,
            passes,
            pass_completion: share(both(|team| team.passes_completed).into(), passes),
            shots: both(|team| team.shots),
            goals: both(|team| team.goals),
            spells: self.spells,
            possession_spell: share(possession.into(), self.spells),
            nobody_owns: share(self.loose_steps.into(), self.steps),
            crowding: share(self.crowd_sum, self.steps),
            thirds: self.thirds.map(|steps| share(steps.into(), self.steps)),
        }
    }
}

impl MatchStatistics {
    /// The average figures of several matches, without the teams' counts, which wouldn't be whole.
    pub fn mean(of: &[MatchStatistics]) -> MatchMeans {
        let n = of.len().max(1) as f64;
        // An empty sum of floats is -0.
        let mean =
            |figure: &dyn Fn(&MatchStatistics) -> f64| of.iter().map(figure).sum::<f64>() / n + 0.0;
        let team = |side: usize, figure: fn(&TeamStatistics) -> u32| {
            mean(&|m| f64::from(figure(&m.teams[side])))
        };
        let sides = |figure: fn(&TeamStatistics) -> u32| [team(0, figure), team(1, figure)];
        let minutes = |m: &MatchStatistics| f64::from(m.steps) / STEPS_PER_S;
        MatchMeans {
            matches: of.len() as u32,
            seconds: mean(&minutes),
            passes: mean(&|m| m.passes.into()),
            pass_completion: {
                let completed: f64 =
                    mean(&|m| m.teams.iter().map(|team| f64::from(team.passes_completed)).sum());
                let attempted = mean(&|m| m.passes.into());
                if attempted > 0.0 { completed / attempted } else { 0.0 }
            },
            shots: mean(&|m| m.shots.into()),
            goals: mean(&|m| m.goals.into()),
            possession_spell: mean(&|m| m.possession_spell),
            nobody_owns: mean(&|m| m.nobody_owns),
            crowding: mean(&|m| m.crowding),
            thirds: std::array::from_fn(|i| mean(&|m| m.thirds[i])),
            passes_by_team: sides(|t| t.passes_attempted),
            shots_by_team: sides(|t| t.shots),
            fouls: sides(|t| t.fouls),
            offsides: sides(|t| t.offsides),
            cards: sides(|t| t.yellow_cards + t.red_cards),
            throw_ins: sides(|t| t.throw_ins),
            corners: sides(|t| t.corners),
            goal_kicks: sides(|t| t.goal_kicks),
            free_kicks: sides(|t| t.free_kicks),
            penalties: sides(|t| t.penalties),
            distance_m: std::array::from_fn(|i| mean(&|m| m.teams[i].distance_m)),
        }
    }
}

/// Figures per match, averaged over several: what `match_stats` shows.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize)]
pub struct MatchMeans {
    /// How many matches.
    pub matches: u32,
    /// Their length, seconds.
    pub seconds: f64,
    /// Passes struck by both.
    pub passes: f64,
    /// Share of all passes that were completed.
    pub pass_completion: f64,
    /// Shots by both.
    pub shots: f64,
    /// Goals by both.
    pub goals: f64,
    /// Steps until the other team has the ball.
    pub possession_spell: f64,
    /// Share of the steps in which nobody has the ball.
    pub nobody_owns: f64,
    /// Share of the outfield players within 8 m of the ball.
    pub crowding: f64,
    /// Share of the steps with the ball in the left, middle and right third.
    pub thirds: [f64; 3],
    /// Passes struck, left and right.
    pub passes_by_team: [f64; 2],
    /// Shots, left and right.
    pub shots_by_team: [f64; 2],
    /// Fouls, left and right.
    pub fouls: [f64; 2],
    /// Offsides, left and right.
    pub offsides: [f64; 2],
    /// Cards, left and right.
    pub cards: [f64; 2],
    /// Throw-ins awarded, left and right.
    pub throw_ins: [f64; 2],
    /// Corners awarded, left and right.
    pub corners: [f64; 2],
    /// Goal kicks awarded, left and right.
    pub goal_kicks: [f64; 2],
    /// Free kicks awarded, left and right.
    pub free_kicks: [f64; 2],
    /// Penalties awarded, left and right.
    pub penalties: [f64; 2],
    /// Metres run by all players of a team, left and right.
    pub distance_m: [f64; 2],
}
