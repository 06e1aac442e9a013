//! Entries that come one by one on standard input, one in each line: each is answered before the next is read.

use std::path::Path;

use congruent_description::Robot;
use congruent_input::{Diagnostic, TextLines};
use congruent_tables::{JsonList, is_entry};
use serde::de::DeserializeOwned;

use crate::{
    beyond_limits::{outside_limits, outside_limits_warning},
    read::{LIST, MOST_BYTES},
    states::JointState,
    written::WrittenConfiguration,
};

/// A list, as its first line shows.
pub enum LiveInput<Lines> {
    /// One entry in each line (JSON Lines), for as long as they come.
    Lines(Lines),
    /// Anything else, to be read as a whole: an array.
    Whole(Box<TextLines>),
}

/// One entry in each line.
pub struct LiveEntries {
    list: JsonList,
    lines: TextLines,
    number: usize,
}

impl LiveEntries {
    /// Opens what a person names, and waits for its first line. A line has at most `most_bytes`, and so has a list that is read as
    /// a whole.
    ///
    /// # Errors
    /// It cannot be read, or is empty or no text.
    pub fn open(list: JsonList, path: &Path, most_bytes: u64) -> Result<LiveInput<Self>, Diagnostic> {
        let mut lines = TextLines::open(path, most_bytes)?.of_any_length();
        let is_live = lines.advance()? && is_entry(lines.line());
        lines.put_back();
        Ok(if is_live {
            LiveInput::Lines(Self { list, lines, number: 0 })
        } else {
            LiveInput::Whole(Box::new(lines))
        })
    }

    /// The next entry, of which `check` makes a value, with its number from 1; waits for its line. `None` at the end.
    ///
    /// # Errors
    /// The line is no entry, or `check` refuses it.
    pub fn next_entry<Written: DeserializeOwned, T>(
        &mut self,
        check: impl FnOnce(Written) -> Result<T, Diagnostic>,
    ) -> Result<Option<(usize, T)>, Diagnostic> {
        if !self.lines.advance()? {
            return Ok(None);
        }
        self.number += 1;
        let read = self.list.read_line(&mut self.lines, self.number, check)?;
        Ok(Some((self.number, read)))
    }
}

/// A state that came alone.
#[derive(Debug, Clone, PartialEq)]
pub struct LiveState {
    /// Its number from 1.
    pub number: usize,
    /// The state.
    pub state: JointState,
    /// A warning of positions outside the joint limits.
    pub warning: Option<Diagnostic>,
}

/// States of a robot that come one by one.
pub struct LiveStates(LiveEntries);

impl LiveStates {
    /// Opens what a person names, and waits for its first line.
    ///
    /// # Errors
    /// As [`LiveEntries::open`].
    pub fn open(path: &Path) -> Result<LiveInput<Self>, Diagnostic> {
        Ok(match LiveEntries::open(LIST, path, MOST_BYTES)? {
            LiveInput::Lines(entries) => LiveInput::Lines(Self(entries)),
            LiveInput::Whole(lines) => LiveInput::Whole(lines),
        })
    }

    /// The next state; waits for its line. `None` at the end.
    ///
    /// # Errors
    /// The line is no configuration of the robot.
    pub fn next_state(&mut self, robot: &Robot) -> Result<Option<LiveState>, Diagnostic> {
        let read = self.0.next_entry(|written: WrittenConfiguration| {
            Ok((written.state(robot)?, outside_limits_warning(&outside_limits(&written.q, robot))))
        })?;
        Ok(read.map(|(number, (state, warning))| LiveState { number, state, warning }))
    }
}
