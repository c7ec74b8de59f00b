//! Words for kinds of values, ranges and defaults.

use crate::shape::{Field, Number, Reference, Shape, Text};
use serde_json::Value;
use world::limits::shown;
use world::ranges::LARGEST;

/// The legal range; empty if every number is legal.
pub(super) fn range(n: &Number) -> String {
    let low = n.low.filter(|v| *v > -LARGEST);
    let high = n.high.filter(|v| *v < LARGEST);
    if let (Some(low), Some(high)) = (low, high)
        && low == high
    {
        return shown(low);
    }
    let least = n.above.map(|v| format!("> {}", shown(v)));
    let most = n.below.map(|v| format!("< {}", shown(v)));
    match (least.or(low.map(shown)), most.or(high.map(shown))) {
        (Some(least), Some(most)) => format!("{least} to {most}"),
        (Some(least), None) if n.above.is_some() => least,
        (Some(least), None) => format!(">= {least}"),
        (None, Some(most)) if n.below.is_some() => most,
        (None, Some(most)) => format!("<= {most}"),
        (None, None) => String::new(),
    }
}

/// What may stand in a place. `link` makes text of the name of a type.
pub(super) fn kind(r: &Reference, shape: &Shape, link: &dyn Fn(&str) -> String) -> String {
    match shape {
        Shape::Named(name) => match &r.types[name].shape {
            Shape::Fields(_) | Shape::Choice(_) => link(name),
            other => kind(r, other, link),
        },
        Shape::Number(n) => {
            let unit = match (n.unit.as_str(), n.whole.is_some()) {
                ("", true) => "whole number",
                ("", false) => "number",
                (unit, _) => unit,
            };
            joined(&[unit, &range(n)])
        }
        Shape::Text(Text { pattern: None, .. }) => "text".to_string(),
        Shape::Text(Text { pattern: Some(pattern), .. }) => format!("text like {pattern}"),
        Shape::Truth => "true or false".to_string(),
        Shape::List(of) => format!("list of {}", kind(r, of, link)),
        Shape::Tuple(parts) => {
            let parts: Vec<String> = parts.iter().map(|p| kind(r, p, link)).collect();
            match parts.split_first() {
                Some((first, rest)) if rest.iter().all(|p| p == first) => {
                    format!("{} times {first}", parts.len())
                }
                _ => format!("({})", parts.join("; ")),
            }
        }
        Shape::Fields(_) => "fields".to_string(),
        Shape::Choice(variants) => {
            let names: Vec<&str> = variants.iter().map(|v| v.name.as_str()).collect();
            names.join(" | ")
        }
    }
}

/// The value if a field is left out.
pub(super) fn default(r: &Reference, field: &Field) -> Option<String> {
    match &field.default {
        None | Some(Value::Null) => None,
        Some(value) => Some(ron(r, &field.shape, value)),
    }
}

/// A value as a person writes it in RON; inner fields are written `(…)`.
pub(super) fn ron(r: &Reference, shape: &Shape, value: &Value) -> String {
    match (r.resolved(shape), value) {
        (_, Value::Null) => "None".to_string(),
        (Shape::Choice(_), Value::String(name)) => name.clone(),
        (Shape::Choice(variants), Value::Object(held)) => {
            let (name, held) = held.iter().next().map_or(("", &Value::Null), |(n, h)| (n, h));
            let of = variants.iter().find(|v| v.name == name).and_then(|v| v.holds.as_ref());
            match of.map(|of| ron(r, of, held)) {
                Some(inner) if inner.starts_with('(') => format!("{name}{inner}"),
                Some(inner) => format!("{name}({inner})"),
                None => name.to_string(),
            }
        }
        (_, Value::Object(_)) => "(…)".to_string(),
        (of, Value::Array(items)) => {
            let item = |(i, v): (usize, &Value)| match of {
                Shape::List(of) => ron(r, of, v),
                Shape::Tuple(parts) => parts.get(i).map_or_else(|| v.to_string(), |p| ron(r, p, v)),
                _ => v.to_string(),
            };
            let items: Vec<String> = items.iter().enumerate().map(item).collect();
            let (open, close) = if matches!(of, Shape::Tuple(_)) { ('(', ')') } else { ('[', ']') };
            format!("{open}{}{close}", items.join(", "))
        }
        (_, Value::Number(n)) => n.as_f64().map_or_else(|| n.to_string(), shown),
        (_, other) => other.to_string(),
    }
}

/// The parts that are not empty, separated by commas.
pub(super) fn joined(parts: &[&str]) -> String {
    let parts: Vec<&str> = parts.iter().copied().filter(|p| !p.is_empty()).collect();
    parts.join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_read_as_people_write_them() {
        let n = |low, above, high| range(&Number { low, above, high, ..Number::default() });
        assert_eq!(n(None, Some(0.0), Some(LARGEST)), "> 0");
        assert_eq!(n(Some(0.0), None, Some(LARGEST)), ">= 0");
        assert_eq!(n(Some(-LARGEST), None, Some(LARGEST)), "");
        assert_eq!(n(Some(1e-3), None, Some(1e6)), "0.001 to 1000000");
        assert_eq!(n(None, Some(0.0), Some(15.0)), "> 0 to 15");
        assert_eq!(n(Some(1.0), None, Some(1.0)), "1");
        let share = Number { above: Some(0.0), below: Some(0.5), ..Number::default() };
        assert_eq!(range(&share), "> 0 to < 0.5");
    }
}
