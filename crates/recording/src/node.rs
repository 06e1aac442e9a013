//! A tree of views as rerun's viewer reads it. What the views show is decided in `blueprint.rs`.

use congruent_twin::recorder::RecordingError;
use re_log_types::{EntityPath, EntityPathPart, TimeInt, TimePoint, Timeline};
use re_sdk_types::{
    AsComponents, SerializedComponentBatch,
    blueprint::{
        archetypes::{ContainerBlueprint, ViewBlueprint, ViewContents, VisibleTimeRanges},
        components::{
            ActiveTab, ColumnShare, ContainerKind, IncludedContent, QueryExpression, RowShare,
            VisibleTimeRange,
        },
    },
    datatypes::{TimeInt as RelativeTime, TimeRange, TimeRangeBoundary, VisibleTimeRange as Range},
    external::uuid::Uuid,
};

use crate::{
    times::{SIM_TIME, nanoseconds},
    writer::RrdWriter,
};

/// Viewers read a layout on a timeline of this name.
const BLUEPRINT_TIMELINE: &str = "blueprint";

/// One view.
#[derive(Debug, Clone)]
pub(super) struct View {
    class: &'static str,
    name: String,
    origin: EntityPath,
    contents: Vec<String>,
    properties: Vec<(&'static str, Vec<SerializedComponentBatch>)>,
    trail: Option<(EntityPath, f64)>,
}

impl View {
    /// A view of everything at and below `origin`.
    pub(super) fn new(class: &'static str, name: impl Into<String>, origin: EntityPath) -> Self {
        Self {
            class,
            name: name.into(),
            origin,
            contents: vec!["$origin/**".to_owned()],
            properties: Vec::new(),
            trail: None,
        }
    }

    /// Shows these entities only.
    pub(super) fn only(mut self, entities: impl IntoIterator<Item = EntityPath>) -> Self {
        self.contents = entities.into_iter().map(|path| format!("+ {path}")).collect();
        self
    }

    /// Sets one of the view's properties.
    pub(super) fn with(mut self, name: &'static str, property: &dyn AsComponents) -> Self {
        self.properties.push((name, property.as_serialized_batches()));
        self
    }

    /// Shows the last seconds of an entity, not only its latest row.
    pub(super) fn with_trail(mut self, entity: EntityPath, duration_s: f64) -> Self {
        self.trail = Some((entity, duration_s));
        self
    }
}

/// A view, or several beside, above or behind each other.
#[derive(Debug, Clone)]
pub(super) enum Node {
    /// One view.
    View(Box<View>),
    /// Side by side, with the shares of the width.
    Columns(Vec<(f32, Node)>),
    /// Above each other, with the shares of the height.
    Rows(Vec<(f32, Node)>),
    /// Behind each other; the first is in front.
    Tabs(Vec<Node>),
}

impl From<View> for Node {
    fn from(view: View) -> Self {
        Self::View(Box::new(view))
    }
}

/// Writes a layout into the open store; names are counted, so that equal layouts are equal bytes.
pub(super) struct LayoutWriter<'a> {
    writer: &'a mut RrdWriter,
    nodes: u128,
}

impl<'a> LayoutWriter<'a> {
    /// A layout in the store that is open.
    pub(super) fn new(writer: &'a mut RrdWriter) -> Self {
        Self { writer, nodes: 0 }
    }

    /// Logs one row at a path of the layout.
    pub(super) fn log(
        &mut self,
        path: impl Into<EntityPath>,
        components: &dyn AsComponents,
    ) -> Result<(), RecordingError> {
        self.row(path, components.as_serialized_batches())
    }

    /// Writes a node with all below it; gives its name.
    pub(super) fn node(&mut self, node: &Node) -> Result<Uuid, RecordingError> {
        self.nodes += 1;
        let id = Uuid::from_u128(self.nodes);
        match node {
            Node::View(view) => self.view(id, view)?,
            Node::Columns(children) | Node::Rows(children) => {
                let (shares, nodes): (Vec<_>, Vec<_>) = children.iter().cloned().unzip();
                let contents = self.contents(&nodes)?;
                let container = if matches!(node, Node::Columns(_)) {
                    ContainerBlueprint::new(ContainerKind::Horizontal)
                        .with_col_shares(shares.into_iter().map(|share| ColumnShare(share.into())))
                } else {
                    ContainerBlueprint::new(ContainerKind::Vertical)
                        .with_row_shares(shares.into_iter().map(|share| RowShare(share.into())))
                };
                self.log(container_path(id), &container.with_contents(contents))?;
            }
            Node::Tabs(nodes) => {
                let contents = self.contents(nodes)?;
                let mut container = ContainerBlueprint::new(ContainerKind::Tabs);
                if let Some(first) = contents.first() {
                    container = container.with_active_tab(ActiveTab(first.0.clone()));
                }
                self.log(container_path(id), &container.with_contents(contents))?;
            }
        }
        Ok(id)
    }

    fn contents(&mut self, nodes: &[Node]) -> Result<Vec<IncludedContent>, RecordingError> {
        let mut contents = Vec::with_capacity(nodes.len());
        for node in nodes {
            let id = self.node(node)?;
            let path = if matches!(node, Node::View(_)) { view_path(id) } else { container_path(id) };
            contents.push(IncludedContent(path.to_string().into()));
        }
        Ok(contents)
    }

    fn view(&mut self, id: Uuid, view: &View) -> Result<(), RecordingError> {
        let path = view_path(id);
        let queries = view.contents.iter().map(|query| QueryExpression(query.as_str().into()));
        self.log(&path / EntityPathPart::new("ViewContents"), &ViewContents::new(queries))?;
        let origin = view.origin.to_string();
        let blueprint = ViewBlueprint::new(view.class)
            .with_display_name(view.name.as_str())
            .with_space_origin(origin.as_str());
        self.log(path.clone(), &blueprint)?;
        for (name, property) in &view.properties {
            self.row(&path / EntityPathPart::new(*name), property.clone())?;
        }
        if let Some((entity, duration_s)) = &view.trail {
            let at = ViewContents::blueprint_base_visualizer_path_for_entity(id, entity);
            let ranges = VisibleTimeRanges::new([last_seconds(*duration_s)]);
            self.log(at, &ranges)?;
        }
        Ok(())
    }

    fn row(
        &mut self,
        path: impl Into<EntityPath>,
        components: Vec<SerializedComponentBatch>,
    ) -> Result<(), RecordingError> {
        let start = TimeInt::new_temporal(0);
        let time = TimePoint::default().with(Timeline::new_sequence(BLUEPRINT_TIMELINE), start);
        self.writer.row(&path.into(), time, components)
    }
}

fn last_seconds(duration_s: f64) -> VisibleTimeRange {
    let boundary = |time_s: f64| TimeRangeBoundary::CursorRelative(RelativeTime(nanoseconds(time_s)));
    VisibleTimeRange(Range {
        timeline: SIM_TIME.into(),
        range: TimeRange { start: boundary(-duration_s), end: boundary(0.0) },
    })
}

fn view_path(id: Uuid) -> EntityPath {
    super::paths::path(&["view", &id.to_string()])
}

fn container_path(id: Uuid) -> EntityPath {
    super::paths::path(&["container", &id.to_string()])
}
