//! What the compared sources are called: a URDF, an MJCF, a table or screws. The one list of titles: whoever prints a pair takes
//! it from its comparison (`CheckReport::title`).

use congruent_agreement::{SourcePair, compare::CheckReport};
use congruent_description::{OwnModelForm, RobotDescription};
use congruent_lint::FileKind;

/// What describes a robot.
#[derive(Clone, Copy, PartialEq)]
enum Written {
    Table,
    Screws,
    Urdf,
    Mjcf,
    Loaded,
    Poses,
}

impl Written {
    fn of(description: &RobotDescription) -> Self {
        if description.is_loaded() {
            return if description.own_model().is_some() { Self::Poses } else { Self::Loaded };
        }
        match (description.own_model(), FileKind::of_links(description)) {
            (Some(OwnModelForm::Table), _) => Self::Table,
            (Some(OwnModelForm::Screws), _) => Self::Screws,
            (None, FileKind::Mjcf) => Self::Mjcf,
            (None, _) => Self::Urdf,
        }
    }

    /// Two descriptions, the first against the second.
    fn title(self, other: Self) -> &'static str {
        use Written::{Loaded, Mjcf, Poses, Screws, Table, Urdf};
        match (self, other) {
            (Table, Table) => "DH table against other DH table",
            (Table, Screws) => "DH table against screws",
            (Table, Urdf) => "DH table against URDF chain",
            (Table, Mjcf) => "DH table against MJCF chain",
            (Screws, Table) => "screws against DH table",
            (Screws, Screws) => "screws against other screws",
            (Screws, Urdf) => "screws against URDF chain",
            (Screws, Mjcf) => "screws against MJCF chain",
            (Urdf, Table) => "URDF chain against DH table",
            (Urdf, Screws) => "URDF chain against screws",
            (Urdf, Urdf) => SourcePair::UrdfOther.title(),
            (Urdf, Mjcf) => "URDF chain against MJCF chain",
            (Mjcf, Table) => "MJCF chain against DH table",
            (Mjcf, Screws) => "MJCF chain against screws",
            (Mjcf, Urdf) => "MJCF chain against URDF chain",
            (Mjcf, Mjcf) => "MJCF chain against other MJCF",
            (Table, Loaded) => "DH table against loaded model",
            (Screws, Loaded) => "screws against loaded model",
            (Urdf, Loaded) => "URDF chain against loaded model",
            (Mjcf, Loaded) => "MJCF chain against loaded model",
            (Table, Poses) => "DH table against poses",
            (Screws, Poses) => "screws against poses",
            (Urdf, Poses) => "URDF chain against poses",
            (Mjcf, Poses) => "MJCF chain against poses",
            (Loaded | Poses, _) => "loaded model against other description",
        }
    }
}

/// The title of a pair of sources of `description`.
fn title(pair: SourcePair, description: &RobotDescription, other: Option<&RobotDescription>) -> &'static str {
    let own = Written::of(description);
    match (pair, other.map(Written::of)) {
        // The robot has a table as well: the other one is the other table.
        (SourcePair::UrdfOther, Some(Written::Table)) if description.dh.is_some() && own == Written::Urdf => {
            "URDF chain against other DH table"
        }
        (SourcePair::UrdfOther, Some(other)) => own.title(other),
        (SourcePair::ModelUrdf, _) if own == Written::Mjcf => "DH table against MJCF chain",
        (SourcePair::PoeUrdf, _) if own == Written::Mjcf => "screws (POE) against MJCF chain",
        (SourcePair::UrdfSimulation, _) if own == Written::Mjcf => "MJCF chain against physics",
        (SourcePair::OtherModelUrdf, Some(Written::Mjcf)) => "other DH table against its MJCF chain",
        _ => pair.title(),
    }
}

/// Gives the comparisons titles that say what the files are.
pub(super) fn entitle(
    geometry: &mut CheckReport,
    description: &RobotDescription,
    other: Option<&RobotDescription>,
) {
    let title = |pair| title(pair, description, other);
    geometry.comparisons.iter_mut().for_each(|of| of.title = title(of.name));
    geometry.certificates.iter_mut().for_each(|of| of.title = title(of.name));
    geometry.diagnoses.iter_mut().for_each(|of| of.title = title(of.name));
}
