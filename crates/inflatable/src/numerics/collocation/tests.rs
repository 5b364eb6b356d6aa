//! Boundary-value problems with exact solutions.

use super::*;

/// `y'' = (y - g) / eps^2` with solution `y = g + exp(-x/eps) + exp((x-1)/eps)`, g = sin(x): layers at both ends.
struct Layers {
    eps: f64,
    left: [(usize, f64); 1],
    right: [(usize, f64); 1],
}

impl Layers {
    fn new(eps: f64) -> Self {
        let decayed = (-1.0 / eps).exp();
        Self { eps, left: [(0, 1.0 + decayed)], right: [(0, 1.0_f64.sin() + 1.0 + decayed)] }
    }
    fn exact(&self, x: f64) -> f64 {
        x.sin() + (-x / self.eps).exp() + ((x - 1.0) / self.eps).exp()
    }
}

impl Problem<2> for Layers {
    fn slope(&self, x: f64, y: &[f64; 2]) -> [f64; 2] {
        let square = self.eps * self.eps;
        [y[1], (y[0] - x.sin() - square * x.sin()) / square]
    }
    fn jacobian(&self, _: f64, _: &[f64; 2]) -> [[f64; 2]; 2] {
        [[0.0, 1.0], [1.0 / (self.eps * self.eps), 0.0]]
    }
    fn values_at_left(&self) -> &[(usize, f64)] {
        &self.left
    }
    fn right(&self) -> &[(usize, f64)] {
        &self.right
    }
}

fn flat(count: u32) -> Profile<2> {
    let mesh: Vec<f64> = (0..=count).map(|i| f64::from(i) / f64::from(count)).collect();
    Profile { values: vec![[0.0; 2]; mesh.len()], mesh }
}

fn worst(problem: &Layers, profile: &Profile<2>) -> f64 {
    let errors = profile.mesh.iter().zip(&profile.values).map(|(&x, y)| (y[0] - problem.exact(x)).abs());
    errors.fold(0.0, f64::max)
}

#[test]
fn the_error_falls_with_the_fourth_power() {
    let problem = Layers::new(0.3);
    let errors = [8, 16, 32]
        .map(|count| worst(&problem, &solve_on_mesh(&problem, flat(count)).expect("linear").profile));
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!((3.8..4.3).contains(&order), "{errors:?}");
    }
}

#[test]
fn refinement_finds_the_layers() {
    let problem = Layers::new(1e-3);
    let solution = solve(&problem, flat(10), 1e-6, 2000).expect("solvable");
    let mesh = &solution.profile.mesh;
    assert!(worst(&problem, &solution.profile) < 1e-5);
    assert!(mesh.len() < 1500 && mesh[1] - mesh[0] < 1e-3, "{}", mesh.len());
    let total = solution.profile.integral(&problem, |_, y| y[0]);
    assert!((total - (1.0 - 1.0_f64.cos() + 2e-3)).abs() < 1e-6);
}

#[test]
fn too_fine_a_mesh_is_refused() {
    let fault = solve(&Layers::new(1e-4), flat(10), 1e-9, 50).expect_err("needs more than 50 intervals");
    assert!(matches!(fault, CollocationFault::TooFine { residual } if residual > 1e-9));
}
