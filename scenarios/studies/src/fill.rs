//! Texts in braces: what a family gives its searchers, and what is drawn for a seed.

/// A text with `{name}` replaced by what is given by this name, and `{0.5 name}` by half of it. What stands in braces
/// and is a path that is `drawn` stays as it is.
///
/// # Errors
/// The text in braces for which nothing is given, and what is.
pub(crate) fn fill(text: &str, given: &[(String, String)], drawn: &[&str]) -> Result<String, String> {
    let mut out = String::new();
    let mut rest = text;
    while let Some((before, after)) = rest.split_once('{') {
        out.push_str(before);
        let (inside, after) = after.split_once('}').ok_or_else(|| format!("`{{{after}`: there is no `}}`"))?;
        out.push_str(&one(inside, given, drawn)?);
        rest = after;
    }
    Ok(out + rest)
}

fn one(inside: &str, given: &[(String, String)], drawn: &[&str]) -> Result<String, String> {
    if drawn.contains(&inside) {
        return Ok(format!("{{{inside}}}"));
    }
    let value = |name: &str| given.iter().find(|(n, _)| n == name).map(|(_, value)| value);
    if let Some(value) = value(inside) {
        return Ok(value.clone());
    }
    if let Some((times, name)) = inside.split_once(' ')
        && let (Ok(times), Some(value)) = (times.parse::<f64>(), value(name))
    {
        let number: f64 = value.parse().map_err(|_| format!("`{{{inside}}}`: {name} is no number but {value}"))?;
        // A thousandth is finer than any length or speed that is scaled.
        return Ok(((times * number * 1000.0).round() / 1000.0).to_string());
    }
    let known: Vec<&str> = given.iter().map(|(name, _)| name.as_str()).chain(drawn.iter().copied()).collect();
    Err(format!("`{{{inside}}}` is not given; there are: {}", known.join(", ")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_numbers_and_paths() {
        let given = [("step", "24"), ("speed", "1.5"), ("declare", "AlongFlow(within_m: {0.5 step})")]
            .map(|(name, value)| (name.to_string(), value.to_string()));
        let of = |text: &str| fill(text, &given, &["sources[0].east_m"]);
        assert_eq!(of("Find(speed: {speed}, up_m: {0.75 step})").as_deref(), Ok("Find(speed: 1.5, up_m: 18)"));
        assert_eq!(of("({sources[0].east_m}, 1)").as_deref(), Ok("({sources[0].east_m}, 1)"));
        assert_eq!(of("no braces").as_deref(), Ok("no braces"));
        for (text, says) in [
            ("{map}", "`{map}` is not given; there are: step, speed, declare, sources[0].east_m"),
            ("{2 declare}", "declare is no number"),
            ("{speed", "there is no `}`"),
        ] {
            let said = of(text).unwrap_err();
            assert!(said.contains(says), "{said}");
        }
    }
}
