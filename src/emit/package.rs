//! The **package** that Bambu Lab's printers take: a sealing program in a 3MF file, `NAME.gcode.3mf`.
//!
//! A 3MF file is a ZIP of parts that name each other. Source of the parts: the repositories bambulab/BambuStudio and
//! OrcaSlicer/OrcaSlicer, `src/libslic3r/Format/bbs_3mf.cpp`. Its writer (`_BBS_3MF_Exporter`) names the program in the settings of plate
//! 1 and in their relationships, and states its MD5 in upper case. Its reader (`load_gcode_3mf_from_stream`) refuses a file without a
//! model that `_rels/.rels` names. What a printer asks for beyond that is not published. Parts that describe filament, a slicer or a
//! model of printer are left out: nothing here is made by a slicer.
//!
//! Entries are stored, not compressed, and dated by the format's first day: the same program has the same bytes.

use crate::emit::picture::crc32;
use spec::digest::md5;

/// The program's part.
const PROGRAM: &str = "Metadata/plate_1.gcode";
/// The types of the parts by their endings, as Bambu Studio has them.
const CONTENT_TYPES: &str = r#"<?xml version="1.0" encoding="UTF-8"?>
<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types">
 <Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/>
 <Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/>
 <Default Extension="gcode" ContentType="text/x.gcode"/>
</Types>
"#;
/// A model without a solid: a sealed sheet has none, and a reader asks for the part.
const MODEL: &str = r#"<?xml version="1.0" encoding="UTF-8"?>
<model unit="millimeter" xml:lang="en-US" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02">
 <metadata name="Application">stargrip-cam</metadata>
 <resources/>
 <build/>
</model>
"#;
/// The settings of plate 1, which name the program.
const SETTINGS: &str = r#"<?xml version="1.0" encoding="UTF-8"?>
<config>
  <plate>
    <metadata key="plater_id" value="1"/>
    <metadata key="plater_name" value=""/>
    <metadata key="locked" value="false"/>
    <metadata key="gcode_file" value="Metadata/plate_1.gcode"/>
  </plate>
</config>
"#;

/// Day of every entry, as MS-DOS writes it: 1 January 1980.
const DATE: u16 = 0x21;
/// Version of the format that a reader needs: 2.0, the least that packages name.
const VERSION: u16 = 20;

/// The package of `program`, G-code that takes `seconds` in all; `None` if it is too long for the format, 4 GiB.
///
/// The time is stated in whole seconds, as in the program's own head.
pub fn package(program: &str, seconds: f64) -> Option<Vec<u8>> {
    let checksum = md5(program);
    let start =
        relationship("3D/3dmodel.model", "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel");
    let of_plate = relationship(PROGRAM, "http://schemas.bambulab.com/package/2021/gcode");
    let slice = slice_info(seconds);
    zip(&[
        ("[Content_Types].xml", CONTENT_TYPES),
        ("3D/3dmodel.model", MODEL),
        ("Metadata/plate_1.gcode.md5", &checksum),
        (PROGRAM, program),
        ("Metadata/_rels/model_settings.config.rels", &of_plate),
        ("Metadata/model_settings.config", SETTINGS),
        ("Metadata/slice_info.config", &slice),
        ("_rels/.rels", &start),
    ])
}

/// The part that names `target`, of this kind.
fn relationship(target: &str, kind: &str) -> String {
    format!(
        r#"<?xml version="1.0" encoding="UTF-8"?>
<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">
 <Relationship Target="/{target}" Id="rel-1" Type="{kind}"/>
</Relationships>
"#
    )
}

/// The part that states the time of plate 1, s.
fn slice_info(seconds: f64) -> String {
    format!(
        r#"<?xml version="1.0" encoding="UTF-8"?>
<config>
  <plate>
    <metadata key="index" value="1"/>
    <metadata key="prediction" value="{seconds:.0}"/>
  </plate>
</config>
"#
    )
}

/// A ZIP (PKWARE's APPNOTE 6.3.10) of these names and contents, stored; `None` if it is too long for 32 bits.
fn zip(entries: &[(&str, &str)]) -> Option<Vec<u8>> {
    let (mut file, mut directory) = (Vec::new(), Vec::new());
    for (name, content) in entries {
        let offset = u32::try_from(file.len()).ok()?;
        let facts = entry_facts(name, content)?;
        file.extend(b"PK\x03\x04");
        file.extend(&facts);
        file.extend(name.as_bytes());
        file.extend(content.as_bytes());
        directory.extend(b"PK\x01\x02");
        directory.extend(VERSION.to_le_bytes());
        directory.extend(&facts);
        // No comment, the first disk, no attributes.
        directory.extend([0; 10]);
        directory.extend(offset.to_le_bytes());
        directory.extend(name.as_bytes());
    }
    let offset = u32::try_from(file.len()).ok()?;
    let length = u32::try_from(directory.len()).ok()?;
    let count = u16::try_from(entries.len()).ok()?.to_le_bytes();
    file.extend(directory);
    // One disk, and no comment.
    file.extend(b"PK\x05\x06\0\0\0\0");
    file.extend([count, count].concat());
    file.extend(length.to_le_bytes());
    file.extend(offset.to_le_bytes());
    file.extend([0; 2]);
    Some(file)
}

/// What both headers of a stored entry state: version, method, date, checksum, lengths.
fn entry_facts(name: &str, content: &str) -> Option<Vec<u8>> {
    let length = u32::try_from(content.len()).ok()?.to_le_bytes();
    let mut facts = VERSION.to_le_bytes().to_vec();
    // No flags, stored, at midnight.
    facts.extend([0; 6]);
    facts.extend(DATE.to_le_bytes());
    facts.extend(crc32(content.as_bytes()).to_le_bytes());
    facts.extend([length, length].concat());
    facts.extend(u16::try_from(name.len()).ok()?.to_le_bytes());
    facts.extend([0; 2]);
    Some(facts)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_same_program_has_the_same_package() {
        let first = package("G28\n", 61.4).expect("short");
        assert_eq!(Some(&first), package("G28\n", 61.4).as_ref());
        assert_ne!(Some(first), package("G29\n", 61.4));
    }

    fn contains(file: &[u8], part: &[u8]) -> bool {
        file.windows(part.len()).any(|window| window == part)
    }

    /// `printf 'G28\n' | md5sum` prints the MD5.
    #[test]
    fn a_package_states_checksums_of_its_program() {
        let file = package("G28\n", 61.4).expect("short");
        assert!(
            contains(&file, b"plate_1.gcode.md5BED3F671261EA5ABC6BE16B782D1C47B"),
            "the MD5 stands behind its name"
        );
        assert!(contains(&file, b"key=\"prediction\" value=\"61\""));
    }
}
