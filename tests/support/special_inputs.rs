//! Inputs that cannot be kept as small plain files.

use std::path::Path;

/// The cases that cannot be kept as small plain files.
pub(crate) fn make_special(folder: &Path) {
    const LINKS: usize = 100_000;
    let write = |name: &str, text: &str| std::fs::write(folder.join(name), text).expect("a writable folder");
    let nested = "<a>".repeat(LINKS) + &"</a>".repeat(LINKS);
    write("deep-nesting.urdf", &format!("<robot name=\"deep\"><link name=\"base_link\"/>{nested}</robot>"));
    std::fs::create_dir(folder.join("directory.urdf")).expect("a writable folder");
    #[cfg(unix)]
    {
        let fifo = std::process::Command::new("mkfifo").arg(folder.join("fifo.urdf")).status();
        assert!(fifo.expect("mkfifo runs").success());
        write("unreadable.urdf", "<robot/>");
        let mut permissions =
            std::fs::metadata(folder.join("unreadable.urdf")).expect("it was written").permissions();
        std::os::unix::fs::PermissionsExt::set_mode(&mut permissions, 0);
        std::fs::set_permissions(folder.join("unreadable.urdf"), permissions).expect("it is ours");
    }
    write("chain-100k.urdf", &chain(LINKS, &" ".repeat(100)));
}

/// A robot of so many links one after another, each followed by `padding`.
pub(crate) fn chain(links: usize, padding: &str) -> String {
    let link = |(link, parent): (usize, usize)| {
        format!(
            "<joint name=\"j{link}\" type=\"fixed\"><parent link=\"l{parent}\"/><child link=\"l{link}\"/></joint>\
             <link name=\"l{link}\"/>{padding}"
        )
    };
    let links: String = (1..links).zip(0..).map(link).collect();
    format!("<robot name=\"chain\"><link name=\"l0\"/>{links}</robot>")
}
