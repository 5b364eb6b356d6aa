//! Workers that are killed at random moments, and started again. docs/reliability.md has the figures.

use std::fs;
use std::path::Path;
use std::process::Stdio;
use std::time::{Duration, Instant};

use super::{command, done, folder, names};

/// Enough rows that a part takes longer than the start of a process.
const STUDY: &str = "schema = 1\nspec = \"spec.toml\"\n[vary]\nstar.points = [3, 4, 5, 6]\n\
                     star.tube_width = \"10 mm..40 mm/40\"\nstar.tip_angle = \"15 deg..60 deg/40\"\n";

/// Two workers, four parts each.
const WORKERS: [&str; 2] = ["1..4/8", "5..8/8"];

fn work(at: &Path, part: &str) -> std::process::Child {
    let args = ["sweep", "study.toml", "--part", part, "-o", "parts", "--threads", "1"];
    command(at, &args).stdout(Stdio::null()).stderr(Stdio::null()).spawn().expect("it starts")
}

/// `KILLS=100 cargo test --release --test cli workers_that_are_killed -- --nocapture` is the figure of docs/reliability.md.
#[test]
fn workers_that_are_killed_go_on_where_they_stopped() {
    let wanted: u32 = std::env::var("KILLS").ok().and_then(|text| text.parse().ok()).unwrap_or(8);
    let dir = folder(STUDY);
    let at = dir.path();
    let began = Instant::now();
    let whole = done(at, &["sweep", "study.toml", "--threads", "2"]);
    let took = began.elapsed();
    let mut state = 0x2545_f491_4f6c_dd1d_u64;
    let mut random = |below: Duration| {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        #[expect(clippy::cast_precision_loss, reason = "53 bits are exact")]
        let part = (state >> 11) as f64 / (1_u64 << 53) as f64;
        below.mul_f64(part)
    };
    let (mut kills, mut studies, mut leftovers) = (0, 0, 0);
    while kills < wanted || studies == 0 {
        let mut workers = WORKERS.map(|part| work(at, part));
        for worker in &mut workers {
            // The kills happen within half the time of the whole, so that a study is killed a few times.
            if kills < wanted {
                std::thread::sleep(random(took / 2));
                if worker.try_wait().expect("a child").is_none() {
                    worker.kill().expect("killed");
                    kills += 1;
                }
            }
        }
        let ended: Vec<_> = workers.iter_mut().map(|worker| worker.wait().expect("a child")).collect();
        leftovers += names(&at.join("parts")).iter().filter(|name| name.ends_with(".partial")).count();
        if ended.iter().all(std::process::ExitStatus::success) {
            let _ = done(at, &["study", "join", "parts", "-o", "joined.csv"]);
            assert!(
                fs::read_to_string(at.join("joined.csv")).expect("joined") == whole,
                "after {kills} kills"
            );
            assert_eq!(names(&at.join("parts")).len(), 16, "parts, their jobs, and nothing else");
            fs::remove_dir_all(at.join("parts")).expect("removed");
            studies += 1;
        }
    }
    println!(
        "{kills} kills in {studies} studies, {leftovers} left something behind: every joined file was that of an undisturbed run"
    );
}
