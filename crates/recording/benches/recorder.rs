//! The whole run loop of `scenarios/ur5e_pick.toml` (4 s at 1 kHz) with its recording. The benchmark
//! of `congruent-twin` measures the parts of the loop.
//!
//! 4 s divided by a time here is the speed relative to real time.

use std::path::Path;

use congruent_recording::RerunRecorder;
use congruent_twin::{
    Run,
    scenario::{Overrides, Scenario},
};

fn main() {
    divan::main();
}

fn scenario() -> Scenario {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios/ur5e_pick.toml");
    Scenario::load(&path, Overrides::default()).expect("the scenario is part of the project")
}

#[divan::bench]
fn run_and_recording(bencher: divan::Bencher<'_, '_>) {
    let path = std::env::temp_dir().join("congruent-bench.rrd");
    bencher
        .with_inputs(|| {
            let mut scenario = scenario();
            let checks = std::mem::take(&mut scenario.checks);
            (scenario, checks)
        })
        .bench_local_values(|(scenario, mut checks)| {
            let run = Run::new(&scenario).expect("the scenario runs");
            let mut recorder =
                RerunRecorder::create(&path, &scenario, run.names(), run.model().sources(), &checks)
                    .expect("a temporary file");
            run.finish(&mut checks, &mut recorder, |_| ())
        });
}
