//! Programs that do the same: the way of the iron, calculated by other means than the verifier's.

/// A place on a program's way: X, Y, Z, feed.
type Place = [f64; 4];

/// Largest delay by a wait, s: in this time the iron moves 0.002 mm at the seal's 0.1 mm/s.
const LATE: f64 = 0.02;

/// The same lines other than cuts, blanks between their words apart, and between them the same way at the same feed: places at
/// equal distances along it lie no farther apart than 0.002 mm, whatever the moves it is made of. Waits may differ if their sum
/// differs nowhere by more than [`LATE`].
pub(crate) fn same_way(a: &str, b: &str) -> bool {
    let (a, b) = (ways(a), ways(b));
    let mut late = 0.0_f64;
    let mut same_waits = |said: &str, also: &str| {
        let (Some(said), Some(also)) = (wait(said), wait(also)) else { return false };
        late += also - said;
        late.abs() <= LATE
    };
    let near = |a: &Place, b: &Place| (0..4).all(|k| (a[k] - b[k]).abs() <= 0.002);
    a.len() == b.len()
        && a.iter().zip(&b).all(|((said, one), (also, other))| {
            let (one, other) = (at_equal_distances(one), at_equal_distances(other));
            (same_words(said, also) || same_waits(said, also))
                && one.len() == other.len()
                && one.iter().zip(&other).all(|(a, b)| near(a, b))
        })
}

/// The same way except for comments without effect: progress, lengths, times, pictures, prose.
pub(crate) fn same_facts(before: &[u8], after: &[u8]) -> bool {
    let facts = |bytes: &[u8]| -> Option<String> {
        let text = std::str::from_utf8(bytes).ok()?;
        let is_read = |line: &&str| {
            let comment = line.trim_start_matches([';', '(', ' ']);
            let is_comment = line.starts_with([';', '(']);
            !(line.starts_with("M73") || is_comment && !FACTS.iter().any(|fact| comment.starts_with(fact)))
        };
        Some(text.lines().filter(is_read).map(|line| line.to_owned() + "\n").collect())
    };
    facts(before).zip(facts(after)).is_some_and(|(a, b)| same_way(&a, &b))
}

/// The beginnings of comments on which a resumed job or the operator relies.
const FACTS: [&str; 9] = [
    "program: ",
    "seal: ",
    "machine: ",
    "heights: ",
    "path: ",
    "chop",
    "seam: ",
    "set the iron to ",
    "end of program, ",
];

/// Duration of a line's dwell, s: milliseconds have no point, and no dwell takes a minute.
fn wait(line: &str) -> Option<f64> {
    let told = line.strip_prefix("G4")?.trim_start().strip_prefix('P')?;
    let time: f64 = told.parse().ok()?;
    Some(if told.contains('.') || time < 10.0 { time } else { 1e-3 * time })
}

/// The same words, in a line of code with or without blanks between them; in a comment also the same figures, such as 5 and 5.0.
fn same_words(a: &str, b: &str) -> bool {
    let figure = |word: &str| -> Option<(String, f64)> {
        let (name, value) = word.split_once('=')?;
        Some((name.to_owned(), value.parse().ok()?))
    };
    let same = |a: &str, b: &str| a == b || figure(a).is_some_and(|a| figure(b) == Some(a));
    let code =
        |line: &str| line.starts_with(['G', 'M']) && line[1..].starts_with(|c: char| c.is_ascii_digit());
    let bare = |line: &str| line.replace(' ', "");
    a == b
        || code(a) && bare(a) == bare(b)
        || a.starts_with([';', '('])
            && a.split(' ').count() == b.split(' ').count()
            && a.split(' ').zip(b.split(' ')).all(|(a, b)| same(a, b))
}

/// The way up to each line other than a cut, and the line.
fn ways(text: &str) -> Vec<(String, Vec<Place>)> {
    let mut at: Place = [0.0; 4];
    let (mut way, mut out) = (Vec::new(), Vec::new());
    // The last line counts the others; an empty line has no words.
    for line in text.lines().map(str::trim_end).filter(|l| !l.is_empty() && !l.contains("end of program, ")) {
        let word = |letter: char| -> Option<f64> {
            let (_, rest) = line.split_once(letter)?;
            let end = rest.find(|c: char| !"+-.0123456789".contains(c)).unwrap_or(rest.len());
            rest[..end].parse().ok()
        };
        let from = at;
        if line.starts_with('G') && !line.starts_with("G4") {
            for (k, letter) in ['X', 'Y', 'Z', 'F'].into_iter().enumerate() {
                at[k] = word(letter).unwrap_or(at[k]);
            }
        }
        let arc = line.starts_with("G2") && !line.starts_with("G21") || line.starts_with("G3");
        if arc {
            let (i, j) = (word('I').unwrap_or(0.0), word('J').unwrap_or(0.0));
            let (x, y) = (from[0] + i, from[1] + j);
            let start = (-j).atan2(-i);
            let turn = (at[1] - y).atan2(at[0] - x) - start;
            let full = std::f64::consts::TAU;
            let turn =
                if line.starts_with("G3") { turn.rem_euclid(full) } else { turn.rem_euclid(full) - full };
            let radius = i.hypot(j);
            way.extend((1..100).map(|n| {
                let part = f64::from(n) / 100.0;
                let angle = start + part * turn;
                let z = from[2] + part * (at[2] - from[2]);
                [x + radius * angle.cos(), y + radius * angle.sin(), z, at[3]]
            }));
        }
        if arc || line.starts_with("G1") && !line.starts_with("G17") {
            way.push(at);
        } else {
            let said = if line.starts_with("G0") { String::from("G0") } else { line.to_owned() };
            out.push((said, std::mem::take(&mut way)));
            way.push(at);
        }
    }
    out
}

fn at_equal_distances(way: &[Place]) -> Vec<Place> {
    let length = |a: &Place, b: &Place| (b[0] - a[0]).hypot(b[1] - a[1]).hypot(b[2] - a[2]);
    let whole: f64 = way.windows(2).map(|ends| length(&ends[0], &ends[1])).sum();
    let mut out: Vec<Place> = way.first().into_iter().chain(way.last()).copied().collect();
    let (mut done, mut next) = (0.0, 1);
    for ends in way.windows(2) {
        let here = length(&ends[0], &ends[1]);
        while next < 500 && f64::from(next) / 500.0 * whole <= done + here && here > 0.0 {
            let part = (f64::from(next) / 500.0 * whole - done) / here;
            let mut place: Place = std::array::from_fn(|k| ends[0][k] + part * (ends[1][k] - ends[0][k]));
            place[3] = ends[1][3];
            out.push(place);
            next += 1;
        }
        done += here;
    }
    out
}
