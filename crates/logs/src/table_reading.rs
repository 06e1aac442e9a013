//! What was found out about a table, as a survey says it.

use schemars::JsonSchema;
use serde::Serialize;

/// How a table was read: what was guessed from its beginning.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct TableReading {
    /// How a text is written; nothing of a Parquet.
    #[serde(flatten)]
    pub text: Option<TableText>,
    /// Whether its columns have names.
    pub has_header: bool,
    /// Where the times of the rows come from.
    pub time: TableTime,
    /// The known program whose columns it has; `None` if columns were recognised one by one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub preset: Option<Preset>,
    /// Columns that are read.
    pub columns: Vec<TableColumn>,
    /// Names of the columns that are not.
    pub unused: Vec<String>,
    /// The episodes of a Parquet with a column `episode_index`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub episodes: Option<TableEpisodes>,
}

/// The episodes of a dataset: the values of its column `episode_index`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
pub struct TableEpisodes {
    /// How many there are.
    pub count: u64,
    /// The smallest index.
    pub first: u64,
    /// The largest.
    pub last: u64,
    /// The index of the one that is read alone.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub taken: Option<u64>,
}

/// How the text of a table is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
pub struct TableText {
    /// What separates cells.
    pub separator: Separator,
    /// What separates whole numbers and fractions.
    pub decimal: DecimalMark,
    /// The encoding of its text.
    pub encoding: TableEncoding,
}

/// A column that is read.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct TableColumn {
    /// Its name in the table, or its number from 1 in one without names.
    pub name: String,
    /// The joint.
    pub joint: String,
    /// What of the joint.
    pub quantity: LoggedQuantity,
    /// The unit that its name states, such as `deg`; values are converted to rad and m.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stated_unit: Option<String>,
}

/// What a value of a joint is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum LoggedQuantity {
    /// Where it is.
    Position,
    /// How fast it moves.
    Velocity,
    /// Its torque or force, or the current of its motor.
    Effort,
}

/// What separates the cells of a table.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Separator {
    /// `,`
    Comma,
    /// `;`
    Semicolon,
    /// A tabulator.
    Tab,
    /// One or several blanks.
    Blanks,
}

/// What separates the whole number and the fraction of a number.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum DecimalMark {
    /// `0.5`
    Point,
    /// `0,5`
    Comma,
}

/// How the text of a table is encoded.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum TableEncoding {
    /// UTF-8, or ASCII.
    #[serde(rename = "utf_8")]
    Utf8,
    /// ISO 8859-1: every byte is a character.
    #[serde(rename = "latin_1")]
    Latin1,
}

/// A program that writes tables with known columns.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Preset {
    /// The client library of Universal Robots: `actual_q_0`, `actual_TCP_pose_0`.
    UrRtde,
}

/// Where the times of rows come from.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum TableTime {
    /// A column.
    Column {
        /// Its name, or its number from 1 in a table without names.
        name: String,
        /// Its unit.
        unit: TimeUnit,
        /// How the unit is known.
        unit_from: TimeUnitFrom,
    },
    /// The rate that was given, Hz.
    RateHz(f64),
}

/// A unit of time.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
pub enum TimeUnit {
    /// Seconds.
    #[serde(rename = "s")]
    Second,
    /// Milliseconds.
    #[serde(rename = "ms")]
    Millisecond,
    /// Microseconds.
    #[serde(rename = "us")]
    Microsecond,
    /// Nanoseconds.
    #[serde(rename = "ns")]
    Nanosecond,
}

/// How the unit of a column of times is known.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum TimeUnitFrom {
    /// Its name states it.
    Name,
    /// Its values are times since 1970 in this unit alone.
    Values,
    /// Its steps are those of a recorder, 2 Hz or more, in this unit.
    Steps,
}
