//! The model under suspicion, in numbers that hypotheses may change: a Denavit-Hartenberg table, or
//! screws where nothing is known but what the model does.

use congruent_description::{ChainQ, DhConvention, DhRowKind};
use congruent_kinematics::{Axes, DhRowTwists, Pose, ScrewChain, SinCos, Twist, rotation_exp};
use nalgebra::Vector3;

/// An entry of a row.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DhEntry {
    /// Link length.
    A,
    /// Link twist.
    Alpha,
    /// Link offset.
    D,
    /// Joint angle at position zero; of a model in screws, the joint's zero.
    Theta,
}

/// One number of a candidate that can be refitted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ModelParameter {
    /// An entry of a row.
    Row(usize, DhEntry),
    /// How much the row moves for one unit of its joint.
    Rate(usize),
    /// Of the declared transform before the rows: x, y, z, then turns about the axes behind it.
    Base(usize),
    /// Of the declared transform after the rows, likewise.
    Tool(usize),
}

/// A declared transform, with its roll-pitch-yaw where the file gives one: a unit slip of an angle
/// beyond a turn is lost in the pose.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Constant {
    /// The transform.
    pub pose: Pose,
    /// Turns about the fixed axes x, y, z as written, in radians.
    pub written_rpy_rad: Option<[f64; 3]>,
}

impl From<Pose> for Constant {
    fn from(pose: Pose) -> Self {
        Self { pose, written_rpy_rad: None }
    }
}

/// One row: how it moves with its joint, and its constants.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CandidateRow {
    /// The joint that drives it: its place in the reference chain.
    pub joint: usize,
    /// How much it moves for one unit of the joint: the sign of a table's row.
    pub rate: f64,
    /// What stands in it.
    pub link: RowConstants,
}

/// The constants of one row.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum RowConstants {
    /// A row of a table.
    Dh {
        /// Which entry the joint drives.
        kind: DhRowKind,
        /// Link length.
        a_m: f64,
        /// Link twist.
        alpha_rad: f64,
        /// Link offset.
        d_m: f64,
        /// Joint angle at position zero.
        theta_rad: f64,
    },
    /// A screw of which nothing more is known.
    Screw {
        /// Space twist at position zero, behind the base.
        twist: Twist,
        /// Position that the model takes for zero, rad or m.
        offset: f64,
    },
}

impl CandidateRow {
    /// Lengths of a screw in another unit; a table's entries are scaled one by one.
    pub(super) fn rescale_screw(&mut self, factor: f64) {
        if let RowConstants::Screw { twist, .. } = &mut self.link {
            twist.linear *= factor;
        }
    }
}

/// A model under suspicion: base, rows, tool.
#[derive(Debug, Clone, PartialEq)]
pub struct Candidate {
    /// Which equation its table stands for; `None` for a model in screws.
    pub convention: Option<DhConvention>,
    /// The declared transform before the rows.
    pub base: Constant,
    /// The rows, base to tip.
    pub rows: Vec<CandidateRow>,
    /// The declared transform after the rows.
    pub tool: Constant,
}

/// How a parameter moves the chain at one configuration.
#[derive(Debug, Clone, Copy)]
pub(super) struct Influence {
    /// Motion of what lies behind, in the base frame, for one unit of the parameter.
    pub(super) generator: Twist,
    /// The first row that moves.
    pub(super) from_row: usize,
    /// The row whose own screw grows with the parameter, by its share.
    pub(super) grows: Option<usize>,
}

/// The chain at one configuration: space screws of its rows there, tip, and frames of the walk.
#[derive(Debug, Clone)]
pub(super) struct ChainWalk {
    pub(super) row_twists: Vec<Twist>,
    pub(super) base_from_tip: Pose,
    /// For each row what its entries do; a row in screws has `theta` alone.
    entries: Vec<DhRowTwists>,
    base_from_dhn: Pose,
}

impl Candidate {
    /// A model of which only its screws are known, its joints in the order of the reference.
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

    /// An entry of a row, where the row has it.
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

    /// The place of an entry, where the row has it.
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

    /// The entry that the joint of a row drives: its value at position zero.
    pub fn zero_entry(&self, row: usize) -> DhEntry {
        match self.rows[row].link {
            RowConstants::Dh { kind: DhRowKind::Prismatic, .. } => DhEntry::D,
            _ => DhEntry::Theta,
        }
    }

    /// Pose of the tip at joint positions `q`, in the order of the reference chain.
    pub fn base_from_tip(&self, q: &ChainQ) -> Pose {
        self.walk(q).base_from_tip
    }

    /// Moves a parameter by `by`; one that the model does not have stays.
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

    /// Everything about the chain at `q` that derivatives need.
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
                    let (theta, alpha) = (SinCos::of(turn), SinCos::of(alpha_rad));
                    let before = Axes::of(&pose);
                    let convention = self.convention.unwrap_or(DhConvention::Standard);
                    let behind = match convention {
                        DhConvention::Standard => before.about_z(theta, slide).about_x(alpha, a_m),
                        DhConvention::Modified => before.about_x(alpha, a_m).about_z(theta, slide),
                    };
                    let by = DhRowTwists::between(convention, &before, &behind);
                    let along_z = if kind == DhRowKind::Revolute { by.theta } else { by.d };
                    row_twists.push(along_z * row.rate);
                    entries.push(by);
                    pose = behind.pose();
                }
                RowConstants::Screw { twist, offset } => {
                    let theta = twist.transformed_by(&pose);
                    row_twists.push(theta * row.rate);
                    entries.push(DhRowTwists { theta, ..DhRowTwists::default() });
                    pose = pose * twist.exp(offset + motion);
                }
            }
        }
        ChainWalk { row_twists, base_from_tip: pose * self.tool.pose, entries, base_from_dhn: pose }
    }

    /// How a parameter moves the chain at `q`, whose walk is given; `None` where the model does not
    /// have it.
    pub(super) fn influence(
        &self,
        parameter: ModelParameter,
        q: &ChainQ,
        walk: &ChainWalk,
    ) -> Option<Influence> {
        let rows = self.rows.len();
        let rigid = |generator, from_row| Some(Influence { generator, from_row, grows: None });
        match parameter {
            ModelParameter::Row(row, entry) => {
                self.entry(row, entry)?;
                let by = &walk.entries[row];
                // Behind a modified row's `a` and `alpha` its own axis moves too.
                let own = usize::from(self.convention != Some(DhConvention::Modified));
                match entry {
                    DhEntry::A => rigid(by.a, row + own),
                    DhEntry::Alpha => rigid(by.alpha, row + own),
                    DhEntry::D => rigid(by.d, row + 1),
                    DhEntry::Theta => rigid(by.theta, row + 1),
                }
            }
            ModelParameter::Rate(row) => {
                let share = q[self.rows[row].joint] / self.rows[row].rate;
                let generator = walk.row_twists[row] * share;
                Some(Influence { generator, from_row: row + 1, grows: Some(row) })
            }
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

/// The twist of one component: shifts along x, y, z, then turns about x, y, z.
fn unit(component: usize) -> Twist {
    Twist::units()[(component + 3) % 6]
}

/// A declared transform with one component changed: a shift in the frame before it, a turn about
/// an axis of the frame behind it, so that neither changes the other's figures.
fn moved(pose: &Pose, component: usize, by: f64) -> Pose {
    let axis = Vector3::ith(component % 3, by);
    if component < 3 {
        Pose::from_parts(pose.rotation, pose.translation + axis)
    } else {
        Pose::from_parts(pose.rotation * rotation_exp(&axis), pose.translation)
    }
}
