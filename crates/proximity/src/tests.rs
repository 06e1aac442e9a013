//! The bounds against brute force: a pair that was not measured may not be nearer than the reported one.

use std::collections::BTreeSet;

use congruent_description::{Geometry, JointKind, JointParts, Link, LinkIndex, Robot};
use nalgebra::{Translation3, UnitQuaternion, Vector3};
use proptest::prelude::*;

use super::*;

/// Two distances of one pair, the one that is reported and the one that brute force finds: equal,
/// since both come from the same query, except for pairs that a bound left out by the slack.
const SAME_M: f64 = DISTANCE_SLACK_M;

/// A robot whose links hang side by side on the root, each with one or two shapes off its origin.
fn description() -> RobotDescription {
    let shape = |x: f64, geometry| Shape {
        link_from_shape: Isometry3::translation(x, 0.05, -0.02),
        geometry,
        color_rgba: None,
    };
    let ball = |radius_m| Geometry::Sphere { radius_m };
    let cuboid = |x, y, z| Geometry::Box { size_m: Vector3::new(x, y, z) };
    let can = |radius_m, length_m| Geometry::Cylinder { radius_m, length_m };
    let shapes = [
        vec![shape(0.0, cuboid(0.3, 0.2, 0.1))],
        vec![shape(0.3, ball(0.1)), shape(-0.2, cuboid(0.1, 0.1, 0.4))],
        vec![shape(0.1, can(0.05, 0.5))],
        vec![shape(0.4, cuboid(0.02, 0.3, 0.3)), shape(0.0, can(0.1, 0.1))],
        vec![shape(-0.1, ball(0.02))],
        vec![],
    ];
    let link = |(index, collisions)| Link { name: format!("link_{index}"), collisions, ..Link::default() };
    let links: Vec<Link> = shapes.into_iter().enumerate().map(link).collect();
    let hang = |index: usize| {
        let [name, child] = ["joint", "link"].map(|what| format!("{what}_{index}"));
        JointParts::new(&name, JointKind::Continuous, "link_0", &child, Isometry3::identity())
    };
    let robot = Robot::new("star", links, (1..6).map(hang).collect()).unwrap();
    RobotDescription {
        path: "star.urdf".into(),
        name: "star".into(),
        urdf_path: "star.urdf".into(),
        base: robot.root(),
        tip: robot.root(),
        chain_ends: congruent_description::ChainEnds::default(),
        robot,
        dh: None,
        dynamics: None,
        accelerations: Vec::new(),
        tip_from_tcp: None,
        declared_tolerance: congruent_description::RequestedTolerance::default(),
        mapping: None,
        tolerances: None,
        references: Vec::new(),
        tolerance: congruent_description::Tolerance::default(),
        named_files: congruent_description::NamedFiles::default(),
        disabled_collisions: BTreeSet::new(),
        warnings: Vec::new(),
        inputs: Vec::new(),
        places: congruent_description::Places::default(),
        set_values: Vec::new(),
        loaded: None,
    }
}

fn obstacle() -> Obstacle {
    Obstacle {
        name: "wall".into(),
        world_from_obstacle: Isometry3::translation(0.8, 0.0, 0.0),
        geometry: Geometry::Box { size_m: Vector3::new(0.1, 2.0, 2.0) },
    }
}

fn watched(choice: PairChoice) -> Clearance {
    Clearance::new(&description(), &[obstacle()], choice).unwrap()
}

/// The smallest distance of all pairs, measured afresh.
fn by_brute_force(poses: &[Isometry3<f64>]) -> f64 {
    let mut fresh = watched(PairChoice::All);
    fresh.move_links(poses);
    let pairs = fresh.pairs().len();
    (0..pairs).map(|pair| fresh.measure(pair)).fold(f64::INFINITY, f64::min)
}

/// A zone around the path of some links, off its own origin's axes.
fn zones() -> [Zone; 2] {
    let description = description();
    let links =
        |names: &[&str]| names.iter().map(|name| description.robot.find_link(name).unwrap()).collect();
    let turned = Isometry3::new(Vector3::new(0.5, 0.2, 0.3), Vector3::new(0.3, -0.8, 0.4));
    let space = |name: &str, world_from_obstacle, geometry| Obstacle {
        name: name.into(),
        world_from_obstacle,
        geometry,
    };
    let ball = space("ball", Isometry3::translation(0.0, 1.0, 0.3), Geometry::Sphere { radius_m: 0.2 });
    let room = space("room", turned, Geometry::Box { size_m: Vector3::new(0.2, 3.0, 1.0) });
    [
        Zone { space: ball, links: links(&["link_1", "link_4"]) },
        Zone { space: room, links: links(&["link_0", "link_2", "link_3"]) },
    ]
}

/// The smallest distance of a zone's links to it, from fresh hulls.
fn to_zones_by_brute_force(poses: &[Isometry3<f64>]) -> f64 {
    let robot = description().robot;
    let apart = |zone: &Zone, link: LinkIndex| {
        let shape = |geometry| Shape { link_from_shape: Isometry3::identity(), geometry, color_rgba: None };
        let space = Hulls::new("zone", &[shape(zone.space.geometry.clone())]).unwrap();
        let hulls = Hulls::new("link", &robot.link(link).collisions).unwrap();
        hulls.distance_m(&space, &poses[link.get()].inv_mul(&zone.space.world_from_obstacle))
    };
    let zones = zones();
    let all = zones.iter().flat_map(|zone| zone.links.iter().map(move |&link| apart(zone, link)));
    all.fold(f64::INFINITY, f64::min)
}

/// A walk of all links: steps of one size in place, rotation about another axis each time.
fn walk() -> impl Strategy<Value = (f64, Vec<[f64; 36]>)> {
    let size = prop_oneof![Just(1e-6), Just(1e-3), Just(0.03), Just(0.5)];
    (size, prop::collection::vec(prop::array::uniform32(-1.0..1.0_f64), 1..40)).prop_map(|(size, steps)| {
        let wide = |step: [f64; 32]| std::array::from_fn(|index| step[index % 32] * size);
        (size, steps.into_iter().map(wide).collect())
    })
}

/// All links after one step of a walk; the root is at rest.
fn stepped(poses: &mut [Isometry3<f64>], step: &[f64; 36]) {
    for (pose, step) in poses.iter_mut().skip(1).zip(step.chunks_exact(6)) {
        let [x, y, z, a, b, c] = step.try_into().map(|step: [f64; 6]| step).unwrap();
        let turn = UnitQuaternion::new(Vector3::new(a, b, c) * 3.0);
        *pose = Isometry3::from_parts(Translation3::new(x, y, z) * pose.translation, turn * pose.rotation);
    }
}

fn at_the_start() -> Vec<Isometry3<f64>> {
    let place = |index: u8| Isometry3::translation(0.0, f64::from(index) * 0.45 - 1.0, 0.3);
    (0..6).map(place).collect()
}

proptest! {
    #[test]
    fn the_nearest_is_the_nearest_of_all((_, steps) in walk()) {
        let mut clearance = watched(PairChoice::All);
        let mut poses = at_the_start();
        for step in &steps {
            stepped(&mut poses, step);
            clearance.move_links(&poses);
            let found_m = clearance.nearest().unwrap().distance_m;
            let expected_m = by_brute_force(&poses);
            prop_assert!((found_m - expected_m).abs() <= SAME_M, "{found_m} is not {expected_m}");
        }
    }

    #[test]
    fn nothing_below_a_threshold_is_missed((_, steps) in walk(), threshold_m in 0.0..0.5_f64) {
        let mut clearance = watched(PairChoice::All);
        let mut poses = at_the_start();
        for step in &steps {
            stepped(&mut poses, step);
            clearance.move_links(&poses);
            let expected_m = by_brute_force(&poses);
            match clearance.nearest_below(threshold_m) {
                Some(found) => {
                    prop_assert!((found.distance_m - expected_m).abs() <= SAME_M);
                    prop_assert_eq!(clearance.current_m(found.pair), Some(found.distance_m));
                }
                None => prop_assert!(expected_m >= threshold_m - SAME_M, "{} missed", expected_m),
            }
        }
    }

    #[test]
    fn case_13_no_link_in_a_zone_is_missed((_, steps) in walk()) {
        let mut before_zones = watched(PairChoice::All).before_zones(&zones()).unwrap();
        let mut poses = at_the_start();
        for step in &steps {
            stepped(&mut poses, step);
            before_zones.move_links(&poses);
            let found_m = before_zones.nearest().unwrap().distance_m;
            let expected_m = to_zones_by_brute_force(&poses);
            prop_assert!((found_m - expected_m).abs() <= SAME_M, "{found_m} is not {expected_m}");
        }
    }

    /// What the bounds rest on: no point of a ball moves further than that.
    #[test]
    fn no_point_moves_further_than_the_bound(
        step in prop::array::uniform6(-2.0..2.0_f64),
        point in prop::array::uniform3(-1.0..1.0_f64),
    ) {
        let before = Isometry3::new(Vector3::new(0.3, 0.1, -0.2), Vector3::new(0.5, -1.0, 0.2));
        let [x, y, z, a, b, c] = step;
        let after = Isometry3::new(Vector3::new(x, y, z), Vector3::new(a, b, c) * 2.0);
        let point = nalgebra::Point3::from(point);
        let moved_m = (after * point - before * point).norm();
        prop_assert!(moved_m <= largest_shift_m(&before, &after, point.coords.norm()) + 1e-12);
    }
}

/// Boxes and balls in rings around the robot, the first `at_m` away and each further ring 0.3 m more.
fn rings(count: u32, at_m: f64) -> Vec<Obstacle> {
    let place = |index: u32| {
        let (ring, angle) = (f64::from(index / 20), f64::from(index) * 0.7);
        let (radius_m, height_m) = (at_m + 0.3 * ring, 0.3 * f64::from(index % 5) - 0.6);
        Obstacle {
            name: format!("obstacle_{index}"),
            world_from_obstacle: Isometry3::new(
                Vector3::new(radius_m * angle.cos(), radius_m * angle.sin(), height_m),
                Vector3::new(0.3, angle, -0.4),
            ),
            geometry: match index % 2 {
                0 => Geometry::Box { size_m: Vector3::new(0.1, 0.2, 0.3) },
                _ => Geometry::Sphere { radius_m: 0.1 },
            },
        }
    };
    (0..count).map(place).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    /// All that is near is found among many obstacles, near and far, with the distances of fresh measurements.
    #[test]
    fn among_many_obstacles_no_pair_is_missed((_, steps) in walk(), limit_m in 0.05..0.6_f64) {
        let obstacles = rings(60, 0.9);
        let among = || Clearance::new(&description(), &obstacles, PairChoice::All).unwrap();
        let mut clearance = among();
        let mut poses = at_the_start();
        for (number, step) in steps.iter().enumerate() {
            stepped(&mut poses, step);
            clearance.move_links(&poses);
            let mut fresh = among();
            fresh.move_links(&poses);
            let pairs = fresh.pairs().len();
            let all: Vec<f64> = (0..pairs).map(|pair| fresh.measure(pair)).collect();
            // The questions of a run change from sample to sample.
            let threshold_m = limit_m * [1.0, 0.3, 0.6][number % 3];
            let mut found = Vec::new();
            clearance.below(threshold_m, |_| f64::INFINITY, |pair, distance_m| found.push((pair, distance_m)));
            let expected: Vec<(usize, f64)> =
                all.iter().copied().enumerate().filter(|(_, distance_m)| *distance_m < threshold_m).collect();
            prop_assert_eq!(&found, &expected);
            let one_by_one = (0..pairs).filter_map(|pair| Some((pair, clearance.measure_below(pair, threshold_m)?)));
            prop_assert_eq!(one_by_one.collect::<Vec<_>>(), expected);
            if number % 2 == 0 {
                let nearest = clearance.nearest().unwrap();
                let expected_m = all.iter().copied().fold(f64::INFINITY, f64::min);
                prop_assert!((nearest.distance_m - expected_m).abs() <= SAME_M);
                prop_assert_eq!(nearest.distance_m.to_bits(), all[nearest.pair].to_bits());
            }
        }
    }
}

/// Number of pairs that are looked at in each of 200 small steps, at most.
fn looked_at(obstacles: u32) -> usize {
    let mut clearance = Clearance::new(&description(), &rings(obstacles, 6.0), PairChoice::All).unwrap();
    let mut poses = at_the_start();
    let mut most = 0;
    for step in 0..200 {
        let step = [if step % 20 < 10 { 1e-3 } else { -1e-3 }; 36];
        stepped(&mut poses, &step);
        clearance.move_links(&poses);
        let nearest = clearance.nearest().unwrap();
        clearance.gather(nearest.distance_m);
        // The first sample looks at all.
        most = most.max(clearance.candidates.len());
        clearance.let_wait();
    }
    most
}

#[test]
fn far_obstacles_wait() {
    let (ten, thousand) = (looked_at(10), looked_at(1000));
    assert_eq!(ten, thousand, "pairs that are looked at in one step");
    assert!(ten <= 10, "{ten} pairs of links");
}

#[test]
fn far_pairs_are_not_measured_again() {
    let mut clearance = watched(PairChoice::All);
    let mut poses = at_the_start();
    clearance.move_links(&poses);
    clearance.nearest();
    poses[1].translation.x += 1e-4;
    clearance.move_links(&poses);
    clearance.nearest();
    let measured = (0..clearance.pairs().len()).filter(|&pair| clearance.current_m(pair).is_some()).count();
    assert!((1..4).contains(&measured), "{measured} of {}", clearance.pairs().len());
}

#[test]
fn case_13_a_zone_is_paired_with_the_links_that_it_names() {
    let before_zones = watched(PairChoice::All).before_zones(&zones()).unwrap();
    let pairs: Vec<_> = (0..before_zones.pairs().len()).map(|pair| before_zones.names(pair)).collect();
    let expected = [["ball", "link_1"], ["ball", "link_4"], ["room", "link_0"], ["room", "link_2"]];
    assert_eq!((&pairs[..4], pairs[4]), (&expected[..], ["room", "link_3"]));
}

#[test]
fn neighbours_and_the_root_before_obstacles_are_left_out() {
    let names = |choice| {
        let clearance = watched(choice);
        let name = |pair| clearance.names(pair);
        (0..clearance.pairs().len()).map(name).map(|[a, b]| format!("{a} {b}")).collect::<Vec<_>>()
    };
    let usual = names(PairChoice::Usual);
    // Every link is a neighbour of the root, link_5 has no shape, and the wall is at rest as the root is.
    assert_eq!(usual.len(), 6 + 4, "{usual:?}");
    assert!(!usual.iter().any(|pair| pair.contains("link_0") || pair.contains("link_5")), "{usual:?}");
    let all = names(PairChoice::All);
    assert_eq!(all.len(), 10 + 4, "{all:?}");
    assert!(!all.contains(&"link_0 wall".to_owned()), "{all:?}");
}

/// Links that turn about an axis through the middle of a ball on the root keep their distance from it; others do not.
#[test]
fn a_pair_that_no_motion_brings_nearer_is_constant() {
    let mut description = description();
    let ball = |y: f64| Shape {
        link_from_shape: Isometry3::translation(0.0, y, 0.0),
        geometry: Geometry::Sphere { radius_m: 0.1 },
        color_rgba: None,
    };
    let link =
        |(name, y): (&str, f64)| Link { name: name.to_owned(), collisions: vec![ball(y)], ..Link::default() };
    let links: Vec<Link> = [("root", 0.0), ("around", 0.5), ("aside", 0.3)].into_iter().map(link).collect();
    let joint = |name: &str, child: &str, y: f64| {
        JointParts::new(name, JointKind::Continuous, "root", child, Isometry3::translation(0.0, y, 0.0))
    };
    description.robot =
        Robot::new("turning", links, vec![joint("a", "around", 0.0), joint("b", "aside", 1.0)]).unwrap();
    let clearance = Clearance::new(&description, &[], PairChoice::All).unwrap();
    let constant = clearance.constant_pairs(&description);
    let named = |pair: usize| clearance.names(pair).join("--");
    let found: Vec<String> = (0..constant.len()).filter(|&pair| constant[pair]).map(named).collect();
    assert_eq!(found, ["root--around"]);
}
