//! The digests of a run's results, in a file that `sha256sum --check` reads.

use std::{
    fs::{self, File},
    io::{self, BufRead, BufReader},
    path::Path,
};

use sha2::{Digest, Sha256};

use super::{
    folder::OutputFolder,
    names::{DIGESTS, RESULTS},
    whole_file::OutputError,
};

/// The results of a run against the digests beside them.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct ComparedResults {
    /// The files that are as the run wrote them.
    pub intact: Vec<&'static str>,
    /// Those that are not, or are not there.
    pub changed: Vec<&'static str>,
}

/// Compares the results in a folder with their digests; `None` if there are no digests. Opens files of the names that
/// results have, whatever the digests name.
pub fn compare_results(folder: &Path) -> Option<ComparedResults> {
    let digests = read_result(&folder.join(DIGESTS)).ok()?;
    let digests = String::from_utf8_lossy(&digests);
    let mut compared = ComparedResults::default();
    for name in RESULTS {
        let expected = digests.lines().find(|line| is_of(line, name));
        // A result without a digest is not one of the run, or the digests were damaged.
        if expected.is_none() && !folder.join(name).is_file() {
            continue;
        }
        let is_intact = line(folder, name).is_ok_and(|found| Some(found.as_str()) == expected);
        if is_intact { &mut compared.intact } else { &mut compared.changed }.push(name);
    }
    Some(compared)
}

impl OutputFolder {
    /// Writes the digests of all results that are there.
    ///
    /// # Errors
    /// [`OutputError`] if a result cannot be read, or the digests cannot be written.
    pub fn write_digests(&self) -> Result<(), OutputError> {
        let mut lines = String::new();
        for name in RESULTS.into_iter().filter(|name| self.file(name).is_file()) {
            let line =
                line(self.path(), name).map_err(|source| OutputError { path: self.file(name), source })?;
            lines.push_str(&line);
            lines.push('\n');
        }
        self.write(DIGESTS, lines.as_bytes())
    }
}

/// The bytes of a result. A pipe or a device in its place is none: it may have no end.
///
/// # Errors
/// It is no file, or cannot be read.
pub fn read_result(path: &Path) -> io::Result<Vec<u8>> {
    is_file(path)?;
    fs::read(path)
}

fn is_file(path: &Path) -> io::Result<()> {
    if fs::metadata(path)?.is_file() { Ok(()) } else { Err(io::ErrorKind::InvalidInput.into()) }
}

/// The digest of a file, two spaces, its name.
fn line(folder: &Path, name: &str) -> io::Result<String> {
    let path = folder.join(name);
    is_file(&path)?;
    let mut reader = BufReader::with_capacity(1 << 16, File::open(path)?);
    let mut digest = Sha256::new();
    loop {
        let bytes = reader.fill_buf()?;
        let length = bytes.len();
        if length == 0 {
            return Ok(format!("{:x}  {name}", digest.finalize()));
        }
        digest.update(bytes);
        reader.consume(length);
    }
}

fn is_of(line: &str, name: &str) -> bool {
    line.split_once("  ").is_some_and(|(_, named)| named == name)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::files::REPORT;

    #[test]
    fn a_changed_and_a_missing_result_are_reported() {
        let out = tempfile::tempdir().unwrap();
        let folder = OutputFolder::create(out.path(), "name", &[]).unwrap();
        assert_eq!(compare_results(folder.path()), None);
        for name in [REPORT, "junit.xml", "report.html"] {
            folder.write(name, b"abc").unwrap();
        }
        folder.write_digests().unwrap();
        let digests = fs::read_to_string(folder.file(DIGESTS)).unwrap();
        // FIPS 180-4, example of a one-block message.
        let first = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad  report.json\n";
        assert!(digests.starts_with(first), "{digests}");
        let compared = || compare_results(folder.path()).unwrap();
        assert_eq!(compared().changed, [""; 0]);
        folder.write("report.html", b"abd").unwrap();
        folder.remove("junit.xml").unwrap();
        assert_eq!(
            compared(),
            ComparedResults { intact: vec![REPORT], changed: vec!["report.html", "junit.xml"] }
        );
        // Digests that were emptied, and the results that are there.
        folder.write(DIGESTS, b"\xff").unwrap();
        assert_eq!(compared().changed, [REPORT, "report.html"]);
    }
}
