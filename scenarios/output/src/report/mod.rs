//! A run's folder: tables, figures, one-page report.

mod film;
mod html;
mod names;
mod page;
mod tables;
mod write;

pub use film::{FILM_STYLE, film};
pub use names::is_result;
pub use page::Page;
pub use tables::tables;
pub use write::{Figure, figures, write_all};

#[cfg(test)]
mod tests;
#[cfg(test)]
mod tests_gantry;
#[cfg(test)]
mod tests_words;
