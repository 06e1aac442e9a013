//! From a chain of screws to a table: frames assigned to the joint axes.
//!
//! One pass along the axes gives parameters that both conventions group differently. What the theory
//! does not determine is chosen, and every choice is reported.

use congruent_description::{DhConvention, DhRow, DhRowKind};
use nalgebra::{Matrix3, Vector3};

use super::{
    axis::{self, AxisLine, DeriveError, MotionAxis},
    choice::{self, Choice, FreeChoice},
    normal::{self, AxisRelation, CommonNormal},
    tidy,
};
use crate::{
    chain::{
        dh::{serial::SerialDh, standard::StandardDh},
        screws::chain::ScrewChain,
    },
    spatial::pose::Pose,
};

/// Sine below which the place of a common normal is ill-conditioned: it may lie ten times as far away
/// as the axes are apart. Where a line may be placed freely, it is placed so that this is not needed.
const NEARLY_PARALLEL_RAD: f64 = 0.1;
/// Axes closer than this part of the accuracy count as parallel, or as one line: the table has then
/// room for ten such simplifications.
pub(super) const PARALLEL_PART: f64 = 0.1;
/// Values closer to a short one than this part of the accuracy are written short.
const TIDY_PART: f64 = 0.01;

/// Relation of two consecutive axes of the chain, and the position of their common normal.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AxisPair {
    /// Index of the joint of the first axis, from 0; the second axis is that of the next joint.
    pub joint: usize,
    /// Relation of the two axes.
    pub relation: AxisRelation,
    /// Angle from the first to the second axis, rad, `0..=pi`.
    pub angle_rad: f64,
    /// Length of the common normal, m.
    pub distance_m: f64,
    /// How far along the first axis the normal lies from the one before: huge for axes that are
    /// nearly but not quite parallel, and what limits the accuracy then.
    pub normal_at_m: f64,
}

/// A derived table, with the choices that were made for it.
#[derive(Debug, Clone, PartialEq)]
pub struct DhDerivation {
    /// The derived table with its constants.
    pub dh: SerialDh,
    /// Relations of consecutive axes, base to tip.
    pub pairs: Vec<AxisPair>,
    /// The properties that the axes do not determine and that were chosen.
    pub choices: Vec<FreeChoice>,
}

impl DhDerivation {
    /// The pair whose normal is furthest away: what limits the accuracy; `None` for a single joint.
    pub fn furthest_normal(&self) -> Option<&AxisPair> {
        self.pairs.iter().max_by(|a, b| a.normal_at_m.abs().total_cmp(&b.normal_at_m.abs()))
    }
}

/// Derives a table from a chain, whatever the chain was written as.
///
/// Frame k is on the axis of joint k + 1 (standard) or k (modified), its x axis along the common
/// normal to the next axis. The z axes point as the joints turn, so every sign is 1. The constants
/// before and after the rows take up the rest of the motion, which four parameters a row cannot express.
///
/// | value | shape | unit | frame |
/// |---|---|---|---|
/// | `chain` | n screws | | base |
/// | `accuracy` | 1 | rad, m | what the table may be off; axes within a tenth of it count as parallel, as meeting or as one |
///
/// Source: Spong, Hutchinson & Vidyasagar, *Robot Modeling and Control* (1st edition, 2006), section
/// 3.2.2; Craig, *Introduction to Robotics* (3rd edition, 2005), section 3.4.
///
/// # Errors
/// [`DeriveError`] for a joint that fits no row, and for a chain without a moving joint.
/// # Examples
/// A turn about the vertical axis, then one about a horizontal axis 0.2 m above:
/// ```
/// use congruent_description::DhConvention;
/// use congruent_kinematics::{AxisRelation, Pose, Screw, ScrewChain, derive_dh};
/// use nalgebra::{Matrix3, Point3, Vector3};
/// let chain = ScrewChain {
///     twists_in_base: vec![
///         Screw::revolute(Vector3::z_axis(), &Point3::origin()).twist(),
///         Screw::revolute(-Vector3::y_axis(), &Point3::new(0., 0., 0.2)).twist(),
///     ],
///     base_from_tip_at_zero: Pose::from_parts(Matrix3::identity(), Vector3::new(0.5, 0., 0.2)),
/// };
/// let derived = derive_dh(&chain, DhConvention::Standard, 1e-12)?;
/// assert_eq!(derived.pairs[0].relation, AxisRelation::Intersecting);
/// let row = derived.dh.rows[0];
/// assert_eq!((row.a_m, row.alpha_rad, row.d_m), (0.0, std::f64::consts::FRAC_PI_2, 0.2));
/// # Ok::<(), congruent_kinematics::DeriveError>(())
/// ```
pub fn derive_dh(
    chain: &ScrewChain,
    convention: DhConvention,
    accuracy: f64,
) -> Result<DhDerivation, DeriveError> {
    let axes = axis::axes(chain, accuracy)?;
    let tip = chain.base_from_tip_at_zero;
    let assignment =
        FrameAssignment { axes, tip, parallel_rad: accuracy * PARALLEL_PART, tidy: accuracy * TIDY_PART };
    let derivation = assignment.derive();
    // A modified table has the same factors, grouped otherwise: one derivation serves both.
    Ok(DhDerivation { dh: derivation.dh.to_convention(convention), ..derivation })
}

/// The axes and the tip, with the bounds of "parallel" and of tidying.
struct FrameAssignment {
    axes: Vec<MotionAxis>,
    tip: Pose,
    parallel_rad: f64,
    tidy: f64,
}

impl FrameAssignment {
    /// The standard table: each frame is computed from the values written so far, so that what
    /// rounding and tidying change does not add up along the chain.
    fn derive(&self) -> DhDerivation {
        let base_from_dh0 = self.first_frame();
        let mut base_from_here = base_from_dh0;
        let (mut rows, mut pairs) = (Vec::new(), Vec::new());
        let mut choices = vec![FreeChoice { joint: 0, choice: Choice::FirstFrame }];
        for (joint, axis) in self.axes.iter().enumerate() {
            let is_last = joint + 1 == self.axes.len();
            let normal = if is_last {
                self.last_normal(&base_from_here)
            } else {
                let next = self.line(joint + 1, &base_from_here);
                let normal = normal::between(&base_from_here, &next, self.parallel_rad);
                pairs.push(pair(joint, &normal));
                choices.extend(choice::undetermined(joint, &normal, &self.axes[joint + 1]));
                normal
            };
            // The next frame follows from the row as written (tidied), so that its change is compensated by the next row
            // instead of adding up.
            let row = self.row(axis, &normal);
            base_from_here = base_from_here * fixed(&row);
            rows.push(row);
        }
        choices.push(FreeChoice { joint: rows.len() - 1, choice: Choice::LastFrame });
        let dhn_from_tip = tidy::pose(&(base_from_here.inverse() * self.tip), self.tidy);
        let dh = SerialDh { convention: DhConvention::Standard, base_from_dh0, rows, dhn_from_tip };
        DhDerivation { dh, pairs, choices }
    }

    fn row(&self, axis: &MotionAxis, normal: &CommonNormal) -> DhRow<()> {
        DhRow {
            joint: (),
            kind: match axis {
                MotionAxis::Turn(_) => DhRowKind::Revolute,
                MotionAxis::Slide(_) => DhRowKind::Prismatic,
            },
            a_m: tidy::number(normal.a_m, self.tidy),
            alpha_rad: tidy::angle(normal.alpha_rad, self.tidy),
            d_m: tidy::number(normal.d_m, self.tidy),
            theta_rad: tidy::angle(normal.theta_rad, self.tidy),
            sign: 1.0,
            line: 0,
        }
    }

    /// Frame 0: on the first axis, as near to the base frame as that allows.
    fn first_frame(&self) -> Pose {
        let line = self.line(0, &Pose::identity());
        let z = line.direction;
        let flat = |v: Vector3<f64>| v - z * v.dot(&z);
        // The projection of a base axis is ill-conditioned if it is nearly along z; of x and y one never is.
        let x = if z.x.abs() < 0.9 { flat(Vector3::x()) } else { flat(Vector3::y()) }.normalize();
        let rotation = Matrix3::from_columns(&[x, z.cross(&x), z]);
        tidy::pose(&Pose::from_parts(rotation, line.nearest_to(&Vector3::zeros())), self.tidy)
    }

    /// The line of an axis, given the frame before it. Only the direction of a shift counts:
    /// its line goes along the turning axis that follows if the two are parallel (a telescopic
    /// quill), otherwise through the origin of the frame before.
    fn line(&self, joint: usize, base_from_before: &Pose) -> AxisLine {
        let direction = match self.axes[joint] {
            MotionAxis::Turn(line) => return line,
            MotionAxis::Slide(direction) => direction,
        };
        let here = base_from_before.translation;
        let z_before = base_from_before.rotation.column(2).into_owned();
        let anchor = match self.axes[joint + 1..].iter().find(|axis| matches!(axis, MotionAxis::Turn(_))) {
            Some(MotionAxis::Turn(next)) if is_nearly_parallel(&direction, &next.direction) => {
                Some(next.nearest_to(&here))
            }
            None if is_nearly_parallel(&direction, &z_before) => Some(self.tip.translation),
            _ => None,
        };
        // A line nearly but not quite parallel to the axis before has its common normal far away, unless it passes through the
        // origin of the frame before: then the two meet there.
        let sine = z_before.cross(&direction).norm();
        let is_sound = sine <= self.parallel_rad || sine >= NEARLY_PARALLEL_RAD;
        AxisLine { point: anchor.filter(|_| is_sound).unwrap_or(here), direction }
    }

    /// The normal from the last axis to the z axis of the tip, so that `dhn_from_tip` is as simple as
    /// possible; a zero row if that normal is ill-conditioned.
    fn last_normal(&self, base_from_here: &Pose) -> CommonNormal {
        let tip_in_here = base_from_here.inverse() * self.tip;
        let column = |at: usize| self.tip.rotation.column(at).into_owned();
        let line = AxisLine { point: self.tip.translation, direction: column(2) };
        // The last row is free up to its axis; if the tip's z axis is parallel or coincident, its origin also fixes d.
        let normal = normal::between(base_from_here, &line, self.parallel_rad);
        let x_in_here = tip_in_here.rotation.column(0).into_owned();
        match normal.relation {
            AxisRelation::Coincident => {
                let theta_rad = libm::atan2(x_in_here.y, x_in_here.x);
                CommonNormal { theta_rad, d_m: tip_in_here.translation.z, ..normal }
            }
            AxisRelation::Parallel | AxisRelation::AntiParallel => {
                CommonNormal { d_m: tip_in_here.translation.z, ..normal }
            }
            _ if libm::sin(normal.alpha_rad).abs() >= NEARLY_PARALLEL_RAD => normal,
            relation => CommonNormal { relation, theta_rad: 0.0, d_m: 0.0, a_m: 0.0, alpha_rad: 0.0 },
        }
    }
}

fn is_nearly_parallel(a: &Vector3<f64>, b: &Vector3<f64>) -> bool {
    a.cross(b).norm() < NEARLY_PARALLEL_RAD
}

fn pair(joint: usize, normal: &CommonNormal) -> AxisPair {
    AxisPair {
        joint,
        relation: normal.relation,
        angle_rad: normal.alpha_rad.abs(),
        distance_m: normal.a_m.abs(),
        normal_at_m: normal.d_m,
    }
}

/// A row at position zero.
fn fixed(row: &DhRow<()>) -> Pose {
    let DhRow { a_m, alpha_rad, d_m, theta_rad, .. } = *row;
    StandardDh { a_m, alpha_rad, d_m, theta_rad }.transform()
}
