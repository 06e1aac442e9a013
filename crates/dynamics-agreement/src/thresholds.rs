//! Every threshold of the comparison, with its unit, its kind and the reason for its value.
//!
//! The benchmark `diagnosis/planted.rs` justifies them together. It plants every cause and detail at every link, several
//! links, all links, joints and gravity, in the candidate's file and in what was built from it, and counts how often the
//! true cause is named, listed as having the same effect, or hidden (without an effect on joint torques); none was missed:
//!
//! | robot | file: faults, named / listed / hidden | built from it: faults, named / listed / hidden |
//! |---|---|---|
//! | `ur5e` | 651: 610 / 11 / 30 | 659: 599 / 30 / 30 |
//! | `iiwa14` | 769: 724 / 11 / 34 | 776: 714 / 28 / 34 |
//! | `panda` (before `com_unit`, `m`, as the rows below) | 1154: 1064 / 35 / 55 | 1162: 1007 / 100 / 55 |
//! | `so100` | 679: 657 / 9 / 13 | 686: 653 / 20 / 13 |
//! | `rrr_arm` | 856: 750 / 64 / 42 | 863: 679 / 141 / 42, 1 under another name |
//! | `denso_hsr065` | 220: 114 / 64 / 42 | 225: 128 / 55 / 42 |
//!
//! Of 750 pairs of identifiable faults on links of two bodies (150 on each of the first five) both are named in 672,
//! listed in 55; in 20 one of them is named or the same difference has another name, in 3 neither is found.
//!
//! Of the 71 faults of the corpus the 57 that change torques are named, and the others raise no alarm. A changed threshold
//! is measured by `cargo test --release -p congruent-dynamics-agreement --lib planted -- --ignored --nocapture`.

/// The precision of a source of torques: the largest residual of an explanation that counts as exact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Precision {
    /// Largest residual relative to the difference. No unit; kind: rounding, or truncation of the source.
    pub(crate) of_difference: f64,
    /// Residual that is allowed in addition, relative to the sum of both torques. No unit; kind: rounding.
    pub(crate) of_torque: f64,
    /// Differences below this share of the torques count as agreement. No unit; kind: rounding of the values in a file.
    pub(crate) same: f64,
}

impl Precision {
    /// Two descriptions. Some thousand products round by 1e-15 of the torque, and a value that is 1e9 times too large by 1e-15 of
    /// itself.
    pub(crate) const EXACT: Self = Self { of_difference: 1e-8, of_torque: 1e-13, same: 1e-10 };

    /// Accelerations of a physics engine, extrapolated to a step of zero; worst seen 7.5e-10 of the torques (`xarm7_gripper`), 1e-10 of the acceleration.
    pub(crate) const ENGINE: Self = Self { of_difference: 1e-5, of_torque: 1e-9, same: 1e-8 };

    /// The largest residual norm that counts as exact.
    pub(crate) fn exact(&self, difference: f64, torques: f64) -> f64 {
        self.of_difference * difference + self.of_torque * torques
    }
}

// States.

/// Number of states at which torques are compared. Kind: choice; the singular values of 20 give the number of base parameters
/// already, 100 give every column some thousand digits' worth of rows.
pub(crate) const STATES: usize = 100;
/// Invariants are compared at so many of the states. Kind: choice; they are an impression, the certificate is the bound.
pub(crate) const INVARIANT_STATES: usize = 20;
/// Largest speed, rad/s or m/s. Kind: choice, so that velocity products are as large as gravity.
pub(crate) const LARGEST_SPEED: f64 = 2.0;
/// Smallest speed: dry friction is undefined at rest. Unit: rad/s or m/s; kind: choice.
pub(crate) const SMALLEST_SPEED: f64 = 0.2;
/// Largest acceleration, rad/s^2 or m/s^2. Kind: choice, that of a fast arm.
pub(crate) const LARGEST_ACCELERATION: f64 = 10.0;

/// Most joints that move. Kind: speed; the regressor at all states is reduced in a time that grows with the cube of the
/// joints: 2.3 s for 50, 4 s for 60, some 20 s for 100.
pub(crate) const MOST_JOINTS: usize = 60;

// Identifiability.

/// Singular values below this share of the largest count as zero. No unit; kind: rounding of some thousand products; axes that
/// are almost parallel because pi/2 is rounded give 1e-6.
pub(crate) const IDENTIFIABLE: f64 = 1e-11;
/// Combinations with a singular value below this share are identifiable only because axes are rounded. No unit; kind: digits
/// of a file.
pub(crate) const WEAKLY_IDENTIFIABLE: f64 = 1e-5;
/// A direction of free parameters with a smaller share of the largest effect is not identifiable and keeps its written value.
/// No unit; kind: rounding. Combinations that are identifiable through rounded axes are above it.
pub(crate) const FREE_AND_IDENTIFIABLE: f64 = 1e-7;
/// Effects below this share of the largest there is are rounding. No unit; kind: rounding. Not more: beside a tensor
/// that is 1e9 times too large, weights make the effect of everything else that small.
pub(crate) const ROUNDING: f64 = 1e-15;
/// A joint whose torque is a smaller share of the largest is weighted by the largest. No unit; kind: rounding.
pub(crate) const NO_TORQUE: f64 = 1e-12;

// Parameters.

/// Parameters that differ by a smaller share of the link's own are equal. No unit; kind: digits of a file.
pub(crate) const SAME_VALUE: f64 = 1e-9;
/// Tensors that differ by a smaller share are one that was computed twice, as from another pi. No unit; kind: choice, six digits.
pub(crate) const COMPUTED_OTHERWISE: f64 = 5e-6;
/// A parameter below this share of the link's own counts as zero: the rotation of a reader rounds by as much. No unit; kind:
/// rounding.
pub(crate) const ZERO_VALUE: f64 = 1e-12;
/// A mistake that explains a parameter except for a smaller share keeps its name, since its values were rounded: a length in
/// inches has four digits. No unit; kind: digits of a file.
pub(crate) const FILE_DIGITS: f64 = 1e-5;
/// A tensor is a power of ten times identity within this share. No unit; kind: rounding.
pub(crate) const PLACEHOLDER: f64 = 1e-9;

// Choice between explanations.

/// Complexity of parameters that the file does not have, or has as a placeholder, however many they are. Unit: free
/// parameters; kind: choice, above that of a mistake without free parameters (0) and below one free parameter.
pub(crate) const COMPLEXITY_OF_MISSING: f64 = 0.5;
/// If every single explanation has more free parameters, pairs are tried as well: six or ten free parameters of one link also
/// explain a fault there together with one at the first link, which has one identifiable parameter. Unit: free parameters;
/// kind: choice.
pub(crate) const PAIRS_ABOVE: usize = 3;
/// If the causes of all links together have a higher complexity, pairs of faults are tried as well. Unit: free parameters;
/// kind: choice, that of two faults with one free parameter each.
pub(crate) const COMPLEXITY_OF_PAIRS: f64 = 3.0;
/// Complexity of each part beyond the first. Unit: free parameters; kind: choice.
pub(crate) const COMPLEXITY_PER_PART: f64 = 1.0;

// Fits.

/// Most steps of a fit. Kind: loop bound; fits that reach zero take some six.
pub(crate) const MAX_STEPS: usize = 30;
/// A fit ends at a step below this share of its unknowns. No unit; kind: solver stop.
pub(crate) const LAST_STEP: f64 = 1e-13;
/// Further starts of a centre of mass beside what is written. Unit: m; kind: choice, the size of a link.
pub(crate) const COM_START_M: f64 = 0.05;
/// Step of a central difference of parameters that are quadratic in each unknown, where it is exact. Unit: that of the
/// unknown; kind: rounding.
pub(crate) const QUADRATIC_STEP: f64 = 1e-2;
/// Step of a central difference of a rotation. Unit: rad; kind: truncation of 1e-10, which costs a step more.
pub(crate) const ROTATION_STEP_RAD: f64 = 1e-5;

// Bounds.

/// Most boxes that are divided for each joint; a bracket that is not closed then is reported with its gap. Kind: speed; a box
/// of four joints costs 10 us.
pub(crate) const MAX_BOXES: usize = 20_000;
/// Most control values that are computed for each joint. Kind: speed; some 0.2 s.
pub(crate) const MAX_CONTROL_VALUES: usize = 20_000_000;
/// Most joints on which one torque may depend; ten have 3^10 coefficients. Kind: speed and memory.
pub(crate) const MAX_VARIABLES: usize = 9;
/// Most coefficients of one torque of a motion, which is quadratic in sine and cosine of each joint: six joints have 5^6 for
/// each of some 36 products. Kind: speed and memory.
pub(crate) const MAX_COEFFICIENTS: usize = 2_500_000;
/// Most control values of a motion that are computed for each joint. Kind: speed; some 0.1 s.
pub(crate) const MAX_MOTION_VALUES: usize = 12_000_000;
/// A bracket is closed within this share. No unit; kind: choice.
pub(crate) const CLOSED: f64 = 0.005;
/// A bracket of a motion is closed within this share. No unit; kind: choice, ten times that of gravity alone.
pub(crate) const CLOSED_SUM: f64 = 0.05;
/// Coefficients below this share of the largest are left out and added as slack. No unit; kind: rounding.
pub(crate) const NO_COEFFICIENT: f64 = 1e-13;
