//! Every key of an answer with its type and its meaning, for those who read answers elsewhere: Python's attributes are made of it.
//!
//! `keyed` makes both of an answer's struct: a field's type is the key's, its docs are the meaning.

/// The type of a key's value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum KeyKind {
    /// A word or a sentence.
    Text,
    /// A number.
    Number,
    /// Two numbers: the ends of an interval.
    Pair,
    /// `tip` and `corner`: a number each, or null.
    Hinges,
    /// Named values.
    Object,
    /// Rows of named values.
    List,
    /// Rows of numbers.
    Rows,
    /// A value whose type depends on the model.
    Variant,
}

/// One key.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Key {
    /// Name of the key, with the unit.
    pub name: &'static str,
    /// Type of the value.
    pub kind: KeyKind,
    /// Whether every answer has this key. Otherwise it may be null or absent.
    pub always: bool,
    /// Meaning of the value, in sentences.
    pub about: &'static str,
}

impl Key {
    /// The key `name` with values of type `T`.
    pub(super) const fn new<T: KeyType>(name: &'static str, meaning: &'static str) -> Self {
        Self { name, kind: T::KIND, always: T::ALWAYS, about: meaning.trim_ascii() }
    }
}

/// The type of a field in an answer.
pub(super) trait KeyType {
    /// The kind of its key.
    const KIND: KeyKind;
    /// Whether it is never null.
    const ALWAYS: bool = true;
}

impl<T: KeyType> KeyType for Option<T> {
    const KIND: KeyKind = T::KIND;
    const ALWAYS: bool = false;
}

/// Gives the types of fields their kinds.
macro_rules! kinds {
    ($($kind:ident: $($type:ty),+;)+) => {
        $($(impl $crate::keys::KeyType for $type {
            const KIND: $crate::keys::KeyKind = $crate::keys::KeyKind::$kind;
        })+)+
    };
}

kinds! {
    Text: &'static str;
    Number: f64;
    Pair: [f64; 2];
    Rows: Vec<[f64; 2]>;
    Variant: bool;
}

/// Defines the struct of an answer, and its `KEYS`. The fields after `and` are not written.
macro_rules! keyed {
    (
        $(#[$attribute:meta])*
        pub struct $name:ident {
            $($(#[doc = $about:literal])+ $(#[serde($($how:tt)*)])? pub $key:ident: $type:ty,)+
        }
        $(and { $($(#[$own:meta])+ pub $field:ident: $of:ty,)+ })?
    ) => {
        $(#[$attribute])*
        pub struct $name {
            $($(#[doc = $about])+ $(#[serde($($how)*)])? pub $key: $type,)+
            $($($(#[$own])+ pub $field: $of,)+)?
        }

        impl $name {
            /// The keys of its JSON in their order.
            pub const KEYS: &'static [$crate::keys::Key] = &[$($crate::keys::Key::new::<$type>(stringify!($key), concat!($($about),+))),+];
        }
    };
}
pub(super) use {keyed, kinds};
