//! Words of a spec and of a profile have no effect where they are written: whatever the names of a design, a machine and its
//! clamps, every kind of file has the same structure as with plain names, and is proven.

use std::collections::BTreeSet;
use std::path::Path;
use std::sync::LazyLock;

use proptest::prelude::*;
use serde_json::Value;

use stargrip_cam::artifact::{Format, Kind, KindRequest};
use stargrip_cam::pipeline::{self, Built, Sources};
use stargrip_cam::spec::{self, Source};

use crate::support;

/// Words that try to break out of the place they are in: of HTML, SVG, JSON, PDF, DXF, G-code, templates, terminals and shells.
const HOSTILE: [&str; 28] = [
    "</script><script>alert(1)</script>",
    "<!--",
    "-->",
    "]]>",
    "'\" onload='x()'",
    "\"><svg onload=alert(1)>",
    "<a href=\"javascript:x\">",
    "&lt;&#60;&amp",
    "<!DOCTYPE x [<!ENTITY y SYSTEM \"file:///etc/passwd\">]>&y;",
    "https://example.org/",
    "\"}, \"uri\": \"x\", {\"",
    "\\u003c\\",
    "{{DATA}}",
    "${x}`",
    ") >> /OpenAction << /S /JavaScript /JS (x",
    "endobj",
    "\\)\\(",
    "%%EOF",
    "EOF SECTION",
    "G0 Z-50",
    "; M3 S1000",
    "(x) $H !",
    "../../x",
    "$(reboot)",
    "%s%n",
    "\u{e9}\u{1F600}\u{661f}",
    "solid",
    " ",
];

/// All kinds that have words in them, and one of each format.
const KINDS: [Kind; 14] = [
    Kind::SealGcode,
    Kind::Seal3mf,
    Kind::TraceGcode,
    Kind::SealSvg,
    Kind::SealDxf,
    Kind::MaskSvg,
    Kind::MaskPdf,
    Kind::MaskStl,
    Kind::PreviewSvg,
    Kind::Prediction,
    Kind::PreviewPng,
    Kind::SceneGlb,
    Kind::Mjcf,
    Kind::Report,
];

#[test]
fn every_format_has_a_kind_among_those_with_hostile_words() {
    let missing: Vec<&str> = Format::ALL
        .into_iter()
        .filter(|(_, format)| *format != Format::Toml && !KINDS.iter().any(|kind| kind.format() == *format))
        .map(|(ending, _)| ending)
        .collect();
    assert!(missing.is_empty(), "no kind of {missing:?}");
}

/// A gripper called `name`, on a machine called `machine` with a clamp called `clamp`; `None` if it is refused.
fn built(name: &str, machine: &str, clamp: &str) -> Option<Built> {
    let quoted = |text: &str| serde_json::to_string(text).expect("a text");
    let load = "[load]\npressure = \"20 kPa\"\nobject_radius = \"40 mm\"\nfriction = 0.5\n";
    let spec = format!(
        "schema = 1\nname = {}\n[star]\npoints = 4\ninner_radius = \"50 mm\"\ntube_width = \"25 mm\"\ntip_angle = \"45 deg\"\n{load}",
        quoted(name)
    );
    let profile: String = support::generic()
        .lines()
        .map(|line| match line.split(" = ").next() {
            Some("name") => format!("name = {}\n", quoted(machine)),
            Some("description") => format!("description = {}\n", quoted(machine)),
            _ => format!("{line}\n"),
        })
        .collect();
    let profile = format!(
        "{profile}\n[[keep_out]]\nname = {}\nx = \"0 mm\"\ny = \"0 mm\"\nwidth = \"2 mm\"\ndepth = \"2 mm\"\nheight = \"1 mm\"\n",
        quoted(clamp)
    );
    let read = spec::read(&Source::new("x", spec.clone())).ok()?.spec;
    let profile_read = spec::read_machine(&Source::new("y", profile.clone())).ok()?;
    let (default_kinds, extras) = KINDS.into_iter().partition(|kind| !kind.is_extra());
    let sources = Sources { spec: &spec, machine: &profile };
    Some(
        pipeline::build(&read, &profile_read, sources, &KindRequest { only: default_kinds, with: extras })
            .expect("a gripper"),
    )
}

/// The structure of a file without its words: a list of its marks.
fn bones(file: &str, bytes: &[u8]) -> BTreeSet<String> {
    let ending = file.rsplit_once('.').expect("an ending").1;
    let text = || std::str::from_utf8(bytes).expect("UTF-8");
    let set = |marks: &mut dyn Iterator<Item = String>| marks.collect::<BTreeSet<String>>();
    match ending {
        "svg" | "xml" => {
            let document = roxmltree::Document::parse(text()).expect("XML");
            let names = |node: roxmltree::Node<'_, '_>| {
                let attributes: Vec<&str> = node.attributes().map(|attribute| attribute.name()).collect();
                format!("{} {attributes:?}", node.tag_name().name())
            };
            set(&mut document.descendants().filter(roxmltree::Node::is_element).map(names))
        }
        "html" => {
            let counts = ["<", ">", "<script"].map(|mark| format!("{mark} {}", text().matches(mark).count()));
            set(&mut counts.into_iter())
        }
        "json" => keys(&serde_json::from_str(text()).expect("JSON")),
        "glb" => {
            let length = u32::from_le_bytes(bytes[12..16].try_into().expect("four bytes")) as usize;
            keys(&serde_json::from_slice(&bytes[20..20 + length]).expect("JSON"))
        }
        "png" => {
            let (mut place, mut kinds) = (8, BTreeSet::new());
            while place < bytes.len() {
                let length =
                    u32::from_be_bytes(bytes[place..place + 4].try_into().expect("four bytes")) as usize;
                let _ = kinds.insert(String::from_utf8_lossy(&bytes[place + 4..place + 8]).into_owned());
                place += 12 + length;
            }
            kinds
        }
        "pdf" => {
            // The title is between brackets, and has none itself.
            let text: String = String::from_utf8_lossy(bytes)
                .split('(')
                .enumerate()
                .map(|(i, part)| {
                    if i == 0 { part } else { part.split_once(')').expect("an end").1 }.to_owned()
                })
                .collect();
            let names =
                text.split('/').skip(1).map(|rest| rest.split(|c: char| !c.is_ascii_alphanumeric()).next());
            let names = names.map(|name| name.unwrap_or_default().to_owned());
            set(&mut names.chain([format!("{} objects", text.matches("endobj").count())]))
        }
        "gcode" => {
            assert!(text().is_ascii());
            let code = text().lines().filter(|line| !line.starts_with(';'));
            let word = |line: &str| line.split([' ', '.']).next().unwrap_or_default().to_owned();
            set(&mut code.map(word).chain([format!("{} comments", text().matches(';').count())]))
        }
        "dxf" => {
            assert!(text().is_ascii());
            set(&mut [format!("{} lines", text().lines().count())].into_iter())
        }
        "stl" => {
            let inert = |byte: &u8| byte.is_ascii_alphanumeric() || b" .,-_+=:/".contains(byte);
            assert!(bytes[..80].iter().all(inert) && !bytes.starts_with(b"solid"));
            BTreeSet::new()
        }
        other => panic!("a file of another kind: {other}"),
    }
}

/// Every key of every object.
fn keys(value: &Value) -> BTreeSet<String> {
    match value {
        Value::Object(map) => {
            map.iter().flat_map(|(key, value)| keys(value).into_iter().chain([key.clone()])).collect()
        }
        Value::Array(list) => list.iter().flat_map(keys).collect(),
        _ => BTreeSet::new(),
    }
}

/// The files that the program writes itself: spec and profile are copies of the inputs.
fn written_files(built: &Built) -> Vec<(String, Vec<u8>)> {
    let files =
        built.files().filter(|(name, _)| Path::new(name).extension().is_none_or(|ending| ending != "toml"));
    files.map(|(name, bytes)| (name.to_owned(), bytes.into_owned())).collect()
}

/// The gripper with plain names.
static PLAIN: LazyLock<Vec<(String, Vec<u8>)>> =
    LazyLock::new(|| written_files(&built("plain", "plain", "plain").expect("a gripper")));

fn words() -> impl Strategy<Value = String> {
    prop::collection::vec(prop::sample::select(HOSTILE.to_vec()), 1..5)
        .prop_map(|words| words.concat().chars().take(80).collect::<String>())
        .prop_filter("a name", |name| !name.trim().is_empty())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    #[test]
    fn names_mean_nothing_in_any_kind_of_file((name, machine, clamp) in (words(), words(), words())) {
        let result = built(&name, &machine, &clamp);
        prop_assume!(result.is_some());
        let gripper = result.expect("assumed");
        prop_assert_eq!(gripper.proof().findings, []);
        let (files, plain) = (written_files(&gripper), &*PLAIN);
        prop_assert_eq!(files.len(), plain.len());
        for ((file, bytes), (other, plain)) in files.iter().zip(plain) {
            prop_assert_eq!(file, other);
            prop_assert_eq!(bones(file, bytes), bones(file, plain), "{}", file);
        }
        let manifest = files.iter().find(|(file, _)| file == "manifest.json").expect("one");
        let manifest: Value = serde_json::from_slice(&manifest.1).expect("JSON");
        prop_assert_eq!(&manifest["name"], &name);
    }
}

/// The property can fail: other than plain words give another structure.
#[test]
fn bones_tell_what_does_not_belong() {
    let other =
        |file: &str, a: &str, b: &str| assert_ne!(bones(file, a.as_bytes()), bones(file, b.as_bytes()));
    other("a.svg", "<svg><g/></svg>", "<svg><script/></svg>");
    other("a.svg", "<svg/>", "<svg onload=''/>");
    other("a.html", "<p>x</p>", "<p><b>x</p>");
    other("a.json", "{\"a\": 1}", "{\"a\": 1, \"uri\": 2}");
    other("a.pdf", "<< /Title (x) >> endobj", "<< /Title (x) /JS (x) >> endobj");
    other("a.gcode", "G1 X1\n; x\n", "G1 X1\nM3\n; x\n");
    other("a.gcode", "G1 X1\n; x\n", "G1 X1 ; x\n; x\n");
    other("a.dxf", "0\nEOF\n", "0\nLINE\n0\nEOF\n");
}
