//! The command line of `stargrip-cam`.

fn main() {}
