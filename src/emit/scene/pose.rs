//! Poses: where a star's parts lie, flat or inflated, and how the one becomes the other for display.
//!
//! An inflated star is the forecast's ([`mod@forecast::pose`]): straight arms of the same length, hinges that turned about their centres,
//! a tube that is as wide as predicted. Its section is an ellipse that keeps the length of the fabric. Flaps and bands go along with the tube's edge beside them, and end where they would run into themselves.
//! It is a picture of these kinematics and no prediction of a surface: no wrinkle of a hinge is in it.

use std::f64::consts::PI;

use crate::emit::scene::mesh::{Mesh, index};
use design::{Star, tube_height};
use forecast::pose::PosedStar;
use geom::{Point, Vec2};

/// Facets across one of a tube's two sheets.
const ACROSS: u32 = 8;
/// Facets along a hinge.
const ALONG: u32 = 10;

/// A star in one of its states. Lengths in mm, angles in rad; in the star's frame, seen from corner 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ScenePose {
    points: u32,
    /// Centre of corner 1, on +X.
    corner: Point,
    /// Centre of tip 1.
    tip: Point,
    /// Along arm 1, from the corner to the tip.
    along: Vec2,
    /// Across arm 1, from its outer edge to the hole.
    across: Vec2,
    arm: f64,
    /// Width of the tube as seen from above.
    width: f64,
    /// Height of a sheet above the middle, mm.
    rise: f64,
    /// Inner radii of curvature of corner and tip.
    radii: [f64; 2],
    /// Half the turn of the tube at a corner and at a tip.
    halves: [f64; 2],
}

impl ScenePose {
    /// The star as it is cut.
    pub(super) fn flat(star: &Star) -> Self {
        Self::new(&PosedStar::flat(star), 0.0)
    }

    /// The star of flat width `flat` (mm) inflated, as `star`.
    pub(super) fn inflated(flat: f64, star: &PosedStar) -> Self {
        Self::new(star, tube_height(flat, star.width) / 2.0)
    }

    fn new(star: &PosedStar, rise: f64) -> Self {
        let halves = [(PI - star.corner_angle) / 2.0, (PI - star.tip_angle) / 2.0];
        // From the corner's centre its arc ends, and the arm begins, in this direction.
        let across = Vec2::unit(PI - halves[0]);
        let along = Vec2::new(across.y, -across.x);
        let corner = Point::new(star.corner_centre, 0.0);
        let tip = Point::polar(star.tip_centre, star.half_sector());
        let radii = [star.corner_radius, star.tip_radius];
        let PosedStar { points, arm, width, .. } = *star;
        Self { points, corner, tip, along, across, arm, width, rise, radii, halves }
    }

    fn ray(&self) -> f64 {
        PI / f64::from(self.points)
    }

    /// The point at `place`, in the half of a sector above +X; never beyond the rays that bound it.
    fn point(&self, place: PosePlace) -> Point {
        let p = match place {
            PosePlace::Corner { turn, out } => {
                let radius = (self.radii[0] - self.distance_outside(out)).max(0.0);
                self.corner + Vec2::unit(PI - turn * self.halves[0]) * radius
            }
            PosePlace::Arm { along, out } => {
                let foot =
                    self.corner + self.across * self.radii[0] - self.across * self.distance_outside(out);
                foot + self.along * along
            }
            PosePlace::Tip { turn, out } => {
                let radius = (self.radii[1] + self.width + self.distance_outside(out)).max(0.0);
                self.tip + Vec2::unit(self.ray() - turn * self.halves[1]) * radius
            }
        };
        let ray = Vec2::unit(self.ray());
        let (v, normal) = (p - Point::ORIGIN, Vec2::new(-ray.y, ray.x));
        let depth = v.dot(normal).max(0.0);
        let q = p - normal * depth;
        Point::new(q.x, q.y.max(0.0))
    }

    /// Distance outside the outer edge of a place given as a share of the width inside of it, or as a length beyond an edge.
    fn distance_outside(&self, place: Out) -> f64 {
        match place {
            Out::Outside(length) => length,
            Out::Tube(share) => -share * self.width,
            Out::Hole(length) => -self.width - length,
        }
    }

    /// The place of `q`, in the half of a sector above +X.
    fn place(&self, q: Point) -> PosePlace {
        let from_corner = q - self.corner;
        let along = from_corner.dot(self.along);
        if along < 0.0 {
            let turn = (PI - from_corner.angle().abs()) / self.halves[0];
            PosePlace::Corner { turn, out: self.tube_place(self.radii[0] - from_corner.length()) }
        } else if along > self.arm {
            let from_tip = q - self.tip;
            let turn = (self.ray() - from_tip.angle()) / self.halves[1];
            PosePlace::Tip { turn, out: self.tube_place(from_tip.length() - self.radii[1] - self.width) }
        } else {
            PosePlace::Arm { along, out: self.tube_place(self.radii[0] - from_corner.dot(self.across)) }
        }
    }

    /// The place across the tube at this `distance` outside of its outer edge.
    fn tube_place(&self, distance: f64) -> Out {
        match distance {
            length if length > 0.0 => Out::Outside(length),
            inside if inside < -self.width => Out::Hole(-self.width - inside),
            inside => Out::Tube(-inside / self.width),
        }
    }

    /// The hole-side edge of the tube and the direction across it to the outer edge, column by column around the star.
    fn columns(&self) -> Vec<(Point, Vec2)> {
        let mut columns = Vec::new();
        for k in 0..self.points {
            let ray = 2.0 * f64::from(k) * self.ray();
            let corner = Point::polar(self.corner.x, ray);
            columns.extend(turns(self.halves[0]).map(|turn| {
                let towards_hole = Vec2::unit(ray + PI - turn);
                (corner + towards_hole * (self.radii[0] + self.width), -towards_hole)
            }));
            let ray = ray + self.ray();
            let tip = Point::polar(self.tip.distance(Point::ORIGIN), ray);
            columns.extend(turns(self.halves[1]).map(|turn| {
                let outwards = Vec2::unit(ray + turn);
                (tip + outwards * self.radii[1], outwards)
            }));
        }
        columns
    }

    /// Corners of the tube's two sheets, around every column.
    fn tube(&self) -> Vec<[f64; 3]> {
        let ring = |(edge, outwards): (Point, Vec2)| {
            (0..2 * ACROSS).map(move |j| {
                // Once around a circle; flat, the way across goes with the length of the fabric.
                let turn = PI * f64::from(j) / f64::from(ACROSS);
                let flat = 1.0 - (f64::from(j) / f64::from(ACROSS) - 1.0).abs();
                let share = if self.rise > 0.0 { (1.0 - libm::cos(turn)) / 2.0 } else { flat };
                let p = edge + outwards * (share * self.width);
                [p.x, p.y, self.rise * libm::sin(turn)]
            })
        };
        self.columns().into_iter().flat_map(ring).collect()
    }
}

/// Directions from `-half` to `half`, evenly.
fn turns(half: f64) -> impl Iterator<Item = f64> {
    (0..=ALONG).map(move |i| half * (2.0 * f64::from(i) / f64::from(ALONG) - 1.0))
}

/// The place of a point beside a tube, in terms that hold for every pose.
#[derive(Clone, Copy)]
enum PosePlace {
    /// At a corner, `turn` from 0 on its ray to 1 where the arm begins.
    Corner { turn: f64, out: Out },
    /// Beside an arm, a length from the corner's end.
    Arm { along: f64, out: Out },
    /// At a tip, `turn` from 0 on its ray to 1 where the arm ends.
    Tip { turn: f64, out: Out },
}

/// The zone between the tube and the edge of the fabric.
#[derive(Clone, Copy)]
enum Out {
    /// A length beyond the outer edge.
    Outside(f64),
    /// A share of the width, from the outer edge.
    Tube(f64),
    /// A length beyond the edge towards the hole.
    Hole(f64),
}

/// From one pose to another.
#[derive(Clone, Copy)]
pub(super) struct PoseMotion {
    pub(super) from: ScenePose,
    pub(super) to: ScenePose,
}

impl PoseMotion {
    /// The inflated place of the fabric's point at `[x, y, z]`; a channel moves along with its tip.
    pub(super) fn carried(&self, [x, y, z]: [f64; 3]) -> [f64; 3] {
        let p = Point::new(x, y);
        let sector = 2.0 * self.from.ray();
        let turn = (p.angle() / sector).round() * sector;
        let turned = rotated(p, -turn);
        let side = if turned.y < 0.0 { -1.0 } else { 1.0 };
        let mirrored = Point::new(turned.x, turned.y.abs());
        let to = self.to.point(self.from.place(mirrored));
        let p = rotated(Point::new(to.x, side * to.y), turn);
        [p.x, p.y, z]
    }
}

/// The tube of a star, in `pose` and, if it moves, also where it goes.
pub(super) fn tube(pose: ScenePose, inflated: Option<ScenePose>) -> Mesh {
    let (columns, ring) = (index(pose.columns().len()), 2 * ACROSS);
    let quads = (0..columns).flat_map(|i| (0..ring).map(move |j| (i, j)));
    let triangles = quads.flat_map(|(i, j)| {
        let [a, b, c, d] =
            [(i, j), (i, j + 1), (i + 1, j + 1), (i + 1, j)].map(|(i, j)| (i % columns) * ring + j % ring);
        [[a, b, c], [a, c, d]]
    });
    Mesh {
        points: pose.tube(),
        inflated: inflated.map_or_else(Vec::new, |pose| pose.tube()),
        triangles: triangles.collect(),
    }
}

fn rotated(p: Point, angle: f64) -> Point {
    let (sin, cos) = libm::sincos(angle);
    Point::new(p.x * cos - p.y * sin, p.x * sin + p.y * cos)
}

#[cfg(test)]
mod tests {
    use super::*;
    use design::Side;
    use forecast::case::mechanism;
    use forecast::pose::at_angle;
    use spec::{self, Source};

    fn stars() -> Vec<Star> {
        let paper = "schema = 1\nname = \"x\"\n[star]\npoints = 5\ninner_radius = \"50 mm\"\ntube_width = \"30 mm\"\ntip_angle = \"30 deg\"\n";
        let round = format!("{paper}tip_radius = \"4 mm\"\ncorner_radius = \"3 mm\"\n");
        let star = |text: &str| {
            let spec = spec::read(&Source::new("spec.toml", text)).expect("valid").spec;
            Star::new(&spec.stars[0]).expect("a star")
        };
        vec![star(paper), star(&round)]
    }

    /// The star with round tubes and its tips at this angle.
    fn closed(star: &Star, phi: f64) -> ScenePose {
        ScenePose::inflated(star.w, &at_angle(star, &mechanism(star), phi))
    }

    #[test]
    fn a_motion_to_where_it_is_moves_nothing() {
        for star in stars() {
            let flat = ScenePose::flat(&star);
            let motion = PoseMotion { from: flat, to: flat };
            for side in [Side::Hole, Side::Outside] {
                for delta in [0.0, 1.0, 5.0] {
                    let path = star.contour(side, delta, 0.0).expect("a contour").path();
                    for i in 0..200 {
                        let p = path.point_at(f64::from(i) / 200.0 * path.length()).expect("a point");
                        let [x, y, _] = motion.carried([p.x, p.y, 0.0]);
                        assert!(Point::new(x, y).distance(p) < 1e-9, "{side:?} {delta} {p:?}");
                    }
                }
            }
        }
    }

    /// Points on the tube's edges stay on them, whatever the tip's angle.
    #[test]
    fn edges_are_carried_to_edges() {
        for star in stars() {
            for phi in [0.0, 0.2, 0.4] {
                let to = closed(&star, phi);
                let motion = PoseMotion { from: ScenePose::flat(&star), to };
                for (side, beyond) in [(Side::Outside, 0.0), (Side::Hole, -to.width)] {
                    let path = star.contour(side, 0.0, 0.0).expect("a contour").path();
                    for i in 0..200 {
                        let p = path.point_at(f64::from(i) / 200.0 * path.length()).expect("a point");
                        let [x, y, _] = motion.carried([p.x, p.y, 0.0]);
                        let sector = (y.atan2(x) / (2.0 * to.ray())).round() * 2.0 * to.ray();
                        let q = rotated(Point::new(x, y), -sector);
                        let place = to.place(Point::new(q.x, q.y.abs()));
                        let (PosePlace::Corner { out: pose_out, .. }
                        | PosePlace::Arm { out: pose_out, .. }
                        | PosePlace::Tip { out: pose_out, .. }) = place;
                        assert!(
                            (to.distance_outside(pose_out) - beyond).abs() < 1e-9,
                            "{side:?} {phi} {p:?}"
                        );
                    }
                }
            }
        }
    }
}
