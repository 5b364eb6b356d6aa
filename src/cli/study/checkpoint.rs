//! Finished rows of a slow study, stored in a file beside the output until that is complete. After a kill only the unfinished rows are
//! computed again.
//!
//! Its first line identifies the study. Every other line is a row: the hash of the rest, a space, and the row's cells as JSON. An
//! incomplete line of a killed process is cut off.

use std::collections::BTreeMap;
use std::fs::{File, TryLockError};
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use crate::cli::escape::shown;
use crate::cli::whole_file::refuse_special;
use forecast::study::{RowBatch, Study, checkpoint};
use spec::digest::sha256;

/// The stored rows, and their file, which is locked against other processes.
pub(super) struct Checkpoint {
    file: File,
    pub(super) rows: BTreeMap<usize, RowBatch>,
}

/// The file with the stored rows of `path`: "study.rows" for "study.csv".
pub(super) fn beside(path: &Path) -> PathBuf {
    path.with_extension("rows")
}

impl Checkpoint {
    /// Opens the file `path`, or begins it.
    ///
    /// # Errors
    /// If it cannot be read or written, is not of this study, or another process writes it.
    pub(super) fn open(path: &Path, study: &Study) -> io::Result<Self> {
        refuse_special(path)?;
        let mut file = File::options().read(true).write(true).create(true).truncate(false).open(path)?;
        if let Err(TryLockError::WouldBlock) = file.try_lock() {
            return Err(io::Error::other(format!(
                "another process is computing the rows of {}",
                shown(path)
            )));
        }
        let head = format!("rows of study {}\n", study.fingerprint());
        let mut bytes = Vec::new();
        let _ = file.read_to_end(&mut bytes)?;
        let mut rows = BTreeMap::new();
        let mut whole = 0;
        if bytes.starts_with(head.as_bytes()) {
            whole = head.len();
            for line in bytes[whole..].split_inclusive(|byte| *byte == b'\n') {
                let Some(batch) = row(line, study) else { break };
                whole += line.len();
                let _ = rows.insert(batch.rows.start, batch);
            }
        } else if !head.as_bytes().starts_with(&bytes) {
            let text =
                format!("{} does not belong to this study: delete it, or choose another place", shown(path));
            return Err(io::Error::other(text));
        }
        file.set_len(u64::try_from(whole).unwrap_or(0))?;
        let _ = file.seek(SeekFrom::End(0))?;
        if whole == 0 {
            file.write_all(head.as_bytes())?;
        }
        Ok(Self { file, rows })
    }

    /// Stores a batch of one row on disk.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub(super) fn keep(&mut self, batch: RowBatch) -> io::Result<()> {
        let cells = serde_json::to_string(&checkpoint::cells(&batch))?;
        self.file.write_all(format!("{} {cells}\n", sha256(&cells)).as_bytes())?;
        self.file.sync_data()?;
        let _ = self.rows.insert(batch.rows.start, batch);
        Ok(())
    }
}

/// The row in a line; `None` if the line is damaged.
fn row(line: &[u8], study: &Study) -> Option<RowBatch> {
    let line = std::str::from_utf8(line).ok()?.strip_suffix('\n')?;
    let (hash, cells) = line.split_once(' ')?;
    if sha256(cells) != hash {
        return None;
    }
    checkpoint::batch(study.columns(), serde_json::from_str(cells).ok()?)
}
