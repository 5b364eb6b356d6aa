//! Makes the section's table anew, and prints it: the command of its provenance. Minutes.
//!
//! `cargo run --release -p research --example section_table > /tmp/table.txt && mv /tmp/table.txt crates/inflatable/src/mechanics/hinge/section/table.txt`

use sha2::{Digest, Sha256};
use stargrip_cam::mechanics::fault::HingeFault;
use stargrip_cam::mechanics::hinge::HingeModel;
use stargrip_cam::mechanics::hinge::section::{OFFSETS, Section, hinge_at};
use stargrip_cam::numerics::Chebyshev;
use std::error::Error;
use std::fmt::Write;

/// Points of each series: b, tau, R*, nu.
const COUNTS: [usize; 4] = [11, 7, 9, 3];
/// Coefficients below this, in every quantity, are left out.
const SMALLEST: f64 = 3e-5;

/// The eight smooth quantities: logarithms of those that span decades.
type Quantities = [f64; 8];

fn main() -> Result<(), Box<dyn Error>> {
    let body = table()?;
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

/// The series from the solver, a line a coefficient that counts.
fn table() -> Result<String, Box<dyn Error>> {
    let points = COUNTS.map(Chebyshev::points);
    let total: usize = COUNTS.iter().product();
    let mut values = Vec::with_capacity(total);
    for number in 0..total {
        let index = indices(number);
        values.push(quantities(hinge_at(std::array::from_fn(|i| points[i][index[i]])))?);
        if (number + 1) % 200 == 0 {
            eprintln!("{} of {total}", number + 1);
        }
    }
    // One dimension after the other, each line of values becomes its coefficients.
    for dimension in 0..4 {
        for start in (0..total).filter(|number| indices(*number)[dimension] == 0) {
            let stride: usize = COUNTS[dimension + 1..].iter().product();
            let places = (0..COUNTS[dimension]).map(|i| start + i * stride);
            let line: Vec<Quantities> = places.clone().map(|place| values[place]).collect();
            for (place, coefficients) in places.zip(transformed(&line)) {
                values[place] = coefficients;
            }
        }
    }
    let mut text = String::new();
    for (number, coefficients) in values.iter().enumerate() {
        if coefficients.iter().any(|c| c.abs() >= SMALLEST) {
            let orders = indices(number).map(|k| k.to_string()).join(" ");
            let millionths = coefficients.iter().map(|c| format!("{:.0}", 1e6 * c).replace("-0", "0"));
            writeln!(text, "{orders} {}", millionths.collect::<Vec<_>>().join(" "))?;
        }
    }
    Ok(text)
}

/// Chebyshev coefficients of each quantity, whose values at the points are `line`.
fn transformed(line: &[Quantities]) -> Vec<Quantities> {
    let series: [Chebyshev; 8] = std::array::from_fn(|quantity| {
        let values: Vec<f64> = line.iter().map(|values| values[quantity]).collect();
        Chebyshev::interpolating(&values)
    });
    (0..line.len()).map(|i| std::array::from_fn(|quantity| series[quantity].coefficients()[i])).collect()
}

/// Indices of a point in the four dimensions, the last one fastest.
fn indices(mut number: usize) -> [usize; 4] {
    let mut index = [0; 4];
    for (own, count) in index.iter_mut().zip(COUNTS).rev() {
        *own = number % count;
        number /= count;
    }
    index
}

/// The quantities of a hinge by 1/eps, tau, R* and nu.
fn quantities([bendability, tau, r_star, poisson]: [f64; 4]) -> Result<Quantities, HingeFault> {
    let section = Section::by_ratios(bendability, tau, poisson);
    let rest = section.target(r_star)?;
    let away = OFFSETS.map(|part| part * (rest.lambda - 1.0));
    let mut secants = [0.0; 4];
    for half in [[1, 0], [2, 3]] {
        let states = section.curve(r_star, &half.map(|i: usize| rest.lambda + away[i]))?;
        for (i, state) in half.into_iter().zip(states) {
            secants[i] = (state.slope / away[i] / rest.curvature).ln();
        }
    }
    let edges = rest.edges.ok_or(HingeFault::Unsolved { r_star, lambda: rest.lambda, residual: f64::MAX })?;
    let [a, b, c, d] = secants;
    let opening = edges.tension * rest.lambda;
    Ok([(rest.lambda - 1.0).ln(), (-rest.curvature).ln(), opening.ln(), edges.width, a, b, c, d])
}
