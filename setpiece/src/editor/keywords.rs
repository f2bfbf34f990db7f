//! The words that begin or join statements: where they stand, what they mean, what follows them.

/// A kind of block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum KeywordBlock {
    /// Outside of every block.
    File,
    /// `scenario`.
    Scenario,
    /// `team`, `formation`.
    Team,
    /// `reward`, and `on` or `when` in it.
    Reward,
    /// `behavior` and blocks in it.
    Behavior,
    /// `check`.
    Check,
    /// `curriculum`.
    Curriculum,
    /// Within a statement.
    Within,
}

impl KeywordBlock {
    /// The kind of a block that begins with this word; of the file for none.
    pub(super) fn of(word: &str) -> KeywordBlock {
        match word {
            "" => KeywordBlock::File,
            "scenario" => KeywordBlock::Scenario,
            "team" | "formation" => KeywordBlock::Team,
            "reward" | "on" | "when" => KeywordBlock::Reward,
            "behavior" | "repeat" | "interrupt" | "if" => KeywordBlock::Behavior,
            "check" => KeywordBlock::Check,
            "curriculum" => KeywordBlock::Curriculum,
            _ => KeywordBlock::Within,
        }
    }
}

/// A keyword.
#[derive(Clone, Copy, Debug)]
pub(super) struct Keyword {
    /// The word.
    pub(super) name: &'static str,
    /// Where it stands.
    pub(super) block: KeywordBlock,
    /// What it means, in a line.
    pub(super) doc: &'static str,
    /// The page of the reference, under `docs/language/`.
    pub(super) page: &'static str,
    /// What is written with it, with `${1:places}` to fill in; empty if the word stands alone.
    pub(super) snippet: &'static str,
}

macro_rules! keywords {
    ($($block:ident $page:literal { $($name:literal $doc:literal $($snippet:literal)?;)* })*) => {
        &[$($(Keyword {
            name: $name,
            block: KeywordBlock::$block,
            doc: $doc,
            page: concat!($page, ".md"),
            snippet: concat!($($snippet)?),
        }),*),*]
    };
}

/// Every keyword, by block. One that stands in several blocks is in each.
pub(super) const KEYWORDS: &[Keyword] = keywords! {
    File "scenario" {
        "scenario" "a scenario: its players, its rewards, when it ends"
            "scenario ${1:name} extends academy {\n    ball at (${2:0.5}, 0)\n    team left {\n        CF at (${3:0.45}, 0)\n    }\n    reward scoring$0\n}";
        "abstract" "a scenario that others extend and that isn't played itself"
            "abstract scenario ${1:name} {\n    $0\n}";
    }
    File "reward" {
        "reward" "a reward that scenarios use by its name"
            "reward ${1:name} {\n    give ${2:0.1} on ${3:pass completed by us}$0\n}";
    }
    File "team" {
        "formation" "players and their places, in the team's own frame"
            "formation ${1:name} {\n    GK at (-1, 0)\n    $0\n}";
    }
    File "behavior" {
        "behavior" "what a scripted player does" "behavior ${1:name} {\n    do ${2:press}$0\n}";
    }
    File "ending" { "ending" "a condition that ends episodes, under a name" "ending ${1:name} = $0"; }
    File "region" { "region" "a part of the pitch, under a name" "region ${1:name} = $0"; }
    File "expression" {
        "fn" "an expression with parameters" "fn ${1:name}(${2:x: number}) = $0";
        "const" "a value that is known when the text is compiled" "const ${1:NAME} = $0";
    }
    File "table" { "table" "numbers over the pitch" "table ${1:name} over ${2:pitch} = [[$0]]"; }
    File "import" { "import" "takes the names of another file" "import \"${1:file.pitch}\""; }
    File "level" {
        "suite" "episodes that a policy is evaluated on"
            "suite ${1:name} {\n    ${2:academy_corner} for ${3:100} episodes$0\n}";
        "check" "what must hold over many episodes"
            "check \"${1:what holds}\" {\n    play ${2:academy_empty_goal_close} with ${3:run_and_shoot} for ${4:50} episodes\n    expect ${5:success_rate > 50%}$0\n}";
        "curriculum" "stages of a training, one after the other"
            "curriculum ${1:name} {\n    stage ${2:first} = ${3:academy_empty_goal} until ${4:success_rate(last: 200) > 90%}\n    stage ${5:last} = ${6:academy_run_to_score}$0\n}";
    }
    Scenario "param" { "param" "a value that is chosen when the scenario is loaded" "param ${1:name}: ${2:number} = ${3:0.5} in ${4:0..1}"; }
    Scenario "draw" {
        "let" "a value of the start, drawn or computed at reset" "let ${1:name} = $0";
        "require" "what must hold of a start; other starts are drawn again" "require $0";
    }
    Scenario "expression" { "const" "a value that is known when the text is compiled" "const ${1:name} = $0"; }
    Scenario "region" { "region" "a part of the pitch, under a name" "region ${1:name} = $0"; }
    Scenario "place" { "ball" "where the ball lies at the start" "ball at (${1:0.5}, ${2:0})"; }
    Scenario "team" { "team" "the players of a team" "team ${1:left} {\n    $0\n}"; }
    Scenario "scenario" {
        "agents" "how many players of each team agents control" "agents { left: ${1:1} }";
        "remove" "takes an inherited statement out" "remove ${1:reward} ${2:scoring}";
    }
    Scenario "start" {
        "rules" "which rules of football apply" "rules { $0 }";
        "start" "begins with a set piece" "start ${1:corner} for ${2:left}";
        "kickoff" "begins with a kick-off" "kickoff ${1:left} { kicking: ${2:grf_kicking}, receiving: ${3:grf_receiving} }";
        "rounds" "several rounds in one episode" "rounds ${1:5} when ${2:ball_dead}";
        "substitute" "replaces a player during the match" "substitute ${1:player} when $0";
    }
    Scenario "world" { "world" "gravity, wind and what the ball does" "world { $0 }"; }
    Scenario "pitch" { "pitch" "the size of the pitch" "pitch { length: ${1:60m}, width: ${2:40m} }"; }
    Scenario "reward" { "reward" "what agents are paid for" "reward ${1:scoring}"; }
    Scenario "ending" { "end" "when an episode ends" "end ${1:success} ${2:name} when $0"; }
    Scenario "record" { "record" "a number that is kept about an episode" "record ${1:name} = count of ${2:pass completed by left}"; }
    Scenario "mirror" { "mirror" "also plays the scenario mirrored" "mirror: ${1:flanks}"; }
    Scenario "observe" { "observe" "an observation of your own" "observe vector {\n    $0\n}"; }
    Team "team" {
        "absent" "this player of the formation doesn't play";
        "each" "options of several players" "each ${1:outfield} { $0 }";
        "maybe" "a player who is there in a share of the episodes" "maybe ${1:30%} ${2:CM} at $0";
        "place" "an inherited player stands elsewhere" "place ${1:CB} at $0";
    }
    Reward "reward" {
        "give" "pays" "give ${1:0.1} on ${2:pass completed by us}";
        "on" "in steps with an event" "on ${1:goal by us} {\n    $0\n}";
        "when" "in steps in which a condition holds" "when ${1:me has ball} {\n    $0\n}";
        "let" "a value of this step, under a name" "let ${1:name} = $0";
        "state" "a value that is kept from step to step" "state ${1:name} = ${2:0}";
        "else" "where the condition doesn't hold";
    }
    Behavior "behavior" {
        "do" "an act, until it is over" "do $0";
        "if" "chooses by a condition" "if ${1:me has ball} {\n    $0\n}";
        "else" "where no condition holds";
        "interrupt" "something else, as soon as a condition holds" "interrupt when ${1:me has ball} {\n    $0\n}";
        "repeat" "over and over" "repeat {\n    $0\n}";
        "choose" "chooses by chance" "choose {\n    ${1:2}: $0\n}";
        "let" "a value that is computed when it is reached" "let ${1:name} = $0";
        "state" "a value that is kept" "state ${1:name} = ${2:0}";
        "finish" "ends the behaviour";
    }
    Check "level" {
        "play" "what is played, and who plays" "play ${1:academy_corner} with ${2:bot} for ${3:50} episodes";
        "expect" "what must hold" "expect ${1:success_rate > 50%}";
    }
    Curriculum "level" {
        "stage" "what is trained on until something is reached" "stage ${1:name} = ${2:academy_corner} until ${3:success_rate(last: 200) > 80%}";
        "mix" "earlier stages come back for a share of the episodes" "mix current: ${1:80%}, earlier: ${2:20%}";
    }
    Within "level" {
        "adapt" "moves a value so that a measure stays in its range";
        "current" "the share of the present stage";
        "earlier" "the share of earlier stages";
        "episodes" "how many episodes";
        "keeping" "the measure that `adapt` keeps in a range";
        "never" "an outcome that may not occur";
        "over" "with parameters drawn from their ranges; or the part of the pitch that a table covers";
        "params" "the parameters, drawn from their ranges";
        "seed" "where the seeds begin";
        "until" "ends it";
        "with" "who plays; or how likely a requirement is";
    }
    Within "place" {
        "ahead" "ahead of somebody, as they face or attack" ;
        "along" "the direction of an offset";
        "at" "at a point";
        "away" "away from a point";
        "behind" "behind somebody, as they face or attack";
        "between" "between two points";
        "beyond" "beyond somebody, seen from somewhere";
        "by" "how far; or whose deed an event is";
        "facing" "where a player looks";
        "from" "seen from where; or where an event began";
        "in" "somewhere in a region; or whether something lies in it";
        "jitter" "moved at random by up to this much";
        "of" "of which player, or of what";
        "offset" "from a point along an angle";
        "own" "read in the team's own frame";
    }
    Within "expression" {
        "and" "both hold";
        "changes" "is different from the step before";
        "has" "`X has ball`: who has it now";
        "if" "`if c then a else b`: one of two values";
        "not" "doesn't hold";
        "or" "one of them holds, or both";
        "then" "the value where the condition holds";
        "where" "only those for which a condition holds";
        "for" "for each of a set; or who receives a reward, or how long";
    }
    Within "reward" {
        "as" "the name that it has in results";
        "once" "only the first time in an episode";
        "per" "`per second`: paid at a rate";
        "second" "`per second`: paid at a rate";
        "to" "who receives it";
        "script" "a Rhai script says how much, when or what" ;
        "rhai" "`script rhai \"\"\"…\"\"\"`: a script in the text";
    }
    Within "ending" {
        "failure" "the episode counts as failed";
        "limit" "the longest episode" ;
        "success" "the episode counts as a success";
    }
    Within "scenario" {
        "extends" "takes everything of another one, and changes some of it";
        "all" "every player of the team";
        "outfield" "every player but the keeper";
        "off" "not so";
        "left" "the left team, which attacks to the right";
        "right" "the right team";
    }
    Within "observe" {
        "delayed" "how late it is seen";
        "noise" "what is added to it";
        "stack" "how many steps of it are seen";
        "vector" "the numbers that agents see";
    }
    Within "behavior" {
        "sprinting" "at full speed";
        "times" "how often it is repeated";
    }
};

#[cfg(test)]
mod tests {
    use super::{KEYWORDS, KeywordBlock};
    use crate::editor::words;

    /// A word of the grammar that an editor can't explain would be a gap in hover and completion.
    #[test]
    fn every_keyword_of_the_grammar_is_explained() {
        let rules = setpiece_grammar::Rule::all_rules().iter();
        let lost: Vec<&str> = rules
            .filter_map(|rule| setpiece_grammar::keyword(*rule))
            .filter(|word| !KEYWORDS.iter().any(|known| known.name == *word))
            .filter(|word| !words::all().any(|known| known.name == *word))
            .collect();
        assert_eq!(lost, [""; 0]);
    }

    /// A statement that the parser knows can be completed where it may begin.
    #[test]
    fn every_statement_is_offered_in_its_block() {
        for word in ["", "scenario", "team", "reward", "behavior", "check", "curriculum"] {
            let block = KeywordBlock::of(word);
            let known = |name: &&&str| {
                KEYWORDS.iter().any(|known| known.block == block && known.name == **name)
            };
            let words = crate::dsl::parse::statement_words(word);
            assert!(!words.is_empty(), "{word}");
            let lost: Vec<_> = words.iter().filter(|name| !known(name)).collect();
            assert!(lost.is_empty(), "{word}: {lost:?}");
        }
    }
}
