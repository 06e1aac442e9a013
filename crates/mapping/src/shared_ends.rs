//! Roots and tips that two descriptions may share: links of one name near the root, and the ends of the chains.

use congruent_description::{LinkIndex, Robot};
use nalgebra::Isometry3;

use crate::find::Both;

impl Both<'_> {
    /// Where the other root may be in this one: by links near the root that have one name in both, and the same frame.
    pub(crate) fn shared_roots(&self) -> Vec<Isometry3<f64>> {
        let (a, b) = (&self.a.robot, &self.b.robot);
        let is_still = |robot: &Robot, link: LinkIndex| robot.body(link) == robot.root();
        let shared = a.link_indices().filter(|&link| is_still(a, link)).filter_map(|link| {
            let there = b.find_link(&a.link(link).name).filter(|&there| is_still(b, there))?;
            Some(self.home(0, link) * self.home(1, there).inverse())
        });
        let mut roots: Vec<Isometry3<f64>> = Vec::new();
        for root in shared.chain([Isometry3::identity()]) {
            let is_known = |known: &Isometry3<f64>| {
                let off = known.inverse() * root;
                off.translation.vector.norm() + off.rotation.angle() < 1e-9
            };
            if !roots.iter().any(is_known) {
                roots.push(root);
            }
        }
        roots
    }

    /// Poses of the tips of both chains, whatever they are called, if they are the ends of the same joints.
    pub(crate) fn both_tips(&self) -> [Isometry3<f64>; 2] {
        [self.home(0, self.a.tip), self.home(1, self.b.tip)]
    }

    /// Poses of the tips in their roots, if both tips have one name.
    pub(crate) fn shared_tips(&self) -> Option<[Isometry3<f64>; 2]> {
        self.tips_of(self.a.tip, &self.a.robot.link(self.a.tip).name)
    }

    /// Poses of a link and of the one of this name in the other description.
    pub(crate) fn tips_of(&self, link: LinkIndex, there: &str) -> Option<[Isometry3<f64>; 2]> {
        Some([self.home(0, link), self.home(1, self.b.robot.find_link(there)?)])
    }

    /// Pose of a link in its root at zero.
    fn home(&self, of: usize, link: LinkIndex) -> Isometry3<f64> {
        self.screws[of].home(link).to_isometry()
    }
}
