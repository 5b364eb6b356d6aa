//! The pictures of speed against accuracy show the numbers of the tables beside them: times differ from run to run, so both must come from
//! one run.

/// Position of a value on a logarithmic axis: pixels at 1, and a decade.
fn at(value: f64, (one, decade): (f64, f64)) -> f64 {
    one + decade * value.log10()
}

/// The centres of the circles of `picture`, without those of its legend.
fn circles(picture: &str) -> Vec<(f64, f64)> {
    let numbers = |line: &str, name: &str| -> Option<f64> {
        line.split_once(&format!(" {name}=\"")).and_then(|(_, rest)| rest.split('"').next()?.parse().ok())
    };
    picture
        .lines()
        .filter(|line| line.starts_with("<circle") && !line.contains("cx=\"730\""))
        .filter_map(|line| numbers(line, "cx").zip(numbers(line, "cy")))
        .collect()
}

fn is_shown(circles: &[(f64, f64)], (x, y): (f64, f64), (dx, dy): (f64, f64)) -> bool {
    circles.iter().any(|(cx, cy)| (cx - x).abs() < dx && (cy - y).abs() < dy)
}

const PAGE: &str = include_str!("../../docs/trade.md");

#[test]
fn the_picture_of_the_trade_is_that_of_its_table() {
    let circles = circles(include_str!("../../docs/trade.svg"));
    let mut compared = 0;
    for row in
        PAGE.lines().filter(|line| line.contains(" us ") && !line.contains(" kPa") && !line.starts_with('|'))
    {
        let (name, rest) = row.split_at(20);
        let (time, errors) = rest.split_once(" us ").expect("a time");
        let x = at(time.trim().parse::<f64>().expect("a number") * 1e-6, (710.0, 80.0));
        for error in errors.split_whitespace().filter_map(|word| word.parse::<f64>().ok()) {
            let y = at(error.max(1e-16), (30.0, -25.0));
            assert!(
                is_shown(&circles, (x, y), (4.0, 1.5)),
                "{}: {error} is not at {x:.1}, {y:.1}",
                name.trim()
            );
            compared += 1;
        }
    }
    assert!(compared > 30 && compared == circles.len(), "{compared} of {}", circles.len());
}

#[test]
fn the_picture_of_shells_is_that_of_its_tables() {
    let circles = circles(include_str!("../../docs/trade-shells.svg"));
    let rows = |head: &str| {
        let lines = PAGE.lines().skip_while(|line| !line.starts_with(head)).skip(1);
        lines.take_while(|line| line.contains(" kPa")).collect::<Vec<_>>()
    };
    let last =
        |row: &str| row.split_whitespace().last().and_then(|word| word.parse::<f64>().ok()).expect("an rms");
    let (closing, forces) = (rows("rho_f "), rows("K | F "));
    assert!(closing.len() == forces.len() && closing.len() > 20);
    let mut compared = 0;
    for (closing, force) in closing.into_iter().zip(forces) {
        assert_eq!(closing[..23], force[..23]);
        let words: Vec<&str> = closing[23..].split_whitespace().collect();
        let Ok(time) = words[0].parse::<f64>() else { continue };
        let time = if words[1] == "us" { 1e-6 * time } else { time };
        for (row, left) in [(closing, 70.0), (force, 520.0)] {
            // 45 pixels for a decade of time from 100 ns, 90 for one of error from 1000 % down.
            let x = at(time.max(1e-7), (left + 315.0, 45.0));
            let error = last(row);
            let y = at((0.01 * error).max(1e-3), (130.0, -90.0));
            // The table rounds to a tenth of a percent, which is much for a small number.
            let rounded = 1.0 + 90.0 * (1.0 - 0.05 / error.max(0.1)).log10().abs();
            assert!(is_shown(&circles, (x, y), (6.0, rounded.max(6.0))), "{row}: not at {x:.1}, {y:.1}");
            compared += 1;
        }
    }
    assert!(compared > 36 && compared == circles.len(), "{compared} of {}", circles.len());
}
