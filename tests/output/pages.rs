//! The pages of runs, checks and calibrations: their numbers are those of the JSON reports, and in a real browser no script
//! fails, nothing is fetched, and every plot is drawn.

use std::{
    collections::BTreeMap,
    fs,
    path::{Path, PathBuf},
};

use serde_json::Value;

use super::browser::{opened, opens_well, read, unescaped};
use crate::support::{
    command::{congruent, congruent_json, text},
    corpus::workspace,
    measurements::CASE_04,
    scratch_folder::ScratchFolder,
};

/// Numbers of plots are rounded to 32 bits. Kind: rounding, relative.
const SINGLE_PRECISION: f64 = 1e-6;

/// Errors below are not plotted, m or rad.
const ROUNDING: f64 = 1e-12;

/// The places in the report that a page names, each with the value beside it.
fn values(html: &str) -> Vec<(String, String)> {
    let between = |text: &str, start: &str| {
        text.split_once(start).and_then(|(_, rest)| rest.split_once('"')).map(|(value, _)| unescaped(value))
    };
    let elements = html.split("<data ").skip(1).map(|rest| rest.split('>').next().unwrap_or_default());
    elements.map(|of| (between(of, "data-path=\"").unwrap(), between(of, " value=\"").unwrap())).collect()
}

/// Every value of a page is the one of the report at its place; returns how many there are.
#[track_caller]
fn holds_values_of(html: &str, report: &Value) -> usize {
    let values = values(html);
    for (path, value) in &values {
        let exact = report.pointer(path).unwrap_or_else(|| panic!("the report has no {path}"));
        let value: f64 = value.parse().unwrap();
        // JSON has no number for what is infinite.
        let same = exact
            .as_f64()
            .map_or(exact.is_null() && !value.is_finite(), |exact| exact.to_bits() == value.to_bits());
        assert!(same, "{path}: {value} in the page, {exact} in the report");
    }
    values.len()
}

/// The whole of a page is in it: it names no other address.
#[track_caller]
fn is_one_file(html: &str) {
    for fetching in ["src=\"http", "href=\"http", "@import", "url(http", "<link", "<iframe"] {
        assert!(!html.contains(fetching), "{fetching}");
    }
    assert!(html.contains("default-src 'none'"));
}

/// Runs a scenario; gives its folder, its page and its report.
#[track_caller]
fn run(scratch: &ScratchFolder, scenario: &str) -> (PathBuf, String, Value) {
    let out = scratch.path().join("out");
    let answer = congruent(&["run", scenario, "--out", &text(&out)]);
    assert!(answer.code < 2, "{}", answer.stderr);
    let name = Path::new(scenario).file_stem().unwrap();
    let folder = out.join(name);
    let report = serde_json::from_str(&read(&folder.join("report.json"))).unwrap();
    let html = read(&folder.join("report.html"));
    is_one_file(&html);
    (folder, html, report)
}

#[test]
fn a_page_that_asks_the_network_or_has_a_wrong_script_is_noticed() {
    let scratch = ScratchFolder::new();
    let image = "<img src=\"http://127.0.0.1:9/image.png\">";
    let page = format!("<html><head></head><body>{image}<script>nothing.at.all();</script></body></html>");
    let path = scratch.write("asking.html", &page);
    let Some(found) = opened(Path::new(&path)) else { return };
    assert!(found["requests"].as_u64().unwrap() > 0, "{found}");
    assert!(found["wrong"].to_string().contains("nothing is not defined"), "{found}");
    // The policy of a page stops what would be asked.
    let policy = "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; script-src 'unsafe-inline'\">";
    let path = scratch.write("stopped.html", &page.replace("<head>", &format!("<head>{policy}")));
    let found = opened(Path::new(&path)).unwrap();
    assert_eq!(found["requests"], 0, "{found}");
    assert!(found["wrong"].to_string().contains("request: http://127.0.0.1:9/image.png"), "{found}");
}

#[test]
fn the_page_of_a_run_has_its_numbers_and_draws_them() {
    let scratch = ScratchFolder::new();
    for (name, passes) in [("ur5e_pick", true), ("ur5e_wrong_convention", false), ("ur5e_into_table", false)]
    {
        let (folder, html, report) = run(&scratch, &format!("scenarios/{name}.toml"));
        assert!(holds_values_of(&html, &report) > 15, "{name}");
        assert!(
            html.contains(if passes { ">Every check passes, as expected.<" } else { ">Expected failure: " }),
            "{name}"
        );
        assert_eq!(html.contains("<h2>What failed, as expected</h2>"), !passes, "{name}");
        assert_eq!(html.contains("Nearest to its limit: "), passes, "{name}");
        assert!(html.contains("href=\"recording.rrd\"") && html.contains("href=\"report.json\""), "{name}");
        assert!(html.len() < 3_000_000, "{name}: {} bytes", html.len());
        let Some(found) = opens_well(&folder.join("report.html")) else { continue };
        // Of a run that failed, all but what failed is folded.
        let plots = found["plots"].as_u64().unwrap();
        assert!(if passes { plots > 15 } else { (1..=6).contains(&plots) }, "{name}: {found}");
        let largest_of = |quantity: &str| {
            let measures = report["checks"].as_array().unwrap().iter();
            let mut measures = measures
                .filter(|check| check["check"] == "agreement")
                .flat_map(|check| check["measures"].as_array().unwrap());
            measures
                .find(|measure| measure["quantity"] == quantity)
                .map(|measure| measure["worst"]["value"].as_f64().unwrap())
        };
        for quantity in ["position", "orientation"] {
            // What is only rounding is a line of text.
            let Some(worst) = largest_of(quantity).filter(|worst| *worst > ROUNDING) else {
                assert!(html.contains("rounding, not plotted"), "{name}");
                continue;
            };
            let plotted = found["largest"][quantity].as_f64().unwrap();
            assert!(
                (plotted - worst).abs() <= SINGLE_PRECISION * worst,
                "{name}, {quantity}: {plotted} is plotted of {worst}"
            );
        }
    }
}

/// The plots in a page, by name.
fn charts(html: &str) -> BTreeMap<String, Value> {
    let (_, data) = html.split_once("id=\"plots\"").and_then(|(_, rest)| rest.split_once('>')).unwrap();
    let (json, _) = data.split_once("</script>").unwrap();
    let plots: Value = serde_json::from_str(json).unwrap();
    let charts = plots["charts"].as_array().unwrap().iter();
    charts.map(|chart| (chart["id"].as_str().unwrap().to_owned(), chart.clone())).collect()
}

#[test]
fn what_failed_comes_first_with_its_limit_and_its_first_violation() {
    let scratch = ScratchFolder::new();
    for (name, check, chart) in [
        ("ur5e_into_table", "clearance", "clearance"),
        ("ur5e_into_zone", "zone", "zones"),
        ("ur5e_soft_servos", "tracking", "tracking_angle"),
        ("ur5e_wrong_convention", "agreement", "position"),
    ] {
        let (_, html, report) = run(&scratch, &format!("scenarios/{name}.toml"));
        let of_check = report["checks"].as_array().unwrap().iter().find(|of| of["check"] == check).unwrap();
        let measures = of_check["measures"].as_array().unwrap().iter();
        let first =
            measures.filter_map(|of| of["first_violation"]["time_s"].as_f64()).fold(f64::INFINITY, f64::min);
        let plotted = charts(&html)[chart].clone();
        let points = plotted["points"].as_array().unwrap();
        assert!(points.iter().any(|point| point["time_s"].as_f64() == Some(first)), "{name}: {points:?}");
        assert!(!plotted["limits"].as_array().unwrap().is_empty(), "{name}");
        assert!(plotted["lines"].as_array().unwrap().len() <= 5, "{name}");
        // The plot, with the picture beside it, is above every table; what passed is folded.
        let at = |text: &str| html.find(text).unwrap_or_else(|| panic!("{name} has no {text}"));
        let figure = at(&format!("data-chart=\"{chart}\""));
        assert!(at("What failed") < figure && figure < at("<svg") && at("<svg") < at("<table"), "{name}");
        assert!(at("<details><summary>what passed") > at("<table"), "{name}");
        // The verdict says what was violated, with its limit.
        let verdict = &html[at("class=\"sentence\"")..];
        let verdict = &verdict[..verdict.find("</span>").unwrap()];
        assert!(verdict.contains("limit"), "{name}: {verdict}");
    }
}

/// The numbers of a line: 32 bits each, in base64.
fn numbers(written: &Value) -> Vec<f32> {
    const DIGITS: &[u8] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let digits = written.as_str().unwrap().trim_end_matches('=').bytes();
    let bits = digits.flat_map(|digit| {
        let value = DIGITS.iter().position(|known| *known == digit).unwrap();
        (0..6).rev().map(move |bit| value >> bit & 1 == 1)
    });
    let bits: Vec<bool> = bits.collect();
    // The first bit of a byte is its highest, the first byte of a number its lowest.
    let byte = |bits: &[bool]| bits.iter().fold(0_u8, |byte, bit| byte << 1 | u8::from(*bit));
    let bytes: Vec<u8> = bits.chunks_exact(8).map(byte).collect();
    bytes.chunks_exact(4).map(|four| f32::from_le_bytes(four.try_into().unwrap())).collect()
}

#[test]
fn a_short_approach_is_in_the_plot_of_distances() {
    let scratch = ScratchFolder::new();
    // Distances are plotted every 60 ms of such a run; the ball passes twice, within 50 ms.
    let scenario = format!(
        "schema_version = 1\nname = 'passing'\nrobot = '{}'\n[simulation]\nduration_s = 20.0\n\
         [controller]\nkind = 'kinematic'\n[[obstacle]]\nname = 'ball'\nsphere_radius_m = 0.05\n\
         path = [{{at_s = 10.005, xyz_m = [1.2, -2, 0.2]}}, {{at_s = 10.055, xyz_m = [1.2, 2, 0.2]}}, \
         {{at_s = 15.005, xyz_m = [1.4, 2, 0.2]}}, {{at_s = 15.055, xyz_m = [1.4, -2, 0.2]}}]\n\
         [[check]]\nkind = 'clearance'\nminimum_m = 0.02\npairs = [['*', 'ball']]\n",
        workspace().join("robots/ur5e").display()
    );
    let (_, html, report) = run(&scratch, &scratch.write("passing.toml", &scenario));
    let worst = &report["checks"][0]["measures"][0]["worst"];
    let [least_m, at_s] = ["value", "time_s"].map(|key| worst[key].as_f64().unwrap());
    let line = &charts(&html)["clearance"]["lines"][0];
    let (times_s, values_m) = (numbers(&line["times_s"]), numbers(&line["values"]));
    let least_near = |time_s: f64| {
        let near =
            times_s.iter().zip(&values_m).filter(|(at_s, _)| (f64::from(**at_s) - time_s).abs() < 0.03);
        near.map(|(_, value_m)| f64::from(*value_m)).fold(f64::INFINITY, f64::min)
    };
    assert!((10.0..10.06).contains(&at_s), "{worst}");
    let first_m = least_near(at_s);
    assert!((least_m * 0.999..least_m * 1.12).contains(&first_m), "{first_m} m of {least_m} m");
    // 200 mm farther away.
    let second_m = least_near(15.03);
    assert!((least_m..(least_m + 0.2) * 1.12).contains(&second_m), "{second_m} m");
}

#[test]
fn events_of_a_run_are_in_its_page() {
    let scratch = ScratchFolder::new();
    let (_, html, _) = run(&scratch, "scenarios/ur5e_grasp.toml");
    for shown in ["<h2>Events</h2>", "motion 4: path_tcp", "grasp of part, 1.5 kg", "2 to 5.8 s"] {
        assert!(html.contains(shown), "{shown}");
    }
    let out = scratch.path().join("out");
    congruent(&["run", "scenarios/faults/stuck_joint.toml", "--no-recording", "--out", &text(&out)]);
    let html = read(&out.join("fault_stuck_joint/report.html"));
    assert!(html.contains("fault, joint panda_joint6: does not move"));
}

/// Results can be given to others: none names a place of this machine.
#[test]
fn no_result_has_an_absolute_path() {
    let scratch = ScratchFolder::new();
    let scenario = workspace().join("scenarios/ur5e_into_table.toml");
    let (folder, html, report) = run(&scratch, &text(&scenario));
    let roots = [workspace(), scratch.path().to_owned()].map(|path| text(&path));
    for name in ["report.html", "report.json", "junit.xml", "recording.rrd"] {
        let bytes = fs::read(folder.join(name)).unwrap();
        let found = String::from_utf8_lossy(&bytes);
        assert!(!roots.iter().any(|root| found.contains(&format!("{root}/"))), "{name}");
    }
    for shown in [report["scenario_file"].as_str().unwrap(), "congruent run", env!("CARGO_PKG_VERSION")] {
        assert!(html.contains(shown), "{shown}");
    }
    let inputs = report["inputs"].as_array().unwrap();
    assert!(inputs.iter().all(|input| html.contains(input["sha256"].as_str().unwrap())));
    let page = scratch.path().join("check.html");
    let robot = text(&workspace().join("robots/ur5e/wrong_convention.toml"));
    congruent(&["check", &robot, "--html", &text(&page)]);
    let html = read(&page);
    // The folder of the page is below another root, to which a relative path leads.
    assert!(!html.contains(&roots[0]), "check");
    assert!(html.contains("congruent check") && html.contains("wrong_convention.toml"));
}

#[test]
fn a_run_without_recording_links_to_none() {
    let scratch = ScratchFolder::new();
    let out = text(&scratch.path().join("out"));
    let answer = congruent(&["run", "scenarios/ur5e_into_table.toml", "--no-recording", "--out", &out]);
    assert_eq!(answer.code, 0, "{}", answer.stderr);
    let html = read(&scratch.path().join("out/ur5e_into_table/report.html"));
    assert!(!html.contains("recording.rrd") && html.contains("href=\"junit.xml\""));
    // Before uPlot, which ends with an error in a browser whose language is not a valid tag.
    let at = |text: &str| html.find(text).unwrap_or_else(|| panic!("no {text}"));
    assert!(at("new Intl.NumberFormat(navigator.language)") < at("github.com/leeoniya/uPlot"));
}

#[test]
fn the_page_of_a_check_shows_lines_bound_and_both_arms() {
    let scratch = ScratchFolder::new();
    let page = scratch.path().join("pages/of/checks/check.html");
    let answer = congruent_json(&["check", "robots/ur5e/wrong_convention.toml", "--html", &text(&page)]);
    let html = read(&page);
    is_one_file(&html);
    assert!(holds_values_of(&html, &answer.json()) > 20);
    for shown in
        ["DIFFERENT", "convention = &quot;modified&quot;", "convention = &quot;standard&quot;", "DH table"]
    {
        assert!(html.contains(shown), "{shown}");
    }
    // Two arms with a tip each, and links that are where they are.
    assert_eq!(html.matches("class=\"arm ").count() % 2, 0);
    assert!(html.matches("<line class=\"link\"").count() >= 20);
    opens_well(&page);
}

#[test]
fn the_page_of_several_robots_has_the_worst_first() {
    let scratch = ScratchFolder::new();
    let page = scratch.path().join("check.html");
    let robots = ["robots/planar_2r", "robots/ur5e/wrong_convention.toml", "no_such_robot"];
    let answer = congruent_json(&["check", robots[0], robots[1], robots[2], "--html", &text(&page)]);
    assert_eq!(answer.code, 2, "{}", answer.stderr);
    let html = read(&page);
    holds_values_of(&html, &answer.json());
    let at = |word: &str| html.find(&format!("{word}</")).unwrap_or_else(|| panic!("no {word}"));
    assert!(at("no_such_robot") < at(robots[1]) && at(robots[1]) < at(robots[0]));
    // What was not compared does not read as agreement.
    assert!(html.contains("SAME GEOMETRY, DYNAMICS NOT COMPARED</span></td>"), "{html}");
    opens_well(&page);
}

#[test]
fn the_page_of_a_calibration_has_its_numbers() {
    let scratch = ScratchFolder::new();
    let measurements = scratch.write("case_04.csv", CASE_04);
    let page = scratch.path().join("calibration.html");
    let answer = congruent_json(&["calibrate", "robots/planar_2r", &measurements, "--html", &text(&page)]);
    let html = read(&page);
    is_one_file(&html);
    assert!(holds_values_of(&html, &answer.json()) > 20);
    // Where all of it comes from.
    for shown in ["congruent calibrate robots/planar_2r", "case_04.csv"] {
        assert!(html.contains(shown), "{shown}");
    }
    if let Some(found) = opens_well(&page) {
        assert_eq!(found["images"], 1, "the plot");
    }
}

#[test]
fn the_page_of_a_calibration_has_the_table_to_paste() {
    let scratch = ScratchFolder::new();
    let measurements = scratch.write("case_04.csv", CASE_04);
    let page = scratch.path().join("calibration.html");
    let free = ["--free", "joint_1.zero", "--html", &text(&page)];
    congruent(&[&["calibrate", "robots/planar_2r", &measurements][..], &free].concat());
    let html = read(&page);
    let (_, pasted) = html.split_once("To paste").unwrap();
    for line in ["[[dh.row]]", "theta_deg = 0.6386  # was 0.0"] {
        assert!(pasted.contains(line), "{line}");
    }
}

#[test]
fn the_index_of_several_runs_has_the_worst_first_and_leads_to_their_pages() {
    let scratch = ScratchFolder::new();
    let out = scratch.path().join("out");
    let wrong = scratch.write("wrong.toml", "schema_version = 1\nname = \"wrong\"\n");
    let scenarios = ["scenarios/ur5e_into_zone.toml", "scenarios/ur5e_into_table.toml", &wrong];
    congruent(&["run", scenarios[0], scenarios[1], scenarios[2], "--out", &text(&out)]);
    let page = out.join("index.html");
    let html = read(&page);
    is_one_file(&html);
    assert!(html.contains("1 OF 3 DO NOT PASS") && html.contains("DID NOT START"), "{html}");
    assert!(html.contains("congruent run scenarios/ur5e_into_zone.toml"), "{html}");
    let links: BTreeMap<usize, &str> = html
        .match_indices("href=\"")
        .map(|(at, _)| (at, html[at + 6..].split('"').next().unwrap()))
        .collect();
    assert_eq!(links.len(), 2, "{links:?}");
    assert!(links.values().all(|link| out.join(link).is_file()), "{links:?}");
    assert!(html.find("wrong.toml").unwrap() < *links.keys().next().unwrap(), "the worst is first");
    opens_well(&page);
}

/// Text of a file is text in a page, whatever it says.
#[test]
fn names_of_a_file_run_nothing() {
    let scratch = ScratchFolder::new();
    let hostile = "</script><img src=x onerror=alert(1)>";
    let robot = text(&workspace().join("robots/planar_2r"));
    let scenario = format!(
        "schema_version = 1\nname = \"{hostile}\"\nrobot = {robot:?}\n[controller]\nkind = \"kinematic\"\n\
         [[motion]]\nmove_joints_deg = {{ joint_1 = 5 }}\nduration_s = 0.1\n\
         [[obstacle]]\nname = \"{hostile}\"\nbox_m = [0.1, 0.1, 0.1]\nxyz_m = [3, 0, 0]\n[[check]]\nkind = \"agreement\"\n"
    );
    let scenario = scratch.write("hostile.toml", &scenario);
    let out = scratch.path().join("out");
    let answer = congruent(&["run", &scenario, "--out", &text(&out)]);
    assert_eq!(answer.code, 0, "{}", answer.stderr);
    let folder = fs::read_dir(&out).unwrap().next().unwrap().unwrap().path();
    let html = read(&folder.join("report.html"));
    assert!(!html.contains("<img") && html.contains("&lt;img src=x onerror=alert(1)&gt;"));
    if let Some(found) = opens_well(&folder.join("report.html")) {
        assert_eq!(found["images"], 0);
    }
}
