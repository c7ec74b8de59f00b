//! `rheotaxis topics`: lists what a run publishes over zenoh.

use crate::args::live::TopicsArgs;
use crate::exit::Exit;
use crate::say;
use output::live;
use output::ros::MessageKind;
use serde_json::{Map, Value, json};
use world::registry::Registry;

/// Prints every key; with `--schema`, one JSON object with all schemas; with `--ros2`, those of ROS 2.
pub(crate) fn topics(registry: &Registry, args: &TopicsArgs) -> Exit {
    if args.ros2 {
        return ros2_topics(args.schema);
    }
    if args.schema {
        let schemas: Map<String, Value> =
            live::topics(registry).iter().map(|t| (t.name.to_string(), t.schema())).collect();
        say::line(format_args!("{:#}", Value::Object(schemas)));
        return Exit::Success;
    }
    say::line(format_args!("Keys below rheotaxis/<run>/, where <run> is <scenario>_<seed>. SI units, ENU axes.\n"));
    for topic in live::topics(registry) {
        say::line(format_args!("{}  ({})", topic.key, topic.rate));
        say::line(format_args!("    {}", topic.what()));
        let schema = topic.schema();
        let required = schema["required"].as_array().map_or(&[][..], Vec::as_slice);
        for field in topic.fields() {
            let mark = if required.iter().any(|r| *r == field) { "" } else { "?" };
            let what = schema["properties"][&field]["description"].as_str().unwrap_or_default();
            say::line(format_args!("    {:<24} {what}", field + mark));
        }
        say::line("");
    }
    Exit::Success
}

fn ros2_topics(schema: bool) -> Exit {
    if schema {
        let one = |kind: MessageKind| {
            let (hash, definition) = (kind.hash(), kind.schema());
            let value = json!({"hash": hash, "definition": definition});
            (kind.name().to_owned(), value)
        };
        let all: Map<String, Value> = MessageKind::all().map(one).collect();
        say::line(format_args!("{:#}", Value::Object(all)));
        return Exit::Success;
    }
    say::line(format_args!(
        "Topics of the node `rheotaxis` with `rheotaxis run SCENARIO --ros2`. SI units, ENU axes. <robot> and <gantry> \
         are ids of the scenario.\n"
    ));
    for topic in live::ros_topics() {
        let (kind, qos) = (topic.kind.name(), topic.qos.label());
        say::line(format_args!("{}  {kind}  ({qos})", topic.name));
        say::line(format_args!("    {}\n", topic.what));
    }
    Exit::Success
}
