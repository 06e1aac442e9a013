//! A published table as a data sheet prints it, and the URDF of the values before they were rounded.

use std::{fmt::Write, fs, path::Path};

use congruent_description::DhConvention;
use congruent_kinematics::{EulerSet, rotation_exp};
use nalgebra::{Matrix3, Vector3};

use super::Random;
use crate::robots::Texts;

/// Tables of the corpus, `robots/dh_tables.json`, which has the publication of each.
const OF_CORPUS: [&str; 8] = [
    "xarm7_vendor_modified",
    "ur3e_vendor",
    "fanuc_m16",
    "lite6_vendor_modified",
    "ur5_vendor_manual_serie3",
    "xarm6_vendor_standard",
    "baxter_left_rtb",
    "ur20_vendor",
];

/// The keys of a row, as most data sheets have their columns.
pub(super) const KEYS: [&str; 4] = ["a_mm", "alpha_deg", "d_mm", "theta_deg"];

/// A value under its key, as it is typed.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Typed {
    pub(super) key: &'static str,
    pub(super) text: String,
}

impl Typed {
    pub(super) fn value(&self) -> f64 {
        self.text.parse().unwrap()
    }
}

/// A typed table, and the URDF that it describes.
#[derive(Debug, Clone)]
pub(super) struct Sheet {
    name: String,
    pub(super) convention: DhConvention,
    /// The values of each row in the order of `KEYS`.
    pub(super) rows: Vec<[Typed; 4]>,
    /// The flange along the last axis, mm; missing if it was forgotten.
    pub(super) flange_mm: Option<String>,
    urdf: String,
}

/// The flange of every sheet, mm.
const FLANGE_MM: f64 = 45.5;

impl Sheet {
    /// Tables of `robots/`, then those of the corpus if it is at hand.
    pub(super) fn published() -> Vec<Self> {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
        let mut sheets: Vec<Self> = ["ur5e", "panda"].map(|name| Self::of_robot(&root, name)).into();
        if let Some(corpus) = std::env::var_os("CONGRUENT_CORPUS") {
            let text = fs::read_to_string(root.join(corpus).join("robots/dh_tables.json")).unwrap();
            let tables: serde_json::Value = serde_json::from_str(&text).unwrap();
            let tables = tables["tables"].as_array().unwrap();
            let named = |name| tables.iter().find(|table| table["name"] == name).unwrap();
            sheets.extend(OF_CORPUS.map(|name| Self::of_corpus(named(name))));
        }
        sheets
    }

    fn of_robot(root: &Path, name: &str) -> Self {
        let description = congruent_description::load_robot(&root.join("robots").join(name)).unwrap();
        let table = description.dh.unwrap();
        let row = |row: &congruent_description::DhRow| [row.a_m, row.alpha_rad, row.d_m, row.theta_rad];
        let rows: Vec<[f64; 4]> = table.rows.iter().map(row).collect();
        Self::new(name, table.convention, &rows)
    }

    fn of_corpus(table: &serde_json::Value) -> Self {
        let value = |row: &serde_json::Value, key: &str| row[key].as_f64().unwrap();
        let keys = ["a", "alpha", "d", "theta_offset"];
        let rows: Vec<[f64; 4]> =
            table["rows"].as_array().unwrap().iter().map(|row| keys.map(|key| value(row, key))).collect();
        let is_standard = table["convention"] == "classic";
        let convention = if is_standard { DhConvention::Standard } else { DhConvention::Modified };
        Self::new(table["name"].as_str().unwrap(), convention, &rows)
    }

    /// `rows` are in metres and radians.
    fn new(name: &str, convention: DhConvention, rows: &[[f64; 4]]) -> Self {
        let mut random = Random::new(u64::try_from(name.len()).unwrap());
        let (mut printed, mut exact) = (Vec::new(), Vec::new());
        for row in rows {
            let values = [0, 1, 2, 3].map(|at| print(row[at], KEYS[at], &mut random));
            exact.push(values.each_ref().map(|(_, exact)| *exact));
            let mut keys = KEYS.into_iter();
            printed.push(values.map(|(text, _)| Typed { key: keys.next().unwrap(), text }));
        }
        let flange = print(FLANGE_MM * 1e-3, "xyz_mm", &mut random);
        let urdf = urdf(convention, &exact, flange.1);
        Self { name: name.to_owned(), convention, rows: printed, flange_mm: Some(flange.0), urdf }
    }

    pub(super) fn texts(&self) -> Texts {
        let mut file = format!(
            "urdf = \"{}.urdf\"\nbase = \"base\"\ntip = \"tool\"\n\n[dh]\nconvention = \"{}\"\n",
            self.name,
            self.convention.name()
        );
        if let Some(flange) = &self.flange_mm {
            let _ = writeln!(file, "dhn_from_tip = {{ xyz_mm = [0, 0, {flange}] }}");
        }
        for (number, row) in (1..).zip(&self.rows) {
            let _ = write!(file, "\n[[dh.row]]\njoint = \"joint_{number}\"\nkind = \"revolute\"\n");
            for Typed { key, text } in row {
                let _ = writeln!(file, "{key} = {text}");
            }
        }
        Texts { name: self.name.clone(), robot_file: file, urdf: self.urdf.clone() }
    }
}

/// A value as it is printed, and before it was rounded, in m or rad. Zeros and quarter turns are exact.
fn print(value: f64, key: &str, random: &mut Random) -> (String, f64) {
    /// Most decimals of a length in millimetres and of an angle in degrees.
    const MOST: usize = 2;
    let is_angle = key.ends_with("_deg");
    let unit = if is_angle { 1.0_f64.to_radians() } else { 1e-3 };
    let in_unit = value / unit;
    let quarters = in_unit / 90.0;
    let is_exact = if is_angle { (quarters - quarters.round()).abs() < 1e-9 } else { value == 0.0 };
    if is_exact {
        let exact = if is_angle { quarters.round() * std::f64::consts::FRAC_PI_2 } else { 0.0 };
        return (format!("{}", in_unit.round() + 0.0), exact);
    }
    let least = if is_angle { MOST } else { 1 };
    let is_printed = |decimals: &usize| {
        let printed: f64 = format!("{in_unit:.decimals$}").parse().unwrap();
        (printed - in_unit).abs() < 1e-9
    };
    let decimals = (least..=MOST).find(is_printed).unwrap_or(MOST);
    let text = format!("{in_unit:.decimals$}");
    let half = 0.5 * 0.1_f64.powi(i32::try_from(decimals).unwrap());
    // Within nine tenths of half the last place, so that it is rounded to what is printed.
    let exact = text.parse::<f64>().unwrap() + 0.9 * half * random.unit();
    (text, exact * unit)
}

/// A chain of revolute joints about z.
fn urdf(convention: DhConvention, rows: &[[f64; 4]], flange_m: f64) -> String {
    let mut text = String::from("<robot name='sheet'>\n<link name='base'/>\n");
    let (mut parent, mut pending) = ("base".to_owned(), (Matrix3::identity(), Vector3::zeros()));
    for (number, [a, alpha, d, theta]) in (1..).zip(rows) {
        let about_x = (rotation_exp(&Vector3::new(*alpha, 0.0, 0.0)), Vector3::new(*a, 0.0, 0.0));
        let about_z = (rotation_exp(&Vector3::new(0.0, 0.0, *theta)), Vector3::new(0.0, 0.0, *d));
        // Standard: Rz(theta) Tz(d) Tx(a) Rx(alpha) behind the joint; modified: Rx(alpha) Tx(a) Rz(theta) Tz(d) before it.
        let none = (Matrix3::identity(), Vector3::zeros());
        let (before, behind) = match convention {
            DhConvention::Standard => (none, after(about_z, about_x)),
            DhConvention::Modified => (after(about_x, about_z), none),
        };
        let child = format!("link_{number}");
        let origin = origin(after(pending, before));
        let _ = write!(
            text,
            "<link name='{child}'/>\n<joint name='joint_{number}' type='revolute'><parent link='{parent}'/>\
             <child link='{child}'/>\n<origin {origin}/><axis xyz='0 0 1'/>\
             <limit lower='-2.9' upper='2.9' effort='100' velocity='2'/></joint>\n"
        );
        (parent, pending) = (child, behind);
    }
    let flange = format!("xyz='0 0 {flange_m:?}'");
    for (name, child, origin) in [("last_frame", "dhn", origin(pending)), ("flange", "tool", flange)] {
        let _ = write!(
            text,
            "<link name='{child}'/>\n<joint name='{name}' type='fixed'><parent link='{parent}'/>\
             <child link='{child}'/><origin {origin}/></joint>\n"
        );
        child.clone_into(&mut parent);
    }
    text + "</robot>\n"
}

type Motion = (Matrix3<f64>, Vector3<f64>);

fn after((rotation, shift): Motion, (then_rotation, then_shift): Motion) -> Motion {
    (rotation * then_rotation, shift + rotation * then_shift)
}

fn origin((rotation, shift): Motion) -> String {
    let [x, y, z]: [f64; 3] = shift.into();
    let [yaw, pitch, roll] = EulerSet::Zyx.angles_singular_below(&rotation, 1e-9).angles_rad;
    format!("xyz='{x:?} {y:?} {z:?}' rpy='{roll:?} {pitch:?} {yaw:?}'")
}
