use super::*;
use crate::football::begin;
use crate::judge::{MatchView, Sight};
use crate::state::event::Event;
use crate::testing::{checkpoints, event, scenario, scoring};
use setpiece_scenario::vocabulary::{EventKind, Role};

/// A judge with some rewards, two left players who are agents, and a right player.
struct Bench {
    judge: RewardJudge,
    game: Match,
    prev: MatchView,
}

impl Bench {
    fn new(rewards: Vec<Reward>) -> Bench {
        let scenario = scenario(&[
            (Team::Left, Role::CM, 0.0, 0.0),
            (Team::Left, Role::CF, 10.0, 0.0),
            (Team::Right, Role::CB, 30.0, 0.0),
        ]);
        let choice = crate::draw::AgentsChoice {
            sides: [crate::draw::SideChoice::All, crate::draw::SideChoice::All],
            fixed: Some(true),
        };
        let bindings = setpiece_scenario::Bindings::default();
        let roster = crate::draw::Roster::new(&scenario, &bindings, Some(&choice)).unwrap();
        let drawn =
            crate::draw::Drawer::new(&scenario).draw(&scenario, &bindings, &roster, 1, 0).unwrap();
        let game = begin::blank(&drawn);
        let scripts = Scripts::compile(&scenario).unwrap();
        let mut bench = Bench {
            judge: RewardJudge::new(rewards.into(), &scripts, 3),
            game,
            prev: MatchView::EMPTY,
        };
        bench.prev = MatchView::of(&bench.game);
        let input = input(&bench.prev, &bench.prev, &[]);
        bench.judge.reset(&bench.game, &input);
        bench
    }

    /// Plays a step with the ball at a normalised place, owned by a player or nobody.
    fn step(&mut self, ball: (f64, f64), owner: Option<u8>, events: &[Event]) -> Vec<f32> {
        let (x, y) = setpiece_scenario::pitch::to_metres(ball.0, ball.1);
        self.game.ball.pos = glam::Vec3::new(x as f32, y as f32, 0.11);
        self.game.owner = owner.map(PlayerId);
        let now = MatchView::of(&self.game);
        self.judge.step(&self.game, &input(&now, &self.prev, events), None).unwrap();
        self.prev = now;
        self.judge.paid().to_vec()
    }
}

fn input<'a>(now: &'a MatchView, prev: &'a MatchView, events: &'a [Event]) -> Input<'a> {
    let us = Team::Left;
    let (now, prev) = (Some(Sight::Kept(now)), Some(Sight::Kept(prev)));
    Input {
        now,
        prev,
        events,
        params: &[],
        lets: &[],
        index: 0,
        us,
        round: 1,
        round_start: 0,
        terminated: false,
        silent: false,
    }
}

#[test]
fn scoring_pays_each_side_its_own() {
    let mut bench = Bench::new(vec![scoring()]);
    let goal = event(EventKind::Goal, Some(Team::Left), Some(0));
    assert_eq!(bench.step((0.9, 0.0), None, &[goal]), [1.0, 1.0, -1.0]);
    assert_eq!(bench.step((0.0, 0.0), None, &[]), [0.0, 0.0, 0.0]);
    assert_eq!(bench.judge.names(), ["scoring/1", "scoring/2"]);
    assert_eq!(bench.judge.sums(2), [0.0, -1.0]);
}

#[test]
fn checkpoints_pay_a_tenth_per_region_and_the_rest_on_the_first_goal() {
    let mut bench = Bench::new(vec![checkpoints()]);
    // Thresholds of GRF: 0.99 - (0.8 / 9) c from (1, 0).
    let thresholds: Vec<f64> = (0..10).map(|c| 0.99 - 0.8 / 9.0 * f64::from(c)).collect();
    assert_eq!(bench.step((1.0 - thresholds[0] - 0.001, 0.0), Some(0), &[]), [0.0, 0.0, 0.0]);
    // The agent who has the ball is paid, and no other.
    let paid = bench.step((1.0 - thresholds[0] + 0.001, 0.0), Some(0), &[]);
    assert!((paid[0] - 0.1).abs() < 1e-6 && paid[1] == 0.0, "{paid:?}");
    assert_eq!(bench.step((1.0 - thresholds[0] + 0.001, 0.0), Some(0), &[])[0], 0.0);
    // Three further regions in one stride.
    let paid = bench.step((1.0 - thresholds[3] + 0.001, 0.0), Some(0), &[]);
    assert!((paid[0] - 0.3).abs() < 1e-6, "{paid:?}");
    // A ball without an owner pays nothing.
    assert_eq!(bench.step((0.95, 0.0), None, &[]), [0.0, 0.0, 0.0]);
    let goal = event(EventKind::Goal, Some(Team::Left), Some(0));
    let paid = bench.step((1.02, 0.0), None, &[goal]);
    assert!(
        (paid[0] - 0.6).abs() < 1e-6 && (paid[1] - 1.0).abs() < 1e-6 && paid[2] == 0.0,
        "{paid:?}"
    );
    // Everything has been paid already.
    assert_eq!(bench.step((1.02, 0.0), Some(0), &[goal]), [0.0, 0.0, 0.0]);
    for agent in 0..2 {
        let total: f64 = bench.judge.sums(agent).iter().sum();
        assert!((total - 1.0).abs() < 1e-9, "{total}");
    }
}

#[test]
fn the_right_side_measures_from_its_own_end() {
    let mut bench = Bench::new(vec![checkpoints()]);
    let paid = bench.step((-0.5, 0.0), Some(11), &[]);
    // d = 0.5: regions with thresholds 0.99 down to 0.5456.
    assert!((paid[2] - 0.6).abs() < 1e-6, "{paid:?}");
}

#[test]
fn a_player_off_the_pitch_is_paid_nothing_for_what_is_his() {
    let mut bench = Bench::new(vec![checkpoints(), scoring()]);
    bench.game.players[0].active = false;
    let goal = event(EventKind::Goal, Some(Team::Left), Some(1));
    assert_eq!(bench.step((0.9, 0.0), None, &[]), [0.0, 0.0, 0.0]);
    assert_eq!(bench.step((0.9, 0.0), None, &[goal])[0], 2.0);
}

#[test]
fn a_new_episode_forgets() {
    let mut bench = Bench::new(vec![checkpoints()]);
    bench.step((0.95, 0.0), Some(0), &[]);
    let start = bench.prev;
    bench.judge.reset(&bench.game, &input(&start, &start, &[]));
    assert_eq!(bench.judge.sums(0), [0.0, 0.0]);
    let paid = bench.step((0.95, 0.0), Some(0), &[]);
    assert!((paid[0] - 1.0).abs() < 1e-6);
}
