//! How a user recognises the controller of a machine, and machines without a profile.

use crate::dialect::Dialect;
use crate::machine::{Heating, Machine, SealingTool};
use crate::profile::builtin::{trade_name, usual_profile};

impl Machine {
    /// The sign by which a user recognises the controller: the line that it prints when a console connects, or its answer to `M115`.
    ///
    /// Sources: `report_init_message` of GRBL and grblHAL, FluidNC's `Report.cpp`, `cmd_M115` of Klipper, the pages on M115 of Marlin
    /// and RepRapFirmware.
    pub fn sign(&self) -> &'static str {
        match self.tool {
            SealingTool::Press => return "two hot plates without a controller",
            SealingTool::Laser => {
                return "prints \"Grbl 1.1h ['$' for help]\" and drives a laser: $32=1 in its answer to $$";
            }
            SealingTool::Iron => {}
        }
        match self.controller.dialect {
            Dialect::Generic => "none of the signs below",
            Dialect::LinuxCnc => "a PC runs LinuxCNC: AXIS, Gmoccapy, QtDragon, PathPilot",
            Dialect::Grbl => "prints \"Grbl 1.1h ['$' for help]\"",
            Dialect::GrblHal => "prints \"GrblHAL 1.1f ['$' or '$HELP' for help]\"",
            Dialect::FluidNc => "prints \"Grbl 3.9 [FluidNC v3.9.1 (wifi) '$' for help]\"",
            Dialect::Marlin => "prints \"start\"; answers M115 with \"FIRMWARE_NAME:Marlin\"",
            Dialect::Bambu => "a Bambu Lab printer",
            Dialect::Klipper => "a page of Mainsail or Fluidd; answers M115 with \"FIRMWARE_NAME:Klipper\"",
            Dialect::RepRapFirmware => {
                "a page of Duet Web Control; answers M115 with \"FIRMWARE_NAME: RepRapFirmware\""
            }
        }
    }

    /// Who heats: "hotend", "by hand", "plates", or "laser".
    pub fn heater(&self) -> &'static str {
        match (self.tool, &self.controller.heating) {
            (SealingTool::Press, _) => "plates",
            (SealingTool::Laser, _) => "laser",
            (SealingTool::Iron, Heating::Operator) => "by hand",
            (SealingTool::Iron, Heating::Hotend(_)) => "hotend",
            (SealingTool::Iron, Heating::Heater(_)) => "heater",
        }
    }
}

/// A kind of machine without a profile, and what its owner may try.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct UnservedMachine {
    /// Names of the machine, as an owner writes them.
    pub names: &'static str,
    /// What to try, without a claim that it works.
    pub remedy: &'static str,
    /// First letters of its names, in lower case without blanks and dashes.
    beginnings: &'static [&'static str],
}

/// Machines without a profile that owners of sealing tools have.
pub const UNSERVED_MACHINES: [UnservedMachine; 6] = [
    UnservedMachine {
        names: "Mach3, Mach4, UCCNC, PlanetCNC, Estlcam, Smoothieware, TinyG, g2core",
        remedy: "they read G-code: profile \"generic\", and a feed check before anything else",
        beginnings: &["mach3", "mach4", "uccnc", "planetcnc", "estlcam", "smoothie", "tinyg", "g2core"],
    },
    UnservedMachine {
        names: "industrial controls: Fanuc, Siemens, Heidenhain, Haas, Mazak",
        remedy: "import seal-dxf into their CAM: programs need a frame of their own; speed and order are then not proven",
        beginnings: &["fanuc", "siemens", "sinumerik", "heidenhain", "haas", "mazak"],
    },
    UnservedMachine {
        names: "robot arms: UR, xArm, Dobot, Franka, Kuka, ABB",
        remedy: "import seal-dxf as a path of their program; speed and order are then not proven",
        beginnings: &["ur3", "ur5", "ur10", "ur16", "xarm", "dobot", "franka", "kuka", "abb"],
    },
    UnservedMachine {
        names: "pen plotters: AxiDraw, EBB boards, iDraw",
        remedy: "a servo lifts the pen and sets no height: draw outline-svg with them, seal by a press with paper (profile \"press\")",
        beginnings: &["axidraw", "ebb", "idraw", "nextdraw"],
    },
    UnservedMachine {
        names: "cutters: Cricut, Silhouette, Roland, Graphtec, Summa",
        remedy: "cut outline-svg, mask-svg and separator-svg with them; seal by a press (profile \"press\")",
        beginnings: &["cricut", "silhouette", "cameo", "roland", "graphtec", "summa", "brother", "scanncut"],
    },
    UnservedMachine {
        names: "ultrasonic and high-frequency welders",
        remedy: "seal-dxf has the centre line and the edges of every band; they have no heat to be planned",
        beginnings: &["ultrasonic", "hfwelder", "rfwelder"],
    },
];

/// What the owner of a machine called `name` may write in place of it: the profile that machines of this name usually have, or what to try
/// without one. `None` for an unknown name.
pub fn machine_remedy(name: &str) -> Option<String> {
    if let Some((controller, profile)) = usual_profile(name) {
        return Some(format!("it usually has {controller}: write profile = \"{profile}\""));
    }
    let plain = trade_name(name);
    let unserved = UNSERVED_MACHINES
        .iter()
        .find(|machine| machine.beginnings.iter().any(|beginning| plain.starts_with(beginning)))?;
    Some(format!("there is no profile for {}; try: {}", unserved.names, unserved.remedy))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::builtin_machines;

    #[test]
    fn a_machine_is_told_its_profile_or_what_to_try() {
        for (name, part) in [
            ("Ender-3 V2", "profile = \"ender\""),
            ("Mach3", "profile \"generic\""),
            ("UR5e", "seal-dxf"),
            ("Silhouette Cameo 4", "separator-svg"),
            ("axidraw", "profile \"press\""),
        ] {
            let remedy = machine_remedy(name).unwrap_or_default();
            assert!(remedy.contains(part), "{name}: {remedy}");
        }
        assert_eq!(machine_remedy("my-machine.toml"), None);
    }

    #[test]
    fn an_unserved_machine_is_no_usual_one_and_no_profile() {
        for beginning in UNSERVED_MACHINES.iter().flat_map(|machine| machine.beginnings) {
            assert_eq!(usual_profile(beginning), None, "{beginning}");
            assert!(builtin_machines().all(|name| !name.starts_with(beginning)), "{beginning}");
        }
    }

    #[test]
    fn signs_tell_controllers_apart() {
        let machines: Vec<Machine> =
            builtin_machines().map(|name| Machine::builtin(name).expect("built in")).collect();
        for (index, machine) in machines.iter().enumerate() {
            for other in &machines[index + 1..] {
                let is_same =
                    machine.controller.dialect == other.controller.dialect && machine.tool == other.tool;
                assert_eq!(machine.sign() == other.sign(), is_same, "{} and {}", machine.name, other.name);
            }
        }
    }
}
