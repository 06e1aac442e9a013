//! The reference cases that forward kinematics alone can answer, each under its own number.

#[path = "support/mod.rs"]
mod support;

use congruent_description::{DhConvention, DhRowKind, JointKind, Robot, RobotQ};
use congruent_kinematics::{
    DhChain, DhFrames, JacobianKind, ModifiedDh, Pose, Screw, ScrewTree, StandardDh, ToolAxes, ToolAxesError,
    UrdfTree, hat,
};
use nalgebra::{Isometry3, Matrix3, Point3, Unit, Vector3, Vector6};
use support::{Carried, RowFigures, TableFigures, within};

/// Golden digits: the cases print twelve decimals, so half a unit of the last, and rounding; worst
/// seen 4.7e-13.
const PRINTED: f64 = 5.01e-13;
/// Rounding of up to nine products within 2 m, eps each, once by each path; worst seen 2.8e-15.
const ROUNDING: f64 = 1e-14;

#[track_caller]
fn assert_position(found: &Pose, printed: [f64; 3]) {
    for (at, printed) in printed.into_iter().enumerate() {
        let found = found.translation[at];
        assert!(within((found - printed).abs(), PRINTED), "entry {at}: {found} for {printed}");
    }
}

#[track_caller]
fn assert_rotation(found: &Pose, printed_rows: [f64; 9]) {
    let difference = found.rotation - Matrix3::from_row_slice(&printed_rows);
    assert!(within(difference.amax(), PRINTED), "{}", found.rotation);
}

#[track_caller]
fn assert_equal(found: &Pose, expected: &Pose) {
    assert!(within(found.distance_m(expected), ROUNDING), "{found:?} for {expected:?}");
    assert!(within(found.angle_rad(expected), ROUNDING), "{found:?} for {expected:?}");
}

fn degrees<const N: usize>(positions_deg: [f64; N]) -> RobotQ {
    positions_deg.map(f64::to_radians).into()
}

fn standard(rows: &[RowFigures]) -> (Robot, DhChain) {
    let figures = TableFigures::new(DhConvention::Standard, rows);
    let robot = figures.robot();
    let chain = DhChain::new(&figures.table(&robot), &robot);
    (robot, chain)
}

fn spatial_3r() -> [RowFigures; 3] {
    [
        RowFigures::revolute(0.30, 90.0, 0.20),
        RowFigures::revolute(0.40, 0.0, 0.0),
        RowFigures::revolute(0.20, 0.0, 0.0),
    ]
}

/// Base and tip turned and shifted, an offset and a sign in the rows: nothing commutes, nothing is zero.
fn crooked_6r(convention: DhConvention) -> TableFigures {
    let alphas_deg = [90.0, -20.0, 30.0, -90.0, 75.0, 10.0];
    let row = |(at, alpha_deg): (usize, f64)| {
        let step = 0.05 * f64::from(u8::try_from(at).expect("six rows"));
        let plain = RowFigures::revolute(0.3 - step, alpha_deg, 0.1 + step);
        RowFigures { theta_rad: 0.4 - step, sign: if at % 2 == 0 { 1.0 } else { -1.0 }, ..plain }
    };
    TableFigures {
        base_from_dh0: Isometry3::new(Vector3::new(0.1, -0.2, 0.3), Vector3::new(0.5, 0.2, -0.9)),
        dhn_from_tip: Isometry3::new(Vector3::new(-0.05, 0.02, 0.1), Vector3::new(-0.3, 1.2, 0.4)),
        ..TableFigures::new(convention, &alphas_deg.into_iter().enumerate().map(row).collect::<Vec<_>>())
    }
}

fn crooked_q() -> RobotQ {
    RobotQ::from([0.3, -1.1, 0.7, 2.0, -0.4, 1.6])
}

#[test]
fn case_01_planar_2r() {
    let (_, chain) = standard(&[RowFigures::revolute(0.6, 0.0, 0.0), RowFigures::revolute(0.4, 0.0, 0.0)]);
    let tip = chain.base_from_tip(&degrees([30.0, -45.0])).unwrap();
    // By hand: y = 0.6 sin 30 + 0.4 sin(-15) = 0.3 - 0.4 * 0.258819045103 = 0.196472381959. The list of
    // cases prints 0.196472382459, which is 5e-10 off.
    assert_position(&tip, [0.905_985_572_786, 0.196_472_381_959, 0.0]);
}

#[test]
fn case_02_one_dh_matrix() {
    let [alpha_rad, theta_rad] = [90_f64, 30.0].map(f64::to_radians);
    let row = StandardDh { a_m: 0.25, alpha_rad, d_m: 0.10, theta_rad }.transform();
    assert_rotation(&row, [0.866_025_403_784, 0., 0.5, 0.5, 0., -0.866_025_403_784, 0., 1., 0.]);
    assert_position(&row, [0.216_506_350_946, 0.125, 0.1]);
}

#[test]
fn case_03_spatial_3r() {
    let (_, chain) = standard(&spatial_3r());
    let q = degrees([20.0, -30.0, 40.0]);
    let tip = chain.base_from_tip(&q).unwrap();
    assert_position(&tip, [0.792_510_174_455, 0.288_450_113_855, 0.034_729_635_533]);
    #[rustfmt::skip]
    assert_rotation(&tip, [
        0.925_416_578_398, -0.163_175_911_167, 0.342_020_143_326,
        0.336_824_088_833, -0.059_391_174_614, -0.939_692_620_786,
        0.173_648_177_667, 0.984_807_753_012, 0.0,
    ]);
    assert!(within(tip.orthonormality_error(), ROUNDING));
    assert!(within((tip.determinant() - 1.0).abs(), ROUNDING));
    let tool = Pose::from_parts(Matrix3::identity(), Vector3::new(0.1, 0.0, 0.0));
    let tcp = chain.base_from_tcp(&q, &tool).unwrap();
    assert_position(&tcp, [0.885_051_832_295, 0.322_132_522_738, 0.052_094_453_300]);
}

#[test]
fn case_08_dh_against_poe() {
    let figures_3r = TableFigures::new(DhConvention::Standard, &spatial_3r());
    for (figures, q) in [
        (figures_3r, &degrees([20.0, -30.0, 40.0])),
        (crooked_6r(DhConvention::Standard), &crooked_q()),
        (crooked_6r(DhConvention::Modified), &crooked_q()),
    ] {
        let robot = figures.robot();
        let by_table = DhChain::new(&figures.table(&robot), &robot).base_from_tip(q).unwrap();
        let tip = robot.find_link("tip").unwrap();
        assert_equal(&ScrewTree::new(&robot).root_from_link(q, tip).unwrap(), &by_table);
        assert_equal(&UrdfTree::new(&robot).root_from_link(q, tip).unwrap(), &by_table);
    }
}

#[test]
fn case_09_one_table_under_both_conventions_is_two_robots() {
    /// No rounding: the arm reaches 0.9 m, and the two tips lie 0.4996 m apart.
    const APART_M: f64 = 0.2;
    let q = degrees([20.0, -30.0, 40.0]);
    let tip = |convention| {
        let figures = TableFigures::new(convention, &spatial_3r());
        let robot = figures.robot();
        DhChain::new(&figures.table(&robot), &robot).base_from_tip(&q).unwrap()
    };
    let (standard, modified) = (tip(DhConvention::Standard), tip(DhConvention::Modified));
    let by_rows = |row: &dyn Fn(RowFigures, f64) -> Pose| {
        spatial_3r()
            .into_iter()
            .zip(&q)
            .fold(Pose::identity(), |above, (figures, &q)| above * row(figures, q))
    };
    assert_equal(
        &standard,
        &by_rows(&|RowFigures { a_m, alpha_rad, d_m, .. }, theta_rad| {
            StandardDh { a_m, alpha_rad, d_m, theta_rad }.transform()
        }),
    );
    assert_equal(
        &modified,
        &by_rows(&|RowFigures { a_m, alpha_rad, d_m, .. }, theta_rad| {
            ModifiedDh { a_m, alpha_rad, d_m, theta_rad }.transform()
        }),
    );
    assert!(standard.distance_m(&modified) > APART_M);
}

#[test]
fn case_11_the_tool_is_separate_from_the_chain() {
    let figures = crooked_6r(DhConvention::Standard);
    let robot = figures.robot();
    let chain = DhChain::new(&figures.table(&robot), &robot);
    let tool = Pose::from(Isometry3::new(Vector3::new(0.02, -0.01, 0.15), Vector3::new(0.1, 0.7, -0.2)));
    for q in [RobotQ::zeros(6), crooked_q()] {
        let tip = chain.base_from_tip(&q).unwrap();
        let tcp = chain.base_from_tcp(&q, &tool).unwrap();
        assert_equal(&(tip.inverse() * tcp), &tool);
        assert_eq!(chain.base_from_tcp(&q, &Pose::identity()).unwrap(), tip);
    }
}

#[test]
fn case_12_orthonormality_kept_over_long_products() {
    const PRODUCTS: u32 = 1_000_000;
    /// Drift: a step is off by eps and a product rounds by as much, all to one side at worst, so n times
    /// 4 eps; worst seen 1e-10.
    const DRIFT: f64 = 1e-9;
    /// The same over the thousand products between two corrections; worst seen 1.1e-13.
    const KEPT: f64 = 1e-12;
    let axis = Unit::new_normalize(Vector3::new(0.3, -0.5, 0.8));
    let screw = Screw::revolute(axis, &Point3::new(0.4, 0.1, -0.2));
    let step = screw.exp(0.7);
    let (mut left_alone, mut corrected, mut worst_corrected) = (Pose::identity(), Pose::identity(), 0.0_f64);
    for at in 1..=PRODUCTS {
        (left_alone, corrected) = (left_alone * step, corrected * step);
        worst_corrected = worst_corrected.max(corrected.orthonormality_error());
        if at % 1000 == 0 {
            corrected = corrected.orthonormalized().unwrap();
        }
    }
    assert!(within(left_alone.orthonormality_error(), DRIFT));
    assert!(within((left_alone.determinant() - 1.0).abs(), DRIFT));
    assert!(within(worst_corrected, KEPT));
    // The correction takes the drift out and does not move the pose.
    let at_last = left_alone.orthonormalized().unwrap();
    assert!(within(at_last.orthonormality_error(), ROUNDING));
    assert!(left_alone.orthonormality_error() > 100.0 * at_last.orthonormality_error());
    for pose in [left_alone, at_last, corrected] {
        let expected = screw.exp(0.7 * f64::from(PRODUCTS));
        assert!(within(pose.distance_m(&expected), DRIFT));
        assert!(within(pose.angle_rad(&expected), DRIFT));
    }
}

#[test]
fn case_14_elementary_transforms() {
    let (along_y, along_x, turn) =
        (Pose::shift_y(1.0), Pose::shift_x(3.0), Pose::turn_z(90_f64.to_radians()));
    let composed = along_y * along_x * turn;
    assert_rotation(&composed, [0., -1., 0., 1., 0., 0., 0., 0., 1.]);
    assert_position(&composed, [3.0, 1.0, 0.0]);
    let inverse = composed.inverse();
    assert_rotation(&inverse, [0., 1., 0., -1., 0., 0., 0., 0., 1.]);
    assert_position(&inverse, [-1.0, 3.0, 0.0]);
    assert_equal(&(composed * inverse), &Pose::identity());
    // About the current frame on the right, about the fixed frame on the left.
    assert_position(&(turn * along_x), [0.0, 3.0, 0.0]);
    assert_position(&(along_x * turn), [3.0, 0.0, 0.0]);
    let about_current_x = turn * Pose::turn_x(90_f64.to_radians());
    assert_rotation(&about_current_x, [0., 0., 1., 1., 0., 0., 0., 1., 0.]);
    let about_fixed_x = Pose::turn_x(90_f64.to_radians()) * turn;
    assert_rotation(&about_fixed_x, [0., -1., 0., 0., 0., -1., 1., 0., 0.]);
    let point = composed * Point3::new(1.0, 0.0, 0.0);
    assert!(within((point - Point3::new(3.0, 2.0, 0.0)).norm(), ROUNDING));
}

#[test]
fn case_16_between_any_two_frames() {
    for convention in [DhConvention::Standard, DhConvention::Modified] {
        let figures = crooked_6r(convention);
        let robot = figures.robot();
        let chain = DhChain::new(&figures.table(&robot), &robot);
        let mut frames = [Pose::identity(); 7];
        chain.dh_frames_into(&crooked_q(), &mut frames).unwrap();
        for (transformed_by, of) in (0..7).flat_map(|i| (0..7).map(move |j| (i, j))) {
            let between = chain.dhi_from_dhj(&crooked_q(), DhFrames { transformed_by, of }).unwrap();
            assert_equal(&between, &(frames[transformed_by].inverse() * frames[of]));
            if transformed_by == of {
                assert_eq!(between, Pose::identity());
            }
        }
    }
}

/// The hand of case 3 by the columns of its printed rotation.
#[test]
fn case_19_tool_frame_by_normal_sliding_approach() {
    /// Golden digits of two printed axes in one product; worst seen 7e-13.
    const TWO_PRINTED: f64 = 2.0 * PRINTED;
    let axes = ToolAxes {
        normal: Vector3::new(0.925_416_578_398, 0.336_824_088_833, 0.173_648_177_667),
        sliding: Vector3::new(-0.163_175_911_167, -0.059_391_174_614, 0.984_807_753_012),
        approach: Vector3::new(0.342_020_143_326, -0.939_692_620_786, 0.0),
    };
    let origin = Point3::new(0.792_510_174_455, 0.288_450_113_855, 0.034_729_635_533);
    let (_, chain) = standard(&spatial_3r());
    let by_table = chain.base_from_tip(&degrees([20.0, -30.0, 40.0])).unwrap();
    let by_axes = axes.base_from_tool(&origin).unwrap();
    assert_rotation(&by_axes, by_table.rotation.transpose().as_slice().try_into().unwrap());
    assert_position(&by_table, by_axes.translation.into());
    // Approach and sliding alone, of any length: n = s x a.
    let by_two = ToolAxes::from_approach_and_sliding(axes.approach * 3.0, axes.sliding * 0.02).unwrap();
    assert!(within((by_two.normal - axes.normal).amax(), TWO_PRINTED));
    // A mirror image, and a sliding axis that leans by one degree.
    let mirrored = ToolAxes { normal: axes.sliding, sliding: axes.normal, ..axes };
    let Err(ToolAxesError::LeftHanded { triple_product }) = mirrored.base_from_tool(&origin) else {
        panic!("a mirror image is no frame")
    };
    assert!(within((triple_product + 1.0).abs(), TWO_PRINTED));
    let one_degree = 1_f64.to_radians();
    let leaning = axes.sliding * one_degree.cos() + axes.normal * one_degree.sin();
    let Err(ToolAxesError::NotPerpendicular { first: "normal", second: "sliding", off_rad }) =
        (ToolAxes { sliding: leaning, ..axes }).base_from_tool(&origin)
    else {
        panic!("leaning axes are no frame")
    };
    assert!(within((off_rad - one_degree).abs(), TWO_PRINTED));
}

#[test]
fn case_20_cylindrical_arm() {
    let first = RowFigures::revolute(0.0, 0.0, 0.5);
    let (_, chain) = standard(&[first, RowFigures::prismatic(-90.0), RowFigures::prismatic(0.0)]);
    let tip = chain.base_from_tip(&RobotQ::from([30_f64.to_radians(), 0.2, 0.3])).unwrap();
    assert_position(&tip, [-0.15, 0.259_807_621_135, 0.7]);
}

#[test]
fn case_20_spherical_wrist() {
    let d6 = RowFigures::revolute(0.0, 0.0, 0.1);
    let (_, chain) =
        standard(&[RowFigures::revolute(0.0, -90.0, 0.0), RowFigures::revolute(0.0, 90.0, 0.0), d6]);
    let tip = chain.base_from_tip(&degrees([10.0, 20.0, 30.0])).unwrap();
    assert_position(&tip, [0.033_682_408_883, 0.005_939_117_461, 0.093_969_262_079]);
    #[rustfmt::skip]
    assert_rotation(&tip, [
        0.714_610_177_143, -0.613_092_022_380, 0.336_824_088_833,
        0.633_718_360_862, 0.771_280_576_369, 0.059_391_174_614,
        -0.296_198_132_726, 0.171_010_071_663, 0.939_692_620_786,
    ]);
}

#[test]
fn a_prismatic_row_ignores_what_it_does_not_drive() {
    let prismatic = RowFigures { theta_rad: 0.3, ..RowFigures::prismatic(20.0) };
    let turned = RowFigures { kind: DhRowKind::Revolute, ..prismatic };
    let tip = |row, q: f64| standard(&[row]).1.base_from_tip(&RobotQ::from([q])).unwrap();
    assert_eq!(tip(prismatic, 0.0), tip(turned, 0.0));
}

#[test]
fn case_22_joints_go_by_name_not_by_order() {
    let finger = |name: &str, x| Carried {
        kind: JointKind::Continuous,
        ..Carried::fixed(name, "base", Isometry3::translation(x, 0.2, 0.0))
    };
    let (left, right) = (finger("left", 0.1), finger("right", -0.3));
    // Two libraries list the same joints in different orders.
    let robots = [support::robot(vec![left.clone(), right.clone()]), support::robot(vec![right, left])];
    let pose = |robot: &Robot, link: &str| {
        let mut q = RobotQ::zeros(robot.dof());
        for (name, position) in [("left", 0.7), ("right", -1.1)] {
            q[robot.coordinate(robot.find_joint(name).unwrap()).unwrap()] = position;
        }
        UrdfTree::new(robot).root_from_link(&q, robot.find_link(link).unwrap()).unwrap()
    };
    for link in ["left", "right"] {
        assert_equal(&pose(&robots[0], link), &pose(&robots[1], link));
    }
    // By order the same vector is another configuration.
    let by_order = robots.map(|robot| {
        let left = robot.find_link("left").unwrap();
        UrdfTree::new(&robot).root_from_link(&RobotQ::from([0.7, -1.1]), left).unwrap()
    });
    assert!(within((by_order[0].angle_rad(&by_order[1]) - 1.8).abs(), ROUNDING));
}

/// A link that turns about the vertical axis through (L, L, 0), and the point P on it, d away.
fn turning_link() -> Robot {
    let (length_m, point_m) = (1.0, 0.4);
    let pivot = Carried::fixed("link", "base", Isometry3::translation(length_m, length_m, 0.0));
    support::robot(vec![
        Carried { kind: JointKind::Continuous, axis_in_joint: Vector3::z_axis(), ..pivot },
        Carried::fixed("p", "link", Isometry3::translation(point_m, 0.0, 0.0)),
    ])
}

#[test]
fn case_25_position_and_velocity_of_a_point() {
    let robot = turning_link();
    let (q, qd, p) = (degrees([30.0]), [1.0], robot.find_link("p").unwrap());
    let (tree, screws) = (UrdfTree::new(&robot), ScrewTree::new(&robot));
    for pose in [tree.root_from_link(&q, p).unwrap(), screws.root_from_link(&q, p).unwrap()] {
        assert_position(&pose, [1.346_410_161_514, 1.2, 0.0]);
    }
    let twist = tree.jacobian(&q, p, JacobianKind::Geometric).unwrap().times(&qd).unwrap();
    let printed = Vector3::new(-0.2, 0.346_410_161_514, 0.0);
    assert!(within((twist.linear - printed).amax(), PRINTED), "{}", twist.linear);
    assert_eq!(twist.angular, Vector3::z());
}

#[test]
fn case_26_body_twist_and_space_twist() {
    let robot = turning_link();
    let link = robot.find_link("link").unwrap();
    let (tree, q, qd) = (UrdfTree::new(&robot), degrees([30.0]), [1.0]);
    let twist = |kind| tree.jacobian(&q, link, kind).unwrap().times(&qd).unwrap();
    let (in_body, in_space) = (twist(JacobianKind::Body), twist(JacobianKind::Space));
    let printed = |six: [f64; 6]| Vector6::from(six);
    assert!(within((Vector6::from(in_body) - printed([0., 0., 1., 0., 0., 0.])).amax(), ROUNDING));
    assert!(within((Vector6::from(in_space) - printed([0., 0., 1., 1., -1., 0.])).amax(), ROUNDING));
    let space_from_body = tree.root_from_link(&q, link).unwrap();
    let adjoint = space_from_body.adjoint();
    assert!(within((adjoint * Vector6::from(in_body) - Vector6::from(in_space)).amax(), ROUNDING));
    // [p] R is below: angular first, the linear velocity takes from the turn and not the reverse.
    let p = space_from_body.translation;
    assert_eq!(adjoint.fixed_view::<3, 3>(3, 0), hat(&p) * space_from_body.rotation);
    assert_eq!(adjoint.fixed_view::<3, 3>(0, 3), Matrix3::zeros());
    assert!(within((in_space.linear + in_space.angular.cross(&p)).norm(), ROUNDING)); // v_s = -w x p
}
