//! Files are read whole and written whole. Only this module opens, makes, renames or removes files.

mod folder;
#[cfg(test)]
mod folder_tests;
mod input;
mod lock;
mod output;
#[cfg(test)]
mod output_tests;
mod shelf;
#[cfg(test)]
mod shelf_tests;

pub use folder::Folder;
pub use input::{is_special, open, read, read_text};
pub use lock::is_in_use;
pub use output::{
    Output, OutputError, clear_abandoned, drop_unfinished, folder_of, make_folder, write, write_new, write_on_disk,
};
pub use shelf::{Shelf, ShelfEntry, ShelfError, Stock};
