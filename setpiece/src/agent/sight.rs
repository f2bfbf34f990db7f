//! What a policy sees: the observation that fits the input of its network.

use super::policy::NetworkPolicy;
use crate::error::{Error, PolicyFault};
use crate::onnx::Tensor;
use crate::pixels::PixelEye;
use setpiece_engine::environment::Environment;
use setpiece_engine::observe::{Floats, ObserveError, SMM_HEIGHT, SMM_WIDTH, smm, smm_size};
use setpiece_render::Pixels;

/// Planes of a map.
const PLANES: usize = 4;
/// The longest side of a map or a picture.
const SIDE_MAX: usize = 1_024;
/// The most observations that are seen at once.
const STACK_MAX: usize = 64;

/// An observation, how many of the latest are seen at once, and as what numbers.
#[derive(Clone, Debug)]
pub struct PolicySight {
    kind: SightKind,
    /// The shape of all that is seen at once; the latest are stacked on the last axis.
    shape: Vec<usize>,
    stack: usize,
    /// Whether the network wants floats.
    is_float: bool,
}

/// The kind of an observation.
#[derive(Clone, Copy, Debug, PartialEq)]
enum SightKind {
    Floats(Floats),
    /// A super mini map.
    Map {
        width: usize,
        height: usize,
    },
    Picture(Pixels),
}

/// The observations of floats by name, in the order in which they are tried.
const FLOATS: [(&str, Floats); 5] = [
    ("simple115v2", Floats::Simple115v2),
    ("simple115v2+sticky", Floats::Simple115v2Sticky),
    ("vector", Floats::Vector),
    ("egocentric", Floats::Egocentric),
    ("simple115", Floats::Simple115),
];

impl PolicySight {
    /// Finds what a policy sees of a scenario: what its file says, else the first observation that
    /// has as many numbers as its network takes.
    ///
    /// # Errors
    /// [`Error::Policy`] if none has.
    pub(super) fn of(
        policy: &NetworkPolicy,
        environment: &Environment,
    ) -> Result<PolicySight, Error> {
        let named = policy.metadata("observation");
        let is_scaled = policy.metadata("scale").is_some_and(|said| said == "true");
        let input = policy.input();
        let axes = input.and_then(|input| input.shape.split_first()).map(|(_, axes)| axes);
        let axes = axes.unwrap_or_default();
        let found = match axes {
            [length] => floats(*length, named, is_scaled, environment),
            [height, width, channels] => picture([*height, *width], *channels, named),
            _ => None,
        };
        let is_float = input.is_some_and(|input| input.element.is_float());
        found.map(|(kind, shape, stack)| PolicySight { kind, shape, stack, is_float }).ok_or_else(
            || {
                policy.fault(PolicyFault::Observation {
                    axes: axes.to_vec(),
                    named: named.map(str::to_owned),
                    scenario: environment.scenario().name.clone(),
                    known: known(environment),
                })
            },
        )
    }

    /// What a network is tried out with.
    pub(super) fn filled(&self, number: f32) -> Tensor {
        self.tensor(&vec![number; self.shape.iter().product()])
    }

    /// What a network is given: numbers with a batch axis in front.
    fn tensor(&self, numbers: &[f32]) -> Tensor {
        let shape = [&[1], &self.shape[..]].concat();
        if self.is_float {
            return Tensor::floats(shape, numbers.to_vec());
        }
        Tensor::integers(shape, numbers.iter().map(|&it| it as i64).collect())
    }
}

/// A kind, the shape of what is seen at once, and how many observations that is.
type Found = (SightKind, Vec<usize>, usize);

/// The observation of floats that has a length, or that is named and a part of the length.
fn floats(
    length: Option<usize>,
    named: Option<&str>,
    is_scaled: bool,
    environment: &Environment,
) -> Option<Found> {
    let candidates = || {
        let of_name = FLOATS.iter().filter(|(name, _)| named.is_none_or(|named| *name == named));
        of_name.filter_map(|(_, floats)| {
            let floats = if is_scaled { floats.scaled()? } else { *floats };
            let one = environment.layout(floats).len();
            (one > 0).then_some((floats, one))
        })
    };
    let once = |&(_, one): &(Floats, usize)| length.is_none_or(|length| length == one);
    let (floats, one) = candidates().find(once).or_else(|| {
        candidates().find(|(_, one)| length.is_some_and(|length| length.is_multiple_of(*one)))
    })?;
    let stack = length.map_or(1, |length| length / one);
    let fits = (1..=STACK_MAX).contains(&stack);
    fits.then(|| (SightKind::Floats(floats), vec![one * stack], stack))
}

/// The map or picture that has a shape.
fn picture(
    [height, width]: [Option<usize>; 2],
    channels: Option<usize>,
    named: Option<&str>,
) -> Option<Found> {
    let (height, width) = (height.unwrap_or(SMM_HEIGHT), width.unwrap_or(SMM_WIDTH));
    let map = SightKind::Map { width, height };
    let pixels = |gray| SightKind::Picture(Pixels { height, width, gray });
    let (kind, planes) = match (named, channels) {
        (Some("smm"), _) => (map, PLANES),
        (None, Some(n)) if n.is_multiple_of(PLANES) => (map, PLANES),
        (Some("pixels"), _) | (None, Some(3)) => (pixels(false), 3),
        (Some("pixels_gray"), _) | (None, Some(1)) => (pixels(true), 1),
        _ => return None,
    };
    let channels = channels.unwrap_or(planes);
    let stack = channels / planes;
    let is_drawable = match kind {
        SightKind::Picture(pixels) => PixelEye::new(pixels).is_ok(),
        _ => true,
    };
    let sides = 1..=SIDE_MAX;
    let fits = channels.is_multiple_of(planes)
        && (1..=STACK_MAX).contains(&stack)
        && sides.contains(&height)
        && sides.contains(&width);
    (fits && is_drawable).then(|| (kind, vec![height, width, channels], stack))
}

/// The observations of a scenario and how many numbers they have.
fn known(environment: &Environment) -> Vec<(&'static str, String)> {
    let floats = FLOATS.iter().map(|(name, floats)| (*name, environment.layout(*floats).len()));
    let floats = floats.filter(|(_, length)| *length > 0);
    let floats = floats.map(|(name, length)| (name, length.to_string()));
    floats.chain([("smm", format!("{SMM_HEIGHT} × {SMM_WIDTH} × {PLANES}"))]).collect()
}

/// The latest observations of an agent, the oldest first.
#[derive(Debug, Default)]
pub(super) struct Seen {
    stacked: Vec<f32>,
}

/// Writes what agents see. It keeps the memory that this needs.
#[derive(Debug, Default)]
pub(super) struct PolicyEye {
    /// A copy of the match, because looking at one may move its scratch memory.
    looked: Option<Environment>,
    /// The seed, the episode and the step of the copy.
    moment: Option<(u64, u64, u32)>,
    pixels: Option<PixelEye>,
    floats: Vec<f32>,
    bytes: Vec<u8>,
}

impl PolicyEye {
    /// Forgets the match before.
    pub(super) fn begin(&mut self) {
        self.moment = None;
    }

    /// Appends what an agent sees now to what they saw; `first`: in this episode.
    pub(super) fn look(
        &mut self,
        sight: &PolicySight,
        environment: &Environment,
        agent: usize,
        (seen, first): (&mut Seen, bool),
    ) -> Result<(), ObserveError> {
        match sight.kind {
            SightKind::Floats(floats) => {
                let moment = (environment.seed(), environment.index(), environment.steps());
                if self.moment != Some(moment) {
                    self.moment = Some(moment);
                    match &mut self.looked {
                        Some(looked) => looked.clone_from(environment),
                        none => *none = Some(environment.clone()),
                    }
                }
                self.floats.resize(sight.shape.iter().product::<usize>() / sight.stack, 0.0);
                if let Some(looked) = &mut self.looked {
                    looked.observe(floats, agent, &mut self.floats)?;
                }
            }
            SightKind::Map { width, height } => {
                self.bytes.resize(smm_size(width, height), 0);
                smm(environment.state(), agent, width, height, &mut self.bytes)?;
                self.floats.clear();
                self.floats.extend(self.bytes.iter().map(|&byte| f32::from(byte)));
            }
            SightKind::Picture(pixels) => {
                self.bytes.resize(pixels.len(), 0);
                if self.pixels.is_none() {
                    self.pixels = PixelEye::new(pixels).ok();
                }
                if let Some(eye) = &mut self.pixels {
                    eye.write(environment, agent, &mut self.bytes)?;
                }
                self.floats.clear();
                self.floats.extend(self.bytes.iter().map(|&byte| f32::from(byte)));
            }
        }
        seen.push(sight, &self.floats, first);
        Ok(())
    }
}

impl Seen {
    /// The first observation of an episode fills all places.
    fn push(&mut self, sight: &PolicySight, latest: &[f32], first: bool) {
        let depth = sight.stack;
        let row = sight.shape.last().copied().unwrap_or(1).max(1);
        let planes = row / depth;
        self.stacked.resize(latest.len() * depth, 0.0);
        for (pixel, fresh) in self.stacked.chunks_exact_mut(row).zip(latest.chunks_exact(planes)) {
            pixel.copy_within(planes.., 0);
            let written = if first { 0 } else { row - planes };
            for place in pixel[written..].chunks_exact_mut(planes) {
                place.copy_from_slice(fresh);
            }
        }
    }

    /// As a network is given it.
    pub(super) fn tensor(&self, sight: &PolicySight) -> Tensor {
        sight.tensor(&self.stacked)
    }
}

impl PolicySight {
    /// Whether every step has to be seen, not only those with a decision.
    pub(super) fn is_stacked(&self) -> bool {
        self.stack > 1
    }
}
