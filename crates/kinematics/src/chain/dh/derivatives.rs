//! Derivatives of the pose of the tip by every parameter of a table, as twists.

use congruent_description::DhConvention;

use crate::{
    chain::axes::Axes,
    spatial::{pose::Pose, twist::Twist},
};

/// Derivatives by the parameters of one row: for each parameter the twist `(dT/dp) T^-1` per unit, in the frame in which the
/// chain is expressed. It applies to every frame behind the row.
///
/// `theta` turns about the row's z axis and `d` shifts along it, `alpha` turns about its x axis and
/// `a` shifts along that: z of the frame before and x of the row's own frame for a standard row, x
/// of the frame before and z of the own for a modified one. None depends on the joint's kind.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct DhRowTwists {
    /// Derivative by the link length, per m.
    pub a: Twist,
    /// Derivative by the link twist, per rad.
    pub alpha: Twist,
    /// Derivative by the link offset, per m.
    pub d: Twist,
    /// Derivative by the joint angle, per rad.
    pub theta: Twist,
}

impl DhRowTwists {
    /// The derivatives that follow from the frames before and behind the row.
    #[inline]
    pub fn between(convention: DhConvention, before: &Axes, behind: &Axes) -> Self {
        let (about_x, about_z) = match convention {
            DhConvention::Standard => (behind, before),
            DhConvention::Modified => (before, behind),
        };
        Self {
            a: Twist::shift(about_x.x),
            alpha: Twist::turn(about_x.x, &about_x.origin),
            d: Twist::shift(about_z.z),
            theta: Twist::turn(about_z.z, &about_z.origin),
        }
    }
}

/// Pose of the tip at one configuration and its derivative by every parameter of a table, each as the
/// twist `(dT/dp) T^-1` in link `base`: to first order, `dp` moves the tip to `exp([V] dp) T`.
///
/// | field | shape | unit | of |
/// |---|---|---|---|
/// | `base_from_tip` | SE(3) | m | |
/// | `by_base_from_dh0` | 6 | 1 per rad, per m | a twist of the constant, in `base`: `exp([V]) base_from_dh0` |
/// | `by_rows` | n | 1 per rad, per m | the rows' parameters |
/// | `by_dhn_from_tip` | 6 | 1 per rad, per m | a twist of the constant, in `dhn`: `exp([V]) dhn_from_tip` |
///
/// The six are in the order of [`Twist::units`]. A space twist is that of every frame fixed to the tip,
/// a tool's too; [`Twist::transformed_by`] gives it in other frames.
///
/// Source: Lynch & Park, *Modern Robotics* (2017), eq. 5.11, for parameters instead of joints.
///
/// # Examples
/// A planar arm of two links of 0.6 m and 0.4 m along x: `alpha` of the first row turns what lies
/// behind about x, which the tip lies on; `d` lifts it.
/// ```
/// # use congruent_description::{DhConvention, DhRow, DhRowKind, DhTable, JointKind, JointParts, Link, Robot};
/// # use nalgebra::{Isometry3, Vector3};
/// use congruent_description::RobotQ;
/// use congruent_kinematics::{DhChain, DhDerivatives};
/// # let link = |name: &str| Link { name: name.into(), ..Link::default() };
/// # let parts = |name: &str, parent: &str, child: &str, x: f64| {
/// #     JointParts::new(name, JointKind::Continuous, parent, child, Isometry3::translation(x, 0., 0.))
/// # };
/// # let robot = Robot::new("2r", vec![link("base"), link("upper"), link("lower")],
/// #     vec![parts("shoulder", "base", "upper", 0.), parts("elbow", "upper", "lower", 0.6)]).unwrap();
/// # let row = |joint: &str, a_m: f64| DhRow {
/// #     joint: robot.find_joint(joint).unwrap(), kind: DhRowKind::Revolute, a_m, alpha_rad: 0.,
/// #     d_m: 0., theta_rad: 0., sign: 1., line: 1,
/// # };
/// # let table = DhTable {
/// #     convention: DhConvention::Standard, source: None,
/// #     base_from_dh0: Isometry3::identity(), dhn_from_tip: Isometry3::identity(),
/// #     rows: vec![row("shoulder", 0.6), row("elbow", 0.4)],
/// # };
/// let chain = DhChain::new(&table, &robot);
/// let mut derivatives = DhDerivatives::default();
/// chain.derivatives_into(&RobotQ::zeros(2), &mut derivatives)?;
/// let tip = derivatives.base_from_tip.translation;
/// let by = derivatives.by_rows[0];
/// assert_eq!(by.alpha.linear + by.alpha.angular.cross(&tip), Vector3::zeros());
/// assert_eq!(by.d.linear, Vector3::z());
/// assert_eq!(derivatives.by_rows[1].theta.linear, Vector3::new(0., -0.6, 0.)); // about the elbow
/// # Ok::<(), congruent_kinematics::KinematicsError>(())
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct DhDerivatives {
    /// Pose of the tip in the base.
    pub base_from_tip: Pose,
    /// Derivatives by a twist of `base_from_dh0`: the unit twists themselves.
    pub by_base_from_dh0: [Twist; 6],
    /// Derivatives by the parameters of each row.
    pub by_rows: Vec<DhRowTwists>,
    /// Derivatives by a twist of `dhn_from_tip`.
    pub by_dhn_from_tip: [Twist; 6],
}
