//! Draws in regions are uniform by area, for every shape.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

use setpiece::engine::environment::{Environment, EnvironmentOptions};

const DRAWS: u64 = 6000;

/// Ball places, metres, of many starts of a scenario whose ball lies in `region`.
fn balls(region: &str) -> Vec<(f64, f64)> {
    let text = format!(
        "scenario s {{ ball in {region}  team left {{ CM at (-50m, -30m) }}  end limit 1 step }}"
    );
    let loaded =
        setpiece::compile_text(&text, "<test>").unwrap_or_else(|error| panic!("{region}: {error}"));
    let mut environment = Environment::new(loaded.scenario, EnvironmentOptions::default()).unwrap();
    let place = |index| {
        environment.reset(Some(7), Some(index)).unwrap();
        let at = environment.state().ball.pos;
        (f64::from(at.x), f64::from(at.y))
    };
    (0..DRAWS).map(place).collect()
}

/// Compares the share of draws that meet a condition with the share of the area that does.
fn share(region: &str, expected: f64, meets: impl Fn(f64, f64) -> bool) {
    let places = balls(region);
    let found = places.iter().filter(|(x, y)| meets(*x, *y)).count() as f64 / DRAWS as f64;
    // Four standard deviations.
    let margin = 4.0 * (expected * (1.0 - expected) / DRAWS as f64).sqrt() + 1e-9;
    assert!(
        (found - expected).abs() <= margin,
        "{region}: {found} instead of {expected} ± {margin}"
    );
}

#[test]
fn an_l_shaped_polygon_is_filled_evenly() {
    // A square of 20 m without its upper right quarter.
    let l = "polygon((0m, 0m), (20m, 0m), (20m, 10m), (10m, 10m), (10m, 20m), (0m, 20m))";
    share(l, 1.0, |x, y| {
        (0.0..=20.0).contains(&x) && (0.0..=20.0).contains(&y) && (x <= 10.0 || y <= 10.0)
    });
    share(l, 1.0 / 3.0, |x, _| x > 10.0);
    share(l, 1.0 / 3.0, |x, y| x < 10.0 && y < 10.0);
}

#[test]
fn a_sector_is_filled_evenly() {
    let half = "sector((0m, 0m), 20m, 90deg, 270deg)";
    share(half, 1.0, |x, y| x <= 1e-4 && x.hypot(y) <= 20.001);
    share(half, 0.25, |x, y| x.hypot(y) < 10.0);
    share(half, 0.5, |_, y| y > 0.0);
    share("sector((0m, 0m), 20m, 0deg, 360deg)", 0.5, |x, _| x > 0.0);
}

#[test]
fn what_two_parts_of_a_union_share_is_not_drawn_more_often() {
    // Two rectangles of 10 m by 10 m that overlap by 5 m by 10 m: 150 m² in total.
    let union = "rect((0m, 0m), (10m, 10m)) | rect((5m, 0m), (15m, 10m))";
    share(union, 1.0, |x, y| (0.0..=15.0).contains(&x) && (0.0..=10.0).contains(&y));
    share(union, 1.0 / 3.0, |x, _| (5.0..10.0).contains(&x));
    share("rect((0m, 0m), (10m, 10m)) | rect((20m, 0m), (50m, 10m))", 0.25, |x, _| x < 10.0);
}

#[test]
fn differences_and_intersections_are_filled_evenly() {
    let ring = "circle(centre, 20m) - circle(centre, 10m)";
    share(ring, 1.0, |x, y| (9.999..=20.001).contains(&x.hypot(y)));
    share(ring, (225.0 - 100.0) / 300.0, |x, y| x.hypot(y) < 15.0);
    let corner = "right.half & flank.bottom";
    share(corner, 1.0, |x, y| x >= 0.0 && y >= 20.14);
    share(corner, 0.5, |x, _| x > 27.5);
    // The D: the part of the disc around the penalty spot outside the box.
    share("right.d", 1.0, |x, y| x <= 38.51 && (x - 44.0).hypot(y) <= 9.16);
}

#[test]
fn a_polygon_whose_corners_are_drawn_is_filled_all_the_same() {
    let text = "scenario s {
        let w = uniform(5m, 15m)
        ball in polygon((0m, -w), (20m, 0m), (0m, w))
        team left { CM at (-50m, -30m) }
        end limit 1 step
    }";
    let loaded = setpiece::compile_text(text, "<test>").unwrap();
    let mut environment = Environment::new(loaded.scenario, EnvironmentOptions::default()).unwrap();
    let mut near = 0;
    for index in 0..DRAWS {
        environment.reset(Some(3), Some(index)).unwrap();
        let at = environment.state().ball.pos;
        assert!(
            (0.0..=20.0).contains(&at.x) && at.y.abs() <= 15.0 * (1.0 - at.x / 20.0) + 1e-3,
            "{at}"
        );
        near += u32::from(at.x < 10.0);
    }
    // Three quarters of a triangle's area are in the half next to its base, however wide it is.
    let share = f64::from(near) / DRAWS as f64;
    assert!((share - 0.75).abs() < 0.023, "{share}");
}

#[test]
fn who_may_overlap_may_be_drawn_onto_another() {
    let text = |overlap: &str| {
        format!(
            "formation kicking {{ GK at (-1, 0)  CB at (-0.5, 0.1)  CB at (-0.5, 0.3) }}
            formation receiving {{ GK at (-1, 0)  CB at (-0.6, 0.1)  CB at (-0.6, 0.101) }}
            scenario close {{
                kickoff choice(left, right) {{ kicking: kicking, receiving: receiving }}
                team left {{ {overlap} }}
                team right {{ {overlap} }}
                end limit 10 steps
            }}"
        )
    };
    assert!(setpiece::compile_text(&text(""), "<test>").is_err());
    let loaded = setpiece::compile_text(&text("each all { overlap: allowed }"), "<test>").unwrap();
    let mut environment = Environment::new(loaded.scenario, EnvironmentOptions::default()).unwrap();
    environment.reset(Some(1), Some(0)).unwrap();
}
