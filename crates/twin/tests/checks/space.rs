//! `contact`: which pair, when, how deep.

use std::collections::BTreeMap;

use congruent_monitors::verdict::{CheckResult, Status};
use congruent_scenario::{
    Check, ContactCheck, MotionSettings, ObstacleSettings, PathPoseSettings, ZoneCheck, ZoneSettings,
};
use congruent_twin::RunSetup;

use crate::support::{arm, controlled, measure, notes, passes, result, scenario, setup, worst};

/// The finger, a ball of 50 mm, slides from 20 mm to 90 mm out and stays; the block's face is 60 mm away from the middle
/// of the ball at its start.
fn slid(check: ContactCheck) -> RunSetup {
    let mut scenario = scenario(controlled("kinematic", 0.0, 0.0), Check::Contact(check));
    scenario.start.joints_rad.clear();
    if let MotionSettings::Joints(motion) = &mut scenario.motion[0] {
        motion.move_joints_rad.clear();
        motion.move_joints_m = BTreeMap::from([("grip".to_owned(), 0.09)]);
        motion.profile = congruent_scenario::Profile::Linear;
    }
    // The ball's middle is 1.05 m out, at y = 0.05 m + q.
    scenario.obstacle = vec![ObstacleSettings {
        name: "block".to_owned(),
        box_m: Some([0.2, 0.2, 0.2]),
        xyz_m: Some([1.05, 0.23, 0.0]),
        ..ObstacleSettings::default()
    }];
    setup(scenario, &arm(&[]))
}

#[test]
fn a_contact_has_its_pair_its_time_and_its_depth() {
    let result = result(&slid(ContactCheck::default()));
    assert_eq!(result.status, Status::Fail, "{result:#?}");
    let [contact] = &result.contacts[..] else { panic!("{result:#?}") };
    assert_eq!(contact.pair, ["finger", "block"].map(str::to_owned));
    // The ball reaches y = 0.1 m + q and the block begins at 0.13 m: they touch from q = 0.03 m on, after a seventh of the
    // path, and stay 60 mm in.
    let began_s = 0.8 / 7.0;
    assert!((contact.from_s - began_s).abs() < 1.5e-3, "{contact:?}");
    assert_eq!(contact.until_s, 1.2);
    assert!((contact.depth_m - 0.06).abs() < 1e-6, "{contact:?}");
    let violation = measure(&result, "distance").first_violation.as_ref().unwrap();
    assert_eq!((violation.subject.as_str(), violation.time_s), ("finger--block", contact.from_s));
}

#[test]
fn a_depth_that_is_allowed_is_no_violation() {
    let deep = |depth_mm| ContactCheck { depth_mm: Some(depth_mm), ..ContactCheck::default() };
    let allowed = result(&slid(deep(61.0)));
    passes(&allowed);
    assert_eq!(allowed.contacts.len(), 1);
    let too_deep = result(&slid(deep(30.0)));
    assert_eq!(too_deep.status, Status::Fail);
    // 30 mm deep at q = 0.06 m, after four sevenths of the path.
    let violation = measure(&too_deep, "distance").first_violation.clone().unwrap();
    assert!((violation.time_s - 0.8 * 4.0 / 7.0).abs() < 1.5e-3, "{violation:?}");
}

/// The same under the physics: the slide pushes the block, whose face is in its path, with the force of its controller.
fn pushed(check: ContactCheck) -> CheckResult {
    let mut scenario = slid(check).scenario;
    scenario.controller = controlled("pd", 400.0, 60.0);
    result(&setup(scenario, &arm(&[])))
}

#[test]
fn the_force_on_an_obstacle_has_a_peak_an_impulse_and_a_limit() {
    let report = pushed(ContactCheck::default());
    assert_eq!(report.status, Status::Fail, "{report:#?}");
    let load = report.contacts.iter().find_map(|contact| contact.force).expect("the physics knows the force");
    let contact = report.contacts.iter().find(|contact| contact.force.is_some()).unwrap();
    assert!((contact.from_s..=contact.until_s).contains(&load.peak_s), "{contact:?}");
    let most_n_s = load.peak_n * (contact.until_s - contact.from_s + 1e-3);
    assert!(load.peak_n > 0.0 && load.impulse_n_s > 0.0 && load.impulse_n_s <= most_n_s, "{contact:?}");
    let limited = |force_n| pushed(ContactCheck { force_n: Some(force_n), ..ContactCheck::default() });
    // With a force that is allowed the two may touch.
    passes(&limited(load.peak_n * 1.01));
    let too_hard = limited(load.peak_n * 0.99);
    assert_eq!(too_hard.status, Status::Fail, "{too_hard:#?}");
    let worst = measure(&too_hard, "contact_force").worst.clone().unwrap();
    assert_eq!((worst.value, worst.time_s), (load.peak_n, load.peak_s));
    // Playback has no forces: nothing was checked.
    let check = ContactCheck { force_n: Some(1.0), ..ContactCheck::default() };
    assert_eq!(result(&slid(check)).status, Status::Skipped);
}

/// A cart runs 150 mm into the fixed base, which cannot yield: the physics has no force for the two, which is not one of 0 N.
#[test]
fn an_overlap_without_a_force_is_not_within_a_limit_of_the_force() {
    let shape =
        "<link name=\"base\"><collision><geometry><box size=\"0.2 0.2 0.2\"/></geometry></collision></link>";
    let into_base = |check: ContactCheck, end_m: f64| {
        let mut scenario = scenario(controlled("pd", 400.0, 60.0), Check::Contact(check));
        let at = |(at_s, x_m): (f64, f64)| PathPoseSettings {
            at_s,
            xyz_m: Some([x_m, 0.0, 0.0]),
            ..PathPoseSettings::default()
        };
        scenario.obstacle = vec![ObstacleSettings {
            name: "cart".to_owned(),
            box_m: Some([0.2, 0.2, 0.2]),
            path: [(0.0, -0.4), (1.0, end_m)].map(at).into(),
            ..ObstacleSettings::default()
        }];
        result(&setup(scenario, &arm(&[("<link name=\"base\"/>", shape)])))
    };
    let limited = || ContactCheck { force_n: Some(1.0), ..ContactCheck::default() };
    let pressed = into_base(limited(), -0.05);
    assert_eq!(pressed.status, Status::Fail, "{pressed:#?}");
    // First of the two distances: that of links has no violation.
    let violation = measure(&pressed, "distance").first_violation.as_ref().unwrap();
    assert_eq!(violation.subject, "base--cart");
    assert!((worst(&pressed, "distance") + 0.15).abs() < 1e-6, "{pressed:#?}");
    assert_eq!(pressed.contacts[0].force, None, "{pressed:#?}");
    notes(&pressed, "the physics has no force for this overlap (base--cart, 150 mm deep)");
    // A depth that is allowed does not make a force of what has none.
    let deep = into_base(ContactCheck { depth_mm: Some(200.0), ..limited() }, -0.05);
    assert_eq!(deep.status, Status::Fail, "{deep:#?}");
    passes(&into_base(limited(), -0.21));
}

#[test]
fn an_arm_that_touches_nothing_passes_with_its_distance() {
    let mut scenario = scenario(controlled("kinematic", 0.0, 0.0), Check::Contact(ContactCheck::default()));
    scenario.obstacle = vec![ObstacleSettings {
        name: "far".to_owned(),
        sphere_radius_m: Some(0.1),
        xyz_m: Some([0.0, 3.0, 0.0]),
        ..ObstacleSettings::default()
    }];
    let far = crate::support::result(&setup(scenario, &arm(&[])));
    passes(&far);
    assert!(far.contacts.is_empty());
}

/// The finger is the only link with a shape.
#[test]
fn without_a_pair_there_is_nothing_to_check() {
    let check = Check::Contact(ContactCheck::default());
    let alone = result(&setup(scenario(controlled("kinematic", 0.0, 0.0), check), &arm(&[])));
    assert_eq!(alone.status, Status::Skipped, "{alone:#?}");
}

/// The finger's ball slides from y = 0.07 m to 0.14 m; its front is at 0.12 m to 0.19 m.
#[test]
fn every_link_that_enters_a_zone_is_reported_with_its_time() {
    let mut scenario = slid(ContactCheck::default()).scenario;
    let zone = |name: &str, at_m: f64| ZoneSettings {
        name: name.to_owned(),
        links: vec!["finger".to_owned()],
        box_m: Some([0.2, 0.2, 0.2]),
        // Its face is 0.1 m before its middle.
        xyz_m: Some([1.05, at_m + 0.1, 0.0]),
        ..ZoneSettings::default()
    };
    scenario.obstacle.clear();
    scenario.zone = vec![zone("first", 0.14), zone("second", 0.17), zone("third", 0.3)];
    scenario.check = vec![Check::Zone(ZoneCheck::default())];
    let result = result(&setup(scenario, &arm(&[])));
    assert_eq!(result.status, Status::Fail, "{result:#?}");
    let entered: Vec<_> =
        result.measures.iter().map(|measure| measure.first_violation.as_ref().unwrap()).collect();
    let names: Vec<&str> = entered.iter().map(|moment| moment.subject.as_str()).collect();
    assert_eq!(names, ["finger--first", "finger--second"]);
    // 20 mm and 50 mm of 70 mm in 0.8 s.
    for (moment, share) in entered.iter().zip([2.0, 5.0]) {
        assert!((moment.time_s - 0.8 * share / 7.0).abs() < 1.5e-3, "{moment:?}");
    }
}
