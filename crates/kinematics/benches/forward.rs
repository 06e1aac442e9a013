//! What one forward kinematics and its derivatives cost, on an arm of six joints with the lengths of a `UR5e`.

#[path = "../tests/support/mod.rs"]
mod support;

use congruent_description::{ChainQ, DhConvention, LinkIndex, Robot, RobotQ};
use congruent_kinematics::{
    DhChain, DhDerivatives, JacobianKind, Pose, ScrewChain, ScrewDerivatives, ScrewTree, SerialChain, Twist,
    UrdfTree,
};
use divan::{Bencher, black_box};
use support::{TableFigures, ur5e_table};

const Q: [f64; 6] = [0.4, -1.2, 1.7, -0.6, 1.1, 0.3];

fn main() {
    divan::main();
}

fn arm(convention: DhConvention) -> (Robot, DhChain) {
    let figures = TableFigures { convention, ..ur5e_table() };
    let robot = figures.robot();
    let chain = DhChain::new(&figures.table(&robot), &robot);
    (robot, chain)
}

fn tip(robot: &Robot) -> LinkIndex {
    robot.find_link("tip").expect("the arm has a tip")
}

/// Six sines with their cosines by the platform, as the screws take them.
#[divan::bench]
fn six_sine_cosine_pairs(bencher: Bencher<'_, '_>) {
    bencher.bench(|| black_box(Q).map(f64::sin_cos));
}

#[divan::bench(args = [DhConvention::Standard, DhConvention::Modified])]
fn dh_to_tip(bencher: Bencher<'_, '_>, convention: DhConvention) {
    let q = RobotQ::from(Q);
    let (_, chain) = arm(convention);
    bencher.bench(|| chain.base_from_tip(black_box(&q)));
}

#[divan::bench(args = [DhConvention::Standard, DhConvention::Modified])]
fn dh_all_frames(bencher: Bencher<'_, '_>, convention: DhConvention) {
    let q = RobotQ::from(Q);
    let (_, chain) = arm(convention);
    let mut frames = [Pose::identity(); 7];
    bencher.bench_local(|| chain.dh_frames_into(black_box(&q), black_box(&mut frames)));
}

#[divan::bench]
fn urdf_to_tip(bencher: Bencher<'_, '_>) {
    let q = RobotQ::from(Q);
    let (robot, _) = arm(DhConvention::Standard);
    let (tree, tip) = (UrdfTree::new(&robot), tip(&robot));
    bencher.bench(|| tree.root_from_link(black_box(&q), tip));
}

#[divan::bench]
fn urdf_all_links(bencher: Bencher<'_, '_>) {
    let q = RobotQ::from(Q);
    let (robot, _) = arm(DhConvention::Standard);
    let tree = UrdfTree::new(&robot);
    let mut links = vec![Pose::identity(); robot.links().len()];
    bencher.bench_local(|| tree.root_from_links_into(black_box(&q), black_box(&mut links)));
}

#[divan::bench]
fn poe_to_tip(bencher: Bencher<'_, '_>) {
    let q = RobotQ::from(Q);
    let (robot, _) = arm(DhConvention::Standard);
    let (screws, tip) = (ScrewTree::new(&robot), tip(&robot));
    bencher.bench(|| screws.root_from_link(black_box(&q), tip));
}

#[divan::bench]
fn poe_all_links(bencher: Bencher<'_, '_>) {
    let q = RobotQ::from(Q);
    let (robot, _) = arm(DhConvention::Standard);
    let screws = ScrewTree::new(&robot);
    let mut links = vec![Pose::identity(); robot.links().len()];
    bencher.bench_local(|| screws.root_from_links_into(black_box(&q), black_box(&mut links)));
}

/// The chain through the description, as `urdf_to_tip` takes it.
fn serial() -> SerialChain {
    let (robot, _) = arm(DhConvention::Standard);
    SerialChain::from_urdf(&robot, robot.root(), tip(&robot))
}

#[divan::bench]
fn serial_to_tip(bencher: Bencher<'_, '_>) {
    let q = ChainQ::from(Q);
    let chain = serial();
    bencher.bench(|| chain.base_from_tip(black_box(&q)));
}

/// A thousand configurations at once, as many as fit the second cache.
#[divan::bench]
fn serial_batch_of_1000(bencher: Bencher<'_, '_>) {
    const COUNT: usize = 1000;
    let chain = serial();
    let configurations: Vec<f64> = (0..6000).map(|at| 3.0 * f64::from(at).sin()).collect();
    let mut base_from_tips = vec![Pose::identity(); COUNT];
    bencher.counter(divan::counter::ItemsCount::new(COUNT)).bench_local(|| {
        chain.base_from_tips_into(black_box(&configurations), black_box(&mut base_from_tips))
    });
}

#[divan::bench(args = [JacobianKind::Space, JacobianKind::Geometric, JacobianKind::Body])]
fn serial_with_jacobian(bencher: Bencher<'_, '_>, kind: JacobianKind) {
    let q = ChainQ::from(Q);
    let chain = serial();
    let mut columns = [Twist::zero(); 6];
    bencher.bench_local(|| chain.pose_and_jacobian_into(black_box(&q), kind, black_box(&mut columns)));
}

#[divan::bench]
fn urdf_jacobian(bencher: Bencher<'_, '_>) {
    let q = RobotQ::from(Q);
    let (robot, _) = arm(DhConvention::Standard);
    let (tree, tip) = (UrdfTree::new(&robot), tip(&robot));
    let mut columns = [Twist::zero(); 6];
    let kind = JacobianKind::Geometric;
    bencher.bench_local(|| tree.jacobian_into(black_box(&q), tip, kind, black_box(&mut columns)));
}

/// The time derivative of a Jacobian that is there already.
#[divan::bench(args = [JacobianKind::Space, JacobianKind::Geometric, JacobianKind::Body])]
fn jacobian_rate(bencher: Bencher<'_, '_>, kind: JacobianKind) {
    let (mut columns, mut rate) = ([Twist::zero(); 6], [Twist::zero(); 6]);
    serial().pose_and_jacobian_into(&ChainQ::from(Q), kind, &mut columns).expect("six joints");
    bencher.bench_local(|| kind.rate_into(black_box(&columns), black_box(&Q), black_box(&mut rate)));
}

/// All 36 derivatives by a table of six rows and its two constants.
#[divan::bench(args = [DhConvention::Standard, DhConvention::Modified])]
fn dh_derivatives(bencher: Bencher<'_, '_>, convention: DhConvention) {
    let q = RobotQ::from(Q);
    let (_, chain) = arm(convention);
    let mut derivatives = DhDerivatives::default();
    bencher.bench_local(|| chain.derivatives_into(black_box(&q), black_box(&mut derivatives)));
}

/// All 42 derivatives by six screws and the home pose.
#[divan::bench]
fn screw_derivatives(bencher: Bencher<'_, '_>) {
    let q = ChainQ::from(Q);
    let (robot, chain) = arm(DhConvention::Standard);
    let screws = ScrewChain::from_dh(&chain, robot.dof()).expect("the table's own robot");
    let mut derivatives = ScrewDerivatives::default();
    bencher.bench_local(|| screws.derivatives_into(black_box(&q), black_box(&mut derivatives)));
}
