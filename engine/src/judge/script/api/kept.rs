//! Encodes what a script keeps in its memory as plain data, for snapshots.
//!
//! A value becomes a flat list of nodes, parts before wholes, so that no list however wild is read
//! by recursion. What a hook was shown (`this.last = now`) leads to its scene; scenes stand on a
//! [`Shelf`] of their own, each once, so that what was one is one again. The shelf is handed along
//! beside the archive of an episode.

use super::convert::type_words;
use super::{Ctx, Point, SeenBall, SeenEvent, SeenPlayer, SeenScore, SeenTeam, ShownState, Vector};
use super::{EpisodeNames, HookScene, Perspective, SeenRegion, SeenTable};
use crate::judge::script::host::MEMORIES_BYTES_MAX;
use crate::judge::script::limits::{EXPRESSION_DEPTH_MAX, MAP_MAX};
use crate::judge::script::{Memory, host};
use crate::judge::view::MatchView;
use crate::random::Stream;
use crate::snapshot::{Archive, SnapshotError, bounded};
use crate::state::PlayerId;
use crate::state::event::{EVENTS_MAX, Event};
use rhai::{Array, Dynamic, FnPtr, ImmutableString, Map};
use serde::{Deserialize, Serialize};
use setpiece_scenario::vocabulary::Team;
use std::ops::{Range, RangeInclusive};
use std::sync::Arc;

/// The scenes that memories refer to, each after those that its own parameters refer to.
#[derive(Debug, Default)]
pub(crate) struct Shelf {
    scenes: Vec<Arc<HookScene>>,
    kept: Vec<KeptScene>,
    /// The number of values read, over all memories.
    n_read: usize,
}

/// The most values of scripts' memories in a snapshot.
const NODES_MAX: usize = 1 << 20;

#[derive(Clone, Debug, Serialize, Deserialize)]
struct KeptScene {
    now: MatchView,
    prev: MatchView,
    #[serde(deserialize_with = "bounded::<_, _, EVENTS_MAX>")]
    events: Vec<Event>,
    #[serde(deserialize_with = "bounded::<_, _, NODES_MAX>")]
    params: Vec<KeptValue>,
    random: Stream,
    seed: u64,
    index: u64,
}

/// A value, or a collection of the values before it.
#[derive(Clone, Debug, Serialize, Deserialize)]
enum KeptValue {
    Nothing,
    Truth(bool),
    Whole(i64),
    Number(f64),
    Letter(char),
    Text(String),
    /// A list of this many values.
    List(u32),
    /// A map with as many values as it has names.
    Table(#[serde(deserialize_with = "bounded::<_, _, { MAP_MAX }>")] Vec<String>),
    Range(i64, i64),
    RangeThrough(i64, i64),
    Point([f64; 2], f64),
    Vector([f64; 2]),
    Shown(ShownKind, Eye),
}

/// The values of a memory.
#[derive(Default, Serialize, Deserialize)]
#[serde(transparent)]
struct KeptValues(#[serde(deserialize_with = "bounded::<_, _, NODES_MAX>")] Vec<KeptValue>);

/// A value that is shown to a hook.
#[derive(Clone, Debug, Serialize, Deserialize)]
enum ShownKind {
    State,
    Ctx,
    Ball,
    Player(PlayerId),
    Side(Team),
    Score,
    Event(Event),
    Region(u32),
    Table(u32),
}

/// The perspective and the scene.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct Eye {
    scene: u32,
    us: Team,
    me: Option<PlayerId>,
    agent: u32,
    script: u32,
    past: bool,
}

/// A value that can't be kept.
struct Unkept {
    place: String,
    what: String,
}

impl Memory {
    /// Writes or reads a script's memory.
    pub(crate) fn archive(
        &mut self,
        name: &str,
        archive: &mut Archive<'_>,
        shelf: &mut Shelf,
    ) -> Result<(), SnapshotError> {
        let mut nodes = KeptValues::default();
        if !archive.is_reading() {
            shelf.write(&self.this, &mut nodes.0).map_err(Unkept::within_this)?;
        }
        archive.value("begun", &mut self.begun)?;
        archive.value(name, &mut nodes)?;
        if archive.is_reading() {
            self.this = shelf.read(nodes.0).map_err(|why| SnapshotError::damaged(name, why))?;
            host::check_size(&self.this, MEMORIES_BYTES_MAX)
                .map_err(|why| SnapshotError::damaged(name, why))?;
        }
        Ok(())
    }
}

impl Shelf {
    /// Writes or reads where a scene stands.
    pub(crate) fn archive(
        &mut self,
        name: &str,
        scene: &mut Option<Arc<HookScene>>,
        archive: &mut Archive<'_>,
    ) -> Result<(), SnapshotError> {
        let mut at = scene
            .as_ref()
            .map(|scene| self.place(scene))
            .transpose()
            .map_err(Unkept::within_this)?;
        archive.value(name, &mut at)?;
        if archive.is_reading() {
            let found = |at| self.scene(at).map_err(|why| SnapshotError::damaged(name, why));
            *scene = at.map(found).transpose()?;
        }
        Ok(())
    }

    /// Writes or reads the scenes themselves. They come before the memories that refer to them.
    pub(crate) fn archive_scenes(
        &mut self,
        archive: &mut Archive<'_>,
    ) -> Result<(), SnapshotError> {
        archive.value("scenes", &mut self.kept)?;
        if archive.is_reading() {
            for (at, kept) in std::mem::take(&mut self.kept).into_iter().enumerate() {
                let scene = self
                    .stage(kept)
                    .map_err(|why| SnapshotError::damaged(format!("scenes[{at}]"), why))?;
                self.scenes.push(Arc::new(scene));
            }
        }
        Ok(())
    }

    /// Gives the scenes that were read the names of their episode.
    pub(crate) fn name(&self, names: &Arc<EpisodeNames>) {
        for scene in &self.scenes {
            scene.episode.get_or_init(|| names.clone());
        }
    }

    fn stage(&mut self, kept: KeptScene) -> Result<HookScene, String> {
        let params = self.read(kept.params)?.try_cast::<Map>().ok_or("has no parameters")?;
        let key = (kept.seed, kept.index);
        Ok(HookScene::new(kept.now, kept.prev, &kept.events, Arc::new(params), kept.random, key))
    }

    /// The index of a scene, which is added if it is new.
    fn place(&mut self, scene: &Arc<HookScene>) -> Result<u32, Unkept> {
        if let Some(at) = self.scenes.iter().position(|known| Arc::ptr_eq(known, scene)) {
            return Ok(at as u32);
        }
        let mut params = Vec::new();
        self.write_map(&scene.params, &mut params)?;
        self.kept.push(KeptScene {
            now: scene.now,
            prev: scene.prev,
            events: scene.events.clone(),
            params,
            random: scene.random(),
            seed: scene.seed,
            index: scene.index,
        });
        self.scenes.push(scene.clone());
        Ok(self.scenes.len() as u32 - 1)
    }

    fn scene(&self, at: u32) -> Result<Arc<HookScene>, String> {
        self.scenes
            .get(at as usize)
            .cloned()
            .ok_or_else(|| format!("leads to scene {at}, which is not there"))
    }

    /// Appends a value as nodes.
    fn write(&mut self, value: &Dynamic, nodes: &mut Vec<KeptValue>) -> Result<(), Unkept> {
        if nodes.len() >= NODES_MAX {
            return Err(Unkept {
                place: String::new(),
                what: format!("more than {NODES_MAX} values"),
            });
        }
        if let Some(map) = value.read_lock::<Map>() {
            return self.write_map(&map, nodes);
        }
        if let Some(list) = value.read_lock::<Array>() {
            for (at, part) in list.iter().enumerate() {
                self.write(part, nodes).map_err(|unkept| unkept.at(&format!("[{at}]")))?;
            }
            nodes.push(KeptValue::List(list.len() as u32));
            return Ok(());
        }
        let node = plain(value).map_or_else(|| self.shown(value), Ok)?;
        nodes.push(node);
        Ok(())
    }

    fn write_map(&mut self, map: &Map, nodes: &mut Vec<KeptValue>) -> Result<(), Unkept> {
        for (name, part) in map {
            self.write(part, nodes).map_err(|unkept| unkept.at(&format!(".{name}")))?;
        }
        nodes.push(KeptValue::Table(map.keys().map(ToString::to_string).collect()));
        Ok(())
    }

    /// Encodes a value that was shown to a hook.
    fn shown(&mut self, value: &Dynamic) -> Result<KeptValue, Unkept> {
        let Some((shown, sight)) = shown(value) else {
            let function = value.is::<FnPtr>();
            let what =
                if function { "a function".to_owned() } else { type_words(value.type_name()) };
            return Err(Unkept { place: String::new(), what });
        };
        let Perspective { us, me, agent } = sight.perspective;
        let scene = self.place(&sight.scene)?;
        let (script, past) = (sight.script, sight.past);
        Ok(KeptValue::Shown(shown, Eye { scene, us, me, agent: agent as u32, script, past }))
    }

    /// Decodes a value from nodes.
    fn read(&mut self, nodes: Vec<KeptValue>) -> Result<Dynamic, String> {
        self.n_read += nodes.len();
        if self.n_read > NODES_MAX {
            return Err(format!("makes more than {NODES_MAX} values of all memories"));
        }
        // Every value with its depth.
        let mut open: Vec<(Dynamic, usize)> = Vec::new();
        for node in nodes {
            let n_parts = match &node {
                KeptValue::List(n) => *n as usize,
                KeptValue::Table(names) => names.len(),
                _ => 0,
            };
            let first = open.len().checked_sub(n_parts).ok_or("lacks parts of a list or map")?;
            let parts = open.split_off(first);
            let depth = parts.iter().map(|(_, depth)| depth + 1).max().unwrap_or_default();
            if depth > EXPRESSION_DEPTH_MAX {
                return Err("is nested too deeply".to_owned());
            }
            let mut parts = parts.into_iter().map(|(part, _)| part);
            let value = match node {
                KeptValue::List(_) => Dynamic::from_array(parts.collect()),
                KeptValue::Table(names) => Dynamic::from_map(
                    names
                        .into_iter()
                        .zip(&mut parts)
                        .map(|(name, part)| (name.into(), part))
                        .collect(),
                ),
                KeptValue::Nothing => Dynamic::UNIT,
                KeptValue::Truth(truth) => truth.into(),
                KeptValue::Whole(whole) => Dynamic::from_int(whole),
                KeptValue::Number(number) => number.into(),
                KeptValue::Letter(letter) => letter.into(),
                KeptValue::Text(text) => text.into(),
                KeptValue::Range(from, to) => Dynamic::from(from..to),
                KeptValue::RangeThrough(from, to) => Dynamic::from(from..=to),
                KeptValue::Point(metres, side) => Dynamic::from(Point { metres, side }),
                KeptValue::Vector(own) => Dynamic::from(Vector { own }),
                KeptValue::Shown(shown, eye) => self.show(shown, &eye)?,
            };
            open.push((value, depth));
        }
        match (open.pop(), open.is_empty()) {
            (Some((value, _)), true) => Ok(value),
            _ => Err("is not one value".to_owned()),
        }
    }

    fn show(&self, shown: ShownKind, eye: &Eye) -> Result<Dynamic, String> {
        let perspective = Perspective { us: eye.us, me: eye.me, agent: eye.agent as usize };
        let (scene, script, past) = (self.scene(eye.scene)?, eye.script, eye.past);
        let sight = ShownState { scene, perspective, script, past };
        Ok(match shown {
            ShownKind::State => Dynamic::from(sight),
            ShownKind::Ctx => Dynamic::from(Ctx(sight)),
            ShownKind::Ball => Dynamic::from(SeenBall(sight)),
            ShownKind::Player(player) => Dynamic::from(SeenPlayer(sight, player)),
            ShownKind::Side(team) => Dynamic::from(SeenTeam(sight, team)),
            ShownKind::Score => Dynamic::from(SeenScore(sight)),
            ShownKind::Event(event) => Dynamic::from(SeenEvent(sight, event)),
            ShownKind::Region(at) => Dynamic::from(SeenRegion(sight, at)),
            ShownKind::Table(at) => Dynamic::from(SeenTable(sight, at)),
        })
    }
}

impl Unkept {
    fn at(mut self, step: &str) -> Unkept {
        self.place.insert_str(0, step);
        self
    }

    fn within_this(self) -> SnapshotError {
        SnapshotError::Unkept { place: format!("this{}", self.place), what: self.what }
    }
}

/// A value that was shown to a hook, and its scene.
fn shown(value: &Dynamic) -> Option<(ShownKind, ShownState)> {
    Some(if let Some(sight) = value.read_lock::<ShownState>() {
        (ShownKind::State, sight.clone())
    } else if let Some(ctx) = value.read_lock::<Ctx>() {
        (ShownKind::Ctx, ctx.0.clone())
    } else if let Some(ball) = value.read_lock::<SeenBall>() {
        (ShownKind::Ball, ball.0.clone())
    } else if let Some(player) = value.read_lock::<SeenPlayer>() {
        (ShownKind::Player(player.1), player.0.clone())
    } else if let Some(side) = value.read_lock::<SeenTeam>() {
        (ShownKind::Side(side.1), side.0.clone())
    } else if let Some(score) = value.read_lock::<SeenScore>() {
        (ShownKind::Score, score.0.clone())
    } else if let Some(happening) = value.read_lock::<SeenEvent>() {
        (ShownKind::Event(happening.1), happening.0.clone())
    } else if let Some(region) = value.read_lock::<SeenRegion>() {
        (ShownKind::Region(region.1), region.0.clone())
    } else if let Some(table) = value.read_lock::<SeenTable>() {
        (ShownKind::Table(table.1), table.0.clone())
    } else {
        return None;
    })
}

/// The scene that a value keeps.
pub(in super::super) fn scene_of(value: &Dynamic) -> Option<*const HookScene> {
    shown(value).map(|(_, sight)| Arc::as_ptr(&sight.scene))
}

/// The node of a self-contained value.
fn plain(value: &Dynamic) -> Option<KeptValue> {
    if value.is_unit() {
        return Some(KeptValue::Nothing);
    }
    if let Ok(truth) = value.as_bool() {
        return Some(KeptValue::Truth(truth));
    }
    if let Ok(whole) = value.as_int() {
        return Some(KeptValue::Whole(whole));
    }
    if let Ok(number) = value.as_float() {
        return Some(KeptValue::Number(number));
    }
    if let Ok(letter) = value.as_char() {
        return Some(KeptValue::Letter(letter));
    }
    if let Some(text) = value.read_lock::<ImmutableString>() {
        return Some(KeptValue::Text(text.to_string()));
    }
    if let Some(range) = value.read_lock::<Range<i64>>() {
        return Some(KeptValue::Range(range.start, range.end));
    }
    if let Some(range) = value.read_lock::<RangeInclusive<i64>>() {
        return Some(KeptValue::RangeThrough(*range.start(), *range.end()));
    }
    if let Some(point) = value.read_lock::<Point>() {
        return Some(KeptValue::Point(point.metres, point.side));
    }
    value.read_lock::<Vector>().map(|vector| KeptValue::Vector(vector.own))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_memory_of_endless_nothings_is_refused_before_it_is_made() {
        let bytes = |length: usize| {
            let mut bytes = postcard::to_allocvec(&(length as u64)).unwrap();
            bytes.resize(bytes.len() + length, 0);
            bytes
        };
        assert_eq!(
            postcard::from_bytes::<KeptValues>(&bytes(NODES_MAX)).unwrap().0.len(),
            NODES_MAX
        );
        assert!(postcard::from_bytes::<KeptValues>(&bytes(NODES_MAX + 1)).is_err());
        let mut shelf = Shelf::default();
        let nothings = || vec![KeptValue::Nothing; NODES_MAX / 2];
        let first = shelf.read(nothings()).unwrap_err();
        assert_eq!(first, "is not one value");
        shelf.read(nothings()).unwrap_err();
        assert!(
            shelf.read(vec![KeptValue::Nothing]).unwrap_err().contains("all memories"),
            "they add up"
        );
    }
}
