//! One construct each.

use congruent_mjcf::{MeshMass, MjEqualityKind, MjJointKind, MjMesh, MjModel, MjTarget, mesh_mass};
use nalgebra::{Matrix3, Point3};
use serde_json::Value;

use crate::{
    kinematics::{difference, pose, world_from_bodies},
    shared::{goldens, left_out, numbers, read},
};

const FOLDER: &str = "mjcf-constructs";
/// Poses, m and rad. Kind: rounding; MuJoCo rounds quaternions at 1e-16 in a chain of few bodies. Worst seen 5e-16.
const POSE: f64 = 1e-12;
/// Values of joints and bodies, relative to 1 and to the value. Kind: rounding. Inertias from meshes pass through an
/// eigenvalue decomposition in MuJoCo.
const VALUE: f64 = 1e-9;

/// Whose bodies MuJoCo joins, which is not done here.
const FUSED: &str = "c21-fusestatic";

fn near(found: f64, expected: f64, what: &str) {
    let tolerance = VALUE * expected.abs().max(1.0);
    assert!((found - expected).abs() <= tolerance, "{what}: {found} instead of {expected}");
}

#[test]
fn constructs_are_read_as_mujoco_reads_them() {
    let Some((folder, golden)) = goldens(FOLDER) else { return left_out("constructs") };
    let mut count = 0;
    for (name, case) in golden["cases"].as_object().unwrap().iter().filter(|(name, _)| name.starts_with('c'))
    {
        let (model, found) = read(&folder.join(format!("{name}.xml")));
        let model = model.unwrap_or_else(|| panic!("{name} is refused: {found:?}"));
        check(name, &model, case, &folder);
        count += 1;
    }
    assert_eq!(count, 34);
}

fn check(name: &str, model: &MjModel, case: &Value, folder: &std::path::Path) {
    check_poses(name, model, case);
    check_joints(name, model, case);
    check_references(name, model, case);
    if name != FUSED {
        check_masses(name, model, case, folder);
    }
}

/// Index of the body of a golden: by name, or by order if it has none.
fn body(model: &MjModel, golden: &Value, index: usize) -> usize {
    let name = golden["name"].as_str().filter(|name| !name.is_empty());
    name.map_or(index, |name| model.bodies.iter().position(|body| body.name.text == name).unwrap())
}

fn check_poses(name: &str, model: &MjModel, case: &Value) {
    let bodies = case["bodies"].as_array().unwrap();
    let sites = case["sites"].as_array().unwrap();
    for config in case["configs"].as_array().unwrap() {
        let poses = world_from_bodies(model, &numbers(&config["q"]));
        for (index, expected) in config["bodies"].as_array().unwrap().iter().enumerate() {
            let found = &poses[body(model, &bodies[index], index)];
            let off = difference(found, &pose(&numbers(expected)));
            assert!(off <= POSE, "{name}, body {}: off by {off}", bodies[index]["name"]);
        }
        for (site, expected) in sites.iter().zip(config["sites"].as_array().unwrap()) {
            let found =
                model.sites.iter().find(|found| found.name.text == site["name"].as_str().unwrap()).unwrap();
            let world_from_site = poses[found.body] * found.body_from_site;
            assert!(
                difference(&world_from_site, &pose(&numbers(expected))) <= POSE,
                "{name}, {}",
                found.name
            );
        }
    }
}

fn check_joints(name: &str, model: &MjModel, case: &Value) {
    let joints = case["joints"].as_array().unwrap();
    assert_eq!(model.joints.len(), joints.len(), "{name}");
    for (found, expected) in model.joints.iter().zip(joints) {
        let label = format!("{name}, {}", found.name);
        let written = expected["name"].as_str().filter(|name| !name.is_empty());
        assert_eq!(found.name.is_written.then_some(found.name.text.as_str()), written, "{label}");
        let kind = match found.kind {
            MjJointKind::Hinge => "hinge",
            MjJointKind::Slide => "slide",
            MjJointKind::Ball => "ball",
            MjJointKind::Free => "free",
        };
        assert_eq!(expected["type"].as_str(), Some(kind), "{label}");
        if found.kind.positions() == 1 {
            let pairs =
                [(&found.axis_in_body.value.into_inner(), "axis"), (&found.pos_in_body.value.coords, "pos")];
            for (vector, key) in pairs {
                for (found, expected) in vector.iter().zip(numbers(&expected[key])) {
                    near(*found, expected, &format!("{label}, {key}"));
                }
            }
        }
        for (found, key) in [
            (&found.reference, "ref"),
            (&found.friction_loss, "frictionloss"),
            (&found.armature, "armature"),
            (&found.damping.clone().map(|[linear, ..]| linear), "damping"),
        ] {
            near(found.value, expected[key].as_f64().unwrap_or_default(), &format!("{label}, {key}"));
        }
        let ranges = [(&found.range, "range"), (&found.actuator_force_range, "actuatorfrcrange")];
        for (found, key) in ranges {
            check_range(found.as_ref().map(|range| range.value), &expected[key], &format!("{label}, {key}"));
        }
    }
}

fn check_range(found: Option<[f64; 2]>, expected: &Value, label: &str) {
    assert_eq!(found.is_some(), !expected.is_null(), "{label}: {found:?} instead of {expected}");
    for (found, expected) in found.into_iter().flatten().zip(expected.as_array().into_iter().flatten()) {
        near(found, expected.as_f64().unwrap(), label);
    }
}

fn check_references(name: &str, model: &MjModel, case: &Value) {
    let actuators = case["actuators"].as_array().unwrap();
    assert_eq!(model.actuators.len(), actuators.len(), "{name}");
    for (found, expected) in model.actuators.iter().zip(actuators) {
        assert_eq!(expected["name"].as_str(), Some(found.name.as_str()));
        near(found.gear.value, expected["gear"].as_f64().unwrap(), name);
        let ranges = [(&found.force_range, "forcerange"), (&found.control_range, "ctrlrange")];
        for (range, key) in ranges {
            check_range(
                range.as_ref().map(|range| range.value),
                &expected[key],
                &format!("{name}, {}", found.name),
            );
        }
        let target = match found.target {
            MjTarget::Joint(joint) => Some(("joint", joint)),
            MjTarget::Tendon(tendon) => Some(("tendon", tendon)),
            MjTarget::Other => None,
        };
        let (kind, index) = target.unwrap();
        assert_eq!(
            (expected["transmission"].as_str(), expected["target"].as_u64()),
            (Some(kind), Some(index as u64))
        );
    }
    let equalities = case["equalities"].as_array().unwrap();
    assert_eq!(model.equalities.len(), equalities.len(), "{name}");
    for (found, expected) in model.equalities.iter().zip(equalities) {
        assert_eq!(expected["active"].as_bool(), Some(found.is_active));
        let ends = match &found.kind {
            MjEqualityKind::Joint { follower, leader, coefficients } => {
                assert_eq!(numbers(&expected["polycoef"]), coefficients.value, "{name}");
                [Some(*follower), *leader]
            }
            MjEqualityKind::Connect { bodies } | MjEqualityKind::Weld { bodies } => bodies.map(Some),
            MjEqualityKind::Tendon { .. } => [None; 2],
        };
        let index = |end: Option<usize>| end.map_or(-1, |end| i64::try_from(end).unwrap());
        assert_eq!(
            [&expected["obj1"], &expected["obj2"]].map(Value::as_i64),
            ends.map(|end| Some(index(end)))
        );
    }
    for (found, expected) in model.keyframes.iter().zip(case["keyframes"].as_array().unwrap()) {
        assert_eq!(found.positions.as_ref().unwrap().value, numbers(&expected["qpos"]));
    }
}

fn check_masses(name: &str, model: &MjModel, case: &Value, folder: &std::path::Path) {
    let bodies = case["bodies"].as_array().unwrap();
    assert_eq!(model.bodies.len(), bodies.len(), "{name}");
    let mut of_mesh = |mesh: &MjMesh| -> Result<MeshMass, congruent_input::Diagnostic> {
        let text = std::fs::read_to_string(folder.join(&mesh.file.as_ref().unwrap().value)).unwrap();
        mesh_mass(mesh, &triangles(mesh, &text))
    };
    let masses = model.mass_properties(&mut of_mesh).unwrap();
    for (index, expected) in bodies.iter().enumerate() {
        let at = body(model, expected, index);
        let (body, found) = (&model.bodies[at], &masses[at]);
        // Hulls are not made here.
        if body.name.text == "l_convex" {
            continue;
        }
        let label = format!("{name}, {}", body.name);
        near(body.gravcomp.value, expected["gravcomp"].as_f64().unwrap(), &label);
        near(found.mass_kg, expected["mass"].as_f64().unwrap(), &label);
        // The centre of nothing has no meaning.
        if found.mass_kg <= 0.0 {
            continue;
        }
        for (found, expected) in found.center_in_body.iter().zip(numbers(&expected["com"])) {
            near(*found, expected, &label);
        }
        let [xx, yy, zz, xy, xz, yz] = numbers(&expected["inertia"]).try_into().unwrap();
        let inertia = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
        let off = (found.inertia_kg_m2 - inertia).norm();
        assert!(
            off <= VALUE * inertia.norm(),
            "{label}: inertia {} instead of {inertia}",
            found.inertia_kg_m2
        );
    }
}

/// The triangles of an OBJ file, in the frame of the mesh.
fn triangles(mesh: &MjMesh, text: &str) -> Vec<[Point3<f64>; 3]> {
    let lines = |kind: &'static str| text.lines().filter_map(move |line| line.strip_prefix(kind));
    let vertices: Vec<Point3<f64>> = lines("v ")
        .map(|line| {
            let numbers: Vec<f64> = line.split_whitespace().map(|token| token.parse().unwrap()).collect();
            mesh.vertex(Point3::from_slice(&numbers))
        })
        .collect();
    let corner = |token: &str| vertices[token.parse::<usize>().unwrap() - 1];
    lines("f ")
        .map(|line| {
            let corners: Vec<Point3<f64>> = line.split_whitespace().map(corner).collect();
            [corners[0], corners[1], corners[2]]
        })
        .collect()
}

#[test]
fn what_mujoco_refuses_is_refused() {
    let Some((folder, golden)) = goldens(FOLDER) else { return left_out("files that MuJoCo refuses") };
    let cases = golden["cases"].as_object().unwrap().iter().filter(|(name, _)| name.starts_with('x'));
    let mut count = 0;
    for (name, case) in cases {
        count += 1;
        let (model, found) = read(&folder.join(format!("{name}.xml")));
        // MuJoCo reads a URDF as well; here that is another reader's work, which the message says.
        let is_read = case["ok"].as_bool().unwrap() && name != "x14-root-is-urdf";
        assert_eq!(model.is_some(), is_read, "{name}: {found:?}");
        for fault in &found {
            assert!(
                fault.line_column().is_some() || fault.source.is_some(),
                "{name}: {fault:?} without a place"
            );
        }
        assert!(!found.is_empty(), "{name} has nothing to say");
    }
    assert_eq!(count, 16);
}
