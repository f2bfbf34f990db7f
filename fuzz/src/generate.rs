//! Scenarios generated from the fuzzer's bytes; nearly all of them compile.
//!
//! When the bytes are used up, every choice is its first, simplest case.

mod expr;
mod play;
mod start;

use crate::choice::Choices;
use crate::levels;
use std::fmt::Write as _;

/// Writes a scenario's text.
#[derive(Debug)]
struct Writer<'a, 'b> {
    choices: &'a mut Choices<'b>,
    out: String,
    /// The named players, left and right.
    squads: [Vec<String>; 2],
    /// Names of numbers: parameters and `let`s.
    numbers: Vec<String>,
    /// Names of records that are numbers.
    records: Vec<String>,
    /// Names of regions.
    regions: Vec<String>,
    /// Names of tables.
    tables: Vec<String>,
    /// Names of behaviours that take no arguments.
    behaviors: Vec<String>,
    /// Names of formations.
    formations: Vec<String>,
}

/// The context of an expression, which decides what it may contain.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum View {
    /// Before the match: places and draws.
    Start,
    /// In the world's frame: endings and records.
    World,
    /// In the own frame: rewards.
    Own,
    /// In a behaviour.
    Behavior,
    /// In an observation.
    Observed,
    /// Without memory: inside a temporal function, or of a loop's player.
    Inner { own: bool },
}

impl View {
    /// Whether `me`, `us` and `them` have a meaning.
    fn is_own(self) -> bool {
        matches!(self, View::Own | View::Behavior | View::Observed | View::Inner { own: true })
    }

    /// Whether the match is judged: records are read, and sums over the episode.
    fn judges(self) -> bool {
        matches!(self, View::World | View::Own)
    }

    /// Whether temporal functions are allowed.
    fn knows_time(self) -> bool {
        matches!(self, View::World | View::Own | View::Behavior)
    }
}

/// Generates the text of a scenario from choices.
pub fn scenario(choices: &mut Choices<'_>) -> String {
    let mut writer = Writer {
        choices,
        out: String::new(),
        squads: Default::default(),
        numbers: vec![],
        records: vec![],
        regions: vec![],
        tables: vec![],
        behaviors: vec![],
        formations: vec![],
    };
    writer.file();
    writer.out
}

impl Writer<'_, '_> {
    fn file(&mut self) {
        // The roster comes first, because everything may name a player of it.
        let sizes = [self.choices.below(12), self.choices.below(12)];
        for (side, letter) in ["p", "q"].into_iter().enumerate() {
            self.squads[side] = (0..sizes[side]).map(|n| format!("{letter}{n}")).collect();
        }
        for n in 0..self.choices.below(3) {
            let shape = self.shape();
            self.line(&format!("region area{n} = {shape}"));
            self.regions.push(format!("area{n}"));
        }
        for n in 0..self.choices.below(3) {
            self.table(n);
        }
        if self.choices.rarely(3) {
            for n in 0..=self.choices.below(2) {
                self.formation(n);
            }
        }
        let squads = std::mem::take(&mut self.squads);
        for n in 0..self.choices.below(3) {
            self.behavior(n);
        }
        self.squads = squads;
        let academy = self.choices.rarely(3);
        self.line(&format!("scenario fuzzed{} {{", if academy { " extends academy" } else { "" }));
        if self.choices.rarely(6) {
            let mirror = self.choices.one(&["flanks", "ends"]);
            self.line(&format!("mirror: {mirror}"));
        }
        self.parameters();
        self.rules();
        if self.choices.rarely(3) {
            self.world();
        }
        if self.choices.rarely(6) {
            self.pitch();
        }
        if self.choices.rarely(6) {
            let (one, other) = (self.shape(), self.shape());
            self.line(&format!("let zone = choice({one}, {other})"));
            self.regions.push("zone".to_owned());
        }
        self.start();
        self.teams();
        self.agents();
        if self.choices.rarely(6) {
            self.substitution();
        }
        for n in 0..self.choices.below(4) {
            self.record(n);
        }
        for n in 0..self.choices.below(3) {
            self.reward(n);
        }
        for n in 0..self.choices.below(4) {
            self.ending(n);
        }
        if self.choices.rarely(3) {
            self.observation();
        }
        self.line("end limit 100 steps");
        self.line("}");
        if self.choices.rarely(8) {
            let params = self.numbers.iter().filter(|name| name.starts_with('k'));
            let params: Vec<&str> = params.map(String::as_str).collect();
            let text = levels::text(self.choices, "fuzzed", &params);
            self.line(&text);
        }
    }

    fn line(&mut self, text: &str) {
        let _ = writeln!(self.out, "{text}");
    }

    fn parameters(&mut self) {
        for n in 0..self.choices.below(3) {
            let value = self.choices.between(0.0, 1.0);
            self.line(&format!("param k{n}: number = {value:.2} in 0..1"));
            self.numbers.push(format!("k{n}"));
        }
        for n in 0..self.choices.below(4) {
            let value = match self.choices.below(6) {
                0 => "uniform(-1, 1)".to_owned(),
                1 => "normal(0, 0.5)".to_owned(),
                2 => "truncated_normal(0, 1, -1, 1)".to_owned(),
                3 => "integer(-3, 3)".to_owned(),
                4 => "choice(0.1: 3, 0.5: 1, -0.2: 2)".to_owned(),
                _ => "alternate(-0.5, 0.5)".to_owned(),
            };
            self.line(&format!("let d{n} = {value}"));
            self.numbers.push(format!("d{n}"));
        }
    }

    fn rules(&mut self) {
        const SWITCHES: &[&str] = &[
            "offside",
            "fouls",
            "cards",
            "penalties",
            "kickoff_circle",
            "back_pass",
            "fatigue",
            "stochastic",
            "assist",
            "anti_stalling",
            "grf_keeper",
        ];
        let mut rules: Vec<String> = Vec::new();
        for _ in 0..self.choices.below(5) {
            let (rule, switch) = (self.choices.one(SWITCHES), self.choices.one(&["off", "on"]));
            if !rules.iter().any(|other| other.starts_with(rule)) {
                rules.push(format!("{rule}: {switch}"));
            }
        }
        if self.choices.rarely(4) {
            let steps = 1 + self.choices.below(60);
            rules.push(format!("half_time: {steps} steps"));
        }
        if self.choices.rarely(8) {
            rules.push("physics: full".to_owned());
        }
        self.line(&format!("rules {{ {} }}", rules.join(", ")));
    }

    fn world(&mut self) {
        const KEYS: &[(&str, f64, f64)] = &[
            ("gravity", 1.0, 30.0),
            ("drag", 0.2, 5.0),
            ("swerve", 0.0, 3.0),
            ("spin_decay", 0.01, 1.0),
            ("bounce", 0.0, 0.95),
            ("friction", 0.1, 5.0),
        ];
        let mut options: Vec<String> = Vec::new();
        for &(key, low, high) in KEYS {
            match self.choices.below(4) {
                0 | 1 => {}
                2 => options.push(format!("{key}: {:.2}", self.choices.between(low, high))),
                _ => options.push(format!("{key}: uniform({low}, {high})")),
            }
        }
        let (x, y) = (self.choices.between(-14.0, 14.0), self.choices.between(-14.0, 14.0));
        options.push(match self.choices.below(3) {
            0 => format!("wind: ({x:.1}m/s, {y:.1}m/s)"),
            1 => "wind: polar(uniform(0m/s, 20m/s), uniform(0deg, 360deg))".to_owned(),
            _ => format!("wind: (uniform(-14m/s, 14m/s), {y:.1}m/s)"),
        });
        self.line(&format!("world {{ {} }}", options.join(", ")));
    }

    /// A longer or wider pitch with other goals and boxes. It isn't much smaller: players stand
    /// where they would on the usual one.
    fn pitch(&mut self) {
        const KEYS: &[(&str, f64, f64)] = &[
            ("length", 110.0, 120.0),
            ("width", 72.0, 90.0),
            ("goal", 1.0, 10.0),
            ("goal_height", 1.0, 3.0),
            ("box", 2.0, 40.0),
            ("box_width", 4.0, 72.0),
        ];
        let mut options: Vec<String> = Vec::new();
        for &(key, low, high) in KEYS {
            match self.choices.below(4) {
                0 | 1 => {}
                2 => options.push(format!("{key}: {:.1}m", self.choices.between(low, high))),
                _ => options.push(format!("{key}: uniform({low}m, {high}m)")),
            }
        }
        self.line(&format!("pitch {{ {} }}", options.join(", ")));
    }

    fn table(&mut self, n: usize) {
        let (columns, rows) = (1 + self.choices.below(5), 1 + self.choices.below(4));
        let mut row = || {
            let numbers = (0..columns).map(|_| format!("{:.2}", self.choices.between(-1.0, 1.0)));
            format!("[{}]", numbers.collect::<Vec<_>>().join(", "))
        };
        let rows: Vec<String> = (0..rows).map(|_| row()).collect();
        let over = self.choices.one(&["", " over pitch", " over right.half", " over left.box"]);
        self.line(&format!("table t{n}{over} = [{}]", rows.join(", ")));
        self.tables.push(format!("t{n}"));
    }

    fn agents(&mut self) {
        let mut sides = Vec::new();
        for (side, name) in ["left", "right"].into_iter().enumerate() {
            let n = self.squads[side].len();
            let who = match self.choices.below(5) {
                0 => usize::from(side == 0).min(n).to_string(),
                1 => "all".to_owned(),
                2 if n > 0 => {
                    format!("[{}]", self.squads[side][..=self.choices.below(n)].join(", "))
                }
                3 => self.choices.below(n + 1).to_string(),
                _ => "0".to_owned(),
            };
            sides.push(format!("{name}: {who}"));
        }
        if self.choices.rarely(4) {
            sides.push("others: hold".to_owned());
        }
        if self.choices.rarely(4) {
            sides.push("switching: fixed".to_owned());
        }
        self.line(&format!("agents {{ {} }}", sides.join(", ")));
    }
}
