//! Whatever stands in the folder, the run is the same; what is broken is made anew.

use super::kit::{all, developed, files, plume, short};
use rheotaxis::cache::CacheFault;
use rheotaxis::scenario::Loaded;
use std::fs;
use std::path::Path;
use world::files::{Shelf, ShelfEntry};

fn small() -> Loaded {
    short("uniform_channel", 20.0, 5.0)
}

#[test]
fn a_damaged_file_is_noticed_told_and_made_anew() {
    let dir = tempfile::tempdir().unwrap();
    let loaded = small();
    let (first, _) = developed(&loaded, 1, &all(dir.path()));
    let path = files(dir.path()).remove(0);
    let good = fs::read(&path).unwrap();
    let n = good.len();
    let mut flipped = good.clone();
    flipped[n / 3] ^= 0x10;
    for bytes in [good[..n / 2].to_vec(), flipped, b"# notes\n".to_vec()] {
        fs::write(&path, &bytes).unwrap();
        let kept = all(dir.path());
        let (trial, taken) = developed(&loaded, 1, &kept);
        assert!(!taken, "{} bytes", bytes.len());
        assert!(matches!(kept.fault(), Some(CacheFault::Broken(_))));
        assert_eq!(plume(&trial), plume(&first));
        assert_eq!(fs::read(&path).unwrap(), good, "it is whole again");
    }
    assert_eq!(files(dir.path()).len(), 1);
}

/// A sealed file whose content is not that of this ocean, which only another program under our name could have written.
#[test]
fn a_whole_file_with_another_content_is_an_error_and_no_panic() {
    let dir = tempfile::tempdir().unwrap();
    for loaded in [small(), short("block_in_channel", 10.0, 5.0), short("flume_crab", 1.0, 5.0)] {
        let place = dir.path().join(&loaded.name);
        let (first, _) = developed(&loaded, 1, &all(&place));
        let key = key(&place);
        let shelf = || Shelf::new(place.clone(), 1 << 30);
        let ShelfEntry::Whole(content) = shelf().get(&key).unwrap() else {
            panic!("it was kept");
        };
        let n = content.len();
        let lengths = [0, 1, 8, 9, 40, n / 7, n / 2, n - 9, n - 1];
        let longer = [content.as_slice(), &[0]].concat();
        let cut = lengths.iter().map(|l| &content[..*l]);
        for bytes in cut.chain([longer.as_slice(), &vec![0; n][..]]) {
            assert!(shelf().store(&key, bytes).unwrap());
            let kept = all(&place);
            let (trial, taken) = developed(&loaded, 1, &kept);
            assert!(!taken, "{}: {} of {n} bytes", loaded.name, bytes.len());
            assert!(matches!(kept.fault(), Some(CacheFault::Broken(_))));
            assert_eq!(plume(&trial), plume(&first));
        }
        assert_eq!(shelf().get(&key).unwrap(), ShelfEntry::Whole(content));
    }
}

/// The key of the only file.
fn key(dir: &Path) -> [u8; 32] {
    let path = files(dir).remove(0);
    let name = path.file_name().unwrap().to_str().unwrap();
    std::array::from_fn(|n| u8::from_str_radix(&name[2 * n..2 * n + 2], 16).unwrap())
}

#[test]
fn a_folder_that_cannot_be_used_stops_nothing() {
    let dir = tempfile::tempdir().unwrap();
    let loaded = small();
    let (first, _) = developed(&loaded, 1, &all(&dir.path().join("good")));
    let file = dir.path().join("file");
    fs::write(&file, "a file").unwrap();
    for place in [file.clone(), file.join("below"), "/proc/kept".into()] {
        let kept = all(&place);
        for _ in 0..2 {
            let (trial, taken) = developed(&loaded, 1, &kept);
            assert!(!taken);
            assert_eq!(plume(&trial), plume(&first));
        }
        let fault = kept.fault().expect("it is told");
        assert!(matches!(fault, CacheFault::Folder(_)), "{fault}");
        assert!(fault.to_string().contains(place.to_str().unwrap()));
        assert!(kept.fault().is_none(), "once");
    }
    assert_eq!(fs::read(&file).unwrap(), b"a file");
}
