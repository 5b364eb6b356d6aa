//! The plan: the steps of the machine, independent of any controller's language.
//!
//! A [`Program`] is a list of [`Step`]s in the sheet's frame. The preview and the G-code are both made
//! from it, so they cannot disagree about order, direction, starts and overlaps. The plan decides all of
//! that, and also how long a single move is; the emitters only round and write.

mod bends;
mod blade;
mod chop;
mod cut;
mod feed_correction;
mod feedcheck;
mod job_size;
mod keep_out;
mod laser;
mod lowest_feed;
mod marks;
mod moves;
mod pace;
mod pressed;
mod process_refusal;
mod process_time;
mod program;
mod ramps;
mod reach;
mod refusals;
mod seal;
mod stepper;
mod time;
mod trace;
mod travel;
mod version;
mod whole_rates;
mod written;

pub use bends::FastTool;
pub use chop::{Chop, move_time, stepper};
pub use cut::{cut_programs, cut_refusals};
pub use feed_correction::{FeedCorrection, STOPWATCH, feed_correction};
pub use feedcheck::{CHECK_LENGTH, feed_check_refusals, feed_check_seconds, feed_checks};
pub use job_size::too_many_moves;
pub use keep_out::clamp_bounds;
pub use laser::{LASER_SAFETY, laser_settings, no_laser};
pub use lowest_feed::{actual_speed, lowest_speed};
pub use marks::no_marks;
pub use moves::{LONGEST_MOVE, moves};
pub use pace::{Pace, Pacer, Stroke};
pub use pressed::pressed_beyond;
pub use process_time::{ProcessTime, process_times};
pub use program::{
    Height, PacedProcess, PauseReason, Program, Purpose, Ramp, SeamList, SeamReport, Step, distinct_processes,
};
pub use reach::refusal_beyond;
pub use refusals::{homing_by_hand, refusals};
pub use seal::{seal_program, seal_programs};
pub use stepper::Stepper;
pub use time::{Clock, Scope, height_of};
pub use trace::trace_programs;
pub use travel::TravelLimits;
pub use version::{MEAN_TOLERANCE, OtherVersion, other_version};
pub use written::{Precision, is_straight};
