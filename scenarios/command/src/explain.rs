//! `rheotaxis explain`: explains the fields of a scenario file.

use super::args_explain::ExplainArgs;
use super::exit::Exit;
use super::say;
use rheotaxis::explain;

/// Prints the explanation of one place, or the whole reference as Markdown or JSON Schema.
pub(super) fn explain(args: &ExplainArgs) -> Exit {
    let path = args.path.as_deref().unwrap_or_default();
    let text = match (args.markdown, args.json_schema) {
        (true, _) => Ok(explain::markdown()),
        (_, true) => Ok(explain::json_schema()),
        _ => explain::explain(path),
    };
    match text {
        Ok(text) => {
            say::line(text.trim_end());
            Exit::Success
        }
        Err(unknown) => {
            say::error(&unknown, Some(&help(&unknown.near)));
            Exit::Error
        }
    }
}

fn help(near: &[String]) -> String {
    match near {
        [] => "`rheotaxis explain` lists the blocks of a scenario".to_string(),
        [one] => format!("did you mean {one}?"),
        several => format!("the nearest are {}", several.join(", ")),
    }
}
