// Start: everything is shown at once, before the page is painted; only the scene comes when it is unpacked.

"use strict";

showHead();
showVerdict();
showStars();
showJob();
showPlots();
showBill();
showChecks();
showSettings();
showEvidence();
hintScrolling();
document.body.classList.remove("wait");
showSolid();
