//! Poses of tools by the directions of a hand: normal, sliding, approach.

use nalgebra::{Matrix3, Point3, Vector3};

use super::pose::Pose;

/// How far a length may be from 1. Kind: written values, six digits each (three entries off by
/// 5e-7 are 8.7e-7 together); smaller deviations are corrected.
const UNIT: f64 = 1e-6;
/// How far two axes may be from perpendicular, in radians. Kind: written values, six digits each (twice
/// 8.7e-7); smaller deviations are corrected.
const PERPENDICULAR_RAD: f64 = 2e-6;
/// At smaller angles than this, approach and sliding do not determine the third axis: six digits are too few.
const PARALLEL_RAD: f64 = 1e-6;

/// The axes of a gripper: it comes along `approach`, its fingers slide along `sliding`, and `normal` is
/// normal to both, `n = s x a`.
///
/// | field | shape | unit | frame |
/// |---|---|---|---|
/// | all three | 3 | 1 | that in which the tool's pose is wanted |
///
/// Source: Spong, Hutchinson & Vidyasagar, *Robot Modeling and Control* (2006), section 3.2.2: x, y and z of
/// the last frame.
///
/// # Examples
/// A gripper that comes from above, its fingers along y.
/// ```
/// use congruent_kinematics::{ToolAxes, ToolAxesError};
/// use nalgebra::{Point3, Vector3};
/// let axes = ToolAxes::from_approach_and_sliding(Vector3::new(0., 0., -2.), Vector3::new(0., 0.1, 0.))?;
/// assert_eq!(axes.normal, Vector3::new(-1., 0., 0.));
/// let base_from_tool = axes.base_from_tool(&Point3::new(0.4, 0., 0.2))?;
/// assert_eq!(base_from_tool * Point3::new(0., 0., 0.2), Point3::new(0.4, 0., 0.));
/// assert_eq!(ToolAxes::from_pose(&base_from_tool), axes);
/// # Ok::<(), ToolAxesError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ToolAxes {
    /// x of the tool.
    pub normal: Vector3<f64>,
    /// y of the tool: how the fingers open.
    pub sliding: Vector3<f64>,
    /// z of the tool: how it comes to the part.
    pub approach: Vector3<f64>,
}

/// The reason why three directions do not form a frame.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ToolAxesError {
    /// An axis has another length than 1.
    #[error("the {axis} axis has length {length}, it must be 1 within {UNIT:e}")]
    NotUnit {
        /// `normal`, `sliding` or `approach`.
        axis: &'static str,
        /// Length of the given vector.
        length: f64,
    },
    /// Two axes are not perpendicular.
    #[error(
        "the {first} and {second} axes are {off_rad:e} rad from perpendicular, the limit is {PERPENDICULAR_RAD:e}"
    )]
    NotPerpendicular {
        /// Name of the first axis.
        first: &'static str,
        /// Name of the second axis.
        second: &'static str,
        /// A quarter turn less their angle, in radians.
        off_rad: f64,
    },
    /// The axes are a mirror image.
    #[error("the axes are left-handed: n . (s x a) is {triple_product}, it must be 1")]
    LeftHanded {
        /// `n . (s x a)`.
        triple_product: f64,
    },
    /// A direction of no length, or with entries that are not finite.
    #[error("the {axis} direction has length {length}, so it is not a direction")]
    NoDirection {
        /// Name of the direction: `sliding` or `approach`.
        axis: &'static str,
        /// Length of the given vector.
        length: f64,
    },
    /// Approach and sliding are one direction.
    #[error("approach and sliding are {angle_rad:e} rad from parallel, which does not determine the normal")]
    Parallel {
        /// Their angle, or that of one and the opposite of the other, in radians.
        angle_rad: f64,
    },
}

impl ToolAxes {
    /// The axes of a tool at this pose.
    pub fn from_pose(base_from_tool: &Pose) -> Self {
        let [normal, sliding, approach] = [0, 1, 2].map(|at| base_from_tool.rotation.column(at).into_owned());
        Self { normal, sliding, approach }
    }

    /// The axes by two directions of any length: `approach` is kept, `sliding` is made perpendicular to it.
    ///
    /// # Errors
    /// [`ToolAxesError::NoDirection`] and [`ToolAxesError::Parallel`].
    pub fn from_approach_and_sliding(
        approach: Vector3<f64>,
        sliding: Vector3<f64>,
    ) -> Result<Self, ToolAxesError> {
        let (approach, sliding) = (direction("approach", &approach)?, direction("sliding", &sliding)?);
        let across = sliding.cross(&approach);
        let angle_rad = libm::asin(across.norm());
        if angle_rad < PARALLEL_RAD {
            return Err(ToolAxesError::Parallel { angle_rad });
        }
        let normal = across.normalize();
        Ok(Self { normal, sliding: approach.cross(&normal), approach })
    }

    /// The pose of the tool with these axes and this origin; deviations of six digits are corrected.
    ///
    /// | value | shape | unit | frame |
    /// |---|---|---|---|
    /// | `tool_in_base` | 3 | m | that of the axes, here called base |
    /// | result | SE(3) | m | `base_from_tool` |
    ///
    /// # Errors
    /// [`ToolAxesError::NotUnit`], [`ToolAxesError::NotPerpendicular`] and [`ToolAxesError::LeftHanded`], by how
    /// much, in this order.
    pub fn base_from_tool(&self, tool_in_base: &Point3<f64>) -> Result<Pose, ToolAxesError> {
        let named = [("normal", self.normal), ("sliding", self.sliding), ("approach", self.approach)];
        for (axis, vector) in named {
            let length = vector.norm();
            if (length - 1.0).abs() > UNIT || length.is_nan() {
                return Err(ToolAxesError::NotUnit { axis, length });
            }
        }
        for (one, other) in [(0, 1), (1, 2), (2, 0)] {
            let ((first, a), (second, b)) = (named[one], named[other]);
            let off_rad = libm::atan2(a.dot(&b), a.cross(&b).norm());
            if off_rad.abs() > PERPENDICULAR_RAD {
                return Err(ToolAxesError::NotPerpendicular { first, second, off_rad });
            }
        }
        let written = Matrix3::from_columns(&[self.normal, self.sliding, self.approach]);
        let corrected = Pose::from_parts(written, tool_in_base.coords).orthonormalized();
        corrected.ok_or(ToolAxesError::LeftHanded { triple_product: written.determinant() })
    }
}

/// A vector of length 1.
fn direction(axis: &'static str, vector: &Vector3<f64>) -> Result<Vector3<f64>, ToolAxesError> {
    // Divided by its largest entry first, so that no square overflows or vanishes.
    let largest = vector.amax();
    let unit = (vector / largest).normalize();
    if largest > 0.0 && unit.iter().all(|entry| entry.is_finite()) {
        Ok(unit)
    } else {
        Err(ToolAxesError::NoDirection { axis, length: vector.norm() })
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::support;

    /// Rounding of a dozen products of numbers up to 1; worst seen 5.6e-16.
    const ROUNDING: f64 = 5e-15;

    fn written(normal: [f64; 3], sliding: [f64; 3], approach: [f64; 3]) -> Result<Pose, ToolAxesError> {
        let [normal, sliding, approach] = [normal, sliding, approach].map(Vector3::from);
        ToolAxes { normal, sliding, approach }.base_from_tool(&Point3::new(1., 2., 3.))
    }

    #[track_caller]
    fn refused(axes: [[f64; 3]; 3], message: &str) {
        let [normal, sliding, approach] = axes;
        assert_eq!(written(normal, sliding, approach).unwrap_err().to_string(), message);
    }

    #[test]
    fn a_refusal_says_which_condition_fails_and_by_how_much() {
        let (x, y, z) = ([1., 0., 0.], [0., 1., 0.], [0., 0., 1.]);
        refused([[0.5, 0., 0.], y, z], "the normal axis has length 0.5, it must be 1 within 1e-6");
        refused([x, [f64::NAN; 3], z], "the sliding axis has length NaN, it must be 1 within 1e-6");
        refused([x, y, [0., 0., 2.]], "the approach axis has length 2, it must be 1 within 1e-6");
        refused([y, x, z], "the axes are left-handed: n . (s x a) is -1, it must be 1");
        let tilted = [0., 0.6, 0.8];
        let off_rad = 0.6_f64.atan2(0.8);
        let [x, y, tilted] = [x, y, tilted].map(Vector3::from);
        let axes = ToolAxes { normal: x, sliding: y, approach: tilted };
        let Err(ToolAxesError::NotPerpendicular { first, second, off_rad: found }) =
            axes.base_from_tool(&Point3::origin())
        else {
            panic!("axes 53 degrees apart are no frame")
        };
        assert_eq!((first, second), ("sliding", "approach"));
        assert!(support::within((found - off_rad).abs(), ROUNDING));
    }

    #[test]
    fn directions_that_fix_no_frame_are_refused() {
        let by = |approach: [f64; 3], sliding: [f64; 3]| {
            ToolAxes::from_approach_and_sliding(approach.into(), sliding.into()).unwrap_err().to_string()
        };
        assert_eq!(
            by([0.; 3], [1., 0., 0.]),
            "the approach direction has length 0, so it is not a direction"
        );
        assert_eq!(
            by([1., 0., 0.], [f64::INFINITY, 0., 0.]),
            "the sliding direction has length inf, so it is not a direction"
        );
        let parallel = "approach and sliding are 0e0 rad from parallel, which does not determine the normal";
        assert_eq!(by([0., 0., 3.], [0., 0., -1.]), parallel);
    }

    proptest! {
        #![proptest_config(support::cases())]

        #[test]
        fn axes_of_a_pose_give_it_back(pose in support::isometry()) {
            let pose = Pose::from(pose);
            let axes = ToolAxes::from_pose(&pose);
            let back = axes.base_from_tool(&Point3::from(pose.translation)).unwrap();
            prop_assert!(support::within(back.angle_rad(&pose), ROUNDING));
            prop_assert_eq!(back.translation, pose.translation);
        }

        #[test]
        fn six_digits_are_enough_and_are_corrected(pose in support::isometry()) {
            let six_digits = |v: Vector3<f64>| v.map(|entry| (entry * 1e6).round() / 1e6);
            let pose = Pose::from(pose);
            let ToolAxes { normal, sliding, approach } = ToolAxes::from_pose(&pose);
            let axes = ToolAxes { normal: six_digits(normal), sliding: six_digits(sliding), approach: six_digits(approach) };
            let back = axes.base_from_tool(&Point3::origin()).unwrap();
            prop_assert!(support::within(back.orthonormality_error(), ROUNDING));
            prop_assert!(back.angle_rad(&pose) < PERPENDICULAR_RAD);
        }

        #[test]
        fn lengths_and_tilts_of_directions_do_not_count(
            pose in support::isometry(), exponents in proptest::array::uniform2(-200.0..200.0), tilt in -3.0..3.0,
        ) {
            let axes = ToolAxes::from_pose(&Pose::from(pose));
            let [long, short] = exponents.map(|exponent| 10_f64.powf(exponent));
            let sliding = (axes.sliding + axes.approach * tilt) * short;
            let found = ToolAxes::from_approach_and_sliding(axes.approach * long, sliding).unwrap();
            for (found, expected) in [
                (found.normal, axes.normal), (found.sliding, axes.sliding), (found.approach, axes.approach),
            ] {
                prop_assert!(support::within((found - expected).norm(), ROUNDING));
            }
        }
    }
}
