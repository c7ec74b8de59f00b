//! Merges objects of several passes that are the same.
//!
//! *Source:* mean of repeated fixes, weighted by the square of their contrast.
//!
//! *Parameters:* `merge_m`, m: jumps of the navigation move an object by some 10 m between two passes.
//!
//! *Deviations:* none. The strongest object gathers those near it, then the strongest of the rest does.

use super::Object;
use nalgebra::Vector2;

/// An object with all its sightings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MergedObject {
    /// Believed place (east, north), m.
    pub place: Vector2<f64>,
    /// Contrast of all sightings together, standard errors.
    pub contrast: f64,
    /// Number of sightings.
    pub sightings: u32,
    /// Height above the bed from the strongest sighting's shadow, m.
    pub height_m: f64,
}

/// The objects, strongest first.
pub fn merge(sightings: &[Object], merge_m: f64) -> Vec<MergedObject> {
    let mut left: Vec<&Object> = sightings.iter().collect();
    left.sort_by(|a, b| b.contrast.total_cmp(&a.contrast));
    let mut found = Vec::new();
    while let Some(first) = left.first().copied() {
        let (near, rest): (Vec<&Object>, Vec<&Object>) =
            (left.into_iter()).partition(|o| (o.place - first.place).norm() <= merge_m);
        left = rest;
        let weight: f64 = near.iter().map(|o| o.contrast * o.contrast).sum();
        let sum: Vector2<f64> = near.iter().map(|o| o.place * (o.contrast * o.contrast)).sum();
        found.push(MergedObject {
            place: sum / weight,
            contrast: weight.sqrt(),
            sightings: near.len() as u32,
            height_m: first.height_m,
        });
    }
    found.sort_by(|a, b| b.contrast.total_cmp(&a.contrast));
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    fn object(x: f64, contrast: f64) -> Object {
        Object {
            place: Vector2::new(x, 0.0),
            contrast,
            port: false,
            along_m: 0.0,
            ground_m: 10.0,
            length_m: 1.0,
            width_m: 1.0,
            height_m: x,
        }
    }

    #[test]
    fn near_ones_are_one_and_weigh_by_contrast() {
        let all = [object(0.0, 3.0), object(50.0, 4.5), object(10.0, 4.0)];
        let found = merge(&all, 12.0);
        assert_eq!(found.len(), 2);
        // 3 and 4 make 5; the mean lies at 10 · 16 / 25.
        assert!((found[0].contrast - 5.0).abs() < 1e-12 && found[0].sightings == 2);
        assert!((found[0].place.x - 6.4).abs() < 1e-12);
        assert_eq!(found[0].height_m, 10.0);
        assert!((found[1].place.x - 50.0).abs() < 1e-12);
        assert!(merge(&[], 1.0).is_empty());
    }
}
