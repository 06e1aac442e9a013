//! `congruent run`: runs scenario files without a display.

mod arguments;
mod faults;
mod index;
pub(crate) mod log_arguments;
pub(crate) mod replay;
mod resumed;
mod run_answer;

use std::sync::{Mutex, atomic::Ordering};

use congruent::results::Options;

use self::{
    arguments::{recording_format, recordings},
    index::write_index,
    resumed::{LoadedScenario, load},
};
use crate::{
    batch::{Answer, Batch},
    failure::Failure,
    interrupt::flag_of_signals,
    sweep_plans::without_plans,
    terminal::{print::Printer, progress::ProgressLines},
};

pub(crate) use self::run_answer::no_folder;
pub(crate) use self::{
    arguments::Arguments,
    run_answer::{RunAnswer, run_one},
};

pub(crate) fn run(arguments: &Arguments, printer: &Printer) -> Result<u8, Failure> {
    if arguments.faults.faults {
        return faults::run(arguments, printer);
    }
    let recording = recording_format(arguments, printer)?;
    let scenarios = without_plans(&arguments.scenarios, printer);
    let arguments = &arguments.of(scenarios);
    let batch = Batch::begin(&arguments.scenarios, &arguments.ci, printer)?;
    let recordings = recordings(recording.as_deref());
    let options = Options { out: arguments.out.clone(), recordings, interrupt: None };
    let loaded = load(arguments, &options, &batch)?;
    batch.plan(&loaded, LoadedScenario::suite);
    let interrupt = flag_of_signals();
    let progress = ProgressLines::new(printer);
    let options = Options { interrupt: Some(&interrupt), ..options };
    let answers = run_all(loaded, arguments, &options, &batch, &progress);
    if arguments.resume {
        let kept = answers.iter().filter(|answer| answer.report().is_ok_and(|ran| ran.is_kept)).count();
        let note = format!("{kept} of {} kept from an earlier call", answers.len());
        printer.notes([note.as_str()]);
    }
    let written = write_index(&answers, &arguments.out);
    batch.finish_with_page(answers, written)
}

/// Runs scenarios on `--jobs` threads; answers are in the order of the arguments.
fn run_all(
    loaded: Vec<Answer<LoadedScenario>>,
    arguments: &Arguments,
    options: &Options<'_>,
    batch: &Batch<'_>,
    progress: &ProgressLines,
) -> Vec<Answer<RunAnswer>> {
    let is_interrupted = || options.interrupt.is_some_and(|flag| flag.load(Ordering::Relaxed));
    let jobs = arguments.threads(loaded.len());
    let waiting = Mutex::new(loaded.into_iter().enumerate());
    let work = || {
        let mut answers = Vec::new();
        loop {
            let next = waiting.lock().expect("no thread panics while it takes a scenario").next();
            let Some((index, loaded)) = next else { return answers };
            let answer = batch.go_on(loaded, |loaded| match loaded {
                LoadedScenario::Finished(report, folder) => {
                    Ok(RunAnswer { report: *report, results: Ok(folder), missing: Vec::new(), is_kept: true })
                }
                LoadedScenario::New(_) if is_interrupted() => {
                    Err(Failure::Machine("interrupted before it started".to_owned()))
                }
                LoadedScenario::New(mut scenario) => {
                    scenario.case_threads = arguments.case_threads(jobs);
                    run_one(&scenario, options, progress)
                }
            });
            batch.keep(index, &answer);
            progress.suspended(|| batch.report(&answer));
            answers.push((index, answer));
        }
    };
    let mut answers: Vec<(usize, Answer<RunAnswer>)> = std::thread::scope(|scope| {
        let threads: Vec<_> = (0..jobs).map(|_| scope.spawn(work)).collect();
        threads
            .into_iter()
            .flat_map(|thread| thread.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)))
            .collect()
    });
    answers.sort_by_key(|(index, _)| *index);
    answers.into_iter().map(|(_, answer)| answer).collect()
}
