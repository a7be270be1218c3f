//! [`Episode`]: the loop that all problems share.

use super::{Action, Definition, State};
use crate::instance::Instance;

/// What a failed episode costs, and what each cover that it still lacks adds, in units of the objective. The
/// second is about what a stop takes on the way, so that failing early is never cheaper than going on.
const FAILURE: f64 = 3.0;
const PER_MISSING_COVER: f64 = 0.5;

/// An episode: from the empty tour, action by action, to where the stop function ends it.
#[derive(Clone)]
pub struct Episode<'a> {
    definition: &'a dyn Definition,
    state: State<'a>,
    actions: Vec<Action>,
    /// By demand, members that are legal actions.
    available: Vec<u32>,
    over: bool,
    earned: f64,
}

impl<'a> Episode<'a> {
    /// An episode at its beginning.
    pub fn new(instance: &'a Instance<'a>, definition: &'a dyn Definition) -> Self {
        let mut episode = Self {
            definition,
            state: State::new(instance),
            actions: Vec::new(),
            available: Vec::new(),
            over: false,
            earned: 0.0,
        };
        episode.look();
        episode
    }

    /// The problem that it is an episode of.
    pub fn definition(&self) -> &'a dyn Definition {
        self.definition
    }

    /// Where it stands.
    pub fn state(&self) -> &State<'a> {
        &self.state
    }

    /// The legal actions, candidates rising; none when it is over.
    pub fn actions(&self) -> &[Action] {
        &self.actions
    }

    /// By demand, how many of its members are legal actions.
    pub fn available(&self) -> &[u32] {
        &self.available
    }

    /// Whether the stop function has ended it.
    pub fn is_over(&self) -> bool {
        self.over
    }

    /// Whether it is over with every demand met.
    pub fn succeeded(&self) -> bool {
        self.over && self.state.open_demands() == 0
    }

    /// Sum of the rewards so far.
    pub fn earned(&self) -> f64 {
        self.earned
    }

    /// The stops in order.
    pub fn order(&self) -> &[u32] {
        self.state.tour().order()
    }

    /// The transition: takes the action of this index and gives its reward, with what it costs if
    /// the episode has failed by it. An index that is no action changes nothing and earns nothing.
    pub fn act(&mut self, index: usize) -> f64 {
        let Some(&action) = self.actions.get(index) else { return 0.0 };
        self.state.insert(action.candidate, action.insertion.position);
        self.look();
        let failed = self.over && self.state.open_demands() > 0;
        let penalty = if failed {
            FAILURE + PER_MISSING_COVER * f64::from(self.state.missing())
        } else {
            0.0
        };
        let reward = action.reward - penalty;
        self.earned += reward;
        reward
    }

    /// Looks for the legal actions and whether the episode goes on.
    fn look(&mut self) {
        self.actions.clear();
        let (state, insert) = (&self.state, self.definition.insertion());
        if !self.definition.stops(state) {
            for &candidate in state.useful() {
                if state.tour().serves(candidate) || !state.helps(candidate) {
                    continue;
                }
                if let Some(mut action) = state.place(candidate, insert) {
                    action.reward = self.definition.reward(state, candidate, &action);
                    self.actions.push(action);
                }
            }
        }
        let instance = state.instance();
        self.available.clear();
        self.available.resize(instance.demands.demands.len(), 0);
        for action in &self.actions {
            for &d in &instance.demands.of[action.candidate as usize] {
                self.available[d as usize] += 1;
            }
        }
        // Where leaving a stop out never breaks a limit, a legal place that is lost never comes back.
        let lacks_more = |(d, &available): (usize, &u32)| state.lacks(d) > available;
        let dead = instance.metric && self.available.iter().enumerate().any(lacks_more);
        self.over = self.actions.is_empty() || dead;
        if self.over {
            self.actions.clear();
        }
    }
}
