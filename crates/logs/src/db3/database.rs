//! The database of a bag: its topics, and its messages block by block.

use std::path::Path;

use rusqlite::{Connection, OpenFlags, Row, limits::Limit, types::ValueRef};

use super::address::read_only_address;

/// Most bytes of a message. Kind: choice; as of a record of an MCAP.
const MOST_MESSAGE_BYTES: i32 = 256 << 20;
/// Bytes of messages after which a block ends. Kind: choice; an image is a block of its own.
const BLOCK_BYTES: usize = 1 << 20;
/// Messages after which a block ends, whose times alone are read. Kind: choice.
const BLOCK_MESSAGES: usize = 4096;

/// A topic as the database has it.
pub(super) struct WrittenTopic {
    pub(super) id: i64,
    pub(super) name: String,
    pub(super) message_type: String,
    pub(super) encoding: String,
}

/// A message as the database has it.
pub(super) struct WrittenMessage {
    pub(super) place: MessagePlace,
    pub(super) topic: i64,
    /// Empty if its topic is not decoded, or if it was read before.
    pub(super) data: Vec<u8>,
}

/// The place of a message in the order of times; the first written is the first of those at one time.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct MessagePlace {
    pub(super) log_ns: i64,
    pub(super) id: i64,
}

impl MessagePlace {
    /// Before all messages.
    pub(super) const START: Self = Self { log_ns: i64::MIN, id: i64::MIN };
}

/// The order in which messages are read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Order {
    /// By the index of times.
    Time,
    /// As they were written, from behind this number on: without the index, and without any sorting.
    Written { after: i64 },
}

/// Messages that were read, and why no more were.
#[derive(Default)]
pub(super) struct MessageBlock {
    pub(super) messages: Vec<WrittenMessage>,
    pub(super) end: BlockEnd,
}

/// Why a block ends.
#[derive(Debug, Default)]
pub(super) enum BlockEnd {
    /// It is full.
    #[default]
    Full,
    /// It has the last message.
    Last,
    /// The next message cannot be read.
    Damaged(String),
}

/// An open database.
pub(super) struct Database {
    connection: Connection,
    /// What is selected of a message, once it is known which topics are decoded.
    columns: String,
}

impl Database {
    /// Opens a database that has the tables of a bag; says why not otherwise.
    pub(super) fn open(path: &Path) -> Result<Self, String> {
        let address = read_only_address(path).map_err(|fault| fault.to_string())?;
        let flags =
            OpenFlags::SQLITE_OPEN_READ_ONLY | OpenFlags::SQLITE_OPEN_URI | OpenFlags::SQLITE_OPEN_NO_MUTEX;
        let opened = Connection::open_with_flags(address, flags).and_then(|connection| {
            connection.set_limit(Limit::SQLITE_LIMIT_LENGTH, MOST_MESSAGE_BYTES)?;
            // A file that is shorter than its head says would else be refused as a whole. Nothing is written: it is read-only.
            connection.execute_batch("pragma writable_schema = on; pragma cell_size_check = on")?;
            Ok(connection)
        });
        let connection = opened.map_err(|fault| fault.to_string())?;
        for table in ["topics", "messages"] {
            has_table(&connection, table)?;
        }
        let database = Self { connection, columns: String::new() }.with_decoded(&[]);
        // Columns that are missing are known before the first message is read.
        for query in [database.query(Order::Time), database.query(Order::Written { after: 0 })] {
            database.connection.prepare(&query).map_err(|fault| fault.to_string())?;
        }
        Ok(database)
    }

    /// The messages of these topics are read, of others the times alone.
    pub(super) fn with_decoded(mut self, topics: &[i64]) -> Self {
        let listed: Vec<String> = topics.iter().map(i64::to_string).collect();
        let is_decoded = format!("topic_id in ({})", listed.join(", "));
        // Data that is not selected is not loaded: images are passed over in the file.
        let data = format!("case when {is_decoded} and (timestamp, id) > (?1, ?2) then data end");
        self.columns = format!("id, timestamp, topic_id, {data}");
        self
    }

    /// The topics, as far as they can be read.
    pub(super) fn topics(&self) -> (Vec<WrittenTopic>, Option<String>) {
        let mut found = Vec::new();
        let mut read = || {
            let query = "select id, name, type, serialization_format from topics order by id";
            let mut query = self.connection.prepare(query)?;
            let mut rows = query.query([])?;
            while let Some(row) = rows.next()? {
                let [name, message_type, encoding] = [text(row, 1)?, text(row, 2)?, text(row, 3)?];
                found.push(WrittenTopic { id: row.get(0)?, name, message_type, encoding });
            }
            Ok(())
        };
        let fault = read().err().map(|fault: rusqlite::Error| fault.to_string());
        (found, fault)
    }

    /// Whether messages have an index by which they are read in the order of times without sorting them.
    pub(super) fn has_index(&self) -> bool {
        let plan = format!("explain query plan {}", self.query(Order::Time));
        let read = || {
            let mut plan = self.connection.prepare(&plan)?;
            let steps = plan.query_map([0, 0], |row| text(row, 3))?;
            steps.collect::<rusqlite::Result<Vec<_>>>()
        };
        read().is_ok_and(|steps| !steps.iter().any(|step| step.contains("TEMP B-TREE")))
    }

    /// The number of messages in the table, whatever the index says; `None` if it cannot be counted.
    pub(super) fn message_count(&self) -> Option<u64> {
        let query = "select count(*) from messages not indexed";
        let count: i64 = self.connection.query_row(query, [], |row| row.get(0)).ok()?;
        count.try_into().ok()
    }

    /// The next messages, of which those up to `read` have been read before: they have no data.
    pub(super) fn block(&self, order: Order, read: MessagePlace) -> MessageBlock {
        let mut block = MessageBlock::default();
        if let Err(fault) = self.fill(&mut block, order, read) {
            block.end = BlockEnd::Damaged(fault.to_string());
        }
        block
    }

    fn fill(&self, block: &mut MessageBlock, order: Order, read: MessagePlace) -> rusqlite::Result<()> {
        let mut query = self.connection.prepare(&self.query(order))?;
        let mut rows = match order {
            Order::Time => query.query([read.log_ns, read.id])?,
            Order::Written { after } => query.query([read.log_ns, read.id, after])?,
        };
        let mut bytes = 0;
        let mut before = read;
        let mut id_before = if let Order::Written { after } = order { after } else { i64::MIN };
        while let Some(row) = rows.next()? {
            let message = message(row)?;
            // Pages of a damaged tree may lead back to each other: without this, reading would not end.
            let is_behind = match order {
                Order::Time => message.place > before,
                Order::Written { .. } => message.place.id > id_before,
            };
            if !is_behind {
                block.end = BlockEnd::Damaged("its messages are not in order".to_owned());
                return Ok(());
            }
            (before, id_before) = (message.place, message.place.id);
            bytes += message.data.len();
            block.messages.push(message);
            if bytes > BLOCK_BYTES || block.messages.len() == BLOCK_MESSAGES {
                return Ok(());
            }
        }
        block.end = BlockEnd::Last;
        Ok(())
    }

    /// The number from behind which messages can be read again, if the one behind `id` cannot; `None` if none can.
    pub(super) fn behind_damage(&self, id: i64, read: MessagePlace) -> Option<i64> {
        let is_whole = |after: i64| {
            let block = self.block(Order::Written { after }, read);
            !block.messages.is_empty() || matches!(block.end, BlockEnd::Last)
        };
        // SQLite numbers messages from 1: from the smallest number on, steps would end before they are reached.
        let id = id.max(0);
        // Steps that double, then the half of the last one again and again: a page is lost, and no more.
        let (mut damaged, mut step) = (id, 1_i64);
        let mut whole = loop {
            let after = id.checked_add(step)?;
            if is_whole(after) {
                break after;
            }
            (damaged, step) = (after, step.checked_mul(2)?);
        };
        while whole - damaged > 1 {
            let middle = damaged + (whole - damaged) / 2;
            *if is_whole(middle) { &mut whole } else { &mut damaged } = middle;
        }
        Some(whole)
    }

    fn query(&self, order: Order) -> String {
        let columns = &self.columns;
        match order {
            Order::Time => format!(
                "select {columns} from messages where (timestamp, id) > (?1, ?2) order by timestamp, id"
            ),
            Order::Written { .. } => {
                format!("select {columns} from messages not indexed where id > ?3 order by id")
            }
        }
    }
}

/// Says why the database has no such table. A view or a virtual table under its name would compute its rows, without an end.
fn has_table(connection: &Connection, name: &str) -> Result<(), String> {
    let query = "select count(*) from sqlite_master where type = 'table' and name = ?1 and rootpage > 0";
    match connection.query_row(query, [name], |row| row.get::<_, i64>(0)) {
        Ok(0) => Err(format!("it has no table \"{name}\"")),
        Ok(_) => Ok(()),
        Err(fault) => Err(fault.to_string()),
    }
}

fn message(row: &Row<'_>) -> rusqlite::Result<WrittenMessage> {
    let place = MessagePlace { id: row.get(0)?, log_ns: row.get(1)? };
    Ok(WrittenMessage { place, topic: row.get(2)?, data: bytes(row.get_ref(3)?).to_vec() })
}

fn text(row: &Row<'_>, column: usize) -> rusqlite::Result<String> {
    Ok(String::from_utf8_lossy(bytes(row.get_ref(column)?)).into_owned())
}

fn bytes(value: ValueRef<'_>) -> &[u8] {
    match value {
        ValueRef::Text(bytes) | ValueRef::Blob(bytes) => bytes,
        _ => &[],
    }
}
