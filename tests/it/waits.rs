//! Waits for conditions, with a bound so generous that only what never comes reaches it.
#![allow(clippy::disallowed_methods, reason = "other processes and threads are waited for, outside any tick")]

use std::fs;
use std::path::Path;
use std::process::{Child, Command, ExitStatus, Output};
use std::thread::sleep;
use std::time::{Duration, Instant};

/// Longest wait for something that must come. Only a failing test waits that long, on however busy a machine.
pub(crate) const PATIENCE: Duration = Duration::from_secs(600);

/// Looks again and again until there is something to return; fails if `what` does not come to pass.
#[track_caller]
pub(crate) fn until<T>(what: &str, mut look: impl FnMut() -> Option<T>) -> T {
    let (begun, mut nap) = (Instant::now(), Duration::from_micros(100));
    loop {
        if let Some(found) = look() {
            return found;
        }
        assert!(begun.elapsed() < PATIENCE, "waited {} s in vain: {what}", PATIENCE.as_secs());
        sleep(nap);
        nap = (nap * 2).min(Duration::from_millis(10));
    }
}

/// Lets other processes and threads go on for a while. No outcome may depend on how far they come.
pub(crate) fn pause(s: f64) {
    sleep(Duration::from_secs_f64(s));
}

/// A process that ends with the test, whatever becomes of it.
pub(crate) struct Process(pub(crate) Child);

impl Process {
    #[track_caller]
    pub(crate) fn start(command: &mut Command) -> Self {
        Self(command.spawn().expect("it starts"))
    }

    /// How it has ended, if it has.
    pub(crate) fn ended(&mut self) -> Option<ExitStatus> {
        self.0.try_wait().expect("it is our child")
    }

    /// Waits for its end.
    #[track_caller]
    pub(crate) fn end(&mut self) -> ExitStatus {
        until("a process ends", || self.ended())
    }

    /// Waits for its end; what it says is read meanwhile.
    #[track_caller]
    pub(crate) fn output(mut self) -> Output {
        let reader = |pipe: Option<Box<dyn std::io::Read + Send>>| {
            std::thread::spawn(move || {
                let mut bytes = Vec::new();
                if let Some(mut pipe) = pipe {
                    pipe.read_to_end(&mut bytes).expect("a pipe");
                }
                bytes
            })
        };
        let out = reader(self.0.stdout.take().map(|p| Box::new(p) as _));
        let err = reader(self.0.stderr.take().map(|p| Box::new(p) as _));
        let status = self.end();
        Output { status, stdout: out.join().expect("read"), stderr: err.join().expect("read") }
    }

    pub(crate) fn kill(&mut self) {
        self.0.kill().expect("it is our child");
        self.0.wait().expect("it is our child");
    }

    /// Sends it a signal, such as `-INT`, if it has not ended.
    pub(crate) fn signal(&mut self, name: &str) {
        if self.ended().is_none() {
            let id = self.0.id().to_string();
            let sent = Command::new("kill").args([name, &id]).status();
            assert!(sent.expect("kill is there").success());
        }
    }

    /// Waits until it would not die of a signal any more, because it handles it; `false` if it has ended before.
    #[track_caller]
    pub(crate) fn handles(&mut self, signal: u32) -> bool {
        let status = format!("/proc/{}/status", self.0.id());
        if !Path::new(&status).exists() && self.ended().is_none() {
            // No machine with Linux: nothing tells.
            pause(2.0);
            return self.ended().is_none();
        }
        until("a process handles a signal", || {
            if self.ended().is_some() {
                return Some(false);
            }
            let text = fs::read_to_string(&status).ok()?;
            let caught = text.lines().find_map(|l| l.strip_prefix("SigCgt:"))?;
            let caught = u64::from_str_radix(caught.trim(), 16).expect("a mask");
            (caught >> (signal - 1) & 1 == 1).then_some(true)
        })
    }
}

impl Drop for Process {
    fn drop(&mut self) {
        // It may have ended.
        let _ended = self.0.kill();
        let _reaped = self.0.wait();
    }
}

/// Signals by their number.
pub(crate) const INT: u32 = 2;
pub(crate) const TERM: u32 = 15;

/// Kills a process that does its work in parts, and starts it again, until all is done: a few times at any moment from
/// its start, then each time after some new parts, so that it gets on however slow the machine is. `parts` counts what
/// is done, `draw` gives numbers from 0 to 1, `killed` looks at what each kill has left. Returns how often it was
/// killed, and how many of these times it had got on.
#[track_caller]
pub(crate) fn kill_again_and_again(
    mut start: impl FnMut() -> Process,
    parts: impl Fn() -> usize,
    mut draw: impl FnMut() -> f64,
    mut killed: impl FnMut(),
) -> [u32; 2] {
    const AT_ANY_MOMENT: u32 = 10;
    let [mut kills, mut grew] = [0, 0];
    loop {
        let before = parts();
        let mut process = start();
        let over = if kills < AT_ANY_MOMENT {
            pause(0.05 * draw());
            process.ended()
        } else {
            let more = before + 1 + (3.0 * draw()) as usize;
            let over = until("it gets on", || process.ended().map(Some).or_else(|| (parts() >= more).then_some(None)));
            // Not always just after a part.
            pause(if over.is_some() { 0.0 } else { 0.02 * draw() });
            over.or_else(|| process.ended())
        };
        process.kill();
        killed();
        grew += u32::from(parts() > before);
        if let Some(status) = over {
            assert!(status.success(), "{status}");
            return [kills, grew];
        }
        kills += 1;
    }
}
