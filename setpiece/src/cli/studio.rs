//! `setpiece studio`: the text and the football on one page.

use super::agent::AgentParser;
use super::common::{FAULT, FINE};
use super::out::Out;
use crate::Error;
use crate::agent::ChosenAgent;
use crate::dsl::problem::Code;
use crate::studio::{OpenOptions, ServeOptions, Session, serve};
use clap::Args;
use std::ffi::OsString;

#[derive(Args, Debug)]
pub(crate) struct StudioArgs {
    /// A scenario of the library, a .pitch file, a level (NAME{param=value}#SEED:EPISODE), or a
    /// recorded episode (.pitchr)
    #[arg(value_name = "SCENARIO", default_value = "academy_3_vs_1_with_keeper")]
    scenario: OsString,
    /// A recorded episode (.pitchr) to show beside it
    #[arg(value_name = "BESIDE")]
    beside: Option<OsString>,
    /// An agent that pages can choose, besides the ready-made ones; may be repeated. The first
    /// plays at the beginning
    #[arg(short, long = "agent", value_name = "AGENT", value_parser = AgentParser)]
    agents: Vec<ChosenAgent>,
    /// The port, on this machine alone; 0 takes any that is free
    #[arg(long, value_name = "N", default_value_t = 0)]
    port: u16,
    /// Also open the page in the browser
    #[arg(long)]
    open: bool,
}

/// Serves the page until Ctrl-C.
pub(crate) fn studio(args: &StudioArgs, out: &Out) -> Result<u8, Error> {
    for agent in &args.agents {
        agent.check()?;
    }
    let options = OpenOptions {
        allow_outside: out.allow_outside,
        agents: args.agents.clone(),
        ..OpenOptions::default()
    };
    let session = Session::open(&args.scenario, args.beside.as_deref(), options)?;
    let served = serve(session, ServeOptions { port: args.port, framed: false }, |ready| {
        out.line(format!("open {}", ready.address));
        out.line("Ctrl-C ends it");
    });
    match served {
        Ok(()) => Ok(FINE),
        Err(why) => {
            let message = format!("the studio can't be served: {why}");
            out.fault(&Code::NoStudio.to_string(), &message, Some("try another `--port`"));
            Ok(FAULT)
        }
    }
}
