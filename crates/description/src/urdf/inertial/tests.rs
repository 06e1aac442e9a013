//! Inertias that no body has, alone and welded to others.

#![expect(clippy::float_cmp, reason = "values must arrive as they are written")]

use congruent_input::Capability;

use crate::urdf::tests::{INERTIAL, LIMIT, arm, good, read, stops};

/// `arm` with a third link, welded to the second.
fn welded(tip: &str, tool: &str) -> String {
    arm(LIMIT, tip).replace(
        "</robot>",
        &format!(
            "<link name=\"tool\">{tool}</link><joint name=\"weld\" type=\"fixed\">\
             <parent link=\"tip\"/><child link=\"tool\"/></joint>\n</robot>"
        ),
    )
}

fn inertial(mass: &str, [ixx, iyy, izz]: [f64; 3]) -> String {
    format!(
        "<inertial><mass value=\"{mass}\"/><inertia ixx=\"{ixx}\" iyy=\"{iyy}\" izz=\"{izz}\" ixy=\"0\" \
         ixz=\"0\" iyz=\"0\"/></inertial>"
    )
}

#[test]
fn an_impossible_inertia_stops_physics_and_stays_as_it_is_written() {
    for (mass, moments, code, message) in [
        ("-2", [1.0; 3], "urdf::mass", "link \"tip\": mass -2 is negative"),
        (
            "2",
            [-1.0, 1.0, 1.0],
            "urdf::inertia",
            "not positive definite: its smallest principal moment is -1",
        ),
        ("2", [3.0, 1.0, 1.0], "urdf::inertia", "its largest principal moment, 3 kg m2, exceeds the sum of"),
    ] {
        let text = arm(LIMIT, &inertial(mass, moments));
        let robot = stops(&text, 8, Some(Capability::Physics), code, message);
        assert_eq!(robot.links()[1].inertia.unwrap().tensor_kg_m2[(0, 0)], moments[0]);
        // The root's body cannot move.
        let root = arm(LIMIT, INERTIAL).replace(
            "<link name=\"base\"/>",
            &format!("<link name=\"base\">{}</link>", inertial(mass, moments)),
        );
        stops(&root, 2, None, code, "the link cannot move, so its inertia is not used");
    }
}

#[test]
fn welded_links_are_judged_as_one_body() {
    let impossible = inertial("0.1", [0.3, 0.1, 0.1]);
    let possible = "together with the links fixed to it the inertia is possible";
    stops(&welded(INERTIAL, &impossible), 10, None, "urdf::inertia", possible);
    // Neither of two links without mass is a fault beside one that has some.
    good(&welded(INERTIAL, ""));
    good(&welded("", INERTIAL));
    // A body that is impossible as a whole.
    let (_, found) = read(&welded(&inertial("0.001", [0.001; 3]), &impossible));
    assert_eq!(found[0].stops, Some(Capability::Physics), "{found:#?}");
}

/// Several findings of a kind, and the lines that correct them, which can be pasted.
#[test]
fn impossible_inertias_are_one_finding_with_the_lines_that_correct_them() {
    let impossible = inertial("1", [3.0, 1.0, 1.0]);
    let text = welded(&impossible, &impossible)
        .replace("type=\"fixed\"", "type=\"continuous\"")
        .replace("\"tool\"", "\"tool 1\"");
    let (_, found) = read(&text);
    let [found] = &found[..] else { panic!("{found:#?}") };
    assert_eq!(found.message, "2 links have an inertia that breaks the triangle inequality: tip, tool 1");
    assert_eq!(
        found.help.as_deref(),
        Some(
            "correct it in the URDF, or use the nearest possible inertia with these lines in robot.toml:\n\
             [inertia]\ntip = \"repair\"\n\"tool 1\" = \"repair\""
        )
    );
    let own: Vec<&str> = found.kind.occurrences.iter().map(|found| found.message.as_str()).collect();
    assert!(own[1].starts_with("link \"tool 1\": inertia breaks the triangle inequality"), "{own:?}");
}
