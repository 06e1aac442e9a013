//! The survey of a log as text for people.

use congruent_logs::{LogSurvey, SurveyWords, survey_words};

use super::{
    TextOptions,
    layout::{Table, paragraph},
};

/// What `congruent describe` prints of a log: its topics with their rates, what is irregular, and how it fits a robot.
pub fn log_text(survey: &LogSurvey, options: &TextOptions) -> String {
    /// Most names in a sentence; --verbose lists all.
    const MOST_LISTED: usize = 12;
    let most = if options.is_in_full { usize::MAX } else { MOST_LISTED };
    let SurveyWords { head, topics, about } = survey_words(survey, most);
    let mut text: String = head.iter().map(|words| paragraph(words, 2, 4)).collect();
    if !topics.is_empty() {
        let mut table = Table::headed(["topic", "messages", "rate", "type"]);
        for row in topics {
            table.row(row);
        }
        text.push('\n');
        table.write(&mut text, options.columns);
        text.push('\n');
    }
    text.extend(about.iter().map(|words| paragraph(words, 2, 4)));
    text
}
