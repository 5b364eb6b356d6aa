//! The profiles that come with the program.

macro_rules! builtin {
    ($($name:literal),+) => {
        &[$(($name, include_str!(concat!("../../templates/machines/", $name, ".toml")))),+]
    };
}

/// Name and text of each.
const BUILTIN: &[(&str, &str)] = builtin![
    "generic",
    "linuxcnc",
    "grbl",
    "grblhal",
    "fluidnc",
    "marlin",
    "klipper",
    "reprapfirmware",
    "bambu",
    "ender",
    "prusa",
    "klipper-printer",
    "press",
    "grbl-laser"
];

/// The names of the profiles that come with the program.
pub fn builtin_machines() -> impl Iterator<Item = &'static str> {
    BUILTIN.iter().map(|(name, _)| *name)
}

/// Usual machines as they are sold: the first letters of their names, in lower case without blanks and dashes, the controller,
/// and its profile. Owners change firmwares, so this is a hint for a message and never a choice.
const USUAL: [(&[&str], &str, &str); 10] = [
    (
        &[
            "creality",
            "cr10",
            "cr6",
            "anycubic",
            "kobra",
            "artillery",
            "anet",
            "lulzbot",
            "elegoo",
            "printer",
        ],
        "Marlin",
        "marlin",
    ),
    (
        &["voron", "ratrig", "crealityk", "k1", "qidi", "sovolsv08", "mainsail", "fluidd"],
        "Klipper",
        "klipper-printer",
    ),
    (&["shapeoko", "3018", "cnc3018", "genmitsu", "xcarve", "longmill"], "GRBL", "grbl"),
    (&["ortur", "sculpfun", "atomstack", "xtool", "laser"], "GRBL", "grbl-laser"),
    (&["ender"], "Marlin", "ender"),
    (&["prusa", "mk3", "mk4"], "Marlin", "prusa"),
    (&["bambu", "a1mini", "p1s", "p1p", "x1c", "x1carbon"], "Bambu's firmware", "bambu"),
    (&["duet", "rrf"], "RepRapFirmware", "reprapfirmware"),
    (&["tormach", "pathpilot", "mesa", "emc2"], "LinuxCNC", "linuxcnc"),
    (&["jackpot", "6pack"], "FluidNC", "fluidnc"),
];

/// The name of a machine in lower case, without blanks and dashes.
pub(super) fn trade_name(name: &str) -> String {
    name.chars().filter(|c| c.is_alphanumeric()).flat_map(char::to_lowercase).collect()
}

/// The controller that machines called `name` usually have, and its profile: ("Marlin", "marlin") for "Ender-3".
pub fn usual_profile(name: &str) -> Option<(&'static str, &'static str)> {
    let plain = trade_name(name);
    // The longest beginning is the most exact: "crealityk1" is a Creality with another firmware.
    let fits = USUAL.iter().flat_map(|(names, controller, profile)| {
        let begin = names.iter().filter(|begin| plain.starts_with(**begin));
        begin.map(|begin| (begin.len(), (*controller, *profile)))
    });
    fits.max_by_key(|(length, _)| *length).map(|(_, found)| found)
}

/// The text of the profile that comes with the program under `name`.
pub fn builtin_machine(name: &str) -> Option<&'static str> {
    BUILTIN.iter().find(|(known, _)| *known == name).map(|(_, text)| *text)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn usual_machines_have_profiles_that_are_there() {
        for (name, profile) in [
            ("ender3", "ender"),
            ("Ender-3 V2", "ender"),
            ("Prusa MK4", "prusa"),
            ("Bambu A1", "bambu"),
            ("Creality K1", "klipper-printer"),
            ("voron 2.4", "klipper-printer"),
            ("3018", "grbl"),
            ("Ortur LM2", "grbl-laser"),
            ("Duet3", "reprapfirmware"),
        ] {
            assert_eq!(usual_profile(name).map(|(_, profile)| profile), Some(profile), "{name}");
        }
        assert_eq!(usual_profile("my-machine.toml"), None);
        assert!(USUAL.iter().all(|(.., profile)| builtin_machine(profile).is_some()));
    }
}
