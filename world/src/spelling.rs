//! Names that were probably meant where somebody wrote another one.

/// "did you mean" with all legal names.
pub fn choose(given: &str, legal: &[&str], what: &str) -> String {
    let all = legal.join(", ");
    let near = (legal.iter())
        .map(|l| (distance(given, l), l))
        .min_by_key(|(d, _)| *d)
        .filter(|(d, l)| !given.is_empty() && *d <= 1 + l.len() / 3);
    match near {
        _ if legal.is_empty() => format!("there are no {what} here"),
        Some((_, l)) => format!("did you mean `{l}`? {what} here: {all}"),
        None => format!("{what} here: {all}"),
    }
}

/// The name that is surely meant: at most two edits away, and no other name is as near.
pub fn nearest<'l>(given: &str, legal: &[&'l str]) -> Option<&'l str> {
    let mut near: Vec<(usize, &str)> = legal.iter().map(|l| (distance(given, l), *l)).collect();
    near.sort_unstable();
    match near.as_slice() {
        [(d, l)] | [(d, l), ..] if *d > 2 || *d >= l.len() => None,
        [(d, _), (e, _), ..] if d == e => None,
        [(_, l), ..] => Some(*l),
        [] => None,
    }
}

/// Number of edits (insert, delete, replace) between two words, ignoring case.
pub fn distance(a: &str, b: &str) -> usize {
    let (a, b) = (a.to_ascii_lowercase(), b.to_ascii_lowercase());
    let mut row: Vec<usize> = (0..=b.chars().count()).collect();
    for (i, ca) in a.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, cb) in b.chars().enumerate() {
            let replaced = diagonal + usize::from(ca != cb);
            diagonal = row[j + 1];
            row[j + 1] = replaced.min(row[j] + 1).min(diagonal + 1);
        }
    }
    row[row.len() - 1]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn edit_distance_counts_edits() {
        assert_eq!(distance("lenght_m", "length_m"), 2);
        assert_eq!(distance("Zigzag", "ZigZag"), 0);
        assert_eq!(distance("", "abc"), 3);
    }

    #[test]
    fn only_a_near_name_is_proposed() {
        let legal = ["length_m", "width_m"];
        assert!(choose("lenght_m", &legal, "fields").starts_with("did you mean `length_m`?"));
        assert_eq!(choose("colour", &["length_m"], "fields"), "fields here: length_m");
        assert_eq!(nearest("lenght_m", &legal), Some("length_m"));
        assert_eq!(nearest("n", &["x", "y"]), None);
        assert_eq!(nearest("east", &["east_m", "east_n"]), None);
    }
}
