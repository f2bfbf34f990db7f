//! Where the goals of a match stand: the frame, nets and mouth that nothing passes through.

use glam::Vec3;
use setpiece::engine::physics::lines::out_x;
use setpiece::engine::state::Match;
use setpiece::scenario::pitch::GOAL_DEPTH_M;

/// The right goal of a match, metres.
#[derive(Clone, Copy)]
pub(super) struct GoalPlace {
    /// x of the goal line.
    pub(super) line: f32,
    /// x from which the whole ball is over it.
    pub(super) out: f32,
    /// x of the net's rear.
    pub(super) rear: f32,
    /// y of a post.
    pub(super) post: f32,
    /// z of the bar.
    pub(super) bar: f32,
}

impl GoalPlace {
    pub(super) fn of(game: &Match) -> GoalPlace {
        let pitch = &game.pitch;
        GoalPlace {
            line: pitch.half_length() as f32,
            out: out_x(pitch),
            rear: (pitch.half_length() + GOAL_DEPTH_M) as f32,
            post: pitch.goal_half_width() as f32,
            bar: pitch.goal_height() as f32,
        }
    }

    /// Whether a point is too far from both goals to meet anything of them.
    pub(super) fn is_far(&self, x: f32, y: f32) -> bool {
        x.abs() < self.line - 1.0 || y.abs() > self.post + 1.0
    }

    /// Posts and bar.
    pub(super) fn frame(&self) -> [[Vec3; 2]; 3] {
        let at = |y: f32, z: f32| Vec3::new(self.line, y, z);
        let GoalPlace { post, bar, .. } = *self;
        [
            [at(-post, 0.0), at(-post, bar)],
            [at(post, 0.0), at(post, bar)],
            [at(-post, bar), at(post, bar)],
        ]
    }

    /// Sides and rear of the net, on the ground.
    pub(super) fn walls(&self) -> [[Vec3; 2]; 3] {
        let at = |x: f32, y: f32| Vec3::new(x, y, 0.0);
        let GoalPlace { line, rear, post, .. } = *self;
        [
            [at(line, -post), at(rear, -post)],
            [at(line, post), at(rear, post)],
            [at(rear, -post), at(rear, post)],
        ]
    }

    /// The distance of a point from the sides and the top of the net; its rear can't be reached
    /// within a tick.
    pub(super) fn net_distance(&self, at: Vec3) -> f32 {
        let x = (self.line - at.x).max(at.x - self.rear).max(0.0);
        let beyond = |past: f32| past.max(0.0);
        let side = Vec3::new(x, at.y.abs() - self.post, beyond(at.z - self.bar)).length();
        let top = Vec3::new(x, beyond(at.y.abs() - self.post), at.z - self.bar).length();
        side.min(top)
    }

    /// Whether a ball is behind the line, between the nets.
    pub(super) fn contains(&self, at: Vec3) -> bool {
        at.x > self.out && at.x < self.rear && at.y.abs() < self.post && at.z < self.bar
    }

    /// Whether a ball crossed either goal's line this far inside the mouth.
    pub(super) fn is_entered(&self, from: Vec3, to: Vec3, room: f32) -> bool {
        let share = (self.out - from.x.abs()) / (to.x.abs() - from.x.abs());
        let at = from.lerp(to, share.clamp(0.0, 1.0));
        from.x.abs() <= self.out
            && to.x.abs() > self.out
            && at.y.abs() <= self.post - room
            && at.z <= self.bar - room
    }
}
