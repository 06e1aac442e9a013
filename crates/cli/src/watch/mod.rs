//! `congruent watch`: a stream of the real robot against the checks of a run, while it comes.

mod answering;
mod arguments;
#[cfg(feature = "recording")]
mod recording;

use std::{
    io::{BufReader, ErrorKind, IsTerminal, stdin},
    rc::Rc,
    sync::{Arc, atomic::AtomicBool},
};

use congruent::{
    description::{RobotDescription, load_robot_with},
    input::{Diagnostic, codes::file},
    logs::{LiveReader, OnNotice, listen_to_lines, listen_to_rtde},
    watch::{SharedOutput, WatchLine, WatchOutput, WatchSetup, watch_text},
};

use self::answering::{Judged, judge};
pub(crate) use self::arguments::Arguments;
use crate::{
    failure::{BROKEN, Failure},
    interrupt::flag_of_signals,
    terminal::print::Printer,
};

pub(crate) fn run(arguments: &Arguments, printer: &Printer) -> Result<u8, Failure> {
    let access = arguments.access.access()?;
    let description = load_robot_with(&arguments.robot, &access)?;
    printer.warnings(Some(&arguments.robot), &description.warnings);
    let output = WatchOutput::shared(Box::new(printer.lines(watch_text)));
    let stop = flag_of_signals();
    let mut reader = listen(arguments, &description, &stop, &output)?;
    let watched = WatchSetup::listen(&mut reader, description, &arguments.request(), &access)?;
    printer.warnings(None, &watched.setup.warnings);
    let Judged { report, counts, exit_code } = judge(arguments, &watched, reader, &output, printer)?;
    let mut end = output.borrow().end(report, counts);
    end.exit_code = exit_code;
    output.borrow_mut().say(&WatchLine::Finished(Box::new(end)));
    match output.borrow().broken() {
        // Whoever reads has seen enough, as `head`.
        Some(error) if error.kind() == ErrorKind::BrokenPipe => Ok(BROKEN),
        Some(error) => Err(Failure::Machine(format!("cannot write the result: {error}"))),
        None => Ok(exit_code),
    }
}

/// Begins to listen to the stream.
fn listen(
    arguments: &Arguments,
    description: &RobotDescription,
    stop: &Arc<AtomicBool>,
    output: &SharedOutput,
) -> Result<LiveReader, Failure> {
    let reported = Rc::clone(output);
    let on_notice: OnNotice = Box::new(move |notice| reported.borrow_mut().notice(notice));
    if let Some(address) = &arguments.rtde {
        let options = arguments.rtde_options(address, description)?;
        return Ok(listen_to_rtde(options, Arc::clone(stop), on_notice)?);
    }
    if stdin().is_terminal() {
        let message = "standard input is a terminal: nothing streams there";
        return Err(Diagnostic::error(file::NO_WRITER, message)
            .with_help("let a program write to it, as `driver | congruent watch ROBOT`, or give --rtde HOST")
            .into());
    }
    Ok(listen_to_lines(BufReader::new(stdin()), Arc::clone(stop), on_notice))
}
