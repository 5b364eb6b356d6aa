//! The picture of speed against accuracy shows the numbers of the table beside it: times differ from run to run, so the two have to
//! come from one.

/// Where a value lies on a logarithmic axis: pixels at 1, and a decade.
fn at(value: f64, (one, decade): (f64, f64)) -> f64 {
    one + decade * value.log10()
}

#[test]
fn the_picture_of_the_trade_is_that_of_its_table() {
    let page = include_str!("../../docs/trade.md");
    let picture = include_str!("../../docs/trade.svg");
    let numbers = |line: &str, name: &str| -> Option<f64> {
        line.split_once(&format!(" {name}=\"")).and_then(|(_, rest)| rest.split('"').next()?.parse().ok())
    };
    let circles: Vec<(f64, f64)> = picture
        .lines()
        .filter(|line| line.starts_with("<circle") && !line.contains("cx=\"730\""))
        .filter_map(|line| numbers(line, "cx").zip(numbers(line, "cy")))
        .collect();
    let mut compared = 0;
    for row in
        page.lines().filter(|line| line.contains(" us ") && !line.contains(" kPa") && !line.starts_with('|'))
    {
        let (name, rest) = row.split_at(20);
        let (time, errors) = rest.split_once(" us ").expect("a time");
        let x = at(time.trim().parse::<f64>().expect("a number") * 1e-6, (710.0, 80.0));
        for error in errors.split_whitespace().filter_map(|word| word.parse::<f64>().ok()) {
            let y = at(error.max(1e-16), (30.0, -25.0));
            let is_shown = circles.iter().any(|(cx, cy)| (cx - x).abs() < 4.0 && (cy - y).abs() < 1.5);
            assert!(is_shown, "{}: {error} is not at {x:.1}, {y:.1}", name.trim());
            compared += 1;
        }
    }
    assert!(compared > 30 && compared == circles.len(), "{compared} of {}", circles.len());
}
