//! The report as a person reads it: parameters, lines of the file, sentences, several faults.

#[path = "../../../../tests/support/corpus.rs"]
mod corpus;
mod exchanged;
mod fixed_links;

use congruent_description::{RobotDescription, load_robot, parse_urdf};
use congruent_dynamics_agreement::{
    CompareError, DynamicsCause, DynamicsExplanation, DynamicsModel, DynamicsReport, DynamicsVerdict,
    Inertial, NamedModel, certify, compare,
};
use fixed_links::{SECOND, arm_with_fixed_link};
use nalgebra::{Matrix3, Rotation3};

fn load(name: &str) -> RobotDescription {
    let path = corpus::workspace().join("robots").join(name);
    load_robot(&path).unwrap_or_else(|findings| panic!("{findings:#?}"))
}

/// A robot with changes against itself without.
fn changed(name: &str, change: impl Fn(&mut DynamicsModel)) -> DynamicsReport {
    let description = load(name);
    let reference = DynamicsModel::new(&description.robot);
    let mut candidate = reference.clone();
    change(&mut candidate);
    let places = description.places.urdf.as_ref().map(|places| places as _);
    let candidate = NamedModel { name: "changed", model: &candidate, places };
    let reference = NamedModel { name: "original", model: &reference, places: None };
    let mut report = compare(&candidate, &reference, 1).expect("one chain");
    report.certificates = Some(certify(&candidate, &reference, 1).expect("one chain"));
    report
}

fn parameters<'a>(model: &'a mut DynamicsModel, link: &str) -> &'a mut Inertial {
    let link = model.frames().find_link(link).expect("a link");
    model.inertials[link].as_mut().expect("an inertial")
}

fn causes(explanations: &[DynamicsExplanation]) -> Vec<(DynamicsCause, &str)> {
    explanations.iter().map(|explanation| (explanation.cause, explanation.place[0].as_str())).collect()
}

#[test]
fn a_fault_has_its_line_its_parameters_and_its_sentence() {
    let right = load("ur5e");
    let text = std::fs::read_to_string(&right.urdf_path).expect("it is there");
    let text = text.replace(r#"<origin xyz="-0.2422 0 0.0265""#, r#"<origin xyz="-242.2 0 26.5""#);
    let path = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("forearm_in_mm.urdf");
    std::fs::write(&path, text).expect("a file for tests");
    let wrong = load_robot(&path).unwrap_or_else(|findings| panic!("{findings:#?}"));
    let [candidate, reference] = [&wrong, &right].map(|of| DynamicsModel::new(&of.robot));
    let places = wrong.places.urdf.as_ref().map(|places| places as _);
    let candidate = NamedModel { name: "wrong", model: &candidate, places };
    let mut report = compare(&candidate, &unnamed(&reference), 1).expect("one chain");
    report.certificates = Some(certify(&candidate, &unnamed(&reference), 1).expect("one chain"));
    let [explanation] = &report.explanations[..] else { panic!("{:?}", report.explanations) };
    assert_eq!(explanation.sentence(), "forearm_link: the centre of mass is given in another unit (mm)");
    let path = explanation.file.as_deref().expect("the file of the candidate");
    let text = std::fs::read_to_string(path).expect("it is there");
    let line = text.lines().nth(explanation.line.expect("a line") - 1).expect("it has the line");
    assert!(line.contains("<origin"), "{line}");
    let [change] = &explanation.changes[..] else { panic!("{:?}", explanation.changes) };
    assert!(change.text.contains(r#"<origin xyz="-0.2422 0"#), "{}", change.text);
    let suggestion = explanation.suggestion.as_deref().expect("what to write");
    assert!(suggestion.starts_with("forearm_link: com_x = "), "{suggestion}");
    let mass = report.invariants.as_ref().expect("both are descriptions").total_mass_kg;
    assert!((mass.found - mass.expected).abs() < 1e-12);
    let worst = report
        .certificates
        .as_ref()
        .and_then(|of| of.gravity.worst.as_ref())
        .expect("a difference of gravity torque");
    assert_eq!(worst.joint, "shoulder_lift_joint");
    assert!(worst.sentence().contains("certified below"), "{}", worst.sentence());
    assert_eq!(
        report.identifiability_sentence().as_deref(),
        Some("joint torques depend on 36 combinations of the 60 inertial parameters")
    );
}

/// A vendor's centre of mass, which is published in the frame of the table.
#[test]
fn a_centre_of_mass_in_a_dh_frame_is_named_with_the_table() {
    let description = load("ur5e");
    assert!(description.dh.is_some(), "the robot file has a table");
    let reference = DynamicsModel::from_description(&description).expect("the table is the robot's");
    let mut found = Vec::new();
    for link in ["upper_arm_link", "forearm_link", "wrist_1_link"] {
        let mut candidate = reference.clone();
        let link_from_dh = reference.frames().dh_frame(link).expect("its joint has a row");
        let right = parameters(&mut candidate, link).com_m;
        parameters(&mut candidate, link).com_m =
            link_from_dh.rotation.transpose() * (right - link_from_dh.translation);
        let report = compare(&unnamed(&candidate), &unnamed(&reference), 1).expect("one chain");
        let explanation = &report.explanations[0];
        let names = std::iter::once((explanation.cause, explanation.detail.clone()));
        let also = explanation.also_named.iter().map(|also| (also.cause, also.detail.clone()));
        found.extend(names.chain(also).filter(|(cause, _)| *cause == DynamicsCause::ComFrame));
        assert_eq!(explanation.place, [link], "{:?}", report.explanations);
    }
    let details: Vec<&str> = found.iter().map(|(_, detail)| detail.as_str()).collect();
    for detail in ["dh2", "dh3", "dh4"] {
        assert!(details.contains(&detail), "{details:?}");
    }
}

/// Beside a tensor that is 1e9 times too large the other fault is below rounding.
#[test]
fn a_small_fault_beside_a_huge_one_is_named() {
    let report = changed("ur5e", |model| {
        parameters(model, "forearm_link").tensor_kg_m2 *= 1e9;
        parameters(model, "wrist_2_link").com_m.y += 0.013;
    });
    let [explanation] = &report.explanations[..] else { panic!("{:?}", report.explanations) };
    let parts: Vec<_> = explanation.parts.iter().map(|part| (part.cause, part.place[0].as_str())).collect();
    assert_eq!(
        parts,
        [(DynamicsCause::InertiaUnit, "forearm_link"), (DynamicsCause::ComEntry, "wrist_2_link")]
    );
}

#[test]
fn a_parameter_without_effect_on_torques_is_reported_with_both_values() {
    let report = changed("ur5e", |model| {
        let parameters = parameters(model, "shoulder_link");
        parameters.com_m.z = 0.0123;
    });
    assert_eq!(report.verdict, DynamicsVerdict::SameTorques);
    let sentences = report.hidden_sentences(None);
    assert_eq!(sentences.len(), 1, "{sentences:?}");
    assert!(sentences[0].starts_with("shoulder_link: com_z is 12.3 mm, expected "), "{sentences:?}");
    assert!(sentences[0].ends_with("it has no effect on joint torques"), "{sentences:?}");
}

#[test]
fn two_faults_are_named_together_and_more_link_by_link() {
    let two = |model: &mut DynamicsModel| {
        parameters(model, "forearm_link").mass_kg *= 1.25;
        parameters(model, "wrist_2_link").com_m.y *= -1.0;
    };
    let report = changed("ur5e", two);
    let [explanation] = &report.explanations[..] else { panic!("{:?}", report.explanations) };
    assert_eq!(explanation.cause, DynamicsCause::Several);
    let mut parts: Vec<(DynamicsCause, &str)> =
        explanation.parts.iter().map(|part| (part.cause, part.place[0].as_str())).collect();
    parts.sort();
    assert_eq!(parts, [(DynamicsCause::ComSign, "wrist_2_link"), (DynamicsCause::Mass, "forearm_link")]);
    let report = changed("ur5e", |model| {
        two(model);
        parameters(model, "upper_arm_link").tensor_kg_m2 *= 1e6;
        let joint = model.frames().find_joint("elbow_joint").expect("a joint");
        model.resistances[joint].damping = 0.7;
    });
    assert_eq!(report.verdict, DynamicsVerdict::Explained);
    // By what each changes of the torques, as a share of what the joints can exert: the mass of the forearm before that of a wrist.
    assert_eq!(
        causes(&report.explanations),
        [
            (DynamicsCause::InertiaUnit, "upper_arm_link"),
            (DynamicsCause::Mass, "forearm_link"),
            (DynamicsCause::ComSign, "wrist_2_link"),
            (DynamicsCause::Damping, "elbow_joint"),
        ]
    );
}

#[test]
fn a_parameter_that_is_no_bodys_is_still_explained() {
    let report = changed("panda", |model| {
        // The six numbers in the order of another format: no body has such a tensor.
        let tensor = &mut parameters(model, "panda_hand").tensor_kg_m2;
        let t = *tensor;
        *tensor = Matrix3::new(
            t[(0, 0)],
            t[(1, 1)],
            t[(2, 2)], //
            t[(1, 1)],
            t[(0, 1)],
            t[(0, 2)], //
            t[(2, 2)],
            t[(0, 2)],
            t[(1, 2)],
        );
    });
    assert_eq!(report.explanations[0].cause, DynamicsCause::InertiaOrder, "{:?}", report.explanations);
    assert!(report.explanations[0].is_a_body);
}

/// The rotation of the other description is known: it needs no free parameter.
#[test]
fn a_rotation_of_an_inertial_frame_that_is_left_out_is_named() {
    let turned = |link: &str| {
        let mut reference = DynamicsModel::new(&load("ur5e").robot);
        let turn = Rotation3::from_euler_angles(0.3, -0.7, 1.1).into_inner();
        let inertial = parameters(&mut reference, link);
        inertial.tensor_kg_m2 = Matrix3::new(0.3, 0.01, 0.02, 0.01, 0.25, -0.03, 0.02, -0.03, 0.2);
        inertial.link_from_axes = turn;
        let mut candidate = reference.clone();
        parameters(&mut candidate, link).link_from_axes = Matrix3::identity();
        (candidate, reference)
    };
    for link in ["shoulder_link", "upper_arm_link", "forearm_link", "wrist_1_link", "wrist_3_link"] {
        let (candidate, reference) = turned(link);
        let report = compare(&unnamed(&candidate), &unnamed(&reference), 1).expect("one chain");
        assert_eq!(causes(&report.explanations), [(DynamicsCause::RpyMissing, link)]);
        assert!(!report.explanations[0].contradicted);
        let report = compare(&unnamed(&reference), &unnamed(&candidate), 1).expect("one chain");
        assert_eq!(causes(&report.explanations), [(DynamicsCause::Rpy, link)]);
    }
}

#[test]
fn two_faults_of_one_link_are_named_without_a_third() {
    let report = changed("ur5e", |model| {
        let wrong = parameters(model, "forearm_link");
        wrong.mass_kg *= 1000.0;
        wrong.com_m = -wrong.com_m;
    });
    let [explanation] = &report.explanations[..] else { panic!("{:?}", report.explanations) };
    assert_eq!(
        explanation.parts.iter().map(|part| part.cause).collect::<Vec<_>>(),
        [DynamicsCause::MassUnit, DynamicsCause::ComSign]
    );
    assert_eq!(explanation.place, ["forearm_link"]);
    assert!(explanation.parameters.iter().all(|of| !of.parameter.starts_with('i')), "{explanation:?}");
}

#[test]
fn a_difference_below_the_resolution_is_said_to_be_so() {
    let report = changed("ur5e", |model| parameters(model, "upper_arm_link").tensor_kg_m2 *= 1.0 + 2e-9);
    let sentences = report.hidden_sentences(None);
    assert_eq!(report.verdict, DynamicsVerdict::SameTorques, "{}", report.difference_relative);
    assert!(
        sentences.iter().any(|sentence| sentence.contains("below the resolution of 1.0e-10")),
        "{sentences:?}"
    );
    let shares = report.hidden_differences.iter().filter_map(|of| of.below_resolution);
    assert!(shares.clone().count() > 0 && shares.clone().all(|share| share < 1e-10), "{sentences:?}");
}

/// The same arm with the frame of its second link turned and shifted along the joint's axis.
#[test]
fn inertias_are_expressed_in_other_link_frames() {
    let text = |second: &str, axis: &str, fixed: &str, inertial: &str| {
        format!(
            r#"<robot name="arm"><link name="base"/>
            <link name="first"><inertial><mass value="4"/>
              <inertia ixx="0.02" iyy="0.03" izz="0.012" ixy="0" ixz="0.001" iyz="0"/></inertial></link>
            <link name="second"><inertial>{inertial}<mass value="3"/>
              <inertia ixx="0.02" iyy="0.03" izz="0.025" ixy="0.001" ixz="0" iyz="0"/></inertial></link>
            <link name="fixed"><inertial><origin xyz="0.05 0.02 0.03"/><mass value="0.8"/>
              <inertia ixx="0.003" iyy="0.002" izz="0.002" ixy="0.0001" ixz="0" iyz="0"/></inertial></link>
            <joint name="j1" type="continuous"><parent link="base"/><child link="first"/><axis xyz="0 0 1"/></joint>
            <joint name="j2" type="continuous"><parent link="first"/><child link="second"/>
              <origin {second}/><axis xyz="{axis}"/></joint>
            <joint name="f" type="fixed"><parent link="second"/><child link="fixed"/><origin {fixed}/></joint>
            </robot>"#
        )
    };
    let model =
        |text: &str| DynamicsModel::new(&parse_urdf(text).unwrap_or_else(|findings| panic!("{findings:#?}")));
    let here =
        model(&text(r#"xyz="0 0 0.2""#, "0 1 0", r#"xyz="0.3 0 0.1""#, r#"<origin xyz="0.2 0.01 0"/>"#));
    // Turned by a quarter about x: what was y is z there, and its origin is 0.1 m further along the axis.
    let there = model(&text(
        r#"xyz="0 0.1 0.2" rpy="-1.5707963267948966 0 0""#,
        "0 0 1",
        r#"xyz="0.3 -0.1 -0.1" rpy="1.5707963267948966 0 0""#,
        r#"<origin xyz="0.2 0 -0.09" rpy="1.5707963267948966 0 0"/>"#,
    ));
    let seen = there.in_frames_of(&here).expect("the same joints");
    let report = compare(&unnamed(&here), &unnamed(&seen), 1).expect("one chain");
    assert!(report.has_same_torques() && report.difference_relative < 1e-14, "{report:?}");
    let report = compare(&unnamed(&here), &unnamed(&there), 1).expect("joints of the same names");
    assert!(!report.has_same_torques(), "as they are written they differ");
}

fn unnamed(model: &DynamicsModel) -> NamedModel<'_> {
    NamedModel { name: "", model, places: None }
}

#[test]
fn an_armature_that_neither_description_has_is_no_cause() {
    let reference = arm_with_fixed_link(SECOND);
    let mut candidate = reference.clone();
    // Of the first link torques show one moment only, as they would of an armature.
    parameters(&mut candidate, "first").tensor_kg_m2 *= 2.0;
    let report = compare(&unnamed(&candidate), &unnamed(&reference), 1).expect("one chain");
    assert_eq!(report.explanations[0].place, ["first"], "{:?}", report.explanations);
    let mut all = report.explanations.iter().chain(&report.indistinguishable);
    assert!(all.all(|of| of.cause != DynamicsCause::Armature), "{report:?}");
}

#[test]
fn damping_and_friction_of_one_joint_are_named_together() {
    let candidate = arm_with_fixed_link(SECOND);
    let mut reference = candidate.clone();
    (reference.resistances[1].damping, reference.resistances[1].friction) = (1.0, 0.5);
    let report = compare(&unnamed(&candidate), &unnamed(&reference), 1).expect("one chain");
    let [explanation] = &report.explanations[..] else { panic!("{:?}", report.explanations) };
    let parameters =
        explanation.parameters.iter().map(|parameter| (parameter.of.as_str(), parameter.parameter.as_str()));
    assert_eq!(parameters.collect::<Vec<_>>(), [("j2", "damping"), ("j2", "friction")]);
    let expected = explanation.parameters.iter().filter_map(|parameter| parameter.expected);
    for (expected, value) in expected.zip([1.0, 0.5]) {
        assert!((expected - value).abs() < 1e-9, "{expected}");
    }
}

#[test]
fn values_that_differ_in_a_late_digit_are_printed_with_all_digits() {
    let reference = arm_with_fixed_link(SECOND);
    let mut candidate = reference.clone();
    parameters(&mut candidate, "second").mass_kg = 3.000_001;
    let report = compare(&unnamed(&candidate), &unnamed(&reference), 1).expect("one chain");
    let sentence = report.explanations[0].parameters[0].sentence();
    assert!(sentence.starts_with("second: mass is 3.000001 kg, expected "), "{sentence}");
}

/// A limit that one description does not state: a range decides, speed and effort are remarks.
#[test]
fn a_limit_on_one_side_is_said() {
    let reference = DynamicsModel::new(&load("ur5e").robot);
    let mut candidate = reference.clone();
    candidate.limits[0].as_mut().expect("a limit").velocity = None;
    candidate.limits[1].as_mut().expect("a limit").effort = Some(0.0);
    let report = compare(&unnamed(&candidate), &unnamed(&reference), 1).expect("one chain");
    let limits = || report.limits.iter();
    let found: Vec<_> = limits().map(|of| (of.parameter.as_str(), of.found, of.decides)).collect();
    assert_eq!(found, [("velocity", None, false), ("effort", None, false)]);
    assert!(report.agrees() && report.limit_sentences(None).is_empty());
    // One sentence for each kind, whatever the number of joints.
    for limit in candidate.limits.iter_mut().flatten() {
        limit.velocity = None;
    }
    let silent = compare(&unnamed(&candidate), &unnamed(&reference), 1).expect("one chain");
    let [velocity, effort] = &silent.one_sided_limit_sentences()[..] else { panic!("{silent:?}") };
    let start = "not compared: velocity limits of 6 joints, stated by ";
    assert!(velocity.starts_with(start) && velocity.ends_with(", wrist_3_joint"), "{velocity}");
    assert!(effort.starts_with("not compared: effort limits of 1 joint, stated by "), "{effort}");
    let endless = candidate.limits[2].as_mut().expect("a limit");
    (endless.lower, endless.upper) = (f64::NEG_INFINITY, f64::INFINITY);
    let report = compare(&unnamed(&candidate), &unnamed(&reference), 1).expect("one chain");
    let decisive: Vec<_> =
        report.limits.iter().filter(|of| of.decides).map(|of| of.parameter.as_str()).collect();
    assert_eq!(decisive, ["lower", "upper"]);
    assert!(!report.agrees());
}

#[test]
fn an_armature_of_one_description_is_taken_out_whole() {
    let reference = arm_with_fixed_link(SECOND);
    let mut candidate = reference.clone();
    (candidate.resistances[0].armature, candidate.resistances[1].armature) = (0.37, 0.1);
    let report = compare(&unnamed(&candidate), &unnamed(&reference), 1).expect("one chain");
    assert_eq!(report.explanations[0].cause, DynamicsCause::Armature);
    let expected: Vec<_> =
        report.explanations[0].parameters.iter().map(|parameter| parameter.expected).collect();
    assert_eq!(expected, [Some(0.0); 2]);
}

#[test]
fn inputs_that_cannot_be_compared_are_refused() {
    let (ur5e, panda) = (DynamicsModel::new(&load("ur5e").robot), DynamicsModel::new(&load("panda").robot));
    let error = compare(&unnamed(&ur5e), &unnamed(&panda), 1).expect_err("other joints");
    assert!(matches!(error, CompareError::Joint { .. }), "{error}");
    let mut endless = ur5e.clone();
    parameters(&mut endless, "forearm_link").mass_kg = f64::NAN;
    let error = compare(&unnamed(&endless), &unnamed(&ur5e), 1).expect_err("no number");
    let CompareError::NotFinite { what, value } = error else { panic!("{error}") };
    assert_eq!((what.as_str(), value.is_nan()), ("link \"forearm_link\": mass", true));
    parameters(&mut endless, "forearm_link").mass_kg = 1e300;
    let error = compare(&unnamed(&ur5e), &unnamed(&endless), 1).expect_err("overflows");
    assert!(error.to_string().contains("forearm_link\": mass = 1e300"), "{error}");
}

#[test]
fn the_report_is_json() {
    let report = changed("ur5e", |model| model.gravity_m_s2.z = -9.80665);
    let json = serde_json::to_value(&report).expect("it is plain data");
    assert_eq!(json["verdict"], "explained");
    assert_eq!(json["explanations"][0]["cause"], "gravity_magnitude");
    assert_eq!(json["explanations"][0]["place"][0], "gravity");
    assert_eq!(json["seen"]["numbers"], 36);
    assert!(json["where"].is_array() && json["certificates"]["gravity"]["worst"].is_object());
}
