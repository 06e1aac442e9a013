//! The whole run loop of `scenarios/ur5e_pick.toml` (4 s at 1 kHz) with its recording. The benchmark
//! of `congruent-twin` measures the parts of the loop.
//!
//! 4 s divided by a time here is the speed relative to real time.

use std::path::Path;

use congruent_recording::RerunRecorder;
use congruent_twin::{Run, RunSetup};

fn main() {
    divan::main();
}

fn setup() -> RunSetup {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios/ur5e_pick.toml");
    RunSetup::load(&path, &[]).expect("the scenario is part of the project")
}

#[divan::bench]
fn run_and_recording(bencher: divan::Bencher<'_, '_>) {
    let path = std::env::temp_dir().join("congruent-bench.rrd");
    let setup = setup();
    bencher.with_inputs(|| setup.checks()).bench_local_values(|mut checks| {
        let mut run = Run::new(&setup).expect("the scenario runs");
        let mut recorder = RerunRecorder::create(&path, &setup, run.names(), run.model().sources())
            .expect("a temporary file");
        run.finish(&mut checks, &mut recorder, |_| ())
    });
}
