//! `congruent check` of a joint that slides without a range.

use std::fs;

use serde_json::{Value, json};

use crate::support::command::{Answer, congruent, congruent_json, text};

/// An MJCF against another one, as JSON and as text.
fn against(first: &str, second: &str) -> (Answer, String) {
    let folder = tempfile::tempdir().unwrap();
    let [one, other] = ["one.xml", "other.xml"].map(|name| folder.path().join(name));
    fs::write(&one, first).unwrap();
    fs::write(&other, second).unwrap();
    let [one, other] = [&one, &other].map(|path| text(path));
    let arguments = ["check", &one, "--against", &other];
    (congruent_json(&arguments), congruent(&arguments).stdout)
}

/// A range that a joint does not have is not made up: without it two robots may be any distance apart.
#[test]
fn a_slide_without_a_range_is_sampled_within_a_metre_and_not_certified() {
    let [one, other] = [0.1, 0.1 + 2e-4].map(|turned| {
        format!(
            "<mujoco><compiler angle='radian'/><worldbody><body name='cart' euler='0 {turned} 0'>\
             <joint name='z' type='slide' axis='1 0 0'/><inertial pos='0 0 0' mass='1' diaginertia='1 1 1'/></body>\
             </worldbody></mujoco>"
        )
    });
    let (same, printed) = against(&one, &one);
    assert_eq!(same.code, 0, "{printed}");
    assert!(printed.contains("joint z slides without a range") && printed.contains("agree at "), "{printed}");
    assert!(!printed.contains("over the whole joint range"), "{printed}");
    let report = same.json();
    let certificate = &report["certificates"][0];
    assert_eq!((&certificate["unranged"], &certificate["position_m"]), (&json!("z"), &Value::Null));
    // The axis is turned by 0.2 mrad, which moves the tip by 0.2 mm at 1 m.
    let (turned, printed) = against(&one, &other);
    assert_eq!(turned.code, 1, "{printed}");
    let report = turned.json();
    let farthest_m = report["worst"]["position_m"].as_f64().unwrap();
    assert!((farthest_m - 2e-4).abs() < 1e-9, "{}", report["worst"]);
}
