//! Changes the value at a path in a scenario's text. The rest stays word for word, including comments.

use super::reader::outline::Outline;

/// Puts `value` (RON) at `path`. A field that the text leaves to its default is added.
///
/// # Errors
/// What is wrong with path or value. Whether the scenario allows the value is for its reader to say.
pub fn set_value(text: &str, path: &str, value: &str) -> Result<String, String> {
    let value = value.trim();
    whole(value)?;
    let outline = Outline::scan(text);
    let exact = outline.nodes.iter().rev().find(|n| n.path == path && !path.is_empty());
    if let Some(node) = exact {
        let mut changed = text.to_string();
        changed.replace_range(node.value.clone(), value);
        return Ok(changed);
    }
    // The nearest enclosing structure in the text, and the fields that it lacks.
    let mut around = path;
    let (at, missing, comma) = loop {
        let cut = around.rfind(['.', '[']).unwrap_or(0);
        let lacking = &path[cut..];
        around = &path[..cut];
        let inner = (outline.nodes.iter()).find(|n| n.path == around && text[n.value.clone()].ends_with(')'));
        if let Some(node) = inner {
            let last = (outline.nodes.iter())
                .filter(|n| node.value.start < n.whole.start && n.whole.end < node.value.end)
                .map(|n| n.whole.end)
                .max();
            let open = text[node.value.clone()].find('(').map(|i| node.value.start + i + 1);
            match (last, open) {
                (Some(end), _) => break (end, lacking, true),
                (None, Some(open)) => break (open, lacking, false),
                (None, None) => {}
            }
        }
        if cut == 0 || outline.nodes.iter().any(|n| n.path == around) {
            return Err(match lacking.strip_prefix('[').and_then(|l| l.split_once(']')) {
                Some((element, _)) => format!("`{around}` has no element {element}"),
                None => format!("`{around}` has no fields"),
            });
        }
    };
    let names: Vec<&str> = missing.trim_start_matches('.').split('.').collect();
    for name in &names {
        if name.contains('[') {
            return Err(format!("the scenario has no list element `{name}`"));
        }
        if name.is_empty() || !name.chars().all(|c| c.is_alphanumeric() || c == '_') {
            return Err("a path reads like `robots[0].strategy.lost_points`".to_string());
        }
    }
    let mut added = if comma { ", " } else { "" }.to_string();
    added.push_str(&names.join(": ("));
    added.push_str(": ");
    added.push_str(value);
    added.push_str(&")".repeat(names.len() - 1));
    let mut changed = text.to_string();
    changed.insert_str(at, &added);
    Ok(changed)
}

/// A value must be one RON value: it must not end the field and begin another.
fn whole(value: &str) -> Result<(), String> {
    let outline = Outline::scan(value);
    let one = outline.whole
        && (outline.nodes.last()).is_some_and(|n| n.path.is_empty() && n.whole == (0..value.len()))
        && !value.contains("//")
        && !value.contains("/*");
    if one { Ok(()) } else { Err(format!("`{value}` is not one RON value")) }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "(\n  version: 1, // first\n  robots: [(id: \"a\", strategy: Amp(track_in: \
        CounterTurn(beta_deg: 20)), start: (v: Depth(2.0)), body: Remus())],\n  time: (limit_s: 5), // end\n)";

    #[test]
    fn values_are_replaced_in_place() {
        let beta = set_value(TEXT, "robots[0].strategy.track_in.beta_deg", "45").unwrap();
        assert_eq!(beta, TEXT.replace("20", "45"));
        let depth = set_value(TEXT, "robots[0].start.v", "Altitude(3)").unwrap();
        assert_eq!(depth, TEXT.replace("Depth(2.0)", "Altitude(3)"));
    }

    #[test]
    fn fields_left_to_their_default_are_added() {
        let step = set_value(TEXT, "time.step_s", "0.02").unwrap();
        assert_eq!(step, TEXT.replace("limit_s: 5", "limit_s: 5, step_s: 0.02"));
        let mass = set_value(TEXT, "robots[0].body.mass.kg", "30").unwrap();
        assert_eq!(mass, TEXT.replace("Remus()", "Remus(mass: (kg: 30))"));
        let title = set_value(TEXT, "title", "\"t\"").unwrap();
        assert_eq!(title, TEXT.replace("(limit_s: 5)", "(limit_s: 5), title: \"t\""));
    }

    #[test]
    fn paths_that_lead_nowhere_and_values_that_are_not_one_are_refused() {
        for (path, value, problem) in [
            ("robots[3].id", "\"b\"", "`robots` has no element 3"),
            ("time.limit_s.x", "1", "has no fields"),
            ("time.step s", "1", "a path reads like"),
            ("", "1", "a path reads like"),
            ("time.limit_s", "1, step_s: 2", "is not one RON value"),
            ("time.limit_s", "1) (", "is not one RON value"),
            ("time.limit_s", "(1", "is not one RON value"),
            ("time.limit_s", "", "is not one RON value"),
        ] {
            let said = set_value(TEXT, path, value).unwrap_err();
            assert!(said.contains(problem), "{path} {value}: {said}");
        }
    }
}
