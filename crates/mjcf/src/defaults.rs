//! Classes of defaults. All `<default>` sections are read before any element that uses them; a class begins as a copy of its
//! parent as that is when the class is declared, after the parent's own elements of the same section.

use std::{
    collections::{BTreeMap, btree_map::Entry},
    sync::Arc,
};

use congruent_input::{Diagnostics, known_names};

use crate::{
    codes,
    document::{MjAttribute, MjElement},
    grammar::ORIENTATIONS,
};

/// The name of the class at the top.
const MAIN: &str = "main";
/// Most classes: each is a copy of its parent. Kind: choice; large public models have fifty.
const MOST_CLASSES: usize = 1_000;
/// The name under which defaults of all kinds of actuators are kept.
const ACTUATOR: &str = "actuator";
/// The key under which a class keeps the kind of actuator that its parameters are of.
const KIND: &str = "kind of actuator";
/// Kinds of actuators that may be in a class.
const ACTUATORS: [&str; 13] = [
    "general",
    "motor",
    "position",
    "velocity",
    "intvelocity",
    "orientation",
    "pid",
    "damper",
    "cylinder",
    "muscle",
    "adhesion",
    "dcmotor",
    "plugin",
];
/// Attributes that any actuator inherits from any other; the others are inherited by the same kind and by `general` alone.
const COMMON: [&str; 13] = [
    "ctrllimited",
    "forcelimited",
    "ctrlrange",
    "forcerange",
    "gear",
    "damping",
    "armature",
    "cranklength",
    "group",
    "user",
    "delay",
    "nsample",
    "interp",
];

/// An attribute, and the class that states it.
#[derive(Debug, Clone)]
pub(crate) struct MjInherited {
    pub(crate) attribute: Arc<MjAttribute>,
    pub(crate) class: Arc<str>,
}

type MjClassElement = BTreeMap<String, MjInherited>;

/// One class: attributes by element. Elements are shared with the parent until they differ.
#[derive(Debug, Clone, Default)]
pub(crate) struct MjClass(BTreeMap<String, Arc<MjClassElement>>);

impl MjClass {
    /// A class without defaults.
    pub(crate) const fn none() -> Self {
        Self(BTreeMap::new())
    }

    /// The default of an attribute of an element with this tag.
    pub(crate) fn attribute(&self, tag: &str, key: &str) -> Option<&MjInherited> {
        if !ACTUATORS.contains(&tag) {
            return self.0.get(tag)?.get(key);
        }
        let found = self.0.get(ACTUATOR)?;
        let kind = found.get(KIND).map(|kind| kind.attribute.value.as_str());
        let is_inherited = COMMON.contains(&key) || tag == "general" || kind == Some(tag);
        found.get(key).filter(|_| is_inherited)
    }

    /// The kind of actuator whose parameters this class has.
    pub(crate) fn actuator_kind(&self) -> Option<&str> {
        Some(&self.0.get(ACTUATOR)?.get(KIND)?.attribute.value)
    }

    fn add(&mut self, element: &MjElement, class: &Arc<str>) {
        let is_actuator = ACTUATORS.contains(&element.tag.as_str());
        let tag = if is_actuator { ACTUATOR } else { &element.tag };
        let kept = Arc::make_mut(self.0.entry(tag.to_owned()).or_default());
        if is_actuator {
            // A shortcut resets the parameters of the one before.
            if element.tag != "general" {
                kept.retain(|key, _| COMMON.contains(&key.as_str()));
            }
            let kind = MjAttribute {
                key: KIND.to_owned(),
                value: element.tag.clone(),
                span: element.span.clone(),
                source: Arc::clone(&element.source),
            };
            kept.insert(KIND.to_owned(), MjInherited { attribute: Arc::new(kind), class: Arc::clone(class) });
        }
        for attribute in element.attributes.iter().filter(|attribute| !attribute.value.is_empty()) {
            // An orientation of the class replaces that of its parent, whatever its notation.
            if is_orientation(&attribute.key) && ["geom", "site", "camera"].contains(&tag) {
                kept.retain(|key, _| !is_orientation(key));
            }
            let inherited = MjInherited { attribute: Arc::clone(attribute), class: Arc::clone(class) };
            kept.insert(attribute.key.clone(), inherited);
        }
    }
}

/// Whether an attribute gives an orientation.
fn is_orientation(key: &str) -> bool {
    ORIENTATIONS.contains(&key)
}

/// All classes of a model, by name.
#[derive(Debug)]
pub(crate) struct MjClasses(BTreeMap<String, MjClass>);

impl MjClasses {
    pub(crate) fn read(root: &MjElement, diagnostics: &mut Diagnostics) -> Self {
        let mut classes = Self(BTreeMap::from([(MAIN.to_owned(), MjClass::default())]));
        for section in root.all("default") {
            if let Some(name) = section.text("class").filter(|name| *name != MAIN) {
                let message = format!("the class of defaults at the top is \"{name}\", it must be \"main\"");
                let help = "leave class out at the top, and declare other classes inside it";
                diagnostics.push(section.fault_at("class", codes::mjcf::CLASS, message).with_help(help));
            }
            classes.section(section, MAIN, diagnostics);
        }
        classes
    }

    /// The class with this name, or that at the top.
    pub(crate) fn get(&self, name: Option<&str>) -> Option<&MjClass> {
        self.0.get(name.unwrap_or(MAIN))
    }

    /// Help for the name of a class that is not declared.
    pub(crate) fn help(&self, name: &str) -> String {
        known_names(name, "classes", self.0.keys().map(String::as_str))
    }

    fn section(&mut self, section: &MjElement, name: &str, diagnostics: &mut Diagnostics) {
        let class: Arc<str> = name.into();
        let mut own = self.0.get(name).cloned().unwrap_or_default();
        for element in section.children.iter().filter(|child| child.tag != "default") {
            own.add(element, &class);
        }
        self.0.insert(name.to_owned(), own.clone());
        for child in section.all("default") {
            let Some(name) = child.text("class") else {
                let message = "a class of defaults has no name";
                diagnostics.push(child.fault(codes::mjcf::CLASS, message).with_help("class=\"arm\""));
                continue;
            };
            if self.0.len() >= MOST_CLASSES {
                let message = format!("there are more than {MOST_CLASSES} classes of defaults");
                diagnostics.push(child.fault(codes::mjcf::TOO_LARGE, message));
                return;
            }
            match self.0.entry(name.to_owned()) {
                Entry::Vacant(entry) => {
                    entry.insert(own.clone());
                    self.section(child, name, diagnostics);
                }
                Entry::Occupied(_) => {
                    let message = format!("the class of defaults \"{name}\" is declared twice");
                    let help = "join the two, or rename one of them";
                    diagnostics.push(child.fault_at("class", codes::mjcf::CLASS, message).with_help(help));
                }
            }
        }
    }
}
