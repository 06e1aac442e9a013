//! Plots that a page's commands write under the name of a picture of the guide: the picture is that plot.

use std::{
    fs,
    path::{Path, PathBuf},
};

use regex_lite::Regex;

use crate::{page::root, sandbox::Sandbox};

/// Plots that differ from their pictures, each with the place of its picture.
pub(crate) fn differing(sandbox: &Sandbox) -> Vec<(PathBuf, PathBuf)> {
    let plots = sandbox.files("svg").into_iter();
    let pairs = plots.map(|plot| {
        let picture = root().join("docs/images").join(plot.file_name().unwrap());
        (plot, picture)
    });
    pairs.filter(|(plot, picture)| !picture.is_file() || labels(plot) != labels(picture)).collect()
}

/// The texts of a plot. Its points are rounded where machines may disagree, titles and ticks are not.
fn labels(path: &Path) -> Vec<String> {
    let text = fs::read_to_string(path).unwrap();
    let label = Regex::new(r"(?s)<text[^>]*>(.*?)</text>").unwrap();
    label.captures_iter(&text).map(|found| found[1].trim().to_owned()).collect()
}
