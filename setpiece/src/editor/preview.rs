//! The picture of a start beside the text.

use super::analysis::scenario_of;
use super::{SymbolKind, Workspace};
use crate::Loaded;
use crate::dsl::Outline;
use crate::dsl::ast::ItemKind;
use crate::engine::draw::Drawer;
use crate::engine::environment::{Environment, EnvironmentOptions};
use crate::error::Error;
use crate::film;
use crate::picture;
use crate::render::Scene;
use crate::scene::of_match;
use std::fmt::Write as _;
use std::path::Path;

/// How many starts lie over each other, if they differ.
const STARTS: u64 = 10;
/// The seed of the starts.
const SEED: u64 = 0;

/// The picture of a start.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Preview {
    /// The scenario.
    pub scenario: String,
    /// The picture, SVG, or why there is none.
    pub picture: Result<String, String>,
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
        let broken = analysis.errors();
        let picture = if broken > 0 {
            let errors =
                if broken == 1 { "1 error".to_owned() } else { format!("{broken} errors") };
            Err(format!("{errors} in the text"))
        } else {
            let is_last = names.last() == Some(&name.as_str());
            let known = analysis.loaded.as_ref().filter(|_| is_last).cloned();
            let loaded =
                known.or_else(|| scenario_of(path, &analysis.text, &self.loader(path), &name));
            loaded.map_or_else(|| Err("it can't be compiled".to_owned()), |it| drawn(&it))
        };
        Some(Preview { scenario: name, picture })
    }
}

/// The starts of a scenario.
fn drawn(loaded: &Loaded) -> Result<String, String> {
    let scenario = &loaded.scenario;
    let fault = |why: crate::engine::batch::EpisodeError| Error::Episode(Box::new(why)).to_string();
    let mut environment = Environment::new(scenario.clone(), EnvironmentOptions::default())
        .map_err(|why| Error::Environment(why).to_string())?;
    let mut scene = Scene::default();
    let mut beneath = regions(loaded, &environment);
    let mut dots: Vec<[String; 3]> = Vec::new();
    for episode in (0..STARTS).rev() {
        environment.reset(Some(SEED), Some(episode)).map_err(|why| fault(why.into()))?;
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
    Ok(picture::svg_over(&scenario.name, &names, &scene, &beneath))
}

/// The outlines of the regions of the first start.
fn regions(loaded: &Loaded, environment: &Environment) -> String {
    let (roster, bindings) = (environment.roster(), environment.bindings());
    let mut drawer = Drawer::new(&loaded.scenario);
    // A start that is refused has regions, too.
    let _ = drawer.draw(&loaded.scenario, bindings, roster, SEED, 0);
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
