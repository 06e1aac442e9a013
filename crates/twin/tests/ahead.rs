//! A simulation that is computed ahead, on a thread of its own, gives the samples and the results of one that is not.

#![expect(clippy::unwrap_used, reason = "helpers of tests end a test by panicking")]

use std::{
    path::Path,
    sync::atomic::{AtomicBool, Ordering},
};

use congruent_monitors::{NoRecorder, Recorder, RecordingError, Sample};
use congruent_twin::{Outcome, Run, RunError, RunSetup, source::SimulationSource};

fn setup(name: &str) -> RunSetup {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios").join(name);
    RunSetup::load(&path, &[]).unwrap()
}

/// Both runs with their own recorder: ahead, and step by step, as a source of somebody else.
fn both<'a, R: Recorder>(setup: &'a RunSetup, recorder: impl Fn() -> R) -> [(Outcome, Option<RunError>); 2] {
    let source = Box::new(SimulationSource::new(setup).unwrap());
    let runs: [Run<'a>; 2] = [Run::new(setup).unwrap(), Run::with_source(setup, source).unwrap()];
    runs.map(|mut run| {
        let (outcome, result) = run.finish(&mut setup.checks(), &mut recorder(), |_| ());
        (outcome, result.err())
    })
}

#[test]
fn a_run_ahead_is_the_run_step_by_step() {
    for name in ["ur5e_pick.toml", "rrr_arm_servo.toml", "ur5e_grasp.toml"] {
        let [(ahead, error), (stepped, _)] = both(&setup(name), || NoRecorder);
        assert!(error.is_none(), "{name}: {error:?}");
        assert!(ahead.steps > 500, "{name}: {} steps", ahead.steps);
        assert_eq!(ahead, stepped, "{name}");
    }
}

/// Cannot record this step.
struct FullAt(u64);

impl Recorder for FullAt {
    fn record(&mut self, sample: &mut Sample<'_>) -> Result<(), RecordingError> {
        let full = || RecordingError { message: "no space".to_owned() };
        if sample.step < self.0 { Ok(()) } else { Err(full()) }
    }
}

#[test]
fn results_are_those_of_the_sample_that_cannot_be_recorded() {
    for name in ["ur5e_pick.toml", "rrr_arm_servo.toml"] {
        for step in [0, 1, 100, 777] {
            let [(ahead, error), (stepped, _)] = both(&setup(name), || FullAt(step));
            assert!(matches!(error, Some(RunError::Recording(_))), "{name}: {error:?}");
            assert_eq!(ahead.steps, step, "{name}");
            assert_eq!(ahead, stepped, "{name}");
        }
    }
}

/// Ends the run at a step, and counts the samples.
struct Interrupting<'a> {
    flag: &'a AtomicBool,
    at: u64,
    last: u64,
}

impl Recorder for Interrupting<'_> {
    fn record(&mut self, sample: &mut Sample<'_>) -> Result<(), RecordingError> {
        if sample.step == self.at {
            self.flag.store(true, Ordering::Relaxed);
        }
        self.last = sample.step;
        Ok(())
    }
}

#[test]
fn an_interrupted_run_has_results_of_all_that_was_computed() {
    let setup = setup("ur5e_pick.toml");
    let flag = AtomicBool::new(false);
    let mut recorder = Interrupting { flag: &flag, at: 300, last: 0 };
    let mut run = Run::new(&setup).unwrap().interrupted_by(Some(&flag));
    let (outcome, result) = run.finish(&mut setup.checks(), &mut recorder, |_| ());
    assert!(matches!(result, Err(RunError::Interrupted)), "{result:?}");
    assert_eq!(outcome.steps, recorder.last);
    // Some hundred steps ahead at most, and not the whole run.
    assert!((300..1500).contains(&outcome.steps), "{} steps", outcome.steps);
}

/// A bug in a recorder.
struct Broken;

impl Recorder for Broken {
    fn record(&mut self, sample: &mut Sample<'_>) -> Result<(), RecordingError> {
        assert!(sample.step < 10, "a bug");
        Ok(())
    }
}

#[test]
#[should_panic(expected = "a bug")]
fn a_panic_ends_the_run() {
    let setup = setup("ur5e_pick.toml");
    let _ = Run::new(&setup).unwrap().finish(&mut setup.checks(), &mut Broken, |_| ());
}
