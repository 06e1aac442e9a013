//! The tables that agree with the reference model and of which the fewest values differ from the given ones.
//!
//! Each z axis of a table is the axis of a joint, so the lines of two neighbouring axes determine the values between them
//! up to the direction of their common normal; if they are parallel, the given `d` is kept. The search goes from base
//! to tip, tries both directions of each normal and of each joint, and ends a branch with more changes than are asked
//! for. Nothing is fitted, so several gross mistakes in one table do not end in a local minimum. Values are exact up to
//! the rounding of the files only: a fit follows.

mod link;
mod same_within;

use congruent_description::{ChainQ, DhConvention, DhRowKind};
use congruent_kinematics::{Pose, Twist, rotation_exp};
use link::{AboutZ, JointLine, LinkValues, links_onto};
use nalgebra::{Matrix3, Vector3};
pub(super) use same_within::SameWithin;

use super::{
    candidate::{CandidateModel, DhEntry, RowConstants},
    reference_model::ReferenceModel,
    thresholds::{NO_TURN, SAME_RATE},
};

/// The cost of a change, so that others can be somewhat likelier or less likely. Kind: choice.
pub(super) const CHANGE: usize = 10;
/// A wrong sign or unit is likelier than any other value, and a value is rarely missing. Kind: choice.
const LIKELY: usize = CHANGE - 1;
const UNLIKELY: usize = CHANGE + 1;
/// A whole transform costs no more than this. Kind: choice.
const WHOLE_TRANSFORM: usize = 3 * CHANGE;

/// A table that agrees, and what its changes cost.
#[derive(Debug, Clone)]
pub(super) struct ChangedTable {
    pub(super) candidate: CandidateModel,
    pub(super) cost: usize,
}

/// The axes of the reference model that a table has to meet.
pub(super) struct WantedAxes {
    axes: Vec<JointLine>,
    base_from_tip: Pose,
    pub(super) same: SameWithin,
}

impl WantedAxes {
    /// `None` if a joint slides: its axis has no place.
    pub(super) fn new(reference: &ReferenceModel, same: SameWithin) -> Option<Self> {
        let state = reference.state(&ChainQ::zeros(reference.joint_count()));
        let axis = |twist: &Twist| {
            let turn = twist.angular.norm();
            // w x v / w^2 is the point of the axis nearest to the origin.
            (turn > NO_TURN).then(|| JointLine {
                through: twist.angular.cross(&twist.linear) / (turn * turn),
                direction: twist.angular / turn,
            })
        };
        let axes = state.twists.iter().map(axis).collect::<Option<Vec<JointLine>>>()?;
        Some(Self { axes, base_from_tip: state.base_from_tip, same })
    }

    /// The tables that differ from the given one by changes that cost at most this much, the cheapest ones.
    pub(super) fn tables(&self, given: &CandidateModel, most: usize) -> Vec<ChangedTable> {
        let is_turning =
            |link: &RowConstants| matches!(link, RowConstants::Dh { kind: DhRowKind::Revolute, .. });
        let rows = &given.rows;
        let is_searched = given.convention.is_some()
            && rows.len() == self.axes.len()
            && rows.iter().all(|row| is_turning(&row.link) && (row.rate.abs() - 1.0).abs() < SAME_RATE);
        let mut search = TableSearch { wanted: self, given, most, found: Vec::new() };
        if is_searched && !rows.is_empty() {
            search.start();
        }
        search.found
    }
}

struct TableSearch<'a> {
    wanted: &'a WantedAxes,
    given: &'a CandidateModel,
    most: usize,
    found: Vec<ChangedTable>,
}

impl TableSearch<'_> {
    /// Both conventions alternate turns about z and x. Standard rows begin with z, on the axis of their own joint;
    /// modified rows begin with x, and z of the base may be anywhere.
    fn is_standard(&self) -> bool {
        self.given.convention != Some(DhConvention::Modified)
    }

    fn start(&mut self) {
        let given = ChangedTable { candidate: self.given.clone(), cost: 0 };
        if !self.is_standard() {
            return self.extend(0, &self.given.base.pose, &given);
        }
        for mut table in self.turned_around(0, &given) {
            let base = self.moved_base(&self.line(&table.candidate, 0));
            table.set_base(base, &self.wanted.same);
            self.extend(0, &base, &table);
        }
    }

    /// A table as it is, and with the joint of a row turned around.
    fn turned_around(&self, row: usize, table: &ChangedTable) -> Vec<ChangedTable> {
        if table.cost + CHANGE > self.most {
            return vec![table.clone()];
        }
        let mut other = table.clone();
        other.candidate.rows[row].rate *= -1.0;
        other.cost += CHANGE;
        vec![table.clone(), other]
    }

    /// The axis of a row's joint with the sign of the row.
    fn line(&self, candidate: &CandidateModel, row: usize) -> JointLine {
        let row = &candidate.rows[row];
        let axis = self.wanted.axes[row.joint];
        JointLine { direction: axis.direction * row.rate, ..axis }
    }

    /// The given base, turned and shifted no more than its z axis needs to be on a line.
    fn moved_base(&self, line: &JointLine) -> Pose {
        let base = self.given.base.pose;
        let z = JointLine::along_z(&base).direction;
        let turn = Vector3::from(z.cross(&line.direction));
        let angle = libm::atan2(turn.norm(), z.dot(&line.direction));
        // Of opposite directions any axis at right angles will do.
        let about = turn.try_normalize(NO_TURN).unwrap_or_else(|| base.rotation.column(0).into_owned());
        let rotation = rotation_exp(&(about * angle)) * base.rotation;
        Pose::from_parts(rotation, base.translation + line.across(&base.translation))
    }

    /// The link at `at` and those behind it, from a frame whose z axis is on the line before it.
    fn extend(&mut self, at: usize, frame: &Pose, table: &ChangedTable) {
        if table.cost > self.most {
            return;
        }
        if at == self.given.rows.len() {
            return self.finish(frame, table);
        }
        let next = if self.is_standard() { at + 1 } else { at };
        if next == self.given.rows.len() {
            // The last row as it is: the transform behind it makes up for everything.
            self.finish(&behind_row(at, frame, &table.candidate), table);
            let end = JointLine::along_z(&self.given_end());
            return self.extend_onto(&end, at, frame, table);
        }
        for table in self.turned_around(next, table) {
            let line = self.line(&table.candidate, next);
            self.extend_onto(&line, at, frame, &table);
        }
    }

    fn extend_onto(&mut self, line: &JointLine, at: usize, frame: &Pose, table: &ChangedTable) {
        // The row of theta and d of this link; of modified rows the one before.
        let about_z = if self.is_standard() { Some(at) } else { at.checked_sub(1) };
        let entry = |row: usize, entry| self.given.entry(row, entry).unwrap_or_default();
        let given = about_z.map_or_else(AboutZ::default, |row| AboutZ {
            theta_rad: entry(row, DhEntry::Theta),
            d_m: entry(row, DhEntry::D),
        });
        let same = self.wanted.same;
        for values in links_onto(line, frame, &given, same) {
            let LinkValues { theta_rad, d_m, a_m, alpha_rad, behind } = values;
            let about_x = [(at, DhEntry::A, a_m), (at, DhEntry::Alpha, alpha_rad)];
            let turns = about_z.map(|row| [(row, DhEntry::Theta, theta_rad), (row, DhEntry::D, d_m)]);
            let values = || about_x.into_iter().chain(turns.into_iter().flatten());
            let cost =
                |(row, entry, value)| table.change(row, entry, value, &same).map_or(0, |(_, cost)| cost);
            // Before the table is copied: most links cost too much.
            if table.cost + values().map(cost).sum::<usize>() > self.most {
                continue;
            }
            let mut table = table.clone();
            values().for_each(|(row, entry, value)| table.set(row, entry, value, &same));
            if about_z.is_none() {
                let shift = Pose::from_parts(about_z_axis(theta_rad), Vector3::z() * d_m);
                table.set_base(table.candidate.base.pose * shift, &same);
            }
            self.extend(at + 1, &behind, &table);
        }
    }

    /// The last frame that the given transform behind the rows wants.
    fn given_end(&self) -> Pose {
        self.wanted.base_from_tip * self.given.tool.pose.inverse()
    }

    /// Behind the last x of the rows: theta and d of a modified table, then the transform to the tip.
    fn finish(&mut self, frame: &Pose, table: &ChangedTable) {
        if self.is_standard() {
            return self.finish_tool(frame, table.clone());
        }
        let last = self.given.rows.len() - 1;
        let entry = |entry| self.given.entry(last, entry).unwrap_or_default();
        let about_z = Pose::from_parts(about_z_axis(entry(DhEntry::Theta)), Vector3::z() * entry(DhEntry::D));
        self.finish_tool(&(*frame * about_z), table.clone());
        let Pose { rotation, translation } = frame.inverse() * self.given_end();
        let same = self.wanted.same;
        let is_along_z = rotation[(2, 2)] > 0.0
            && rotation.column(2).xy().norm() <= same.parallel_rad
            && translation.xy().norm() <= same.length_m;
        if is_along_z {
            let mut table = table.clone();
            table.set(last, DhEntry::Theta, libm::atan2(rotation[(1, 0)], rotation[(0, 0)]), &same);
            table.set(last, DhEntry::D, translation.z, &same);
            self.keep(table);
        }
    }

    /// The transform behind the last frame as it has to be.
    fn finish_tool(&mut self, last: &Pose, mut table: ChangedTable) {
        let tool = last.inverse() * self.wanted.base_from_tip;
        let changed = self.wanted.same.changed_numbers(&self.given.tool.pose, &tool);
        if changed > 0 {
            table.candidate.tool = tool.into();
            table.cost += (changed * CHANGE).min(WHOLE_TRANSFORM);
        }
        self.keep(table);
    }

    fn keep(&mut self, table: ChangedTable) {
        if table.cost > self.most {
            return;
        }
        // Nothing that costs a whole change more than the cheapest one.
        self.most = self.most.min(table.cost + LIKELY);
        self.found.push(table);
        let most = self.most;
        self.found.retain(|found| found.cost <= most);
    }
}

impl ChangedTable {
    /// Changes a value of a row, unless it is the same already.
    fn set(&mut self, row: usize, entry: DhEntry, value: f64, same: &SameWithin) {
        if let Some((value, cost)) = self.change(row, entry, value, same) {
            self.candidate.set_entry(row, entry, value);
            self.cost += cost;
        }
    }

    /// The new value of an entry and what it costs, unless it is the same already.
    fn change(&self, row: usize, entry: DhEntry, value: f64, same: &SameWithin) -> Option<(f64, usize)> {
        let given = self.candidate.entry(row, entry)?;
        let by = same.change(entry, given, value)?;
        let degrees = 1.0_f64.to_radians();
        let factors = if entry.is_angle() { [-1.0, degrees, 1.0 / degrees] } else { [-1.0, 1e-3, 1e3] };
        let is_likely = || {
            let is_zero = same.is_same(entry, 0.0, value);
            !is_zero && factors.iter().any(|factor| same.is_same(entry, factor * given, value))
        };
        let cost = match given {
            0.0 => UNLIKELY,
            _ if is_likely() => LIKELY,
            _ => CHANGE,
        };
        Some((given + by, cost))
    }

    /// Changes the transform before the rows, unless it is the same already.
    fn set_base(&mut self, base: Pose, same: &SameWithin) {
        let changed = same.changed_numbers(&self.candidate.base.pose, &base);
        if changed > 0 {
            self.candidate.base = base.into();
            self.cost += (changed * CHANGE).min(WHOLE_TRANSFORM);
        }
    }
}

/// The frame behind a standard row as it is.
fn behind_row(row: usize, frame: &Pose, candidate: &CandidateModel) -> Pose {
    let entry = |entry| candidate.entry(row, entry).unwrap_or_default();
    let about_z = Pose::from_parts(about_z_axis(entry(DhEntry::Theta)), Vector3::z() * entry(DhEntry::D));
    let alpha = rotation_exp(&(Vector3::x() * entry(DhEntry::Alpha)));
    *frame * about_z * Pose::from_parts(alpha, Vector3::x() * entry(DhEntry::A))
}

fn about_z_axis(angle_rad: f64) -> Matrix3<f64> {
    rotation_exp(&(Vector3::z() * angle_rad))
}
