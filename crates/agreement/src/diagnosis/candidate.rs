//! The candidate: the model whose faults are searched, as parameters that hypotheses can change. It is a
//! Denavit-Hartenberg table, or screws if only the motion of the model is known.

use std::fmt;

use congruent_description::{ChainQ, DhConvention, DhRow, DhRowKind};
use congruent_kinematics::{Axes, DhRowTwists, Pose, ScrewChain, SinCos, Twist, rotation_exp};
use nalgebra::Vector3;
use serde::Serialize;

/// An entry of a row, by the symbol of the literature.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum DhEntry {
    /// Link length `a`: distance from one joint axis to the next along their common normal, m.
    A,
    /// Link twist `alpha`: angle from one joint axis to the next about their common normal, rad.
    Alpha,
    /// Link offset `d`: shift along the joint axis, m; the position of a prismatic joint is added to it.
    D,
    /// Joint angle at position zero; of a model in screws, the joint's zero.
    Theta,
}

impl DhEntry {
    /// All entries, in the order of a row.
    pub const ALL: [Self; 4] = [Self::A, Self::Alpha, Self::D, Self::Theta];

    /// Whether it is an angle; the others are lengths.
    pub fn is_angle(self) -> bool {
        matches!(self, Self::Alpha | Self::Theta)
    }
}

impl fmt::Display for DhEntry {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.serialize(f)
    }
}

/// One parameter of a candidate that can be fitted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ModelParameter {
    /// An entry of a row.
    Row(usize, DhEntry),
    /// How much the row moves for one unit of its joint.
    Rate(usize),
    /// A component of the declared transform before the rows: x, y, z, then rotations about the axes of the
    /// frame behind it.
    Base(usize),
    /// A component of the declared transform after the rows, likewise.
    Tool(usize),
}

impl ModelParameter {
    /// Whether it is an angle; the others are lengths and ratios.
    pub(super) fn is_angle(self) -> bool {
        match self {
            Self::Row(_, entry) => entry.is_angle(),
            Self::Base(component) | Self::Tool(component) => component >= 3,
            Self::Rate(_) => false,
        }
    }
}

/// A declared transform, with its roll, pitch and yaw if the file gives them: the pose does not show an angle
/// beyond a turn, as a wrong unit gives it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DeclaredTransform {
    /// The transform as one rigid motion, m.
    pub pose: Pose,
    /// Rotations about the fixed axes x, y, z as the file writes them, in radians.
    pub written_rpy_rad: Option<[f64; 3]>,
}

impl From<Pose> for DeclaredTransform {
    fn from(pose: Pose) -> Self {
        Self { pose, written_rpy_rad: None }
    }
}

/// One row: how it moves with its joint, and its constants.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CandidateRow {
    /// The joint that drives it, by its number among the moving joints of the reference model.
    pub joint: usize,
    /// How much it moves for one unit of the joint: the sign of a table's row.
    pub rate: f64,
    /// What does not move: the entries of a table, or a screw.
    pub link: RowConstants,
}

impl CandidateRow {
    /// A row of a table that this joint drives.
    pub(super) fn from_dh_row<J>(joint: usize, row: &DhRow<J>) -> Self {
        let DhRow { kind, a_m, alpha_rad, d_m, theta_rad, sign, .. } = *row;
        Self { joint, rate: sign, link: RowConstants::Dh { kind, a_m, alpha_rad, d_m, theta_rad } }
    }
}

/// The constants of one row.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum RowConstants {
    /// A row of a table.
    Dh {
        /// Which entry the joint drives.
        kind: DhRowKind,
        /// Link length a, m.
        a_m: f64,
        /// Link twist alpha, rad.
        alpha_rad: f64,
        /// Link offset d, m.
        d_m: f64,
        /// Joint angle at position zero, rad.
        theta_rad: f64,
    },
    /// A screw, without parameters of a table.
    Screw {
        /// Space twist at position zero, behind the base.
        twist: Twist,
        /// Position of the joint at the model's zero, rad or m.
        offset: f64,
    },
}

impl CandidateRow {
    /// Scales the lengths of a screw; a table's entries are scaled one by one.
    pub(super) fn rescale_screw(&mut self, factor: f64) {
        if let RowConstants::Screw { twist, .. } = &mut self.link {
            twist.linear *= factor;
        }
    }
}

/// The candidate: base, rows, tool.
#[derive(Debug, Clone, PartialEq)]
pub struct CandidateModel {
    /// The convention of its table; `None` for a model in screws.
    pub convention: Option<DhConvention>,
    /// The declared transform before the rows.
    pub base: DeclaredTransform,
    /// The rows, base to tip.
    pub rows: Vec<CandidateRow>,
    /// The declared transform after the rows.
    pub tool: DeclaredTransform,
}

/// The effect of a parameter on the chain at one configuration.
#[derive(Debug, Clone, Copy)]
pub(super) struct CandidateEffect {
    /// Twist, in the base frame, of the chain from `from_row` on, for one unit of the parameter.
    pub(super) generator: Twist,
    /// The first row that changes.
    pub(super) from_row: usize,
    /// The row whose own screw is proportional to the parameter.
    pub(super) scales_row: Option<usize>,
}

/// Forward kinematics at one configuration, with the space screws of the rows and what derivatives need.
#[derive(Debug, Clone)]
pub(super) struct ChainWalk {
    pub(super) row_twists: Vec<Twist>,
    pub(super) base_from_tip: Pose,
    /// For each row the twists of its entries; a row in screws has `theta` only.
    entries: Vec<DhRowTwists>,
    base_from_dhn: Pose,
}

impl CandidateModel {
    /// A candidate of which only the screws are known, its joints in the order of the reference model.
    pub fn from_screws(chain: &ScrewChain) -> Self {
        let row = |(joint, &twist): (usize, &Twist)| CandidateRow {
            joint,
            rate: 1.0,
            link: RowConstants::Screw { twist, offset: 0.0 },
        };
        Self {
            convention: None,
            base: Pose::identity().into(),
            rows: chain.twists_in_base.iter().enumerate().map(row).collect(),
            tool: chain.base_from_tip_at_zero.into(),
        }
    }

    /// An entry of a row, if the row has it.
    pub fn entry(&self, row: usize, entry: DhEntry) -> Option<f64> {
        match (self.rows[row].link, entry) {
            (RowConstants::Dh { a_m, .. }, DhEntry::A) => Some(a_m),
            (RowConstants::Dh { alpha_rad, .. }, DhEntry::Alpha) => Some(alpha_rad),
            (RowConstants::Dh { d_m, .. }, DhEntry::D) => Some(d_m),
            (RowConstants::Dh { theta_rad, .. }, DhEntry::Theta) => Some(theta_rad),
            (RowConstants::Screw { offset, .. }, DhEntry::Theta) => Some(offset),
            (RowConstants::Screw { .. }, _) => None,
        }
    }

    /// Mutable access to an entry of a row, if the row has it.
    pub(super) fn entry_mut(&mut self, row: usize, entry: DhEntry) -> Option<&mut f64> {
        match (&mut self.rows[row].link, entry) {
            (RowConstants::Dh { a_m, .. }, DhEntry::A) => Some(a_m),
            (RowConstants::Dh { alpha_rad, .. }, DhEntry::Alpha) => Some(alpha_rad),
            (RowConstants::Dh { d_m, .. }, DhEntry::D) => Some(d_m),
            (RowConstants::Dh { theta_rad, .. }, DhEntry::Theta) => Some(theta_rad),
            (RowConstants::Screw { offset, .. }, DhEntry::Theta) => Some(offset),
            (RowConstants::Screw { .. }, _) => None,
        }
    }

    /// Gives an entry of a row another value, if the row has it.
    pub(crate) fn set_entry(&mut self, row: usize, entry: DhEntry, value: f64) {
        if let Some(place) = self.entry_mut(row, entry) {
            *place = value;
        }
    }

    /// The entry that the joint of a row drives: its value at position zero.
    pub fn zero_entry(&self, row: usize) -> DhEntry {
        match self.rows[row].link {
            RowConstants::Dh { kind: DhRowKind::Prismatic, .. } => DhEntry::D,
            _ => DhEntry::Theta,
        }
    }

    /// Pose of the tip at joint positions `q`, in the order of the reference model.
    pub fn base_from_tip(&self, q: &ChainQ) -> Pose {
        self.walk(q).base_from_tip
    }

    /// Takes a parameter from another candidate: of a declared transform the whole.
    pub(super) fn copy(&mut self, parameter: ModelParameter, from: &Self) {
        match parameter {
            ModelParameter::Row(row, entry) => {
                if let Some(value) = from.entry(row, entry) {
                    self.set_entry(row, entry, value);
                }
            }
            ModelParameter::Rate(row) => self.rows[row].rate = from.rows[row].rate,
            ModelParameter::Base(_) => self.base = from.base,
            ModelParameter::Tool(_) => self.tool = from.tool,
        }
    }

    /// Adds `by` to a parameter; nothing happens if the candidate does not have it.
    pub(super) fn shift(&mut self, parameter: ModelParameter, by: f64) {
        match parameter {
            ModelParameter::Row(row, entry) => {
                if let Some(value) = self.entry_mut(row, entry) {
                    *value += by;
                }
            }
            ModelParameter::Rate(row) => self.rows[row].rate += by,
            ModelParameter::Base(component) => self.base = moved(&self.base.pose, component, by).into(),
            ModelParameter::Tool(component) => self.tool = moved(&self.tool.pose, component, by).into(),
        }
    }

    /// Forward kinematics at `q`, with the twists from which derivatives are computed.
    pub(super) fn walk(&self, q: &ChainQ) -> ChainWalk {
        let mut pose = self.base.pose;
        let mut row_twists = Vec::with_capacity(self.rows.len());
        let mut entries = Vec::with_capacity(self.rows.len());
        for row in &self.rows {
            let motion = row.rate * q[row.joint];
            match row.link {
                RowConstants::Dh { kind, a_m, alpha_rad, d_m, theta_rad } => {
                    let (turn, slide) = match kind {
                        DhRowKind::Revolute => (theta_rad + motion, d_m),
                        DhRowKind::Prismatic => (theta_rad, d_m + motion),
                    };
                    let (theta, alpha) = (SinCos::from_angle(turn), SinCos::from_angle(alpha_rad));
                    let before = Axes::from_pose(&pose);
                    // Standard: Rz(theta) Tz(d) Tx(a) Rx(alpha), Denavit and Hartenberg 1955; modified: Rx(alpha)
                    // Tx(a) Rz(theta) Tz(d), Craig 2005. A row of a table always comes with its convention.
                    let convention = self.convention.unwrap_or(DhConvention::Standard);
                    let behind = match convention {
                        DhConvention::Standard => before.about_z(theta, slide).about_x(alpha, a_m),
                        DhConvention::Modified => before.about_x(alpha, a_m).about_z(theta, slide),
                    };
                    let by = DhRowTwists::between(convention, &before, &behind);
                    // A DH joint turns about its z axis or slides along it: its screw is the twist of `theta` or of
                    // `d`.
                    let along_z = if kind == DhRowKind::Revolute { by.theta } else { by.d };
                    row_twists.push(along_z * row.rate);
                    entries.push(by);
                    pose = behind.pose();
                }
                RowConstants::Screw { twist, offset } => {
                    // The rows before it have moved its axis: a column of the space Jacobian (Lynch and Park 2017,
                    // eq. 5.11).
                    let theta = twist.transformed_by(&pose);
                    row_twists.push(theta * row.rate);
                    entries.push(DhRowTwists { theta, ..DhRowTwists::default() });
                    pose = pose * twist.exp(offset + motion);
                }
            }
        }
        ChainWalk { row_twists, base_from_tip: pose * self.tool.pose, entries, base_from_dhn: pose }
    }

    /// The effect of a parameter at `q`, given the walk there; `None` if the candidate does not have the
    /// parameter.
    pub(super) fn parameter_effect(
        &self,
        parameter: ModelParameter,
        q: &ChainQ,
        walk: &ChainWalk,
    ) -> Option<CandidateEffect> {
        let rows = self.rows.len();
        let rigid = |generator, from_row| Some(CandidateEffect { generator, from_row, scales_row: None });
        match parameter {
            ModelParameter::Row(row, entry) => {
                self.entry(row, entry)?;
                let by = &walk.entries[row];
                // In a modified row `a` and `alpha` also move the row's own axis.
                let own = usize::from(self.convention != Some(DhConvention::Modified));
                match entry {
                    DhEntry::A => rigid(by.a, row + own),
                    DhEntry::Alpha => rigid(by.alpha, row + own),
                    // `theta` and `d` act along the row's own axis, which they leave in place: the first row that
                    // moves is the next.
                    DhEntry::D => rigid(by.d, row + 1),
                    DhEntry::Theta => rigid(by.theta, row + 1),
                }
            }
            ModelParameter::Rate(row) => {
                // The motion of the row is `rate * q`, and `row_twists` are per unit of `q`: `S rate` divided by
                // the rate is the screw of the row itself, and one unit of the rate moves it by `q`.
                let share = q[self.rows[row].joint] / self.rows[row].rate;
                let generator = walk.row_twists[row] * share;
                Some(CandidateEffect { generator, from_row: row + 1, scales_row: Some(row) })
            }
            // `moved` adds translations in the frame before the transform, and turns about axes of the frame behind
            // it: so the generator of a translation is at the base, that of a rotation in the transformed frame.
            ModelParameter::Base(component) if component < 3 => rigid(unit(component), 0),
            ModelParameter::Base(component) => rigid(unit(component).transformed_by(&self.base.pose), 0),
            ModelParameter::Tool(component) if component < 3 => {
                rigid(unit(component).transformed_by(&walk.base_from_dhn), rows)
            }
            ModelParameter::Tool(component) => {
                rigid(unit(component).transformed_by(&walk.base_from_tip), rows)
            }
        }
    }
}

/// The twist of one component: translations along x, y, z, then rotations about x, y, z.
fn unit(component: usize) -> Twist {
    // `Twist::units` has the rotations first.
    Twist::units()[(component + 3) % 6]
}

/// A declared transform with one component changed: a translation in the frame before it, a rotation about an
/// axis of the frame behind it, so that neither changes the values of the other.
fn moved(pose: &Pose, component: usize, by: f64) -> Pose {
    let axis = Vector3::ith(component % 3, by);
    if component < 3 {
        Pose::from_parts(pose.rotation, pose.translation + axis)
    } else {
        Pose::from_parts(pose.rotation * rotation_exp(&axis), pose.translation)
    }
}
