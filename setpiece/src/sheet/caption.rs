//! The caption under a frame: the clock, who has the ball, the score, what happened.

use super::badge::badge;
use super::canvas::{Canvas, at};
use super::colours::{FAINT, GOAL, INK, shirt};
use super::text::{Style, fitted, width};
use super::words::{self, DECISIVE, Piece, Sentence, waiting};
use crate::engine::state::PlayerId;
use crate::engine::state::event::Event;
use crate::film::Film;
use crate::scenario::Team;
use crate::scene::{player_id, team};
use setpiece_render::Scene;
use tiny_skia::Point;

/// The most lines of events under a frame.
const LINES_MAX: usize = 3;
/// Line height relative to the text's size.
const LEADING: f32 = 1.5;
/// Events of at least this weight are written in full ink.
const NOTABLE: u32 = 30;

/// The caption of a moment.
pub struct Caption<'a> {
    film: &'a Film,
    scene: &'a Scene,
    size: f32,
    room: f32,
    sentences: Vec<Sentence>,
    dropped: usize,
}

impl<'a> Caption<'a> {
    /// Writes the caption of a moment.
    ///
    /// - `size`, `room`: of the text and of its place, pixels. What doesn't fit is only counted,
    ///   starting with the least important.
    /// - `events`: what happened since the last frame.
    pub fn new(
        film: &'a Film,
        scene: &'a Scene,
        size: f32,
        room: f32,
        events: &[Event],
    ) -> Caption<'a> {
        let mut caption =
            Caption { film, scene, size, room, sentences: words::tell(events), dropped: 0 };
        while caption.lines() > LINES_MAX {
            let least =
                caption.sentences.iter().enumerate().min_by_key(|(_, sentence)| sentence.weight);
            let Some((index, _)) = least else { break };
            caption.sentences.remove(index);
            caption.dropped += 1;
        }
        caption
    }

    /// The number of lines of events.
    pub fn lines(&self) -> usize {
        let (mut lines, mut x) = (1, 0.0);
        for sentence in &self.sentences {
            let width = self.sentence_width(sentence);
            if x > 0.0 && x + width > self.inner() {
                lines += 1;
                x = 0.0;
            }
            x += width + self.gap();
        }
        // Reserves space for the count of omitted events.
        let more = self.dropped > 0 && x + 2.0 * self.size > self.inner();
        if self.sentences.is_empty() && self.dropped == 0 { 0 } else { lines + usize::from(more) }
    }

    /// Draws it below a frame.
    pub fn draw(&self, canvas: &mut Canvas<'_>, corner: Point) {
        let size = self.size;
        let (left, right) = (corner.x + self.pad(), corner.x + self.room - self.pad());
        let middle = corner.y + size * (LEADING / 2.0 + 0.45);
        let mut x = left;
        x += canvas.write(
            &format!("step {}", self.scene.step),
            at(x, middle),
            Style::bold(size, INK),
        ) + size * 0.6;
        x += canvas.write(&clock(self.scene.clock_s), at(x, middle), Style::plain(size, FAINT))
            + size * 1.1;
        for piece in ball_of(self.scene) {
            x += self.piece(canvas, &piece, at(x, middle), Style::plain(size, FAINT)) + size * 0.35;
        }
        score(canvas, at(right, middle), size, self.scene.score);
        self.flow(canvas, at(left, middle + size * LEADING * 1.05), right);
    }

    fn pad(&self) -> f32 {
        self.size * 0.7
    }

    fn inner(&self) -> f32 {
        self.room - 2.0 * self.pad()
    }
}

/// The height of a caption with this many lines of events, pixels.
pub fn height(size: f32, lines: usize) -> f32 {
    size * (LEADING * (lines as f32 + 1.0) + 0.9)
}

/// Minutes and seconds.
pub fn clock(seconds: f32) -> String {
    let seconds = seconds as u32;
    format!("{}:{:02}", seconds / 60, seconds % 60)
}

/// Writes a score that ends at a point, each team's goals on its colour.
pub fn score(canvas: &mut Canvas<'_>, end: Point, size: f32, score: [u16; 2]) {
    let texts = score.map(|goals| goals.to_string());
    let style = Style::bold(size, INK);
    let box_width =
        texts.iter().map(|text| width(text, style)).fold(size * 0.7, f32::max) + size * 0.6;
    let mut left = end.x - 2.0 * box_width - size * 0.2;
    for (text, team) in texts.iter().zip(Team::ALL) {
        let shirt = shirt(*team, false);
        let height = size * 1.35;
        canvas.card(at(left, end.y - height / 2.0), box_width, height, size * 0.25, shirt.cloth);
        canvas.write_centred(
            text,
            at(left + box_width / 2.0, end.y),
            Style::bold(size, shirt.number),
        );
        left += box_width + size * 0.2;
    }
}

/// Who has the ball, or who takes which set piece.
fn ball_of(scene: &Scene) -> Vec<Piece> {
    let owner = scene.ball.owner.map(player_id);
    match (waiting(scene.mode), owner, scene.possession.map(team)) {
        (Some(what), Some(taker), _) => vec![Piece::Text(what), Piece::Player(taker)],
        (Some(what), None, Some(team)) => vec![Piece::Text(what), Piece::Team(team)],
        (Some(what), None, None) => vec![Piece::Text(what)],
        (None, Some(owner), _) => vec![Piece::Text("ball"), Piece::Player(owner)],
        (None, None, Some(team)) => vec![Piece::Text("ball free, last"), Piece::Team(team)],
        (None, None, None) => vec![Piece::Text("ball free")],
    }
}

impl Caption<'_> {
    /// A player's name, as far as it fits.
    fn name(&self, id: PlayerId) -> String {
        let name = self.film.names.get(id.index()).map_or("", String::as_str);
        fitted(name, Style::plain(self.size, INK), self.size * 9.0)
    }

    /// The width of a piece.
    fn width(&self, piece: &Piece, style: Style) -> f32 {
        match piece {
            Piece::Text(text) => width(text, style),
            Piece::Player(id) => self.size * 1.5 + width(&self.name(*id), style),
            Piece::Team(team) => self.size * 0.95 + width(team.name(), style),
        }
    }

    /// Writes a piece and returns its width.
    fn piece(&self, canvas: &mut Canvas<'_>, piece: &Piece, start: Point, style: Style) -> f32 {
        let size = self.size;
        match piece {
            Piece::Text(text) => {
                canvas.write(text, start, style);
            }
            Piece::Player(id) => {
                badge(
                    canvas,
                    at(start.x + size * 0.6, start.y),
                    size * 0.6,
                    *id,
                    self.film.is_keeper(*id),
                );
                canvas.write(&self.name(*id), at(start.x + size * 1.5, start.y), style);
            }
            Piece::Team(team) => {
                let colour = shirt(*team, false).cloth;
                canvas.disc(at(start.x + size * 0.35, start.y), size * 0.35, colour);
                canvas.write(team.name(), at(start.x + size * 0.95, start.y), style);
            }
        }
        self.width(piece, style)
    }

    fn style(&self, sentence: &Sentence) -> Style {
        match sentence.weight {
            DECISIVE.. => Style::bold(self.size, GOAL),
            NOTABLE.. => Style::plain(self.size, INK),
            _ => Style::plain(self.size, FAINT),
        }
    }

    fn sentence_width(&self, sentence: &Sentence) -> f32 {
        let style = self.style(sentence);
        let gaps = sentence.pieces.len().saturating_sub(1) as f32 * self.size * 0.3;
        let pieces: f32 = sentence.pieces.iter().map(|piece| self.width(piece, style)).sum();
        pieces + gaps + times(sentence).map_or(0.0, |times| self.size * 0.3 + width(&times, style))
    }

    fn gap(&self) -> f32 {
        self.size * 1.1
    }

    /// Writes the sentences one after the other, on as many lines as they need.
    fn flow(&self, canvas: &mut Canvas<'_>, start: Point, right: f32) {
        let mut pen = start;
        for sentence in &self.sentences {
            let (style, room) = (self.style(sentence), self.sentence_width(sentence));
            if pen.x > start.x && pen.x + room > right {
                pen = at(start.x, pen.y + self.size * LEADING);
            }
            let mut x = pen.x;
            for piece in &sentence.pieces {
                x += self.piece(canvas, piece, at(x, pen.y), style) + self.size * 0.3;
            }
            if let Some(times) = times(sentence) {
                canvas.write(&times, at(x, pen.y), style);
            }
            pen.x += room + self.gap();
        }
        if self.dropped > 0 {
            canvas.write_before(
                &format!("+{}", self.dropped),
                at(right, pen.y),
                Style::plain(self.size, FAINT),
            );
        }
    }
}

/// The count of a repeated event.
fn times(sentence: &Sentence) -> Option<String> {
    (sentence.times > 1).then(|| format!("×{}", sentence.times))
}
