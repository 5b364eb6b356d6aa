//! What tests of predictions ask about.

/// The paper's three stars, with all that can be asked about them.
pub const GRIPPER: &str = include_str!("gripper.toml");

/// A V-actuator at its pressure, as the command is asked about it.
pub const ACTUATOR: [&str; 11] = [
    "actuator",
    "--tube-width",
    "20 mm",
    "--radius",
    "2 mm",
    "--arm-length",
    "80 mm",
    "--angle",
    "60 deg",
    "--pressure",
    "14 kPa",
];
