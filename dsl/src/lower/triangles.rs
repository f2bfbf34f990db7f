//! Polygons as triangles: ear clipping.
//!
//! Which triangles, and in which order, is part of a scenario: a seed picks one by its number, and
//! then a point in it. A library that cuts otherwise (earcutr) would begin every polygon's episodes
//! elsewhere, and refuses no crossing edges.

/// A triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Triangle {
    /// Its corners, `[x, y]`.
    pub(crate) corners: [[f64; 2]; 3],
    /// Its area.
    pub(crate) area: f64,
}

/// Twice the signed area of a triangle: positive where a, b, c turn from +x towards +y.
fn twice(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// Cuts a simple polygon into triangles; `None` where its edges cross or it has no area.
pub(crate) fn triangulate(corners: &[[f64; 2]]) -> Option<Vec<Triangle>> {
    let around = |i: usize| (corners[i], corners[(i + 1) % corners.len()]);
    let signed: f64 = (0..corners.len()).map(around).map(|(p, q)| p[0] * q[1] - q[0] * p[1]).sum();
    if corners.len() < 3 || signed == 0.0 || crosses_itself(corners) {
        return None;
    }
    let mut left: Vec<[f64; 2]> = corners.to_vec();
    if signed < 0.0 {
        left.reverse();
    }
    let mut triangles = Vec::new();
    while left.len() > 3 {
        let n = left.len();
        let ear = (0..n).find(|&i| {
            let (a, b, c) = (left[(i + n - 1) % n], left[i], left[(i + 1) % n]);
            let hides = |p: &[f64; 2]| {
                *p != a
                    && *p != b
                    && *p != c
                    && twice(a, b, *p) >= 0.0
                    && twice(b, c, *p) >= 0.0
                    && twice(c, a, *p) >= 0.0
            };
            twice(a, b, c) >= 0.0 && !left.iter().any(hides)
        })?;
        push(&mut triangles, [left[(ear + n - 1) % n], left[ear], left[(ear + 1) % n]]);
        left.remove(ear);
    }
    push(&mut triangles, [left[0], left[1], left[2]]);
    Some(triangles)
}

/// Whether all corners lie on one line.
pub(crate) fn is_flat(corners: &[[f64; 2]]) -> bool {
    corners.iter().all(|&a| corners.iter().all(|&b| corners.iter().all(|&c| twice(a, b, c) == 0.0)))
}

fn push(triangles: &mut Vec<Triangle>, corners: [[f64; 2]; 3]) {
    let area = 0.5 * twice(corners[0], corners[1], corners[2]);
    // Corners on one line span nothing.
    if area > 0.0 {
        triangles.push(Triangle { corners, area });
    }
}

/// Whether two edges that share no corner meet.
fn crosses_itself(corners: &[[f64; 2]]) -> bool {
    let n = corners.len();
    let edge = |i: usize| (corners[i], corners[(i + 1) % n]);
    let meets = |(a, b): ([f64; 2], [f64; 2]), (c, d): ([f64; 2], [f64; 2])| {
        twice(a, b, c) * twice(a, b, d) < 0.0 && twice(c, d, a) * twice(c, d, b) < 0.0
    };
    (0..n).any(|i| (i + 2..n).any(|j| (j + 1) % n != i && meets(edge(i), edge(j))))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn area(corners: &[[f64; 2]]) -> Option<f64> {
        triangulate(corners).map(|triangles| triangles.iter().map(|triangle| triangle.area).sum())
    }

    #[test]
    fn triangles_cover_the_polygon_whichever_way_round_it_is_written() {
        let arrow = [[0.0, 0.0], [4.0, 2.0], [0.0, 4.0], [1.0, 2.0]];
        let mut back = arrow;
        back.reverse();
        assert_eq!(area(&arrow), Some(6.0));
        assert_eq!(area(&back), Some(6.0));
        let comb = [
            [0.0, 0.0],
            [5.0, 0.0],
            [5.0, 3.0],
            [4.0, 3.0],
            [4.0, 1.0],
            [3.0, 1.0],
            [3.0, 3.0],
            [0.0, 3.0],
        ];
        assert_eq!(area(&comb), Some(13.0));
    }

    #[test]
    fn what_crosses_itself_or_has_no_area_is_refused() {
        assert_eq!(area(&[[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]]), None);
        assert_eq!(area(&[[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]]), None);
    }
}
