//! `docs/calibration.md`: measured sections replace their older versions.

use crate::explained::REASONS;
use crate::figure::Section;
use crate::pitch::LabError;
use std::fmt::Write as _;
use std::path::PathBuf;

const HEAD: &str = "# Calibration\n\nSetpiece's game beside Google Research Football's, as measured of version 2.10. `cargo \
                    xtask calibrate` writes this page; with `--check` it fails on a figure that is outside and not \
                    explained below.\n\n| section | figures | inside | outside, explained | outside, open |\n\
                    |---|---|---|---|---|\n";
const LAST: &str = "Explained";

/// Writes the page with these sections; others stay unchanged.
pub(crate) fn write(sections: &[Section]) -> Result<(), LabError> {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../docs/calibration.md");
    let before = std::fs::read_to_string(&path).unwrap_or_default();
    std::fs::write(&path, page(&before, sections))
        .map_err(|why| format!("{}: {why}", path.display()))
}

/// The page after `before` with these sections measured again.
fn page(before: &str, sections: &[Section]) -> String {
    let mut blocks: Vec<(String, String)> = Vec::new();
    for block in before.split("\n## ").skip(1).filter(|block| !block.starts_with(LAST)) {
        let title = block.lines().next().unwrap_or_default().to_owned();
        blocks.push((title, format!("## {}\n", block.trim_end())));
    }
    for section in sections {
        let title = format!("{}. {}", section.number, section.title);
        blocks.retain(|(other, _)| other.split('.').next() != title.split('.').next());
        blocks.push((title, section.markdown()));
    }
    blocks.sort_by(|(a, _), (b, _)| a.cmp(b));
    let mut text = String::from(HEAD);
    for (title, block) in &blocks {
        let rows = |end: &str| {
            block.lines().filter(|line| line.starts_with("| C-") && line.contains(end)).count()
        };
        let [inside, explained, open] =
            [rows("| ✓ |"), rows("| outside ["), rows("| **outside** |")];
        let all = inside + explained + open;
        let _ = writeln!(text, "| {title} | {all} | {inside} | {explained} | {open} |");
    }
    for (_, block) in &blocks {
        let _ = write!(text, "\n{}\n", block.trim_end());
    }
    let _ = write!(text, "\n## {LAST}\n\n");
    for (number, reason) in (1..).zip(REASONS) {
        let _ = writeln!(text, "{number}. {}", reason.why);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::page;
    use crate::figure::Section;

    #[test]
    fn a_section_measured_again_takes_the_place_of_its_older_self() {
        let section = |number, title, ours| {
            let mut section = Section::new(number, title, "how");
            section.within("a figure", "1", [0.5, 1.5], ours);
            section
        };
        let first = page("", &[section(2, "Movement", 1.0), section(3, "The ball", 9.0)]);
        assert!(first.contains("| 2. Movement | 1 | 1 | 0 | 0 |"), "{first}");
        assert!(first.contains("| 3. The ball | 1 | 0 | 0 | 1 |"), "{first}");
        let second = page(&first, &[section(3, "The ball", 1.0)]);
        assert!(second.contains("| 2. Movement | 1 | 1 | 0 | 0 |"), "{second}");
        assert!(second.contains("| 3. The ball | 1 | 1 | 0 | 0 |"), "{second}");
        assert_eq!(page(&second, &[]), second);
    }
}
