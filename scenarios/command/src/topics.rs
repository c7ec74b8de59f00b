//! `rheotaxis topics`: lists what a run publishes over zenoh.

use super::args::TopicsArgs;
use super::exit::Exit;
use super::say;
use output::live;
use serde_json::{Map, Value};

/// Prints every key; with `--schema`, one JSON object with all schemas.
pub(super) fn topics(args: &TopicsArgs) -> Exit {
    if args.schema {
        let schemas: Map<String, Value> = live::topics()
            .iter()
            .map(|t| (t.name.to_string(), t.schema()))
            .collect();
        say::line(format_args!("{:#}", Value::Object(schemas)));
        return Exit::Success;
    }
    say::line(format_args!(
        "Keys below rheotaxis/<run>/, where <run> is <scenario>_<seed>. SI units, ENU axes.\n"
    ));
    for topic in live::topics() {
        say::line(format_args!("{}  ({})", topic.key, topic.rate));
        say::line(format_args!("    {}", topic.what));
        for field in topic.fields {
            let mark = if field.required { "" } else { "?" };
            say::line(format_args!(
                "    {:<24} {}",
                format!("{}{mark}", field.name),
                field.what
            ));
        }
        say::line("");
    }
    Exit::Success
}
