//! Damaged recordings are read up to the first message that cannot be, and never end in a panic. Values that were changed in a
//! message that can be read are noticed by the digests beside the recording, not here.

#![expect(clippy::unwrap_used, reason = "a test stops if a value is missing")]

use std::{fs, path::Path};

use congruent_input::{FileAccess, RosPackages};
use congruent_recording::{RecordingSummary, RerunFormat, inspect};
use congruent_results::{Options, execute};
use congruent_twin::RunSetup;

/// A short run of a planar arm: small, with all kinds of messages.
fn recording(folder: &Path) -> Vec<u8> {
    let repository = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").canonicalize().unwrap();
    let text = format!(
        "schema_version = 1\nname = \"short\"\nrobot = \"{}/robots/planar_2r\"\n\
         [simulation]\nduration_s = 0.04\n[controller]\nkind = \"kinematic\"\n[[check]]\nkind = \"agreement\"\n",
        repository.display()
    );
    let path = folder.join("scenario.toml");
    fs::write(&path, text).unwrap();
    let access = FileAccess::new(RosPackages::default(), &[repository]).unwrap();
    let setup = RunSetup::load_with(&path, &[], &access).unwrap();
    let options = Options { out: folder.to_owned(), recordings: vec![&RerunFormat], interrupt: None };
    let (_, results) = execute(&setup, &options, |_| ()).unwrap();
    fs::read(results.file("recording.rrd")).unwrap()
}

/// A recording, the same every time, and the answers to changes of it.
struct Bench {
    folder: tempfile::TempDir,
    whole: Vec<u8>,
}

impl Bench {
    fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        let whole = recording(folder.path());
        Self { folder, whole }
    }

    /// The summary of these bytes; `None` if they are refused.
    fn inspect(&self, bytes: &[u8]) -> Option<RecordingSummary> {
        let path = self.folder.path().join("changed.rrd");
        fs::write(&path, bytes).unwrap();
        inspect(&path).ok()
    }

    /// The file is refused, or judged to be bad input for a reason.
    #[track_caller]
    fn is_noticed(&self, bytes: &[u8], change: &str) {
        if let Some(summary) = self.inspect(bytes) {
            assert_eq!(summary.exit_code, 2, "{change}: {}", summary.reason);
            assert!(!summary.problems.is_empty(), "{change}");
        }
    }

    /// First byte and length of every message with its header.
    fn messages(&self) -> Vec<(usize, usize)> {
        const FILE_HEADER: usize = 12;
        const HEADER: usize = 16;
        const FOOTER: usize = 32;
        let (mut at, mut messages) = (FILE_HEADER, Vec::new());
        while at + FOOTER < self.whole.len() {
            let length = u64::from_le_bytes(self.whole[at + 8..at + HEADER].try_into().unwrap());
            let length = HEADER + usize::try_from(length).unwrap();
            messages.push((at, length));
            at += length;
        }
        assert_eq!(at + FOOTER, self.whole.len());
        messages
    }
}

/// Numbers that no one has chosen.
struct Random(u64);

impl Random {
    fn below(&mut self, bound: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        usize::try_from(self.0 >> 33).unwrap() % bound
    }
}

#[test]
fn a_file_that_ends_early_is_noticed() {
    let bench = Bench::new();
    let (whole, mut random) = (&bench.whole, Random(11));
    let summary = bench.inspect(whole).unwrap();
    assert_eq!((summary.exit_code, summary.complete), (0, true), "{}", summary.reason);
    let anywhere = (0..200).map(|_| random.below(whole.len())).collect::<Vec<_>>();
    let ends = bench.messages().into_iter().map(|(start, _)| start);
    for end in (0..20).chain(whole.len() - 60..whole.len()).chain(anywhere).chain(ends) {
        bench.is_noticed(&whole[..end], &format!("cut off after {end} bytes"));
    }
    bench.is_noticed(&[&whole[..], b"\0"].concat(), "a byte more");
}

#[test]
fn a_wrong_length_is_noticed() {
    let bench = Bench::new();
    let messages = bench.messages();
    let (start, _) = messages[messages.len() / 2];
    for bit in 0..64 {
        let mut bytes = bench.whole.clone();
        bytes[start + 8 + bit / 8] ^= 1 << (bit % 8);
        bench.is_noticed(&bytes, &format!("bit {bit}"));
    }
}

#[test]
fn no_change_ends_in_a_panic() {
    let bench = Bench::new();
    let (whole, mut random) = (&bench.whole, Random(5));
    for round in 0..80 {
        let length = 1 + random.below([4, 64, 1000, 20_000][round % 4]);
        let (at, to) = (random.below(whole.len() - length), random.below(whole.len() - length));
        let (block, rest) = (&whole[at..at + length], [&whole[..at], &whole[at + length..]].concat());
        let mut flipped = whole.clone();
        flipped[at] ^= 1 << (round % 8);
        for bytes in [
            flipped,
            [&whole[..at], &vec![0; length], &whole[at + length..]].concat(),
            [&whole[..at], &vec![0xff; length], &whole[at + length..]].concat(),
            [&rest[..to], block, &rest[to..]].concat(),
            [&whole[..to], block, &whole[to..]].concat(),
            rest,
        ] {
            let found = bench.inspect(&bytes);
            assert!(found.is_none_or(|summary| summary.problems.is_empty() || summary.exit_code == 2));
        }
    }
}

#[test]
fn the_first_damage_is_reported_and_what_is_before_it_is_read() {
    let bench = Bench::new();
    let whole = bench.inspect(&bench.whole).unwrap();
    let messages = bench.messages();
    let rows_of = |of: &RecordingSummary| of.entities.iter().map(|entity| entity.rows).sum::<u64>();
    let mut rows = Vec::new();
    for &(start, length) in messages.iter().skip(messages.len() / 4).step_by(messages.len() / 8) {
        let mut bytes = bench.whole.clone();
        bytes[start + 16..start + length].fill(0);
        let summary = bench.inspect(&bytes).unwrap();
        assert_eq!((summary.exit_code, summary.complete), (2, false), "{}", summary.reason);
        let problem = &summary.problems[0];
        assert!(problem.starts_with(&format!("the file is damaged at byte {start}: ")), "{problem}");
        assert!(problem.contains(", after /") && problem.ends_with("or repeat its run"), "{problem}");
        rows.push(rows_of(&summary));
    }
    assert!(rows.is_sorted() && rows[0] > 0 && rows[0] < rows_of(&whole), "{rows:?}");
}
