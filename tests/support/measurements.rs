//! Measurements for calibrations: a published case, and poses that `congruent fk` computes from a robot file, with noise.

use std::collections::BTreeMap;

use serde_json::{Value, json};

use super::{command::congruent_json, scratch_folder::ScratchFolder};

/// Reference case 4: five measured points of the planar arm.
pub(crate) const CASE_04: &str = "\
joint_1_deg,joint_2_deg,x_m,y_m
0,0,1.000,0.015
30,-45,0.900,0.210
60,-30,0.640,0.735
-20,10,0.956,-0.322
10,40,0.735,0.456
";

/// A stream of pseudorandom numbers, `SplitMix64`.
struct Random(u64);

impl Random {
    /// Uniform in (0, 1).
    #[expect(clippy::cast_precision_loss, reason = "53 bits fit")]
    fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        (((z ^ (z >> 31)) >> 11) as f64 + 0.5) / (1_u64 << 53) as f64
    }

    /// Standard normal, by Box and Muller.
    fn normal(&mut self) -> f64 {
        (-2.0 * self.uniform().ln()).sqrt() * (std::f64::consts::TAU * self.uniform()).cos()
    }
}

/// Where the TCP of a robot file's table is at random configurations, with noise, as JSON rows.
pub(crate) fn measured(
    robot: &str,
    joints: &[&str],
    rows: usize,
    (noise_m, noise_rad): (f64, f64),
) -> Vec<Value> {
    let mut random = Random(4);
    let configuration = |random: &mut Random| -> BTreeMap<String, f64> {
        // Within the limits of every robot here; the Panda's fourth joint bends one way only.
        let draw = |joint: &&str| {
            let centre = if *joint == "panda_joint4" {
                -1.5
            } else if *joint == "panda_joint6" {
                1.5
            } else {
                0.0
            };
            ((*joint).to_owned(), centre + 2.6 * (random.uniform() - 0.5))
        };
        joints.iter().map(draw).collect()
    };
    let configurations: Vec<Value> = (0..rows).map(|_| json!({ "q": configuration(&mut random) })).collect();
    let folder = ScratchFolder::new();
    let file = folder.write("q.json", &Value::from(configurations.clone()).to_string());
    let answer = congruent_json(&["fk", robot, "--source", "dh", "--configurations", &file]);
    assert_eq!(answer.code, 0, "{}", answer.stderr);
    let answer = answer.json();
    let mut row = |(asked, found): (&Value, &Value)| {
        let value = |key: &str, at: usize| found["links"]["tcp"][key][at].as_f64().unwrap();
        let translation: Vec<f64> =
            (0..3).map(|at| value("translation_m", at) + noise_m * random.normal()).collect();
        // A small turn on the left of the quaternion, to first order; the reader normalises it.
        let [w, x, y, z] = [0, 1, 2, 3].map(|at| value("quaternion_wxyz", at));
        let [a, b, c] = [0; 3].map(|_| noise_rad * random.normal() / 2.0);
        let turned = [
            w - a * x - b * y - c * z,
            x + a * w + b * z - c * y,
            y + b * w + c * x - a * z,
            z + c * w + a * y - b * x,
        ];
        json!({ "q": asked["q"], "translation_m": translation, "quaternion_wxyz": turned })
    };
    configurations.iter().zip(answer["results"].as_array().unwrap()).map(&mut row).collect()
}
