//! Football's own rules about a start: everybody on the pitch, nobody on another's spot.
//!
//! What is constant is checked now; what is drawn or depends on parameters becomes a requirement of
//! the draw.

use super::kind::NEAR_M;
use crate::ast::Span;
use crate::lower::Lower;
use crate::lower::people::Rostered;
use crate::lower::team::PlayerOptions;
use crate::problem::Problem;
use crate::problem::facts::{Implied, Players, Starts};
use setpiece_scenario::vocabulary::{PitchMeasure, StartKind, Team};
use setpiece_scenario::{BallStart, BinaryOp, Instr, Reg, UnaryOp};

/// Nearer than this two players stand on one spot.
const SAME_SPOT_M: f64 = 0.3;
/// Nearer than this two players are not drawn.
const DRAWN_GAP_M: f64 = 0.6;

/// One of the situations in which the players stand somewhere: the start, or either kick-off.
type Situation = Vec<(Reg, Reg)>;

/// Checks the places of players and ball.
pub(super) fn check_places(
    lower: &mut Lower<'_, '_>,
    places: &[(Reg, Reg)],
    options: &[PlayerOptions<'_>],
    ball: Option<&BallStart>,
) {
    if let (Some(ball), Some((kind, span))) = (ball, lower.said_place()) {
        check_ball(lower, (ball.x, ball.y), kind, span);
    }
    let rim = lower.rim();
    let mut on_pitch = Vec::new();
    let mut apart = Vec::new();
    let situations = situations(lower, places);
    for (nth, situation) in situations.iter().enumerate() {
        for (index, place) in situation.iter().enumerate() {
            let Some(player) = lower.world.roster.get(index) else { continue };
            let (shown, span) = (player.shown(), player.place_span());
            if check_on_pitch(lower, *place, rim, &shown, span) == KnownStart::Later {
                on_pitch.push((within(lower, *place, rim), span));
            }
        }
        for a in 0..situation.len() {
            for b in a + 1..situation.len() {
                if let Some(reg) = check_pair(lower, situation, (a, b), options, nth) {
                    let span = lower
                        .world
                        .roster
                        .get(b)
                        .map_or(lower.world.flat.item.name.span, Rostered::place_span);
                    apart.push((reg, span));
                }
            }
        }
    }
    let all = [(on_pitch, Implied::PlayersOnPitch), (apart, Implied::PlayersApart)];
    for (parts, implied) in all {
        let first = parts.first().map(|(_, span)| *span);
        // Of several parts it isn't known here which one fails.
        let span = first.filter(|first| parts.iter().all(|(_, span)| span == first));
        let regs = parts.into_iter().map(|(reg, _)| reg);
        if let Some(all) = regs.reduce(|a, b| lower.code.binary(BinaryOp::And, a, b)) {
            lower.imply(all, &implied, span);
        }
    }
}

/// Checks where the ball lies, at a throw-in beside a side line: it is put on it.
fn check_ball(lower: &mut Lower<'_, '_>, place: (Reg, Reg), kind: StartKind, span: Span) {
    let line = lower.pitch_length(PitchMeasure::HalfWidth);
    let near = lower.code.constant(NEAR_M);
    let aside = match kind {
        StartKind::ThrowIn => lower.code.binary(BinaryOp::Add, line, near),
        _ => line,
    };
    let limit = (lower.pitch_length(PitchMeasure::HalfLength), aside);
    if check_on_pitch(lower, place, limit, "the ball", span) == KnownStart::Later {
        let inside = within(lower, place, limit);
        lower.imply(inside, &Implied::BallOnPitch, Some(span));
    }
    if kind != StartKind::ThrowIn {
        return;
    }
    let nearest = lower.code.binary(BinaryOp::Sub, line, near);
    match (lower.interval(place.1), lower.interval(nearest)) {
        (Some((low, high)), Some((_, most))) if low >= most || high <= -most => {}
        (Some((low, high)), Some((least, _))) if low > -least && high < least => {
            lower.report(Problem::new(span, Starts::NoSideLine));
        }
        _ => {
            let aside = lower.code.unary(UnaryOp::Abs, place.1);
            let beside = lower.code.binary(BinaryOp::Ge, aside, nearest);
            lower.imply(beside, &Implied::BesideSideLine, Some(span));
        }
    }
}

fn situations(lower: &Lower<'_, '_>, places: &[(Reg, Reg)]) -> Vec<Situation> {
    if lower.world.flat.kickoff.is_none() {
        return vec![places.to_vec()];
    }
    let of = |kicking: Team| -> Situation {
        let layouts = lower.start().into_iter().flat_map(|start| &start.layouts);
        let layouts = layouts.zip(places).zip(&lower.world.roster);
        layouts
            .map(|((layout, place), player)| match layout {
                Some((kicks, _)) if player.team == kicking => *kicks,
                Some((_, receives)) => *receives,
                None => *place,
            })
            .collect()
    };
    vec![of(Team::Left), of(Team::Right)]
}

#[derive(PartialEq, Eq)]
enum KnownStart {
    Now,
    Later,
}

fn check_on_pitch(
    lower: &mut Lower<'_, '_>,
    place: (Reg, Reg),
    limit: (Reg, Reg),
    what: &str,
    span: Span,
) -> KnownStart {
    let (x, y) = (lower.interval(place.0), lower.interval(place.1));
    // What is drawn up to the rim and beyond is never drawn on the rim.
    let beyond = |low: f64, high: f64, limit: f64| low > limit || (low >= limit && high > low);
    let (limit_x, limit_y) = (lower.interval(limit.0), lower.interval(limit.1));
    let outside = |axis: Option<(f64, f64)>, limit: Option<(f64, f64)>| {
        let Some(((low, high), (_, limit))) = axis.zip(limit) else { return false };
        beyond(low, high, limit) || beyond(-high, -low, limit)
    };
    if outside(x, limit_x) || outside(y, limit_y) {
        let text = lower.world.text(span);
        let far = |axis: Option<(f64, f64)>| axis.map_or(0.0, |(low, _)| low);
        let lines = [PitchMeasure::HalfLength, PitchMeasure::HalfWidth];
        let [length, width] = lines.map(|measure| {
            let half = lower.pitch_length(measure);
            lower.interval(half).map_or(measure.usual(), |(_, most)| most)
        });
        lower.report(Problem::new(
            span,
            Starts::OffPitch {
                what: what.to_owned(),
                text,
                at: (far(x), far(y)),
                size: (2.0 * length, 2.0 * width),
            },
        ));
        return KnownStart::Now;
    }
    let within = |axis: Option<(f64, f64)>, limit: Option<(f64, f64)>| {
        let Some(((low, high), (limit, _))) = axis.zip(limit) else { return false };
        low >= -limit && high <= limit
    };
    if within(x, limit_x) && within(y, limit_y) { KnownStart::Now } else { KnownStart::Later }
}

fn within(lower: &mut Lower<'_, '_>, place: (Reg, Reg), limit: (Reg, Reg)) -> Reg {
    let mut inside = |value: Reg, limit: Reg| {
        let size = lower.code.unary(UnaryOp::Abs, value);
        lower.code.binary(BinaryOp::Le, size, limit)
    };
    let (x, y) = (inside(place.0, limit.0), inside(place.1, limit.1));
    lower.code.binary(BinaryOp::And, x, y)
}

/// Checks a pair of players; gives the requirement on them where their places are not constant.
fn check_pair(
    lower: &mut Lower<'_, '_>,
    situation: &Situation,
    (a, b): (usize, usize),
    options: &[PlayerOptions<'_>],
    nth: usize,
) -> Option<Reg> {
    let (one, other) = (options.get(a)?, options.get(b)?);
    if one.overlap || other.overlap {
        return None;
    }
    let (p, q) = (*situation.get(a)?, *situation.get(b)?);
    let constant = |place: (Reg, Reg)| {
        Some((lower.code.constant_of(place.0)?, lower.code.constant_of(place.1)?))
    };
    let (first, second) = (lower.world.roster.get(a)?, lower.world.roster.get(b)?);
    if [p.0, p.1, q.0, q.1].into_iter().any(|reg| lower.code.is_unknown(reg)) {
        return None;
    }
    if let (Some(x), Some(y)) = (constant(p), constant(q)) {
        let apart = ((x.0 - y.0).powi(2) + (x.1 - y.1).powi(2)).sqrt();
        if apart >= SAME_SPOT_M
            || one.presence.conditions().chain(other.presence.conditions()).next().is_some()
        {
            return None;
        }
        let at = |player: &Rostered<'_>| player.place_span();
        let nth = lower.world.flat.kickoff.is_some().then_some(nth + 1);
        let text = lower.world.text(at(second));
        let own = text.strip_prefix("at (").filter(|_| first.team != second.team);
        let own = own.map(|rest| format!("at own ({rest}"));
        let (players, first) = ((first.shown(), second.shown()), at(first));
        lower.report(Problem::new(at(second), Players::SameSpot { players, nth, first, own }));
        return None;
    }
    let drawn = |instr: &Instr| matches!(instr, Instr::Random { .. });
    let is_drawn = [p.0, p.1, q.0, q.1].into_iter().any(|reg| lower.code.depends(reg, &drawn));
    let gap = if is_drawn { DRAWN_GAP_M } else { SAME_SPOT_M };
    // Far apart whatever is drawn: nothing to check at each reset.
    if far(lower, p.0, q.0, gap) || far(lower, p.1, q.1, gap) {
        return None;
    }
    let distance = lower.distance(p, q);
    let gap = lower.code.constant(gap);
    let mut reg = lower.code.binary(BinaryOp::Ge, distance, gap);
    for present in one.presence.conditions().chain(other.presence.conditions()) {
        let absent = lower.code.unary(UnaryOp::Not, present);
        reg = lower.code.binary(BinaryOp::Or, reg, absent);
    }
    Some(reg)
}

fn far(lower: &Lower<'_, '_>, p: Reg, q: Reg, gap: f64) -> bool {
    match (lower.interval(p), lower.interval(q)) {
        (Some(p), Some(q)) => p.0 - q.1 >= gap || q.0 - p.1 >= gap,
        _ => false,
    }
}
