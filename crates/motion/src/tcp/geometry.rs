//! Lines and arcs one after another, with blends between them.

use nalgebra::{Isometry3, Translation3};

use super::segment::Segment;

/// Lines and arcs; the parameter of the path is the length along them, without blends.
#[derive(Debug, Clone)]
pub(super) struct TcpPath {
    segments: Vec<Segment>,
    /// Length at the end of each.
    ends_m: Vec<f64>,
    /// Distance from the end of each within which it turns into the next; 0 for a stop.
    blends_m: Vec<f64>,
}

impl TcpPath {
    /// A path of segments, each beginning where the one before ends, each with the radius of the blend at its end.
    pub(super) fn new(segments: Vec<(Segment, f64)>) -> Self {
        let (segments, blends_m): (Vec<_>, Vec<_>) = segments.into_iter().unzip();
        let mut ends_m = Vec::with_capacity(segments.len());
        let mut end_m = 0.0;
        for segment in &segments {
            end_m += segment.length_m();
            ends_m.push(end_m);
        }
        Self { segments, ends_m, blends_m }
    }

    pub(super) fn length_m(&self) -> f64 {
        self.ends_m[self.ends_m.len() - 1]
    }

    /// Length at the end of each segment.
    pub(super) fn ends_m(&self) -> &[f64] {
        &self.ends_m
    }

    /// Angle by which the tool rotates in each segment.
    pub(super) fn turns_rad(&self) -> impl Iterator<Item = f64> + '_ {
        self.segments.iter().map(Segment::turn_rad)
    }

    /// Whether the tool stops at the end of a segment.
    pub(super) fn stops_after(&self, segment: usize) -> bool {
        self.blends_m[segment] == 0.0
    }

    /// The segment at a length of the path.
    pub(super) fn segment_at(&self, length_m: f64) -> usize {
        // A length behind the last end, by rounding, is on the last segment.
        self.ends_m.partition_point(|&end_m| end_m < length_m).min(self.ends_m.len() - 1)
    }

    /// The pose at a length of the path.
    pub(super) fn at(&self, length_m: f64) -> Isometry3<f64> {
        let index = self.segment_at(length_m);
        let segment = &self.segments[index];
        let start_m = self.ends_m[index] - segment.length_m();
        let (before_m, to_end_m) = (length_m - start_m, self.ends_m[index] - length_m);
        // Blends are at most half of a segment, so that a length is in one of the two at most.
        if index > 0 && before_m < self.blends_m[index - 1] {
            return self.blended(index - 1, before_m);
        }
        if index + 1 < self.segments.len() && to_end_m < self.blends_m[index] {
            return self.blended(index, -to_end_m);
        }
        segment.at(before_m)
    }

    /// The pose in the blend at the end of a segment, `from_corner_m` after it. One motion ends while the next begins:
    /// `p = first(L - a(1 - t)) + second(a(t)) - corner` with `a(t) = r (2 t^3 - t^4)`, which joins both with continuous
    /// velocity and acceleration; so do the rotations.
    fn blended(&self, index: usize, from_corner_m: f64) -> Isometry3<f64> {
        let (first, second, radius_m) =
            (&self.segments[index], &self.segments[index + 1], self.blends_m[index]);
        // From 0 to 1 over the blend, 1/2 at the corner.
        let t = ((from_corner_m + radius_m) / (2.0 * radius_m)).clamp(0.0, 1.0);
        let along_m = |t: f64| radius_m * t * t * t * (2.0 - t);
        let corner = second.at(0.0);
        let (out, on) = (first.at(first.length_m() - along_m(1.0 - t)), second.at(along_m(t)));
        // Both poses are relative to the corner, so it is counted twice and taken out once; rotations do not commute, so it
        // is taken out between the two.
        let shift = out.translation.vector + on.translation.vector - corner.translation.vector;
        let turn = out.rotation * corner.rotation.inverse() * on.rotation;
        Isometry3::from_parts(Translation3::from(shift), turn)
    }

    /// The corner at the end of a segment: the length of the difference of the directions before and after, from 0 for
    /// straight on to 2 for straight back.
    pub(super) fn corner(&self, index: usize) -> f64 {
        let (first, second) = (&self.segments[index], &self.segments[index + 1]);
        (second.direction_at(0.0) - first.direction_at(first.length_m())).norm()
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{UnitQuaternion, Vector3};

    use super::*;

    fn pose(xyz: [f64; 3], turn: [f64; 3]) -> Isometry3<f64> {
        let turn = UnitQuaternion::from_scaled_axis(Vector3::from(turn));
        Isometry3::from_parts(Translation3::from(Vector3::from(xyz)), turn)
    }

    /// A line, an arc and a line, with blends of 30 mm and 20 mm.
    fn path() -> TcpPath {
        let (a, b) = (pose([0.0; 3], [0.0; 3]), pose([0.3, 0.0, 0.0], [0.0, 0.4, 0.0]));
        let (c, d) = (pose([0.5, 0.2, 0.0], [0.3, 0.4, 0.0]), pose([0.5, 0.2, 0.4], [0.3, 0.0, 1.0]));
        let arc =
            Segment::arc(b, Vector3::new(0.3, 0.2, 0.0) + Vector3::new(0.1, -0.1, 0.0) * 2.0_f64.sqrt(), c);
        TcpPath::new(vec![(Segment::line(a, b), 0.03), (arc.unwrap(), 0.02), (Segment::line(c, d), 0.0)])
    }

    #[test]
    fn nothing_jumps_up_to_the_second_derivative() {
        let path = path();
        let h = 1e-4;
        let velocity =
            |at: f64| (path.at(at + h).translation.vector - path.at(at - h).translation.vector) / (2.0 * h);
        let turning = |at: f64| {
            (path.at(at + h).rotation * path.at(at - h).rotation.inverse()).scaled_axis() / (2.0 * h)
        };
        let mut at = 2.0 * h;
        while at < path.length_m() - 4.0 * h {
            // Curvature at most 3/(4 r) times the corner, a jump of the derivative would be 0.1 and more.
            let [bend, change] =
                [(velocity(at + h) - velocity(at)).norm(), (turning(at + h) - turning(at)).norm()];
            assert!(bend < 75.0 * h && change < 200.0 * h, "{bend} {change} at {at}");
            let second = (velocity(at + h) - velocity(at)) / h;
            let next = (velocity(at + 2.0 * h) - velocity(at + h)) / h;
            // A jump of curvature would be 5 and more; its slope is 1.5 / r^2 times sqrt(2) at most.
            assert!((second - next).norm() < 5.5e3 * h, "{} at {at}", (second - next).norm());
            at += h;
        }
    }

    #[test]
    fn outside_of_blends_the_speed_is_that_of_the_parameter_and_inside_it_is_no_more() {
        let path = path();
        let h = 1e-5;
        let speed = |at: f64| {
            (path.at(at + h).translation.vector - path.at(at - h).translation.vector).norm() / (2.0 * h)
        };
        let arc_end_m = path.ends_m()[1];
        for at in [0.1, 0.26, 0.35, 0.4, arc_end_m - 0.021, arc_end_m + 0.021, arc_end_m + 0.2] {
            assert!((speed(at) - 1.0).abs() < 1e-8, "{} at {at}", speed(at));
        }
        for at in [0.28, 0.3, 0.32, arc_end_m - 0.01, arc_end_m, arc_end_m + 0.01] {
            assert!(speed(at) < 1.0 + 1e-8, "{} at {at}", speed(at));
        }
        // In the middle of the blend of perpendicular directions: cos(45 deg).
        assert!((speed(arc_end_m) - 0.5_f64.sqrt()).abs() < 2e-3, "{}", speed(arc_end_m));
        assert!((path.corner(1) - 2.0_f64.sqrt()).abs() < 1e-9 && path.corner(0) < 1e-9);
    }

    #[test]
    fn a_blend_cuts_its_corner_by_three_sixteenths_of_its_radius() {
        let at = |xyz| pose(xyz, [0.0; 3]);
        let corner = [at([0.0; 3]), at([1.0, 0.0, 0.0]), at([1.0, 1.0, 0.0])];
        let lines =
            vec![(Segment::line(corner[0], corner[1]), 0.1), (Segment::line(corner[1], corner[2]), 0.0)];
        let middle = TcpPath::new(lines).at(1.0).translation.vector;
        let cut = Vector3::new(1.0 - 0.1 * 3.0 / 16.0, 0.1 * 3.0 / 16.0, 0.0);
        assert!((middle - cut).norm() < 1e-12, "{middle}");
    }
}
