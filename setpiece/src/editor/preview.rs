//! The picture of a start beside the text, and what somebody moves in it.

use super::analysis::scenario_of;
use super::{Analysis, Edit, SymbolKind, Workspace};
use crate::Loaded;
use crate::drag::HeldThing;
use crate::dsl::Outline;
use crate::dsl::ast::ItemKind;
use crate::engine::draw::Drawer;
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
        let loaded = self.sound(path, &analysis, scenario)?;
        let environment = environment_of(&loaded)?;
        let drawer = first_draw(&loaded, &environment);
        let held = HeldThing::of(&loaded.scenario, &drawer, player);
        let held = held.ok_or("nobody stands there any more")?;
        let numbers = held.moved(&loaded, &analysis.text, to)?;
        Ok(numbers.into_iter().map(|it| Edit::replace(path, it.range, it.text)).collect())
    }

    /// A scenario of a text, if nothing is wrong with the text.
    fn sound(&self, path: &Path, analysis: &Analysis, name: &str) -> Result<Loaded, String> {
        match analysis.errors() {
            0 => {}
            1 => return Err("1 error in the text".to_owned()),
            broken => return Err(format!("{broken} errors in the text")),
        }
        let known = analysis.loaded.as_ref().filter(|it| it.scenario.name == name).cloned();
        known
            .or_else(|| scenario_of(path, &analysis.text, &self.loader(path), name))
            .ok_or_else(|| "it can't be compiled".to_owned())
    }
}

/// The starts of a scenario.
fn drawn(loaded: &Loaded) -> Result<StartPicture, String> {
    let scenario = &loaded.scenario;
    let fault = |why: crate::engine::batch::EpisodeError| Error::Episode(Box::new(why)).to_string();
    let mut environment = environment_of(loaded)?;
    let mut scene = Scene::default();
    let mut beneath = regions(loaded, &environment);
    let mut dots: Vec<[String; 3]> = Vec::new();
    for episode in (0..STARTS).rev() {
        match environment.reset(Some(SEED), Some(episode)) {
            Ok(()) => {}
            // The first start is the picture; of the others, those that there are.
            Err(_) if episode > 0 => continue,
            Err(why) => return Err(fault(why.into())),
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
    })
}

/// The environment in which a start is drawn.
fn environment_of(loaded: &Loaded) -> Result<Environment, String> {
    Environment::new(loaded.scenario.clone(), EnvironmentOptions::default())
        .map_err(|why| Error::Environment(why).to_string())
}

/// What has drawn the first start, also one that is refused.
fn first_draw(loaded: &Loaded, environment: &Environment) -> Drawer {
    let mut drawer = Drawer::new(&loaded.scenario);
    let (roster, bindings) = (environment.roster(), environment.bindings());
    let _ = drawer.draw(&loaded.scenario, bindings, roster, SEED, 0);
    drawer
}

/// The outlines of the regions of the first start.
fn regions(loaded: &Loaded, environment: &Environment) -> String {
    let drawer = first_draw(loaded, environment);
    let mut text = String::new();
    for (_, shape) in loaded.regions(&drawer) {
        outline(&shape, &mut text);
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
