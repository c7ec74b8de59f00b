//! Lists of names that readers of files can keep for as long as the program runs.

use std::sync::{Mutex, PoisonError};

/// Every list that was asked for, once: as many as there are kinds and registries.
static LISTS: Mutex<Vec<&'static [&'static str]>> = Mutex::new(Vec::new());

/// The same names for as long as the program runs.
pub(super) fn kept(names: &[&'static str]) -> &'static [&'static str] {
    let mut lists = LISTS.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(list) = lists.iter().find(|l| **l == names) {
        return list;
    }
    let list: &'static [&'static str] = Vec::leak(names.to_vec());
    lists.push(list);
    list
}
