//! Places of parameters in a file, and the edits that change them: the same questions to a URDF, an MJCF and a robot file.

use std::{
    fmt::{self, Debug},
    ops::Range,
    sync::Arc,
};

use congruent_input::{ChangedLines, SourceFile, TextEdit, changed_lines, line_column};
use congruent_robot::{Inertia, JointResistance};
use nalgebra::Vector3;

/// Where a parameter is written.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ParameterPlace {
    /// The file, which may be one that the file of the robot includes.
    pub source: Arc<SourceFile>,
    /// Byte range in its text.
    pub span: Range<usize>,
    /// The class of defaults that states it, if a change there changes other elements, too.
    pub class: Option<String>,
}

impl ParameterPlace {
    /// The line, from 1.
    pub fn line(&self) -> usize {
        line_column(&self.source.text, self.span.start).0
    }

    /// The line if the place is in this file.
    pub fn line_in(&self, file: &SourceFile) -> Option<usize> {
        (self.source.path == file.path).then(|| self.line())
    }

    /// What a line of this file does not say: `None` if the element itself writes the value there.
    pub fn elsewhere(&self, file: &SourceFile) -> Option<PlaceElsewhere> {
        let other_file = (self.source.path != file.path).then(|| self.source.path.display().to_string());
        let is_elsewhere = other_file.is_some() || self.class.is_some();
        is_elsewhere.then(|| PlaceElsewhere {
            file: other_file,
            line: self.line(),
            class: self.class.clone(),
        })
    }
}

/// File and line, as `arm.urdf:12`.
impl fmt::Display for ParameterPlace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let elsewhere = PlaceElsewhere { file: None, line: self.line(), class: self.class.clone() };
        f.write_str(&elsewhere.in_words(&self.source.path.display().to_string()))
    }
}

/// Where a value is written if that is not the element itself in the file of the robot: an included file, or a class of defaults.
#[derive(Debug, Clone, PartialEq, Eq, serde::Serialize, schemars::JsonSchema)]
pub struct PlaceElsewhere {
    /// Path of the included file; left out if it is the file of the robot.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub file: Option<String>,
    /// The line there.
    pub line: usize,
    /// The class of defaults that states the value, if a change there changes other elements, too.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub class: Option<String>,
}

impl PlaceElsewhere {
    /// `arm.xml:45 (class "visual")`, of a robot of this file.
    pub fn in_words(&self, file: &str) -> String {
        let place = format!("{}:{}", self.file.as_deref().unwrap_or(file), self.line);
        match &self.class {
            Some(class) => format!("{place} (class \"{class}\")"),
            None => place,
        }
    }
}

/// A part of a joint that has its own place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum JointElement {
    /// Its pose in the link before it.
    Origin,
    /// Its axis.
    Axis,
    /// The joint that it follows.
    Mimic,
}

/// A file with parameters of links, joints or gravity that can be located and edited.
pub trait ParameterPlaces: Debug {
    /// The file with its text.
    fn source(&self) -> &Arc<SourceFile>;

    /// Place of a parameter, such as `mass` or `com_x`; `of` is the link or joint, empty for gravity.
    fn parameter(&self, of: &str, parameter: &str) -> Option<ParameterPlace>;

    /// Place of a part of a joint, or of the element that would have it; `None` if the file has no such joint.
    fn joint_part(&self, _joint: &str, _part: JointElement) -> Option<ParameterPlace> {
        None
    }

    /// Whether the file has an entry for damping and dry friction of a joint: if not, their zeros are no statement.
    fn states_joint_terms(&self, _joint: &str) -> bool {
        true
    }

    /// Whether the file writes damping or dry friction of a joint; it may state them without that, by a default of its format.
    fn writes_joint_terms(&self, joint: &str) -> bool {
        self.states_joint_terms(joint)
    }

    /// The edits that give a link this inertia; `None` if its element in the file cannot.
    fn set_inertial(&self, link: &str, inertia: &Inertia) -> Option<Vec<TextEdit>>;

    /// The edits that give a joint these terms; `None` if its element in the file cannot.
    fn set_terms(&self, joint: &str, terms: &JointResistance) -> Option<Vec<TextEdit>>;

    /// The edits that set gravity, in the root link; empty if the file format cannot express it.
    fn set_gravity(&self, _gravity_m_s2: &Vector3<f64>) -> Vec<TextEdit> {
        Vec::new()
    }

    /// The text of a link and of the joint that carries it, to be added to another file; `None` if the file has no such link.
    fn link_text(&self, _link: &str) -> Option<String> {
        None
    }

    /// The edits that add a link of another file; empty if the file format cannot express it.
    fn add_link(&self, _text: &str) -> Vec<TextEdit> {
        Vec::new()
    }

    /// The edits that set a limit of a joint, such as `effort`; empty if the file format cannot express it.
    fn set_limit(&self, _joint: &str, _parameter: &str, _value: f64) -> Vec<TextEdit> {
        Vec::new()
    }

    /// The lines of the file that these edits change, with their new text.
    fn changed_lines(&self, edits: &[TextEdit]) -> Vec<ChangedLines> {
        changed_lines(&self.source().text, edits)
    }
}
