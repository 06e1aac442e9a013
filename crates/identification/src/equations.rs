//! The equations of a recording: for each driven joint, the inner products of its columns in each block of the time.

use congruent_dynamics::{BodyTree, PARAMETERS};
use nalgebra::{DMatrix, DVector};

use crate::unknowns::{JointUnknown, UnknownOrder};

/// The blocks of time in which equations are added up: what one of them holds is left out together. Kind: choice; four of each fifth.
pub(crate) const BLOCKS: usize = 20;

/// Inner products of the columns of some rows.
#[derive(Debug, Clone)]
pub(crate) struct SummedRows {
    /// `C^T C`, symmetric.
    pub(crate) gram: DMatrix<f64>,
    pub(crate) rows: usize,
}

/// The equations of one driven joint.
#[derive(Debug, Clone)]
pub struct JointEquations {
    /// The joint, among the moving ones.
    pub joint: usize,
    /// The bodies that it moves.
    pub(crate) bodies: Vec<usize>,
    /// `C^T C` of each block, where `C` has the columns below.
    pub(crate) blocks: Vec<DMatrix<f64>>,
    /// Rows of each block.
    pub(crate) counts: Vec<usize>,
}

/// Columns of the equations of a joint behind those of its bodies and its terms: the delay of its effort, the effort of gravity by the
/// description, and the effort that was recorded.
const BEHIND: usize = 3;

impl JointEquations {
    pub(crate) fn new(joint: usize, bodies: Vec<usize>) -> Self {
        let columns = PARAMETERS * bodies.len() + JointUnknown::ALL.len() + BEHIND;
        Self {
            joint,
            bodies,
            blocks: vec![DMatrix::zeros(columns, columns); BLOCKS],
            counts: vec![0; BLOCKS],
        }
    }

    /// Rows in all blocks.
    pub fn rows(&self) -> usize {
        self.counts.iter().sum()
    }

    pub(crate) fn columns(&self) -> usize {
        self.blocks.first().map_or(0, DMatrix::ncols)
    }

    pub(crate) fn term_column(&self, term: JointUnknown) -> usize {
        PARAMETERS * self.bodies.len() + term as usize
    }

    pub(crate) fn delay_column(&self) -> usize {
        self.columns() - 3
    }

    pub(crate) fn gravity_column(&self) -> usize {
        self.columns() - 2
    }

    pub(crate) fn effort_column(&self) -> usize {
        self.columns() - 1
    }

    pub(crate) fn add(&mut self, block: usize, row: &DVector<f64>) {
        self.blocks[block].syger(1.0, row, row, 1.0);
        self.counts[block] += 1;
    }

    /// The sum of some blocks.
    pub(crate) fn sum(&self, is_taken: impl Fn(usize) -> bool) -> SummedRows {
        let mut gram = DMatrix::zeros(self.columns(), self.columns());
        let mut rows = 0;
        for (at, block) in self.blocks.iter().enumerate().filter(|(at, _)| is_taken(*at)) {
            gram += block;
            rows += self.counts[at];
        }
        // Only the lower triangle was added up.
        gram.fill_upper_triangle_with_lower_triangle();
        SummedRows { gram, rows }
    }

    /// The unknown of each column but those of gravity and of the effort.
    pub(crate) fn unknowns(&self, layout: &UnknownOrder, row: usize) -> Vec<usize> {
        let of_bodies = self.bodies.iter().flat_map(|&body| UnknownOrder::body(body));
        let of_terms = JointUnknown::ALL.iter().map(|&term| layout.term(row, term));
        of_bodies.chain(of_terms).chain(std::iter::once(layout.delay())).collect()
    }
}

/// The equations of all driven joints.
#[derive(Debug, Clone)]
pub struct RecordedEquations {
    pub(crate) layout: UnknownOrder,
    /// The unknowns as the description has them.
    pub(crate) nominal: DVector<f64>,
    /// One for each driven joint, in the order of the layout.
    pub joints: Vec<JointEquations>,
    /// Instants that the equations are made of.
    pub instants: usize,
}

impl RecordedEquations {
    pub(crate) fn new(tree: &BodyTree, joints: Vec<JointEquations>) -> Self {
        let layout = UnknownOrder { bodies: tree.dof(), joints: joints.iter().map(|of| of.joint).collect() };
        Self { nominal: layout.nominal(tree), layout, joints, instants: 0 }
    }

    /// The same equations with the effort of gravity added to the recorded one, of a robot that reports efforts without it.
    #[must_use]
    pub fn with_gravity_added(mut self) -> Self {
        for joint in &mut self.joints {
            let (gravity, effort) = (joint.gravity_column(), joint.effort_column());
            for block in &mut joint.blocks {
                block.fill_upper_triangle_with_lower_triangle();
                let column = block.column(gravity).into_owned();
                let mut changed = block.column_mut(effort);
                changed += column;
                let row = block.row(gravity).into_owned();
                let mut changed = block.row_mut(effort);
                changed += row;
            }
        }
        self
    }

    /// The same equations with the recorded effort of each driven joint multiplied by a factor.
    #[must_use]
    pub fn with_factors(mut self, factors: &[f64]) -> Self {
        for (joint, factor) in self.joints.iter_mut().zip(factors) {
            let scaled = [joint.effort_column(), joint.delay_column()];
            for block in &mut joint.blocks {
                for at in scaled {
                    let mut row = block.row_mut(at);
                    row *= *factor;
                    let mut column = block.column_mut(at);
                    column *= *factor;
                }
            }
        }
        self
    }
}
