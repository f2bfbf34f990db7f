//! What stands under a frame: the clock, who has the ball, the score, what happened.

use super::canvas::{Canvas, at};
use super::colours::{FAINT, GOAL, INK, shirt};
use super::film::Film;
use super::people;
use super::scene::Scene;
use super::text::{Style, fitted, width};
use super::words::{DECISIVE, Piece, Sentence, waiting};
use crate::engine::state::PlayerId;
use crate::scenario::Team;
use crate::scenario::pitch::STEPS_PER_S;
use tiny_skia::Point;

/// Lines of events under a frame.
const LINES: usize = 3;
/// Height of a line over the text's size.
const LEADING: f32 = 1.5;
/// The least weight of an event that is told in full ink.
const NOTABLE: u32 = 30;

/// How high a caption is whose text has a size, pixels.
pub fn height(size: f32) -> f32 {
    size * (LEADING * (LINES as f32 + 1.0) + 1.0)
}

/// Writes the caption of a moment.
///
/// - `corner`, `room`: its upper left corner and its width, pixels.
/// - `sentences`: what happened since the frame before.
pub fn draw(
    canvas: &mut Canvas<'_>,
    (corner, room): (Point, f32),
    size: f32,
    film: &Film,
    scene: &Scene,
    sentences: Vec<Sentence>,
) {
    let pad = size * 0.7;
    let (left, right) = (corner.x + pad, corner.x + room - pad);
    let middle = corner.y + size * (LEADING / 2.0 + 0.45);
    let mut x = left;
    x += canvas.write(&format!("step {}", scene.step), at(x, middle), Style::bold(size, INK)) + size * 0.6;
    x += canvas.write(&clock(scene.clock_steps), at(x, middle), Style::plain(size, FAINT)) + size * 1.1;
    let mut writer = Writer { canvas, film, size };
    for piece in ball_of(scene) {
        x += writer.piece(&piece, at(x, middle), Style::plain(size, FAINT)) + size * 0.35;
    }
    score(canvas, at(right, middle), size, scene.score);
    let mut writer = Writer { canvas, film, size };
    let (kept, dropped) = writer.kept(sentences, right - left);
    writer.flow(&kept, dropped, at(left, middle + size * LEADING * 1.05), right);
}

/// Minutes and seconds.
pub fn clock(steps: u32) -> String {
    let seconds = (f64::from(steps) / STEPS_PER_S) as u32;
    format!("{}:{:02}", seconds / 60, seconds % 60)
}

/// Writes a score that ends at a point, each team's goals on its colour.
pub fn score(canvas: &mut Canvas<'_>, end: Point, size: f32, score: [u16; 2]) {
    let texts = score.map(|goals| goals.to_string());
    let style = Style::bold(size, INK);
    let box_width = texts.iter().map(|text| width(text, style)).fold(size * 0.7, f32::max) + size * 0.6;
    let mut left = end.x - 2.0 * box_width - size * 0.2;
    for (text, team) in texts.iter().zip(Team::ALL) {
        let shirt = shirt(*team, false);
        let height = size * 1.35;
        canvas.card(at(left, end.y - height / 2.0), box_width, height, size * 0.25, shirt.cloth);
        canvas.write_centred(text, at(left + box_width / 2.0, end.y), Style::bold(size, shirt.number));
        left += box_width + size * 0.2;
    }
}

/// Who has the ball, or who takes what.
fn ball_of(scene: &Scene) -> Vec<Piece> {
    match (waiting(scene.mode), scene.owner, scene.possession) {
        (Some(what), Some(taker), _) => vec![Piece::Text(what), Piece::Player(taker)],
        (Some(what), None, Some(team)) => vec![Piece::Text(what), Piece::Team(team)],
        (Some(what), None, None) => vec![Piece::Text(what)],
        (None, Some(owner), _) => vec![Piece::Text("ball"), Piece::Player(owner)],
        (None, None, Some(team)) => vec![Piece::Text("free ball, last"), Piece::Team(team)],
        (None, None, None) => vec![Piece::Text("free ball")],
    }
}

/// Writes pieces of sentences.
struct Writer<'a, 'b> {
    canvas: &'a mut Canvas<'b>,
    film: &'a Film,
    size: f32,
}

impl Writer<'_, '_> {
    /// What a player is called.
    fn name(&self, id: PlayerId) -> &str {
        self.film.names.get(id.index()).map_or("", String::as_str)
    }

    /// How wide a piece is.
    fn width(&self, piece: &Piece, style: Style) -> f32 {
        match piece {
            Piece::Text(text) => width(text, style),
            Piece::Player(id) => self.size * 1.5 + width(&self.short(*id), style),
            Piece::Team(team) => self.size * 0.95 + width(team.name(), style),
        }
    }

    /// A name that leaves room for others.
    fn short(&self, id: PlayerId) -> String {
        fitted(self.name(id), Style::plain(self.size, INK), self.size * 9.0)
    }

    /// Writes a piece and says how wide it is.
    fn piece(&mut self, piece: &Piece, start: Point, style: Style) -> f32 {
        let size = self.size;
        match piece {
            Piece::Text(text) => {
                self.canvas.write(text, start, style);
            }
            Piece::Player(id) => {
                let keeper = self.film.is_keeper(*id);
                people::badge(self.canvas, at(start.x + size * 0.6, start.y), size * 0.6, *id, keeper);
                let name = self.short(*id);
                self.canvas.write(&name, at(start.x + size * 1.5, start.y), style);
            }
            Piece::Team(team) => {
                let colour = shirt(*team, false).cloth;
                self.canvas.disc(at(start.x + size * 0.35, start.y), size * 0.35, colour);
                self.canvas.write(team.name(), at(start.x + size * 0.95, start.y), style);
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
        sentence.pieces.iter().map(|piece| self.width(piece, style)).sum::<f32>() + gaps
    }

    /// The sentences that there is room for, those that matter least left out first, and how many were.
    fn kept(&self, mut sentences: Vec<Sentence>, room: f32) -> (Vec<Sentence>, usize) {
        let all = sentences.len();
        let mut widths: Vec<f32> = sentences.iter().map(|sentence| self.sentence_width(sentence)).collect();
        while lines(&widths, self.gap(), room, sentences.len() < all) > LINES {
            let least = sentences.iter().enumerate().min_by_key(|(_, sentence)| sentence.weight);
            let Some((index, _)) = least else { break };
            sentences.remove(index);
            widths.remove(index);
        }
        let dropped = all - sentences.len();
        (sentences, dropped)
    }

    fn gap(&self) -> f32 {
        self.size * 1.0
    }

    /// Writes sentences one after the other, on as many lines as they need.
    fn flow(&mut self, sentences: &[Sentence], dropped: usize, start: Point, right: f32) {
        let mut pen = start;
        for sentence in sentences {
            let (style, room) = (self.style(sentence), self.sentence_width(sentence));
            if pen.x > start.x && pen.x + room > right {
                pen = at(start.x, pen.y + self.size * LEADING);
            }
            for piece in &sentence.pieces {
                pen.x += self.piece(piece, pen, style) + self.size * 0.3;
            }
            pen.x += self.gap() - self.size * 0.3;
        }
        if dropped > 0 {
            self.canvas.write_before(&format!("+{dropped}"), at(right, pen.y), Style::plain(self.size, FAINT));
        }
    }
}

/// How many lines sentences of these widths take; some room is left at the end where something is left out.
fn lines(widths: &[f32], gap: f32, room: f32, more: bool) -> usize {
    let (mut lines, mut x) = (1, 0.0);
    for width in widths {
        if x > 0.0 && x + width > room {
            lines += 1;
            x = 0.0;
        }
        x += width + gap;
    }
    lines + usize::from(more && x + 1.5 * gap > room)
}
