//! Joins the files of a model into one tree: `<include>` is replaced by the children of the included root, before anything
//! else is read. Bounds: files, elements and depth.

use std::{collections::BTreeSet, sync::Arc};

use congruent_input::{Diagnostic, Diagnostics, SourceFile, xml};
use roxmltree::Node;

use super::element::{MjAttribute, MjElement};
use crate::{ReadFile, codes};

/// Most files of a model, attached models among them. Kind: choice; the largest public model has a dozen.
const MOST_FILES: usize = 256;
/// Most elements of all files together, so that included files cannot multiply the bound of one.
const MOST_ELEMENTS: usize = 300_000;
/// Deepest nesting after the inclusion of files: readers call themselves once for each level.
const DEEPEST: usize = 100;

/// Opens files and counts what they add, for a model and the models that it attaches.
pub(crate) struct Assembly<'a, 'r> {
    read: &'a mut ReadFile<'r>,
    pub(crate) diagnostics: &'a mut Diagnostics,
    files: usize,
    elements: usize,
}

impl<'a, 'r> Assembly<'a, 'r> {
    pub(crate) fn new(read: &'a mut ReadFile<'r>, diagnostics: &'a mut Diagnostics) -> Self {
        Self { read, diagnostics, files: 0, elements: 0 }
    }

    /// A file that `by` names, relative to the folder of the main file.
    pub(crate) fn open(&mut self, path: &str, by: &MjAttribute) -> Option<Arc<SourceFile>> {
        self.files += 1;
        if self.files > MOST_FILES {
            let message = format!("the model has more than {MOST_FILES} files, the most that are read");
            self.diagnostics.push(by.fault(codes::mjcf::TOO_LARGE, message));
            return None;
        }
        let opened = (self.read)(path).map_err(|fault| {
            // A file that cannot be opened is shown where it is named.
            if fault.source.is_some() { fault } else { fault.at(by.span.clone()).in_file(&by.source) }
        });
        self.diagnostics.keep(opened)
    }

    /// Counts an element; `None` above the bound.
    fn count(&mut self, node: Node<'_, '_>, depth: usize, source: &Arc<SourceFile>) -> Option<()> {
        self.elements += 1;
        let message = if self.elements > MOST_ELEMENTS {
            format!("the model has more than {MOST_ELEMENTS} elements, the most that are read")
        } else if depth > DEEPEST {
            format!("elements are nested deeper than {DEEPEST}, included files counted")
        } else {
            return Some(());
        };
        let fault = Diagnostic::error(codes::mjcf::TOO_LARGE, message).at(opening(node)).in_file(source);
        self.diagnostics.push(fault);
        None
    }
}

/// The folder of a path as a file names it, with its slash; empty for a bare name.
pub(crate) fn folder(path: &str) -> &str {
    &path[..path.rfind('/').map_or(0, |slash| slash + 1)]
}

/// The tree of a model; `None` if it cannot be read. Files that it names are relative to `folder`.
pub(crate) fn assemble(
    main: &Arc<SourceFile>,
    folder: &str,
    assembly: &mut Assembly<'_, '_>,
) -> Option<MjElement> {
    let document = parsed(&main.text, main, assembly)?;
    let root = document.root_element();
    if root.tag_name().name() != "mujoco" {
        let fault = not_an_mjcf(root).at(opening(root)).in_file(main);
        assembly.diagnostics.push(fault);
        return None;
    }
    let name = main.path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    let mut tree = Tree { folder, included: BTreeSet::from([name]), assembly };
    tree.element(root, main, 1)
}

fn not_an_mjcf(root: Node<'_, '_>) -> Diagnostic {
    let tag = root.tag_name().name();
    let what = match tag {
        "robot" => " (a URDF begins with <robot>)",
        "sdf" => " (an SDF begins with <sdf>)",
        "mujocoinclude" => " (a file that another one includes)",
        _ => "",
    };
    Diagnostic::error(
        codes::mjcf::ROOT,
        format!("the root element is <{tag}>, an MJCF begins with <mujoco>{what}"),
    )
    .with_help("give the main file of the model, whose root element is <mujoco>")
}

fn parsed<'a>(
    text: &'a str,
    source: &Arc<SourceFile>,
    assembly: &mut Assembly<'_, '_>,
) -> Option<roxmltree::Document<'a>> {
    assembly.diagnostics.keep(xml::parse(text).map_err(|fault| fault.in_file(source)))
}

/// One model while its files are joined.
struct Tree<'t, 'a, 'r> {
    folder: &'t str,
    /// Names of the files so far, without `./`: MuJoCo includes each at most once.
    included: BTreeSet<String>,
    assembly: &'t mut Assembly<'a, 'r>,
}

impl Tree<'_, '_, '_> {
    fn element(&mut self, node: Node<'_, '_>, source: &Arc<SourceFile>, depth: usize) -> Option<MjElement> {
        self.assembly.count(node, depth, source)?;
        let attributes = node.attributes().filter(|attribute| attribute.namespace().is_none());
        let mut element = MjElement {
            tag: node.tag_name().name().to_owned(),
            span: opening(node),
            attributes: attributes
                .map(|attribute| {
                    Arc::new(MjAttribute {
                        key: attribute.name().to_owned(),
                        value: attribute.value().to_owned(),
                        span: attribute.range_value(),
                        source: Arc::clone(source),
                    })
                })
                .collect(),
            children: Vec::new(),
            source: Arc::clone(source),
        };
        self.children(node, source, depth, &mut element.children)?;
        Some(element)
    }

    fn children(
        &mut self,
        parent: Node<'_, '_>,
        source: &Arc<SourceFile>,
        depth: usize,
        children: &mut Vec<MjElement>,
    ) -> Option<()> {
        for node in parent.children().filter(Node::is_element) {
            if node.has_tag_name("include") {
                self.include(node, source, depth, children)?;
            } else {
                children.push(self.element(node, source, depth + 1)?);
            }
        }
        Some(())
    }

    fn include(
        &mut self,
        node: Node<'_, '_>,
        source: &Arc<SourceFile>,
        depth: usize,
        children: &mut Vec<MjElement>,
    ) -> Option<()> {
        self.assembly.count(node, depth + 1, source)?;
        let fault = |message: String, help: &str| {
            let fault = Diagnostic::error(codes::mjcf::INCLUDE, message).at(opening(node)).in_file(source);
            if help.is_empty() { fault } else { fault.with_help(help) }
        };
        let Some(file) = node.attributes().find(|attribute| attribute.name() == "file") else {
            self.assembly.diagnostics.push(fault("<include> names no file".to_owned(), "file=\"part.xml\""));
            return None;
        };
        let by = MjAttribute {
            key: "file".to_owned(),
            value: file.value().to_owned(),
            span: file.range_value(),
            source: Arc::clone(source),
        };
        if node.children().any(|child| child.is_element()) {
            let message = format!("<include> of \"{}\" has children, which it must not have", by.value);
            self.assembly.diagnostics.push(fault(message, "put them before or after the <include>"));
            return None;
        }
        if !self.included.insert(plain(&by.value)) {
            let message = format!("\"{}\" is included already, or is the main file", by.value);
            let help = "each file is included at most once; remove this <include>";
            self.assembly.diagnostics.push(by.fault(codes::mjcf::INCLUDE, message).with_help(help));
            return None;
        }
        let path = format!("{}{}", self.folder, by.value);
        let included = self.assembly.open(&path, &by)?;
        let document = parsed(&included.text, &included, self.assembly)?;
        let root = document.root_element();
        if !root.children().any(|child| child.is_element()) {
            let message = format!("the included file \"{}\" has no elements", by.value);
            self.assembly.diagnostics.push(by.fault(codes::mjcf::INCLUDE, message));
            return None;
        }
        // The root of the included file is dropped, whatever its name and attributes are.
        self.children(root, &included, depth, children)
    }
}

/// A file name without the parts that change nothing.
fn plain(path: &str) -> String {
    let parts: Vec<&str> = path.split('/').filter(|part| *part != "." && !part.is_empty()).collect();
    parts.join("/")
}

/// The opening of a start tag, `<name`.
fn opening(node: Node<'_, '_>) -> std::ops::Range<usize> {
    let range = node.range();
    let text = &node.document().input_text()[range.clone()];
    let end = text.find(|c: char| c.is_whitespace() || c == '/' || c == '>').unwrap_or(text.len());
    range.start..range.start + end
}
