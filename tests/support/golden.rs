//! Goldens of the corpus: configurations in, numbers of independent programs out; and numbers of JSON documents.

use std::{fs, path::Path};

use serde_json::{Map, Value, json};

/// `golden.json` of one robot.
pub(crate) struct Golden {
    document: Value,
}

impl Golden {
    pub(crate) fn load(robot: &Path) -> Self {
        Self { document: read_json(&robot.join("golden.json")) }
    }

    /// The golden with the armature of its joints in the equations of motion, if they were computed without it: on the diagonal of
    /// the mass matrix `M`, and so `rnea` grows by armature times acceleration, and without torque `(M + A) qdd' = M qdd`.
    pub(crate) fn with_armature(mut self) -> Self {
        let joints = self.document["joints"].as_array().expect("joints");
        let armature: Vec<f64> = joints.iter().map(|joint| number(&joint["armature"])).collect();
        let product = |rows: &[Vec<f64>], vector: &[f64]| -> Vec<f64> {
            rows.iter().map(|row| row.iter().zip(vector).map(|(a, b)| a * b).sum()).collect()
        };
        for configuration in self.document["configs"].as_array_mut().expect("configurations") {
            let Some(rows) = configuration["mass_matrix"].as_array() else { continue };
            let mut rows: Vec<Vec<f64>> = rows.iter().map(numbers).collect();
            let torques = product(&rows, &numbers(&configuration["aba_zero_torque"]));
            rows.iter_mut().enumerate().for_each(|(at, row)| row[at] += armature[at]);
            configuration["mass_matrix"] = json!(rows);
            let (rnea, qdd) = (numbers(&configuration["rnea"]), numbers(&configuration["a"]));
            let added =
                rnea.iter().zip(&armature).zip(&qdd).map(|((tau, armature), qdd)| tau + armature * qdd);
            configuration["rnea"] = json!(added.collect::<Vec<f64>>());
            configuration["aba_zero_torque"] = json!(solved(rows, torques));
        }
        self
    }

    /// All configurations of some kinds.
    pub(crate) fn configurations(&self, kinds: &[&str]) -> Vec<&Value> {
        let all = self.document["configs"].as_array().expect("configurations");
        all.iter().filter(|each| kinds.iter().any(|kind| each["kind"] == *kind)).collect()
    }

    /// Names of the links, in the order of poses.
    pub(crate) fn links(&self) -> Vec<&str> {
        let links = self.document["links"].as_array().expect("links");
        links.iter().map(|link| link.as_str().expect("a name")).collect()
    }

    /// Names of the movable joints, in the order of vectors and columns.
    pub(crate) fn joints(&self) -> Vec<&str> {
        let joints = self.document["joints"].as_array().expect("joints");
        joints.iter().map(|joint| joint["name"].as_str().expect("a name")).collect()
    }

    /// Writes configurations as a batch for the command, with the speeds and accelerations that they have.
    pub(crate) fn write_batch(&self, configurations: &[&Value], path: &Path) {
        let named = |numbers: &Value| -> Map<String, Value> {
            let numbers = numbers.as_array().into_iter().flatten().cloned();
            self.joints().into_iter().map(str::to_owned).zip(numbers).collect()
        };
        let by_name = |entry: &&Value| json!({ "q": named(&entry["q"]), "v": named(&entry["v"]), "a": named(&entry["a"]) });
        let batch: Vec<Value> = configurations.iter().map(by_name).collect();
        fs::write(path, json!(batch).to_string()).expect("a temporary file is written");
    }
}

/// The solution of `matrix x = right` for a positive definite matrix, which needs no pivots.
fn solved(mut matrix: Vec<Vec<f64>>, mut right: Vec<f64>) -> Vec<f64> {
    let size = right.len();
    for column in 0..size {
        for row in (0..size).filter(|row| *row != column) {
            let share = matrix[row][column] / matrix[column][column];
            let eliminating = matrix[column].clone();
            matrix[row].iter_mut().zip(eliminating).for_each(|(entry, above)| *entry -= share * above);
            right[row] -= share * right[column];
        }
    }
    right.iter().enumerate().map(|(at, value)| value / matrix[at][at]).collect()
}

/// A JSON file of the corpus.
pub(crate) fn read_json(path: &Path) -> Value {
    let text = fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    serde_json::from_str(&text).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// A number of a JSON document.
#[track_caller]
pub(crate) fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is not a number"))
}

/// Numbers of a JSON array.
pub(crate) fn numbers(value: &Value) -> Vec<f64> {
    let array = value.as_array().unwrap_or_else(|| panic!("no array: {value}"));
    array.iter().map(|number| number.as_f64().expect("a number")).collect()
}

/// Angle between two unit quaternions, scalar first, accurate near 0.
pub(crate) fn angle_rad(a: &[f64], b: &[f64]) -> f64 {
    let dot: f64 = a.iter().zip(b).map(|(a, b)| a * b).sum();
    let sign = dot.signum();
    // |a - b| = 2 sin(angle / 4) for unit quaternions on the same side.
    let chord: f64 = a.iter().zip(b).map(|(a, b)| (a - sign * b).powi(2)).sum::<f64>().sqrt();
    4.0 * (chord / 2.0).asin()
}

/// Distance of two points.
pub(crate) fn distance_m(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt()
}
