//! The twelve sets of Euler angles, to a rotation and back, with their singular positions.

use std::{f64::consts::PI, fmt, str::FromStr};

use nalgebra::Matrix3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::elementary::turn;

/// Nearer than this to a singular position (radians of the middle angle) the first and the last
/// angle can no longer be distinguished. Kind: rounding of a product of some dozen rotations, 64 eps.
const SINGULAR_BELOW_RAD: f64 = 1.4e-14;

/// The axes of three turns in a row, each about an axis of the frame that the one before has turned:
/// `Xyz` means `R = Rx(first) Ry(middle) Rz(last)`.
///
/// Three different axes (Tait-Bryan) or the first again at the end (proper Euler angles). About
/// *fixed* axes the same turns come in the reverse order: see [`EulerSet::reversed`].
///
/// Source: Craig, *Introduction to Robotics* (3rd ed. 2005), section 2.8 and appendix B.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum EulerSet {
    /// `R = Rx(first) Ry(middle) Rz(last)`.
    Xyz,
    /// `R = Rx(first) Rz(middle) Ry(last)`.
    Xzy,
    /// `R = Ry(first) Rx(middle) Rz(last)`.
    Yxz,
    /// `R = Ry(first) Rz(middle) Rx(last)`.
    Yzx,
    /// `R = Rz(first) Rx(middle) Ry(last)`.
    Zxy,
    /// `R = Rz(first) Ry(middle) Rx(last)`: yaw, pitch, roll.
    Zyx,
    /// `R = Rx(first) Ry(middle) Rx(last)`.
    Xyx,
    /// `R = Rx(first) Rz(middle) Rx(last)`.
    Xzx,
    /// `R = Ry(first) Rx(middle) Ry(last)`.
    Yxy,
    /// `R = Ry(first) Rz(middle) Ry(last)`.
    Yzy,
    /// `R = Rz(first) Rx(middle) Rz(last)`.
    Zxz,
    /// `R = Rz(first) Ry(middle) Rz(last)`.
    Zyz,
}

/// No set of Euler angles has this name.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("unknown set of Euler angles \"{name}\", known are {}", known.map(EulerSet::name).join(", "))]
pub struct UnknownEulerSet {
    /// The name that is not a set of Euler angles.
    pub name: String,
    /// All sets, nearest first.
    pub known: [EulerSet; 12],
}

/// Which of the first and the last angle of a set a rotation determines.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum DeterminedAngles {
    /// Both angles are determined.
    Both,
    /// Only their sum: the position is singular, and the first is set to zero.
    Sum,
    /// Only the first less the last: the position is singular, and the first is set to zero.
    Difference,
}

/// The angles of one rotation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EulerAngles {
    /// First, middle and last. The middle one is in `-pi/2..=pi/2` of three different axes and in
    /// `0..=pi` if the first comes again, the others are in `-pi..=pi`.
    pub angles_rad: [f64; 3],
    /// The same rotation with the middle angle in the other half of the circle.
    pub other_rad: [f64; 3],
    /// Whether the position is singular.
    pub determined: DeterminedAngles,
    /// How far the middle angle is from the nearest singular position, in `0..=pi/2`. A small error
    /// of the rotation comes back in the first and the last angle divided by its sine.
    pub from_singular_rad: f64,
}

impl EulerSet {
    /// All twelve sets: six of three different axes, six proper ones.
    pub const ALL: [Self; 12] = [
        Self::Xyz,
        Self::Xzy,
        Self::Yxz,
        Self::Yzx,
        Self::Zxy,
        Self::Zyx,
        Self::Xyx,
        Self::Xzx,
        Self::Yxy,
        Self::Yzy,
        Self::Zxz,
        Self::Zyz,
    ];

    /// The axes in lower case, first to last: `"zyx"`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Xyz => "xyz",
            Self::Xzy => "xzy",
            Self::Yxz => "yxz",
            Self::Yzx => "yzx",
            Self::Zxy => "zxy",
            Self::Zyx => "zyx",
            Self::Xyx => "xyx",
            Self::Xzx => "xzx",
            Self::Yxy => "yxy",
            Self::Yzy => "yzy",
            Self::Zxz => "zxz",
            Self::Zyz => "zyz",
        }
    }

    /// Whether the first axis comes again at the end.
    pub fn is_proper(self) -> bool {
        let [first, _, last] = self.axes();
        first == last
    }

    /// The set that gives the same rotation by the same angles in the reverse order, about the axes
    /// of the fixed frame; and the reverse.
    ///
    /// Source: Craig, *Introduction to Robotics* (3rd ed. 2005), eq. 2.64 and 2.71.
    ///
    /// # Examples
    /// Roll, pitch and yaw of a URDF turn about the fixed axes x, y, z, which is `Zyx` from the last.
    /// ```
    /// use congruent_kinematics::{EulerSet, Pose};
    /// let [roll, pitch, yaw] = [0.1, -0.2, 0.3];
    /// let about_fixed_axes = Pose::turn_z(yaw) * (Pose::turn_y(pitch) * Pose::turn_x(roll));
    /// let zyx = EulerSet::Xyz.reversed();
    /// assert_eq!(zyx, EulerSet::Zyx);
    /// assert!((zyx.rotation([yaw, pitch, roll]) - about_fixed_axes.rotation).norm() < 1e-15);
    /// ```
    #[must_use]
    pub fn reversed(self) -> Self {
        match self {
            Self::Xyz => Self::Zyx,
            Self::Xzy => Self::Yzx,
            Self::Yxz => Self::Zxy,
            Self::Yzx => Self::Xzy,
            Self::Zxy => Self::Yxz,
            Self::Zyx => Self::Xyz,
            same => same,
        }
    }

    /// The rotation by three angles: first, middle, last.
    ///
    /// # Examples
    /// ```
    /// use congruent_kinematics::EulerSet;
    /// use nalgebra::Vector3;
    /// use std::f64::consts::FRAC_PI_2;
    /// // The z axis goes to x by the first two turns of Zyz, and the last does not move it.
    /// let rotation = EulerSet::Zyz.rotation([0.0, FRAC_PI_2, 0.7]);
    /// assert!((rotation * Vector3::z() - Vector3::x()).norm() < 1e-15);
    /// ```
    pub fn rotation(self, angles_rad: [f64; 3]) -> Matrix3<f64> {
        let [first, middle, last] = self.axes();
        turn(first, angles_rad[0]) * turn(middle, angles_rad[1]) * turn(last, angles_rad[2])
    }

    /// The angles of a rotation, both solutions, and how well the rotation determines them.
    ///
    /// The first angle is found from where the last axis points, the last from what remains when the
    /// first is undone: so the three together are accurate even if the first alone is not.
    ///
    /// Source: Craig, *Introduction to Robotics* (3rd ed. 2005), eq. 2.66 to 2.75; at a singular
    /// position the first angle is zero, as in eq. 2.67, and the middle one is exactly there.
    ///
    /// # Examples
    /// ```
    /// use congruent_kinematics::{DeterminedAngles, EulerSet};
    /// let found = EulerSet::Zyz.angles(&EulerSet::Zyz.rotation([0.3, 0.5, -0.2]));
    /// assert!((found.angles_rad[1] - 0.5).abs() < 1e-15 && (found.other_rad[1] + 0.5).abs() < 1e-15);
    /// // Without the middle turn only the sum counts.
    /// let singular = EulerSet::Zyz.angles(&EulerSet::Zyz.rotation([0.3, 0.0, -0.2]));
    /// assert_eq!((singular.determined, singular.angles_rad[0]), (DeterminedAngles::Sum, 0.0));
    /// assert!((singular.angles_rad[2] - 0.1).abs() < 1e-15);
    /// ```
    pub fn angles(self, rotation: &Matrix3<f64>) -> EulerAngles {
        self.angles_singular_below(rotation, SINGULAR_BELOW_RAD)
    }

    /// The same for rotations that are less exact than rounding.
    pub fn angles_singular_below(self, rotation: &Matrix3<f64>, singular_below_rad: f64) -> EulerAngles {
        let [i, j, last] = self.axes();
        // The third axis: 0, 1 and 2 have the sum 3. The sign is that of the permutation, for one formula in place of
        // twelve.
        let k = 3 - i - j;
        let handed = if (i + 1) % 3 == j { 1.0 } else { -1.0 };
        let m = |row, column| rotation[(row, column)];
        // Where the last axis points: along the first in a singular position.
        let (across, up) = if self.is_proper() {
            (m(j, last), -handed * m(k, last))
        } else {
            (-handed * m(j, last), m(k, last))
        };
        let from_singular_rad = libm::atan2(libm::hypot(across, up), m(i, last).abs());
        let determined = match (from_singular_rad < singular_below_rad, m(i, last) > 0.0) {
            (false, _) => DeterminedAngles::Both,
            (true, true) => DeterminedAngles::Sum,
            (true, false) => DeterminedAngles::Difference,
        };
        let (first, sine) = match determined {
            DeterminedAngles::Both => (angle(across, up), libm::hypot(across, up)),
            // A sine of exactly 0 puts the middle angle exactly at the singular position; all of the turn goes to the
            // last.
            DeterminedAngles::Sum | DeterminedAngles::Difference => (0.0, 0.0),
        };
        // Row j of what remains when the first turn is undone.
        let (sin, cos) = libm::sincos(first);
        let remains = |column| cos * m(j, column) + handed * sin * m(k, column);
        let (middle, last) = if self.is_proper() {
            (angle(sine, m(i, i)), angle(-handed * remains(k), remains(j)))
        } else {
            (angle(handed * m(i, k), sine), angle(handed * remains(i), remains(j)))
        };
        let other_middle = if self.is_proper() { 0.0 - middle } else { opposite(-middle) };
        EulerAngles {
            angles_rad: [first, middle, last],
            other_rad: [opposite(first), other_middle, opposite(last)],
            determined,
            from_singular_rad,
        }
    }

    /// The axes as 0, 1, 2 for x, y, z.
    fn axes(self) -> [usize; 3] {
        let name = self.name().as_bytes();
        [0, 1, 2].map(|at| usize::from(name[at] - b'x'))
    }
}

/// The angle of a sine and a cosine of any common length, in `-pi..=pi`; a negative zero counts as zero.
fn angle(sine: f64, cosine: f64) -> f64 {
    libm::atan2(sine + 0.0, cosine)
}

/// Half a turn further, in `-pi..=pi`.
fn opposite(angle_rad: f64) -> f64 {
    if angle_rad > 0.0 { angle_rad - PI } else { angle_rad + PI }
}

impl fmt::Display for EulerSet {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(self.name())
    }
}

impl FromStr for EulerSet {
    type Err = UnknownEulerSet;

    /// From its axes, first to last, in upper or lower case.
    ///
    /// # Errors
    /// [`UnknownEulerSet`] for another name, with the known ones, nearest first.
    fn from_str(name: &str) -> Result<Self, Self::Err> {
        let lower = name.to_lowercase();
        let known = Self::ALL.into_iter().find(|set| set.name() == lower);
        known.ok_or_else(|| {
            let mut nearest = Self::ALL;
            let misses = |set: &Self| set.name().chars().zip(lower.chars()).filter(|(a, b)| a != b).count();
            nearest.sort_by_key(misses);
            UnknownEulerSet { name: name.to_owned(), known: nearest }
        })
    }
}
