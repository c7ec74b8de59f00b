//! Units of fields: from the end of their names, or from the tables here if the name has none.

use crate::shape::Object;
use serde_json::Value;
use world::limits::UNIT;

/// Ends of names and their units. An end is the whole name or follows an underscore; the longest one that fits counts.
const ENDS: &[(&str, &str)] = &[
    ("1_s", "1/s"),
    ("candela", "cd"),
    ("db", "dB"),
    ("db_m", "dB/m"),
    ("deg", "degrees"),
    ("deg_m", "degrees/m"),
    ("deg_m_s", "degrees/(m s)"),
    ("deg_s", "degrees/s"),
    ("e", "electrons"),
    ("electrons_per_lux_s", "electrons/(lx s)"),
    ("g_s", "g/s"),
    ("h", "h"),
    ("hz", "1/s"),
    ("kg", "kg"),
    ("kg_m3", "kg/m3"),
    ("klux", "klx"),
    ("m", "m"),
    ("m2", "m2"),
    ("m2_kg", "m2/kg"),
    ("m2_s", "m2/s"),
    ("m3", "m3"),
    ("m3_s", "m3/s"),
    ("m_rts", "m/s^0.5"),
    ("m_s", "m/s"),
    ("m_s2", "m/s2"),
    ("nat", "nat"),
    ("per_m", "1/m"),
    ("per_s", "1/s"),
    ("rad_s", "rad/s"),
    ("rpm", "rpm"),
    ("rpm_limit", "rpm"),
    ("rpm_m", "rpm/m"),
    ("rpm_per_speed", "rpm s/m"),
    ("s", "s"),
    ("ug_l", "ug/L"),
    ("v", "V"),
    ("w", "W"),
    ("w_n", "W/N"),
    ("wh", "Wh"),
];

/// Fields that have a paper's name, by type.
const NAMED: &[(&str, &str, &str)] = &[
    ("ColourSpec", "alpha1", "levels of 255"),
    ("ColourSpec", "alpha2", "levels of 255"),
    ("ColourSpec", "delta1", "levels of 255"),
    ("ColourSpec", "delta2", "levels of 255"),
    ("ColourSpec", "epsilon", "levels of 255"),
    ("ColourSpec", "rho_m", "levels of 255"),
    ("CredibleAreaParams", "below", "m2, in space m3"),
    ("FinSpec", "lift_slope", "1/rad"),
    ("RouteSpec", "points", "m"),
    ("TorpedoFinsSpec", "rudder_slope", "1/rad"),
    ("TorpedoFinsSpec", "stern_slope", "1/rad"),
];

/// Numbers in the parentheses of a variant, by type and name.
const VARIANTS: &[(&str, &str, &str)] = &[
    ("Base", "Depth", "m"),
    ("Base", "Z", "m"),
    ("Block", "Diagonal", "units of the block"),
    ("Block", "Full", "units of the block"),
    ("CurveSpec", "Newtons", "N"),
    ("CurveSpec", "Polynomial", "N and unit of the input"),
    ("CurveSpec", "Table", "unit of the input and N"),
    ("DriveFault", "StuckAt", "degrees, of a propeller rpm"),
    ("VerticalSpec", "Altitude", "m"),
    ("VerticalSpec", "Depth", "m"),
    ("ZoneSize", "Fixed", "m"),
];

/// Puts units into the schema of a type.
pub(super) fn add_units(of: &str, schema: &mut Object) {
    if let Some(Value::Object(fields)) = schema.get_mut("properties") {
        for (name, field) in fields {
            if let Some(unit) = of_field(of, name) {
                put_on(field, unit);
            }
        }
    }
    if let Some(Value::Array(variants)) = schema.get_mut("oneOf") {
        for variant in variants {
            let Some(Value::Object(held)) = variant.get_mut("properties") else {
                continue;
            };
            for (name, held) in held {
                if let Some(unit) = stated(VARIANTS, of, name) {
                    put_on(held, unit);
                }
            }
        }
    }
}

fn of_field(of: &str, name: &str) -> Option<&'static str> {
    let fits = |end: &str| name.strip_suffix(end).is_some_and(|s| s.is_empty() || s.ends_with('_'));
    let ends = ENDS.iter().filter(|(end, _)| fits(end));
    let by_name = ends.max_by_key(|(end, _)| end.len()).map(|(_, unit)| *unit);
    stated(NAMED, of, name).or(by_name)
}

fn stated(table: &[(&str, &str, &'static str)], of: &str, name: &str) -> Option<&'static str> {
    let row = table.iter().find(|row| (row.0, row.1) == (of, name));
    row.map(|row| row.2)
}

/// On every number of a field; a limit has said its own.
fn put_on(field: &mut Value, unit: &str) {
    numbers(field, &mut |number| {
        number.entry(UNIT).or_insert_with(|| unit.into());
    });
}

/// Every number, whole ones apart, that stands in a field itself and not in a type it names.
fn numbers(field: &mut Value, seen: &mut dyn FnMut(&mut Object)) {
    let Some(field) = field.as_object_mut() else {
        return;
    };
    let is_number = match field.get("type") {
        Some(Value::Array(kinds)) => kinds.iter().any(|k| k == "number"),
        kind => kind.is_some_and(|k| k == "number"),
    };
    if is_number {
        seen(field);
    }
    for inner in ["items", "prefixItems", "anyOf"] {
        match field.get_mut(inner) {
            Some(Value::Array(parts)) => parts.iter_mut().for_each(|part| numbers(part, seen)),
            Some(part) => numbers(part, seen),
            None => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::explain::schema::schema;
    use crate::shape::VEHICLE;
    use std::collections::BTreeSet;
    use world::registry::Registry;

    /// Shares, factors, weights, coefficients.
    const PURE: &str = "\
        Weak added_roll advance_ratio albedo area_share bed_albedo bed_texture centre_weight clearance_weight \
        climb contrast contrast_left coverage cross_flow damping discount drag_0 dropout errors f_number factor \
        false_detection fix_gain flicker frontal_drag least least_contrast least_dye least_red least_redness \
        least_source lost_below max_gain mean_cosine merge missed mixing most_dye most_edge most_share \
        most_source most_yellow mu peakedness pitch_damping pitch_gain plate prediction_error probability pull \
        push quantum_yield ratio reach reject_at resample_below roll_damping roughening salinity saturation \
        scale_error shaft_share share silence soft_edge span_efficiency spreading stern_per_pitch strengths \
        stretch structure target texture threshold thrust thrust_share torque torque_share transverse verify_at \
        volume_share wake_share white_balance";

    #[test]
    fn every_number_has_a_unit_or_is_known_to_have_none() {
        let mut whole = schema(&Registry::default(), &[VEHICLE]);
        let types = whole["$defs"].as_object_mut().unwrap();
        let stated: BTreeSet<String> = PURE.split_whitespace().map(str::to_string).collect();
        let mut pure = BTreeSet::new();
        for (of, schema) in types {
            let mut look = |name: &str, field: &mut Value| {
                numbers(field, &mut |number| {
                    if !number.contains_key(UNIT) {
                        assert!(stated.contains(name), "{of}.{name} has no unit: see explain/units.rs");
                        pure.insert(name.to_string());
                    }
                });
            };
            let fields = schema.get_mut("properties").and_then(Value::as_object_mut);
            fields.into_iter().flatten().for_each(|(name, field)| look(name, field));
            let variants = schema.get_mut("oneOf").and_then(Value::as_array_mut);
            for variant in variants.into_iter().flatten() {
                let held = variant.get_mut("properties").and_then(Value::as_object_mut);
                held.into_iter().flatten().for_each(|(name, held)| look(name, held));
            }
        }
        assert_eq!(pure, stated, "stated to be pure numbers, and found to be");
    }

    #[test]
    fn the_longest_end_of_a_name_holds() {
        for (field, unit) in [("speed_m_s", Some("m/s")), ("t_s", Some("s")), ("hz", Some("1/s")), ("turns", None)] {
            assert_eq!(of_field("AnySpec", field), unit);
        }
        assert_eq!(of_field("ColourSpec", "rho_m"), Some("levels of 255"));
    }
}
