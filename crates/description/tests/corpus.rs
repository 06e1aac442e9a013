//! Real robots and broken files that nobody in the project made: every robot loads with the
//! meshes that others measured, every broken file is refused with a message that helps.

use std::path::{Path, PathBuf};

use congruent_description::{Geometry, Mesh, load_robot};
use congruent_input::{Capability, Diagnostic, Findings, Severity};
use serde_json::Value;

use special_inputs::{chain, make_special};

#[path = "../../../tests/support/corpus.rs"]
mod corpus;
#[path = "../../../tests/support/special_inputs.rs"]
mod special_inputs;

fn json(path: &Path) -> Value {
    let text = std::fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    serde_json::from_str(&text).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// A diagnostic as a person reads it: place, message, help.
fn line(found: &Diagnostic) -> String {
    let file = found.source.as_ref().map_or(String::new(), |source| source.path.display().to_string());
    let place = found.line_column().map_or(String::new(), |(line, column)| format!(":{line}:{column}"));
    let help = found.help.as_ref().map_or(String::new(), |help| format!(" ({help})"));
    format!("{file}{place}: [{}] {}{help}", found.code.name, found.message)
}

fn lines<'a>(found: impl IntoIterator<Item = &'a Diagnostic>) -> String {
    found.into_iter().map(line).collect::<Vec<_>>().join("\n")
}

fn robots(corpus: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(corpus.join("robots")).expect("the corpus holds robots");
    let mut robots: Vec<PathBuf> = entries
        .map(|entry| entry.expect("a readable folder").path())
        .filter(|path| path.join("robot.urdf").is_file())
        .collect();
    robots.sort();
    robots
}

#[test]
fn every_real_robot_loads() {
    let Some(corpus) = corpus::corpus() else { return };
    let robots = robots(&corpus);
    assert!(robots.len() >= 9, "{robots:?}");
    for folder in robots {
        let loaded =
            load_robot(&folder.join("robot.urdf")).unwrap_or_else(|found| panic!("{}", lines(&found)));
        let golden = json(&folder.join("golden.json"));
        let joints = golden["joints"].as_array().expect("a list of joints");
        assert_eq!(loaded.robot.dof(), joints.len(), "{}", folder.display());
        let known: &[&str] = match folder.file_name().and_then(|name| name.to_str()) {
            Some("fanuc_m10ia") => &["urdf::massless"],
            Some("denso_hsr065") => &["mesh::empty"],
            Some("baxter") => &["chain::several_tips"],
            _ => &[],
        };
        let found: Vec<&str> = loaded.warnings.iter().map(|warning| warning.code.name).collect();
        assert_eq!(found, known, "{}", lines(&loaded.warnings));
    }
}

/// The frames that the vendors' manuals and drivers call the tool's, by robot.
#[test]
fn the_chain_ends_where_tools_are_programmed() {
    let Some(corpus) = corpus::corpus() else { return };
    let expected = [
        ("baxter", "right_gripper", 7),
        ("denso_hsr065", "J4", 4),
        ("fanuc_m10ia", "tool0", 6),
        ("iiwa14", "iiwa_link_ee", 7),
        ("panda", "panda_hand_tcp", 7),
        ("rrr_arm", "gripper_frame_cp", 4),
        ("so100", "gripper", 5),
        ("ur5e", "tool0", 6),
        ("xarm7_gripper", "link_tcp", 7),
    ];
    for (name, tip, joints) in expected {
        let loaded = load_robot(&corpus.join("robots").join(name).join("robot.urdf")).expect("it loads");
        let chain = loaded.reported_chain();
        assert_eq!((chain.tip.as_str(), chain.joints.len()), (tip, joints), "{name}");
    }
}

/// `meshes.json` gives bounds with six digits: half a unit of the last of 0.999999 m.
const BOUNDS_M: f64 = 5e-7;

#[test]
fn meshes_have_the_measured_triangles_and_bounds() {
    let Some(corpus) = corpus::corpus() else { return };
    let mut compared = 0;
    for folder in robots(&corpus) {
        let measured = json(&folder.join("meshes.json"));
        let loaded =
            load_robot(&folder.join("robot.urdf")).unwrap_or_else(|found| panic!("{}", lines(&found)));
        let shapes = loaded.robot.links().iter().flat_map(|link| link.visuals.iter().chain(&link.collisions));
        for shape in shapes {
            let Geometry::Mesh(mesh) = &shape.geometry else { continue };
            let name = mesh.path.strip_prefix(folder.canonicalize().expect("it exists")).expect("inside");
            let expected = &measured[name.to_str().expect("plain names")];
            assert_eq!(expected["triangles"], mesh.triangles.len(), "{}", name.display());
            compared += 1;
            if let Some(bounds) = expected["bounds"].as_array() {
                check_bounds(mesh, bounds);
            }
        }
    }
    assert!(compared > 80, "only {compared} meshes were compared");
}

#[track_caller]
fn check_bounds(mesh: &Mesh, bounds: &[Value]) {
    let first = mesh.vertices_m[0].coords;
    let (least, most) = mesh
        .vertices_m
        .iter()
        .fold((first, first), |(least, most), vertex| (least.inf(&vertex.coords), most.sup(&vertex.coords)));
    for (found, expected) in [(least, &bounds[0]), (most, &bounds[1])] {
        for axis in 0..3 {
            let expected = expected[axis].as_f64().expect("a number");
            let off = (found[axis] - expected).abs();
            assert!(off < BOUNDS_M, "{}: {} is not {expected}", mesh.path.display(), found[axis]);
        }
    }
}

/// Every use of a robot, and then the warnings if none is refused.
fn for_every_use(path: &Path) -> Result<Vec<Diagnostic>, Findings> {
    let description = load_robot(path)?;
    description.check_capability(Capability::Physics)?;
    description.check_capability(Capability::Clearance)?;
    Ok(description.warnings)
}

/// Whether one case of the index is answered as its README asks for. A case that must be refused is refused for
/// every use, or for the one that needs what is wrong.
fn verdict(case: &Value, path: &Path) -> Result<(), String> {
    let (outcome, found) = match for_every_use(path) {
        Err(found) => ("error", found.into_vec()),
        Ok(warnings) if warnings.is_empty() => ("ok", warnings),
        Ok(warnings) => ("warn", warnings),
    };
    let text = lines(&found);
    if text.contains("CANARY") {
        return Err("the canary was read".to_owned());
    }
    if let Some(unplaced) = found.iter().find(|found| found.source.is_some() && found.span.is_none()) {
        return Err(format!("no place: {}", line(unplaced)));
    }
    if case["severity"] != outcome && case["also_acceptable"] != outcome {
        return Err(format!("{outcome} instead of {}: {text}", case["severity"]));
    }
    let Some(must_mention) = case.get("must_mention").filter(|_| outcome != "ok") else { return Ok(()) };
    // The case's own path is taken out: it names the fault.
    let shown = text.replace(&path.display().to_string(), "");
    let mentions = |key: &str| must_mention[key].as_str().map(|pattern| matches(pattern, &shown));
    let is_near = |found: &Diagnostic| {
        let line = found.line_column().map(|(line, _)| line as u64);
        line.zip(case["true_line"].as_u64()).is_some_and(|(line, expected)| line.abs_diff(expected) <= 3)
    };
    if mentions("what") != Some(true) {
        return Err(format!("does not say what: {text}"));
    }
    match mentions("where") {
        Some(false) if !found.iter().any(is_near) => Err(format!("does not say where: {text}")),
        _ => Ok(()),
    }
}

fn matches(pattern: &str, text: &str) -> bool {
    let pattern = regex_lite::Regex::new(&format!("(?i){pattern}")).expect("a pattern of the index");
    pattern.is_match(text)
}

#[test]
fn every_broken_urdf_is_answered_well() {
    let Some(corpus) = corpus::corpus() else { return };
    let folder = corpus.join("bad-inputs");
    let special = tempfile::tempdir().expect("a writable temporary folder");
    make_special(special.path());
    let index = json(&folder.join("index.json"));
    let mut wrong = Vec::new();
    let mut scored = 0;
    for case in index["cases"].as_array().expect("a list of cases") {
        let file = case["file"].as_str().expect("a path");
        let path = match file.split_once('/') {
            Some(("urdf", _)) => folder.join(file),
            Some(("special", name)) => special.path().join(name),
            _ => continue,
        };
        // Permissions mean nothing to root.
        if case["id"] == "P55" && std::fs::read(&path).is_ok() {
            continue;
        }
        scored += 1;
        if let Err(reason) = verdict(case, &path) {
            wrong.push(format!("{}: {reason}", case["id"]));
        }
    }
    assert!(wrong.is_empty(), "{} of {scored} are wrong:\n{}", wrong.len(), wrong.join("\n"));
    assert!(scored > 60, "only {scored} cases were scored");
}

/// What stops clearance or physics alone: the links and joints of all of these are those of the good robot.
#[test]
fn kinematics_goes_on_past_what_it_does_not_need() {
    let Some(corpus) = corpus::corpus() else { return };
    let folder = corpus.join("bad-inputs/urdf");
    let good = load_robot(&folder.join("c01-control-good.urdf")).unwrap().robot;
    let mut counted = [0, 0];
    for entry in std::fs::read_dir(&folder).expect("the corpus holds bad inputs").flatten() {
        let path = entry.path();
        if path.extension().is_none_or(|extension| extension != "urdf") {
            continue;
        }
        let Ok(description) = load_robot(&path) else { continue };
        let uses = [Capability::Physics, Capability::Clearance];
        for (index, _) in
            uses.iter().enumerate().filter(|(_, use_)| description.check_capability(**use_).is_err())
        {
            counted[index] += 1;
            assert_eq!(description.robot.joints(), good.joints(), "{}", path.display());
        }
    }
    assert_eq!(counted, [7, 14], "physics and clearance");
}

#[test]
fn many_links_are_counted_and_the_most_allowed_load() {
    let folder = tempfile::tempdir().expect("a writable temporary folder");
    let path = folder.path().join("chain.urdf");
    std::fs::write(&path, chain(10_001, "")).expect("a writable folder");
    assert!(lines(&load_robot(&path).unwrap_err()).contains("too many links: 10001, the limit is 10000"));
    std::fs::write(&path, chain(10_000, "")).expect("a writable folder");
    assert_eq!(load_robot(&path).unwrap().robot.links().len(), 10_000);
    let moving = chain(2_002, "").replace("\"fixed\"", "\"continuous\"");
    std::fs::write(&path, moving).expect("a writable folder");
    assert!(
        lines(&load_robot(&path).unwrap_err()).contains("too many moving joints: 2001, the limit is 2000")
    );
}

#[test]
fn a_robot_cut_at_any_byte_is_refused_and_never_panics() {
    let Some(corpus) = corpus::corpus() else { return };
    let whole = std::fs::read(corpus.join("bad-inputs/urdf/c01-control-good.urdf")).expect("a control");
    let folder = tempfile::tempdir().expect("a writable temporary folder");
    let path = folder.path().join("cut.urdf");
    let end = whole.trim_ascii_end().len();
    for cut in 0..end {
        std::fs::write(&path, &whole[..cut]).expect("a writable folder");
        let found = load_robot(&path).expect_err("a cut robot");
        assert!(found.iter().any(|found| found.severity == Severity::Error), "{cut}");
    }
}
