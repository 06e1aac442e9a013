//! Files whose content the system makes up while they are read, as those in `/proc`: some are regular files by their kind, and
//! reading them waits for an event.

use std::{fs::Metadata, path::Path};

/// Folders of such file systems.
const FOLDERS: [&str; 3] = ["/proc", "/sys", "/dev"];
/// Folders below these that hold ordinary files: shared memory, and the open files of a program where they are no links.
const ORDINARY: [&str; 2] = ["/dev/shm", "/dev/fd"];

/// The folder of the file system that makes up the content of a file; `None` for files of a disk or of the memory. A link is
/// followed: `/dev/fd/3` is the file that a shell has opened.
pub(super) fn pseudo_folder(path: &Path, metadata: &Metadata) -> Option<&'static str> {
    let is_mounted = |folder: &&str| is_on_its_device(metadata, Path::new(folder));
    // Mounted elsewhere they have the device of the folder itself; file systems below them, as /sys/kernel/debug, have another.
    let by_device = || ["/proc", "/sys"].into_iter().find(is_mounted);
    let real = path.canonicalize().ok();
    let by_path = real.filter(|real| !ORDINARY.iter().any(|folder| real.starts_with(folder)));
    by_path.and_then(|real| FOLDERS.into_iter().find(|folder| real.starts_with(folder))).or_else(by_device)
}

/// Whether a file is on the device of a folder, if that is not the device of all files.
#[cfg(unix)]
fn is_on_its_device(file: &Metadata, folder: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let device = |path: &Path| std::fs::metadata(path).ok().map(|metadata| metadata.dev());
    device(folder) == Some(file.dev()) && device(Path::new("/")) != Some(file.dev())
}

#[cfg(not(unix))]
fn is_on_its_device(_: &Metadata, _: &Path) -> bool {
    false
}

#[cfg(target_os = "linux")]
#[cfg(test)]
mod tests {
    use std::os::fd::AsRawFd;

    use super::*;

    #[track_caller]
    fn check(path: &Path, expected: Option<&str>) {
        assert_eq!(pseudo_folder(path, &std::fs::metadata(path).unwrap()), expected, "{}", path.display());
    }

    #[test]
    fn files_that_the_system_makes_up_are_recognised_through_links() {
        check(Path::new("/proc/version"), Some("/proc"));
        check(Path::new("/dev/null"), Some("/dev"));
        let folder = tempfile::tempdir().unwrap();
        let link = folder.path().join("robot.urdf");
        std::os::unix::fs::symlink("/proc/version", &link).unwrap();
        check(&link, Some("/proc"));
        let file = folder.path().join("file");
        std::fs::write(&file, "text").unwrap();
        check(&file, None);
        // What a shell gives for `3<file`, also if the file has no name any more, as the text of a here-document.
        let open = std::fs::File::open(&file).unwrap();
        let by_number = format!("/dev/fd/{}", open.as_raw_fd());
        check(Path::new(&by_number), None);
        std::fs::remove_file(&file).unwrap();
        check(Path::new(&by_number), None);
    }
}
