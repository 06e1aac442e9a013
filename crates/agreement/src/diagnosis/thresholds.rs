//! Every threshold of the diagnosis, with its unit, its kind and the reason for its value.
//!
//! The mutation benchmark (`tests/mutations`) justifies them together. It injects faults of every cause and
//! of several magnitudes into 39 robots and counts how often the true cause is named first, listed as
//! indistinguishable from the first, or replaced by a simpler explanation:
//!
//! | injected | tolerance | faults | explained |
//! |---|---|---|---|
//! | none | 1e-9 m, 1e-9 rad | 39 robots | no finding |
//! | one fault | 1e-9 m, 1e-9 rad | 10,297 | 100 % |
//! | one fault | 1e-3 m, 1e-3 rad | 9,349 | 100 % |
//! | two faults | 1e-9 m, 1e-9 rad | 742 | 98.52 % |
//!
//! A changed threshold is measured by
//! `cargo test --release -p congruent-agreement --test mutations -- --ignored --nocapture`.
//! Mistakes in rounded tables are measured by the typed data sheets (`tests/advice/typed_sheets.rs`): ten published tables, one
//! to five mistakes. The table at the end of a check agrees in at least 97 % of the cases at 1 nm, 0.1 mm and 1 mm, and no cause is
//! named for rounding alone.
//!
//! "Without unit" is the norm of the difference of screws and tip, in which lengths are divided by the size
//! of the arm ([`super::evaluation_point::EvaluationPoint`]).

// Equality up to rounding.

/// Parameters, invariants and models that differ by less are the same. Unit: m, rad or none; kind: rounding
/// of a fit or of an identified chain. Fits end below 1e-11, and the smallest injected fault is 1e-4.
pub(crate) const SAME_VALUE: f64 = 1e-9;

/// Fits to a file that is itself rounded end within this part of their residual. No unit; kind: solver stop.
pub(super) const SAME_PART_OF_RESIDUAL: f64 = 1e-3;

/// Edits whose screws and tips differ by less have the same effect. Without unit; kind: rounding of some
/// fifty values of up to 1.
pub(super) const SAME_EFFECT: f64 = 1e-13;

/// Norms of fits that differ by less than this part are the same: parameters along one axis have the same
/// effect. No unit; kind: solver stop.
pub(super) const SAME_NORM: f64 = 1e-6;

/// A smaller turn is none. Unit: rad, or 1 for an entry of a rotation matrix; kind: rounding.
pub(super) const NO_TURN: f64 = 1e-12;

/// Axes whose angle has a smaller sine are parallel. No unit; kind: rounding. The common normal of two axes
/// has a relative error of some 1e-15 divided by this sine, so 1e-9 at this value.
pub(super) const PARALLEL: f64 = 1e-6;

/// A residual below this is rounding. Unit: m or rad; kind: rounding of a fit, or of a file with ten digits.
pub(super) const ROUNDING_RESIDUAL: f64 = 1e-11;

// Rotations as files write them.

/// Largest error of a quarter turn that a file rounds: 1.57 is off by 8e-4. Unit: rad; kind: digits of a file.
pub(crate) const ROUNDED_QUARTER_RAD: f64 = 1e-3;

/// Entries of a rotation by quarter turns are 0 or 1 within this; kind: digits of a file, three decimals.
/// Every rpy order of quarter turns is a quarter turn again, so a match is weak evidence for a wrong order.
pub(super) const QUARTER_TURNS: f64 = 1e-3;

/// Nearer to a pitch of a quarter turn, only the sum or difference of roll and yaw is defined. Unit: rad;
/// kind: digits of a file, which may have as few as ten.
pub(super) const SINGULAR_BELOW_RAD: f64 = 1e-9;

/// Numbers of files with few digits that differ by a unit have its ratio within this part. No unit; kind: digits of a
/// file.
pub(crate) const SAME_UNIT_RATIO: f64 = 1e-3;

// Digits of files.

/// Most joints of a chain whose differences are weighted by the digits of the files: the weights are a matrix of six
/// rows for each joint. Kind: speed.
pub(super) const MOST_WEIGHTED_JOINTS: usize = 24;

/// A typed value may be off by this much more than half of its last place. Relative; kind: rounding of sums of values
/// that are off by exactly half a place, such as 0.05 mm of 0.28475 m typed as 0.2848.
pub(super) const DIGITS_MARGIN: f64 = 1e-4;

/// A residual below this part of what the digits of the files allow is no rounding. No unit; kind: judgement; rounding
/// gives some fifth of what is allowed.
pub(super) const BEYOND_DIGITS: f64 = 1e-2;

/// Passes of the search for values within the digits. Kind: loop bound; some four are needed.
pub(super) const BOX_PASSES: usize = 16;

/// Damping of these passes, relative to the largest effect of a value. No unit; kind: solver.
pub(super) const BOX_DAMPING: DampingSchedule =
    DampingSchedule { first: 1e-9, least: 1e-14, most: 1e-2, after_success: 0.1, after_failure: 100.0 };

/// The search ends below this norm. Without unit; kind: choice, a thousandth of what counts as the same.
pub(super) const ENOUGH: f64 = 1e-12;

/// The search ends if more than this remains in the linear problem. Without unit; kind: choice, ten times what counts as the
/// same.
pub(super) const OUT_OF_REACH: f64 = 1e-8;

/// Times the error of the linear problem, as measured along the last step, that must remain, too. Kind: judgement.
pub(super) const FIRST_ORDER_ERRORS: f64 = 10.0;

// Choice between explanations.

/// An explanation whose residual is more than this many times the best one is refuted. No unit; kind: judgement.
/// The rounding of one file does not change a residual that much.
pub(super) const REFUTED: f64 = 10.0;

/// A correction that makes a difference this many times larger is no correction. No unit; kind: judgement. The first of two true
/// ones may make it somewhat larger.
pub(super) const FAR_WORSE: f64 = 10.0;

/// A value below this many times the residual could as well be zero. No unit; kind: judgement.
pub(super) const EVIDENT: f64 = 3.0;

/// A corrected unit that gives a value of so many times the residual is no coincidence, even if a fitted
/// parameter absorbs the file's rounding and has a lower residual. No unit; kind: judgement, the factor of
/// mm to m.
pub(super) const CERTAIN: f64 = 1e3;

/// Up to this part of the tolerance a residual is far below it, the best of three classes. No unit; kind:
/// choice.
pub(super) const FAR_BELOW_TOLERANCE: f64 = 0.1;

/// Up to this part of the tolerance a residual is below it, above is the last class. No unit; kind: choice.
pub(super) const BELOW_TOLERANCE: f64 = 0.3;

/// A fit is evaluated at all configurations only if its norm is at most so many tolerances. No unit; kind:
/// speed; the ratio of the screws' difference to that of the tips within the joints' ranges is far below.
pub(super) const EVALUATED_BELOW: f64 = 1e4;

// Extent of the search.

/// Most hypotheses that are tried in pairs, those with the smallest norms first. Kind: speed; 34,000 pairs for
/// chains of up to 60 rows, fewer for longer ones, since the fit of a pair takes longer with more rows.
pub(super) fn most_in_pairs(rows: usize) -> usize {
    const MOST: usize = 260;
    const ROWS: usize = 60;
    (MOST * MOST * ROWS / rows.max(ROWS)).isqrt()
}

/// Most parameters that may be wrong together before a difference counts as unexplained. Kind: choice; more
/// wrong parameters are a matter of calibration.
pub(super) const MAX_PARAMETERS: usize = 8;

/// A cause is gross if correcting it reduces the norm to less than this part. No unit; kind: choice.
pub(super) const GROSS_PART: f64 = 0.3;

/// Gross causes with up to this many times the smallest residual are alike: their residuals are due to other
/// faults, which a fit with more parameters absorbs in part. No unit; kind: choice.
pub(super) const GROSS_WITHIN: f64 = 3.0;

/// Most gross causes that are tried with further parameters. Kind: speed.
pub(super) const MAX_GROSS: usize = 8;

/// Most gross causes to which parameters are added one by one. Kind: speed.
pub(super) const MAX_GROSS_ONE_BY_ONE: usize = 2;

/// A further parameter must reduce the norm to less than this part. No unit; kind: choice.
pub(super) const PARAMETER_GAIN: f64 = 0.9;

/// Joints of the URDF that are named as the other place of a fault. Kind: choice; consecutive fixed joints, and offsets along
/// one axis, have the same effect.
pub(super) const MAX_ORIGINS: usize = 3;

/// Explanations with a residual beyond the tolerance that are reported. Kind: choice.
pub(super) const MAX_NEXT_BEST: usize = 4;

// The table with the fewest changes.

/// Values of a table that differ by fewer half places are the same. No unit; kind: judgement; two digits in each other's
/// place are 18 half places or more.
pub(super) const SAME_PLACES: f64 = 6.0;

/// Rates of 1 and -1 are the signs of a table. No unit; kind: rounding.
pub(super) const SAME_RATE: f64 = 1e-9;

/// Most changes that the search without a fit looks for. Kind: speed; five mistakes that exchange values and lose one at the
/// end of a shifted column change seven.
pub(super) const MAX_CHANGES: usize = 7;

/// Most rows of a table of which two edits are tried together. Kind: speed.
pub(super) const MAX_EDITED: usize = 10;

/// Most tables with the fewest changes that are fitted. Kind: speed; of several with as many changes, some differ in
/// which of two values with one effect changes.
pub(super) const MAX_TABLES: usize = 12;

// The nearest table that agrees.

/// A value is independent of others if more than this part of its effect is not a combination of theirs. No unit;
/// kind: rounding of directions of axes in a file with six digits.
pub(super) const INDEPENDENT: f64 = 1e-5;

/// The same for a table that agrees within the digits of its files. No unit; kind: rounding of files, of which the coarsest
/// write quarter turns as 1.57.
pub(super) const INDEPENDENT_IN_DIGITS: f64 = 1e-3;

/// Most fits of all values, each with the values that are independent there. Kind: loop bound.
pub(super) const MAX_PASSES: usize = 4;

/// How far a table that is derived from the axes may be off. Unit: m, rad; kind: choice, the default tolerance.
pub(super) const DERIVED_WITHIN: f64 = 1e-9;

// Fits.

/// Starts of an angle in addition to its present value. Unit: rad; kind: choice. Starts a third of a turn apart
/// miss no minimum, and at half a turn the slope is zero.
pub(super) const ANGLE_STARTS_RAD: [f64; 2] = [2.1, -2.1];

/// Below this norm no further start is tried. Without unit; kind: rounding of a fit.
pub(super) const GOOD_FIT: f64 = 1e-12;

/// A fit ends below this norm. Without unit; kind: rounding of some fifty values.
pub(super) const PERFECT_FIT: f64 = 3e-16;

/// Most steps of a fit. Kind: loop bound; fits that reach zero take some six steps.
pub(super) const MAX_STEPS: usize = 60;

/// A fit ends at a step that reduces the norm by less than this part: it is in another minimum. No unit;
/// kind: solver stop.
pub(super) const MIN_GAIN: f64 = 1e-3;

/// Damping of Levenberg and Marquardt, relative to the diagonal: at the start, at least, and at most; a fit
/// whose step fails at the last ends. No unit; kind: solver.
pub(super) const DAMPING: DampingSchedule =
    DampingSchedule { first: 1e-6, least: 1e-12, most: 1e4, after_success: 0.1, after_failure: 100.0 };

/// Added to the diagonal of the normal equations: a parameter without effect keeps its value. Without unit;
/// kind: rounding, some eps.
pub(super) const NO_EFFECT: f64 = 1e-15;

/// The damping of a fit and its change after each step.
pub(super) struct DampingSchedule {
    pub(super) first: f64,
    pub(super) least: f64,
    pub(super) most: f64,
    pub(super) after_success: f64,
    pub(super) after_failure: f64,
}

/// Two hypotheses together are tried anyway.
pub(super) const PAIR: usize = 2;

/// Joints of a chain whose signs are all tried together: 2^8 sets take some milliseconds.
pub(super) const MAX_FLIPPED_JOINTS: usize = 8;
