//! The numbers of the REMUS 100 for tests.

use super::coefficients::Coefficients;
use super::spec::TorpedoHullSpec;
use crate::vehicles::folder::{ShippedVehicle, TermsSpec};

/// The hull of the shipped file.
fn hull() -> (TorpedoHullSpec, f64, f64) {
    let file = ShippedVehicle::named("remus100").expect("it is shipped").read().expect("it can be read");
    let (rho, gravity) = (file.hydrodynamics.density_kg_m3.get(), file.hydrodynamics.gravity_m_s2.get());
    match file.hydrodynamics.terms {
        TermsSpec::Torpedo(hull) => (*hull, rho, gravity),
        TermsSpec::Blocks => panic!("a torpedo"),
    }
}

/// Its numbers, with the quirks of the published code or without.
pub(in crate::vehicles) fn remus100(published: bool) -> Coefficients {
    let (hull, rho, gravity) = hull();
    Coefficients::new(&TorpedoHullSpec { published, ..hull }, rho, gravity).expect("a hull")
}
