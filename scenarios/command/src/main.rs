//! The program `rheotaxis`; all of its code is in the library of this crate.

fn main() -> std::process::ExitCode {
    command::main()
}
