//! Chains of many joints: what is compared of them, what is not, and at which cost.

use crate::{calibration::Bench, command::congruent};

/// A URDF of a chain of so many revolute joints, its axes in turn along x, y and z.
fn chain(joints: usize) -> String {
    let axes = ["0 0 1", "0 1 0", "1 0 0"];
    let link = |at: usize| {
        format!(
            "<link name=\"l{at}\"><inertial><mass value=\"0.5\"/><inertia ixx=\"0.01\" iyy=\"0.01\" izz=\"0.01\" ixy=\"0\" ixz=\"0\" \
             iyz=\"0\"/></inertial></link>\n"
        )
    };
    let joint = |at: usize| {
        let [x, y, z] = [7, 11, 13].map(|prime| 0.01 * f64::from(u32::try_from(at * prime % 9).unwrap()));
        format!(
            "<joint name=\"j{at}\" type=\"revolute\"><parent link=\"l{}\"/><child link=\"l{at}\"/><origin xyz=\"{x} {y} {z}\"/>\
             <axis xyz=\"{}\"/><limit lower=\"-2\" upper=\"2\" effort=\"10\" velocity=\"2\"/></joint>\n",
            at - 1,
            axes[at % 3]
        )
    };
    let links: String = (0..=joints).map(link).collect();
    let joints: String = (1..=joints).map(joint).collect();
    format!("<robot name=\"chain\">\n{links}{joints}</robot>\n")
}

#[test]
fn torques_of_many_joints_are_not_compared_which_is_no_disagreement() {
    let bench = Bench::new();
    let urdf = bench.write("chain.urdf", &chain(70));
    let found = congruent(&["check", &urdf, "--against", &urdf, "--format", "json"]);
    let report = found.json();
    assert_eq!((found.code, &report["verdict"]), (0, &"agree".into()), "{}", found.stderr);
    let not_asked = report["not_asked"].as_array().unwrap();
    assert!(not_asked.iter().any(|of| of["source"] == "other_dynamics"), "{not_asked:?}");
    assert!(report["against"]["dynamics_not_compared"].is_null());
}
