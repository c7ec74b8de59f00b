//! `rheotaxis explain`: explains the fields of scenarios, campaigns, the arena and vehicles, and columns of tables.

use crate::args::explain::ExplainArgs;
use crate::exit::Exit;
use crate::failure::{Failure, hinted};
use crate::say;
use output::columns::TableInfo;
use output::report;
use rheotaxis::explain::{self, FileKind};
use studies::arena::{FAMILY_FILE, SEARCHERS_FILE};
use studies::campaign;
use world::registry::Registry;

/// The files that this command knows beside those of the library.
const MORE: &[FileKind] = &[campaign::FILE, FAMILY_FILE, SEARCHERS_FILE];

/// The tables of runs and campaigns.
fn tables() -> Vec<TableInfo> {
    [report::tables(), campaign::tables()].concat()
}

/// Prints the explanation of one place, or the whole reference as Markdown or JSON Schema.
pub(crate) fn explain(registry: &Registry, args: &ExplainArgs) -> Result<Exit, Failure> {
    let path = args.path.as_deref().unwrap_or_default();
    let table = tables().into_iter().find(|table| table.is_in(path));
    let text = match (args.markdown, args.json_schema, table) {
        (true, ..) => explain::markdown(registry, MORE),
        (_, true, _) => explain::json_schema(registry),
        (.., Some(table)) => table.text(),
        _ => explain::explain(registry, path, MORE).map_err(|unknown| hinted(&unknown, help(&unknown.near)))?,
    };
    say::line(text.trim_end());
    Ok(Exit::Success)
}

fn help(near: &[String]) -> String {
    match near {
        [] => "`rheotaxis explain` lists the blocks of a scenario and the other files".to_string(),
        [one] => format!("did you mean {one}?"),
        several => format!("the nearest are {}", several.join(", ")),
    }
}
