//! Series that were read from recordings.

use std::collections::BTreeMap;

use super::{
    file_comparison::{ComparedFile, FileComparison},
    report_label::ReportLabel,
    series::{SAME_TIME_S, SeriesComparison},
};
use crate::trajectory_file::Value;

/// Numbers over time by the name of their series; times rise.
pub type Scalars = BTreeMap<String, Vec<(f64, f64)>>;

/// What a series is.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct ScalarLabel {
    /// The joint that it is of.
    pub joint: Option<String>,
    /// Its name in words: `orientation error of tool0`.
    pub words: Option<String>,
    /// The unit of its values, if that is known beyond the end of its name.
    pub unit: Option<&'static str>,
}

/// Compares the series of two recordings at the times that both have; `label` says what a series is.
pub fn compare_scalars(
    a: &Scalars,
    b: &Scalars,
    label: impl Fn(&str) -> ScalarLabel,
    tolerance: f64,
) -> FileComparison {
    let missing = |from: &Scalars, to: &Scalars| -> Vec<String> {
        from.keys().filter(|name| !to.contains_key(*name)).cloned().collect()
    };
    let only_in = [missing(a, b), missing(b, a)];
    let common: Vec<_> = a.iter().filter_map(|(name, of_a)| Some((name, of_a, b.get(name)?))).collect();
    let compared = common.len();
    let compare = |(name, a, b): (&String, &Vec<_>, &Vec<_>)| {
        let ScalarLabel { joint, words, unit } = label(name);
        let label = words.map(|words| ReportLabel { words, unit });
        let mut series = SeriesComparison::new(name, joint, tolerance).labelled(label);
        merge(&mut series, a, b);
        series.finish()
    };
    let series = common.into_iter().filter_map(compare).collect();
    FileComparison::new(ComparedFile::Recording, compared, series, only_in, Vec::new())
}

fn merge(series: &mut SeriesComparison, a: &[(f64, f64)], b: &[(f64, f64)]) {
    let (mut at_a, mut at_b) = (0, 0);
    while at_a < a.len() || at_b < b.len() {
        match (a.get(at_a), b.get(at_b)) {
            (Some(&(a_s, of_a)), Some(&(b_s, of_b))) if (a_s - b_s).abs() <= SAME_TIME_S => {
                series.observe(Some(a_s), &Value::Number(of_a), &Value::Number(of_b));
                (at_a, at_b) = (at_a + 1, at_b + 1);
            }
            (Some(&(a_s, _)), b) if b.is_none_or(|&(b_s, _)| a_s < b_s) => {
                series.only_in(0);
                at_a += 1;
            }
            _ => {
                series.only_in(1);
                at_b += 1;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn series_are_compared_at_the_times_that_both_have() {
        let a = Scalars::from([("x".to_owned(), vec![(0.0, 1.0), (0.1, 2.0), (0.2, 3.0)])]);
        let b = Scalars::from([("x".to_owned(), vec![(0.0, 1.0), (0.2, 4.0), (0.3, 5.0), (0.4, 5.0)])]);
        let found = compare_scalars(&a, &b, |_| ScalarLabel::default(), 0.0);
        let series = &found.series[0];
        let counts = (series.compared, series.differing, series.only_in_a, series.only_in_b);
        assert_eq!(counts, (2, 1, 1, 2));
        assert_eq!(found.first.unwrap().time_s, Some(0.2));
        assert!(compare_scalars(&a, &a, |_| ScalarLabel::default(), 0.0).same);
    }
}
