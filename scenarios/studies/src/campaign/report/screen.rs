//! A report on its way: the page, and the same tables and words as plain text for a terminal.

use super::text::{Table, wrapped};
use output::charts::escaped;
use output::report::{FILM_STYLE, Page};

/// Pictures of tracks are for print, and for browsers without JavaScript.
const STILL_STYLE: &str = ".still{display:none}.still img{max-width:100%;background:#fff}\
@media print{.still{display:block}.still img{max-height:215mm;margin:auto;display:block}}";

/// The tracks of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Film {
    /// The data of its [animation](output::report::film).
    pub data: String,
    /// A picture of them as a `data:` address, for print and for browsers without JavaScript.
    pub still: Option<String>,
}

/// Both. What stands in the page alone is added to it.
pub(super) struct Shown {
    pub(super) page: Page,
    pub(super) text: String,
    /// Width of the terminal, characters; without it, lines are as long as they are.
    columns: Option<usize>,
}

impl Shown {
    pub(super) fn new(title: &str, columns: Option<usize>) -> Self {
        let page = Page::new(title, title, &[FILM_STYLE, STILL_STYLE].concat());
        let mut begun = Self { page, text: String::new(), columns };
        begun.line(title);
        begun
    }

    /// A line of the text alone.
    pub(super) fn line(&mut self, words: &str) {
        self.text.push_str(wrapped(words, self.columns).trim_end());
        self.text.push('\n');
    }

    /// A paragraph.
    pub(super) fn paragraph(&mut self, words: &str) {
        self.page.paragraph(words);
        self.text.push('\n');
        self.line(words);
    }

    /// A table. In the text it has a title, unless that is empty.
    pub(super) fn table(&mut self, title: &str, table: &Table) {
        self.page.table(&table.head, &table.rows, false);
        self.text.push('\n');
        if !title.is_empty() {
            self.line(title);
        }
        self.text.push_str(&table.text(self.columns));
    }

    /// Tables that belong together, each with its title and what the text adds to that.
    pub(super) fn tables(&mut self, tables: &[(String, Table)], more: &str) {
        for (title, table) in tables {
            self.page.title(title);
            self.table(&format!("{title}{more}"), table);
        }
    }

    /// An animation in the page; its picture stands in for it in print and without JavaScript.
    pub(super) fn film(&mut self, title: &str, film: &Film) {
        self.page.film(title, &film.data);
        if let Some(still) = &film.still {
            let title = escaped(title);
            self.page.html(&format!(
                "<figure class=\"still\"><img src=\"{still}\" alt=\"{title}\"><figcaption>{title}</figcaption></figure>\n"
            ));
        }
    }
}
