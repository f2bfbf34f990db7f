//! Behaviours end to end: from `.pitch` to the actions of scripted players.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

use setpiece::engine::batch::{ReadyMade, run_episodes};
use setpiece::engine::control::agents::Agent;
use setpiece::engine::environment::{Environment, EnvironmentOptions, Scratch, StepError};
use setpiece::engine::state::PlayerId;
use setpiece::scenario::Action::{Bottom, BuiltinAi, Idle, Left, Right};
use setpiece::scenario::file::{from_json, to_json};
use setpiece::scenario::{Action, Ai, Node, Reg, Scenario};
use setpiece_dsl::source::{LoadError, Source, SourceLoader};
use setpiece_dsl::{CompileOptions, compile};
use std::path::Path;
use std::sync::Arc;

struct Library;

impl SourceLoader for Library {
    fn load(&self, path: &str, _from: &str) -> Result<Source, LoadError> {
        let inner = path.strip_prefix("std/").unwrap_or(path);
        let full = Path::new(env!("CARGO_MANIFEST_DIR")).join("../stdlib-scenarios").join(inner);
        match std::fs::read_to_string(full) {
            Ok(text) => Ok(Source { name: path.to_owned(), text: text.into() }),
            Err(error) => {
                Err(LoadError { message: error.to_string(), similar: Vec::new(), awaited: None })
            }
        }
    }
}

fn scenario(text: &str) -> Arc<Scenario> {
    let root = Source { name: "test.pitch".to_owned(), text: text.into() };
    let outcome = compile(root, &Library, &CompileOptions::default());
    Arc::new(outcome.scenario.unwrap_or_else(|| panic!("{:#?}", outcome.problems)))
}

/// An environment in which only scripted players play.
fn environment(text: &str) -> Environment {
    Environment::new(scenario(text), EnvironmentOptions::default()).unwrap()
}

/// A lone left player with a behaviour `b`, the ball far away, nobody else.
fn alone(behavior: &str) -> Environment {
    environment(&format!(
        "{behavior}
        scenario s {{
            rules {{ offside: off }}
            agents {{ left: 0 }}
            ball at (-0.9, -0.4)
            team left {{ CM at (0, 0) {{ ai: b }} GK at (-0.92, -0.4) {{ ai: hold }} }}
            team right {{ GK at (1, 0) {{ ai: lazy }} }}
            end limit 300 steps
        }}"
    ))
}

const FIRST: PlayerId = PlayerId(0);
const RIGHT_FIRST: PlayerId = PlayerId(11);

/// Plays this many steps of an episode, or to its end, and calls `look` after each.
fn play(
    environment: &mut Environment,
    seed: u64,
    steps: u32,
    mut look: impl FnMut(u32, &Environment),
) {
    let mut scratch = Scratch::default();
    environment.reset(Some(seed), None).unwrap();
    for step in 1..=steps {
        if !environment.is_running() {
            break;
        }
        environment.step(&vec![Action::BuiltinAi; environment.n_agents()], &mut scratch).unwrap();
        look(step, environment);
    }
}

/// The presses of the first left player in this many steps.
fn presses(environment: &mut Environment, steps: u32) -> Vec<Action> {
    let mut pressed = Vec::new();
    play(environment, 1, steps, |_, environment| {
        pressed.push(environment.action_of(FIRST).unwrap());
    });
    pressed
}

fn first(pressed: &[Action], action: Action) -> Option<usize> {
    pressed.iter().position(|known| *known == action).map(|at| at + 1)
}

#[test]
fn a_marker_stays_goal_side_of_the_opponent() {
    let mut environment = environment(
        "behavior roam() {
            repeat {
                do move_to((0.3, -0.25)) sprinting
                do move_to((0.6, 0.1)) sprinting
                do move_to((0.3, 0.25))
                do move_to((0, 0)) sprinting
            }
        }
        behavior marker() { do mark(nearest(them, to: me)) }
        scenario s {
            rules { offside: off }
            agents { left: 0 }
            ball at (-0.95, 0) { owner: keeper }
            team left { striker: CF at (0, 0) { ai: roam } keeper: GK at (-0.96, 0) { ai: hold } }
            team right { CB at (0.06, 0) { ai: marker } }
            end limit 400 steps
        }",
    );
    let (mut seen, mut goal_side, mut total) = (0, 0, 0.0);
    play(&mut environment, 3, 200, |step, environment| {
        let game = environment.state();
        let (opponent, marker) = (game.player(FIRST), game.player(RIGHT_FIRST));
        if step > 20 {
            let goal = apart_m(marker.pos.x, marker.pos.y, 55.0, 0.0);
            let rival = apart_m(opponent.pos.x, opponent.pos.y, 55.0, 0.0);
            let gap = apart_m(opponent.pos.x, opponent.pos.y, marker.pos.x, marker.pos.y);
            assert!(gap < 6.0, "step {step}: {gap} m away");
            total += gap;
            seen += 1;
            goal_side += u32::from(goal < rival + 0.5);
        }
    });
    let mean = total / 180.0;
    assert!(mean < 3.0, "{mean} m away on average");
    assert!(seen == 180 && goal_side * 10 >= seen * 6, "goal side in {goal_side} of {seen} steps");
}

fn apart_m(ax: f32, ay: f32, bx: f32, by: f32) -> f32 {
    (ax - bx).hypot(ay - by)
}

#[test]
fn a_dribbler_zigzags_through_the_way_points() {
    let mut environment = environment(
        "behavior zigzag(width: length) {
            do hold until me has ball
            do dribble_to((0m, width))
            do dribble_to((10m, -width))
            do dribble_to((20m, width))
            do dribble_to((30m, 0m))
            do hold
        }
        scenario s {
            agents { left: 0 }
            ball at (-10m, 0m) { owner: dribbler }
            team left { dribbler: CF at (-10.5m, 0m) { ai: zigzag(5m) } }
            team right { GK at (1, 0) { ai: lazy } }
            end limit 400 steps
        }",
    );
    let points = [(0.0, 5.0), (10.0, -5.0), (20.0, 5.0), (30.0, 0.0)];
    let mut reached = 0;
    play(&mut environment, 1, 300, |_, environment| {
        let game = environment.state();
        let pos = game.player(FIRST).pos;
        if let Some(&(x, y)) = points.get(reached)
            && apart_m(pos.x, pos.y, x, y) < 1.5
        {
            reached += 1;
            let ball = game.ball.pos;
            assert!(
                apart_m(ball.x, ball.y, pos.x, pos.y) < 3.0,
                "the ball stays with the dribbler to {x}"
            );
        }
    });
    assert_eq!(reached, points.len());
}

const ARRIVE_AND_SHOOT: &str = "
    behavior arrive_and_shoot(spot: point) {
        do move_to(spot) sprinting
        do hold until me has ball
        do dribble_to(them.goal) until distance(me, them.goal) < 14m or pressed(me, within: 2m)
        do shoot
        interrupt when distance(me, ball) < 1m and not us has ball { do tackle }
    }
    scenario s {
        rules { offside: off }
        agents { left: 0 }
        let side = uniform(-0.1, 0.1)
        ball at (0.5, side)
        team left { CF at (0.3, 0) { ai: arrive_and_shoot((0.5, side)) } GK at (-1, 0) }
        team right { CB at (-0.5, 0.3) { ai: lazy } }
        end success scored when goal by left
        end limit 200 steps
    }";

#[test]
fn arrive_and_shoot_scores_into_an_empty_goal() {
    let mut environment = environment(ARRIVE_AND_SHOOT);
    let mut scored = 0;
    for seed in 0..20 {
        play(&mut environment, seed, 200, |_, _| ());
        scored +=
            u32::from(environment.outcome().is_some_and(|outcome| &*outcome.label == "scored"));
    }
    assert!(scored >= 14, "{scored} of 20");
}

#[test]
fn an_interrupt_pauses_what_it_interrupts() {
    // The hold lasts 3 s, not counting the interrupt.
    let mut environment = alone(
        "behavior b() {
            state done = 0
            do hold for 3s
            do run(90deg) for 5s
            interrupt when elapsed >= 1s and done == 0 {
                done = 1
                do run(0deg) for 0.5s
            }
        }",
    );
    let pressed = presses(&mut environment, 60);
    // A behaviour sees the state before the step: 1 s is over before step 11.
    assert_eq!(first(&pressed, Action::Right), Some(11), "{pressed:?}");
    assert_eq!(first(&pressed, Action::ReleaseDirection), Some(16), "{pressed:?}");
    assert_eq!(first(&pressed, Action::Bottom), Some(36), "{pressed:?}");
}

#[test]
fn the_first_written_interrupt_wins_and_only_it_interrupts_the_others() {
    let mut environment = alone(
        "behavior b() {
            do hold
            interrupt when elapsed >= 2s and elapsed < 2.1s { do run(90deg) for 1s }
            interrupt when elapsed >= 1s and elapsed < 1.1s or elapsed >= 2s and elapsed < 2.5s { do run(0deg) for 2s }
        }",
    );
    let pressed = presses(&mut environment, 60);
    // At 1 s the second begins. At 2 s the first interrupts it for 1 s, without being interrupted
    // in turn. Then the second continues for its remaining second.
    assert_eq!(first(&pressed, Action::Right), Some(11), "{pressed:?}");
    assert_eq!(first(&pressed, Action::Bottom), Some(21), "{pressed:?}");
    assert_eq!(first(&pressed[21..], Action::Right), Some(10), "{pressed:?}");
    assert_eq!(first(&pressed, Action::ReleaseDirection), Some(41), "{pressed:?}");
}

#[test]
fn an_outer_interrupt_beats_an_inner_one_and_a_call_is_left_as_a_whole() {
    let mut environment = alone(
        "behavior inner() {
            do hold
            interrupt when elapsed >= 1s { do run(180deg) }
        }
        behavior b() {
            do inner until elapsed >= 2s
            do inner for 1s
            do run(270deg) for 1s
            interrupt when elapsed >= 1s and elapsed < 1.1s { do run(0deg) for 0.3s }
        }",
    );
    let pressed = presses(&mut environment, 50);
    assert_eq!(first(&pressed, Action::Right), Some(11), "the outer first: {pressed:?}");
    assert_eq!(first(&pressed, Action::Left), Some(14), "{pressed:?}");
    assert_eq!(
        first(&pressed, Action::Top),
        Some(31),
        "left at 2 s, then 1 s more of it: {pressed:?}"
    );
    assert_eq!(pressed.last(), Some(&Action::BuiltinAi), "behind the last statement the bot plays");
}

#[test]
fn loops_count_wait_and_finish() {
    let mut environment = alone(
        "behavior inner() {
            repeat {
                if elapsed >= 1s { finish }
            }
        }
        behavior b() {
            state n = 0
            do inner
            repeat 3 times {
                n = n + 1
                do run(0deg) for 0.2s
                do run(90deg) for 0.1s
            }
            repeat until n >= 5 { n = n + 1 }
            do run(180deg) for 0.1s
            finish
            do run(270deg)
        }",
    );
    let pressed = presses(&mut environment, 30);
    // Iterations without a step wait one each: `inner` checks ten times, the last loop adds twice.
    let mut expected = vec![Idle; 10];
    expected
        .extend([Right, Idle, Bottom, Right, Idle, Bottom, Right, Idle, Bottom, Idle, Idle, Left]);
    expected.resize(30, BuiltinAi);
    assert_eq!(pressed, expected);
}

#[test]
fn a_let_is_frozen_and_a_state_remembered() {
    let mut environment = alone(
        "behavior b() {
            state last = ball
            let before = elapsed
            do hold for 1s
            if elapsed - before == 1s and abs(last.x + 0.9) < 0.001 { do run(0deg) for 0.1s }
            let later = elapsed
            last = (0, 0)
            if later - before >= 1s and last.x == 0 and distance(last, (0, 0)) < 1m { do run(90deg) for 0.1s }
            do run(180deg)
        }",
    );
    let pressed = presses(&mut environment, 14);
    assert_eq!(pressed[10..13], [Action::Right, Action::Bottom, Action::Left], "{pressed:?}");
}

#[test]
fn what_over_time_was_counts_once_a_step() {
    // `held` sees every step from the start state on, whether or not a statement reads it, and
    // however often cells change.
    let mut environment = alone(
        "behavior b() {
            state n = 0
            repeat 20 times { n = n + 1 let m = n do hold for 0.1s until held(not ball_dead, for: 1.5s) and m > 0 }
            do run(0deg)
        }",
    );
    let pressed = presses(&mut environment, 40);
    assert_eq!(
        first(&pressed, Action::Right),
        Some(21),
        "fourteen holds, six passes that wait: {pressed:?}"
    );
}

#[test]
fn a_choice_follows_its_weights() {
    let mut environment =
        alone("behavior b() { choose { 3: do run(0deg) 1: { do run(180deg) } } }");
    let mut scratch = Scratch::default();
    let (mut right, n) = (0, 1000);
    environment.reset(Some(5), None).unwrap();
    for _ in 0..n {
        environment.step(&[], &mut scratch).unwrap();
        let action = environment.action_of(FIRST).unwrap();
        assert!(action == Action::Right || action == Action::Left);
        right += u32::from(action == Action::Right);
        environment.reset(None, None).unwrap();
    }
    // Five standard deviations of a binomial.
    assert!((682..=818).contains(&right), "{right} of {n}");
}

#[test]
fn random_arguments_are_drawn_per_player_and_episode() {
    let mut environment = environment(
        "behavior go(heading: angle) { do run(heading) }
        behavior b(heading: angle = uniform(0deg, 360deg)) { do go(heading) }
        scenario s {
            agents { left: 0 }
            ball at (-0.9, -0.4)
            team left { CM at (0, 0) { ai: b } CM at (0, 0.1) { ai: b } GK at (-0.92, -0.4) { ai: hold } }
            team right { GK at (1, 0) { ai: lazy } }
            end limit 300 steps
        }",
    );
    let (mut apart, mut headings) = (0, std::collections::BTreeSet::new());
    for seed in 0..40 {
        let mut changes = 0;
        play(&mut environment, seed, 20, |step, environment| {
            let (one, other) = (
                environment.action_of(FIRST).unwrap(),
                environment.action_of(PlayerId(1)).unwrap(),
            );
            if step == 1 {
                headings.insert(one.index());
                apart += u32::from(one != other);
            } else {
                changes += u32::from(one != Action::Idle);
            }
        });
        assert_eq!(changes, 0, "drawn once");
    }
    assert!(apart > 25 && headings.len() == 8, "{apart} {headings:?}");
}

#[test]
fn literals_are_read_in_the_own_frame_and_arguments_where_they_stand() {
    let mut environment = environment(
        "behavior there(spot: point, heading: angle) {
            do move_to(spot) for 0.1s
            do move_to((0.5, 0)) for 0.1s
            do run(heading) for 0.1s
            do run(0deg) for 0.1s
        }
        scenario s {
            agents { left: 0 }
            ball at (-0.9, -0.4)
            team left { GK at (-0.92, -0.4) { ai: hold } }
            team right { CM at (0, 0) { ai: there((0.5, 0), 0deg) } GK at (1, 0) }
            end limit 50 steps
        }",
    );
    let mut pressed = Vec::new();
    play(&mut environment, 1, 4, |_, environment| {
        pressed.push(environment.action_of(RIGHT_FIRST).unwrap());
    });
    // Presses are in the own frame too: world +x is back for the right team.
    assert_eq!(pressed, [Action::Left, Action::Right, Action::Left, Action::Right]);
}

#[test]
fn nobody_and_no_ball_end_at_once() {
    let mut environment = alone(
        "behavior b() {
            do pass_to(nobody)
            do mark(nobody)
            do shoot
            do pass_to(nearest(mates, to: me))
            do dribble_to((0.5, 0))
            do move_to(me)
            do hold for 0s
            do hold until true
            do run(0deg)
        }",
    );
    assert_eq!(presses(&mut environment, 1), [Action::Right]);
}

#[test]
fn a_pass_is_struck_to_the_mate_meant() {
    let mut environment = environment(
        "behavior b(mate: player) {
            do pass_to(mate)
            do hold
        }
        scenario s {
            rules { offside: off, stochastic: off }
            agents { left: 0 }
            ball at (0.01, 0) { owner: passer }
            team left {
                passer: CM at (0, 0) { ai: b(wing) }
                wing: RM at (0.1, 0.25) { ai: hold }
                other: CF at (0.3, -0.05) { ai: hold }
            }
            team right { GK at (1, 0) { ai: lazy } }
            end success arrived when pass completed by left
            end limit 60 steps
        }",
    );
    let (mut kicks, mut receiver) = (0, None);
    play(&mut environment, 1, 60, |_, environment| {
        kicks += u32::from(environment.action_of(FIRST) == Some(Action::ShortPass));
        receiver =
            environment.events().iter().filter_map(|event| event.to).next_back().or(receiver);
    });
    assert_eq!((kicks, receiver), (1, Some(PlayerId(1))));
    assert_eq!(environment.outcome().map(|outcome| &*outcome.label), Some("arrived"));
}

#[test]
fn an_agent_wins_over_a_behavior() {
    let text = "behavior b() { do run(90deg) }
        scenario s {
            agents { left: [anna] }
            ball at (-0.9, -0.4)
            team left { anna: CM at (0, 0) { ai: b } GK at (-0.92, -0.4) { ai: hold } }
            team right { GK at (1, 0) }
            end limit 50 steps
        }";
    let mut environment = environment(text);
    let mut scratch = Scratch::default();
    environment.reset(Some(1), None).unwrap();
    let mut pressed = Vec::new();
    for action in [Action::Right, Action::Idle, Action::BuiltinAi, Action::BuiltinAi, Action::Left]
    {
        environment.step(&[action], &mut scratch).unwrap();
        pressed.push(environment.action_of(FIRST));
    }
    // The behaviour pauses while the agent plays, and plays when the agent hands over.
    let expected = [Action::Right, Action::Idle, Action::Bottom, Action::Idle, Action::Left];
    assert_eq!(pressed, expected.map(Some));
}

#[test]
fn the_presses_of_a_behavior_replayed_by_an_agent_give_the_same_match() {
    let text = ARRIVE_AND_SHOOT
        .replace("offside: off", "offside: off, assist: off")
        .replace("CF at (0.3, 0) {", "anna: CF at (0.3, 0) {");
    let mut scripted = environment(&text);
    let mut pressed = Vec::new();
    play(&mut scripted, 4, 200, |_, environment| {
        pressed.push(environment.action_of(FIRST).unwrap());
    });
    let mut agent = environment(&text.replace("left: 0", "left: [anna]"));
    let mut scratch = Scratch::default();
    agent.reset(Some(4), None).unwrap();
    let (mut ball, mut step) = (Vec::new(), 0);
    while agent.is_running() && step < pressed.len() {
        agent.step(&[pressed[step]], &mut scratch).unwrap();
        ball.push(agent.state().ball.pos);
        step += 1;
    }
    assert_eq!(
        agent.outcome().map(|outcome| &*outcome.label),
        scripted.outcome().map(|outcome| &*outcome.label)
    );
    assert_eq!((step, agent.state().ball.pos), (pressed.len(), scripted.state().ball.pos));
}

/// Eleven against eleven, everyone with a behaviour that draws and chooses.
fn crowd() -> Arc<Scenario> {
    scenario(
        "behavior wander() {
            repeat {
                choose {
                    2: { do move_to(uniform(pitch)) sprinting for uniform(1s, 4s) }
                    1: do press for 2s
                    1: do mark(nearest(them, to: me)) for 2s
                }
                if me has ball { choose { 1: do shoot 2: do pass_to(nearest(mates, to: me)) 1: do dribble_to(them.goal) for 2s } }
            }
            interrupt when distance(me, ball) < 2m and not us has ball { choose { 3: do tackle 1: do slide } }
        }
        scenario s {
            agents { left: 0 }
            team left { formation: grf_receiving each outfield { ai: wander } }
            team right { formation: grf_receiving each outfield { ai: wander } }
            ball at centre
            end limit 300 steps
        }",
    )
}

#[test]
fn a_crowd_of_behaviors_repeats_itself_on_any_number_of_threads_and_through_a_file() {
    let scenario = crowd();
    let run = |scenario: &Arc<Scenario>, threads| {
        let environment =
            Environment::new(scenario.clone(), EnvironmentOptions::default()).unwrap();
        let policy = || ReadyMade::new(Agent::Idle);
        let episodes =
            run_episodes(&environment, 9, 0..4, threads, |_| None, policy, |_| ()).unwrap();
        episodes.into_iter().map(|episode| episode.unwrap().digest).collect::<Vec<u64>>()
    };
    let one = run(&scenario, 1);
    assert_eq!(one, run(&scenario, 1));
    assert_eq!(one, run(&scenario, 2));
    let file = to_json(&scenario).unwrap();
    let read = Arc::new(from_json(&file).unwrap());
    assert_eq!(*read, *scenario);
    assert_eq!(one, run(&read, 1));
    assert!(one.windows(2).all(|pair| pair[0] != pair[1]), "{one:?}");
}

#[test]
fn a_clone_goes_on_as_the_original_does() {
    let mut original = Environment::new(crowd(), EnvironmentOptions::default()).unwrap();
    play(&mut original, 2, 80, |_, _| ());
    let mut copy = original.clone();
    let mut scratch = Scratch::default();
    for _ in 0..80 {
        original.step(&[], &mut scratch).unwrap();
    }
    for _ in 0..80 {
        copy.step(&[], &mut scratch).unwrap();
    }
    assert_eq!(original.digest(), copy.digest());
}

#[test]
fn a_damaged_behavior_is_refused() {
    let scenario = crowd();
    let refused = |damage: &dyn Fn(&mut Scenario)| {
        let mut damaged = (*scenario).clone();
        damage(&mut damaged);
        setpiece::scenario::verify::verify(&damaged).is_err()
    };
    assert!(!refused(&|_| ()));
    assert!(refused(&|scenario| scenario.players[1].ai = Ai::Behavior(99)));
    assert!(refused(&|scenario| scenario.behaviors[0].nodes.push(Node::Jump(0))));
    assert!(refused(&|scenario| scenario.behaviors[0].nodes.push(Node::Mark(u32::MAX))));
    assert!(refused(&|scenario| scenario.behaviors[0]
        .nodes
        .push(Node::Loop { to: 9999, mark: 0 })));
    assert!(refused(&|scenario| scenario.behaviors[0].watches[0].when = Reg(u32::MAX)));
    assert!(refused(&|scenario| scenario.behaviors[0].watches[0].to = u32::MAX));
}

#[test]
fn a_script_plays_a_player() {
    let mut environment = environment(
        "behavior runner(far: length, target: point) script rhai \"\"\"
            fn reset(ctx) { this.steps = 0; }
            fn act(ctx, me, now) {
                this.steps += 1;
                if this.steps == 1 { return \"right\"; }
                if distance(me.at, ctx.params.target) < ctx.params.far { \"release_direction\" } else { \"sprint\" }
            }
        \"\"\"
        scenario s {
            agents { left: 0 }
            ball at (-0.9, -0.4)
            team left {
                CM at (0, 0) { ai: runner(10m, (30m, 0m)) }
                GK at (-0.92, -0.4) { ai: script rhai \"\"\"fn act(ctx, me, now) { \"idle\" }\"\"\" }
            }
            team right { GK at (1, 0) { ai: lazy } }
            end limit 100 steps
        }",
    );
    play(&mut environment, 1, 100, |_, _| ());
    let game = environment.state();
    assert!((20.0..24.0).contains(&game.player(FIRST).pos.x), "{}", game.player(FIRST).pos);
    assert_eq!(environment.action_of(PlayerId(1)), Some(Action::Idle));
}

#[test]
fn a_script_that_names_no_action_ends_the_episode() {
    let failing = |body: &str| {
        let mut environment = alone(&format!(
            "behavior b() script rhai \"\"\"fn act(ctx, me, now) {{ if now.elapsed > 0.15 {{ {body} }} else {{ \"idle\" }} }}\"\"\""
        ));
        let mut scratch = Scratch::default();
        environment.reset(Some(1), None).unwrap();
        environment.step(&[], &mut scratch).unwrap();
        environment.step(&[], &mut scratch).unwrap();
        let error = environment.step(&[], &mut scratch).unwrap_err();
        assert!(!environment.is_running());
        match error {
            StepError::Script(error) => {
                assert_eq!((error.hook.as_str(), error.seed, error.step), ("act", 1, 2));
                error.message
            }
            other => panic!("{other:?}"),
        }
    };
    assert_eq!(failing("\"shoot\""), "no action is called `shoot`; did you mean `shot`?");
    assert_eq!(failing("7"), "expected the name of an action, found a whole number");
    assert!(failing("throw \"lost\"").contains("lost"));
}

/// A scripted player follows the script, whatever ball is nearby. A player controlled by an agent
/// is drawn to the ball.
#[test]
fn a_scripted_player_is_not_drawn_to_the_ball_unless_an_agent_drives_them() {
    let walked = |agents: &str| {
        let text = format!(
            "behavior waits {{ do hold }}
            scenario s {{
                ball at (40m, 20m)
                team left {{ GK at (-50m, 0m) {{ ai: hold }}  a: CF at (-40m, 30m) {{ ai: hold }} }}
                team right {{ p: CB at (10m, 0m) {{ ai: waits }} }}
                agents {{ {agents} }}
                end limit 60 steps
            }}"
        );
        let loaded =
            setpiece::compile_text(&text, "<test>").unwrap_or_else(|error| panic!("{error}"));
        let mut environment =
            Environment::new(loaded.scenario, EnvironmentOptions::default()).unwrap();
        environment.reset(Some(1), None).unwrap();
        let mut scratch = Scratch::default();
        while environment.is_running() {
            environment.step(&[Action::BuiltinAi], &mut scratch).unwrap();
        }
        environment.state().players[11].pos.distance(glam::Vec2::new(10.0, 0.0))
    };
    assert!(walked("left: [a]") < 0.5);
    assert!(walked("left: 0, right: [p]") > 10.0);
}
