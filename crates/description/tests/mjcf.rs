//! MJCF files as robots, held against MuJoCo: poses, limits, mass and inertia. Then files that are wrong, and those that a
//! robot file names.

use std::{collections::BTreeMap, fs, path::Path};

use congruent_description::{
    Geometry, JointKind, Robot, RobotDescription, load_robot, load_robot_with, parse_robot,
};
use congruent_input::{Capability, Diagnostic, FileAccess, Severity, SourceFile};
use nalgebra::{Isometry3, Matrix3, Quaternion, Translation3, UnitQuaternion, Vector3};
use serde_json::Value;

#[path = "../../../tests/support/corpus.rs"]
mod corpus;

const ROBOTS: [&str; 5] = ["ur5e", "wx250s", "so_arm100", "panda", "piper"];
/// Poses, m and rad. Kind: golden digits, 1e-16, along ten bodies. Worst seen: below 1e-15.
const POSE: f64 = 1e-12;
/// Mass and inertia relative to the largest of the body; centres, m. Kind: rounding; MuJoCo keeps the vertices of a mesh in single
/// precision after it has moved them to their centre. Worst seen: 7e-9 (`so_arm100`, the one body whose inertia is that of a mesh file).
const INERTIA: f64 = 3e-8;

fn json(path: &Path) -> Value {
    serde_json::from_str(&fs::read_to_string(path).expect("the golden has it")).expect("the golden has it")
}

fn numbers(value: &Value) -> Vec<f64> {
    value
        .as_array()
        .expect("the golden has it")
        .iter()
        .map(|number| number.as_f64().expect("the golden has it"))
        .collect()
}

/// A pose of a golden: position, then quaternion with w first.
fn pose(value: &Value) -> Isometry3<f64> {
    let [x, y, z, qw, qx, qy, qz] = numbers(value).try_into().expect("the golden has it");
    let rotation = UnitQuaternion::from_quaternion(Quaternion::new(qw, qx, qy, qz));
    Isometry3::from_parts(Translation3::new(x, y, z), rotation)
}

/// World poses of all links by name, if each of the named joints has its position; followers included.
fn world_from_links<'a>(robot: &'a Robot, q: &BTreeMap<&str, f64>) -> BTreeMap<&'a str, Isometry3<f64>> {
    let mut poses = vec![Isometry3::identity(); robot.links().len()];
    for joint in robot.joints() {
        let position = q.get(joint.name.as_str()).copied().unwrap_or_default();
        let axis = joint.axis_in_joint;
        let motion = match joint.kind {
            JointKind::Fixed => Isometry3::identity(),
            JointKind::Prismatic => Translation3::from(axis.into_inner() * position).into(),
            _ => Isometry3::rotation(axis.into_inner() * position),
        };
        poses[joint.child.get()] = poses[joint.parent.get()] * joint.parent_from_joint * motion;
    }
    robot.links().iter().map(|link| link.name.as_str()).zip(poses).collect()
}

#[track_caller]
fn check_pose(place: &str, found: &Isometry3<f64>, golden: &Value) {
    let off = found.inverse() * pose(golden);
    let off = off.translation.vector.norm().max(2.0 * off.rotation.imag().norm());
    assert!(off <= POSE, "{place}: off by {off:e}");
}

/// A symmetric tensor as goldens write it.
fn tensor(value: &Value) -> Matrix3<f64> {
    let [xx, yy, zz, xy, xz, yz] = numbers(value).try_into().expect("the golden has it");
    Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz)
}

/// Mass, centre of mass and inertia of a link.
#[track_caller]
fn check_inertia(place: &str, robot: &Robot, link: &str, [mass, com, golden]: [&Value; 3]) {
    let mass = mass.as_f64().expect("the golden has it");
    let Some(found) = robot.links()[robot.find_link(link).expect("the golden has it").get()].inertia else {
        return assert!(mass.abs() < f64::MIN_POSITIVE, "{place}: has no inertia");
    };
    assert!((found.mass_kg - mass).abs() <= INERTIA * mass, "{place}: {} kg, not {mass} kg", found.mass_kg);
    let com = Vector3::from_vec(numbers(com));
    let off_m = (found.link_from_inertial.translation.vector - com).norm();
    assert!(off_m <= INERTIA, "{place}: centre of mass off by {off_m:e} m");
    let turn = found.link_from_inertial.rotation.to_rotation_matrix();
    let tensor_in_link = turn * found.tensor_kg_m2 * turn.inverse();
    let golden = tensor(golden);
    let off = (tensor_in_link - golden).amax();
    assert!(off <= INERTIA * golden.amax(), "{place}: inertia off by {off:e} kg m2 of {:e}", golden.amax());
}

fn load(path: &Path) -> RobotDescription {
    load_robot(path).unwrap_or_else(|found| panic!("{}: {found:#?}", path.display()))
}

#[test]
fn robots_have_the_joints_poses_and_inertias_of_mujoco() {
    let Some(corpus) = corpus::corpus() else { return };
    for name in ROBOTS {
        let folder = corpus.join("pairs").join(name);
        let golden = json(&folder.join("golden.json"));
        let description = load(&folder.join("robot.xml"));
        assert_eq!(description.check_capability(Capability::Physics), Ok(()), "{name}");
        let robot = &description.robot;
        check_joints(name, robot, &golden);
        let links: Vec<&str> = golden["links"]
            .as_array()
            .expect("the golden has it")
            .iter()
            .map(|it| it.as_str().expect("the golden has it"))
            .collect();
        let joints: Vec<&str> = golden["joints"]
            .as_array()
            .expect("the golden has it")
            .iter()
            .map(|it| it["name"].as_str().expect("the golden has it"))
            .collect();
        for (at, link) in links.iter().enumerate() {
            let values = ["masses", "coms", "inertias"].map(|key| &golden[key][at]);
            check_inertia(&format!("{name} {link}"), robot, link, values);
        }
        for configuration in golden["configs"].as_array().expect("the golden has it") {
            let q = joints.iter().copied().zip(numbers(&configuration["q"])).collect();
            let found = world_from_links(robot, &q);
            for (link, golden) in
                links.iter().zip(configuration["poses"].as_array().expect("the golden has it"))
            {
                check_pose(&format!("{name} {link}"), &found[link], golden);
            }
            let sites = golden["site_names"]
                .as_array()
                .expect("the golden has it")
                .iter()
                .map(|it| it.as_str().expect("the golden has it"));
            for (site, golden) in sites.zip(configuration["sites"].as_array().expect("the golden has it")) {
                check_pose(&format!("{name} site {site}"), &found[site], golden);
            }
        }
    }
}

fn check_joints(name: &str, robot: &Robot, golden: &Value) {
    let golden = golden["joints"].as_array().expect("the golden has it");
    assert_eq!(robot.dof(), golden.len(), "{name}");
    for (&joint, golden) in robot.movable_joints().iter().zip(golden) {
        let joint = robot.joint(joint);
        assert_eq!(golden["name"].as_str(), Some(joint.name.as_str()), "{name}");
        assert_eq!(golden["type"].as_str(), Some(joint.kind.name()), "{name} {}", joint.name);
        let range = golden["lower"].as_f64().zip(golden["upper"].as_f64());
        assert_eq!(joint.position_range(), range, "{name} {}", joint.name);
        assert_eq!(
            joint.limit.and_then(|limit| limit.effort),
            golden["effort"].as_f64(),
            "{name} {}",
            joint.name
        );
        let losses =
            [&golden["damping"], &golden["friction"]].map(|it| it.as_f64().expect("the golden has it"));
        for (found, golden) in [joint.damping, joint.friction].into_iter().zip(losses) {
            assert!((found - golden).abs() < 1e-15, "{name} {}", joint.name);
        }
        let armature = joint.armature.expect("every MJCF states it");
        let expected = golden["armature"].as_f64().expect("the golden has it");
        assert!((armature - expected).abs() < 1e-15, "{name} {}", joint.name);
        let mimic = joint.mimic.map(|of| (robot.joint(of.master).name.as_str(), of.multiplier, of.offset));
        let expected = &golden["mimic"];
        let expected = expected["joint"].as_str().map(|master| {
            (
                master,
                expected["multiplier"].as_f64().expect("the golden has it"),
                expected["offset"].as_f64().expect("the golden has it"),
            )
        });
        assert_eq!(mimic, expected, "{name} {}", joint.name);
    }
}

/// Each file with one construct. A body that a robot cannot have is refused or fixed; MuJoCo drops the names of the bodies
/// that `fusestatic` joins.
#[test]
fn constructs_are_read_as_mujoco_reads_them() {
    let Some(corpus) = corpus::corpus() else { return };
    let folder = corpus.join("pairs/mjcf-constructs");
    let golden = json(&folder.join("golden.json"));
    let mut read = 0;
    for (case, golden) in golden["cases"].as_object().expect("the golden has it") {
        // It is a URDF, whose root link MuJoCo joins with the world.
        if case.starts_with("x14") {
            continue;
        }
        let is_good = golden["ok"].as_bool().expect("the golden has it");
        let loaded = load_robot(&folder.join(format!("{case}.xml")));
        // A ball joint that carries a hinge.
        if case.starts_with("c30") {
            assert!(loaded.is_err_and(|found| found.iter().any(|it| it.code.name == "mjcf::ball")));
            continue;
        }
        let Ok(description) = loaded else {
            assert!(!is_good, "{case}: {:#?}", loaded.err());
            continue;
        };
        assert!(is_good, "{case} is not refused");
        if !case.starts_with("c21") {
            check_construct(case, &description.robot, golden);
        }
        read += 1;
    }
    assert!(read >= 33, "{read}");
}

/// Bodies of one shape each, among them an ellipsoid, whose mass MuJoCo computes from it.
#[test]
fn an_ellipsoid_is_a_shape_as_every_other() {
    let Some(corpus) = corpus::corpus() else { return };
    for case in ["c15-inertia-from-primitives", "c16-inertiafromgeom-true-overrides"] {
        let read = load_robot(&corpus.join("pairs/mjcf-constructs").join(format!("{case}.xml")));
        let read = read.expect("MuJoCo reads it");
        assert!(read.warnings.iter().all(|found| found.code.name != "mjcf::shape"), "{:#?}", read.warnings);
        let body = read.robot.links().iter().find(|link| link.name == "ellipsoid").expect("the file has it");
        let [shape] = &body.collisions[..] else { panic!("{case}: {:#?}", body.collisions) };
        assert_eq!(shape.geometry, Geometry::Ellipsoid { semi_axes_m: Vector3::new(0.1, 0.2, 0.3) });
        assert_eq!(body.visuals, body.collisions);
    }
}

fn check_construct(case: &str, robot: &Robot, golden: &Value) {
    let named = |key: &str| -> Vec<String> {
        let all = golden[key].as_array().expect("the golden has it").iter();
        all.map(|it| it["name"].as_str().unwrap_or_default().to_owned()).collect()
    };
    let (bodies, joints, sites) = (named("bodies"), named("joints"), named("sites"));
    for (name, body) in bodies.iter().zip(golden["bodies"].as_array().expect("the golden has it")).skip(1) {
        if !name.is_empty() {
            let values = ["mass", "com", "inertia"].map(|key| &body[key]);
            check_inertia(&format!("{case} {name}"), robot, name, values);
        }
    }
    for configuration in golden["configs"].as_array().expect("the golden has it") {
        let q = numbers(&configuration["q"]);
        let q = robot.movable_joint_names().zip(q).collect();
        let found = world_from_links(robot, &q);
        let of_sites = configuration["sites"].as_array().expect("the golden has it");
        let links = bodies.iter().zip(configuration["bodies"].as_array().expect("the golden has it"));
        for (name, golden) in links.filter(|(name, _)| !name.is_empty()) {
            check_pose(&format!("{case} {name}"), &found[name.as_str()], golden);
        }
        for (name, golden) in sites.iter().zip(of_sites).filter(|(name, _)| !name.is_empty()) {
            let link = if bodies.contains(name) { format!("site:{name}") } else { name.clone() };
            check_pose(&format!("{case} site {name}"), &found[link.as_str()], golden);
        }
    }
    assert_eq!(robot.dof(), joints.len(), "{case}");
}

const MASS: &str = "<inertial pos='0 0 0' mass='1' diaginertia='1 1 1'/>";

/// An arm with one joint that includes a file.
fn arm(inside: &str) -> String {
    format!(
        "<mujoco model='arm'>{inside}<worldbody><body name='link'>{MASS}<joint name='j' axis='0 1 0' range='-90 90'/></body></worldbody></mujoco>"
    )
}

/// A folder with these files.
fn folder(files: &[(&str, &str)]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("the golden has it");
    for (name, text) in files {
        fs::write(folder.path().join(name), text).expect("the golden has it");
    }
    folder
}

#[track_caller]
fn first_error(path: &Path) -> Diagnostic {
    let found = load_robot(path).expect_err("the file is refused");
    found.iter().find(|found| found.severity == Severity::Error).expect("the golden has it").clone()
}

#[test]
fn a_robot_file_names_an_mjcf_by_either_key() {
    let arm = arm("<include file='options.xml'/>");
    let options = "<mujocoinclude><compiler angle='degree'/></mujocoinclude>";
    let folder = folder(&[
        ("arm.xml", &arm),
        ("options.xml", options),
        ("old.toml", "urdf = 'arm.xml'\ntip = 'link'"),
        ("new.toml", "description = 'arm.xml'\ntip = 'link'"),
        ("both.toml", "urdf = 'arm.xml'\ndescription = 'arm.xml'"),
        ("gone.toml", "description = 'gone.xml'"),
    ]);
    for name in ["arm.xml", "old.toml", "new.toml"] {
        let description =
            load_robot_with(&folder.path().join(name), &FileAccess::default()).expect("the golden has it");
        assert_eq!(description.robot.name(), "arm");
        assert_eq!(description.robot.link(description.tip).name, "link");
        assert!(description.places.urdf.is_none());
        let inputs: Vec<&str> =
            description.inputs.iter().filter_map(|it| it.path.file_name()?.to_str()).collect();
        assert!(inputs.contains(&"options.xml") && inputs.contains(&"arm.xml"), "{inputs:?}");
    }
    let both = first_error(&folder.path().join("both.toml"));
    assert_eq!((both.code.name, both.line_column()), ("robot_file::urdf", Some((2, 15))));
    assert!(first_error(&folder.path().join("gone.toml")).message.starts_with("description = \"gone.xml\""));
}

#[test]
fn the_text_alone_is_a_robot_unless_it_includes_files() {
    let source = |text: String| SourceFile { path: "arm.xml".into(), text, is_foreign: false }.into();
    assert_eq!(parse_robot(None, &source(arm(""))).expect("the golden has it").robot.dof(), 1);
    let refused = parse_robot(None, &source(arm("<include file='a.xml'/>"))).unwrap_err();
    assert_eq!(refused[0].code.name, "mjcf::include");
}

#[test]
fn what_cannot_be_read_is_named_with_its_place() {
    let cycle = "<mujocoinclude><include file='cycle.xml'/></mujocoinclude>";
    for (inside, code, line) in [
        ("\n<include file='cycle.xml'/>", "mjcf::include", 1),
        ("\n<include file='gone.xml'/>", "file::not_found", 2),
        ("\n<include file='../../../../../../etc/hostname'/>", "", 2),
        ("\n<asset/>\n<nonsense/>", "mjcf::unknown_element", 3),
    ] {
        let folder = folder(&[("arm.xml", &arm(inside)), ("cycle.xml", cycle)]);
        let found = first_error(&folder.path().join("arm.xml"));
        assert!(code.is_empty() || found.code.name == code, "{found:#?}");
        assert_eq!(found.line_column().map(|(line, _)| line), Some(line), "{found:#?}");
    }
}

/// `refpos` and `refquat` move the vertices of the file, and `scale` what has been moved: centres and principal moments of MuJoCo 4.0.
#[test]
fn a_mesh_is_moved_before_it_is_scaled() {
    let cases = [
        (
            "refpos='.1 0 0'",
            [0.114_366_160_450, 0.237_078_026_032, 0.382_272_920_329],
            [0.005_024_676_550, 0.003_886_148_147, 0.001_589_175_302],
        ),
        (
            "refpos='.1 0 0' refquat='0.9 0.1 0.2 0.3'",
            [0.124_451_607_718, 0.229_002_504_988, 0.384_970_085_398],
            [0.004_649_508_072, 0.003_230_539_739, 0.001_874_024_209],
        ),
    ];
    for (moved, com_m, moments_kg_m2) in cases {
        let text = format!(
            "<mujoco><asset><mesh name='w' vertex='0 0 0 1 0 0 0 1 0 0 0 1' scale='.1 .2 .3' {moved}/></asset><worldbody>\
             <body name='b'><joint name='j'/><geom type='mesh' mesh='w' pos='.1 .2 .3' euler='10 20 30'/></body></worldbody></mujoco>"
        );
        let folder = folder(&[("w.xml", &text)]);
        let description = load(&folder.path().join("w.xml"));
        let link = description.robot.link(description.robot.find_link("b").unwrap());
        let inertia = link.inertia.unwrap();
        let com = inertia.link_from_inertial.translation.vector;
        // MuJoCo keeps vertices in single precision.
        assert!((com - Vector3::from(com_m)).norm() < 1e-8, "{moved}: {com}");
        let mut found = inertia.tensor_in_link().symmetric_eigenvalues();
        found.as_mut_slice().sort_by(|a, b| b.total_cmp(a));
        assert!((found - Vector3::from(moments_kg_m2)).norm() < 1e-9, "{moved}: {found}");
        // The shape is where its mass is: the mean of the corners of a tetrahedron.
        let Geometry::Mesh(mesh) = &link.collisions[0].geometry else { panic!("{:?}", link.collisions) };
        let corners =
            mesh.vertices_m.iter().map(|corner| (link.collisions[0].link_from_shape * corner).coords);
        assert!((corners.sum::<Vector3<f64>>() / 4.0 - com).norm() < 1e-12, "{moved}");
    }
}

#[test]
fn a_mesh_that_is_missing_stops_what_needs_it() {
    let robot = |inertial: &str| {
        format!(
            "<mujoco><asset><mesh name='m' file='gone.stl'/></asset><worldbody><body name='b'>{inertial}<joint/>\
             <geom type='mesh' mesh='m'/></body></worldbody></mujoco>"
        )
    };
    let folder = folder(&[("inferred.xml", &robot("")), ("stated.xml", &robot(MASS))]);
    let inferred = load(&folder.path().join("inferred.xml"));
    assert!(inferred.check_capability(Capability::Physics).is_err());
    assert_eq!(inferred.robot.links()[1].inertia, None);
    let stated = load(&folder.path().join("stated.xml"));
    assert_eq!(stated.check_capability(Capability::Physics), Ok(()));
    for description in [inferred, stated] {
        let refused = description.check_capability(Capability::Clearance).unwrap_err();
        assert_eq!((refused[0].code.name, refused[0].line_column()), ("mesh::not_found", Some((1, 37))));
    }
}

#[test]
fn nothing_and_a_free_robot() {
    let free = format!(
        "<mujoco><worldbody><body name='b' pos='0 0 1'><freejoint/>{MASS}<body>{MASS}<joint name='j'/></body></body></worldbody></mujoco>"
    );
    let folder = folder(&[("empty.xml", "<mujoco/>"), ("free.xml", &free)]);
    let empty = load(&folder.path().join("empty.xml"));
    assert_eq!((empty.robot.links().len(), empty.name.as_str()), (1, "empty"));
    let free = load(&folder.path().join("free.xml"));
    assert_eq!((free.robot.dof(), free.warnings[0].code.name), (1, "mjcf::free"));
    assert!((free.robot.joints()[0].parent_from_joint.translation.z - 1.0).abs() < 1e-15);
}
