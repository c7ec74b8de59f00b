//! Files: whole ones in, whole ones out. No other code of the program opens, makes, renames or removes one.

mod folder;
mod input;
mod output;
#[cfg(test)]
mod output_tests;

pub use folder::Folder;
pub use input::{is_special, open, read, read_text};
pub use output::{Output, OutputError, make_folder, write, write_new, write_on_disk};
