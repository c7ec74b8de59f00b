//! The report as one self-contained page.

use super::text::Table;
use super::tracks::Film;
use output::charts::escaped;
use output::report::{FILM_STYLE, STYLE, film_script, film_section};
use std::fmt::Write as _;

/// Pictures of tracks are for print, and for browsers without JavaScript.
const STILL_STYLE: &str = ".still{display:none}.still img{max-width:100%;background:#fff}\
@media print{.still{display:block}.still img{max-height:215mm;margin:auto;display:block}}";
const TEXT: &str = "writing to a String succeeds";

/// A page that grows from top to bottom.
pub(super) struct Page {
    text: String,
    /// Whether something in it moves.
    moves: bool,
}

impl Page {
    pub(super) fn new(title: &str) -> Self {
        let title = escaped(title);
        let text = format!(
            "<!DOCTYPE html>\n<html lang=\"en\">\n<head><meta charset=\"utf-8\">\
             <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\
             <title>{title}</title><style>{STYLE}{FILM_STYLE}{STILL_STYLE}</style></head>\n<body>\n<h1>{title}</h1>\n"
        );
        Self { text, moves: false }
    }

    pub(super) fn heading(&mut self, text: &str) {
        writeln!(self.text, "<h2>{}</h2>", escaped(text)).expect(TEXT);
    }

    pub(super) fn paragraph(&mut self, text: &str) {
        writeln!(self.text, "<p>{}</p>", escaped(text)).expect(TEXT);
    }

    /// A paragraph for browsers without JavaScript.
    pub(super) fn without_script(&mut self, text: &str) {
        let text = escaped(text);
        writeln!(self.text, "<noscript><style>.still{{display:block}}</style><p>{text}</p></noscript>").expect(TEXT);
    }

    /// An animation; its picture stands in for it in print and without JavaScript.
    pub(super) fn film(&mut self, title: &str, film: &Film) {
        self.moves = true;
        self.text.push_str(&film_section(title, &film.data));
        if let Some(still) = &film.still {
            let title = escaped(title);
            let figure = format!(
                "<figure class=\"still\"><img src=\"{still}\" alt=\"{title}\"><figcaption>{title}</figcaption></figure>"
            );
            writeln!(self.text, "{figure}").expect(TEXT);
        }
    }

    pub(super) fn svg(&mut self, svg: &str) {
        self.text.push_str(svg);
    }

    /// A table whose cells are never broken inside a word; where it is too wide, it scrolls.
    pub(super) fn table(&mut self, table: &Table) {
        self.rows("<table>", table);
    }

    /// A table of names and what they mean, which may be long: it is as wide as the page.
    pub(super) fn facts(&mut self, table: &Table) {
        self.rows("<table class=\"facts\">", table);
    }

    /// Tables that belong together, each with its title.
    pub(super) fn tables(&mut self, tables: &[(String, Table)]) {
        for (title, table) in tables {
            writeln!(self.text, "<h3>{}</h3>", escaped(title)).expect(TEXT);
            self.table(table);
        }
    }

    fn rows(&mut self, begin: &str, table: &Table) {
        write!(self.text, "{begin}\n<tr>").expect(TEXT);
        for h in &table.head {
            write!(self.text, "<th>{}</th>", escaped(h)).expect(TEXT);
        }
        self.text.push_str("</tr>\n");
        for row in &table.rows {
            self.text.push_str("<tr>");
            for cell in row {
                write!(self.text, "<td>{}</td>", escaped(cell)).expect(TEXT);
            }
            self.text.push_str("</tr>\n");
        }
        self.text.push_str("</table>\n");
    }

    pub(super) fn end(mut self) -> String {
        if self.moves {
            self.text.push_str(&film_script());
        }
        self.text.push_str("</body>\n</html>\n");
        self.text
    }
}
