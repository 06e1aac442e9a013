//! Plots that a page's commands write under the name of a picture of the guide: the picture is that plot.

use std::{fs, path::Path};

use regex_lite::Regex;

use crate::{page::root, sandbox::Sandbox};

/// What differs; an update takes the plot as the picture.
pub(crate) fn compare(sandbox: &Sandbox, is_update: bool) -> Vec<String> {
    let mut faults = Vec::new();
    for plot in sandbox.files("svg") {
        let name = plot.file_name().unwrap();
        let picture = root().join("docs/images").join(name);
        if is_update {
            fs::copy(&plot, &picture).unwrap();
        } else if !picture.is_file() || labels(&plot) != labels(&picture) {
            faults.push(format!("{} is not what the command draws", picture.display()));
        }
    }
    faults
}

/// The texts of a plot. Its points are rounded where machines may disagree, titles and ticks are not.
fn labels(path: &Path) -> Vec<String> {
    let text = fs::read_to_string(path).unwrap();
    let label = Regex::new(r"(?s)<text[^>]*>(.*?)</text>").unwrap();
    label.captures_iter(&text).map(|found| found[1].trim().to_owned()).collect()
}
