//! Codes: the stable kebab-case words by which scripts distinguish faults, refusals and findings.
//!
//! Each room declares its own in one table: name, word, and the sentence that docs/codes.md shows. A report names a code of the
//! table, so that none can be misspelt or be missing from the page.

/// A code of some room.
pub trait Code: Copy {
    /// The word for scripts: "no-arm".
    fn as_str(self) -> &'static str;

    /// The meaning of the code and the remedy, in one sentence.
    fn meaning(self) -> &'static str;
}

/// Declares the codes of a room: an enum with `ALL`, and [`Code`] for it.
#[macro_export]
macro_rules! codes {
    ($(#[$doc:meta])* $room:ident { $($name:ident $word:literal $meaning:literal,)+ }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum $room {
            $(#[doc = $meaning] $name,)+
        }

        impl $room {
            /// Every code of this room, in the order of the alphabet.
            pub const ALL: &'static [Self] = &[$(Self::$name),+];
        }

        impl $crate::Code for $room {
            fn as_str(self) -> &'static str {
                match self { $(Self::$name => $word),+ }
            }

            fn meaning(self) -> &'static str {
                match self { $(Self::$name => $meaning),+ }
            }
        }

        /// The word for scripts.
        impl std::fmt::Display for $room {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.write_str($crate::Code::as_str(*self))
            }
        }

        /// Compares the word for scripts.
        impl PartialEq<&str> for $room {
            fn eq(&self, word: &&str) -> bool {
                $crate::Code::as_str(*self) == *word
            }
        }
    };
}

codes! {
    /// Faults of specs and machine profiles.
    FaultCode {
        Cell "cell" "A cell of a table is not a number in its range; write one, with a decimal point.",
        CellCount "cell-count" "A row of a table has more or fewer cells than its header; correct the row.",
        Conflict "conflict" "Two values exclude each other; delete or change one of them.",
        DecimalComma "decimal-comma" "A number of a table is written with a decimal comma; write a point.",
        DuplicateIndex "duplicate-index" "One star has two `[[stack.star]]` sections; write all of its keys into one.",
        Edit "edit" "The star of this spec cannot be given other values; write its section with one key a line.",
        LineEnd "line-end" "Lines end with CR alone; save the file once more, with line ends of LF or CRLF.",
        Link "link" "The link is not an address of a web page; write one that begins with https:// and has no # and no user.",
        MissingKey "missing-key" "A required key is missing; write it.",
        Name "name" "A name is empty, too long, or holds control characters; choose another.",
        NoColumn "no-column" "A table lacks a column; add it, under the name shown.",
        NoEffect "no-effect" "A warning: the key has no effect at this place; move it, or delete it.",
        NoHeader "no-header" "A table does not begin with the names of its columns; write them above the numbers.",
        NoRows "no-rows" "A table has a header and no rows; check whether it is the right file.",
        NoUnit "no-unit" "A quantity is a bare number; write it in quotes, with one of the units shown.",
        NotANumber "not-a-number" "A quantity does not begin with a decimal number; write one, with a decimal point.",
        NotASpec "not-a-spec" "The file is G-code, JSON or a drawing, not TOML; name the spec that it was made from.",
        NotText "not-text" "The file is not UTF-8; save it as UTF-8, and see whether it is the right file.",
        OpenQuote "open-quote" "A quoted cell of a table does not end in its line; close the quote.",
        OutOfRange "out-of-range" "A value is outside of the range shown; choose one inside.",
        OwnValue "own-value" "A `[[stack.star]]` decides a value that `star` should be given; move it there.",
        Profile "profile" "The machine's profile is neither a name nor a path; write one of them.",
        ProgramLine "program-line" "A line that the profile puts into programs is not allowed there; shorten or correct it.",
        Ptfe "ptfe" "The temperature harms the PTFE release layer: a warning above 260 C, refused from 300 C; lower it.",
        Schema "schema" "The version of the spec is unknown; write the one shown.",
        Syntax "syntax" "The text is not TOML; correct the line shown.",
        TooLarge "too-large" "The file is larger than any spec, or a line longer than any of a table; see whether it is the right one.",
        TwoColumns "two-columns" "A table has two columns of one name; delete or rename one.",
        Unit "unit" "A column of a table is in another unit than needed; convert it.",
        UnknownChoice "unknown-choice" "The word is not one of the choices shown; write one of them.",
        UnknownKey "unknown-key" "No key has this name here; write the one suggested, or delete it.",
        UnknownMachine "unknown-machine" "No machine profile has this name, and no file; `stargrip-cam machines` lists them.",
        UnknownProcess "unknown-process" "No process has this name; write the one suggested, or its section `[process.NAME]`.",
        UnknownSection "unknown-section" "No section has this name; write the one suggested, or delete it.",
        UnknownUnit "unknown-unit" "The unit does not fit the quantity, or is unknown; write one of those shown.",
        WrongType "wrong-type" "The value is of another kind than the key takes; write it as shown.",
    }
}
