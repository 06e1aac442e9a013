//! A tree of views in the form that rerun's viewer reads. `layout.rs` decides what the views show.

use congruent_monitors::RecordingError;
use re_log_types::{EntityPath, EntityPathPart, TimeInt, TimePoint, Timeline};
use re_sdk_types::{
    AsComponents, SerializedComponentBatch,
    blueprint::{
        archetypes::{ContainerBlueprint, EntityBehavior, ViewBlueprint, ViewContents, VisibleTimeRanges},
        components::{
            ActiveTab, ColumnShare, ContainerKind, IncludedContent, QueryExpression, RowShare,
            VisibleTimeRange,
        },
    },
    datatypes::{TimeInt as RelativeTime, TimeRange, TimeRangeBoundary, VisibleTimeRange as Range},
    external::uuid::Uuid,
};

use crate::rrd::{
    paths,
    times::{SIM_TIME, nanoseconds},
    writer::RrdWriter,
};

/// Name of the timeline on which viewers read a layout.
const BLUEPRINT_TIMELINE: &str = "blueprint";

/// One view of the viewer: its kind, its title, and the entities that it shows.
#[derive(Debug, Clone)]
pub(crate) struct View {
    class: &'static str,
    name: String,
    origin: EntityPath,
    contents: Vec<String>,
    properties: Vec<(&'static str, Vec<SerializedComponentBatch>)>,
    trail: Option<(EntityPath, f64)>,
    hidden: Vec<EntityPath>,
}

impl View {
    /// A view of everything at and below `origin`.
    pub(crate) fn new(class: &'static str, name: impl Into<String>, origin: EntityPath) -> Self {
        Self {
            class,
            name: name.into(),
            origin,
            contents: vec!["$origin/**".to_owned()],
            properties: Vec::new(),
            trail: None,
            hidden: Vec::new(),
        }
    }

    /// Shows only these entities.
    pub(crate) fn only(mut self, entities: impl IntoIterator<Item = EntityPath>) -> Self {
        self.contents = entities.into_iter().map(|path| format!("+ {path}")).collect();
        self
    }

    /// Sets one of the view's properties.
    pub(crate) fn with(mut self, name: &'static str, property: &dyn AsComponents) -> Self {
        self.properties.push((name, property.as_serialized_batches()));
        self
    }

    /// Shows the rows of an entity in the last seconds, not only the latest row.
    pub(crate) fn with_trail(mut self, entity: EntityPath, duration_s: f64) -> Self {
        self.trail = Some((entity, duration_s));
        self
    }

    /// Hides an entity and all below it until someone shows it.
    pub(crate) fn hiding(mut self, entity: EntityPath) -> Self {
        self.hidden.push(entity);
        self
    }
}

/// A view, or a container of nodes.
#[derive(Debug, Clone)]
pub(crate) enum LayoutNode {
    /// A leaf of the tree, with contents of its own.
    View(Box<View>),
    /// Side by side, each with its share of the width.
    Columns(Vec<(f32, LayoutNode)>),
    /// One above the other, each with its share of the height.
    Rows(Vec<(f32, LayoutNode)>),
    /// In tabs; the first is in front.
    Tabs(Vec<LayoutNode>),
}

impl From<View> for LayoutNode {
    fn from(view: View) -> Self {
        Self::View(Box::new(view))
    }
}

/// Writes a layout into the open store; identifiers are counted, so that equal layouts give equal bytes.
pub(crate) struct BlueprintWriter<'a> {
    writer: &'a mut RrdWriter,
    nodes: u128,
}

impl<'a> BlueprintWriter<'a> {
    /// A writer of a layout into the open store.
    pub(crate) fn new(writer: &'a mut RrdWriter) -> Self {
        Self { writer, nodes: 0 }
    }

    /// Logs one row at a path of the layout.
    pub(crate) fn log(
        &mut self,
        path: impl Into<EntityPath>,
        components: &dyn AsComponents,
    ) -> Result<(), RecordingError> {
        self.row(path, components.as_serialized_batches())
    }

    /// Writes a node and all nodes below it; returns its identifier.
    pub(crate) fn node(&mut self, node: &LayoutNode) -> Result<Uuid, RecordingError> {
        self.nodes += 1;
        let id = Uuid::from_u128(self.nodes);
        match node {
            LayoutNode::View(view) => self.view(id, view)?,
            LayoutNode::Columns(children) | LayoutNode::Rows(children) => {
                let (shares, nodes): (Vec<_>, Vec<_>) = children.iter().cloned().unzip();
                let contents = self.contents(&nodes)?;
                let container = if matches!(node, LayoutNode::Columns(_)) {
                    ContainerBlueprint::new(ContainerKind::Horizontal)
                        .with_col_shares(shares.into_iter().map(|share| ColumnShare(share.into())))
                } else {
                    ContainerBlueprint::new(ContainerKind::Vertical)
                        .with_row_shares(shares.into_iter().map(|share| RowShare(share.into())))
                };
                self.log(container_path(id), &container.with_contents(contents))?;
            }
            LayoutNode::Tabs(nodes) => {
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

    fn contents(&mut self, nodes: &[LayoutNode]) -> Result<Vec<IncludedContent>, RecordingError> {
        let mut contents = Vec::with_capacity(nodes.len());
        for node in nodes {
            let id = self.node(node)?;
            let path = if matches!(node, LayoutNode::View(_)) { view_path(id) } else { container_path(id) };
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
        for entity in &view.hidden {
            let at = ViewContents::blueprint_base_visualizer_path_for_entity(id, entity);
            self.log(at, &EntityBehavior::new().with_visible(false))?;
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
    paths::path(&["view", &id.to_string()])
}

fn container_path(id: Uuid) -> EntityPath {
    paths::path(&["container", &id.to_string()])
}
