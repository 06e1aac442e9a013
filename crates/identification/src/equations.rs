//! The equations of a recording: for each driven joint, the inner products of its columns in each block of the time.

use congruent_dynamics::{BodyTree, PARAMETERS};
use nalgebra::{DMatrix, DVector};

use crate::unknowns::{JointUnknown, UnknownOrder};

/// The blocks of time in which equations are added up: what one of them holds is left out together. Kind: choice; four of each fifth.
pub(crate) const BLOCKS: usize = 20;

/// Inner products of the columns of some rows.
#[derive(Debug, Clone)]
pub(crate) struct SummedRows {
    /// `C^T C`, symmetric; without what the noise of the efforts adds to the square of the column of the delay, or the delay would seem
    /// smaller than it is.
    pub(crate) gram: DMatrix<f64>,
    pub(crate) rows: usize,
    /// What the noise of the positions adds to the square of the column of the armature.
    pub(crate) armature_noise: f64,
    /// The part of the square of the column of the delay that is not noise.
    pub(crate) delay_signal: f64,
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
    /// What noise adds to the squares of the columns of armature and delay in each block.
    noise: Vec<[f64; 2]>,
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
            noise: vec![[0.0; 2]; BLOCKS],
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

    /// Adds a row, with the variances of its acceleration and of the derivative of its effort.
    pub(crate) fn add(&mut self, block: usize, row: &DVector<f64>, variances: [f64; 2]) {
        self.noise[block].iter_mut().zip(variances).for_each(|(sum, variance)| *sum += variance);
        self.blocks[block].syger(1.0, row, row, 1.0);
        self.counts[block] += 1;
    }

    /// Forgets all rows.
    fn clear(&mut self) {
        self.blocks.iter_mut().for_each(|block| block.fill(0.0));
        self.counts.fill(0);
        self.noise.fill([0.0; 2]);
    }

    /// The sum of some blocks.
    pub(crate) fn sum(&self, is_taken: impl Fn(usize) -> bool) -> SummedRows {
        let mut gram = DMatrix::zeros(self.columns(), self.columns());
        let mut rows = 0;
        let [mut armature_noise, mut delay_noise] = [0.0; 2];
        for (at, block) in self.blocks.iter().enumerate().filter(|(at, _)| is_taken(*at)) {
            gram += block;
            rows += self.counts[at];
            armature_noise += self.noise[at][0];
            delay_noise += self.noise[at][1];
        }
        // Only the lower triangle was added up.
        gram.fill_upper_triangle_with_lower_triangle();
        let at = self.delay_column();
        let whole = gram[(at, at)];
        gram[(at, at)] = (whole - delay_noise).max(0.0);
        let delay_signal = if whole > 0.0 { gram[(at, at)] / whole } else { 0.0 };
        SummedRows { gram, rows, armature_noise, delay_signal }
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
    /// Relative standard errors of the factors that made torques of the efforts.
    pub(crate) factor_errors: Vec<f64>,
}

impl RecordedEquations {
    pub(crate) fn new(tree: &BodyTree, joints: Vec<JointEquations>) -> Self {
        let layout = UnknownOrder { bodies: tree.dof(), joints: joints.iter().map(|of| of.joint).collect() };
        let factor_errors = vec![0.0; joints.len()];
        Self { nominal: layout.nominal(tree), layout, joints, instants: 0, factor_errors }
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

    /// The same equations with the recorded effort of each driven joint multiplied by a factor; a joint whose factor is not a number has no
    /// rows. `relative_errors` are those of the factors.
    #[must_use]
    pub fn with_factors(mut self, factors: &[f64], relative_errors: &[f64]) -> Self {
        self.factor_errors = relative_errors.to_vec();
        for (joint, factor) in self.joints.iter_mut().zip(factors) {
            let scaled = [joint.effort_column(), joint.delay_column()];
            if !factor.is_finite() {
                joint.clear();
                continue;
            }
            joint.noise.iter_mut().for_each(|noise| noise[1] *= factor * factor);
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
