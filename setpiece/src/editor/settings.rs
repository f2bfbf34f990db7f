//! What an option may be set to.

use super::Analysis;
use super::completion::{Completion, word, words_of};
use super::cursor::last_word;
use super::words::WordKind;
use crate::scenario::vocabulary::Rule;

/// A word that an option may be set to, and what it means.
type SettingWord = (&'static str, &'static str);

const SWITCH: &[SettingWord] = &[("on", "it holds"), ("off", "it doesn't hold")];

/// What may stand behind the key of an option.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Settings {
    /// These words alone.
    Words(&'static [SettingWord]),
    /// These words, or a value of the text.
    WordsOrOwn(&'static [SettingWord]),
    /// These words, an act or a behaviour.
    WordsOrActs(&'static [SettingWord]),
    /// A number.
    Number,
    /// The name of a formation.
    Formation,
    /// These words, or a player.
    WordsOrPlayers(&'static [SettingWord]),
    /// These words, or a list of players.
    WordsOrList(&'static [SettingWord]),
}

/// What the option of a block may be set to, if it isn't any value.
///
/// - `block`: the word that begins the block, `agents`; `player` for a player's braces.
fn settings(block: &str, key: &str) -> Option<Settings> {
    Some(match (block, key) {
        ("scenario", "mirror") => Settings::Words(&[
            ("none", "as it is written, without an inherited mirror"),
            ("flanks", "the top and the bottom of the picture are swapped"),
            ("ends", "the pitch is turned by 180°"),
        ]),
        ("agents", "left" | "right") => Settings::WordsOrList(&[("all", "every player")]),
        ("agents", "others") => Settings::Words(&[
            ("bot", "the game's own player"),
            ("hold", "they stand where they are"),
        ]),
        ("agents", "switching") => Settings::Words(&[
            ("auto", "a count of agents follows the ball"),
            ("fixed", "agents keep their players"),
        ]),
        ("player", "ai") => Settings::WordsOrActs(&[
            ("bot", "the game's own player"),
            ("hold", "stands where they are"),
            ("lazy", "stands still and doesn't play the ball"),
        ]),
        ("player", "controllable") => Settings::WordsOrOwn(SWITCH),
        ("player", "overlap") => {
            Settings::Words(&[("allowed", "another player may stand on the same spot")])
        }
        ("team" | "player" | "substitute", "difficulty")
        | ("player" | "substitute", "fatigue")
        | ("player", "yellow_cards")
        | ("stats" | "world" | "pitch", _)
        | ("start", "elapsed") => Settings::Number,
        ("start", "score") => {
            Settings::Words(&[("[0, 0]", "goals of the left and the right team")])
        }
        ("kickoff", "kicking" | "receiving") => Settings::Formation,
        ("ball", "owner") => Settings::WordsOrPlayers(&[]),
        ("rules", key) => match Rule::from_name(key)? {
            Rule::Physics => Settings::Words(&[
                ("gated", "rapier resolves contacts"),
                ("full", "rapier runs on every tick"),
            ]),
            Rule::HalfTime => Settings::WordsOrOwn(&[("off", "there is none")]),
            _ => Settings::WordsOrOwn(SWITCH),
        },
        _ => return None,
    })
}

impl Analysis {
    /// What may stand behind `KEY:` in a block; none if it is any value, or another text.
    pub(super) fn settings(&self, block: &str, text: &str) -> Option<Vec<Completion>> {
        let found = settings(block, last_word(key_of(text)?))?;
        let (words, further): (_, Vec<Completion>) = match found {
            Settings::Words(words) => (words, Vec::new()),
            Settings::WordsOrOwn(words) => {
                let values = self.own_names().into_iter().filter(|it| it.detail != "a player");
                (words, values.collect())
            }
            Settings::Number => (&[][..], self.numbers()),
            Settings::Formation => (&[][..], self.after("formation")),
            Settings::WordsOrActs(words) => {
                // `wait` says for how long, in a behaviour.
                let acts = words_of(&[WordKind::Act]).filter(|it| it.text != "wait");
                (words, acts.chain(self.after("behavior")).collect())
            }
            Settings::WordsOrPlayers(words) => (words, self.players()),
            Settings::WordsOrList(words) => {
                let list = |it: Completion| Completion { text: format!("[{}]", it.text), ..it };
                (words, self.players().into_iter().map(list).collect())
            }
        };
        let own: Vec<Completion> =
            words.iter().map(|&(name, doc)| word(name, doc, "setting")).collect();
        let is_new = |it: &Completion| !own.iter().any(|other| other.text == it.text);
        let further: Vec<Completion> = further.into_iter().filter(is_new).collect();
        Some(own.into_iter().chain(further).collect())
    }

    /// What may be a value that no moment of the match decides.
    pub(super) fn numbers(&self) -> Vec<Completion> {
        let values = self.own_names().into_iter().filter(|it| it.detail != "a player");
        values.chain(words_of(&[WordKind::Function])).collect()
    }

    /// The players that have a name.
    pub(super) fn players(&self) -> Vec<Completion> {
        self.own_names().into_iter().filter(|it| it.detail == "a player").collect()
    }
}

/// The end of a text up to the key whose value is written next: of `ai: `, and of each part of
/// `ai: if chasing then press else `.
fn key_of(text: &str) -> Option<&str> {
    let text = text.trim_end();
    let is_part = matches!(last_word(text), "then" | "else");
    let value = text.rfind([',', '{', '\n']).map_or(0, |at| at + 1);
    let value = text.get(value..)?;
    let end = if is_part { value.split_once(':')?.0 } else { text.strip_suffix(':')? };
    Some(end.trim_end())
}
