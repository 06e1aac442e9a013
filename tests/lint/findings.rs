//! `lint`: findings with codes and places, formats, exit codes, the ignore list.

use std::{fs, path::PathBuf};

use serde_json::Value;

use crate::support::command::{congruent, congruent_json, text};

const URDF: &str = "<robot name='r'>
  <link name='base'/>
  <link name='arm'/>
  <joint name='turn' type='revolute'>
    <origin xyz='0 0 0.3'/><parent link='base'/><child link='arm'/>
    <axis xyz='0 0 2'/>
    <limit lower='-1' upper='1' effort='10' velocity='2'/>
  </joint>
</robot>
";

struct Folder(tempfile::TempDir);

impl Folder {
    fn new(files: &[(&str, &str)]) -> Self {
        let folder = Self(tempfile::tempdir().unwrap());
        for (name, contents) in files {
            fs::write(folder.path(name), contents).unwrap();
        }
        folder
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn text(&self, name: &str) -> String {
        text(&self.path(name))
    }
}

/// Masses are judged although a limit is wrong; what needs a robot is said not to be.
#[test]
fn an_error_hides_no_other_error() {
    let body = "<inertial><mass value='-3.9'/><inertia ixx='0.1' ixy='0' ixz='0' iyy='0.1' iyz='0' izz='0.1'/></inertial>";
    let wrong = URDF
        .replace("lower='-1' upper='1'", "lower='1' upper='-1'")
        .replace("<link name='arm'/>", &format!("<link name='arm'>{body}</link>"));
    let folder = Folder::new(&[("r.urdf", &wrong)]);
    let answer = congruent(&["lint", &folder.text("r.urdf")]);
    assert_eq!(answer.code, 1, "{}", answer.stderr);
    for said in ["lower limit 1 is above upper limit -1", "-3.9", "not examined: units, "] {
        assert!(answer.stdout.contains(said), "no {said:?} in {}", answer.stdout);
    }
    let report = congruent_json(&["lint", &folder.text("r.urdf")]).json();
    assert_eq!((&report["errors"], &report["is_incomplete"]), (&2.into(), &true.into()), "{report}");
    let right = Folder::new(&[("r.urdf", URDF)]);
    let answer = congruent(&["lint", &right.text("r.urdf")]);
    assert!(!answer.stdout.contains("not examined"), "{}", answer.stdout);
}

#[test]
fn findings_have_a_place_a_number_and_what_they_stop() {
    let folder = Folder::new(&[("r.urdf", URDF)]);
    let answer = congruent(&["lint", &folder.text("r.urdf")]);
    assert_eq!(answer.code, 0, "{}", answer.stderr);
    for said in
        ["CGR-URDF-018 urdf::axis", "warning: joint \"turn\": axis has length 2", "r.urdf:6:5", "2 warnings"]
    {
        assert!(answer.stdout.contains(said), "no {said:?} in {}", answer.stdout);
    }
    let report = congruent_json(&["lint", &folder.text("r.urdf")]).json();
    assert_eq!((&report["verdict"], &report["kind"]), (&"warnings".into(), &"urdf".into()));
    let finding = &report["findings"][1];
    assert_eq!((&finding["id"], &finding["code"]), (&"CGR-URDF-018".into(), &"urdf::axis".into()));
    assert_eq!((&finding["line"], &finding["column"]), (&6.into(), &5.into()));

    let strict = congruent(&["lint", "--strict", &folder.text("r.urdf")]);
    assert_eq!(strict.code, 1);
}

#[test]
fn an_error_ends_with_1_and_a_missing_file_with_2() {
    let broken = URDF.replace("'0 0 0.3'", "'0 0,3'");
    let folder = Folder::new(&[("r.urdf", &broken), ("good.urdf", URDF)]);
    let answer = congruent_json(&["lint", &folder.text("r.urdf")]);
    let report = answer.json();
    assert_eq!((answer.code, &report["verdict"]), (1, &"errors".into()));
    assert_eq!(report["stops"], serde_json::json!(["kinematics", "clearance", "physics"]));
    assert_eq!(congruent(&["lint", &folder.text("nowhere.urdf")]).code, 2);
    let several = congruent_json(&["lint", &folder.text("good.urdf"), &folder.text("r.urdf")]);
    assert_eq!((several.code, several.json().as_array().map(Vec::len)), (1, Some(2)));
}

#[test]
fn what_physics_alone_needs_stops_physics_alone() {
    let impossible = URDF.replace(
        "<link name='arm'/>",
        "<link name='arm'><inertial><mass value='2'/>\
         <inertia ixx='3' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial></link>",
    );
    let folder = Folder::new(&[("r.urdf", &impossible)]);
    let report = congruent_json(&["lint", &folder.text("r.urdf")]).json();
    assert_eq!((&report["stops"], &report["verdict"]), (&serde_json::json!(["physics"]), &"errors".into()));
}

#[test]
fn robot_files_scenarios_and_srdfs_are_linted() {
    let scenario = "schema_version = 1\nname = 's'\nrobot = 'robot.toml'\n[simulation]\nduration_s = 0.01\n\
                    [controller]\nkind = 'passive'\nstifness = 1\n[[check]]\nkind = 'agreement'\n";
    let folder = Folder::new(&[
        ("r.urdf", URDF),
        ("robot.toml", "urdf = 'r.urdf'\nsrdf = 'r.srdf'\n[tcp]\nxyz_m = [0, 0, 50]\n"),
        ("r.srdf", "<robot name='r'><disable_collisions link1='base' link2='arn'/></robot>"),
        ("s.toml", scenario),
        ("data.csv", "a,b\n1,2\n"),
    ]);
    let codes = |name: &str| -> Vec<String> {
        let report = congruent_json(&["lint", &folder.text(name)]).json();
        let findings = report["findings"].as_array().unwrap().iter();
        findings.map(|found| found["code"].as_str().unwrap().to_owned()).collect()
    };
    let of_robot = codes("robot.toml");
    for code in ["robot_file::length", "srdf::unknown_link", "urdf::axis", "urdf::massless"] {
        assert!(of_robot.iter().any(|found| found == code), "no {code} in {of_robot:?}");
    }
    assert!(codes("s.toml").contains(&"toml::unknown_key".to_owned()), "{:?}", codes("s.toml"));
    assert_eq!(codes("r.srdf"), ["srdf::unknown_link"]);
    assert_eq!(codes("data.csv"), ["measurements::unknown_column"; 2]);
}

#[test]
fn an_ignore_list_has_reasons_and_hides_nothing_else() {
    let entry = |code: &str| format!("[[lint.ignore]]\ncode = '{code}'\nreason = 'as delivered'\n");
    let folder = Folder::new(&[("r.urdf", URDF)]);
    let report = |entries: &str| {
        fs::write(folder.path("robot.toml"), format!("urdf = 'r.urdf'\n{entries}")).unwrap();
        congruent_json(&["lint", &folder.text("robot.toml")]).json()
    };
    let one = report(&entry("CGR-URDF-018"));
    assert_eq!(one["ignored"][0]["reason"], "as delivered");
    assert_eq!(one["findings"].as_array().map(Vec::len), Some(1), "{one:#}");
    let both = report(&(entry("urdf::axis") + &entry("CGR-URDF-028")));
    assert_eq!((&both["verdict"], both["ignored"].as_array().map(Vec::len)), (&"clean".into(), Some(2)));
    let unused = report(&entry("CGR-URDF-024"));
    let last =
        unused["findings"].as_array().unwrap().iter().find(|found| found["code"] == "lint::ignored_nothing");
    assert_eq!(last.unwrap()["line"], 3);
}

#[test]
fn safe_corrections_are_shown_and_written() {
    // The byte order mark stays.
    let misspelt = format!("\u{feff}{}", URDF.replace("<origin", "<orgin"));
    let folder = Folder::new(&[("r.urdf", &misspelt)]);
    let file = folder.text("r.urdf");
    let dry = congruent(&["lint", &file, "--fix", "--dry-run"]);
    assert!(dry.code == 1 && dry.stdout.contains("\n-    <orgin xyz='0 0 0.3'/>"), "{}", dry.stdout);
    assert_eq!(fs::read_to_string(&file).unwrap(), misspelt);
    let fixed = congruent(&["lint", &file, "--fix"]);
    assert!(fixed.code == 0 && fixed.stdout.contains("\n+    <axis xyz='0 0 1'/>"), "{}", fixed.stdout);
    let right = format!("\u{feff}{}", URDF.replace("'0 0 2'", "'0 0 1'"));
    assert_eq!(fs::read_to_string(&file).unwrap(), right);
    let sarif = congruent(&["lint", &folder.text("r.urdf"), "--format", "sarif"]).json();
    assert!(sarif["runs"][0]["results"].as_array().is_some_and(|results| !results.is_empty()));
}

/// The log as SARIF, which is as the schema of the standard asks.
#[track_caller]
fn sarif(arguments: &[&str]) -> (i32, Value) {
    let answer = congruent(&[&["lint", "--format", "sarif"], arguments].concat());
    let document = answer.json();
    let mut schema: Value = serde_json::from_str(include_str!("sarif/sarif-schema-2.1.0.json")).unwrap();
    // The pattern of a language has a bracket that nothing opens, which the crate refuses; none is written here.
    for of in ["run", "toolComponent"] {
        schema["definitions"][of]["properties"]["language"].as_object_mut().unwrap().remove("pattern");
    }
    let schema = jsonschema::draft7::options().should_validate_formats(true).build(&schema).unwrap();
    let faults: Vec<String> =
        schema.iter_errors(&document).map(|error| format!("{}: {error}", error.instance_path())).collect();
    assert!(faults.is_empty(), "{faults:#?}");
    (answer.code, document)
}

#[test]
fn sarif_is_as_the_standard_asks_and_as_code_hosts_need_it() {
    let broken = URDF.replace("upper='1'", "upper='-2'");
    let misspelt = URDF.replace("<origin", "<orgin");
    let cut = URDF.replace("</robot>", "");
    let files =
        [("r.urdf", URDF), ("broken.urdf", &broken), ("my rob\u{f6}t.urdf", &misspelt), ("cut.urdf", &cut)];
    let folder = Folder::new(&files);
    let names = ["r.urdf", "broken.urdf", "my rob\u{f6}t.urdf", "cut.urdf", "nowhere.urdf"];
    let paths = names.map(|name| folder.text(name));
    let (code, document) = sarif(&paths.each_ref().map(String::as_str));
    assert_eq!(code, 2);
    let run = &document["runs"][0];
    let results = run["results"].as_array().unwrap();
    let rules = run["tool"]["driver"]["rules"].as_array().unwrap();
    let levels: Vec<&str> = results.iter().map(|result| result["level"].as_str().unwrap()).collect();
    assert!(levels.contains(&"error") && levels.contains(&"warning"), "{levels:?}");
    let mut fingerprints = std::collections::BTreeSet::new();
    for result in results {
        let rule = usize::try_from(result["ruleIndex"].as_u64().unwrap()).unwrap();
        assert_eq!(rules[rule]["id"], result["ruleId"]);
        let place = &result["locations"][0]["physicalLocation"];
        assert!(place["region"]["startLine"].as_u64().unwrap() >= 1, "{result:#}");
        let uri = place["artifactLocation"]["uri"].as_str().unwrap();
        assert!(uri.starts_with("file:///") && uri.is_ascii() && !uri.contains([' ', '\\']), "{uri}");
        let fingerprint = result["partialFingerprints"]["congruentFinding/v1"].as_str().unwrap();
        assert!(fingerprints.insert(fingerprint.to_owned()), "twice: {result:#}");
    }
    assert!(document.to_string().contains("my%20rob%C3%B6t.urdf"));
    let related = results.iter().filter_map(|result| result["relatedLocations"].as_array()).flatten();
    let lines: Vec<&Value> = related.map(|place| &place["physicalLocation"]["region"]["startLine"]).collect();
    assert_eq!(lines, [1], "the element that is not closed");
    let fixed = |result: &&Value| result["fixes"].is_array();
    assert!(results.iter().any(|result| fixed(&result)), "{results:#?}");
    let other = congruent(&["describe", &paths[0], "--format", "sarif"]);
    assert!(other.code == 2 && other.stderr.contains("lint"), "{}", other.stderr);
}

#[test]
fn sarif_names_files_from_the_top_of_the_repository() {
    let folder = Folder::new(&[]);
    let inner = folder.path("robots/my arm");
    fs::create_dir_all(&inner).unwrap();
    fs::create_dir(folder.path(".git")).unwrap();
    fs::write(inner.join("r.urdf"), URDF).unwrap();
    let answer = crate::support::command::congruent_in(&inner, &["lint", "--format", "sarif", "./r.urdf"]);
    let place =
        &answer.json()["runs"][0]["results"][0]["locations"][0]["physicalLocation"]["artifactLocation"];
    assert_eq!(*place, serde_json::json!({ "uri": "robots/my%20arm/r.urdf", "uriBaseId": "%SRCROOT%" }));
}

/// Codes and messages of what is reported of one of several files.
fn reported(arguments: &[&str], of: &str) -> Vec<(String, String)> {
    let report = congruent_json(&[&["lint"], arguments].concat()).json();
    let reports = report.as_array().cloned().unwrap_or_else(|| vec![report]);
    let report = if reports.len() == 1 {
        &reports[0]
    } else {
        reports
            .iter()
            .find(|report| report["input"].as_str().is_some_and(|input| input.ends_with(of)))
            .unwrap()
    };
    let text = |value: &Value| value.as_str().unwrap_or_default().to_owned();
    let findings = report["findings"].as_array().unwrap().iter();
    findings.map(|found| (text(&found["code"]), text(&found["message"]))).collect()
}

#[test]
fn an_srdf_is_compared_with_the_robot_that_it_is_of() {
    let srdf = "<robot name='r'>\n<group name='g'><chain base_link='base' tip_link='amr'/></group>\n\
                <disable_collisions link1='base' link2='amr'/></robot>";
    let unknown = ("srdf::unknown_link".to_owned(), "2 link names are not in the robot: amr, amr".to_owned());
    // Beside it, with it in the call, and named by a robot file.
    let beside = Folder::new(&[("r.urdf", URDF), ("r.srdf", srdf)]);
    assert_eq!(reported(&[&beside.text("r.srdf")], "r.srdf"), std::slice::from_ref(&unknown));
    let [robot, alone] = [Folder::new(&[("r.urdf", URDF)]), Folder::new(&[("r.srdf", srdf)])];
    let together = [robot.text("r.urdf"), alone.text("r.srdf")];
    assert_eq!(reported(&[&together[0], &together[1]], "r.srdf"), std::slice::from_ref(&unknown));
    assert_eq!(reported(&[&together[1], &together[0]], "r.srdf"), std::slice::from_ref(&unknown));
    let named = Folder::new(&[
        ("r.urdf", URDF),
        ("r.srdf", srdf),
        ("robot.toml", "urdf = 'r.urdf'\nsrdf = 'r.srdf'"),
    ]);
    let of_robot = reported(&[&named.text("robot.toml")], "robot.toml");
    assert_eq!(of_robot.iter().filter(|found| **found == unknown).count(), 1, "{of_robot:?}");
    // Without a robot that is reported, and with another one.
    let (code, message) = &reported(&[&alone.text("r.srdf")], "r.srdf")[0];
    assert!(code == "lint::no_robot" && message.contains("not checked"), "{message}");
    let other = Folder::new(&[("q.urdf", &URDF.replace("name='r'", "name='q'"))]);
    let codes: Vec<String> = reported(&[&alone.text("r.srdf"), &other.text("q.urdf")], "r.srdf")
        .into_iter()
        .map(|(code, _)| code)
        .collect();
    assert_eq!(codes, ["srdf::robot_name", "srdf::unknown_link"]);
}

#[test]
fn tables_are_read_as_their_commands_read_them() {
    let folder = Folder::new(&[
        ("r.urdf", URDF),
        ("good.json", "[{\"q\": {\"turn\": 0.5}}]"),
        ("wrong.json", "[{\"q\": {\"tunr\": 0.5}}]"),
        ("targets.json", "[{\"translation_m\": [0, 0, 1], \"quaternion_wxyz\": [2, 0, 0, 0]}]"),
        ("measured.csv", "turn_rad,x_m\n0.1,a\n"),
        ("time.csv", "time_s,turn_rad\n0,0\n1,1\n"),
        ("log.mcap", "x"),
    ]);
    let robot = folder.text("r.urdf");
    let codes = |name: &str| -> Vec<String> {
        reported(&[&robot, &folder.text(name)], name).into_iter().map(|(code, _)| code).collect()
    };
    assert_eq!(codes("good.json"), [""; 0]);
    assert_eq!(codes("wrong.json"), ["configurations::unknown_joint"]);
    assert_eq!(codes("targets.json"), ["targets::quaternion_norm"]);
    assert_eq!(codes("measured.csv"), ["measurements::number"]);
    assert_eq!(codes("time.csv"), ["lint::kind"]);
    assert_eq!(codes("log.mcap"), ["lint::kind"]);
    let alone = congruent_json(&["lint", &folder.text("good.json")]);
    assert_eq!((alone.code, &alone.json()["findings"][0]["code"]), (2, &"lint::no_robot".into()));
    fs::write(folder.path("robot.toml"), "urdf = 'r.urdf'").unwrap();
    assert_eq!(reported(&[&folder.text("good.json")], "good.json"), []);
}

#[test]
fn a_misspelt_key_of_a_robot_file_is_corrected() {
    let misspelt = "urfd = \"r.urdf\"\n[tcp]\nxzy_m = [0, 0, 0.1]\nrpy_rd = [0, 0, 1]\n";
    let folder = Folder::new(&[("r.urdf", URDF), ("robot.toml", misspelt)]);
    let file = folder.text("robot.toml");
    let dry = congruent(&["lint", &file, "--fix", "--dry-run"]);
    assert!(dry.stdout.contains("\n+urdf = \"r.urdf\"") && dry.stdout.contains("\n+xyz_m"), "{}", dry.stdout);
    assert_eq!(fs::read_to_string(&file).unwrap(), misspelt);
    congruent(&["lint", &file, "--fix"]);
    let fixed = "urdf = \"r.urdf\"\n[tcp]\nxyz_m = [0, 0, 0.1]\nrpy_rd = [0, 0, 1]\n";
    assert_eq!(fs::read_to_string(&file).unwrap(), fixed);
}

#[test]
fn an_element_that_is_open_is_shown_where_it_begins_and_where_the_file_ends() {
    let folder = Folder::new(&[
        ("r.urdf", &URDF.replace("</robot>\n", "")),
        ("j.urdf", &URDF.replace("  </joint>\n", "")),
    ]);
    let finding = |name: &str| congruent_json(&["lint", &folder.text(name)]).json()["findings"][0].clone();
    let cut = finding("r.urdf");
    assert_eq!((&cut["line"], &cut["related"]["line"]), (&8.into(), &1.into()), "{cut:#}");
    assert!(cut["message"].as_str().unwrap().contains("opened in line 1"));
    let open = finding("j.urdf");
    assert_eq!((&open["line"], &open["related"]["line"]), (&8.into(), &4.into()), "{open:#}");
    let shown = congruent(&["lint", &folder.text("j.urdf")]).stdout;
    assert!(
        shown.contains("<joint> is opened here") && shown.contains("</robot> where </joint> is expected"),
        "{shown}"
    );
}

/// An arm of 0.3 m, and points that were measured on it.
const ROBOT: &str = "urdf = 'r.urdf'\nbase = 'base'\ntip = 'tip'\n";
const ARM: &str = "<robot name='r'><link name='base'/><link name='arm'/><link name='tip'/>
  <joint name='turn' type='revolute'><parent link='base'/><child link='arm'/><axis xyz='0 0 1'/>
    <limit lower='-1' upper='1' effort='10' velocity='2'/></joint>
  <joint name='end' type='fixed'><origin xyz='0.3 0 0'/><parent link='arm'/><child link='tip'/></joint></robot>
";

#[test]
fn a_table_in_another_unit_is_reported() {
    let points = "turn_deg,x_m,y_m,z_m\n0,0.3,0,0\n30,0.2598,0.15,0\n-30,0.2598,-0.15,0\n";
    let targets = r#"[{"translation_m": [0.2598, 0.15, 0]}]"#;
    let reported = |table: &str, text: &str| {
        let folder = Folder::new(&[("r.urdf", ARM), ("robot.toml", ROBOT), (table, text)]);
        let report = congruent_json(&["lint", &folder.text("robot.toml"), &folder.text(table)]).json();
        let findings = report[1]["findings"].as_array().unwrap_or_else(|| panic!("{report}")).clone();
        findings.into_iter().map(|found| found["code"].as_str().unwrap().to_owned()).collect::<Vec<_>>()
    };
    assert_eq!(reported("points.csv", points), [""; 0]);
    let in_mm = "turn_deg,x_m,y_m,z_m\n0,300,0,0\n30,259.8,150,0\n-30,259.8,-150,0\n";
    assert_eq!(reported("points.csv", in_mm), ["units::measured_point"]);
    assert_eq!(
        reported("points.csv", &points.replace("30,0.2598,0.15", "30,259.8,150")),
        ["units::measured_point"]
    );
    assert_eq!(
        reported("points.csv", &points.replace("turn_deg", "turn_rad")),
        ["measurements::outside_limits"]
    );
    // In the frame of a tracker, far away.
    let far = points.replace(",0.3,", ",12.3,").replace("0.2598", "12.2598");
    assert_eq!(reported("points.csv", &far), [""; 0]);
    assert_eq!(reported("targets.json", targets), [""; 0]);
    assert_eq!(
        reported("targets.json", &targets.replace("[0.2598, 0.15, 0]", "[259.8, 150, 0]")),
        ["units::target"]
    );
}

#[test]
fn many_findings_are_cut_for_people_alone() {
    use std::fmt::Write;
    let mut robot_file = format!("{ROBOT}[dh]\nconvention = 'standard'\n");
    for _ in 0..499 {
        robot_file +=
            "[[dh.row]]\njoint = 'turn'\nkind = 'revolute'\na_m = 0.3\nd_m = 0\nalpha_deg = 0\nsign = 2\n";
    }
    let folder = Folder::new(&[("r.urdf", ARM), ("robot.toml", &robot_file)]);
    let answer = congruent(&["lint", &folder.text("robot.toml")]);
    assert_eq!(answer.code, 1);
    assert_eq!(answer.stdout.matches("robot_file::sign").count(), 100);
    assert!(answer.stdout.contains("\nand 400 more; --verbose shows all\n"), "{}", answer.stdout);
    let all = congruent(&["lint", "--verbose", &folder.text("robot.toml")]);
    assert_eq!(all.stdout.matches("robot_file::sign").count(), 499);
    let mut wide = String::new();
    let _ = write!(wide, "<robot name='r'><link name='{}'/></robot>", "x".repeat(70_000));
    let folder = Folder::new(&[("wide.urdf", &wide)]);
    assert_eq!(congruent(&["fk", &folder.text("wide.urdf")]).code, 0, "a name that is wider than any column");
}
