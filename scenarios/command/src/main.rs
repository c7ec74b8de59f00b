//! The command `rheotaxis`; everything it does is in the library.

fn main() -> std::process::ExitCode {
    command::main()
}
