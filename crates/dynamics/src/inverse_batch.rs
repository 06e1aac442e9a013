//! Inverse dynamics of many samples at once: the algorithm of `inverse.rs` for several samples side by side, in the widest
//! vector instructions of the machine.

#![expect(clippy::inline_always, reason = "what is not inlined is compiled for the narrowest vectors")]

use congruent_kinematics::SinCos;
use pulp::{Arch, Simd, WithSimd};

use crate::{
    algebra::lanes::{LANES, LaneVector, Lanes, lanes},
    body_tree::{BodyTree, TreeBody},
    error::DynamicsError,
    spatial_inertia::SpatialInertia,
};

/// Motions of many samples, one sample after another.
///
/// | field | shape | unit |
/// |---|---|---|
/// | `q` | m x dof | rad, m |
/// | `qd` | m x dof | rad/s, m/s |
/// | `qdd` | m x dof | rad/s^2, m/s^2 |
#[derive(Debug, Clone, Copy)]
pub struct JointMotions<'a> {
    /// Joint positions, rad or m, one sample after another.
    pub q: &'a [f64],
    /// Joint speeds, rad/s or m/s, one sample after another.
    pub qd: &'a [f64],
    /// Joint accelerations, rad/s^2 or m/s^2, one sample after another.
    pub qdd: &'a [f64],
}

/// Intermediate values of a batch: [`BodyTree::batch_buffer`] makes it, and no call allocates after that.
#[derive(Debug, Clone)]
pub struct BatchBuffer {
    bodies: Vec<BodyLanes>,
}

/// Motion and wrench of one body in all lanes.
#[derive(Debug, Clone, Copy)]
struct BodyLanes {
    sin: Lanes,
    cos: Lanes,
    /// In the parent's frame.
    origin: LaneVector,
    motion: MotionLanes,
    moment: LaneVector,
    force: LaneVector,
}

#[derive(Debug, Clone, Copy)]
struct MotionLanes {
    angular_velocity: LaneVector,
    angular: LaneVector,
    linear: LaneVector,
}

impl BodyLanes {
    const NONE: Self = Self {
        sin: [0.0; LANES],
        cos: [1.0; LANES],
        origin: LaneVector::ZERO,
        motion: MotionLanes {
            angular_velocity: LaneVector::ZERO,
            angular: LaneVector::ZERO,
            linear: LaneVector::ZERO,
        },
        moment: LaneVector::ZERO,
        force: LaneVector::ZERO,
    };
}

impl BodyTree {
    /// A buffer for batches of this robot.
    pub fn batch_buffer(&self) -> BatchBuffer {
        BatchBuffer { bodies: vec![BodyLanes::NONE; self.dof()] }
    }

    /// Torques of many motions, as [`BodyTree::inverse_into`] gives them one by one, to rounding.
    ///
    /// | value | shape | unit |
    /// |---|---|---|
    /// | `motions` | m x dof each, one sample after another | rad, m and s |
    /// | `tau` | m x dof | N m, N |
    ///
    /// # Errors
    /// [`DynamicsError::Length`] if the vectors do not hold as many numbers as `tau`, if these are not a number for each
    /// moving joint of each sample, or if the buffer is another robot's.
    pub fn inverse_many_into(
        &self,
        motions: &JointMotions<'_>,
        buffer: &mut BatchBuffer,
        tau: &mut [f64],
    ) -> Result<(), DynamicsError> {
        let n = self.dof();
        if buffer.bodies.len() != n {
            let found = buffer.bodies.len();
            return Err(DynamicsError::Length { what: "buffer", expected: n, found });
        }
        // The largest whole number of samples that fits: a rest of `tau` then shows as a wrong length.
        let expected = tau.len().checked_div(n).unwrap_or(0) * n;
        DynamicsError::check("torques", expected, tau)?;
        DynamicsError::check("positions", expected, motions.q)?;
        DynamicsError::check("speeds", expected, motions.qd)?;
        DynamicsError::check("accelerations", expected, motions.qdd)?;
        Arch::new().dispatch(BatchPass { tree: self, motions, buffer, tau });
        Ok(())
    }
}

/// All samples, compiled for the widest vector instructions of the machine.
struct BatchPass<'a> {
    tree: &'a BodyTree,
    motions: &'a JointMotions<'a>,
    buffer: &'a mut BatchBuffer,
    tau: &'a mut [f64],
}

impl WithSimd for BatchPass<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { tree, motions, buffer, tau } = self;
        let n = tree.dof();
        if n == 0 {
            return;
        }
        for (group, tau) in tau.chunks_mut(n * LANES).enumerate() {
            // The last group may have fewer samples than lanes.
            let samples = tau.len() / n;
            let first = group * LANES * n;
            let group = Group { tree, samples, first, bodies: &mut buffer.bodies };
            group.run(motions, tau);
        }
    }
}

/// Samples that fill the lanes, or fewer: the rest of the lanes repeats the first one.
struct Group<'a> {
    tree: &'a BodyTree,
    samples: usize,
    first: usize,
    bodies: &'a mut [BodyLanes],
}

impl Group<'_> {
    #[inline(always)]
    fn joint_lanes(&self, numbers: &[f64], joint: usize) -> Lanes {
        let n = self.tree.dof();
        let numbers = &numbers[self.first..][..self.samples * n];
        // Lanes without a sample repeat the first one: their results are never read.
        lanes(|lane| numbers[if lane < self.samples { lane * n } else { 0 } + joint])
    }

    #[inline(always)]
    fn run(mut self, motions: &JointMotions<'_>, tau: &mut [f64]) {
        for joint in 0..self.tree.dof() {
            self.carry(joint, motions);
        }
        for joint in (0..self.tree.dof()).rev() {
            self.take_up(joint, motions, tau);
        }
    }

    /// Outwards: the motion of a body from its parent's, and the wrench that this motion requires.
    #[inline(always)]
    fn carry(&mut self, joint: usize, motions: &JointMotions<'_>) {
        let body = &self.tree.bodies[joint];
        let (q, qd) = (self.joint_lanes(motions.q, joint), self.joint_lanes(motions.qd, joint));
        let qdd = self.joint_lanes(motions.qdd, joint);
        // As in `move_bodies`: the root accelerates upwards in place of gravity.
        let parent = body.parent.map_or_else(
            || MotionLanes {
                linear: LaneVector::splat(&-self.tree.gravity_in_root),
                ..BodyLanes::NONE.motion
            },
            |parent| self.bodies[parent].motion,
        );
        let lanes = &mut self.bodies[joint];
        lanes.place(body, &q);
        lanes.motion = lanes.carried(body, &parent, &qd, &qdd);
        (lanes.moment, lanes.force) = wrench(&body.spatial_inertia, &lanes.motion);
    }

    /// Inwards: the torque of a joint, and the wrench of its body on the parent.
    #[inline(always)]
    fn take_up(&mut self, joint: usize, motions: &JointMotions<'_>, tau: &mut [f64]) {
        let (n, body) = (self.tree.dof(), &self.tree.bodies[joint]);
        let resistance = &self.tree.resistances[joint];
        // A parent always has a smaller index, so both bodies can be borrowed at once.
        let (before, from) = self.bodies.split_at_mut(joint);
        let from = &from[0];
        let along = if body.frame.turns { &from.moment.0[2] } else { &from.force.0[2] };
        for (sample, tau) in tau.chunks_exact_mut(n).enumerate() {
            let at = self.first + sample * n + joint;
            tau[joint] = along[sample]
                + resistance.against_speed(motions.qd[at])
                + resistance.armature * motions.qdd[at];
        }
        let Some(parent) = body.parent else { return };
        let force = from.in_parent(body, &from.force);
        let parent = &mut before[parent];
        parent.moment = parent.moment + from.in_parent(body, &from.moment) + from.origin.cross(&force);
        parent.force = parent.force + force;
    }
}

impl BodyLanes {
    #[inline(always)]
    fn place(&mut self, body: &TreeBody, q: &Lanes) {
        let origin = &body.parent_from_body.translation;
        if body.frame.turns {
            let mut turns = [SinCos { sin: 0.0, cos: 1.0 }; LANES];
            SinCos::from_angles_into(q, &mut turns);
            self.sin = lanes(|lane| turns[lane].sin);
            self.cos = lanes(|lane| turns[lane].cos);
            self.origin = LaneVector::splat(origin);
        } else {
            // Its sine and cosine stay those of the empty buffer: no turn.
            let axis = body.parent_from_body.rotation.column(2);
            let [ox, oy, oz] = [origin.x, origin.y, origin.z];
            self.origin = LaneVector([
                lanes(|lane| ox + axis[0] * q[lane]),
                lanes(|lane| oy + axis[1] * q[lane]),
                lanes(|lane| oz + axis[2] * q[lane]),
            ]);
        }
    }

    /// A vector of the body in the axes of its parent.
    #[inline(always)]
    fn in_parent(&self, body: &TreeBody, v: &LaneVector) -> LaneVector {
        v.turned_about_z(&self.sin, &self.cos).turned_by(&body.parent_from_body.rotation)
    }

    /// A vector of the parent in the axes of the body.
    #[inline(always)]
    fn in_body(&self, body: &TreeBody, v: &LaneVector) -> LaneVector {
        v.turned_back_by(&body.parent_from_body.rotation).turned_back_about_z(&self.sin, &self.cos)
    }

    /// Source: Luh, Walker, Paul (1980), with the acceleration of the point at the frame's origin.
    #[inline(always)]
    fn carried(&self, body: &TreeBody, parent: &MotionLanes, qd: &Lanes, qdd: &Lanes) -> MotionLanes {
        let turning = parent.angular_velocity;
        let linear =
            parent.linear + parent.angular.cross(&self.origin) + turning.cross(&turning.cross(&self.origin));
        let mut angular_velocity = self.in_body(body, &turning);
        let (mut angular, mut linear) = (self.in_body(body, &parent.angular), self.in_body(body, &linear));
        // The angular velocity times the joint's own motion, which is along z.
        let [x, y, _] = &angular_velocity.0;
        let crossed =
            LaneVector([lanes(|lane| y[lane] * qd[lane]), lanes(|lane| -x[lane] * qd[lane]), [0.0; LANES]]);
        if body.frame.turns {
            angular = (angular + crossed).plus_z(qdd);
            angular_velocity = angular_velocity.plus_z(qd);
        } else {
            linear = (linear + crossed.times(2.0)).plus_z(qdd);
        }
        MotionLanes { angular_velocity, angular, linear }
    }
}

/// The moment and the force that give a body this motion.
#[inline(always)]
fn wrench(inertia: &SpatialInertia, motion: &MotionLanes) -> (LaneVector, LaneVector) {
    let MotionLanes { angular_velocity: turning, angular, linear } = motion;
    let h = LaneVector::splat(&inertia.first_moment_kg_m);
    let tensor = &inertia.tensor_kg_m2;
    let moment = angular.turned_by(tensor) + h.cross(linear) + turning.cross(&turning.turned_by(tensor));
    let force = linear.times(inertia.mass_kg) - h.cross(angular) + turning.cross(&turning.cross(&h));
    (moment, force)
}
