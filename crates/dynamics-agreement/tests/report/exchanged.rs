//! Values that have changed places: those of two links, and those of one `<limit>`.

use congruent_dynamics_agreement::{DynamicsCause, DynamicsModel, LimitDifference, compare};

use super::{changed, load, parameters, unnamed};

#[test]
fn exchanged_links_are_named_beside_another_fault() {
    let report = changed("ur5e", |model| {
        let [arm, wrist] = ["upper_arm_link", "wrist_2_link"].map(|link| *parameters(model, link));
        *parameters(model, "upper_arm_link") = wrist;
        *parameters(model, "wrist_2_link") = arm;
        parameters(model, "forearm_link").mass_kg *= 1.02;
    });
    let [both] = &report.explanations[..] else { panic!("{:?}", report.explanations) };
    let parts: Vec<_> = both.parts.iter().map(|part| (part.cause, part.place.clone())).collect();
    let expected = [
        (DynamicsCause::Mass, vec!["forearm_link".to_owned()]),
        (DynamicsCause::InertialsSwapped, vec!["upper_arm_link".to_owned(), "wrist_2_link".to_owned()]),
    ];
    assert!(parts.len() == 2 && expected.iter().all(|part| parts.contains(part)), "{parts:?}");
}

#[test]
fn limits_that_have_changed_places_are_said_to_be_exchanged() {
    let reference = DynamicsModel::new(&load("panda").robot);
    let mut candidate = reference.clone();
    let limit = candidate.limits[3].as_mut().expect("a limit");
    std::mem::swap(&mut limit.velocity, &mut limit.effort);
    (limit.lower, limit.upper) = (-limit.upper, -limit.lower);
    // Both are off, and neither has the value of the other.
    candidate.limits[4].as_mut().expect("a limit").velocity = Some(1.25);
    candidate.limits[4].as_mut().expect("a limit").effort = Some(3.5);
    let report = compare(&unnamed(&candidate), &unnamed(&reference), 1).expect("one chain");
    let details: Vec<&str> = report.limits.iter().map(|limit| limit.detail.as_str()).collect();
    assert_eq!(details, ["exchanged", "exchanged", "exchanged", "exchanged", "", ""]);
    let sentences: Vec<String> = report.limits.iter().map(LimitDifference::sentence).collect();
    assert!(sentences[0].ends_with(": effort and velocity are exchanged"), "{sentences:?}");
    assert!(sentences[2].ends_with(": lower and upper are exchanged, with their signs"), "{sentences:?}");
}
