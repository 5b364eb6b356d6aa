//! Reads binary STL: a head, a count, and triangles in single precision.

/// Three corners (x, y, z), mm, counterclockwise from outside.
pub type StlFacet = [[f32; 3]; 3];

/// The data of a solid besides its corners.
#[derive(Debug, PartialEq)]
pub(in crate::verify) struct SolidNotes {
    /// The normal of each facet.
    pub(in crate::verify) normals: Vec<[f32; 3]>,
    /// The head, whose text programs show as a name.
    pub(in crate::verify) head: Vec<u8>,
    /// Whether the two bytes of every facet are zeros: some readers take them for a colour.
    pub(in crate::verify) plain: bool,
}

/// Length of the head and the count.
const HEAD: usize = 84;
/// Length of a facet: its normal, three corners, two bytes.
const FACET: usize = 50;

/// The facets of a binary STL; `None` if the length does not match the count, or a number is not finite.
pub fn read_stl(bytes: &[u8]) -> Option<Vec<StlFacet>> {
    read_solid(bytes).map(|(facets, _)| facets)
}

/// The facets of a binary STL, with the data besides the corners.
pub(in crate::verify) fn read_solid(bytes: &[u8]) -> Option<(Vec<StlFacet>, SolidNotes)> {
    let count = usize::try_from(u32::from_le_bytes(bytes.get(80..HEAD)?.try_into().ok()?)).ok()?;
    if bytes.len() != HEAD.checked_add(FACET.checked_mul(count)?)? {
        return None;
    }
    let facet = |raw: &[u8]| Some([read_corner(raw, 12)?, read_corner(raw, 24)?, read_corner(raw, 36)?]);
    let mut records = bytes[HEAD..].chunks_exact(FACET);
    let facets: Option<Vec<StlFacet>> = records.clone().map(facet).collect();
    let normals: Option<Vec<[f32; 3]>> = records.clone().map(|raw| read_corner(raw, 0)).collect();
    let plain = records.all(|raw| raw[48..] == [0, 0]);
    Some((facets?, SolidNotes { normals: normals?, head: bytes[..80].to_vec(), plain }))
}

/// Three numbers from the byte `place` of a facet on.
fn read_corner(raw: &[u8], place: usize) -> Option<[f32; 3]> {
    Some([read_number(raw, place)?, read_number(raw, place + 4)?, read_number(raw, place + 8)?])
}

fn read_number(raw: &[u8], place: usize) -> Option<f32> {
    Some(f32::from_le_bytes(raw.get(place..place + 4)?.try_into().ok()?)).filter(|x| x.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One facet in the plane Z 0.
    fn triangle() -> Vec<u8> {
        let mut bytes = vec![b' '; 80];
        bytes.extend(1_u32.to_le_bytes());
        let numbers = [0.0, 0.0, 1.0, 1.0, 2.0, 0.0, 3.0, 2.0, 0.0, 1.0, 4.0, 0.0_f32];
        bytes.extend(numbers.iter().flat_map(|x| x.to_le_bytes()));
        bytes.extend([0, 0]);
        bytes
    }

    #[test]
    fn reads_what_stands_there() {
        let facets = read_stl(&triangle()).expect("a facet");
        assert_eq!(facets, [[[1.0, 2.0, 0.0], [3.0, 2.0, 0.0], [1.0, 4.0, 0.0]]]);
    }

    #[test]
    fn refuses_another_length_and_numbers_that_are_none() {
        let good = triangle();
        assert_eq!(read_stl(&good[..good.len() - 1]), None);
        assert_eq!(read_stl(&[]), None);
        let mut truncated = good.clone();
        truncated[80..84].copy_from_slice(&u32::MAX.to_le_bytes());
        assert_eq!(read_stl(&truncated), None);
        let mut odd = good;
        odd[96..100].copy_from_slice(&f32::NAN.to_le_bytes());
        assert_eq!(read_stl(&odd), None);
    }
}
