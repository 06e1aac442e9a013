//! Nothing in a file or an argument reaches a terminal or the log of a CI host as anything but text that is seen.

use std::fs;

use congruent::input::is_hidden;

use crate::support::{
    command::{Answer, congruent, text},
    scratch_folder::ScratchFolder,
};

/// Pieces of strings that terminals, hosts of CI, or readers of a line obey.
const PIECES: [&str; 20] = [
    "\u{1b}[2J\u{1b}[1;1Hpass",
    "\u{1b}[8m",
    "\u{1b}]0;title\u{7}",
    "\u{7}",
    "\u{8}\u{8}",
    "\u{9b}31m",
    "\n::error file=x,line=1::y",
    "\r::warning::y",
    "\r\n##[error]y",
    "\tpass",
    "\u{85}::error::y",
    "\u{202e}ssap\u{202c}",
    "\u{2066}x\u{2069}",
    "\u{200e}\u{200f}\u{61c}",
    "\u{2028}::error::y\u{2029}",
    "\u{200b}\u{200d}\u{feff}",
    "\u{e0041}\u{ad}",
    "::error title=x::y",
    "##[error]x ##vso[task.complete]y ##teamcity[z]",
    "a|b`c`<script>x</script>%0A,:",
];

/// A place for a string of a stranger, as `@` in one of the files or arguments.
struct Place {
    /// How a string is written there.
    write: fn(&str) -> String,
    /// A file and what is replaced in it by what; nothing for an argument.
    change: Option<(&'static str, &'static str, &'static str)>,
    arguments: &'static [&'static str],
}

const fn in_file(
    write: fn(&str) -> String,
    change: (&'static str, &'static str, &'static str),
    arguments: &'static [&'static str],
) -> Place {
    Place { write, change: Some(change), arguments }
}

const fn in_argument(arguments: &'static [&'static str]) -> Place {
    Place { write: raw, change: None, arguments }
}

const ROBOT: &str = "robot/robot.toml";
const URDF: &str = "robot/planar_2r.urdf";
const RUN: [&str; 5] = ["run", "scenario.toml", "--no-recording", "--out", "out"];
const CHECK: [&str; 2] = ["check", "robot"];
const URDF_ALONE: [&str; 2] = ["describe", URDF];
const AT: [&str; 4] = ["fk", "robot", "--configurations", "configurations.json"];
const CALIBRATE: [&str; 3] = ["calibrate", "robot", "measured.csv"];

const PLACES: [Place; 34] = [
    in_file(toml, (ROBOT, "name = \"", "name = @ #"), &CHECK),
    in_file(toml, (ROBOT, "tip = \"", "tip = @ #"), &CHECK),
    in_file(toml, (ROBOT, "urdf = \"", "urdf = @ #"), &CHECK),
    in_file(toml, (ROBOT, "name = \"", "@ = 1\nname = \""), &CHECK),
    in_file(toml, (ROBOT, "convention = \"", "convention = @ #"), &CHECK),
    in_file(toml, (ROBOT, "joint = \"", "joint = @ #"), &CHECK),
    in_file(raw, (ROBOT, "convention = \"", "convention = 3 # @"), &CHECK),
    in_file(raw, (ROBOT, "convention = \"", "convention = '@' #"), &CHECK),
    in_file(xml, (URDF, "<robot name=\"planar_2r\"", "<robot name=\"@\""), &URDF_ALONE),
    in_file(xml, (URDF, "<link name=\"", "<link name=\"@"), &URDF_ALONE),
    in_file(xml, (URDF, "<joint name=\"", "<joint name=\"@"), &URDF_ALONE),
    in_file(xml, (URDF, "<child link=\"", "<child link=\"@"), &URDF_ALONE),
    in_file(xml, (URDF, "type=\"revolute\"", "type=\"@\""), &URDF_ALONE),
    in_file(xml, (URDF, "xyz=\"", "xyz=\"@"), &URDF_ALONE),
    in_file(
        xml,
        (
            URDF,
            "</robot>",
            "<link name=\"m\"><collision><geometry><mesh filename=\"@\"/></geometry></collision></link></robot>",
        ),
        &URDF_ALONE,
    ),
    in_file(raw, (URDF, "</robot>", "<!-- @ --><link/></robot>"), &URDF_ALONE),
    in_file(raw, (URDF, "</robot>", "<@></robot>"), &URDF_ALONE),
    in_file(toml, ("scenario.toml", "name = \"bench\"", "name = @"), &RUN),
    in_file(toml, ("scenario.toml", "robot = \"robot\"", "robot = @"), &RUN),
    in_file(toml, ("scenario.toml", "seed = 1", "@ = 1"), &RUN),
    in_file(toml, ("scenario.toml", "{ joint_1 = 0.5 }", "{ @ = 0.5 }"), &RUN),
    in_file(toml, ("scenario.toml", "kind = \"agreement\"", "kind = @"), &RUN),
    in_file(toml, ("scenario.toml", "name = \"post\"", "name = @"), &RUN),
    in_file(raw, ("scenario.toml", "seed = 1", "seed = \"x\" # @"), &RUN),
    in_file(json, ("configurations.json", "\"joint_1\"", "@"), &AT),
    in_file(json, ("configurations.json", "0.1", "@"), &AT),
    in_file(raw, ("configurations.json", "0.1", "@"), &AT),
    in_file(raw, ("measured.csv", "joint_1_rad", "@"), &CALIBRATE),
    in_file(raw, ("measured.csv", "0.1", "@"), &CALIBRATE),
    in_argument(&["check", "@.toml"]),
    in_argument(&["fk", "robot", "--tip", "@"]),
    in_argument(&["run", "scenario.toml", "--set", "name=@"]),
    in_argument(&["check", "--@"]),
    in_argument(&["inspect", "@.rrd"]),
];

const SCENARIO: &str = "\
schema_version = 1
name = \"bench\"
robot = \"robot\"
seed = 1
[simulation]
duration_s = 0.01
[controller]
kind = \"gravity_compensation\"
[[motion]]
move_joints_deg = { joint_1 = 0.5 }
duration_s = 0.01
over_limit = \"warn\"
[[obstacle]]
name = \"post\"
box_m = [0.1, 0.1, 0.1]
xyz_m = [9.0, 9.0, 9.0]
[[check]]
kind = \"agreement\"
";

fn raw(text: &str) -> String {
    text.to_owned()
}

fn json(text: &str) -> String {
    serde_json::to_string(text).unwrap()
}

/// TOML, with all that is hidden written as escapes.
fn toml(text: &str) -> String {
    let escaped = |c: char| if is_hidden(c) { format!("\\U{:08x}", u32::from(c)) } else { c.to_string() };
    format!("\"{}\"", text.replace('"', "'").chars().map(escaped).collect::<String>())
}

/// An attribute, with line breaks that are no spaces.
fn xml(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('"', "'")
        .replace('\n', "&#10;")
        .replace('\t', "&#9;")
}

/// A folder with a robot, a scenario, configurations and measurements.
fn scratch_folder() -> ScratchFolder {
    let scratch = ScratchFolder::new();
    let robot = scratch.robot("planar_2r", &[]);
    fs::rename(robot, scratch.path().join("robot")).unwrap();
    scratch.write("scenario.toml", SCENARIO);
    scratch.write("configurations.json", "[{\"q\": {\"joint_1\": 0.1}}]");
    scratch.write("measured.csv", "joint_1_rad,joint_2_rad,x_m,y_m,z_m\n0.1,0.2,1,1,0\n");
    scratch
}

impl Place {
    /// The command with this string at the place, and its results.
    fn answer(&self, string: &str, format: &str) -> (Answer, ScratchFolder) {
        let scratch = scratch_folder();
        let written = (self.write)(string);
        if let Some((file, from, to)) = self.change {
            let path = scratch.path().join(file);
            let before = fs::read_to_string(&path).unwrap();
            assert!(before.contains(from), "{file} has no {from:?}:\n{before}");
            fs::write(path, before.replacen(from, &to.replace('@', &written), 1)).unwrap();
        }
        let is_file = |name: &str| scratch.path().join(name).exists() || name == "out";
        let mut arguments: Vec<String> = vec!["--format".to_owned(), format.to_owned()];
        arguments.extend(self.arguments.iter().map(|argument| match *argument {
            name if is_file(name) => text(&scratch.path().join(name)),
            // A name of a file cannot have a zero or a slash.
            other => other.replace('@', &written),
        }));
        if ["run", "check"].contains(&self.arguments[0]) {
            for (option, name) in [("--junit", "junit.xml"), ("--summary", "summary.md")] {
                arguments.extend([option.to_owned(), text(&scratch.path().join(name))]);
            }
        }
        arguments.rotate_left(2);
        (congruent(&arguments), scratch)
    }
}

/// Whether a text is lines of characters that are seen, and no command to a host of CI.
#[track_caller]
fn assert_visible(text: &str, string: &str) {
    for line in text.lines() {
        let written = line.trim_start();
        assert!(!line.contains(is_hidden), "{string:?} gives {line:?}");
        assert!(!written.starts_with("::"), "{string:?} gives {line:?}");
        assert!(
            ["##[", "##vso[", "##teamcity["].iter().all(|each| !line.contains(each)),
            "{string:?} gives {line:?}"
        );
    }
}

#[track_caller]
fn holds(place: &Place, string: &str, format: &str) {
    let (answer, scratch) = place.answer(string, format);
    assert!((0..=4).contains(&answer.code), "{string:?}: {answer:?}");
    assert_visible(&answer.stdout, string);
    assert_visible(&answer.stderr, string);
    if format == "json" && !answer.stdout.is_empty() {
        answer.json();
    }
    if let Ok(summary) = fs::read_to_string(scratch.path().join("summary.md")) {
        assert!(
            !summary.contains(|c| is_hidden(c) && c != '\n') && !summary.contains("<script"),
            "{summary}"
        );
        for row in summary.lines().filter(|line| line.starts_with('|')) {
            assert_eq!(row.replace("\\|", "").matches('|').count(), 6, "{string:?} gives {row}");
        }
    }
    if let Ok(junit) = fs::read_to_string(scratch.path().join("junit.xml")) {
        let document = roxmltree::Document::parse(&junit).unwrap();
        let texts = document.descendants().flat_map(|node| {
            node.attributes().map(|attribute| attribute.value()).chain(node.text()).collect::<Vec<_>>()
        });
        texts.for_each(|text| assert!(!text.contains(|c| is_hidden(c) && c != '\n'), "{text:?}"));
        assert!(document.descendants().all(|node| !node.has_tag_name("script")), "{junit}");
    }
}

#[test]
fn no_string_of_a_stranger_is_obeyed() {
    for (index, place) in PLACES.iter().enumerate() {
        for (at, piece) in PIECES.iter().enumerate() {
            // Every place with every piece, in other company at each.
            let other = PIECES[(7 * index + 3 * at + 1) % PIECES.len()];
            let string = match (index + at) % 3 {
                0 => (*piece).to_owned(),
                1 => format!("a{piece}b{other}"),
                _ => format!("{piece}{other}"),
            };
            holds(place, &string, if (index + at) % 4 == 0 { "json" } else { "human" });
        }
    }
}
