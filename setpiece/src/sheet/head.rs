//! The header of a page: the episode, its result, and a legend.

use super::canvas::{Canvas, at};
use super::caption;
use super::colours::{AGENT, DARK, FAINT, INK, VERDICTS, faded, shirt};
use super::text::{Style, fitted, width};
use crate::film::Film;
use crate::scenario::Verdict;
use crate::scenario::pitch::STEPS_PER_S;
use tiny_skia::Point;

/// Its height, pixels.
pub const HEIGHT: u32 = 108;

/// Draws it over the whole width of a page, except a margin.
pub fn draw(canvas: &mut Canvas<'_>, film: &Film, margin: f32) {
    let (left, right) = (margin, canvas.size().0 - margin);
    let (first, second) = (36.0, 78.0);
    let length = film.length();
    let length = format!("{length} steps, {:.1} s", f64::from(length) / STEPS_PER_S);
    let mut end = right;
    if let Some(last) = film.scenes.last() {
        caption::score(canvas, at(end, first), 30.0, last.score);
        end -= 120.0;
    }
    let mut before = |text: &str, style: Style| {
        canvas.write_before(text, at(end, first), style);
        end -= width(text, style) + 24.0;
    };
    before(&length, Style::plain(24.0, INK));
    if let Some(outcome) = &film.outcome {
        let colour = match outcome.verdict {
            Some(Verdict::Success) => VERDICTS[0],
            Some(Verdict::Failure) => VERDICTS[1],
            None => INK,
        };
        before(
            &fitted(&outcome.label, Style::bold(24.0, colour), 400.0),
            Style::bold(24.0, colour),
        );
    }
    let style = Style::bold(34.0, INK);
    let mut x = left;
    x += canvas.write(&fitted(&film.name, style, (end - left) * 0.6), at(x, first), style) + 24.0;
    let style = Style::plain(24.0, FAINT);
    canvas.write(&fitted(&film.origin, style, end - x), at(x, first), style);
    let style = Style::plain(20.0, FAINT);
    let from = legend(canvas, right, second);
    canvas.write(&fitted(&film.title, style, from - left - 40.0), at(left, second), style);
}

/// Draws a sign around a point.
type Sign<'a> = &'a dyn Fn(&mut Canvas<'_>, Point);

/// Draws the legend, ending at a point; returns where it begins.
fn legend(canvas: &mut Canvas<'_>, right: f32, y: f32) -> f32 {
    use crate::scenario::Team::{Left, Right};
    let agent = |canvas: &mut Canvas<'_>, middle| {
        canvas.disc(middle, 9.0, DARK);
        canvas.ring(middle, 7.5, 3.0, AGENT);
    };
    let owner = |canvas: &mut Canvas<'_>, middle| {
        canvas.disc(middle, 11.0, faded(AGENT, 0.35));
        canvas.disc(middle, 6.0, FAINT);
    };
    let cloth = |team, keeper| {
        move |canvas: &mut Canvas<'_>, middle: Point| {
            canvas.disc(middle, 9.0, shirt(team, keeper).cloth);
        }
    };
    let [left, left_keeper, right_team, right_keeper] =
        [(Left, false), (Left, true), (Right, false), (Right, true)]
            .map(|(team, keeper)| cloth(team, keeper));
    // From the right.
    let signs: [(&str, Sign<'_>); 6] = [
        ("has the ball", &owner),
        ("played by an agent", &agent),
        ("its keeper", &right_keeper),
        ("right team ←", &right_team),
        ("its keeper", &left_keeper),
        ("left team →", &left),
    ];
    let style = Style::plain(19.0, FAINT);
    let mut x = right;
    for (text, sign) in signs {
        canvas.write_before(text, at(x, y), style);
        x -= width(text, style) + 18.0;
        sign(canvas, at(x, y));
        x -= 36.0;
    }
    x
}
