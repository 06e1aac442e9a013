//! What a recording says of the parameters of a robot.

use congruent_dynamics::{PARAMETERS, SpatialInertia};
use nalgebra::{DMatrix, DVector, Vector3};

use crate::{
    equations::RecordedEquations,
    estimate::{JointNoise, ParameterEstimate, estimate},
    held_out::{HeldOutEffort, held_out},
    unknowns::{FreeGroup, FreeUnknowns, JointUnknown, PayloadPlace, UnknownOrder},
};

/// The parameters that a recording identifies.
#[derive(Debug, Clone)]
pub struct IdentifiedParameters {
    /// One for each driven joint.
    pub joints: Vec<IdentifiedJoint>,
    /// The payload, in its frame.
    pub payload: Option<IdentifiedBody>,
    /// The bodies, if their parameters were free, in the frames of the links of their joints.
    pub bodies: Vec<IdentifiedBody>,
    /// Terms that were kept as the description has them, since others have the same effect.
    pub indistinct: Vec<IndistinctTerm>,
    /// Combinations of the free inertial parameters that the recording says more of than was known before, and how many there are.
    pub known_combinations: [usize; 2],
    /// By how much efforts are recorded later than positions, s, with its standard error; `None` if it does not show.
    pub delay_s: Option<(f64, f64)>,
    /// Whether the parameters are better on data that they were not estimated from.
    pub is_better: bool,
}

/// A driven joint.
#[derive(Debug, Clone)]
pub struct IdentifiedJoint {
    /// The joint, among the moving ones.
    pub joint: usize,
    /// Its terms that were estimated.
    pub terms: Vec<(JointUnknown, IdentifiedValue)>,
    /// The residual of its effort in data that were left out.
    pub held_out: HeldOutEffort,
    /// The residual in the data that the estimate is from.
    pub noise: JointNoise,
}

/// A value with its uncertainty.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct IdentifiedValue {
    /// As estimated.
    pub value: f64,
    /// Its standard error.
    pub standard_error: f64,
    /// As the description has it.
    pub nominal: f64,
}

/// A body, and the standard errors of what it is written as.
#[derive(Debug, Clone)]
pub struct IdentifiedBody {
    /// The moving joint that carries it.
    pub joint: usize,
    /// As estimated.
    pub inertia: SpatialInertia,
    /// As the description has it.
    pub nominal: SpatialInertia,
    /// Standard error of the mass, kg.
    pub mass_error_kg: f64,
    /// Standard errors of the centre of mass, m.
    pub center_error_m: [f64; 3],
    /// Standard errors of the tensor about the centre of mass, in the order xx, xy, xz, yy, yz, zz, kg m^2.
    pub tensor_error_kg_m2: [f64; 6],
}

/// A term that others have the effect of.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct IndistinctTerm {
    /// The joint, among the moving ones.
    pub joint: usize,
    /// The term, which was kept.
    pub term: JointUnknown,
    /// The terms of the joint whose sum it is; none if it has no effect at all.
    pub from: Vec<JointUnknown>,
}

/// On data that were left out, the residual has to be smaller by this part at least. No unit; kind: choice.
const BETTER: f64 = 0.02;
/// And it may be larger for no joint by more than this part: a joint that the description explains already is predicted a little worse
/// by estimates. No unit; kind: choice.
const WORSE: f64 = 0.1;

/// The free parameters of a robot from the equations of a recording, whose efforts are torques. `None` if it has no rows, or does not
/// determine them at all.
pub fn identify(equations: &RecordedEquations, free: &FreeUnknowns) -> Option<IdentifiedParameters> {
    let found = estimate(equations, free, |_| true)?;
    let left_out = held_out(equations, free);
    let joints = equations.joints.iter().enumerate().map(|(row, joint)| IdentifiedJoint {
        joint: joint.joint,
        terms: terms(equations, &found, row),
        held_out: left_out[row],
        noise: found.noise[row],
    });
    let layout = &equations.layout;
    let place =
        |joint: usize| PayloadPlace { joint, link_from_payload: congruent_kinematics::Pose::identity() };
    let bodies = if free.has_group(FreeGroup::Links) { 0..layout.bodies } else { 0..0 };
    Some(IdentifiedParameters {
        joints: joints.collect(),
        payload: free.payload_alone().and_then(|place| body(equations, &found, &place, BodyOrigin::Added)),
        bodies: bodies
            .filter_map(|joint| body(equations, &found, &place(joint), BodyOrigin::Described))
            .collect(),
        indistinct: indistinct(equations, &found),
        known_combinations: found.known_combinations,
        delay_s: found.standard_error(layout.delay()).map(|error| (found.x[layout.delay()], error)),
        is_better: is_better(&left_out, &found.noise),
    })
}

/// Whether the whole is better by a little at least, and no joint much worse.
fn is_better(left_out: &[HeldOutEffort], noise: &[JointNoise]) -> bool {
    let used = || left_out.iter().zip(noise).filter(|(of, _)| of.rows > 0);
    let sum = |left: fn(&HeldOutEffort) -> f64| {
        used().map(|(of, noise)| (left(of) / noise.rms).powi(2)).sum::<f64>()
    };
    let is_worse =
        |(of, noise): (&HeldOutEffort, &JointNoise)| of.after > of.before.max(noise.rms) * (1.0 + WORSE);
    sum(|of| of.after) < sum(|of| of.before) * (1.0 - BETTER) && !used().any(is_worse)
}

fn terms(
    equations: &RecordedEquations,
    found: &ParameterEstimate,
    row: usize,
) -> Vec<(JointUnknown, IdentifiedValue)> {
    let value = |term: JointUnknown| {
        let unknown = equations.layout.term(row, term);
        // An error of the torque constant is one of all that follows from it.
        let by_factor = found.x[unknown] * equations.factor_errors[row];
        let standard_error = libm::hypot(found.standard_error(unknown)?, by_factor);
        let value =
            IdentifiedValue { value: found.x[unknown], standard_error, nominal: equations.nominal[unknown] };
        Some((term, value))
    };
    JointUnknown::ALL.into_iter().filter_map(value).collect()
}

fn indistinct(equations: &RecordedEquations, found: &ParameterEstimate) -> Vec<IndistinctTerm> {
    let layout = &equations.layout;
    let of = |unknown: usize| {
        let at = unknown - PARAMETERS * layout.bodies;
        (at / JointUnknown::ALL.len(), JointUnknown::ALL[at % JointUnknown::ALL.len()])
    };
    let each = found.held.iter().map(|(unknown, others)| {
        let (row, term) = of(*unknown);
        let from = others.iter().map(|other| of(*other).1).collect();
        IndistinctTerm { joint: layout.joints[row], term, from }
    });
    each.collect()
}

/// Where a body comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum BodyOrigin {
    /// The description has it.
    Described,
    /// It is a payload.
    Added,
}

/// A body as estimated, in the frame of its place; a payload is what is added to the description.
fn body(
    equations: &RecordedEquations,
    found: &ParameterEstimate,
    place: &PayloadPlace,
    origin: BodyOrigin,
) -> Option<IdentifiedBody> {
    let range = UnknownOrder::body(place.joint);
    let covariance = found.covariance_of(range.start)?;
    let of = |x: &DVector<f64>| -> [f64; PARAMETERS] { std::array::from_fn(|at| x[range.start + at]) };
    let nominal = of(&equations.nominal);
    let mut estimated = of(&found.x);
    if origin == BodyOrigin::Added {
        estimated.iter_mut().zip(nominal).for_each(|(estimated, nominal)| *estimated -= nominal);
    }
    let payload_from_link = place.link_from_payload.inverse();
    let in_place = |parameters: [f64; PARAMETERS]| {
        SpatialInertia::from_parameters(parameters).transformed_by(&payload_from_link)
    };
    // By differences: mass, centre and tensor about it are no linear functions of the parameters.
    let written = |parameters: [f64; PARAMETERS]| as_written(&in_place(parameters));
    let about = written(estimated)?;
    let mut derivatives = DMatrix::zeros(about.len(), PARAMETERS);
    for at in 0..PARAMETERS {
        let mut changed = estimated;
        let step = STEP * (covariance[(at, at)].sqrt()).min(estimated[PARAMETERS - 1].abs().max(STEP));
        changed[at] += step;
        let column = (written(changed)? - &about) / step;
        derivatives.set_column(at, &column);
    }
    let spread = &derivatives * covariance * derivatives.transpose();
    let error = |at: usize| spread[(at, at)].max(0.0).sqrt();
    Some(IdentifiedBody {
        joint: place.joint,
        inertia: in_place(estimated),
        nominal: if origin == BodyOrigin::Added { SpatialInertia::zero() } else { in_place(nominal) },
        mass_error_kg: error(0),
        center_error_m: std::array::from_fn(|at| error(1 + at)),
        tensor_error_kg_m2: std::array::from_fn(|at| error(4 + at)),
    })
}

/// Step of the differences, as part of the standard error. No unit; kind: choice.
const STEP: f64 = 1e-5;

/// Mass, centre of mass and tensor about it; `None` without mass.
fn as_written(inertia: &SpatialInertia) -> Option<DVector<f64>> {
    if inertia.mass_kg <= 0.0 {
        return None;
    }
    let center: Vector3<f64> = inertia.first_moment_kg_m / inertia.mass_kg;
    let tensor = inertia.tensor_kg_m2 - SpatialInertia::point_mass(inertia.mass_kg, center).tensor_kg_m2;
    let parts = [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)];
    let values = std::iter::once(inertia.mass_kg).chain(center.iter().copied());
    Some(DVector::from_iterator(10, values.chain(parts.map(|part| tensor[part]))))
}
