//! Every fenced block of commands is run, in one directory a page, and the blocks below it must show its results:
//!
//! - `sh`: run by a shell. `<!-- not run: why -->` above it prevents that; these are listed below, so that a new one is noticed.
//! - `text`, in the same section: the whole output of the commands. A line `...` stands for any number of lines, ` ...` at its end for
//!   the rest of a line. If it shows an error, the last command fails.
//! - `toml` that begins with `# name.toml`: the content of the file of that name.
//! - `csv` that begins with `# name.csv`: a file that the reader of the page fills in; it is written.
//!
//! Predictions with their ranges in prose must be among the output of the page's commands. The directory contains only designs/.

use std::fs;
use std::path::Path;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use crate::figures::unprinted;
use crate::output::{BlockOutput, matches};
use crate::page::{Block, Page, Piece, ends_in};
use crate::{home, renews};

/// The blocks that are not run: page, beginning of the first line.
const NOT_RUN: &[(&str, &str)] = &[
    ("README.md", "cargo install --locked --path .    # or `make install`"),
    ("README.md", "stargrip-cam predict designs/paper-gripper.toml --model shel"),
    ("docs/benchmarks.md", "valgrind --tool=callgrind target/release/stargrip-cam build"),
    ("docs/benchmarks.md", "cargo build --release --locked -p stargrip-cam --bin stargri"),
    ("docs/benchmarks.md", "cargo bench -p benches --bench build --no-run"),
    ("docs/benchmarks.md", "cargo bench -p benches --bench mechanics -- section"),
    ("docs/benchmarks.md", "/usr/bin/time -f \"%e s %M kB\" stargrip-cam actuator --tube-w"),
    ("docs/clock.md", "cargo test --release --locked --test machines clock:: -- --i"),
    ("docs/hosts.md", "tests/strangers/octoprint        # OctoPrint's analysis of t"),
    ("docs/install.md", "tar -xzf stargrip-cam-0.2.0-x86_64-unknown-linux-musl.tar.gz"),
    ("docs/install.md", "sudo apt install ./stargrip-cam_0.2.0-1_amd64.deb    # or _a"),
    ("docs/install.md", "pip install stargrip_cam-0.2.0-cp39-abi3-manylinux2014_x86_6"),
    ("docs/install.md", "cargo install --locked --path .    # the program alone, in ~"),
    ("docs/install.md", "cd ~/.local && rm -r bin/stargrip-cam share/stargrip-cam sha"),
    ("docs/models.md", "cargo run --release -p research --example section_table > /t"),
    ("docs/models.md", "cargo run --release -p research -- ladders ladders"),
    ("docs/models.md", "cargo run --release -p research -- residuals --lengths"),
    ("docs/models.md", "cargo run --release -p research -- stars stars --set all"),
    ("docs/models.md", "python3 crates/research/pull.py target/release/stargrip-cam"),
    ("docs/models.md", "stargrip-cam predict five.toml --model shell --vtu five.vtu"),
    ("docs/models.md", "cargo run --release -p stargrip-inflatable --example weave -"),
    ("docs/models.md", "cargo run --release -p research --example around"),
    ("docs/models.md", "stargrip-cam predict designs/paper-gripper.toml --model shel"),
    ("docs/models.md", "cargo run --release -p stargrip-inflatable --example folds"),
    ("docs/packaging.md", "make release          # target/dist: archives, Debian packag"),
    ("docs/paper.md", "cargo run --release -p research --example paper -- --svg doc"),
    ("docs/paper.md", "cargo run --release -p research --example paper -- --shells"),
    ("docs/paper.md", "cargo run --release -p stargrip-inflatable --example coil --"),
    ("docs/python.md", "pip install ./python"),
    ("docs/ranges.md", "python3 crates/research/poisson.py target/release/stargrip-c"),
    ("docs/ranges.md", "cargo run --release -p research --example ranges"),
    ("docs/stability.md", "cargo run --release -p research --example extremes"),
    ("docs/stability.md", "cargo run --release -p research --example shell_random -- 10"),
    ("docs/studies.md", "stargrip-cam study run study.toml -o study.csv"),
    ("docs/testing.md", "make test        # everything below but the strangers; rando"),
    ("docs/testing.md", "cargo run --release -p research --example optimum -- 200"),
    ("docs/testing.md", "cargo run --release -p research --example optimum -- 200 she"),
    ("docs/testing.md", "cargo test --test laws our_curves -- --nocapture"),
    ("docs/testing.md", "cargo install --locked cargo-mutants"),
    ("docs/trade.md", "stargrip-cam trade --svg docs/trade.svg"),
    ("docs/trade.md", "python3 crates/research/by_shell.py target/release/stargrip-"),
    ("docs/weave.md", "cargo run --release -p stargrip-inflatable --example weave -"),
    ("docs/web.md", "rustup target add wasm32-unknown-unknown"),
    ("docs/web.md", "export NODE_PATH=target/strangers-npm/node_modules"),
];

#[test]
fn commands_say_what_the_pages_say() {
    let pages = Page::read_all();
    let (next, faults) = (AtomicUsize::new(0), Mutex::new(Vec::new()));
    let threads = std::thread::available_parallelism().map_or(1, usize::from).min(4);
    std::thread::scope(|scope| {
        for _ in 0..threads {
            let _ = scope.spawn(|| {
                while let Some(page) = pages.get(next.fetch_add(1, Ordering::Relaxed)) {
                    let page_faults = run(page);
                    faults.lock().expect("no panic").extend(page_faults);
                }
            });
        }
    });
    let faults = faults.into_inner().expect("no panic");
    assert!(faults.is_empty(), "\n{}", faults.join("\n"));
}

#[test]
fn what_is_not_run_is_known() {
    let mut blocks = Vec::new();
    for page in Page::read_all() {
        for piece in page.pieces() {
            if let Piece::Block(Block { kind, body, not_run: Some(reason), .. }) = piece {
                assert!(kind == "sh" && reason.len() > 4, "{}: {reason}", page.name);
                let first = body.lines().next().unwrap_or_default();
                blocks
                    .push((page.name.clone(), first.chars().take(60).collect::<String>().trim().to_owned()));
            }
        }
    }
    let expected: Vec<(String, String)> =
        NOT_RUN.iter().map(|(page, line)| ((*page).to_owned(), (*line).to_owned())).collect();
    assert_eq!(blocks, expected);
}

/// Runs the commands of `page`; returns the differences from the page.
fn run(page: &Page) -> Vec<String> {
    let pieces = page.pieces();
    let dir = tempfile::tempdir().expect("a directory");
    for folder in ["designs", "designs/drawings", "designs/press"] {
        fs::create_dir(dir.path().join(folder)).expect("made");
        let files =
            fs::read_dir(home().join(folder)).expect("a directory").map(|file| file.expect("a file").path());
        for file in files.filter(|file| file.is_file()) {
            let name = file.file_name().expect("a name");
            let _ = fs::copy(&file, dir.path().join(folder).join(name)).expect("copied");
        }
    }
    let mut faults = Vec::new();
    // The output of the block above, if it was run.
    let mut output: Option<BlockOutput> = None;
    let mut printed = String::new();
    for piece in &pieces {
        let Piece::Block(block) = piece else {
            if matches!(piece, Piece::Heading(_)) {
                faults.extend(output.take().and_then(|output| output.unexpected(page)));
            }
            continue;
        };
        let place = format!("{}:{}", page.name, block.line);
        match block.kind.as_str() {
            "sh" => {
                faults.extend(output.take().and_then(|output| output.unexpected(page)));
                if block.not_run.is_none() {
                    output = Some(BlockOutput::run_block(block, dir.path()))
                        .inspect(|output| printed += &output.text);
                }
            }
            "text" => {
                if let Some(output) = output.take() {
                    let is_fault = block.body.lines().any(|line| line.starts_with("error"));
                    if is_fault == output.is_done || !matches(&block.body, &output.text) {
                        faults.push(format!(
                            "{place}: the page says\n{}and the commands\n{}",
                            block.body, output.text
                        ));
                    }
                }
            }
            "toml" | "csv" => {
                let first = block.body.lines().next().and_then(|line| line.strip_prefix("# "));
                let Some(name) = first.filter(|name| name.ends_with(&format!(".{}", block.kind))) else {
                    continue;
                };
                let path = dir.path().join(name);
                let rest = block.body.split_once('\n').map_or("", |(_, rest)| rest);
                if block.kind == "csv" {
                    fs::create_dir_all(path.parent().expect("a directory")).expect("made");
                    fs::write(&path, rest).expect("written");
                } else if !fs::read_to_string(&path).is_ok_and(|file| file.contains(rest)) {
                    let file = fs::read_to_string(&path).unwrap_or_default();
                    faults.push(format!("{place}: the page says\n{rest}and {name}\n{file}"));
                }
            }
            _ => {}
        }
    }
    faults.extend(output.and_then(|output| output.unexpected(page)));
    let missing = unprinted(&page.text, &printed).into_iter();
    faults.extend(missing.map(|one| format!("{}: no command prints {one}", page.name)));
    for piece in &pieces {
        if let Piece::Picture { file, from: source, .. } = piece {
            faults.extend(compare(page, file, source.as_deref(), dir.path()));
        }
    }
    faults
}

/// The difference of the picture `file` of `page` from the file `source` in `dir`.
fn compare(page: &Page, file: &str, source: Option<&str>, dir: &Path) -> Option<String> {
    // Pictures of commands that are not run (`tests/pages/trade.rs` and `main.rs`), and of a browser (`tests/strangers/web_pictures.mjs`).
    let is_command_run = !["trade.svg", "trade-shells.svg"].contains(&file) && page.name != "docs/paper.md";
    if !is_command_run || ends_in(file, "webp") {
        return None;
    }
    let Some(source_name) = source else { return Some(format!("{}: which file is {file}?", page.name)) };
    let folder = home().join(&page.name);
    let path = folder.parent().expect("a directory").join(file);
    let Ok(command_file) = fs::read(dir.join(source_name)) else {
        return Some(format!("{}: no command writes {source_name}", page.name));
    };
    if renews() {
        fs::write(&path, &command_file).expect("written");
    }
    let is_same = fs::read(&path).is_ok_and(|picture| picture == command_file);
    (!is_same).then(|| format!("{}: {file} is another picture than {source_name}", page.name))
}

#[test]
fn a_page_that_says_otherwise_is_found() {
    let page = |text: &str| Page { name: "docs/trial.md".to_owned(), text: text.to_owned() };
    let number = |text: &str| run(&page(text)).len();
    let sound = "```sh\nstargrip-cam explain no-arm\n```\n\n```text\nno-arm ...\n...\n```\n";
    assert_eq!(number(sound), 0);
    assert_eq!(number(&sound.replace("```text\nno-arm", "```text\nno-leg")), 1);
    assert_eq!(number(&sound.replace("explain no-arm", "explain no-leg")), 1);
    assert_eq!(number("```sh\nstargrip-cam check none.toml\n```\n\nWords.\n"), 1);
    assert_eq!(number("![words for a picture](none.svg)\n"), 1);
    assert_eq!(
        number("```sh\nstargrip-cam new a > /dev/null\n```\n\n```toml\n# a.toml\npoints = 6\n```\n"),
        1
    );
}
