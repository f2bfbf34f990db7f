//! Whole pictures: an episode as a sheet of frames, and one moment large.

use super::canvas::{Canvas, at};
use super::colours::{AGENT, CARD, Colour, DARK, FAINT, INK, PAGE, VERDICTS, faded, shirt};
use super::film::Film;
use super::moments::{COLUMNS, Happening, choose};
use super::stage::{self, TRAIL_STEPS};
use super::text::{Style, fitted, width};
use super::view::{ASPECT, Region};
use super::{caption, words};
use crate::engine::event::Event;
use crate::scenario::Verdict;
use crate::scenario::pitch::STEPS_PER_S;
use tiny_skia::{Pixmap, PixmapMut, PixmapPaint, Transform};

/// Width of a picture of one moment, pixels.
const LARGE: u32 = 1680;
/// Width of a sheet's frame; of one with few frames.
const SMALL: u32 = 624;
const MIDDLE: u32 = 840;
/// Space around and between frames, pixels.
const GAP: u32 = 20;
/// Height of a sheet's head, pixels.
const HEAD: u32 = 108;
/// Grass around the ball's way, metres.
const MARGIN_M: f32 = 12.0;

/// Draws an episode as a sheet of frames; none where a picture of its size can't be had.
pub fn sheet(film: &Film) -> Option<Pixmap> {
    let happenings: Vec<Happening> =
        film.events.iter().map(|(at, event)| Happening { at: *at, weight: words::weight(event) }).collect();
    let chosen = choose(film.scenes.len(), &happenings);
    let columns = if chosen.len() <= 9 { chosen.len().clamp(1, COLUMNS - 1) } else { COLUMNS } as u32;
    let width = if columns < COLUMNS as u32 { MIDDLE } else { SMALL };
    let rows = (chosen.len() as u32).div_ceil(columns);
    let layout = Layout::new(width, 16.0);
    let region = Region::around(film.scenes.iter().map(|scene| [scene.ball[0], scene.ball[1]]), MARGIN_M);
    let (page_width, page_height) = (columns * (width + GAP) + GAP, HEAD + rows * (layout.height() + GAP));
    let mut page = Pixmap::new(page_width.max(2 * MIDDLE), page_height)?;
    let mut canvas = blank(&mut page);
    head(&mut canvas, film);
    let mut shown = None;
    for (place, &moment) in chosen.iter().enumerate() {
        let (column, row) = (place as u32 % columns, place as u32 / columns);
        let corner = (GAP + column * (width + GAP), HEAD + row * (layout.height() + GAP));
        layout.draw(&mut canvas, corner, film, (shown, moment), region)?;
        shown = Some(moment);
    }
    Some(page)
}

/// Draws one moment of a film large, with what happened on the way; none where there is no such moment.
pub fn frame(film: &Film, moment: usize) -> Option<Pixmap> {
    let layout = Layout::new(LARGE, 24.0);
    let mut page = Pixmap::new(LARGE + 2 * GAP, HEAD + layout.height() + GAP)?;
    let mut canvas = blank(&mut page);
    head(&mut canvas, film);
    let before = moment.checked_sub(TRAIL_STEPS);
    layout.draw(&mut canvas, (GAP, HEAD), film, (before, moment), Region::WHOLE)?;
    Some(page)
}

/// A page without anything on it.
fn blank(page: &mut Pixmap) -> Canvas<'_> {
    let [red, green, blue, opacity] = PAGE;
    page.fill(tiny_skia::Color::from_rgba8(red, green, blue, opacity));
    Canvas { pixels: page.as_mut() }
}

/// A frame: the picture, and its caption below.
struct Layout {
    width: u32,
    picture: u32,
    size: f32,
}

impl Layout {
    fn new(width: u32, size: f32) -> Layout {
        Layout { width, picture: (width as f32 / ASPECT).round() as u32, size }
    }

    fn height(&self) -> u32 {
        self.picture + caption::height(self.size).ceil() as u32
    }

    /// Draws a moment, and says what happened since the one before.
    fn draw(
        &self,
        canvas: &mut Canvas<'_>,
        (left, top): (u32, u32),
        film: &Film,
        (before, moment): (Option<usize>, usize),
        region: Region,
    ) -> Option<()> {
        let first = moment.saturating_sub(TRAIL_STEPS);
        let mut picture = Pixmap::new(self.width, self.picture)?;
        stage::draw(picture.as_mut(), film.scenes.get(first..=moment)?, region);
        let corner = at(left as f32, top as f32);
        canvas.card(corner, self.width as f32, self.height() as f32, 8.0, CARD);
        place(&mut canvas.pixels, &picture, left, top);
        let events: Vec<Event> = film
            .events
            .iter()
            .filter(|(at, _)| before.is_none_or(|before| *at > before) && *at <= moment)
            .map(|(_, event)| *event)
            .collect();
        let below = (at(corner.x, corner.y + self.picture as f32), self.width as f32);
        caption::draw(canvas, below, self.size, film, film.scenes.get(moment)?, words::tell(&events));
        Some(())
    }
}

fn place(page: &mut PixmapMut<'_>, picture: &Pixmap, left: u32, top: u32) {
    let paint = PixmapPaint::default();
    page.draw_pixmap(left as i32, top as i32, picture.as_ref(), &paint, Transform::identity(), None);
}

/// What it is a film of, what came of it, and what the signs mean.
fn head(canvas: &mut Canvas<'_>, film: &Film) {
    let (left, right) = (GAP as f32, canvas.size().0 - GAP as f32);
    let (first, second) = (36.0, 78.0);
    let length = film.length();
    let told = format!("{length} steps, {:.1} s", f64::from(length) / STEPS_PER_S);
    let mut end = right;
    if let Some(last) = film.scenes.last() {
        caption::score(canvas, at(end, first), 30.0, last.score);
        end -= 120.0;
    }
    let mut before = |text: &str, style: Style| {
        canvas.write_before(text, at(end, first), style);
        end -= width(text, style) + 24.0;
    };
    before(&told, Style::plain(24.0, INK));
    if let Some(outcome) = &film.outcome {
        let colour = match outcome.verdict {
            Some(Verdict::Success) => VERDICTS[0],
            Some(Verdict::Failure) => VERDICTS[1],
            None => INK,
        };
        before(&fitted(&outcome.label, Style::bold(24.0, colour), 400.0), Style::bold(24.0, colour));
    }
    let style = Style::bold(34.0, INK);
    let mut x = left;
    x += canvas.write(&fitted(&film.name, style, (end - left) * 0.6), at(x, first), style) + 24.0;
    let style = Style::plain(24.0, FAINT);
    canvas.write(&fitted(&film.origin, style, end - x), at(x, first), style);
    legend(canvas, left, right, second);
}

/// What the signs mean.
fn legend(canvas: &mut Canvas<'_>, left: f32, right: f32, y: f32) {
    use crate::scenario::Team::{Left, Right};
    type Sign<'a> = (&'a str, &'a dyn Fn(&mut Canvas<'_>, tiny_skia::Point));
    let disc = |colour: Colour| move |canvas: &mut Canvas<'_>, middle| canvas.disc(middle, 9.0, colour);
    let cloths = [(Left, false), (Left, true), (Right, false), (Right, true)]
        .map(|(team, keeper)| disc(shirt(team, keeper).cloth));
    let ringed = |canvas: &mut Canvas<'_>, middle| {
        canvas.disc(middle, 9.0, DARK);
        canvas.ring(middle, 7.5, 3.0, AGENT);
    };
    let glow = |canvas: &mut Canvas<'_>, middle| {
        canvas.disc(middle, 11.0, faded(AGENT, 0.35));
        canvas.disc(middle, 6.0, FAINT);
    };
    let signs: [Sign<'_>; 6] = [
        ("left team, attacks →", &cloths[0]),
        ("its keeper", &cloths[1]),
        ("right team, attacks ←", &cloths[2]),
        ("its keeper", &cloths[3]),
        ("played by an agent", &ringed),
        ("has the ball", &glow),
    ];
    let style = Style::plain(19.0, FAINT);
    let mut x = left;
    for (text, sign) in signs {
        sign(canvas, at(x + 10.0, y));
        x += 28.0 + canvas.write(text, at(x + 28.0, y), style) + 30.0;
    }
    let about = fitted("height above the ground stands beside the ball, a line leads to its shadow", style, right - x);
    canvas.write_before(&about, at(right, y), style);
}
