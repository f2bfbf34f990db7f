//! What the session says of itself: its text, what a check found, its parameters and players.

use super::Session;
use crate::engine::environment::{Environment, EnvironmentOptions};
use crate::scenario::{Bindings, Type};
use crate::studio::message::{CheckReply, OpenReply, ParamControl, Reply, SeatReply};
use gen_lsp_types as lsp;

impl Session {
    pub(super) fn opening(&self, from: Option<String>) -> Reply {
        Reply::Opened(OpenReply {
            source: self.source.clone(),
            uri: self.uri(),
            is_file: self.path.is_some(),
            is_saved: self.path.is_none() || self.text == self.on_disk,
            text: self.text.clone(),
            from,
        })
    }

    /// The address of the text: that of its file, if it is one.
    fn uri(&self) -> String {
        let path = self.path.as_ref().and_then(|path| std::path::absolute(path).ok());
        let uri = path.and_then(|path| lsp::Uri::from_file_path(path).ok());
        uri.map_or_else(|| "untitled:studio.pitch".to_owned(), |uri| uri.to_string())
    }

    pub(super) fn checked(&self) -> Reply {
        let (problems, fault) = self.found.clone();
        let scenario = &self.loaded.scenario;
        let values = self.bindings().0;
        let params = scenario.params.iter().zip(values).map(|(param, value)| ParamControl {
            name: param.name.clone(),
            doc: param.doc.clone(),
            value,
            shown: param.show(value),
            range: param.range,
            choices: param.choices.clone(),
            values: param.values.clone(),
            kind: match param.ty {
                Type::Bool => "bool",
                Type::Int => "integer",
                _ => "number",
            },
        });
        Reply::Checked(CheckReply {
            problems,
            fault,
            name: scenario.name.clone(),
            title: scenario.title().to_owned(),
            params: params.collect(),
            agents: self.seats(),
            players: self.players(),
        })
    }

    /// Who can play: agents of the command, policies from outside, behaviours of the text.
    pub(super) fn players(&self) -> Vec<String> {
        let agents = self.agents().map(|agent| agent.name().to_owned());
        let guests = self.guests();
        let behaviors = self.loaded.behaviors.iter().filter(|name| !guests.contains(name));
        agents.chain(guests.iter().cloned()).chain(behaviors.cloned()).collect()
    }

    /// The agents that people can play.
    pub(super) fn seats(&self) -> Vec<SeatReply> {
        let Ok(environment) = Environment::new(self.loaded.scenario.clone(), self.environment())
        else {
            return Vec::new();
        };
        let agents = environment.agent_ids().iter().zip(&environment.roster().agents);
        agents.map(|(id, (team, _))| SeatReply { id: id.clone(), team: team.name() }).collect()
    }

    /// The parameters' values: those that were set, within their ranges.
    pub(super) fn bindings(&self) -> Bindings {
        let value = |param: &crate::scenario::Param| {
            let set = self.params.get(&param.name).copied().filter(|value| value.is_finite());
            match (set, param.range) {
                (Some(value), Some((low, high))) => value.clamp(low, high),
                (Some(value), None) => value,
                (None, _) => param.default,
            }
        };
        Bindings(self.loaded.scenario.params.iter().map(value).collect())
    }

    pub(super) fn environment(&self) -> EnvironmentOptions {
        EnvironmentOptions { bindings: Some(self.bindings()), ..EnvironmentOptions::default() }
    }
}
