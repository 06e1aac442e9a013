//! The checked description of a robot: URDF, chain, table, dynamics, tool and tolerance. Every command starts from it.

use std::{
    collections::{BTreeMap, BTreeSet},
    path::{Path, PathBuf},
    sync::Arc,
};

use congruent_input::{Capability, Diagnostic, Findings, InputFile, display::first_of, known_names};
use congruent_robot::{
    DeclaredTolerances, DhTable, JointIndex, LinkIndex, RequestedTolerance, Robot, Tolerance, WrittenNames,
};
use nalgebra::Isometry3;

use crate::{
    chain::{ChainEnd, ChainEnds, ReportedChain, choose_tip},
    codes,
    mjcf::MjcfPlaces,
    own_model::{OwnModelForm, OwnModelPlaces, without_bodies},
    parameter_places::ParameterPlaces,
    robot_file::{
        DeclaredMapping, DeclaredReference, DynamicsTable, InertialPlaces, RobotFilePlaces, joint_for_link,
    },
    tolerance_scale::ToleranceScale,
    urdf::UrdfPlaces,
};

/// The texts that a description was read from. Messages show lines of these texts, even if the files have changed since.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Places {
    /// The robot file with its table; `None` if there is no table, or none of this chain.
    pub robot_file: Option<Arc<RobotFilePlaces>>,
    /// The robot file with its `[[inertial]]` entries; `None` if there are none.
    pub inertials: Option<Arc<InertialPlaces>>,
    /// The URDF; `None` if the robot was made without one.
    pub urdf: Option<UrdfPlaces>,
    /// The MJCF with the files that it includes; `None` if the robot was made without one.
    pub mjcf: Option<MjcfPlaces>,
    /// The robot file whose table or screws are the robot; `None` if the robot is that of a URDF or an MJCF.
    pub own_model: Option<Arc<OwnModelPlaces>>,
}

impl Places {
    /// Where the URDF or the MJCF writes parameters of links and joints.
    pub fn parameters(&self) -> Option<&dyn ParameterPlaces> {
        let urdf = self.urdf.as_ref().map(|places| places as &dyn ParameterPlaces);
        urdf.or_else(|| self.mjcf.as_ref().map(|places| places as &dyn ParameterPlaces))
    }

    /// The places of a robot that has been rewritten in other variables: the names of its joints and links in the URDF or the
    /// MJCF by those that they have. What the file writes of a joint is then no value of the robot.
    #[must_use]
    pub fn of_rewritten(self, joints: &BTreeMap<String, String>, links: &BTreeMap<String, String>) -> Self {
        self.with_names(|names| names.rewritten(joints.clone(), links.clone()))
    }

    /// The same without places of these links, whose values no element of the URDF or the MJCF has.
    #[must_use]
    pub fn without_links(self, links: &[String]) -> Self {
        self.with_names(|names| names.without_links(links.iter()))
    }

    fn with_names(self, change: impl Fn(WrittenNames) -> WrittenNames) -> Self {
        let urdf = self.urdf.map(|urdf| urdf.with_names(&change));
        let mjcf = self.mjcf.map(|mjcf| mjcf.with_names(&change));
        Self { urdf, mjcf, ..self }
    }
}

/// Files and folders that a robot file names in addition to the URDF.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct NamedFiles {
    /// Path of the SRDF; `None` if the robot file names none.
    pub srdf: Option<PathBuf>,
    /// Folders of packages by name.
    pub packages: BTreeMap<String, PathBuf>,
}

/// A robot with its analytical model, as a robot file (or a bare URDF) declares them.
#[derive(Debug, Clone, PartialEq)]
pub struct RobotDescription {
    /// The robot file, or the URDF if there is no robot file.
    pub path: PathBuf,
    /// The name that the robot file gives, or the URDF's.
    pub name: String,
    /// Path of the URDF; of the robot file if its table or screws are the robot.
    pub urdf_path: PathBuf,
    /// The tree of links and joints, as the URDF gives it.
    pub robot: Robot,
    /// The link that the model's base frame is declared in.
    pub base: LinkIndex,
    /// The link that the model's last frame is declared in; it hangs below the body of `base`.
    pub tip: LinkIndex,
    /// Who determined these two links: the file, the command, or an automatic choice.
    pub chain_ends: ChainEnds,
    /// The Denavit-Hartenberg table; `None` for a bare URDF.
    pub dh: Option<DhTable>,
    /// The dynamics that the robot file declares beside the URDF; `None` if it declares none.
    pub dynamics: Option<DynamicsTable>,
    /// The largest acceleration of each moving joint that the robot file declares, rad/s^2 or m/s^2.
    pub accelerations: Vec<Option<f64>>,
    /// Pose of the tool centre point in link `tip`; `None` if no tool is declared.
    pub tip_from_tcp: Option<Isometry3<f64>>,
    /// Largest difference of poses at which model and twin still agree.
    pub tolerance: Tolerance,
    /// The parts of the tolerance that the robot file or the caller has set. What nobody has set is judged by the digits that the
    /// files are typed with.
    pub declared_tolerance: RequestedTolerance,
    /// How joints are called and counted in another description, if the robot file declares it.
    pub mapping: Option<DeclaredMapping>,
    /// By how much each parameter may be off; `None` if the file does not say.
    pub tolerances: Option<DeclaredTolerances>,
    /// The other descriptions of this robot that the robot file names.
    pub references: Vec<DeclaredReference>,
    /// The other files and folders that the robot file names.
    pub named_files: NamedFiles,
    /// Link pairs that an SRDF excludes from clearance, the smaller index first.
    pub disabled_collisions: BTreeSet<(LinkIndex, LinkIndex)>,
    /// Warnings, among them faults that block a use other than kinematics.
    pub warnings: Vec<Diagnostic>,
    /// The files that were read: robot file, URDF, SRDF and meshes.
    pub inputs: Vec<InputFile>,
    /// The texts of robot file and URDF.
    pub places: Places,
    /// Values that were set in place of those of the files, `KEY=VALUE`.
    pub set_values: Vec<String>,
    /// Set if the robot is what a program has loaded: no file has its values, and what it lacks is 0. How far the program's own poses were
    /// found to be from those of the robot, at most.
    pub loaded: Option<Tolerance>,
}

impl RobotDescription {
    /// A robot alone: root as base, a chosen tip, no table, default tolerance. `path` is that of its URDF or MJCF.
    pub(crate) fn of_robot(path: &Path, robot: Robot) -> Self {
        let base = robot.root();
        Self {
            path: path.to_owned(),
            name: robot.name().to_owned(),
            urdf_path: path.to_owned(),
            base,
            tip: choose_tip(&robot, base).tip,
            chain_ends: ChainEnds::default(),
            accelerations: vec![None; robot.dof()],
            robot,
            dh: None,
            dynamics: None,
            tip_from_tcp: None,
            tolerance: Tolerance::default(),
            declared_tolerance: RequestedTolerance::default(),
            mapping: None,
            tolerances: None,
            references: Vec::new(),
            named_files: NamedFiles::default(),
            disabled_collisions: BTreeSet::new(),
            warnings: Vec::new(),
            inputs: Vec::new(),
            places: Places::default(),
            set_values: Vec::new(),
            loaded: None,
        }
    }

    /// The robot that a program has loaded, such as an engine of physics, under the name that messages have for it. `forces` are what
    /// the program computes with and a robot has no place for, in words; `within` is how far its own poses are from those of the robot.
    pub fn of_loaded(
        name: &str,
        robot: Robot,
        forces: impl IntoIterator<Item = String>,
        within: Tolerance,
    ) -> Self {
        let forces = forces.into_iter().map(|message| Diagnostic::warning(codes::mjcf::GRAVITY, message));
        let warnings = forces.collect();
        Self { warnings, loaded: Some(within), ..Self::of_robot(Path::new(name), robot) }
    }

    /// Whether it is what a program has loaded, and no file.
    pub fn is_loaded(&self) -> bool {
        self.loaded.is_some()
    }

    /// The scale with which tolerances of its poses are compared.
    pub fn tolerance_scale(&self) -> ToleranceScale {
        ToleranceScale::with_tool(&self.robot, self.tip, self.tip_from_tcp.as_ref())
    }

    /// Checks that the robot is complete for a use. Every computation that needs more than kinematics calls this first.
    ///
    /// # Errors
    /// The findings that block this use, as errors.
    pub fn check_capability(&self, needed: Capability) -> Result<(), Findings> {
        if let Some(fault) = self.places.own_model.as_ref().and_then(|of| without_bodies(of, needed)) {
            return Err(fault.into());
        }
        let stopping = self.warnings.iter().filter(|found| found.stops == Some(needed));
        let errors: Vec<Diagnostic> =
            stopping.map(|found| found.clone().needed_by(Some(Capability::Kinematics))).collect();
        if errors.is_empty() { Ok(()) } else { Err(errors.into()) }
    }

    /// The format of the file that the robot was read from: `URDF` or `MJCF`.
    pub fn format_name(&self) -> &'static str {
        if self.places.mjcf.is_some() { "MJCF" } else { "URDF" }
    }

    /// What the robot is made of if there is no URDF: the table or the screws of its robot file.
    pub fn own_model(&self) -> Option<OwnModelForm> {
        self.places.own_model.as_ref().map(|places| places.form())
    }

    /// The same robot with another chain. A link that is not named stays; a new base without a tip gets a chosen tip. If the
    /// chain changes, the table is dropped with a warning.
    ///
    /// # Errors
    /// A link is unknown, or `tip` does not hang below `base`.
    pub fn with_chain(mut self, base: Option<&str>, tip: Option<&str>) -> Result<Self, Diagnostic> {
        let before = (self.base, self.tip);
        if let Some(base) = base {
            self.base = self.link("base", base)?;
            self.chain_ends.base = ChainEnd::Given;
        }
        if let Some(tip) = tip {
            self.tip = self.link("tip", tip)?;
            self.chain_ends.tip = ChainEnd::Given;
        } else if base.is_some() {
            self.tip = choose_tip(&self.robot, self.base).tip;
            self.chain_ends.tip = ChainEnd::Chosen;
        }
        if self.robot.chain(self.base, self.tip).is_none() {
            let message = format!(
                "tip \"{}\" is not a descendant of base \"{}\"",
                self.name_of(self.tip),
                self.name_of(self.base)
            );
            return Err(Diagnostic::error(codes::chain::BROKEN, message)
                .with_help("the tip must be a link below the base: choose another --tip or --base, or other keys tip and base"));
        }
        if before != (self.base, self.tip) {
            self.drop_table(before.0, before.1);
        }
        Ok(self.with_tip_warning())
    }

    fn drop_table(&mut self, base: LinkIndex, tip: LinkIndex) {
        let (table, inertials) = (self.dh.take(), self.dynamics.take());
        let dropped = match (table, inertials) {
            (Some(_), Some(_)) => Some(("[dh] table and the [[inertial]] entries describe", "they are")),
            (Some(_), None) => Some(("[dh] table describes", "it is")),
            (None, Some(_)) => Some(("[[inertial]] entries describe", "they are")),
            (None, None) => None,
        };
        if let Some((what, they_are)) = dropped {
            let message = format!(
                "the {what} the chain from \"{}\" to \"{}\", not from \"{}\" to \"{}\", so {they_are} not used",
                self.name_of(base),
                self.name_of(tip),
                self.name_of(self.base),
                self.name_of(self.tip)
            );
            self.warnings.push(Diagnostic::warning(codes::chain::TABLE_DROPPED, message));
        }
        // The frames of the declared dynamics are those of the table or of its base; the tool is declared in the old tip.
        self.places.inertials = None;
        self.tip_from_tcp = None;
        self.places.robot_file = None;
    }

    /// Replaces the warning that several tips are equally likely. Called again after each change of the chain.
    #[must_use]
    pub(crate) fn with_tip_warning(mut self) -> Self {
        const MOST_NAMED: usize = 10;
        self.warnings.retain(|warning| warning.code != codes::chain::SEVERAL_TIPS);
        if self.chain_ends.tip != ChainEnd::Chosen {
            return self;
        }
        let others = choose_tip(&self.robot, self.base).others;
        if !others.is_empty() {
            let others: Vec<&str> = others.into_iter().map(|link| self.name_of(link)).collect();
            let message = format!(
                "the robot has several chains of about the same length: the one to \"{}\" was taken, others end at {}",
                self.name_of(self.tip),
                first_of(&others, MOST_NAMED)
            );
            self.warnings.push(
                Diagnostic::warning(codes::chain::SEVERAL_TIPS, message)
                    .with_help("choose with --tip, or with the keys base and tip of a robot file"),
            );
        }
        self
    }

    /// The likely tips of the chain from `base`, whatever is declared: the one that is chosen if none is named, then the ends of
    /// limbs that are about as long.
    pub fn likely_tips(&self) -> Vec<LinkIndex> {
        let chosen = choose_tip(&self.robot, self.base);
        std::iter::once(chosen.tip).chain(chosen.others).collect()
    }

    /// The chain, as reports name it.
    pub fn reported_chain(&self) -> ReportedChain {
        let joints = self.moving_chain().into_iter().map(|joint| self.robot.joint(joint).name.clone());
        ReportedChain {
            base: self.name_of(self.base).to_owned(),
            base_is: self.chain_ends.base,
            tip: self.name_of(self.tip).to_owned(),
            tip_is: self.chain_ends.tip,
            joints: joints.collect(),
            set_values: self.set_values.clone(),
        }
    }

    fn name_of(&self, link: LinkIndex) -> &str {
        &self.robot.link(link).name
    }

    /// The moving joints from base to tip, mimic joints among them.
    pub fn moving_chain(&self) -> Vec<JointIndex> {
        let joints = self.robot.chain(self.base, self.tip).unwrap_or_default();
        joints.into_iter().filter(|&joint| self.robot.joint(joint).kind.is_movable()).collect()
    }

    /// The entries of the configuration vector of [`RobotDescription::moving_chain`].
    pub fn moving_coordinates(&self) -> Vec<usize> {
        self.moving_chain().into_iter().filter_map(|joint| self.robot.coordinate(joint)).collect()
    }

    fn link(&self, role: &str, name: &str) -> Result<LinkIndex, Diagnostic> {
        self.robot.find_link(name).ok_or_else(|| {
            let links = self.robot.links().iter().map(|link| link.name.as_str());
            Diagnostic::error(
                codes::chain::UNKNOWN_LINK,
                format!("{role} \"{name}\": the robot has no such link"),
            )
            .with_help(joint_for_link(&self.robot, name) + &known_names(name, "links", links))
        })
    }
}
