//! A hinge model that solves each hinge once: stars of a stack with equal hinges ask for the same ones.

use std::collections::BTreeMap;
use std::sync::Mutex;

use inflatable::mechanics::fault::HingeFault;
use inflatable::mechanics::hinge::{Arms, HingeModel, HingeState, Level};

/// The answers of a model, by the bits of its arguments.
type Answers<K> = Mutex<BTreeMap<K, Result<HingeState, HingeFault>>>;

/// `model` with its answers so far.
pub(super) struct Remembered<M> {
    model: M,
    states: Answers<[u64; 2]>,
    targets: Answers<u64>,
}

impl<M> Remembered<M> {
    /// `model`, without answers.
    pub(super) fn new(model: M) -> Self {
        Self { model, states: Answers::default(), targets: Answers::default() }
    }
}

/// The answer to `question`, from `answers` or computed by `solve`; a thread that panicked leaves no answers.
fn answer<K: Ord>(
    answers: &Answers<K>,
    question: K,
    solve: impl FnOnce() -> Result<HingeState, HingeFault>,
) -> Result<HingeState, HingeFault> {
    let answer = answers.lock().ok().and_then(|answers| answers.get(&question).copied());
    answer.unwrap_or_else(|| {
        let solved = solve();
        if let Ok(mut answers) = answers.lock() {
            let _ = answers.insert(question, solved);
        }
        solved
    })
}

impl<M: HingeModel> HingeModel for Remembered<M> {
    fn level(&self) -> Level {
        self.model.level()
    }

    fn state(&self, r_star: f64, lambda: f64) -> Result<HingeState, HingeFault> {
        let question = [r_star.to_bits(), lambda.to_bits()];
        answer(&self.states, question, || self.model.state(r_star, lambda))
    }

    fn target(&self, r_star: f64) -> Result<HingeState, HingeFault> {
        answer(&self.targets, r_star.to_bits(), || self.model.target(r_star))
    }

    fn onset(&self, r_star: f64) -> Result<Option<f64>, HingeFault> {
        self.model.onset(r_star)
    }

    fn arms(&self, r_star: f64, arc: f64) -> Option<Arms> {
        self.model.arms(r_star, arc)
    }
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicUsize, Ordering};

    use inflatable::mechanics::hinge::ring::Ring;

    use super::*;

    /// The exact ring, with the number of its solutions.
    struct Counted<'a>(&'a AtomicUsize);

    impl HingeModel for Counted<'_> {
        fn level(&self) -> Level {
            Ring.level()
        }

        fn state(&self, r_star: f64, lambda: f64) -> Result<HingeState, HingeFault> {
            let _ = self.0.fetch_add(1, Ordering::Relaxed);
            Ring.state(r_star, lambda)
        }

        fn target(&self, r_star: f64) -> Result<HingeState, HingeFault> {
            let _ = self.0.fetch_add(1, Ordering::Relaxed);
            Ring.target(r_star)
        }
    }

    #[test]
    fn each_hinge_is_solved_once() {
        let count = AtomicUsize::new(0);
        let model = Remembered::new(Counted(&count));
        for _ in 0..3 {
            assert_eq!(model.state(0.1, 1.1), Ring.state(0.1, 1.1));
            assert_eq!(model.state(-1.0, 1.1), Ring.state(-1.0, 1.1), "a refusal is an answer");
            assert_eq!(model.target(0.1), Ring.target(0.1));
        }
        assert_eq!(count.load(Ordering::Relaxed), 3);
        let _ = model.state(0.1, 1.2);
        assert_eq!(count.load(Ordering::Relaxed), 4);
    }
}
