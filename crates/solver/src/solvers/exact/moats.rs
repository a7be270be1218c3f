//! How much a tour must travel or leave unserved: moats that grow round the candidates.
//!
//! Goemans and Williamson (1995), as far as the dual solution goes. A tour that serves anyone inside a set
//! without the root crosses its border at least twice, so it travels twice the width of the moat round
//! the set; otherwise it forgoes the prizes inside. Moats that together fill no way more than its length, and
//! inside no set are worth more than its prizes, hence add up to a bound. All grow evenly, merge where
//! they touch, and rest where their prizes are used up or they reach the root.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// The root's component; others are named by one of their nodes.
const NONE: u32 = u32::MAX;

/// Ways along which moats are watched. The others are looked at when a bound is to hold.
#[derive(Debug)]
pub struct Watched {
    /// By node, the way to the root.
    pub root_m: Vec<f64>,
    /// By node, the other ends and lengths.
    pub near: Vec<Vec<(u32, f64)>>,
}

/// Moats at the end of their growth.
#[derive(Debug)]
pub struct Moats {
    /// What a tour travels and forgoes at least.
    pub value: f64,
    /// The ways that were not watched and are filled beyond their length.
    pub burst: Vec<(u32, u32)>,
    /// The least share of its load that such a way can take.
    pub share: f64,
}

#[derive(Clone, Debug, Default)]
struct Moat {
    members: Vec<u32>,
    /// Width so far, for all members alike.
    width: f64,
    /// When `width` and `left` were right, while it grows.
    since: f64,
    /// Prizes not yet used up.
    left: f64,
    grows: bool,
    /// Tells a note of when it rests from one that is out of date.
    stamp: u32,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Event {
    /// Two nodes may touch; the root is `NONE`.
    Touch(u32, u32),
    /// A moat has used up its prizes.
    Rest(u32, u32),
}

/// A time that orders; never negative, so that its bits do.
fn key(time: f64) -> u64 {
    time.max(0.0).to_bits()
}

struct Growth<'w> {
    watched: &'w Watched,
    moats: Vec<Moat>,
    /// By node, its moat; the last moat is the root's.
    of: Vec<u32>,
    /// By node, what its moats are wider in all than the present one says.
    inner: Vec<f64>,
    events: BinaryHeap<Reverse<(u64, Event)>>,
    now: f64,
    value: f64,
}

/// Grows moats for nodes with these prizes, in metres, and ends with all ways looked at if `way` measures
/// them. A node without a prize takes no part.
pub fn grow(watched: &Watched, prizes: &[f64], way: Option<&dyn Fn(u32, u32) -> f64>) -> Moats {
    let n = prizes.len();
    let moat = |i: usize| Moat {
        members: if prizes[i] > 0.0 { vec![i as u32] } else { Vec::new() },
        left: prizes[i].max(0.0),
        ..Moat::default()
    };
    let mut growth = Growth {
        watched,
        moats: (0..n).map(moat).chain([Moat::default()]).collect(),
        of: (0..n as u32).collect(),
        inner: vec![0.0; n],
        events: BinaryHeap::new(),
        now: 0.0,
        value: 0.0,
    };
    let mut moats = Moats { value: 0.0, burst: Vec::new(), share: 1.0 };
    for (i, &prize) in prizes.iter().enumerate() {
        if prize > 0.0 {
            growth.wake(i);
        }
    }
    for i in 0..n as u32 {
        growth.watch(i, prizes);
    }
    while let Some(Reverse((time, event))) = growth.events.pop() {
        growth.now = f64::from_bits(time);
        match event {
            Event::Rest(moat, stamp) => {
                if growth.moats[moat as usize].stamp == stamp {
                    growth.sync(moat as usize);
                    growth.moats[moat as usize].grows = false;
                }
            }
            Event::Touch(a, b) => {
                if let Some((one, other)) = growth.touching(a, b) {
                    if let Some(way) = way {
                        growth.look(one, other, way, &mut moats);
                    }
                    growth.merge(one, other, prizes);
                }
            }
        }
    }
    if let Some(way) = way {
        for one in 0..=n {
            for other in 0..one {
                growth.look(one, other, way, &mut moats);
            }
        }
    }
    moats.value = growth.value;
    moats
}

impl Growth<'_> {
    fn root(&self) -> usize {
        self.moats.len() - 1
    }

    /// Lets a moat grow from now on.
    fn wake(&mut self, moat: usize) {
        let m = &mut self.moats[moat];
        (m.grows, m.since) = (true, self.now);
        m.stamp += 1;
        if m.left < f64::INFINITY {
            let rests = self.now + 0.5 * m.left.max(0.0);
            self.events.push(Reverse((key(rests), Event::Rest(moat as u32, m.stamp))));
        }
    }

    /// Notes when the ways from a node may fill up.
    fn watch(&mut self, i: u32, prizes: &[f64]) {
        if prizes[i as usize] <= 0.0 {
            return;
        }
        let watched = self.watched;
        self.note(i, NONE, watched.root_m[i as usize]);
        for &(other, way) in &watched.near[i as usize] {
            // Where both grow one note is enough.
            if prizes[other as usize] > 0.0 {
                self.note(i, other, way);
            }
        }
    }

    fn note(&mut self, a: u32, b: u32, way: f64) {
        let (one, other) = (self.moat_of(a), self.moat_of(b));
        let rate = u8::from(self.moats[one].grows) + u8::from(self.moats[other].grows);
        if one != other && rate > 0 {
            let slack = way - self.width(a) - self.width(b);
            let time = self.now + (slack / f64::from(rate)).max(0.0);
            self.events.push(Reverse((key(time), Event::Touch(a, b))));
        }
    }

    fn moat_of(&self, i: u32) -> usize {
        if i == NONE { self.root() } else { self.of[i as usize] as usize }
    }

    /// How far the moats round a node reach.
    fn width(&self, i: u32) -> f64 {
        if i == NONE {
            return 0.0;
        }
        let moat = &self.moats[self.of[i as usize] as usize];
        let new = if moat.grows { self.now - moat.since } else { 0.0 };
        self.inner[i as usize] + moat.width + new
    }

    fn sync(&mut self, moat: usize) {
        let m = &mut self.moats[moat];
        if m.grows {
            let new = self.now - m.since;
            m.width += new;
            m.left -= 2.0 * new;
            m.since = self.now;
            self.value += 2.0 * new;
        }
    }

    /// The two moats of nodes whose way is full; else it is noted again for when it may be.
    fn touching(&mut self, a: u32, b: u32) -> Option<(usize, usize)> {
        let (one, other) = (self.moat_of(a), self.moat_of(b));
        let rate = u8::from(self.moats[one].grows) + u8::from(self.moats[other].grows);
        if one == other || rate == 0 {
            return None;
        }
        let way = if b == NONE {
            self.watched.root_m[a as usize]
        } else {
            self.watched.near[a as usize].iter().find(|(to, _)| *to == b)?.1
        };
        let slack = way - self.width(a) - self.width(b);
        if slack > 1e-9 * (1.0 + way) {
            self.note(a, b, way);
            return None;
        }
        Some((one, other))
    }

    /// Joins two moats into one that grows, or rests at the root.
    fn merge(&mut self, one: usize, other: usize, prizes: &[f64]) {
        self.sync(one);
        self.sync(other);
        let root = self.root();
        let larger = self.moats[one].members.len() >= self.moats[other].members.len();
        let into_one = one == root || other != root && larger;
        let (into, from) = if into_one { (one, other) } else { (other, one) };
        let woken: Vec<u32> = if into == root {
            Vec::new()
        } else {
            let rested = [into, from].into_iter().filter(|&moat| !self.moats[moat].grows);
            rested.flat_map(|moat| self.moats[moat].members.clone()).collect()
        };
        let old = std::mem::take(&mut self.moats[from]);
        self.moats[from].stamp = old.stamp + 1;
        for &i in &old.members {
            self.of[i as usize] = into as u32;
            self.inner[i as usize] += old.width - self.moats[into].width;
        }
        self.moats[into].members.extend(old.members);
        self.moats[into].left += old.left;
        if into != root {
            self.wake(into);
            for i in woken {
                self.watch(i, prizes);
            }
        }
    }

    /// Looks for ways between two moats that are filled beyond their length.
    fn look(&self, one: usize, other: usize, way: &dyn Fn(u32, u32) -> f64, found: &mut Moats) {
        for &a in &self.moats[one].members {
            let width = self.width(a);
            for &b in &self.moats[other].members {
                let load = width + self.width(b);
                let way = way(a, b);
                if load > way + 1e-8 * (1.0 + way) {
                    found.burst.push((a, b));
                    found.share = found.share.min(way / load);
                }
            }
        }
    }
}
