//! The potential of one sheet per flat area, with its exact derivatives.
//!
//! With the flat radius `w = R* + s` (lengths in W), the meridian `Q(s), z(s)` and its slope angle `phi`:
//!
//! ```text
//! e_s = sqrt(Q'^2 + z'^2) - 1      k_s  = dphi/ds = (Q' z'' - z' Q'') / (Q'^2 + z'^2)
//! e_th = lambda Q / w - 1          k_th = sin(phi) / Q
//!
//! y/2 [e_s^2 + (e_th + nu e_s)^2 / (1 - nu^2)] + 1/(2 b) [k_s^2 + k_th^2 + 2 nu k_s k_th] - lambda Q z Q' / w
//! ```
//!
//! in units of p W. The first bracket is plane stress, the second a plate's bending, the last the pressure: integrated
//! over `w ds` it is the potential Pi per flat angle in units of p W^3, with `y = Y / (p W)` and `b = 1/eps`.

/// Response of fabric to compression around the axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Hoop {
    /// It resists, as a sheet does that has not wrinkled.
    Stiff,
    /// It wrinkles without resistance: the tension field, whose limit is the ring.
    Slack,
}

/// The fabric in units of the pressure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Scales {
    /// 1/eps = p W^3 / B.
    pub(super) bendability: f64,
    /// y = Y / (p W).
    pub(super) stiffness: f64,
    /// Poisson ratio nu.
    pub(super) poisson: f64,
    /// Law of compression.
    pub(super) hoop: Hoop,
}

/// Function and derivatives of the meridian at one place: Q, Q', Q'', z, z', z''.
pub(super) type Jet = [f64; 6];

/// Strains, curvatures and forces at one place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Strains {
    /// sqrt(Q'^2 + z'^2).
    stretch: f64,
    /// Cosine of the slope angle phi.
    pub(super) cos: f64,
    /// Sine of the slope angle.
    pub(super) sin: f64,
    /// Meridional strain.
    pub(super) e_s: f64,
    /// Hoop strain.
    pub(super) e_th: f64,
    /// Meridional curvature, 1/W.
    pub(super) k_s: f64,
    /// Hoop curvature, 1/W.
    pub(super) k_th: f64,
    /// Meridional tension per flat length, p W.
    pub(super) n_s: f64,
    /// Hoop tension per flat length, p W.
    pub(super) n_th: f64,
    /// 1 / (1 - nu^2), or 0 where the hoop is slack.
    hooped: f64,
}

impl Strains {
    #[inline]
    pub(super) fn new(scales: &Scales, w: f64, lambda: f64, jet: &Jet) -> Self {
        let [q, q1, q2, _, z1, z2] = *jet;
        let nu = scales.poisson;
        let stretch = (q1 * q1 + z1 * z1).sqrt();
        let (cos, sin) = (q1 / stretch, z1 / stretch);
        let (e_s, e_th) = (stretch - 1.0, lambda * q / w - 1.0);
        let pull = e_th + nu * e_s;
        let slack = scales.hoop == Hoop::Slack && pull < 0.0;
        let hooped = if slack { 0.0 } else { (1.0 - nu * nu).recip() };
        let n_th = scales.stiffness * hooped * pull;
        Self {
            stretch,
            cos,
            sin,
            e_s,
            e_th,
            k_s: (cos * z2 - sin * q2) / stretch,
            k_th: sin / q,
            n_s: scales.stiffness * e_s + nu * n_th,
            n_th,
            hooped,
        }
    }

    /// The density without the pressure.
    #[inline]
    pub(super) fn energy(&self, scales: &Scales) -> f64 {
        let Self { e_s, e_th, k_s, k_th, .. } = *self;
        let nu = scales.poisson;
        let membrane = scales.stiffness * e_s * e_s + self.n_th * (e_th + nu * e_s);
        0.5 * (membrane + (k_s * k_s + k_th * k_th + 2.0 * nu * k_s * k_th) / scales.bendability)
    }
}

/// The density's derivatives; of the Hessian the upper triangle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Density {
    /// By the jet.
    pub(super) gradient: Jet,
    /// By the jet twice.
    pub(super) hessian: [Jet; 6],
    /// By lambda.
    pub(super) slope: f64,
    /// By lambda and the jet.
    pub(super) mixed: Jet,
    /// By lambda twice.
    pub(super) curvature: f64,
}

/// The derivatives at the flat radius `w`.
///
/// If not `exact`, the terms that make Hessians of states far from equilibrium indefinite are left out: meridional
/// compression, and moments times second derivatives of curvatures.
#[inline]
pub(super) fn density(scales: &Scales, w: f64, lambda: f64, jet: &Jet, exact: bool) -> Density {
    let strains = Strains::new(scales, w, lambda, jet);
    let [q, q1, q2, z, _, z2] = *jet;
    let (c, s, nu) = (strains.cos, strains.sin, scales.poisson);
    // phi and its derivatives by Q' and z': it is the argument of Q' + i z'.
    let (a, b) = (-s / strains.stretch, c / strains.stretch);
    let (aa, ab) = (-2.0 * a * b, a * a - b * b);
    let turn = lambda / w;
    let (e_s, e_th) = ([0.0, c, 0.0, 0.0, s, 0.0], [turn, 0.0, 0.0, 0.0, 0.0, 0.0]);
    let k_s = [0.0, aa * q2 + ab * z2, a, 0.0, ab * q2 - aa * z2, b];
    let k_th = [-s / (q * q), c * a / q, 0.0, 0.0, c * b / q, 0.0];
    let hoop = scales.stiffness * strains.hooped;
    let meridian = scales.stiffness + nu * nu * hoop;
    let bend = scales.bendability.recip();
    let (m_s, m_th) = (bend * (strains.k_s + nu * strains.k_th), bend * (strains.k_th + nu * strains.k_s));

    let mut gradient = [0.0; 6];
    let mut hessian = [[0.0; 6]; 6];
    for j in 0..6 {
        gradient[j] = strains.n_s * e_s[j] + strains.n_th * e_th[j] + m_s * k_s[j] + m_th * k_th[j];
        // The law of the sheet times the derivatives of the strains.
        let meridian_stress = meridian * e_s[j] + nu * hoop * e_th[j];
        let hoop_stress = hoop * (e_th[j] + nu * e_s[j]);
        let (with_s, with_th) = (bend * (k_s[j] + nu * k_th[j]), bend * (k_th[j] + nu * k_s[j]));
        // All rows, though the upper triangle would do: the loop is unrolled.
        for i in 0..6 {
            hessian[i][j] =
                e_s[i] * meridian_stress + e_th[i] * hoop_stress + k_s[i] * with_s + k_th[i] * with_th;
        }
    }
    let pull = (if exact { strains.n_s } else { strains.n_s.max(0.0) }) / strains.stretch;
    add_pull(&mut hessian, pull, s, c);
    if exact {
        // Terms of k_s: phi's third derivatives along (Q'', z''), 2 (Q'' + i z'') / (Q' + i z')^3.
        let (re, im) = (
            2.0 * (b * (b * b - 3.0 * a * a) * q2 - a * (3.0 * b * b - a * a) * z2),
            2.0 * (b * (b * b - 3.0 * a * a) * z2 + a * (3.0 * b * b - a * a) * q2),
        );
        let m_q = m_th / q;
        hessian[1][1] += m_s * im + m_q * (c * aa - s * a * a);
        hessian[1][4] += m_s * re + m_q * (c * ab - s * a * b);
        hessian[4][4] += -m_s * im - m_q * (c * aa + s * b * b);
        hessian[1][2] += m_s * aa;
        hessian[1][5] += m_s * ab;
        hessian[2][4] += m_s * ab;
        hessian[4][5] -= m_s * aa;
        hessian[0][0] += 2.0 * m_q * s / (q * q);
        hessian[0][1] -= m_q * c * a / q;
        hessian[0][4] -= m_q * c * b / q;
    }
    add_pressure(&mut gradient, &mut hessian, turn, jet);
    let reach = q / w;
    let mut mixed = std::array::from_fn(|i| hoop * reach * (nu * e_s[i] + e_th[i]));
    mixed[0] += (strains.n_th - z * q1) / w;
    mixed[1] -= reach * z;
    mixed[3] -= reach * q1;
    Density {
        gradient,
        hessian,
        slope: reach * (strains.n_th - z * q1),
        mixed,
        curvature: hoop * reach * reach,
    }
}

/// Adds the second derivatives of the stretch times the meridian's tension over the stretch, `pull`.
#[inline]
fn add_pull(hessian: &mut [Jet; 6], pull: f64, s: f64, c: f64) {
    hessian[1][1] += pull * s * s;
    hessian[1][4] -= pull * s * c;
    hessian[4][4] += pull * c * c;
}

/// Adds the derivatives of the pressure's -lambda Q z Q' / w, with `turn` for lambda / w.
#[inline]
fn add_pressure(gradient: &mut Jet, hessian: &mut [Jet; 6], turn: f64, [q, q1, _, z, ..]: &Jet) {
    gradient[0] -= turn * z * q1;
    gradient[1] -= turn * q * z;
    gradient[3] -= turn * q * q1;
    hessian[0][1] -= turn * z;
    hessian[0][3] -= turn * q1;
    hessian[1][3] -= turn * q;
}
