//! What is read in a mirror while it is lowered.

use super::Lower;
use super::mirror::Mirror;
use setpiece_scenario::{Reg, UnaryOp};

impl Lower<'_, '_> {
    /// World y of something at the top or bottom of the picture.
    pub(crate) fn picture_y(&mut self, y: Reg) -> Reg {
        if self.world.mirror == Mirror::Off { y } else { self.code.unary(UnaryOp::Neg, y) }
    }

    /// A spin, which turns the other way round in a mirror.
    pub(crate) fn mirrored_spin(&mut self, (x, y, z): (Reg, Reg, Reg)) -> (Reg, Reg, Reg) {
        let mut negated = |reg: Reg| self.code.unary(UnaryOp::Neg, reg);
        match self.world.mirror {
            Mirror::Off => (x, y, z),
            Mirror::Flanks => (negated(x), y, negated(z)),
            Mirror::Ends => (negated(x), negated(y), z),
        }
    }
}
