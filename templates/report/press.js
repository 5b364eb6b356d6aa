// A heat press: its time is told in pressings, and there is no program to play. These replace functions of the same names.

/** The pressings, their time, temperature and pressure. */
function hours() {
  return data.press.words;
}

function showJob() {}
