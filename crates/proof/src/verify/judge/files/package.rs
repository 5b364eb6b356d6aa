//! Packages of Bambu Lab's printers: a 3MF file whose parts must lead to one program, with its MD5 and its time.
//!
//! The parts are found as Bambu Studio's reader finds them (bambulab/BambuStudio, `src/libslic3r/Format/bbs_3mf.cpp`): from
//! `_rels/.rels` to the model, and from the settings of a plate to its program.

use roxmltree::{Document, Node};

use crate::verify::finding::quote;
use crate::verify::read::svg::parse;
use crate::verify::read::zip::{ZipEntry, read_zip};
use crate::verify::{Finding, FindingCode, Findings};
use spec::digest::md5;

/// Settings of plates.
const SETTINGS: &str = "Metadata/model_settings.config";
/// Relationships of these settings.
const SETTINGS_RELATIONSHIPS: &str = "Metadata/_rels/model_settings.config.rels";
/// The time of plates.
const SLICE_INFO: &str = "Metadata/slice_info.config";
/// Parts that stand at a fixed place.
const FIXED: [&str; 5] = ["[Content_Types].xml", "_rels/.rels", SETTINGS, SETTINGS_RELATIONSHIPS, SLICE_INFO];
/// Kind of the relationship to the model.
const MODEL_KIND: &str = "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel";
/// Kind of the relationship to a program.
const PROGRAM_KIND: &str = "http://schemas.bambulab.com/package/2021/gcode";

/// The parts of a package.
struct Package<'a>(Vec<ZipEntry<'a>>);

impl<'a> Package<'a> {
    /// The text of the part called `name`.
    fn text(&self, name: &str) -> Result<&'a str, Finding> {
        let part = self.0.iter().find(|entry| entry.name == name);
        let part = part.ok_or_else(|| fault(format!("no {}", quote(name)), "that part"))?;
        std::str::from_utf8(part.content).map_err(|_| {
            let problem = format!("bytes that are not UTF-8 in {}", quote(name));
            Finding::new(FindingCode::NotText, problem, "text")
        })
    }

    /// The part that the relationships in `part` name as their only one, of this kind.
    fn target(&self, part: &str, kind: &str) -> Result<String, Finding> {
        let document = parse(self.text(part)?)?;
        let targets: Vec<&str> = elements(&document, "Relationship")
            .filter(|relationship| relationship.attribute("Type") == Some(kind))
            .filter_map(|relationship| relationship.attribute("Target"))
            .collect();
        match targets[..] {
            [target] => Ok(target.trim_start_matches('/').to_owned()),
            _ => Err(fault(format!("{} targets in {}", targets.len(), quote(part)), "1 target")),
        }
    }

    /// The value under `key` of the only plate in `part`.
    fn of_plate(&self, part: &str, key: &str) -> Result<String, Finding> {
        let document = parse(self.text(part)?)?;
        let plates: Vec<Node<'_, '_>> = elements(&document, "plate").collect();
        let [plate] = plates[..] else {
            return Err(fault(format!("{} plates in {}", plates.len(), quote(part)), "1 plate"));
        };
        let mut values = plate.children().filter(|child| child.attribute("key") == Some(key));
        match (values.next().and_then(|value| value.attribute("value")), values.next()) {
            (Some(value), None) => Ok(value.to_owned()),
            _ => Err(fault(format!("no single {} in {}", quote(key), quote(part)), "1 value")),
        }
    }

    /// The program to which all parts lead.
    fn program(&self) -> Result<&'a str, Finding> {
        let types = parse(self.text("[Content_Types].xml")?)?;
        let mut endings = ["rels", "model", "gcode"].into_iter();
        if let Some(ending) = endings.find(|ending| !has_type(&types, ending)) {
            return Err(fault(format!("no type of {}", quote(ending)), "a type for each ending"));
        }
        let model = self.target("_rels/.rels", MODEL_KIND)?;
        let model_tree = parse(self.text(&model)?)?;
        if model_tree.root_element().tag_name().name() != "model" {
            return Err(fault(quote(model_tree.root_element().tag_name().name()), "a root element model"));
        }
        let name = self.of_plate(SETTINGS, "gcode_file")?;
        let related = self.target(SETTINGS_RELATIONSHIPS, PROGRAM_KIND)?;
        if related != name {
            return Err(fault(quote(&related), quote(&name)));
        }
        let program = self.text(&name)?;
        let checksum = format!("{name}.md5");
        let stated = self.text(&checksum)?;
        let allowed = md5(program);
        if stated != allowed {
            return Err(fault(format!("MD5 {}", quote(stated)), allowed));
        }
        let time = self.of_plate(SLICE_INFO, "prediction")?;
        let allowed = stated_time(program).unwrap_or_default();
        if time != allowed {
            return Err(fault(
                format!("a time of {} s", quote(&time)),
                format!("{allowed} s, as in the program"),
            ));
        }
        let parts = FIXED.into_iter().chain([model.as_str(), &name, &checksum]);
        // Each of them was read.
        if self.0.len() != parts.clone().count() {
            return Err(fault(format!("{} parts", self.0.len()), parts.collect::<Vec<_>>().join(", ")));
        }
        Ok(program)
    }
}

/// The elements called `name`, wherever they stand.
fn elements<'d, 'i>(document: &'d Document<'i>, name: &str) -> impl Iterator<Item = Node<'d, 'i>> {
    document.descendants().filter(move |node| node.tag_name().name() == name)
}

/// Whether the list of types has one for this `ending`.
fn has_type(types: &Document<'_>, ending: &str) -> bool {
    elements(types, "Default").any(|default| default.attribute("Extension") == Some(ending))
}

/// A finding about the parts.
fn fault(problem: impl Into<String>, allowed: impl Into<String>) -> Finding {
    Finding::new(FindingCode::WrongPackage, problem, allowed)
}

/// The time that a program states in its head, whole seconds.
fn stated_time(program: &str) -> Option<&str> {
    let total = program.lines().find_map(|line| line.strip_prefix("; total: "))?;
    total.split(' ').find_map(|word| word.strip_prefix("time_s="))
}

/// The program in the package `bytes`; `None`, with a finding, if its parts do not lead to one.
pub fn program_in<'a>(bytes: &'a [u8], findings: &mut Findings) -> Option<&'a str> {
    let program = read_zip(bytes).and_then(|entries| Package(entries).program());
    program.map_err(|finding| findings.push(finding)).ok()
}
