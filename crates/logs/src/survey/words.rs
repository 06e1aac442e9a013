//! A survey in words: sentences, and the rows of a table of topics. How they are laid out is up to who prints them.

use congruent_input::{
    display::{counted, first_of, number, quantity},
    serde_name,
};

use super::report::{
    FramePair, JointSource, JointsSurvey, LogSurvey, PositionUnit, RobotInLog, RobotOfLog, TopicSurvey,
    TopicTimes,
};
use crate::{
    cdr::CDR,
    event::{LogFormat, TopicContent},
    table_reading::{TableEpisodes, TableReading, TableTime},
};

/// A survey in words.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SurveyWords {
    /// What it is, and how a table was read.
    pub head: Vec<String>,
    /// Name, number of messages, rate and type of each topic; empty for a table.
    pub topics: Vec<[String; 4]>,
    /// What is in the topics, what is irregular, and how it fits a robot.
    pub about: Vec<String>,
}

/// The survey in words, with at most so many names in a sentence.
pub fn survey_words(survey: &LogSurvey, most_listed: usize) -> SurveyWords {
    let mut head = vec![format!("log {}: {}", survey.file, headline(survey))];
    head.extend(survey.table.iter().map(|table| reading(table, most_listed)));
    let mut about = Vec::new();
    for topic in &survey.topics {
        let of_topic =
            [joints(topic, most_listed), irregular(topic, entry(survey)), frames(topic, most_listed)];
        about.extend(of_topic.into_iter().flatten().map(|words| format!("{}: {words}", topic.name)));
    }
    about.extend(survey.description.as_ref().map(described));
    about.extend(survey.robot.as_ref().map(of_robot));
    if survey.unreadable_parts > 0 {
        let parts = entries(survey.unreadable_parts, "part");
        about.push(format!("{parts} cannot be read, see the warnings"));
    }
    let topics = match survey.format {
        LogFormat::Mcap | LogFormat::Db3 | LogFormat::JsonLines | LogFormat::Rtde => {
            survey.topics.iter().map(topic_row).collect()
        }
        LogFormat::Table | LogFormat::Parquet | LogFormat::LeRobot => Vec::new(),
    };
    SurveyWords { head, topics, about }
}

fn topic_row(topic: &TopicSurvey) -> [String; 4] {
    let kind = match topic.encoding.as_str() {
        CDR => topic.message_type.clone(),
        other => format!("{} ({other})", topic.message_type),
    };
    [topic.name.clone(), topic.messages.to_string(), rate(topic).unwrap_or_default(), kind]
}

/// The survey in one line, for `--quiet`.
pub fn survey_line(survey: &LogSurvey) -> String {
    let mut parts = vec![headline(survey)];
    let with_joints = survey.topics.iter().filter(|topic| topic.content == TopicContent::Joints);
    parts.extend(with_joints.filter_map(|topic| {
        let joints = topic.joints.as_ref()?.joints.len();
        Some(format!(
            "{} {}{}",
            topic.name,
            counted(joints, "joint"),
            rate(topic).map_or(String::new(), |rate| format!(" at {rate}"))
        ))
    }));
    parts.extend(survey.robot.as_ref().map(of_robot));
    if !survey.warnings.is_empty() {
        parts.push(counted(survey.warnings.len(), "warning"));
    }
    parts.join("; ")
}

/// What an entry of a log is called.
fn entry(survey: &LogSurvey) -> &'static str {
    match survey.format {
        LogFormat::Mcap | LogFormat::Db3 | LogFormat::JsonLines | LogFormat::Rtde => "message",
        LogFormat::Table | LogFormat::Parquet | LogFormat::LeRobot => "row",
    }
}

fn headline(survey: &LogSurvey) -> String {
    let begun = survey.begun.as_ref().map_or(String::new(), |date| format!(" from {date}"));
    let duration = format!("{}{begun}", duration(survey.duration_s));
    let counted_entries = entries(survey.messages, entry(survey));
    let of_bag = |format: &str| {
        let topics = counted(survey.topics.len(), "topic");
        format!("{format}, {duration}, {counted_entries}, {topics}")
    };
    match survey.format {
        LogFormat::Mcap => of_bag("MCAP"),
        LogFormat::Db3 => of_bag("SQLite bag"),
        LogFormat::JsonLines => of_bag("JSON Lines"),
        LogFormat::Rtde => of_bag("RTDE"),
        LogFormat::Table => format!("table, {duration}, {counted_entries}"),
        LogFormat::Parquet => {
            let episodes = survey.table.as_ref().and_then(|table| table.episodes.as_ref());
            let episodes = episodes.map_or_else(String::new, |of| format!("{}, ", episodes_words(of)));
            format!("table in Parquet, {episodes}{duration}, {counted_entries}")
        }
        LogFormat::LeRobot => {
            let times = survey.topics.first().and_then(|topic| topic.times.as_ref());
            // Without the column each episode begins where the times go back.
            let parts = || entries(times.map_or(0, |times| times.restarts + 1), "episode");
            let episodes = survey.table.as_ref().and_then(|table| table.episodes.as_ref());
            let episodes = episodes.map_or_else(parts, episodes_words);
            format!("dataset of LeRobot, {episodes}, {counted_entries}")
        }
    }
}

/// How many episodes there are, and which one is read.
fn episodes_words(episodes: &TableEpisodes) -> String {
    let TableEpisodes { count, first, last, taken } = episodes;
    let range = if count == &1 { format!("index {first}") } else { format!("indices {first} to {last}") };
    let all = format!("{} ({range})", entries(*count, "episode"));
    taken.map_or_else(|| all.clone(), |taken| format!("episode {taken} alone of {all}"))
}

/// How a table was read.
fn reading(table: &TableReading, most: usize) -> String {
    let time = match &table.time {
        TableTime::Column { name, unit, unit_from } => {
            format!("time in \"{name}\", in {} by its {}", serde_name(unit), serde_name(unit_from))
        }
        TableTime::RateHz(rate_hz) => format!("rows at {} Hz as given", number(*rate_hz)),
    };
    let header = if table.has_header { "columns have names" } else { "columns have no names" };
    let preset = table.preset.map_or(String::new(), |preset| format!("; columns of {}", serde_name(&preset)));
    let unused = match &table.unused[..] {
        [] => String::new(),
        unused => format!("; not read: {}", first_of(unused, most)),
    };
    let text = table.text.map_or(String::new(), |text| {
        let (separator, decimal) = (serde_name(&text.separator), serde_name(&text.decimal));
        format!("separator {separator}, decimal {decimal}, ")
    });
    format!("read as: {text}{header}; {time}{preset}{unused}")
}

/// The mean rate outside of gaps.
fn rate(topic: &TopicSurvey) -> Option<String> {
    Some(format!("{} Hz", number(topic.times.as_ref()?.rate_hz?)))
}

/// A duration in s, or in ms below one.
fn duration(seconds: f64) -> String {
    if seconds.abs() < 1.0 { format!("{} ms", number(1e3 * seconds)) } else { quantity(seconds, "s") }
}

fn joints(topic: &TopicSurvey, most: usize) -> Option<String> {
    let of = topic.joints.as_ref()?;
    let names: Vec<&str> = of.joints.iter().map(|joint| joint.name.as_str()).collect();
    let kinds = [
        ("positions", of.without_positions),
        ("velocities", of.without_velocities),
        ("efforts", of.without_efforts),
    ];
    let kinds: Vec<&str> =
        kinds.iter().filter(|(_, without)| *without < of.messages).map(|(kind, _)| *kind).collect();
    let kinds = if kinds.is_empty() { "no values".to_owned() } else { kinds.join(", ") };
    Some(format!("{} with {kinds}: {}", counted(names.len(), "joint"), first_of(&names, most)))
}

/// What is irregular in a topic; `None` if nothing is.
fn irregular(topic: &TopicSurvey, entry: &str) -> Option<String> {
    let mut found = Vec::new();
    if let Some(times) = &topic.times {
        found.extend(gaps(times).filter(|_| has_period(topic.content)));
        found.extend(irregular_times(times, entry));
    }
    found.extend(topic.joints.iter().flat_map(|joints| irregular_joints(joints, entry)));
    let undecoded = topic.undecoded.as_ref().map_or(0, |undecoded| undecoded.count);
    let without_stamp = topic.times.as_ref().map_or(0, |times| times.without_stamp.saturating_sub(undecoded));
    let counts = [(without_stamp, "without a stamp"), (undecoded, "that cannot be decoded")];
    found.extend(counted_rows(&counts, entry));
    (!found.is_empty()).then(|| found.join("; "))
}

/// Whether messages are expected at a period: not those of events, and each broadcaster of TF has its own.
fn has_period(content: TopicContent) -> bool {
    matches!(content, TopicContent::Joints | TopicContent::Pose)
}

fn gaps(times: &TopicTimes) -> Option<String> {
    let gaps = times.gaps.as_ref()?;
    // From the first message of the topic on: stamps may count from another start than log times.
    let from_s = gaps.longest_from_s - times.from_s;
    let longest = format!("{} from {} on", duration(gaps.longest_s), duration(from_s));
    Some(match gaps.count {
        1 => format!("1 gap of {longest}"),
        count => format!("{count} gaps of {} together, the longest {longest}", duration(gaps.total_s)),
    })
}

fn irregular_times(times: &TopicTimes, entry: &str) -> Vec<String> {
    let mut found = Vec::new();
    if times.steps_back > 0 {
        let largest = duration(times.largest_step_back_s);
        found.push(format!(
            "{} earlier than the one before, by {largest} at most",
            entries(times.steps_back, entry)
        ));
    }
    if times.repeated_messages > 0 {
        found.push(format!("{} repeated", entries(times.repeated_messages, entry)));
    }
    if times.repeated_stamps > 0 {
        found.push(format!(
            "{} with the stamp of another and other values",
            entries(times.repeated_stamps, entry)
        ));
    }
    found
}

fn irregular_joints(joints: &JointsSurvey, entry: &str) -> Vec<String> {
    // What no message has is no irregularity; `joints` says what they have.
    let of_some = |count: u64| if count < joints.messages { count } else { 0 };
    let counts = [
        (joints.incomplete, "without a joint that others have"),
        (joints.wrong_lengths, "with arrays of another length than the names"),
        (of_some(joints.without_positions), "without positions"),
        (of_some(joints.without_velocities), "without velocities"),
        (joints.order_changes, "with other names or another order than the one before"),
    ];
    let mut found = counted_rows(&counts, entry);
    let shares = [
        ("positions", joints.missing_values.position),
        ("velocities", joints.missing_values.velocity),
        ("efforts", joints.missing_values.effort),
    ];
    let missing = shares.iter().filter(|(_, share)| *share > 0.0);
    found.extend(missing.map(|(what, share)| format!("{} of the {what} are missing", percent(*share))));
    found
}

/// Numbers of messages or rows, each with what is irregular about them.
fn counted_rows(counts: &[(u64, &str)], entry: &str) -> Vec<String> {
    let some = counts.iter().filter(|(count, _)| *count > 0);
    some.map(|(count, what)| format!("{} {what}", entries(*count, entry))).collect()
}

/// A number of messages or rows.
pub(super) fn entries(count: u64, entry: &str) -> String {
    counted(usize::try_from(count).unwrap_or(usize::MAX), entry)
}

fn percent(share: f64) -> String {
    format!("{} %", number(100.0 * share))
}

fn frames(topic: &TopicSurvey, most: usize) -> Option<String> {
    let pair = |of: &FramePair| match &of.child {
        Some(child) => format!("{child} in {}", of.frame),
        None => format!("in {}", of.frame),
    };
    let frames: Vec<String> = topic.frames.iter().map(pair).collect();
    (!frames.is_empty()).then(|| format!("poses {}", first_of(&frames, most)))
}

fn described(description: &RobotInLog) -> String {
    let RobotInLog { topic, robot, bytes, changes } = description;
    let name = robot
        .as_ref()
        .map_or("a text without the name of a robot".to_owned(), |name| format!("robot {name}"));
    let changes = match changes {
        0 => String::new(),
        changes => format!(", with {}", entries(*changes, "change")),
    };
    format!("description on {topic}: {name}, {bytes} bytes{changes}")
}

/// How the joints and units fit a robot.
fn of_robot(found: &RobotOfLog) -> String {
    let from = |source: &JointSource| {
        let other = [&source.prefix, &source.suffix, &source.prefix_of_robot];
        let words = ["prefix", "suffix", "less the prefix"];
        let other = words.iter().zip(other).filter(|(_, text)| !text.is_empty());
        let other: Vec<String> = other.map(|(what, text)| format!("{what} {text}")).collect();
        let other = if other.is_empty() { String::new() } else { format!(" ({})", other.join(", ")) };
        format!("{} on {}{other}", source.joints.len(), source.topic)
    };
    let sources: Vec<String> = found.sources.iter().map(from).collect();
    let sources = if sources.is_empty() {
        "no joint in the log".to_owned()
    } else {
        format!("joints: {}", sources.join(", "))
    };
    let missing = match found.missing.len() {
        0 => String::new(),
        count => format!(", {count} not in the log"),
    };
    let unit = match found.position_unit {
        PositionUnit::Radian => "positions lie within the limits as rad",
        PositionUnit::Degree => "positions are degrees",
        PositionUnit::Neither => "positions lie beyond the limits, as rad and as degrees",
        PositionUnit::Unknown => "no position to compare with limits",
    };
    // What most joints do may hide one.
    let beyond = match found.joints_beyond_limits().count() {
        count if count > 0 && found.position_unit != PositionUnit::Neither => {
            format!(", except of {}", counted(count, "joint"))
        }
        _ => String::new(),
    };
    format!("robot {}: {sources}{missing}; {unit}{beyond}", found.robot)
}

#[cfg(test)]
#[path = "words_tests.rs"]
mod tests;
