//! `mirror: flanks` and `mirror: ends`: the same scenario with y or both ends exchanged.
//!
//! What the author writes keeps its meaning: literals, coordinates, angles, landmarks and
//! directions are read in the mirror, wherever they stand. `flanks` reflects y, so that left backs
//! become right backs; `ends` turns the pitch by 180° and exchanges the teams.

use crate::ast::Ident;
use crate::problem::Problem;
use crate::problem::facts::Bounds;
use setpiece_scenario::vocabulary::{Role, Team};

/// How a scenario is mirrored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Mirror {
    /// Not at all.
    Off,
    /// y is -y.
    Flanks,
    /// Both ends and both teams are exchanged.
    Ends,
}

impl Mirror {
    /// Reads the word behind `mirror:`.
    pub(crate) fn of(word: Option<&Ident>, problems: &mut Vec<Problem>) -> Mirror {
        let Some(word) = word else { return Mirror::Off };
        match word.node.as_str() {
            "flanks" => Mirror::Flanks,
            "ends" => Mirror::Ends,
            // Undoes what is inherited.
            "none" | "off" => Mirror::Off,
            other => {
                problems.push(Problem::new(word.span, Bounds::Mirror { word: other.to_owned() }));
                Mirror::Off
            }
        }
    }

    /// The team that a written one stands for.
    pub(crate) fn team(self, team: Team) -> Team {
        if self == Mirror::Ends { team.other() } else { team }
    }

    /// The role that a written one stands for.
    pub(crate) fn role(self, role: Role) -> Role {
        match (self, role) {
            (Mirror::Flanks, Role::LB) => Role::RB,
            (Mirror::Flanks, Role::RB) => Role::LB,
            (Mirror::Flanks, Role::LM) => Role::RM,
            (Mirror::Flanks, Role::RM) => Role::LM,
            _ => role,
        }
    }
}
