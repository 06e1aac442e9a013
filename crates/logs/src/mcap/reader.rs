//! Reads the files of a log in MCAP, one after the other, as one log.

use std::{
    fs::File,
    io,
    path::{Path, PathBuf},
    sync::Arc,
    vec,
};

use congruent_input::{Code, Diagnostic, SourceFile, unreadable};
use mcap::{
    parse_record,
    records::{Record, op},
};

use super::{
    chunk::Chunk,
    framing::{Framed, Framing, HEAD_BYTES, MOST_RECORD_BYTES},
    records::{RecordFault, Records},
    summary::Summary,
};
use crate::{
    codes,
    event::{LogEvent, LogFormat, LogReader, LogTopic},
};

/// Bytes of a chunk beside the name of its compression and its records: three times 8, a sum and a length of 4, and 8.
const CHUNK_FIELD_BYTES: usize = 40;

/// A log in one or several files of MCAP.
pub(crate) struct McapReader {
    files: vec::IntoIter<PathBuf>,
    file: Option<McapFile>,
    records: Records,
    /// The content of the record that is being read.
    content: Vec<u8>,
    chunk: Chunk,
}

/// The file that is being read.
struct McapFile {
    source: Arc<SourceFile>,
    framing: Framing,
    summary: Summary,
}

impl McapReader {
    /// A log in these files, in this order. Each was seen to be an MCAP. `refused` is why other files of the log are not read.
    pub(crate) fn new(files: Vec<PathBuf>, refused: Vec<Diagnostic>) -> Self {
        Self {
            files: files.into_iter(),
            file: None,
            records: Records::new(refused),
            content: Vec::new(),
            chunk: Chunk::default(),
        }
    }

    /// Reads a record; `false` after the last of the log.
    fn step(&mut self) -> Result<bool, Diagnostic> {
        let Some(file) = &mut self.file else { return self.open_next() };
        match self.chunk.next() {
            Ok(Some(record)) => {
                let taken = self.records.take(record.code, record.content, &file.summary);
                return file.report(taken, &mut self.records).map(|()| true);
            }
            Ok(None) => {}
            Err(fault) => file.damaged(&mut self.records, None, &format!("a chunk: {fault}")),
        }
        let framed = file.framing.next(&mut self.content);
        match framed.map_err(|fault| unreadable(&file.source.path, &fault))? {
            Framed::Record(op::CHUNK) => self.open_chunk()?,
            Framed::Record(op::DATA_END | op::FOOTER) => self.file = None,
            Framed::Record(code) => {
                let taken = self.records.take(code, &self.content, &file.summary);
                file.report(taken, &mut self.records)?;
            }
            Framed::End => {
                self.records.gap(None, file.truncated("the log ends without an end record"));
                self.file = None;
            }
            Framed::Cut(at) | Framed::NoRecord(at) | Framed::TooLong(at)
                if file.summary.chunk_behind(at).is_some() =>
            {
                file.go_on_behind(at, &mut self.records)?;
            }
            Framed::Cut(at) => {
                let cut = file.truncated(&format!("the log ends inside the record that begins at byte {at}"));
                self.records.gap(None, cut);
                self.file = None;
            }
            Framed::TooLong(at) => {
                let limit = MOST_RECORD_BYTES >> 20;
                let fault =
                    format!("the record that begins at byte {at} is longer than {limit} MiB and is left out");
                file.damaged(&mut self.records, None, &fault);
            }
            Framed::NoRecord(at) => {
                let fault = format!("what begins at byte {at} is no record; nothing behind it is read");
                file.damaged(&mut self.records, None, &fault);
                self.file = None;
            }
        }
        Ok(true)
    }

    fn open_next(&mut self) -> Result<bool, Diagnostic> {
        let Some(path) = self.files.next() else { return Ok(false) };
        let opened = McapFile::open(&path).map_err(|fault| unreadable(&path, &fault))?;
        self.records.begin_file();
        self.file = Some(opened);
        Ok(true)
    }

    /// Decompresses the chunk that is the content.
    fn open_chunk(&mut self) -> Result<(), Diagnostic> {
        let Some(file) = &mut self.file else { return Ok(()) };
        let end = file.framing.at();
        let start = end - (HEAD_BYTES + self.content.len()) as u64;
        let Ok(Record::Chunk { header, data }) = parse_record(op::CHUNK, &self.content) else {
            let next = file.summary.chunk_behind(start).map_or(end, |chunk| chunk.chunk_start_offset);
            let fault = format!("the chunk that begins at byte {start} is shorter than it claims");
            file.damaged(&mut self.records, file.summary.times_between(start, next), &fault);
            return file.go_to(next);
        };
        let times = Some([header.message_start_time, header.message_end_time]);
        let length = CHUNK_FIELD_BYTES + header.compression.len() + data.len();
        if length < self.content.len() {
            // Its length is damaged, and would take the chunks behind it with it.
            let next = start + (HEAD_BYTES + length) as u64;
            let fault = format!("the chunk that begins at byte {start} is longer than what it has");
            file.damaged(&mut self.records, times, &fault);
            return file.go_to(next);
        }
        if let Err(fault) = self.chunk.fill(&header, &data) {
            file.damaged(
                &mut self.records,
                times,
                &format!("the chunk that begins at byte {start}: {fault}"),
            );
        }
        Ok(())
    }
}

impl LogReader for McapReader {
    fn format(&self) -> LogFormat {
        LogFormat::Mcap
    }

    fn topics(&self) -> &[LogTopic] {
        self.records.events.topics()
    }

    fn next_event(&mut self) -> Result<Option<LogEvent>, Diagnostic> {
        loop {
            if let Some(event) = self.records.events.next() {
                return Ok(Some(event));
            }
            if !self.step()? {
                return Ok(None);
            }
        }
    }
}

impl McapFile {
    fn open(path: &Path) -> io::Result<Self> {
        let mut file = File::open(path)?;
        let summary = Summary::read(&mut file)?;
        let source = SourceFile { path: path.to_owned(), text: String::new(), is_foreign: false };
        Ok(Self { source: Arc::new(source), framing: Framing::new(file)?, summary })
    }

    fn finding(&self, code: &'static Code, message: &str) -> Diagnostic {
        Diagnostic::warning(code, message).in_file(&self.source)
    }

    fn truncated(&self, message: &str) -> Diagnostic {
        self.finding(codes::log::TRUNCATED, message).with_help(
            "all that is whole before it is read; `mcap recover` writes that as a file with an end",
        )
    }

    fn damaged(&self, records: &mut Records, times: Option<[u64; 2]>, fault: &str) {
        records.gap(times, self.finding(codes::log::DAMAGED, fault));
    }

    /// A record that is damaged is a gap; one that cannot be read on principle ends the reading.
    fn report(&self, taken: Result<(), RecordFault>, records: &mut Records) -> Result<(), Diagnostic> {
        match taken {
            Ok(()) => {}
            Err(RecordFault::Damaged(fault)) => self.damaged(records, None, &fault),
            Err(RecordFault::Refused(cause)) => return Err(cause.in_file(&self.source)),
        }
        Ok(())
    }

    /// Goes to the next chunk that the summary knows behind a damaged place.
    fn go_on_behind(&mut self, at: u64, records: &mut Records) -> Result<(), Diagnostic> {
        let Some(next) = self.summary.chunk_behind(at).map(|chunk| chunk.chunk_start_offset) else {
            return Ok(());
        };
        let fault = format!("what begins at byte {at} is no record; reading goes on at byte {next}");
        self.damaged(records, self.summary.times_between(at, next), &fault);
        self.go_to(next)
    }

    fn go_to(&mut self, at: u64) -> Result<(), Diagnostic> {
        self.framing.go_to(at).map_err(|fault| unreadable(&self.source.path, &fault))
    }
}

#[cfg(test)]
#[path = "reader_tests.rs"]
mod tests;
