//! The registry of codes, and what is known of a problem from its code alone.

/// How bad a problem is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// The scenario is compiled all the same.
    Warning,
    /// No scenario comes out.
    Error,
}

/// Declares the registry of codes: number, severity, title.
macro_rules! codes {
    ($($(#[$meta:meta])* $name:ident = $number:literal $severity:ident $title:literal;)+) => {
        /// A stable code of a problem: `SP0204`. Never reused.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum Code {
            $(#[doc = $title] $name,)+
        }

        impl Code {
            /// Every code, in order.
            pub const ALL: &'static [Code] = &[$(Code::$name,)+];

            /// The number.
            pub const fn number(self) -> u16 {
                match self { $(Code::$name => $number,)+ }
            }

            /// What it is about, in a few words.
            pub const fn title(self) -> &'static str {
                match self { $(Code::$name => $title,)+ }
            }

            /// How bad it is.
            pub const fn severity(self) -> Severity {
                match self { $(Code::$name => Severity::$severity,)+ }
            }
        }
    };
}

codes! {
    // SP00xx: loading.
    FileMissing = 1 Error "a file can't be read";
    FileTooLarge = 2 Error "a file is too large";
    NotUtf8 = 3 Error "a file is not UTF-8 text";
    UnknownScenario = 5 Error "no scenario has this name";
    FileIsDirectory = 6 Error "a directory stands for a file";
    BadCompiled = 7 Error "a compiled scenario can't be read";
    BadParameter = 8 Error "a parameter can't be bound";
    UnknownReward = 9 Error "a reward is not in scope";
    UnknownCode = 10 Error "no report has this code";
    NoPicture = 11 Error "a picture can't be made";
    NoStep = 12 Error "an episode has no such step";
    BadSnapshot = 13 Error "a snapshot can't be used";
    BadReplay = 14 Error "a replay can't be played";
    CompiledCast = 15 Error "a compiled scenario keeps who plays its players";
    FileNotRegular = 17 Error "a pipe or device stands for a file";
    NoStudio = 18 Error "the studio can't be served";
    OtherLevel = 19 Error "a level is of another scenario";
    NoPlans = 20 Error "there is no such suite, check or curriculum";
    OtherSpaces = 21 Error "a level doesn't fit its vector";
    BadLevel = 22 Error "a level can't be read";
    BadPolicy = 23 Error "a policy can't be played";
    NoBaseline = 24 Error "a scenario has no baseline";
    // SP01xx: syntax.
    Syntax = 101 Error "something else was expected here";
    TooDeep = 102 Error "brackets are nested too deeply";
    BlockAfterGive = 103 Error "a `give` has no block";
    UnclosedBracket = 104 Error "a bracket is not closed";
    UnclosedString = 105 Error "a string is not closed";
    ComparisonChain = 106 Error "comparisons don't chain";
    ReservedName = 107 Error "a reserved word is used as a name";
    NotYet = 108 Error "this construct is not supported yet";
    TooMuch = 109 Error "there is more of this than a text may hold";
    // SP02xx: names.
    UnknownName = 201 Error "no such name";
    DuplicateName = 202 Error "a name is declared twice";
    UnknownRole = 203 Error "no such role";
    UnknownMember = 204 Error "no such property";
    UnknownOption = 205 Error "no such option";
    UnknownFunction = 206 Error "no such function";
    UnknownEvent = 207 Error "no such event";
    UnknownParent = 208 Error "nothing to extend has this name";
    ImportCycle = 209 Error "files import each other in a circle";
    ExtendsCycle = 210 Error "things extend each other in a circle";
    AmbiguousName = 211 Error "a name has two meanings";
    NothingToRemove = 212 Error "there is nothing to remove";
    Recursion = 216 Error "a definition uses itself";
    UnusedName = 213 Warning "a name is never used";
    LikelyTypo = 217 Warning "a name looks like another";
    HidingName = 218 Warning "a name hides another";
    NoScenario = 214 Error "the file has no scenario to run";
    WrongScope = 215 Error "this can't be used here";
    // SP03xx: types and units.
    WrongType = 301 Error "a value has another type";
    WrongUnit = 302 Error "units don't agree";
    WrongArguments = 303 Error "arguments don't match";
    MixedUnits = 304 Error "a point mixes units";
    NotConstant = 305 Error "the value must be known before the start";
    Impossible = 306 Error "the value can't be computed";
    // SP04xx: football.
    OffPitch = 401 Error "a player or the ball is off the pitch";
    SameSpot = 402 Error "two players stand on one spot";
    TooManyPlayers = 403 Error "a team has more than eleven players";
    OutOfRange = 404 Error "a value is out of its range";
    NoBall = 405 Error "the ball has no place";
    DuplicateOption = 406 Error "an option is given twice";
    WrongRoster = 407 Error "layouts of a kick-off differ";
    NoPlace = 408 Error "a player has no place";
    CyclicPlace = 409 Error "places depend on each other in a circle";
    BadAgents = 410 Error "agents don't fit the team";
    NoEnding = 411 Warning "the episode never ends";
    TwoKeepers = 412 Error "a team has two keepers";
    AbsentPlayer = 413 Error "a player is absent and placed";
    AgentOverScript = 414 Warning "an agent may take a scripted player";
    DeadParameter = 415 Warning "an inherited parameter does nothing";
    TooCostly = 418 Error "a scenario costs too much";
    OtherAgents = 419 Warning "stages have other numbers of agents";
    // SP05xx: scripts.
    ScriptSyntax = 501 Error "a script can't be read";
    ScriptHook = 502 Error "a script lacks its hook";
    ScriptName = 503 Error "a script uses a name that is not there";
    // SP06xx: what a dry run finds.
    EndsAtOnce = 601 Error "the episode ends before its first step";
    NeverPays = 602 Warning "a reward can never pay";
    HardToDraw = 603 Warning "requirements are seldom met";
    ImpossibleToDraw = 604 Error "requirements are never met";
    NeverEnds = 605 Warning "an ending never comes about";
    // SP07xx: while episodes run.
    DrawFailed = 701 Error "no start meets the requirements";
    ScriptFailed = 702 Error "a script's hook failed";
    Endless = 703 Error "nothing ends the episode";
    NoThreads = 704 Error "threads can't be started";
}

/// Who finds a problem: the hundreds of its code.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// Whoever reads files and what a caller asks for: `SP00xx`.
    Load,
    /// The parser: `SP01xx`.
    Syntax,
    /// Whoever binds names: `SP02xx`.
    Names,
    /// The check of types and units: `SP03xx`.
    Types,
    /// Football's rules and ranges: `SP04xx`.
    Football,
    /// The check of scripts: `SP05xx`.
    Scripts,
    /// A dry run: `SP06xx`.
    DryRun,
    /// An episode: `SP07xx`.
    Episode,
}

impl Code {
    /// Who finds it.
    pub const fn stage(self) -> Stage {
        match self.number() / 100 {
            0 => Stage::Load,
            1 => Stage::Syntax,
            2 => Stage::Names,
            3 => Stage::Types,
            4 => Stage::Football,
            5 => Stage::Scripts,
            6 => Stage::DryRun,
            _ => Stage::Episode,
        }
    }

    /// Whether what it is about is left out of the scenario, so that the rest may lack it: see
    /// [`Code::may_be_echo`].
    pub const fn leaves_gap(self) -> bool {
        match self.stage() {
            Stage::Load => true,
            // What is not supported yet has been read all the same.
            Stage::Syntax => !matches!(self, Code::NotYet),
            Stage::Names => matches!(
                self,
                Code::UnknownRole
                    | Code::UnknownEvent
                    | Code::UnknownParent
                    | Code::ImportCycle
                    | Code::ExtendsCycle
            ),
            Stage::Types | Stage::Football | Stage::Scripts | Stage::DryRun | Stage::Episode => {
                false
            }
        }
    }

    /// Whether it may be nothing but the echo of a statement that was left out: it tells of what is
    /// not there.
    pub const fn may_be_echo(self) -> bool {
        matches!(
            self,
            Code::UnusedName
                | Code::NoEnding
                | Code::NoBall
                | Code::BadAgents
                | Code::WrongRoster
                | Code::NothingToRemove
        )
    }

    /// Whether what is wrong is wrong where it is used, and may be right elsewhere.
    pub const fn depends_on_caller(self) -> bool {
        matches!(self, Code::WrongScope | Code::NotConstant)
    }

    /// The code that a text names: `SP0203`, `sp0203` or `203`.
    pub fn from_text(text: &str) -> Option<Code> {
        let text = text.trim();
        let digits = match text.get(..2) {
            Some(head) if head.eq_ignore_ascii_case("sp") => text.get(2..)?,
            _ => text,
        };
        let number: u16 =
            digits.parse().ok().filter(|_| digits.bytes().all(|byte| byte.is_ascii_digit()))?;
        Code::ALL.iter().copied().find(|code| code.number() == number)
    }
}

impl std::fmt::Display for Code {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "SP{:04}", self.number())
    }
}
