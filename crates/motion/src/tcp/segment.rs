//! A straight line or an arc of a circle between two poses; the orientation turns evenly along it.

use nalgebra::{Isometry3, Point3, Translation3, Unit, UnitQuaternion, Vector3};

/// Shorter translations count as none. A pure rotation has its angle as its length, 1 m for 1 rad. Kind: rounding.
pub(super) const NO_TRANSLATION_M: f64 = 1e-9;
/// Three points count as collinear if the height of their triangle is a smaller part of its longest side. Dimensionless.
const FLAT: f64 = 1e-6;

/// A line or an arc of the tool centre point, with its rotation.
#[derive(Debug, Clone)]
pub(super) struct Segment {
    from: Isometry3<f64>,
    /// The rotation from its start to its end, as axis times angle in the frame of the start.
    turn: Vector3<f64>,
    length_m: f64,
    curve: SegmentCurve,
}

#[derive(Debug, Clone)]
enum SegmentCurve {
    Line { direction: Vector3<f64> },
    Arc { centre: Point3<f64>, normal: Unit<Vector3<f64>>, radius_m: f64 },
}

impl Segment {
    pub(super) fn line(from: Isometry3<f64>, to: Isometry3<f64>) -> Self {
        let turn = from.rotation.rotation_to(&to.rotation);
        // Into the frame of the start: `at` multiplies the turn from the right.
        let turn = (from.rotation.inverse() * turn * from.rotation).scaled_axis();
        let displacement = to.translation.vector - from.translation.vector;
        let (length_m, direction) = if displacement.norm() > NO_TRANSLATION_M {
            (displacement.norm(), displacement.normalize())
        } else {
            (turn.norm(), Vector3::zeros())
        };
        Self { from, turn, length_m, curve: SegmentCurve::Line { direction } }
    }

    /// The arc of the circle through `via`; `None` if the three points are on a line.
    pub(super) fn arc(from: Isometry3<f64>, via: Vector3<f64>, to: Isometry3<f64>) -> Option<Self> {
        let start = from.translation.vector;
        let (a, b) = (via - start, to.translation.vector - start);
        let normal = a.cross(&b);
        let longest_m = a.norm().max(b.norm()).max((b - a).norm());
        if normal.norm() <= FLAT * longest_m * longest_m {
            return None;
        }
        // Centre of the circumcircle from the start: ((|a|^2 b - |b|^2 a) x n) / (2 |n|^2) with n = a x b.
        let squares = b * a.norm_squared() - a * b.norm_squared();
        let from_start = squares.cross(&normal) / (2.0 * normal.norm_squared());
        // The normal is a x b, so the path from the start through `via` to the end is anticlockwise about it, and the angle
        // from 0 to 2 pi is that of the arc, also if it is longer than half a circle.
        let (centre, normal) = (Point3::from(start + from_start), Unit::new_normalize(normal));
        let (out, back) = (-from_start, b - from_start);
        let angle_rad =
            libm::atan2(out.cross(&back).dot(&normal), out.dot(&back)).rem_euclid(std::f64::consts::TAU);
        let radius_m = from_start.norm();
        let line = Self::line(from, to);
        Some(Self {
            length_m: radius_m * angle_rad,
            curve: SegmentCurve::Arc { centre, normal, radius_m },
            ..line
        })
    }

    pub(super) fn length_m(&self) -> f64 {
        self.length_m
    }

    pub(super) fn turn_rad(&self) -> f64 {
        self.turn.norm()
    }

    /// Radius of curvature; infinity for a line.
    pub(super) fn radius_m(&self) -> f64 {
        match self.curve {
            SegmentCurve::Line { .. } => f64::INFINITY,
            SegmentCurve::Arc { radius_m, .. } => radius_m,
        }
    }

    /// Whether the segment is a pure rotation.
    pub(super) fn is_turn_alone(&self) -> bool {
        matches!(self.curve, SegmentCurve::Line { direction } if direction == Vector3::zeros())
    }

    /// Pose of the tool at a length along the segment; the rotation is in proportion to the length.
    pub(super) fn at(&self, length_m: f64) -> Isometry3<f64> {
        let share = if self.length_m > 0.0 { length_m / self.length_m } else { 1.0 };
        let rotation = self.from.rotation * UnitQuaternion::from_scaled_axis(self.turn * share);
        let position = match &self.curve {
            SegmentCurve::Line { direction } => self.from.translation.vector + direction * length_m,
            SegmentCurve::Arc { centre, normal, radius_m } => {
                let turn = UnitQuaternion::from_axis_angle(normal, length_m / radius_m);
                centre.coords + turn * (self.from.translation.vector - centre.coords)
            }
        };
        Isometry3::from_parts(Translation3::from(position), rotation)
    }

    /// Unit tangent at a length along the segment; zero for a pure rotation.
    pub(super) fn direction_at(&self, length_m: f64) -> Vector3<f64> {
        match &self.curve {
            SegmentCurve::Line { direction } => *direction,
            SegmentCurve::Arc { centre, normal, radius_m } => {
                normal.cross(&(self.at(length_m).translation.vector - centre.coords)) / *radius_m
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pose(xyz: [f64; 3], turn: [f64; 3]) -> Isometry3<f64> {
        let turn = UnitQuaternion::from_scaled_axis(Vector3::from(turn));
        Isometry3::from_parts(Translation3::from(Vector3::from(xyz)), turn)
    }

    /// Rounding of a metre; worst seen 5e-16.
    const ROUNDING_M: f64 = 1e-12;

    #[test]
    fn a_line_ends_at_its_end_and_turns_evenly_about_one_axis() {
        let (from, to) = (pose([0.1, 0.2, 0.3], [0.5, 0.0, 0.2]), pose([0.4, -0.2, 0.3], [0.5, 1.0, -0.2]));
        let line = Segment::line(from, to);
        assert!((line.length_m() - 0.5).abs() < ROUNDING_M);
        let end = line.at(0.5);
        assert!((end.translation.vector - to.translation.vector).norm() < ROUNDING_M);
        assert!(end.rotation.angle_to(&to.rotation) < 1e-7);
        let middle = from.rotation.slerp(&to.rotation, 0.5);
        assert!(line.at(0.25).rotation.angle_to(&middle) < 1e-7);
    }

    #[test]
    fn arcs_go_through_via_whichever_way_is_longer() {
        let from = pose([1.0, 0.0, 0.0], [0.0; 3]);
        let to = pose([0.0, 1.0, 0.0], [0.0; 3]);
        let half = 0.5_f64.sqrt();
        for (via, quarters) in
            [([half, half, 0.0], 1.0), ([-half, -half, 0.0], 3.0), ([-half, half, 0.0], 3.0)]
        {
            let arc = Segment::arc(from, Vector3::from(via), to).unwrap();
            assert!((arc.length_m() - quarters * std::f64::consts::FRAC_PI_2).abs() < ROUNDING_M);
            assert!((arc.at(arc.length_m()).translation.vector - to.translation.vector).norm() < ROUNDING_M);
            for step in 0..=20 {
                let at = arc.at(arc.length_m() * f64::from(step) / 20.0).translation.vector;
                assert!((at.norm() - 1.0).abs() < ROUNDING_M && at.z.abs() < ROUNDING_M);
            }
            let near = (0..=3000)
                .map(|step| {
                    arc.at(arc.length_m() * f64::from(step) / 3000.0).translation.vector - Vector3::from(via)
                })
                .fold(f64::INFINITY, |nearest, displacement| nearest.min(displacement.norm()));
            assert!(near < 1e-3, "{near}");
        }
    }

    #[test]
    fn three_points_on_a_line_are_no_arc() {
        let at = |x: f64| pose([x, 0.0, 0.0], [0.0; 3]);
        assert!(Segment::arc(at(0.0), Vector3::x() * 0.5, at(1.0)).is_none());
        assert!(Segment::arc(at(0.0), Vector3::x(), at(1.0)).is_none());
        assert!(Segment::arc(at(0.0), Vector3::new(1.0, 1.0, 0.0), at(0.0)).is_none());
    }
}
