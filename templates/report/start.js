// Start: everything is shown at once, before the page is painted; only the scene comes when it is unpacked.

"use strict";

showKind();
showHead();
showVerdict();
if (KIND === "star") showStars();
else showChambers();
showJob();
if (KIND === "star") showPlots();
showBill();
showChecks();
showSettings();
showEvidence();
hintScrolling();
document.body.classList.remove("wait");
showSolid().then(keepPlace);
