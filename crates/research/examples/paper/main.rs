//! Every figure and number of the paper that the models can compute: the tables of docs/paper.md.
//!
//! `cargo run --release -p research --example paper`; with `-- --svg docs` it writes the pictures there, too. `-- --shells` computes the contents of
//! shells.txt, and prints them, in minutes.

mod actuator_pictures;
mod actuators;
mod cone;
mod lifting;
mod membrane;
mod paper_fabric;
mod plot;
mod shells;
mod star_pictures;
mod stars;

use std::error::Error;
use std::path::Path;

fn main() -> Result<(), Box<dyn Error>> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    match words[..] {
        ["--shells"] => shells::compute(),
        ["--svg", directory] => {
            print!("{}", tables());
            for (name, picture) in pictures() {
                std::fs::write(Path::new(directory).join(name), picture)?;
            }
        }
        [] => print!("{}", tables()),
        _ => return Err("takes nothing, --svg DIRECTORY or --shells".into()),
    }
    Ok(())
}

/// All tables, in the order of the page.
pub fn tables() -> String {
    let [angles, coiling, by_width, by_angle, moment] = actuators::tables();
    let [balance, offset] = cone::tables();
    let parts = [
        membrane::before(),
        angles,
        coiling,
        membrane::volumes(),
        by_width,
        by_angle,
        moment,
        stars::closed_form(),
        stars::radii(),
        lifting::coarse_stars(),
        membrane::scale(),
        stars::curves(),
        stars::forces(),
        balance,
        offset,
        lifting::payload(),
        lifting::coating(),
    ];
    parts.concat()
}

/// All pictures, by the names of their files.
pub fn pictures() -> Vec<(&'static str, String)> {
    let mut all = actuator_pictures::pictures().to_vec();
    all.extend(star_pictures::pictures());
    all
}
