//! A self-contained page, made from top to bottom.

use super::film::{film_script, film_section};
use crate::charts::escaped;
use std::fmt::Write as _;

/// Style sheet of all pages.
pub(super) const STYLE: &str = "body{font:15px/1.5 system-ui,sans-serif;color:#222;max-width:1040px;margin:2em auto;padding:0 1em}\
h1{font-size:1.5em;margin-bottom:.1em}h2{font-size:1.15em;margin-top:2em;border-bottom:1px solid #ddd}\
h3{font-size:1em;margin:1.2em 0 .2em;break-after:avoid}\
table{border-collapse:collapse;margin:.6em 0}td,th{padding:.2em .9em .2em 0;text-align:left;vertical-align:top}\
th{font-weight:600;color:#555}svg{max-width:100%;height:auto}pre{background:#f6f6f6;padding:1em;overflow:auto;font-size:12.5px}\
.outcome{font-weight:600}code{font-size:.9em}img{max-width:100%;height:auto}\
.pictures{display:grid;grid-template-columns:repeat(auto-fill,minmax(220px,1fr));gap:.6em}\
figure{margin:0;break-inside:avoid}figcaption{font-size:.85em;color:#555}h2{break-after:avoid}\
p,.facts td:not(:first-child){overflow-wrap:anywhere}\
table:not(.facts){display:block;overflow-x:auto}\
@media(max-width:600px){body{font-size:14px;margin:1em auto;padding:0 .7em}table.facts td,table.facts th{display:block;padding-right:0}\
pre{font-size:10.5px}.pictures{grid-template-columns:1fr 1fr}}\
@media print{@page{margin:14mm}body{font-size:10.5px;line-height:1.35;max-width:none;margin:0;padding:0}h1{font-size:15px}\
h2{font-size:12px;margin:1em 0 .3em}svg{display:block;max-height:235mm;max-width:100%;margin:auto}td,th{padding:.05em .7em .05em 0}\
table:not(.facts){display:table}table:not(.facts) :is(td,th){overflow-wrap:break-word}\
pre{font-size:6.5px;line-height:1.25;white-space:pre-wrap;padding:.5em}.pictures{grid-template-columns:repeat(4,1fr);gap:2mm}}\
@media screen and (prefers-color-scheme:dark){:root{color-scheme:dark}body{color:#e2e4e7;background:#14171a}h2{border-color:#3a3f45}\
th,figcaption{color:#a8adb3}pre{background:#1d2126}svg{background:#fff;border-radius:4px}}";

const TEXT: &str = "writing to a String succeeds";

/// A page on its way.
#[derive(Debug)]
pub struct Page {
    text: String,
    /// Whether something in it moves.
    moves: bool,
}

impl Page {
    /// Begins a page: its title for the browser, its heading, and what it adds to the style of all pages.
    pub fn new(title: &str, heading: &str, style: &str) -> Self {
        let (title, heading) = (escaped(title), escaped(heading));
        let text = format!(
            "<!DOCTYPE html>\n<html lang=\"en\">\n<head><meta charset=\"utf-8\">\
             <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\
             <title>{title}</title><style>{STYLE}{style}</style></head>\n<body>\n<h1>{heading}</h1>\n"
        );
        Self { text, moves: false }
    }

    /// Adds what is HTML already, such as an SVG.
    pub fn html(&mut self, html: &str) {
        self.text.push_str(html);
    }

    /// The heading of a section.
    pub fn heading(&mut self, text: &str) {
        writeln!(self.text, "<h2>{}</h2>", escaped(text)).expect(TEXT);
    }

    /// A paragraph.
    pub fn paragraph(&mut self, text: &str) {
        writeln!(self.text, "<p>{}</p>", escaped(text)).expect(TEXT);
    }

    /// The heading of a part of a section.
    pub fn title(&mut self, text: &str) {
        writeln!(self.text, "<h3>{}</h3>", escaped(text)).expect(TEXT);
    }

    /// A section with names and what they are, which may be long: it is as wide as the page.
    pub fn facts<K: AsRef<str>>(&mut self, title: &str, rows: &[(K, String)]) {
        self.heading(title);
        self.html("<table class=\"facts\">\n");
        for (name, what) in rows {
            let (name, what) = (escaped(name.as_ref()), escaped(what));
            writeln!(self.text, "<tr><th>{name}</th><td>{what}</td></tr>").expect(TEXT);
        }
        self.html("</table>\n");
    }

    /// A table whose cells are never broken inside a word: where it is too wide, it scrolls. If it is of `facts`, which
    /// may be long, it is as wide as the page.
    pub fn table(&mut self, head: &[String], rows: &[Vec<String>], facts: bool) {
        let line = |tag: &str, cells: &[String]| {
            let cells: Vec<String> = cells.iter().map(|c| format!("<{tag}>{}</{tag}>", escaped(c))).collect();
            format!("<tr>{}</tr>\n", cells.concat())
        };
        self.text.push_str(if facts { "<table class=\"facts\">\n" } else { "<table>\n" });
        self.text.push_str(&line("th", head));
        self.text.extend(rows.iter().map(|row| line("td", row)));
        self.text.push_str("</table>\n");
    }

    /// An [animation](super::film()) with its data.
    pub fn film(&mut self, title: &str, data: &str) {
        self.moves = true;
        self.text.push_str(&film_section(title, data));
    }

    /// The whole page.
    pub fn end(mut self) -> String {
        if self.moves {
            self.text.push_str(&film_script());
        }
        self.text.push_str("</body>\n</html>\n");
        self.text
    }
}
