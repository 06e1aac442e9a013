//! Values of real robot files are changed, one or several; the lines that the check advises are put in their
//! places; then table and URDF agree.

use std::fmt::Write;

use rand_chacha::{
    ChaCha8Rng,
    rand_core::{RngCore, SeedableRng},
};

use crate::robots::{Texts, agrees, all, is_written};

/// Tolerances of the property, in m and rad.
const TOLERANCES: [f64; 3] = [1e-9, 1e-6, 1e-3];

/// Changes of one line: of a length, of an angle, of a word.
const OF_LENGTHS: [fn(f64) -> f64; 6] = [
    |value| value + 0.0137,
    |value| value - 2e-3,
    |value| value + 1.23456e-2,
    |value| value * 1e3 + 0.5,
    |value| -value + 0.01,
    |value| value * 1e-3 + 0.07,
];
const OF_ANGLES_DEG: [fn(f64) -> f64; 6] = [
    |value| value + 0.5,
    |value| value - 90.0,
    |value| value + 180.0,
    |value| value + 271.3,
    |value| value.to_radians() + 3.0,
    |value| value - 12.345_67,
];

struct Random(ChaCha8Rng);

impl Random {
    fn below(&mut self, count: usize) -> usize {
        usize::try_from(self.0.next_u64() % u64::try_from(count).unwrap()).unwrap()
    }

    fn pick<T: Copy>(&mut self, list: &[T]) -> T {
        list[self.below(list.len())]
    }
}

/// The lines of a robot file that a fault can be in.
fn lines_with(file: &[String], keys: &[&str]) -> Vec<usize> {
    let has = |line: &String| keys.iter().any(|key| line.starts_with(&format!("{key} = ")));
    (0..file.len()).filter(|&line| has(&file[line])).collect()
}

fn number(line: &str) -> Option<(&str, f64)> {
    let (key, value) = line.split_once(" = ")?;
    Some((key, value.parse().ok()?))
}

/// One fault in a robot file; `None` if the file has no place for it.
fn mutate(file: &mut Vec<String>, random: &mut Random) -> Option<()> {
    match random.below(12) {
        0..=2 => value(file, &["a_m", "d_m"], &OF_LENGTHS, random),
        3 | 4 => value(file, &["alpha_deg", "theta_deg"], &OF_ANGLES_DEG, random),
        5 => {
            let lines = lines_with(file, &["sign"]);
            let line = *lines.get(random.below(lines.len().max(1)))?;
            let flipped = if file[line].ends_with("-1") { "sign = 1" } else { "sign = -1" };
            // Without its line the sign is 1.
            if flipped == "sign = 1" && random.below(2) == 0 {
                file.remove(line);
            } else {
                flipped.clone_into(&mut file[line]);
            }
            Some(())
        }
        6 => {
            let joints = lines_with(file, &["joint"]);
            let (one, two) = (random.pick(&joints), random.pick(&joints));
            file.swap(one, two);
            Some(())
        }
        7 => {
            let line = *lines_with(file, &["convention"]).first()?;
            let is_standard = file[line].contains("standard");
            file[line] = format!("convention = \"{}\"", if is_standard { "modified" } else { "standard" });
            Some(())
        }
        8 => transform(file, random),
        _ => misplaced(file, random),
    }
}

/// Values of one key in each other's rows, a column one row too low or too high, or a minus that is missing or too many.
fn misplaced(file: &mut [String], random: &mut Random) -> Option<()> {
    let key = random.pick(&["a_m", "d_m", "alpha_deg"]);
    let lines = lines_with(file, &[key]);
    let (one, two) = (random.pick(&lines), random.pick(&lines));
    match random.below(4) {
        0 => file.swap(one, two),
        1 => lines.windows(2).for_each(|pair| file.swap(pair[0], pair[1])),
        2 => lines.windows(2).rev().for_each(|pair| file.swap(pair[0], pair[1])),
        _ => {
            let (key, value) = number(&file[one])?;
            file[one] = format!("{key} = {:?}", -value);
        }
    }
    Some(())
}

/// Another number in a line, or no line for a theta, which has a default.
fn value(
    file: &mut Vec<String>,
    keys: &[&str],
    changes: &[fn(f64) -> f64],
    random: &mut Random,
) -> Option<()> {
    let line = random.pick(&lines_with(file, keys));
    let (key, value) = number(&file[line])?;
    if key == "theta_deg" && random.below(3) == 0 {
        file.remove(line);
    } else {
        file[line] = format!("{key} = {:?}", random.pick(changes)(value));
    }
    Some(())
}

/// Another declared transform in one of its notations, or none.
fn transform(file: &mut Vec<String>, random: &mut Random) -> Option<()> {
    const WRITTEN: [&str; 7] = [
        "{}",
        "{ xyz_m = [0.0, 0.0, 0.05] }",
        "{ xyz_mm = [10, 0, 0], rpy_deg = [0, 0, 90] } # as measured",
        "{ rpy_rad = [0.0, 1.5707963267948966, 0.3] }",
        "{ xyz_m = [0.1, 0.2, 0.3], quaternion_wxyz = [0.6, 0.0, 0.8, 0.0] }",
        "{ matrix = [[1, 0, 0, 0], [0, 1, 0, 0.01], [0, 0, 1, 0], [0, 0, 0, 1]] }",
        "{ rpy_deg = [0, 0, 180] }",
    ];
    let lines = lines_with(file, &["base_from_dh0", "dhn_from_tip"]);
    let line = *lines.get(random.below(lines.len().max(1)))?;
    let key = file[line].split_once(" = ")?.0.to_owned();
    match random.below(9) {
        0 => {
            file.remove(line);
        }
        1 => file[line] = format!("{key}.xyz_mm = [0, 0, 5]"),
        other => file[line] = format!("{key} = {}", WRITTEN[other - 2]),
    }
    Some(())
}

/// Notations of the same file.
const STYLES: [fn(&str) -> String; 4] = [str::to_owned, inline_rows, headers, str::to_owned];

/// Each row as an inline table on one line.
fn inline_rows(file: &str) -> String {
    let (mut rows, mut others, mut in_row) = (Vec::<Vec<&str>>::new(), Vec::new(), false);
    for line in file.lines() {
        if line == "[[dh.row]]" {
            rows.push(Vec::new());
            in_row = true;
        } else if line.starts_with('[') {
            in_row = false;
            others.push(line);
        } else if in_row && !line.is_empty() && !line.starts_with('#') {
            rows.last_mut().unwrap().push(line);
        } else {
            others.push(line);
        }
    }
    let rows: Vec<String> = rows.iter().map(|row| format!("  {{ {} }},\n", row.join(", "))).collect();
    let at = others.iter().position(|line| *line == "[dh]").unwrap() + 1;
    let (before, behind) = others.split_at(at);
    format!("{}\nrow = [\n{}]\n{}\n", before.join("\n"), rows.concat(), behind.join("\n"))
}

/// Declared transforms under headers of their own.
fn headers(file: &str) -> String {
    let (mut kept, mut sections) = (String::new(), String::new());
    for line in file.lines() {
        match line.split_once(" = {") {
            Some((key, rest)) if key.ends_with("dh0") || key.ends_with("tip") => {
                let keys = rest.rsplit_once('}').unwrap().0.trim().replace("], ", "]\n");
                // The rows of a matrix are lists as well.
                let keys = if keys.starts_with("matrix") { keys.replace("]\n", "], ") } else { keys };
                let _ = writeln!(sections, "[dh.{key}]\n{keys}");
            }
            _ => {
                if line == "[[dh.row]]" {
                    kept += &std::mem::take(&mut sections);
                }
                kept += line;
                kept += "\n";
            }
        }
    }
    kept
}

/// Checks a file with faults and corrects it as advised; `Some(explained)` if the faults matter.
fn correct(texts: &Texts, tolerance: f64) -> Option<bool> {
    let report = texts.check(tolerance);
    if agrees(&report) {
        return None;
    }
    let first = &report.diagnosis[0];
    let every: Vec<_> =
        [first].into_iter().chain(report.indistinguishable.iter().map(|other| &other.cause)).collect();
    if !first.within_tolerance {
        return Some(false);
    }
    for cause in every {
        let parts = if cause.parts.is_empty() { vec![&cause.fault] } else { cause.parts.iter().collect() };
        // A correction without a key in the robot file is a sentence.
        if !parts.iter().all(|fault| is_written(fault)) {
            continue;
        }
        let corrected = texts.corrected(cause);
        let again = corrected.check(tolerance);
        assert!(
            agrees(&again),
            "{} at {tolerance:e}: {}\n{}\n{:?}\n--- was\n{}\n--- is\n{}",
            texts.name,
            cause.fault.message,
            cause.fault.suggestion,
            again.worst,
            texts.robot_file,
            corrected.robot_file
        );
    }
    Some(true)
}

/// Every advice for faults of one robot file, `rounds` for each tolerance and number of faults.
#[track_caller]
fn advice_agrees(rounds: usize, faults: usize) {
    let mut random = Random(ChaCha8Rng::seed_from_u64(5 + u64::try_from(faults).unwrap()));
    let (mut all_of_them, mut explained) = (0, 0);
    for texts in all() {
        for round in 0..rounds {
            let mut file: Vec<String> = texts.robot_file.lines().map(str::to_owned).collect();
            for _ in 0..faults {
                let _ = mutate(&mut file, &mut random);
            }
            let robot_file = STYLES[round % STYLES.len()](&(file.join("\n") + "\n"));
            let mutated = Texts { robot_file, ..texts.clone() };
            if let Some(is_explained) = correct(&mutated, TOLERANCES[round % TOLERANCES.len()]) {
                all_of_them += 1;
                explained += usize::from(is_explained);
            }
        }
    }
    let least = if faults == 1 { all_of_them } else { all_of_them * 9 / 10 };
    assert!(explained >= least && all_of_them > rounds, "{explained} of {all_of_them} are explained");
}

#[test]
fn advice_for_one_fault_makes_the_models_agree() {
    advice_agrees(24, 1);
}

#[test]
fn advice_for_two_faults_makes_the_models_agree() {
    advice_agrees(12, 2);
}
