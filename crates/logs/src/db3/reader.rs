//! Reads the databases of a bag, one after the other, as one log.

use std::{
    collections::{BTreeMap, BTreeSet},
    io::Read,
    path::{Path, PathBuf},
    sync::Arc,
    vec,
};

use congruent_input::{Diagnostic, SourceFile, codes::file, open_regular, unreadable};

use super::{
    address::{Pending, pending},
    database::{BlockEnd, Database, MessagePlace, Order, WrittenMessage},
};
use crate::{
    codes,
    event::{LogEvent, LogFormat, LogReader, LogTopic},
    messages::MessageEvents,
};

/// The first bytes of every database of SQLite.
const MAGIC: &[u8] = b"SQLite format 3\0";

/// A bag in one or several databases.
pub(super) struct Db3Reader {
    files: vec::IntoIter<PathBuf>,
    file: Option<BagFile>,
    events: MessageEvents,
}

/// The database that is being read.
struct BagFile {
    source: Arc<SourceFile>,
    database: Database,
    /// Topics of the log by their numbers in the database.
    topics: BTreeMap<i64, usize>,
    /// Numbers of topics that the database does not declare, each reported once.
    undeclared: BTreeSet<i64>,
    order: Order,
    /// The last message that was read in the order of times.
    read: MessagePlace,
    /// Log time of the last message that was read.
    last_ns: Option<i64>,
    messages: u64,
    /// What is wrong with the index of times, as long as no message was found missing.
    index_fault: Option<String>,
    lost: Option<Lost>,
}

/// Messages that cannot be read, until the next one that can.
struct Lost {
    /// Number of the last message before, and the number behind which reading went on.
    between: [i64; 2],
    fault: String,
}

impl Db3Reader {
    pub(super) fn open(files: &[PathBuf], mut refused: Vec<Diagnostic>) -> Result<Self, Diagnostic> {
        let mut whole = Vec::new();
        for path in files {
            match opened(path) {
                Ok(_) => whole.push(path.clone()),
                Err(fault) => refused.push(fault),
            }
        }
        if let Some(fault) = refused.pop_if(|_| whole.is_empty()) {
            return Err(fault);
        }
        Ok(Self { files: whole.into_iter(), file: None, events: MessageEvents::with_gaps(refused) })
    }

    /// Reads a block of messages; `false` after the last of the log.
    fn step(&mut self) -> Result<bool, Diagnostic> {
        let Some(file) = &mut self.file else {
            let Some(path) = self.files.next() else { return Ok(false) };
            self.file = Some(BagFile::open(&path, &mut self.events)?);
            return Ok(true);
        };
        if !file.step(&mut self.events)? {
            self.file = None;
        }
        Ok(true)
    }
}

impl LogReader for Db3Reader {
    fn topics(&self) -> &[LogTopic] {
        self.events.topics()
    }

    fn next_event(&mut self) -> Result<Option<LogEvent>, Diagnostic> {
        loop {
            if let Some(event) = self.events.next() {
                return Ok(Some(event));
            }
            if !self.step()? {
                return Ok(None);
            }
        }
    }

    fn format(&self) -> LogFormat {
        LogFormat::Db3
    }
}

impl BagFile {
    fn open(path: &Path, events: &mut MessageEvents) -> Result<Self, Diagnostic> {
        let database = opened(path)?;
        let (written, fault) = database.topics();
        let topics: BTreeMap<i64, usize> = written
            .iter()
            .map(|topic| (topic.id, events.topic(&topic.name, &topic.message_type, &topic.encoding)))
            .collect();
        let decoded: Vec<i64> =
            topics.iter().filter(|(_, topic)| events.is_decoded(**topic)).map(|(id, _)| *id).collect();
        let database = database.with_decoded(&decoded);
        let order = if database.has_index() { Order::Time } else { Order::Written { after: i64::MIN } };
        let file = Self {
            source: Arc::new(SourceFile { path: path.to_owned(), text: String::new(), is_foreign: false }),
            database,
            topics,
            undeclared: BTreeSet::new(),
            order,
            read: MessagePlace::START,
            last_ns: None,
            messages: 0,
            index_fault: None,
            lost: None,
        };
        if let Some(fault) = fault {
            events.gap(None, file.damaged(&format!("topics cannot be read: {fault}")));
        }
        Ok(file)
    }

    /// Reads a block; `false` after the last.
    fn step(&mut self, events: &mut MessageEvents) -> Result<bool, Diagnostic> {
        let block = self.database.block(self.order, self.read);
        for message in block.messages {
            self.take(&message, events)?;
        }
        match block.end {
            BlockEnd::Full => Ok(true),
            BlockEnd::Last => {
                self.finish(events);
                Ok(false)
            }
            BlockEnd::Damaged(fault) => Ok(self.go_on(fault, events)),
        }
    }

    fn take(&mut self, message: &WrittenMessage, events: &mut MessageEvents) -> Result<(), Diagnostic> {
        let MessagePlace { log_ns, id } = message.place;
        self.report_lost(Some(log_ns), events);
        match &mut self.order {
            Order::Time => self.read = message.place,
            Order::Written { after } => *after = id,
        }
        if matches!(self.order, Order::Written { .. }) && message.place <= self.read {
            return Ok(());
        }
        self.last_ns = Some(log_ns);
        self.messages += 1;
        if let Some(&topic) = self.topics.get(&message.topic) {
            return events.take(topic, log_ns, &message.data).map_err(|fault| fault.in_file(&self.source));
        }
        if self.undeclared.insert(message.topic) {
            let fault =
                format!("messages of topic {} are left out: the table of topics lacks it", message.topic);
            events.gap(None, self.damaged(&fault));
        }
        Ok(())
    }

    /// Goes on behind a message that cannot be read; `false` if nothing behind it can.
    fn go_on(&mut self, fault: String, events: &mut MessageEvents) -> bool {
        let Order::Written { after } = self.order else {
            // The table may be whole where the index is not. What was read is passed over there.
            self.index_fault = Some(fault);
            self.order = Order::Written { after: i64::MIN };
            return true;
        };
        self.index_fault = None;
        let from = self.lost.take().map_or(after, |lost| lost.between[0]);
        let Some(whole) = self.database.behind_damage(after, self.read) else {
            events.gap(None, self.damaged(&format!("{} can be read: {fault}", nothing_behind(from))));
            return false;
        };
        self.lost = Some(Lost { between: [from, whole], fault });
        self.order = Order::Written { after: whole };
        true
    }

    fn finish(&mut self, events: &mut MessageEvents) {
        self.report_lost(None, events);
        if let Some(fault) = self.index_fault.take() {
            let fault = format!(
                "the index of times cannot be read: {fault}; messages behind the damage are in the order in which they were written"
            );
            events.gap(None, self.damaged(&fault));
        }
        // A recorder that dies may have written a page of the table, and not that of the index.
        let missing = match self.order {
            Order::Time => self.database.message_count().unwrap_or_default().saturating_sub(self.messages),
            Order::Written { .. } => 0,
        };
        if missing > 0 {
            let fault = format!("{missing} messages are left out: the index of times lacks them");
            events.gap(None, self.damaged(&fault));
        }
    }

    /// Reports what was lost, up to the message at this time.
    fn report_lost(&mut self, until_ns: Option<i64>, events: &mut MessageEvents) {
        let Some(Lost { between: [before, last], fault }) = self.lost.take() else { return };
        let which = if before == i64::MIN {
            format!("messages up to number {last}")
        } else {
            format!("messages {} to {last}", before.saturating_add(1))
        };
        let times_ns = self.last_ns.zip(until_ns).map(|(from_ns, to_ns)| [from_ns, to_ns]);
        events.gap(times_ns, self.damaged(&format!("{which} cannot be read: {fault}")));
    }

    fn damaged(&self, message: &str) -> Diagnostic {
        Diagnostic::warning(codes::log::DAMAGED, message).in_file(&self.source).with_help(
            "copy it again from the recorder; `sqlite3 BAG.db3 .recover | sqlite3 whole.db3` may find more",
        )
    }
}

fn nothing_behind(id: i64) -> String {
    if id == i64::MIN { "no message".to_owned() } else { format!("no message behind {id}") }
}

/// Opens a database, whose first bytes are those of one.
fn opened(path: &Path) -> Result<Database, Diagnostic> {
    let mut head = Vec::new();
    let bytes = open_regular(path, u64::MAX)?;
    bytes.take(MAGIC.len() as u64).read_to_end(&mut head).map_err(|fault| unreadable(path, &fault))?;
    let name = path.display();
    if head.is_empty() {
        return Err(Diagnostic::error(file::EMPTY, format!("{name} is empty"))
            .with_help("a recorder writes nothing before its first topic: record it again"));
    }
    if head != MAGIC {
        return Err(Diagnostic::error(codes::log::DATABASE, format!("{name} is no database of SQLite"))
            .with_help("`file FILE` says what it is; copy it again if it was damaged"));
    }
    Database::open(path).map_err(|fault| {
        let help = match pending(path) {
            Some(Pending::Log) => "messages are in the file -wal beside it: copy both into a folder in which you may write",
            Some(Pending::Journal) => "the recorder died while it wrote; `sqlite3 BAG.db3 .schema` on a copy of both files, -journal too, takes back what was half written",
            None => "`sqlite3 BAG.db3 .schema` lists its tables: those of a bag are topics and messages",
        };
        Diagnostic::error(codes::log::DATABASE, format!("{name} cannot be read as a bag: {fault}"))
            .with_help(help)
    })
}

#[cfg(test)]
#[path = "reader_tests.rs"]
mod tests;
