//! Every reader on the saved corpus of the fuzz targets in `fuzz/`: refused in words or read, never a panic. The corpus is
//! bounded, and so is the time.

use std::{fs, path::Path};

#[path = "../fuzz/src/readers.rs"]
#[allow(unreachable_pub, reason = "the fuzz targets share the file")]
mod readers;

use readers::{Kind, Readers};

/// Most bytes of the corpus of one kind, and of one input: what the gate has time for.
const MOST_BYTES: [u64; 2] = [400_000, 100_000];
/// Most inputs of one kind.
const MOST_INPUTS: usize = 400;

#[test]
fn no_reader_panics_on_the_saved_corpus() {
    let corpus = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/corpus");
    let readers = Readers::new();
    for (kind, name) in Kind::ALL {
        let entries =
            fs::read_dir(corpus.join(name)).unwrap_or_else(|error| panic!("fuzz/corpus/{name}: {error}"));
        let mut inputs: Vec<_> = entries.map(|entry| entry.unwrap().path()).collect();
        inputs.sort();
        assert!((1..=MOST_INPUTS).contains(&inputs.len()), "{name}: {} inputs", inputs.len());
        let sizes: Vec<u64> = inputs.iter().map(|input| input.metadata().unwrap().len()).collect();
        assert!(sizes.iter().sum::<u64>() <= MOST_BYTES[0], "{name}");
        assert!(sizes.iter().all(|&size| size <= MOST_BYTES[1]), "{name}");
        for input in inputs {
            let bytes = fs::read(&input).unwrap();
            let read = std::panic::catch_unwind(|| readers.read_everything(kind, &bytes));
            assert!(read.is_ok(), "{} panics", input.display());
        }
    }
}
