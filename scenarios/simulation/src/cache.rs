//! Spun-up plumes kept on the disk, so that the second run with the same ocean need not make it again.
//!
//! A run that takes a kept state over is the same, bit for bit, as one that spins up itself. A state is found under a
//! digest of its [`Origin`] (seed, place, water, obstacles with the content of their files,
//! sources, spin-up) and of the running program's own file. No version number is trusted: another build, or the same
//! library in another program with currents of its own, makes its own states. Vector instructions do not count, because
//! all give the same bits. Code from a shared library does not count either: if this crate is built into a plug-in,
//! [`SpinUps::made_by`] names the plug-in's file.
//!
//! The library keeps nothing unless it is asked to:
//!
//! ```no_run
//! # use rheotaxis::{cache::{MOST, SpinUps}, scenario, trial::{Trial, Unwatched}};
//! # let scenario = scenario::load("duck_st".as_ref())?;
//! let kept = SpinUps::of_user(MOST).expect("there is a home folder");
//! let mut trial = Trial::assemble(&scenario, 7)?;
//! trial.spin_up_with(&kept, &mut Unwatched); // seconds the first time, milliseconds from then on
//! let ended = trial.run(&mut Unwatched);
//! if let Some(fault) = kept.fault() {
//!     eprintln!("{fault}"); // the run went on without
//! }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! - The folder holds at most a number of bytes ([`MOST`]). The least recently used states go first. A process adds a
//!   quarter of that at most, so a campaign of thousands of seeds keeps its first hundreds and leaves most others' be.
//! - A state that was made in less than half a second is not kept.
//! - Every file is checked when it is read. A damaged or foreign one is removed and made again.
//! - A run under a secret key ([`Key`](world::seeds::Key)) is neither kept nor looked for: its plume is what the key
//!   hides.
//! - The states are as trustworthy as the folder: whoever may write there can put a wrong state there.
#![allow(
    clippy::disallowed_methods,
    reason = "the time that a spin-up took decides whether it is kept, never what it is"
)]

use crate::lanes::Lanes;
use crate::ocean::{Mismatch, Ocean, Origin, SpunUp};
use crate::trial::{Event, Observer, Trial};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, OnceLock, PoisonError};
use std::time::{Duration, Instant};
use world::digest::Fingerprint;
use world::files::{self, Shelf, ShelfEntry, ShelfError};

/// The most bytes that kept spin-ups take, unless another bound is given.
pub const MOST: u64 = 2_000_000_000;
/// A spin-up that took less is not kept, unless another time is given: it costs little more to make than to read.
pub const LEAST: Duration = Duration::from_millis(500);

/// A folder of kept spin-ups. Threads may share it, and processes the folder.
#[derive(Debug)]
pub struct SpinUps {
    shelf: Shelf,
    least: Duration,
    maker: Option<(PathBuf, OnceLock<io::Result<[u8; 32]>>)>,
    fault: Mutex<Option<CacheFault>>,
    /// Set once the folder could not be used: a full disk is not tried again for every run.
    given_up: AtomicBool,
}

/// Why spin-ups were made although they might have been kept. The runs are the same as without a cache.
#[derive(Debug, thiserror::Error)]
pub enum CacheFault {
    /// The folder or a file in it cannot be read or written.
    #[error("spin-ups are not kept, and the runs go on without: {0}")]
    Folder(#[from] ShelfError),
    /// The program's own file cannot be read, so nobody can tell which program makes the states.
    #[error("spin-ups are not kept, and the runs go on without: the program's own file cannot be read: {0}")]
    Program(io::Error),
    /// A kept state was damaged, or something else stood in its place.
    #[error("a kept spin-up in {} was damaged; it was removed and made anew", .0.display())]
    Broken(PathBuf),
}

/// A spin-up, and where it came from.
#[derive(Clone, Debug)]
pub struct SpinUp {
    /// The state, for other runs to take over.
    pub state: SpunUp,
    /// Whether it was kept, so that it had not to be made.
    pub kept: bool,
}

impl SpinUps {
    /// Those in the user's cache folder, which may hold so many bytes; `None` if the system names no such folder.
    pub fn of_user(most: u64) -> Option<Self> {
        dirs::cache_dir().map(|dir| Self::new(dir.join("rheotaxis"), most))
    }

    /// Those in a folder, which need not exist yet, with the most bytes that it may hold.
    pub fn new(dir: PathBuf, most: u64) -> Self {
        Self {
            shelf: Shelf::new(dir, most),
            least: LEAST,
            maker: None,
            fault: Mutex::new(None),
            given_up: AtomicBool::new(false),
        }
    }

    /// Keeps those that took at least this long.
    #[must_use]
    pub fn from(mut self, least: Duration) -> Self {
        self.least = least;
        self
    }

    /// Those that the program in this file makes, instead of the running program's own: for a plug-in.
    #[must_use]
    pub fn made_by(mut self, file: PathBuf) -> Self {
        self.maker = Some((file, OnceLock::new()));
        self
    }

    /// Fingerprint of the file with the program that makes the states.
    fn program(&self) -> Result<&[u8; 32], &io::Error> {
        let Some((file, print)) = &self.maker else {
            return program();
        };
        print.get_or_init(|| fingerprint(file)).as_ref()
    }

    /// The folder with its files.
    pub fn shelf(&self) -> &Shelf {
        &self.shelf
    }

    /// The first fault since this was asked last.
    pub fn fault(&self) -> Option<CacheFault> {
        self.noted().take()
    }

    fn noted(&self) -> std::sync::MutexGuard<'_, Option<CacheFault>> {
        self.fault.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn note(&self, fault: CacheFault) {
        if !matches!(fault, CacheFault::Broken(_)) {
            self.given_up.store(true, Ordering::Relaxed);
        }
        self.noted().get_or_insert(fault);
    }

    /// The key of a spin-up; `None` if it is not to be kept.
    fn key(&self, origin: &Origin) -> Option<[u8; 32]> {
        let secret = origin.seed().key().mark().is_some();
        if secret || origin.spin_up_s() <= 0.0 || self.given_up.load(Ordering::Relaxed) {
            return None;
        }
        match self.program() {
            Ok(program) => {
                let mut key = Fingerprint::default();
                key.part(b"rheotaxis spun-up plume");
                key.part(program);
                key.part(origin.text().as_bytes());
                Some(key.finish())
            }
            Err(e) => {
                self.note(CacheFault::Program(io::Error::new(e.kind(), e.to_string())));
                None
            }
        }
    }

    /// What is kept for an ocean that has not been spun up.
    fn get(&self, key: &[u8; 32], origin: &Origin, ocean: &Ocean) -> Option<SpunUp> {
        let broken = || CacheFault::Broken(self.shelf.dir().to_owned());
        match self.shelf.get(key) {
            Ok(ShelfEntry::Nothing) => None,
            Ok(ShelfEntry::Broken) => {
                self.note(broken());
                None
            }
            Ok(ShelfEntry::Whole(bytes)) => {
                let read = SpunUp::read(ocean, origin, &bytes);
                // What another program of the same bytes wrote can be read; so this is a mistake of ours, or malice.
                read.inspect_err(|_| self.note(broken())).ok()
            }
            Err(error) => {
                self.note(error.into());
                None
            }
        }
    }

    fn store(&self, key: &[u8; 32], state: &SpunUp) {
        if let Err(error) = self.shelf.store(key, &state.bytes()) {
            self.note(error.into());
        }
    }

    /// Has `runs` in an ocean that has not been spun up take over what is kept for it. Otherwise it is spun up, and
    /// kept if that took long enough.
    fn develop<R>(
        &self,
        runs: &mut R,
        ocean: impl FnOnce(&R) -> Option<(&Origin, &Ocean)>,
        take_over: impl FnOnce(&mut R, &SpunUp) -> Result<(), Mismatch>,
        spin_up: impl FnOnce(&mut R) -> Option<SpunUp>,
    ) -> Option<SpinUp> {
        let (origin, ocean) = ocean(runs)?;
        let key = self.key(origin);
        if let Some(state) = key.and_then(|key| self.get(&key, origin, ocean))
            && take_over(runs, &state).is_ok()
        {
            return Some(SpinUp { state, kept: true });
        }
        let begun = Instant::now();
        let state = spin_up(runs)?;
        if let Some(key) = key
            && begun.elapsed() >= self.least
        {
            self.store(&key, &state);
        }
        Some(SpinUp { state, kept: false })
    }
}

impl Trial {
    /// As [`Trial::spin_up`], but a kept spin-up is taken over if there is one, and else one that took long enough is
    /// kept. Whatever is wrong with the folder, the trial is spun up; [`SpinUps::fault`] tells.
    ///
    /// # Panics
    /// If the run has been spun up before.
    pub fn spin_up_with(&mut self, kept: &SpinUps, observer: &mut dyn Observer) -> Option<SpinUp> {
        let developed = kept.develop(
            self,
            |trial| Some((&trial.simulation.origin, trial.simulation.ocean())),
            Trial::take_over,
            |trial| trial.spin_up(observer),
        )?;
        observer.see(&Event::SpinUpFromCache(developed.kept));
        Some(developed)
    }
}

impl<O: Observer> Lanes<O> {
    /// As [`Lanes::spin_up`], but a kept spin-up is taken over if there is one, and else one that took long enough is
    /// kept. Whatever is wrong with the folder, the lanes are spun up; [`SpinUps::fault`] tells.
    ///
    /// # Panics
    /// If the lanes have been spun up before.
    pub fn spin_up_with(&mut self, kept: &SpinUps) -> Option<SpinUp> {
        let developed = kept.develop(self, Lanes::ocean, Lanes::take_over, Lanes::spin_up)?;
        self.tell_cached(developed.kept);
        Some(developed)
    }
}

/// The first 32 hexadecimal digits of the fingerprint of the running program's file; `unknown` if it cannot be read.
/// Programs with other algorithms of their own have another one, even if they call themselves by one version.
pub fn program_mark() -> String {
    program().map_or_else(|_| "unknown".to_string(), |print| Fingerprint::hex(print)[..32].to_string())
}

/// Fingerprint of the running program's file, made once in a process.
fn program() -> Result<&'static [u8; 32], &'static io::Error> {
    static PROGRAM: OnceLock<io::Result<[u8; 32]>> = OnceLock::new();
    let read = || {
        // On Linux this is the running file even if another has its name by now.
        let linux = Path::new("/proc/self/exe");
        let path = if linux.exists() { linux.to_owned() } else { std::env::current_exe()? };
        fingerprint(&path)
    };
    PROGRAM.get_or_init(read).as_ref()
}

fn fingerprint(file: &Path) -> io::Result<[u8; 32]> {
    let mut program = Fingerprint::default();
    program.read(files::open(file)?)?;
    Ok(program.finish())
}
