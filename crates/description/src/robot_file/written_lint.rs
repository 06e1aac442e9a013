//! `[[lint.ignore]]` of a robot file as it is written; crate `lint` applies it.

use schemars::JsonSchema;
use serde::Deserialize;
use toml::Spanned;

/// Warnings that `lint` does not report.
#[derive(Debug, Clone, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Lint")]
pub struct WrittenLint {
    /// Warnings that are known and accepted.
    #[serde(default)]
    #[schemars(with = "Vec<WrittenIgnore>")]
    pub ignore: Vec<Spanned<WrittenIgnore>>,
}

/// Warnings of one code that are known and accepted.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "LintIgnore")]
pub struct WrittenIgnore {
    /// The code of the warnings, by number (CGR-URDF-017) or name.
    #[schemars(with = "String")]
    pub code: Spanned<String>,
    /// Why these warnings are not a fault.
    pub reason: String,
    /// The link, joint or file that the warning is about; if it is left out, all warnings of that code are ignored.
    #[serde(default)]
    #[schemars(with = "String")]
    pub name: Option<String>,
}
