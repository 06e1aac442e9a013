//! The mapping that a robot file declares.

use std::collections::BTreeSet;

use congruent_description::{DeclaredMapping, JointIndex, RobotDescription};
use congruent_input::known_names;

use crate::{
    find::{Both, FoundMapping, MatchedBy},
    names::{JointPairs, is_alike},
    variables::{ChainPair, JointVariable},
};

/// The joints of `b` in the variables of `a` as a robot file declares them; joints that it does not name have the same name
/// and variable.
///
/// # Errors
/// A joint that `b` lacks, that slides in one of the two and turns in the other, or that is meant twice.
pub fn declared(
    a: &RobotDescription,
    b: &RobotDescription,
    mapping: &DeclaredMapping,
) -> Result<FoundMapping, String> {
    let both = Both::new(a, b);
    let mut pairs: JointPairs = Vec::new();
    let mut known = Vec::new();
    for &index in a.robot.movable_joints() {
        let name = &a.robot.joint(index).name;
        if mapping.left_out.contains(name) {
            continue;
        }
        let written = mapping.joints.iter().find(|of| of.joint == *name);
        let there = written.map_or(name, |of| &of.there);
        let found = b.robot.find_joint(there).filter(|&found| b.robot.joint(found).kind.is_movable());
        let Some(found) = found else {
            if written.is_some() {
                let names = known_names(there, "moving joints", b.robot.movable_joint_names());
                return Err(format!("{} has no moving joint \"{there}\"; {names}", b.path.display()));
            }
            continue;
        };
        if !is_alike([&a.robot, &b.robot], [index, found]) {
            return Err(format!("joint \"{name}\" turns in one description and slides in the other"));
        }
        if pairs.iter().any(|pair| pair[1] == found) {
            return Err(format!("two joints are \"{there}\" in {}", b.path.display()));
        }
        pairs.push([index, found]);
        let variable = written.map(|of| JointVariable { is_flipped: of.is_flipped, offset: of.offset });
        known.push(variable.unwrap_or_default());
    }
    both.with_known(&pairs, &known, mapping).ok_or_else(|| "no joint moves in both".to_owned())
}

impl Both<'_> {
    /// The mapping of these pairs with the variables that are known.
    fn with_known(
        &self,
        pairs: &JointPairs,
        known: &[JointVariable],
        mapping: &DeclaredMapping,
    ) -> Option<FoundMapping> {
        let base = self.shared_roots()[0];
        let of_chain = self.a.moving_chain();
        let is_of_chain = |pair: &&[JointIndex; 2]| of_chain.contains(&pair[0]);
        let chain: JointPairs = pairs.iter().filter(is_of_chain).copied().collect();
        let variable = |pair: &[JointIndex; 2]| {
            pairs.iter().zip(known).find(|(of, _)| *of == pair).map(|(_, variable)| *variable)
        };
        let fitted = || {
            let known = chain.iter().map(variable).collect();
            ChainPair { known, ..self.chain_pair(&chain, None, None) }
                .with_base_at_first_axes(self.shared_tips())
        };
        let as_declared = || {
            let known: Vec<JointVariable> = chain.iter().filter_map(variable).collect();
            self.chain_pair(&chain, Some(base), None).judged(&base, &known)
        };
        let solution = if mapping.has_fitted_base { fitted() } else { as_declared() };
        let mapped = pairs.iter().zip(known).map(|(pair, variable)| self.in_variable(*pair, *variable));
        let mapped = mapped.collect::<Vec<_>>();
        (!pairs.is_empty()).then(|| FoundMapping {
            joints: mapped,
            matched_by: MatchedBy::Declared,
            unmatched: self.unmatched(pairs),
            root_from_other_root: solution.as_ref().map_or(base, |solution| solution.a_from_b),
            has_fitted_base: mapping.has_fitted_base,
            misplaced: BTreeSet::new(),
            angle_rad: solution.as_ref().map_or(0.0, |solution| solution.angle_rad),
            distance_m: solution.as_ref().map_or(0.0, |solution| solution.distance_m),
            equivalent: Vec::new(),
        })
    }
}
