//! The part of a star that is modelled: half a sector between two planes of symmetry, or where fabric is woven askew to them the whole
//! star, one sheet of it.
//!
//! Both sheets lie with their warps parallel, so the plane between them stays one of symmetry.

use crate::shell::assembly::{Plane, State, Supports};
use crate::shell::cases::arm_line::ArmLine;
use crate::shell::contact::Obstacle;
use crate::shell::mesh::{Border, HalfSector, MarginWidths, Mesh, MeshFault, Meshed, Sizes, distance, rim};

/// The modelled part of a star.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StarPart {
    /// Half a sector of one sheet; all others are its images. Right for isotropic fabric, and where the warp lies at a multiple of 45 deg to
    /// both planes.
    HalfSector,
    /// One whole sheet, without planes of symmetry. Contact between its arms is not modelled.
    Whole,
}

/// A part of a star whose lengths are divided by W.
#[derive(Clone, Copy)]
pub(super) struct ModelledPart {
    pub(super) part: StarPart,
    pub(super) sector: HalfSector,
    /// Width beyond its rims.
    pub(super) margin: MarginWidths,
}

/// Places of the corners.
pub(super) struct CornerPlaces {
    /// Mean distance of the corners' apexes from the point in their middle.
    pub(super) mean: f64,
    /// The least and the largest.
    pub(super) range: [f64; 2],
    /// The point in the middle of the corners, against that in the middle of the tips.
    pub(super) middle: [f64; 2],
    pub(super) aside: f64,
    /// Mean distance of the cut edge in front of the apexes from there; of the apexes where there is no margin.
    pub(super) edge: f64,
}

/// Distance from a ray within which a flat point counts as on it, W.
const ON_RAY: f64 = 1e-7;

impl ModelledPart {
    pub(super) fn meshed(&self, sizes: &Sizes) -> Result<Meshed, MeshFault> {
        let half = self.sector.mesh_with(sizes, self.margin)?;
        match self.part {
            StarPart::HalfSector => Ok(half),
            StarPart::Whole => half.unfolded(self.sector.n, 2 * self.sector.n),
        }
    }

    /// Walls where arms meet their images, and last the object, as yet of no size.
    pub(super) fn obstacles(&self) -> Vec<Obstacle> {
        let post = Obstacle::Post { radius: 0.0 };
        self.planes().into_iter().map(Obstacle::Wall).chain([post]).collect()
    }

    fn planes(&self) -> Vec<Plane> {
        match self.part {
            StarPart::HalfSector => vec![Plane::first(), Plane::second(self.sector.half_angle())],
            StarPart::Whole => Vec::new(),
        }
    }

    /// A whole sheet is held at three coordinates, so that it neither slides nor turns as a whole.
    pub(super) fn supports(&self, mesh: &Mesh) -> Supports {
        let mut supports = Supports::new(mesh, self.planes());
        if self.part == StarPart::Whole {
            let farthest = |along: f64| {
                let rim = mesh.along(Border::Rim(rim::OUTER)).flat_map(|edge| mesh.edges[edge].ends);
                let at = |point: &usize| along * mesh.points[*point][0];
                rim.max_by(|a, b| at(a).total_cmp(&at(b))).unwrap_or_default()
            };
            let (right_end, other) = (farthest(1.0), farthest(-1.0));
            for (point, axis) in [(right_end, 0), (right_end, 1), (other, 1)] {
                supports.fix(point, axis);
            }
        }
        supports
    }

    /// The number of copies of the modelled part in the star.
    pub(super) fn count(&self) -> f64 {
        match self.part {
            StarPart::HalfSector => 4.0 * f64::from(self.sector.n),
            StarPart::Whole => 2.0,
        }
    }

    /// Angles of the rays of the corners that are modelled.
    fn corners(&self) -> impl Iterator<Item = f64> + use<> {
        let (count, half_angle) = match self.part {
            StarPart::HalfSector => (1, 0.0),
            StarPart::Whole => (self.sector.n, self.sector.half_angle()),
        };
        (0..count).map(move |corner| 2.0 * f64::from(corner) * half_angle)
    }

    /// The places of the corners of `state`.
    pub(super) fn corner_places(&self, mesh: &Mesh, state: &State) -> CornerPlaces {
        let of = |angle: f64, radius: f64, border: u8| {
            let (sine, cosine) = libm::sincos(angle);
            let place = [radius * cosine, radius * sine];
            let [x, y, _] = state.points[nearest(mesh, place, Border::Rim(border))];
            [x, y]
        };
        let apexes: Vec<[f64; 2]> =
            self.corners().map(|angle| of(angle, self.sector.rho_0, rim::INNER)).collect();
        if self.part == StarPart::HalfSector {
            let radius = apexes[0][0];
            let edge = self.cut_edge(mesh, 0.0).map_or(radius, |point| state.points[point][0]);
            return CornerPlaces { mean: radius, range: [radius; 2], middle: [0.0; 2], aside: 0.0, edge };
        }
        let half_angle = self.sector.half_angle();
        let tips: Vec<[f64; 2]> =
            self.corners().map(|angle| of(angle + half_angle, self.tip_radius(), rim::OUTER)).collect();
        let mean = |numbers: &mut dyn Iterator<Item = f64>| numbers.sum::<f64>() / f64::from(self.sector.n);
        let [middle, of_tips] =
            [&apexes, &tips].map(|all| [0, 1].map(|c| mean(&mut all.iter().map(|at| at[c]))));
        let from_middle = |[x, y]: [f64; 2]| libm::hypot(x - middle[0], y - middle[1]);
        let edges: Vec<f64> = self
            .corners()
            .filter_map(|angle| self.cut_edge(mesh, angle))
            .map(|point| from_middle([state.points[point][0], state.points[point][1]]))
            .collect();
        let radii: Vec<f64> = apexes.iter().copied().map(from_middle).collect();
        let end = |pick: fn(f64, f64) -> f64| radii.iter().copied().reduce(pick).unwrap_or_default();
        CornerPlaces {
            mean: mean(&mut radii.iter().copied()),
            edge: mean(&mut if edges.is_empty() { &radii } else { &edges }.iter().copied()),
            range: [end(f64::min), end(f64::max)],
            middle,
            aside: distance(middle, of_tips),
        }
    }

    /// The point of the inner margin's cut edge on the ray of a corner, if there is a margin.
    fn cut_edge(&self, mesh: &Mesh, angle: f64) -> Option<usize> {
        let (sine, cosine) = libm::sincos(angle);
        let radius = self.sector.rho_0 - self.margin.inner;
        (self.margin.inner > 0.0).then(|| nearest(mesh, [radius * cosine, radius * sine], Border::Free))
    }

    /// From the axis to the outermost point of a flat tip.
    fn tip_radius(&self) -> f64 {
        let HalfSector { rho_0, w, phi_i, r_i, r_e, .. } = self.sector;
        let (turn, half_angle) = (phi_i / 2.0, self.sector.half_angle());
        // From the centre of the corner's arc along the arm to the centre of the tip's; both lie on their rays.
        let (sine, cosine) = libm::sincos(turn + half_angle);
        let (l, across) = (self.sector.l(), w + r_i + r_e);
        let x = rho_0 + w + r_e + l * cosine - across * sine;
        let y = l * sine + across * cosine;
        libm::hypot(x, y) + r_i + w
    }

    /// Twice the angle between each tip's ray and the line of each of its arms, which leaves out one W at each hinge, or a third of a short
    /// arm: the mean and the least of a tip.
    pub(super) fn tip_angles(&self, mesh: &Mesh, state: &State) -> [f64; 2] {
        let sector = &self.sector;
        let half_angle = sector.half_angle();
        let half_corner = sector.phi_i / 2.0 + half_angle;
        let start = (sector.rho_0 + sector.w + sector.r_e) * libm::cos(half_corner);
        let l = sector.l();
        let left_out = (l / 3.0).min(1.0);
        let reach = [start + left_out, start + l - left_out];
        let angle = |[x, y]: [f64; 2]| libm::atan2(y, x);
        let direction = |angle: f64| {
            let (sine, cosine) = libm::sincos(angle);
            [cosine, sine]
        };
        if self.part == StarPart::HalfSector {
            let arm = ArmLine::new(mesh, direction(half_corner), reach).direction(state);
            return [2.0 * (angle(arm) - half_angle); 2];
        }
        // The arm that begins at each corner counterclockwise, and the one that ends at the next corner: the same tip's.
        let tips: Vec<f64> = self
            .corners()
            .map(|corner| {
                let next = corner + 2.0 * half_angle;
                let is_between = |[x, y]: [f64; 2], from: f64| {
                    let [along, across] = turned([x, y], -(from + half_angle / 2.0));
                    along > 0.0 && libm::atan2(across, along).abs() < half_angle / 2.0
                };
                let first = ArmLine::within(mesh, direction(corner + half_corner), reach, |place| {
                    is_between(place, corner)
                });
                let second = ArmLine::within(mesh, direction(next - half_corner), reach, |place| {
                    is_between(place, corner + half_angle)
                });
                // Against the tip's ray, so that no angle jumps by a whole turn.
                let against = |line: &ArmLine| angle(turned(line.direction(state), -(corner + half_angle)));
                against(&first) - against(&second)
            })
            .collect();
        let least = tips.iter().copied().fold(f64::INFINITY, f64::min);
        [tips.iter().sum::<f64>() / f64::from(sector.n), least]
    }

    /// Outward displacement of the sections of all modelled corners: points, and the direction times the flat length of each.
    pub(super) fn sections(&self, mesh: &Mesh) -> Vec<(usize, [f64; 3])> {
        let mut parts = Vec::new();
        let HalfSector { rho_0, w, .. } = self.sector;
        for angle in self.corners() {
            let (sine, cosine) = libm::sincos(angle);
            // A margin beyond the rims is no part of the section.
            let is_on = |point: usize| {
                let [along, across] = turned(mesh.points[point], -angle);
                (rho_0 - ON_RAY..=rho_0 + w + ON_RAY).contains(&along) && across.abs() < ON_RAY
            };
            for (edge, ends) in mesh.edges.iter().map(|edge| edge.ends).enumerate() {
                if ends.into_iter().all(is_on) {
                    let half = mesh.length(edge) / 2.0;
                    parts.extend(ends.map(|end| (end, [half * cosine, half * sine, 0.0])));
                }
            }
        }
        parts
    }

    /// The stiffness of the modelled part by the compliance of its sections, all of which bear the same force: force by displacement of one
    /// corner, times their number.
    pub(super) fn stiffness(&self, compliance: f64) -> f64 {
        let corners: f64 = self.corners().map(|_| 1.0).sum();
        corners * corners / compliance
    }
}

/// The point of a border that is nearest to `place` on the flat sheet.
fn nearest(mesh: &Mesh, place: [f64; 2], border: Border) -> usize {
    let away = |point: &usize| distance(mesh.points[*point], place);
    let rim = mesh.along(border).flat_map(|edge| mesh.edges[edge].ends);
    rim.min_by(|a, b| away(a).total_cmp(&away(b))).unwrap_or_default()
}

fn turned([x, y]: [f64; 2], angle: f64) -> [f64; 2] {
    let (sine, cosine) = libm::sincos(angle);
    [cosine * x - sine * y, sine * x + cosine * y]
}
