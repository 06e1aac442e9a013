//! Opens a page in a real browser, headless Chromium where it is installed, and says what became of it.

#![allow(clippy::print_stderr, reason = "a skipped test says so")]

use std::{fs, path::Path, process::Command};

use serde_json::Value;

/// Text of an attribute or an element.
pub(super) fn unescaped(text: &str) -> String {
    [("&lt;", "<"), ("&gt;", ">"), ("&quot;", "\""), ("&amp;", "&")]
        .iter()
        .fold(text.to_owned(), |text, (escaped, plain)| text.replace(escaped, plain))
}

/// The text of a file.
pub(super) fn read(path: &Path) -> String {
    fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// Notes what goes wrong, from before the first script of the page.
const WATCH: &str = "<script>window.wrong = [];
addEventListener('error', (event) => wrong.push('error: ' + event.message), true);
addEventListener('unhandledrejection', (event) => wrong.push('rejection: ' + event.reason));
addEventListener('securitypolicyviolation', (event) => wrong.push('request: ' + event.blockedURI));</script>";

/// Writes what became of the page into it.
const REPORT: &str = "<script>addEventListener('load', () => setTimeout(() => {
  const found = { wrong, fetched: performance.getEntriesByType('resource').map((entry) => entry.name), plots: 0, empty: [], largest: {} };
  for (const figure of document.querySelectorAll('figure[data-chart]')) {
    if (figure.closest('details:not([open])')) continue;
    found.plots += 1;
    const canvas = figure.querySelector('canvas');
    const pixels = canvas ? canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data : [];
    if (!pixels.some((value) => value > 0)) found.empty.push(figure.dataset.chart);
  }
  const data = document.getElementById('plots');
  for (const chart of data ? JSON.parse(data.textContent).charts : []) {
    const all = chart.lines.flatMap((line) => {
      const bytes = Uint8Array.from(atob(line.values), (letter) => letter.charCodeAt(0));
      return Array.from(new Float32Array(bytes.buffer));
    });
    found.largest[chart.id] = Math.max(...all);
  }
  found.images = document.querySelectorAll('img').length;
  const place = document.createElement('pre');
  place.id = 'found';
  place.textContent = JSON.stringify(found);
  document.body.append(place);
}, 300));</script>";

fn browser() -> Option<&'static str> {
    let names = ["chromium", "chromium-browser", "google-chrome", "chrome"];
    let found = names.into_iter().find(|name| {
        Command::new(name).arg("--version").output().is_ok_and(|output| output.status.success())
    });
    if found.is_none() {
        eprintln!("skipped: no Chromium is installed");
    }
    found
}

/// Opens a page in the browser; gives what was found in it, or `None` without a browser.
pub(super) fn opened(page: &Path) -> Option<Value> {
    let browser = browser()?;
    let html = read(page);
    let watched = html.replacen("<head>", &format!("<head>{WATCH}"), 1).replacen(
        "</body>",
        &format!("{REPORT}</body>"),
        1,
    );
    let copy = page.with_extension("watched.html");
    fs::write(&copy, watched).unwrap();
    let profile = tempfile::tempdir().unwrap();
    let log = profile.path().join("net.json");
    let output = Command::new(browser)
        .args([
            "--headless",
            "--no-sandbox",
            "--disable-gpu",
            "--no-first-run",
            "--disable-background-networking",
        ])
        .args([
            "--disable-component-update",
            "--disable-sync",
            "--disable-default-apps",
            "--window-size=1400,1000",
        ])
        .args(["--virtual-time-budget=5000", "--dump-dom"])
        .arg(format!("--user-data-dir={}", profile.path().display()))
        .arg(format!("--log-net-log={}", log.display()))
        .arg(format!("file://{}", copy.canonicalize().unwrap().display()))
        .output()
        .unwrap();
    let shown = String::from_utf8_lossy(&output.stdout);
    let found = shown.split_once("<pre id=\"found\">").and_then(|(_, rest)| rest.split_once("</pre>"));
    let (found, _) = found.unwrap_or_else(|| panic!("{shown}\n{}", String::from_utf8_lossy(&output.stderr)));
    let mut found: Value = serde_json::from_str(&unescaped(found)).unwrap();
    // What the browser asks for itself, as whether there is a new version, has no origin; what a page asks has one.
    let log = read(&log);
    let initiators = log.split("\"initiator\":\"").skip(1);
    found["requests"] = initiators.filter(|rest| !rest.starts_with("not an origin")).count().into();
    Some(found)
}

/// A page with nothing wrong in the browser; gives what was found.
#[track_caller]
pub(super) fn opens_well(page: &Path) -> Option<Value> {
    let found = opened(page)?;
    assert_eq!(found["wrong"], Value::Array(Vec::new()), "{}", page.display());
    assert_eq!(found["fetched"], Value::Array(Vec::new()), "{}", page.display());
    assert_eq!(found["empty"], Value::Array(Vec::new()), "{}", page.display());
    assert_eq!(found["requests"], 0, "{}", page.display());
    Some(found)
}
