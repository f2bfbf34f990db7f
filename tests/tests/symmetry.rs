//! With chance off, a match turned by 180° and played with turned actions is exactly the turned
//! match.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

use setpiece::engine::environment::Scratch;
use setpiece::engine::random::{Purpose, Stream};
use setpiece::engine::start::{Drawn, DrawnPlayer};
use setpiece::engine::state::event::{Event, Events};
use setpiece::engine::state::{Match, PlayerId};
use setpiece::engine::step;
use setpiece::scenario::vocabulary::{Action, EventKind, Team};
use setpiece_tests::environment;

/// A player's counterpart.
fn other(id: PlayerId) -> PlayerId {
    PlayerId::new(id.team().other(), id.in_team())
}

/// The start turned by 180°: each team in the other's place.
fn turned(start: &Drawn) -> Drawn {
    let player = |player: &DrawnPlayer| DrawnPlayer {
        pos: -player.pos,
        vel: -player.vel,
        kickoff: player.kickoff.map(|places| places.map(|place| -place)),
        ..player.clone()
    };
    let mut agents = start.agents.clone();
    for agent in &mut agents {
        agent.team = agent.team.other();
        agent.fixed = agent.fixed.map(other);
    }
    agents.sort_by_key(|agent| agent.team.index());
    let turn = |v: glam::Vec3| glam::Vec3::new(-v.x, -v.y, v.z);
    Drawn {
        players: std::array::from_fn(|i| start.players[(i + 11) % 22].as_ref().map(player)),
        ball_pos: turn(start.ball_pos),
        ball_vel: turn(start.ball_vel),
        ball_spin: turn(start.ball_spin),
        owner: start.owner.map(other),
        taker: start.taker.map(Team::other),
        first_kickoff: start.first_kickoff.map(Team::other),
        score: [start.score[1], start.score[0]],
        difficulty: [start.difficulty[1], start.difficulty[0]],
        agents,
        conditions: start.conditions.turned(),
        ..start.clone()
    }
}

/// Compares everything of the second match as the first would show it.
fn same(there: &Match, back: &Match) -> Result<(), String> {
    let turn = |v: glam::Vec3| glam::Vec3::new(-v.x, -v.y, v.z);
    let check = |what: &str, same: bool| if same { Ok(()) } else { Err(what.to_owned()) };
    let (a, b) = (&there.ball, &back.ball);
    check("ball", a.pos == turn(b.pos) && a.vel == turn(b.vel) && a.spin == turn(b.spin))
        .map_err(|why| format!("{why}: {a:?} / {b:?}"))?;
    for i in there.squad.ids().map(|id| id.0) {
        let id = PlayerId(i);
        let (a, b) = (there.player(id), back.player(other(id)));
        let (c, d) = (&a.body, &b.body);
        let same = a.pos == -b.pos
            && a.vel == -b.vel
            && a.active == b.active
            && a.fatigue == b.fatigue
            && a.yellow_cards == b.yellow_cards
            && c.facing == -d.facing
            && (c.pose, c.pose_ticks, c.ready_at, c.touched_at)
                == (d.pose, d.pose_ticks, d.ready_at, d.touched_at)
            && c.kick.map(|plan| {
                (
                    plan.kind,
                    plan.mate,
                    plan.gauge_ticks,
                    plan.swing.map(|swing| (swing.ready_at, swing.mate)),
                )
            }) == d.kick.map(|plan| {
                (
                    plan.kind,
                    plan.mate.map(other),
                    plan.gauge_ticks,
                    plan.swing.map(|swing| (swing.ready_at, swing.mate.map(other))),
                )
            });
        check("player", same).map_err(|why| format!("{why} {i}:\n{a:?}\n{b:?}"))?;
    }
    check("owner", there.owner == back.owner.map(other))?;
    check("last touch", there.last_touch == back.last_touch.map(other))?;
    check("possession", there.possession == back.possession.map(Team::other))?;
    check("score", there.score == [back.score[1], back.score[0]])?;
    check(
        "mode",
        (there.mode, there.dead, there.tick, there.step)
            == (back.mode, back.dead, back.tick, back.step),
    )
}

/// The kinds of events with their players.
fn facts(events: &[Event], turn: bool) -> Vec<(EventKind, Option<PlayerId>, Option<PlayerId>)> {
    let of = |id: PlayerId| if turn { other(id) } else { id };
    events.iter().map(|e| (e.kind, e.by.map(of), e.to.map(of))).collect()
}

/// Plays a start and its turned twin with the same actions, chosen at random and held for a while.
fn play(start: &Drawn, seed: u64, steps: u32, seen: &mut Vec<EventKind>) {
    let (mut there, mut back) = (step::begin(start), step::begin(&turned(start)));
    let (mut events, mut turned_events) = (Events::new(), Events::new());
    let mut scratch = Scratch::default();
    let mut stream = Stream::new(seed, 0, Purpose::Agent);
    let n = there.agents.len();
    let left = there.agents.iter().filter(|slot| slot.team == Team::Left).count();
    same(&there, &back).unwrap_or_else(|why| panic!("start of seed {seed}: {why}"));
    for step in 0..steps {
        let action = |stream: &mut Stream| Action::from_index(stream.below(20) as usize).unwrap();
        let actions: Vec<Action> = (0..n).map(|_| action(&mut stream)).collect();
        let swapped: Vec<Action> =
            actions[left..].iter().chain(&actions[..left]).copied().collect();
        events.clear();
        turned_events.clear();
        step::hand_over(&mut there);
        step::hand_over(&mut back);
        step::play(&mut there, &actions, &mut events, &mut scratch);
        step::play(&mut back, &swapped, &mut turned_events, &mut scratch);
        seen.extend(events.as_slice().iter().map(|event| event.kind));
        same(&there, &back).unwrap_or_else(|why| panic!("step {step} of seed {seed}: {why}"));
        assert_eq!(
            facts(events.as_slice(), false),
            facts(turned_events.as_slice(), true),
            "step {step} of seed {seed}"
        );
        step::go_on(&mut there);
        step::go_on(&mut back);
        same(&there, &back).unwrap_or_else(|why| panic!("after step {step} of seed {seed}: {why}"));
    }
}

/// The starts of a scenario's text, with chance off.
fn starts(text: &str, count: u64) -> Vec<Drawn> {
    let mut environment = environment(text);
    (0..count)
        .map(|seed| {
            environment.reset(Some(seed), None).unwrap();
            environment.start().unwrap()
        })
        .collect()
}

const SCRAMBLE: &str = "scenario scramble {
    let windy = uniform(0, 1) < 50%
    world { wind: if windy then polar(uniform(0m/s, 12m/s), uniform(0deg, 360deg)) else (0m/s, 0m/s) }
    rules { stochastic: off, handball: on }
    agents { left: 2, right: 1 }
    ball in pitch { velocity: (uniform(-25m/s, 25m/s), uniform(-20m/s, 20m/s))  height: uniform(0m, 6m) }
    team left { difficulty: 0.8  formation: grf_kicking }
    team right { difficulty: 0.6  formation: grf_receiving }
    end limit 400 steps
}";

const ACADEMY: &str = "scenario turned extends NAME {
    rules { stochastic: off }
    agents { left: all }
    let dx = uniform(-0.02, 0.02)
}";

#[test]
fn a_turned_match_is_the_turned_match() {
    use EventKind::{
        Corner, Foul, FreeKick, Goal, GoalKick, Header, Offside, Pass, Save, Shot, Slide, Tackle,
        ThrowIn,
    };
    let mut seen = Vec::new();
    for (seed, start) in starts(SCRAMBLE, 80).iter().enumerate() {
        play(start, seed as u64, 300, &mut seen);
    }
    for kind in [
        Corner, Foul, FreeKick, Goal, GoalKick, Header, Offside, Pass, Save, Shot, Slide, Tackle,
        ThrowIn,
    ] {
        assert!(seen.contains(&kind), "no {kind} was played");
    }
}

#[test]
fn turned_academies_are_the_turned_academies() {
    let mut seen = Vec::new();
    for name in [
        "academy_3_vs_1_with_keeper",
        "academy_corner",
        "academy_counterattack_hard",
        "academy_run_to_score_with_keeper",
        "academy_single_goal_versus_lazy",
    ] {
        for (seed, start) in starts(&ACADEMY.replace("NAME", name), 3).iter().enumerate() {
            play(start, seed as u64, 300, &mut seen);
        }
    }
}
