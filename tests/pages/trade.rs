//! The pictures of speed against accuracy show the numbers of the tables beside them: times differ from run to run, so both must come from
//! one run.

/// Position of a value on a logarithmic axis: pixels at 1, and a decade.
fn position(value: f64, unit_place: f64, decade: f64) -> f64 {
    unit_place + decade * value.log10()
}

/// A circle of a picture by its centre, pixels.
#[derive(Clone, Copy)]
struct Circle {
    x: f64,
    y: f64,
}

fn circles_of(picture: &str) -> Vec<Circle> {
    let number = |line: &str, name: &str| -> Option<f64> {
        line.split_once(&format!(" {name}=\"")).and_then(|(_, rest)| rest.split('"').next()?.parse().ok())
    };
    picture
        .lines()
        .filter(|line| line.starts_with("<circle"))
        .filter_map(|line| Some(Circle { x: number(line, "cx")?, y: number(line, "cy")? }))
        .collect()
}

fn is_shown(circles: &[Circle], place: Circle, tolerance: Circle) -> bool {
    circles
        .iter()
        .any(|circle| (circle.x - place.x).abs() < tolerance.x && (circle.y - place.y).abs() < tolerance.y)
}

const PAGE: &str = include_str!("../../docs/trade.md");

/// The rows of the table of the page that begins with `head`.
fn rows(head: &str) -> Vec<&'static str> {
    let lines = PAGE.lines().skip_while(|line| !line.starts_with(head)).skip(1);
    lines.take_while(|line| line.contains(" kPa")).collect()
}

/// The last word of a row, a root of the mean square in %.
fn last(row: &str) -> f64 {
    row.split_whitespace().last().and_then(|word| word.parse::<f64>().ok()).expect("an rms")
}

/// The first columns of the picture's second panel: rows 24 pixels apart from 440 on, an error of 1 at 890 and a decade in 41.25 pixels.
#[test]
fn the_limits_in_the_picture_are_those_of_their_table() {
    let circles: Vec<Circle> = circles_of(include_str!("../../docs/trade.svg"))
        .into_iter()
        .filter(|circle| circle.y > 430.0)
        .collect();
    let table =
        PAGE.lines().filter(|line| line.contains(" us ") && !line.contains(" kPa") && !line.starts_with('|'));
    let mut compared = 0;
    for (row, place) in table.zip(0_u8..) {
        let (name, rest) = row.split_at(20);
        let (_, errors) = rest.split_once(" us ").expect("a time");
        for error in errors.split_whitespace().filter_map(|word| word.parse::<f64>().ok()) {
            let place =
                Circle { x: position(error.max(1e-16), 890.0, 41.25), y: 440.0 + 24.0 * f64::from(place) };
            // The table has two digits.
            assert!(is_shown(&circles, place, Circle { x: 1.5, y: 1.0 }), "{}: {error}", name.trim());
            compared += 1;
        }
    }
    assert!(compared > 30 && compared == circles.len(), "{compared} of {}", circles.len());
}

/// The picture's first panel has the root of the mean square over three pressures, the table that of each.
#[test]
fn the_choice_in_the_picture_lies_between_the_pressures_of_its_table() {
    let picture = include_str!("../../docs/trade.svg");
    let circles: Vec<Circle> = circles_of(picture).into_iter().filter(|circle| circle.y < 300.0).collect();
    let (closing, forces) = (rows("rho_f "), rows("K | F "));
    let mut models: Vec<&str> = closing.iter().map(|row| row[..15].trim()).collect();
    models.dedup();
    assert_eq!((models.len(), circles.len()), (8, 24));
    for model in models {
        let label = format!("text-anchor=\"start\">{model}</text>");
        let line = picture.lines().find(|line| line.ends_with(&label)).expect(model);
        let y: f64 =
            line.split("y=\"").nth(1).and_then(|rest| rest.split('"').next()?.parse().ok()).expect("a place");
        for (table, left) in [(&closing, 230.0), (&forces, 730.0)] {
            let errors: Vec<f64> =
                table.iter().filter(|row| row[..15].trim() == model).map(|row| 0.01 * last(row)).collect();
            let [low, high] =
                [f64::min, f64::max].map(|pick| errors.iter().copied().reduce(pick).expect(model));
            let circle = circles.iter().find(|circle| {
                (circle.y - (y - 4.0)).abs() < 0.1 && (left - 0.1..left + 185.1).contains(&circle.x)
            });
            let circle = circle.expect(model);
            // The table rounds to a tenth of a percent.
            let ends = [(low - 5e-4).max(1e-3), (high + 5e-4).min(10.0)];
            let [start, end] = ends.map(|error| position(error, left + 138.75, 46.25));
            assert!((start..end).contains(&circle.x), "{model}: {} outside {start} to {end}", circle.x);
        }
    }
}

#[test]
fn the_picture_of_shells_is_that_of_its_tables() {
    let circles = circles_of(include_str!("../../docs/trade-shells.svg"));
    let (closing, forces) = (rows("rho_f "), rows("K | F "));
    assert!(closing.len() == forces.len() && closing.len() > 20);
    let mut compared = 0;
    for (closing, force) in closing.into_iter().zip(forces) {
        assert_eq!(closing[..23], force[..23]);
        let words: Vec<&str> = closing[23..].split_whitespace().collect();
        let Ok(time) = words[0].parse::<f64>() else { continue };
        let unit = match words[1] {
            "us" => 1e-6,
            "ms" => 1e-3,
            _ => 1.0,
        };
        let time = unit * time;
        for (row, left) in [(closing, 70.0), (force, 520.0)] {
            // 45 pixels for a decade of time from 100 ns, 90 for one of error from 1000 % down.
            let x = position(time.max(1e-7), left + 315.0, 45.0);
            let error = last(row);
            let y = position((0.01 * error).max(1e-3), 130.0, -90.0);
            // The table rounds to a tenth of a percent, which is much for a small number.
            let rounded = 1.0 + 90.0 * (1.0 - 0.05 / error.max(0.1)).log10().abs();
            let tolerance = Circle { x: 6.0, y: rounded.max(6.0) };
            assert!(is_shown(&circles, Circle { x, y }, tolerance), "{row}: not at {x:.1}, {y:.1}");
            compared += 1;
        }
    }
    assert!(compared > 36 && compared == circles.len(), "{compared} of {}", circles.len());
}
