//! The settings of `<compiler>`: of several sections, the last that gives an attribute holds, wherever it is in the file.

use congruent_input::{Diagnostics, units::UnitSystem};
use nalgebra::Isometry3;

use crate::{
    codes,
    document::{MjAttribute, MjElement},
    grammar::numbers,
    model::{MjInertiaRules, MjInference, MjNotation, MjWritten},
};

/// Settings of one model; an attached model has its own.
#[derive(Debug, Clone)]
pub(crate) struct MjSettings {
    /// Degrees are engineering units.
    pub(crate) angle_unit: UnitSystem,
    pub(crate) euler_sequence: [u8; 3],
    pub(crate) has_auto_limits: bool,
    /// Folder of meshes, as it is written.
    pub(crate) mesh_folder: String,
    /// Whether folders in names of files are dropped.
    pub(crate) is_path_stripped: bool,
    pub(crate) inertia: MjInertiaRules,
    pub(crate) total_mass_kg: Option<MjWritten<f64>>,
}

impl MjSettings {
    pub(crate) fn read(root: &MjElement, diagnostics: &mut Diagnostics) -> Self {
        let given = |key: &str| -> Option<&MjAttribute> {
            let found = root.all("compiler").filter_map(|section| section.attribute(key)).last();
            found.map(AsRef::as_ref).filter(|attribute| !attribute.value.is_empty())
        };
        let text = |key: &str| given(key).map(|attribute| attribute.value.as_str());
        let number = |key: &str| text(key).and_then(|text| numbers(text).first().copied());
        if let Some(coordinate) = given("coordinate").filter(|attribute| attribute.value == "global") {
            let message = "coordinate is \"global\", which MuJoCo no longer supports";
            let help =
                "convert the file with MuJoCo 2.3.3 or older, or write every pose in the frame of its parent";
            diagnostics.push(coordinate.fault(codes::mjcf::COMPILER, message).with_help(help));
        }
        Self {
            angle_unit: if text("angle") == Some("radian") {
                UnitSystem::Si
            } else {
                UnitSystem::Engineering
            },
            euler_sequence: given("eulerseq").map_or(*b"xyz", |given| euler_sequence(given, diagnostics)),
            has_auto_limits: text("autolimits") != Some("false"),
            mesh_folder: text("meshdir").or(text("assetdir")).unwrap_or_default().to_owned(),
            is_path_stripped: text("strippath") == Some("true"),
            inertia: MjInertiaRules {
                inference: match text("inertiafromgeom") {
                    Some("false") => MjInference::Never,
                    Some("true") => MjInference::Always,
                    _ => MjInference::WithoutInertial,
                },
                groups: text("inertiagrouprange").map_or([0, 5], groups),
                least_mass_kg: number("boundmass").unwrap_or_default(),
                least_moment_kg_m2: number("boundinertia").unwrap_or_default(),
                is_balanced: text("balanceinertia") == Some("true"),
            },
            total_mass_kg: number("settotalmass").filter(|mass| *mass > 0.0).map(|value| MjWritten {
                value,
                place: given("settotalmass").map(|attribute| attribute.place(None)),
            }),
        }
    }

    pub(crate) fn is_in_degrees(&self) -> bool {
        self.angle_unit == UnitSystem::Engineering
    }

    /// How values of an element in this frame are written.
    pub(crate) fn notation(&self, body_from_frame: Isometry3<f64>) -> MjNotation {
        MjNotation {
            is_in_degrees: self.is_in_degrees(),
            euler_sequence: self.euler_sequence,
            body_from_frame,
        }
    }

    /// An angle of the file, rad.
    pub(crate) fn angle(&self, written: f64) -> f64 {
        self.notation(Isometry3::identity()).angle_rad(written)
    }
}

fn groups(text: &str) -> [i32; 2] {
    let mut groups = text.split_whitespace().filter_map(|token| token.parse().ok());
    [groups.next().unwrap_or(0), groups.next().unwrap_or(5)]
}

/// The three letters. MuJoCo checks them only when an `euler` is read.
fn euler_sequence(given: &MjAttribute, diagnostics: &mut Diagnostics) -> [u8; 3] {
    let letters: Option<[u8; 3]> = given.value.as_bytes().try_into().ok();
    let is_axis = |letter: &u8| b"xyzXYZ".contains(letter);
    letters.filter(|letters| letters.iter().all(is_axis)).unwrap_or_else(|| {
        let message = format!("eulerseq is \"{}\", expected three of the letters x y z X Y Z", given.value);
        let help = "roll, pitch, yaw of a URDF is \"XYZ\"; without eulerseq it is \"xyz\", about moved axes";
        diagnostics.push(given.fault(codes::mjcf::COMPILER, message).with_help(help));
        *b"xyz"
    })
}
