//! What a user writes to say what to hear, as a key expression.

use super::super::config::plain;
use super::super::{LiveError, Topic};
use world::spelling::nearest;
use zenoh::key_expr::{OwnedKeyExpr, keyexpr};

/// The key expression for what a user wrote: a key below that of any run, or one that begins with `rheotaxis/`.
pub(super) fn expression(given: &str) -> Result<OwnedKeyExpr, LiveError> {
    let key = match given.starts_with("rheotaxis/") {
        true => starred(given),
        false => format!("rheotaxis/*/{}", starred(given)),
    };
    OwnedKeyExpr::autocanonize(key).map_err(|e| {
        let why = plain(&e);
        // Before that zenoh repeats the key.
        let why = why.split_once("`: ").map_or(&*why, |(_, why)| why);
        LiveError::Key { key: given.to_owned(), why: why.to_owned() }
    })
}

/// A line for the user if no topic has such a key. Runs of other programs may still have one.
pub(super) fn unknown(given: &str, key: &keyexpr, topics: &[Topic]) -> Option<String> {
    let known = |topic: &Topic| {
        let own = expression(topic.key);
        own.is_ok_and(|own| own.intersects(key))
    };
    if topics.iter().any(known) {
        return None;
    }
    let names: Vec<&str> = topics.iter().map(|t| t.name).collect();
    let word = given.rsplit('/').next().unwrap_or(given);
    let near = nearest(word, &names).and_then(|near| topics.iter().find(|t| t.name == near));
    let near = near.map(|topic| format!("; did you mean `{}`?", starred(topic.key)));
    Some(format!("no topic has the key `{given}`: `rheotaxis topics` lists all{}", near.unwrap_or_default()))
}

/// A key with `*` in the place of names like `<id>`, as `rheotaxis topics` prints them.
fn starred(key: &str) -> String {
    let one = |chunk| match chunk {
        name if str::starts_with(name, '<') && name.ends_with('>') => "*",
        chunk => chunk,
    };
    key.split('/').map(one).collect::<Vec<_>>().join("/")
}

#[cfg(test)]
mod tests {
    use super::super::super::topics;
    use super::*;
    use world::registry::Registry;

    #[test]
    fn a_key_is_that_of_any_run_or_a_whole_one() {
        for (given, key) in [
            ("clock", "rheotaxis/*/clock"),
            ("auv/<id>/chemical", "rheotaxis/*/auv/*/chemical"),
            ("auv/auv0/**", "rheotaxis/*/auv/auv0/**"),
            ("**", "rheotaxis/*/**"),
            ("**/**", "rheotaxis/*/**"),
            ("rheotaxis/a_1/plume", "rheotaxis/a_1/plume"),
            ("rheotaxis/**", "rheotaxis/**"),
        ] {
            let key = OwnedKeyExpr::new(key).unwrap();
            assert_eq!(expression(given), Ok(key.clone()), "{given}");
            assert_eq!(unknown(given, &key, &topics(&Registry::default())), None, "{given}");
        }
    }

    #[test]
    fn what_is_no_key_is_refused_and_one_that_no_topic_has_is_told_with_the_nearest() {
        for given in ["", "/clock", "auv//truth", "auv/*uv0", "clock?", "clock/"] {
            let why = expression(given).unwrap_err().to_string();
            assert!(why.starts_with(&format!("`{given}` is no key")) && why.contains("auv/*/chemical"), "{why}");
        }
        for (given, near) in [
            ("chemical", "`auv/*/chemical`?"),
            ("auv/auv0/chemicl", "`auv/*/chemical`?"),
            ("robots/auv0/pose", "`rheotaxis topics` lists all"),
        ] {
            let told = unknown(given, &expression(given).unwrap(), &topics(&Registry::default()));
            assert!(told.as_ref().is_some_and(|told| told.ends_with(near)), "{told:?}");
        }
    }
}
