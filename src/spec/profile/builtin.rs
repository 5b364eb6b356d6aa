//! The profiles that come with the program.

macro_rules! builtin {
    ($($name:literal),+) => {
        &[$(($name, include_str!(concat!("../../../templates/machines/", $name, ".toml")))),+]
    };
}

/// Name and text of each.
const BUILTIN: &[(&str, &str)] =
    builtin!["generic", "linuxcnc", "grbl", "grblhal", "fluidnc", "marlin", "klipper", "reprapfirmware"];

/// The names of the profiles that come with the program.
pub fn builtin_machines() -> impl Iterator<Item = &'static str> {
    BUILTIN.iter().map(|(name, _)| *name)
}

/// The text of the profile that comes with the program under `name`.
pub fn builtin_machine(name: &str) -> Option<&'static str> {
    BUILTIN.iter().find(|(known, _)| *known == name).map(|(_, text)| *text)
}
