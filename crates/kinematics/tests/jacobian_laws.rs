//! Laws of Jacobians: they are what moving one joint does, one kind follows from another, and every
//! form of a chain has the same.

#[path = "support/mod.rs"]
mod support;

use congruent_description::{ChainQ, LinkIndex, Robot, RobotQ};
use congruent_kinematics::{
    Jacobian, JacobianKind, KinematicsError, Pose, ScrewChain, SerialChain, Twist, UrdfTree, Wrench,
};
use proptest::prelude::*;
use support::within;

/// Rounding over up to eight joints within 10 m, by two paths; worst seen 4.4e-15.
const ROUNDING: f64 = 1e-13;
/// The same where screws were identified from poses: each has the rounding of a few poses, and turns all links behind it; worst seen
/// 1.1e-13.
const IDENTIFIED: f64 = 1e-12;
/// Central difference, h = 2^-10 and Richardson's fourth order: h^4/30 on 10 m is 3e-13, rounding
/// 10 eps/h is 2e-12; worst seen 2.6e-12.
const DIFFERENCE: f64 = 1e-11;

fn apart(a: &Twist, b: &Twist) -> f64 {
    (a.angular - b.angular).norm().max((a.linear - b.linear).norm())
}

/// The space twist of one unit of a coordinate, by differences of poses alone.
fn by_differences(pose_at: impl Fn(f64) -> Pose) -> Twist {
    const STEP: f64 = 1.0 / 1024.0;
    let here = pose_at(0.0).inverse();
    let slope = |step: f64| {
        let (ahead, behind) = (Twist::log(&(pose_at(step) * here)), Twist::log(&(pose_at(-step) * here)));
        Twist {
            angular: (ahead.angular - behind.angular) / (2.0 * step),
            linear: (ahead.linear - behind.linear) / (2.0 * step),
        }
    };
    let (fine, coarse) = (slope(STEP), slope(2.0 * STEP));
    Twist {
        angular: (fine.angular * 4.0 - coarse.angular) / 3.0,
        linear: (fine.linear * 4.0 - coarse.linear) / 3.0,
    }
}

fn space_from(kind: JacobianKind, column: &Twist, root_from_link: &Pose) -> Twist {
    match kind {
        JacobianKind::Space => *column,
        JacobianKind::Body => column.transformed_by(root_from_link),
        JacobianKind::Geometric => Twist {
            angular: column.angular,
            linear: column.linear + root_from_link.translation.cross(&column.angular),
        },
    }
}

const KINDS: [JacobianKind; 3] = [JacobianKind::Space, JacobianKind::Body, JacobianKind::Geometric];

fn links(robot: &Robot) -> Vec<LinkIndex> {
    robot.link_indices().collect()
}

proptest! {
    #![proptest_config(support::cases())]

    #[test]
    fn a_column_is_what_its_joint_does(joints in support::tree(), q in support::positions()) {
        let robot = support::robot(joints);
        let (tree, q) = (UrdfTree::new(&robot), &q.of_robot(&robot));
        for link in robot.link_indices() {
            let root_from_link = tree.root_from_link(q, link).unwrap();
            for kind in KINDS {
                let jacobian = tree.jacobian(q, link, kind).unwrap();
                for (coordinate, column) in jacobian.columns().iter().enumerate() {
                    let expected = by_differences(|step| {
                        let mut q = q.clone();
                        q[coordinate] += step;
                        tree.root_from_link(&q, link).unwrap()
                    });
                    let found = space_from(kind, column, &root_from_link);
                    prop_assert!(within(apart(&found, &expected), DIFFERENCE), "{kind:?}: {found:?} {expected:?}");
                }
            }
        }
    }

    /// The same wrench on the link, in the frame of each kind, takes the same efforts.
    #[test]
    fn efforts_do_not_depend_on_the_frame(
        joints in support::tree(), q in support::positions(), [moment, force] in [support::vector(), support::vector()],
    ) {
        let robot = support::robot(joints);
        let (tree, q, in_link) = (UrdfTree::new(&robot), &q.of_robot(&robot), Wrench { moment, force });
        for link in robot.link_indices() {
            let root_from_link = tree.root_from_link(q, link).unwrap();
            let turned = Pose { translation: nalgebra::Vector3::zeros(), ..root_from_link };
            let efforts = |kind, wrench: Wrench| tree.jacobian(q, link, kind).unwrap().efforts(&wrench);
            let expected = efforts(JacobianKind::Body, in_link);
            for found in [
                efforts(JacobianKind::Space, in_link.transformed_by(&root_from_link)),
                efforts(JacobianKind::Geometric, in_link.transformed_by(&turned)),
            ] {
                for (found, expected) in found.iter().zip(&expected) {
                    prop_assert!(within((found - expected).abs(), ROUNDING));
                }
            }
        }
    }

    #[test]
    fn a_serial_chain_is_its_path_through_the_tree(
        joints in support::tree(), q in support::positions(), ends in any::<[prop::sample::Index; 2]>(),
    ) {
        let robot = support::robot(joints);
        let (tree, q) = (UrdfTree::new(&robot), &q.of_robot(&robot));
        let all = links(&robot);
        let [base, tip] = ends.map(|end| all[end.index(all.len())]);
        let chain = SerialChain::from_urdf(&robot, base, tip);
        let of_chain = q.chain_positions(chain.coordinates());
        let base_from_root = tree.root_from_link(q, base).unwrap().inverse();
        let expected = base_from_root * tree.root_from_link(q, tip).unwrap();
        let found = chain.base_from_tip(&of_chain).unwrap();
        prop_assert!(within(found.distance_m(&expected), ROUNDING));
        prop_assert!(within(found.angle_rad(&expected), ROUNDING));
        for kind in KINDS {
            let mut columns = vec![Twist::zero(); chain.joint_count()];
            let base_from_tip = chain.pose_and_jacobian_into(&of_chain, kind, &mut columns).unwrap();
            prop_assert_eq!(base_from_tip, found);
            for (joint, column) in columns.iter().enumerate() {
                let expected = by_differences(|step| {
                    let mut q = of_chain.clone();
                    q[joint] += step;
                    chain.base_from_tip(&q).unwrap()
                });
                prop_assert!(within(apart(&space_from(kind, column, &found), &expected), DIFFERENCE));
            }
        }
    }

    #[test]
    fn tables_and_screws_give_the_same_serial_chain(figures in support::table_figures(), q in support::positions()) {
        let robot = figures.robot();
        let (q, of_chain) = (&q.of_robot(&robot), &q.of_chain(robot.dof()));
        let tip = robot.find_link("tip").unwrap();
        let by_urdf = SerialChain::from_urdf(&robot, robot.root(), tip);
        let by_table = SerialChain::from_dh(&figures.table(&robot), &robot);
        let screws = ScrewChain::from_urdf(&robot, robot.root(), tip, by_urdf.coordinates()).unwrap();
        let by_screws = SerialChain::from_screws(&screws);
        let tree = UrdfTree::new(&robot).jacobian(q, tip, JacobianKind::Geometric).unwrap();
        for (chain, rounding) in [(by_urdf, ROUNDING), (by_table, ROUNDING), (by_screws, IDENTIFIED)] {
            let mut columns = vec![Twist::zero(); chain.joint_count()];
            chain.pose_and_jacobian_into(of_chain, JacobianKind::Geometric, &mut columns).unwrap();
            for (found, expected) in columns.iter().zip(tree.columns()) {
                prop_assert!(within(apart(found, expected), rounding), "{found:?} {expected:?}");
            }
        }
    }
}

#[test]
fn wrong_lengths_are_refused() {
    let robot = support::robot(Vec::new());
    let tree = UrdfTree::new(&robot);
    let columns = &mut [Twist::zero()];
    let refused = tree.jacobian_into(&RobotQ::zeros(0), robot.root(), JacobianKind::Body, columns);
    assert_eq!(refused, Err(KinematicsError::ColumnCount { expected: 0, found: 1 }));
    let chain = SerialChain::from_urdf(&robot, robot.root(), robot.root());
    let refused = chain.pose_and_jacobian_into(&ChainQ::zeros(1), JacobianKind::Body, columns);
    assert_eq!(refused, Err(KinematicsError::JointCount { expected: 0, found: 1 }));
    let jacobian = Jacobian::from_columns(JacobianKind::Body, columns.to_vec());
    assert_eq!(jacobian.times(&[]), Err(KinematicsError::JointCount { expected: 1, found: 0 }));
}
