//! The lists of statements and the words with which their statements begin.

use crate::habit::HabitPlace;
use setpiece_grammar::Rule;

/// A list of statements.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::parse) enum Context {
    /// A file.
    File,
    /// A scenario.
    Scenario,
    /// A team or formation.
    Team,
    /// A reward or a block in it.
    Reward,
    /// A behaviour or a block in it.
    Behavior,
    /// A suite or an `each` in it.
    Suite,
    /// A check.
    Check,
    /// A curriculum.
    Curriculum,
    /// Options.
    Fields,
}

/// The words with which statements begin in a block, by the block's word; `""` for a file.
pub fn statement_words(block: &str) -> &'static [&'static str] {
    Context::of_block(block).keywords()
}

impl Context {
    /// Every list.
    pub(in crate::parse) const ALL: [Context; 9] = [
        Context::File,
        Context::Scenario,
        Context::Team,
        Context::Reward,
        Context::Behavior,
        Context::Suite,
        Context::Check,
        Context::Curriculum,
        Context::Fields,
    ];

    /// The list in a block that begins with this word.
    pub(in crate::parse) fn of_block(word: &str) -> Context {
        match word {
            "" => Context::File,
            "scenario" => Context::Scenario,
            "team" | "formation" => Context::Team,
            "reward" | "on" | "when" => Context::Reward,
            "behavior" | "repeat" | "choose" | "interrupt" | "if" => Context::Behavior,
            "suite" => Context::Suite,
            "check" => Context::Check,
            "curriculum" => Context::Curriculum,
            _ => Context::Fields,
        }
    }

    /// The rule of a statement.
    pub(super) const fn statement(self) -> Rule {
        match self {
            Context::File => Rule::item,
            Context::Scenario => Rule::scen_stmt,
            Context::Team => Rule::team_stmt,
            Context::Reward => Rule::reward_stmt,
            Context::Behavior => Rule::beh_stmt,
            Context::Suite => Rule::suite_stmt,
            Context::Check => Rule::check_stmt,
            Context::Curriculum => Rule::curriculum_stmt,
            Context::Fields => Rule::field,
        }
    }

    /// The rule that reads statements to the end and takes no junk.
    pub(in crate::parse) const fn probe(self) -> Rule {
        match self {
            Context::File => Rule::file_probe,
            Context::Scenario => Rule::scenario_probe,
            Context::Team => Rule::team_probe,
            Context::Reward => Rule::reward_probe,
            Context::Behavior => Rule::behavior_probe,
            Context::Suite => Rule::suite_probe,
            Context::Check => Rule::check_probe,
            Context::Curriculum => Rule::curriculum_probe,
            Context::Fields => Rule::fields_probe,
        }
    }

    /// Where habits are met in it.
    pub(super) const fn place(self) -> HabitPlace {
        match self {
            Context::File => HabitPlace::File,
            Context::Scenario => HabitPlace::Scenario,
            Context::Team => HabitPlace::Team,
            Context::Reward => HabitPlace::Reward,
            Context::Behavior => HabitPlace::Behavior,
            Context::Suite => HabitPlace::Suite,
            Context::Check => HabitPlace::Check,
            Context::Curriculum => HabitPlace::Curriculum,
            Context::Fields => HabitPlace::Fields,
        }
    }

    /// What it lists.
    pub(super) const fn list(self) -> &'static str {
        match self {
            Context::File => "items",
            Context::Fields => "options",
            Context::Suite => "entries",
            _ => "statements",
        }
    }

    /// Where one is, with its article.
    pub(super) const fn name(self) -> &'static str {
        match self {
            Context::File => "a file, outside of everything",
            Context::Scenario => "a scenario",
            Context::Team => "a team",
            Context::Reward => "a reward",
            Context::Behavior => "a behavior",
            Context::Suite => "a suite",
            Context::Check => "a check",
            Context::Curriculum => "a curriculum",
            Context::Fields => "options",
        }
    }

    /// The words with which a statement may begin.
    pub(in crate::parse) const fn keywords(self) -> &'static [&'static str] {
        match self {
            Context::File => &[
                "import",
                "abstract",
                "scenario",
                "reward",
                "formation",
                "const",
                "fn",
                "region",
                "table",
                "ending",
                "behavior",
                "curriculum",
                "suite",
                "check",
            ],
            Context::Scenario => &[
                "param",
                "let",
                "const",
                "region",
                "rules",
                "world",
                "pitch",
                "agents",
                "ball",
                "team",
                "kickoff",
                "start",
                "reward",
                "end",
                "require",
                "record",
                "remove",
                "mirror",
                "observe",
                "rounds",
                "substitute",
            ],
            Context::Team => &["place", "each"],
            Context::Reward => &["state", "let", "give", "on", "when"],
            Context::Behavior => {
                &["do", "interrupt", "repeat", "choose", "if", "state", "let", "finish"]
            }
            Context::Suite => &["each"],
            Context::Check => &["play", "expect"],
            Context::Curriculum => &["stage", "mix"],
            Context::Fields => &[],
        }
    }

    /// The words with which a statement may go on.
    pub(super) const fn further(self) -> &'static [&'static str] {
        match self {
            Context::Scenario => &["jitter", "when", "with", "as"],
            Context::Team => super::expect::AFTER_ROLE,
            Context::Reward => &["per", "once", "on", "when", "as", "else"],
            Context::Behavior => &["sprinting", "until", "for", "else", "times"],
            Context::Suite => &["for", "seed"],
            Context::Check => &["with", "for", "seed", "over"],
            Context::Curriculum => &["until", "or", "adapt", "from", "to", "keeping", "in"],
            Context::File | Context::Fields => &[],
        }
    }

    /// How a statement that begins with a word is written.
    pub(super) fn form(self, word: &str) -> Option<&'static str> {
        Some(match (self, word) {
            (Context::File, "import") => "import \"rewards.pitch\"",
            (Context::File, "abstract") => "abstract scenario base { … }",
            (Context::File, "scenario") => "scenario my_drill { … }",
            (Context::File, "reward") => "reward scoring { give 1 on goal by us }",
            (Context::File, "formation") => "formation pair { CM at (-0.3, 0) }",
            (Context::File, "fn") => "fn twice(x: number) = x * 2",
            (Context::File, "table") => "table worth = [[0, 0.1], [0, 0.2]]",
            (Context::File, "ending") => "ending late = elapsed > 20s",
            (Context::File, "behavior") => "behavior waits { do hold }",
            (Context::File, "suite") => "suite mine { academy_corner for 100 episodes }",
            (Context::File, "check") => {
                "check \"it can be scored\" { play my_drill with bot for 50 episodes expect success_rate > 50% }"
            }
            (Context::File, "curriculum") => "curriculum mine { stage first = academy_corner }",
            (Context::Suite, "each") => "each level in [0.2, 0.8] { … }",
            (Context::Suite, _) => "academy_corner for 100 episodes",
            (Context::Check, "play") => "play academy_corner with bot for 50 episodes",
            (Context::Check, "expect") => "expect success_rate > 50%",
            (Context::Curriculum, "stage") => {
                "stage first = academy_corner until success_rate(last: 200) > 80%"
            }
            (Context::Curriculum, "mix") => "mix current: 80%, earlier: 20%",
            (Context::File | Context::Scenario, "const") => "const far = 12m",
            (Context::File | Context::Scenario, "region") => "region strip = right.box",
            (Context::Scenario, "param") => "param reach = 12m in 5m..20m",
            (Context::Scenario, "let") => "let lane = uniform(-0.2, 0.2)",
            (Context::Scenario, "rules") => "rules { offside: off }",
            (Context::Scenario, "world") => "world { wind: (4m/s, 0m/s) }",
            (Context::Scenario, "pitch") => "pitch { length: 60m, width: 40m }",
            (Context::Scenario, "agents") => "agents { left: 1 }",
            (Context::Scenario, "ball") => "ball at (0.6, 0)",
            (Context::Scenario, "team") => "team left { CM at (0.5, 0) }",
            (Context::Scenario, "start") => "start corner for left",
            (Context::Scenario, "reward") => "reward mine { give 1 on goal by us }",
            (Context::Scenario, "end") => "end success when goal by left",
            (Context::Scenario, "require") => "require distance(anna, bert) > 5m",
            (Context::Scenario, "record") => "record goals = count of goal by left",
            (Context::Scenario, "remove") => "remove reward scoring",
            (Context::Scenario, "mirror") => "mirror: flanks",
            (Context::Scenario, "substitute") => {
                "substitute tired when tired.fatigue > 0.8 { fatigue: 0 }"
            }
            (Context::Scenario, "rounds") => "rounds 5 when goal or ball_dead",
            (Context::Team, "each") => "each outfield { difficulty: 0.6 }",
            (Context::Team, "place") => "place anchor at (0, 0)",
            (Context::Reward | Context::Behavior, "state") => "state n = 0",
            (Context::Reward | Context::Behavior, "let") => "let near = 5m",
            (Context::Reward, "give") => "give 1 on goal by us",
            (Context::Reward, "on") => "on goal by us { give 1 }",
            (Context::Reward, "when") => "when us has ball { give 0.1 per second }",
            (Context::Behavior, "do") => "do move_to(ball) until me has ball",
            (Context::Behavior, "interrupt") => "interrupt when me has ball { do shoot }",
            (Context::Behavior, "repeat") => "repeat 3 times { … }",
            (Context::Behavior, "choose") => "choose { 2: do shoot 1: do hold for 1s }",
            (Context::Behavior, "if") => "if me has ball { do shoot } else { do press }",
            _ => return None,
        })
    }

    /// The rule of the block that belongs to a keyword.
    pub(super) fn block_of(self, keyword: &str) -> Option<Rule> {
        Some(match (self, keyword) {
            (Context::File, "scenario" | "abstract") => Rule::scenario_body,
            (Context::File | Context::Scenario, "reward") | (Context::Reward, "on" | "when") => {
                Rule::reward_body
            }
            (Context::File, "behavior") | (Context::Behavior, "interrupt" | "repeat" | "if") => {
                Rule::behavior_body
            }
            (Context::File, "formation") | (Context::Scenario, "team") => Rule::team_body,
            (Context::File, "suite") | (Context::Suite, "each") => Rule::suite_body,
            (Context::File, "check") => Rule::check_body,
            (Context::File, "curriculum") => Rule::curriculum_body,
            (
                Context::Scenario,
                "rules" | "world" | "pitch" | "agents" | "ball" | "start" | "kickoff",
            ) => Rule::fields,
            _ => return None,
        })
    }
}
