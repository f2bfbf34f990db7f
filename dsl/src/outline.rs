//! The shapes of parts of the pitch.

use serde::Serialize;
use std::sync::Arc;

/// A part of the pitch: lengths in metres, angles in radians, world frame.
///
/// `N` is a number, or the register that holds it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Outline<N> {
    /// Between two corners, in any order.
    Rect((N, N), (N, N)),
    /// A disc: centre and radius.
    Circle((N, N), N),
    /// A slice of a disc: from an angle on, as wide as another.
    Sector {
        /// The tip.
        centre: (N, N),
        /// How far it reaches.
        radius: N,
        /// Where it begins.
        from: N,
        /// How wide it is, 0 to a full turn.
        width: N,
    },
    /// Between corners, in order.
    Polygon(Vec<(N, N)>),
    /// In one or the other.
    Union(Arc<Outline<N>>, Arc<Outline<N>>),
    /// In both.
    Intersection(Arc<Outline<N>>, Arc<Outline<N>>),
    /// In the first but not in the second.
    Difference(Arc<Outline<N>>, Arc<Outline<N>>),
    /// The first where a condition holds, else the second.
    Either(N, Arc<Outline<N>>, Arc<Outline<N>>),
}

impl<N: Copy> Outline<N> {
    /// Its numbers, in order.
    pub fn numbers(&self) -> Vec<N> {
        let mut numbers = Vec::new();
        self.map(&mut |number| {
            numbers.push(number);
            number
        });
        numbers
    }

    /// The same shape with other numbers.
    pub fn map<M>(&self, f: &mut dyn FnMut(N) -> M) -> Outline<M> {
        let pair = |(x, y): (N, N), f: &mut dyn FnMut(N) -> M| (f(x), f(y));
        let both = |a: &Outline<N>, b: &Outline<N>, f: &mut dyn FnMut(N) -> M| {
            (Arc::new(a.map(f)), Arc::new(b.map(f)))
        };
        match self {
            Outline::Rect(a, b) => Outline::Rect(pair(*a, f), pair(*b, f)),
            Outline::Circle(centre, radius) => Outline::Circle(pair(*centre, f), f(*radius)),
            Outline::Sector { centre, radius, from, width } => Outline::Sector {
                centre: pair(*centre, f),
                radius: f(*radius),
                from: f(*from),
                width: f(*width),
            },
            Outline::Polygon(corners) => {
                Outline::Polygon(corners.iter().map(|&at| pair(at, f)).collect())
            }
            Outline::Union(a, b) => {
                let (a, b) = both(a, b, f);
                Outline::Union(a, b)
            }
            Outline::Intersection(a, b) => {
                let (a, b) = both(a, b, f);
                Outline::Intersection(a, b)
            }
            Outline::Difference(a, b) => {
                let (a, b) = both(a, b, f);
                Outline::Difference(a, b)
            }
            Outline::Either(condition, a, b) => {
                let condition = f(*condition);
                let (a, b) = both(a, b, f);
                Outline::Either(condition, a, b)
            }
        }
    }
}

impl Outline<f64> {
    /// The shape of one episode: without [`Outline::Either`].
    #[must_use]
    pub fn drawn(&self) -> Outline<f64> {
        let both = |a: &Outline<f64>, b: &Outline<f64>| (Arc::new(a.drawn()), Arc::new(b.drawn()));
        match self {
            Outline::Either(condition, a, _) if *condition != 0.0 => a.drawn(),
            Outline::Either(_, _, b) => b.drawn(),
            Outline::Union(a, b) => {
                let (a, b) = both(a, b);
                Outline::Union(a, b)
            }
            Outline::Intersection(a, b) => {
                let (a, b) = both(a, b);
                Outline::Intersection(a, b)
            }
            Outline::Difference(a, b) => {
                let (a, b) = both(a, b);
                Outline::Difference(a, b)
            }
            plain => plain.clone(),
        }
    }
}
