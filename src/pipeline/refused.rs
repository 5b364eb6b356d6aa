//! All refusals of a spec at once, across the stages of its design.
//!
//! A stage that refuses a value ends the design. So that the next stages can judge the rest, the value is **mended**: replaced by one that
//! constrains nothing, such as no `extent` for one that reaches too far. A mended value has no faults that follow from it. Values of a star's
//! shape and of a drawing cannot be mended, because all later stages depend on them.

use crate::pipeline::planned::{no_prediction, planned};
use design::{Design, Refusal, Refusals};
use forecast::predict::predict;
use forecast::verdict;
use spec::units::Length;
use spec::{FEWEST_POSTS, KeyPath, Machine, ModelChoice, Spec};

/// Most stages that are mended, more than there are.
const ROUNDS: usize = 16;

/// A spec and a machine whose refused values are mended.
struct Mended {
    spec: Spec,
    machine: Machine,
    /// All refusals on the way.
    refusals: Refusals,
    /// The design of the mended spec; `None` if a refused value cannot be mended.
    design: Option<Design>,
}

impl Mended {
    /// Mends `spec` and `machine`, of which `design` is the design.
    fn new(spec: &Spec, machine: &Machine, design: Result<Design, Refusals>) -> Self {
        let mut mended =
            Self { spec: spec.clone(), machine: machine.clone(), refusals: Refusals::new(), design: None };
        let mut result = design;
        for _ in 0..ROUNDS {
            match result {
                Ok(design) => return Self { design: Some(design), ..mended },
                Err(refusals) => {
                    // Each one is mended, also after one that cannot be.
                    let failed = refusals.iter().filter(|refusal| !mended.mend(refusal.key)).count();
                    mended.add(refusals);
                    if failed > 0 {
                        return mended;
                    }
                }
            }
            result = Design::new(&mended.spec, &mended.machine);
        }
        mended
    }

    /// Adds refusals that are not yet in the list.
    fn add(&mut self, refusals: impl IntoIterator<Item = Refusal>) {
        for refusal in refusals {
            if !self.refusals.contains(&refusal) {
                self.refusals.push(refusal);
            }
        }
    }

    /// Replaces the value of `key`, one that a design refuses, by one that constrains nothing; returns whether there is one.
    fn mend(&mut self, key: KeyPath) -> bool {
        let spec = &mut self.spec;
        match (key.section(), key.key()) {
            ("mask", "extent") => spec.mask.extent = None,
            ("mask", "creep") => spec.mask.creep = Length(0.0),
            ("mask", "border") => spec.mask.border = Length(10.0),
            ("mask", "bed") => spec.mask.bed = None,
            ("cut", "kerf") => {
                // That of the frame is the same if it is not written.
                if spec.frame.kerf == spec.cut.kerf {
                    spec.frame.kerf = Length(0.0);
                }
                spec.cut.kerf = Length(0.0);
            }
            ("frame", "kerf") => spec.frame.kerf = Length(0.0),
            ("frame", "posts") => spec.frame.posts = FEWEST_POSTS,
            ("stack", "pitch") => {
                for star in &mut spec.stars {
                    star.pitch = Length(star.pitch.0.max(star.tube_width.0 + spec.frame.plate_thickness.0));
                }
            }
            // Without a hose, the ports of a drawing would be told to be missing.
            ("inlet", _) if spec.has_stars() => spec.inlet = None,
            ("sheet", "hole_diameter") => spec.sheet.hole_diameter = Length(0.0),
            ("sheet", "width" | "height") => (spec.sheet.width, spec.sheet.height) = (None, None),
            ("machine", "profile") => self.machine.bench.work_area = None,
            _ => return false,
        }
        true
    }
}

/// All reasons why the stages up to the programs refuse `spec` or `machine`, whose design has these `refusals`.
pub(super) fn refused(spec: &Spec, machine: &Machine, refusals: Refusals) -> Refusals {
    let mut mended = Mended::new(spec, machine, Err(refusals));
    if let Some(design) = mended.design.take() {
        let refused = planned(mended.spec.clone(), mended.machine.clone(), design).err().unwrap_or_default();
        // A mended inlet is none, which would leave the star without air.
        let is_mended = spec.inlet.is_some() && mended.spec.inlet.is_none();
        mended.add(refused.into_iter().filter(|refusal| !(is_mended && refusal.key.section() == "inlet")));
    }
    mended.refusals
}

/// The reasons why a gripper of `spec`, which has these `refusals`, does not suit its own load, as far as that can be judged. Models that compute
/// for long are left out.
pub fn unfit_besides(spec: &Spec, machine: &Machine, refusals: &Refusals) -> Refusals {
    let is_fast = !matches!(spec.accuracy.model, ModelChoice::Shell | ModelChoice::Bvp);
    if !spec.has_stars() || spec.load.is_none() || !is_fast {
        return Refusals::new();
    }
    // The refused values are mended before the design is made again: to refuse a bed for a large mask takes long.
    let mut mended =
        Mended { spec: spec.clone(), machine: machine.clone(), refusals: Refusals::new(), design: None };
    for refusal in refusals.iter() {
        let _ = mended.mend(refusal.key);
    }
    let design = Design::new(&mended.spec, &mended.machine);
    let Mended { spec, design, .. } = Mended::new(&mended.spec, &mended.machine, design);
    design.map_or_else(Refusals::new, |design| match predict(&spec, &design) {
        Ok(prediction) => verdict::refusals(&spec, &prediction).into_iter().collect(),
        Err(fault) => no_prediction(&fault).into(),
    })
}
