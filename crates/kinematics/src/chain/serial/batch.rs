//! Many configurations of one chain at once: the steps of `chain.rs` taken by several
//! configurations side by side, in the widest vector instructions that the machine has. Sums and
//! products are those of one configuration alone, in the same order, so the width changes no bit.

#![expect(clippy::inline_always, reason = "what is not inlined is compiled for the narrowest vectors")]

use nalgebra::Vector3;
use pulp::{Arch, Simd, WithSimd};

use super::chain::{SerialChain, SerialRow};
use crate::{
    chain::{
        axes::Axes,
        sin_cos::{SinCos, SinesCosines},
    },
    error::KinematicsError,
    spatial::pose::Pose,
};

/// Configurations that step together: two vectors of AVX2, enough to hide the latency of a sum.
const LANES: usize = 8;

/// One number of each configuration.
type LaneValues = [f64; LANES];

impl SerialChain {
    /// Poses of the tip in the base at many configurations, bit for bit those of
    /// [`SerialChain::base_from_tip`].
    ///
    /// | value | shape | unit | frame |
    /// |---|---|---|---|
    /// | `configurations` | m x n, one after another | rad, m | joints of the chain, base to tip |
    /// | `base_from_tips` | m | m | `base_from_tip` of each |
    ///
    /// # Errors
    /// [`KinematicsError::JointCount`] when there are not n positions for each pose.
    /// # Examples
    /// ```
    /// use congruent_kinematics::{Pose, ScrewChain, SerialChain, Twist};
    /// use nalgebra::Vector3;
    /// let joint = |y: f64| Twist { angular: Vector3::z(), linear: Vector3::new(0., y, 0.) };
    /// let chain = SerialChain::from_screws(&ScrewChain {
    ///     twists_in_base: vec![joint(0.0), joint(-0.6)],
    ///     base_from_tip_at_zero: Pose { translation: Vector3::new(1.0, 0.0, 0.0), ..Pose::identity() },
    /// });
    /// let configurations = [[0.0, 0.0], [0.3, -0.7], [1.0, 2.0]];
    /// let mut base_from_tips = [Pose::identity(); 3];
    /// chain.base_from_tips_into(configurations.as_flattened(), &mut base_from_tips)?;
    /// assert_eq!(base_from_tips[1], chain.base_from_tip(&configurations[1].into())?);
    /// # Ok::<(), congruent_kinematics::KinematicsError>(())
    /// ```
    pub fn base_from_tips_into(
        &self,
        configurations: &[f64],
        base_from_tips: &mut [Pose],
    ) -> Result<(), KinematicsError> {
        let n = self.joint_count();
        KinematicsError::check_joints(n * base_from_tips.len(), configurations)?;
        // Full groups of lanes in vectors; the rest one by one, with the same sums in the same order.
        let (groups, rest) = base_from_tips.as_chunks_mut::<LANES>();
        let (together, alone) = configurations.split_at(n * LANES * groups.len());
        // Chosen at run time by what the processor has, so that one build serves all.
        Arch::new().dispatch(Groups { chain: self, configurations: together, base_from_tips: groups });
        for (at, base_from_tip) in rest.iter_mut().enumerate() {
            *base_from_tip = self.base_from_tip_at(&alone[n * at..][..n]);
        }
        Ok(())
    }
}

/// The configurations that fill all lanes.
struct Groups<'a> {
    chain: &'a SerialChain,
    configurations: &'a [f64],
    base_from_tips: &'a mut [[Pose; LANES]],
}

impl WithSimd for Groups<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { chain, configurations, base_from_tips } = self;
        let n = chain.joint_count();
        for (at, base_from_tips) in base_from_tips.iter_mut().enumerate() {
            let configurations = &configurations[n * LANES * at..][..n * LANES];
            let mut axes = LaneAxes::repeat(&chain.base_from_first);
            for (joint, row) in chain.rows.iter().enumerate() {
                axes.step(row, &std::array::from_fn(|lane| configurations[lane * n + joint]));
            }
            for (lane, base_from_tip) in base_from_tips.iter_mut().enumerate() {
                *base_from_tip = axes.lane(lane).turned_about_z(chain.last).pose();
            }
        }
    }
}

/// [`Axes`] of each configuration, entry by entry.
struct LaneAxes {
    x: [LaneValues; 3],
    y: [LaneValues; 3],
    z: [LaneValues; 3],
    origin: [LaneValues; 3],
}

impl LaneAxes {
    #[inline(always)]
    fn repeat(axes: &Axes) -> Self {
        let in_all = |v: &Vector3<f64>| [[v.x; LANES], [v.y; LANES], [v.z; LANES]];
        Self { x: in_all(&axes.x), y: in_all(&axes.y), z: in_all(&axes.z), origin: in_all(&axes.origin) }
    }

    #[inline(always)]
    fn lane(&self, lane: usize) -> Axes {
        let of = |v: &[LaneValues; 3]| Vector3::new(v[0][lane], v[1][lane], v[2][lane]);
        Axes { x: of(&self.x), y: of(&self.y), z: of(&self.z), origin: of(&self.origin) }
    }

    /// Times `Rz(theta) T(shift) Rx(alpha)` of the row at the joint's positions.
    #[inline(always)]
    fn step(&mut self, row: &SerialRow, q: &LaneValues) {
        let SinesCosines { sin, cos } =
            SinesCosines::from_angles(q.map(|q| row.theta_rad + row.theta_per_q * q));
        let d_m = q.map(|q| row.shift.z + row.d_per_q * q);
        let SinCos { sin: sin_alpha, cos: cos_alpha } = row.alpha;
        // The products and sums of `Axes` in the same order, without fused ones: each lane then has the bits of a
        // single evaluation.
        for entry in 0..3 {
            for lane in 0..LANES {
                let (x, y, z) = (self.x[entry][lane], self.y[entry][lane], self.z[entry][lane]);
                let (x, y) = (x * cos[lane] + y * sin[lane], y * cos[lane] - x * sin[lane]);
                self.origin[entry][lane] += x * row.shift.x + y * row.shift.y + z * d_m[lane];
                self.x[entry][lane] = x;
                self.y[entry][lane] = y * cos_alpha + z * sin_alpha;
                self.z[entry][lane] = z * cos_alpha - y * sin_alpha;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::support;

    proptest! {
        #![proptest_config(support::cases())]

        /// Also beyond full groups, and if one angle of a group is too large for the quick sine.
        #[test]
        fn a_batch_is_its_configurations_one_by_one(
            figures in support::table_figures(), q in proptest::collection::vec(support::positions(), 0..20),
            far in any::<prop::sample::Index>(),
        ) {
            let robot = figures.robot();
            let chain = SerialChain::from_dh(&figures.table(&robot), &robot);
            let mut configurations: Vec<f64> =
                q.iter().flat_map(|q| q.of_joints(chain.joint_count())).copied().collect();
            if !configurations.is_empty() {
                configurations[far.index(q.len())] = 1e9;
            }
            let mut base_from_tips = vec![Pose::identity(); q.len()];
            chain.base_from_tips_into(&configurations, &mut base_from_tips).unwrap();
            for (found, q) in base_from_tips.iter().zip(configurations.chunks(chain.joint_count())) {
                prop_assert_eq!(found, &chain.base_from_tip(&q.into()).unwrap());
            }
        }
    }

    #[test]
    fn a_chain_without_joints_and_a_wrong_length() {
        let robot = support::robot(Vec::new());
        let chain = SerialChain::from_urdf(&robot, robot.root(), robot.root());
        let mut base_from_tips = [Pose::from_parts(nalgebra::Matrix3::zeros(), Vector3::zeros()); LANES + 1];
        chain.base_from_tips_into(&[], &mut base_from_tips).unwrap();
        assert_eq!(base_from_tips, [Pose::identity(); LANES + 1]);
        let refused = chain.base_from_tips_into(&[0.0], &mut base_from_tips);
        assert_eq!(refused, Err(KinematicsError::JointCount { expected: 0, found: 1 }));
    }
}
