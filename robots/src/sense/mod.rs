//! Instruments: the truth seen through noise, rate and range. One file each; the suite reads them all.

mod adcp;
mod altimeter;
mod camera;
mod catalogue;
mod compass;
mod ctd;
mod depth;
mod dvl;
mod fluorometer;
mod fluorometers_aside;
mod lbl;
mod on_board;
mod probe;
mod ranging;
mod sensor;
mod sidescan;
mod suite;
#[cfg(test)]
pub(crate) mod testing;
mod tools;

pub use adcp::{Adcp, AdcpSpec, Look};
pub use altimeter::{Altimeter, AltimeterSpec};
pub use camera::Camera;
pub use camera::spec::{CameraSpec, LampSpec, SensorSpec, looking, turned};
pub use catalogue::PARTS;
pub use compass::{Compass, CompassSpec};
pub use ctd::{Ctd, CtdSpec};
pub use depth::{Depth, DepthSpec};
pub use dvl::{Dvl, DvlSpec};
pub use fluorometer::{Fluorometer, FluorometerSpec};
pub use fluorometers_aside::FluorometersAsideSpec;
pub use lbl::{Lbl, LblSpec};
pub use on_board::OnBoard;
pub use probe::{Probes, ProbesSpec, TIP_M};
pub use ranging::{Ranging, RangingSpec};
pub use sensor::{Fitting, Imaging, Sensor, SensorParams, SensorRequests, Surroundings};
pub use sidescan::{Sidescan, SidescanSpec};
pub use suite::{SensorSuite, Sensors, SensorsSpec, cost};
pub use tools::EchoTarget;
