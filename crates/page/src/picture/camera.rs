//! The view of a picture: a parallel projection from above, from the side that shows most.

use nalgebra::{Point2, Point3, Vector3};

/// Angle of the view above the horizon.
const ELEVATION_RAD: f64 = 0.38;
/// Directions that are tried.
const DIRECTIONS: u32 = 24;

/// A parallel projection from the root link's frame (m) to the plane of the picture (m).
#[derive(Debug, Clone, Copy)]
pub(crate) struct FigureCamera {
    right: Vector3<f64>,
    up: Vector3<f64>,
}

impl FigureCamera {
    fn from_azimuth(azimuth_rad: f64) -> Self {
        let (sin, cos) = libm::sincos(azimuth_rad);
        let (sin_up, cos_up) = libm::sincos(ELEVATION_RAD);
        Self { right: Vector3::new(-sin, cos, 0.0), up: Vector3::new(-cos * sin_up, -sin * sin_up, cos_up) }
    }

    /// The direction from which the lines are longest together.
    pub(crate) fn showing(lines: &[[Point3<f64>; 2]]) -> Self {
        let cameras = (0..DIRECTIONS)
            .map(|k| Self::from_azimuth(std::f64::consts::TAU * f64::from(k) / f64::from(DIRECTIONS)));
        let projected = |camera: &Self| -> f64 {
            lines.iter().map(|[from, to]| (camera.project(to) - camera.project(from)).norm()).sum()
        };
        // Seen along a planar arm its links would lie on each other; the longest projections show its plane.
        cameras
            .max_by(|a, b| projected(a).total_cmp(&projected(b)))
            .unwrap_or_else(|| Self::from_azimuth(0.0))
    }

    /// Right and up, in metres.
    pub(crate) fn project(&self, point: &Point3<f64>) -> Point2<f64> {
        Point2::new(self.right.dot(&point.coords), self.up.dot(&point.coords))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_is_drawn_in_side_view() {
        let line = [Point3::origin(), Point3::new(0.0, 2.0, 0.0)];
        let camera = FigureCamera::showing(&[line]);
        let projected = camera.project(&line[1]) - camera.project(&line[0]);
        assert!((projected.norm() - 2.0).abs() < 1e-12, "{projected}");
        let up = camera.project(&Point3::new(0.0, 0.0, 1.0));
        assert!(up.x.abs() < 1e-12 && up.y > 0.9, "{up}");
    }
}
