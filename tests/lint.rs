//! `lint`: findings with codes and places, formats, exit codes, the ignore list.

use std::{fs, path::PathBuf};

use serde_json::Value;

use crate::command::{congruent, congruent_json, text};

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

#[test]
fn findings_have_a_place_a_number_and_what_they_stop() {
    let folder = Folder::new(&[("r.urdf", URDF)]);
    let answer = congruent(&["lint", &folder.text("r.urdf")]);
    assert_eq!(answer.code, 0, "{}", answer.stderr);
    for said in
        ["CGR-URDF-018 urdf::axis", "warning: joint \"turn\": axis is normalised", "r.urdf:6:5", "2 warnings"]
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
    assert_eq!(codes("r.srdf"), [""; 0]);
    assert_eq!(codes("data.csv"), ["lint::kind"]);
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
fn codes_are_explained_by_number_and_by_name() {
    for word in ["CGR-URDF-028", "urdf::massless"] {
        let answer = congruent(&["lint", "--explain", word]);
        assert!(
            answer.code == 0 && answer.stdout.starts_with("CGR-URDF-028 urdf::massless\n"),
            "{}",
            answer.stdout
        );
    }
    let unknown = congruent(&["lint", "--explain", "urdf::masless"]);
    assert_eq!(unknown.code, 2);
    assert!(unknown.stderr.contains("did you mean CGR-URDF-028, urdf::massless?"), "{}", unknown.stderr);
}

#[test]
fn safe_corrections_are_shown_and_written() {
    let misspelt = URDF.replace("<origin", "<orgin");
    let folder = Folder::new(&[("r.urdf", &misspelt)]);
    let file = folder.text("r.urdf");
    let dry = congruent(&["lint", &file, "--fix", "--dry-run"]);
    assert!(dry.code == 1 && dry.stdout.contains("\n-    <orgin xyz='0 0 0.3'/>"), "{}", dry.stdout);
    assert_eq!(fs::read_to_string(&file).unwrap(), misspelt);
    let fixed = congruent(&["lint", &file, "--fix"]);
    assert!(fixed.code == 0 && fixed.stdout.contains("\n+    <axis xyz='0 0 1'/>"), "{}", fixed.stdout);
    assert_eq!(fs::read_to_string(&file).unwrap(), URDF.replace("'0 0 2'", "'0 0 1'"));
    let sarif = congruent(&["lint", &folder.text("r.urdf"), "--format", "sarif"]).json();
    assert!(sarif["runs"][0]["results"].as_array().is_some_and(|results| !results.is_empty()));
}

/// The parts of the published schema of SARIF 2.1.0 that these documents use, with its constraints.
fn sarif_schema() -> Value {
    serde_json::from_str(include_str!("sarif_subset.json")).unwrap()
}

#[test]
fn sarif_has_the_published_structure() {
    let broken = URDF.replace("upper='1'", "upper='-2'");
    let folder = Folder::new(&[("r.urdf", URDF), ("broken.urdf", &broken)]);
    let files = [folder.text("r.urdf"), folder.text("broken.urdf"), folder.text("nowhere.urdf")];
    let answer = congruent(&["lint", &files[0], &files[1], &files[2], "--format", "sarif"]);
    assert_eq!(answer.code, 2);
    let document = answer.json();
    let schema = jsonschema::draft202012::new(&sarif_schema()).unwrap();
    let faults: Vec<String> =
        schema.iter_errors(&document).map(|error| format!("{}: {error}", error.instance_path())).collect();
    assert!(faults.is_empty(), "{faults:#?}");
    let run = &document["runs"][0];
    let results = run["results"].as_array().unwrap();
    let levels: Vec<&str> = results.iter().map(|result| result["level"].as_str().unwrap()).collect();
    assert!(levels.contains(&"error") && levels.contains(&"warning"), "{levels:?}");
    for result in results {
        let rule = usize::try_from(result["ruleIndex"].as_u64().unwrap()).unwrap();
        assert_eq!(run["tool"]["driver"]["rules"][rule]["id"], result["ruleId"]);
    }
    let other = congruent(&["describe", &files[0], "--format", "sarif"]);
    assert!(other.code == 2 && other.stderr.contains("lint"), "{}", other.stderr);
}
