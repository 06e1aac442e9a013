//! Whole, cut and damaged bags, made by SQLite itself.

use std::{fs, path::Path};

use congruent_input::{Diagnostic, codes::file};

use super::super::write::{IMAGES, STATES, add, add_state, begun, states};
use crate::{
    LogEvent, LogFormat, LogGap, LogOptions, codes,
    event::{LoggedJoints, TopicContent},
    mutation_tests::{Numbers, mutated},
    open_log,
};

/// Bytes of a page, unless a database says otherwise.
const PAGE_BYTES: usize = 4096;

fn read(path: &Path) -> Result<Vec<LogEvent>, Diagnostic> {
    let mut reader = open_log(path, &LogOptions::default())?;
    let mut events = Vec::new();
    while let Some(event) = reader.next_event()? {
        events.push(event);
    }
    Ok(events)
}

fn joints(events: &[LogEvent]) -> Vec<&LoggedJoints> {
    events
        .iter()
        .filter_map(|event| if let LogEvent::Joints(joints) = event { Some(joints) } else { None })
        .collect()
}

/// Times of arrival of the joint states, ms.
fn times_ms(events: &[LogEvent]) -> Vec<i64> {
    joints(events).iter().map(|joints| joints.time.log_ns / 1_000_000).collect()
}

fn gaps(events: &[LogEvent]) -> Vec<&LogGap> {
    events.iter().filter_map(|event| if let LogEvent::Gap(gap) = event { Some(gap) } else { None }).collect()
}

/// A bag in a folder of its own, as bytes that a test changes.
struct Changed {
    folder: tempfile::TempDir,
    bytes: Vec<u8>,
}

impl Changed {
    fn new(count: i64) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("bag.db3");
        drop(states(&path, count));
        let bytes = fs::read(&path).unwrap();
        Self { folder, bytes }
    }

    fn read(&self) -> Result<Vec<LogEvent>, Diagnostic> {
        let path = self.folder.path().join("bag.db3");
        fs::write(&path, &self.bytes).unwrap();
        read(&path)
    }

    /// The pages whose first byte is this: 13 is a leaf of a table, 10 one of an index.
    fn pages(&self, kind: u8) -> Vec<usize> {
        (1..self.bytes.len() / PAGE_BYTES).filter(|page| self.bytes[page * PAGE_BYTES] == kind).collect()
    }

    fn damage(&mut self, page: usize) {
        self.bytes[page * PAGE_BYTES..][..PAGE_BYTES].fill(0xaa);
    }
}

#[test]
fn messages_come_in_the_order_of_their_times() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("bag with blank, 100 % and ü.db3");
    let bag = begun(&path);
    add_state(&bag, 3_000_000);
    add(&bag, IMAGES, 2_000_000, &vec![7; 50_000]);
    add_state(&bag, 1_000_000);
    add_state(&bag, 3_000_000);
    drop(bag);
    let mut reader = open_log(&path, &LogOptions::default()).unwrap();
    assert_eq!(reader.format(), LogFormat::Db3);
    let events: Vec<LogEvent> = std::iter::from_fn(|| reader.next_event().unwrap()).collect();
    assert_eq!(times_ms(&events), [1, 3, 3]);
    assert!(matches!(&events[1], LogEvent::Other(image) if image.topic == 1 && image.fault.is_none()));
    let first = joints(&events)[0];
    assert_eq!((first.time.stamp_ns, &first.position[..]), (Some(1_000_000), &[0.5, 1.5][..]));
    assert_eq!(reader.topics()[1].content, TopicContent::TimesAlone);
    // Nothing was written beside it.
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
}

#[test]
fn long_bags_are_read_in_blocks() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("bag.db3");
    drop(states(&path, 20_000));
    let events = read(&path).unwrap();
    assert_eq!(times_ms(&events), (1..=20_000).collect::<Vec<_>>());
    assert!(gaps(&events).is_empty());
}

#[test]
fn the_databases_of_a_folder_are_one_log() {
    let folder = tempfile::tempdir().unwrap();
    for (name, ns) in [("bag_10.db3", 3_000_000), ("bag_2.db3", 2_000_000), ("bag_0.db3", 1_000_000)] {
        add_state(&begun(&folder.path().join(name)), ns);
    }
    fs::write(folder.path().join("bag_11.db3"), "").unwrap();
    fs::write(folder.path().join("bag_12.db3.zstd"), "").unwrap();
    let events = read(folder.path()).unwrap();
    assert_eq!((times_ms(&events), gaps(&events).len()), (vec![1, 2, 3], 2));
    assert!(joints(&events).iter().all(|joints| joints.topic == 0));
}

#[test]
fn a_bag_without_an_index_is_read_as_it_was_written() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("bag.db3");
    let bag = begun(&path);
    bag.execute_batch("drop index timestamp_idx").unwrap();
    for ns in [3_000_000, 1_000_000, 2_000_000] {
        add_state(&bag, ns);
    }
    drop(bag);
    let events = read(&path).unwrap();
    assert_eq!((times_ms(&events), gaps(&events).len()), (vec![3, 1, 2], 0));
}

#[test]
fn messages_that_are_still_in_the_log_of_sqlite_are_read() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("bag.db3");
    let bag = begun(&path);
    bag.pragma_update(None, "journal_mode", "wal").unwrap();
    add_state(&bag, 1_000_000);
    // The recorder still has it open.
    assert!(folder.path().join("bag.db3-wal").metadata().unwrap().len() > 0);
    assert_eq!(times_ms(&read(&path).unwrap()), [1]);
    drop(bag);
    assert_eq!(times_ms(&read(&path).unwrap()), [1]);
}

#[test]
fn a_change_that_did_not_end_is_taken_back_by_the_user() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("bag.db3");
    let bag = states(&path, 3000);
    // A transaction that is longer than the memory of SQLite goes into the database, and what it replaces into the journal.
    bag.execute_batch("pragma cache_size = 5; begin; update messages set timestamp = timestamp + 1").unwrap();
    let copy = folder.path().join("copy.db3");
    fs::copy(&path, &copy).unwrap();
    fs::copy(folder.path().join("bag.db3-journal"), folder.path().join("copy.db3-journal")).unwrap();
    let refused = read(&copy).unwrap_err();
    assert_eq!(refused.code, codes::log::DATABASE);
    assert!(refused.help.unwrap().contains("-journal too"), "{}", refused.message);
}

#[test]
fn a_damaged_page_costs_its_own_messages_alone() {
    let mut bag = Changed::new(3000);
    let pages = bag.pages(13);
    bag.damage(pages[pages.len() / 2]);
    let events = bag.read().unwrap();
    let [gap] = gaps(&events)[..] else { panic!("{:?}", gaps(&events)) };
    assert_eq!(gap.cause.code, codes::log::DAMAGED);
    let times_ms = times_ms(&events);
    let lost: Vec<i64> = (1..=3000).filter(|at| !times_ms.contains(at)).collect();
    // A message takes some 90 bytes of a page.
    assert!((40..=50).contains(&lost.len()), "{lost:?}");
    let [first, last] = [lost[0], *lost.last().unwrap()];
    assert_eq!(usize::try_from(last - first + 1).unwrap(), lost.len());
    assert!(gap.cause.message.starts_with(&format!("messages {first} to {last} ")), "{gap:?}");
    // From the message before it to the one behind it; seconds count from the first one.
    let [from_s, to_s] = gap.between_s.unwrap();
    let expected = [first - 2, last].map(|ms| f64::from(i32::try_from(ms).unwrap()) / 1e3);
    assert!((from_s - expected[0]).abs() < 1e-9 && (to_s - expected[1]).abs() < 1e-9, "{gap:?}");
}

#[test]
fn a_damaged_first_page_costs_its_own_messages_alone() {
    let mut bag = Changed::new(3000);
    // The first leaf is that of the topics.
    let first = bag.pages(13).into_iter().find(|page| bag.bytes[page * PAGE_BYTES + 4] > 2).unwrap();
    bag.damage(first);
    let events = bag.read().unwrap();
    let [gap] = gaps(&events)[..] else { panic!("{:?}", gaps(&events)) };
    assert!(gap.cause.message.starts_with("messages up to number "), "{gap:?}");
    let times_ms = times_ms(&events);
    assert!((2950..2960).contains(&times_ms.len()) && times_ms[0] > 1, "{}", times_ms.len());
}

#[test]
fn a_damaged_index_costs_no_message() {
    let mut bag = Changed::new(3000);
    let pages = bag.pages(10);
    bag.damage(pages[pages.len() / 2]);
    let events = bag.read().unwrap();
    assert_eq!(times_ms(&events), (1..=3000).collect::<Vec<_>>());
    let [gap] = gaps(&events)[..] else { panic!("{:?}", gaps(&events)) };
    assert!(gap.cause.message.contains("the index of times cannot be read"), "{gap:?}");
}

#[test]
fn messages_that_the_index_lacks_are_counted() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("bag.db3");
    let bag = states(&path, 100);
    bag.execute_batch(
        "drop index timestamp_idx;
         create index timestamp_idx on messages (timestamp asc) where id <= 60;
         pragma writable_schema = on;
         update sqlite_master set sql = 'create index timestamp_idx on messages (timestamp asc)'
             where name = 'timestamp_idx'",
    )
    .unwrap();
    drop(bag);
    let events = read(&path).unwrap();
    assert_eq!(times_ms(&events).len(), 60);
    let [gap] = gaps(&events)[..] else { panic!("{:?}", gaps(&events)) };
    assert!(gap.cause.message.starts_with("40 messages are left out"), "{gap:?}");
}

#[test]
fn of_a_cut_file_the_whole_pages_are_read() {
    let mut bag = Changed::new(3000);
    bag.bytes.truncate(bag.bytes.len() * 2 / 3 / PAGE_BYTES * PAGE_BYTES);
    let events = bag.read().unwrap();
    let times_ms = times_ms(&events);
    assert!(times_ms.len() > 1500 && times_ms.is_sorted(), "{}", times_ms.len());
    assert!(gaps(&events).iter().all(|gap| gap.cause.code == codes::log::DAMAGED));
    let last = gaps(&events).last().unwrap().cause.message.clone();
    assert!(last.starts_with("no message behind ") && last.contains(" can be read: "), "{last}");
}

#[test]
fn messages_of_a_topic_that_is_not_declared_are_reported_once() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("bag.db3");
    let bag = states(&path, 3);
    bag.execute("delete from topics where id = ?1", [STATES]).unwrap();
    drop(bag);
    let events = read(&path).unwrap();
    assert_eq!((events.len(), gaps(&events).len()), (1, 1));
}

#[test]
fn messages_that_are_compressed_one_by_one_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("bag.db3");
    add(&begun(&path), STATES, 5, &[0x28, 0xb5, 0x2f, 0xfd, 0, 0]);
    assert_eq!(read(&path).unwrap_err().code, codes::log::COMPRESSED_MESSAGES);
}

#[test]
fn what_is_no_bag_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("bag.db3");
    for (text, code) in [("", file::EMPTY), ("some text, longer than the first bytes", codes::log::DATABASE)]
    {
        fs::write(&path, text).unwrap();
        assert_eq!(read(&path).unwrap_err().code, code, "{text}");
    }
    // Rows of a view are computed: these would never end.
    let endless = "create view messages as with recursive n(id) as (select 1 union all select id + 1 from n)
        select id, 1 as topic_id, id as timestamp, x'' as data from n";
    for (change, fault) in [
        ("drop table messages".to_owned(), "no table \"messages\""),
        ("alter table messages drop column data".to_owned(), "no such column: data"),
        (format!("drop table messages; {endless}"), "no table \"messages\""),
    ] {
        fs::remove_file(&path).unwrap();
        begun(&path).execute_batch(&change).unwrap();
        let refused = read(&path).unwrap_err();
        assert_eq!(refused.code, codes::log::DATABASE);
        assert!(refused.message.contains(fault), "{refused}");
    }
}

#[test]
fn changed_bags_are_read_or_refused() {
    let whole = Changed::new(600);
    let mut numbers = Numbers(0x9e37_79b9_7f4a_7c15);
    let mut read = 0;
    for _ in 0..600 {
        let bytes = mutated(&whole.bytes, &mut numbers);
        let changed = Changed { folder: tempfile::tempdir().unwrap(), bytes };
        read += usize::from(changed.read().is_ok());
    }
    assert!(read > 200, "{read}");
}
