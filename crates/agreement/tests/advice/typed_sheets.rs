//! Typed data sheets: published tables as they are printed, rounded, against a URDF of the values before rounding, with one
//! to five mistakes that people make. What the corrected table at the end of a check gives, by kind of mistake and by
//! tolerance. A small part runs with the tests, the whole prints each sheet and the figures:
//! `cargo test --release -p congruent-agreement --test advice typed_sheets_of_ten -- --ignored --nocapture`; `CONGRUENT_EACH`
//! says how many sheets of each table and number of mistakes, `CONGRUENT_SEED` is the seed of the mistakes, and
//! `CONGRUENT_ONLY` the number of one table, from 0.

mod mistakes;
mod sheet;

use std::{collections::BTreeMap, fmt, ops::Range};

use congruent_agreement::compare::{Agreement, CheckReport, Grade};
use mistakes::{Mistake, make};
use rand_chacha::{
    ChaCha8Rng,
    rand_core::{RngCore, SeedableRng},
};
use sheet::Sheet;

use crate::robots::{Texts, agrees};

/// Tolerances of a check, in m and rad.
const TOLERANCES: [f64; 3] = [1e-9, 1e-4, 1e-3];

/// A corrected sheet may be so many times as far from the URDF as the printed sheet without mistakes. Kind: choice; the
/// values that are written instead of wrong ones have an error of their own, as large as that of rounding.
const AS_GOOD: f64 = 2.0;

/// Share of one to five mistakes that the table at the end of a check corrects, at each tolerance. Kind: choice; of ten
/// tables with 120 sheets, 99 %, 99 % and 100 % are corrected at 1 nm, 0.1 mm and 1 mm.
const CORRECTED_AT_LEAST: f64 = 0.95;

/// The seed of the mistakes.
const SEED: u64 = 22;

pub(crate) struct Random(ChaCha8Rng);

impl Random {
    fn new(seed: u64) -> Self {
        Self(ChaCha8Rng::seed_from_u64(seed))
    }

    pub(crate) fn below(&mut self, count: usize) -> usize {
        usize::try_from(self.0.next_u64() % u64::try_from(count).unwrap()).unwrap()
    }

    /// A number in -1 to 1.
    #[expect(clippy::cast_precision_loss, reason = "53 bits fit")]
    pub(crate) fn unit(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

/// Whether a sheet was corrected.
#[derive(Debug, Clone, Copy)]
struct Corrected(bool);

impl fmt::Display for Corrected {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(if self.0 { "corrected" } else { "MISSED" })
    }
}

/// Counts of sheets that were corrected, and of all.
#[derive(Debug, Clone, Copy, Default)]
struct Share {
    corrected: usize,
    all: usize,
}

impl Share {
    /// Counts a sheet that is corrected if `result` is true.
    fn count(&mut self, Corrected(result): Corrected) {
        self.corrected += usize::from(result);
        self.all += 1;
    }

    #[expect(clippy::cast_precision_loss, reason = "counts are small")]
    fn part(self) -> f64 {
        self.corrected as f64 / (self.all as f64).max(1.0)
    }
}

/// The shares by tolerance, then by kind and by number of mistakes.
#[derive(Default)]
struct Figures {
    by_kind: BTreeMap<Mistake, [Share; 3]>,
    by_number: BTreeMap<usize, [Share; 3]>,
    all: [Share; 3],
}

impl Figures {
    /// Counts a sheet with these mistakes at a tolerance.
    fn count(&mut self, made: &[Mistake], at: usize, result: Corrected) {
        if let [kind] = made {
            self.by_kind.entry(*kind).or_default()[at].count(result);
        }
        self.by_number.entry(made.len()).or_default()[at].count(result);
        self.all[at].count(result);
    }
}

impl fmt::Display for Figures {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{:34} {:>14} {:>14} {:>14}", "corrected at a tolerance of", "1 nm", "0.1 mm", "1 mm")?;
        let mut line = |label: String, shares: &[Share; 3]| {
            let cells = shares
                .map(|share| format!("{:3}/{:<3} {:4.0} %", share.corrected, share.all, 1e2 * share.part()));
            writeln!(f, "{label:34} {:>14} {:>14} {:>14}", cells[0], cells[1], cells[2])
        };
        for (kind, shares) in &self.by_kind {
            line(format!("one mistake: {kind}"), shares)?;
        }
        for (number, shares) in &self.by_number {
            line(format!("{number} mistakes"), shares)?;
        }
        line("all".to_owned(), &self.all)
    }
}

fn error_of(report: &CheckReport) -> [f64; 2] {
    [report.worst.error.position_m, report.worst.error.orientation_rad]
}

/// Whether the table at the end of the diagnosis of a sheet is as good as the sheet without mistakes.
fn corrected(typed: &Texts, rounding: [f64; 2], tolerance: f64) -> Corrected {
    let diagnosis = typed.diagnose(tolerance).swap_remove(0);
    // The mistakes may be smaller than the rounding: then there is nothing to correct.
    let corrected = diagnosis.corrected.map_or(typed.robot_file.clone(), |corrected| corrected.text);
    let report = Texts { robot_file: corrected, ..typed.clone() }.check(tolerance);
    let found = error_of(&report);
    let is_as_good = (0..2).all(|at| found[at] <= (AS_GOOD * rounding[at]).max(tolerance));
    Corrected(agrees(&report) || is_as_good)
}

/// A sample of sheets: of these tables, so many rounds of each number of mistakes, drawn with a seed.
struct Sample {
    tables: Range<usize>,
    rounds: usize,
    seed: u64,
    /// The numbers of the tolerances.
    tolerances: &'static [usize],
}

impl Sample {
    /// The figures of the sample; `seen` gets a line about each sheet.
    fn figures(&self, mut seen: impl FnMut(&str)) -> Figures {
        let mut figures = Figures::default();
        let kinds = Mistake::ALL.len();
        for (index, sheet) in Sheet::published().iter().enumerate() {
            // Of its own for each table, so that one table alone has the same mistakes.
            let mut random = Random::new(100 * self.seed + u64::try_from(index).unwrap());
            if !self.tables.contains(&index) {
                continue;
            }
            let rounding = error_of(&sheet.texts().check(TOLERANCES[0]));
            let singles = (0..self.rounds * kinds).map(|round| (1, Some(Mistake::ALL[round % kinds])));
            let several = (2..=5).flat_map(|number| (0..self.rounds).map(move |_| (number, None)));
            for (number, first) in singles.chain(several) {
                let (typed, made) = make(sheet, number, first, &mut random);
                if made.len() < number {
                    continue;
                }
                let typed = typed.texts();
                for &at in self.tolerances {
                    let tolerance = TOLERANCES[at];
                    let result = corrected(&typed, rounding, tolerance);
                    figures.count(&made, at, result);
                    seen(&format!("{index} {} {made:?} at {tolerance:.0e}: {result}", typed.name));
                }
            }
        }
        figures
    }
}

#[track_caller]
fn is_within_bounds(figures: &Figures) {
    assert!(figures.all.iter().any(|share| share.all > 0));
    for share in &figures.all {
        assert!(share.all == 0 || share.part() >= CORRECTED_AT_LEAST, "{figures}");
    }
}

#[test]
fn the_corrected_table_undoes_mistakes_of_typing() {
    is_within_bounds(&Sample { tables: 0..2, rounds: 1, seed: SEED, tolerances: &[0, 2] }.figures(|_| ()));
}

/// Each table as it is printed agrees, and if 1 nm is declared it differs, for no other reason than its digits.
#[test]
fn no_cause_is_named_for_rounding_alone() {
    for sheet in Sheet::published() {
        let printed = sheet.texts();
        for tolerance in TOLERANCES {
            let report = printed.check(tolerance);
            assert!(agrees(&report) && report.diagnosis.is_empty(), "{} at {tolerance:e}", printed.name);
        }
        let report = printed.check_declared(TOLERANCES[0]);
        assert_eq!(report.verdict, Agreement::Disagree, "{}", printed.name);
        assert_eq!(report.grade, Some(Grade::SameWithinDigits), "{}", printed.name);
        assert!(report.diagnosis.is_empty(), "{}: {:?}", printed.name, report.diagnosis);
    }
}

#[test]
#[ignore = "takes minutes; prints the figures"]
#[expect(clippy::print_stdout, clippy::disallowed_methods, reason = "the test is run for figures and times")]
fn typed_sheets_of_ten_tables() {
    let number = |name: &str| std::env::var(name).ok().map(|text| text.parse::<usize>().unwrap());
    let sample = Sample {
        tables: number("CONGRUENT_ONLY").map_or(0..10, |only| only..only + 1),
        rounds: number("CONGRUENT_EACH").unwrap_or(1),
        seed: number("CONGRUENT_SEED").map_or(SEED, |seed| u64::try_from(seed).unwrap()),
        tolerances: &[0, 1, 2],
    };
    let mut last = std::time::Instant::now();
    let figures = sample.figures(|line| {
        println!("{line}, {:.2} s", last.elapsed().as_secs_f64());
        last = std::time::Instant::now();
    });
    println!("{figures}");
    is_within_bounds(&figures);
}
