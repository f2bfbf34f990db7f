//! What a text requires of every draw without saying so: labels of compiled requirements, and what
//! makes them hold.

/// A requirement that a text implies.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Implied {
    /// Players stand on the pitch.
    PlayersOnPitch,
    /// No two players stand on one spot.
    PlayersApart,
    /// The ball lies on the pitch.
    BallOnPitch,
    /// A throw-in is taken from a side line.
    BesideSideLine,
    /// A penalty box lies in its half.
    BoxFits,
    /// A point is found in a region that is made of several.
    InRegion { text: String },
    /// The ends of a range are in order.
    EndsOrdered { text: String },
    /// A choice can be drawn.
    AnyWeight { text: String },
    /// A value is in its range; `what` and `shown`: in backticks where they are written so.
    Inside { what: String, shown: String },
    /// A velocity is not above the greatest one.
    Slower { what: String, most_mps: f64 },
}

impl Implied {
    /// Its label, without backticks: messages put the whole of it into some.
    pub(crate) fn label(&self) -> String {
        let label = match self {
            Implied::PlayersOnPitch => "everybody stands on the pitch".to_owned(),
            Implied::PlayersApart => "nobody stands on another's spot".to_owned(),
            Implied::BallOnPitch => "the ball lies on the pitch".to_owned(),
            Implied::BesideSideLine => "the throw-in is taken from a side line".to_owned(),
            Implied::BoxFits => "the penalty boxes fit the pitch".to_owned(),
            Implied::InRegion { text } => format!("a point lies in {text}"),
            Implied::EndsOrdered { text } => {
                format!("the lower end of {text} lies below the upper one")
            }
            Implied::AnyWeight { text } => format!("a weight of {text} is above 0"),
            Implied::Inside { what, shown } => format!("{what} is {shown}"),
            Implied::Slower { what, most_mps } => {
                format!("{what} is not faster than {most_mps} m/s")
            }
        };
        label.replace('`', "")
    }

    /// What makes it hold.
    pub(crate) fn help(&self) -> String {
        match self {
            Implied::PlayersOnPitch => {
                "place the players where every draw lies between the lines".to_owned()
            }
            Implied::PlayersApart => {
                "give the players more room, or allow it: `{ overlap: allowed }`".to_owned()
            }
            Implied::BallOnPitch => "place it where every draw lies between the lines".to_owned(),
            Implied::BesideSideLine => super::start::SIDE_LINES.to_owned(),
            Implied::BoxFits => {
                "draw a smaller box, or leave it out: it is in proportion then".to_owned()
            }
            Implied::InRegion { .. } => {
                "draw from a region whose parts have more in common".to_owned()
            }
            Implied::EndsOrdered { .. } => "write the lower end first".to_owned(),
            Implied::AnyWeight { .. } => "give one of the choices a weight above 0".to_owned(),
            Implied::Inside { shown, .. } => format!("keep the value in {shown}"),
            Implied::Slower { .. } => "write a smaller velocity".to_owned(),
        }
    }
}
