//! Reads a recording back: its content, whether it is complete, and its verdict. Reads recordings of any
//! program, complete or cut off. Draws nothing and repairs nothing.

mod content;
mod damage;
mod evidence;
mod exit_code;
mod frames;
mod lengths;
mod recheck;
mod rechecked;
mod summary;
mod table;

use std::{
    collections::BTreeMap,
    fs::File,
    io::{self, BufRead, BufReader},
    path::{Path, PathBuf},
};

use congruent_input::catch_panic;
use congruent_results::comparison::Scalars;
use re_log_encoding::{CachingApplicationIdInjector, DecoderTransport, MessageHeader, ToApplication};
use re_log_types::LogMsg;

use self::{
    content::RecordingContent,
    damage::MAX_PROBLEMS,
    frames::{FileParts, Frames},
};
use crate::rrd::times::seconds;

pub use damage::{CheckSums, Damage};
pub use recheck::{RecheckError, recheck};
pub use rechecked::{Basis, Disagreement, Recheck, RecheckedCheck, RecheckedQuantity};
pub use summary::{
    CheckSummary, EntitySummary, QuantitySummary, RecordingSummary, ScalarSummary, TimelineSummary,
};
pub use table::scalars_csv;

/// Why a file cannot be read as a recording.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum InspectError {
    /// The file cannot be opened or read.
    #[error("cannot read {}: {source}", .path.display())]
    Read {
        /// The file as it was named.
        path: PathBuf,
        /// The error of the operating system.
        source: io::Error,
    },
    /// The path names a folder, a device or a pipe.
    #[error("{} is not a file", .path.display())]
    NotAFile {
        /// The path as it was named.
        path: PathBuf,
    },
    /// The file has no bytes.
    #[error("{} is empty", .path.display())]
    Empty {
        /// The file as it was named.
        path: PathBuf,
    },
    /// The first bytes are not those of a recording, or those of a format that is too old.
    #[error("{} is not a rerun recording: {reason}", .path.display())]
    NotARecording {
        /// The file as it was named.
        path: PathBuf,
        /// What is wrong with its first bytes.
        reason: String,
    },
    /// The file starts like a recording but contains none.
    #[error("{} contains no recording", .path.display())]
    NoRecording {
        /// The file as it was named.
        path: PathBuf,
    },
}

/// The summary of a recording.
///
/// A file that is cut off is read up to its last complete message, one that is damaged except for what is; both is
/// reported in [`RecordingSummary::problems`].
///
/// # Errors
/// [`InspectError`] if there is no recording to read.
pub fn inspect(path: &Path) -> Result<RecordingSummary, InspectError> {
    read(path, &mut RecordingContent::default())
}

/// The summary of a recording, and all values of each scalar by the path of its entity, with times in seconds that
/// rise.
///
/// # Errors
/// [`InspectError`] if there is no recording to read.
pub fn scalars(path: &Path) -> Result<(RecordingSummary, Scalars), InspectError> {
    let in_seconds = |(nanoseconds, value): (i64, f64)| (seconds(nanoseconds), value);
    let mut content = RecordingContent::default();
    content.series = Some(BTreeMap::new());
    let summary = read(path, &mut content)?;
    let sorted = |(path, mut series): (String, Vec<(i64, f64)>)| {
        // Stable: of equal times the later in the file stays last. Chunks need not be in order of time.
        series.sort_by_key(|&(nanoseconds, _)| nanoseconds);
        (path, series.into_iter().map(in_seconds).collect())
    };
    Ok((summary, content.series.unwrap_or_default().into_iter().map(sorted).collect()))
}

fn read(path: &Path, content: &mut RecordingContent) -> Result<RecordingSummary, InspectError> {
    let refused = |source| InspectError::Read { path: path.to_owned(), source };
    let metadata = std::fs::metadata(path).map_err(refused)?;
    if !metadata.is_file() {
        return Err(InspectError::NotAFile { path: path.to_owned() });
    }
    if metadata.len() == 0 {
        return Err(InspectError::Empty { path: path.to_owned() });
    }
    let mut file = BufReader::new(File::open(path).map_err(refused)?);
    let length = metadata.len();
    let mut frames = Frames::read(&mut file, length)
        .map_err(refused)?
        .map_err(|reason| InspectError::NotARecording { path: path.to_owned(), reason })?;
    // Before the content: the damaged ranges are examined for what they held, and then not read any more.
    let damaged = frames.damaged.iter().map(|range| Damage::examine(&mut file, range.clone()));
    let damaged: Vec<Damage> = damaged.collect::<io::Result<_>>().map_err(refused)?;
    let problems = frames.problem(length).into_iter().chain(damage::problems(&damaged)).collect::<Vec<_>>();
    // Each message has a header, which bounds their number.
    let most = usize::try_from(length).unwrap_or(usize::MAX) / MessageHeader::ENCODED_SIZE_BYTES;
    let parts = FileParts::new(file.into_inner(), std::mem::take(&mut frames.readable));
    read_messages(BufReader::new(parts), most, content);
    let mut summary = content.summary().ok_or_else(|| InspectError::NoRecording { path: path.to_owned() })?;
    summary.bytes = length;
    summary.complete = frames.is_complete();
    summary.check_sums = frames.intact.map(|intact| CheckSums { intact, damaged });
    // Problems of the file come before those of its values, and the first one is the reason of the exit code.
    summary.problems.splice(0..0, problems);
    (summary.exit_code, summary.reason) = exit_code::judge(&summary);
    Ok(summary)
}

fn read_messages(file: impl BufRead, most: usize, content: &mut RecordingContent) {
    let mut applications = CachingApplicationIdInjector::default();
    let mut unreadable = 0_usize;
    for message in DecoderTransport::decode_lazy(file).take(most) {
        let taken = message.map_err(|error| error.to_string()).and_then(|message| {
            // Before the Arrow reader sees the message: it allocates what the message states.
            lengths::check(&message)?;
            catch_panic(|| {
                let message = message.to_application((&mut applications, None));
                add(content, message.map_err(|error| error.to_string())?)
            })
        });
        if let Err(error) = taken {
            unreadable += 1;
            if unreadable <= MAX_PROBLEMS {
                content.add_problem(format!("a message cannot be read: {error}"));
            }
        }
    }
    if unreadable > MAX_PROBLEMS {
        content.add_problem(format!("{unreadable} messages cannot be read in total"));
    }
}

fn add(content: &mut RecordingContent, message: LogMsg) -> Result<(), String> {
    match message {
        LogMsg::SetStoreInfo(info) => content.add_store(&info.info.store_id),
        LogMsg::ArrowMsg(store, message) => content.add_chunk(&store, &message)?,
        LogMsg::BlueprintActivationCommand(_) => {}
    }
    Ok(())
}
