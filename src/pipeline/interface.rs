//! Who reads precautions: each interface has its own names for the tests and steps of the program.

/// Where precautions are read: how the tests and steps are called there to which they refer.
#[derive(Clone, Copy, Debug)]
pub enum Interface<'a> {
    /// On a terminal or beside the files, with the path of the spec, quoted for a shell.
    Command(&'a str),
    /// In the page, which has buttons, and neither coupons nor feed checks.
    Page,
}

impl Interface<'_> {
    /// The command `name` for the spec, which writes a feed check or coupons.
    pub(super) fn command(self, name: &str) -> String {
        match self {
            Self::Command(spec) => format!("`stargrip-cam {name} {spec}`"),
            Self::Page => format!("the command `stargrip-cam {name}`"),
        }
    }

    /// What measures the strength of a seal.
    pub(super) fn coupon(self) -> &'static str {
        match self {
            Self::Command(_) => "`coupon`",
            Self::Page => "coupon",
        }
    }

    /// What writes the programs for a sheet that was moved.
    pub(super) fn align(self) -> &'static str {
        match self {
            Self::Command(_) => "`align`",
            Self::Page => "“The sheet was moved”",
        }
    }

    /// What tells which loop of a star opens first.
    pub(super) fn pulls(self) -> &'static str {
        match self {
            Self::Command(_) => "with a pressure in [load] `check` says which",
            Self::Page => "with a pressure in [load] the page says which",
        }
    }

    /// What lists the pull on the seams of an inflated drawing.
    pub(super) fn drawn_pulls(self) -> &'static str {
        match self {
            Self::Command(_) => "`predict`",
            Self::Page => "the report",
        }
    }

    /// What computes a drawing under pressure.
    pub(super) fn shell(self) -> &'static str {
        match self {
            Self::Command(_) => forecast::drawn::HOW_BY_COMMANDS,
            Self::Page => "“Inflate it” computes the pull",
        }
    }
}
