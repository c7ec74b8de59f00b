//! Finds readings of an instrument of another crate that say nothing.

use super::{ChemicalReading, Readings};

/// No reading of an instrument is greater.
const MOST: f64 = 1e9;

impl Readings {
    /// The first field that is no number, and what it is.
    pub fn fault(&self) -> Option<String> {
        let number = |field: &str, values: &[f64]| {
            let wrong = values.iter().find(|v| !(v.abs() <= MOST))?;
            Some(format!("`{field}` must be within ±{MOST}, got {wrong}"))
        };
        let chemical = |name: &str, c: &ChemicalReading| {
            let share = (!(0.0..=1.0).contains(&c.of_full_scale)).then(|| {
                let got = c.of_full_scale;
                format!("`{name}.of_full_scale` must be from 0 to 1, got {got}")
            });
            number(&format!("{name}.volts"), &[c.volts]).or(share)
        };
        let sides = || self.sides.as_ref()?.iter().find_map(|c| chemical("sides", c));
        let attitude = || {
            let a = self.attitude?;
            let [x, y, z]: [f64; 3] = a.rates_rad_s.into();
            let values = [a.heading.rad(), a.roll_rad, a.pitch_rad, x, y, z];
            number("attitude", &values)
        };
        let ctd = || {
            let c = self.ctd?;
            let light = (!(c.density_kg_m3 > 0.0)).then(|| {
                let got = c.density_kg_m3;
                format!("`ctd.density_kg_m3` must be above 0, got {got}")
            });
            light.or_else(|| number("ctd", &[c.density_kg_m3, c.below_m]))
        };
        let adcp = || {
            let a = self.adcp.filter(|a| a.valid)?;
            let velocity = number("adcp.v_body_m_s", a.v_body_m_s.as_slice());
            velocity.or_else(|| number("adcp.above_m", &[a.above_m]))
        };
        let ranging = || {
            let scan = self.ranging.as_ref()?;
            let place = number("ranging.p_BS", scan.p_BS.as_slice());
            let range = || number("ranging.max_m", &[scan.max_m]);
            let beams = || {
                scan.beams.iter().find_map(|b| {
                    let dir = number("ranging.beams.dir_B", b.dir_B.as_slice());
                    dir.or_else(|| number("ranging.beams.echo_m", b.echo_m.as_slice()))
                })
            };
            place.or_else(range).or_else(beams)
        };
        let sidescan = || {
            let ping = self.sidescan.as_ref()?;
            let place = number("sidescan.p_BS", ping.p_BS.as_slice());
            let echo = |db: &f32| number("sidescan.port_db, starboard_db", &[f64::from(*db)]);
            let both = || ping.port_db.iter().chain(ping.starboard_db.iter());
            (place.or_else(|| number("sidescan.max_m", &[ping.max_m]))).or_else(|| both().find_map(echo))
        };
        let picture = || {
            let p = self.picture.as_ref()?;
            let place = number("picture.p_BC", p.p_BC.as_slice());
            let turned = || number("picture.R_BC", p.R_BC.coords.as_slice());
            place.or_else(turned).or_else(|| number("picture.view_rad", &[p.view_rad]))
        };
        let other = || (self.other.iter()).find_map(|(name, value)| number(name, &[*value]));
        let dvl = self.dvl.filter(|d| d.valid);
        let altimeter = self.altimeter.filter(|a| a.valid);
        (self.chemical.as_ref().and_then(|c| chemical("chemical", c)))
            .or_else(sides)
            .or_else(|| number("dvl.v_body_m_s", dvl?.v_body_m_s.as_slice()))
            .or_else(adcp)
            .or_else(attitude)
            .or_else(|| number("depth.depth_m", &[self.depth?.depth_m]))
            .or_else(ctd)
            .or_else(|| number("altimeter.altitude_m", &[altimeter?.altitude_m]))
            .or_else(|| number("lbl.position", self.lbl?.position.as_slice()))
            .or_else(ranging)
            .or_else(sidescan)
            .or_else(picture)
            .or_else(other)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::handoff::{AltimeterReading, DepthReading, LblFix};
    use nalgebra::Vector2;

    #[test]
    fn the_field_that_is_no_number_is_named() {
        let nan = f64::NAN;
        let chemical = |volts, of_full_scale| Some(ChemicalReading { volts, of_full_scale, detected: false });
        let altimeter = |altitude_m, valid| Some(AltimeterReading { altitude_m, valid });
        let position = Vector2::new(0.0, f64::INFINITY);
        let sides = chemical(1.0, 0.5).zip(chemical(1.0, nan)).map(Into::into);
        let all: [(Readings, &str); 9] = [
            (Readings { sides, ..Readings::default() }, "`sides.of_full_scale`"),
            (Readings { chemical: chemical(nan, 0.5), ..Readings::default() }, "`chemical.volts`"),
            (Readings { chemical: chemical(1.0, 1e9), ..Readings::default() }, "`chemical.of_full_scale`"),
            (Readings { depth: Some(DepthReading { depth_m: nan }), ..Readings::default() }, "`depth.depth_m`"),
            (Readings { altimeter: altimeter(nan, true), ..Readings::default() }, "`altimeter.altitude_m`"),
            // What is said to be of no use is not used.
            (Readings { altimeter: altimeter(nan, false), ..Readings::default() }, ""),
            (Readings { lbl: Some(LblFix { position }), ..Readings::default() }, "`lbl.position`"),
            (Readings { other: vec![("pressure_pa", nan)], ..Readings::default() }, "`pressure_pa`"),
            (Readings { chemical: chemical(1.0, 0.5), ..Readings::default() }, ""),
        ];
        for (readings, field) in all {
            let told = readings.fault().unwrap_or_default();
            assert!(told.starts_with(field) && told.is_empty() == field.is_empty(), "{told}");
        }
    }
}
