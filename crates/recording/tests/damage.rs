//! Damaged recordings: every change of a file is noticed, in it alone, and what is not changed is still read.

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
fn what_is_not_damaged_is_intact() {
    let bench = Bench::new();
    let summary = bench.inspect(&bench.whole).unwrap();
    assert_eq!((summary.exit_code, summary.complete), (0, true), "{}", summary.reason);
    let sums = summary.check_sums.unwrap();
    // The footer, which follows from the index, is counted beside the messages.
    assert_eq!((sums.intact, sums.damaged.len()), (bench.messages().len() as u64 + 1, 0));
}

#[test]
fn every_flipped_bit_is_noticed() {
    let bench = Bench::new();
    let mut bytes = bench.whole.clone();
    let bits = bytes.len() * 8;
    // All bits of headers and footer, and others in steps that meet every bit of a byte.
    let headers = bench.messages().into_iter().step_by(40).flat_map(|(at, _)| at..at + 16);
    let framing = (0..12).chain(headers).chain(bytes.len() - 60..bytes.len());
    let framing = framing.flat_map(|at| at * 8..at * 8 + 8);
    let step = (bits / FLIPPED) | 1;
    for bit in framing.chain((0..bits).step_by(step)).collect::<Vec<_>>() {
        bytes[bit / 8] ^= 1 << (bit % 8);
        bench.is_noticed(&bytes, &format!("bit {bit}"));
        bytes[bit / 8] ^= 1 << (bit % 8);
    }
    assert!(bytes == bench.whole);
}

/// Bits that are flipped over the whole file.
const FLIPPED: usize = 1500;

#[test]
fn every_block_that_is_zeroed_cut_moved_or_repeated_is_noticed() {
    let bench = Bench::new();
    let (whole, mut random) = (&bench.whole, Random(11));
    for round in 0..150 {
        let length = 1 + random.below([4, 64, 1000, 20_000][round % 4]);
        let at = random.below(whole.len() - length);
        let to = random.below(whole.len() - length);
        let (block, rest) = (&whole[at..at + length], [&whole[..at], &whole[at + length..]].concat());
        let changes = [
            ("zeroed", [&whole[..at], &vec![0; length], &whole[at + length..]].concat()),
            ("cut out", rest.clone()),
            ("cut off", whole[..at].to_vec()),
            ("moved", [&rest[..to], block, &rest[to..]].concat()),
            ("repeated", [&whole[..to], block, &whole[to..]].concat()),
            ("filled", [&whole[..at], &vec![0xff; length], &whole[at + length..]].concat()),
        ];
        for (change, bytes) in changes.iter().filter(|(_, bytes)| bytes != whole) {
            bench.is_noticed(bytes, &format!("{length} bytes at {at} {change}, to {to}"));
        }
    }
    bench.is_noticed(&[&whole[..], whole].concat(), "twice");
    bench.is_noticed(&[&whole[..], b"\0"].concat(), "a byte more");
}

#[test]
fn whole_messages_that_are_missing_moved_or_repeated_are_noticed() {
    let bench = Bench::new();
    let (whole, messages, mut random) = (&bench.whole, bench.messages(), Random(5));
    let at = |(start, length): (usize, usize)| &whole[start..start + length];
    for _ in 0..100 {
        let (a, b) = (random.below(messages.len()), random.below(messages.len()));
        let (a, b) = (a.min(b), a.max(b));
        let ((first, _), (second, second_length)) = (messages[a], messages[b]);
        let (mut missing, mut repeated, mut swapped) = (Vec::new(), Vec::new(), whole[..first].to_vec());
        missing.extend([&whole[..second], &whole[second + second_length..]].concat());
        repeated.extend([&whole[..first], at(messages[b]), &whole[first..]].concat());
        swapped.extend(at(messages[b]));
        swapped.extend(&whole[first + messages[a].1..second.max(first + messages[a].1)]);
        swapped.extend(at(messages[a]));
        swapped.extend(&whole[second + second_length..]);
        bench.is_noticed(&missing, &format!("without message {b}"));
        bench.is_noticed(&repeated, &format!("message {b} once more before {a}"));
        if a != b {
            bench.is_noticed(&swapped, &format!("messages {a} and {b} swapped"));
        }
    }
}

#[test]
fn the_damage_is_reported_and_the_rest_is_read() {
    let bench = Bench::new();
    let whole = bench.inspect(&bench.whole).unwrap();
    let path = "/joint/position/joint_2";
    let count = |of: &RecordingSummary| of.scalars.iter().filter(|scalar| scalar.path == path).count();
    assert_eq!(count(&whole), 1);
    // In the check sum, so that the content can still be verified.
    let damaged = |&(start, length): &(usize, usize)| {
        let mut bytes = bench.whole.clone();
        bytes[start + length - 1] ^= 1;
        bytes
    };
    let is_about = |of: &RecordingSummary| {
        let damage = &of.check_sums.as_ref().unwrap().damaged[0];
        damage.entity.as_deref() == Some(path) && damage.times_s.is_some()
    };
    let messages = bench.messages();
    let of_joint = messages.iter().find(|message| is_about(&bench.inspect(&damaged(message)).unwrap()));
    let &(start, length) = of_joint.unwrap();
    let bytes = damaged(&(start, length));
    let summary = bench.inspect(&bytes).unwrap();
    let sums = summary.check_sums.as_ref().unwrap();
    let damage = &sums.damaged[0];
    assert_eq!((damage.from_byte, damage.to_byte), (start as u64, (start + length) as u64));
    assert_eq!(damage.entity.as_deref(), Some(path));
    assert_eq!(damage.times_s, Some([0.0, 0.04]));
    let expected = format!("bytes {start} to {} ({path}, 0 s to 0.04 s)", start + length);
    assert!(summary.problems[0].starts_with(&expected), "{:?}", summary.problems);
    assert_eq!(count(&summary), 0, "its values are left out");
    // The check sum counts for the next message as well.
    assert_eq!(sums.damaged.len(), 2);
    assert_eq!(whole.scalars.len() - summary.scalars.len(), sums.damaged.len());
    assert_eq!(sums.intact + 2, whole.check_sums.unwrap().intact);
}

#[test]
fn a_wrong_length_loses_one_message() {
    let bench = Bench::new();
    let messages = bench.messages();
    for bit in 0..64 {
        let mut bytes = bench.whole.clone();
        let (start, length) = messages[messages.len() / 2];
        bytes[start + 8 + bit / 8] ^= 1 << (bit % 8);
        let sums = bench.inspect(&bytes).unwrap().check_sums.unwrap();
        assert_eq!(sums.intact, messages.len() as u64, "bit {bit}");
        let range = (sums.damaged[0].from_byte, sums.damaged[0].to_byte);
        assert_eq!(range, (start as u64, (start + length) as u64), "bit {bit}");
    }
}
