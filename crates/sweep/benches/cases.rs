//! What a case of a sweep costs beside its run: 20 cases of `scenarios/ur5e_payload.sweep.toml`, set up and run as rows, and the same
//! runs alone, set up before the clock starts.
//!
//! The difference of the two is the sweep: reading the scenario, planning, the report, the cause and the row.

use std::{path::Path, sync::atomic::AtomicBool};

use congruent_input::FileAccess;
use congruent_monitors::NoRecorder;
use congruent_sweep::{
    plan::SweepPlan,
    run::{CaseRunner, run_cases},
};
use congruent_twin::{Run, RunSetup};

const CASES: u64 = 20;

fn main() {
    divan::main();
}

fn plan() -> SweepPlan {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios/ur5e_payload.sweep.toml");
    SweepPlan::read(&path, &FileAccess::default()).expect("the plan is part of the project")
}

#[divan::bench]
fn bare_runs(bencher: divan::Bencher<'_, '_>) {
    let plan = plan();
    let runner = CaseRunner::new(&plan, FileAccess::default());
    let setups: Vec<RunSetup> =
        (0..CASES).map(|case| runner.setup(&plan.case(case)).expect("the case runs")).collect();
    bencher.bench_local(|| {
        for setup in &setups {
            let mut run = Run::new(setup).expect("the scenario runs").on_one_thread();
            let (_, result) = run.finish(&mut setup.checks(), &mut NoRecorder, |_| ());
            result.expect("the physics holds");
        }
    });
}

#[divan::bench]
fn rows(bencher: divan::Bencher<'_, '_>) {
    let plan = plan();
    let runner = CaseRunner::new(&plan, FileAccess::default());
    let interrupt = AtomicBool::new(false);
    bencher.bench_local(|| (0..CASES).filter_map(|case| runner.run(case, &interrupt)).count());
}

#[divan::bench]
fn rows_on_two_threads(bencher: divan::Bencher<'_, '_>) {
    let plan = plan();
    let runner = CaseRunner::new(&plan, FileAccess::default());
    let interrupt = AtomicBool::new(false);
    let run = |case: u64| runner.run(case, &interrupt);
    bencher.bench_local(|| run_cases(0..CASES, 2, &interrupt, run, |_| Ok::<(), ()>(())));
}
