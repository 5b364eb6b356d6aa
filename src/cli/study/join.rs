//! Parts to one file, whose bytes are those of a run that was never cut.

use std::collections::BTreeMap;
use std::fs;
use std::fs::File;
use std::io;
use std::io::{BufRead, BufReader, BufWriter, Write};
use std::path::{Path, PathBuf};

use crate::cli::failure::{Failure, tell};
use crate::cli::harmless::shown;
use crate::cli::study::part::{Ticket, is_sound, name, ticket};
use crate::cli::study::rows::Form;
use crate::cli::voice::Voice;
use crate::cli::whole_file::{WholeFile, sweep_leftovers};

/// A part with its ticket.
type Part = (PathBuf, Ticket);

/// Joins the parts in `dir` to the file `output`.
pub(super) fn run(dir: &Path, output: &Path, voice: Voice) -> Result<(), Failure> {
    let entries = fs::read_dir(dir).map_err(|error| Failure::file("read", dir, &error))?;
    let mut files: Vec<PathBuf> =
        entries.flatten().map(|entry| entry.path()).filter(|path| is_part(path)).collect();
    files.sort();
    let (parts, form) = whole(dir, &files)?;
    for (path, ticket) in &parts {
        let sound = is_sound(path, ticket).map_err(|error| Failure::file("read", path, &error))?;
        if !sound {
            let text = format!(
                "{} is damaged: it is not what was written; delete it, and compute it again",
                shown(path)
            );
            return Err(Failure::Message(text));
        }
    }
    let form = form.built_in()?;
    let into = output.parent().filter(|dir| !dir.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let own = output.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    sweep_leftovers(into, |name| name == own);
    let joined = || -> io::Result<()> {
        let out = BufWriter::new(WholeFile::begin(output)?);
        let out = match form {
            Form::Csv => csv(&parts, out)?,
            Form::Parquet => parquet(&parts, out)?,
        };
        out.into_inner().map_err(io::IntoInnerError::into_error)?.publish()
    };
    joined().map_err(|error| Failure::file("write", output, &error))?;
    let rows = parts.last().map_or(0, |(_, ticket)| ticket.rows[1]);
    if voice.is_heard() {
        tell(&format!("{} parts joined, {rows} rows", parts.len()));
    }
    Ok(())
}

fn is_part(path: &Path) -> bool {
    let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    name.starts_with("part-")
        && [Form::Csv, Form::Parquet].iter().any(|form| name.ends_with(&format!(".{}", form.ending())))
}

/// All parts of one study in order, or what is missing or foreign.
fn whole(dir: &Path, files: &[PathBuf]) -> Result<(Vec<Part>, Form), Failure> {
    let mut faults = Vec::new();
    let mut found: BTreeMap<usize, Part> = BTreeMap::new();
    let tickets: Vec<(&PathBuf, Option<Ticket>)> = files.iter().map(|path| (path, ticket(path))).collect();
    let first = tickets.iter().find_map(|(path, ticket)| ticket.as_ref().map(|ticket| (*path, ticket)));
    let Some((path, first)) = first else {
        let text = format!("{} holds no parts; `sweep STUDY --part k/N -o DIR` writes them", shown(dir));
        return Err(Failure::Message(text));
    };
    let form = Form::of(path);
    let alike = |ticket: &Ticket| {
        (&ticket.study, ticket.parts, ticket.units) == (&first.study, first.parts, first.units)
    };
    for (path, ticket) in tickets.iter().cloned() {
        let own = ticket.filter(|ticket| alike(ticket) && is_named(path, ticket, form));
        match own {
            Some(ticket) => {
                let _ = found.insert(ticket.part, (path.clone(), ticket));
            }
            None => faults
                .push(format!("{} is foreign: it is not a file with a ticket of this study", shown(path))),
        }
    }
    let missing: Vec<usize> = (1..=first.parts).filter(|part| !found.contains_key(part)).collect();
    if !missing.is_empty() {
        let list = missing.iter().take(20).map(ToString::to_string).collect::<Vec<_>>().join(", ");
        let more = if missing.len() > 20 { ", ..." } else { "" };
        faults.push(format!(
            "{} of {} parts are missing: {list}{more}; compute them with --part k/{}",
            missing.len(),
            first.parts,
            first.parts
        ));
    }
    if faults.is_empty() {
        Ok((found.into_values().collect(), form))
    } else {
        Err(Failure::Message(faults.join("\n")))
    }
}

/// Whether the file has the name and the form of its part.
fn is_named(path: &Path, ticket: &Ticket, form: Form) -> bool {
    path.file_name().is_some_and(|own| *own == *name(ticket.part, ticket.parts, form.ending()))
}

/// The header of the first, and all rows.
fn csv<W: Write>(parts: &[Part], mut out: W) -> io::Result<W> {
    for (i, (path, ticket)) in parts.iter().enumerate() {
        let mut file = BufReader::with_capacity(1 << 16, File::open(path)?);
        let mut header = Vec::new();
        for _ in 0..=usize::from(ticket.units) {
            let _ = file.read_until(b'\n', &mut header)?;
        }
        if i == 0 {
            out.write_all(&header)?;
        }
        let _ = io::copy(&mut file, &mut out)?;
    }
    Ok(out)
}

#[cfg(feature = "parquet")]
fn parquet<W: Write + Send>(parts: &[Part], out: W) -> io::Result<W> {
    use crate::forecast::study::parquet::{Reader, Writer};
    let open = |path: &Path| Reader::new(File::open(path)?);
    let (first, _) = parts.first().ok_or(io::ErrorKind::NotFound)?;
    let mut writer = Writer::like(out, &open(first)?)?;
    for (path, _) in parts {
        for batch in open(path)?.batches() {
            writer.write(batch?)?;
        }
    }
    writer.finish()
}

#[cfg(not(feature = "parquet"))]
fn parquet<W: Write>(_: &[Part], _: W) -> io::Result<W> {
    Err(io::ErrorKind::Unsupported.into())
}
