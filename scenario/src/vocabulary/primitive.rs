//! The primitives of behaviours.

use super::words;

words! {
    /// A primitive of behaviours; its documentation begins with its signature.
    Primitive {
        MoveTo = "move_to", "move_to(point): runs there; ends within 1 m of it";
        Run = "run", "run(angle): runs in that direction";
        DribbleTo = "dribble_to", "dribble_to(point): takes the ball there; ends within 1 m of it, or when the ball is lost";
        PassTo = "pass_to", "pass_to(player): a short pass; ends when it is struck, or at once without the ball";
        HighPassTo = "high_pass_to", "high_pass_to(player): a lofted pass";
        LongPassTo = "long_pass_to", "long_pass_to(player): a ground pass ahead of the player";
        Shoot = "shoot", "shoot, or shoot(at: point): a shot; ends when it is struck, or at once without the ball";
        Tackle = "tackle", "tackle: challenges for the ball; ends when the own side has it, or after 1 s";
        Slide = "slide", "slide: one slide tackle; ends when the player is up again";
        Mark = "mark", "mark(player): stays between that player and the own goal";
        Press = "press", "press: goes for the ball while the own side does not have it";
        Hold = "hold", "hold: stands";
        Wait = "wait", "wait for D: stands for that long";
        Bot = "bot", "bot: hands over to the built-in bot";
    }
}

impl Primitive {
    /// Whether it can be done `sprinting`.
    pub const fn runs(self) -> bool {
        use Primitive as P;
        matches!(self, P::MoveTo | P::Run | P::DribbleTo | P::Tackle | P::Mark | P::Press)
    }
}
