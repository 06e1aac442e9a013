//! Mass matrices of MJCF with armature against `MuJoCo`: that of joints, and that which motors add behind their gears.

#[path = "../../../../tests/support/corpus.rs"]
mod corpus;

use congruent_description::{RobotQ, load_robot};
use congruent_dynamics::BodyTree;
use nalgebra::DMatrix;
use serde_json::Value;

/// Largest difference relative to the largest entry of a matrix. Kind: rounding, ours and the other program's; worst seen 1e-15.
const RELATIVE: f64 = 1e-9;

/// Made by `mass_matrices.py`, whose name and version of `MuJoCo` are in it.
const GOLDEN: &str = include_str!("golden.json");

const HERE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/armature");

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().expect("an array").iter().map(|number| number.as_f64().expect("a number")).collect()
}

#[test]
fn mass_matrices_have_the_armature_of_joints_and_motors() {
    let golden: Value = serde_json::from_str(GOLDEN).expect("the file is JSON");
    let corpus = corpus::corpus();
    for case in golden["cases"].as_array().expect("a list of cases") {
        let name = case["file"].as_str().expect("the name of a file");
        // A file beside this one needs no corpus.
        let folder = if name.contains('/') { corpus.clone() } else { Some(HERE.into()) };
        let Some(folder) = folder else { continue };
        let robot = load_robot(&folder.join(name)).unwrap_or_else(|found| panic!("{name}: {found:#?}")).robot;
        let joints = case["joints"].as_array().expect("names of joints");
        let place = |name: &str| joints.iter().position(|known| known == name).expect("both have the joint");
        let places: Vec<usize> = robot.movable_joint_names().map(place).collect();
        assert_eq!(places.len(), joints.len(), "{name}");
        let tree = BodyTree::new(&robot);
        assert!(tree.resistances().iter().any(|of| of.armature > 0.0), "{name} has an armature");
        for state in case["states"].as_array().expect("a list of states") {
            let q = numbers(&state["q"]);
            let q: RobotQ = places.iter().map(|&place| q[place]).collect();
            let mut found = DMatrix::zeros(tree.dof(), tree.dof());
            tree.mass_matrix_into(&q, &mut tree.buffer(), &mut found).unwrap();
            let expected = state["mass_matrix"].as_array().expect("rows").iter().map(numbers);
            let expected: Vec<Vec<f64>> = expected.collect();
            let expected =
                DMatrix::from_fn(tree.dof(), tree.dof(), |row, column| expected[places[row]][places[column]]);
            let off = (found - &expected).amax() / expected.amax();
            assert!(off < RELATIVE, "{name}: mass matrices differ by {off:e}");
        }
    }
}
