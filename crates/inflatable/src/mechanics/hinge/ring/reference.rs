//! The ring in some 30 digits, by code independent of the solver: double-double numbers,
//! tanh-sinh quadrature in phi, volume by its definition, derivatives by differencing the volume.

use crate::mechanics::hinge::ring::Ring;
use crate::mechanics::hinge::ring::section::{LAMBDA, TENSION};
use crate::mechanics::hinge::ring::solve::{Solved, solve_cone, solve_free, solve_target};
use crate::mechanics::hinge::{HingeModel, seal_load};
use std::f64::consts::FRAC_PI_2;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// An unevaluated sum of two numbers: about 31 digits.
#[derive(Clone, Copy, Debug)]
struct Wide(f64, f64);

impl Wide {
    fn from_f64(x: f64) -> Self {
        Self(x, 0.0)
    }
    fn sum(a: f64, b: f64) -> Self {
        let s = a + b;
        let t = s - a;
        Self(s, (a - (s - t)) + (b - t))
    }
    fn sqrt(self) -> Self {
        if self.0 <= 0.0 {
            return Self::from_f64(0.0);
        }
        let root = Self::from_f64(self.0.sqrt());
        (root + self / root) * Self::from_f64(0.5)
    }
    /// Taylor series of exp, after halving the argument ten times.
    fn exp(self) -> Self {
        let x = self * Self::from_f64(1.0 / 1024.0);
        let (mut term, mut sum) = (Self::from_f64(1.0), Self::from_f64(1.0));
        for k in 1..14 {
            term = term * x / Self::from_f64(f64::from(k));
            sum = sum + term;
        }
        (0..10).fold(sum, |value, _| value * value)
    }
    /// Taylor series, after halving the argument four times.
    fn sin_cos(self) -> (Self, Self) {
        let x = self * Self::from_f64(1.0 / 16.0);
        let square = x * x;
        let (mut sin, mut cos) = (Self::from_f64(0.0), Self::from_f64(0.0));
        let mut term = Self::from_f64(1.0);
        for k in 0..11 {
            cos = cos + term;
            let odd = term * x / Self::from_f64(f64::from(2 * k + 1));
            sin = sin + odd;
            term = -(term * square / Self::from_f64(f64::from((2 * k + 1) * (2 * k + 2))));
        }
        let unit = Self::from_f64(1.0);
        (0..4).fold((sin, cos), |(s, c), _| (s * c * Self::from_f64(2.0), unit - s * s * Self::from_f64(2.0)))
    }
}

impl Add for Wide {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let Self(s, e) = Self::sum(self.0, other.0);
        let Self(t, f) = Self::sum(self.1, other.1);
        let Self(s, e) = Self::sum(s, e + t);
        Self::sum(s, e + f)
    }
}
impl Neg for Wide {
    type Output = Self;
    fn neg(self) -> Self {
        Self(-self.0, -self.1)
    }
}
impl Sub for Wide {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}
impl Mul for Wide {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let p = self.0 * other.0;
        let e = self.0.mul_add(other.0, -p);
        Self::sum(p, e + (self.0 * other.1 + self.1 * other.0))
    }
}
impl Div for Wide {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let mut quotient = Self::from_f64(self.0 / other.0);
        for _ in 0..2 {
            let rest = self - quotient * other;
            quotient = quotient + Self::from_f64(rest.0 / other.0);
        }
        quotient
    }
}

/// Nodes of the tanh-sinh rule on [0, 1]: distance from 0, distance from 1, weight.
fn rule() -> Vec<(Wide, Wide, Wide)> {
    let unit = Wide::from_f64(1.0);
    let step = 1.0 / 24.0;
    (-104..=104)
        .map(|k| {
            let t = (Wide::from_f64(step) * Wide::from_f64(f64::from(k))).exp();
            let (sinh2, cosh2) = (t - unit / t, t + unit / t);
            // x = 1 / (1 + e^(-2u)), u = pi/2 sinh t; weight dx/dt times the step.
            let pi_half = Wide(FRAC_PI_2, 6.123_233_995_736_766e-17);
            let grow = (pi_half * sinh2).exp();
            let tail = unit / (unit + grow);
            let head = unit / (unit + unit / grow);
            (head, tail, head * tail * pi_half * cosh2 * Wide::from_f64(step))
        })
        .collect()
}

/// Length, rise, `∫ Q^2 sin(phi) ds` and the final Q of an arc.
fn arc(rule: &[(Wide, Wide, Wide)], axis: Wide, tension: Wide, from: Wide, to: Wide) -> [Wide; 4] {
    let two = Wide::from_f64(2.0);
    let span = from - to;
    let q_square = |drop: Wide| {
        // sin(from) - sin(from - drop) without cancellation.
        let half = drop * Wide::from_f64(0.5);
        axis * axis + two * tension * two * (from - half).sin_cos().1 * half.sin_cos().0
    };
    let mut sums = [Wide::from_f64(0.0); 3];
    for &(near, _, weight) in rule {
        let drop = span * near;
        let square = q_square(drop);
        let ds = tension * span * weight / square.sqrt();
        let rise = ds * (from - drop).sin_cos().0;
        for (sum, part) in sums.iter_mut().zip([ds, rise, rise * square]) {
            *sum = *sum + part;
        }
    }
    [sums[0], sums[1], sums[2], q_square(span).sqrt()]
}

/// Length - 1, closing, contact, and the volume `-lambda ∫ Q^2 sin(phi) ds`.
fn section(rule: &[(Wide, Wide, Wide)], r_star: f64, unknowns: [Wide; 4], cone: bool) -> [Wide; 4] {
    let [phi_0, tension, length, lambda] = unknowns;
    let unit = Wide::from_f64(1.0);
    let end = Wide(-FRAC_PI_2, -6.123_233_995_736_766e-17);
    let axis = Wide::from_f64(r_star) / lambda;
    if !cone {
        let [s, z, q2, _] = arc(rule, axis, tension, phi_0, end);
        return [s - unit, z, Wide::from_f64(0.0), -(lambda * q2)];
    }
    let cos = unit / lambda;
    let sin = (unit - cos * cos).sqrt();
    // gamma by Newton on sin(gamma) = sin.
    let mut gamma = Wide::from_f64(sin.0.asin());
    for _ in 0..3 {
        let (s, c) = gamma.sin_cos();
        gamma = gamma - (s - sin) / c;
    }
    let [s1, z1, q21, q] = arc(rule, axis, tension, phi_0, -gamma);
    let gain = length * cos;
    let third = unit / Wide::from_f64(3.0);
    let q2_cone = -(sin * length) * (q * q + q * gain + gain * gain * third);
    let next = tension + length * (q + gain * Wide::from_f64(0.5)) * cos / sin;
    let [s2, z2, q22, _] = arc(rule, q + gain, next, -gamma, end);
    [
        s1 + length + s2 - unit,
        z1 - sin * length + z2,
        lambda * (q - axis) - s1,
        -(lambda * (q21 + q2_cone + q22)),
    ]
}

/// The unknowns at `lambda` in 30 digits: `solved` improved by Newton steps with its own Jacobian.
fn improved(
    rule: &[(Wide, Wide, Wide)],
    r_star: f64,
    solved: &Solved,
    lambda: Wide,
    cone: bool,
) -> [Wide; 4] {
    let mut unknowns = solved.unknowns.map(Wide::from_f64);
    unknowns[LAMBDA] = lambda;
    let rows = [solved.section.length, solved.section.closing, solved.section.contact];
    let count = if cone { 3 } else { 2 };
    for _ in 0..4 {
        let rest = section(rule, r_star, unknowns, cone);
        let matrix = nalgebra::DMatrix::from_fn(count, count, |i, j| rows[i].slope[j]);
        let right = nalgebra::DVector::from_fn(count, |i, _| rest[i].0);
        let step = matrix.lu().solve(&right).expect("regular");
        for j in 0..count {
            unknowns[j] = unknowns[j] - Wide::from_f64(step[j]);
        }
    }
    unknowns
}

/// The volume at `lambda` in 30 digits.
fn volume(rule: &[(Wide, Wide, Wide)], r_star: f64, solved: &Solved, lambda: Wide, cone: bool) -> Wide {
    let rest = section(rule, r_star, improved(rule, r_star, solved, lambda, cone), cone);
    assert!(rest[..3].iter().all(|r| r.0.abs() < 1e-26), "{rest:?}");
    rest[3]
}

/// V, V' and V'' at `lambda` by differences of the volume of sixth order, step 2^-9: error 1e-16 of V.
fn derivatives(rule: &[(Wide, Wide, Wide)], r_star: f64, lambda: f64, cone: bool) -> [f64; 3] {
    let step = 1.0 / 512.0;
    let volume_at = |k: i32| {
        let lambda = lambda + f64::from(k) * step;
        let solved = if cone {
            let target = solve_target(r_star).expect("solved");
            let start = std::array::from_fn(|i| {
                target.unknowns[i] + (lambda - target.unknowns[LAMBDA]) * target.tangent[i]
            });
            solve_cone(r_star, lambda, start).expect("solved")
        } else {
            solve_free(r_star, lambda).expect("solved")
        };
        volume(rule, r_star, &solved, Wide::from_f64(lambda), cone)
    };
    let v: Vec<Wide> = (-4..=4).map(volume_at).collect();
    let odd = [4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0];
    let even = [8.0 / 5.0, -1.0 / 5.0, 8.0 / 315.0, -1.0 / 560.0];
    let (mut slope, mut curvature) = (Wide::from_f64(0.0), Wide::from_f64(0.0));
    for k in 1..=4 {
        slope = slope + (v[4 + k] - v[4 - k]) * Wide::from_f64(odd[k - 1]);
        curvature = curvature + (v[4 + k] + v[4 - k] - v[4] - v[4]) * Wide::from_f64(even[k - 1]);
    }
    [v[4].0, slope.0 / step, curvature.0 / (step * step)]
}

#[test]
fn wide_numbers_have_thirty_digits() {
    let x = Wide::from_f64(0.7);
    let (sin, cos) = x.sin_cos();
    assert!((sin * sin + cos * cos - Wide::from_f64(1.0)).0.abs() < 1e-29);
    assert!((x.exp() * (-x).exp() - Wide::from_f64(1.0)).0.abs() < 1e-28);
    assert!((Wide::from_f64(2.0).sqrt() * Wide::from_f64(2.0).sqrt() - Wide::from_f64(2.0)).0.abs() < 1e-30);
    let root = rule().iter().fold(Wide::from_f64(0.0), |sum, &(near, _, w)| sum + w / near.sqrt());
    assert!(
        (root - Wide::from_f64(2.0)).0.abs() < 1e-14,
        "a 1/sqrt end is cut off at 1e-30 from it: {root:?}"
    );
}

#[test]
fn target_volume_and_curvature_meet_the_table() {
    let quadrature = rule();
    for r_star in [0.0, 1e-6, 1e-3, 0.1, 0.5, 1.0, 10.0, 100.0, 1e4] {
        let target = solve_target(r_star).expect("solved");
        let lambda = target.unknowns[LAMBDA];
        let [volume, slope, curvature] = derivatives(&quadrature, r_star, lambda, true);
        let lambda_t = lambda - slope / curvature;
        let errors = [
            lambda / lambda_t - 1.0,
            target.section.volume.value / volume - 1.0,
            target.curvature / curvature - 1.0,
        ];
        println!(
            "R* {r_star:8}: lambda_t {lambda_t:.13} V {volume:.13} V'' {curvature:.11} errors {errors:?}"
        );
        assert!(errors[0].abs() < 1e-10 && errors[1].abs() < 1e-10 && errors[2].abs() < 1e-8);
    }
}

#[test]
fn free_sections_meet_the_table() {
    let quadrature = rule();
    for r_star in [1e-6, 1e-3, 0.1, 1.0, 10.0, 1e4] {
        let solved = solve_free(r_star, 1.05).expect("solved");
        let [volume, slope, curvature] = derivatives(&quadrature, r_star, 1.05, false);
        let errors = [solved.section.volume.value / volume - 1.0, solved.section.slope.value / slope - 1.0];
        println!("R* {r_star:8}: V {volume:.13} V' {slope:.13} V'' {curvature:.3e} errors {errors:?}");
        assert!(errors.iter().all(|e| e.abs() < 1e-10));
        // V'' almost vanishes here: measured against V'.
        assert!((solved.curvature - curvature).abs() < 1e-9 * slope);
    }
}

/// k = T lambda / R*: `forecast` uses it for the load on the seal.
#[test]
fn seal_loads_meet_the_table() {
    let quadrature = rule();
    for r_star in [1e-6, 1e-3, 1.0 / 30.0, 0.1, 0.2, 0.5, 1.0, 10.0] {
        let solved = solve_target(r_star).expect("solved");
        let unknowns = improved(&quadrature, r_star, &solved, Wide::from_f64(solved.unknowns[LAMBDA]), true);
        let exact = (unknowns[TENSION] * unknowns[LAMBDA] / Wide::from_f64(r_star)).0;
        let load = seal_load(r_star, &Ring.target(r_star).expect("solved")).expect("finite");
        println!("R* {r_star:8}: k {exact:.12} error {:e}", load / exact - 1.0);
        assert!((load / exact - 1.0).abs() < 1e-10, "{r_star}: {load} {exact}");
    }
}
