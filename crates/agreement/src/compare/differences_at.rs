//! The differences of all sources at requested configurations.

use std::{cell::RefCell, fmt, sync::Arc};

use congruent_description::{JointValues, Places, RobotDescription, RobotQ, RobotQList};
use congruent_kinematics::{LinkPoses, PoseError};
use schemars::JsonSchema;
use serde::{Serialize, Serializer};

use super::{check_report::TipDifference, comparing::Comparing, error::CheckError};
use crate::source_pair::SourcePair;

/// The difference of the sources at one requested configuration.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct DifferenceAt {
    /// The configuration: every movable joint, rad or m.
    pub q: JointValues,
    /// The largest distance and the largest angle at a link that decides.
    #[serde(flatten)]
    pub error: PoseError,
    /// The tip by the sources of each pair that is compared, screws excepted.
    pub tip: Vec<TipDifference>,
}

/// The differences at requested configurations, each computed when it is read: memory does not grow with their number
/// except for the configurations themselves. It is serialised as the list of them.
pub struct DifferencesAt {
    configurations: Arc<RobotQList>,
    /// The comparisons with the robot's URDF: its table and the physics, then another description of the robot.
    compared: RefCell<Vec<(RobotDescription, Comparing<'static>)>>,
}

impl DifferencesAt {
    /// The differences of the robot's table, its URDF, and the physics if there is one.
    ///
    /// # Errors
    /// [`CheckError`] if table and robot do not fit together.
    pub fn new(
        description: &RobotDescription,
        physics: Option<Box<dyn LinkPoses>>,
        configurations: &Arc<RobotQList>,
    ) -> Result<Self, CheckError> {
        let own = (description.clone(), Comparing::new(description, physics)?);
        Ok(Self { configurations: configurations.clone(), compared: vec![own].into() })
    }

    /// Adds the differences from another source of the poses of all links, as [`CheckReport::add_other`] does.
    ///
    /// # Errors
    /// As [`DifferencesAt::new`].
    ///
    /// [`CheckReport::add_other`]: super::CheckReport::add_other
    pub fn with_other(
        self,
        description: &RobotDescription,
        other: Box<dyn LinkPoses>,
    ) -> Result<Self, CheckError> {
        let urdf = without_table(description);
        let comparing = Comparing::new(&urdf, Some(other))?;
        self.compared.borrow_mut().push((urdf, comparing));
        Ok(self)
    }

    /// The number of requested configurations.
    pub fn len(&self) -> usize {
        self.configurations.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The differences at all requested configurations, in their order.
    ///
    /// # Panics
    /// If a source rejects a configuration; [`check`](super::check) has evaluated all of them before.
    pub fn iter(&self) -> impl Iterator<Item = DifferenceAt> + '_ {
        self.configurations.iter().map(|q| self.at(&q))
    }

    fn at(&self, q: &RobotQ) -> DifferenceAt {
        let mut compared = self.compared.borrow_mut();
        let (mut error, mut tip) = (PoseError::default(), Vec::new());
        for (index, (description, comparing)) in compared.iter_mut().enumerate() {
            error =
                error.larger(comparing.observe(0, q).expect("the check has evaluated this configuration"));
            let tips = comparing.tips(description).into_iter();
            tip.extend(tips.map(|tip| match index {
                0 => tip,
                _ => TipDifference { pair: SourcePair::UrdfOther, ..tip },
            }));
        }
        DifferenceAt { q: JointValues::for_movable_joints(&compared[0].0.robot, q), error, tip }
    }
}

/// The robot as its URDF alone describes it, for a comparison with another source of link poses.
pub(super) fn without_table(description: &RobotDescription) -> RobotDescription {
    let places = Places { robot_file: None, ..description.places.clone() };
    RobotDescription { dh: None, places, ..description.clone() }
}

impl Serialize for DifferencesAt {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.iter())
    }
}

impl fmt::Debug for DifferencesAt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("DifferencesAt").field("len", &self.len()).finish_non_exhaustive()
    }
}
