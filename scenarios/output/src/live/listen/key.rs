//! What a user writes to say what to hear, as a key expression; and the topic of a key.

use super::super::{ListenOptions, LiveError, LiveOptions, Topic};
use world::spelling::nearest;
use zenoh::key_expr::OwnedKeyExpr;

/// Which keys to hear.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Wanted {
    /// All of them.
    pub(super) all: OwnedKeyExpr,
    /// The clocks of the runs they belong to: a run's last message is one.
    pub(super) clocks: OwnedKeyExpr,
    /// The tokens of these runs.
    pub(super) tokens: OwnedKeyExpr,
}

impl Wanted {
    /// What the options ask for, among these topics.
    pub(super) fn new(options: &ListenOptions, topics: &[Topic]) -> Result<Self, LiveError> {
        if let Some(run) = &options.run {
            LiveOptions::new(run.clone()).check()?;
        }
        let run = options.run.as_deref().unwrap_or("*");
        let given = options.key.as_deref().unwrap_or("**");
        let whole = given.split('/').next() == Some("rheotaxis");
        if let (true, Some(run)) = (whole, &options.run) {
            return Err(LiveError::TwoRuns {
                key: given.to_owned(),
                run: run.clone(),
            });
        }
        let all = match whole {
            true => expression(given.to_owned())?,
            false => expression(format!("rheotaxis/{run}/{}", below(given, topics)?))?,
        };
        // `**` may stand for any number of chunks, and then for any run.
        let run = match all.as_str().split('/').nth(1) {
            Some(run) if !run.contains("**") => run.to_owned(),
            _ => "*".to_owned(),
        };
        Ok(Self {
            clocks: expression(format!("rheotaxis/{run}/clock"))?,
            tokens: expression(format!("rheotaxis/{run}/@live/sim"))?,
            all,
        })
    }
}

/// The key below that of a run: a topic's, or the one given. Names in it may stand as `rheotaxis topics` prints them.
fn below(given: &str, topics: &[Topic]) -> Result<String, LiveError> {
    if let Some(topic) = topics.iter().find(|t| t.name == given) {
        return Ok(starred(topic.key));
    }
    if given.contains(['/', '*', '$']) {
        return Ok(starred(given));
    }
    let names: Vec<&str> = topics.iter().map(|t| t.name).collect();
    let near = nearest(given, &names).map(|near| format!("did you mean `{near}`? "));
    Err(LiveError::NoTopic {
        name: given.to_owned(),
        cure: format!("{}`rheotaxis topics` lists them", near.unwrap_or_default()),
    })
}

fn is_name(chunk: &str) -> bool {
    chunk.starts_with('<') && chunk.ends_with('>')
}

/// A key with `*` in the place of names like `<id>`.
fn starred(key: &str) -> String {
    let chunks: Vec<&str> = (key.split('/'))
        .map(|chunk| if is_name(chunk) { "*" } else { chunk })
        .collect();
    chunks.join("/")
}

fn expression(key: String) -> Result<OwnedKeyExpr, LiveError> {
    OwnedKeyExpr::autocanonize(key.clone()).map_err(|e| LiveError::Key {
        key,
        why: super::super::config::plain(&e),
    })
}

/// The run of a key, and what stands below it; nothing of both for a key that is not of a run.
pub(super) fn parts(key: &str) -> Option<(&str, &str)> {
    key.strip_prefix("rheotaxis/")?.split_once('/')
}

/// The topic of a key below that of a run.
pub(super) fn topic<'t>(below: &str, topics: &'t [Topic]) -> Option<&'t Topic> {
    let fits = |topic: &&Topic| {
        let (mut chunks, mut own) = (below.split('/'), topic.key.split('/'));
        loop {
            match (own.next(), chunks.next()) {
                (None, None) => return true,
                (Some(own), Some(chunk)) if own == chunk || is_name(own) => {}
                _ => return false,
            }
        }
    };
    topics.iter().find(fits)
}

#[cfg(test)]
mod tests {
    use super::super::super::topics;
    use super::*;

    fn wanted(key: &str, run: Option<&str>) -> Result<[String; 2], LiveError> {
        let options = ListenOptions {
            key: Some(key.to_owned()),
            run: run.map(str::to_owned),
            ..ListenOptions::default()
        };
        let w = Wanted::new(&options, &topics())?;
        Ok([w.all.to_string(), w.clocks.to_string()])
    }

    #[test]
    fn a_name_a_key_below_a_run_and_a_whole_key_are_understood() {
        for (given, run, all, clocks) in [
            (
                "chemical",
                None,
                "rheotaxis/*/auv/*/chemical",
                "rheotaxis/*/clock",
            ),
            (
                "gantry_behaviour",
                Some("a_1"),
                "rheotaxis/a_1/gantry/*/behaviour",
                "rheotaxis/a_1/clock",
            ),
            (
                "auv/<id>/truth",
                None,
                "rheotaxis/*/auv/*/truth",
                "rheotaxis/*/clock",
            ),
            (
                "auv/auv0/**",
                Some("a_1"),
                "rheotaxis/a_1/auv/auv0/**",
                "rheotaxis/a_1/clock",
            ),
            ("**", None, "rheotaxis/*/**", "rheotaxis/*/clock"),
            (
                "rheotaxis/a_1/plume",
                None,
                "rheotaxis/a_1/plume",
                "rheotaxis/a_1/clock",
            ),
            ("rheotaxis/**", None, "rheotaxis/**", "rheotaxis/*/clock"),
            (
                "rheotaxis/**/clock",
                None,
                "rheotaxis/**/clock",
                "rheotaxis/*/clock",
            ),
        ] {
            assert_eq!(
                wanted(given, run),
                Ok([all.to_owned(), clocks.to_owned()]),
                "{given}"
            );
        }
    }

    #[test]
    fn what_cannot_be_heard_is_refused_with_a_cure() {
        for (given, run, said) in [
            (
                "chemcal",
                None,
                "no topic `chemcal`: did you mean `chemical`? `rheotaxis topics` lists them",
            ),
            (
                "auv//truth",
                None,
                "`rheotaxis/*/auv//truth` is not a key expression of zenoh",
            ),
            ("rheotaxis/a_1/**", Some("b_1"), "leave out `--run b_1`"),
            ("clock", Some("b/1"), "run id `b/1` must be of a-z"),
        ] {
            let why = wanted(given, run).expect_err(given).to_string();
            assert!(why.contains(said), "{given}: {why}");
        }
    }

    #[test]
    fn every_topic_is_that_of_its_own_key() {
        for one in topics() {
            let key = one.key.replace(['<', '>'], "");
            assert_eq!(
                topic(&key, &topics()).map(|t| t.name),
                Some(one.name),
                "{key}"
            );
        }
        assert_eq!(topic("auv/auv0/nothing", &topics()), None);
        assert_eq!(
            parts("rheotaxis/a_1/auv/b/truth"),
            Some(("a_1", "auv/b/truth"))
        );
        assert_eq!(parts("0/chatter"), None);
    }
}
