//! `congruent check` of a URDF against an MJCF that writes axes in other coordinates: the base is turned, and where the last link lies
//! along its axis cannot be compared.

use std::{fs, path::PathBuf};

use crate::support::{command::congruent, corpus::corpus, scratch_folder::ScratchFolder};

/// URDF and MJCF of a UR5e, whose base is turned by half a turn in one of them.
fn pair() -> Option<[PathBuf; 2]> {
    let folder = corpus()?.join("pairs/ur5e");
    Some(["partner.urdf", "robot.xml"].map(|file| folder.join(file)))
}

/// The first line for the URDF with one number changed.
fn first_line(from: &str, to: &str) -> Option<String> {
    let [urdf, mjcf] = pair()?;
    let text = fs::read_to_string(urdf).unwrap();
    assert!(text.contains(from), "{from}");
    let scratch = ScratchFolder::new();
    let changed = scratch.write("ur5e.urdf", &text.replace(from, to));
    Some(congruent(&["check", "-q", &changed, "--against", &mjcf.display().to_string()]).stdout)
}

/// Another zero of the first joint would move its range, which both files state alike.
#[test]
fn a_base_is_turned_if_both_files_state_the_same_range_of_the_first_joint() {
    let Some([urdf, mjcf]) = pair() else { return };
    for [own, other] in [[&urdf, &mjcf], [&mjcf, &urdf]] {
        let [own, other] = [own, other].map(|file| file.display().to_string());
        let answer = congruent(&["check", &own, "--against", &other]).stdout;
        assert!(answer.contains("the base is turned by 180 deg, or shoulder_pan"), "{answer}");
        assert!(answer.contains("      base = \"fitted\"\n"), "{answer}");
        assert!(!answer.contains("lower limit"), "{answer}");
    }
}

/// The frame of the last link is another one in each file, and a length along its axis could be part of that choice.
#[test]
fn a_length_along_the_last_axis_is_said_not_to_be_compared() {
    let Some(line) = first_line("xyz=\"0 0.0996 ", "xyz=\"0 0.1096 ") else { return };
    assert!(line.contains("SAME GEOMETRY AFTER MAPPING"), "{line}");
    assert!(
        line.ends_with("; not compared: wrist_3_link lies 109 mm elsewhere along the axis of its joint\n"),
        "{line}"
    );
}

/// 20 mm in one length are the cause, and not half a turn without one.
#[test]
fn a_wrong_length_beside_a_turned_base_is_named() {
    let Some(line) = first_line("xyz=\"0 -0.0997 ", "xyz=\"0 -0.1197 ") else { return };
    assert!(line.contains("DIFFERENT: the base is turned by 180 deg, or shoulder_pan"), "{line}");
    assert!(
        line.contains("Cause: joint \"wrist_3_joint\": origin") && line.contains("off by 20.2 mm"),
        "{line}"
    );
}
