//! A study's rows: the design of each, and its agreement with the prediction of that design alone.

use crate::{PAPER, close, predict};
use proptest::prelude::*;
use stargrip_cam::forecast::study::{ColumnKind, ColumnValues, RowBatch, Study, csv};
use stargrip_cam::mechanics::hinge::HingeModel;
use stargrip_cam::mechanics::hinge::ring::{Ring, RingTable};
use stargrip_cam::spec::study::{Axis, read_study};
use stargrip_cam::spec::{Source, read};
use stargrip_cam::units::{Angle, Length, Pressure};
use std::ops::Range;
use std::sync::atomic::AtomicBool;
use std::sync::{Arc, LazyLock};

static NEVER: LazyLock<Arc<AtomicBool>> = LazyLock::new(Arc::default);

/// The paper's gripper, by the membrane's limit.
pub(super) fn ring() -> Source {
    Source::new("spec.toml", format!("{PAPER}[accuracy]\nmodel = \"ring\"\n"))
}

pub(super) fn vary(spec: &Source, axes: &[&str]) -> Result<Study, String> {
    let axes = axes.iter().map(|text| Axis::parse(text).expect("valid")).collect();
    Study::vary(spec, axes).expect("a valid spec")
}

pub(super) fn sweep(axes: &[&str]) -> Study {
    vary(&ring(), axes).expect("small")
}

/// A study of the paper's gripper at its pressure.
pub(super) fn study(text: &str) -> Study {
    let source = Source::new("study.toml", format!("schema = 1\nspec = \"spec.toml\"\n{text}"));
    let file = read_study(&source).unwrap_or_else(|faults| panic!("{faults}"));
    Study::new(&file, &Source::new("spec.toml", PAPER)).unwrap_or_else(|faults| panic!("{faults}"))
}

pub(super) fn text(study: &Study, rows: Range<usize>) -> String {
    let mut out = Vec::new();
    let take = |text: Vec<u8>, _| {
        out.extend(text);
        true
    };
    assert!(study.run(rows, &NEVER, |batch| csv::lines(&batch), take));
    String::from_utf8(out).expect("text")
}

/// The whole stack's numbers are those of the prediction, also where a value varies that only some of its stars share.
#[test]
fn rows_of_unequal_stars_say_what_their_predictions_say() {
    let own = "[[stack.star]]\nindex = 2\ninner_radius = \"60 mm\"\n";
    let source = Source::new("spec.toml", format!("{PAPER}{own}"));
    let axes =
        ["star.inner_radius=50 mm,60 mm", "star.tip_angle=30 deg,34 deg", "load.pressure=30 kPa,37 kPa"];
    let study = vary(&source, &axes).expect("small");
    let batch = whole(&study);
    let found = ["payload_kg", "payload_lo_kg", "payload_hi_kg"].map(|name| numbers(&study, &batch, name));
    for row in 0..study.rows() {
        let mut spec = read(&source).expect("valid").spec;
        let pick = |stride: usize, values: [f64; 2]| values[row / stride % 2];
        for (star, spec) in spec.stars.iter_mut().enumerate() {
            spec.inner_radius = Length(if star == 1 { 60.0 } else { pick(4, [50.0, 60.0]) });
            spec.tip_angle = Angle(pick(2, [30.0, 34.0]));
        }
        spec.load.as_mut().expect("given").pressure = Some(Pressure(pick(1, [30.0, 37.0])));
        let first = predict(&spec).first;
        let [low, high] = first.ranges.payload_kg.expect("known");
        for (column, value) in found.iter().zip([first.payload_kg.expect("known"), low, high]) {
            close(column[row], value, 1e-9);
        }
    }
}

fn lines(study: &Study, rows: Range<usize>) -> Vec<String> {
    text(study, rows).lines().map(str::to_owned).collect()
}

/// The numbers of column `name`.
pub(super) fn numbers(study: &Study, batch: &RowBatch, name: &str) -> Vec<f64> {
    let at = study.columns().iter().position(|column| column.name == name).expect(name);
    match &batch.columns[at] {
        ColumnValues::Real(values) => values.clone(),
        #[expect(clippy::cast_precision_loss, reason = "small numbers")]
        ColumnValues::Whole(values) => values.iter().map(|value| *value as f64).collect(),
        ColumnValues::Text(_) => panic!("{name} holds words"),
    }
}

pub(super) fn words(study: &Study, batch: &RowBatch, name: &str) -> Vec<Option<String>> {
    let at = study.columns().iter().position(|column| column.name == name).expect(name);
    match &batch.columns[at] {
        ColumnValues::Text(values) => values.iter().map(|word| word.as_deref().map(str::to_owned)).collect(),
        _ => panic!("{name} holds numbers"),
    }
}

pub(super) fn whole(study: &Study) -> RowBatch {
    let mut all: Vec<RowBatch> = Vec::new();
    let take = |batch: RowBatch, _: usize| {
        match all.first_mut() {
            Some(whole) => {
                whole.columns.iter_mut().zip(batch.columns).for_each(|(own, more)| append(own, more));
            }
            None => all.push(batch),
        }
        true
    };
    assert!(study.run(0..study.rows(), &NEVER, |batch| batch, take), "nobody stops it");
    all.swap_remove(0)
}

fn append(own: &mut ColumnValues, more: ColumnValues) {
    match (own, more) {
        (ColumnValues::Real(own), ColumnValues::Real(more)) => own.extend(more),
        (ColumnValues::Whole(own), ColumnValues::Whole(more)) => own.extend(more),
        (ColumnValues::Text(own), ColumnValues::Text(more)) => own.extend(more),
        _ => panic!("columns of other kinds"),
    }
}

/// `sweep spec.toml --vary star.points=3,5,9 --vary "star.tube_width=20 mm..40 mm/3" --vary "load.pressure=0.001 kPa,37 kPa,600 kPa"`
/// of the version before study files. Predictions, empty cells and remedies are those of this version.
#[test]
fn what_was_swept_before_is_swept_the_same() {
    let spec = Source::new("spec.toml", PAPER.replace("[seal]\nband = \"1 mm\"\n", ""));
    let axes =
        ["star.points=3,5,9", "star.tube_width=20 mm..40 mm/3", "load.pressure=0.001 kPa,37 kPa,600 kPa"];
    let study = vary(&spec, &axes).expect("small");
    let found = csv::header(study.columns(), false) + &text(&study, 0..study.rows());
    assert!(found == include_str!("vary.csv").replace("\r\n", "\n"), "{found}");
}

#[test]
fn the_last_axis_runs_fastest() {
    let sweep = sweep(&["star.points=4,5", "star.tube_width=20 mm..30 mm/3", "star.tip_angle=30 deg,40 deg"]);
    let mut row = 0;
    for points in [4, 5] {
        for width in [20.0, 25.0, 30.0] {
            for angle in [30.0, 40.0] {
                let star = sweep.design(row).expect("a spec").star;
                assert_eq!((star.points, star.tube_width.0, star.tip_angle.0), (points, width, angle));
                let found = &lines(&sweep, row..row + 1)[0];
                assert!(found.starts_with(&format!("{row},{points},{width},{angle},")), "{found}");
                row += 1;
            }
        }
    }
    assert_eq!(sweep.rows(), row);
    assert_eq!(
        csv::header(sweep.columns(), false),
        "row,star.points,star.tube_width_mm,star.tip_angle_deg,arm_length_mm,tip_equilibrium_angle_deg,\
         final_radius_mm,contraction,operating_pressure_kPa,radial_stiffness_N_per_m,object_force_N,payload_kg,\
         burst_pressure_kPa,fabric_cm2,bendability,stretch,burst_margin,widest_radius_mm,final_radius_lo_mm,\
         final_radius_hi_mm,object_force_lo_N,object_force_hi_N,payload_lo_kg,payload_hi_kg,refused\n"
    );
}

#[test]
fn a_row_says_what_its_design_says() {
    let sweep = sweep(&["star.points=4,5,6", "load.pressure=20 kPa,37 kPa"]);
    let table = RingTable::new().expect("solved");
    for (row, line) in lines(&sweep, 0..sweep.rows()).iter().enumerate() {
        let answer = sweep.design(row).expect("a spec").answer(&table).expect("feasible");
        let outcome = answer.outcome.as_ref().expect("a limit");
        let expected = [
            Some(answer.star.l),
            Some(outcome.rest.equilibrium.to_degrees()),
            Some(outcome.rest.radius * 1e3),
            Some(1.0 - outcome.rest.radius / 0.05),
            Some(answer.operating_pressure.0),
            outcome.stiffness,
            outcome.object_force(),
            answer.payload,
            answer.burst.map(|burst| burst.0),
            answer.fabric.map(|area| area * 0.01),
        ];
        let cells: Vec<&str> = line.split(',').collect();
        // A limit has no ranges.
        assert!(cells.len() == 24 && cells[17..].iter().all(|cell| cell.is_empty()), "{line}");
        for (cell, expected) in cells[3..13].iter().zip(expected) {
            // Nine digits are written.
            close(cell.parse().expect("a number"), expected.expect("asked for"), 5e-9);
        }
        // Three equal stars hold three times as much as one.
        close(answer.payload.expect("asked for"), 3.0 * outcome.payload.expect("asked for"), 1e-12);
    }
}

#[test]
fn faults_of_a_sweep_say_which_axis() {
    let new = |axes: &[&str]| vary(&ring(), axes).map(|study| study.rows());
    assert_eq!(new(&[]), Err("nothing is varied".to_owned()));
    let twice = new(&["star.points=3", "load.friction=1", "star.points=4"]);
    assert_eq!(twice, Err("`star.points` is varied twice".to_owned()));
    let size = new(&["load.object_diameter=70 mm", "load.object_radius=40 mm"]);
    let same = "`load.object_diameter` and `load.object_radius` are the same size: vary one of them";
    assert_eq!(size, Err(same.to_owned()));
    let thousand =
        ["load.pressure=1 kPa..2 kPa/1000", "star.tip_angle=30 deg..40 deg/1000", "load.friction=1..2/1000"];
    assert_eq!(new(&thousand), Ok(1_000_000_000));
    let more = [&thousand[..2], &["load.friction=1..2/1001"]].concat();
    assert_eq!(new(&more), Err("more than 1000000000 rows".to_owned()));
}

#[test]
fn parts_are_a_partition_of_equal_sizes() {
    let sweep = sweep(&["star.points=3,4,5,6,7", "load.friction=0.1..1/11"]);
    for parts in [1, 2, 7, 55, 60] {
        let cuts: Vec<Range<usize>> = (1..=parts).map(|part| sweep.part(part, parts)).collect();
        assert_eq!((cuts[0].start, cuts[parts - 1].end), (0, 55));
        assert!(cuts.windows(2).all(|pair| pair[0].end == pair[1].start));
        let (least, most) = (55 / parts, 55_usize.div_ceil(parts));
        assert!(cuts.iter().all(|cut| (least..=most).contains(&cut.len())), "{parts}: {cuts:?}");
    }
}

#[test]
fn a_reader_that_has_enough_stops_the_run() {
    let sweep = sweep(&["star.tip_angle=30 deg..40 deg/9000"]);
    let (mut calls, mut rows) = (0, 0);
    let take = |text: Vec<u8>, count: usize| {
        assert_eq!(text.split(|byte| *byte == b'\n').count(), count + 1);
        (calls, rows) = (calls + 1, rows + count);
        calls < 2
    };
    assert!(!sweep.run(0..sweep.rows(), &NEVER, |batch| csv::lines(&batch), take));
    assert_eq!((calls, rows), (2, 2048));
    let stopped = Arc::new(AtomicBool::new(true));
    let goes_on =
        sweep.run(0..100, &stopped, |batch| batch, |_, _| panic!("whoever stops it gets no torn batch"));
    assert!(!goes_on);
}

#[test]
fn what_is_kept_at_another_value_is_kept_in_every_row() {
    let study = study(
        "model = \"ring\"\n[set]\nstar.points = 4\nseal.band = \"1.5 mm\"\n[vary]\nload.pressure = [\"20 kPa\"]\n",
    );
    let design = study.design(0).expect("a spec");
    assert_eq!(
        (design.star.points, design.seal.band.0, design.model),
        (4, 1.5, stargrip_cam::spec::ModelChoice::Ring)
    );
}

#[test]
fn refusals_have_their_codes_and_nothing_else() {
    let study = study(
        "[vary]\nstar.points = [5, 9]\ninlet.tip = [1, 7]\nseal.temperature = [\"200 C\", \"320 C\"]\n",
    );
    let batch = whole(&study);
    let codes = words(&study, &batch, "refused_code");
    let ptfe = Some("ptfe".to_owned());
    let arm = Some("no-arm".to_owned());
    let tip = Some("out-of-range".to_owned());
    assert_eq!(codes, [None, ptfe.clone(), tip, ptfe.clone(), arm.clone(), ptfe.clone(), arm, ptfe]);
    let columns = study.columns();
    for (i, code) in codes.iter().enumerate() {
        let text = &words(&study, &batch, "refused")[i];
        assert_eq!(code.is_some(), text.is_some());
        for (column, values) in columns.iter().zip(&batch.columns) {
            let is_answer = column.kind == ColumnKind::Real && !column.name.starts_with("seal.");
            if let (true, ColumnValues::Real(values), Some(_)) = (is_answer, values, code) {
                assert!(values[i].is_nan(), "{}: {}", column.name, values[i]);
            }
        }
    }
    assert!(numbers(&study, &batch, "final_radius_mm")[0] > 0.0);
}

#[test]
fn columns_are_those_that_are_wanted_in_their_order() {
    let study = study(
        "outputs = [\"stretch\", \"bendability\"]\n[vary]\nload.pressure = [\"37 kPa\", \"0.01 kPa\"]\n",
    );
    let header = csv::header(study.columns(), true);
    assert_eq!(header, "row,load.pressure_kPa,stretch,bendability,refused_code,refused\n#-,kPa,-,-,-,-\n");
    // p W / Y and 12 p W^3 (1 - nu^2) / (E t^3), calculated independently: they are given even where no model answers.
    let (p, w, e, t, nu) = (37e3, 0.03, 128e6, 0.3e-3, 0.39_f64);
    let batch = whole(&study);
    close(numbers(&study, &batch, "stretch")[0], p * w / (e * t), 1e-12);
    let bendability = numbers(&study, &batch, "bendability");
    close(bendability[0], 12.0 * p * w * w * w * (1.0 - nu * nu) / (e * t * t * t), 1e-12);
    close(bendability[1], bendability[0] / 3700.0, 1e-9);
}

#[test]
fn what_a_study_depends_on_is_in_its_fingerprint() {
    let base = study("[vary]\nstar.points = [4, 5]\n").fingerprint();
    assert_eq!(base.len(), 64);
    assert_eq!(base, study("# the same\nvary = { \"star.points\" = [ 4, 5 ] }\n").fingerprint());
    for other in [
        "[vary]\nstar.points = [4, 6]\n",
        "outputs = [\"stretch\"]\n[vary]\nstar.points = [4, 5]\n",
        "model = \"ring\"\n[vary]\nstar.points = [4, 5]\n",
        "[set]\nload.friction = 0.4\n[vary]\nstar.points = [4, 5]\n",
        "[rows]\nstar.points = [4, 5]\n[vary]\nload.friction = [0.5]\n",
    ] {
        assert!(study(other).fingerprint() != base, "{other}");
    }
}

#[test]
fn a_key_draws_the_same_whatever_else_is_drawn() {
    let of = |keys: &str| {
        let study = study(&format!("[draw]\ncount = 5\nmethod = \"random\"\n[draw.between]\n{keys}"));
        let design = |row| study.design(row).expect("a design");
        [0, 1, 2, 3, 4].map(|row| (design(row).star.tip_angle, design(row).load.pressure))
    };
    let [angle, pressure] = ["star.tip_angle = \"20 deg..40 deg\"\n", "load.pressure = \"20 kPa..40 kPa\"\n"];
    let both = of(&format!("{angle}{pressure}"));
    assert_eq!(both, of(&format!("{pressure}{angle}")));
    let alone = (of(angle), of(pressure));
    assert!((0..5).all(|row| both[row] == (alone.0[row].0, alone.1[row].1)));
    assert!(both.iter().all(|(angle, pressure)| pressure.is_some_and(|pressure| angle.0 != pressure.0)));
}

const MIXED: &str = "[draw]\ncount = 37\nseed = 3\n[draw.between]\nstar.tube_width = \"10 mm..60 mm\"\nstar.points = \"3..9\"\n\
                     [vary]\nseal.band = [\"1 mm\", \"3 mm\"]\nload.pressure = \"5 kPa..60 kPa/40\"\n";

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// However a study is split, into parts, batches and threads, its rows are the same bytes.
    #[test]
    fn any_split_gives_the_same_rows(parts in 1..30_usize, threads in 1..4_usize, from in 0..2960_usize, len in 0..1500_usize) {
        let study = study(MIXED);
        prop_assert_eq!(study.rows(), 37 * 2 * 40);
        let once = text(&study, 0..study.rows());
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        let joined: String = pool.install(|| (1..=parts).map(|k| text(&study, study.part(k, parts))).collect());
        prop_assert!(joined == once);
        let own = text(&study, from..(from + len).min(study.rows()));
        let expected: String = once.lines().skip(from).take(len).flat_map(|line| [line, "\n"]).collect();
        prop_assert_eq!(own, expected);
    }
}

#[test]
fn the_table_is_the_ring() {
    let table = RingTable::new().expect("solved");
    for r_star in [1e-3, 0.1, 1.0, 7.0] {
        let (fast, exact) = (&table, &Ring as &dyn HingeModel);
        let [a, b] = [fast.target(r_star), exact.target(r_star)].map(|state| state.expect("in range"));
        let [x, y] = [a, b].map(|state| state.edges.expect("a ring has edges"));
        let pairs = [
            (a.lambda, b.lambda),
            (a.volume.expect("known"), b.volume.expect("known")),
            (a.curvature, b.curvature),
            (x.tension, y.tension),
            (x.angle, y.angle),
            (x.width, y.width),
            (x.rim_force, y.rim_force),
        ];
        for (fast, exact) in pairs {
            close(fast, exact, 1e-8);
        }
        let [a, b] = [fast.onset(r_star), exact.onset(r_star)].map(|onset| onset.expect("in range"));
        close(a.expect("known"), b.expect("known"), 1e-8);
    }
}
