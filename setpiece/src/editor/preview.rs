//! The picture of a start beside the text, and what somebody moves in it.

use super::alone::{BrokenRequire, SoundScenario};
use super::refused::Refusals;
use super::{Edit, SymbolKind, Workspace};
use crate::Loaded;
use crate::drag::HeldThing;
use crate::dsl::Outline;
use crate::dsl::ast::ItemKind;
use crate::dsl::problem::Severity;
use crate::engine::batch::EpisodeError;
use crate::engine::draw::{DrawError, Drawer};
use crate::engine::environment::{Environment, EnvironmentOptions};
use crate::error::Error;
use crate::film;
use crate::picture;
use crate::render::Scene;
use crate::render::scene::Id;
use crate::scene::{of_match, player_id};
use std::fmt::Write as _;
use std::path::Path;

/// How many starts lie over each other, if they differ.
const STARTS: u64 = 10;
/// The seed of the starts.
const SEED: u64 = 0;

/// The picture of a start.
#[derive(Clone, Debug, PartialEq)]
pub struct Preview {
    /// The scenario.
    pub scenario: String,
    /// The picture, or why there is none.
    pub picture: Result<StartPicture, String>,
}

/// A start that is drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct StartPicture {
    /// The picture, in metres of the world's frame.
    pub svg: String,
    /// What of the world it shows: the left and top edge, the width and the height.
    pub view: [f64; 4],
    /// Whoever and whatever can be moved in it.
    pub things: Vec<PlacedThing>,
    /// What a start must meet: what is written, and of what follows from the rest of the text what
    /// refuses something.
    pub requires: Vec<AskedOfStart>,
    /// Why no episode has this start; it is drawn as it is written then.
    pub refused: Option<String>,
}

/// Something that a start must meet.
#[derive(Clone, Debug, PartialEq)]
pub struct AskedOfStart {
    /// The author's words or label.
    pub label: String,
    /// The share of single attempts at a start that it is the first to refuse, 0..1; none if it has
    /// an error, so that no attempt asks for it.
    pub share: Option<f64>,
    /// Whether the start that is drawn doesn't meet it, or it has an error.
    pub fails: bool,
}

/// A player or the ball in a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct PlacedThing {
    /// The player; none for the ball.
    pub player: Option<Id>,
    /// The player's name or role; of the ball, `ball`.
    pub name: String,
    /// Where they stand, metres.
    pub at: [f32; 2],
}

impl Workspace {
    /// The start of the scenario around a byte, or of the text's last one: the first start, nine
    /// others as faint dots, and the regions. None if the text has no scenario.
    pub fn preview(&mut self, path: &Path, offset: usize) -> Option<Preview> {
        let analysis = self.analysis(path)?;
        let around = analysis.around(offset, &[SymbolKind::Scenario]).map(|it| it.name);
        let concrete = analysis.tree.items.iter().filter_map(|item| match &item.kind {
            ItemKind::Scenario(it) if !it.is_abstract => Some(it.name.node.as_str()),
            _ => None,
        });
        let names: Vec<&str> = concrete.collect();
        let name = names
            .iter()
            .find(|name| Some(**name) == around.as_deref())
            .or(names.last())
            .map(|name| (*name).to_owned())?;
        let picture = self.sound(path, &analysis, &name).and_then(|it| drawn(&it));
        Some(Preview { scenario: name, picture })
    }

    /// The edits after which a player of the drawn start, or the ball, stands elsewhere: two
    /// numbers of the text.
    ///
    /// - `player`: who; none for the ball.
    /// - `to`: metres, in the world's frame; what lies off the pitch is put on its rim.
    ///
    /// # Errors
    /// A sentence for the user, if the place isn't two plain numbers of this text.
    pub fn move_to(
        &mut self,
        path: &Path,
        scenario: &str,
        player: Option<Id>,
        to: [f64; 2],
    ) -> Result<Vec<Edit>, String> {
        let analysis = self.analysis(path).ok_or("the text is gone")?;
        let SoundScenario { loaded, broken } = self.sound(path, &analysis, scenario)?;
        let environment = environment_of(&loaded)?;
        let (drawer, refused) = first_draw(&loaded, &environment);
        let held = HeldThing::of(&loaded.scenario, &drawer, player);
        let held = held.ok_or("nobody stands there any more")?;
        // What is left out of the text is as long as the blanks for it.
        let (_, read) = loaded.sources.iter().next().ok_or("the text is gone")?;
        let numbers = held.moved(&loaded, &read.text, to)?;
        let edits: Vec<Edit> =
            numbers.into_iter().map(|it| Edit::replace(path, it.range, it.text)).collect();
        // Whoever mends a start that is refused needn't do it in one move.
        if refused.is_none() && broken.is_empty() {
            self.after(&edits).starts(path, scenario)?;
        }
        Ok(edits)
    }

    /// Whether a scenario has a start.
    ///
    /// # Errors
    /// Why it has none.
    fn starts(&mut self, path: &Path, scenario: &str) -> Result<(), String> {
        let analysis = self.analysis(path).ok_or("the text is gone")?;
        let sound = self.sound(path, &analysis, scenario).map_err(|why| {
            let errors = analysis.own_reports(path).filter(|it| it.severity == Severity::Error);
            let first = errors.map(|it| it.message.clone()).next();
            format!("not there: {}", first.unwrap_or(why))
        })?;
        let environment = environment_of(&sound.loaded)?;
        let (_, refused) = first_draw(&sound.loaded, &environment);
        let broken = sound.broken.into_iter().map(|it| it.label).next();
        match broken.or(refused.map(|why| why.requirement)) {
            None => Ok(()),
            Some(requirement) => Err(format!("not there: `{requirement}` fails")),
        }
    }
}

/// The starts of a scenario.
fn drawn(SoundScenario { loaded, broken }: &SoundScenario) -> Result<StartPicture, String> {
    let scenario = &loaded.scenario;
    let mut environment = environment_of(loaded)?;
    let (drawer, refused) = first_draw(loaded, &environment);
    let mut scene = Scene::default();
    let mut beneath = regions(loaded, &drawer);
    let mut dots: Vec<[String; 3]> = Vec::new();
    // Where the first start is refused, an environment has it until its first episode.
    let episodes = if refused.is_none() { STARTS } else { 0 };
    of_match(environment.state(), &mut scene);
    for episode in (0..episodes).rev() {
        match environment.reset(Some(SEED), Some(episode)) {
            Ok(()) => {}
            // The first start is the picture; of the others, those that there are.
            Err(_) if episode > 0 => continue,
            Err(why) => return Err(Error::Episode(Box::new(why.into())).to_string()),
        }
        of_match(environment.state(), &mut scene);
        if episode > 0 {
            let [x, y, _] = scene.ball.pos;
            dots.push([format!("{x:.2}"), format!("{y:.2}"), "#ffffff".to_owned()]);
            for player in scene.players.iter().filter(|player| player.present) {
                let [x, y] = player.pos;
                let colour = ["#ffb000", "#2f6df6"][player.id.team.index()];
                dots.push([format!("{x:.2}"), format!("{y:.2}"), colour.to_owned()]);
            }
        }
    }
    // Starts that don't differ are one.
    dots.sort();
    dots.dedup();
    for [x, y, colour] in dots {
        let _ = writeln!(
            beneath,
            "<circle cx=\"{x}\" cy=\"{y}\" r=\"0.6\" fill=\"{colour}\" fill-opacity=\"0.45\"/>"
        );
    }
    let names = film::names(scenario);
    let [x, y, _] = scene.ball.pos;
    let ball = PlacedThing { player: None, name: "ball".to_owned(), at: [x, y] };
    let present = scene.players.iter().filter(|player| player.present);
    let players = present.map(|player| PlacedThing {
        player: Some(player.id),
        name: names.get(player_id(player.id).index()).cloned().unwrap_or_default(),
        at: player.pos,
    });
    let things = players.chain([ball]).collect();
    Ok(StartPicture {
        svg: picture::svg_over(&scenario.name, &names, &scene, &beneath),
        view: picture::view(&scene.pitch),
        things,
        requires: requires(loaded, &drawer, broken),
        refused: broken.first().map(|it| it.why.clone()).or_else(|| {
            refused.map(|why| Error::Episode(Box::new(EpisodeError::from(why))).to_string())
        }),
    })
}

/// What the starts of a scenario must meet.
///
/// - `drawer`: that of the start that is drawn.
fn requires(loaded: &Loaded, drawer: &Drawer, broken: &[BrokenRequire]) -> Vec<AskedOfStart> {
    let Some(found) = Refusals::of(loaded) else { return Vec::new() };
    let scenario = &loaded.scenario;
    let parts = scenario.start.requires.iter().zip(&loaded.origins.requires).zip(&found.by);
    parts
        .enumerate()
        .filter_map(|(which, ((require, origin), count))| {
            let fails = drawer.is_unmet(scenario, which, SEED, 0);
            let matters = origin.help.is_none() || *count > 0 || fails;
            let (label, share) = (require.label.clone(), Some(found.share(*count)));
            matters.then_some(AskedOfStart { label, share, fails })
        })
        .chain(broken.iter().map(|it| AskedOfStart {
            label: it.label.clone(),
            share: None,
            fails: true,
        }))
        .collect()
}

/// The environment in which a start is drawn.
fn environment_of(loaded: &Loaded) -> Result<Environment, String> {
    Environment::new(loaded.scenario.clone(), EnvironmentOptions::default())
        .map_err(|why| Error::Environment(why).to_string())
}

/// What has drawn the first start, and why it is refused, if it is.
fn first_draw(loaded: &Loaded, environment: &Environment) -> (Drawer, Option<DrawError>) {
    let scenario = &loaded.scenario;
    let mut drawer = Drawer::new(scenario);
    let (roster, bindings) = (environment.roster(), environment.bindings());
    let drawn = drawer.draw(scenario, bindings, roster, SEED, 0);
    if drawn.is_err() {
        // The attempt that is drawn, of all that were refused.
        drawer.draw_unchecked(scenario, bindings, roster);
    }
    (drawer, drawn.err())
}

/// The outlines of the regions of the first start, each once.
fn regions(loaded: &Loaded, drawer: &Drawer) -> String {
    let mut shapes: Vec<Outline<f64>> = Vec::new();
    for (_, shape) in loaded.regions(drawer) {
        if !shapes.contains(&shape) {
            shapes.push(shape);
        }
    }
    let mut text = String::new();
    for shape in &shapes {
        outline(shape, &mut text);
    }
    text
}

/// One shape; of one that is put together, its parts.
fn outline(shape: &Outline<f64>, text: &mut String) {
    const LOOK: &str = "fill=\"#ffffff\" fill-opacity=\"0.08\" stroke=\"#ffffff\" stroke-width=\"0.25\" stroke-dasharray=\"1 0.7\"";
    let _ = match shape {
        Outline::Rect((ax, ay), (bx, by)) => writeln!(
            text,
            "<rect x=\"{:.2}\" y=\"{:.2}\" width=\"{:.2}\" height=\"{:.2}\" {LOOK}/>",
            ax.min(*bx),
            ay.min(*by),
            (ax - bx).abs(),
            (ay - by).abs()
        ),
        Outline::Circle((x, y), radius) => {
            writeln!(text, "<circle cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"{radius:.2}\" {LOOK}/>")
        }
        Outline::Sector { centre: (x, y), radius, from, width } => {
            let at = |angle: f64| (x + radius * angle.cos(), y + radius * angle.sin());
            let ((ax, ay), (bx, by)) = (at(*from), at(from + width));
            let large = u8::from(*width > std::f64::consts::PI);
            writeln!(
                text,
                "<path d=\"M{x:.2} {y:.2}L{ax:.2} {ay:.2}A{radius:.2} {radius:.2} 0 {large} 1 {bx:.2} {by:.2}Z\" {LOOK}/>"
            )
        }
        Outline::Polygon(corners) => {
            let corners: Vec<String> =
                corners.iter().map(|(x, y)| format!("{x:.2},{y:.2}")).collect();
            writeln!(text, "<polygon points=\"{}\" {LOOK}/>", corners.join(" "))
        }
        Outline::Union(one, other)
        | Outline::Intersection(one, other)
        | Outline::Difference(one, other)
        | Outline::Either(_, one, other) => {
            outline(one, text);
            outline(other, text);
            Ok(())
        }
    };
}
