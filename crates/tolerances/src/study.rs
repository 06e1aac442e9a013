//! The study behind `congruent tolerances`: distribution and worst case of the error, and what to tighten.

use congruent_description::{
    ArmQ, Joint, JointValues, RequestedTolerance, RobotDescription, RobotQ, RobotQList,
};
use congruent_input::{Diagnostic, Finding};
use congruent_kinematics::{Arm, ArmJoint, Twist, Uniform, maximize, range};

use crate::{
    error_chain::ErrorMotions,
    farthest_sum::CoveringDirections,
    first_order::{ErrorCovariances, ScaledColumns},
    monte_carlo::{Draws, monte_carlo},
    norm_quantile::{NormDistribution, PrincipalVariances},
    parameters::{ToleratedChain, refused},
    ranking::tightening_order,
    report::{
        ChosenBy, ConfigurationError, ConfigurationsOfStudy, ErrorLevels, Requirement, ToleranceReport,
        ToleranceSource, WorstCase, WorstConfiguration, largest_p997,
    },
    worst_case::{AttainedError, CertifiedError, WorstErrors, certified_at, certified_over},
};

/// From how many of the worst configurations a local search starts: the worst of all may be on a side peak.
const SEARCHES: usize = 4;

/// What is studied.
#[derive(Debug, Clone)]
pub struct StudyOptions {
    /// Where the tolerances are from.
    pub source: ToleranceSource,
    /// The configurations; random ones within the joint ranges if there are none.
    pub given: Option<RobotQList>,
    /// Number of random configurations.
    pub random: usize,
    /// Number of draws.
    pub samples: usize,
    /// Seed of the draws and the random configurations.
    pub seed: u64,
    /// The error that is allowed.
    pub required: RequestedTolerance,
}

/// The configurations of a study, and how they are moved.
struct StudiedArm<'a> {
    description: &'a RobotDescription,
    tolerated: &'a ToleratedChain,
    arm: Arm,
    configurations: RobotQList,
    is_random: bool,
}

/// Distribution and worst case of the error at the tool.
///
/// # Errors
/// No joint moves between base and tip, or there are too many for a search.
/// # Examples
/// A planar arm of 0.6 m and 0.4 m whose first joint may be off by 1 mrad: stretched, the tool is off by 1 mm at most.
/// ```
/// use congruent_description::{DeclaredTolerances, JointTolerances, ParameterTolerances, RequestedTolerance, load_robot};
/// use congruent_tolerances::{StudyOptions, ToleranceSource, declared, tolerance_study};
/// let robot = load_robot(concat!(env!("CARGO_MANIFEST_DIR"), "/../../robots/planar_2r").as_ref())?;
/// let zero = ParameterTolerances { zero_rad: Some(1e-3), ..ParameterTolerances::default() };
/// let rows = vec![JointTolerances { joint: "joint_1".into(), tolerances: zero }];
/// let tolerances = DeclaredTolerances { rows, ..DeclaredTolerances::default() };
/// let options = StudyOptions {
///     source: ToleranceSource::Options,
///     given: None,
///     random: 100,
///     samples: 1000,
///     seed: 0,
///     required: RequestedTolerance::default(),
/// };
/// let report = tolerance_study(&robot, &declared(&robot, &tolerances)?, &options)?;
/// let reach_m = report.worst_case.attained_m / 1e-3;
/// assert!((reach_m - 1.0).abs() < 1e-6, "{reach_m}");
/// assert!(report.worst_case.certified_m >= report.worst_case.attained_m);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn tolerance_study(
    description: &RobotDescription,
    tolerated: &ToleratedChain,
    options: &StudyOptions,
) -> Result<ToleranceReport, Diagnostic> {
    let arm = Arm::from_description(description).map_err(|error| refused(&error))?;
    arm.check_search().map_err(|error| refused(&error))?;
    let studied = StudiedArm {
        configurations: options
            .given
            .clone()
            .unwrap_or_else(|| random_configurations(description, &arm, options.random, options.seed)),
        is_random: options.given.is_none(),
        description,
        tolerated,
        arm,
    };
    let norm = NormDistribution::new();
    let columns = ScaledColumns::new(tolerated, &studied.configurations);
    let draws = Draws { samples: options.samples, seed: options.seed };
    let overall = levels_over(tolerated, &columns, &studied.configurations, &norm, draws);
    let [q, q_orientation] = [0, 1].map(|part| studied.worst_configuration(part, &norm));
    let worst = studied.worst_at(&q, &norm, draws);
    let worst_orientation =
        if q_orientation == q { worst.clone() } else { studied.worst_at(&q_orientation, &norm, draws) };
    let directions = CoveringDirections::new();
    let (worst_case, errors) = studied.worst_case(&directions);
    let at = studied.at_each(&columns, &norm, &directions);
    let worst_case = worst_case.or_largest_of(&at);
    // Normal errors are drawn beyond the tolerances, too.
    let is_within = tolerated.spread.sigmas().is_none();
    let worst_case = if is_within { worst_case.or_drawn([&worst, &worst_orientation]) } else { worst_case };
    let order = tightening_order(tolerated, &columns, &norm, &errors, overall.first_order.p95_m);
    let RequestedTolerance { position_m, orientation_rad } = options.required;
    let is_required = position_m.is_some() || orientation_rad.is_some();
    let found = largest_p997([&overall, &worst.levels, &worst_orientation.levels]);
    let requirement =
        is_required.then(|| Requirement::judge(position_m, orientation_rad, found, &worst_case));
    let chosen = if studied.is_random { ChosenBy::Random } else { ChosenBy::Given };
    Ok(ToleranceReport {
        robot: description.name.clone(),
        chain: description.reported_chain(),
        source: options.source,
        sigmas: tolerated.spread.sigmas(),
        configurations: ConfigurationsOfStudy { chosen, count: studied.configurations.len() },
        seed: options.seed,
        overall,
        worst,
        worst_orientation,
        worst_case,
        parameters: order.parameters,
        halvings: order.halvings,
        at,
        requirement,
        warnings: description.warnings.iter().chain(&tolerated.warnings).map(Finding::from).collect(),
    })
}

/// Random configurations of the chain; all other joints are at 0.
pub(crate) fn random_configurations(
    description: &RobotDescription,
    arm: &Arm,
    count: usize,
    seed: u64,
) -> RobotQList {
    let mut random = Uniform::seeded(seed);
    let mut list = RobotQList::new(description.robot.dof());
    for _ in 0..count {
        let draw = |joint: &ArmJoint| {
            let (lower, upper) = joint.sampled_range();
            random.between(lower, upper)
        };
        let q: ArmQ = arm.joints().iter().map(draw).collect();
        list.push(&robot_q(description, arm, &q));
    }
    list
}

fn robot_q(description: &RobotDescription, arm: &Arm, q: &ArmQ) -> RobotQ {
    let mut q_robot = RobotQ::zeros(description.robot.dof());
    arm.write_to_robot(q, &mut q_robot);
    description.robot.apply_mimic(&mut q_robot);
    q_robot
}

/// Errors over configurations by both methods.
fn levels_over(
    tolerated: &ToleratedChain,
    columns: &ScaledColumns,
    configurations: &RobotQList,
    norm: &NormDistribution,
    draws: Draws,
) -> ErrorLevels {
    let first_order = columns.errors(tolerated, norm);
    let monte_carlo = monte_carlo(&tolerated.chain, &tolerated.spread, configurations, draws);
    let apart = (monte_carlo.rms_m - first_order.rms_m).abs();
    let standard_errors_apart = match monte_carlo.rms_standard_error_m {
        error if error > 0.0 => apart / error,
        _ => 0.0,
    };
    ErrorLevels { first_order, monte_carlo, standard_errors_apart }
}

impl StudiedArm<'_> {
    fn joint_values(&self, q: &RobotQ) -> JointValues {
        let named = self
            .arm
            .joints()
            .iter()
            .map(|joint| (self.description.robot.joint(joint.joint).name.clone(), q[joint.coordinate]));
        named.collect()
    }

    /// The configuration of the set with the largest value, or for random ones what a local search finds from the largest few.
    fn largest(&self, mut value: impl FnMut(&RobotQ) -> f64) -> RobotQ {
        let mut ranked: Vec<(f64, RobotQ)> = self.configurations.iter().map(|q| (value(&q), q)).collect();
        ranked.sort_by(|a, b| b.0.total_cmp(&a.0));
        ranked.truncate(if self.is_random { SEARCHES } else { 1 });
        if self.is_random {
            for (found, q) in &mut ranked {
                let mut q_arm = self.arm.from_robot(q);
                let at = |q_arm: &ArmQ| value(&robot_q(self.description, &self.arm, q_arm));
                *found = maximize(self.arm.joints(), &mut q_arm, at);
                *q = robot_q(self.description, &self.arm, &q_arm);
            }
        }
        let best = ranked.into_iter().max_by(|a, b| a.0.total_cmp(&b.0));
        best.map_or_else(|| RobotQ::zeros(self.description.robot.dof()), |(_, q)| q)
    }

    /// Where the 99.7 % quantile of the distance (part 0) or of the angle (part 1) is largest, to first order: the root mean square
    /// of the angle is the same at all configurations if the tolerances of all axes are.
    fn worst_configuration(&self, part: usize, norm: &NormDistribution) -> RobotQ {
        let mut covariances = ErrorCovariances::new(self.tolerated);
        self.largest(|q| norm.quantile(&[PrincipalVariances::new(&covariances.at(q)[part])], 0.997))
    }

    /// The error at a worst configuration.
    fn worst_at(&self, q: &RobotQ, norm: &NormDistribution, draws: Draws) -> WorstConfiguration {
        let alone = RobotQList::from(q);
        let columns = ScaledColumns::new(self.tolerated, &alone);
        // Another seed than over all configurations: the two are then independent.
        let draws = Draws { seed: draws.seed.wrapping_add(1), ..draws };
        let levels = levels_over(self.tolerated, &columns, &alone, norm, draws);
        WorstConfiguration { levels, at: self.joint_values(q) }
    }

    /// The worst case over the joint range, and the error of each parameter in it.
    fn worst_case(&self, directions: &CoveringDirections) -> (WorstCase, Vec<f64>) {
        let tolerances = &self.tolerated.spread.tolerances;
        let mut search = WorstErrors::new(&self.tolerated.chain, tolerances);
        let q = self.largest(|q| search.at(q).position_m);
        let AttainedError { errors, position_m: attained_m, .. } = search.at(&q);
        let turned = self.largest(|q| search.at(q).orientation_rad);
        let attained_rad = search.at(&turned).orientation_rad;
        let CertifiedError { position_m: certified_m, orientation_rad: certified_rad } =
            certified_over(&self.tolerated.chain, &self.ranges(), tolerances, directions);
        let at = self.joint_values(&q);
        (WorstCase { attained_m, certified_m, attained_rad, certified_rad, at }, errors)
    }

    /// The errors at each of the given configurations; none of random ones.
    fn at_each(
        &self,
        columns: &ScaledColumns,
        norm: &NormDistribution,
        directions: &CoveringDirections,
    ) -> Vec<ConfigurationError> {
        if self.is_random {
            return Vec::new();
        }
        let mut motions = ErrorMotions::default();
        let at = |(q, columns): (RobotQ, &Vec<Twist>)| {
            self.tolerated.chain.motions_into(&q, &mut motions);
            let certified = certified_at(&motions, &self.tolerated.spread.tolerances, directions);
            let here = ScaledColumns { at: vec![columns.clone()] };
            ConfigurationError {
                first_order: here.errors(self.tolerated, norm),
                certified_m: certified.position_m,
                certified_rad: certified.orientation_rad,
            }
        };
        self.configurations.iter().zip(&columns.at).map(at).collect()
    }

    /// The range of each joint of the chain; that of a joint that follows another one is that of its master.
    fn ranges(&self) -> Vec<(f64, f64)> {
        let robot = &self.description.robot;
        let of_joint = |joint: &Joint| match joint.mimic {
            None => range(joint),
            Some(mimic) => {
                let (lower, upper) = range(robot.joint(mimic.master));
                let ends = [lower, upper].map(|end| mimic.multiplier * end + mimic.offset);
                (ends[0].min(ends[1]), ends[0].max(ends[1]))
            }
        };
        let coordinates = self.tolerated.chain.coordinates.iter();
        coordinates.map(|&at| of_joint(robot.joint(robot.movable_joints()[at]))).collect()
    }
}
