//! The section `[tolerances]` of a robot file as it is written. The doc comments become the descriptions of its JSON schema.

use congruent_input::{Code, Diagnostic, known_names, units::Unit};
use schemars::JsonSchema;
use serde::Deserialize;
use toml::Spanned;

use crate::declared_tolerances::{
    DeclaredTolerances, ErrorDistribution, FrameTolerances, JointTolerances, ParameterTolerances,
};

/// A section with a tolerance of each quantity of [`ParameterTolerances`], between other keys. Not a struct that is flattened into both:
/// serde then loses the places of the values.
macro_rules! tolerance_section {
    (
        $(#[$meta:meta])*
        $visibility:vis struct $name:ident { $($before:tt)* } followed_by { $($behind:tt)* }
    ) => {
        #[derive(Debug, Clone, PartialEq, Deserialize, JsonSchema)]
        #[serde(deny_unknown_fields)]
        $(#[$meta])*
        $visibility struct $name {
            $($before)*
            /// Tolerance of link length a of a row, in metres.
            #[serde(default)]
            #[schemars(with = "f64")]
            a_m: Option<Spanned<f64>>,
            /// Tolerance of link length a of a row, in millimetres.
            #[serde(default)]
            #[schemars(with = "f64")]
            a_mm: Option<Spanned<f64>>,
            /// Tolerance of link offset d of a row, in metres.
            #[serde(default)]
            #[schemars(with = "f64")]
            d_m: Option<Spanned<f64>>,
            /// Tolerance of link offset d of a row, in millimetres.
            #[serde(default)]
            #[schemars(with = "f64")]
            d_mm: Option<Spanned<f64>>,
            /// Tolerance of link twist alpha of a row, in radians.
            #[serde(default)]
            #[schemars(with = "f64")]
            alpha_rad: Option<Spanned<f64>>,
            /// Tolerance of link twist alpha of a row, in degrees.
            #[serde(default)]
            #[schemars(with = "f64")]
            alpha_deg: Option<Spanned<f64>>,
            /// Tolerance of joint angle theta of a row, in radians.
            #[serde(default)]
            #[schemars(with = "f64")]
            theta_rad: Option<Spanned<f64>>,
            /// Tolerance of joint angle theta of a row, in degrees.
            #[serde(default)]
            #[schemars(with = "f64")]
            theta_deg: Option<Spanned<f64>>,
            /// Tolerance of zero of a joint that slides, in metres.
            #[serde(default)]
            #[schemars(with = "f64")]
            zero_m: Option<Spanned<f64>>,
            /// Tolerance of zero of a joint that slides, in millimetres.
            #[serde(default)]
            #[schemars(with = "f64")]
            zero_mm: Option<Spanned<f64>>,
            /// Tolerance of zero of a joint that turns: encoder and backlash, in radians.
            #[serde(default)]
            #[schemars(with = "f64")]
            zero_rad: Option<Spanned<f64>>,
            /// Tolerance of zero of a joint that turns: encoder and backlash, in degrees.
            #[serde(default)]
            #[schemars(with = "f64")]
            zero_deg: Option<Spanned<f64>>,
            /// Tolerance of each coordinate of a joint's origin, of a robot without a table, in metres.
            #[serde(default)]
            #[schemars(with = "f64")]
            xyz_m: Option<Spanned<f64>>,
            /// Tolerance of each coordinate of a joint's origin, of a robot without a table, in millimetres.
            #[serde(default)]
            #[schemars(with = "f64")]
            xyz_mm: Option<Spanned<f64>>,
            /// Tolerance of each of three turns about the axes of a joint's frame, of a robot without a table, in radians.
            #[serde(default)]
            #[schemars(with = "f64")]
            rpy_rad: Option<Spanned<f64>>,
            /// Tolerance of each of three turns about the axes of a joint's frame, of a robot without a table, in degrees.
            #[serde(default)]
            #[schemars(with = "f64")]
            rpy_deg: Option<Spanned<f64>>,
            $($behind)*
        }

        impl $name {
            /// The tolerances of the quantities, in SI units.
            fn parameters(&self, reader: ToleranceReader) -> Result<ParameterTolerances, Diagnostic> {
                let read = |unit, quantity, keys| reader.read(unit, quantity, keys);
                Ok(ParameterTolerances {
                    a_m: read(Unit::Length, "a", [&self.a_m, &self.a_mm])?,
                    d_m: read(Unit::Length, "d", [&self.d_m, &self.d_mm])?,
                    alpha_rad: read(Unit::Angle, "alpha", [&self.alpha_rad, &self.alpha_deg])?,
                    theta_rad: read(Unit::Angle, "theta", [&self.theta_rad, &self.theta_deg])?,
                    zero_m: read(Unit::Length, "zero", [&self.zero_m, &self.zero_mm])?,
                    zero_rad: read(Unit::Angle, "zero", [&self.zero_rad, &self.zero_deg])?,
                    xyz_m: read(Unit::Length, "xyz", [&self.xyz_m, &self.xyz_mm])?,
                    rpy_rad: read(Unit::Angle, "rpy", [&self.rpy_rad, &self.rpy_deg])?,
                })
            }
        }
    };
}

tolerance_section! {
    /// By how much each parameter of the robot may be off, above 0: half widths. What is not written is exact. Each quantity has one of its
    /// two keys: SI units or engineering units.
    #[schemars(rename = "ParameterTolerances")]
    pub struct WrittenTolerances {
        /// How each error is distributed: "uniform" within its tolerance, which is the default, or "normal".
        #[serde(default)]
        kind: DistributionKind,
        /// Standard deviations of a tolerance, if errors are normal; 3 by default.
        #[serde(default)]
        #[schemars(with = "f64")]
        sigmas: Option<Spanned<f64>>,
    } followed_by {
        /// Tolerance of each coordinate of the base, in metres.
        #[serde(default)]
        #[schemars(with = "f64")]
        base_m: Option<Spanned<f64>>,
        /// Tolerance of each coordinate of the base, in millimetres.
        #[serde(default)]
        #[schemars(with = "f64")]
        base_mm: Option<Spanned<f64>>,
        /// Tolerance of each turn of the base about its axes, in radians.
        #[serde(default)]
        #[schemars(with = "f64")]
        base_rad: Option<Spanned<f64>>,
        /// Tolerance of each turn of the base about its axes, in degrees.
        #[serde(default)]
        #[schemars(with = "f64")]
        base_deg: Option<Spanned<f64>>,
        /// Tolerance of each coordinate of the tool centre point in the last link, in metres.
        #[serde(default)]
        #[schemars(with = "f64")]
        tcp_m: Option<Spanned<f64>>,
        /// Tolerance of each coordinate of the tool centre point in the last link, in millimetres.
        #[serde(default)]
        #[schemars(with = "f64")]
        tcp_mm: Option<Spanned<f64>>,
        /// Tolerance of each turn of the tool centre point about its axes, in radians.
        #[serde(default)]
        #[schemars(with = "f64")]
        tcp_rad: Option<Spanned<f64>>,
        /// Tolerance of each turn of the tool centre point about its axes, in degrees.
        #[serde(default)]
        #[schemars(with = "f64")]
        tcp_deg: Option<Spanned<f64>>,
        /// Other tolerances of single joints and their rows.
        #[serde(default)]
        row: Vec<WrittenJointTolerances>,
    }
}

/// How an error is distributed within its tolerance.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
enum DistributionKind {
    /// Each error within the tolerance is as likely as any other.
    #[default]
    Uniform,
    /// Normal, a tolerance is `sigmas` standard deviations.
    Normal,
}

tolerance_section! {
    /// Tolerances of one joint and its row, in the place of the general ones.
    #[schemars(rename = "JointTolerances")]
    struct WrittenJointTolerances {
        /// Name of the joint.
        #[schemars(with = "String")]
        joint: Spanned<String>,
    } followed_by {}
}

/// Checks the values of a section.
#[derive(Clone, Copy)]
struct ToleranceReader {
    /// Of the faults.
    code: &'static Code,
}

impl WrittenTolerances {
    /// The tolerances in SI units, for a robot with these joints; faults have this code.
    ///
    /// # Errors
    /// A value is not above 0, a quantity has both of its keys, or no joint has the name of a row.
    pub fn declared(&self, joints: &[&str], code: &'static Code) -> Result<DeclaredTolerances, Diagnostic> {
        let reader = ToleranceReader { code };
        let read = |unit, quantity, keys| reader.read(unit, quantity, keys);
        let general = self.parameters(reader)?;
        let frame = |quantity, lengths, angles| {
            let position_m = read(Unit::Length, quantity, lengths)?;
            Ok(FrameTolerances { position_m, orientation_rad: read(Unit::Angle, quantity, angles)? })
        };
        let row = |row: &WrittenJointTolerances| reader.row(row, joints);
        Ok(DeclaredTolerances {
            general,
            rows: self.row.iter().map(row).collect::<Result<_, Diagnostic>>()?,
            base: frame("base", [&self.base_m, &self.base_mm], [&self.base_rad, &self.base_deg])?,
            tcp: frame("tcp", [&self.tcp_m, &self.tcp_mm], [&self.tcp_rad, &self.tcp_deg])?,
            distribution: self.distribution(reader)?,
        })
    }

    fn distribution(&self, reader: ToleranceReader) -> Result<ErrorDistribution, Diagnostic> {
        /// Of a tolerance that nothing else is said about.
        const USUAL: f64 = 3.0;
        match (self.kind, &self.sigmas) {
            (DistributionKind::Uniform, None) => Ok(ErrorDistribution::Uniform),
            (DistributionKind::Uniform, Some(sigmas)) => {
                let message = "sigmas is of normal errors, and these are uniform";
                let fault = Diagnostic::error(reader.code, message).at(sigmas.span());
                Err(fault.with_help("add kind = \"normal\", or remove sigmas"))
            }
            (DistributionKind::Normal, None) => Ok(ErrorDistribution::Normal { sigmas: USUAL }),
            (DistributionKind::Normal, Some(sigmas)) => {
                Ok(ErrorDistribution::Normal { sigmas: reader.positive("sigmas", sigmas)? })
            }
        }
    }
}

impl ToleranceReader {
    fn row(self, row: &WrittenJointTolerances, joints: &[&str]) -> Result<JointTolerances, Diagnostic> {
        let name = row.joint.get_ref();
        if !joints.contains(&name.as_str()) {
            let message = format!("[[tolerances.row]]: the robot has no joint \"{name}\"");
            let known = known_names(name, "joints", joints.iter().copied());
            return Err(Diagnostic::error(self.code, message).at(row.joint.span()).with_help(known));
        }
        let tolerances = row.parameters(self)?;
        Ok(JointTolerances { joint: name.clone(), tolerances })
    }

    /// The tolerance of a quantity from its keys, of SI units first.
    fn read(
        self,
        unit: Unit,
        quantity: &str,
        [si, engineering]: [&Option<Spanned<f64>>; 2],
    ) -> Result<Option<f64>, Diagnostic> {
        for (key, value) in unit.keys(quantity).iter().zip([si, engineering]) {
            if let Some(value) = value {
                self.positive(key, value)?;
            }
        }
        unit.value(quantity, si.as_ref(), engineering.as_ref())
    }

    fn positive(self, key: &str, value: &Spanned<f64>) -> Result<f64, Diagnostic> {
        let found = *value.get_ref();
        if found > 0.0 && found.is_finite() {
            return Ok(found);
        }
        let message = format!("{key} must be greater than 0, it is {found}");
        let help =
            "a tolerance is a half width: 0.05 of 300 is from 299.95 to 300.05; leave out what is exact";
        Err(Diagnostic::error(self.code, message).at(value.span()).with_help(help))
    }
}
