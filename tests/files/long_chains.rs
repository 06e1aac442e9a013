//! Chains of many joints: what is compared of them, what is not, and at which cost.

#[cfg(target_os = "linux")]
use crate::support::command::with_memory;
use crate::support::{command::congruent, scratch_folder::ScratchFolder};

/// A URDF of a chain of so many revolute joints, its axes in turn along x, y and z; joints that are `shifted` are 5 mm along x
/// and 2 mm along z from their place.
fn chain(joints: usize, shifted: &[usize]) -> String {
    let axes = ["0 0 1", "0 1 0", "1 0 0"];
    let link = |at: usize| {
        format!(
            "<link name=\"l{at}\"><inertial><mass value=\"0.5\"/><inertia ixx=\"0.01\" iyy=\"0.01\" izz=\"0.01\" ixy=\"0\" ixz=\"0\" \
             iyz=\"0\"/></inertial></link>\n"
        )
    };
    let joint = |at: usize| {
        let [x, y, z] = [7, 11, 13].map(|prime| 0.01 * f64::from(u32::try_from(at * prime % 9).unwrap()));
        let (x, z) = if shifted.contains(&at) { (x + 0.005, z + 0.002) } else { (x, z) };
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
fn two_files_of_many_joints_are_compared_without_a_search_for_causes() {
    let scratch = ScratchFolder::new();
    // Causes are searched for up to 60 joints.
    let whole = chain(61, &[]);
    let urdf = scratch.write("chain.urdf", &whole);
    let checked = |changed: &str| {
        let changed = scratch.write("changed.urdf", changed);
        let found = congruent(&["check", &changed, "--against", &urdf, "--format", "json"]);
        (found.code, found.json())
    };
    let (code, report) = checked(&whole);
    assert_eq!((code, &report["verdict"]), (0, &"agree".into()), "{report}");
    assert_eq!(report["dynamics"]["verdict"], "same");
    let link = whole.find("<link name=\"l50\"").unwrap();
    let heavier =
        [&whole[..link], &whole[link..].replacen("mass value=\"0.5\"", "mass value=\"0.75\"", 1)].concat();
    let (code, report) = checked(&heavier);
    assert_eq!((code, &report["dynamics"]["verdict"]), (1, &"unexplained".into()), "{report}");
    let differences = report["dynamics"]["differences"].as_array().unwrap();
    let [only] = &differences[..] else { panic!("{differences:?}") };
    assert_eq!((&only["of"], &only["figure"], &only["found"]), (&"l50".into(), &"mass".into(), &0.75.into()));
    let joint = whole.find("<joint name=\"j50\"").unwrap();
    let narrower = [&whole[..joint], &whole[joint..].replacen("upper=\"2\"", "upper=\"1.9\"", 1)].concat();
    let (code, report) = checked(&narrower);
    assert_eq!(code, 1, "{report}");
    assert_eq!(report["dynamics"]["limits"][0]["joint"], "j50");
}

/// What the command prints for two such chains with so many MiB of memory, of which 60 are the program's own.
#[cfg(target_os = "linux")]
fn differing(joints: usize, shifted: &[usize], most_mib: u32) -> String {
    let scratch = ScratchFolder::new();
    let urdf = scratch.write("chain.urdf", &chain(joints, &[]));
    let shifted = scratch.write("shifted.urdf", &chain(joints, shifted));
    let mut command = with_memory(most_mib << 10, &["check", &shifted, "--against", &urdf]);
    let ended = command.output().unwrap();
    let [text, said] = [&ended.stdout, &ended.stderr].map(|bytes| String::from_utf8_lossy(bytes));
    assert_eq!(ended.status.code(), Some(1), "{text}{said}");
    text.into_owned()
}

/// Candidates and fits of a diagnosis grow with the square of the joints; what is kept of them does not.
#[test]
#[cfg(target_os = "linux")]
fn a_long_chain_is_diagnosed_in_little_memory() {
    let shifted: Vec<usize> = (5..15).map(|tenth| 5 * tenth).collect();
    let text = differing(100, &shifted, 160);
    assert!(text.contains("after 10 corrections") && text.contains("agree     dynamics of"), "{text}");
    // More than are named together.
    let shifted: Vec<usize> = (5..45).map(|half| 2 * half).collect();
    let text = differing(100, &shifted, 160);
    assert!(text.contains("no known cause explains the difference"), "{text}");
}

/// Both files give every origin: a joint with another one is found without a search.
#[test]
#[cfg(target_os = "linux")]
fn an_origin_is_named_in_short_and_long_chains() {
    for (joints, shifted, most_mib) in [(8, 5, 160), (200, 100, 256)] {
        let text = differing(joints, &[shifted], most_mib);
        assert!(text.contains("check::joint_origin"), "{text}");
        let words = text.split_whitespace().filter(|word| *word != "│").collect::<Vec<_>>().join(" ");
        assert!(words.contains(&format!("error: joint \"j{shifted}\": origin xyz=")), "{words}");
        assert!(words.contains("off by 5.39 mm"), "{words}");
    }
}
