//! How much a command says: the answer, all there is to say, nothing, or one JSON object.

/// Arguments of every command that reports.
#[derive(clap::Args, Clone, Copy, Debug, Default)]
pub(super) struct Voice {
    /// Say everything there is to say.
    #[arg(short, long)]
    pub(super) verbose: bool,
    /// Say nothing but what stands in the way.
    #[arg(short, long, conflicts_with = "verbose")]
    pub(super) quiet: bool,
    /// Print one JSON object and nothing else.
    #[arg(long, conflicts_with_all = ["verbose", "quiet"])]
    pub(super) json: bool,
}
