//! What a case of a sweep costs beside its run: cases of `scenarios/ur5e_payload.sweep.toml` with a motion of 1 s, set up and run as
//! rows, and the same runs alone, set up before the clock starts.
//!
//! The difference of the two is the sweep: reading the scenario, planning, the report, the cause and the row. `-- --include-ignored`
//! runs 10,000 cases as well, which takes several minutes.

use std::{path::Path, sync::atomic::AtomicBool};

use congruent_input::FileAccess;
use congruent_monitors::NoRecorder;
use congruent_sweep::{
    plan::SweepPlan,
    run::{CaseRunner, run_cases},
};
use congruent_twin::{Run, RunSetup};

const CASES: u64 = 20;
const MANY_CASES: u64 = 10_000;

fn main() {
    divan::main();
}

fn plan() -> SweepPlan {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios/ur5e_payload.sweep.toml");
    let mut plan = SweepPlan::read(&path, &FileAccess::default()).expect("the plan is part of the project");
    plan.set.push("motion.1.duration_s=1.0".parse().expect("it has a key and a value"));
    plan
}

/// So many runs on threads, of setups that repeat after [`CASES`].
fn run_bare(bencher: divan::Bencher<'_, '_>, cases: u64, jobs: usize) {
    let plan = plan();
    let runner = CaseRunner::new(&plan, FileAccess::default());
    let setups: Vec<RunSetup> =
        (0..CASES).map(|case| runner.setup(&plan.case(case)).expect("the case runs")).collect();
    let interrupt = AtomicBool::new(false);
    let run = |case: u64| {
        let setup = &setups[usize::try_from(case % CASES).expect("a small number")];
        let mut run = Run::new(setup).expect("the scenario runs").on_one_thread();
        let (_, result) = run.finish(&mut setup.checks(), &mut NoRecorder, |_| ());
        result.expect("the physics holds");
        Some(())
    };
    bencher.bench_local(|| run_cases(0..cases, jobs, &interrupt, run, |()| Ok::<(), ()>(())));
}

/// So many cases on threads, which repeat after [`CASES`] as the runs alone do.
fn run_rows(bencher: divan::Bencher<'_, '_>, cases: u64, jobs: usize) {
    let plan = plan();
    let runner = CaseRunner::new(&plan, FileAccess::default());
    let interrupt = AtomicBool::new(false);
    let run = |case: u64| runner.run(case % CASES, &interrupt);
    bencher.bench_local(|| run_cases(0..cases, jobs, &interrupt, run, |_| Ok::<(), ()>(())));
}

#[divan::bench(args = [1, 2])]
fn bare_runs(bencher: divan::Bencher<'_, '_>, threads: usize) {
    run_bare(bencher, CASES, threads);
}

#[divan::bench(args = [1, 2])]
fn rows(bencher: divan::Bencher<'_, '_>, threads: usize) {
    run_rows(bencher, CASES, threads);
}

#[divan::bench(ignore, sample_count = 1, sample_size = 1)]
fn ten_thousand_bare_runs(bencher: divan::Bencher<'_, '_>) {
    run_bare(bencher, MANY_CASES, 2);
}

#[divan::bench(ignore, sample_count = 1, sample_size = 1)]
fn ten_thousand_rows(bencher: divan::Bencher<'_, '_>) {
    run_rows(bencher, MANY_CASES, 2);
}
