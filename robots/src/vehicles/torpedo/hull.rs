//! A torpedo-shaped hull at work: its numbers, its equation of motion, and the state of fins and propeller.
//!
//! *Source:* the equation of motion in `vehicles/dynamics`; terms in `terms.rs`.
//!
//! *Parameters:* [`TorpedoHullSpec`].
//!
//! *Deviations:* its greatest speed is that at which thrust and drag balance, found by running its own equation of motion
//! from rest. Its electric power is that of the shaft over a constant efficiency.

use super::actuators::Actuators;
use super::coefficients::Coefficients;
use super::spec::TorpedoHullSpec;
use super::terms::TorpedoTerms;
use crate::error::{RobotError, ensure};
use crate::handoff::{Actuation, ActuatorCommand, Capabilities, Control, DriveEffect, NamedDrive};
use crate::vehicles::drives::{CurveSpec, table};
use crate::vehicles::dynamics::{Equation, wrench};
use crate::vehicles::folder::VehicleSource;
use crate::vehicles::motion::{Inertia, Motion, Statics, VehicleDrive, foreign};
use crate::vehicles::urdf::Shell;
use nalgebra::{Matrix3, Vector3};
use world::fields::WaterSample;
use world::frames::{Pose, Truth};
use world::ranges::{Finite, Positive};
use world::units::{Heading, SEA_WATER_KG_M3};

/// Time from rest to a steady speed, s: some ten times a hull's time constant.
const RUN_UP_S: f64 = 60.0;
/// Step of the run-up, s.
const STEP_S: f64 = 0.02;

/// A hull and the state of its actuators.
#[derive(Clone, Debug)]
pub(in crate::vehicles) struct TorpedoHull {
    c: Coefficients,
    equation: Equation,
    propeller: DriveEffect,
    /// Speed at the greatest rpm, m/s.
    top_speed_m_s: f64,
    actuators: Actuators,
    /// State, velocity (ENU) and density of the water at the beginning of the last step.
    last: Option<(Truth, Vector3<f64>, f64)>,
}

impl TorpedoHull {
    /// The hull of a vehicle's file, with the mass of its URDF.
    pub(in crate::vehicles) fn build(
        source: &VehicleSource,
        spec: &TorpedoHullSpec,
        shell: &Shell,
        told: &mut Vec<String>,
    ) -> Result<Self, RobotError> {
        source.file.has_only_terms().map_err(|problem| source.wrong(problem))?;
        let water = &source.file.hydrodynamics;
        let c = Coefficients::new(spec, water.density_kg_m3.get(), water.gravity_m_s2.get());
        let c = c.map_err(|problem| source.wrong(problem))?;
        let fault = |problem: String| source.urdf.fault(problem);
        for drive in NamedDrive::fins() {
            ensure(shell.links.contains_key(&drive.name), || format!("link \"{}\" is missing", drive.name))
                .map_err(fault)?;
        }
        let (c, differs) = shell.ballast.put_into(&shell.body, &c).map_err(fault)?;
        told.extend(differs);
        let propeller = propeller(&c).map_err(|e| source.wrong(format!("hydrodynamics.terms.propeller: {e}")))?;
        let equation = Equation::new(c.body()).expect("its mass is near that of a spheroid in water");
        let mut hull = Self { c, equation, propeller, top_speed_m_s: 0.0, actuators: Actuators::default(), last: None };
        hull.top_speed_m_s = hull.run_up(f64::MAX);
        Ok(hull)
    }

    /// Greatest speed from rest in a minute with the propeller at `rpm`, m/s.
    fn run_up(&self, rpm: f64) -> f64 {
        let mut hull = self.clone();
        let water = WaterSample {
            velocity: Vector3::zeros(),
            gradient: Matrix3::zeros(),
            rate: Vector3::zeros(),
            density_kg_m3: SEA_WATER_KG_M3,
        };
        let ahead = ActuatorCommand { rpm, ..ActuatorCommand::default() };
        let level = Pose::level(Vector3::new(0.0, 0.0, -10.0), Heading::from_deg(0.0));
        let mut truth = Truth::at_rest(level);
        let mut top: f64 = 0.0;
        for _ in 0..(RUN_UP_S / STEP_S) as u32 {
            truth = hull.sail(&truth, &water, &ahead, STEP_S);
            // Held on its line: a heel or a turn would cost speed that a helmsman would not lose.
            truth.pose = level;
            truth.v_WB_B = Vector3::new(truth.v_WB_B.x, 0.0, 0.0);
            truth.w_WB_B = Vector3::zeros();
            top = top.max(truth.v_WB_B.x);
        }
        top
    }

    fn sail(&mut self, truth: &Truth, water: &WaterSample, command: &ActuatorCommand, dt_s: f64) -> Truth {
        let terms = TorpedoTerms { c: &self.c, asked: Actuators::asked(command, &self.c) };
        let (free, actuators) = self.equation.advance(&terms, truth, &self.actuators, water, dt_s);
        self.actuators = actuators;
        self.last = Some((*truth, water.velocity, water.density_kg_m3));
        free
    }
}

/// Thrust of the propeller in still water by rpm, and the moment of its shaft for each N.
fn propeller(c: &Coefficients) -> Result<DriveEffect, String> {
    let p = &c.spec.propeller;
    let (d, most) = (p.diameter_m.get(), p.limit_rpm.get());
    let newtons = p.thrust_share.get() * c.ballast_density_kg_m3 * d * d * d * d * c.thrust[0] / 3600.0;
    let rpm = |v: f64| Finite::new(v);
    let curve = table(&CurveSpec::Polynomial((Finite::try_from(newtons)?, rpm(0.0), rpm(-most), rpm(most))))?;
    let torque_m = p.torque_share.get() * d * c.torque[0] / (p.thrust_share.get() * c.thrust[0]);
    Ok(DriveEffect::Pushes(wrench((Vector3::x(), Vector3::x() * torque_m)), curve))
}

impl Motion for TorpedoHull {
    fn control(&self) -> Control {
        Control::Fins
    }

    fn capabilities(&self, turn_radius_m: f64) -> Capabilities {
        Capabilities {
            least_speed_m_s: self.c.spec.fins.least_speed_m_s.get(),
            top_speed_m_s: self.top_speed_m_s,
            turning_radius_m: turn_radius_m,
            ..Capabilities::default()
        }
    }

    fn top_speed_m_s(&self, rpm: f64) -> f64 {
        if rpm < self.c.spec.propeller.limit_rpm.get() { self.run_up(rpm) } else { self.top_speed_m_s }
    }

    fn idle(&self) -> Actuation {
        Actuation::Fins(ActuatorCommand::default())
    }

    fn drives(&self) -> Vec<VehicleDrive> {
        let c = &self.c;
        // Force of 1 rad at 1 m/s and 1 kg/m³: a positive rudder pushes the tail to port, a stern plane pushes it up.
        let lifts = |slope: Positive, way: Vector3<f64>| {
            let force = way * (c.spec.fins.area_m2.get() * slope.get());
            DriveEffect::Lifts(wrench((force, Vector3::new(c.fin_x_m, 0.0, 0.0).cross(&force))))
        };
        let (fin, rpm) = (c.fin_limit_rad, c.spec.propeller.limit_rpm.get());
        let fitted = [
            (fin, Vector3::y(), lifts(c.spec.fins.rudder_slope, -Vector3::y())),
            (fin, Vector3::z(), lifts(c.spec.fins.stern_slope, -Vector3::z())),
            (rpm, Vector3::x(), self.propeller.clone()),
        ];
        let drive = |(named, (most, way, does)): (NamedDrive, (f64, Vector3<f64>, DriveEffect))| VehicleDrive {
            named,
            limits: [-most, most],
            way,
            does,
        };
        NamedDrive::fins().into_iter().zip(fitted).map(drive).collect()
    }

    fn states(&self) -> Vec<f64> {
        vec![self.actuators.rudder_rad, self.actuators.stern_rad, self.actuators.rpm]
    }

    /// That of its propeller in the last step.
    fn power_w(&self) -> f64 {
        let Some((truth, water_m_s, density_kg_m3)) = &self.last else {
            return 0.0;
        };
        let through = truth.v_WB_B - truth.pose.R_WB.inverse() * water_m_s;
        let [v_ground, v] = [truth.v_WB_B, through].map(|v| Vector3::new(v.x, -v.y, -v.z));
        let terms = TorpedoTerms { c: &self.c, asked: self.actuators };
        let shaft_w = terms.shaft_w(&v_ground, &v, *density_kg_m3, self.actuators.rpm);
        shaft_w / self.c.spec.propeller.shaft_share.get()
    }

    fn inertia(&self) -> Inertia {
        Inertia {
            p_BG: Vector3::new(0.0, 0.0, -self.c.z_g_m),
            mass: self.equation.whole_mass_flu(),
            without_momentum: false,
        }
    }

    fn statics(&self) -> Option<Statics> {
        Some(Statics::new(&self.equation, self.c.ballast_density_kg_m3, false))
    }

    fn coefficients(&self) -> Option<&Coefficients> {
        Some(&self.c)
    }

    fn step_in(&mut self, truth: &Truth, water: &WaterSample, set: &Actuation, dt_s: f64) -> Truth {
        match set {
            Actuation::Fins(set) => self.sail(truth, water, set, dt_s),
            other => foreign(other),
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::error::RobotError;
    use crate::vehicles::{InMemory, ShippedVehicle, Vehicle, VehicleSpec};

    /// At full ahead a REMUS 100 of the published model makes some 2.5 m/s: 1000 rpm for 1.674 m/s, 1525 rpm at most.
    #[test]
    fn full_ahead_follows_from_thrust_and_drag() {
        let vehicle = Vehicle::load(&VehicleSpec::default(), &InMemory::default()).unwrap();
        let cruise = vehicle.top_speed_m_s(1000.0);
        assert!((cruise - 1.674).abs() < 0.05, "{cruise}");
        let top = vehicle.top_speed_m_s(1e6);
        assert!((top - 1.674 * 1.525).abs() < 0.08, "{top}");
        assert_eq!(top, vehicle.top_speed_m_s(1525.0));
    }

    /// The REMUS's folder as a user's own, with a word changed.
    fn own(from: &str, to: &str) -> Result<Vehicle, RobotError> {
        let remus = ShippedVehicle::named("remus100").expect("it is shipped");
        assert!(remus.file.contains(from), "{from}");
        let files = InMemory::default()
            .with("my_auv/vehicle.ron", remus.file.replacen(from, to, 1).as_bytes())
            .with("my_auv/remus100.urdf", remus.urdf.1.as_bytes());
        Vehicle::load(&VehicleSpec::File("my_auv".into()), &files)
    }

    #[test]
    fn a_folder_of_ones_own_can_have_these_terms() {
        let remus = Vehicle::load(&VehicleSpec::default(), &InMemory::default()).unwrap();
        let same = own("", "").unwrap();
        assert_eq!(same.coefficients(), remus.coefficients());
        assert_eq!((same.name(), same.doubts()), ("REMUS 100", &[][..]));
        let published = own("area_share: 0.7,", "area_share: 0.7, published: true,").unwrap();
        assert!(published.coefficients().unwrap().spec.published);
        let slow = own("limit_rpm: 1525", "limit_rpm: 1000").unwrap();
        assert!((slow.top_speed_m_s(f64::MAX) - 1.674).abs() < 0.05);
        for (from, to, why) in [
            ("diameter_m: 0.19", "diameter_m: 1.6", "hydrodynamics.terms.diameter_m: must be less than the length"),
            (
                "density_kg_m3: 1026,",
                "density_kg_m3: 1026, floats: true,",
                "must be left out, because hydrodynamics.terms has its own",
            ),
            ("urdf:", "autopilot: Torpedo(), urdf:", "must be left out, because hydrodynamics.terms has its own"),
            ("lag_s: 0.1", "lag_s: 0.001", "must take 0.04 s at least, for steps of 0.1 s follow nothing quicker"),
            ("diameter_m: 0.14", "diameter_m: 1e6", "hydrodynamics.terms.propeller: must be from -1e18 to 1e18"),
            ("length_m: 1.6", "length_m: 1.7", "link \"base_link\": <mass> is 31.029385 kg"),
            ("terms: Torpedo(", "terms: Blocks, volume_m3: 1, other: (", "other"),
        ] {
            let said = own(from, to).expect_err(to).to_string();
            assert!(said.starts_with("my_auv/") && said.contains(why), "{said}");
        }
    }
}
