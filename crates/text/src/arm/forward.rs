//! What `congruent fk` prints.

use congruent_analysis::forward::{ForwardReport, PoseStream, ReportedLinkPoses};

use crate::{
    TextOptions,
    layout::{POSE_COLUMNS, Table, pose_cells},
};

/// What `congruent fk` prints: the chain, then a table of poses for each configuration, in parts of whole lines. `root` is the
/// name of the root link, `first` the number of the first configuration; the chain is left out if that is not 1.
pub fn forward_text_parts<'a>(
    report: &'a ForwardReport<PoseStream<'_>>,
    root: &str,
    first: usize,
    options: &'a TextOptions,
) -> impl Iterator<Item = String> + 'a {
    let columns = options.columns;
    let frame = if report.from == root { format!("the root link {root}") } else { report.from.clone() };
    let configuration = move |(number, poses): (usize, ReportedLinkPoses)| {
        let mut text = format!("configuration {number}: poses in {frame}\n");
        let mut table = Table::headed(POSE_COLUMNS);
        for (name, pose) in &poses.links {
            table.row([name.clone()].into_iter().chain(pose_cells(pose)));
        }
        table.write(&mut text, columns);
        text
    };
    let heading = (first == 1).then(|| format!("{}: {}\n", report.robot, report.chain));
    heading.into_iter().chain((first..).zip(report.results.iter()).map(configuration))
}
