//! Reads a recording back: its content, whether it is complete, and its verdict. Reads recordings of any
//! program up to their end or the first damaged message. Draws nothing and repairs nothing.

mod content;
mod evidence;
mod exit_code;
mod frames;
mod label;
mod lengths;
mod recheck;
mod rechecked;
mod summary;
mod table;

use std::{
    collections::BTreeMap,
    fs::File,
    io::{self, BufReader, Read},
    path::{Path, PathBuf},
};

use congruent_input::catch_panic;
use congruent_results::comparison::Scalars;
use re_log_encoding::{CachingApplicationIdInjector, Decodable, ToApplication};
use re_log_types::LogMsg;
use re_protos::log_msg::v1alpha1::log_msg::Msg;

use self::{
    content::RecordingContent,
    frames::{FileEnd, FileFrames},
};
use crate::rrd::times::seconds;

pub use label::label;
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
/// A file that is cut off or damaged is read up to there, which is the first of [`RecordingSummary::problems`].
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
    let file = BufReader::new(File::open(path).map_err(refused)?);
    let mut frames = FileFrames::begin(file, metadata.len())
        .map_err(refused)?
        .map_err(|reason| InspectError::NotARecording { path: path.to_owned(), reason })?;
    let (position, end) = read_messages(&mut frames, content).map_err(refused)?;
    let problem = problem(position, &end, content);
    let mut summary = content.summary().ok_or_else(|| InspectError::NoRecording { path: path.to_owned() })?;
    summary.bytes = metadata.len();
    summary.complete = end == FileEnd::Complete;
    // The problem of the file comes before those of its values, and the first one is the reason of the exit code.
    summary.problems.splice(0..0, problem);
    (summary.exit_code, summary.reason) = exit_code::judge(&summary);
    Ok(summary)
}

/// Adds the messages up to the end of the file or the first one that cannot be read. Returns why it is the last one, and
/// its first byte.
fn read_messages(
    frames: &mut FileFrames<impl Read>,
    content: &mut RecordingContent,
) -> io::Result<(u64, FileEnd)> {
    let mut applications = CachingApplicationIdInjector::default();
    loop {
        let position = frames.position();
        let message = match frames.next_message()? {
            Ok(message) => message,
            Err(end) => return Ok((position, end)),
        };
        // Damaged bytes reach code of rerun that expects its own output, and a panic there must not end the call.
        if let Err(error) = catch_panic(|| add(content, &message, &mut applications)) {
            return Ok((position, FileEnd::Damaged(error)));
        }
    }
}

/// What is wrong with the file, and what to do.
fn problem(position: u64, end: &FileEnd, content: &RecordingContent) -> Option<String> {
    let what = match end {
        FileEnd::Complete => return None,
        FileEnd::NotFinished => "the file has no footer, so the recording was not finished".to_owned(),
        FileEnd::CutOff => format!("the file is cut off in the message at byte {position}"),
        FileEnd::Damaged(error) => format!("the file is damaged at byte {position}: {error}"),
    };
    let last = content.last_chunk().map_or_else(String::new, |last| format!(", after {last}"));
    Some(format!("{what}{last}; it is read up to there: copy it again, or repeat its run"))
}

fn add(
    content: &mut RecordingContent,
    message: &[u8],
    applications: &mut CachingApplicationIdInjector,
) -> Result<(), String> {
    let Some(message) = Option::<Msg>::from_rrd_bytes(message).map_err(|error| error.to_string())? else {
        return Ok(());
    };
    // Before the Arrow reader sees the message: it allocates what the message states.
    lengths::check(&message)?;
    match message.to_application((applications, None)).map_err(|error| error.to_string())? {
        LogMsg::SetStoreInfo(info) => content.add_store(&info.info.store_id),
        LogMsg::ArrowMsg(store, message) => content.add_chunk(&store, &message)?,
        LogMsg::BlueprintActivationCommand(_) => {}
    }
    Ok(())
}
