//! The guide is whole: its contents list every page, and every link of every page leads somewhere. The book is built from
//! the same files by `mdbook build docs`.

use std::{
    collections::BTreeSet,
    fs,
    path::{Path, PathBuf},
};

use pulldown_cmark::{Event, Options, Parser, Tag, TagEnd};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..").canonicalize().expect("the workspace exists")
}

fn read(path: &Path) -> String {
    fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

fn is_page(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension == "md")
}

/// A path from the root.
fn name_of(path: &Path) -> String {
    path.strip_prefix(root()).expect("below the root").to_str().expect("names are UTF-8").to_owned()
}

/// The pages below a folder, as paths from the root.
fn pages_below(folder: &str) -> BTreeSet<String> {
    let mut pages = BTreeSet::new();
    let mut folders = vec![root().join(folder)];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).expect("a folder").flatten() {
            let path = entry.path();
            if path.is_dir() {
                folders.push(path);
            } else if is_page(&path) {
                pages.insert(name_of(&path));
            }
        }
    }
    pages
}

/// What one page links to, and the anchors that its headings have.
#[derive(Default)]
struct Outline {
    links: Vec<String>,
    anchors: BTreeSet<String>,
}

fn outline(text: &str) -> Outline {
    let mut outline = Outline::default();
    let mut heading: Option<String> = None;
    for event in Parser::new_ext(text, Options::ENABLE_TABLES) {
        match event {
            Event::Start(Tag::Link { dest_url, .. } | Tag::Image { dest_url, .. }) => {
                outline.links.push(dest_url.into_string());
            }
            Event::Start(Tag::Heading { .. }) => heading = Some(String::new()),
            Event::Text(text) | Event::Code(text) => {
                if let Some(heading) = &mut heading {
                    heading.push_str(&text);
                }
            }
            Event::End(TagEnd::Heading(_)) => {
                outline.anchors.extend(heading.take().map(|heading| anchor(&heading)));
            }
            _ => {}
        }
    }
    outline
}

/// The anchor of a heading, by the rule that mdBook and GitHub have in common.
fn anchor(heading: &str) -> String {
    let kept = heading.trim().chars().filter(|letter| letter.is_alphanumeric() || " -_".contains(*letter));
    kept.collect::<String>().to_lowercase().replace(' ', "-")
}

/// Pages whose links are checked: those of the guide and those in the root.
fn all_pages() -> BTreeSet<String> {
    let entries = fs::read_dir(root()).expect("the root").flatten();
    let in_root = entries.map(|entry| entry.path()).filter(|path| is_page(path));
    in_root.map(|path| name_of(&path)).chain(pages_below("docs")).collect()
}

#[test]
fn the_contents_list_every_page_once() {
    let summary = outline(&read(&root().join("docs/SUMMARY.md")));
    let listed: Vec<String> = summary.links.iter().map(|link| format!("docs/{link}")).collect();
    let once: BTreeSet<String> = listed.iter().cloned().collect();
    assert_eq!(once.len(), listed.len(), "a page is listed twice");
    let mut pages = pages_below("docs");
    pages.remove("docs/SUMMARY.md");
    assert_eq!(once, pages);
}

#[test]
fn every_link_leads_somewhere() {
    let mut count = 0;
    for page in all_pages() {
        let text = read(&root().join(&page));
        for link in outline(&text).links {
            count += 1;
            if link.starts_with("https://") {
                continue;
            }
            assert!(!link.contains("://"), "{page}: {link}: only https");
            let (file, anchor) =
                link.split_once('#').map_or((link.as_str(), None), |(file, anchor)| (file, Some(anchor)));
            let folder = root().join(&page).parent().expect("it is in a folder").to_owned();
            let target = if file.is_empty() { root().join(&page) } else { folder.join(file) };
            let target =
                target.canonicalize().unwrap_or_else(|_| panic!("{page}: {link}: there is no such file"));
            // The book holds `docs` alone.
            let in_book = page.starts_with("docs/");
            assert!(
                !in_book || target.starts_with(root().join("docs")),
                "{page}: {link} leads out of the book"
            );
            if let Some(anchor) = anchor {
                let anchors = outline(&read(&target)).anchors;
                assert!(anchors.contains(anchor), "{page}: {link}: there is no such heading in {anchors:?}");
            }
        }
    }
    assert!(count > 50, "{count} links were found");
}

/// Lines without indentation; what the formatter puts between them does not count.
fn code_lines(text: &str) -> Vec<&str> {
    text.lines().map(str::trim).filter(|line| !line.is_empty()).collect()
}

#[test]
fn programs_are_those_of_the_tests() {
    let tests = read(&root().join("crates/congruent/tests/guide.rs"));
    let tests = code_lines(&tests);
    let mut count = 0;
    for page in all_pages() {
        let text = read(&root().join(&page));
        for block in text.split("```rust\n").skip(1) {
            let program = code_lines(block.split("```").next().unwrap_or_default());
            let is_there = tests.windows(program.len()).any(|lines| lines == program);
            assert!(
                is_there,
                "{page}: crates/congruent/tests/guide.rs does not have\n{}",
                program.join("\n")
            );
            count += 1;
        }
    }
    assert!(count >= 4, "{count} programs were found");
}

#[test]
fn pictures_are_used() {
    let linked: BTreeSet<PathBuf> = all_pages()
        .iter()
        .flat_map(|page| {
            let path = root().join(page);
            let folder = path.parent().expect("it is in a folder").to_owned();
            outline(&read(&path))
                .links
                .into_iter()
                .filter_map(move |link| folder.join(link).canonicalize().ok())
        })
        .collect();
    for entry in fs::read_dir(root().join("docs/images")).expect("the pictures").flatten() {
        assert!(linked.contains(&entry.path()), "{} is in no page", entry.path().display());
    }
}
