//! Jobs that are not resumed: comments and moves that contradict each other, lines of other origin.

use crate::recounted;
use crate::resume::job;
use stargrip_cam::resume::{ResumeAt, ResumeFault, resume};

/// The job with every occurrence of a text replaced.
fn lied(name: &str, from: &str, to: &str) -> String {
    let job = job(name);
    assert!(job.contains(from), "{name}: {from}");
    job.replace(from, to)
}

#[test]
fn what_a_comment_says_is_not_believed() {
    for name in ["generic", "klipper", "reprapfirmware", "grbl"] {
        for (from, to) in [
            ("speed_mm_s=0.1", "speed_mm_s=10"),
            ("contact_mm=-0.3", "contact_mm=1"),
            ("travel_mm=5", "travel_mm=7"),
            ("park_mm=30", "park_mm=20"),
        ] {
            let fault = resume(&lied(name, from, to), ResumeAt::Share(0.4), None);
            assert!(
                matches!(&fault, Err(ResumeFault::Disagrees(f)) if f.line.is_some()),
                "{name} {to}: {fault:?}"
            );
        }
        let hot = resume(&lied(name, "temperature_C=200", "temperature_C=450"), ResumeAt::Share(0.4), None);
        assert!(matches!(hot, Err(ResumeFault::TooHot(t)) if t.0 == 450.0), "{name}: {hot:?}");
        let other = resume(
            &lied(name, "seal: temperature_C=200", "seal: temperature_C=180"),
            ResumeAt::Share(0.4),
            None,
        );
        assert!(matches!(&other, Err(ResumeFault::Disagrees(f)) if f.line.is_some()), "{name}: {other:?}");
    }
}

#[test]
fn lengths_and_times_that_the_moves_contradict_are_refused() {
    let refused = |job: &str, words: &str| match resume(job, ResumeAt::Share(0.5), None) {
        Err(ResumeFault::Disagrees(finding)) => {
            assert_eq!(finding.code, "other-comment", "{finding}");
            assert!(finding.found.contains(words) && finding.line.is_some(), "{finding}");
        }
        other => panic!("{words}: {other:?}"),
    };
    for name in ["generic", "klipper", "grbl", "marlin"] {
        let job = job(name);
        let rest = resume(&job, ResumeAt::Share(0.4), None).expect("resumed").text;
        for text in [&job, &rest] {
            for (key, value, to) in [
                ("total", "length_mm", "1.000"),
                ("total", "time_s", "10"),
                ("length", "length_mm", "1.000"),
                ("length", "time_s", "10"),
                ("seam", "time_s", "9000"),
                ("job", "time_s", "90000"),
                ("job", "time_s", "9000"),
                ("total", "time_s", "30000"),
            ] {
                if key == "job" && text == &job {
                    continue;
                }
                let line = text.lines().find(|line| line.starts_with(&format!("; {key}: "))).expect(key);
                let old = line.split(' ').find(|word| word.starts_with(&format!("{value}="))).expect(value);
                let lie = line.replace(old, &format!("{value}={to}"));
                let words =
                    if key == "total" && to == "30000" && text == &rest { "job: " } else { &lie[2..] };
                refused(&text.replace(line, &lie), words);
            }
        }
    }
    // One corner 8 mm beside the seam.
    let job = job("generic");
    let line =
        job.lines().filter(|line| line.starts_with("G1 X") && !line.contains('Z')).nth(60).expect("a move");
    let x: f64 = line[4..].split(' ').next().and_then(|x| x.parse().ok()).expect("X");
    let moved = line.replacen(&line[..4 + x.to_string().len()], &format!("G1 X{}", x + 8.0), 1);
    refused(&job.replacen(line, &moved, 1), "seam=");
}

/// A job with a line inserted before the first one that begins with `before`, and the correct number of lines in its last line.
fn with_line(name: &str, before: &str, line: &str) -> (String, usize) {
    let job = job(name);
    let mut lines: Vec<&str> = job.lines().collect();
    let at = lines.iter().position(|text| text.starts_with(before)).expect(before);
    lines.insert(at, line);
    (recounted(&lines), at + 1)
}

#[test]
fn a_job_that_plunges_or_changes_settings_is_not_resumed() {
    for (name, before, line, code) in [
        ("generic", "G0 Z30", "G0 Z-50 F1200", "blind-move"),
        ("linuxcnc", "G0 Z30", "G0 Z-50", "blind-move"),
        ("klipper", "G0 Z30", "G0 Z-50 F1200", "blind-move"),
        ("reprapfirmware", "G0 Z30", "M203 I600", "profile-line"),
        ("marlin", "G0 Z30", "M205 T500", "profile-line"),
        ("klipper", "G0 Z30", "SET_IDLE_TIMEOUT TIMEOUT=1", "profile-line"),
        ("klipper", "G0 Z30", "SET_VELOCITY_LIMIT VELOCITY=0.05", "profile-line"),
        ("reprapfirmware", "G1 ", "M203 I600", "profile-line"),
        ("klipper", "G1 ", "SET_IDLE_TIMEOUT TIMEOUT=1", "profile-line"),
        ("marlin", "G1 ", "M205 T500", "profile-line"),
        ("marlin", "M84", "M104 S200", "stray-heat"),
    ] {
        let (job, at) = with_line(name, before, line);
        match resume(&job, ResumeAt::Share(0.4), None) {
            Err(ResumeFault::Disagrees(finding)) => {
                assert_eq!((finding.code, finding.line), (code, Some(at)), "{name} {line}");
            }
            other => panic!("{name} {line}: {other:?}"),
        }
    }
}
