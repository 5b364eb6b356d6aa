//! Messages between the page and the program: JSON, and files as bytes.
//!
//! As bytes: the length of the JSON (four bytes, the lowest first), the JSON, then the files one after the other. `files` in the JSON
//! has the `name` and the number of `bytes` of each.

use serde_json::{Value, json};

/// The fault of a message that ends before its files do.
const SHORT: &str = "the question ends early";

/// A question or an answer.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Message {
    /// All but the files.
    pub json: Value,
    /// Name and content of each file.
    pub files: Vec<(String, Vec<u8>)>,
}

impl Message {
    /// An answer without files.
    pub fn from_json(json: Value) -> Self {
        Self { json, files: Vec::new() }
    }

    /// Reads a message.
    ///
    /// # Errors
    /// The message is malformed. The page wrote it, so it is a fault of the page.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, String> {
        let (head, rest) = bytes.split_first_chunk::<4>().ok_or(SHORT)?;
        let length = usize::try_from(u32::from_le_bytes(*head)).map_err(|_| SHORT)?;
        let (text, mut rest) = rest.split_at_checked(length).ok_or(SHORT)?;
        let json: Value =
            serde_json::from_slice(text).map_err(|error| format!("the question is not JSON: {error}"))?;
        let mut files = Vec::new();
        for file in json["files"].as_array().into_iter().flatten() {
            let length = file["bytes"].as_u64().and_then(|length| usize::try_from(length).ok());
            let (bytes, tail) = length.and_then(|length| rest.split_at_checked(length)).ok_or(SHORT)?;
            files.push((file["name"].as_str().unwrap_or_default().to_owned(), bytes.to_vec()));
            rest = tail;
        }
        if rest.is_empty() { Ok(Self { json, files }) } else { Err("the question is too long".to_owned()) }
    }

    /// The message as bytes.
    pub fn into_bytes(self) -> Vec<u8> {
        let Self { mut json, files } = self;
        if !files.is_empty() {
            let list = files.iter().map(|(name, bytes)| json!({ "name": name, "bytes": bytes.len() }));
            json["files"] = list.collect();
        }
        let text = json.to_string();
        let mut bytes = u32::try_from(text.len()).unwrap_or(u32::MAX).to_le_bytes().to_vec();
        bytes.extend_from_slice(text.as_bytes());
        for (_, file) in files {
            bytes.extend_from_slice(&file);
        }
        bytes
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample() -> Message {
        let files = vec![("a.toml".to_owned(), vec![1, 2, 3]), ("b".to_owned(), Vec::new())];
        let json = json!({ "ask": "verify", "files": [{ "name": "a.toml", "bytes": 3 }, { "name": "b", "bytes": 0 }] });
        Message { json, files }
    }

    #[test]
    fn what_is_written_is_read() {
        assert_eq!(Message::from_bytes(&sample().into_bytes()), Ok(sample()));
        let plain = Message::from_json(json!({ "ask": "start" }));
        assert_eq!(Message::from_bytes(&plain.clone().into_bytes()), Ok(plain));
    }

    #[test]
    fn a_message_of_another_length_is_refused() {
        let bytes = sample().into_bytes();
        for end in 0..bytes.len() {
            assert!(Message::from_bytes(&bytes[..end]).is_err(), "{end}");
        }
        assert!(Message::from_bytes(&[bytes, vec![0]].concat()).is_err());
        assert!(Message::from_bytes(&[255; 9]).is_err());
    }
}
