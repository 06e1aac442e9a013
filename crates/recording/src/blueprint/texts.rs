//! The views beside the plots: the statuses of the checks over time, and the events in words.

use re_sdk_types::blueprint::{
    archetypes::TextLogColumns,
    components::TextLogColumn,
    datatypes::{TextLogColumn as Column, TextLogColumnKind},
};

use super::tree::{LayoutNode, View};
use crate::rrd::paths;

/// A lane for each check.
pub(super) fn statuses() -> LayoutNode {
    View::new("StateTimeline", "Checks", paths::path(&["status"])).into()
}

/// The events, without columns that are the same for all.
pub(super) fn events() -> LayoutNode {
    let column = |kind: TextLogColumnKind, is_visible: bool| {
        TextLogColumn(Column { visible: is_visible.into(), kind })
    };
    let columns = TextLogColumns::new().with_text_log_columns([
        column(TextLogColumnKind::EntityPath, false),
        column(TextLogColumnKind::LogLevel, false),
        column(TextLogColumnKind::Body, true),
    ]);
    View::new("TextLog", "Events", paths::log()).with("TextLogColumns", &columns).into()
}
