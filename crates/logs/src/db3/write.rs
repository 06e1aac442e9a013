//! Bags for tests, with the tables that rosbag2 writes.

use std::path::Path;

use rusqlite::{Connection, params};

use crate::mcap::write::joint_data;

/// The number of the topic of joint states, and of one whose times alone are read.
pub(super) const STATES: i64 = 1;
pub(super) const IMAGES: i64 = 7;
/// The joints of [`STATES`].
pub(super) const NAMES: [&str; 2] = ["elbow", "wrist"];

/// An empty bag with two topics.
pub(super) fn begun(path: &Path) -> Connection {
    let bag = Connection::open(path).unwrap();
    bag.execute_batch(
        "create table topics(id integer primary key, name text not null, type text not null,
            serialization_format text not null, offered_qos_profiles text not null);
         create table messages(id integer primary key, topic_id integer not null,
            timestamp integer not null, data blob not null);
         create index timestamp_idx on messages (timestamp asc);
         insert into topics values (1, '/joint_states', 'sensor_msgs/msg/JointState', 'cdr', '');
         insert into topics values (7, '/camera', 'sensor_msgs/msg/Image', 'cdr', '');",
    )
    .unwrap();
    bag
}

pub(super) fn add(bag: &Connection, topic: i64, ns: i64, data: &[u8]) {
    let insert = "insert into messages(topic_id, timestamp, data) values (?1, ?2, ?3)";
    bag.execute(insert, params![topic, ns, data]).unwrap();
}

/// A joint state that arrives at this time, with the same stamp.
pub(super) fn add_state(bag: &Connection, ns: i64) {
    add(bag, STATES, ns, &joint_data(ns, &NAMES, &[0.5, 1.5]));
}

/// A bag with a joint state each millisecond, from the first on.
pub(super) fn states(path: &Path, count: i64) -> Connection {
    let bag = begun(path);
    let all = bag.unchecked_transaction().unwrap();
    for at in 1..=count {
        add_state(&bag, at * 1_000_000);
    }
    all.commit().unwrap();
    bag
}
