//! Makes the section's table anew, and prints it: the command of its provenance.
//!
//! `cargo run --release -p research --example section_table > crates/inflatable/src/mechanics/hinge/section/table.txt`

use sha2::{Digest, Sha256};
use stargrip_cam::mechanics::hinge::section::SectionTable;
use std::error::Error;
use std::fmt::Write;

fn main() -> Result<(), Box<dyn Error>> {
    let body = SectionTable::make(&mut |done, total| {
        if done % 200 == 0 {
            eprintln!("{done} of {total}");
        }
    })?;
    let mut hash = String::new();
    for byte in Sha256::digest(&body) {
        write!(hash, "{byte:02x}")?;
    }
    println!(
        "# The section at rest as Chebyshev series; read by crates/inflatable/src/mechanics/hinge/section/table.rs."
    );
    println!(
        "# Made by `cargo run --release -p research --example section_table`. SHA-256 of the lines below: {hash}"
    );
    println!(
        "# Orders in 1/eps, tau, R*, nu; millionths of ln(lambda - 1), ln C, ln V, width, and four ln(secant / C)."
    );
    print!("{body}");
    Ok(())
}
