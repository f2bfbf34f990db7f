//! From `.pitch` to payments: the standard library's rewards compared with Google Research
//! Football's own rules, and episodes that are the same on any number of threads.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

use setpiece_dsl::source::{LoadError, Source, SourceLoader};
use setpiece_dsl::{CompileOptions, compile};
use setpiece_engine::batch::{EpisodeSummary, ReadyMade, run_episodes};
use setpiece_engine::control::agents::Agent;
use setpiece_engine::environment::{Environment, EnvironmentOptions, Scratch};
use setpiece_engine::judge::Recorded;
use setpiece_engine::observe::Floats;
use setpiece_engine::random::{Purpose, Stream};
use setpiece_scenario::vocabulary::{EventKind, Team};
use setpiece_scenario::{Action, Scenario};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Loads the standard library under `std/`.
struct Library;

fn library() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../stdlib-scenarios")
}

impl SourceLoader for Library {
    fn load(&self, path: &str, _from: &str) -> Result<Source, LoadError> {
        let inner = path.strip_prefix("std/").unwrap_or(path);
        match std::fs::read_to_string(library().join(inner)) {
            Ok(text) => Ok(Source { name: path.to_owned(), text: text.into() }),
            Err(error) => {
                Err(LoadError { message: error.to_string(), similar: Vec::new(), awaited: None })
            }
        }
    }
}

fn compiled(text: String) -> Arc<Scenario> {
    let root = Source { name: "test.pitch".to_owned(), text: text.into() };
    let outcome = compile(root, &Library, &CompileOptions::default());
    Arc::new(outcome.scenario.unwrap_or_else(|| panic!("{:#?}", outcome.problems)))
}

fn stdlib(name: &str) -> Arc<Scenario> {
    compiled(std::fs::read_to_string(library().join(format!("{name}.pitch"))).unwrap())
}

fn environment(scenario: Arc<Scenario>, rewards: &[&str]) -> Environment {
    let rewards = Some(rewards.iter().map(ToString::to_string).collect());
    Environment::new(scenario, EnvironmentOptions { rewards, ..EnvironmentOptions::default() })
        .unwrap()
}

/// GRF's checkpoint reward by its own rules: `collected` regions, thresholds 0.99 down to 0.19 from
/// (1, 0).
fn grf_checkpoints(collected: &mut u32, goal: bool, carried_to: Option<f64>) -> f64 {
    if goal {
        let rest = 0.1 * f64::from(10 - *collected);
        *collected = 10;
        return rest;
    }
    let mut paid = 0.0;
    if let Some(distance) = carried_to {
        while *collected < 10 && distance <= 0.99 - 0.8 / 9.0 * f64::from(*collected) {
            paid += 0.1;
            *collected += 1;
        }
    }
    paid
}

#[test]
fn checkpoints_pay_what_grf_pays() {
    let mut scratch = Scratch::default();
    let (mut carried, mut goals) = (0, 0);
    // A crowded box for the regions, and an empty goal for the remaining payment of the first goal.
    let scenarios = ["academy/academy_3_vs_1_with_keeper", "academy/academy_empty_goal"];
    let environments = scenarios.map(|name| environment(stdlib(name), &["scoring", "checkpoints"]));
    for (seed, mut environment) in
        (0..15).flat_map(|seed| environments.clone().map(|environment| (seed, environment)))
    {
        environment.reset(Some(seed), None).unwrap();
        let (mut collected, mut total) = (0, 0.0);
        let mut stream = Stream::new(seed, 0, Purpose::Agent);
        while environment.is_running() {
            let action = Agent::RunAndShoot.act(environment.state(), 0, &mut stream);
            let result = environment.step(&[action], &mut scratch).unwrap();
            let goal = |team| {
                environment
                    .events()
                    .iter()
                    .any(|event| event.kind == EventKind::Goal && event.team == Some(team))
            };
            let (scored, conceded) = (goal(Team::Left), goal(Team::Right));
            // The state shows the restart; if play stopped without a goal, the judge saw another
            // state.
            if result.terminated && !scored {
                break;
            }
            let game = environment.state();
            let owns = game.owner.is_some() && game.owner == game.agents[0].player;
            let (x, y) = (f64::from(game.ball.pos.x) / 54.4, f64::from(game.ball.pos.y) / 83.6);
            let expected =
                grf_checkpoints(&mut collected, scored, owns.then(|| (x - 1.0).hypot(y)));
            let score = f64::from(i8::from(scored) - i8::from(conceded));
            let paid = f64::from(environment.rewards()[0]);
            assert!(
                (paid - score - expected).abs() < 1e-6,
                "seed {seed} step {}: {paid}",
                environment.steps()
            );
            carried += u32::from(expected > 0.0 && !scored);
            goals += u32::from(scored);
            total += expected;
        }
        assert!(total <= 1.0 + 1e-9, "{total}");
    }
    assert!(carried > 30 && goals > 0, "{carried} regions, {goals} goals");
}

#[test]
fn an_edited_copy_pays_what_it_says() {
    let rewards = std::fs::read_to_string(library().join("rewards.pitch")).unwrap();
    let own = rewards.replace("reward scoring", "reward my_scoring").replace("give +1", "give +5");
    let own = own.split("/// Up to").next().unwrap().to_owned();
    let scenario = compiled(format!(
        "{own}\nscenario mine extends academy {{
            ball at (0.9, 0)
            team left {{ CF at (0.88, 0) }}
            team right {{ }}
            remove reward scoring
            reward my_scoring
        }}"
    ));
    let environment = Environment::new(scenario, EnvironmentOptions::default()).unwrap();
    assert_eq!(environment.term_names(), ["my_scoring/goal", "my_scoring/conceded"]);
    let policy = || ReadyMade::new(Agent::RunAndShoot);
    let episodes = run_episodes(&environment, 1, 0..10, 1, |_| None, policy, |_| ()).unwrap();
    let summaries: Vec<EpisodeSummary> = episodes.into_iter().map(Result::unwrap).collect();
    assert!(summaries.iter().any(|summary| summary.score[0] == 1));
    for summary in summaries {
        assert_eq!(summary.returns, [5.0 * f64::from(summary.score[0])], "{}", summary.outcome);
    }
}

/// Episodes of bots in a scenario, and the names of its terms.
fn bots(text: &str, n: u64) -> (Vec<EpisodeSummary>, Vec<String>) {
    let environment = setpiece_tests::environment(text);
    let episodes =
        run_episodes(&environment, 1, 0..n, 1, |_| None, || ReadyMade::new(Agent::Bot), |_| ())
            .unwrap();
    (episodes.into_iter().map(Result::unwrap).collect(), environment.term_names().to_vec())
}

#[test]
fn a_potential_pays_its_difference_over_an_episode() {
    let text = "scenario s extends academy_run_to_score {
        remove reward scoring
        reward near { give potential(ball.x, gamma: 1) as \"undiscounted\"  give potential(ball.x, gamma: 0.9) as \"discounted\" }
        record all = sum of ball.x
        record begin = first of prev(ball.x)
        record over = last of ball.x
    }";
    let cut_short = text.replace("record all", "end limit 20 steps\n record all");
    for summary in bots(text, 3).0.into_iter().chain(bots(&cut_short, 3).0) {
        let record = |name: &str| {
            let found = summary.records.iter().find(|(known, _)| known == name);
            found.and_then(|(_, value)| value.number()).unwrap()
        };
        let (begin, over, all) = (record("begin"), record("over"), record("all"));
        // A state in which the episode terminates has no potential; the limit doesn't terminate it.
        let terminated = summary.outcome != "limit";
        assert_eq!(terminated, summary.length != 20);
        let (over, all) = if terminated { (0.0, all - over) } else { (over, all) };
        assert!(
            (summary.terms[0][0] - (over - begin)).abs() < 1e-6,
            "{} of {begin}..{over}",
            summary.terms[0][0]
        );
        // 0.9 of every state minus every previous state.
        let discounted = 0.9 * all - (all - over + begin);
        assert!(
            (summary.terms[0][1] - discounted).abs() < 1e-6,
            "{} of {discounted}",
            summary.terms[0][1]
        );
    }
}

#[test]
fn a_potential_leaves_out_nothing_that_moves_the_ball_or_the_agent() {
    // Restarts place the ball, and control goes from player to player.
    let mut environment = setpiece_tests::environment(
        "scenario s extends 5_vs_5 {
            reward of_the_ball { give potential(ball.x, gamma: 1) as \"ball\" }
            reward of_me { give potential(me.x, gamma: 0.5) as \"me\" }
            record ball = last of ball.x
            record me = last of me.x
            end limit 600 steps
        }",
    );
    let term = |name: &str, environment: &Environment| {
        environment.term_names().iter().position(|known| known == name).unwrap()
    };
    let terms = ["of_the_ball/ball", "of_me/me"].map(|name| term(name, &environment));
    let (mut restarts, mut handed_over) = (0, 0);
    for seed in 0..3 {
        environment.reset(Some(seed), None).unwrap();
        let mut scratch = Scratch::default();
        let mut stream = Stream::new(seed, 0, Purpose::Agent);
        let mut before: Option<[f64; 2]> = None;
        let (mut player, mut sum, mut start) = (None, 0.0, 0.0);
        while environment.is_running() {
            let action = Agent::Bot.act(environment.state(), 0, &mut stream);
            environment.step(&[action], &mut scratch).unwrap();
            let judged: Vec<f64> = environment
                .records()
                .map(|(_, value)| match value {
                    Recorded::PerAgent(values) => values[0].number().unwrap(),
                    one => one.number().unwrap(),
                })
                .collect();
            let [ball, me] = [judged[0], judged[1]];
            let paid = terms.map(|term| environment.terms(0)[term]);
            match before {
                Some([ball_before, me_before]) => {
                    assert!((paid[0] - (ball - ball_before)).abs() < 1e-6, "{paid:?} {ball}");
                    assert!((paid[1] - (0.5 * me - me_before)).abs() < 1e-6, "{paid:?} {me}");
                }
                None => start = ball - paid[0],
            }
            sum += paid[0];
            before = Some([ball, me]);
            let game = environment.state();
            restarts += u32::from(environment.judged_state().ball.pos != game.ball.pos);
            handed_over += u32::from(player.is_some_and(|known| known != game.agents[0].player));
            player = Some(game.agents[0].player);
        }
        assert!((sum - (before.unwrap()[0] - start)).abs() < 1e-6, "{sum}");
    }
    assert!(restarts > 1 && handed_over > 20, "{restarts} restarts, {handed_over} times");
}

#[test]
fn agents_judged_together_are_paid_as_if_judged_alone() {
    // Rewards run for a whole team, records agent by agent.
    let paid = [
        "abs(me.x) * me.fatigue",
        "distance(me, ball) / 1m",
        "if me has ball then 1 else 0",
        "if pressed(me, within: 3m) then 1 else 0",
        "count(p in mates where distance(p, me) < 12m)",
        "min(distance(p, me) / 1m for p in them)",
        "if held(me.speed > 3m/s, for: 0.5s) then 1 else 0",
        "if ever(me has ball) then 1 else 0",
        "closing(me, ball) / 1m",
        "if touch by me then 1 else 0",
        "distance(nearest(mates, to: me), ball) / 1m - us.score",
    ];
    for agents in
        ["left: 1, right: 0", "left: 3, right: 0", "left: all, right: 0", "left: 0, right: all"]
    {
        let mut text = format!(
            "scenario s extends 11_vs_11_stochastic {{ agents {{ {agents} }} end limit 300 steps\n"
        );
        for (index, value) in paid.iter().enumerate() {
            text.push_str(&format!(
                "reward r{index} {{ give {value} as \"sum\" }}\nrecord m{index} = sum of ({value})\n"
            ));
        }
        text.push('}');
        let (summaries, names) = bots(&text, 1);
        for summary in summaries {
            for (index, value) in paid.iter().enumerate() {
                let term = names.iter().position(|name| *name == format!("r{index}/sum")).unwrap();
                let (_, recorded) =
                    summary.records.iter().find(|(name, _)| *name == format!("m{index}")).unwrap();
                let alone: Vec<f64> = match recorded {
                    Recorded::PerAgent(values) => {
                        values.iter().map(|value| value.number().unwrap()).collect()
                    }
                    one => vec![one.number().unwrap()],
                };
                let together: Vec<f64> = summary.terms.iter().map(|terms| terms[term]).collect();
                assert_eq!(alone, together, "`{value}` with {agents}");
            }
        }
    }
}

#[test]
fn threads_change_nothing() {
    for (name, n) in [("academy/academy_counterattack_hard", 6), ("academy/academy_corner", 6)] {
        let environment = environment(stdlib(name), &["scoring", "checkpoints"]);
        let run = |threads| {
            let policy = || ReadyMade::new(Agent::Random);
            let episodes =
                run_episodes(&environment, 3, 0..n, threads, |_| None, policy, |_| ()).unwrap();
            episodes.into_iter().map(Result::unwrap).collect::<Vec<_>>()
        };
        let one = run(1);
        assert_eq!(one, run(2), "{name}");
        assert!(one.windows(2).any(|pair| pair[0].digest != pair[1].digest), "{name}");
        assert!(
            one.iter().all(|summary| summary.length <= 400 && !summary.outcome.is_empty()),
            "{name}"
        );
    }
}

#[test]
fn a_match_is_counted() {
    let environment = environment(stdlib("benchmark/11_vs_11_stochastic"), &["scoring"]);
    let policy = || ReadyMade::new(Agent::Bot);
    let mut episodes = run_episodes(&environment, 1, 0..1, 1, |_| None, policy, |_| ()).unwrap();
    let summary = episodes.pop().unwrap().unwrap();
    assert_eq!((summary.length, summary.truncated), (3000, true));
    let statistics = &summary.statistics;
    assert_eq!(statistics.goals, u32::from(summary.score[0] + summary.score[1]));
    assert!(statistics.passes > 0 && statistics.pass_completion <= 1.0, "{statistics:?}");
    assert!((statistics.thirds.iter().sum::<f64>() - 1.0).abs() < 1e-9);
    assert!(statistics.crowding > 0.0 && statistics.crowding < 1.0);
    assert!(statistics.teams.iter().all(|team| team.distance_m > 1000.0), "{statistics:?}");
    println!("{statistics:#?}");
}

#[test]
fn who_is_absent_has_no_place() {
    let reads = [
        "distance(ghost, ball) < 300m",
        "ghost in pitch",
        "ghost.speed < 300m/s",
        "pressed(ghost, within: 300m)",
        "distance(me, ghost) < 300m",
        "sees(me, ghost, within: 180deg)",
        "nearest(left, to: ghost) == striker",
        "ghost in right",
        "ghost in them",
        "ghost in players",
    ];
    let scripted = [
        "distance(ghost, now.ball) < 300.0",
        "ghost.x > -2.0",
        "ghost.at.y > -2.0",
        "ghost.speed < 300.0",
        "speed(ghost) < 300.0",
        "ghost.fatigue < 2.0",
        "ghost.action != ()",
        "ghost.active",
        "pressed(ghost, 300.0)",
        "now.them.players.contains(ghost)",
    ];
    let reads = reads.map(|read| format!("reward r {{ give 1 when {read} as \"seen\" }}"));
    let scripted = scripted.map(|read| {
        format!(
            "reward script rhai \"\"\"
                fn reward(ctx, now, prev, events) {{
                    let ghost = now.named.ghost;
                    if {read} {{ 1 }} else {{ 0 }}
                }}
            \"\"\" as \"seen\""
        )
    });
    for read in reads.into_iter().chain(scripted) {
        let text = |share| {
            format!(
                "scenario t extends academy {{
                    ball at (0.5, 0)
                    team left {{ GK at (-1, 0)  striker: CF at (0.48, 0) }}
                    team right {{ GK at (1, 0)  maybe {share}% ghost: CB at (0.6, 0) }}
                    {read}
                    agents {{ left: 1 }}
                }}"
            )
        };
        let [absent, there] = [0, 100].map(|share| {
            let mut env = setpiece_tests::environment(&text(share));
            env.reset(Some(0), Some(0)).unwrap();
            env.step(&[Action::Idle], &mut Scratch::default()).unwrap();
            let terms = env.terms(0);
            assert!(!terms.is_empty(), "{read}");
            terms.last().copied().unwrap()
        });
        assert_eq!((absent, there), (0.0, 1.0), "{read}");
    }
}

#[test]
fn who_is_absent_ends_nothing_and_has_no_record_and_no_view() {
    let play = |share| {
        let mut env = setpiece_tests::environment(&format!(
            "scenario t extends academy {{
                ball at (0.5, 0)
                agents {{ left: all }}
                team left {{ striker: CF at (0.48, 0)  maybe {share}% mate: CF at (0.4, 0.2) }}
                team right {{ GK at (1, 0)  maybe {share}% ghost: CB at (0.6, 0) }}
                record fastest = max of ghost.speed
                record near = min of distance(ghost, ball)
                record place = last of ghost
                record member = count of (ghost in right)
                record closest = last of nearest(mates, to: ball).x
                record side = last of ghost.team
                end seen when ghost in pitch and elapsed > 0.2s
                end limit 5 steps
                observe vector {{ ghost as \"ghost\"  exists(ghost) as \"there\"  ghost.speed as \"speed\" }}
            }}"
        ));
        env.reset(Some(0), Some(0)).unwrap();
        while env.is_running() {
            env.step(&[Action::Idle; 2], &mut Scratch::default()).unwrap();
        }
        let mut seen = vec![0.0; 4];
        env.observe(Floats::Vector, 0, &mut seen).unwrap();
        let records: Vec<Option<f64>> = env
            .records()
            .map(|(_, value)| match value {
                Recorded::Place([x, _]) => Some(x).filter(|x| !x.is_nan()),
                Recorded::PerAgent(values) => values[0].number(),
                one => one.number(),
            })
            .collect();
        (env.outcome().unwrap().label.to_string(), seen, records)
    };
    let (outcome, seen, records) = play(0);
    assert_eq!((outcome.as_str(), seen), ("limit", vec![0.0; 4]));
    // The team is the text's, whether or not they play.
    assert_eq!(records, [None, None, None, Some(0.0), None, Some(1.0)]);
    let (outcome, seen, records) = play(100);
    assert_eq!((outcome.as_str(), seen[2]), ("seen", 1.0));
    assert!(records.iter().all(Option::is_some), "{records:?}");
}
