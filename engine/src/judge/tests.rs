use super::*;
use crate::football::begin;
use crate::state::PlayerId;
use crate::state::event::Event;
use crate::testing::{Code, checkpoints, event, scenario, scoring};
use glam::Vec3;
use setpiece_scenario::vocabulary::{EventKind, Field, GameMode, Qualifier, Role, Team, Verdict};
use setpiece_scenario::{
    BinaryOp, Each, Ending, EventFilter, Fold, FoldKind, Instr, Over, Program, RewardBody, When,
    Who,
};

const GOAL_LINE_M: f32 = 55.0;

/// A judge, a striker with an agent, and their match, which the tests change by hand.
fn bench(rewards: Vec<Reward>, prepare: impl FnOnce(&mut Scenario)) -> (Judge, Match, Events) {
    let mut scenario =
        scenario(&[(Team::Left, Role::CF, 0.0, 0.0), (Team::Right, Role::GK, 50.0, 0.0)]);
    prepare(&mut scenario);
    setpiece_scenario::verify::verify(&scenario).unwrap();
    let bindings = setpiece_scenario::Bindings::default();
    let roster = crate::draw::Roster::new(&scenario, &bindings, None).unwrap();
    let drawn =
        crate::draw::Drawer::new(&scenario).draw(&scenario, &bindings, &roster, 1, 0).unwrap();
    let game = begin::blank(&drawn);
    let scripts = Scripts::compile(&scenario).unwrap();
    let mut judge = Judge::new(&scenario, rewards.into(), scripts, roster.agents.len());
    judge.reset(
        &game,
        &Given {
            seed: 1,
            index: 0,
            params: &bindings.0,
            lets: &drawn.lets,
            round: 1,
            rounds: 1,
            round_start: 0,
        },
    );
    (judge, game, Events::new())
}

/// Pays the ball's current x into one term and its x of the last step into another.
fn where_is_the_ball() -> Reward {
    let mut code = Code::default();
    let now = code.load(Field::BallX);
    let prev = code.push(Instr::Load { field: Field::BallX, of: None, when: When::Prev });
    code.push(Instr::Give { term: 0, value: now, guard: None });
    code.push(Instr::Give { term: 1, value: prev, guard: None });
    let body = RewardBody {
        init: setpiece_scenario::Program::default(),
        step: code.program,
        terms: vec!["now".to_owned(), "prev".to_owned()],
        hooks: Vec::new(),
    };
    Reward { name: "ball".to_owned(), doc: String::new(), body }
}

fn goal_ends(scenario: &mut Scenario) {
    let mut code = Code::default();
    let us = code.push(Instr::Us);
    let filter =
        EventFilter { kind: EventKind::Goal, qualifier: None, by: Some(Who::Team(us)), to: None };
    let fold = Fold { kind: FoldKind::Count, value: None, guard: None };
    let when =
        Some(code.push(Instr::Each(Box::new(Each { over: Over::Events(filter), body: 0, fold }))));
    scenario.endings.program = code.program;
    let verdict = Some(Verdict::Success);
    scenario.endings.list.push(Ending { verdict, label: "scored".to_owned(), when, script: None });
}

#[test]
fn a_goal_is_judged_in_the_net_and_prev_sees_the_restart() {
    let (mut judge, mut game, mut events) = bench(vec![where_is_the_ball()], |_| ());
    game.step = 1;
    game.ball.pos.x = GOAL_LINE_M + 1.0;
    game.dead = true;
    assert_eq!(judge.step(&game, &mut events).unwrap(), None);
    // At the first step, prev is the start state.
    assert_eq!(judge.rewards().terms(0), [56.0, 0.0]);
    // The restart puts the ball on the centre spot.
    game.ball.pos = Vec3::new(0.5, 0.0, 0.11);
    game.dead = false;
    judge.settle(&game);
    game.step = 2;
    game.ball.pos.x = 2.0;
    judge.step(&game, &mut events).unwrap();
    assert_eq!(judge.rewards().terms(0), [2.0, 0.5]);
}

#[test]
fn rewards_of_the_last_step_see_the_end() {
    let mut code = Code::default();
    let value = code.number(3.0);
    for (qualifier, term) in
        [(None, 0), (Some(Qualifier::Success), 1), (Some(Qualifier::Failure), 2)]
    {
        let filter = EventFilter { kind: EventKind::End, qualifier, by: None, to: None };
        let fold = Fold { kind: FoldKind::Nothing, value: None, guard: None };
        code.push(Instr::Each(Box::new(Each { over: Over::Events(filter), body: 1, fold })));
        code.push(Instr::Give { term, value, guard: None });
    }
    let body = RewardBody {
        init: setpiece_scenario::Program::default(),
        step: code.program,
        terms: ["any", "success", "failure"].map(str::to_owned).to_vec(),
        hooks: Vec::new(),
    };
    let on_end = Reward { name: "on_end".to_owned(), doc: String::new(), body };
    let (mut judge, mut game, mut events) = bench(vec![on_end], goal_ends);
    game.step = 1;
    judge.step(&game, &mut events).unwrap();
    assert_eq!(judge.rewards().terms(0), [0.0, 0.0, 0.0]);
    game.step = 2;
    events.push(event(EventKind::Goal, Some(Team::Left), Some(0)));
    let outcome = judge.step(&game, &mut events).unwrap().unwrap();
    assert_eq!((&*outcome.label, outcome.verdict), ("scored", Some(Verdict::Success)));
    assert_eq!(judge.rewards().terms(0), [3.0, 3.0, 0.0]);
    // The limit ends an episode too, without success or failure.
    events.clear();
    game.step = 50;
    assert!(judge.step(&game, &mut events).unwrap().unwrap().truncated);
    assert_eq!(judge.rewards().terms(0), [3.0, 0.0, 0.0]);
}

#[test]
fn judging_and_observing_allocate_nothing() {
    let crowded = |reward: Reward| {
        // A loop over everybody that computes a distance each.
        let RewardBody { init, mut step, terms, hooks } = reward.body;
        let mut code = Code { program: std::mem::take(&mut step) };
        let everybody = code.number(-1.0);
        let at = code.program.code.len() as u32;
        let value = Some(setpiece_scenario::Reg(at + 2));
        let fold = Fold { kind: FoldKind::Min, value, guard: None };
        let each = code.push(Instr::Each(Box::new(Each {
            over: Over::Players { team: everybody, except: None },
            body: 2,
            fold,
        })));
        let x = code.load_of(Field::PlayerX, each);
        code.binary(BinaryOp::Hypot, x, x);
        code.push(Instr::Give { term: 0, value: each, guard: None });
        Some(Reward { body: RewardBody { init, step: code.program, terms, hooks }, ..reward })
    };
    let rewards = vec![scoring(), checkpoints(), crowded(where_is_the_ball()).unwrap()];
    let (mut judge, mut game, mut events) = bench(rewards, goal_ends);
    game.agents[0].player = Some(PlayerId(0));
    let mut statistics = crate::statistics::Statistics::begin(&game);
    let (mut vector, mut map) = ([0.0; 115], vec![0; crate::observe::smm_size(96, 72)]);
    let counted = allocation_counter::measure(|| {
        for step in 1..=50 {
            game.step = step;
            events.clear();
            for _ in 0..4 {
                events.push(Event {
                    tick: step,
                    ..event(EventKind::Touch, Some(Team::Left), Some(0))
                });
            }
            if step == 49 {
                events.push(event(EventKind::Goal, Some(Team::Left), Some(0)));
            }
            let outcome = judge.step(&game, &mut events).unwrap();
            assert_eq!(outcome.is_some(), step >= 49);
            statistics.observe(&game, events.as_slice());
            judge.settle(&game);
            crate::observe::simple115(&game, 0, &mut vector).unwrap();
            crate::observe::smm(&game, 0, 96, 72, &mut map).unwrap();
            crate::observe::raw(&game, 0).unwrap();
            crate::observe::action_mask(&game, 0).unwrap();
        }
    });
    assert_eq!(counted.count_total, 0);
    assert!(judge.rewards().sums(0)[0] > 0.0);
}

/// A program that reads a field of the last state, and what is kept of the last step for it.
#[test]
fn what_a_program_looks_back_at_is_kept() {
    let (_, mut game, _) = bench(Vec::new(), |_| ());
    game.ball.pos = Vec3::new(7.0, -3.0, 1.5);
    game.ball.vel = Vec3::new(4.0, 2.0, -1.0);
    (game.owner, game.possession) = (Some(PlayerId(11)), Some(Team::Right));
    (game.score, game.mode, game.dead, game.step) = ([2, 1], GameMode::Corner, true, 13);
    game.limit_steps = Some(400);
    game.players[11].fatigue = 0.5;
    for &field in Field::ALL {
        let program = Program {
            code: vec![Instr::Load { field, of: None, when: When::Prev }],
            ..Program::default()
        };
        let mut view = MatchView::EMPTY;
        view.keep(&game, ViewMemory::of(&program));
        for of in [0.0, 1.0, 11.0] {
            let (kept, live) =
                (Sight::Kept(&view).load(field, of), Sight::Live(&game).load(field, of));
            assert!(
                kept == live || kept.is_nan() && live.is_nan(),
                "{field:?} of {of}: {kept} {live}"
            );
        }
    }
}
