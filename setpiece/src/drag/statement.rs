//! Where a place is written: the statement of the scenario's own text that gives it.

use super::numbers::Written;
use crate::Loaded;
use crate::dsl::ast::{
    ItemKind, Place, PlayerStmt, ScenarioStmtKind, Span, TeamStmt, TeamStmtKind,
};
use crate::dsl::parse::parse;
use crate::scenario::{PitchSize, PlayerSlot, Team};
use std::ops::Range;

/// What gives a player or the ball its place.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Statement {
    /// The place in the text, if one is written.
    pub(super) place: Option<Range<usize>>,
    /// Whether the place is drawn around what is written.
    pub(super) is_jittered: bool,
    /// Whether points are of the team's own frame without the word `own`: in a formation.
    is_own: bool,
    /// Whether the team's own frame is turned: that of the team which is written as the right one.
    is_right: bool,
    /// What the scenario's mirror does to the axes.
    mirror: [f64; 2],
}

impl Statement {
    /// The statement of a player, or of the ball.
    ///
    /// # Errors
    /// A sentence for the user, if it isn't in the scenario's own text.
    pub(super) fn of(
        loaded: &Loaded,
        player: Option<(usize, &PlayerSlot)>,
    ) -> Result<Statement, String> {
        let elsewhere = || "this place isn't written in this file".to_owned();
        let (file, source) = loaded.sources.iter().next().ok_or_else(elsewhere)?;
        let tree = parse(source, file, &mut Vec::new());
        let items = || tree.items.iter();
        let own = items().find_map(|item| match &item.kind {
            ItemKind::Scenario(it) if Some(it.name.span) == loaded.origin => Some(it),
            _ => None,
        });
        let own = own.ok_or_else(elsewhere)?;
        let mirror = loaded.origins.mirror.map_or("", |word| loaded.sources.text(word));
        let (mirror, are_swapped) = match mirror {
            "flanks" => ([1.0, -1.0], false),
            "ends" => ([-1.0, -1.0], true),
            _ => ([1.0, 1.0], false),
        };
        let written_right = |slot: &PlayerSlot| (slot.team == Team::Right) != are_swapped;
        let is_right = player.is_some_and(|(_, slot)| written_right(slot));
        let whole = |place: Option<&Place>, is_jittered: bool, is_own: bool| Statement {
            place: place.map(|it| it.span.start as usize..it.span.end as usize),
            is_jittered,
            is_own,
            is_right,
            mirror,
        };
        let span = match player {
            Some((index, _)) => loaded.origins.players.get(index).copied(),
            None => loaded.origins.ball,
        };
        let span = span.filter(|span| !loaded.sources.text(*span).is_empty());
        let span = span.ok_or_else(elsewhere)?;
        if span.file != file {
            let name = loaded.sources.get(span.file).map_or("", |source| source.name.as_str());
            return Err(format!("this place isn't written in this file, but in `{name}`"));
        }
        let item = items().find(|item| item.span.holds(span)).ok_or_else(elsewhere)?;
        match &item.kind {
            ItemKind::Scenario(it) if std::ptr::eq(it, own) => {
                let found = it.body.iter().find_map(|stmt| match &stmt.kind {
                    ScenarioStmtKind::Ball(ball) if stmt.span == span => {
                        Some(whole(Some(&ball.place), ball.jitter.is_some(), false))
                    }
                    ScenarioStmtKind::Team { body, .. } => player_at(body, span)
                        .map(|it| whole(it.place.as_ref(), it.jitter.is_some(), false)),
                    _ => None,
                });
                found.ok_or_else(elsewhere)
            }
            ItemKind::Scenario(it) => Err(format!(
                "this place is inherited from `{}`: move it there, or write it in `{}`",
                it.name.node, own.name.node
            )),
            ItemKind::Formation(it) => {
                let found = player_at(&it.body, span);
                let found = found.map(|it| whole(it.place.as_ref(), it.jitter.is_some(), true));
                found.ok_or_else(elsewhere)
            }
            _ => Err(elsewhere()),
        }
    }

    /// By what written metres are multiplied to be those of the world, along and across the pitch.
    pub(super) fn scale(&self, written: &Written, pitch: &PitchSize) -> [f64; 2] {
        let is_turned = (written.is_own || self.is_own) && self.is_right;
        let turn = if is_turned { -1.0 } else { 1.0 };
        // In a formation, what has no unit is stretched over the pitch.
        let usual = PitchSize::USUAL;
        let stretch = if self.is_own && !written.is_metres {
            [pitch.half_length() / usual.half_length(), pitch.half_width() / usual.half_width()]
        } else {
            [1.0; 2]
        };
        [0, 1].map(|axis| turn * stretch[axis] * self.mirror[axis])
    }
}

/// The statement of a player that holds a place of the text, or that of their override.
fn player_at(body: &[TeamStmt], span: Span) -> Option<&PlayerStmt> {
    body.iter().find(|stmt| stmt.span.holds(span)).and_then(|stmt| match &stmt.kind {
        TeamStmtKind::Player(player) => Some(player),
        TeamStmtKind::Override { change, .. } => Some(change),
        _ => None,
    })
}
