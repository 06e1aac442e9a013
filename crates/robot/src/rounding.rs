//! What the digits that joints and inertias are written with leave open.

use nalgebra::{Isometry3, Matrix3, Rotation3, UnitQuaternion, Vector3};

use super::{inertia::Inertia, joint_limit::JointLimit};

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

    /// This motion less another one.
    #[must_use]
    pub fn less(&self, other: &Self) -> Self {
        Self { angular_rad: self.angular_rad - other.angular_rad, linear_m: self.linear_m - other.linear_m }
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
    /// What the numbers are.
    pub form: JointForm,
}

/// The numbers that place a joint: those of two files are the same numbers in the same form alone.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum JointForm {
    /// Pose and axis in the link before, as in a URDF or an MJCF.
    #[default]
    Pose,
    /// A row of a table of the standard convention.
    StandardRow,
    /// A row of a table of the modified convention.
    ModifiedRow,
    /// A twist in the base.
    TwistInBase,
    /// A twist in the tip at zero.
    TwistInTip,
    /// An axis with a point on it in the base.
    PointInBase,
    /// An axis with a point on it in the tip at zero.
    PointInTip,
    /// A row, a twist or an axis in other variables: its numbers are not those that the file of these variables has.
    Rewritten,
}

impl JointRounding {
    /// How many numbers leave something open.
    pub fn values(&self) -> usize {
        self.motions().count()
    }

    /// All of these motions.
    pub fn motions(&self) -> impl Iterator<Item = &SmallMotion> {
        self.origin.iter().chain(&self.axis).chain(&self.frame)
    }

    /// The same in another frame of the parent link.
    #[must_use]
    pub fn expressed_in(&self, outer_from_frame: &Isometry3<f64>) -> Self {
        let moved = |motions: &[SmallMotion]| {
            motions.iter().map(|motion| motion.expressed_in(outer_from_frame)).collect()
        };
        let Self { origin, axis, frame, form } = self;
        Self { origin: moved(origin), axis: moved(axis), frame: moved(frame), form: *form }
    }
}

/// Half of the last place of the limits and losses of a joint, in their units; 0 where nothing is written or a program has
/// written all digits.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct JointValueRounding {
    /// Those of the limits; `None` as 0.
    pub limit: JointLimit,
    /// That of the damping.
    pub damping: f64,
    /// That of the dry friction.
    pub friction: f64,
    /// That of the armature.
    pub armature: f64,
}

/// How far mass, centre of mass and tensor of a link may be from the truth because of the digits that they are written with.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct InertiaRounding {
    /// Half of the last place of the mass, kg.
    pub mass_kg: f64,
    /// The most that each coordinate of the centre of mass is off, in the link, m.
    pub com_m: Vector3<f64>,
    /// The most that each entry of the tensor about the centre of mass is off, in the axes of the link, kg m^2.
    pub tensor_kg_m2: Matrix3<f64>,
}

impl InertiaRounding {
    /// From half places in the inertial frame, and from the turns of that frame about its origin, in the link, rad, that half of
    /// the last place of each number of its orientation makes.
    pub fn of_written(
        inertia: &Inertia,
        mass_kg: f64,
        com_m: Vector3<f64>,
        moments_kg_m2: &Matrix3<f64>,
        turns_rad: &[Vector3<f64>],
    ) -> Self {
        let tensor = inertia.tensor_in_link();
        let of_turn = |turn: &Vector3<f64>| {
            let cross = turn.cross_matrix();
            (cross * tensor - tensor * cross).abs()
        };
        let of_turns: Matrix3<f64> = turns_rad.iter().map(of_turn).sum();
        let of_moments = in_axes(moments_kg_m2, &inertia.link_from_inertial.rotation.to_rotation_matrix());
        Self { mass_kg, com_m, tensor_kg_m2: of_moments + of_turns }
    }

    /// The same in another frame of the link, to the outside.
    #[must_use]
    pub fn expressed_in(&self, outer_from_frame: &UnitQuaternion<f64>) -> Self {
        let turn = outer_from_frame.to_rotation_matrix();
        let com_m = turn.matrix().abs() * self.com_m;
        Self { com_m, tensor_kg_m2: in_axes(&self.tensor_kg_m2, &turn), ..*self }
    }
}

/// The most that the entries of a matrix are off in turned axes.
fn in_axes(most: &Matrix3<f64>, turn: &Rotation3<f64>) -> Matrix3<f64> {
    let sizes = turn.matrix().abs();
    sizes * most * sizes.transpose()
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
