//! Many configurations of one robot in little memory.

use std::ops::Range;

use super::RobotQ;

/// Configurations of one robot, one after the other: 8 bytes for each value.
///
/// # Examples
/// ```
/// use congruent_description::{RobotQ, RobotQList};
/// let mut list = RobotQList::new(2);
/// list.push(&[0.1, 0.2]);
/// list.push(&[0.3, 0.4]);
/// assert_eq!(list.iter().collect::<Vec<RobotQ>>(), [[0.1, 0.2].into(), [0.3, 0.4].into()]);
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct RobotQList(Rows);

impl RobotQList {
    /// An empty list for a robot with this number of movable joints.
    pub fn new(joints: usize) -> Self {
        Self(Rows::new(joints))
    }

    /// Adds a configuration at the end.
    ///
    /// # Panics
    /// If it has not one value for each movable joint.
    pub fn push(&mut self, q: &[f64]) {
        self.0.push(q);
    }

    /// Number of configurations.
    pub fn len(&self) -> usize {
        self.0.count
    }

    /// Whether the list has no configuration.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The configuration with this index, from 0; `None` beyond the end.
    pub fn get(&self, index: usize) -> Option<RobotQ> {
        (index < self.len()).then(|| RobotQ::from(self.0.row(index)))
    }

    /// All configurations in the order in which they were added.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = RobotQ> + Clone + '_ {
        (0..self.len()).map(|index| RobotQ::from(self.0.row(index)))
    }
}

impl From<&RobotQ> for RobotQList {
    fn from(q: &RobotQ) -> Self {
        let mut list = Self::new(q.len());
        list.push(q);
        list
    }
}

/// Rows of equally many values. The leading rows that are zero throughout take no memory: torques and accelerations are often
/// zero in the whole file.
#[derive(Debug, Clone, PartialEq, Default)]
struct Rows {
    width: usize,
    count: usize,
    /// Rows of zeros at the beginning, which are not stored.
    leading: usize,
    zeros: Vec<f64>,
    values: Vec<f64>,
}

impl Rows {
    fn new(width: usize) -> Self {
        Self { width, zeros: vec![0.0; width], ..Self::default() }
    }

    fn push(&mut self, row: &[f64]) {
        assert_eq!(row.len(), self.width, "one value for each movable joint");
        self.count += 1;
        // By bits, since a row with -0.0 must be read back as -0.0.
        if self.values.is_empty() && row.iter().all(|value| value.to_bits() == 0) {
            self.leading += 1;
        } else {
            self.values.extend_from_slice(row);
        }
    }

    fn row(&self, index: usize) -> &[f64] {
        let place = |at: usize| -> Range<usize> { at * self.width..(at + 1) * self.width };
        index.checked_sub(self.leading).map_or(&self.zeros[..], |stored| &self.values[place(stored)])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_what_was_pushed() {
        let rows = [[0.0, 0.0], [0.0, 0.0], [0.0, -0.0], [0.0, 0.0], [1.0, f64::MIN_POSITIVE]];
        for skipped in 0..rows.len() {
            let mut list = RobotQList::new(2);
            rows[skipped..].iter().for_each(|row| list.push(row));
            let bits = |row: &[f64]| row.iter().map(|value| value.to_bits()).collect::<Vec<_>>();
            let read: Vec<_> = list.iter().map(|q| bits(&q)).collect();
            assert_eq!(read, rows[skipped..].iter().map(|row| bits(row)).collect::<Vec<_>>());
            assert_eq!((list.len(), list.get(list.len())), (rows.len() - skipped, None));
        }
    }

    #[test]
    fn a_robot_without_joints_has_configurations() {
        let mut list = RobotQList::new(0);
        list.push(&[]);
        list.push(&[]);
        assert_eq!(list.iter().collect::<Vec<_>>(), [RobotQ::zeros(0), RobotQ::zeros(0)]);
    }
}
