//! [`Run`]: a training with its validations, checkpoints and curves.

use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};

use voltour_solver::policy::Problem;
use voltour_trainer::Result;
use voltour_trainer::checkpoint::{self, Checkpoint};
use voltour_trainer::dqn::{Progress, Score, Training, Trial, validate};
use voltour_trainer::network::Weights;
use voltour_trainer::report::{self, Point};
use voltour_trainer::stopwatch::Stopwatch;

use super::bar::Bar;

/// A training on its way, and what is known of it.
pub struct Run<'a> {
    training: Training<'a>,
    trials: Vec<Trial<'a>>,
    problem: Problem,
    out: PathBuf,
    curve: Vec<Point>,
    best: Weights,
    command: String,
    seconds_before: f64,
    watch: Stopwatch,
    losses: Mean,
    totals: Mean,
}

/// A mean in the making.
#[derive(Default)]
struct Mean {
    sum: f64,
    count: u64,
}

impl Mean {
    fn add(&mut self, value: Option<f64>) {
        if let Some(value) = value {
            self.sum += value;
            self.count += 1;
        }
    }

    fn take(&mut self) -> f64 {
        let mean = self.sum / self.count.max(1) as f64;
        *self = Self::default();
        mean
    }
}

impl<'a> Run<'a> {
    /// A run that begins, or goes on from a checkpoint.
    pub fn new(
        training: Training<'a>,
        trials: Vec<Trial<'a>>,
        problem: Problem,
        out: PathBuf,
        from: Option<Checkpoint>,
    ) -> Self {
        let fresh = training.learner.average.weights().clone();
        // One that goes on keeps the command that it began with: that is the one with the options.
        let (curve, seconds_before, best, command) = from.map_or_else(
            || (Vec::new(), 0.0, fresh, command(std::env::args().skip(1))),
            |c| (c.run.curve, c.run.seconds, c.best, c.run.command),
        );
        let (losses, totals) = (Mean::default(), Mean::default());
        let watch = Stopwatch::start();
        Self {
            training,
            trials,
            problem,
            out,
            curve,
            best,
            command,
            seconds_before,
            watch,
            losses,
            totals,
        }
    }

    /// Trains to the end, or until interrupted; what is reached is saved either way.
    pub fn go(mut self, validate_every: u64, interrupted: &AtomicBool) -> Result<()> {
        let done = self.training.learner.adam.steps;
        let mut bar = Bar::new(self.training.options.steps, done);
        let mut next = done + validate_every;
        let mut progress = Progress { step: done, ..Progress::default() };
        while !self.training.is_over() && !interrupted.load(Ordering::Relaxed) {
            progress = self.training.advance()?;
            self.losses.add(progress.loss);
            self.totals.add(progress.total);
            bar.show(&progress);
            if progress.step >= next {
                bar.score(progress.step, self.measure(&progress)?);
                next = progress.step + validate_every;
            }
        }
        if self.curve.last().is_none_or(|point| point.step < progress.step) {
            bar.score(progress.step, self.measure(&progress)?);
        }
        bar.end();
        if !self.training.is_over() {
            eprintln!("interrupted at step {}; go on with --resume", progress.step);
        }
        println!("{}", self.out.join("model.onnx").display());
        Ok(())
    }

    /// Validates, and saves what there is.
    fn measure(&mut self, progress: &Progress) -> Result<Score> {
        let learner = &self.training.learner;
        let score = validate(&learner.average, &self.trials);
        let point = Point {
            step: progress.step,
            seconds: self.seconds_before + self.watch.seconds(),
            loss: self.losses.take(),
            epsilon: progress.epsilon,
            total: self.totals.take(),
            gap: score.gap,
            feasible: score.feasible,
        };
        if self.curve.iter().all(|p| point.cost() < p.cost()) {
            self.best = learner.average.weights().clone();
        }
        self.curve.push(point);
        let checkpoint = Checkpoint {
            run: checkpoint::Run {
                problem: self.problem.name().to_owned(),
                command: self.command.clone(),
                options: self.training.options.clone(),
                steps: progress.step,
                rounds: self.training.rounds(),
                seconds: point.seconds,
                curve: self.curve.clone(),
            },
            weights: learner.network.weights().clone(),
            average: learner.average.weights().clone(),
            target: learner.target.weights().clone(),
            best: self.best.clone(),
            adam: learner.adam.clone(),
        };
        checkpoint.save(&self.out.join("checkpoint.safetensors"))?;
        checkpoint.model(false).save(&self.out.join("model.onnx"))?;
        report::save(&self.out, self.problem.name(), &self.curve)?;
        Ok(score)
    }
}

/// What the command line asked for, but not where its output went, which says nothing of the model.
fn command(mut arguments: impl Iterator<Item = String>) -> String {
    let mut command = "voltour-train".to_owned();
    while let Some(argument) = arguments.next() {
        match argument.as_str() {
            "--out" => drop(arguments.next()),
            given if given.starts_with("--out=") => {}
            given => {
                command.push(' ');
                command.push_str(given);
            }
        }
    }
    command
}

#[cfg(test)]
mod tests {
    use super::command;

    #[test]
    fn a_model_does_not_say_where_it_was_made() {
        let given = ["train", "reward", "--out", "/home/me/runs", "--seed", "3", "--out=/there"];
        let command = command(given.into_iter().map(str::to_owned));
        assert_eq!(command, "voltour-train train reward --seed 3");
    }
}
