use super::*;
use crate::allowed::SIZE;

/// The value of `bed = text`, mm; without a value the code and the words of the fault.
fn bed(text: &str) -> Result<[f64; 2], (&'static str, String)> {
    let (raw, _) = RawSpec::parse(&format!("[mask]\nbed = \"{text}\"\n"));
    let mut reader = Reader::new(&raw);
    let area = reader.section("mask").area("bed", SIZE);
    let fault = reader.faults.first().map(|fault| (fault.code, fault.message.clone()));
    area.map(|both| both.map(|length| length.0)).ok_or_else(|| fault.expect("a fault"))
}

#[test]
fn a_number_in_other_words_is_named() {
    let help = |text: &str| {
        let (raw, _) = RawSpec::parse(&format!("[load]\nfriction = {text}\n"));
        let mut reader = Reader::new(&raw);
        let _ = reader.section("load").number("friction", SIZE);
        reader.faults.first().and_then(|fault| fault.help.clone())
    };
    assert_eq!(help("\"50 %\"").as_deref(), Some("write friction = 0.5"));
    assert_eq!(help("\"0.5\"").as_deref(), Some("write friction = 0.5"));
    assert_eq!(help("\"much\""), None);
}

#[test]
fn a_bed_is_two_lengths() {
    for text in ["220 mm x 210 mm", "220 x 210 mm", "220x210mm", "22 cm x 210 mm", "220 mm \u{d7} 210 mm"] {
        assert_eq!(bed(text), Ok([220.0, 210.0]), "{text}");
    }
    assert_eq!(bed("8 x 10 in"), Ok([8.0 * 25.4, 254.0]));
    for (text, code) in [
        ("220 mm", "wrong-type"),
        ("220 x 210", "no-unit"),
        ("220 ells x 210 mm", "unknown-unit"),
        ("wide x 210 mm", "not-a-number"),
        ("0 mm x 210 mm", "out-of-range"),
        ("", "wrong-type"),
        ("x", "not-a-number"),
    ] {
        assert_eq!(bed(text).map_err(|(code, _)| code), Err(code), "{text}");
    }
}
