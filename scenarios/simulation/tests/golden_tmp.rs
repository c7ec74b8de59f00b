#![allow(missing_docs)]
#[path = "../../../tests/it/golden.rs"]
mod golden;
