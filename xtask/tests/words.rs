//! Words that names and sentences of this project do without, since the field has a term that says more. CONTRIBUTING.md
//! says how a message is worded.

mod support;

use std::collections::BTreeMap;

use support::{files_below, name_of, read, root};

/// A word that is not used.
struct Word {
    /// The word, or the words of a phrase, in lower case. Names are split into their words first.
    phrase: &'static str,
    /// What to write.
    instead: &'static str,
    /// Phrases with the word that are plain or technical English.
    except: &'static [&'static str],
    /// Files in which it is a technical term.
    not_in: &'static [&'static str],
    /// How often it may occur: today's count. It only falls.
    most: usize,
}

/// A word without any exception.
const fn never(phrase: &'static str, instead: &'static str) -> Word {
    Word { phrase, instead, except: &[], not_in: &[], most: 0 }
}

const WORDS: &[Word] = &[
    never("told", "reported, distinguished, commanded, said"),
    never("tell", "report, distinguish"),
    never("tells", "reports, distinguishes, says"),
    never("teller", "the thing that is reported, as a noun"),
    never("slip", "mistake"),
    never("slips", "mistakes"),
    never("handy", "the unit: engineering unit"),
    never("price", "complexity, cost"),
    never("yardstick", "reference, scale"),
    never("accusation", "explanation, finding"),
    never("suspect", "candidate"),
    never("witness", "source"),
    never("witnesses", "sources"),
    never("gauge", "free choice"),
    never("blame", "explain, name"),
    never("blamed", "named"),
    // The word of PyO3 for a class whose instances never change.
    Word {
        not_in: &["crates/python/src/robot/class.rs", "crates/python/src/report/class.rs"],
        ..never("frozen", "held, constant")
    },
    never("besides", "beside, as well, except"),
    never("but for", "except for, up to"),
    never("seen from", "expressed in, in a view from"),
    never("what is left", "the residual, the rest, the margin"),
    never("no finite number", "not a finite number"),
    never("no finite value", "not a finite value"),
    // The description of a field in the schema of comparisons.
    Word { most: 1, ..never("is no number", "is not a number") },
    never("are no numbers", "are not numbers"),
    // A key of the reports of `check`, which other programs read.
    Word { most: 33, ..never("not asked", "not compared, not requested") },
    never("mended", "corrected"),
    never("mends", "corrects"),
    never("probed", "identified, sampled"),
    never("probing", "identifying, sampling"),
    // The instrument of that name is a term.
    Word { except: &["touch probe"], ..never("probe", "identify, sample") },
    never("climb", "local search"),
    never("climbed", "found by local search"),
    // Leaves of a tree of values are a term; a thing that leaves a place goes away from it. Two remain, one of them in a schema.
    Word {
        except: &[
            "leaves the reach",
            "leaves its limits",
            "leaves the project",
            "leaves nothing behind",
            "correction leaves",
            "that leaves",
        ],
        not_in: &["crates/results/src/comparison/reports.rs"],
        most: 2,
        ..never("leaves", "residual, omits, gives")
    },
    // A symbol stands for something; an arm is at rest.
    Word { except: &["stands for", "stands in", "as it stands"], ..never("stands", "is at rest, is at") },
    // Senses of direction and manner; the way of a motion is its path.
    Word {
        except: &[
            "other way",
            "either way",
            "half way",
            "under way",
            "each way",
            "same way",
            "this way",
            "one way",
            "which way",
            "whichever way",
            "give way",
            "gives way",
            "common way",
            "that way",
        ],
        ..never("way", "path, distance, direction")
    },
    Word {
        except: &["different ways", "both ways", "other ways"],
        ..never("ways", "paths, distances, notations")
    },
];

/// Folders of sources and pages of documents that keep to the words.
fn texts() -> Vec<(String, String)> {
    let root = root();
    let mut files = Vec::new();
    for folder in ["crates", "tests"] {
        files.extend(files_below(&root.join(folder), "rs"));
    }
    files.extend(files_below(&root.join("docs"), "md"));
    for page in ["README.md", "CONTRIBUTING.md", "DESIGN.md", "ARCHITECTURE.md", "CONVENTIONS.md"] {
        files.push(root.join(page));
    }
    let texts = files.into_iter().map(|path| (name_of(&path), read(&path)));
    // What was written in former releases stays as it was.
    texts.filter(|(name, _)| name != "docs/history.md").collect()
}

/// The words of a text.
struct Words {
    /// Each with its line, in lower case; an empty one where a sentence ends.
    words: Vec<(usize, String)>,
    /// Where each word is in that list.
    places: BTreeMap<String, Vec<usize>>,
}

/// The words of a text: names are parted at underscores and capitals. A full stop or a bracket parts sentences.
fn words(text: &str) -> Words {
    let mut found: Vec<(usize, String)> = Vec::new();
    for (index, line) in text.lines().enumerate() {
        let line = line.trim_start().trim_start_matches(['/', '!', '#', '*']);
        let (mut word, mut before) = (String::new(), ' ');
        for letter in line.chars().chain([' ']) {
            let is_new_word = letter.is_uppercase() && before.is_lowercase();
            if (is_new_word || !letter.is_alphanumeric()) && !word.is_empty() {
                found.push((index + 1, std::mem::take(&mut word)));
            }
            if letter.is_alphanumeric() {
                word.extend(letter.to_lowercase());
            } else if ".;:(){}[]".contains(letter) {
                found.push((index + 1, String::new()));
            }
            before = letter;
        }
    }
    let mut places: BTreeMap<String, Vec<usize>> = BTreeMap::new();
    for (at, (_, word)) in found.iter().enumerate() {
        places.entry(word.clone()).or_default().push(at);
    }
    Words { words: found, places }
}

/// The lines on which a word is used, except for the phrases in which it may be.
fn uses(text: &Words, word: &Word) -> Vec<usize> {
    let starts_at = |at: usize, phrase: &str| {
        let mut steps = phrase.split(' ').enumerate();
        steps.all(|(step, part)| text.words.get(at + step).is_some_and(|(_, word)| word == part))
    };
    let is_exempt = |at: usize| {
        word.except.iter().any(|phrase| {
            let offset = phrase.split(' ').position(|part| part == word.phrase).unwrap_or_default();
            at.checked_sub(offset).is_some_and(|start| starts_at(start, phrase))
        })
    };
    let first = word.phrase.split(' ').next().unwrap_or_default();
    let places = text.places.get(first).into_iter().flatten().copied();
    places.filter(|&at| starts_at(at, word.phrase) && !is_exempt(at)).map(|at| text.words[at].0).collect()
}

#[test]
fn words_that_are_not_used() {
    let texts: Vec<_> = texts().into_iter().map(|(name, text)| (name, words(&text))).collect();
    let mut faults = Vec::new();
    for word in WORDS {
        let mut found = Vec::new();
        for (name, words) in texts.iter().filter(|(name, _)| !word.not_in.contains(&name.as_str())) {
            found.extend(uses(words, word).into_iter().map(|line| format!("{name}:{line}")));
        }
        if found.len() > word.most {
            let Word { phrase, instead, most, .. } = word;
            let places = found.join("\n    ");
            faults.push(format!(
                "\"{phrase}\" occurs {} times, {most} are allowed; write: {instead}\n    {places}",
                found.len()
            ));
        }
    }
    assert!(faults.is_empty(), "words that this project does not use:\n{}", faults.join("\n"));
}

#[test]
fn words_are_found_in_names_and_sentences() {
    let used = |text: &str, word: &Word| uses(&words(text), word);
    let told = never("told", "");
    assert_eq!(used("fn is_told() {}\nstruct ToldNow;\nlet TOLD = untold;", &told), [1, 2, 3]);
    let rest = never("what is left", "");
    assert_eq!(used("/// of what is\n/// left. What is. Left", &rest), [1]);
    let way = Word { except: &["half way"], ..never("way", "") };
    assert_eq!(used("let half_way = on_the_way; // always half way there", &way), [1]);
}
