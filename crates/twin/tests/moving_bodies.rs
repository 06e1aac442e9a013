//! Moving obstacles in whole runs, against closed forms: everything is a sphere.

#![expect(clippy::unwrap_used, reason = "helpers of tests end a test by panicking")]

use std::{collections::BTreeMap, path::PathBuf};

use congruent_description::{RobotDescription, load_robot};
use congruent_input::Findings;
use congruent_monitors::{Recorder, RecordingError, Sample};
use congruent_scenario::{
    ControllerKind, ControllerSettings, GraspSettings, JointMotion, MotionSettings, ObstacleSettings,
    PathPoseSettings, Profile, Scenario, SimulationSettings,
};
use congruent_twin::{Run, RunSetup};

/// A ball of radius 0.1 m and 2 kg on a vertical slide of 2 m, beside a post on the root.
const LIFT: &str = r#"<robot name="lift">
  <link name="base"><collision><origin xyz="3 0 0"/><geometry><sphere radius="0.1"/></geometry></collision></link>
  <link name="ball">
    <inertial><mass value="2"/><inertia ixx="0.01" iyy="0.01" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial>
    <collision><geometry><sphere radius="0.1"/></geometry></collision>
  </link>
  <joint name="slide" type="prismatic">
    <parent link="base"/><child link="ball"/><axis xyz="0 0 1"/><limit lower="-2" upper="2" velocity="5" effort="500"/>
  </joint>
</robot>"#;

fn lift() -> (tempfile::TempDir, RobotDescription) {
    let folder = tempfile::tempdir().unwrap();
    let path: PathBuf = folder.path().join("lift.urdf");
    std::fs::write(&path, LIFT).unwrap();
    let description = load_robot(&path).unwrap();
    (folder, description)
}

fn ball(name: &str, radius_m: f64, xyz: [f64; 3]) -> ObstacleSettings {
    let (sphere_radius_m, xyz_m) = (Some(radius_m), Some(xyz));
    ObstacleSettings { name: name.to_owned(), sphere_radius_m, xyz_m, ..ObstacleSettings::default() }
}

fn along(name: &str, radius_m: f64, path: &[(f64, [f64; 3])]) -> ObstacleSettings {
    let pose = |(at_s, xyz): &(f64, [f64; 3])| PathPoseSettings {
        at_s: *at_s,
        xyz_m: Some(*xyz),
        ..Default::default()
    };
    let path = path.iter().map(pose).collect();
    ObstacleSettings { path, xyz_m: None, ..ball(name, radius_m, [0.0; 3]) }
}

fn raise(to_m: f64, duration_s: f64) -> MotionSettings {
    MotionSettings::Joints(JointMotion {
        move_joints_m: BTreeMap::from([("slide".to_owned(), to_m)]),
        duration_s: Some(duration_s),
        profile: Profile::Linear,
        ..JointMotion::default()
    })
}

fn scenario(kind: &str, obstacle: Vec<ObstacleSettings>, grasp: Vec<GraspSettings>) -> Scenario {
    Scenario {
        name: "lift".to_owned(),
        controller: ControllerSettings {
            kind: ControllerKind::find(kind).expect("a kind"),
            stiffness: 1e5.into(),
            damping: 2e3.into(),
            ..ControllerSettings::default()
        },
        simulation: SimulationSettings { duration_s: Some(3.0), ..SimulationSettings::default() },
        motion: vec![raise(1.0, 2.0)],
        obstacle,
        grasp,
        ..Scenario::default()
    }
}

/// At each sample: the time, all distances by names, the position of the slide and its effort.
struct Seen(Vec<(f64, BTreeMap<String, f64>, f64, f64)>);

impl Recorder for Seen {
    fn record(&mut self, sample: &mut Sample<'_>) -> Result<(), RecordingError> {
        // Below infinity are all pairs that count now.
        let pairs = sample.clearance.pairs().len();
        for pair in 0..pairs {
            sample.clearance.measure_below(pair, f64::INFINITY);
        }
        let pairs = 0..sample.clearance.pairs().len();
        let found = pairs.filter_map(|pair| {
            let [a, b] = sample.clearance.names(pair);
            Some((format!("{a}--{b}"), sample.clearance.current_m(pair)?))
        });
        let joints = sample.joints.state();
        self.0.push((sample.time_s, found.collect(), joints.q[0], joints.effort[0]));
        Ok(())
    }
}

fn seen(scenario: Scenario) -> Seen {
    let (_folder, description) = lift();
    watched(&RunSetup::new(scenario, description).unwrap_or_else(|found| panic!("{found:#?}")))
}

fn watched(setup: &RunSetup) -> Seen {
    let mut seen = Seen(Vec::new());
    let (_, result) = Run::new(setup).unwrap().finish(&mut setup.checks(), &mut seen, |_| ());
    result.unwrap();
    seen
}

#[track_caller]
fn refused(scenario: Scenario, code: &str, words: &str) {
    let (_folder, description) = lift();
    let found = RunSetup::new(scenario, description).map(|_| ()).unwrap_err();
    assert!(found[0].code.name == code && found[0].message.contains(words), "{found:#?}");
}

/// Rounding of distances of spheres, and the slack of parry; worst seen 1e-15.
const DISTANCE_M: f64 = 1e-9;

/// The ball is at the origin; a body of radius 0.1 m that overlaps it by `depth_m`, beside it.
fn beside(depth_m: f64) -> ObstacleSettings {
    ball("part", 0.1, [0.2 - depth_m, 0.0, 0.0])
}

/// What the physics says of a scenario before it begins.
fn of_physics(kind: &str, obstacle: ObstacleSettings, grasp: Vec<GraspSettings>) -> Result<(), Findings> {
    let (_folder, description) = lift();
    let setup = RunSetup::new(scenario(kind, vec![obstacle], grasp), description).unwrap();
    setup.for_simulation().map(|_| ())
}

#[test]
fn what_overlaps_a_link_at_the_start_is_refused_if_the_physics_acts_on_it() {
    let found = of_physics("pd", beside(0.02), Vec::new()).unwrap_err();
    assert_eq!(found[0].code.name, "scenario::obstacle_overlap");
    for words in ["obstacle \"part\"", "link \"ball\"", "by 20 mm at the start"] {
        assert!(found[0].message.contains(words), "{found:#?}");
    }
    // Carried from the first step on, not later: then it would be pushed away before.
    let from = |from_s| vec![GraspSettings { from_s, ..grasp(None) }];
    assert!(of_physics("pd", beside(0.02), from(0.0)).is_ok());
    let later = of_physics("pd", beside(0.02), from(0.5)).unwrap_err();
    assert!(later[0].help.as_ref().unwrap().contains("from_s = 0.0"), "{later:#?}");
    // Touching, in playback, and a link that is fixed to the root.
    assert!(of_physics("pd", beside(0.0), Vec::new()).is_ok());
    assert!(of_physics("pd", beside(0.9e-3), Vec::new()).is_ok());
    assert!(of_physics("kinematic", beside(0.02), Vec::new()).is_ok());
    assert!(of_physics("pd", ball("part", 0.1, [3.0, 0.0, 0.0]), Vec::new()).is_ok());
    // On a path, where it begins.
    let path = along("part", 0.1, &[(0.0, [0.15, 0.0, 0.0]), (1.0, [5.0, 0.0, 0.0])]);
    assert_eq!(of_physics("pd", path, Vec::new()).unwrap_err().len(), 1);
}

/// A ball of 0.2 m: 0.1 m in a step is seen in every sample it is near, 2 m in a step may pass through a link unseen.
#[test]
fn an_obstacle_that_jumps_over_links_is_reported() {
    let warned = |until_s: f64| {
        let path = along("bullet", 0.1, &[(1.0, [-1.0, 0.0, 0.5]), (until_s, [1.0, 0.0, 0.5])]);
        let (_folder, description) = lift();
        let setup = RunSetup::new(scenario("pd", vec![path], Vec::new()), description).unwrap();
        let jumps =
            setup.warnings.into_iter().filter(|warning| warning.code.name == "scenario::obstacle_jumps");
        jumps.map(|warning| warning.message).collect::<Vec<_>>()
    };
    assert_eq!(warned(1.02), [""; 0]);
    let found = warned(1.001);
    assert!(found.len() == 1 && found[0].contains("\"bullet\" moves up to 2000 mm in a step"), "{found:?}");
}

#[test]
fn distances_to_an_obstacle_on_a_path_are_those_of_spheres() {
    let drone = along("drone", 0.2, &[(0.5, [-1.0, 0.4, 0.5]), (2.5, [1.0, 0.4, 0.5])]);
    for (time_s, distances, q, _) in seen(scenario("kinematic", vec![drone], Vec::new())).0 {
        let x = -1.0 + (time_s - 0.5).clamp(0.0, 2.0);
        let to_ball = (x * x + 0.16 + (q - 0.5) * (q - 0.5)).sqrt() - 0.3;
        assert!((distances["ball--drone"] - to_ball.max(0.0)).abs() < DISTANCE_M, "at {time_s}");
        // A link at rest is approached too.
        let to_base = ((x - 3.0) * (x - 3.0) + 0.16 + 0.25_f64).sqrt() - 0.3;
        assert!((distances["base--drone"] - to_base).abs() < DISTANCE_M, "at {time_s}");
    }
}

fn grasp(mass_kg: Option<f64>) -> GraspSettings {
    GraspSettings {
        body: "part".to_owned(),
        from_s: 0.5,
        until_s: Some(1.5),
        // The ball takes it in passing, through the air.
        reach_m: Some(1.0),
        mass_kg,
        ..GraspSettings::default()
    }
}

#[test]
fn a_carried_body_goes_along_is_held_against_other_obstacles_and_stays_where_it_is_left() {
    let (part, roof) = (ball("part", 0.05, [0.0, 0.3, 0.1]), ball("roof", 0.1, [0.0, 0.3, 2.0]));
    for (time_s, distances, _, _) in seen(scenario("kinematic", vec![part, roof], vec![grasp(None)])).0 {
        // The slide rises by 0.5 m/s.
        let is_carried = (0.5..1.5).contains(&time_s);
        let z = 0.1 + 0.5 * (time_s.clamp(0.5, 1.5) - 0.5);
        let to_roof = distances.get("part--roof").copied();
        assert_eq!(to_roof.is_some(), is_carried, "at {time_s}: {to_roof:?}");
        if let Some(distance_m) = to_roof {
            assert!((distance_m - (2.0 - z - 0.15)).abs() < DISTANCE_M, "{distance_m} at {time_s}");
        }
        // The link that carries it never counts.
        assert!(!distances.contains_key("ball--part") && distances.contains_key("ball--roof"));
    }
}

#[test]
fn a_carried_mass_loads_the_arm_meanwhile() {
    let part = ball("part", 0.05, [0.0, 0.3, 0.1]);
    let seen = seen(scenario("pd", vec![part], vec![grasp(Some(3.0))])).0;
    // Steadily rising: the force is the weight of the ball, and of the part while it is carried.
    let force = |at: usize| seen[at].3;
    for (at, mass_kg) in [(450, 2.0), (1000, 5.0), (1450, 5.0), (1900, 2.0), (2950, 2.0)] {
        assert!((force(at) - mass_kg * 9.81).abs() < 0.01, "{} N at {} s", force(at), seen[at].0);
    }
}

#[test]
fn the_payload_is_where_the_plan_has_it() {
    let (_folder, description) = lift();
    let part = ball("part", 0.05, [0.0, 0.3, 0.1]);
    let setup = RunSetup::new(scenario("pd", vec![part], vec![grasp(Some(3.0))]), description).unwrap();
    let payload = &setup.payloads[0];
    // At 0.5 s the ball is at 0.25 m.
    let com = payload.inertia_in_link().link_from_inertial.translation.vector;
    assert!((com - nalgebra::Vector3::new(0.0, 0.3, 0.1 - 0.25)).norm() < 1e-12, "{com}");
    let moment = payload.inertia_in_link().tensor_kg_m2[(0, 0)];
    assert!((moment - 0.4 * 3.0 * 0.05 * 0.05).abs() < 1e-15);
    assert_eq!((payload.from_s, payload.until_s, payload.name.as_str()), (0.5, 1.5, "part"));
}

#[test]
fn a_body_on_a_path_pushes_the_arm() {
    // The slide hangs free at 0; a ram rises under it by 0.5 m.
    let ram = along("ram", 0.1, &[(0.0, [0.0, 0.0, -0.25]), (1.0, [0.0, 0.0, 0.25])]);
    let scenario = Scenario { motion: Vec::new(), ..scenario("passive", vec![ram], Vec::new()) };
    let seen = seen(scenario).0;
    let lifted = seen[1000].2;
    assert!((lifted - 0.45).abs() < 0.01, "the ball is at {lifted} m, on the ram at 0.25 m");
}

#[test]
fn what_cannot_move_so_is_refused() {
    let part = || ball("part", 0.05, [0.0, 0.3, 0.1]);
    let one = |obstacle, grasp| scenario("kinematic", vec![obstacle], grasp);
    let twice = ObstacleSettings { xyz_m: Some([0.0; 3]), ..along("a", 0.1, &[(0.0, [0.0; 3])]) };
    refused(one(twice, Vec::new()), "scenario::obstacle_path", "a pose of its own and a path");
    let back = along("a", 0.1, &[(1.0, [0.0; 3]), (1.0, [0.0; 3])]);
    refused(one(back, Vec::new()), "scenario::obstacle_path", "not after 1 s");
    let unknown = GraspSettings { body: "prat".to_owned(), ..grasp(None) };
    refused(one(part(), vec![unknown]), "scenario::grasp", "no obstacle is named \"prat\"");
    let again = GraspSettings { from_s: 1.0, until_s: None, ..grasp(None) };
    refused(
        one(part(), vec![grasp(None), again]),
        "scenario::grasp",
        "before the end of its previous grasp at 1.5 s",
    );
    let early = GraspSettings { until_s: Some(0.2), ..grasp(None) };
    refused(one(part(), vec![early]), "scenario::grasp", "until_s = 0.2 s must be later");
    let moving = along("part", 0.05, &[(0.0, [0.0, 0.3, 0.1])]);
    refused(one(moving, vec![grasp(None)]), "scenario::grasp", "moves along a path");
    let no_body = GraspSettings { inertia_kg_m2: Some([1.0, 1.0, 3.0]), ..grasp(Some(1.0)) };
    refused(one(part(), vec![no_body]), "scenario::grasp_inertia", "no body has this");
}

/// The ball of 0.1 m is on a straight line upwards, so that every distance is a closed form.
#[test]
fn a_body_beyond_the_reach_of_the_gripper_is_not_grasped() {
    let near = |y| ball("part", 0.05, [0.0, y, 0.0]);
    let taken = |reach_m| GraspSettings { from_s: 0.0, until_s: None, reach_m, ..grasp(None) };
    let setup = |y: f64, reach_m| {
        let (_folder, description) = lift();
        RunSetup::new(scenario("kinematic", vec![near(y)], vec![taken(reach_m)]), description).map(|_| ())
    };
    assert!(setup(0.249, None).is_ok(), "99 mm between the surfaces");
    for (y, reach_m, words) in [
        (0.251, None, "101 mm from the gripper (link \"ball\""),
        (0.7, None, "550 mm from the gripper"),
        (0.249, Some(0.05), "at from_s = 0 s, reach <= 50 mm"),
    ] {
        refused(scenario("kinematic", vec![near(y)], vec![taken(reach_m)]), "scenario::grasp", words);
    }
    assert!(setup(0.7, Some(0.551)).is_ok());
    let both = GraspSettings { reach_mm: Some(50.0), ..taken(Some(0.05)) };
    refused(scenario("kinematic", vec![near(0.2)], vec![both]), "toml::both_units", "reach_mm");
}

/// A cube of 200 mm around the origin, as text of an STL file in millimetres.
fn cube() -> String {
    let corner = |index: usize| [0, 1, 2].map(|bit| if index >> bit & 1 == 0 { -100 } else { 100 });
    let sides = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];
    let triangles = sides.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]);
    let facet = |corners: [usize; 3]| {
        let vertices = corners.map(|index| {
            let [x, y, z] = corner(index);
            format!("vertex {x} {y} {z}\n")
        });
        format!("facet normal 0 0 0\nouter loop\n{}endloop\nendfacet\n", vertices.concat())
    };
    format!("solid cube\n{}endsolid cube\n", triangles.map(facet).collect::<String>())
}

#[test]
fn files_beside_the_scenario_are_found_and_others_are_not() {
    let (folder, _) = lift();
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
    write("cube.stl", &cube());
    write("up.csv", "time_s,slide_mm\n0,0\n1,250\n2,500\n");
    let scenario = |mesh: &str| {
        format!(
            "schema_version = 1\nname = \"files\"\nrobot = \"lift.urdf\"\n[controller]\nkind = \"kinematic\"\n\
             [[motion]]\nplay_csv = \"up.csv\"\nbetween = \"linear\"\n\
             [[obstacle]]\nname = \"cube\"\nmesh = \"{mesh}\"\nscale = [0.001, 0.001, 0.002]\nxyz_m = [0.5, 0, 0]\n"
        )
    };
    write("scenario.toml", &scenario("cube.stl"));
    let path = folder.path().join("scenario.toml");
    let setup = RunSetup::load(&path, &[]).unwrap_or_else(|found| panic!("{found:#?}"));
    for (time_s, distances, q, _) in watched(&setup).0 {
        assert!((q - 0.25 * time_s).abs() < 1e-12, "{q} at {time_s}");
        // To a side at x = 0.4, which ends at z = 0.2.
        let expected = (0.16 + (q - 0.2).max(0.0).powi(2)).sqrt() - 0.1;
        assert!((distances["ball--cube"] - expected).abs() < 1e-7, "{distances:?} at {time_s}");
    }
    for (mesh, code) in [
        ("../../../cube.stl", "mesh::not_found"),
        ("tube.stl", "mesh::not_found"),
        ("up.csv", "mesh::invalid"),
    ] {
        write("scenario.toml", &scenario(mesh));
        let found = RunSetup::load(&path, &[]).map(|_| ()).unwrap_err();
        assert!(
            found[0].code.name == code && found[0].line_column().is_some_and(|(line, _)| line == 11),
            "{found:#?}"
        );
    }
}
