//! What a code of messages is, and how a crate declares those of its own messages.

use crate::nearest::nearest;

/// The stable number and name of a kind of finding, declared with [`codes!`](macro@crate::codes).
///
/// # Examples
/// ```
/// use congruent_input::{Code, codes};
/// assert_eq!(Code::find("cgr-file-003", codes::ALL), Some(codes::file::NOT_REGULAR));
/// assert_eq!(Code::nearest("file::permision", codes::ALL), Some(codes::file::PERMISSION));
/// ```
#[derive(Debug, PartialEq, Eq)]
pub struct Code {
    /// The number, `CGR-URDF-017`; the causes of disagreements have none.
    pub id: Option<&'static str>,
    /// The name, `area::fault`.
    pub name: &'static str,
    /// What is wrong, why it matters and what to do, perhaps with an example below it.
    pub about: &'static str,
    /// Whether the file itself cannot be read or is of no known kind, so that nothing in it has been examined.
    pub is_unreadable: bool,
}

impl Code {
    /// The code with this name (`urdf::axis`) or number (`CGR-URDF-018`); upper and lower case are equal.
    pub fn find(word: &str, known: &[&'static Self]) -> Option<&'static Self> {
        let is_meant = |code: &&&Self| code.words().any(|known| known.eq_ignore_ascii_case(word));
        known.iter().find(is_meant).copied()
    }

    /// The number, or the name of a code that has none.
    pub fn id_or_name(&self) -> &'static str {
        self.id.unwrap_or(self.name)
    }

    /// The first half of the name: `urdf` of `urdf::axis`.
    pub fn area(&self) -> &'static str {
        self.name.split_once("::").map_or(self.name, |(area, _)| area)
    }

    /// The code most similar to a word that is not a code.
    pub fn nearest(word: &str, known: &[&'static Self]) -> Option<&'static Self> {
        let near = nearest(word, known.iter().flat_map(|code| code.words()))?;
        Self::find(near, known)
    }

    fn words(&self) -> impl Iterator<Item = &'static str> {
        self.id.into_iter().chain([self.name])
    }
}

/// Declares the codes of a crate, in modules that are named as the first half of their names, and the list `ALL` of them.
///
/// A number that is no longer used is never given again, since ignore lists and other programs refer to it. `unreadable` says
/// that nothing in the file has been examined. The library's `codes()` joins the lists of all crates.
///
/// # Examples
/// ```
/// congruent_input::codes! {
///     gripper {
///         OPEN = "CGR-GRIPPER-001", "gripper::open", "The gripper is open when it should hold. Close it.";
///         FILE = "CGR-GRIPPER-002", "gripper::file" unreadable, "The file is not of a gripper.";
///     }
/// }
/// assert_eq!((ALL.len(), gripper::OPEN.id, gripper::FILE.is_unreadable), (2, Some("CGR-GRIPPER-001"), true));
/// ```
#[macro_export]
macro_rules! codes {
    ($($module:ident { $($code:ident = $id:literal, $name:literal $($unreadable:ident)?, $about:literal;)+ })+) => {
        $(
            #[doc = concat!("Codes `", stringify!($module), "::`.")]
            pub mod $module {
                $(
                    #[doc = concat!("`", $name, "`, ", $id, ".")]
                    pub const $code: &$crate::Code = &$crate::Code {
                        id: Some($id),
                        name: $name,
                        about: $about,
                        is_unreadable: $crate::codes!(@is_unreadable $($unreadable)?),
                    };
                )+
            }
        )+

        /// All codes of this crate.
        pub const ALL: &[&$crate::Code] = &[$($($module::$code),+),+];
    };
    (@is_unreadable) => { false };
    (@is_unreadable unreadable) => { true };
}
