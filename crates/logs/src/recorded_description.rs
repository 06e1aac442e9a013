//! The description of the robot that a log has beside its joint states.

use std::{path::Path, sync::Arc};

use congruent_input::{Diagnostic, SourceFile};

use crate::{
    codes,
    descriptions::{Descriptions, LastDescription},
    event::LogEvent,
    open::open_log,
    options::LogOptions,
};

/// A description that was recorded.
#[derive(Debug, Clone)]
pub struct RecordedDescription {
    /// The text, named `LOG:robot_description`.
    pub source: Arc<SourceFile>,
    /// What of the log cannot be read, and whether the description changed.
    pub warnings: Vec<Diagnostic>,
}

/// The description that a log has; the last one, if it was published again.
///
/// # Errors
/// The log cannot be read, has no description, or different ones on several topics.
pub fn recorded_description(path: &Path) -> Result<RecordedDescription, Diagnostic> {
    let mut reader = open_log(path, &LogOptions::default())?;
    let (mut warnings, mut descriptions) = (Vec::new(), Descriptions::default());
    while let Some(event) = reader.next_event()? {
        match event {
            LogEvent::Description(found) => descriptions.take(found),
            LogEvent::Gap(gap) => warnings.push(gap.cause),
            _ => {}
        }
    }
    let name = |of: &LastDescription| reader.topics()[of.description.topic].name.clone();
    let all = descriptions.all();
    let Some(found) = all.first() else { return Err(no_description(path, warnings.first())) };
    if let Some(other) = all.iter().find(|of| of.description.text != found.description.text) {
        return Err(several(path, [name(found), name(other)]));
    }
    // Beside the log, where paths of meshes are looked for: a name with the slashes of the topic would be in another folder.
    let topic = name(found);
    let named = format!("{}:{}", path.display(), topic.rsplit('/').next().unwrap_or(&topic));
    let source = SourceFile { path: named.into(), text: found.description.text.clone(), is_foreign: false };
    let source = Arc::new(source);
    let changes: u64 = all.iter().map(|of| of.changes).sum();
    if changes > 0 {
        let times = if changes == 1 { "once".to_owned() } else { format!("{changes} times") };
        let message = format!("the description changes {times} in the log");
        let help = "the last one is compared: cut the log where it changes to compare the others";
        let found = Diagnostic::warning(codes::log::DESCRIPTIONS, message);
        warnings.push(found.with_help(help).in_file(&source));
    }
    Ok(RecordedDescription { source, warnings })
}

/// `damage` is the first part of the log that cannot be read: the description may have been there.
fn no_description(path: &Path, damage: Option<&Diagnostic>) -> Diagnostic {
    let damage =
        damage.map_or_else(String::new, |damage| format!(" in what can be read of it: {}", damage.message));
    let message = format!("{} has no robot_description{damage}", path.display());
    Diagnostic::error(codes::log::NO_DESCRIPTION, message).with_help(
        "record it with the joint states: `ros2 bag record -s mcap /joint_states /robot_description`; \
         `congruent describe LOG` lists the topics of a log",
    )
}

fn several(path: &Path, [first, second]: [String; 2]) -> Diagnostic {
    let message = format!("{} has different descriptions on {first} and {second}", path.display());
    Diagnostic::error(codes::log::DESCRIPTIONS, message)
        .with_help("keep the topic of one robot: `ros2 bag convert` with `topics: [...]` in its options")
}

#[cfg(test)]
mod tests {
    use std::io::Write;

    use super::*;
    use crate::{
        cdr::write::{ByteOrder, CdrText},
        mcap::write::{begun, end, message, topic},
    };

    const TEXT: &str = "std_msgs/msg/String";

    fn published(number: u16, text: &str) -> Vec<u8> {
        let mut data = CdrText::new(ByteOrder::Little);
        data.text(text);
        message(number, 1, &data.bytes)
    }

    fn recorded(parts: &[Vec<u8>]) -> Result<RecordedDescription, Diagnostic> {
        let mut file = tempfile::NamedTempFile::with_suffix(".mcap").unwrap();
        file.write_all(&[begun(), parts.concat(), end()].concat()).unwrap();
        recorded_description(file.path())
    }

    #[test]
    fn the_last_description_counts_and_a_change_is_said() {
        let topic = topic(1, "/robot_description", TEXT, "cdr");
        let once = recorded(&[topic.clone(), published(1, "<robot name='a'/>")]).unwrap();
        assert!(once.source.path.to_string_lossy().ends_with(".mcap:robot_description"));
        assert_eq!((&*once.source.text, once.warnings.len()), ("<robot name='a'/>", 0));
        let texts = ["<robot name='a'/>", "<robot name='b'/>"].map(|text| published(1, text));
        let changed = recorded(&[topic, texts.concat()]).unwrap();
        assert_eq!(&*changed.source.text, "<robot name='b'/>");
        assert!(changed.warnings[0].message.contains("changes once"), "{}", changed.warnings[0].message);
    }

    #[test]
    fn a_log_with_no_description_or_with_two_is_refused() {
        let refused =
            recorded(&[topic(1, "/joint_states", "sensor_msgs/msg/JointState", "cdr")]).unwrap_err();
        assert_eq!(refused.code, codes::log::NO_DESCRIPTION);
        let names = ["/left/robot_description", "/right/robot_description"];
        let topics = [topic(1, names[0], TEXT, "cdr"), topic(2, names[1], TEXT, "cdr")].concat();
        let texts = |second| [published(1, "<robot name='a'/>"), published(2, second)].concat();
        assert!(recorded(&[topics.clone(), texts("<robot name='a'/>")]).is_ok());
        let mut cut = tempfile::NamedTempFile::with_suffix(".mcap").unwrap();
        cut.write_all(&[begun(), topics.clone()].concat()).unwrap();
        let refused = recorded_description(cut.path()).unwrap_err();
        assert!(refused.message.contains("in what can be read of it"), "{}", refused.message);
        let refused = recorded(&[topics, texts("<robot name='b'/>")]).unwrap_err();
        assert!(names.iter().all(|name| refused.message.contains(name)), "{}", refused.message);
    }
}
