//! Every threshold of the comparison, with its unit, its kind and the reason for its value.
//!
//! The benchmark `diagnosis/planted.rs` justifies them together. It plants every cause and detail at every link, several
//! links, all links, joints and gravity, in the candidate's file and in what was built from it, and counts how often the
//! true cause is named, listed as having the same effect, or seen by no joint torque; none was missed:
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
//! Of 750 pairs of faults on links of two bodies that torque shows (150 on each of the first five) both are named in 672,
//! listed in 55; in 20 one of them is named or the same difference has another name, in 3 neither is found.
//!
//! Of the 71 faults of the corpus the 57 that torque shows are named, and the others raise no alarm. A changed threshold
//! is measured by `cargo test --release -p congruent-dynamics-agreement --lib planted -- --ignored --nocapture`.

/// What a source of torques is worth: how much of a difference an explanation may leave.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Precision {
    /// Share of the difference that may be left. No unit; kind: rounding, or truncation of the source.
    pub(crate) of_difference: f64,
    /// Share of both torques that may be left besides. No unit; kind: rounding.
    pub(crate) of_torque: f64,
    /// Differences below this share of the torque are none. No unit; kind: rounding of somebody's file.
    pub(crate) same: f64,
}

impl Precision {
    /// Two descriptions. Some thousand products leave 1e-15 of the torque, and a slip of 1e9 that much of its own.
    pub(crate) const EXACT: Self = Self { of_difference: 1e-8, of_torque: 1e-13, same: 1e-10 };

    /// Accelerations of a physics engine, extrapolated to a step of zero; worst seen 7.5e-10 of the torques (`xarm7_gripper`), 1e-10 of the acceleration.
    pub(crate) const ENGINE: Self = Self { of_difference: 1e-5, of_torque: 1e-9, same: 1e-8 };

    /// The largest norm that counts as nothing left.
    pub(crate) fn exact(&self, difference: f64, torques: f64) -> f64 {
        self.of_difference * difference + self.of_torque * torques
    }
}

// States.

/// States that torques are compared at. Kind: choice; the singular values of 20 give the number of base parameters
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

// Numbers that torques see.

/// Singular values below this share of the largest are none. No unit; kind: rounding of some thousand products; axes
/// that a rounded pi/2 leaves almost parallel give 1e-6.
pub(crate) const SEEN: f64 = 1e-11;
/// Singular values below this share are seen by the rounding of the axes only. No unit; kind: digits of a file.
pub(crate) const WEAKLY_SEEN: f64 = 1e-5;
/// A direction of free numbers with a smaller share of the largest effect stays as it is written: nothing shows it.
/// No unit; kind: rounding. Weakly seen numbers are above it.
pub(crate) const FREE_AND_SEEN: f64 = 1e-7;
/// Effects below this share of the largest there is are rounding. No unit; kind: rounding. Not more: beside a tensor
/// that is 1e9 times too large, weights make the effect of everything else that small.
pub(crate) const ROUNDING: f64 = 1e-15;
/// A joint whose torque is a smaller share of the largest is weighted by the largest. No unit; kind: rounding.
pub(crate) const NO_TORQUE: f64 = 1e-12;

// Parameters.

/// Parameters that differ by a smaller share of the link's own are equal. No unit; kind: digits of a file.
pub(crate) const SAME_VALUE: f64 = 1e-9;
/// A parameter below this share of the link's own is zero: a reader's rotation leaves as much. No unit; kind: rounding.
pub(crate) const ZERO_VALUE: f64 = 1e-12;
/// A slip that leaves a smaller share of the parameter is meant, and its parameters are rounded: a length in inches has four
/// digits. No unit; kind: digits of a file.
pub(crate) const FILE_DIGITS: f64 = 1e-5;
/// A tensor is a power of ten times identity within this share. No unit; kind: rounding.
pub(crate) const PLACEHOLDER: f64 = 1e-9;

// Choice between explanations.

/// Price of parameters that the file does not have or that stand there as a placeholder, however many they are. Unit:
/// free numbers; kind: choice, dearer than a slip and cheaper than any free number.
pub(crate) const PRICE_OF_MISSING: f64 = 0.5;
/// If every single explanation has more, pairs are tried as well: six or ten free numbers of one link also explain a
/// fault there and one at the first link, of which torque shows one number. Unit: free numbers; kind: choice.
pub(crate) const PAIRS_ABOVE: usize = 3;
/// Price of each part beyond the first. Unit: free numbers; kind: choice.
pub(crate) const PRICE_OF_PART: f64 = 1.0;

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

/// Boxes for each joint before a bracket is reported as it stands. Kind: speed; a box of four joints costs 10 us.
pub(crate) const MAX_BOXES: usize = 20_000;
/// Control values for each joint before a bracket is reported as it stands. Kind: speed; some 0.2 s.
pub(crate) const MAX_CONTROL_VALUES: usize = 20_000_000;
/// Joints of which one torque may depend; more have 3^10 coefficients. Kind: speed and memory.
pub(crate) const MAX_VARIABLES: usize = 9;
/// Coefficients of one torque of a motion, which is quadratic in each joint's waves: six joints take 5^6 for each of
/// some 36 products. Kind: speed and memory.
pub(crate) const MAX_COEFFICIENTS: usize = 2_500_000;
/// Control values of the products for each joint before a bracket is reported as it stands. Kind: speed; some 0.1 s.
pub(crate) const MAX_MOTION_VALUES: usize = 12_000_000;
/// A bracket is closed within this share. No unit; kind: choice.
pub(crate) const CLOSED: f64 = 0.005;
/// A bracket of a motion is closed within this share. No unit; kind: choice, ten times that of gravity alone.
pub(crate) const CLOSED_SUM: f64 = 0.05;
/// Coefficients below this share of the largest are left out and added as slack. No unit; kind: rounding.
pub(crate) const NO_COEFFICIENT: f64 = 1e-13;
