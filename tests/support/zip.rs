//! Stored ZIP archives, written and read by a few lines that know nothing of the program's own.
#![allow(dead_code, unreachable_pub, reason = "every test binary uses some of it")]

/// A name and its content.
pub type Part = (String, Vec<u8>);

/// The parts of an archive, in their order, as its local headers state them.
pub fn parts(archive: &[u8]) -> Vec<Part> {
    let (mut list, mut place) = (Vec::new(), 0);
    while archive[place..].starts_with(b"PK\x03\x04") {
        let (length, start) =
            (number(archive, place + 22), place + 30 + (number(archive, place + 26) & 0xffff));
        let name = String::from_utf8(archive[place + 30..start].to_vec()).expect("a name");
        list.push((name, archive[start..start + length].to_vec()));
        place = start + length;
    }
    list
}

/// The number in four bytes at `place`.
fn number(archive: &[u8], place: usize) -> usize {
    u32::from_le_bytes(archive[place..place + 4].try_into().expect("four bytes")) as usize
}

/// An archive of these parts, with right checksums.
pub fn archive(parts: &[Part]) -> Vec<u8> {
    let (mut file, mut directory) = (Vec::new(), Vec::new());
    for (name, content) in parts {
        let length = u32::try_from(content.len()).expect("short").to_le_bytes();
        let name_length = u16::try_from(name.len()).expect("short").to_le_bytes();
        let offset = u32::try_from(file.len()).expect("short").to_le_bytes();
        let checksum = crc32(content).to_le_bytes();
        let facts =
            [&[20, 0, 0, 0, 0, 0, 0, 0, 0x21, 0][..], &checksum, &length, &length, &name_length, &[0; 2]];
        file.extend([&b"PK\x03\x04"[..], &facts.concat(), name.as_bytes(), content].concat());
        directory
            .extend([&b"PK\x01\x02\x14\0"[..], &facts.concat(), &[0; 10], &offset, name.as_bytes()].concat());
    }
    let count = u16::try_from(parts.len()).expect("few").to_le_bytes();
    let [length, offset] =
        [&directory, &file].map(|bytes| u32::try_from(bytes.len()).expect("short").to_le_bytes());
    [&file[..], &directory, b"PK\x05\x06\0\0\0\0", &count, &count, &length, &offset, &[0; 2]].concat()
}

/// CRC-32, a bit at a time.
fn crc32(bytes: &[u8]) -> u32 {
    let mut crc = u32::MAX;
    for byte in bytes {
        crc ^= u32::from(*byte);
        for _ in 0..8 {
            crc = (crc >> 1) ^ if crc & 1 == 1 { 0xedb8_8320 } else { 0 };
        }
    }
    !crc
}
