//! Published tables of the corpus against its URDFs, as robot files for the command.

use std::{fmt::Write, fs, path::Path};

use serde_json::Value;

use super::{
    command::{Answer, congruent_json, text},
    golden::read_json,
};

/// A published table and the URDF that it is held against.
pub(crate) struct Pairing<'a> {
    pub(crate) table: &'a str,
    pub(crate) urdf: &'a str,
    pub(crate) base: &'a str,
    pub(crate) tip: &'a str,
    pub(crate) joints: &'a [&'a str],
}

pub(crate) const UR5E_JOINTS: [&str; 6] = [
    "shoulder_pan_joint",
    "shoulder_lift_joint",
    "elbow_joint",
    "wrist_1_joint",
    "wrist_2_joint",
    "wrist_3_joint",
];
pub(crate) const PANDA_JOINTS: [&str; 7] = [
    "panda_joint1",
    "panda_joint2",
    "panda_joint3",
    "panda_joint4",
    "panda_joint5",
    "panda_joint6",
    "panda_joint7",
];

/// Writes a robot file with the table's own base and tool and checks it.
pub(crate) fn check_table(pairing: &Pairing<'_>, corpus: &Path) -> Answer {
    let tables = read_json(&corpus.join("robots/dh_tables.json"));
    let by_name = |table: &&Value| table["name"] == pairing.table;
    let table = tables["tables"].as_array().unwrap().iter().find(by_name).expect("the table exists");
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("robot.toml");
    fs::write(&file, robot_file(table, pairing, corpus)).unwrap();
    congruent_json(&["check", &text(&file)])
}

fn robot_file(table: &Value, pairing: &Pairing<'_>, corpus: &Path) -> String {
    let urdf = text(&corpus.join("robots").join(pairing.urdf).join("robot.urdf"));
    let convention = if table["convention"] == "classic" { "standard" } else { "modified" };
    let mut text = format!(
        "name = \"{}\"\nurdf = {:?}\nbase = \"{}\"\ntip = \"{}\"\n[tolerance]\nposition_m = 1e-9\norientation_rad = 1e-9\n\
         [dh]\nconvention = \"{convention}\"\nbase_from_dh0 = {{ matrix = {} }}\ndhn_from_tip = {{ matrix = {} }}\n",
        pairing.table, urdf, pairing.base, pairing.tip, table["base"], table["tool"]
    );
    for (row, joint) in table["rows"].as_array().unwrap().iter().zip(pairing.joints) {
        let sign = if row["flip"] == true { -1 } else { 1 };
        writeln!(
            text,
            "[[dh.row]]\njoint = \"{joint}\"\nkind = \"revolute\"\na_m = {}\nalpha_rad = {}\nd_m = {}\ntheta_rad = {}\nsign = {sign}",
            row["a"], row["alpha"], row["d"], row["theta_offset"]
        )
        .unwrap();
    }
    text
}
