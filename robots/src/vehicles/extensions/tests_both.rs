//! A model means the same in both forms.

use super::tests::{blocks, row};
use super::{FossenBlocks, turned};
use nalgebra::{Matrix6, Vector6};
use proptest::prelude::*;
use std::fmt::Write;

/// A model in uuv_simulator's form, from blocks forward, left, up.
fn uuv(b: &FossenBlocks) -> String {
    let all = |m: &Matrix6<f64>| row(m.transpose().as_slice());
    let mut model = String::new();
    for (what, m) in [
        ("added_mass", turned(&b.added_mass)),
        ("linear_damping", -turned(&b.linear)),
        ("quadratic_damping", -turned(&b.quadratic)),
        ("linear_damping_forward_speed", -turned(&b.forward)),
    ] {
        writeln!(model, "<{what}>{}</{what}>", all(&m)).expect("memory");
    }
    format!(
        "<robot><gazebo><plugin filename=\"libuuv_underwater_object_plugin.so\">\
         <fluid_density>{}</fluid_density><link name=\"{}\"><hydrodynamic_model><type>fossen</type>\n{model}\
         </hydrodynamic_model></link></plugin></gazebo></robot>",
        b.density_kg_m3.expect("given"),
        b.link
    )
}

/// A model in gz-sim's form.
fn gz(b: &FossenBlocks) -> String {
    let mut terms = String::new();
    let mut add = |name: &str, value: f64| {
        writeln!(terms, "<{name}>{}</{name}>", 0.0 - value).expect("memory");
    };
    for (i, force) in "xyzkmn".chars().enumerate() {
        for (j, speed) in "UVWPQR".chars().enumerate() {
            add(&format!("{force}Dot{speed}"), b.added_mass[(i, j)]);
            add(&format!("{force}{speed}"), b.linear[(i, j)]);
            add(&format!("{force}{speed}abs{speed}"), b.quadratic[(i, j)]);
            // <xUU> would be read as drag.
            if (i, j) != (0, 0) {
                add(&format!("{force}U{speed}"), b.forward[(i, j)]);
            }
        }
    }
    format!(
        "<robot><gazebo><plugin filename=\"gz-sim-hydrodynamics-system\"><link_name>{}</link_name>\
         <water_density>{}</water_density>\n{terms}</plugin></gazebo></robot>",
        b.link,
        b.density_kg_m3.expect("given")
    )
}

proptest! {
    /// Printed in either form, a model is read as the same blocks.
    #[test]
    fn both_forms_mean_the_same(
        mass in proptest::array::uniform32(-9.0..9.0f64),
        own in proptest::array::uniform6(10.0..90.0f64),
        linear in proptest::collection::vec(-9.0..9.0f64, 36),
        forward in proptest::collection::vec(-9.0..9.0f64, 36),
        quadratic in proptest::array::uniform6(0.0..9.0f64),
    ) {
        let mass = Matrix6::from_fn(|i, j| mass[(i.max(j) * 6 + i.min(j)) % 32]);
        let model = FossenBlocks {
            source: "",
            link: "hull".into(),
            added_mass: mass - Matrix6::from_diagonal(&mass.diagonal())
                + Matrix6::from_diagonal(&Vector6::from_row_slice(&own)),
            linear: Matrix6::from_row_slice(&linear),
            quadratic: Matrix6::from_diagonal(&Vector6::from_row_slice(&quadratic)),
            // <xUU> is read as drag, so gz-sim cannot say it.
            forward: Matrix6::from_fn(|i, j| if i + j == 0 { 0.0 } else { forward[6 * i + j] }),
            volume_m3: None,
            neutral: false,
            centre_of_buoyancy_m: None,
            density_kg_m3: Some(1000.0),
            doubts: Vec::new(),
        };
        for text in [uuv(&model), gz(&model)] {
            let mut found = blocks(&text);
            found.source = "";
            found.doubts.clear();
            prop_assert_eq!(&found, &model);
        }
    }
}
