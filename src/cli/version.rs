//! The version of the program, and for a report of a fault the build that it is.

use std::env::consts::{ARCH, OS};
use std::ffi::OsString;

/// Whether the arguments are `--version` and `-v` alone, in any order and spelling.
pub(super) fn wants_build(args: &[OsString]) -> bool {
    let (mut version, mut verbose) = (false, false);
    for arg in args.iter().skip(1) {
        match arg.to_str() {
            Some("--version" | "-V") => version = true,
            Some("--verbose" | "-v") => verbose = true,
            Some("-vV" | "-Vv") => (version, verbose) = (true, true),
            _ => return false,
        }
    }
    version && verbose
}

/// The version, and the facts in which two builds of it may differ: commit, system, features, optimisation.
///
/// The scripts below packaging/ name the commit. A build by cargo alone does not ask git for it: each commit would compile this crate again.
pub(super) fn build() -> String {
    let commit = option_env!("STARGRIP_COMMIT").filter(|commit| !commit.is_empty()).unwrap_or("not recorded");
    let library = if cfg!(target_env = "musl") {
        " musl"
    } else if cfg!(target_env = "gnu") {
        " gnu"
    } else if cfg!(target_env = "msvc") {
        " msvc"
    } else {
        ""
    };
    let optimised = if cfg!(debug_assertions) { "no" } else { "yes" };
    format!(
        "{} {}\ncommit     {commit}\ntarget     {ARCH} {OS}{library}\nfeatures   cli\noptimised  {optimised}\n",
        env!("CARGO_PKG_NAME"),
        env!("CARGO_PKG_VERSION"),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn is_listed(line: &str) -> bool {
        wants_build(&line.split(' ').map(OsString::from).collect::<Vec<_>>())
    }

    #[test]
    fn the_build_is_printed_for_both_flags_alone() {
        for line in ["p --version -v", "p -v --version", "p -V -v", "p -Vv", "p -vV", "p --verbose --version"]
        {
            assert!(is_listed(line), "{line}");
        }
        for line in ["p", "p --version", "p -v", "p check -v", "p --version -v check", "p --version -v -q"] {
            assert!(!is_listed(line), "{line}");
        }
    }

    #[test]
    fn the_build_names_version_commit_and_target() {
        let text = build();
        assert!(text.starts_with(concat!("stargrip-cam ", env!("CARGO_PKG_VERSION"), "\n")), "{text}");
        for name in ["commit  ", "target  ", "features  ", "optimised  "] {
            assert_eq!(text.lines().filter(|line| line.starts_with(name)).count(), 1, "{text}");
        }
    }
}
