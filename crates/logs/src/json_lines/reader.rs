//! A file in JSON Lines as a log.

use std::{collections::VecDeque, fs::File, io::BufReader, path::Path, sync::Arc};

use congruent_input::{Diagnostic, SourceFile, display::counted, open_regular, unreadable};

use super::stream::{BadLine, JsonLines, LineEvents};
use crate::{
    codes,
    event::{LogEvent, LogFormat, LogGap, LogReader, LogTopic},
};

/// A file of lines.
pub(crate) struct JsonLinesReader {
    source: Arc<SourceFile>,
    lines: JsonLines<BufReader<File>>,
    events: VecDeque<LogEvent>,
    bad: usize,
    first_bad: Option<BadLine>,
    is_at_end: bool,
}

impl JsonLinesReader {
    /// Opens a file.
    ///
    /// # Errors
    /// It cannot be read.
    pub(crate) fn open(path: &Path) -> Result<Self, Diagnostic> {
        let file = open_regular(path, u64::MAX)?;
        let source = SourceFile { path: path.to_owned(), text: String::new(), is_foreign: false };
        Ok(Self {
            source: Arc::new(source),
            lines: JsonLines::new(BufReader::new(file)),
            events: VecDeque::new(),
            bad: 0,
            first_bad: None,
            is_at_end: false,
        })
    }

    fn step(&mut self) -> Result<(), Diagnostic> {
        // A file has one time: that of the values.
        match self.lines.next(|time_ns| time_ns).map_err(|error| unreadable(&self.source.path, &error))? {
            Some(Ok(LineEvents { joints, pose })) => {
                self.events.extend(joints.map(LogEvent::Joints));
                self.events.extend(pose.map(LogEvent::Pose));
            }
            Some(Err(bad)) => {
                self.bad += 1;
                self.events.push_back(LogEvent::Unusable(1));
                self.first_bad.get_or_insert(bad);
            }
            None => {
                self.is_at_end = true;
                self.report_bad_lines();
            }
        }
        Ok(())
    }

    fn report_bad_lines(&mut self) {
        let Some(BadLine { line, message, .. }) = &self.first_bad else { return };
        let message = format!("{} left out; the first is line {line}: {message}", counted(self.bad, "line"));
        let cause = Diagnostic::warning(codes::log::LINES, message)
            .with_help("a line is {\"time_s\": 1.25, \"q\": {\"elbow_joint\": 0.4}}")
            .in_file(&self.source);
        self.events.push_back(LogEvent::Gap(LogGap { between_s: None, cause }));
    }
}

impl LogReader for JsonLinesReader {
    fn format(&self) -> LogFormat {
        LogFormat::JsonLines
    }

    fn topics(&self) -> &[LogTopic] {
        self.lines.topics()
    }

    fn next_event(&mut self) -> Result<Option<LogEvent>, Diagnostic> {
        while self.events.is_empty() && !self.is_at_end {
            self.step()?;
        }
        Ok(self.events.pop_front())
    }
}

#[cfg(test)]
mod tests {
    use congruent_input::Severity;

    use super::*;

    #[test]
    fn a_file_has_joints_and_poses_and_its_bad_lines_are_counted() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("arm.jsonl");
        let text = r#"{"time_s": 10.0, "q": {"a": 1, "b": 2}}
not a line

{"time_s": 10.5, "q": {"a": 1.5, "b": 2}, "pose": {"frame": "base", "translation_m": [0, 0, 1], "quaternion_wxyz": [1, 0, 0, 0]}}
{"time_s": 11.0}
"#;
        std::fs::write(&path, text).unwrap();
        let mut reader = JsonLinesReader::open(&path).unwrap();
        let mut events = Vec::new();
        while let Some(event) = reader.next_event().unwrap() {
            events.push(event);
        }
        let [
            LogEvent::Joints(first),
            LogEvent::Unusable(1),
            LogEvent::Joints(second),
            LogEvent::Pose(pose),
            LogEvent::Unusable(1),
            LogEvent::Gap(gap),
        ] = &events[..]
        else {
            panic!("{events:?}")
        };
        assert_eq!((first.time.log_s, second.time.log_s), (0.0, 0.5));
        assert!(Arc::ptr_eq(&first.names, &second.names), "equal names are shared");
        assert_eq!(reader.topics()[pose.topic].name, "pose");
        assert_eq!(gap.cause.severity, Severity::Warning);
        assert!(
            gap.cause.message.starts_with("2 lines left out; the first is line 2"),
            "{}",
            gap.cause.message
        );
    }
}
