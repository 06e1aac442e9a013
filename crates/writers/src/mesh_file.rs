//! Mesh files as a new file names them: relative to its folder.

use std::path::Path;

use congruent_description::Mesh;
use congruent_input::relative_path;

/// How a file in `folder` (absolute, without links) names the file of a mesh; `None` if the mesh has none. Slashes separate
/// folders on every system, as both formats expect.
pub(crate) fn file_name(mesh: &Mesh, folder: &Path) -> Option<String> {
    if mesh.path.as_os_str().is_empty() {
        return None;
    }
    let path = mesh.path.canonicalize().unwrap_or_else(|_| mesh.path.clone());
    // Without a common root, as on two drives, only the whole path names the file.
    let named = relative_path(folder, &path).unwrap_or(path);
    Some(named.to_string_lossy().replace(std::path::MAIN_SEPARATOR, "/"))
}
