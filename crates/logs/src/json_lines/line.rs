//! What one line has: joint states, a pose, or both.

use std::fmt;

use serde::{
    Deserialize, Deserializer,
    de::{Error, MapAccess, Visitor},
};

/// Times beyond this are no seconds: it is in 2255, and ns since 1970 are below 2^63.
const LATEST_S: f64 = 9e9;

/// A line that is a message.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Line {
    /// Time of its sender.
    pub(super) time_ns: i64,
    pub(super) joints: Option<LineJoints>,
    pub(super) pose: Option<LinePose>,
}

/// The joints of a line; the arrays are as long as the names, or empty.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct LineJoints {
    pub(super) names: Vec<String>,
    pub(super) position: Vec<f64>,
    pub(super) velocity: Vec<f64>,
    pub(super) effort: Vec<f64>,
}

/// The pose of a line.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub(super) struct LinePose {
    pub(super) frame: String,
    pub(super) child: Option<String>,
    pub(super) translation_m: [f64; 3],
    pub(super) quaternion_wxyz: [f64; 4],
    #[serde(skip)]
    pub(super) origin: Option<LineOrigin>,
}

/// Where a pose comes from, as its sender says.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum LineOrigin {
    Derived,
    Controller,
    Measured,
}

/// A line as it is written; other keys are of no interest.
#[derive(Deserialize)]
struct WrittenLine {
    time_s: Option<f64>,
    q: Option<NamedNumbers>,
    v: Option<NamedNumbers>,
    tau: Option<NamedNumbers>,
    pose: Option<LinePose>,
    origin: Option<LineOrigin>,
}

/// Numbers by the names of joints, in the order of the line; `null` is NaN.
struct NamedNumbers(Vec<(String, f64)>);

impl Line {
    /// Reads a line.
    ///
    /// # Errors
    /// What is wrong with it, in words.
    pub(super) fn parse(text: &[u8]) -> Result<Self, String> {
        let written: WrittenLine = serde_json::from_slice(text).map_err(|error| {
            // The number of the line is that in the stream, which the parser does not know.
            let message = error.to_string().replace(" at line 1 column ", " at column ");
            let has = |word: &[u8]| text.windows(word.len()).any(|part| part == word);
            let is_unknown = has(b"NaN") || has(b"Infinity");
            if is_unknown {
                format!("{message}; JSON has no NaN: write null for a value that is not known")
            } else {
                message
            }
        })?;
        let WrittenLine { time_s, q, v, tau, pose, origin } = written;
        let time_s = time_s.ok_or("it has no \"time_s\"")?;
        if time_s.abs() > LATEST_S {
            return Err(format!("time_s = {time_s} is beyond {LATEST_S} s: it must be in seconds"));
        }
        if q.is_none() && pose.is_none() {
            return Err("it has neither \"q\" nor \"pose\"".to_owned());
        }
        #[expect(clippy::cast_possible_truncation, reason = "below 9e18")]
        let time_ns = (time_s * 1e9).round() as i64;
        Ok(Self {
            time_ns,
            joints: q.map(|q| LineJoints::new(q, v, tau)),
            pose: pose.map(|pose| LinePose { origin, ..pose }),
        })
    }
}

impl LineJoints {
    fn new(q: NamedNumbers, v: Option<NamedNumbers>, tau: Option<NamedNumbers>) -> Self {
        let (names, position): (Vec<String>, Vec<f64>) = q.0.into_iter().unzip();
        // Velocities and efforts of joints without a position are not used.
        let in_order = |of: Option<NamedNumbers>| {
            let Some(NamedNumbers(of)) = of else { return Vec::new() };
            let value = |(at, name): (usize, &String)| {
                let same = of.get(at).filter(|(other, _)| other == name);
                same.or_else(|| of.iter().find(|(other, _)| other == name))
                    .map_or(f64::NAN, |(_, value)| *value)
            };
            names.iter().enumerate().map(value).collect()
        };
        Self { velocity: in_order(v), effort: in_order(tau), position, names }
    }
}

impl<'de> Deserialize<'de> for NamedNumbers {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_map(NamedNumbersVisitor)
    }
}

struct NamedNumbersVisitor;

impl<'de> Visitor<'de> for NamedNumbersVisitor {
    type Value = NamedNumbers;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("numbers by the names of joints, as {\"elbow_joint\": 0.4}")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Self::Value, A::Error> {
        let mut numbers: Vec<(String, f64)> = Vec::with_capacity(map.size_hint().unwrap_or(8).min(64));
        while let Some((name, value)) = map.next_entry::<String, Option<f64>>()? {
            if numbers.iter().any(|(other, _)| *other == name) {
                return Err(A::Error::custom(format!("joint \"{name}\" is given twice")));
            }
            numbers.push((name, value.unwrap_or(f64::NAN)));
        }
        Ok(NamedNumbers(numbers))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn joints_have_their_values_by_name_and_null_is_not_known() {
        let text = br#"{"time_s": 1.25, "q": {"a": 0.5, "b": null}, "v": {"b": 2, "a": 1, "c": 9}}"#;
        let line = Line::parse(text).unwrap();
        let joints = line.joints.unwrap();
        assert_eq!((line.time_ns, joints.names), (1_250_000_000, vec!["a".to_owned(), "b".to_owned()]));
        assert_eq!(format!("{:?}", joints.position), "[0.5, NaN]");
        assert_eq!((joints.velocity, joints.effort), (vec![1.0, 2.0], Vec::new()));
    }

    #[test]
    fn a_pose_says_where_it_comes_from() {
        let text = br#"{"time_s": 0, "pose": {"frame": "base", "translation_m": [1, 2, 3],
            "quaternion_wxyz": [1, 0, 0, 0]}, "origin": "controller"}"#;
        let pose = Line::parse(text).unwrap().pose.unwrap();
        assert_eq!((pose.origin, pose.child), (Some(LineOrigin::Controller), None));
        assert_eq!(format!("{:?}", pose.translation_m), "[1.0, 2.0, 3.0]");
    }

    #[track_caller]
    fn refused(text: &str, part: &str) {
        let message = Line::parse(text.as_bytes()).unwrap_err();
        assert!(message.contains(part), "{message}");
    }

    #[test]
    fn what_is_wrong_with_a_line_is_said() {
        refused("{\"time_s\": 1, \"q\"", "EOF while parsing an object at column 17");
        refused(r#"{"q": {"a": 1}}"#, "no \"time_s\"");
        refused(r#"{"time_s": 1}"#, "neither \"q\" nor \"pose\"");
        refused(r#"{"time_s": 1, "q": [1, 2]}"#, "names of joints");
        refused(r#"{"time_s": 1, "q": {"a": 1, "a": 2}}"#, "\"a\" is given twice");
        refused(r#"{"time_s": 1700000000000, "q": {"a": 1}}"#, "in seconds");
    }
}
