//! A run's folder: tables, figures, one-page report.

mod film;
mod html;
mod names;
mod tables;
mod write;

pub use film::{FILM_STYLE, film, film_script, film_section};
pub use html::STYLE;
pub use names::is_result;
pub use tables::tables;
pub use write::{Figure, figures, write_all};

#[cfg(test)]
mod tests;
#[cfg(test)]
mod tests_gantry;
#[cfg(test)]
mod tests_words;
