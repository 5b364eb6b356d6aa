//! The command line of `stargrip-cam`.

use std::process::ExitCode;

fn main() -> ExitCode {
    stargrip_cam::cli::main()
}
