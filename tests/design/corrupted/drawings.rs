//! Drawings: paths lost, doubled, opened, and formats that disagree.

use super::{assert_found, forged};

#[test]
fn drawings_with_lost_doubled_or_opened_paths_are_found() {
    let svg = "sheet-1-outline.svg";
    let lines_without = |text: &str, part: &str| -> String {
        let remaining: Vec<&str> = text.lines().filter(|line| !line.contains(part)).collect();
        remaining.join("\n") + "\n"
    };
    assert_found(&forged(svg, |text| lines_without(text, "<circle")), "path-count", svg);
    assert_found(&forged(svg, |text| text.replacen(" Z\"", "\"", 1)), "open-loop", svg);
    let doubled = forged(svg, |text| {
        let path = text.lines().find(|line| line.contains("<path")).expect("a path");
        text.replacen(path, &format!("{path}\n{path}"), 1)
    });
    assert_found(&doubled, "path-length", svg);
    let moved = forged(svg, |text| text.replacen("<circle cx=\"", "<circle cx=\"1", 1));
    assert_found(&moved, "deviation", svg);
    let renamed = forged(svg, |text| text.replace("cut-hole", "engrave"));
    assert_found(&renamed, "unknown-layer", svg);
    let scaled = forged(svg, |text| text.replacen("mm\"", "px\"", 1));
    assert_found(&scaled, "wrong-scale", svg);
    let page = forged(svg, |text| text.replace("333.1", "334.1"));
    assert_found(&page, "wrong-size", svg);
}

#[test]
fn a_damaged_dxf_is_found() {
    let dxf = "sheet-1-seal.dxf";
    assert_found(&forged(dxf, |text| text.replace("  0\nEOF\n", "")), "truncated", dxf);
    let inches = forged(dxf, |text| text.replace("$INSUNITS\n 70\n4\n", "$INSUNITS\n 70\n1\n"));
    assert_found(&inches, "wrong-scale", dxf);
    let hollow = forged(dxf, |text| text.replacen(" 42\n-0.", " 42\n0.", 1));
    assert_found(&hollow, "deviation", dxf);
}

#[test]
fn formats_that_disagree_are_found() {
    let dxf = "sheet-1-seal.dxf";
    let findings = forged(dxf, |text| text.replace("  8\nseal-inner\n", "  8\nseal-outer\n"));
    assert_found(&findings, "formats-disagree", dxf);
}

/// The cost of a drawing grows with its length, and not with its square.
#[test]
fn a_drawing_of_300_000_subpaths_is_refused_at_once() {
    for body in ["<path d=\"{}\"/>", "<g>{}</g>"] {
        let piece = if body.contains("d=") { "M0 0L1 1" } else { "<circle transform=\"\" r=\"1\"/>" };
        let findings = forged("sheet-1-seal.svg", |svg| {
            let subpaths = body.replace("{}", &piece.repeat(300_000));
            svg.replacen("</g>", &format!("{subpaths}</g>"), 1)
        });
        assert!(!findings.is_empty());
    }
}
