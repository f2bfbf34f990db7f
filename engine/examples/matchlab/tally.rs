//! What is counted of full matches.

use setpiece_engine::event::Events;
use setpiece_engine::state::Match;
use setpiece_scenario::vocabulary::{EventKind, GameMode, Qualifier, Role, Team};
use std::collections::BTreeMap;

#[derive(Default)]
pub(crate) struct Tally {
    matches: u32,
    steps: u32,
    goals: [u32; 2],
    wins: [u32; 3],
    counts: BTreeMap<String, u32>,
    teams: BTreeMap<String, [u32; 2]>,
    shot_m: f64,
    shot_mps: f64,
    pass_m: f64,
    crowd: f64,
    thirds: [u32; 3],
    unowned: u32,
    owned: [u32; 2],
    spells: u32,
    last: Option<Team>,
    high: u32,
    mode: u32,
    metres: f64,
    tired: f64,
    tired_keepers: f64,
}

impl Tally {
    pub(crate) fn step(&mut self, game: &Match, events: &Events) {
        self.steps += 1;
        for e in events.as_slice() {
            let mut name = e.kind.name().to_owned();
            if let Some(q) = e.qualifier {
                name = format!("{name} {q}");
            }
            *self.counts.entry(name.clone()).or_default() += 1;
            if let Some(team) = e.team {
                self.teams.entry(name).or_default()[team.index()] += 1;
            }
            if e.kind == EventKind::Shot && e.qualifier.is_none() {
                self.shot_m += f64::from(e.length_m);
                self.shot_mps += f64::from(e.speed_mps);
            }
            if e.kind == EventKind::Pass && e.qualifier == Some(Qualifier::Attempted) {
                self.pass_m += f64::from(e.length_m);
            }
        }
        let ball = game.ball.pos;
        assert!(ball.is_finite());
        let near = game
            .players
            .iter()
            .filter(|p| p.active && p.role != Role::GK && p.pos.distance(ball.truncate()) < 8.0)
            .count();
        let all = game.players.iter().filter(|p| p.active && p.role != Role::GK).count();
        self.crowd += near as f64 / all as f64;
        self.thirds[if ball.x < -18.33 {
            0
        } else if ball.x < 18.33 {
            1
        } else {
            2
        }] += 1;
        match game.owner {
            Some(id) => self.owned[id.team().index()] += 1,
            None => self.unowned += 1,
        }
        if game.possession.is_some() && game.possession != self.last {
            self.spells += 1;
            self.last = game.possession;
        }
        self.high += u32::from(ball.z > 1.0);
        self.mode += u32::from(game.mode != GameMode::Normal);
        for p in game.players.iter().filter(|p| p.active) {
            assert!(p.pos.is_finite() && p.pos.x.abs() <= 60.5 && p.pos.y.abs() <= 40.5);
            if p.role != Role::GK {
                self.metres += f64::from(p.vel.length()) * 0.1 / 20.0;
            }
        }
    }

    pub(crate) fn matched(&mut self, game: &Match) {
        self.matches += 1;
        for i in 0..2 {
            self.goals[i] += u32::from(game.score[i]);
        }
        let [l, r] = game.score;
        self.wins[if l > r {
            0
        } else if l == r {
            1
        } else {
            2
        }] += 1;
        self.last = None;
        for p in &game.players {
            if p.role == Role::GK {
                self.tired_keepers += f64::from(p.fatigue) / 2.0;
            } else {
                self.tired += f64::from(p.fatigue) / 20.0;
            }
        }
    }
}

impl std::fmt::Display for Tally {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let n = f64::from(self.matches);
        let steps = f64::from(self.steps);
        let count = |name: &str| f64::from(self.counts.get(name).copied().unwrap_or(0));
        let (attempted, done, cut) = (count("pass attempted"), count("pass completed"), count("pass intercepted"));
        let shots = count("shot");
        writeln!(
            f,
            "goals {:.2} : {:.2}   W/D/L {:?}",
            f64::from(self.goals[0]) / n,
            f64::from(self.goals[1]) / n,
            self.wins
        )?;
        writeln!(
            f,
            "passes {:.1} done {:.0}% cut {:.0}%  mean {:.1} m   shots {:.1} (goals per shot {:.2}) from {:.1} m at {:.1} m/s",
            attempted / n,
            100.0 * done / attempted,
            100.0 * cut / attempted,
            self.pass_m / attempted,
            shots / n,
            f64::from(self.goals[0] + self.goals[1]) / shots,
            self.shot_m / shots,
            self.shot_mps / shots
        )?;
        writeln!(
            f,
            "owned L {:.2} R {:.2} nobody {:.2}  spell {:.1} steps  within 8 m {:.2}  thirds {:.2}/{:.2}/{:.2}  high {:.2}  mode {:.0}  km {:.2}  tired {:.2}/{:.2}",
            f64::from(self.owned[0]) / steps,
            f64::from(self.owned[1]) / steps,
            f64::from(self.unowned) / steps,
            steps / f64::from(self.spells),
            self.crowd / steps,
            f64::from(self.thirds[0]) / steps,
            f64::from(self.thirds[1]) / steps,
            f64::from(self.thirds[2]) / steps,
            f64::from(self.high) / steps,
            f64::from(self.mode) / n,
            self.metres / n / 1000.0,
            self.tired / n,
            self.tired_keepers / n
        )?;
        for (name, times) in &self.counts {
            let teams = self.teams.get(name).copied().unwrap_or_default();
            write!(
                f,
                "{name} {:.1} ({:.1}/{:.1}); ",
                f64::from(*times) / n,
                f64::from(teams[0]) / n,
                f64::from(teams[1]) / n
            )?;
        }
        Ok(())
    }
}
