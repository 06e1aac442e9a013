//! The two conditions under which a transform is one row of a table, and the error that says which of them fails and by how
//! much.

use std::fmt;

use congruent_description::DhConvention;
use nalgebra::Vector3;

/// How far from a right angle the two axes may be. Kind: digits of the file; ten of them, as in
/// 1.570796327 for a quarter turn, leave 2.1e-10.
const PERPENDICULAR_RAD: f64 = 1e-9;
/// How far the two axes may pass each other. Kind: digits of the file, as above within 2 m.
const MEETING_M: f64 = 1e-9;

/// The reason why a transform is not a row of a table: four parameters cannot hold the six of a rigid motion, so the
/// x axis of one frame must be perpendicular to the z axis of the other (DH1) and meet it (DH2).
///
/// Source: Spong, Hutchinson & Vidyasagar, *Robot Modeling and Control* (1st edition, 2006),
/// section 3.2.1; for the modified convention the same of the inverse.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub struct NotADhTransform {
    /// Convention of the row that was looked for.
    pub convention: DhConvention,
    /// Deviation of the angle between x axis and z axis from a right angle, rad.
    pub off_perpendicular_rad: f64,
    /// Distance between the lines of the x axis and of the z axis, m.
    pub off_meeting_m: f64,
}

impl NotADhTransform {
    /// Checks the two conditions for the axes of two frames; the z axis goes through the origin of its frame.
    ///
    /// | value | shape | unit | frame |
    /// |---|---|---|---|
    /// | `x` | 3 | 1 | unit, in the frame of the z axis |
    /// | `origin` | 3 | m | a point of the x axis, in the same frame |
    pub(super) fn check(
        convention: DhConvention,
        x: &Vector3<f64>,
        origin: &Vector3<f64>,
    ) -> Result<(), Self> {
        // DH1: x must be perpendicular to z. DH2: the line of x must meet the line of z, which it passes at the distance of
        // the two lines, measured along their common perpendicular.
        let across = Vector3::z().cross(x);
        let off_perpendicular_rad = libm::atan2(x.z.abs(), across.norm());
        // Parallel lines have no common perpendicular direction: their distance is the one to z.
        let off_meeting_m = across
            .try_normalize(f64::EPSILON)
            .map_or_else(|| origin.xy().norm(), |across| across.dot(origin).abs());
        if off_perpendicular_rad <= PERPENDICULAR_RAD && off_meeting_m <= MEETING_M {
            return Ok(());
        }
        Err(Self { convention, off_perpendicular_rad, off_meeting_m })
    }

    /// Whether the axes are not perpendicular.
    pub fn is_oblique(&self) -> bool {
        self.off_perpendicular_rad > PERPENDICULAR_RAD
    }

    /// Whether the axes do not meet.
    pub fn is_apart(&self) -> bool {
        self.off_meeting_m > MEETING_M
    }
}

impl fmt::Display for NotADhTransform {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let convention = self.convention.name();
        let (x, z) = match self.convention {
            DhConvention::Standard => ("x1", "z0"),
            DhConvention::Modified => ("x0", "z1"),
        };
        write!(f, "not a {convention} DH transform: ")?;
        if self.is_oblique() {
            let degrees = self.off_perpendicular_rad.to_degrees();
            write!(f, "{x} is {degrees:.9} deg off the perpendicular to {z}")?;
        }
        if self.is_oblique() && self.is_apart() {
            f.write_str(", and ")?;
        }
        if self.is_apart() {
            write!(f, "{x} passes {z} at a distance of {:.9} m instead of meeting it", self.off_meeting_m)?;
        }
        Ok(())
    }
}
