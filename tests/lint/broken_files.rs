//! `lint` on broken files: those of the corpus, and further ones of kinds that it does not have. Each is reported, clearly and
//! at its place; none is a crash or a hang.

use std::{fs, path::Path};

use serde_json::Value;

use crate::support::{
    command::{Answer, congruent_json, text},
    corpus::corpus,
    special_inputs::make_special,
};

/// An arm with two links, a tool and a box; every mutation below is of this text.
const ARM: &str = r#"<?xml version="1.0"?>
<robot name="arm">
  <link name="base"/>
  <link name="upper">
    <inertial>
      <origin xyz="0.2 0 0"/>
      <mass value="2"/>
      <inertia ixx="0.0021" ixy="0" ixz="0" iyy="0.028" iyz="0" izz="0.028"/>
    </inertial>
    <visual>
      <origin xyz="0.2 0 0" rpy="0 0 0"/>
      <geometry><box size="0.4 0.08 0.08"/></geometry>
      <material name="grey"><color rgba="0.5 0.5 0.5 1"/></material>
    </visual>
    <collision>
      <origin xyz="0.2 0 0"/>
      <geometry><cylinder radius="0.04" length="0.4"/></geometry>
    </collision>
  </link>
  <link name="fore arm">
    <inertial>
      <origin xyz="0.15 0 0"/>
      <mass value="1.2"/>
      <inertia ixx="0.0009" ixy="0" ixz="0" iyy="0.0098" iyz="0" izz="0.0098"/>
    </inertial>
  </link>
  <link name="tool"/>
  <joint name="shoulder" type="revolute">
    <origin xyz="0 0 0.1" rpy="0 0 0"/>
    <parent link="base"/>
    <child link="upper"/>
    <axis xyz="0 0 1"/>
    <limit lower="-2" upper="2" effort="40" velocity="3.1"/>
  </joint>
  <joint name="elbow" type="revolute">
    <origin xyz="0.4 0 0"/>
    <parent link="upper"/>
    <child link="fore arm"/>
    <axis xyz="0 1 0"/>
    <limit lower="-2" upper="2" effort="20" velocity="4.2"/>
  </joint>
  <joint name="flange" type="fixed">
    <origin xyz="0.3 0 0"/>
    <parent link="fore arm"/>
    <child link="tool"/>
  </joint>
</robot>
"#;

/// What is replaced by what, the severity, and a pattern that a message must match, with the line if it is not 0.
type Case = (&'static str, &'static str, &'static str, &'static str, u64);

#[rustfmt::skip]
const CASES: &[Case] = &[
    // XML
    ("</robot>\n", "</robot>\n<robot name=\"second\"/>\n", "error", "second root|after the (root|end)|one root", 48),
    ("</robot>\n", "</robot>\n</robot>\n", "error", "after the|closing tag|no element|not open|unexpected close", 48),
    ("</robot>\n", "</robot>\ntrailing words\n", "error", "after the|text", 48),
    ("<link name=\"base\"/>", "<link name=base/>", "error", "quote", 3),
    ("<link name=\"base\"/>", "<link name=\"base/>", "error", "not closed|quote|invalid|\"<\"|'<'", 3),
    ("<link name=\"base\"/>", "<!-- <link name=\"base\"/>", "error", "comment", 3),
    ("<link name=\"base\"/>", "<link name=\"base & co\"/>", "error", "&|entity|reference", 3),
    ("<link name=\"base\"/>", "<link name=\"a<b\"/>", "error", "<", 3),
    ("  </link>\n  <link name=\"tool\"/>", "  </links>\n  <link name=\"tool\"/>", "error", "link", 26),
    ("<?xml version=\"1.0\"?>\n", "\n<?xml version=\"1.0\"?>\n", "error", "declaration|first", 2),
    ("  <link name=\"tool\"/>\n", "<<<<<<< HEAD\n  <link name=\"tool\"/>\n=======\n>>>>>>> b\n", "error", "conflict", 27),
    // Names and structure
    ("<link name=\"base\"/>", "<link/>", "error", "name", 3),
    ("<link name=\"base\"/>", "<link name=\"\"/>", "error", "empty", 3),
    ("<joint name=\"elbow\" type=\"revolute\">", "<joint type=\"revolute\">", "error", "name", 35),
    ("<joint name=\"elbow\" type=\"revolute\">", "<joint name=\"elbow\">", "error", "type", 35),
    ("name=\"elbow\" type=\"revolute\"", "name=\"elbow\" type=\"Revolute\"", "error", "did you mean \"revolute\"", 35),
    ("name=\"elbow\"", "name=\"shoulder\"", "error", "duplicate joint", 35),
    ("name=\"elbow\" type=\"revolute\"", "name=\"elbow\" type=\"floating\"", "error", "floating", 35),
    ("name=\"elbow\" type=\"revolute\"", "name=\"elbow\" type=\"ball\"", "error", "ball", 35),
    ("<child link=\"fore arm\"/>", "<child link=\"fore arm \"/>", "error", "not found.*did you mean", 38),
    ("<child link=\"fore arm\"/>", "<child link=\"fore_arm\"/>", "error", "not found.*did you mean", 38),
    ("<child link=\"fore arm\"/>", "<child>fore arm</child>", "error", "link", 38),
    ("<child link=\"tool\"/>", "<child link=\"upper\"/>", "error", "already has a parent|loop", 0),
    ("<child link=\"tool\"/>", "<child link=\"tool\"/><child link=\"base\"/>", "error", "twice", 45),
    ("<axis xyz=\"0 1 0\"/>", "<axis xyz=\"0 1 0\"/><axis xyz=\"0 0 1\"/>", "error", "twice", 39),
    ("<axis xyz=\"0 1 0\"/>", "<axis xyz=\"0 1 0\"/><mimic/>", "error", "mimic", 39),
    ("<axis xyz=\"0 1 0\"/>", "<axis xyz=\"0 1 0\"/><mimic joint=\"flange\"/>", "error", "flange", 39),
    ("<axis xyz=\"0 1 0\"/>", "<axis/>", "error", "xyz", 39),
    // Numbers
    ("<axis xyz=\"0 1 0\"/>", "<axis xyz=\"0 1\"/>", "error", "3|three", 39),
    ("<axis xyz=\"0 1 0\"/>", "<axis xyz=\"0,1,0\"/>", "error", "number|comma", 39),
    ("<axis xyz=\"0 1 0\"/>", "<axis xyz=\"y\"/>", "error", "number", 39),
    ("xyz=\"0.4 0 0\"", "xyz=\"0.4 0 0 0\"", "error", "3|three", 36),
    ("xyz=\"0.4 0 0\"", "xyz=\"\"", "error", "3|three|empty", 36),
    ("xyz=\"0.4 0 0\"", "xyz=\"0x10 0 0\"", "error", "0x10", 36),
    ("xyz=\"0.4 0 0\"", "xyz=\"\u{2212}0.4 0 0\"", "error", "\u{2212}", 36),
    ("xyz=\"0.4 0 0\"", "xyz=\"0.4.1 0 0\"", "error", "0.4.1", 36),
    ("xyz=\"0.4 0 0\"", "xyz=\"2/5 0 0\"", "error", "2/5", 36),
    ("xyz=\"0 0 0.1\" rpy=\"0 0 0\"", "xyz=\"0 0 0.1\" rpy=\"0 pi/2 0\"", "error", "pi/2", 29),
    ("xyz=\"0 0 0.1\" rpy=\"0 0 0\"", "xyz=\"0 0 0.1\" rpy=\"0 90 0\"", "warning", "degrees|full turn", 29),
    ("xyz=\"0 0 0.1\" rpy", "xyz=\"0 0 100\" rpy", "warning", "100", 29),
    // Limits
    ("lower=\"-2\" upper=\"2\" effort=\"20\"", "lower=\"-115\" upper=\"115\" effort=\"20\"", "warning", "degrees", 40),
    ("lower=\"-2\" upper=\"2\" effort=\"20\"", "upper=\"2\" effort=\"20\"", "warning", "has no lower", 40),
    ("lower=\"-2\" upper=\"2\" effort=\"20\"", "lower=\"2\" upper=\"2\" effort=\"20\"", "warning", "cannot move", 40),
    ("effort=\"20\" velocity=\"4.2\"", "effort=\"-20\" velocity=\"4.2\"", "error", "negative", 40),
    ("effort=\"20\" velocity=\"4.2\"", "effort=\"20\" velocity=\"-4.2\"", "error", "negative", 40),
    ("effort=\"20\" velocity=\"4.2\"", "effort=\"20\"", "warning", "no velocity", 40),
    ("effort=\"20\" velocity=\"4.2\"", "effort=\"20\" velocity=\"240\"", "warning", "rad/s", 40),
    ("effort=\"20\" velocity=\"4.2\"", "effort=\"inf\" velocity=\"4.2\"", "error", "inf", 40),
    // Inertia
    ("<mass value=\"1.2\"/>", "", "error", "mass", 21),
    ("<mass value=\"1.2\"/>", "<mass value=\"0\"/>", "warning", "mass is zero", 20),
    ("<mass value=\"1.2\"/>", "<mass value=\"1200\"/>", "warning", "mass|gyration", 0),
    ("<mass value=\"1.2\"/>", "<mass value=\"1.2\"/><mass value=\"2\"/>", "error", "twice", 23),
    ("iyy=\"0.0098\" iyz=\"0\"", "iyz=\"0\"", "error", "iyy", 24),
    ("iyy=\"0.0098\" iyz=\"0\"", "iyy=\"-0.0098\" iyz=\"0\"", "error", "positive definite|triangle", 24),
    ("<origin xyz=\"0.15 0 0\"/>", "<origin xyz=\"150 0 0\"/>", "warning", "centre of mass is 150 m", 22),
    ("<origin xyz=\"0.15 0 0\"/>", "<origin xyz=\"1.5 0 0\"/>", "warning", "centre of mass", 22),
    ("ixx=\"0.0009\" ixy=\"0\" ixz=\"0\" iyy=\"0.0098\" iyz=\"0\" izz=\"0.0098\"", "ixx=\"0\" ixy=\"0\" ixz=\"0\" iyy=\"0\" iyz=\"0\" izz=\"0\"", "warning", "inertia is zero", 24),
    // Shapes
    ("<cylinder radius=\"0.04\" length=\"0.4\"/>", "<cylinder radius=\"0.04\"/>", "error", "length", 17),
    ("<cylinder radius=\"0.04\" length=\"0.4\"/>", "<cylinder radius=\"-0.04\" length=\"0.4\"/>", "error", "positive", 0),
    ("<cylinder radius=\"0.04\" length=\"0.4\"/>", "<sphere radius=\"0\"/>", "error", "positive", 0),
    ("<cylinder radius=\"0.04\" length=\"0.4\"/>", "<cone radius=\"0.04\" length=\"0.4\"/>", "error", "cone", 17),
    ("<cylinder radius=\"0.04\" length=\"0.4\"/>", "<capsule radius=\"0\" length=\"0.4\"/>", "error", "capsule", 0),
    ("<cylinder radius=\"0.04\" length=\"0.4\"/>", "<sphere radius=\"1\"/><sphere radius=\"1\"/>", "error", "more than one shape", 17),
    ("<cylinder radius=\"0.04\" length=\"0.4\"/>", "<mesh/>", "error", "filename", 17),
    ("<cylinder radius=\"0.04\" length=\"0.4\"/>", "<mesh filename=\"\"/>", "error", "mesh", 0),
    ("<cylinder radius=\"0.04\" length=\"0.4\"/>", "<mesh filename=\"C:\\meshes\\a.stl\"/>", "error", "a.stl", 0),
    ("<cylinder radius=\"0.04\" length=\"0.4\"/>", "<mesh filename=\"package://none/a.stl\"/>", "error", "none", 0),
    ("<cylinder radius=\"0.04\" length=\"0.4\"/>", "<mesh filename=\"a.fbx\"/>", "error", "fbx", 0),
    ("<cylinder radius=\"0.04\" length=\"0.4\"/>", "<mesh filename=\"pointer.stl\"/>", "error", "LFS", 0),
    ("<cylinder radius=\"0.04\" length=\"0.4\"/>", "<mesh filename=\"page.dae\"/>", "error", "page.dae", 0),
    ("<cylinder radius=\"0.04\" length=\"0.4\"/>", "<mesh filename=\"empty.obj\"/>", "error", "empty", 0),
    ("<box size=\"0.4 0.08 0.08\"/>", "<box size=\"0.4 0.08\"/>", "warning", "3|three", 12),
    ("<color rgba=\"0.5 0.5 0.5 1\"/>", "<color rgba=\"0.5 0.5 0.5\"/>", "warning", "4|four", 13),
    ("<geometry><box size", "<geometri><box size", "error|warning", "geometry", 12),
    // Another file
];

/// Files that are no URDF at all.
const FILES: &[(&str, &str, &str)] = &[
    ("a.urdf", "", "empty"),
    ("b.urdf", "  \n\t\n", "empty|no XML"),
    ("c.urdf", "{\"robot\": {}}", "XML|no URDF"),
    ("d.urdf", "robot:\n  name: x\n", "XML|no URDF"),
    ("e.urdf", "<!DOCTYPE html>\n<html><body>404: Not Found</body></html>\n", "DTD|html|web page"),
    ("f.urdf", "<html><body>404: Not Found</body></html>\n", "html"),
    ("g.urdf", "version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 1\n", "LFS"),
    ("h.urdf", "404: Not Found", "XML|no URDF"),
    ("i.urdf", "<robot name='r'/>", "no link"),
    ("j.urdf", "<robot name='r'><group name='arm'/></robot>", "no link"),
    ("k.urdf", "<mujoco><body/></mujoco>", "no element of <mujoco>"),
    ("l.srdf", "<robot name='r'><disable_collisions link1='a'/></robot>", "no link2"),
    ("m.toml", "urdf = 'missing.urdf'\n", "does not exist"),
    ("n.toml", "urdf = 'n.urdf\n", "string|TOML|quote|invalid"),
    ("o.toml", "schema_version = 9\nname = 'x'\nrobot = '.'\n", "schema_version"),
    ("p.toml", "urfd = 'a.urdf'\n[dh]\n", "did you mean \"urdf\""),
];

#[track_caller]
fn matches(pattern: &str, text: &str) -> bool {
    regex_lite::Regex::new(&format!("(?i){pattern}")).unwrap().is_match(text)
}

/// All findings as one text, and whether one that matches is at the line.
fn is_reported(answer: &Answer, severity: &str, pattern: &str, line: u64) -> bool {
    let report = answer.json();
    let mut findings = report["findings"].as_array().unwrap().iter();
    let said = |value: &Value| value.as_str().unwrap_or_default().to_owned();
    findings.any(|found| {
        let text = said(&found["message"]) + " " + &said(&found["help"]);
        let line_is_right = line == 0 || found["line"] == line;
        severity.split('|').any(|severity| found["severity"] == severity)
            && matches(pattern, &text)
            && line_is_right
    })
}

fn summary(answer: &Answer) -> String {
    let report = answer.json();
    let findings = report["findings"].as_array().cloned().unwrap_or_default();
    let line = |found: &Value| {
        format!("    {}:{}: {} ({})", found["line"], found["severity"], found["message"], found["help"])
    };
    findings.iter().map(line).collect::<Vec<_>>().join("\n")
}

#[test]
fn broken_robots_of_many_kinds_are_reported() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, contents: &str| fs::write(folder.path().join(name), contents).unwrap();
    write("pointer.stl", "version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 1\n");
    write("page.dae", "<html><body>404</body></html>");
    write("empty.obj", "");
    write("a.fbx", "");
    let file = folder.path().join("arm.urdf");
    write("arm.urdf", ARM);
    let good = congruent_json(&["lint", &text(&file)]);
    assert_eq!(good.json()["verdict"], "clean", "{}", summary(&good));
    let mut wrong = Vec::new();
    for (from, to, severity, pattern, line) in CASES {
        assert!(ARM.contains(from), "{from}");
        fs::write(&file, ARM.replacen(from, to, 1)).unwrap();
        let answer = congruent_json(&["lint", &text(&file)]);
        let code = i32::from(severity.contains("error"));
        if !is_reported(&answer, severity, pattern, *line) || answer.code != code {
            wrong.push(format!(
                "{from} -> {to}, {pattern}, line {line}, code {}:\n{}",
                answer.code,
                summary(&answer)
            ));
        }
    }
    for (name, contents, pattern) in FILES {
        write(name, contents);
        let answer = congruent_json(&["lint", &text(&folder.path().join(name))]);
        if !is_reported(&answer, "error|warning", pattern, 0) {
            wrong.push(format!("{name}, {pattern}, code {}:\n{}", answer.code, summary(&answer)));
        }
    }
    assert!(wrong.is_empty(), "{} of {}:\n{}", wrong.len(), CASES.len() + FILES.len(), wrong.join("\n"));
}

/// Why the answer to a case of the corpus is not good enough.
fn verdict(case: &Value, path: &Path) -> Result<(), String> {
    let answer = congruent_json(&["lint", &text(path)]);
    let said = summary(&answer);
    let has = |severity: &str| said.contains(&format!("\"{severity}\":"));
    let outcome = match (answer.code, has("warning")) {
        (1 | 2, _) => "error",
        (0, true) => "warn",
        (0, false) => "ok",
        (code, _) => return Err(format!("exit code {code}\n{}", answer.stderr)),
    };
    let expected = case["severity"].as_str().unwrap();
    let is_expected = outcome == expected || case["also_acceptable"] == outcome;
    if !is_expected {
        return Err(format!("{outcome} instead of {expected}\n{said}"));
    }
    if outcome == "ok" {
        return Ok(());
    }
    let pattern = |key: &str| case["must_mention"][key].as_str();
    if pattern("what").is_some_and(|what| !matches(what, &said)) {
        return Err(format!("it does not say what is wrong\n{said}"));
    }
    let lines: Vec<u64> = answer.json()["findings"]
        .as_array()
        .unwrap()
        .iter()
        .filter_map(|found| found["line"].as_u64())
        .collect();
    let is_near = case["true_line"]
        .as_u64()
        .is_some_and(|line| lines.iter().any(|reported| reported.abs_diff(line) <= 3));
    match pattern("where") {
        Some(place) if !is_near && !matches(place, &said) => Err(format!("it does not say where\n{said}")),
        _ => Ok(()),
    }
}

#[test]
fn the_broken_files_of_the_corpus_are_reported() {
    let Some(corpus) = corpus() else { return };
    let folder = corpus.join("bad-inputs");
    let special = tempfile::tempdir().unwrap();
    make_special(special.path());
    let index: Value = serde_json::from_str(&fs::read_to_string(folder.join("index.json")).unwrap()).unwrap();
    let (mut wrong, mut scored) = (Vec::new(), 0);
    for case in index["cases"].as_array().unwrap() {
        let path = match case["file"].as_str().unwrap().split_once('/') {
            Some(("special", name)) => special.path().join(name),
            _ => folder.join(case["file"].as_str().unwrap()),
        };
        // Permissions mean nothing to root.
        let is_readable = case["id"] == "P55" && fs::read(&path).is_ok();
        if path.extension().is_none_or(|extension| extension != "urdf") || is_readable {
            continue;
        }
        scored += 1;
        if let Err(reason) = verdict(case, &path) {
            wrong.push(format!("{} ({}): {reason}", case["id"], case["wrong"]));
        }
    }
    assert!(scored >= 60, "only {scored} cases were scored");
    assert!(wrong.is_empty(), "{} of {scored}:\n{}", wrong.len(), wrong.join("\n"));
}

#[cfg(unix)]
#[test]
fn hostile_files_of_every_kind_are_refused_at_once() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
    let link = |to: &str, name: &str| std::os::unix::fs::symlink(to, folder.path().join(name)).unwrap();
    write("huge_attribute.urdf", &format!("<robot name='{}'/>", "x".repeat(4 << 20)));
    write(
        "many_attributes.urdf",
        &format!("<robot {}/>", (0..200_000).map(|at| format!("k{at}='1'")).collect::<Vec<_>>().join(" ")),
    );
    write("deep.srdf", &("<group>".repeat(100_000) + &"</group>".repeat(100_000)));
    write("bomb.xml", "<!DOCTYPE r [<!ENTITY a 'aaaa'><!ENTITY b '&a;&a;&a;&a;'>]><robot name='&b;'/>");
    write("deep.toml", &format!("urdf = {}", "[".repeat(100_000)));
    write("deep.json", &"[".repeat(1_000_000));
    write("deep.csv", &",".repeat(1_000_000));
    link("loop.urdf", "loop.urdf");
    link("/dev/zero", "zero.urdf");
    link("/dev/zero", "zero.csv");
    fs::create_dir(folder.path().join("folder.srdf")).unwrap();
    write("r.urdf", ARM);
    for entry in fs::read_dir(folder.path()).unwrap().flatten().filter(|entry| entry.file_name() != "r.urdf")
    {
        #[expect(clippy::disallowed_methods, reason = "the time of an answer, which is asserted")]
        let start = std::time::Instant::now();
        let answer = congruent_json(&["lint", &text(&entry.path()), &text(&folder.path().join("r.urdf"))]);
        let took = start.elapsed();
        let name = entry.file_name();
        assert!(answer.code == 1 || answer.code == 2, "{name:?}: {} {}", answer.code, answer.stderr);
        assert!(took.as_secs() < 20, "{name:?}: {took:?}");
        assert!(answer.stdout.len() + answer.stderr.len() < 100_000, "{name:?} is answered by a book");
    }
}
