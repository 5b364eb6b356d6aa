//! The inputs of tests of predictions.

/// The paper's three stars, with all inputs of a prediction.
pub const GRIPPER: &str = include_str!("gripper.toml");

/// A V-actuator at its pressure, as arguments of the command.
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
