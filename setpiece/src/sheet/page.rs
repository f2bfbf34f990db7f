//! Complete pictures: an episode as a sheet of frames, and one moment large.

use super::canvas::{Canvas, at};
use super::caption::{self, Caption};
use super::colours::{CARD, PAGE};
use super::moments::{Happening, choose};
use super::region::Region;
use super::{head, words};
use crate::engine::state::event::Event;
use crate::film::Film;
use setpiece_render::{Options, Overlays, Renderer};
use tiny_skia::{Pixmap, PixmapMut, PixmapPaint, Transform};

/// Number of steps in a trail.
const TRAIL_STEPS: usize = 12;
/// Width of a picture of one moment, pixels.
const LARGE: u32 = 1680;
/// Width of a sheet, pixels.
const PAGE_WIDTH: u32 = 2580;
/// Space around and between frames, pixels.
const GAP: u32 = 20;
/// Size of a caption's text in a sheet and under one large frame, pixels.
const TEXT: f32 = 16.0;
const LARGE_TEXT: f32 = 24.0;
/// Grass around the ball's path, metres.
const AROUND_BALL_M: f32 = 10.0;
/// Players who come this near to the ball are shown completely, with this much grass around them,
/// metres.
const NEAR_M: f32 = 18.0;
const AROUND_PERSON_M: f32 = 3.5;
/// The same for a goal.
const NEAR_GOAL_M: f32 = 40.0;
const AROUND_GOAL_M: f32 = 10.0;

/// Draws an episode as a sheet of frames. None if a picture of its size can't be allocated.
pub fn sheet(film: &Film) -> Option<Pixmap> {
    let happenings: Vec<Happening> = film
        .events
        .iter()
        .map(|(at, event)| Happening { at: *at, weight: words::weight(event) })
        .collect();
    let region = region(film);
    let columns = if region.aspect() < 1.2 { 5 } else { 4 };
    let chosen = choose(film.scenes.len(), &happenings, columns as usize);
    let before = std::iter::once(None).chain(chosen.iter().copied().map(Some));
    let width = (PAGE_WIDTH - GAP) / columns - GAP;
    let frames: Option<Vec<Frame<'_>>> = chosen
        .iter()
        .zip(before)
        .map(|(&moment, before)| Frame::new(film, before, moment, region, (width, TEXT)))
        .collect();
    let frames = frames?;
    let lines = frames.iter().map(|frame| frame.caption.lines()).max().unwrap_or_default();
    let height = frames.first()?.picture.height() + caption::height(TEXT, lines).ceil() as u32;
    let rows = (frames.len() as u32).div_ceil(columns);
    let mut page = Pixmap::new(PAGE_WIDTH, head::HEIGHT + rows * (height + GAP))?;
    let mut canvas = blank(&mut page);
    head::draw(&mut canvas, film, GAP as f32);
    for (place, frame) in frames.iter().enumerate() {
        let (column, row) = (place as u32 % columns, place as u32 / columns);
        frame.draw(
            &mut canvas,
            (GAP + column * (width + GAP), head::HEIGHT + row * (height + GAP)),
            height,
        );
    }
    Some(page)
}

/// Draws one moment of a film large, with what happened before it. None if the moment doesn't
/// exist.
pub fn frame(film: &Film, moment: usize) -> Option<Pixmap> {
    let frame = Frame::new(
        film,
        moment.checked_sub(TRAIL_STEPS),
        moment,
        Region::WHOLE,
        (LARGE, LARGE_TEXT),
    )?;
    let height =
        frame.picture.height() + caption::height(LARGE_TEXT, frame.caption.lines()).ceil() as u32;
    let mut page = Pixmap::new(LARGE + 2 * GAP, head::HEIGHT + height + GAP)?;
    let mut canvas = blank(&mut page);
    head::draw(&mut canvas, film, GAP as f32);
    frame.draw(&mut canvas, (GAP, head::HEIGHT), height);
    Some(page)
}

/// The part of the pitch that an episode needs: the ball's path, players near it, a goal nearby.
fn region(film: &Film) -> Region {
    Region::around(film.scenes.iter().flat_map(|scene| {
        let ball = [scene.ball.pos[0], scene.ball.pos[1]];
        let within = move |place: [f32; 2], most_m: f32| {
            (place[0] - ball[0]).hypot(place[1] - ball[1]) < most_m
        };
        let present = scene.players.iter().filter(|player| player.present);
        let people = present.map(|player| player.pos).filter(move |&pos| within(pos, NEAR_M));
        let line = 0.5 * scene.pitch.length_m;
        let goals =
            [[line, 0.0], [-line, 0.0]].into_iter().filter(move |&goal| within(goal, NEAR_GOAL_M));
        std::iter::once((ball, AROUND_BALL_M))
            .chain(people.map(|pos| (pos, AROUND_PERSON_M)))
            .chain(goals.map(|goal| (goal, AROUND_GOAL_M)))
    }))
}

/// An empty page.
fn blank(page: &mut Pixmap) -> Canvas<'_> {
    let [red, green, blue, opacity] = PAGE;
    page.fill(tiny_skia::Color::from_rgba8(red, green, blue, opacity));
    Canvas { pixels: page.as_mut() }
}

/// A frame: the picture, and its caption below.
struct Frame<'a> {
    picture: Pixmap,
    caption: Caption<'a>,
}

impl<'a> Frame<'a> {
    /// Draws a moment, and writes what happened since the last one.
    fn new(
        film: &'a Film,
        before: Option<usize>,
        moment: usize,
        region: Region,
        (width, size): (u32, f32),
    ) -> Option<Frame<'a>> {
        let mut picture = Pixmap::new(width, (width as f32 / region.aspect()).round() as u32)?;
        let first = moment.saturating_sub(TRAIL_STEPS);
        let options = Options { camera: region.camera(), overlays: Overlays::NONE };
        let (width_px, height_px) = (picture.width() as usize, picture.height() as usize);
        let mut renderer = Renderer::new(width_px, height_px, options).ok()?;
        let (scene, way) = film.scenes.get(first..=moment)?.split_last()?;
        renderer.render_after(way, scene, picture.data_mut()).ok()?;
        let since = film
            .events
            .iter()
            .filter(|(at, _)| before.is_none_or(|before| *at > before) && *at <= moment);
        let events: Vec<Event> = since.map(|(_, event)| *event).collect();
        let caption = Caption::new(film, film.scenes.get(moment)?, size, width as f32, &events);
        Some(Frame { picture, caption })
    }

    /// Places it on a page.
    fn draw(&self, canvas: &mut Canvas<'_>, (left, top): (u32, u32), height: u32) {
        let corner = at(left as f32, top as f32);
        canvas.card(corner, self.picture.width() as f32, height as f32, 8.0, CARD);
        place(&mut canvas.pixels, &self.picture, left, top);
        self.caption.draw(canvas, at(corner.x, corner.y + self.picture.height() as f32));
    }
}

fn place(page: &mut PixmapMut<'_>, picture: &Pixmap, left: u32, top: u32) {
    let paint = PixmapPaint::default();
    page.draw_pixmap(
        left as i32,
        top as i32,
        picture.as_ref(),
        &paint,
        Transform::identity(),
        None,
    );
}
