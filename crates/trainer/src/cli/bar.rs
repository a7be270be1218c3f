//! The progress bar of a training.

use indicatif::{ProgressBar, ProgressStyle};

use voltour_trainer::dqn::{Progress, Score};

const TEMPLATE: &str = "{bar:24} {human_pos}/{human_len} {elapsed}<{eta}  {msg}";

/// Steps done, with loss, epsilon and the last score.
pub struct Bar {
    bar: ProgressBar,
    score: Option<Score>,
    loss: f64,
}

impl Bar {
    /// A bar of so many steps, some of which are done.
    pub fn new(steps: u64, done: u64) -> Self {
        let bar = ProgressBar::new(steps).with_position(done);
        if let Ok(style) = ProgressStyle::with_template(TEMPLATE) {
            bar.set_style(style);
        }
        Self { bar, score: None, loss: f64::NAN }
    }

    /// Shows how it goes.
    pub fn show(&mut self, progress: &Progress) {
        self.bar.set_position(progress.step);
        self.loss = progress.loss.unwrap_or(self.loss);
        let score = self.score.map_or_else(String::new, |s| {
            format!("  gap {:.2} %  tours {:.1} %", 100.0 * s.gap, 100.0 * s.feasible)
        });
        self.bar
            .set_message(format!("loss {:.4}  epsilon {:.2}{score}", self.loss, progress.epsilon));
    }

    /// Shows a score from now on; where there is no terminal, as a line.
    pub fn score(&mut self, step: u64, score: Score) {
        self.score = Some(score);
        if self.bar.is_hidden() {
            let (gap, feasible) = (100.0 * score.gap, 100.0 * score.feasible);
            eprintln!("step {step}  loss {:.4}  gap {gap:.2} %  tours {feasible:.1} %", self.loss);
        }
    }

    /// Leaves the bar as it stands.
    pub fn end(&self) {
        self.bar.abandon();
    }
}
