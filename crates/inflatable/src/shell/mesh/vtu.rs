//! An inflated sheet as a VTU file, which ParaView reads.
//!
//! Numbers are written as their own bits (base64), so none is rounded. Format: VTK, "XML File Formats", `UnstructuredGrid`.

use std::fmt::Write as _;

/// A quantity on the points or on the triangles of a sheet.
#[derive(Clone, Copy, Debug)]
pub struct VtuField<'a> {
    /// Name of the field, with the unit.
    pub name: &'a str,
    /// The number of components at each place.
    pub components: usize,
    /// The numbers, place by place.
    pub values: &'a [f64],
}

/// A field does not have the right number of values.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FieldFault {
    /// The field.
    pub name: String,
    /// The given number of values.
    pub found: usize,
    /// The required number of values.
    pub needed: usize,
}

impl std::fmt::Display for FieldFault {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "the field {} has {} values, and must have {}", self.name, self.found, self.needed)
    }
}

impl std::error::Error for FieldFault {}

/// VTK's number of a triangle among cells.
const TRIANGLE: u8 = 5;

/// The text of a VTU file: triangles between `positions`, with fields on points and on triangles.
///
/// # Errors
/// If a field has not one value for each component at each place.
pub fn vtu(
    positions: &[[f64; 3]],
    triangles: &[[usize; 3]],
    on_points: &[VtuField<'_>],
    on_triangles: &[VtuField<'_>],
) -> Result<String, FieldFault> {
    let (points, cells) = (positions.len(), triangles.len());
    let mut xml = String::from("<?xml version=\"1.0\"?>\n");
    xml.push_str("<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n");
    let _ =
        writeln!(xml, "<UnstructuredGrid>\n<Piece NumberOfPoints=\"{points}\" NumberOfCells=\"{cells}\">");
    for (section, fields, places) in [("PointData", on_points, points), ("CellData", on_triangles, cells)] {
        let _ = writeln!(xml, "<{section}>");
        for field in fields {
            let (count, expected_count) = (field.values.len(), field.components * places);
            if count != expected_count {
                return Err(FieldFault { name: field.name.to_owned(), found: count, needed: expected_count });
            }
            array(
                &mut xml,
                "Float64",
                field.name,
                field.components,
                field.values.iter().map(|x| x.to_le_bytes()),
            );
        }
        let _ = writeln!(xml, "</{section}>");
    }
    xml.push_str("<Points>\n");
    array(&mut xml, "Float64", "Points", 3, positions.iter().flatten().map(|x| x.to_le_bytes()));
    xml.push_str("</Points>\n<Cells>\n");
    let corners = triangles.iter().flatten().map(|&point| (point as u64).to_le_bytes());
    array(&mut xml, "Int64", "connectivity", 1, corners);
    array(&mut xml, "Int64", "offsets", 1, (1..=cells as u64).map(|cell| (3 * cell).to_le_bytes()));
    array(&mut xml, "UInt8", "types", 1, triangles.iter().map(|_| [TRIANGLE]));
    xml.push_str("</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
    Ok(xml)
}

fn array<const N: usize>(
    xml: &mut String,
    kind: &str,
    name: &str,
    components: usize,
    values: impl Iterator<Item = [u8; N]>,
) {
    let name = name.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;");
    let _ = writeln!(
        xml,
        "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{components}\" format=\"binary\">"
    );
    let data: Vec<u8> = values.flatten().collect();
    // The number of bytes, then the bytes, in one run.
    let bytes: Vec<u8> = (data.len() as u64).to_le_bytes().into_iter().chain(data).collect();
    base64(xml, &bytes);
    xml.push_str("\n</DataArray>\n");
}

/// RFC 4648, with padding.
fn base64(text: &mut String, bytes: &[u8]) {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for three in bytes.chunks(3) {
        let [first, second, third] = [0, 1, 2].map(|i| u32::from(three.get(i).copied().unwrap_or(0)));
        let group = (first << 16) | (second << 8) | third;
        for i in 0..4 {
            let digit = usize::try_from((group >> (18 - 6 * i)) & 63).map_or(0, |digit| DIGITS[digit]);
            text.push(if i <= three.len() { char::from(digit) } else { '=' });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_is_that_of_its_standard() {
        for (plain, coded) in [
            ("", ""),
            ("f", "Zg=="),
            ("fo", "Zm8="),
            ("foo", "Zm9v"),
            ("foob", "Zm9vYg=="),
            ("foobar", "Zm9vYmFy"),
        ] {
            let mut encoded = String::new();
            base64(&mut encoded, plain.as_bytes());
            assert_eq!(encoded, coded);
        }
    }

    #[test]
    fn a_field_needs_a_value_a_place() {
        let positions = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        let field = VtuField { name: "stretch", components: 1, values: &[1.0, 2.0] };
        let fault = vtu(&positions, &[[0, 1, 2]], &[], &[field]);
        assert_eq!(fault, Err(FieldFault { name: "stretch".into(), found: 2, needed: 1 }));
        let two = VtuField { components: 2, ..field };
        let text = vtu(&positions, &[[0, 1, 2]], &[], &[VtuField { name: "a < \"b\" & c", ..two }]);
        assert!(text.is_ok_and(|text| text.contains("Name=\"a &lt; &quot;b&quot; &amp; c\"")));
    }
}
