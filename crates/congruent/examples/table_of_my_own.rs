//! A table of joint positions at uneven times, of any format of one's own, becomes a report with a page:
//! `cargo run --example table_of_my_own` writes `out/my_table/report.html`. For logs that the project reads (MCAP, CSV)
//! `congruent replay` does all this.

#![expect(clippy::print_stdout, reason = "an example shows its result")]

use std::{error::Error, path::Path};

use congruent::{
    description::RobotQ,
    page::PageFormat,
    prelude::*,
    results::{Options, execute_with, report::explain},
    twin::source::{Advance, JointStateSource, SourceError},
};
use congruent_monitors::{JointSample, JointStateView};
use congruent_scenario::{AgreementCheck, Check, RecordingCheck};

/// Times and positions of the joints of a planar arm; nothing was recorded between 0.61 and 1.4 s.
const TABLE: &str =
    "0.00 0.0 0.0\n0.11 0.1 0.2\n0.18 0.2 0.3\n0.40 0.4 0.5\n0.61 0.5 0.8\n1.40 0.9 0.6\n1.47 1.0 0.5";
/// A longer time without a row is a gap.
const GAP_S: f64 = 0.5;

/// The rows of a table, one after another.
struct TableSource {
    rows: Vec<(f64, RobotQ)>,
    at: usize,
    is_gap_given: bool,
}

impl JointStateSource for TableSource {
    fn joints(&self) -> JointSample<'_> {
        JointSample::measured(JointStateView { q: &self.rows[self.at].1, qd: &[], effort: &[] })
    }

    fn advance(&mut self, _: f64) -> Result<Advance, SourceError> {
        let (from_s, to_s) = (self.rows[self.at].0, self.rows[self.at + 1].0);
        if to_s - from_s > GAP_S && !std::mem::replace(&mut self.is_gap_given, true) {
            return Ok(Advance::Gap { from_s, to_s });
        }
        (self.at, self.is_gap_given) = (self.at + 1, false);
        Ok(Advance::At(to_s))
    }

    fn is_last(&self) -> bool {
        self.at + 1 == self.rows.len()
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let number = |word: &str| word.parse::<f64>().unwrap_or(f64::NAN);
    let row = |line: &str| -> Vec<f64> { line.split_whitespace().map(number).collect() };
    let rows: Vec<(f64, RobotQ)> =
        TABLE.lines().map(row).map(|row| (row[0], row[1..].to_vec().into())).collect();
    let robot = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../robots/planar_2r"));
    let check =
        vec![Check::Agreement(AgreementCheck::default()), Check::Recording(RecordingCheck::default())];
    let scenario = Scenario { name: "my_table".to_owned(), check, ..Scenario::default() };
    let setup = RunSetup::new(scenario, load_robot(robot)?)?;
    let begin = |setup| Run::with_source(setup, Box::new(TableSource { rows, at: 0, is_gap_given: false }));
    let options = Options { out: "out".into(), recordings: vec![&PageFormat], interrupt: None };
    let (report, folder) = execute_with(&setup, &options, begin, explain, |_| ())?;
    println!("{}: {}", report.sentence(), folder.file("report.html").display());
    Ok(())
}
