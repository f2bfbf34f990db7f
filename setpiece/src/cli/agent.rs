//! The agent that an option names: a ready-made one, or the file of a policy.

use crate::agent::ChosenAgent;
use crate::baseline::BASELINE;
use crate::engine::control::agents::Agent;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::{Arg, Command};
use std::ffi::OsStr;
use std::path::Path;

/// Reads an agent.
#[derive(Clone)]
pub(crate) struct AgentParser;

/// What `--help` says of agents.
const ABOUT: [(Agent, &str); 4] = [
    (Agent::Random, "Uniform over the 19 actions"),
    (Agent::Idle, "Nothing"),
    (Agent::RunAndShoot, "Sprints at goal, shoots from 16 m, chases the ball"),
    (Agent::Bot, "The built-in bot"),
];

fn values() -> impl Iterator<Item = PossibleValue> {
    let named = ABOUT.iter().map(|(agent, about)| PossibleValue::new(agent.name()).help(*about));
    named.chain([
        PossibleValue::new(BASELINE).help("The policy that the scenario comes with"),
        PossibleValue::new("FILE.onnx").help("A policy from an ONNX file"),
    ])
}

impl TypedValueParser for AgentParser {
    type Value = ChosenAgent;

    fn parse_ref(
        &self,
        command: &Command,
        arg: Option<&Arg>,
        value: &OsStr,
    ) -> Result<ChosenAgent, clap::Error> {
        if ChosenAgent::is_path(&value.to_string_lossy()) {
            return Ok(ChosenAgent::of_file(Path::new(value)));
        }
        let name = PossibleValuesParser::new(values()).parse_ref(command, arg, value)?;
        Ok(ChosenAgent::from_name(&name).unwrap_or(Agent::Bot.into()))
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        Some(Box::new(values()))
    }
}
