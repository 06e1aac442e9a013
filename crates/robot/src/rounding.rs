//! What the digits that a joint is written with leave open.

use nalgebra::{Isometry3, Vector3};

/// A small motion, to first order: every point `p` moves by `linear_m + angular_rad x p`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SmallMotion {
    /// The turn, rad.
    pub angular_rad: Vector3<f64>,
    /// The shift of the point at the origin of the frame, m.
    pub linear_m: Vector3<f64>,
}

impl SmallMotion {
    /// A shift, m.
    pub fn shift(linear_m: Vector3<f64>) -> Self {
        Self { angular_rad: Vector3::zeros(), linear_m }
    }

    /// A turn about an axis through a point, rad.
    pub fn turn(angular_rad: Vector3<f64>, through: &Vector3<f64>) -> Self {
        Self { angular_rad, linear_m: through.cross(&angular_rad) }
    }

    /// The same motion in the coordinates of another frame.
    #[must_use]
    pub fn expressed_in(&self, outer_from_frame: &Isometry3<f64>) -> Self {
        let angular_rad = outer_from_frame.rotation * self.angular_rad;
        let turned = outer_from_frame.rotation * self.linear_m;
        Self { angular_rad, linear_m: turned + outer_from_frame.translation.vector.cross(&angular_rad) }
    }
}

/// The motions, in the parent link, that half of the last place of each written number of a joint makes. Empty if a program
/// has written the numbers with all their digits, or nobody has written them.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct JointRounding {
    /// Those of the numbers of its origin, which move the joint and all that it carries.
    pub origin: Vec<SmallMotion>,
    /// Those of the numbers of its axis, which move the axis alone.
    pub axis: Vec<SmallMotion>,
    /// Those of the frame of the link that it carries, which move no axis and no other link: none of a file, whose numbers say
    /// where a frame lies, but of a frame that was chosen to lie where another description has it.
    pub frame: Vec<SmallMotion>,
}

impl JointRounding {
    /// How many numbers leave something open.
    pub fn values(&self) -> usize {
        self.origin.len() + self.axis.len() + self.frame.len()
    }

    /// The same in another frame of the parent link.
    #[must_use]
    pub(crate) fn expressed_in(&self, outer_from_frame: &Isometry3<f64>) -> Self {
        let moved = |motions: &[SmallMotion]| {
            motions.iter().map(|motion| motion.expressed_in(outer_from_frame)).collect()
        };
        Self { origin: moved(&self.origin), axis: moved(&self.axis), frame: moved(&self.frame) }
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{Point3, Translation3, UnitQuaternion};

    use super::*;

    /// A point moves the same, whatever frame the motion is expressed in.
    #[test]
    fn a_motion_is_the_same_in_every_frame() {
        let motion = SmallMotion::turn(Vector3::new(1e-4, -2e-4, 3e-4), &Vector3::new(0.3, 0.1, -0.2));
        let velocity =
            |motion: &SmallMotion, at: &Point3<f64>| motion.linear_m + motion.angular_rad.cross(&at.coords);
        let outer_from_frame = Isometry3::from_parts(
            Translation3::new(0.4, -0.1, 0.7),
            UnitQuaternion::from_euler_angles(0.3, -1.0, 2.0),
        );
        let at = Point3::new(0.5, 0.6, -0.7);
        let expected = outer_from_frame.rotation * velocity(&motion, &at);
        let found = velocity(&motion.expressed_in(&outer_from_frame), &(outer_from_frame * at));
        assert!((found - expected).norm() < 1e-18, "{found} {expected}");
        assert_eq!(velocity(&motion, &Point3::new(0.3, 0.1, -0.2)), Vector3::zeros());
    }
}
