//! Rewards for some agents, and assists, end to end.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

use setpiece::engine::environment::{Environment, Scratch};
use setpiece::engine::state::PlayerId;
use setpiece::engine::state::event::Event;
use setpiece::scenario::{Action, EventKind, Qualifier};
use setpiece_tests::environment;

/// The sum of a term over the episode so far, by agent.
fn sums(environment: &Environment, term: &str) -> Vec<f64> {
    let at = environment.term_names().iter().position(|name| name == term).unwrap();
    (0..environment.n_agents()).map(|agent| environment.term_sums(agent)[at]).collect()
}

const SOME: &str = "reward step { give 1 as \"paid\" }
    reward remembers {
        state n = 0
        n = n + 1
        give n to right as \"counted\"
        give 1 to [GK, CB] once when n > 3 as \"once\"
    }
    scenario some extends academy {
        agents { left: all  right: all }
        ball at (0.3, 0)
        team left { GK at (-1, 0)  ace: CF at (0.28, 0)  CM at (0.2, 0.1) }
        team right { GK at (1, 0)  CB at (0.7, 0) }
        param paid: team = right
        remove reward scoring
        reward step for left as \"left\" * 2
        reward step for ace as \"ace\"
        reward step for CF as \"role\"
        reward step for [ace, CB] as \"both\"
        reward step for paid as \"chosen\"
        reward rest for right { give 1 per second as \"time\" }
        reward remembers
        remove end possession
        end limit 10 steps
    }";

#[test]
fn a_reward_is_paid_to_those_who_are_named() {
    let mut environment = environment(SOME);
    environment.reset(Some(3), None).unwrap();
    let mut scratch = Scratch::default();
    while environment.is_running() {
        environment.step(&[Action::Idle; 5], &mut scratch).unwrap();
    }
    let steps = f64::from(environment.steps());
    let sums = |term: &str| sums(&environment, term);
    // The agents in order: GK, CF, CM of the left, GK, CB of the right.
    let times = |who: [u8; 5]| who.map(|paid| f64::from(paid) * steps).to_vec();
    assert_eq!(sums("left/paid"), times([2, 2, 2, 0, 0]));
    assert_eq!(sums("ace/paid"), times([0, 1, 0, 0, 0]));
    assert_eq!(sums("role/paid"), times([0, 1, 0, 0, 0]));
    assert_eq!(sums("both/paid"), times([0, 1, 0, 0, 1]));
    assert_eq!(sums("chosen/paid"), times([0, 0, 0, 1, 1]));
    let rounded: Vec<f64> = sums("rest/time").iter().map(|sum| (sum * 10.0).round()).collect();
    assert_eq!(rounded, times([0, 0, 0, 1, 1]));
    let counted = steps * (steps + 1.0) / 2.0;
    assert_eq!(sums("remembers/counted"), [0.0, 0.0, 0.0, counted, counted]);
    assert_eq!(sums("remembers/once"), [1.0, 0.0, 0.0, 1.0, 1.0]);
}

const ASSISTED: &str = "reward part {
        give 1 to goal as \"scorer\"
        give 1 to assist as \"assist\"
        give 1 to event.by on assist by us as \"same\"
        give 1 to event.to on assist by us as \"received\"
        give 1 on assist by me as \"mine\"
    }
    scenario assisted extends academy {
        agents { left: all }
        ball at (0.86, 0.2)
        team left {
            GK at (-1, 0) { controllable: off }
            AM at (0.84, 0.2)  CF at (0.88, 0.02)  CF at (0.86, -0.05)
        }
        team right { GK at (1, 0.08) { ai: lazy }  CB at (0.5, -0.1) }
        reward part
        remove end possession
        record assists = count of assist by left
        end limit 100 steps
    }";

/// The passer and the scorer of an assisted goal, by the touches and passes of the whole episode.
fn assist_of(history: &[Event]) -> Option<(PlayerId, PlayerId)> {
    let goal = history.iter().position(|event| event.kind == EventKind::Goal)?;
    let scorer = history[goal].by.filter(|by| history[goal].team == Some(by.team()))?;
    // Backwards from the goal, everyone who touched the ball is the scorer, up to the pass to them.
    for event in history[..goal].iter().rev() {
        let completed =
            event.kind == EventKind::Pass && event.qualifier == Some(Qualifier::Completed);
        if completed && event.to == Some(scorer) {
            return Some((event.by?, scorer));
        }
        let touched = matches!(event.kind, EventKind::Touch | EventKind::Header);
        if touched && event.by != Some(scorer) {
            return None;
        }
    }
    None
}

#[test]
fn the_passer_of_a_goal_is_paid() {
    // A player in front of the goal rarely passes.
    let near = ASSISTED.replace("(0.86, 0.2)", "(0.9, 0)").replace("(0.84, 0.2)", "(0.88, 0)");
    let (assisted, _) = goals(ASSISTED);
    let (_, alone) = goals(&near);
    assert!(assisted > 2 && alone > 2, "{assisted} goals with an assist, {alone} without");
}

/// Plays episodes and checks what they pay; how many had a goal with an assist, and one without.
fn goals(text: &str) -> (u32, u32) {
    let mut environment = environment(text);
    let mut scratch = Scratch::default();
    let (mut assisted, mut alone) = (0, 0);
    for index in 0..240 {
        environment.reset(Some(5), Some(index)).unwrap();
        let mut history: Vec<Event> = Vec::new();
        while environment.is_running() {
            environment.step(&[Action::BuiltinAi; 3], &mut scratch).unwrap();
            history.extend(environment.events());
        }
        let expected = assist_of(&history);
        let found = history.iter().find(|event| event.kind == EventKind::Assist);
        assert_eq!(found.map(|event| (event.by.unwrap(), event.to.unwrap())), expected, "{index}");
        let paid_to = |player: Option<PlayerId>| -> Vec<f64> {
            let is = |agent: usize| environment.agents()[agent].player == player;
            (0..3).map(|agent| f64::from(u8::from(player.is_some() && is(agent)))).collect()
        };
        let passer = expected.map(|(passer, _)| passer);
        for term in ["part/assist", "part/same", "part/mine"] {
            assert_eq!(sums(&environment, term), paid_to(passer), "{term} {index}");
        }
        let scorer = expected.map(|(_, scorer)| scorer);
        assert_eq!(sums(&environment, "part/received"), paid_to(scorer), "{index}");
        let goal = history.iter().find(|event| event.kind == EventKind::Goal);
        if let Some(goal) = goal {
            let scorer = goal.by.filter(|by| goal.team == Some(by.team()));
            let left = scorer.filter(|by| by.index() < 11);
            assert_eq!(sums(&environment, "part/scorer"), paid_to(left), "{index}");
        }
        assisted += u32::from(expected.is_some());
        alone += u32::from(goal.is_some() && expected.is_none());
    }
    (assisted, alone)
}
