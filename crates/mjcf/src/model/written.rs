//! Values with their places, and how a place writes them.

use std::{fmt, ops::Range, sync::Arc};

use congruent_input::{
    Code, Diagnostic, SourceFile, line_column,
    units::{Unit, UnitSystem, WrittenUnit},
};
use nalgebra::Isometry3;

/// Where a value is written: the file, and the text between the quotes of its attribute.
#[derive(Clone, PartialEq)]
pub struct MjPlace {
    /// The file, which may be an included one.
    pub source: Arc<SourceFile>,
    /// Byte range of the value in the file; of an element the opening of its tag.
    pub span: Range<usize>,
    /// The attribute, as `pos` or `quat`; of an element its tag.
    pub key: String,
    /// The class of defaults that states the value; `None` if its own element does. A change there changes other elements, too.
    pub class: Option<String>,
}

impl MjPlace {
    /// The text as it is written.
    pub fn text(&self) -> &str {
        self.source.text.get(self.span.clone()).unwrap_or_default()
    }

    /// An error at this place.
    pub(crate) fn fault(&self, code: &'static Code, message: impl Into<String>) -> Diagnostic {
        Diagnostic::error(code, message).at(self.span.clone()).in_file(&self.source)
    }

    /// A warning at this place.
    pub(crate) fn warning(&self, code: &'static Code, message: impl Into<String>) -> Diagnostic {
        Diagnostic::warning(code, message).at(self.span.clone()).in_file(&self.source)
    }
}

/// File, line and column, without the text of the file.
impl fmt::Debug for MjPlace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (line, column) = line_column(&self.source.text, self.span.start);
        write!(f, "{} at {}:{line}:{column}", self.key, self.source.path.display())
    }
}

/// A value in SI units, and its place.
#[derive(Debug, Clone, PartialEq)]
pub struct MjWritten<T> {
    /// The value, in metres, radians, kilograms and their products.
    pub value: T,
    /// Where it is written; `None` if no file states it and it is the default of MuJoCo.
    pub place: Option<MjPlace>,
}

impl<T> MjWritten<T> {
    /// A value that no file states.
    pub fn unwritten(value: T) -> Self {
        Self { value, place: None }
    }

    /// Another value at the same place.
    pub fn map<U>(self, change: impl FnOnce(T) -> U) -> MjWritten<U> {
        MjWritten { value: change(self.value), place: self.place }
    }
}

/// The name of a body, joint or site.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct MjName {
    /// The name, with the prefix of an attached model and the number of a replica; `joint 2 of forearm` if the file has none.
    pub text: String,
    /// Whether the file states it.
    pub is_written: bool,
}

impl fmt::Display for MjName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}

/// How values of an element are written, for whoever corrects them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MjNotation {
    /// Whether angles are in degrees.
    pub is_in_degrees: bool,
    /// Axes of `euler`, as `xyz`: lower case turns about moved axes, upper case about fixed ones.
    pub euler_sequence: [u8; 3],
    /// Pose of the innermost `<frame>` in the body (for a body: in its parent): values are written in that frame.
    pub body_from_frame: Isometry3<f64>,
}

impl MjNotation {
    /// The unit of angles: degrees are engineering units.
    pub(crate) fn angle_unit(&self) -> UnitSystem {
        if self.is_in_degrees { UnitSystem::Engineering } else { UnitSystem::Si }
    }

    /// An angle, rad, in the unit of the file.
    pub fn written_angle(&self, angle_rad: f64) -> f64 {
        WrittenUnit { unit: Unit::Angle, system: self.angle_unit() }.from_si(angle_rad)
    }

    /// An angle of the file, rad.
    pub(crate) fn angle_rad(&self, written: f64) -> f64 {
        WrittenUnit { unit: Unit::Angle, system: self.angle_unit() }.to_si(written)
    }
}
