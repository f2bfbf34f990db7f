//! Sources of levels: curricula, lists, samplers.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

use setpiece::engine::batch::EpisodeSummary;
use setpiece::engine::environment::{Environment, EnvironmentOptions};
use setpiece::levels::{
    ChosenLevel, CurriculumRun, LevelScore, LevelSource, ListedLevel, ListedLevels, Numbering,
    PrioritizedLevels, RandomizedLevels, ReplayOptions,
};
use setpiece::plans::plans_of_text;
use setpiece::scenario::plan::{Curriculum, Played};
use setpiece::scenario::{Bindings, Verdict};

const COURSE: &str = "
scenario near { ball at (0.9, 0)  team left { CF at (0.85, 0) }  end limit 50 steps }
scenario far extends near {
    param gap = 2m in 1m..21m
    param n: int = 1 in [1, 4, 9]
    ball at (50m, 0m)
}
curriculum course {
    stage first = near until success_rate(last: 4) > 70% or steps > 1000
    stage second = near until episodes >= 3
    stage third = far(gap: d) adapt d from 1m to 21m keeping success_rate(last: 2) in 40%..60%
    mix current: 75%, earlier: 25%
}
";

fn curriculum(text: &str) -> Curriculum {
    let loaded = plans_of_text(text, "<test>").unwrap_or_else(|error| panic!("{error}"));
    loaded.plans.curricula.into_iter().next().unwrap()
}

/// The result of an episode of twenty steps.
fn result(source: &dyn LevelSource, success: bool) -> EpisodeSummary {
    let scenario = source.scenarios().remove(0).scenario;
    let environment = Environment::new(scenario, EnvironmentOptions::default()).unwrap();
    let verdict = Some(if success { Verdict::Success } else { Verdict::Failure });
    EpisodeSummary { verdict, length: 20, ..EpisodeSummary::of(&environment) }
}

/// Plays some levels in a row, all of them with success or none.
fn play(source: &mut dyn LevelSource, levels: usize, success: bool) -> Vec<ChosenLevel> {
    let result = result(source, success);
    let play = |_| {
        let level = source.next().unwrap();
        source.report(&level, &result, &[]);
        level
    };
    (0..levels).map(play).collect()
}

#[test]
fn a_stage_ends_when_a_goal_is_reached() {
    let mut run = CurriculumRun::new(curriculum(COURSE), Some(7)).unwrap();
    assert_eq!(run.stage(), 0);
    // Three of four aren't more than 70 % before four have been played.
    play(&mut run, 3, true);
    assert_eq!(run.stage(), 0);
    play(&mut run, 1, true);
    assert_eq!(run.stage(), 1, "the rate is reached");
    // Levels of the first stage don't count for the second.
    let second: Vec<_> = play(&mut run, 40, false);
    assert_eq!(run.stage(), 2, "three episodes");
    assert!(second.iter().any(|level| level.scenario == 0), "earlier stages are mixed in");
    let mut failing = CurriculumRun::new(curriculum(COURSE), Some(7)).unwrap();
    play(&mut failing, 50, false);
    assert_eq!(failing.stage(), 0);
    play(&mut failing, 1, false);
    assert_eq!(failing.stage(), 1, "more than 1000 steps");
}

#[test]
fn earlier_stages_have_their_share() {
    let mut run = CurriculumRun::new(curriculum(COURSE), Some(1)).unwrap();
    play(&mut run, 100, true);
    assert_eq!(run.stage(), 2);
    let levels = play(&mut run, 4_000, false);
    let share = |stage| levels.iter().filter(|level| level.scenario == stage).count() as f64 / 4e3;
    assert!((share(2) - 0.75).abs() < 0.03, "{}", share(2));
    assert!((share(0) - 0.125).abs() < 0.03 && (share(1) - 0.125).abs() < 0.03);
}

#[test]
fn a_value_moves_so_that_its_measure_stays_in_the_band() {
    let mut run = CurriculumRun::new(curriculum(COURSE), Some(1)).unwrap();
    play(&mut run, 100, true);
    let value = |run: &CurriculumRun| run.value().unwrap();
    // Whoever is good up to 12 m stays about there.
    let good = result(&run, true);
    let bad = result(&run, false);
    for _ in 0..2_000 {
        let level = run.next().unwrap();
        let is_good = level.bindings.0.first().is_none_or(|gap| *gap < 12.0);
        run.report(&level, if is_good { &good } else { &bad }, &[]);
    }
    assert!((10.0..=13.0).contains(&value(&run)), "{}", value(&run));
    let levels = play(&mut run, 200, true);
    assert_eq!(value(&run), 21.0, "it has come to its end");
    let scenario = run.plan().stages[2].played.scenario.clone();
    for level in levels.iter().filter(|level| level.scenario == 2) {
        for (param, value) in scenario.params.iter().zip(&level.bindings.0) {
            assert!(param.admit(*value).is_ok(), "{value}");
        }
    }
    play(&mut run, 2_000, false);
    assert_eq!(value(&run), 1.0);
}

#[test]
fn a_level_that_began_before_a_move_does_not_count() {
    let mut run = CurriculumRun::new(curriculum(COURSE), Some(1)).unwrap();
    let (good, bad) = (result(&run, true), result(&run, false));
    let early: Vec<_> = (0..20).map(|_| run.next().unwrap()).collect();
    for level in &early[..4] {
        run.report(level, &good, &[]);
    }
    assert_eq!(run.stage(), 1);
    for level in &early[4..] {
        run.report(level, &bad, &[]);
    }
    assert_eq!(run.stage(), 1, "three episodes of the first stage aren't of the second");
}

/// Continues a copy whose state has been saved as text.
fn restored<T: LevelSource>(source: &dyn LevelSource, mut other: T) -> T {
    other.restore(&source.save()).unwrap();
    other
}

#[test]
fn a_saved_state_continues_as_the_original() {
    let mut run = CurriculumRun::new(curriculum(COURSE), Some(1)).unwrap();
    play(&mut run, 37, true);
    let mut other = restored(&run, CurriculumRun::new(curriculum(COURSE), None).unwrap());
    assert_eq!(play(&mut run, 300, true), play(&mut other, 300, true));
    let mut random = RandomizedLevels::new(far(), vec![0, 1], Some(3));
    random.next();
    let mut other = restored(&random, RandomizedLevels::new(far(), vec![0, 1], None));
    assert_eq!(play(&mut random, 9, true), play(&mut other, 9, true));
    let mut again = prioritized(LevelScore::Learnability, Some(3));
    for success in [true, false, true] {
        play(&mut again, 30, success);
    }
    let mut other = restored(&again, prioritized(LevelScore::Learnability, None));
    assert_eq!(play(&mut again, 99, true), play(&mut other, 99, true));
}

#[test]
fn a_state_of_something_else_is_refused() {
    let mut run = CurriculumRun::new(curriculum(COURSE), Some(1)).unwrap();
    play(&mut run, 5, true);
    let before = run.save();
    let read = || serde_json::from_str::<serde_json::Value>(&before).unwrap();
    let mut other = read();
    other["memory"]["stages"][0] = "walk".into();
    assert!(run.restore(&other.to_string()).unwrap_err().contains("`walk`"));
    for (key, wrong) in [
        ("stage", serde_json::json!(7)),
        ("moved", serde_json::json!(21)),
        ("phase", serde_json::json!({ "episodes": 0, "steps": 0, "windows": [] })),
        ("numbering", serde_json::json!(3)),
    ] {
        let mut other = read();
        let place = if key == "numbering" { &mut other } else { &mut other["memory"] };
        place[key] = wrong;
        if key == "phase" {
            place["stage"] = 0.into();
        }
        assert!(run.restore(&other.to_string()).is_err(), "{key}");
        assert_eq!(run.save(), before);
    }
}

fn far() -> Played {
    let scenario = curriculum(COURSE).stages[2].played.scenario.clone();
    Played { bindings: Bindings::defaults(&scenario.params), scenario }
}

fn prioritized(score: LevelScore, seed: Option<u64>) -> PrioritizedLevels {
    let options = ReplayOptions {
        capacity: 10,
        replay: 0.5,
        staleness: 0.1,
        temperature: 0.3,
        edit: 0.0,
        scale: 0.1,
        score,
    };
    PrioritizedLevels::new(RandomizedLevels::new(far(), vec![0], seed), options)
}

#[test]
fn drawn_parameters_are_the_named_ones() {
    let mut random = RandomizedLevels::new(far(), vec![0], Some(3));
    let levels = play(&mut random, 50, true);
    assert!(levels.iter().all(|level| level.bindings.0[1] == 1.0));
    assert!(levels.iter().any(|level| level.bindings.0[0] > 15.0));
    assert_eq!(levels[7].episode, 7);
    random.set_numbering(Numbering::of(Some(3)));
    assert_eq!(random.next().unwrap(), levels[0], "the seed decides");
}

#[test]
fn a_list_begins_again_after_its_end() {
    let random = RandomizedLevels::new(far(), vec![0], Some(3));
    let level = |episode| ListedLevel { scenario: 0, bindings: far().bindings, episode };
    let one = |seed| level(Some((seed, 0)));
    let mut list = ListedLevels::new(random.scenarios(), vec![one(4), one(2)]).unwrap();
    let seeds: Vec<u64> = (0..5).map(|_| list.next().unwrap().seed).collect();
    assert_eq!(seeds, [4, 2, 4, 2, 4]);
    // One without a seed is another episode every time.
    let mut list = ListedLevels::new(random.scenarios(), vec![one(4), level(None)]).unwrap();
    assert_eq!(list.numbering().seed, None);
    list.set_numbering(Numbering::of(Some(9)));
    let played: Vec<_> = (0..4).map(|_| list.next().unwrap()).collect();
    let played: Vec<(u64, u64)> = played.iter().map(|it| (it.seed, it.episode)).collect();
    assert_eq!(played, [(4, 0), (9, 1), (4, 0), (9, 3)]);
    assert!(ListedLevels::new(random.scenarios(), vec![]).is_none());
}

#[test]
fn levels_with_a_high_score_are_played_again() {
    let mut levels = prioritized(LevelScore::Given, Some(3));
    let fresh: Vec<_> = (0..200).map(|_| levels.next().unwrap()).collect();
    assert!(fresh.iter().all(|level| level.tag == 0), "no score, nothing to play again");
    for (at, level) in fresh[..30].iter().enumerate() {
        levels.score(&level.bindings, level.seed, level.episode, at as f64);
    }
    assert_eq!(levels.kept(), 10);
    let again: Vec<_> =
        (0..2_000).map(|_| levels.next().unwrap()).filter(|level| level.tag > 0).collect();
    assert!((800..1_200).contains(&again.len()), "{}", again.len());
    assert!(again.iter().all(|level| (20..30).contains(&level.episode)), "the ten best");
    let best = again.iter().filter(|level| level.episode == 29).count();
    assert!(best > again.len() / 2, "{best}");
    // A level that has become dull is played less.
    levels.score(&fresh[29].bindings, fresh[29].seed, fresh[29].episode, 0.0);
    let again: Vec<_> =
        (0..2_000).map(|_| levels.next().unwrap()).filter(|level| level.tag > 0).collect();
    assert!(again.iter().filter(|level| level.episode == 29).count() < again.len() / 10);
}

#[test]
fn learnability_prefers_levels_between_success_and_failure() {
    let mut levels = prioritized(LevelScore::Learnability, Some(3));
    let (good, bad) = (result(&levels, true), result(&levels, false));
    let mut won = false;
    let mut again = Vec::new();
    for _ in 0..3_000 {
        let level = levels.next().unwrap();
        // Wide levels are a coin's toss, narrow ones are won always.
        won = !won;
        let success = level.bindings.0[0] < 15.0 || won;
        levels.report(&level, if success { &good } else { &bad }, &[]);
        if level.tag > 0 {
            again.push(level.bindings.0[0]);
        }
    }
    let late = &again[again.len() / 2..];
    let wide = late.iter().filter(|gap| **gap >= 15.0).count();
    assert!(wide > late.len() * 6 / 10, "{wide} of {}", late.len());
}

#[test]
fn edited_levels_keep_their_seed_and_stay_allowed() {
    let options = ReplayOptions {
        capacity: 4,
        replay: 1.0,
        staleness: 0.0,
        temperature: 0.3,
        edit: 1.0,
        scale: 0.2,
        score: LevelScore::Given,
    };
    let fresh = RandomizedLevels::new(far(), vec![0, 1], Some(3));
    let mut kept = Vec::new();
    let mut levels = PrioritizedLevels::new(fresh, options);
    for score in 0..4 {
        let level = levels.next().unwrap();
        levels.score(&level.bindings, level.seed, level.episode, f64::from(score));
        kept.push((level.bindings, level.episode));
    }
    let edited: Vec<_> = (0..200).map(|_| levels.next().unwrap()).collect();
    let scenario = far().scenario;
    for level in &edited {
        // An edit that changes nothing plays a kept level again: it isn't another one.
        let is_kept = kept.contains(&(level.bindings.clone(), level.episode));
        assert!(level.episode < 4 && (level.tag != 0) == is_kept, "{level:?}");
        for (param, value) in scenario.params.iter().zip(&level.bindings.0) {
            assert!(param.admit(*value).is_ok(), "{value}");
        }
    }
    assert!(edited.iter().any(|level| level.bindings.0[0] != edited[0].bindings.0[0]));
    assert!(edited.iter().any(|level| level.bindings.0[1] != edited[0].bindings.0[1]));
}
