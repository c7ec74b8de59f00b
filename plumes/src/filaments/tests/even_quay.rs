//! Even dye stays even under a quay, between its piles and in two layers.

use super::even::{Scene, Shots, blocks_of, mixing, stays_even};
use crate::flow::CurrentSpec;
use crate::flow::blockage::tests::{area, block, eastward, pile, solids, spec};
use crate::flow::tests::kit::{layer, rough, two_layers};
use nalgebra::Vector3;
use world::terrain::Terrain;

/// A part of the quay: wall, deck with its lower side within a cell, hull with its sides within cells, two piles, two
/// layers with no diffusivity between them. Pools of 2 x 2 columns and 2 levels, four times 20 s apart, for
/// behind the piles the water is exchanged slowly: 6000 and more.
#[test]
fn under_a_quay() {
    let area = area(32.0, 44.0, 90.0);
    let bed = Terrain::Level { depth_m: 12.0 };
    let mut solids = solids(
        &[
            (block([80.0, 6.0, 12.0]), 4.0, 12.0, 90.0),
            (block([80.0, 13.0, 12.0]), 4.0, 2.5, 90.0),
            (block([15.0, 9.0, 12.0]), 6.0, -11.0, 90.0),
            (pile(1.5, 12.0), -3.0, -1.0, 90.0),
            (pile(1.5, 12.0), 11.0, -1.0, 90.0),
        ],
        &bed,
    );
    // Deck and hull hang: one metre of the deck and five of the hull are under water.
    solids.0[1].pose.p_WB = Vector3::new(4.0, 2.5, 5.0);
    solids.0[2].pose.p_WB = Vector3::new(6.0, -11.0, 1.0);
    let layers = [layer(0.3, 90.0, 1012.0), layer(0.2, 90.0, 1022.0)];
    let mut spec = eastward(0.0, spec(2.0, 13, 0.0));
    spec.currents = vec![CurrentSpec::new(two_layers(layers, 3.0, 1.0, Vec::new()))];
    spec.bed = rough(0.002, 4.0);
    mixing(&mut spec, 0.03, 3e-4);
    let scene = Scene::new(&spec, &area, &bed, &solids, 100.0, 2);
    let open = scene.cells().open.iter().filter(|o| **o).count();
    assert!(open < scene.cells().open.len() - 500, "{open}");
    stays_even(scene, 4.0, Shots { first: 10, then: 5, count: 4 }, blocks_of(2, 2), 300);
}
