//! The report as one self-contained page.

use output::charts::escaped;
use output::report::STYLE;
use std::fmt::Write as _;

const TEXT: &str = "writing to a String succeeds";

/// A page that grows from top to bottom.
pub(super) struct Page(String);

impl Page {
    pub(super) fn new(title: &str) -> Self {
        let title = escaped(title);
        Self(format!(
            "<!DOCTYPE html>\n<html lang=\"en\">\n<head><meta charset=\"utf-8\">\
             <meta name=\"viewport\" content=\"width=device-width\">\
             <title>{title}</title><style>{STYLE}</style></head>\n<body>\n<h1>{title}</h1>\n"
        ))
    }

    pub(super) fn heading(&mut self, text: &str) {
        writeln!(self.0, "<h2>{}</h2>", escaped(text)).expect(TEXT);
    }

    pub(super) fn paragraph(&mut self, text: &str) {
        writeln!(self.0, "<p>{}</p>", escaped(text)).expect(TEXT);
    }

    pub(super) fn svg(&mut self, svg: &str) {
        self.0.push_str(svg);
    }

    pub(super) fn table<const N: usize>(&mut self, head: &[&str; N], rows: &[[String; N]]) {
        self.0.push_str("<table>\n<tr>");
        for h in head {
            write!(self.0, "<th>{}</th>", escaped(h)).expect(TEXT);
        }
        self.0.push_str("</tr>\n");
        for row in rows {
            self.0.push_str("<tr>");
            for cell in row {
                write!(self.0, "<td>{}</td>", escaped(cell)).expect(TEXT);
            }
            self.0.push_str("</tr>\n");
        }
        self.0.push_str("</table>\n");
    }

    pub(super) fn end(mut self) -> String {
        self.0.push_str("</body>\n</html>\n");
        self.0
    }
}
