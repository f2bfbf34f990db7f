//! The players who take part. This depends only on parameters, so it is known before the first
//! episode.

use super::{DrawKey, Drawer};
use crate::in_place::clone_in_place;
use crate::state::PlayerId;
use setpiece_scenario::pitch::PLAYERS_MAX;
use setpiece_scenario::vocabulary::{Role, Team};
use setpiece_scenario::{Bindings, Scenario, SideAgents, Switching};

/// The players and agents of an environment, the same in every episode.
#[derive(Debug, PartialEq, Eq)]
pub struct Roster {
    /// Which players take part, by id.
    pub present: [bool; PLAYERS_MAX],
    /// The agents, left before right: the team, and the player if it is fixed.
    pub agents: Vec<(Team, Option<PlayerId>)>,
}

clone_in_place! {
    Roster { present, agents }
}

/// Agents that were requested instead of the scenario's.
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub struct AgentsChoice {
    /// Left and right.
    pub sides: [SideChoice; 2],
    /// Whether each agent keeps its player; as the scenario says if absent.
    pub fixed: Option<bool>,
}

/// The agents of a side.
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub enum SideChoice {
    /// As the scenario says.
    Scenario,
    /// This many.
    Count(u32),
    /// One per controllable player.
    All,
    /// One per player of these names, in this order.
    Players(Vec<String>),
}

/// The requested agents are impossible.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum RosterError {
    /// More agents than controllable players.
    #[error("{asked} agents on the {team} side, which has {controllable} controllable players")]
    TooMany {
        /// The side.
        team: Team,
        /// The number requested.
        asked: u32,
        /// The number of controllable players.
        controllable: u32,
    },
    /// A player that no agent can control.
    #[error("no agent can play `{name}` of the {team} side: its controllable players are `{}`", .known.join("`, `"))]
    Player {
        /// The side.
        team: Team,
        /// The player requested.
        name: String,
        /// The players that can be requested.
        known: Vec<String>,
    },
    /// A player requested twice.
    #[error("`{name}` is requested twice")]
    Twice {
        /// The player.
        name: String,
    },
}

impl Roster {
    /// Determines the roster of a scenario under its parameters.
    ///
    /// # Errors
    /// [`RosterError`] if the requested agents are more than the controllable players, or other
    /// players.
    pub fn new(
        scenario: &Scenario,
        bindings: &Bindings,
        choice: Option<&AgentsChoice>,
    ) -> Result<Roster, RosterError> {
        let mut drawer = Drawer::new(scenario);
        // Presence and counts don't depend on draws, so any seed gives them.
        let draws = DrawKey { seed: 0, index: 0, attempt: 0 };
        drawer.begin(bindings, draws);
        drawer.run(bindings, draws);
        let mut roster = Roster { present: [false; PLAYERS_MAX], agents: Vec::new() };
        for team in Team::ALL {
            for (id, slot) in scenario.team(*team).filter(|&(id, _)| id < PLAYERS_MAX) {
                roster.present[id] |= drawer.is_present(&slot.start);
            }
        }
        for team in Team::ALL {
            let side = choice.map_or(&SideChoice::Scenario, |choice| &choice.sides[team.index()]);
            let asked = choice.and_then(|choice| choice.fixed);
            let fixed = asked.unwrap_or(scenario.agents.switching == Switching::Fixed);
            let count = |asked| roster.counted(scenario, *team, asked, fixed);
            let agents = match (side, &scenario.agents.sides[team.index()]) {
                (SideChoice::Count(n), _) => count(*n)?,
                (SideChoice::Players(names), _) => roster.named(scenario, *team, names)?,
                (SideChoice::Scenario, SideAgents::Count(n)) => {
                    count(libm::round(drawer.value(*n)) as u32)?
                }
                (SideChoice::All, _) | (SideChoice::Scenario, SideAgents::All) => {
                    roster.controllable(scenario, *team).map(Some).collect()
                }
                (SideChoice::Scenario, SideAgents::Players(players)) => players
                    .iter()
                    .map(|&index| PlayerId::new(*team, index.into()))
                    .filter(|id| roster.present.get(id.index()) == Some(&true))
                    .map(Some)
                    .collect(),
            };
            roster.agents.extend(agents.into_iter().map(|fixed| (*team, fixed)));
        }
        Ok(roster)
    }

    /// The players of a team that an agent may control, in source order.
    fn controllable<'a>(
        &'a self,
        scenario: &'a Scenario,
        team: Team,
    ) -> impl Iterator<Item = PlayerId> + 'a {
        scenario
            .seats(team)
            .filter(|(id, slots)| {
                slots.iter().any(|slot| slot.controllable) && self.present.get(*id) == Some(&true)
            })
            .map(|(id, _)| PlayerId(id as u8))
    }

    /// The players of these names.
    fn named(
        &self,
        scenario: &Scenario,
        team: Team,
        names: &[String],
    ) -> Result<Vec<Option<PlayerId>>, RosterError> {
        let known: Vec<(String, PlayerId)> = self
            .controllable(scenario, team)
            .map(|id| (player_name(scenario, team, id), id))
            .collect();
        let mut players = Vec::new();
        for name in names {
            let Some((_, id)) = known.iter().find(|(other, _)| other == name) else {
                let known = known.into_iter().map(|(name, _)| name).collect();
                return Err(RosterError::Player { team, name: name.clone(), known });
            };
            if players.contains(&Some(*id)) {
                return Err(RosterError::Twice { name: name.clone() });
            }
            players.push(Some(*id));
        }
        Ok(players)
    }

    /// This many agents: one per controllable player, or the first few with the keeper last.
    fn counted(
        &self,
        scenario: &Scenario,
        team: Team,
        asked: u32,
        fixed: bool,
    ) -> Result<Vec<Option<PlayerId>>, RosterError> {
        let all: Vec<PlayerId> = self.controllable(scenario, team).collect();
        if asked as usize > all.len() {
            return Err(RosterError::TooMany { team, asked, controllable: all.len() as u32 });
        }
        if asked as usize == all.len() {
            return Ok(all.into_iter().map(Some).collect());
        }
        if !fixed {
            return Ok(vec![None; asked as usize]);
        }
        let keeper = |id: &PlayerId| {
            scenario.team(team).any(|(other, slot)| other == id.index() && slot.role == Role::GK)
        };
        let (keepers, outfield): (Vec<_>, Vec<_>) = all.into_iter().partition(keeper);
        Ok(outfield.into_iter().chain(keepers).take(asked as usize).map(Some).collect())
    }
}

/// A player's name, else their team, role and number among the team's players of that role.
pub(crate) fn player_name(scenario: &Scenario, team: Team, player: PlayerId) -> String {
    let Some((_, slot)) = scenario.team(team).find(|(id, _)| *id == player.index()) else {
        return format!("{team}_{}", player.in_team());
    };
    slot.name.clone().unwrap_or_else(|| {
        let before = scenario
            .team(team)
            .filter(|(id, other)| !other.instead && *id <= player.index())
            .filter(|(_, other)| other.role == slot.role);
        format!("{team}_{}_{}", slot.role, before.count())
    })
}
