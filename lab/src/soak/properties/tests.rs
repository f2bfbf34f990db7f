//! Every property can fail: takes a valid step and spoils it in one way after the other.

use super::*;
use crate::pitch::text;
use glam::{Vec2, Vec3};
use setpiece::engine::environment::Environment;
use setpiece::engine::physics::lines::out_x;
use setpiece::engine::state::PlayerId;
use setpiece::engine::state::player::Pose;
use setpiece::scenario::PitchSize;
use setpiece::scenario::vocabulary::{Qualifier, Role, Rule, Team};

const MATCH: &str = "scenario held {
    rules { half_time: 500 steps }
    agents { left: 2, right: 1 }
    kickoff left { kicking: grf_kicking, receiving: grf_receiving }
    team left { difficulty: 0.9 }
    team right { difficulty: 0.4 }
    end limit 1000 steps
}";

/// A recorded step, with the state before it.
#[derive(Clone)]
struct Taken {
    before: Match,
    actions: Vec<Action>,
    judged: Match,
    after: Match,
    events: Vec<Event>,
}

impl Taken {
    fn hold(&self) -> Result<(), LabError> {
        let mut witness = Witness {
            before: self.before.clone(),
            film: TickMemory::default(),
            waiting: Waiting::default(),
        };
        let step = Step {
            actions: &self.actions,
            judged: &self.judged,
            after: &self.after,
            events: &self.events,
        };
        witness.see(&step, &mut Scratch::default()).map(|_| ())
    }

    /// The judged state and the state after it.
    fn states(&mut self) -> [&mut Match; 2] {
        [&mut self.judged, &mut self.after]
    }
}

/// Some steps of a match.
fn steps(episode: u64) -> Vec<Taken> {
    let mut environment: Environment = text(MATCH).unwrap();
    environment.reset(Some(1), Some(episode)).unwrap();
    let mut scratch = Scratch::default();
    let mut steps = Vec::new();
    while environment.is_running() {
        let before = environment.state().clone();
        let actions = vec![Action::BuiltinAi; environment.n_agents()];
        environment.step(&actions, &mut scratch).unwrap();
        let (judged, after) = (environment.judged_state().clone(), environment.state().clone());
        steps.push(Taken { before, actions, judged, after, events: environment.events().to_vec() });
    }
    steps
}

/// A step of open play without events.
fn open(steps: &[Taken]) -> Taken {
    // The wrong values are those of players 3 and 9: no agent may control player 3, and neither may
    // have the ball.
    let quiet = |step: &&Taken| {
        let free = step.after.agents.iter().all(|agent| agent.player != Some(PlayerId(3)))
            && [3, 9].iter().all(|id| step.after.owner != Some(PlayerId(*id)));
        step.events.is_empty() && step.after.play.set_piece.is_none() && !step.judged.dead && free
    };
    steps.iter().filter(quiet).nth(40).unwrap().clone()
}

/// A step that an event stopped.
fn stopped(steps: &[Taken], kind: EventKind) -> Taken {
    let stops = |step: &&Taken| {
        step.events.iter().any(|event| event.kind == kind && event.qualifier.is_none())
    };
    steps.iter().find(stops).unwrap_or_else(|| panic!("no {kind:?}")).clone()
}

/// Spoils a step in one way; the report must contain these words.
fn spoilt(step: &Taken, words: &str, spoil: impl FnOnce(&mut Taken)) {
    step.hold().unwrap();
    let mut step = step.clone();
    spoil(&mut step);
    let why = step.hold().err().unwrap_or_else(|| panic!("nothing is said of what is `{words}`"));
    assert!(why.contains(words), "`{words}` is missing in: {why}");
}

#[test]
fn a_ball_or_a_player_that_can_not_be_is_seen() {
    let step = open(&steps(0));
    spoilt(&step, "the ball: ", |step| step.judged.ball.vel.x = f32::NAN);
    spoilt(&step, "in the ground", |step| step.judged.ball.pos.z = 0.05);
    spoilt(&step, "too fast", |step| step.judged.ball.vel = Vec3::X * 80.0);
    spoilt(&step, "play goes on", |step| step.judged.ball.pos.y = 37.0);
    spoilt(&step, "player 3: ", |step| step.judged.players[3].vel.y = f32::INFINITY);
    spoilt(&step, "is lost", |step| step.judged.players[3].pos.y = 41.0);
    spoilt(&step, "too fast", |step| step.judged.players[3].vel = Vec2::X * 13.0);
    spoilt(&step, "is tired by", |step| step.judged.players[3].fatigue = 1.1);
    spoilt(&step, "faces nowhere", |step| step.judged.players[3].body.facing = Vec2::ZERO);
    spoilt(&step, "holds the ball", |step| step.judged.play.hands = Some((PlayerId(4), 0)));
    spoilt(&step, "two agents", |step| {
        for game in step.states() {
            game.agents[1].player = game.agents[0].player;
        }
    });
    spoilt(&step, "must not have", |step| step.after.agents[0].player = Some(PlayerId(15)));
    spoilt(&step, "has nobody", |step| {
        for game in step.states() {
            game.agents[0].player = None;
        }
    });
    spoilt(&step, "has become another", |step| step.before.agents[0].team = Team::Right);
}

#[test]
fn what_goes_through_something_is_seen() {
    let step = open(&steps(0));
    spoilt(&step, "went another way", |step| step.judged.ball.pos.x += 0.01);
    spoilt(&step, "player 5 went another way", |step| step.judged.players[5].pos.x += 0.01);
    let film = |was: &Match, now: &Match| TickMemory::default().tick(was, now);
    let (free, ball) = (step.before.clone(), |game: &Match, at: Vec3, vel: Vec3| {
        let mut game = game.clone();
        (game.ball.pos, game.ball.vel) = (at, vel);
        game
    });
    let fly = |from: Vec3, to: Vec3| {
        let vel = (to - from) * 100.0;
        film(&ball(&free, from, vel), &ball(&free, to, vel)).err().unwrap_or_default()
    };
    for side in [1.0, -1.0] {
        let at = |x: f32, y: f32, z: f32| Vec3::new(x * side, y * side, z);
        assert_eq!(
            fly(at(54.8, 0.0, 1.0), at(55.1, 0.0, 1.0)),
            "",
            "through the mouth, not yet over the line"
        );
        assert_eq!(
            fly(at(54.8, 0.0, 1.0), at(out_x(&PitchSize::USUAL), 0.0, 1.0)),
            "",
            "on the line to the last hair"
        );
        assert!(fly(at(54.8, 3.7, 1.0), at(55.2, 3.7, 1.0)).contains("frame"), "through a post");
        assert!(fly(at(54.8, 1.0, 2.5), at(55.2, 1.0, 2.5)).contains("frame"), "through the bar");
        assert!(fly(at(55.1, 3.95, 1.0), at(55.4, 3.7, 1.0)).contains("net"), "in the side net");
        assert!(
            fly(at(55.16, 4.0, 1.0), at(55.5, 3.4, 1.0)).contains("in the goal"),
            "through the side net"
        );
        assert!(
            fly(at(55.16, 0.0, 2.8), at(55.5, 0.0, 2.2)).contains("in the goal"),
            "through the top net"
        );
    }
    let jump =
        film(&ball(&free, Vec3::Z, Vec3::X), &ball(&free, Vec3::Z + Vec3::X, Vec3::X)).unwrap_err();
    assert!(jump.contains("the ball has jumped"), "{jump}");
    let scored = |from: Vec3, to: Vec3| {
        let vel = (to - from) * 100.0;
        let mut now = ball(&free, to, vel);
        now.score[0] += 1;
        film(&ball(&free, from, vel), &now).err().unwrap_or_default()
    };
    assert_eq!(scored(Vec3::new(55.0, 3.0, 1.0), Vec3::new(55.3, 3.0, 1.0)), "");
    assert!(scored(Vec3::new(55.1, 3.68, 1.0), Vec3::new(55.4, 3.5, 1.0)).contains("a goal from"));
    assert!(scored(Vec3::new(55.0, 3.0, 2.6), Vec3::new(55.3, 3.0, 2.4)).contains("a goal from"));
    assert!(scored(Vec3::new(50.0, 3.0, 1.0), Vec3::new(50.3, 3.0, 1.0)).contains("a goal from"));

    let moved = |game: &Match, i: usize, at: Vec2| {
        let mut game = game.clone();
        game.players[i].pos = at;
        game.players[i].body.pose = Pose::Up;
        game
    };
    let run = |from: Vec2, to: Vec2| {
        film(&moved(&free, 7, from), &moved(&free, 7, to)).err().unwrap_or_default()
    };
    assert!(run(Vec2::new(20.0, 39.0), Vec2::new(20.3, 39.0)).contains("has jumped"));
    assert_eq!(run(Vec2::new(56.0, 4.2), Vec2::new(56.0, 4.1)), "");
    assert!(run(Vec2::new(56.0, 3.95), Vec2::new(56.0, 3.85)).contains("into a net"));
    assert!(run(Vec2::new(-57.5, 0.0), Vec2::new(-57.6, 0.0)).contains("into a net"));

    let pair = |there: Vec2, back: Vec2| {
        let at = |game: &Match, way: Vec2| {
            moved(&moved(game, 7, Vec2::new(30.0, 38.0)), 8, Vec2::new(30.0, 38.0) + way)
        };
        let mut film = TickMemory::default();
        film.pair(&at(&free, there), &at(&free, there), 7, 8).unwrap();
        film.pair(&at(&free, there), &at(&free, back), 7, 8).is_ok()
    };
    assert!(pair(Vec2::X, Vec2::X * 0.5), "they meet");
    assert!(pair(Vec2::X, Vec2::X * 0.05), "pressed into each other");
    assert!(!pair(Vec2::X, Vec2::X * -0.5), "through each other");
    assert!(pair(Vec2::X * 0.06, Vec2::X * 0.05), "placed in each other");

    let mut kick_off = free.clone();
    kick_off.play.kick_off = Some(Team::Left);
    let inside = moved(&kick_off, 18, Vec2::new(3.0, 0.0));
    assert!(film(&inside, &inside).unwrap_err().contains("in the circle"));
}

#[test]
fn a_clock_that_is_wrong_is_seen() {
    let all = steps(0);
    let step = open(&all);
    spoilt(&step, "follows", |step| step.judged.step += 1);
    spoilt(&step, "ticks", |step| step.judged.tick -= 1);
    spoilt(&step, "took time", |step| step.after.tick += 1);
    spoilt(&step, "half-time without", |step| {
        step.states().into_iter().for_each(|game| game.play.second_half = true);
    });
    spoilt(&step, "half-time is late", |step| {
        step.states().into_iter().for_each(|game| game.rules[Rule::HalfTime.index()] = 1.0);
    });
    spoilt(&step, "full time", |step| step.judged.limit_steps = Some(1));
    let half = stopped(&all, EventKind::HalfTime);
    spoilt(&half, "too early", |step| {
        step.states().into_iter().for_each(|game| game.rules[Rule::HalfTime.index()] = 900.0);
    });
    spoilt(&half, "kicks off", |step| step.after.play.kick_off = Some(Team::Left));
    spoilt(&half, "first half again", |step| {
        step.before.play.second_half = true;
        step.states().into_iter().for_each(|game| game.play.second_half = false);
        step.events.retain(|event| event.kind != EventKind::HalfTime);
    });
    spoilt(&half, "tired by", |step| step.judged.players[4].fatigue = 0.1);
    spoilt(&all[999], "full time", |step| {
        step.events.retain(|event| event.kind != EventKind::FullTime);
    });
}

#[test]
fn a_score_or_a_card_that_is_wrong_is_seen() {
    let step = open(&steps(0));
    let event = |kind: EventKind, by: u8| Event {
        tick: step.judged.tick,
        kind,
        qualifier: None,
        team: Some(PlayerId(by).team()),
        by: Some(PlayerId(by)),
        to: None,
        at: step.judged.ball.pos,
        length_m: 0.0,
        speed_mps: 0.0,
    };
    spoilt(&step, "goals", |step| step.states().into_iter().for_each(|game| game.score[1] += 1));
    spoilt(&step, "goals", |step| step.events.push(event(EventKind::Goal, 3)));
    spoilt(&step, "changed the score", |step| step.after.score[0] += 1);
    spoilt(&step, "own goals", |step| step.events.push(event(EventKind::OwnGoal, 3)));

    spoilt(&step, "cards, not", |step| {
        step.states().into_iter().for_each(|game| game.players[3].yellow_cards = 1);
    });
    spoilt(&step, "cards, not", |step| step.before.players[3].yellow_cards = 1);
    spoilt(&step, "a second yellow", |step| {
        step.before.players[3].yellow_cards = 1;
        step.states().into_iter().for_each(|game| game.players[3].yellow_cards = 2);
        step.events.push(event(EventKind::YellowCard, 3));
    });
    spoilt(&step, "is shown a card", |step| {
        step.before.players[3].active = false;
        step.states().into_iter().for_each(|game| game.players[3].active = false);
        step.events.push(event(EventKind::RedCard, 3));
    });
    spoilt(&step, "red cards, gone", |step| step.events.push(event(EventKind::RedCard, 3)));
    spoilt(&step, "red cards, gone", |step| {
        step.states().into_iter().for_each(|game| game.players[9].active = false);
    });
    spoilt(&step, "has appeared", |step| step.before.players[9].active = false);
    spoilt(&step, "who player 9 is", |step| step.after.players[9].yellow_cards = 1);
    spoilt(&step, "tired by", |step| step.judged.players[9].fatigue = 0.0);
    spoilt(&step, "cards is off", |step| {
        for game in [&mut step.before, &mut step.judged, &mut step.after] {
            game.rules[Rule::Cards.index()] = 0.0;
        }
        step.states().into_iter().for_each(|game| game.players[3].yellow_cards = 1);
        step.events.push(event(EventKind::YellowCard, 3));
    });
}

#[test]
fn a_restart_that_is_wrong_is_seen() {
    let all: Vec<Taken> = (0..6).flat_map(steps).collect();
    let step = open(&all);
    spoilt(&step, "awards", |step| step.judged.dead = true);
    spoilt(&step, "came without a stop", |step| {
        let waiting = all.iter().find(|step| step.after.play.set_piece.is_some()).unwrap();
        step.judged.play.set_piece = waiting.after.play.set_piece;
    });
    spoilt(&step, "a restart is left over", |step| step.after.dead = true);
    let kick = stopped(&all, EventKind::GoalKick);
    spoilt(&kick, "awards", |step| step.events.retain(|event| event.kind != EventKind::GoalKick));
    spoilt(&kick, "awards", |step| step.events.push(*step.events.last().unwrap()));
    spoilt(&kick, "nothing is worth", |step| {
        step.events.retain(|event| event.kind != EventKind::OutOfPlay);
    });
    spoilt(&kick, "waits after", |step| step.judged.play.pending = None);
    spoilt(&kick, "is not where", |step| step.after.ball.pos.x += 1.0);
    spoilt(&kick, "the mode is", |step| step.after.mode = step.before.mode);
    spoilt(&kick, "waits after", |step| {
        step.after.play.set_piece = None;
        step.after.mode = step.before.mode;
    });
    spoilt(&kick, "nobody takes", |step| {
        let set_piece = step.after.play.set_piece.as_mut().unwrap();
        set_piece.team = set_piece.team.other();
    });
    let waits = |step: &&Taken| {
        step.before.play.set_piece.is_some() && step.judged.play.set_piece.is_none()
    };
    let taken = all.iter().find(waits).unwrap();
    spoilt(taken, "was taken as", |step| {
        step.events.retain(|event| event.qualifier != Some(Qualifier::Taken));
    });
    let goal = stopped(&all, EventKind::Goal);
    spoilt(&goal, "kicks off after", |step| {
        step.after.play.kick_off = step.after.play.kick_off.map(Team::other);
    });
    spoilt(&goal, "goals", |step| step.events.retain(|event| event.kind != EventKind::Goal));
}

#[test]
fn what_waits_for_too_long_is_seen() {
    let is_wait = |step: &Taken| step.after.play.set_piece.is_some();
    let waits = (0..8).find_map(|index| steps(index).into_iter().find(is_wait)).unwrap();
    let wait = |spoil: &dyn Fn(&mut Match), most: u32| {
        let (mut waiting, mut step) = (Waiting::default(), waits.clone());
        step.judged.dead = false;
        spoil(&mut step.after);
        let see =
            Step { actions: &step.actions, judged: &step.judged, after: &step.after, events: &[] };
        (0..1000).position(|_| waiting.hold(&see).is_err()).map(|steps| steps as u32) == Some(most)
    };
    let taker = waits.after.play.set_piece.unwrap().taker;
    let none = |game: &mut Match| game.play.set_piece = None;
    assert!(wait(&|_| {}, 27));
    assert!(wait(&|game| game.play.driven = 1 << taker.0, 27), "the rule hurries agents");
    let unhurried = |game: &mut Match| game.rules[Rule::AntiStalling.index()] = 0.0;
    assert!(wait(&unhurried, 27), "bots wait for nothing");
    assert!(
        !wait(&|game| (unhurried(game), game.play.driven = 1 << taker.0).0, 27),
        "agents may wait"
    );
    let keeper =
        waits.after.players.iter().position(|player| player.role == Role::GK).unwrap() as u8;
    let hold = |game: &mut Match| (none(game), game.play.hands = Some((PlayerId(keeper), 0))).0;
    assert!(wait(&hold, 61));
    assert!(wait(&|game| (none(game), game.play.kick_off = Some(Team::Left)).0, 21));
    assert!(wait(&|game| (none(game), game.play.kick_off = None).0, 180), "the ball lies about");
}
