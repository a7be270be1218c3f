//! Deep Q-learning as in the paper's Algorithm 1, with what was measured to help.
//!
//! ```text
//! initialise the replay memory                                    Replay
//! for each step of some episodes in parallel:                     Actors
//!     choose an action by epsilon-greedy, insert it, be rewarded
//!     store what was seen, with its return, when the episode ends Trajectory
//!     for each update:
//!         sample a batch from the memory                          Replay
//!         step the parameters towards the targets y               Learner
//! ```
//!
//! Deviations from the published algorithm:
//!
//! 1. The targets are the returns of whole episodes (Monte-Carlo) unless `n-step` is asked for; then the
//!    bootstrapped part is a double DQN's, with a target network.
//! 2. Huber's loss instead of the square, with the gradient clipped.
//! 3. Beside single transitions, roll-outs: for some states the greedy completion of several actions,
//!    with a loss on their differences as well.
//! 4. Demonstrations of the exact solver may be mixed in.
//! 5. No symmetry augmentation: the features do not change when the plane is moved or turned or the
//!    candidates change their order, so a turned copy of a state is the same input.

mod actors;
mod adam;
mod demonstrations;
mod greedy;
mod learner;
mod options;
mod pool;
mod random;
mod replay;
mod rollouts;
mod sample;
mod schedule;
mod training;
mod trajectory;
mod validation;

pub use adam::{Adam, clip};
pub use demonstrations::demonstrations;
pub use greedy::{best, complete};
pub use learner::{Device, Learner};
pub use options::{Options, Targets};
pub use pool::{Play, Pool};
pub use random::{index, stream, unit};
pub use replay::Replay;
pub use sample::Sample;
pub use schedule::{epsilon, learning_rate};
pub use training::{Progress, Training};
pub use trajectory::Trajectory;
pub use validation::{Score, Trial, trials, validate};
