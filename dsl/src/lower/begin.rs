//! Reads what every program of a scenario is lowered against: parameters, then players.

use super::loaded_scripts::LoadedScripts;
use super::mirror::Mirror;
use super::param::lower_params;
use super::people::Casting;
use super::roster::lower_roster;
use super::world::{Effort, World};
use crate::resolve::{Flat, Library};
use std::cell::{Cell, RefCell};

impl<'w> World<'w> {
    /// Reads the parameters, then the players against them. Whoever has a world has all of it.
    pub(crate) fn new(
        library: &'w Library,
        flat: &'w Flat<'w>,
        mirror: Mirror,
        casting: &'w [Casting<'w>],
        scripts_loaded: &'w LoadedScripts<'w>,
        effort: &'w Effort,
    ) -> World<'w> {
        let mut world = World {
            library,
            flat,
            params: Vec::new(),
            mirror,
            casting,
            roster: Vec::new(),
            whole_roster: false,
            scripts: RefCell::default(),
            scripts_loaded,
            problems: RefCell::default(),
            used: RefCell::default(),
            circular: RefCell::default(),
            effort,
            counts: RefCell::default(),
            found: Cell::default(),
            errors: Cell::default(),
            is_tentative: Cell::default(),
        };
        // A default is a constant: it reads no other parameter and no player.
        world.params = lower_params(&world);
        let found = world.found();
        // Who plays is read against the parameters; where they stand belongs to the start.
        world.roster = lower_roster(&world);
        world.whole_roster = world.found() == found;
        world
    }
}
