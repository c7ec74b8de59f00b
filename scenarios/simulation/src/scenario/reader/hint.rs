//! What may stand in a place, in words, and what to write there.

use crate::shape::{Field, Number, Reference, Shape, Text, Variant};
use world::limits::shown;
use world::ranges::LARGEST;

/// The kind of value that belongs in a place.
pub(super) fn kind(legal: &Reference, shape: &Shape) -> String {
    match legal.resolved(shape) {
        Shape::Number(Number { whole: Some(_), .. }) => "a whole number".to_string(),
        Shape::Number(_) => "a number".to_string(),
        Shape::Text(_) => "a text in quotes".to_string(),
        Shape::Truth => "true or false".to_string(),
        Shape::List(_) => "a list in square brackets".to_string(),
        Shape::Tuple(parts) => format!("{} values in parentheses", parts.len()),
        Shape::Choice(_) => "the name of a choice".to_string(),
        Shape::Fields(_) | Shape::Named(_) => "fields in parentheses".to_string(),
    }
}

/// What to do about a value of another kind.
pub(super) fn instead(legal: &Reference, shape: &Shape) -> Option<String> {
    match legal.resolved(shape) {
        Shape::Number(n) => range(n, 0.0),
        Shape::Text(t) => t.legal.as_ref().map(|words| format!("must be {words}")),
        Shape::Fields(_) | Shape::Tuple(_) => Some(format!("write `{}`", form(legal, shape))),
        _ => None,
    }
}

/// The legal values of a missing field, unless what to write says it all.
pub(super) fn values(legal: &Reference, shape: &Shape) -> Option<String> {
    match legal.resolved(shape) {
        Shape::Number(n @ Number { whole: Some(_), .. }) => range(n, 0.0),
        Shape::Choice(variants) => Some(format!("one of {}", names(variants).join(", "))),
        Shape::Fields(_) | Shape::Tuple(_) => None,
        other => {
            let range = instead(legal, other).map_or(String::new(), |range| format!(", {range}"));
            Some(kind(legal, other) + &range)
        }
    }
}

/// What to write in a place: parentheses and the fields that must be given.
pub(super) fn form(legal: &Reference, shape: &Shape) -> String {
    match legal.resolved(shape) {
        Shape::Fields(fields) => {
            let required = fields.iter().filter(|f| f.required);
            let fields = required.map(|f| format!("{}: {}", f.name, form(legal, &f.shape)));
            format!("({})", fields.collect::<Vec<_>>().join(", "))
        }
        Shape::Tuple(parts) => format!("({})", vec!["..."; parts.len()].join(", ")),
        _ => "...".to_string(),
    }
}

/// The whole numbers of a range.
pub(super) fn whole(least: i128, most: i128) -> String {
    if most == i128::from(u64::MAX) {
        return format!("a whole number, {least} or greater");
    }
    format!("a whole number from {least} to {most}")
}

/// The range of a number that must contain `v`; `None` if every number is legal.
pub(super) fn range(n: &Number, v: f64) -> Option<String> {
    if let Some((least, most)) = n.whole {
        return Some(whole(least, most));
    }
    // The ends of all numbers are said only to those who are beyond them.
    let near = v.abs() <= LARGEST;
    let low = n.low.filter(|low| !near || *low > -LARGEST);
    let high = n.high.filter(|high| !near || *high < LARGEST);
    let unit = if n.unit.is_empty() { String::new() } else { format!(" {}", n.unit) };
    if let (Some(low), Some(high)) = (low, high) {
        return Some(format!("must be from {} to {}{unit}", shown(low), shown(high)));
    }
    let sign = |sign: &str, end: Option<f64>| end.map(|end| format!("{sign} {}", shown(end)));
    let least = sign(">", n.above).or(sign(">=", low));
    let most = sign("<", n.below).or(sign("<=", high));
    let ends: Vec<String> = least.into_iter().chain(most).collect();
    (!ends.is_empty()).then(|| format!("must be {}{unit}", ends.join(" and ")))
}

/// The rule that a text breaks.
pub(super) fn refused(t: &Text, text: &str) -> Option<String> {
    if let Some(longest) = t.longest.filter(|longest| text.chars().count() as u64 > *longest) {
        return Some(format!("must have at most {longest} characters, got {}", text.chars().count()));
    }
    let pattern = t.pattern.as_ref()?;
    let fits = regex::Regex::new(pattern).is_ok_and(|pattern| pattern.is_match(text));
    (!fits).then(|| match &t.legal {
        Some(words) => format!("must be {words}"),
        None => format!("must be text like {pattern}"),
    })
}

/// The names of variants, without that of a bare number.
pub(super) fn names(variants: &[Variant]) -> Vec<&str> {
    variants.iter().map(|v| v.name.as_str()).filter(|name| *name != "number").collect()
}

/// The names of fields.
pub(super) fn fields(fields: &[Field]) -> Vec<&str> {
    fields.iter().map(|f| f.name.as_str()).collect()
}
