//! The codes of precautions before sealing, and of commands that fail without a fault of a spec or a design.

use spec::codes;

codes! {
    /// The subject of a precaution.
    PrecautionCode {
        ChoppedSeal "chopped-seal" "The seal's speed is an average of strokes and dwells; time a feed check.",
        CutSheet "cut-sheet" "What to do between the seal and the cut of the sheet; see the message.",
        FastSeal "fast-seal" "The seal is much faster than the paper's; peel a coupon before you trust it.",
        FitValve "fit-valve" "The flange of a valve is sealed to one sheet before the sheets are sealed; see the message.",
        GenericMachine "generic-machine" "The profile has no data on the machine; name your profile, or time a feed check.",
        LaserSafety "laser-safety" "What protects from a laser and its fumes, or what is to be tested before it seals; see the message.",
        LeavesPlane "leaves-plane" "A drawn shape may bend or twist out of its plane; the prediction assumes that it does not.",
        MachineRequires "machine-requires" "The profile requires this of the machine; make sure of it.",
        MayNotHold "may-not-hold" "The gripper may not hold the object; see the numbers and the remedies.",
        Prediction "prediction" "The prediction has a wide range, or omits an effect; see the message.",
        Pressing "pressing" "What a heat press must give, or what is to be tested before it is used; see the message.",
        SheetMarks "sheet-marks" "Where programs stop above the marks of a sheet; mark it there.",
        Unfit "unfit" "The gripper does not meet its `load` section, and was accepted anyway.",
        UnknownFeed "unknown-feed" "Whether the machine can move as slowly as the seal needs is unknown; time a feed check.",
        UnknownReach "unknown-reach" "Whether the machine reaches all of the sheet is unknown; write `work_area` into its profile.",
        UnknownStrength "unknown-strength" "The burst pressure is unknown; measure `seal_strength` with a coupon, and write it.",
        WeakProcess "weak-process" "Seams of several strengths: which is the weakest, or why a weak one does not open first.",
        WeakSeal "weak-seal" "The seal may fail at this place; see the remedy, if one is shown.",
    }
}

codes! {
    /// The reason why a command fails although neither a spec nor a design is refused.
    CommandCode {
        Failed "failed" "The command cannot do this; the message gives the reason.",
        Infeasible "infeasible" "No gripper meets the request; the message names other requests that can be met.",
        NotPublished "not-published" "The files could not be put in place; nothing was replaced.",
    }
}
