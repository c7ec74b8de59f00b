//! The animation of `report.html`: plan, vertical section and series of a run, drawn by a script on canvases. The data
//! are whole numbers in a JSON text of the page; the script and its style stand beside this file. Without a script the
//! page keeps its pictures, and so does its print.

mod data;
mod plan;
mod tracks;
mod wisps;

use crate::results::RunReport;
use std::fmt::Write as _;

/// Style of the animation.
pub const FILM_STYLE: &str = include_str!("film.css");
const SCRIPTS: [&str; 4] = [
    include_str!("film_data.js"),
    include_str!("film_draw.js"),
    include_str!("film_side.js"),
    include_str!("film_play.js"),
];

/// The data of the animation as JSON, for [`Page::film`](super::Page::film), that is safe inside a page; `None` for a run in which nothing moved.
pub fn film(run: &RunReport<'_>) -> Option<String> {
    data::film_data(run).map(|data| in_page(&data.to_string()))
}

/// A section of the page with an animation and its heading; the data are those of [`film`]. The page needs
/// [`FILM_STYLE`] and, once after all animations, [`film_script`].
pub(super) fn film_section(title: &str, film: &str) -> String {
    let title = crate::charts::escaped(title);
    format!(
        "<section class=\"film\" hidden aria-label=\"{title}\"><h2>{title}</h2>\n\
         <script type=\"application/json\">{film}</script></section>\n"
    )
}

/// The script that brings all animations of a page to life.
pub(super) fn film_script() -> String {
    format!("<script>\n(() => {{\n\"use strict\";\n{}}})();\n</script>\n", SCRIPTS.concat())
}

/// Escapes what would end a script of a page, or a line of one.
fn in_page(json: &str) -> String {
    let mut out = String::with_capacity(json.len());
    for c in json.chars() {
        match c {
            '<' | '>' | '&' | '\u{2028}' | '\u{2029}' => {
                write!(out, "\\u{:04x}", c as u32).expect("writing to a String succeeds");
            }
            c => out.push(c),
        }
    }
    out
}

#[cfg(test)]
mod tests;
