//! The codes of refusals and warnings: of the design, and of what later rooms say in its words.

use crate::spec::codes;

codes! {
    /// Why a valid spec cannot be made, or what a person should know before making it.
    RefusalCode {
        ArmsFallThrough "arms-fall-through" "Arms would slip through a plate's opening; make clearance smaller or the stars more alike.",
        BandEatsArm "band-eats-arm" "The band takes more of an arm at its end than there is; make it narrower, or the hinge rounder.",
        BandsMeet "bands-meet" "A leak: the two bands leave no tube between them; widen the tube or narrow the band.",
        Bursts "bursts" "The seal would peel at the pressure of `load`; see the remedies shown, or build it all the same with `--anyway`.",
        ClampInTheWay "clamp-in-the-way" "The iron would meet a clamp of the profile; move the clamp or the sheet's parts.",
        FeedFloor "feed-floor" "The controller cannot go as slowly as the seal; let it chop, seal faster, or use finer steps.",
        HoleClosed "hole-closed" "Band and hole-side flap close the hole; make them smaller or inner_radius larger.",
        InletMeetsArm "inlet-meets-arm" "The hose's channel is wider than the tip has room for; take a thinner hose or a wider tube.",
        JobTooLarge "job-too-large" "The job has too many moves, or takes too long, to be written; build fewer or smaller stars at a time.",
        LongExtent "long-extent" "The wanted coating windows would meet or run past the arms; make extent smaller.",
        LongOverlap "long-overlap" "The overlap is longer than half the loop; make it shorter.",
        NarrowMouth "narrow-mouth" "A leak: the inlet's mouth is too narrow for the hose; take a thinner hose.",
        NoArm "no-arm" "The arms would have no length; make one of the single changes shown.",
        NoChop "no-chop" "The slow seal cannot be chopped into strokes; give the profile what is missing, or another speed.",
        NoOverlap "no-overlap" "A leak: a loop closes without sealing any of it twice; make overlap larger.",
        NoPlate "no-plate" "The mask's plate cannot be made so much larger than the outline; make border smaller.",
        NoPrediction "no-prediction" "The mechanics has no answer for this spec; change the key shown, or delete its `load` section.",
        NoRoomForHoles "no-room-for-holes" "The registration holes do not fit on a tip; make them smaller, or 0.",
        NoWindow "no-window" "Creep leaves nothing of the coating windows; make it smaller.",
        ObjectTooThin "object-too-thin" "The inflated star does not reach the object of `load`; make inner_radius smaller, or use `--anyway`.",
        ObjectTooWide "object-too-wide" "The object of `load` does not enter the star, or is not closed around; see the remedy, or use `--anyway`.",
        OutOfReach "out-of-reach" "The machine does not reach all of a part or a coupon; make it smaller, or take a larger machine.",
        PostMeetsHose "post-meets-hose" "A post of the frame would stand in the way of a hose; use fewer posts or line up the inlets.",
        SeamCrossesItself "seam-crosses-itself" "A leak: a seam crosses itself; narrow the band or lengthen the arms.",
        SeamGap "seam-gap" "A leak: a seam has a gap; it has none in any design we know, so please report it.",
        SeamsCross "seams-cross" "A leak: the two seams cross; widen the tube or narrow the band.",
        SheetTooSmall "sheet-too-small" "A part does not fit on the sheet; make the sheet larger, or allow parts to turn.",
        ShortInlet "short-inlet" "The inlet's mouth would lie inside the flap; make its length larger.",
        ShortWindow "short-window" "A warning: the default coating windows had to be cut; write extent to accept it, or make room.",
        SmallBed "small-bed" "A piece of a printed mask is larger than the bed; name a larger bed, or none.",
        StarsOverlap "stars-overlap" "A leak: the bands of two stars on one sheet overlap; make gap larger.",
        SteepRamp "steep-ramp" "The iron would go straight down onto the fabric; write a longer ramp in the machine profile.",
        StraightCorner "straight-corner" "The reentrant corners would be straight or open outwards; narrow the tips or add points.",
        ThickHose "thick-hose" "A warning: the hose is thicker than the inflated tube; take a thinner hose, or a wider tube.",
        TooLarge "too-large" "The star is larger than 200 m; widen the tips or shrink it.",
        TubeBetweenPlates "tube-between-plates" "The inflated tube does not fit between its plates; make pitch larger.",
        WideKerf "wide-kerf" "The cut is wider than what it is to cut out; make kerf smaller.",
        WrongOpening "wrong-opening" "A leak: a loop is open that must be closed, or the other way round; change the `inlet` section.",
    }
}
