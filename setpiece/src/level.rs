//! Levels: what decides an episode's start and chance.

mod values;

use crate::Error;
use crate::error::LevelFault;
use serde::{Deserialize, Serialize};
use setpiece_scenario::{Bindings, Scenario};
use std::collections::BTreeMap;

/// A level: a scenario's name, the parameters that differ from their defaults, a seed and an index
/// under it.
///
/// As text `academy_corner{difficulty=0.8}#1234`, with `:5` behind it for the index 5.
#[derive(Clone, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Level {
    /// The scenario: a name of the library, or a file.
    pub scenario: String,
    /// The fingerprint of the compiled scenario, if it is known: 16 hexadecimal digits.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub digest: Option<String>,
    /// Values as the language writes them, by name.
    #[serde(
        default,
        skip_serializing_if = "BTreeMap::is_empty",
        deserialize_with = "values::deserialize"
    )]
    pub params: BTreeMap<String, String>,
    /// The seed.
    pub seed: u64,
    /// The episode's index under the seed.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub episode: u64,
}

#[allow(clippy::trivially_copy_pass_by_ref, reason = "serde asks for it like this")]
fn is_zero(index: &u64) -> bool {
    *index == 0
}

impl Level {
    /// The level of an episode.
    pub fn of(scenario: &Scenario, bindings: &Bindings, seed: u64, episode: u64) -> Level {
        let values = scenario.params.iter().zip(&bindings.0);
        let changed = values.filter(|(param, value)| **value != param.default);
        Level {
            scenario: scenario.name.clone(),
            digest: setpiece_scenario::file::digest(scenario)
                .ok()
                .map(|digest| format!("{digest:016x}")),
            params: changed
                .map(|(param, value)| (param.name.clone(), param.write(*value)))
                .collect(),
            seed,
            episode,
        }
    }

    /// Reads `NAME{param=value,…}#SEED[:INDEX]`, or a level's JSON.
    ///
    /// # Errors
    /// What is wrong with it, in words.
    pub fn read(text: &str) -> Result<Level, String> {
        let text = text.trim();
        if text.starts_with('{') {
            return serde_json::from_str(text).map_err(|why| why.to_string());
        }
        let unlike = || "write it as NAME{param=value}#SEED:EPISODE".to_owned();
        let (head, key) = text.rsplit_once('#').ok_or_else(unlike)?;
        let (seed, episode) = key.split_once(':').unwrap_or((key, "0"));
        let (scenario, params) = match head.strip_suffix('}') {
            Some(head) => head.split_once('{').ok_or_else(unlike)?,
            None => (head, ""),
        };
        if scenario.is_empty() || scenario.contains(['{', '}']) {
            return Err(unlike());
        }
        let number = |what: &str, digits: &str| -> Result<u64, String> {
            let most = u64::MAX;
            digits.parse().map_err(|_| format!("the {what} `{digits}` is no number in 0..{most}"))
        };
        Ok(Level {
            scenario: scenario.to_owned(),
            digest: None,
            params: values::read(params).ok_or_else(unlike)??,
            seed: number("seed", seed)?,
            episode: number("episode", episode)?,
        })
    }

    /// Refuses a scenario of another name.
    ///
    /// # Errors
    /// [`Error::Level`].
    pub fn check_name(&self, scenario: &Scenario) -> Result<(), Error> {
        if self.scenario == scenario.name {
            return Ok(());
        }
        Err(self.fault(LevelFault::Name { found: scenario.name.clone() }))
    }

    /// The error of this level.
    pub(crate) fn fault(&self, why: LevelFault) -> Error {
        Error::Level { level: self.to_string(), why }
    }

    /// The values of a scenario's parameters in this level.
    ///
    /// # Errors
    /// [`Error::Param`] if the scenario has no such parameter or a value isn't allowed,
    /// [`Error::Level`] if the scenario isn't the one that the level was taken of.
    pub fn bind(&self, scenario: &Scenario) -> Result<Bindings, Error> {
        let digest = setpiece_scenario::file::digest(scenario).ok();
        let found = digest.map(|digest| format!("{digest:016x}"));
        if self.digest.is_some() && self.digest != found {
            return Err(self.fault(LevelFault::Version));
        }
        let pairs = self.params.iter().map(|(name, value)| (name.as_str(), value.as_str()));
        crate::bind(scenario, pairs)
    }
}

impl std::fmt::Display for Level {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.scenario)?;
        if !self.params.is_empty() {
            let pairs: Vec<String> =
                self.params.iter().map(|(name, value)| values::written(name, value)).collect();
            write!(f, "{{{}}}", pairs.join(","))?;
        }
        write!(f, "#{}", self.seed)?;
        if self.episode > 0 {
            write!(f, ":{}", self.episode)?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_level_is_what_its_text_says() {
        for text in [
            "academy_corner#0",
            "academy_corner{difficulty=0.8}#1234",
            "drills/corner.pitch{gap=12m,side=left}#7:3",
            r#"a{k="",mode="a,k=3",said="\"}#1"}#18446744073709551615"#,
        ] {
            let level = Level::read(text).unwrap();
            assert_eq!(level.to_string(), text);
            let line = serde_json::to_string(&level).unwrap();
            assert_eq!(serde_json::from_str::<Level>(&line).unwrap(), level);
        }
        let json = r#"{"scenario":"a","seed":3,"params":{"b":0.5,"c":true,"d":"1m"}}"#;
        assert_eq!(Level::read(json), Level::read("a{b=0.5,c=on,d=1m}#3\n"));
        for (text, why) in [
            ("{\"scenario\":\"a\"}", "seed"),
            ("academy_corner", "#SEED"),
            ("a{b}#1", "#SEED"),
            ("a{b=1#1", "#SEED"),
            ("a{b=\"1}#1", "#SEED"),
            ("a{b=1,b=2}#1", "`b` twice"),
            ("a#", "the seed ``"),
            ("a#1:x", "the episode `x`"),
            ("a#-1", "the seed `-1`"),
        ] {
            assert!(Level::read(text).unwrap_err().contains(why), "{text}");
        }
    }

    #[test]
    fn a_level_of_an_episode_binds_what_was_bound() {
        let scenario = crate::load("academy_corner").unwrap().scenario;
        let mut bindings = Bindings::defaults(&scenario.params);
        bindings.set_text(&scenario.params, "difficulty", "0.25").unwrap();
        let level = Level::of(&scenario, &bindings, 9, 2);
        assert_eq!(level.to_string(), "academy_corner{difficulty=0.25}#9:2");
        assert_eq!(level.bind(&scenario).unwrap(), bindings);
        let other = crate::load("academy_empty_goal").unwrap().scenario;
        assert!(matches!(level.bind(&other), Err(Error::Level { .. })));
    }
}
