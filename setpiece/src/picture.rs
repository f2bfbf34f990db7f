//! A picture of a moment, as SVG.

use crate::scene::player_id;
use setpiece_render::Scene;
use setpiece_render::scene::{Pitch, ScenePlayer};
use setpiece_scenario::pitch::PLAYERS_MAX;
use std::fmt::Write as _;

/// Grass around the lines, metres.
const MARGIN_M: f64 = 4.5;
/// Stripes of the lawn.
const STRIPES: u32 = 10;
/// Radius of a player's disc, metres; larger than life, so that the role can be read.
const PLAYER_M: f64 = 1.5;
/// Fill, ring and text of the left and the right team: distinguishable with every kind of colour
/// vision.
const COLOURS: [[&str; 3]; 2] =
    [["#ffb000", "#7a4f00", "#2b1b00"], ["#2f6df6", "#0b2a77", "#ffffff"]];

/// Draws a moment from above in metres, with the left team attacking to the right. Players are
/// discs in their team's colour with role, heading and name.
///
/// `names`: everybody's label, by their
/// [index](crate::engine::state::PlayerId::index); a role as a name is left out.
pub fn svg(title: &str, names: &[String; PLAYERS_MAX], scene: &Scene) -> String {
    svg_over(title, names, scene, "")
}

/// The same, with some elements between the pitch and the players, in metres.
pub(crate) fn svg_over(
    title: &str,
    names: &[String; PLAYERS_MAX],
    scene: &Scene,
    beneath: &str,
) -> String {
    let mut text = begun(title, &scene.pitch);
    text.push_str(beneath);
    for one in scene.players.iter().filter(|player| player.present) {
        let name = names.get(player_id(one.id).index()).map_or("", String::as_str);
        player(&mut text, one, name);
    }
    let [ball_x, ball_y, _] = scene.ball.pos;
    let _ = write!(
        text,
        "<circle cx=\"{ball_x:.2}\" cy=\"{ball_y:.2}\" r=\"0.7\" fill=\"#fff\" stroke=\"#111\" stroke-width=\"0.3\"/>\n</svg>\n",
    );
    text
}

/// Draws an empty pitch with some elements over it, in metres.
pub(crate) fn pitch_svg(title: &str, pitch: &Pitch, over: &str) -> String {
    begun(title, pitch) + over + "</svg>\n"
}

/// A picture's beginning, up to the lines of the pitch.
fn begun(title: &str, pitch: &Pitch) -> String {
    let [left, top, width, height] = view(pitch);
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"{left} {top} {width} {height}\" width=\"{}\" height=\"{}\" \
         font-family=\"system-ui, sans-serif\" text-anchor=\"middle\">\n<title>{}</title>\n",
        width * 8.0,
        height * 8.0,
        escaped(title)
    );
    lawn(&mut text, pitch);
    lines(&mut text, pitch);
    text
}

/// What a picture shows, metres: its left and top edge, its width and height. The world's frame is
/// the picture's.
pub(crate) fn view(pitch: &Pitch) -> [f64; 4] {
    let [x, y] = half(pitch).map(|half| half + MARGIN_M);
    [-x, -y, 2.0 * x, 2.0 * y]
}

/// Half the pitch along each axis, metres.
fn half(pitch: &Pitch) -> [f64; 2] {
    [pitch.length_m, pitch.width_m].map(|metres| 0.5 * shown(metres))
}

/// A measure as it is written: in centimetres.
fn shown(metres: f32) -> f64 {
    (f64::from(metres) * 100.0).round() / 100.0
}

fn lawn(text: &mut String, pitch: &Pitch) {
    let [half_length, half_width] = half(pitch);
    let (x, y) = (half_length + MARGIN_M, half_width + MARGIN_M);
    let width = 2.0 * half_length / f64::from(STRIPES);
    let _ = writeln!(
        text,
        "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" rx=\"1.5\" fill=\"#2f6f3e\"/>",
        -x,
        -y,
        2.0 * x,
        2.0 * y
    );
    for stripe in (0..STRIPES).step_by(2) {
        let left = f64::from(stripe) * width - half_length;
        let _ = writeln!(
            text,
            "<rect x=\"{left}\" y=\"{}\" width=\"{width}\" height=\"{}\" fill=\"#367a46\"/>",
            -half_width,
            2.0 * half_width
        );
    }
}

/// The lines of the pitch; each end is drawn once and turned for the other.
fn lines(text: &mut String, pitch: &Pitch) {
    let [x, y] = half(pitch);
    let [spot, edge] = [pitch.spot_m, pitch.box_depth_m].map(|ahead| x - shown(ahead));
    let [wide, six_yard, post] = [pitch.box_width_m, pitch.six_yard_width_m, pitch.goal_width_m]
        .map(|width| 0.5 * shown(width));
    let circle = shown(pitch.circle_m);
    // A circle that ends in the box has no part outside it.
    let arc = (circle.powi(2) - (spot - edge).powi(2)).max(0.0).sqrt();
    let _ = writeln!(
        text,
        "<g fill=\"none\" stroke=\"#f4f7f2\" stroke-width=\"0.25\" stroke-linejoin=\"round\">\n\
         <path d=\"M{} {}H{x}V{y}H{}ZM0 {}V{y}\"/>\n<circle r=\"{circle}\"/>",
        -x, -y, -x, -y
    );
    for turn in [0, 180] {
        let _ = writeln!(
            text,
            "<g transform=\"rotate({turn})\"><path d=\"M{x} {}H{edge}V{wide}H{x}M{x} {}H{}V\
             {six_yard}H{x}\"/><path d=\"M{edge} {:.3}A{circle} {circle} 0 0 0 {edge} \
             {arc:.3}\"/><path d=\"M{x} {}H{}V{post}H{x}\" fill=\"#ffffff55\"/>\
             <circle cx=\"{spot}\" r=\"0.15\" fill=\"#f4f7f2\"/></g>",
            -wide,
            -six_yard,
            x - shown(pitch.six_yard_depth_m),
            -arc,
            -post,
            x + shown(pitch.goal_depth_m)
        );
    }
    text.push_str("<circle r=\"0.15\" fill=\"#f4f7f2\"/>\n</g>\n");
}

fn player(text: &mut String, player: &ScenePlayer, name: &str) {
    let role = format!("{:?}", player.role);
    let [fill, ring, ink] = COLOURS[player.id.team.index()];
    let [x, y] = player.pos;
    let [ahead, across] = player.facing;
    let heading = across.atan2(ahead).to_degrees();
    let _ = writeln!(
        text,
        "<g transform=\"translate({x:.2} {y:.2})\"><path d=\"M{0} -0.7L{1} 0L{0} 0.7Z\" \
         transform=\"rotate({heading:.1})\" fill=\"{ring}\"/><circle r=\"{PLAYER_M}\" fill=\"{fill}\" stroke=\"{ring}\" \
         stroke-width=\"0.3\"/><text y=\"0.45\" font-size=\"1.3\" font-weight=\"700\" fill=\"{ink}\">{role}</text>",
        PLAYER_M,
        PLAYER_M + 0.9
    );
    if !name.is_empty() && name != role {
        let _ = writeln!(
            text,
            "<text y=\"{}\" font-size=\"1.5\" fill=\"#fff\">{}</text>",
            PLAYER_M + 1.8,
            escaped(name)
        );
    }
    text.push_str("</g>\n");
}

/// Escapes XML's special characters.
pub(crate) fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
