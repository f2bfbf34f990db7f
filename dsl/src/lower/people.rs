//! The players of a scenario as the text has them, and who plays them.

use super::value::Scope;
use crate::ast::{Expr, Facing, Field, Ident, Place, Span};
use crate::cast::CastTarget;
use setpiece_scenario::Reg;
use setpiece_scenario::pitch::TEAM_MAX;
use setpiece_scenario::vocabulary::{Role, Team};

/// A part of what is said of a player, with the scope in which it stands: a formation, or the
/// scenario that uses it.
#[derive(Clone)]
pub(crate) struct Scoped<'w, T> {
    /// The part.
    pub(crate) it: &'w T,
    /// Its scope.
    pub(crate) scope: Scope<'w>,
}

impl<'w, T> Scoped<'w, T> {
    /// A part that stands in a scope.
    pub(crate) fn new(it: &'w T, scope: &Scope<'w>) -> Scoped<'w, T> {
        Scoped { it, scope: scope.clone() }
    }
}

/// A player of the roster.
#[derive(Clone)]
pub(crate) struct Rostered<'w> {
    /// `team * 11 + seat`.
    pub(crate) id: u8,
    /// Their place in the team, by which programs know them.
    pub(crate) seat: usize,
    /// Whether they share it with the player before them in the roster.
    pub(crate) instead: bool,
    /// The formations that they belong to, if not to all that their team may have.
    pub(crate) formations: Option<Formations<'w>>,
    /// Their team.
    pub(crate) team: Team,
    /// Their role.
    pub(crate) role: Role,
    /// Their name, if any.
    pub(crate) name: Option<&'w Ident>,
    /// Their statement.
    pub(crate) span: Span,
    /// Where they start; when their team kicks off, if there are layouts.
    pub(crate) stand: Stand<'w>,
    /// In which scope it is read whether they play.
    pub(crate) scope: Scope<'w>,
    /// Where they stand when the others kick off, if there are layouts.
    pub(crate) receiving: Option<Stand<'w>>,
    /// Where they look.
    pub(crate) facing: Option<Scoped<'w, Facing>>,
    /// How far their place is moved.
    pub(crate) jitter: Option<Scoped<'w, Expr>>,
    /// Whether they play.
    pub(crate) when: Option<&'w Expr>,
    /// In which share of the episodes.
    pub(crate) maybe: Option<&'w Expr>,
    /// Which of a drawn number of players they are.
    pub(crate) numbered: Option<Numbered>,
    /// Options: what stands later wins.
    pub(crate) fields: Vec<Scoped<'w, Field>>,
}

/// Some of the formations of which an episode has one.
#[derive(Clone)]
pub(crate) struct Formations<'w> {
    /// The expression that chooses one.
    pub(crate) whole: &'w Expr,
    /// Which of them.
    pub(crate) which: Vec<usize>,
}

/// What decides whether a player takes part.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Presence {
    /// Known from the parameters: who doesn't hold belongs to no episode.
    pub(crate) present: Option<Reg>,
    /// Drawn: who doesn't hold is absent from this episode.
    pub(crate) active: Option<Reg>,
}

/// A copy of a statement with a drawn number of players: `3..5 CB`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Numbered {
    /// How many copies stand before it.
    pub(crate) before: u32,
    /// The least number of players.
    pub(crate) least: u32,
    /// The greatest.
    pub(crate) most: u32,
}

impl Presence {
    /// Its conditions.
    pub(crate) fn conditions(self) -> impl Iterator<Item = Reg> {
        [self.present, self.active].into_iter().flatten()
    }
}

/// Where a player stands in a layout.
#[derive(Clone)]
pub(crate) enum Stand<'w> {
    /// At a place, read in a scope; in the zone of the role without one.
    At(Option<&'w Place>, Scope<'w>),
    /// As in some formations of which an episode has one.
    Among(&'w Expr, Vec<(usize, Stand<'w>)>),
}

impl<'w> Rostered<'w> {
    /// Makes them a player of one of several formations.
    pub(super) fn join(&mut self, whole: &'w Expr, which: usize) {
        self.formations = Some(Formations { whole, which: vec![which] });
        self.stand = Stand::Among(whole, vec![(which, self.stand.clone())]);
    }

    /// Lets them stand somewhere in a further one of the formations.
    pub(super) fn also(&mut self, which: usize, there: Stand<'w>) {
        if let Some(formations) = &mut self.formations {
            formations.which.push(which);
        }
        if let Stand::Among(_, stands) = &mut self.stand {
            stands.push((which, there));
        }
    }

    /// One player for each formation that they belong to, if it isn't all of them. Who has a name
    /// stays one player.
    pub(super) fn by_formation(&self) -> Vec<Rostered<'w>> {
        let (Some(formations), Stand::Among(whole, stands), None) =
            (&self.formations, &self.stand, self.name)
        else {
            return vec![self.clone()];
        };
        let single = |stand: &(usize, Stand<'w>)| Rostered {
            formations: Some(Formations { whole: formations.whole, which: vec![stand.0] }),
            stand: Stand::Among(whole, vec![stand.clone()]),
            ..self.clone()
        };
        stands.iter().map(single).collect()
    }

    /// What a report of the place points at.
    pub(crate) fn place_span(&self) -> Span {
        match self.stand {
            Stand::At(Some(place), _) => place.span,
            Stand::At(None, _) | Stand::Among(..) => self.span,
        }
    }

    /// The name of the stream of the draws: the label, else the team and index.
    pub(crate) fn stream(&self) -> String {
        match self.name {
            Some(name) => format!("player {}", name.node),
            None => format!("player {} {}", self.team, usize::from(self.id) % TEAM_MAX),
        }
    }

    /// Whether they and another one may be meant never to play together: by what their `when` says,
    /// or because they belong to different formations.
    pub(crate) fn may_exclude(&self, other: &Rostered<'_>) -> bool {
        let formations = match (&self.formations, &other.formations) {
            (Some(own), Some(others)) => !own.which.iter().any(|it| others.which.contains(it)),
            _ => false,
        };
        formations || (self.when.is_some() && other.when.is_some() && self.span != other.span)
    }

    /// The player in a sentence.
    pub(crate) fn shown(&self) -> String {
        match self.name {
            Some(name) => format!("`{}`", name.node),
            None => format!("the {} team's {}", self.team, self.role),
        }
    }
}

/// An `ai` from outside, read: `each all { ai: … }` in a text of its own.
#[derive(Clone, Copy)]
pub(crate) struct Casting<'w> {
    /// Whose.
    pub(crate) target: CastTarget,
    /// The `all`.
    pub(crate) who: &'w Ident,
    /// The `ai`.
    pub(crate) field: &'w Field,
}
