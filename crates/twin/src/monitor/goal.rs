//! The goal: at the end of the scenario the tool centre point of the twin is where it ought to be. A
//! run that ends before its time has not come to it, and the check is skipped.

use congruent_description::{Diagnostic, LinkIndex, RobotDescription, WrittenTransform};
use congruent_kinematics::{Pose, PoseError};
use nalgebra::Isometry3;
use serde::Deserialize;
use toml::Spanned;

use super::{Findings, Monitor, Names, watch::Watch};
use crate::{
    sample::Sample,
    scenario::{Positive, Section},
    verdict::Bound,
};

pub(super) const NAME: &str = "goal";

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {
    tcp: Spanned<WrittenTransform>,
    position_m: Positive,
    orientation_rad: Option<Positive>,
}

struct Goal {
    written: WrittenTransform,
    world_from_target: Pose,
    tip: LinkIndex,
    tip_from_tcp: Isometry3<f64>,
    position: (Watch, f64),
    /// Where a rotation is asked for.
    orientation: Option<(Watch, f64)>,
    samples: u64,
}

/// A pose needs both tolerances, a position one.
pub(super) fn parse(
    section: Section<'_>,
    description: &RobotDescription,
) -> Result<Box<dyn Monitor>, Vec<Diagnostic>> {
    let Written { tcp, position_m, orientation_rad } = section.read()?;
    let span = tcp.span();
    let written = tcp.into_inner();
    let at_goal = |mut error: Diagnostic| {
        error.span.get_or_insert_with(|| span.clone());
        error
    };
    let world_from_target = Pose::from(written.isometry().map_err(at_goal)?);
    if written.has_rotation() != orientation_rad.is_some() {
        let message = if written.has_rotation() {
            "the goal has a rotation and no `orientation_rad` that it is held to"
        } else {
            "`orientation_rad` holds to a rotation, and the goal has none"
        };
        return Err(Diagnostic::error("scenario::goal", message)
            .with_help("give both for a pose, neither for a position")
            .at(span)
            .into());
    }
    let watch = |quantity, unit, limit: Positive| {
        (Watch::new(quantity, unit, Bound::AtMost, limit.get(), description.robot.dof()), limit.get())
    };
    Ok(Box::new(Goal {
        written,
        world_from_target,
        tip: description.tip,
        tip_from_tcp: description.tip_from_tcp.unwrap_or_else(Isometry3::identity),
        position: watch("position", "m", position_m),
        orientation: orientation_rad.map(|limit| watch("orientation", "rad", limit)),
        samples: 0,
    }))
}

impl Monitor for Goal {
    fn observe(&mut self, sample: &mut Sample<'_>) {
        if !sample.is_last {
            return;
        }
        self.samples += 1;
        let world_from_tcp = sample.twin[self.tip.get()] * self.tip_from_tcp;
        let PoseError { position_m, orientation_rad } =
            PoseError::to_isometry(&self.world_from_target, &world_from_tcp);
        self.position.0.observe(position_m, self.tip.get(), sample);
        if let Some((watch, _)) = &mut self.orientation {
            watch.observe(orientation_rad, self.tip.get(), sample);
        }
    }

    fn finish(&self, names: &Names) -> Findings {
        let watches = std::iter::once(&self.position).chain(&self.orientation);
        let measure =
            |(watch, _): &(Watch, f64)| watch.measure(&names.joints, |link| names.links[link].clone());
        Findings { samples: self.samples, measures: watches.map(measure).collect(), notes: Vec::new() }
    }

    fn has_failed(&self) -> bool {
        std::iter::once(&self.position).chain(&self.orientation).any(|(watch, _)| watch.is_violated())
    }

    fn resolved(&self) -> toml::Table {
        let mut table = toml::Table::new();
        table.insert("tcp".to_owned(), self.written.to_table().into());
        table.insert("position_m".to_owned(), self.position.1.into());
        if let Some((_, orientation_rad)) = self.orientation {
            table.insert("orientation_rad".to_owned(), orientation_rad.into());
        }
        table
    }
}
