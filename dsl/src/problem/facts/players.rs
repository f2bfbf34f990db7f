//! Teams, formations, agents and who stands where.

use super::facts;
use crate::problem::said::{Said, say};
use crate::problem::{Code, Guess};
use crate::source::Span;
use setpiece_scenario::vocabulary::Team;

facts! {
    /// Facts about players and teams.
    pub(crate) Players {
        /// More players are written than a team can ever have.
        TooManyWritten { team: Team, most: usize, team_max: usize } = Code::TooManyPlayers =>
            say(format!("more than {most} players are written for the {team} team"), "one too many")
                .help(format!("a team has at most {team_max} players: leave the others out")),
        /// More players than a team has; `line`: how a line of several is written so that it fits.
        TooMany { team: Team, most: usize, line: Option<String> } = Code::TooManyPlayers => {
            let said = say(format!("the {team} team has more than {most} players"), "this is the twelfth");
            match line {
                Some(line) => said.help(format!("write at most `{line} …`")),
                None => said.help("leave one out"),
            }
        },
        /// A number of players that is no small number.
        TooManyInLine { text: String } = Code::TooManyPlayers =>
            say(format!("`{text}` players are too many"), "a team has at most 11").help("write a number up to 11"),
        /// `0 CM`.
        NoneInLine { role: String } = Code::OutOfRange =>
            say(format!("`0 {role}` is nobody"), "")
                .help("leave the line out; whether a player takes part with a parameter says `when …`"),
        /// `5..3 CB`
        NumberEndsSwapped { least: u32, most: u32 } = Code::OutOfRange =>
            say(format!("`{least}..{most}` players: the first number must be less"), "")
                .help(if least == most {
                    format!("write `{most}`")
                } else {
                    format!("write `{most}..{least}`")
                }),
        /// `b: 30% CF`; `form`: how it is written.
        NameBeforeShare { name: String, form: String } = Code::Syntax =>
            say(format!("the name `{name}` stands before a share"), "a name stands before its role")
                .help(format!("write `{form} …`")),
        /// Two keepers.
        TwoKeepers { team: Team, first: Span } = Code::TwoKeepers =>
            say(format!("the {team} team has two keepers"), "the second one")
                .at(first, "the first one")
                .help("give one of them another role"),
        /// A role is placed and absent.
        AbsentAndPlaced { role: String, placed: Span } = Code::AbsentPlayer =>
            say(format!("`{role}` is absent and placed"), "absent here")
                .at(placed, "placed here")
                .help("leave one of the two lines out"),
        /// A role is absent that nobody has.
        NobodyToBeAbsent { role: String } = Code::NothingToRemove =>
            say(format!("no `{role}` is there to be absent"), "").help("leave it out"),
        /// A team with the layouts of `kickoff` writes players.
        LayoutsAndOwn { layouts: Span } = Code::DuplicateOption =>
            say("a team whose players come from `kickoff` has no players of its own", "")
                .at(layouts, "the layouts are given here")
                .help("write the player into both formations, or `place` one of theirs"),
        /// A team with the layouts of `kickoff` has a `formation`.
        LayoutsAndFormation { layouts: Span } = Code::DuplicateOption =>
            say("the layouts of `kickoff` are the formation", "").at(layouts, "given here").help("leave it out"),
        /// `kickoff` without one of its layouts, or without both.
        NoLayout { layout: Option<&'static str> } = Code::WrongArguments => {
            let what = layout.map_or("its two layouts".to_owned(), |it| format!("the `{it}` layout"));
            say(format!("`kickoff` lacks {what}"), "")
                .help("write `kickoff left { kicking: grf_kicking, receiving: grf_receiving }`")
        },
        /// The second layout gives a player options.
        SecondLayoutSaysMore { player: Span } = Code::WrongRoster =>
            say(
                "the second layout says more of a player than a place",
                "the first one says everything else",
            )
            .at(player, "said here")
            .help("move `facing`, `jitter`, `when` and options into the first formation"),
        /// The layouts have different players.
        LayoutsDiffer { first: String, second: String } = Code::WrongRoster =>
            say(
                format!("the layouts differ: `{first}` and `{second}`"),
                "the same players, in the same order, stand in both",
            )
            .help("list the roles of both formations in the same order"),
        /// Two players stand on one spot.
        ///
        /// - `nth`: at which of several kick-offs;
        /// - `own`: the second one's place in the own frame, if they are opponents and it may be
        ///   meant.
        SameSpot {
            players: (String, String),
            nth: Option<usize>,
            first: Span,
            own: Option<String>,
        } = Code::SameSpot => {
            let when = nth.map_or(String::new(), |nth| format!(" at kick-off {nth}"));
            let said = say(format!("{} and {} stand on one spot{when}", players.0, players.1), "the same spot")
                .at(first, "taken by this player");
            match own {
                Some(own) => said.help(format!("is it seen from the team's own goal? Then write `{own}`")),
                None => said.help("move one of them, or allow it: `{ overlap: allowed }`"),
            }
        },
        /// A substitution of somebody who isn't one certain player.
        SubstituteOfNobody { text: String } = Code::WrongType =>
            say(format!("`{text}` is not one player in every step"), "who goes off?")
                .help("name a player, `tired: CM at …`, and write `substitute tired when …`"),
        /// A substitution of several players.
        SubstituteOfMany { text: String, noun: String } = Code::WrongType =>
            say(format!("`{text}` is {noun}: one player goes off"), "who goes off?")
                .help("write one for each player by their name: `substitute tired when …`"),
        /// A substitution of a name in quotes.
        SubstituteInQuotes { name: String } = Code::WrongType =>
            say("a player's name stands without quotes", "").write(name),
        /// The place of what may be nobody.
        MayBeNobody { text: String } = Code::NoPlace =>
            say(format!("`{text}` may be nobody, who has no place"), "whose place?")
                .help("let it be a player in every case, or write a place: `at (0.5, 0)`"),
        /// Places that depend on each other in a circle.
        PlaceInCircle { text: String } = Code::CyclicPlace =>
            say("this place depends on itself", format!("`{text}` is placed by what is placed here"))
                .help("give one of them a place of its own: `at (x, y)`"),
        /// Whether a player takes part depends on itself.
        PresenceInCircle { text: String } = Code::CyclicPlace =>
            say("whether a player takes part depends on itself", format!("`{text}` counts them"))
                .help("draw the condition in a `let`, without counting players"),
        /// A player faces the own place.
        FacesItself = Code::Impossible =>
            say("a player can't face their own spot", "")
                .help("face another place, or an angle: `facing 90deg`"),
        /// A side keeps an agent beside the other side's, and has a player with an `ai`.
        AgentOverScript { team: Team, name: String } = Code::AgentOverScript =>
            say(
                format!("the {team} team keeps its agent, who may take `{name}` from its `ai`"),
                format!("says nothing of the {team} team"),
            )
            .help(format!("write `{team}: 0` beside it, or list the players that are meant, `{team}: [NAME]`")),
        /// An option that was written by an inherited parameter is written again, and nothing else
        /// reads the parameter.
        DeadParameter { name: String, parent: String, value: String, wrote: Span }
            = Code::DeadParameter =>
            say(
                format!("the inherited parameter `{name}` does nothing here"),
                "written without it",
            )
            .at(wrote, "the parent writes it by the parameter")
            .help(format!("write `extends {parent}({name}: {value})` instead of this option")),
        /// Listed agents can't switch players.
        ListedAgentSwitches = Code::BadAgents =>
            say("an agent that is listed by name keeps its player", "")
                .help("leave `switching` out, or ask for a number of agents: `left: 1`"),
        /// An agent that no player of the team is called.
        NoSuchAgent {
            team: Team,
            name: String,
            is_anyone: bool,
            guess: Guess,
        } = Code::BadAgents => {
            let said = say(format!("no player of the {team} team is called `{name}`"), "not known");
            if *is_anyone {
                said.guess(guess, "its players with names are")
            } else {
                said.help("give the players names, `anna: CM at (0, 0)`, and list those: `[anna]`")
            }
        },
        /// A listed agent whose player can't be controlled.
        NotControllable { name: String } = Code::BadAgents =>
            say(format!("`{name}` is not `controllable`"), "")
                .help("leave the player out of the list, or leave out `controllable: off`"),
        /// An agent is listed twice.
        ListedTwice { name: String } = Code::BadAgents =>
            say(format!("`{name}` is listed twice"), "").help("leave one of them out"),
        /// More agents than players that can be controlled.
        TooManyAgents {
            team: Team,
            asked: f64,
            controllable: usize,
            place: AskedFor,
        } = Code::BadAgents =>
            too_many_agents(*team, *asked, *controllable, place),
    }
}

/// Where agents are asked for.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum AskedFor {
    /// Nowhere: one player of the left team is controlled.
    Nowhere,
    /// In a parent.
    Inherited(Span),
    /// In the scenario itself.
    Here,
}

fn too_many_agents(team: Team, asked: f64, controllable: usize, place: &AskedFor) -> Said {
    let said = say(
        format!(
            "{asked} of the {team} team's players are asked for, {controllable} can be controlled"
        ),
        "",
    );
    match place {
        AskedFor::Nowhere => said.help("without `agents { … }` one player of the left team is controlled"),
        AskedFor::Inherited(at) => said
            .at(at, "asked for here")
            .help(format!("place them, `team {team} {{ CM at (0, 0) }}`, or ask for fewer: `agents {{ {team}: … }}`")),
        AskedFor::Here if controllable == 0 => {
            said.help(format!("place players in `team {team} {{ … }}`, or leave `{team}` out"))
        }
        AskedFor::Here => said.help(format!("write at most `{team}: {controllable}`, or `{team}: all`")),
    }
}
