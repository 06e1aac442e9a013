//! `congruent check --against` of pairs of public descriptions of one robot, against `pair.json` of each, which an independent
//! program made: mapping of joints, geometry before and after it, limits, efforts, masses, gravity torques, and causes.
//!
//! Each pair is checked twice: as a user does it first, and with what the first answer says to declare, in the part of the robot
//! that `pair.json` is about. `DEVIATIONS` has where the two differ, with the reason.

use std::{fs, path::Path};

use serde_json::Value;

use crate::support::{
    command::{Answer, congruent_json, text},
    corpus::corpus,
    scratch_folder::ScratchFolder,
};

/// Angles of these files have five or six digits: 1.57079 and 3.14158 for half a turn and a turn. Two roundings of 6.3e-6 rad in
/// one zero are the largest sum seen, 1.26e-5 rad (`so_arm100`).
const ROUNDED_RAD: f64 = 2e-5;
/// Ends of ranges have two decimals and more, as 3.14 for half a turn.
const ROUNDED_END_RAD: f64 = 5e-3;
/// `pair.json` fits base and tool to 40 configurations and takes the worst of 4000 others; the program takes what is declared and
/// searches. Seen: 0.59 to 1.4 before the mapping.
const OTHER_FIT: f64 = 2.0;
/// Where lengths differ by a millimetre, that turns the base that `pair.json` fits.
const FITTED_BASE_RAD: f64 = 5e-4;
/// What rounded angles do to the tip of an arm of at most one metre.
const ROUNDED_M: f64 = ROUNDED_RAD;
/// A torque of the 2000 samples may exceed one of the search by rounding of the search's box, relative.
const SEARCHED: f64 = 1e-3;
/// Values that both files write with the same digits.
const SAME_DIGITS: f64 = 1e-9;
const STANDARD_GRAVITY_M_S2: f64 = 9.81;

/// A public pair, and the tolerance within which dynamics is compared: the geometry of some differs by rounded values.
struct PublicPair {
    folder: &'static str,
    tolerance: &'static str,
}

const PAIRS: [PublicPair; 7] = [
    PublicPair { folder: "ur5e", tolerance: "3mm,0.1deg" },
    PublicPair { folder: "wx250s", tolerance: "1nm" },
    PublicPair { folder: "so_arm100", tolerance: "20um,0.01deg" },
    PublicPair { folder: "panda", tolerance: "1nm" },
    PublicPair { folder: "piper", tolerance: "20um,0.01deg" },
    PublicPair { folder: "urdf-ur5e-vendor-rosi", tolerance: "1nm" },
    PublicPair { folder: "urdf-jaco-kinova-drake", tolerance: "1nm" },
];

/// What of `pair.json` the program does not say, or says in other words: pair, what, and why. A test fails if one of these is said
/// after all, so that the list stays true.
const DEVIATIONS: [(&str, &str, &str); 7] = [
    ("ur5e", "length of shoulder_pan_joint", ROUNDED_LENGTHS),
    ("ur5e", "length of wrist_1_joint", ROUNDED_LENGTHS),
    ("ur5e", "length of wrist_3_joint", ROUNDED_LENGTHS),
    (
        "wx250s",
        "inertia_rotation_dropped of wx250s/base_link",
        "nothing moves the base, so no torque depends on its inertia",
    ),
    (
        "wx250s",
        "inertia_rotation_dropped of wx250s/shoulder_link",
        "it is a quarter turn about the axis of the first joint, which changes no torque",
    ),
    (
        "so_arm100",
        "mass of base",
        "nothing moves the base: the difference is in the total mass, which is compared",
    ),
    ("sdf-iiwa14", "everything", "SDF is not read, which is said"),
];
const ROUNDED_LENGTHS: &str =
    "all bodies lie in a base that is turned by half a turn, so that no single length is the cause";

fn is_deviation(pair: &str, what: &str) -> bool {
    DEVIATIONS.iter().any(|(folder, name, _)| (*folder, *name) == (pair, what))
}

/// The files of a pair and what the independent program says.
struct Read {
    name: &'static str,
    a: String,
    b: String,
    expected: Value,
}

impl Read {
    fn new(corpus: &Path, name: &'static str) -> Self {
        let folder = corpus.join("pairs").join(name);
        let expected: Value =
            serde_json::from_str(&fs::read_to_string(folder.join("pair.json")).unwrap()).unwrap();
        let file = |side: &str| text(&folder.join(expected[side]["file"].as_str().unwrap()));
        Self { name, a: file("a"), b: file("b"), expected }
    }

    fn joints(&self) -> &[Value] {
        self.expected["joints"].as_array().unwrap()
    }

    /// The moving joints of a file that are no part of the pair.
    fn left_out(&self, file: &str, side: &str) -> Vec<String> {
        let described = congruent_json(&["describe", file]).json();
        let moving = described["joints"].as_array().unwrap().iter().filter(|joint| joint["kind"] != "fixed");
        let names = moving.map(|joint| joint["name"].as_str().unwrap());
        let is_of_pair = |name: &&str| self.joints().iter().any(|joint| joint[side] == *name);
        names.filter(|name| !is_of_pair(name)).map(str::to_owned).collect()
    }

    /// The check of the part that the pair is about, with these variables of the joints: sign and offset in rad.
    fn declared(&self, variables: impl Fn(&Value) -> (i64, f64), tolerance: &str) -> Value {
        let scratch = ScratchFolder::new();
        let left_out = [self.left_out(&self.a, "a"), self.left_out(&self.b, "b")].concat();
        let tip = &self.expected["a"]["tip"];
        let mut lines = vec![
            format!(
                "urdf = {:?}\ntip = {tip}\n[mapping]\nbase = \"fitted\"\nleft_out = {left_out:?}",
                self.a
            ),
            "[mapping.joints]".to_owned(),
        ];
        for joint in self.joints() {
            let (sign, offset_rad) = variables(joint);
            lines.push(format!(
                "{} = {{ joint = {}, sign = {sign}, offset_rad = {offset_rad:?} }}",
                joint["a"], joint["b"]
            ));
        }
        let file = scratch.write("robot.toml", &(lines.join("\n") + "\n"));
        let answer = congruent_json(&["check", &file, "--against", &self.b, "--tolerance", tolerance]);
        assert_eq!(answer.code, 1, "{}: {}", self.name, answer.stderr);
        answer.json()
    }
}

/// The variables that the program finds without a declaration; `None` if it compares the joints as they are.
fn found_variables(pair: &Read) -> Option<Vec<Value>> {
    let Answer { code, stdout, stderr } = congruent_json(&["check", &pair.a, "--against", &pair.b]);
    assert_eq!(code, 1, "{}: {stderr}", pair.name);
    let report: Value = serde_json::from_str(&stdout).unwrap();
    Some(report["against"]["mapping"]["joints"].as_array()?.clone())
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("no number: {value}"))
}

/// The sign and the zero of each joint as `pair.json` has them.
fn check_mapping(pair: &Read) {
    let Some(found) = found_variables(pair) else {
        let is_same = |joint: &Value| joint["sign"] == 1 && number(&joint["offset_rad"]) == 0.0;
        assert!(pair.joints().iter().all(is_same), "{}: no mapping is found", pair.name);
        return;
    };
    let mut compared = 0;
    for joint in pair.joints() {
        let Some(here) = found.iter().find(|of| of["joint"] == joint["a"]) else { continue };
        assert_eq!([&here["other"], &here["sign"]], [&joint["b"], &joint["sign"]], "{}", pair.name);
        let off = number(&here["offset"]) - number(&joint["offset_rad"]);
        // Another zero of the first joint is a turned base, which `pair.json` fits.
        let turned = pair.expected["base_a_from_b"]["rpy_rad"].as_array().map(|rpy| number(&rpy[2]).abs());
        let is_base = compared == 0 && (off.abs() - turned.unwrap()).abs() < FITTED_BASE_RAD;
        assert!(is_base || off.abs() < ROUNDED_RAD, "{}: {here} {joint}", pair.name);
        compared += 1;
    }
    assert_eq!(compared, pair.joints().len(), "{}: joints that are compared", pair.name);
}

/// The difference of the tip's position, in metres.
fn tip_m(pair: &Read, report: &Value) -> f64 {
    let comparisons = report["comparisons"].as_array().unwrap();
    let other = comparisons.iter().find(|of| of["name"] == "urdf_other").expect("the other is compared");
    let tip = &pair.expected["a"]["tip"];
    let links = other["links"].as_array().unwrap();
    number(
        &links.iter().find(|of| of["link"] == *tip).unwrap_or_else(|| panic!("{tip}: {links:?}"))["position_m"],
    )
}

fn check_geometry(pair: &Read, same: &Value, mapped: &Value) {
    let expected = |of: &str| number(&pair.expected["geometry"][of]["position_m"]);
    let (before, before_m) = (tip_m(pair, same), expected("same_variables"));
    let within = |found: f64, wanted: f64| {
        found <= OTHER_FIT * wanted + ROUNDED_M && wanted <= OTHER_FIT * found + ROUNDED_M
    };
    assert!(within(before, before_m), "{}: {before} m, expected {before_m} m", pair.name);
    let (after, after_m) = (tip_m(pair, mapped), expected("mapped"));
    assert!(within(after, after_m), "{}: {after} m, expected {after_m} m", pair.name);
}

/// The values of limits that differ, and no others but those that the digits explain.
fn check_limits(pair: &Read, report: &Value) {
    let limits = report["dynamics"]["limits"].as_array().unwrap();
    let rounded = report["against"]["values_within_digits"].as_array();
    let is_rounded = |value: String| rounded.is_some_and(|all| all.iter().any(|of| *of == value));
    for joint in pair.joints() {
        let sides = [
            ("lower", &joint["limits_a"][0], &joint["limits_b"][0]),
            ("upper", &joint["limits_a"][1], &joint["limits_b"][1]),
            ("effort", &joint["effort"][0], &joint["effort"][1]),
        ];
        for (figure, a, b) in sides {
            let (Some(a), Some(b)) = (a.as_f64(), b.as_f64()) else { continue };
            let listed = limits
                .iter()
                .find(|of| of["joint"] == joint["a"] && of["figure"] == figure && of["decides"] == true);
            let Some(listed) = listed else {
                let allowed = match figure {
                    "effort" => SAME_DIGITS,
                    end if is_rounded(format!("{}: {end}", joint["a"].as_str().unwrap())) => ROUNDED_END_RAD,
                    _ => ROUNDED_RAD,
                };
                assert!((a - b).abs() <= allowed, "{}: {figure} of {joint} is not listed", pair.name);
                continue;
            };
            assert!((a - b).abs() > SAME_DIGITS, "{}: {listed} is no difference", pair.name);
            let [found, there] = ["found", "expected"].map(|side| number(&listed[side]));
            assert!((found - a).abs() < SAME_DIGITS, "{}: {listed}", pair.name);
            assert!((there - b).abs() < ROUNDED_RAD, "{}: {listed}, expected {b}", pair.name);
        }
    }
}

/// The mass of each body that moves, of the base, and their sums.
fn check_masses(pair: &Read, report: &Value) {
    let bodies = pair.expected["bodies"].as_array().unwrap();
    let masses = |body: &Value| [0, 1].map(|side| number(&body["mass_kg"][side]));
    let invariants = &report["dynamics"]["invariants"];
    let difference = |of: &str| number(&invariants[of]["found"]) - number(&invariants[of]["expected"]);
    let sum = |bodies: &[Value]| bodies.iter().map(masses).map(|[a, b]| a - b).sum::<f64>();
    // The base, which comes first, moves with nothing.
    for (what, wanted) in [("total_mass_kg", sum(bodies)), ("moving_mass_kg", sum(&bodies[1..]))] {
        let found = difference(what);
        assert!((found - wanted).abs() < 1e-6, "{}: {what}: {found} kg, expected {wanted} kg", pair.name);
    }
    for body in &bodies[1..] {
        let [a, b] = masses(body);
        if (a - b).abs() < 1e-6 {
            continue;
        }
        let figures = figures(report).filter(|of| of["figure"] == "mass");
        let is_of_body = |of: &&Value| body["links_a"].as_array().unwrap().contains(&of["of"]);
        let found =
            figures.into_iter().find(is_of_body).unwrap_or_else(|| panic!("{}: mass of {body}", pair.name));
        let off = [number(&found["found"]) - a, number(&found["expected"]) - b];
        assert!(off.iter().all(|off| off.abs() < 1e-6), "{}: {found}, expected {a} and {b}", pair.name);
    }
}

fn explanations(report: &Value) -> impl Iterator<Item = &Value> {
    report["dynamics"]["explanations"].as_array().unwrap().iter()
}

fn figures(report: &Value) -> impl Iterator<Item = &Value> {
    explanations(report).flat_map(|of| of["figures"].as_array().unwrap())
}

/// The worst difference of gravity torques of each joint: the worst of 2000 samples is below the certificate, and the search finds
/// at least as much. `pair.json` takes each torque in its own geometry and the program both in that of the first, so a lever
/// that differs counts with the weight that it carries.
fn check_gravity(pair: &Read, report: &Value) {
    let bounds = report["dynamics"]["certificates"]["gravity"]["by_joint"].as_array().unwrap();
    let bodies = pair.expected["bodies"].as_array().unwrap();
    let carried_kg: f64 = bodies[1..].iter().map(|body| number(&body["mass_kg"][1])).sum();
    let lever_m = number(&pair.expected["geometry"]["mapped"]["position_m"]);
    let allowed = carried_kg * STANDARD_GRAVITY_M_S2 * lever_m + 1e-6;
    let sampled = pair.expected["gravity_torque_nm"]["max_difference"].as_array().unwrap();
    for (joint, sampled) in pair.joints().iter().zip(sampled) {
        let sampled = number(sampled);
        let bound = bounds.iter().find(|of| of["joint"] == joint["a"]);
        // A joint along gravity has none.
        let [attained, certified] =
            ["attained_n_m", "certified_n_m"].map(|of| bound.map_or(0.0, |bound| number(&bound[of])));
        assert!(sampled <= certified + allowed, "{}: {joint} {sampled} > {certified}", pair.name);
        assert!(
            attained >= sampled * (1.0 - SEARCHED) - allowed,
            "{}: {joint} {attained} < {sampled}",
            pair.name
        );
    }
}

/// Causes of explanations for one of `pair.json`; the notes of the study name them otherwise.
fn names_of(cause: &str) -> &'static [&'static str] {
    match cause {
        "inertia_rotation_dropped" => &["inertia_rotation", "rpy_missing", "rpy"],
        "principal_moments_without_axes" => &["principal_axes_missing"],
        "mass" => &["mass", "inertial"],
        "center_of_mass" => &["com", "inertial"],
        "inertia" => &["inertia", "inertial"],
        _ => panic!("{cause}: a cause that the test does not know"),
    }
}

/// An `<inertial>` of these files has at most so many lines.
const INERTIAL_LINES: u64 = 15;

/// Whether an explanation has a cause of a link, at its lines.
fn is_explained(report: &Value, cause: &Value) -> bool {
    let link = if cause["link_a"].is_string() { &cause["link_a"] } else { &cause["link_b"] };
    let names = names_of(cause["cause"].as_str().unwrap());
    let found = explanations(report).filter(|of| of["place"].as_array().unwrap().contains(link)).any(|of| {
        let parts = of["parts"].as_array().unwrap().iter().map(|part| &part["cause"]);
        let is_named =
            std::iter::once(&of["cause"]).chain(parts).any(|name| names.contains(&name.as_str().unwrap()));
        let line = of["line"].as_u64().unwrap();
        is_named && cause["line_a"].as_u64().is_none_or(|from| (from..from + INERTIAL_LINES).contains(&line))
    });
    // Where the whole inertial is off it must be the quantity that is meant.
    let quantity = match cause["cause"].as_str().unwrap() {
        "mass" => "mass",
        "center_of_mass" => "com",
        _ => "i",
    };
    let is_quantity = |of: &Value| of["of"] == *link && of["figure"].as_str().unwrap().starts_with(quantity);
    found && figures(report).any(is_quantity)
}

fn check_causes(pair: &Read, report: &Value) {
    let limits = report["dynamics"]["limits"].as_array().unwrap();
    let decides = |figures: &[&str], joint: &Value| {
        let of_figure = |of: &&Value| figures.contains(&of["figure"].as_str().unwrap());
        let is_joint = |of: &Value| joint.is_null() || of["joint"] == *joint;
        limits.iter().filter(of_figure).any(|of| of["decides"] == true && is_joint(of))
    };
    for cause in pair.expected["causes"].as_array().unwrap() {
        let (what, is_said) = match cause["cause"].as_str().unwrap() {
            // Compared with the mapping.
            "zero_offset" | "axis_flipped" => continue,
            "limits" => ("limits".to_owned(), decides(&["lower", "upper"], &cause["joint"])),
            "effort" => ("effort".to_owned(), decides(&["effort"], &Value::Null)),
            "parameter" => {
                let is_joint = |of: &Value| of["joint"] == cause["joint"];
                let joint = cause["joint"].as_str().unwrap();
                (format!("length of {joint}"), report["diagnosis"].as_array().unwrap().iter().any(is_joint))
            }
            name => {
                let link = cause["link_a"].as_str().or(cause["link_b"].as_str()).unwrap();
                (format!("{name} of {link}"), is_explained(report, cause))
            }
        };
        assert_eq!(is_said, !is_deviation(pair.name, &what), "{}: {what}: {report:#}", pair.name);
    }
}

#[test]
fn public_pairs_differ_as_an_independent_program_found() {
    let Some(corpus) = corpus() else { return };
    for PublicPair { folder, tolerance } in PAIRS {
        let pair = Read::new(&corpus, folder);
        check_mapping(&pair);
        let as_written = pair.declared(|_| (1, 0.0), "1nm");
        let variable = |joint: &Value| (joint["sign"].as_i64().unwrap(), number(&joint["offset_rad"]));
        let mapped = pair.declared(variable, tolerance);
        check_geometry(&pair, &as_written, &mapped);
        check_limits(&pair, &mapped);
        check_masses(&pair, &mapped);
        check_gravity(&pair, &mapped);
        check_causes(&pair, &mapped);
    }
}

#[test]
fn a_description_in_sdf_is_refused_in_words() {
    let Some(corpus) = corpus() else { return };
    let pair = Read::new(&corpus, "sdf-iiwa14");
    let answer = congruent_json(&["check", &pair.a, "--against", &pair.b]);
    assert_eq!(answer.code, 2, "{}", answer.stdout);
    assert!(
        answer.stdout.contains("SDF") || answer.stderr.contains("SDF"),
        "{}{}",
        answer.stdout,
        answer.stderr
    );
}

/// The MJCF of wx250s has five links of the URDF as one, and omits the rotation of inertial frames: the sum of the five agrees,
/// and the rotations are all that is named.
#[test]
fn links_that_an_mjcf_fuses_are_compared_as_one() {
    let Some(corpus) = corpus() else { return };
    let pair = corpus.join("pairs/wx250s");
    let [mjcf, urdf] = ["robot.xml", "partner.urdf"].map(|name| pair.join(name).display().to_string());
    for files in [[&mjcf, &urdf], [&urdf, &mjcf]] {
        let report = congruent_json(&["check", files[0], "--against", files[1]]).json();
        let fused = report["against"]["fused_links"].as_array().unwrap();
        assert!(fused.iter().any(|of| of.as_str().unwrap().contains("wx250s/gripper_bar_link")), "{fused:?}");
        let differences = report["dynamics"]["differences"].as_array().unwrap();
        let differing: Vec<&str> = differences.iter().filter_map(|of| of["figure"].as_str()).collect();
        assert!(differing.iter().all(|parameter| parameter.starts_with('i')), "only tensors: {differing:?}");
        let links = differences.iter().filter_map(|of| of["of"].as_str());
        assert!(!links.clone().any(|link| link.ends_with("gripper_link")), "{:?}", links.collect::<Vec<_>>());
    }
}
