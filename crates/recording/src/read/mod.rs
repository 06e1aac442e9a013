//! Reads a recording back: its content, whether it is complete, and its verdict. Reads recordings of any
//! program, complete or cut off. Draws nothing and repairs nothing.

mod content;
mod frames;
mod judgement;
mod lengths;
mod panics;
mod summary;

use std::{
    fs::File,
    io::{self, BufReader, Read, Seek, SeekFrom},
    path::{Path, PathBuf},
};

use re_log_encoding::{CachingApplicationIdInjector, DecoderTransport, MessageHeader, ToApplication};
use re_log_types::LogMsg;

pub use summary::{EntitySummary, RecordingSummary, ScalarSummary, TimelineSummary};

use self::{content::RecordingContent, frames::Extent, panics::catch_panic};

/// Why a file cannot be read as a recording.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum InspectError {
    /// The file cannot be opened or read.
    #[error("cannot read {}: {source}", .path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// The error of the operating system.
        source: io::Error,
    },
    /// The path names a folder, a device or a pipe.
    #[error("{} is not a file", .path.display())]
    NotAFile {
        /// The path.
        path: PathBuf,
    },
    /// The file has no bytes.
    #[error("{} is empty", .path.display())]
    Empty {
        /// The file.
        path: PathBuf,
    },
    /// The first bytes are not those of a recording, or those of a format that is too old.
    #[error("{} is not a rerun recording: {reason}", .path.display())]
    NotARecording {
        /// The file.
        path: PathBuf,
        /// What is wrong with its first bytes.
        reason: String,
    },
    /// The file starts like a recording but contains none.
    #[error("{} contains no recording", .path.display())]
    NoRecording {
        /// The file.
        path: PathBuf,
    },
}

/// The most unreadable messages that are reported one by one; a corrupt file can have thousands.
const MAX_PROBLEMS: usize = 20;

/// The summary of a recording.
///
/// A file that is cut off is read up to its last complete message, which [`RecordingSummary::problems`]
/// reports.
///
/// # Errors
/// [`InspectError`] if there is no recording to read.
pub fn inspect(path: &Path) -> Result<RecordingSummary, InspectError> {
    let refused = |source| InspectError::Read { path: path.to_owned(), source };
    let metadata = std::fs::metadata(path).map_err(refused)?;
    if !metadata.is_file() {
        return Err(InspectError::NotAFile { path: path.to_owned() });
    }
    if metadata.len() == 0 {
        return Err(InspectError::Empty { path: path.to_owned() });
    }
    let mut file = BufReader::new(File::open(path).map_err(refused)?);
    let extent = Extent::of(&mut file, metadata.len())
        .map_err(refused)?
        .map_err(|reason| InspectError::NotARecording { path: path.to_owned(), reason })?;
    file.seek(SeekFrom::Start(0)).map_err(refused)?;
    let mut content = RecordingContent::default();
    read_messages(file.take(extent.readable), &mut content);
    let mut summary = content.summary().ok_or_else(|| InspectError::NoRecording { path: path.to_owned() })?;
    summary.bytes = metadata.len();
    summary.complete = extent.is_complete();
    summary.problems.splice(0..0, extent.problem(metadata.len()));
    (summary.exit_code, summary.reason) = judgement::judge(&summary);
    Ok(summary)
}

fn read_messages(file: io::Take<BufReader<File>>, content: &mut RecordingContent) {
    let mut applications = CachingApplicationIdInjector::default();
    let mut unreadable = 0_usize;
    // Each message has a header, which bounds their number.
    let max_messages = file.limit() / MessageHeader::ENCODED_SIZE_BYTES as u64;
    let max_messages = usize::try_from(max_messages).unwrap_or(usize::MAX);
    for message in DecoderTransport::decode_lazy(file).take(max_messages) {
        let taken = message.map_err(|error| error.to_string()).and_then(|message| {
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
