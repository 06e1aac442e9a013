//! A model with its own settings, classes and assets: the main one, or one that is attached.

use std::{
    collections::{BTreeMap, BTreeSet},
    sync::Arc,
};

use congruent_input::SourceFile;

use crate::{
    codes,
    defaults::MjClasses,
    document::{Assembly, MjElement, assemble, folder},
    grammar,
    settings::MjSettings,
};

use super::names::MjNamed;

/// Deepest nesting of attached models: a model that attaches itself would never end.
const DEEPEST_MODELS: usize = 4;

/// What elements of one model are read with.
pub(crate) struct MjScope {
    pub(super) root: MjElement,
    /// Folder of its main file, relative to that of the main model; empty or with a slash at its end.
    pub(super) folder: String,
    pub(super) settings: MjSettings,
    pub(super) classes: MjClasses,
    /// Models that it may attach, by name.
    pub(super) models: BTreeMap<String, MjScope>,
    /// Number of its elements.
    pub(super) size: usize,
    /// The names that its tree and its tendons declare, whether they are attached or not.
    pub(super) declared: BTreeSet<(MjNamed, String)>,
}

impl MjScope {
    /// Reads the files of a model and checks them against the grammar; `None` if there is no tree.
    pub(super) fn load(
        main: &Arc<SourceFile>,
        folder: &str,
        assembly: &mut Assembly<'_, '_>,
        depth: usize,
    ) -> Option<Self> {
        let root = assemble(main, folder, assembly)?;
        grammar::check(&root, assembly.diagnostics);
        if assembly.diagnostics.has_error() {
            return None;
        }
        let settings = MjSettings::read(&root, assembly.diagnostics);
        let classes = MjClasses::read(&root, assembly.diagnostics);
        let (size, declared) = (size(&root), declared(&root));
        let folder = folder.to_owned();
        let mut scope = Self { root, folder, settings, classes, models: BTreeMap::new(), size, declared };
        scope.load_models(assembly, depth);
        Some(scope)
    }

    fn load_models(&mut self, assembly: &mut Assembly<'_, '_>, depth: usize) {
        for asset in self.root.in_sections("asset").filter(|asset| asset.tag == "model") {
            let Some(file) = asset.attribute("file") else { continue };
            if depth >= DEEPEST_MODELS {
                let message = format!("models are attached more than {DEEPEST_MODELS} deep");
                let help = "a model must not attach itself, also not through another file";
                assembly.diagnostics.push(file.fault(codes::mjcf::TOO_LARGE, message).with_help(help));
                return;
            }
            let path = format!("{}{}", self.folder, file.value);
            let Some(source) = assembly.open(&path, file) else { continue };
            let Some(model) = Self::load(&source, folder(&path), assembly, depth + 1) else { continue };
            let name = asset.name().or(model.root.text("model")).unwrap_or_default().to_owned();
            if self.models.contains_key(&name) {
                let message = format!("two models are called \"{name}\"");
                assembly.diagnostics.push(asset.fault_at("name", codes::mjcf::NAME, message));
            }
            self.models.insert(name, model);
        }
    }
}

fn declared(root: &MjElement) -> BTreeSet<(MjNamed, String)> {
    let mut names = BTreeSet::new();
    let mut open: Vec<&MjElement> = root.all("worldbody").chain(root.all("tendon")).collect();
    while let Some(element) = open.pop() {
        let kind = match element.tag.as_str() {
            "body" => Some(MjNamed::Body),
            "joint" | "freejoint" => Some(MjNamed::Joint),
            "site" => Some(MjNamed::Site),
            "spatial" | "fixed" => Some(MjNamed::Tendon),
            _ => None,
        };
        names.extend(kind.zip(element.name().map(str::to_owned)));
        open.extend(&element.children);
    }
    names
}

fn size(root: &MjElement) -> usize {
    let (mut open, mut size) = (vec![root], 0);
    while let Some(element) = open.pop() {
        size += 1;
        open.extend(&element.children);
    }
    size
}
