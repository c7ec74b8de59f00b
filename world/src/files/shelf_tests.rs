//! What is on a shelf is what was put there, or nothing.

use super::shelf::*;
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

const KEY: [u8; 32] = [7; 32];

fn shelf(dir: &Path, most: u64) -> Shelf {
    Shelf::new(dir.join("kept"), most)
}

fn whole(content: &[u8]) -> ShelfEntry {
    ShelfEntry::Whole(content.to_vec())
}

/// The files of a shelf, by name.
fn files(shelf: &Shelf) -> Vec<PathBuf> {
    let mut files: Vec<PathBuf> = (fs::read_dir(shelf.dir()).unwrap()).map(|e| e.unwrap().path()).collect();
    files.sort();
    files
}

fn age(path: &Path, seconds: u64) {
    #[allow(clippy::disallowed_methods, reason = "a file's age")]
    let then = SystemTime::now() - Duration::from_secs(seconds);
    let file = File::options().write(true).open(path).unwrap();
    file.set_modified(then).unwrap();
}

#[test]
fn what_was_put_is_found_and_may_be_put_again() {
    let dir = tempfile::tempdir().unwrap();
    let shelf = shelf(dir.path(), 1 << 20);
    assert_eq!(shelf.get(&KEY).unwrap(), ShelfEntry::Nothing);
    assert_eq!(shelf.stock().unwrap(), Stock::default());
    for content in [&b"one"[..], b"", b"another"] {
        assert!(shelf.store(&KEY, content).unwrap());
        assert_eq!(shelf.get(&KEY).unwrap(), whole(content));
    }
    assert_eq!(shelf.get(&[8; 32]).unwrap(), ShelfEntry::Nothing);
    assert_eq!(files(&shelf).len(), 1);
}

#[test]
fn a_file_that_is_not_whole_is_never_taken_for_one() {
    let dir = tempfile::tempdir().unwrap();
    let shelf = shelf(dir.path(), 1 << 20);
    let content: Vec<u8> = (0..200).collect();
    shelf.store(&KEY, &content).unwrap();
    let path = files(&shelf).remove(0);
    let good = fs::read(&path).unwrap();
    let broken = |bytes: &[u8], what: &str| {
        fs::write(&path, bytes).unwrap();
        assert_eq!(shelf.get(&KEY).unwrap(), ShelfEntry::Broken, "{what}");
        assert!(!path.exists(), "{what}: it is removed");
        assert_eq!(shelf.get(&KEY).unwrap(), ShelfEntry::Nothing);
    };
    for n in 0..good.len() {
        broken(&good[..n], "cut short");
        let mut bytes = good.clone();
        bytes[n] ^= 1 << (n % 8);
        broken(&bytes, "a bit flipped");
    }
    broken(&[good.as_slice(), b"\0"].concat(), "longer");
    broken(b"a,b\n1,2\n", "foreign");
    broken(&vec![0; 5000], "foreign and long");
    // Whole, but another key's.
    shelf.store(&[8; 32], &content).unwrap();
    let other = files(&shelf).remove(0);
    broken(&fs::read(other).unwrap(), "another key's");
    fs::write(&path, &good).unwrap();
    assert_eq!(shelf.get(&KEY).unwrap(), whole(&content));
}

#[test]
fn the_least_recently_used_go_first_and_what_is_not_ours_stays() {
    let dir = tempfile::tempdir().unwrap();
    let keys = [1, 2, 3, 4_u8].map(|n| [n; 32]);
    let content = [0; 1000];
    // Each by a process of its own; three fit.
    let one = |most| shelf(dir.path(), most);
    for (n, key) in keys[..3].iter().enumerate() {
        assert!(one(3500).store(key, &content).unwrap());
        let path = files(&one(0)).pop().unwrap();
        age(&path, 1000 - n as u64);
    }
    let notes = one(0).dir().join("notes.txt");
    fs::write(&notes, vec![b'x'; 9000]).unwrap();
    let similar = one(0).dir().join(format!("{}.kept.txt", "a".repeat(64)));
    fs::write(&similar, "not ours").unwrap();
    // The first is read again; so the second goes.
    assert_eq!(one(3500).get(&keys[0]).unwrap(), whole(&content));
    assert!(one(3500).store(&keys[3], &content).unwrap());
    let there = keys.map(|key| one(0).get(&key).unwrap() != ShelfEntry::Nothing);
    assert_eq!(there, [true, false, true, true]);
    assert!(notes.exists() && similar.exists());
    let stock = one(0).stock().unwrap();
    assert!(stock.files == 3 && stock.bytes <= 3500, "{stock:?}");
    assert_eq!(one(0).clear().unwrap().files, 3);
    assert_eq!(files(&one(0)), [similar, notes]);
}

#[test]
fn one_process_fills_only_its_share() {
    let dir = tempfile::tempdir().unwrap();
    let shelf = shelf(dir.path(), 10_000);
    let put = |n: u8, bytes: usize| shelf.store(&[n; 32], &vec![n; bytes]).unwrap();
    assert!(!put(0, 10_000), "no room for it at all");
    // The first may be larger than the share; then it has been used up.
    assert!(put(1, 4000) && !put(2, 10));
    let shelf = Shelf::new(dir.path().join("other"), 10_000);
    let put = |n: u8, bytes: usize| shelf.store(&[n; 32], &vec![n; bytes]).unwrap();
    assert!(put(1, 1000) && put(2, 1000) && !put(3, 1000) && put(4, 10));
}

#[test]
fn files_of_killed_processes_go_and_those_under_way_stay() {
    let dir = tempfile::tempdir().unwrap();
    let shelf = shelf(dir.path(), 1 << 20);
    fs::create_dir_all(shelf.dir()).unwrap();
    let named = |n: u8| {
        let name = format!("{}.kept.17-{n}.tmp", "a".repeat(64));
        let path = shelf.dir().join(name);
        fs::write(&path, "half").unwrap();
        path
    };
    let (old, new) = (named(0), named(1));
    age(&old, 7200);
    assert!(shelf.store(&KEY, b"x").unwrap());
    assert!(!old.exists() && new.exists());
    assert_eq!(shelf.stock().unwrap().files, 1);
    shelf.clear().unwrap();
    assert_eq!(files(&shelf), Vec::<PathBuf>::new());
}

#[test]
fn many_at_once_leave_whole_files_below_the_bound() {
    let dir = tempfile::tempdir().unwrap();
    let content = |n: u8| vec![n; 5000];
    std::thread::scope(|scope| {
        for thread in 0..4_u8 {
            let dir = dir.path();
            scope.spawn(move || {
                for n in 0..40_u8 {
                    let n = (n + 10 * thread) % 40;
                    // A process of its own each time.
                    let shelf = shelf(dir, 60_000);
                    match shelf.get(&[n; 32]).unwrap() {
                        ShelfEntry::Whole(found) => assert_eq!(found, content(n)),
                        ShelfEntry::Nothing => assert!(shelf.store(&[n; 32], &content(n)).unwrap()),
                        ShelfEntry::Broken => panic!("half a file was seen"),
                    }
                }
            });
        }
    });
    let shelf = shelf(dir.path(), 60_000);
    let stock = shelf.stock().unwrap();
    assert!(stock.bytes <= 60_000 && stock.files > 5, "{stock:?}");
    assert_eq!(files(&shelf).len() as u64, stock.files, "nothing half done");
}

#[cfg(unix)]
#[test]
fn what_cannot_be_used_is_named() {
    use std::os::unix::fs::symlink;
    let dir = tempfile::tempdir().unwrap();
    // A file where the folder should be.
    fs::write(dir.path().join("kept"), "a file").unwrap();
    let said = shelf(dir.path(), 999).store(&KEY, b"x").unwrap_err();
    assert!(said.to_string().contains("kept"), "{said}");
    // A folder, or a device, where a file should be.
    let shelf = Shelf::new(dir.path().join("other"), 1 << 20);
    shelf.store(&KEY, b"x").unwrap();
    let path = files(&shelf).remove(0);
    fs::remove_file(&path).unwrap();
    fs::create_dir(&path).unwrap();
    let said = shelf.get(&KEY).unwrap_err().to_string();
    assert!(said.contains("it is a folder"), "{said}");
    assert!(shelf.store(&KEY, b"x").is_err());
    fs::remove_dir(&path).unwrap();
    symlink("/dev/zero", &path).unwrap();
    assert!(shelf.get(&KEY).is_err() && shelf.store(&KEY, b"x").is_err());
    assert_eq!(files(&shelf), [path]);
}
