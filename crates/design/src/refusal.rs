//! The reasons why a valid spec has no design.

use std::fmt;
use std::ops::{Deref, DerefMut};

use crate::RefusalCode;
use spec::{DrawnPlace, KeyPath};

/// A spec whose every value is in its range, but whose geometry cannot be made; as a [`Warning`], one that can.
#[derive(Clone, Debug, PartialEq)]
pub struct Refusal {
    /// The key that is best changed; of the star concerned, where stars can differ in it.
    pub key: KeyPath,
    /// Code of the refusal for scripts: "no-arm".
    pub code: RefusalCode,
    /// The finding, with numbers.
    pub found: String,
    /// The allowed values and the remedy.
    pub remedy: String,
    /// The place in the drawing of the spec.
    pub drawn: Option<Box<DrawnPlace>>,
}

impl Refusal {
    /// A refusal that points at `key`.
    pub fn new(
        key: KeyPath,
        code: RefusalCode,
        finding: impl Into<String>,
        remedy: impl Into<String>,
    ) -> Self {
        Self { key, code, found: finding.into(), remedy: remedy.into(), drawn: None }
    }

    /// This refusal, at a place of the drawing.
    #[must_use]
    pub fn drawn_at(self, place: DrawnPlace) -> Self {
        Self { drawn: Some(Box::new(place)), ..self }
    }

    /// This refusal about star `index`, if it concerns one of the keys that stars can have of their own.
    pub fn of_star(self, index: usize) -> Self {
        Self { key: self.key.of_star(index), ..self }
    }
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}; {}", self.key, self.found, self.remedy)
    }
}

impl std::error::Error for Refusal {}

/// A warning about a design that can be made; its key is best changed, or written to accept the warning.
pub type Warning = Refusal;

/// All reasons for which such a gripper cannot be made; as an error it lists them all, a line each.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Refusals(Vec<Refusal>);

impl Refusals {
    /// No refusal yet.
    pub const fn new() -> Self {
        Self(Vec::new())
    }

    /// What was `result`; nothing, with its refusals, if it was not.
    pub(super) fn keep<T>(&mut self, result: Result<T, impl Into<Self>>) -> Option<T> {
        result.map_err(|refused| self.0.extend(refused.into())).ok()
    }

    /// These refusals without those of one code at one key that follow the first.
    pub(super) fn each_once(self) -> Self {
        let mut distinct = Self::new();
        for refusal in self {
            if !distinct.iter().any(|known| known.code == refusal.code && known.key == refusal.key) {
                distinct.push(refusal);
            }
        }
        distinct
    }

    /// Adds a way out to the remedies of the refusals of `code`, in the words of the interface that shows them: a lower room knows neither
    /// options nor arguments.
    pub fn offer(&mut self, code: RefusalCode, way_out: &str) {
        for refusal in self.0.iter_mut().filter(|refusal| refusal.code == code) {
            refusal.remedy = format!("{}; {way_out}", refusal.remedy);
        }
    }

    /// `value`, unless something was refused.
    ///
    /// # Errors
    /// These refusals, if there is at least one.
    pub fn or_value<T>(self, value: T) -> Result<T, Self> {
        if self.0.is_empty() { Ok(value) } else { Err(self) }
    }
}

/// They are read and extended as a list.
impl Deref for Refusals {
    type Target = Vec<Refusal>;

    fn deref(&self) -> &Vec<Refusal> {
        &self.0
    }
}

impl DerefMut for Refusals {
    fn deref_mut(&mut self) -> &mut Vec<Refusal> {
        &mut self.0
    }
}

impl From<Refusal> for Refusals {
    fn from(refusal: Refusal) -> Self {
        Self(vec![refusal])
    }
}

impl FromIterator<Refusal> for Refusals {
    fn from_iter<I: IntoIterator<Item = Refusal>>(refusals: I) -> Self {
        Self(refusals.into_iter().collect())
    }
}

impl IntoIterator for Refusals {
    type Item = Refusal;
    type IntoIter = std::vec::IntoIter<Refusal>;

    fn into_iter(self) -> Self::IntoIter {
        self.0.into_iter()
    }
}

impl fmt::Display for Refusals {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let lines: Vec<String> = self.0.iter().map(ToString::to_string).collect();
        f.write_str(&lines.join("\n"))
    }
}

impl std::error::Error for Refusals {}

#[cfg(test)]
mod tests {
    use super::*;
    use spec::key;

    #[test]
    fn refusals_say_all_of_themselves() {
        let keys = [key::star::POINTS, key::seal::BAND];
        let refusals =
            keys.map(|key| Refusal::new(key, RefusalCode::NoArm, "found".to_owned(), "remedy".to_owned()));
        let pair: Refusals = refusals.into_iter().collect();
        assert_eq!(pair.to_string(), "star.points: found; remedy\nseal.band: found; remedy");
        assert_eq!(pair.clone().or_value(()), Err(pair));
        assert_eq!(Refusals::new().or_value(7), Ok(7));
    }
}
