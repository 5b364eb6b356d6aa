//! The ring by brute force: a chain of straight segments whose enclosed volume is maximised directly.
//!
//! No equation of equilibrium, no regimes: only segment angles, the volume of a polygon turned around
//! the axis, and the constraints, by an augmented Lagrangian and limited-memory quasi-Newton steps.

#![expect(clippy::cast_precision_loss, reason = "chains have a few dozen segments")]

use crate::mechanics::hinge::HingeModel;
use crate::mechanics::hinge::ring::Ring;

struct Chain {
    r_star: f64,
    lambda: f64,
    /// Multipliers of `lambda r - s <= 0` at the nodes, and of `z(1) = 0`.
    hoop: Vec<f64>,
    closing: f64,
    weight: f64,
}

impl Chain {
    fn nodes(angles: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let step = 1.0 / angles.len() as f64;
        let (mut r, mut z) = (vec![0.0], vec![0.0]);
        for angle in angles {
            r.push(r[r.len() - 1] + step * libm::cos(*angle));
            z.push(z[z.len() - 1] + step * libm::sin(*angle));
        }
        (r, z)
    }

    /// `V / (W^3 alpha_0)` of the polygon, exactly, and its gradient with respect to the nodes.
    fn volume(&self, r: &[f64], z: &[f64]) -> (f64, Vec<f64>, Vec<f64>) {
        let axis = self.r_star / self.lambda;
        let (mut sum, mut by_r, mut by_z) = (0.0, vec![0.0; r.len()], vec![0.0; z.len()]);
        for k in 0..r.len() - 1 {
            let (q0, q1, z0, z1) = (axis + r[k], axis + r[k + 1], z[k], z[k + 1]);
            let mean = (2.0 * (q0 * z0 + q1 * z1) + q0 * z1 + q1 * z0) / 6.0;
            let (d, scale) = (q1 - q0, 2.0 * self.lambda);
            sum += scale * d * mean;
            by_r[k] += scale * (d * (2.0 * z0 + z1) / 6.0 - mean);
            by_r[k + 1] += scale * (d * (2.0 * z1 + z0) / 6.0 + mean);
            by_z[k] += scale * d * (2.0 * q0 + q1) / 6.0;
            by_z[k + 1] += scale * d * (2.0 * q1 + q0) / 6.0;
        }
        (sum, by_r, by_z)
    }

    /// The augmented Lagrangian to be minimised, and its gradient with respect to the angles.
    fn merit(&self, angles: &[f64]) -> (f64, Vec<f64>) {
        let (r, z) = Self::nodes(angles);
        let (volume, mut by_r, mut by_z) = self.volume(&r, &z);
        let count = angles.len();
        let step = 1.0 / count as f64;
        let mut merit = -volume;
        for g in by_r.iter_mut().chain(&mut by_z) {
            *g = -*g;
        }
        for k in 1..=count {
            let push = (self.hoop[k] + self.weight * step * (self.lambda * r[k] - k as f64 * step)).max(0.0);
            merit += 0.5 * push * push / (self.weight * step);
            by_r[k] += push * self.lambda;
        }
        let lift = self.closing + self.weight * z[count];
        merit += 0.5 * lift * lift / self.weight;
        by_z[count] += lift;
        let mut gradient = vec![0.0; count];
        let (mut right, mut upward) = (0.0, 0.0);
        for k in (0..count).rev() {
            right += by_r[k + 1];
            upward += by_z[k + 1];
            gradient[k] = step * (upward * libm::cos(angles[k]) - right * libm::sin(angles[k]));
        }
        (merit, gradient)
    }

    fn update(&mut self, angles: &[f64]) {
        let (r, z) = Self::nodes(angles);
        let step = 1.0 / angles.len() as f64;
        for (k, (hoop, r)) in self.hoop.iter_mut().zip(&r).enumerate() {
            *hoop = (*hoop + self.weight * step * (self.lambda * r - k as f64 * step)).max(0.0);
        }
        self.closing += self.weight * z[r.len() - 1];
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// `a += factor * b`
fn add(a: &mut [f64], factor: f64, b: &[f64]) {
    for (x, y) in a.iter_mut().zip(b) {
        *x += factor * y;
    }
}

/// Minimises by L-BFGS with Armijo steps.
fn minimise(chain: &Chain, angles: &mut Vec<f64>) {
    // The two loops over the memory turn the gradient into a quasi-Newton direction. A step is halved until the merit
    // falls by a part of what the slope promises. The last twenty steps are remembered.
    let (mut merit, mut gradient) = chain.merit(angles);
    let mut memory: Vec<(Vec<f64>, Vec<f64>)> = Vec::new();
    for _ in 0..600 {
        if dot(&gradient, &gradient).sqrt() < 1e-10 {
            return;
        }
        let mut direction = gradient.clone();
        let mut factors = Vec::new();
        for (s, y) in memory.iter().rev() {
            let factor = dot(s, &direction) / dot(s, y);
            add(&mut direction, -factor, y);
            factors.push(factor);
        }
        let scale = memory.last().map_or(1.0, |(s, y)| dot(s, y) / dot(y, y));
        for d in &mut direction {
            *d *= scale;
        }
        for ((s, y), factor) in memory.iter().zip(factors.iter().rev()) {
            let back = factor - dot(y, &direction) / dot(s, y);
            add(&mut direction, back, s);
        }
        let slope = dot(&direction, &gradient);
        let mut length = 1.0;
        loop {
            let trial: Vec<f64> = angles.iter().zip(&direction).map(|(a, d)| a - length * d).collect();
            let (next, next_gradient) = chain.merit(&trial);
            if next <= merit - 1e-4 * length * slope {
                let s: Vec<f64> = direction.iter().map(|d| -length * d).collect();
                let y: Vec<f64> = next_gradient.iter().zip(&gradient).map(|(a, b)| a - b).collect();
                if dot(&s, &y) > 0.0 {
                    memory.push((s, y));
                }
                if memory.len() > 20 {
                    drop(memory.remove(0));
                }
                (*angles, merit, gradient) = (trial, next, next_gradient);
                break;
            }
            length *= 0.5;
            if length < 1e-12 {
                return;
            }
        }
    }
}

/// The largest volume of a chain of `count` segments.
fn largest_volume(r_star: f64, lambda: f64, count: usize) -> f64 {
    let weight = 30.0 * (1.0 + r_star);
    let mut chain = Chain { r_star, lambda, hoop: vec![0.0; count + 1], closing: 0.0, weight };
    let mut angles: Vec<f64> = (0..count).map(|k| 1.0 - 2.5 * (k as f64 + 0.5) / count as f64).collect();
    for _ in 0..16 {
        minimise(&chain, &mut angles);
        chain.update(&angles);
        chain.weight *= 1.5;
    }
    let (r, z) = Chain::nodes(&angles);
    let violation =
        (1..=count).map(|k| chain.lambda * r[k] - k as f64 / count as f64).fold(z[count].abs(), f64::max);
    assert!(violation < 2e-5, "constraints kept to {violation:.1e}");
    chain.volume(&r, &z).0
}

#[test]
fn no_chain_encloses_more_than_the_ring_and_long_ones_come_close() {
    for (r_star, lambda) in [(0.0, 1.28), (0.1, 1.1), (0.1, 1.5), (1.0, 1.4)] {
        let exact = Ring.state(r_star, lambda).expect("solved").volume.expect("known");
        let errors = [16, 32].map(|count| largest_volume(r_star, lambda, count) / exact - 1.0);
        println!("R* {r_star} lambda {lambda}: {errors:?}");
        // Polygons converge like 1/count^2: a quarter at twice the count, and the rest after extrapolation.
        let extrapolated = errors[1] + (errors[1] - errors[0]) / 3.0;
        assert!(extrapolated.abs() < 1e-3, "R* {r_star} lambda {lambda}: {errors:?}");
        assert!((2.8..5.5).contains(&(errors[0] / errors[1])), "R* {r_star} lambda {lambda}: {errors:?}");
    }
}
