//! The hydrodynamic numbers of a vehicle: those of `vehicle.ron`, and those of its URDF's extensions.
//!
//! *Source:* see `extensions`.
//!
//! *Parameters:* [`HydrodynamicsSpec`].
//!
//! *Deviations:* what `vehicle.ron` gives counts before what the URDF gives.

use super::blocks::Damping;
use super::hydrodynamics_spec::{Axes, Block, HydrodynamicsSpec};
use crate::error::RobotError;
use crate::vehicles::dynamics::turned;
use crate::vehicles::extensions::{self, SURFACE};
use crate::vehicles::urdf_parts::UrdfText;
use nalgebra::{Matrix6, Vector3};
use std::collections::BTreeMap;
use world::frames::Pose;

/// A block in FRD.
fn matrix(block: &Block, axes: Axes) -> Matrix6<f64> {
    let given = match block {
        Block::Diagonal(d) => Matrix6::from_diagonal(&row(d)),
        Block::Full(rows) => {
            let (a, b, c, d, e, f) = &**rows;
            Matrix6::from_columns(&[a, b, c, d, e, f].map(row)).transpose()
        }
    };
    match axes {
        Axes::Flu => turned(&given),
        Axes::Frd => given,
    }
}

fn row((a, b, c, d, e, f): &super::Row) -> nalgebra::Vector6<f64> {
    nalgebra::Vector6::from([a, b, c, d, e, f].map(|v| v.get()))
}

/// Blocks in FRD, from `vehicle.ron` and, where that asks for it, from the URDF's extensions.
pub(super) struct HullBlocks {
    pub(super) added: Option<Matrix6<f64>>,
    pub(super) damping: Damping,
    pub(super) volume_m3: Option<f64>,
    /// FLU, m.
    pub(super) centre_of_buoyancy: Option<Vector3<f64>>,
    pub(super) gravity_m_s2: f64,
    pub(super) floats: bool,
}

pub(super) fn given(
    spec: &HydrodynamicsSpec,
    urdf: &UrdfText,
    kg: f64,
    links: &BTreeMap<String, Pose>,
    told: &mut Vec<String>,
) -> Result<HullBlocks, RobotError> {
    let block = |b: &Option<Block>| b.as_ref().map(|b| matrix(b, spec.axes));
    let mut given = HullBlocks {
        added: block(&spec.added_mass),
        damping: Damping {
            linear: Matrix6::zeros(),
            quadratic: Matrix6::zeros(),
            forward: Matrix6::zeros(),
            density_kg_m3: spec.density_kg_m3.get(),
            wet: 1.0,
        },
        volume_m3: spec.volume_m3.map(|v| v.get()),
        centre_of_buoyancy: spec.centre_of_buoyancy_m.map(|(x, y, z)| Vector3::new(x.get(), y.get(), z.get())),
        gravity_m_s2: spec.gravity_m_s2.get(),
        floats: spec.floats,
    };
    let mut damping = [block(&spec.linear_damping), block(&spec.quadratic_damping), block(&spec.forward_damping)];
    let extension = extensions::read(&urdf.text).map_err(|problem| urdf.fault(problem))?;
    match (spec.from_urdf, extension) {
        (true, None) => {
            return Err(urdf.fault(
                "hydrodynamics.from_urdf: it has no <hydrodynamic_model> of uuv_simulator and no Hydrodynamics plugin \
                 of gz-sim"
                    .into(),
            ));
        }
        (true, Some(found)) => {
            // A craft that floats is none under water.
            let afloat = |doubt: &String| spec.floats && doubt.ends_with(SURFACE);
            told.extend(found.doubts.into_iter().filter(|doubt| !afloat(doubt)));
            // Names may begin with that of the vehicle, as in `lauv/base_link`.
            let link = found.link.rsplit('/').next().unwrap_or_default();
            let elsewhere = |pose: &&Pose| pose.p_WB.norm() > 1e-9 || pose.R_WB.angle() > 1e-9;
            if let Some(pose) = links.get(link).filter(elsewhere) {
                let p = pose.p_WB;
                told.push(format!(
                    "the hydrodynamics for {} hold about the origin of link \"{link}\", which lies at ({}, {}, {}) m \
                     from that of the first link; they are used as if they held there: let both be in one place",
                    found.source, p.x, p.y, p.z
                ));
            }
            let from_urdf = [found.linear, found.quadratic, found.forward];
            for (block, found) in damping.iter_mut().zip(from_urdf) {
                block.get_or_insert_with(|| turned(&found));
            }
            given.added.get_or_insert_with(|| turned(&found.added_mass));
            if let Some(density) = found.density_kg_m3 {
                given.damping.density_kg_m3 = density;
            }
            let neutral = found.neutral.then(|| kg / given.damping.density_kg_m3);
            given.volume_m3 = given.volume_m3.or(found.volume_m3).or(neutral);
            given.centre_of_buoyancy = given.centre_of_buoyancy.or(found.centre_of_buoyancy_m);
        }
        (false, Some(found)) => told.push(format!(
            "the URDF has hydrodynamics for {}, which are not used: `from_urdf: true` takes them",
            found.source
        )),
        (false, None) => {}
    }
    [given.damping.linear, given.damping.quadratic, given.damping.forward] =
        damping.map(|block| block.unwrap_or_else(Matrix6::zeros));
    Ok(given)
}

#[cfg(test)]
mod tests {
    use super::super::super::files::InMemory;
    use super::super::TermsSpec;
    use super::*;
    use std::path::Path;

    /// A craft of a vehicle.ron, with an element of uuv_simulator that is only for the surface.
    #[test]
    fn what_floats_is_not_doubted_to_be_a_surface_vessel() {
        let urdf = "<robot name=\"boat\"><link name=\"boat\"/><gazebo>\
            <plugin filename=\"libuuv_underwater_object_ros_plugin.so\" name=\"p\"><link name=\"boat\">\
            <volume>0.1</volume><metacentric_width>0.3</metacentric_width>\
            <hydrodynamic_model><type>fossen</type><added_mass>1 1 1 1 1 1</added_mass>\
            <linear_damping>-1 -2 -3 -4 -5 -6</linear_damping></hydrodynamic_model>\
            </link></plugin></gazebo></robot>";
        let files = InMemory::default().with("boat.urdf", urdf.as_bytes());
        let text = UrdfText::open_at(Path::new("boat.urdf"), &files).expect("there");
        let told = |floats| {
            let spec = HydrodynamicsSpec {
                terms: TermsSpec::Blocks,
                axes: Axes::Flu,
                from_urdf: true,
                volume_m3: None,
                centre_of_buoyancy_m: None,
                added_mass: None,
                linear_damping: None,
                quadratic_damping: None,
                forward_damping: None,
                density_kg_m3: world::ranges::Positive::new(1025.0),
                gravity_m_s2: world::ranges::Positive::new(9.8),
                floats,
            };
            let mut told = Vec::new();
            given(&spec, &text, 50.0, &BTreeMap::new(), &mut told).expect("legal");
            told.into_iter().filter(|t| t.contains("metacentric")).count()
        };
        assert_eq!((told(false), told(true)), (1, 0));
    }
}
