//! Who takes part: what of a start depends on parameters alone, so that it is known before the first episode.

use super::{DrawKey, Drawer};
use crate::judge::machine::truth;
use crate::state::PlayerId;
use setpiece_scenario::pitch::PLAYERS_MAX;
use setpiece_scenario::vocabulary::{Role, Team};
use setpiece_scenario::{Bindings, Scenario, SideAgents, Switching};

/// The players and agents of an environment, the same in every episode.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Roster {
    /// Which players take part, by id.
    pub present: [bool; PLAYERS_MAX],
    /// The agents, left before right: the team, and the player where he is fixed.
    pub agents: Vec<(Team, Option<PlayerId>)>,
}

/// Agents asked for instead of the scenario's.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct AgentsChoice {
    /// Left and right.
    pub sides: [SideChoice; 2],
    /// Whether each agent keeps his player for ever.
    pub fixed: bool,
}

/// The agents of a side.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SideChoice {
    /// As the scenario says.
    Scenario,
    /// So many.
    Count(u32),
    /// One per controllable player.
    All,
}

/// More agents were asked for than there are players for them.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{asked} agents on the {team} side, which has {controllable} controllable players")]
pub struct RosterError {
    /// The side.
    pub team: Team,
    /// How many were asked for.
    pub asked: u32,
    /// How many there may be.
    pub controllable: u32,
}

impl Roster {
    /// The roster of a scenario under its parameters.
    ///
    /// # Errors
    /// [`RosterError`] where more agents are asked for than there are controllable players.
    pub fn new(scenario: &Scenario, bindings: &Bindings, choice: Option<&AgentsChoice>) -> Result<Roster, RosterError> {
        let mut drawer = Drawer::new(scenario);
        // Presence and counts don't depend on draws: any seed tells them.
        let draws = DrawKey { seed: 0, index: 0, attempt: 0 };
        drawer.begin(bindings, draws);
        drawer.run(bindings, draws);
        let mut roster = Roster { present: [false; PLAYERS_MAX], agents: Vec::new() };
        for team in Team::ALL {
            for (id, slot) in scenario.team(*team).filter(|&(id, _)| id < PLAYERS_MAX) {
                roster.present[id] = slot.start.present.is_none_or(|present| truth(drawer.value(present)));
            }
        }
        for team in Team::ALL {
            let side = choice.map_or(SideChoice::Scenario, |choice| choice.sides[team.index()]);
            let fixed = choice.map_or(scenario.agents.switching == Switching::Fixed, |choice| choice.fixed);
            let count = |asked| roster.counted(scenario, *team, asked, fixed);
            let agents = match (side, &scenario.agents.sides[team.index()]) {
                (SideChoice::Count(n), _) => count(n)?,
                (SideChoice::Scenario, SideAgents::Count(n)) => count(libm::round(drawer.value(*n)) as u32)?,
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

    /// The players of a team that an agent may be given, in source order.
    fn controllable<'a>(&'a self, scenario: &'a Scenario, team: Team) -> impl Iterator<Item = PlayerId> + 'a {
        scenario
            .team(team)
            .filter(|(id, slot)| slot.controllable && self.present.get(*id) == Some(&true))
            .map(|(id, _)| PlayerId(id as u8))
    }

    /// So many agents: every controllable player's, or the first few with the keeper last.
    fn counted(
        &self,
        scenario: &Scenario,
        team: Team,
        asked: u32,
        fixed: bool,
    ) -> Result<Vec<Option<PlayerId>>, RosterError> {
        let all: Vec<PlayerId> = self.controllable(scenario, team).collect();
        if asked as usize > all.len() {
            return Err(RosterError { team, asked, controllable: all.len() as u32 });
        }
        if asked as usize == all.len() {
            return Ok(all.into_iter().map(Some).collect());
        }
        if !fixed {
            return Ok(vec![None; asked as usize]);
        }
        let keeper =
            |id: &PlayerId| scenario.team(team).any(|(other, slot)| other == id.index() && slot.role == Role::GK);
        let (keepers, outfield): (Vec<_>, Vec<_>) = all.into_iter().partition(keeper);
        Ok(outfield.into_iter().chain(keepers).take(asked as usize).map(Some).collect())
    }
}
