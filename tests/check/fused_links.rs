//! Masses of a body at other links in the two files: as one link with the sum, and with other parts at the same links.

use super::stated::{ARM, against, with, without_inertials};

/// `third` as one body with a part of its tool, in the frame of `third`; `tool` has these parts of its mass and moments left.
fn with_part_of_tool_at_third(tool: &str, part: f64) -> String {
    // About the origin of `third`: 2 kg at (20, 10, 50) mm and up to 0.5 kg at (10, 20, 130) mm.
    let mass = [2.0, 0.5 * part];
    let all_kg = mass[0] + mass[1];
    let at = [[0.02, 0.01, 0.05], [0.01, 0.02, 0.13]];
    let com: Vec<f64> = (0..3).map(|axis| (mass[0] * at[0][axis] + mass[1] * at[1][axis]) / all_kg).collect();
    let tensors = [[0.01, 0.012, 0.014, 0.001, 0.0002, 0.0003], [0.001, 0.0012, 0.0014, 0.0, 0.0, 0.0]];
    let mut sum = [0.0; 6];
    for (link, tensor) in tensors.iter().enumerate() {
        let [x, y, z] = [0, 1, 2].map(|axis| at[link][axis] - com[axis]);
        let shift = [y * y + z * z, x * x + z * z, x * x + y * y, -x * y, -x * z, -y * z];
        for entry in 0..6 {
            sum[entry] += [1.0, part][link] * tensor[entry] + mass[link] * shift[entry];
        }
    }
    let inertial = format!(
        "<origin xyz=\"{} {} {}\"/><mass value=\"{all_kg}\"/>\n\
         <inertia ixx=\"{}\" iyy=\"{}\" izz=\"{}\" ixy=\"{}\" ixz=\"{}\" iyz=\"{}\"/>",
        com[0], com[1], com[2], sum[0], sum[1], sum[2], sum[3], sum[4], sum[5]
    );
    let from = tool.find("<origin xyz=\"0.02 0.01 0.05\"/>").unwrap();
    let to = from + tool[from..].find("</inertial>").unwrap();
    [&tool[..from], &inertial, &tool[to..]].concat()
}

/// The tool's mass at the link that carries it is the same body, as programs write that fuse links.
#[test]
fn a_link_with_the_mass_of_those_that_are_fixed_to_it_is_no_difference() {
    let lumped = with_part_of_tool_at_third(&without_inertials(&["tool"]), 1.0);
    for (own, other) in [(ARM, &lumped[..]), (&lumped, ARM)] {
        let (answer, printed) = against(own, other, &[]);
        assert_eq!(answer.code, 0, "{printed}");
        assert!(
            printed.contains("fixed to each other are compared as one body: third with tool\n"),
            "{printed}"
        );
        assert!(!printed.contains("mass") || !printed.contains("no effect"), "{printed}");
    }
    let heavier = lumped.replace("<mass value=\"2.5\"/>", "<mass value=\"2.6\"/>");
    let (answer, printed) = against(ARM, &heavier, &[]);
    assert_eq!(answer.code, 1, "{printed}");
    assert!(
        printed.contains("third: mass 2 kg in ") && printed.contains(", 2.1 kg computed for "),
        "{printed}"
    );
}

/// A part of the tool's mass at the link that carries it: the same body again, with other masses at the same links.
#[test]
fn differences_that_cancel_are_not_said_to_be_below_the_resolution() {
    let moments = "ixx=\"0.001\" iyy=\"0.0012\" izz=\"0.0014\"";
    let half = with("<mass value=\"0.5\"/>", "<mass value=\"0.25\"/>")
        .replace(moments, "ixx=\"0.0005\" iyy=\"0.0006\" izz=\"0.0007\"");
    let lumped = with_part_of_tool_at_third(&half, 0.5);
    let (answer, printed) = against(ARM, &lumped, &[]);
    assert_eq!(answer.code, 0, "{printed}");
    let mass = printed.lines().find(|line| line.contains("third: mass 2 kg in ")).unwrap();
    assert!(mass.contains(", 2.25 kg in ") && mass.contains("; the other differences cancel"), "{mass}");
    assert!(!printed.contains("below the resolution"), "{printed}");
}

/// A frame to which an importer has given a mass, so that it does not refuse the link, is no difference; a camera is one.
#[test]
fn a_mass_that_is_negligible_in_its_body_is_no_difference() {
    let with_frame = |mass: &str| {
        with(
            "<joint name=\"mount\"",
            &format!(
                "<link name=\"frame\"><inertial><mass value=\"{mass}\"/>\
                 <inertia ixx=\"0\" iyy=\"0\" izz=\"0\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial></link>\n\
                 <joint name=\"frame\" type=\"fixed\"><parent link=\"third\"/><child link=\"frame\"/></joint>\n\
                 <joint name=\"mount\""
            ),
        )
    };
    for (mass, code) in [("1e-9", 0), ("0.05", 1)] {
        let frame = with_frame(mass);
        for (own, other) in [(ARM, &frame[..]), (&frame, ARM)] {
            let (answer, printed) = against(own, other, &[]);
            assert_eq!(answer.code, code, "{mass}: {printed}");
        }
    }
}
