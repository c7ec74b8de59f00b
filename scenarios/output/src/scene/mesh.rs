//! Surfaces as corners and triangles of their numbers, with a limit on their number.

use nalgebra::Vector3;
use std::collections::BTreeMap;

/// A surface of more triangles is made coarser: corners in one cell of a grid become one.
pub const MOST_TRIANGLES: usize = 20_000;

/// A surface.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Corners, m.
    pub vertices: Vec<Vector3<f64>>,
    /// Numbers of the corners of each triangle, anticlockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
}

impl Mesh {
    /// Of triangles, with equal corners joined, and made coarser if there are more than [`MOST_TRIANGLES`].
    pub fn from_triangles(triangles: &[[Vector3<f64>; 3]]) -> Self {
        Self::limited(triangles, MOST_TRIANGLES)
    }

    fn limited(triangles: &[[Vector3<f64>; 3]], most: usize) -> Self {
        let corners = triangles.as_flattened();
        let low = corners.iter().fold(Vector3::repeat(f64::MAX), |m, p| m.inf(p));
        let high = corners.iter().fold(Vector3::repeat(f64::MIN), |m, p| m.sup(p));
        let reach_m = (high - low).max();
        let mesh = Self::joined(triangles, |p| p.map(f64::to_bits).into());
        // A grid of n cells along the longest side has at most some 6 n² cells on a surface round the solid.
        let mut cells = 256.0;
        let mut coarse = mesh;
        while coarse.triangles.len() > most && cells > 2.0 {
            let cell = |p: &Vector3<f64>| ((p - low) * (cells / reach_m)).map(|v| v.floor() as u64).into();
            coarse = Self::joined(triangles, cell);
            cells *= 0.75;
        }
        coarse
    }

    /// Corners with one key become one, at the first of them; triangles that collapse are omitted.
    fn joined(triangles: &[[Vector3<f64>; 3]], key: impl Fn(&Vector3<f64>) -> [u64; 3]) -> Self {
        let mut numbers = BTreeMap::new();
        let mut mesh = Self::default();
        for triangle in triangles {
            let t = triangle.map(|p| {
                *numbers.entry(key(&p)).or_insert_with(|| {
                    mesh.vertices.push(p);
                    mesh.vertices.len() as u32 - 1
                })
            });
            if t[0] != t[1] && t[1] != t[2] && t[2] != t[0] {
                mesh.triangles.push(t);
            }
        }
        mesh
    }

    /// The corners of each triangle.
    pub fn corners(&self) -> impl Iterator<Item = [Vector3<f64>; 3]> + '_ {
        (self.triangles.iter()).map(|t| t.map(|k| self.vertices[k as usize]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    /// A ball of radius 1 m, of `n` by `2 n` fields.
    fn ball(n: u32) -> Vec<[Vector3<f64>; 3]> {
        let at = |i: u32, j: u32| {
            let (up, round) = (f64::from(i) / f64::from(n), f64::from(j) / f64::from(n));
            let (z, r) = (world::math::cos(up * PI), world::math::sin(up * PI));
            let (s, c) = world::math::sin_cos(round * PI);
            Vector3::new(r * c, r * s, z)
        };
        let fields = (0..n).flat_map(|i| (0..2 * n).map(move |j| (i, j)));
        fields
            .flat_map(|(i, j)| {
                let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
                [[a, b, c], [a, c, d]]
            })
            .collect()
    }

    #[test]
    fn small_surfaces_keep_every_corner_once() {
        let corner = |k: u8| Vector3::new(f64::from(k % 2), f64::from(k / 2 % 2), f64::from(k / 4));
        let mesh = Mesh::from_triangles(&[[0, 1, 2].map(corner), [1, 3, 2].map(corner)]);
        assert_eq!(mesh.vertices.len(), 4);
        assert_eq!(mesh.triangles, [[0, 1, 2], [1, 3, 2]]);
        assert_eq!(Mesh::from_triangles(&[]), Mesh::default());
    }

    #[test]
    fn large_surfaces_become_coarser_and_keep_their_shape() {
        let fine = ball(100);
        let mesh = Mesh::limited(&fine, 3000);
        let n = mesh.triangles.len();
        assert!(n <= 3000 && n > 500, "{n} of {}", fine.len());
        let volume: f64 = mesh.corners().map(|[a, b, c]| a.dot(&b.cross(&c)) / 6.0).sum();
        assert!((volume / 4.188_79 - 1.0).abs() < 0.1, "{volume}");
    }
}
