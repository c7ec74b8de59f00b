//! What `rheotaxis --version` prints: all that tells two builds apart, for reports of errors.

use plumes::filaments;
use rheotaxis::scenario::{OLDEST, VERSION};
use std::sync::LazyLock;

/// Version, features, processor path, target and profile, on a line each. `-V` prints the version alone.
pub(super) fn long() -> &'static str {
    static TEXT: LazyLock<String> = LazyLock::new(text);
    &TEXT
}

fn text() -> String {
    let features = match cfg!(feature = "live") {
        true => "live (state over zenoh, TLS included)",
        false => "none (without live: no state over zenoh)",
    };
    format!(
        "{}\nscenarios: versions {OLDEST} to {VERSION}\nfeatures:  {features}\nprocessor: {} ({} for filaments)\n\
         target:    {}\nprofile:   {}",
        env!("CARGO_PKG_VERSION"),
        std::env::consts::ARCH,
        filaments::instructions(),
        env!("RHEOTAXIS_TARGET"),
        env!("RHEOTAXIS_PROFILE"),
    )
}

#[cfg(test)]
mod tests {
    use super::super::Args;
    use clap::CommandFactory;

    #[test]
    fn the_long_version_tells_two_builds_apart() {
        let said = Args::command().render_long_version();
        let lines: Vec<&str> = said.trim_end().lines().collect();
        assert_eq!(lines[0], concat!("rheotaxis ", env!("CARGO_PKG_VERSION")));
        let value = |name: &str| {
            let found = lines.iter().find_map(|l| l.strip_prefix(name));
            found
                .unwrap_or_else(|| panic!("no {name} in\n{said}"))
                .trim()
        };
        assert_eq!(
            value("features:").starts_with("live "),
            cfg!(feature = "live")
        );
        assert!(
            value("target:").starts_with(std::env::consts::ARCH),
            "{said}"
        );
        assert!(["debug", "release"].contains(&value("profile:")), "{said}");
        #[cfg(target_arch = "x86_64")]
        {
            let fast = std::arch::is_x86_feature_detected!("avx2");
            assert_eq!(value("processor:").contains("AVX"), fast, "{said}");
        }
    }

    #[test]
    fn the_short_version_is_one_line() {
        let said = Args::command().render_version();
        assert_eq!(said, concat!("rheotaxis ", env!("CARGO_PKG_VERSION"), "\n"));
    }
}
