//! RTDE of a controller that this test plays: the stream, a lost connection, a variable that it does not know.

use std::{
    io::{Read, Write},
    net::{TcpListener, TcpStream},
    thread,
    time::Duration,
};

use super::{of_kind, swing};
use crate::support::{command::allowing, live::Live, scratch_folder::ScratchFolder};

/// Types of packages that only commands of a robot have: inputs.
const SETUP_INPUTS: u8 = b'I';

/// A controller with one connection.
struct Controller {
    stream: TcpStream,
    /// Types of the packages that it was sent.
    asked: Vec<u8>,
}

impl Controller {
    /// Waits for a connection and answers its questions; the outputs have these types.
    fn accept(listener: &TcpListener, types: &str) -> Self {
        let (stream, _) = listener.accept().unwrap();
        let mut controller = Self { stream, asked: Vec::new() };
        loop {
            let (kind, payload) = controller.receive();
            match kind {
                b'V' => {
                    assert_eq!(payload, [0, 2]);
                    // A text of the controller before the answer is of no interest.
                    controller.send(b'M', b"\x02hi\x01c\x01");
                    controller.send(b'V', &[1]);
                }
                b'O' => {
                    assert_eq!(payload[..8], 500_f64.to_be_bytes());
                    assert_eq!(&payload[8..], b"timestamp,actual_q,actual_qd,actual_current,actual_TCP_pose");
                    controller.send(b'O', &[&[7], types.as_bytes()].concat());
                }
                b'S' => {
                    controller.send(b'S', &[1]);
                    return controller;
                }
                other => panic!("package of type {other}"),
            }
        }
    }

    fn receive(&mut self) -> (u8, Vec<u8>) {
        let mut head = [0; 3];
        self.stream.read_exact(&mut head).unwrap();
        let mut payload = vec![0; usize::from(u16::from_be_bytes([head[0], head[1]])) - 3];
        self.stream.read_exact(&mut payload).unwrap();
        self.asked.push(head[2]);
        (head[2], payload)
    }

    fn send(&mut self, kind: u8, payload: &[u8]) {
        let length = u16::try_from(payload.len() + 3).unwrap().to_be_bytes();
        let package = [&length[..], &[kind], payload].concat();
        // In two parts, as a network may bring it.
        let (first, second) = package.split_at(package.len() / 2);
        self.stream.write_all(first).unwrap();
        self.stream.write_all(second).unwrap();
    }

    /// Sends states of the swing, at their own pace.
    fn stream(&mut self, numbers: std::ops::Range<u32>) {
        for number in numbers {
            let time_s = 100.0 + f64::from(number) / 500.0;
            let q = swing(time_s);
            let numbers = [time_s].into_iter().chain(q).chain([0.0; 18]);
            let bytes: Vec<u8> = numbers.flat_map(f64::to_be_bytes).collect();
            self.send(b'U', &[&[7], &bytes[..]].concat());
        }
    }
}

const TYPES: &str = "DOUBLE,VECTOR6D,VECTOR6D,VECTOR6D,VECTOR6D";

#[test]
fn a_lost_connection_is_opened_again_and_its_time_is_a_gap() {
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let address = listener.local_addr().unwrap().to_string();
    let robot = thread::spawn(move || {
        let mut first = Controller::accept(&listener, TYPES);
        first.stream(0..300);
        // Half a package, then the network is gone.
        first.stream.write_all(&[0, 204, b'U', 7]).unwrap();
        drop(first);
        let mut second = Controller::accept(&listener, TYPES);
        second.stream(800..1000);
        // The elbow beyond its range ends the run; the client says pause before it goes.
        let mut q = swing(102.0);
        q[2] = 4.0;
        let numbers = [102.0].into_iter().chain(q).chain([0.0; 18]);
        let bytes: Vec<u8> = numbers.flat_map(f64::to_be_bytes).collect();
        second.send(b'U', &[&[7], &bytes[..]].concat());
        thread::sleep(Duration::from_millis(100));
        second.asked
    });
    // The pose of this controller is nonsense.
    let folder = ScratchFolder::new();
    let limits_alone = folder.write(
        "limits.toml",
        "schema_version = 1\nname = \"limits\"\nrobot = \"ur5e\"\n[source]\nlog = \"stream\"\n[[check]]\nkind = \"limits\"\n",
    );
    let mut live = Live::begin(&[
        "watch",
        "robots/ur5e",
        "--rtde",
        &address,
        "--rate-hz",
        "500",
        "--until-violation",
        "--scenario",
        &limits_alone,
        "--format",
        "json",
    ]);
    let mut documents = Vec::new();
    while documents.last().is_none_or(|last: &serde_json::Value| last["kind"] != "finished") {
        documents.push(live.next());
    }
    let kinds: Vec<&str> = documents.iter().map(|document| document["kind"].as_str().unwrap()).collect();
    assert_eq!(
        kinds,
        ["started", "lost", "connected_again", "gap", "violation", "finished"],
        "{documents:?}"
    );
    let [gap] = of_kind(&documents, "gap")[..] else { panic!("{documents:?}") };
    assert_eq!((&gap["from_s"], &gap["to_s"]), (&100.598.into(), &101.6.into()), "{gap}");
    let finished = documents.last().unwrap();
    assert_eq!(finished["counts"]["samples"], 501, "{finished}");
    assert_eq!(finished["counts"]["lost_connections"], 1, "{finished}");
    assert_eq!(live.code(), 1);
    let asked = robot.join().unwrap();
    assert!(!asked.contains(&SETUP_INPUTS) && asked == [b'V', b'O', b'S'], "{asked:?}");
}

#[test]
#[cfg(unix)]
fn a_robot_that_does_not_come_back_has_lost_what_was_to_come() {
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let address = listener.local_addr().unwrap().to_string();
    let robot = thread::spawn(move || Controller::accept(&listener, TYPES).stream(0..300));
    let mut live =
        Live::begin(&["watch", "robots/ur5e", "--rtde", &address, "--rate-hz", "500", "--format", "json"]);
    robot.join().unwrap();
    while live.next()["kind"] != "lost" {}
    thread::sleep(Duration::from_millis(500));
    live.signal("INT");
    let mut finished = live.next();
    while finished["kind"] != "finished" {
        finished = live.next();
    }
    let checks = finished["report"]["checks"].as_array().unwrap();
    let recording = checks.iter().find(|check| check["check"] == "recording").unwrap();
    assert_eq!(recording["status"], "fail", "{recording}");
    // 300 of 550 and more.
    assert!(recording["measures"][0]["worst"]["value"].as_f64().unwrap() < 0.55, "{recording}");
    assert_eq!(live.code(), 1);
}

#[test]
fn an_output_that_the_controller_does_not_know_is_named() {
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let address = listener.local_addr().unwrap().to_string();
    let robot = thread::spawn(move || {
        let (stream, _) = listener.accept().unwrap();
        let mut controller = Controller { stream, asked: Vec::new() };
        controller.receive();
        controller.send(b'V', &[1]);
        controller.receive();
        controller.send(b'O', b"\x07DOUBLE,VECTOR6D,VECTOR6D,NOT_FOUND,VECTOR6D");
    });
    let output = allowing(&["watch", "robots/ur5e", "--rtde", &address]).output().unwrap();
    let shown = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2), "{shown}");
    assert!(shown.contains("actual_current is NOT_FOUND"), "{shown}");
    robot.join().unwrap();
}

#[test]
fn a_robot_that_cannot_be_reached_is_said_at_once() {
    let address = TcpListener::bind("127.0.0.1:0").unwrap().local_addr().unwrap().to_string();
    let output = allowing(&["watch", "robots/ur5e", "--rtde", &address]).output().unwrap();
    let shown = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.code() == Some(2) && shown.contains("no data by RTDE"), "{shown}");
}
