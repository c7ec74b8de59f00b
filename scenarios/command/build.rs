//! Hands the target and the profile of this build to `rheotaxis --version`.

#![allow(clippy::print_stdout, reason = "a build script speaks to cargo")]

fn main() {
    for (name, from) in [("RHEOTAXIS_TARGET", "TARGET"), ("RHEOTAXIS_PROFILE", "PROFILE")] {
        let value = std::env::var(from).unwrap_or_else(|_| "unknown".to_string());
        println!("cargo::rustc-env={name}={value}");
    }
    println!("cargo::rerun-if-changed=build.rs");
}
