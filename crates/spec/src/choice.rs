//! Choices: enums whose variants have words, each from one table, so that no list of them misses a variant.

/// Declares an enum from a table, one line a variant with its word: the enum, `ALL` with the words of all variants, `WORDS`, and the
/// method, named in the head of the table, that gives a variant's word.
#[macro_export]
macro_rules! choices {
    ($(#[$about:meta])* $type:ident, $(#[$says:meta])* $method:ident;
     $($(#[$doc:meta])* $variant:ident: $word:literal,)+) => {
        $(#[$about])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum $type {
            $($(#[$doc])* $variant,)+
        }

        impl $type {
            /// Every variant, after its word.
            pub const ALL: [(&'static str, Self); Self::WORDS.len()] = [$(($word, Self::$variant)),+];

            /// The words of all variants.
            pub const WORDS: [&'static str; [$($word),+].len()] = [$($word),+];

            $(#[$says])*
            pub const fn $method(self) -> &'static str {
                match self {
                    $(Self::$variant => $word,)+
                }
            }
        }
    };
}
