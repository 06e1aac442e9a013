//! The formats of mesh files: a new one is a file beside this one and a line in each match.

use congruent_input::xml::LFS_POINTER;

use super::{
    dae,
    mesh_file::{MeshError, MeshFile},
    obj, stl,
};

/// A format that is read.
#[derive(Debug, Clone, Copy)]
pub(super) enum MeshFormat {
    Stl,
    Obj,
    Collada,
}

impl MeshFormat {
    /// The format that the extension of a file name says, in capitals or not.
    pub(super) fn from_extension(extension: &str) -> Result<Self, MeshError> {
        match extension.to_ascii_lowercase().as_str() {
            "stl" => Ok(Self::Stl),
            "obj" => Ok(Self::Obj),
            "dae" => Ok(Self::Collada),
            _ => Err(MeshError::Unsupported { extension: format!(".{extension}") }),
        }
    }

    /// Reads the bytes of a mesh file of this format.
    ///
    /// An empty result is an empty COLLADA scene, which real robots hold; every other mesh without a
    /// triangle that has area is refused.
    pub(super) fn parse(self, bytes: &[u8]) -> Result<MeshFile, MeshError> {
        // Before the format: a pointer has the extension of the mesh that it stands for, and its message says how to
        // get it.
        if bytes.starts_with(LFS_POINTER.as_bytes()) {
            return Err(MeshError::LfsPointer);
        }
        if bytes.iter().all(u8::is_ascii_whitespace) {
            return Err(MeshError::Empty);
        }
        let mesh = match self {
            Self::Stl => stl::parse(bytes)?,
            Self::Obj => obj::parse(bytes)?,
            Self::Collada => {
                let mesh = dae::parse(bytes)?;
                // An empty scene is legal COLLADA and gets a warning; `check` would refuse it for having no area.
                if mesh.triangles.is_empty() {
                    return Ok(mesh);
                }
                mesh
            }
        };
        mesh.check()?;
        Ok(mesh)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn other_formats_are_refused_by_name() {
        let message = MeshFormat::from_extension("step").unwrap_err().to_string();
        assert_eq!(message, "mesh format \".step\" is not supported (use STL, OBJ or DAE)");
        let pointer = MeshFormat::Stl.parse(b"version https://git-lfs.github.com/spec/v1\noid sha256:0\n");
        assert_eq!(pointer, Err(MeshError::LfsPointer));
        assert_eq!(MeshFormat::Obj.parse(b"\n"), Err(MeshError::Empty));
    }
}
