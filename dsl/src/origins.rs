//! Where the parts of a compiled scenario come from.

use crate::outline::Outline;
use crate::source::Span;
use setpiece_scenario::Reg;

/// Where the parts of a compiled scenario stand in the sources.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Origins {
    /// The scenario's name.
    pub scenario: Option<Span>,
    /// Its parameters, in order.
    pub params: Vec<Span>,
    /// Its players, in order.
    pub players: Vec<Span>,
    /// Its ball.
    pub ball: Option<Span>,
    /// Its rewards, in order.
    pub rewards: Vec<Span>,
    /// Its endings, in order.
    pub endings: Vec<Span>,
    /// Its records, in order.
    pub records: Vec<Span>,
    /// The word behind its `mirror:`, own or inherited.
    pub mirror: Option<Span>,
    /// Its observation.
    pub observation: Option<Span>,
    /// Its requirements, in order: the written ones, then the implied.
    pub requires: Vec<RequireOrigin>,
    /// Its regions: the named ones, those that something is drawn in, and those that requirements
    /// ask about. Only if they are asked for.
    pub regions: Vec<RegionOrigin>,
}

/// A region, with the registers of the start program that give its shape.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RegionOrigin {
    /// Its name, or the expression.
    pub span: Span,
    /// Its shape.
    pub shape: Outline<Reg>,
}

/// Where a requirement of the draw comes from.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct RequireOrigin {
    /// The statement, or the part that implies it, where it is one part.
    pub span: Option<Span>,
    /// What makes an implied one hold.
    pub help: Option<String>,
}
