//! Writes rerun messages to a file so that equal runs give equal bytes.
//!
//! rerun's own encoder numbers chunks by the clock, lists the stores of the footer in the order of a random
//! map, and reports a full disk only on request. Here identifiers are counted, the footer is sorted, and
//! every write returns its error at once. This file knows nothing about the contents of the messages.

use std::{
    collections::BTreeMap,
    fmt::Display,
    fs::File,
    io::{BufWriter, Write},
    path::Path,
};

use congruent_monitors::RecordingError;
use re_chunk::{Chunk, ChunkId, RowId, Span, TimeColumn, external::arrow::datatypes::Schema};
use re_log_encoding::{
    Compression, CrateVersion, Encodable, EncodingOptions, MessageHeader, MessageKind, RRD_FOURCC, RrdFooter,
    RrdManifestBuilder, StreamFooter, StreamHeader, ToTransport,
};
use re_log_types::{
    ArrowMsg, BlueprintActivationCommand, EntityPath, LogMsg, SetStoreInfo, StoreId, StoreInfo, StoreSource,
    TimePoint,
};
use re_sdk_types::{AsComponents, SerializedComponentBatch, SerializedComponentColumn};

/// A [`RecordingError`] with the message of an error of rerun or of the operating system.
pub(crate) fn failed(error: impl Display) -> RecordingError {
    RecordingError { message: error.to_string() }
}

/// Bytes that are gathered before they are passed on: most messages are one or two kB.
const BUFFER_BYTES: usize = 1 << 18;

/// An open file of messages. Rows go to the store that was opened last.
pub(crate) struct RrdWriter {
    file: BufWriter<File>,
    written: u64,
    frame: Vec<u8>,
    store: StoreId,
    manifests: BTreeMap<StoreId, RrdManifestBuilder>,
    last_id: u64,
}

impl RrdWriter {
    /// Creates the file and opens its first store.
    pub(crate) fn create(path: &Path, store: StoreId) -> Result<Self, RecordingError> {
        let file = File::create(path)
            .map_err(|error| failed(format_args!("cannot write {}: {error}", path.display())))?;
        let mut writer = Self {
            file: BufWriter::with_capacity(BUFFER_BYTES, file),
            written: 0,
            frame: Vec::new(),
            store: store.clone(),
            manifests: BTreeMap::new(),
            last_id: 0,
        };
        writer.put(&StreamHeader {
            fourcc: RRD_FOURCC,
            version: CrateVersion::LOCAL.to_bytes(),
            options: EncodingOptions::PROTOBUF_COMPRESSED,
        })?;
        writer.open_store(store)?;
        Ok(writer)
    }

    /// Opens another store; rows go there from now on.
    pub(crate) fn open_store(&mut self, store: StoreId) -> Result<(), RecordingError> {
        let source = StoreSource::Other(concat!("congruent ", env!("CARGO_PKG_VERSION")).to_owned());
        let row_id = self.next_ids().1.as_tuid();
        self.message(&LogMsg::SetStoreInfo(SetStoreInfo {
            row_id,
            info: StoreInfo::new(store.clone(), source),
        }))?;
        self.store = store;
        Ok(())
    }

    /// Makes the open store the layout that the viewer uses for this application.
    pub(crate) fn activate_blueprint(&mut self) -> Result<(), RecordingError> {
        let command = BlueprintActivationCommand::make_active(self.store.clone());
        self.message(&LogMsg::BlueprintActivationCommand(command))?;
        Ok(())
    }

    /// Logs components that hold at all times.
    pub(crate) fn log_static(
        &mut self,
        path: &EntityPath,
        components: &dyn AsComponents,
    ) -> Result<(), RecordingError> {
        self.row(path, TimePoint::default(), components.as_serialized_batches())
    }

    /// Logs the components of several archetypes, which hold at all times, in one row.
    pub(crate) fn log_static_together(
        &mut self,
        path: &EntityPath,
        archetypes: &[&dyn AsComponents],
    ) -> Result<(), RecordingError> {
        let parts = archetypes.iter().flat_map(|archetype| archetype.as_serialized_batches()).collect();
        self.row(path, TimePoint::default(), parts)
    }

    /// Logs components that hold from one time on.
    pub(crate) fn log_at(
        &mut self,
        path: &EntityPath,
        time: TimePoint,
        components: &dyn AsComponents,
    ) -> Result<(), RecordingError> {
        self.row(path, time, components.as_serialized_batches())
    }

    /// Logs serialized components as one row.
    pub(crate) fn row(
        &mut self,
        path: &EntityPath,
        time: TimePoint,
        components: Vec<SerializedComponentBatch>,
    ) -> Result<(), RecordingError> {
        if components.is_empty() {
            return Ok(());
        }
        let (chunk, row) = self.next_ids();
        let chunk = Chunk::builder_with_id(chunk, path.clone())
            .with_serialized_batches(row, time, components)
            .build()
            .map_err(failed)?;
        self.chunk(&chunk)
    }

    /// Logs many rows of one entity at once.
    pub(crate) fn columns(
        &mut self,
        path: &EntityPath,
        times: &[TimeColumn],
        columns: impl IntoIterator<Item = SerializedComponentColumn>,
    ) -> Result<(), RecordingError> {
        let times = times.iter().map(|column| (*column.timeline().name(), column.clone())).collect();
        let (chunk, _) = self.next_ids();
        let columns = columns.into_iter().collect();
        let chunk = Chunk::from_auto_row_ids(chunk, path.clone(), times, columns).map_err(failed)?;
        self.chunk(&chunk)
    }

    /// Passes all data so far to the operating system: after a run is killed, at least these data are in the file.
    pub(crate) fn flush(&mut self) -> Result<(), RecordingError> {
        self.file.flush().map_err(failed)
    }

    /// Writes the footer, the index that viewers read first, and closes the file.
    pub(crate) fn finish(mut self) -> Result<(), RecordingError> {
        let mut footer = RrdFooter::default();
        for (store, manifest) in std::mem::take(&mut self.manifests) {
            let mut manifest = manifest.build(store.clone()).map_err(failed)?;
            let mut fields: Vec<_> = manifest.sorbet_schema.fields().iter().cloned().collect();
            // rerun builds the columns from a map with a random order; sorted, equal runs have equal bytes.
            fields.sort_by(|a, b| a.name().cmp(b.name()));
            let metadata = manifest.sorbet_schema.metadata().clone();
            manifest.sorbet_schema = Schema::new_with_metadata(fields, metadata);
            footer.manifests.insert(store, manifest);
        }
        let mut footer = footer.to_transport(()).map_err(failed)?;
        footer.manifests.sort_by_cached_key(|manifest| format!("{:?}", manifest.store_id));
        let mut bytes = Vec::new();
        footer.to_rrd_bytes(&mut bytes).map_err(failed)?;
        self.put(&MessageHeader { kind: MessageKind::End, len: bytes.len() as u64 })?;
        // After the header: the end of the stream points to the footer's data.
        let start = self.written;
        self.file.write_all(&bytes).map_err(failed)?;
        self.put(&StreamFooter::from_rrd_footer_bytes(start, &bytes))?;
        self.flush()
    }

    fn chunk(&mut self, chunk: &Chunk) -> Result<(), RecordingError> {
        // One conversion for message and index; `Chunk::to_arrow_msg` would be another.
        let batch = chunk.to_chunk_batch().map_err(failed)?;
        let message = ArrowMsg { chunk_id: chunk.id().as_tuid(), batch: (&batch).into(), on_release: None };
        let message = LogMsg::ArrowMsg(self.store.clone(), message);
        let (span, uncompressed) = self.message(&message)?;
        let manifest = self.manifests.entry(self.store.clone()).or_default();
        manifest.append(&batch, span, uncompressed).map_err(failed)
    }

    /// Writes a message; returns the span of its payload in the file and its size before compression.
    fn message(&mut self, message: &LogMsg) -> Result<(Span<u64>, u64), RecordingError> {
        let message = message.to_transport(Compression::LZ4).map_err(failed)?;
        let start = self.written + MessageHeader::ENCODED_SIZE_BYTES as u64;
        self.put(&message)?;
        let span = Span { start, len: self.written - start };
        Ok((span, message.byte_size_uncompressed()))
    }

    fn put(&mut self, frame: &dyn Encodable) -> Result<(), RecordingError> {
        self.frame.clear();
        frame.to_rrd_bytes(&mut self.frame).map_err(failed)?;
        self.file.write_all(&self.frame).map_err(failed)?;
        self.written += self.frame.len() as u64;
        Ok(())
    }

    /// Identifiers that are counted, not taken from the clock as rerun does: the upper half is the number of
    /// the chunk, the lower half counts its rows.
    fn next_ids(&mut self) -> (ChunkId, RowId) {
        self.last_id += 1;
        let id = u128::from(self.last_id) << 64;
        (ChunkId::from_u128(id), RowId::from_u128(id + 1))
    }
}
