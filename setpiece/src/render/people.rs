//! The players: discs in their team's colours with a number, their direction, and their pose.
//!
//! Players are drawn larger than life, so that their numbers can be read.

use super::canvas::{Canvas, at};
use super::colours::{AGENT, CARD_YELLOW, Colour, DARK, SHADOW, faded, shirt};
use super::scene::{Person, SheetScene};
use super::text::Style;
use super::view::View;
use crate::engine::state::PlayerId;
use crate::engine::state::player::Pose;
use tiny_skia::Point;

/// Radius of a player's disc, metres, and its least, pixels.
const RADIUS_M: f32 = 0.98;
const RADIUS_LEAST: f32 = 8.5;

/// Draws everyone on the pitch, the owner of the ball last.
pub fn draw(canvas: &mut Canvas<'_>, view: &View, scene: &SheetScene) {
    let mut people: Vec<&Person> = scene.people.iter().collect();
    people.sort_by_key(|person| (person.pose == Pose::Up, scene.owner == Some(person.id)));
    for person in people {
        player(canvas, view, person, scene);
    }
}

/// Draws everyone's trail to their place in the last scene.
pub fn draw_trails(canvas: &mut Canvas<'_>, view: &View, scenes: &[SheetScene]) {
    let Some(now) = scenes.last() else { return };
    for person in &now.people {
        let places = scenes.iter().filter_map(|scene| scene.person(person.id));
        let points: Vec<Point> = places.map(|then| view.point(then.pos[0], then.pos[1])).collect();
        canvas.tail(
            &points,
            radius(view) * 1.1,
            faded(shirt(person.id.team(), person.keeper).cloth, 0.85),
        );
    }
}

/// The radius of a player's disc, pixels.
pub fn radius(view: &View) -> f32 {
    view.length(RADIUS_M).max(RADIUS_LEAST)
}

/// A player's number in their shirt, as captions show it.
pub fn badge(canvas: &mut Canvas<'_>, middle: Point, radius: f32, id: PlayerId, keeper: bool) {
    let shirt = shirt(id.team(), keeper);
    canvas.disc(middle, radius, shirt.cloth);
    number(canvas, middle, radius, id, shirt.number);
}

fn number(canvas: &mut Canvas<'_>, middle: Point, radius: f32, id: PlayerId, colour: Colour) {
    canvas.write_centred(&id.in_team().to_string(), middle, Style::bold(radius * 1.32, colour));
}

fn player(canvas: &mut Canvas<'_>, view: &View, person: &Person, scene: &SheetScene) {
    let shirt = shirt(person.id.team(), person.keeper);
    let (middle, radius) = (view.point(person.pos[0], person.pos[1]), radius(view));
    let edge = (radius * 0.16).max(1.2);
    let [x, y] = match person.pose {
        Pose::Diving => unit(person.vel).unwrap_or(person.facing),
        _ => person.facing,
    };
    let along = |forward: f32, left: f32| {
        at(
            middle.x + radius * (forward * x + left * y),
            middle.y + radius * (forward * y - left * x),
        )
    };
    let shade = at(middle.x + radius * 0.16, middle.y + radius * 0.28);
    canvas.disc(shade, radius * 1.08, SHADOW);
    if scene.owner == Some(person.id) {
        canvas.disc(middle, radius * 1.75, faded(AGENT, 0.3));
    }
    let body = |canvas: &mut Canvas<'_>, from: f32, to: f32, width: f32| {
        let ends = [along(from, 0.0), along(to, 0.0)];
        canvas.line(&ends, radius * width + 2.0 * edge, shirt.edge);
        canvas.line(&ends, radius * width, shirt.cloth);
    };
    match person.pose {
        Pose::Up | Pose::Stumbling { .. } => {
            canvas.polygon(&[along(0.2, 1.15), along(2.05, 0.0), along(0.2, -1.15)], shirt.edge);
            canvas.polygon(&[along(0.4, 0.8), along(1.62, 0.0), along(0.4, -0.8)], shirt.cloth);
        }
        Pose::Sliding => {
            // Skid marks behind, the leg ahead.
            for left in [-0.45, 0.45] {
                canvas.line(
                    &[along(-1.0, left), along(-2.9, left)],
                    radius * 0.16,
                    faded(AGENT, 0.55),
                );
            }
            body(canvas, 0.0, 2.1, 0.62);
        }
        Pose::Down => body(canvas, -1.2, 1.5, 0.8),
        Pose::Diving => {
            body(canvas, -1.3, 1.5, 0.85);
            for left in [-0.55, 0.55] {
                canvas.disc(along(2.05, left), radius * 0.36 + edge * 0.7, shirt.edge);
                canvas.disc(along(2.05, left), radius * 0.36, AGENT);
            }
        }
    }
    canvas.disc(middle, radius, shirt.edge);
    let cloth =
        if person.pose == Pose::Down { mixed(shirt.cloth, shirt.edge) } else { shirt.cloth };
    canvas.disc(middle, radius - edge, cloth);
    if person.agent {
        canvas.ring(middle, radius + edge * 0.9, edge * 2.2, DARK);
        canvas.ring(middle, radius + edge * 0.9, edge * 1.3, AGENT);
    }
    number(canvas, beside_ball(middle, radius, view, scene), radius, person.id, shirt.number);
    for card in 0..person.yellow_cards {
        let corner = at(middle.x + radius * (0.6 + 0.5 * f32::from(card)), middle.y - radius * 1.5);
        canvas.card(corner, radius * 0.55, radius * 0.8, 1.0, CARD_YELLOW);
        canvas.outline(corner, (radius * 0.55, radius * 0.8), 1.0, 0.8, DARK);
    }
}

/// The place of a number: in the middle, or a little aside if the ball would hide it.
fn beside_ball(middle: Point, radius: f32, view: &View, scene: &SheetScene) -> Point {
    let ball = view.point(scene.ball[0], scene.ball[1]);
    let (x, y) = (middle.x - ball.x, middle.y - ball.y);
    let away = x.hypot(y);
    let aside = (radius * 0.5 - (away - radius * 0.7).max(0.0)).max(0.0);
    if away < 0.1 { middle } else { at(middle.x + x / away * aside, middle.y + y / away * aside) }
}

fn unit([x, y]: [f32; 2]) -> Option<[f32; 2]> {
    let length = x.hypot(y);
    (length > 0.1).then(|| [x / length, y / length])
}

/// Halfway between two colours.
fn mixed(first: Colour, second: Colour) -> Colour {
    std::array::from_fn(|part| u8::midpoint(first[part], second[part]))
}
