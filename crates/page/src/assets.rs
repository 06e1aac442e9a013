//! Files that every page carries; `assets/SOURCE.md` says where they come from.

/// The script that draws plots (uPlot), embedded in each page.
pub(crate) const UPLOT_JS: &str = include_str!("../assets/uPlot.iife.min.js");
pub(crate) const UPLOT_CSS: &str = include_str!("../assets/uPlot.min.css");
/// What uPlot needs before it is loaded.
pub(crate) const LOCALE_JS: &str = include_str!("../assets/locale.js");
/// The look of the page, and what draws its plots.
pub(crate) const PAGE_CSS: &str = include_str!("../assets/page.css");
pub(crate) const PAGE_JS: &str = include_str!("../assets/page.js");

#[cfg(test)]
mod tests {
    use std::fmt::Write;

    use sha2::{Digest, Sha256};

    use super::*;

    #[test]
    fn what_comes_from_elsewhere_is_what_its_source_says() {
        let source = include_str!("../assets/SOURCE.md");
        for text in [UPLOT_JS, UPLOT_CSS] {
            let hash = Sha256::digest(text).iter().fold(String::new(), |mut hex, byte| {
                write!(hex, "{byte:02x}").unwrap();
                hex
            });
            assert!(source.contains(&hash), "{hash}");
        }
    }

    /// The elements that they stand in end with `</script>` and `</style>`.
    #[test]
    fn no_asset_ends_its_element() {
        for text in [UPLOT_JS, LOCALE_JS, PAGE_JS, UPLOT_CSS, PAGE_CSS] {
            assert!(!text.contains("</"));
        }
    }
}
