//! What a model is read into, and what bounds it.

use congruent_input::Diagnostics;
use nalgebra::{Isometry3, UnitQuaternion, Vector3};

use super::{
    attributes::MjAttributes,
    names::{MjCopy, MjNamed, MjNames},
    scope::MjScope,
};
use crate::{
    codes,
    defaults::MjClass,
    document::MjElement,
    model::{MjBody, MjModel, MjName, MjNotation, MjWritten},
};

/// Most bodies, joints, geoms, other parts and replicas together, and elements of attached models. Kind: choice; the largest
/// public model has some thousands, a file has at most 300,000 elements.
const MOST_PARTS: usize = 1_000_000;
/// After so many findings, reading stops if one of them is an error. Kind: choice; nobody reads more.
const MOST_FINDINGS: usize = 1_000;
/// Parts between two looks at the number of findings.
const PARTS_BETWEEN_LOOKS: usize = 256;
/// Deepest nesting of bodies, attached models counted: readers call themselves once for each level.
const DEEPEST: usize = 150;

/// A model whose elements are read under names of their own: the main one, or one of those that are attached.
pub(super) struct MjAttachment<'s> {
    pub(super) scope: &'s MjScope,
    pub(super) prefix: String,
    pub(super) suffix: String,
}

/// Where in the tree an element is.
#[derive(Clone)]
pub(super) struct MjContext<'s> {
    pub(super) attachment: usize,
    /// Number of the replica: the innermost first, as MuJoCo appends them.
    pub(super) replica: String,
    /// The nearest `childclass`.
    pub(super) class: Option<&'s str>,
    /// Pose of the innermost frame in the body whose contents are read.
    pub(super) body_from_frame: Isometry3<f64>,
    /// That frame in the model.
    pub(super) frame: Option<usize>,
    pub(super) depth: usize,
}

impl<'s> MjContext<'s> {
    /// The same inside a frame.
    pub(super) fn moved(&self, frame: Isometry3<f64>) -> Self {
        Self { body_from_frame: self.body_from_frame * frame, ..self.clone() }
    }

    /// The same with the `childclass` of an element, if it has one.
    pub(super) fn with_class_of(&self, element: &'s MjElement) -> Self {
        Self { class: element.text("childclass").or(self.class), ..self.clone() }
    }
}

/// Reads a model.
pub(super) struct MjReader<'s, 'd> {
    pub(super) model: MjModel,
    pub(super) attachments: Vec<MjAttachment<'s>>,
    pub(super) names: MjNames,
    pub(super) diagnostics: &'d mut Diagnostics,
    parts: usize,
}

impl<'s, 'd> MjReader<'s, 'd> {
    /// Reads all of a model; `None` above a bound.
    pub(super) fn read(scope: &'s MjScope, diagnostics: &'d mut Diagnostics) -> Option<MjModel> {
        let mut reader = Self {
            model: empty(scope),
            attachments: Vec::new(),
            names: MjNames::default(),
            diagnostics,
            parts: 0,
        };
        let main = MjAttachment { scope, prefix: String::new(), suffix: String::new() };
        reader.attach(main)?;
        reader.world(scope)?;
        // Attachments come into being while bodies are read; none does any more.
        for attachment in 0..reader.attachments.len() {
            reader.tendons(attachment)?;
            reader.actuators(attachment)?;
            reader.equalities(attachment)?;
            reader.exclusions(attachment)?;
            reader.keyframes(attachment);
            reader.unread_sections(attachment);
        }
        reader.check_planes();
        reader.sum_efforts();
        Some(reader.model)
    }

    /// Begins to read a model.
    pub(super) fn attach(&mut self, attachment: MjAttachment<'s>) -> Option<usize> {
        let index = self.attachments.len();
        let scope = attachment.scope;
        self.attachments.push(attachment);
        // What is outside of the tree is looked at once for each attachment, and the tree is searched.
        self.parts += scope.size;
        self.count(&scope.root)?;
        self.meshes(index)?;
        Some(index)
    }

    /// Counts a part before it is made; `None` above the bound, with an error at `element`.
    pub(super) fn count(&mut self, element: &MjElement) -> Option<()> {
        self.parts += 1;
        if self.parts.is_multiple_of(PARTS_BETWEEN_LOOKS)
            && self.diagnostics.len() > MOST_FINDINGS
            && self.diagnostics.has_error()
        {
            return None;
        }
        if self.parts <= MOST_PARTS {
            return Some(());
        }
        let message = format!("the model has more than {MOST_PARTS} parts, the most that are read");
        let help = "replicas are counted: see count of <replicate>";
        self.diagnostics.push(element.fault(codes::mjcf::TOO_LARGE, message).with_help(help));
        None
    }

    /// Checks the depth of a body; `None` above the bound.
    pub(super) fn check_depth(&mut self, depth: usize, element: &MjElement) -> Option<()> {
        if depth <= DEEPEST {
            return Some(());
        }
        let message = format!("bodies and frames are nested deeper than {DEEPEST}");
        self.diagnostics.push(element.fault(codes::mjcf::TOO_LARGE, message));
        None
    }

    pub(super) fn scope(&self, attachment: usize) -> &'s MjScope {
        self.attachments[attachment].scope
    }

    /// A name with the prefix of the attached model, and the number of the replica.
    pub(super) fn full_name(&self, attachment: usize, replica: &str, name: &str) -> String {
        let MjAttachment { prefix, suffix, .. } = &self.attachments[attachment];
        format!("{prefix}{name}{replica}{suffix}")
    }

    /// The full name of an element in the tree, taken and noted for references; `None` if it has none.
    pub(super) fn named(
        &mut self,
        kind: MjNamed,
        element: &MjElement,
        context: &MjContext<'s>,
        index: usize,
    ) -> Option<String> {
        let name = element.name()?;
        let full = self.full_name(context.attachment, &context.replica, name);
        let taken = self.names.take(kind, &full, element);
        self.diagnostics.keep(taken);
        self.names.add(context.attachment, kind, name, MjCopy { replica: context.replica.clone(), index });
        Some(full)
    }

    /// The class of an element: its own, or the nearest `childclass`.
    pub(super) fn class(&mut self, element: &MjElement, context: &MjContext<'s>) -> &'s MjClass {
        let own = element.text("class");
        self.class_called(own.or(context.class), element, context.attachment)
    }

    /// The class with this name, or that at the top; a fault at `element` if there is none.
    fn class_called(&mut self, name: Option<&str>, element: &MjElement, attachment: usize) -> &'s MjClass {
        static NO_DEFAULTS: MjClass = MjClass::none();
        let classes = &self.scope(attachment).classes;
        classes.get(name).unwrap_or_else(|| {
            let name = name.unwrap_or_default();
            let message = format!("{}: there is no class of defaults \"{name}\"", element.label());
            let fault = element.fault_at("class", codes::mjcf::CLASS, message).with_help(classes.help(name));
            self.diagnostics.push(fault);
            classes.get(None).unwrap_or(&NO_DEFAULTS)
        })
    }

    /// Refuses a `childclass` that is not declared.
    pub(super) fn check_childclass(&mut self, element: &MjElement, attachment: usize) {
        let Some(name) = element.text("childclass") else { return };
        let classes = &self.scope(attachment).classes;
        if classes.get(Some(name)).is_none() {
            let message = format!("{}: there is no class of defaults \"{name}\"", element.label());
            let fault = element.fault_at("childclass", codes::mjcf::CLASS, message);
            self.diagnostics.push(fault.with_help(classes.help(name)));
        }
    }

    /// The attributes of an element outside of the tree, with the defaults of its class.
    pub(super) fn attributes<'e>(&mut self, element: &'e MjElement, attachment: usize) -> MjAttributes<'e>
    where
        's: 'e,
    {
        let class = self.class_called(element.text("class"), element, attachment);
        MjAttributes::with_class(element, class)
    }

    pub(super) fn notation(&self, context: &MjContext<'s>) -> MjNotation {
        self.scope(context.attachment).settings.notation(context.body_from_frame)
    }
}

/// A model with the world alone.
fn empty(scope: &MjScope) -> MjModel {
    let world = MjBody {
        name: MjName { text: "world".to_owned(), is_written: true },
        parent: None,
        parent_from_body: Isometry3::identity(),
        pos: MjWritten::unwritten(Vector3::zeros()),
        orientation: MjWritten::unwritten(UnitQuaternion::identity()),
        notation: MjNotation {
            is_in_degrees: scope.settings.is_in_degrees(),
            euler_sequence: scope.settings.euler_sequence,
            body_from_frame: Isometry3::identity(),
        },
        frame: None,
        joints: 0..0,
        geoms: 0..0,
        sites: 0..0,
        inertial: None,
        inertia_rules: scope.settings.inertia,
        gravcomp: MjWritten::unwritten(0.0),
        is_mocap: false,
        place: scope.root.place(),
    };
    MjModel {
        name: scope.root.text("model").unwrap_or_default().to_owned(),
        bodies: vec![world],
        frames: Vec::new(),
        joints: Vec::new(),
        geoms: Vec::new(),
        sites: Vec::new(),
        meshes: Vec::new(),
        actuators: Vec::new(),
        equalities: Vec::new(),
        tendons: Vec::new(),
        exclusions: Vec::new(),
        keyframes: Vec::new(),
        gravity_in_world: gravity(&scope.root).map(Vector3::from),
        medium_density_kg_m3: of_medium(&scope.root, "density"),
        medium_viscosity_pa_s: of_medium(&scope.root, "viscosity"),
        total_mass_kg: scope.settings.total_mass_kg.clone(),
        files: Vec::new(),
    }
}

/// What the last of several sections says of the medium around the bodies; none without one.
fn of_medium(root: &MjElement, key: &str) -> MjWritten<f64> {
    let given = root.all("option").filter(|option| option.text(key).is_some()).last();
    given.map_or(MjWritten::unwritten(0.0), |option| MjAttributes::own(option).number(key, 0.0))
}

/// The last gravity of several sections; none if a flag switches it off.
fn gravity(root: &MjElement) -> MjWritten<[f64; 3]> {
    const EARTH_M_S2: [f64; 3] = [0.0, 0.0, -9.81];
    let flags = root.in_sections("option").filter(|child| child.tag == "flag");
    if let Some(flag) = flags.filter_map(|flag| flag.attribute("gravity")).last()
        && flag.value == "disable"
    {
        return MjWritten { value: [0.0; 3], place: Some(flag.place(None)) };
    }
    let given = root.all("option").filter(|option| option.text("gravity").is_some()).last();
    given.map_or(MjWritten::unwritten(EARTH_M_S2), |option| {
        MjAttributes::own(option).array("gravity", EARTH_M_S2)
    })
}
