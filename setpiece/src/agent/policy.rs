//! Policies from ONNX files: from an observation, and perhaps masks, to the logits of the actions.

use super::sight::PolicySight;
use crate::error::{Error, PolicyFault};
use crate::files::read_file;
use crate::onnx::{Network, NetworkFault, NetworkInput, Numbers, Tensor};
use setpiece_scenario::Action;
use std::path::{Path, PathBuf};

/// Largest policy, bytes.
pub const POLICY_MAX_BYTES: u64 = 64 << 20;
/// The name of a network's input for masks.
const MASK: &str = "mask";
/// How many actions a policy may rate: GRF's default set, and with the one that asks the bot.
const ACTION_COUNTS: [usize; 2] = [Action::DEFAULT_SET, Action::V2_SET];
/// The most steps that a decision lasts.
const REPEAT_MAX: u32 = 1_000;

/// A policy from a file.
#[derive(Debug)]
pub struct NetworkPolicy {
    path: PathBuf,
    network: Network,
    /// Which input sees the observation.
    observation: usize,
    /// How many masks the input for them takes, if the network has one.
    masks: Option<usize>,
    /// How many steps a decision lasts.
    repeat: u32,
}

impl NetworkPolicy {
    /// Reads a policy.
    ///
    /// # Errors
    /// [`Error::File`] if the file can't be read, [`Error::Policy`] if it is no policy.
    pub fn from_file(path: &Path) -> Result<NetworkPolicy, Error> {
        NetworkPolicy::from_bytes(path, &read_file(path, POLICY_MAX_BYTES)?)
    }

    /// Reads a policy that comes from `path`.
    ///
    /// # Errors
    /// [`Error::Policy`] if it is none.
    pub fn from_bytes(path: &Path, bytes: &[u8]) -> Result<NetworkPolicy, Error> {
        let fault = |why| Error::Policy { path: path.to_owned(), why };
        let network = Network::from_bytes(bytes).map_err(|why| fault(why.into()))?;
        let inputs = network.inputs();
        let (masks, shown): (Vec<_>, Vec<_>) =
            (0..inputs.len()).partition(|&at| inputs.get(at).and_then(masks_of).is_some());
        let (&[observation], [] | [_]) = (&shown[..], &masks[..]) else {
            let found = inputs.iter().map(|input| input.name.clone()).collect();
            return Err(fault(PolicyFault::Inputs { found }));
        };
        let said = network.metadata("repeat").unwrap_or("1");
        let repeat = said.parse().ok().filter(|repeat| (1..=REPEAT_MAX).contains(repeat));
        let repeat = repeat.ok_or_else(|| fault(PolicyFault::Repeat { said: said.to_owned() }))?;
        let masks = masks.first().and_then(|&at| inputs.get(at)).and_then(masks_of);
        Ok(NetworkPolicy { path: path.to_owned(), network, observation, masks, repeat })
    }

    /// How many steps a decision lasts.
    pub fn repeat(&self) -> u32 {
        self.repeat
    }

    /// Whether it sees masks.
    pub(super) fn sees_masks(&self) -> bool {
        self.masks.is_some()
    }

    /// The input that sees the observation.
    pub(super) fn input(&self) -> Option<&NetworkInput> {
        self.network.inputs().get(self.observation)
    }

    /// What its author says of it.
    pub(super) fn metadata(&self, key: &str) -> Option<&str> {
        self.network.metadata(key)
    }

    /// An error about it.
    pub(super) fn fault(&self, why: PolicyFault) -> Error {
        Error::Policy { path: self.path.clone(), why }
    }

    /// Computes it once, so that it can't fail later.
    ///
    /// # Errors
    /// [`Error::Policy`] if it can't be computed, or returns something else than logits.
    pub(super) fn try_out(&self, sight: &PolicySight) -> Result<(), Error> {
        let mask = [true; Action::FULL_SET];
        // What is undefined for one observation may not be for another.
        for number in [0.0, 0.5] {
            let seen = sight.filled(number);
            let logits = self.logits(seen, &mask).map_err(|why| self.fault(why.into()))?;
            let is_row = matches!(logits.shape[..], [1, n] if ACTION_COUNTS.contains(&n));
            match logits.numbers {
                Numbers::Floats(numbers) if is_row => {
                    if !numbers.iter().any(|number| number.is_nan()) {
                        return Ok(());
                    }
                }
                _ => return Err(self.fault(PolicyFault::Actions { found: logits.shape })),
            }
        }
        Err(self.fault(PolicyFault::NotNumbers))
    }

    /// The action of the greatest logit, the first of equal ones.
    pub(super) fn decide(&self, seen: Tensor, mask: &[bool; Action::FULL_SET]) -> Action {
        // It has been tried out.
        let Ok(Tensor { numbers: Numbers::Floats(logits), .. }) = self.logits(seen, mask) else {
            return Action::Idle;
        };
        Action::from_index(greatest(&logits)).unwrap_or(Action::Idle)
    }

    fn logits(
        &self,
        seen: Tensor,
        mask: &[bool; Action::FULL_SET],
    ) -> Result<Tensor, NetworkFault> {
        let Some(n) = self.masks else { return self.network.run(vec![seen]) };
        let open = mask.iter().take(n).copied();
        let is_float = |input: &NetworkInput| input.element.is_float();
        let other = self.network.inputs().get(1 - self.observation);
        let shown = if other.is_some_and(is_float) {
            Tensor::floats([1, n], open.map(|open| f32::from(u8::from(open))).collect())
        } else {
            Tensor::integers([1, n], open.map(i64::from).collect())
        };
        let both = if self.observation == 0 { vec![seen, shown] } else { vec![shown, seen] };
        self.network.run(both)
    }
}

/// How many masks an input takes, if it is the one for masks.
fn masks_of(input: &NetworkInput) -> Option<usize> {
    match input.shape[..] {
        [_, Some(n)] if input.name == MASK && ACTION_COUNTS.contains(&n) => Some(n),
        _ => None,
    }
}

/// The place of the greatest number, as `numpy.argmax` finds it: the first of equal ones, and
/// what isn't a number before all others.
fn greatest(numbers: &[f32]) -> usize {
    let mut best = (0, f32::NEG_INFINITY);
    for (at, &number) in numbers.iter().enumerate() {
        if number.is_nan() {
            return at;
        }
        if number > best.1 {
            best = (at, number);
        }
    }
    best.0
}

#[cfg(test)]
mod tests {
    use super::greatest;

    #[test]
    fn the_first_of_the_greatest_logits_wins() {
        assert_eq!(greatest(&[1.0, 3.0, 3.0, -1.0]), 1);
        assert_eq!(greatest(&[f32::NEG_INFINITY; 3]), 0);
        assert_eq!(greatest(&[1.0, f32::NAN, 3.0]), 1);
    }
}
