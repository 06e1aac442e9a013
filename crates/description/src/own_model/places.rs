//! Places of the joints of a model on its own in the robot file.

use std::{ops::Range, sync::Arc};

use congruent_input::{SourceFile, line_column};

/// What a description without a URDF is written as.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum OwnModelForm {
    /// A Denavit-Hartenberg table, `[dh]`.
    Table,
    /// A product of exponentials, `[poe]`.
    Screws,
}

impl OwnModelForm {
    /// What it is, in words.
    pub fn words(self) -> &'static str {
        match self {
            Self::Table => "a table ([dh])",
            Self::Screws => "screws ([poe])",
        }
    }
}

/// The robot file of a description without a URDF, with the places of its joints.
#[derive(Debug, Clone, PartialEq)]
pub struct OwnModelPlaces {
    source: Arc<SourceFile>,
    form: OwnModelForm,
    joints: Vec<(String, Range<usize>)>,
}

impl OwnModelPlaces {
    pub(super) fn new(
        source: Arc<SourceFile>,
        form: OwnModelForm,
        joints: Vec<(String, Range<usize>)>,
    ) -> Self {
        Self { source, form, joints }
    }

    /// The robot file that the places are in.
    pub fn source(&self) -> &Arc<SourceFile> {
        &self.source
    }

    /// The same, to name its file in another form.
    pub(crate) fn source_mut(&mut self) -> &mut Arc<SourceFile> {
        &mut self.source
    }

    /// Whether the model is a table or screws.
    pub fn form(&self) -> OwnModelForm {
        self.form
    }

    /// Byte range of the name of a joint in its row; `None` if there is no joint of that name.
    pub fn joint(&self, name: &str) -> Option<Range<usize>> {
        self.joints.iter().find(|(known, _)| known == name).map(|(_, at)| at.clone())
    }

    /// Line of a joint's row, from 1; `None` if there is no joint of that name.
    pub fn joint_line(&self, name: &str) -> Option<usize> {
        Some(line_column(&self.source.text, self.joint(name)?.start).0)
    }
}
