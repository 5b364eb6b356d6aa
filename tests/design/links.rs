//! `link` in [build]: previews and report lead back to their spec. Codes are read by someone else's reader in tests/strangers/web.mjs.

use stargrip_cam::artifact::{Kind, KindRequest};
use stargrip_cam::pipeline::{Built, Forecast, Sources};
use stargrip_cam::spec;
use stargrip_cam::spec::Source;

use crate::support;

const PAPER: &str = include_str!("../../designs/paper-five-points.toml");
const PILLOW: &str = include_str!("../../designs/drawings/pillow.toml");
const LINK: &str = "[build]\nlink = \"https://example.org/page/\"\n";

fn built(text: &str) -> (Built, Vec<String>) {
    let reading = spec::read(&Source::new("x.toml", text)).unwrap_or_else(|faults| panic!("{faults}"));
    let reading = reading.with_drawing(include_bytes!("../../designs/drawings/pillow.dxf"));
    let sources = Sources { spec: text, machine: support::generic() };
    let forecast = Forecast::new(reading.spec, support::machine()).expect("a design");
    let codes = forecast.warnings(sources).iter().map(|warning| warning.code.to_string()).collect();
    let request =
        KindRequest { only: vec![Kind::PreviewSvg, Kind::PreviewPng, Kind::Report], with: Vec::new() };
    (forecast.build(sources, &request), codes)
}

fn text_of(built: &Built, ending: &str) -> String {
    let (_, bytes) = built.files().find(|(name, _)| name.ends_with(ending)).expect("a file");
    String::from_utf8(bytes.into_owned()).expect("text")
}

/// The link in the report, as a browser reads it.
fn linked(built: &Built) -> Option<String> {
    let page = text_of(built, "report.html");
    let (link, _) = page.split_once("<footer>")?.1.split_once("href=\"")?.1.split_once('"')?;
    Some(link.replace("&#47;", "/").replace("&#38;", "&"))
}

#[test]
fn a_report_and_every_preview_lead_back_to_the_spec() {
    let (text, drawing_text) = (format!("{PAPER}\n{LINK}"), format!("{PILLOW}\n{LINK}"));
    for (text, plain, parts) in [(&text, PAPER, 1), (&drawing_text, PILLOW, 3)] {
        let ((linked_build, codes), (plain_build, _)) = (built(text), built(plain));
        assert_eq!(linked_build.proof().findings, []);
        assert!(!codes.contains(&"long-link".to_owned()), "{codes:?}");
        let link = linked(&linked_build).expect("a link");
        assert!(link.starts_with("https://example.org/page/#spec="), "{link}");
        assert_eq!(link.split('&').count(), parts, "{link}");
        assert_eq!(linked(&plain_build), None);
        assert!(text_of(&linked_build, "preview.svg").contains(">This spec in the page<"));
        assert!(!text_of(&plain_build, "preview.svg").contains(">This spec in the page<"));
    }
}

#[test]
fn a_link_that_is_too_long_is_told_and_leaves_no_code() {
    // Letters that no packer shortens much.
    let mut state = 1_u64;
    let letters = std::iter::repeat_with(|| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        char::from(b'a' + state.to_le_bytes()[7] % 26)
    });
    let text = format!("{PAPER}\n{} # {}\n", LINK.trim_end(), letters.take(6000).collect::<String>());
    let (gripper, codes) = built(&text);
    assert!(codes.contains(&"long-link".to_owned()), "{codes:?}");
    assert_eq!((gripper.proof().findings, linked(&gripper)), (Vec::new(), None));
    assert!(!text_of(&gripper, "preview.svg").contains(">This spec in the page<"));
}

#[test]
fn a_link_is_an_address_of_the_web() {
    let long = format!("https://{}", "a".repeat(193));
    for bad in [
        "",
        "https://",
        "example.org",
        "javascript:alert(1)",
        "https://a/#b",
        "https://a b",
        "https://a/\u{e9}",
        "https://a/<",
        &long,
    ] {
        let text = format!("{PAPER}\n[build]\nlink = {bad:?}\n");
        let faults = spec::read(&Source::new("x.toml", text)).expect_err(bad);
        assert_eq!(faults.list().iter().map(|fault| fault.code).collect::<Vec<_>>(), ["link"], "{bad}");
    }
}
