//! The machines that come with the program.

use std::fmt;

use crate::spec::{Machine, Source, builtin_machine, builtin_machines, read_machine};

/// No machine of this name comes with the program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnknownMachine(pub String);

impl fmt::Display for UnknownMachine {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let known: Vec<&str> = builtin_machines().collect();
        write!(f, "no machine {:?} comes with the program; there are {}", self.0, known.join(", "))
    }
}

impl std::error::Error for UnknownMachine {}

impl Machine {
    /// The machine that comes with the program under `name`: "generic", "grbl" and so on, as [`builtin_machines`] lists.
    ///
    /// # Errors
    /// If there is no such machine.
    pub fn builtin(name: &str) -> Result<Self, UnknownMachine> {
        let text = builtin_machine(name);
        // A profile of our own that does not read is a fault of this program; a test reads each of them.
        let machine = text.and_then(|text| read_machine(&Source::new(name, text)).ok());
        machine.ok_or_else(|| UnknownMachine(name.to_owned()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_listed_machine_is_there_and_no_other() {
        for name in builtin_machines() {
            assert!(Machine::builtin(name).is_ok(), "{name}");
        }
        let fault = Machine::builtin("grlb").expect_err("a typo");
        assert!(fault.to_string().contains("\"grlb\"") && fault.to_string().contains("grbl, "), "{fault}");
    }
}
