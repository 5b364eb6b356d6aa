//! Programs that do the same: the way of the iron, calculated by other means than the verifier's.

/// A place on a program's way: X, Y, Z, feed.
type Place = [f64; 4];

/// Largest delay by a wait, s: in this time the iron moves 0.002 mm at the seal's 0.1 mm/s.
const LATE: f64 = 0.02;

/// Whether lines other than cuts are equal, blanks between their words apart, and between them the way at the same feed: places at
/// equal distances along it lie no farther apart than 0.002 mm, whatever the moves it is made of. Waits may differ if their sum
/// differs nowhere by more than [`LATE`].
pub(crate) fn same_way(a: &str, b: &str) -> bool {
    let (a, b) = (ways(a), ways(b));
    let mut delay = 0.0_f64;
    let mut same_waits = |said: &str, also: &str| {
        let (Some(first_wait), Some(second_wait)) = (wait(said), wait(also)) else { return false };
        delay += second_wait - first_wait;
        delay.abs() <= LATE
    };
    let are_near = |a: &Place, b: &Place| (0..4).all(|k| (a[k] - b[k]).abs() <= 0.002);
    a.len() == b.len()
        && a.iter().zip(&b).all(|((said, one), (also, other))| {
            let (first_way, other) = (at_equal_distances(one), at_equal_distances(other));
            (same_words(said, also) || same_waits(said, also))
                && first_way.len() == other.len()
                && first_way.iter().zip(&other).all(|(a, b)| are_near(a, b))
        })
}

/// Whether ways are equal except for comments without effect: progress, lengths, times, pictures, prose.
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
    let figure = line.strip_prefix("G4")?.trim_start().strip_prefix('P')?;
    let time: f64 = figure.parse().ok()?;
    Some(if figure.contains('.') || time < 10.0 { time } else { 1e-3 * time })
}

/// Whether words are equal, in a line of code with or without blanks between them; in a comment also figures, such as 5 and 5.0.
fn same_words(a: &str, b: &str) -> bool {
    let figure = |word: &str| -> Option<(String, f64)> {
        let (name, value) = word.split_once('=')?;
        Some((name.to_owned(), value.parse().ok()?))
    };
    let are_same = |a: &str, b: &str| a == b || figure(a).is_some_and(|a| figure(b) == Some(a));
    let code =
        |line: &str| line.starts_with(['G', 'M']) && line[1..].starts_with(|c: char| c.is_ascii_digit());
    let bare = |line: &str| line.replace(' ', "");
    a == b
        || code(a) && bare(a) == bare(b)
        || a.starts_with([';', '('])
            && a.split(' ').count() == b.split(' ').count()
            && a.split(' ').zip(b.split(' ')).all(|(a, b)| are_same(a, b))
}

/// The way up to each line other than a cut, and the line.
fn ways(text: &str) -> Vec<(String, Vec<Place>)> {
    let mut position: Place = [0.0; 4];
    let (mut way, mut ways) = (Vec::new(), Vec::new());
    // The last line counts the others; an empty line has no words.
    for line in text.lines().map(str::trim_end).filter(|l| !l.is_empty() && !l.contains("end of program, ")) {
        let word = |letter: char| -> Option<f64> {
            let (_, rest) = line.split_once(letter)?;
            let end = rest.find(|c: char| !"+-.0123456789".contains(c)).unwrap_or(rest.len());
            rest[..end].parse().ok()
        };
        let origin = position;
        if line.starts_with('G') && !line.starts_with("G4") {
            for (k, letter) in ['X', 'Y', 'Z', 'F'].into_iter().enumerate() {
                position[k] = word(letter).unwrap_or(position[k]);
            }
        }
        let arc = line.starts_with("G2") && !line.starts_with("G21") || line.starts_with("G3");
        if arc {
            let (i, j) = (word('I').unwrap_or(0.0), word('J').unwrap_or(0.0));
            let (x, y) = (origin[0] + i, origin[1] + j);
            let start = (-j).atan2(-i);
            let turn = (position[1] - y).atan2(position[0] - x) - start;
            let full = std::f64::consts::TAU;
            let turn =
                if line.starts_with("G3") { turn.rem_euclid(full) } else { turn.rem_euclid(full) - full };
            let radius = i.hypot(j);
            way.extend((1..100).map(|n| {
                let part = f64::from(n) / 100.0;
                let angle = start + part * turn;
                let z = origin[2] + part * (position[2] - origin[2]);
                [x + radius * angle.cos(), y + radius * angle.sin(), z, position[3]]
            }));
        }
        if arc || line.starts_with("G1") && !line.starts_with("G17") {
            way.push(position);
        } else {
            let words = if line.starts_with("G0") { String::from("G0") } else { line.to_owned() };
            ways.push((words, std::mem::take(&mut way)));
            way.push(position);
        }
    }
    ways
}

fn at_equal_distances(way: &[Place]) -> Vec<Place> {
    let length = |a: &Place, b: &Place| (b[0] - a[0]).hypot(b[1] - a[1]).hypot(b[2] - a[2]);
    let total: f64 = way.windows(2).map(|ends| length(&ends[0], &ends[1])).sum();
    let mut places: Vec<Place> = way.first().into_iter().chain(way.last()).copied().collect();
    let (mut walked, mut next) = (0.0, 1);
    for ends in way.windows(2) {
        let step = length(&ends[0], &ends[1]);
        while next < 500 && f64::from(next) / 500.0 * total <= walked + step && step > 0.0 {
            let part = (f64::from(next) / 500.0 * total - walked) / step;
            let mut place: Place = std::array::from_fn(|k| ends[0][k] + part * (ends[1][k] - ends[0][k]));
            place[3] = ends[1][3];
            places.push(place);
            next += 1;
        }
        walked += step;
    }
    places
}
