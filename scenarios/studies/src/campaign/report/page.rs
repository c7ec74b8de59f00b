//! The report as one self-contained page.

use output::charts::escaped;
use output::report::{FILM_STYLE, STYLE, film_script, film_section};
use std::fmt::Write as _;

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
             <title>{title}</title><style>{STYLE}{FILM_STYLE}</style></head>\n<body>\n<h1>{title}</h1>\n"
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
        writeln!(self.text, "<noscript><p>{}</p></noscript>", escaped(text)).expect(TEXT);
    }

    /// An animation, by its data.
    pub(super) fn film(&mut self, title: &str, film: &str) {
        self.moves = true;
        self.text.push_str(&film_section(title, film));
    }

    pub(super) fn svg(&mut self, svg: &str) {
        self.text.push_str(svg);
    }

    pub(super) fn table<const N: usize>(&mut self, head: &[&str; N], rows: &[[String; N]]) {
        self.text.push_str("<table>\n<tr>");
        for h in head {
            write!(self.text, "<th>{}</th>", escaped(h)).expect(TEXT);
        }
        self.text.push_str("</tr>\n");
        for row in rows {
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
