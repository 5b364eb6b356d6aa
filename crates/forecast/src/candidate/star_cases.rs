//! The cases of the stars of a design among many: their strengths, their places in the stack, and the object where each meets it.

use crate::candidate::{Candidate, RefusedDesign};
use crate::case::Case;
use design::{Meeting, Object, Star, opening};
use spec::units::LineForce;
use spec::{StarSpec, seam_strength};

impl Candidate {
    /// The strengths of the two loops of `star`.
    pub(super) fn strengths(&self, star: &StarSpec) -> [Option<LineForce>; 2] {
        [&star.inner_process, &star.outer_process]
            .map(|name| seam_strength(&self.processes, name, &self.fabric))
    }

    /// The cases of its stars, each with the slopes of the object at such stars, the lowest star's first; empty where all are as `base_case`, the
    /// case of `star`.
    pub(super) fn different_cases(
        &self,
        star: &Star,
        base_case: &Case,
    ) -> Result<Vec<(Case, Vec<f64>)>, RefusedDesign> {
        let object = Object::new(&self.load).filter(|_| self.stars > 1);
        if self.unequal.is_empty() {
            let meetings = object.map_or_else(Vec::new, |object| self.different_meetings(&object, star));
            return Ok(meetings
                .into_iter()
                .map(|(meeting, slopes)| (base_case.meeting(Some(meeting)), slopes))
                .collect());
        }
        let star_of = |(i, one): (usize, &StarSpec)| {
            Star::for_band(one, self.seal.band).map_err(|refusal| refusal.of_star(i + 1))
        };
        let stars = self.unequal.iter().enumerate().map(star_of).collect::<Result<Vec<Star>, _>>()?;
        let mut heights = vec![0.0];
        for star in self.unequal.iter().skip(1) {
            heights.push(heights[heights.len() - 1] + star.pitch.0);
        }
        let holes: Vec<f64> = stars.iter().map(|star| star.hole(&self.seal)).collect();
        let meetings = object.map(|object| object.meetings(&heights, &holes));
        let case = |(i, star): (usize, &Star)| {
            let neighbours = self.unequal.iter().take(i + 1).skip(i.saturating_sub(1));
            let plate_opening = opening(neighbours.map(|star| star.inner_radius.0), self.clearance.0);
            let meeting = meetings.as_ref().and_then(|meetings| meetings.get(i)).copied();
            let case = Case::new(star, &self.fabric, &self.seal, Some(&self.load))?
                .with_strengths(self.strengths(&self.unequal[i]))
                .above_plate(Some(plate_opening));
            Ok((case.meeting(meeting), vec![meeting.map_or(0.0, |meeting| meeting.slope)]))
        };
        stars.iter().enumerate().map(case).collect()
    }

    /// The contacts of its equal stars with `object`, each with the slopes of the object at such stars, the lowest star's first; empty where
    /// all meet its middle.
    fn different_meetings(&self, object: &Object, star: &Star) -> Vec<(Meeting, Vec<f64>)> {
        let mut meetings: Vec<(Meeting, Vec<f64>)> = Vec::new();
        for meeting in object.equal_meetings(self.stars, self.star.pitch.0, star.hole(&self.seal)) {
            match meetings.iter_mut().find(|(like, _)| like.is_like(&meeting)) {
                Some((_, slopes)) => slopes.push(meeting.slope),
                None => meetings.push((meeting, vec![meeting.slope])),
            }
        }
        if meetings.len() > 1 || meetings.iter().any(|(meeting, _)| meeting.radius < meeting.entering) {
            meetings
        } else {
            Vec::new()
        }
    }

    /// Whether all of its stars are as `star`, whose case is `base_case`, and meet the object at its middle radius.
    pub fn are_alike(&self, star: &Star, base_case: &Case) -> bool {
        self.different_cases(star, base_case).is_ok_and(|cases| cases.is_empty())
    }

    /// The most stars of a stack that is not taller than its object, at least 1.
    pub fn most_stars(&self) -> u32 {
        let Some(object) = Object::new(&self.load) else { return u32::MAX };
        let stars =
            ((object.height().0 - self.plate.0) / self.star.pitch.0.max(1e-3)).floor().clamp(1.0, 1e3);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "1 to 1000")]
        let stars = stars as u32;
        stars
    }
}
