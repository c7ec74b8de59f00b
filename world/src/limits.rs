//! Physical ranges of fields, stated where a field is declared: `#[serde(with = "world::limits::density_kg_m3")]`. The
//! reader reports place, value and range, as it does for the types of [`crate::ranges`], which keep the sign; the schema
//! of scenario files, and with it `explain` and the reference, has the range and the unit. A field that holds something
//! else than the limit's own kind of number says so: `"world::limits::depth_m::<Option<Positive>>"`.
//!
//! A limit does not judge whether a value is good. It marks where the models end: no water, instrument or hull lies
//! beyond.

mod narrow;

pub use crate::ranges::shown;
pub use narrow::{Range, UNIT};

use crate::ranges::{Finite, Fraction, NonNegative, Positive};
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::{Deserialize, Deserializer, Serialize, Serializer, de::Error};
use std::borrow::Cow;
use std::marker::PhantomData;

/// What a field with a limit holds: a number, or several.
pub trait LimitedValue: Sized {
    /// The form in which it is read.
    type Raw;

    /// Accepts it if all numbers lie in a range, ends included.
    ///
    /// # Errors
    /// States the range and the number that is outside. For a wrong sign or NaN, the error of the number's own type.
    fn limited(raw: Self::Raw, range: &Range) -> Result<Self, String>;
}

macro_rules! one {
    ($($type:ty),*) => {$(
        impl LimitedValue for $type {
            type Raw = f64;
            fn limited(raw: f64, range: &Range) -> Result<Self, String> {
                let typed = Self::try_from(raw);
                // It is too large or too small for its type but has the right sign: the narrower range is the more
                // helpful message.
                let signed = raw.is_finite() && Self::try_from(raw.signum()).is_ok();
                match (range.refuses(raw), typed) {
                    (Some(said), Ok(_)) => Err(said),
                    (Some(said), Err(_)) if signed && raw != 0.0 => Err(said),
                    (_, typed) => typed,
                }
            }
        }
    )*};
}

one!(Finite, Fraction, NonNegative, Positive);

impl<T: LimitedValue> LimitedValue for Option<T> {
    type Raw = Option<T::Raw>;
    fn limited(raw: Self::Raw, range: &Range) -> Result<Self, String> {
        raw.map(|raw| T::limited(raw, range)).transpose()
    }
}

impl<T: LimitedValue> LimitedValue for (T, T) {
    type Raw = (T::Raw, T::Raw);
    fn limited((a, b): Self::Raw, range: &Range) -> Result<Self, String> {
        Ok((T::limited(a, range)?, T::limited(b, range)?))
    }
}

impl<T: LimitedValue> LimitedValue for (T, T, T) {
    type Raw = (T::Raw, T::Raw, T::Raw);
    fn limited((a, b, c): Self::Raw, range: &Range) -> Result<Self, String> {
        Ok((T::limited(a, range)?, T::limited(b, range)?, T::limited(c, range)?))
    }
}

macro_rules! limits {
    ($($(#[$doc:meta])* $name:ident: $low:expr, $high:expr, $unit:literal, $of:ident;)*) => {
        $(
        $(#[$doc])*
        #[expect(non_camel_case_types, reason = "named as fields are")]
        pub struct $name<T = $of>(PhantomData<T>);

        impl<T: LimitedValue> $name<T> {
            /// Reads a field.
            ///
            /// # Errors
            /// If it is no number, or out of range.
            pub fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<T, D::Error>
            where
                T::Raw: Deserialize<'de>,
            {
                T::limited(T::Raw::deserialize(from)?, &range::$name).map_err(D::Error::custom)
            }

            /// Writes a field as it is.
            ///
            /// # Errors
            /// Those of the format.
            pub fn serialize<S: Serializer>(value: &T, to: S) -> Result<S::Ok, S::Error>
            where
                T: Serialize,
            {
                value.serialize(to)
            }
        }

        impl<T: JsonSchema> JsonSchema for $name<T> {
            fn inline_schema() -> bool {
                true
            }

            fn schema_name() -> Cow<'static, str> {
                T::schema_name()
            }

            fn json_schema(generator: &mut SchemaGenerator) -> Schema {
                let mut schema = T::json_schema(generator);
                range::$name.narrow(&mut schema);
                schema
            }
        }
        )*

        /// The limits themselves, by name.
        #[expect(non_upper_case_globals, reason = "named as fields are")]
        pub mod range {
            use super::Range;
            $(
                $(#[$doc])*
                pub const $name: Range = Range($low, $high, $unit);
            )*
        }
    };
}

limits! {
    /// East or north of the datum, m: half way round the Earth. There filaments resolve positions to 2 m; 10 km from
    /// the datum, to 1 mm.
    place_m: -2e7, 2e7, "m", Finite;
    /// Size of something solid, m: from a pebble to an island.
    solid_m: 1e-3, 1e6, "m", Positive;
    /// Metres in one unit of a file.
    scale: 1e-9, 1e9, "m", Positive;
    /// A depth, height or thickness in the sea, m: the Challenger Deep has 10.9 km.
    depth_m: 1e-4, 12_000.0, "m", Positive;
    /// Roughness length of a bed, m.
    roughness_m: 1e-9, 10.0, "m", Positive;
    /// Roughness length of a bed, m; zero means a smooth bed.
    sand_m: 0.0, 10.0, "m", NonNegative;
    /// Density of water, kg/m³. The Dead Sea has 1240, brines have 1300; hot fresh water, the lightest, has 950.
    density_kg_m3: 900.0, 1400.0, "kg/m3", Positive;
    /// Kinematic viscosity of water, m²/s: 0.3e-6 when boiling, 1.8e-6 at the freezing point. Oil has 1e-4.
    viscosity_m2_s: 1e-7, 1e-4, "m2/s", Positive;
    /// Speed of a stream, m/s: the strongest tidal streams reach 10.
    stream_m_s: 0.0, 15.0, "m/s", NonNegative;
    /// Component of a stream's velocity, with its sign, m/s.
    component_m_s: -15.0, 15.0, "m/s", Finite;
    /// Speed of a stream that is not at rest, m/s.
    running_m_s: 1e-4, 15.0, "m/s", Positive;
    /// Standard deviation of a current, m/s.
    std_m_s: 0.0, 5.0, "m/s", NonNegative;
    /// Frequency of a current's fluctuation, rad/s: from months to a second.
    wander_rad_s: 1e-7, 6.0, "rad/s", Positive;
    /// Damping ratio of an oscillation.
    damping: 1e-3, 1.0, "", Positive;
    /// Horizontal diffusivity, m²/s: ocean eddies reach 1e4.
    diffusivity_m2_s: 0.0, 1e5, "m2/s", NonNegative;
    /// Vertical diffusivity, m²/s: deep convection reaches 10.
    vertical_m2_s: 0.0, 100.0, "m2/s", NonNegative;
    /// Diffusivity in units of friction velocity times depth: 0.15 in straight channels, 3 in rivers that bend.
    transverse: 0.0, 100.0, "", NonNegative;
    /// Height of surface waves, m; the highest measured waves had 30.
    wave_m: 1e-4, 40.0, "m", Positive;
    /// Period of surface waves, s: from ripples to the longest swell.
    wave_s: 0.05, 60.0, "s", Positive;
    /// Peak enhancement of a wave spectrum; measured values are 1 to 7.
    peakedness: 0.1, 20.0, "", Positive;
    /// Directional spreading of waves: 10 in a wind sea, 75 in a swell.
    spreading: 0.0, 1000.0, "", NonNegative;
    /// Mixing by waves, in units of the squared height divided by the period.
    wave_mixing: 0.0, 10.0, "", NonNegative;
    /// Amplitude of an internal wave, m.
    internal_m: 0.0, 1000.0, "m", NonNegative;
    /// Length of an internal wave, m.
    internal_length_m: 0.01, 1e7, "m", Positive;
    /// Period of an internal wave, s.
    internal_s: 0.01, 1e8, "s", Positive;
    /// Period of a tide, h.
    tide_h: 0.01, 1e6, "h", Positive;
    /// Mass that a source releases, g/s: from a picogram to a tonne.
    source_g_s: 1e-12, 1e6, "g/s", Positive;
    /// Size of a filament or of what releases it, m.
    filament_m: 1e-5, 1000.0, "m", Positive;
    /// Growth of a filament's squared size, m²/s.
    growth_m2_s: 0.0, 1000.0, "m2/s", NonNegative;
    /// Distance between the outermost probes of a head, m.
    span_m: 1e-3, 10.0, "m", Positive;
    /// Diameter of a nozzle, m.
    nozzle_m: 1e-5, 10.0, "m", Positive;
    /// Speed of the fluid that leaves a nozzle, m/s.
    nozzle_m_s: 1e-4, 100.0, "m/s", Positive;
    /// Length of the shortest waves of turbulence, m.
    eddy_m: 1e-5, 10.0, "m", Positive;
    /// Volume that a source releases, L/s.
    volume_l_s: 1e-9, 1e7, "L/s", Positive;
    /// Difference of density between a release and the water around, kg/m³.
    excess_kg_m3: -500.0, 500.0, "kg/m³", Finite;
    /// Practical salinity.
    salinity: 0.0, 42.0, "", NonNegative;
    /// Temperature of water, °C.
    water_c: -2.0, 40.0, "°C", Finite;
    /// Grams of a substance in a litre.
    solute_g_l: 1e-9, 1000.0, "g/L", Positive;
    /// Speed of a vehicle under water, m/s.
    vehicle_m_s: 0.0, 15.0, "m/s", Positive;
    /// Error of a position, m.
    error_m: 0.0, 1e5, "m", NonNegative;
    /// What a faulty instrument reads too much of a length, m.
    bias_m: -1e5, 1e5, "m", Finite;
    /// The same, growing.
    drift_m_s: -100.0, 100.0, "m/s", Finite;
    /// What a faulty compass turns a heading by.
    bias_deg: -180.0, 180.0, "degrees", Finite;
    /// The same, growing.
    drift_deg_s: -10.0, 10.0, "degrees/s", Finite;
    /// What a faulty instrument adds to a velocity in each second.
    drift_m_s2: -1.0, 1.0, "m/s2", Finite;
    /// What a faulty fluorometer reads too much.
    bias_ug_l: -1e6, 1e6, "ug/L", Finite;
    /// The same, growing.
    drift_ug_l_s: -1e4, 1e4, "ug/(L s)", Finite;
    /// What a faulty CTD adds to the density in each second.
    drift_kg_m3_s: -10.0, 10.0, "kg/(m3 s)", Finite;
    /// Range of a sonar, m.
    sonar_m: 0.01, 5000.0, "m", Positive;
    /// Turning radius of a vehicle, m.
    turn_m: 0.0, 10_000.0, "m", Positive;
    /// Least turning radius of a vehicle without dynamics, m.
    radius_m: 0.01, 10_000.0, "m", Positive;
    /// Greatest turn rate of a vehicle without dynamics, degrees/s: up to a turn in half a second.
    turn_deg_s: 0.01, 720.0, "degrees/s", Positive;
    /// Time constant of a vehicle's response, s; zero means at once.
    response_s: 0.0, 1000.0, "s", NonNegative;
    /// Distance that a planner looks ahead, m.
    look_m: 0.01, 1e5, "m", Positive;
    /// Spread of dye per square root of time, m/√s; 100 makes a kilometre in two minutes.
    spread_m_rts: 1e-6, 100.0, "m/s^0.5", Positive;
    /// How long something lasts, s: from a millisecond to 30 years.
    lasting_s: 1e-3, 1e9, "s", Positive;
    /// How long a run waits for an answer from outside, s of real time: from a millisecond to a day.
    answer_s: 1e-3, 86_400.0, "s", Positive;
    /// Speed of a propeller, rpm.
    rpm: -10_000.0, 10_000.0, "rpm", Finite;
    /// Greatest speed of a propeller, rpm.
    rpm_limit: 1.0, 10_000.0, "rpm", Positive;
    /// Angle of a fin, °.
    fin_deg: -90.0, 90.0, "degrees", Positive;
    /// Level of sound, dB.
    level_db: -300.0, 300.0, "dB", Finite;
    /// Distance that can be seen in water, m.
    visibility_m: 0.01, 1000.0, "m", Positive;
    /// Loss of light along its path, 1/m.
    loss_per_m: 0.0, 1000.0, "1/m", NonNegative;
}

#[cfg(test)]
mod tests {
    use super::*;

    const SPEED: Range = Range(0.0, 15.0, "m/s");
    const SIZE: Range = Range(1e-3, 1e6, "m");

    #[test]
    fn ends_are_legal_and_what_is_no_number_is_not() {
        let speed = |v: f64| NonNegative::limited(v, &SPEED).map(NonNegative::get);
        assert_eq!(speed(0.0), Ok(0.0));
        assert_eq!(speed(15.0), Ok(15.0));
        assert_eq!(speed(1e6), Err("must be from 0 to 15 m/s, got 1000000".into()));
        assert_eq!(speed(f64::NAN), Err("must be >= 0, got NaN".into()));
    }

    #[test]
    fn a_wrong_sign_is_said_by_the_type_and_a_wrong_size_by_the_limit() {
        let size = |v: f64| Positive::limited(v, &SIZE).unwrap_err();
        assert_eq!(size(1e200), "must be from 0.001 to 1000000 m, got 1e200");
        assert_eq!(size(5e-324), "must be from 0.001 to 1000000 m, got 5e-324");
        assert_eq!(size(-1.0), "must be > 0, got -1");
        assert_eq!(size(-2e274), "must be > 0, got -2e274");
        assert_eq!(size(0.0), "must be > 0, got 0");
        assert_eq!(size(f64::INFINITY), "must be > 0, got inf");
    }

    #[test]
    fn every_number_of_a_pair_is_looked_at() {
        type Pair = (Positive, Positive);
        assert!(Pair::limited((1.0, 2.0), &SIZE).is_ok());
        assert!(Pair::limited((1.0, 1e9), &SIZE).is_err());
        assert!(<Option<Finite>>::limited(Some(3e7), &SIZE).is_err());
        assert_eq!(<Option<Positive>>::limited(None, &SIZE), Ok(None));
    }

    #[test]
    fn numbers_are_shown_as_people_write_them() {
        let all = [0.0, 15.0, 1e-6, 0.05, 1e154, -2e7].map(shown);
        assert_eq!(all, ["0", "15", "1e-6", "0.05", "1e154", "-2e7"]);
    }
}
