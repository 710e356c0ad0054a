//! Progress on standard error, for work of over a second and only on a terminal.

use std::io::IsTerminal;
use std::sync::Mutex;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};

/// A bar that appears when the work has taken a second.
pub struct Progress {
    start: Instant,
    bar: Mutex<Option<ProgressBar>>,
    terminal: bool,
}

impl Progress {
    /// Starts the clock.
    pub fn new() -> Self {
        Progress {
            start: Instant::now(),
            bar: Mutex::new(None),
            terminal: std::io::stderr().is_terminal(),
        }
    }

    /// Tells how many faces of how many are done.
    pub fn faces(&self, done: u32, count: u32) {
        self.units(done, count, "faces");
    }

    /// The same for things of another name.
    pub fn units(&self, done: u32, count: u32, name: &str) {
        if !self.terminal || self.start.elapsed() < Duration::from_secs(1) {
            return;
        }
        if let Ok(mut bar) = self.bar.lock() {
            let bar = bar.get_or_insert_with(|| {
                let style = ProgressStyle::with_template(&format!(
                    "{{bar:40}} {{human_pos}}/{{human_len}} {name} {{eta}}"
                ));
                ProgressBar::new(u64::from(count))
                    .with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
            });
            bar.set_position(u64::from(done));
        }
    }

    /// Removes the bar.
    pub fn finish(&self) {
        if let Ok(Some(bar)) = self.bar.lock().map(|bar| bar.clone()) {
            bar.finish_and_clear();
        }
    }
}
