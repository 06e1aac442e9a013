//! Reads a recording back: what is in it, whether it is whole, and the verdict it carries. Any
//! recording will do, ours or not, whole or cut off. Nothing is drawn and nothing is repaired.

mod content;
mod frames;
mod payload;
mod shield;
mod summary;

use std::{
    fs::File,
    io::{self, BufReader, Read, Seek, SeekFrom},
    path::{Path, PathBuf},
};

use re_log_encoding::{CachingApplicationIdInjector, DecoderTransport, MessageHeader, ToApplication};
use re_log_types::LogMsg;

pub use summary::{EntitySummary, RecordingSummary, ScalarSummary, TimelineSummary};

use self::{content::Content, frames::Extent, shield::shielded};

/// Why a file cannot be read as a recording.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum InspectError {
    /// The file cannot be opened or read.
    #[error("cannot read {}: {source}", .path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// What the operating system says.
        source: io::Error,
    },
    /// A folder, a device or a pipe.
    #[error("{} is not a file", .path.display())]
    NotAFile {
        /// What was named.
        path: PathBuf,
    },
    /// Nothing in it.
    #[error("{} is empty", .path.display())]
    Empty {
        /// The file.
        path: PathBuf,
    },
    /// The first bytes are not those of a recording, or of one that is too old.
    #[error("{} is not a rerun recording: {reason}", .path.display())]
    NotARecording {
        /// The file.
        path: PathBuf,
        /// What is wrong with its first bytes.
        reason: String,
    },
    /// It starts like a recording, but none is in it.
    #[error("{} holds no recording", .path.display())]
    NoRecording {
        /// The file.
        path: PathBuf,
    },
}

/// Faults that are told one by one; a spoilt file may have thousands.
const MOST_PROBLEMS: usize = 20;

/// Reads a recording.
///
/// A file that is cut off is read up to its last whole message; [`RecordingSummary::problems`]
/// says so.
///
/// # Errors
/// [`InspectError`] where there is no recording to read.
pub fn inspect(path: &Path) -> Result<RecordingSummary, InspectError> {
    let refused = |source| InspectError::Read { path: path.to_owned(), source };
    let kind = std::fs::metadata(path).map_err(refused)?;
    if !kind.is_file() {
        return Err(InspectError::NotAFile { path: path.to_owned() });
    }
    if kind.len() == 0 {
        return Err(InspectError::Empty { path: path.to_owned() });
    }
    let mut file = BufReader::new(File::open(path).map_err(refused)?);
    let extent = Extent::of(&mut file, kind.len())
        .map_err(refused)?
        .map_err(|reason| InspectError::NotARecording { path: path.to_owned(), reason })?;
    file.seek(SeekFrom::Start(0)).map_err(refused)?;
    let mut content = Content::default();
    read_messages(file.take(extent.readable), &mut content);
    let mut summary = content.summary().ok_or_else(|| InspectError::NoRecording { path: path.to_owned() })?;
    summary.bytes = kind.len();
    summary.complete = extent.is_whole();
    summary.problems.splice(0..0, extent.problem(kind.len()));
    Ok(summary)
}

fn read_messages(file: io::Take<BufReader<File>>, content: &mut Content) {
    let mut applications = CachingApplicationIdInjector::default();
    let mut faults = 0_usize;
    // Each message has a header: there cannot be more of them.
    let most = file.limit() / MessageHeader::ENCODED_SIZE_BYTES as u64;
    let most = usize::try_from(most).unwrap_or(usize::MAX);
    for message in DecoderTransport::decode_lazy(file).take(most) {
        let taken = message.map_err(|error| error.to_string()).and_then(|message| {
            payload::check(&message)?;
            shielded(|| {
                let message = message.to_application((&mut applications, None));
                add(content, message.map_err(|error| error.to_string())?)
            })
        });
        if let Err(error) = taken {
            faults += 1;
            if faults <= MOST_PROBLEMS {
                content.add_problem(format!("a message cannot be read: {error}"));
            }
        }
    }
    if faults > MOST_PROBLEMS {
        content.add_problem(format!("{faults} messages cannot be read in all"));
    }
}

fn add(content: &mut Content, message: LogMsg) -> Result<(), String> {
    match message {
        LogMsg::SetStoreInfo(info) => content.add_store(&info.info.store_id),
        LogMsg::ArrowMsg(store, message) => content.add_chunk(&store, &message)?,
        LogMsg::BlueprintActivationCommand(_) => {}
    }
    Ok(())
}
