//! What a tour can gain at most within its capacity or its time: a price on the scarce resource, and moats
//! for what travelling costs at that price.
//!
//! Any price gives a bound (Lagrange): the tour pays for what it uses and is given the limit. What is left is a
//! prize-collecting tour, which [`grow`] bounds. The bound is nearly convex in the price, so that a golden
//! section finds a good one.

use super::moats::{Watched, grow};
use super::quick::Care;
use super::{Model, Places};

/// Nearest others along which moats are watched.
const NEAR: usize = 8;
/// Beyond so many candidates travelling is taken to cost nothing.
const MOST: usize = 3_000;
/// Candidates for which prices are tried, counted once a price, and prices tried at least and at most.
const WORK: usize = 16_000;
const LEAST_PRICES: usize = 6;
const MOST_PRICES: usize = 16;
/// How often the ways that moats have burst are watched too.
const REPAIRS: usize = 3;

/// What the tour has only so much of.
struct Scarce {
    limit: f64,
    /// By open candidate.
    uses: Vec<f64>,
    per_m: f64,
}

/// No tour gains more.
pub fn most_gain(model: &Model<'_>, places: &Places, incumbent_gain: f64, care: Care) -> f64 {
    let instance = &model.wide;
    let charger = &instance.scenario.charger;
    let gains: Vec<f64> = places.open.iter().map(|&i| model.gains[i as usize]).collect();
    let mut most: f64 = gains.iter().sum();
    let charges = || places.open.iter().map(|&i| places.charge_j[i as usize]);
    let energy =
        Scarce { limit: instance.capacity_j, uses: charges().collect(), per_m: charger.travel_jpm };
    let time = Scarce {
        limit: last_finish_s(model, places).min(instance.timespan_s),
        uses: charges().map(|charge_j| charge_j / charger.transfer_w).collect(),
        per_m: 1.0 / charger.speed_mps,
    };
    let mut market = Market { places, watched: watched(model, places), gains };
    for scarce in [energy, time] {
        if scarce.limit.is_finite() && most > 0.0 {
            most = most.min(market.best(&scarce, incumbent_gain, care));
        }
    }
    most
}

/// The latest arrival at the end that deadlines allow, in seconds.
fn last_finish_s(model: &Model<'_>, places: &Places) -> f64 {
    let instance = &model.wide;
    if instance.moving {
        return f64::INFINITY;
    }
    let charger = &instance.scenario.charger;
    let after = |&i: &u32| {
        let c = &instance.candidates[i as usize];
        let leg_m = instance.distance_m(i as usize, instance.end());
        c.due_s + c.target_j / charger.transfer_w + leg_m / charger.speed_mps
    };
    let none_s = instance.distance_m(instance.start(), instance.end()) / charger.speed_mps;
    places.open.iter().map(after).fold(none_s, f64::max)
}

fn watched(model: &Model<'_>, places: &Places) -> Watched {
    let instance = &model.wide;
    let open = &places.open;
    let root = |&i: &u32| {
        let i = i as usize;
        places.least_m(instance.start(), i).min(places.least_m(i, instance.end()))
    };
    let mut near: Vec<Vec<(u32, f64)>> = vec![Vec::new(); open.len()];
    let k = NEAR.min(open.len().saturating_sub(1));
    if open.len() <= MOST && k > 0 {
        let mut ways: Vec<(f64, u32)> = Vec::new();
        for a in 0..open.len() {
            ways.clear();
            let others = (0..open.len()).filter(|&b| b != a);
            let way = |b: usize| places.least_m(open[a] as usize, open[b] as usize);
            ways.extend(others.map(|b| (way(b), b as u32)));
            ways.select_nth_unstable_by(k - 1, |x, y| x.0.total_cmp(&y.0).then(x.1.cmp(&y.1)));
            for &(way, b) in &ways[..k] {
                near[a].push((b, way));
                near[b as usize].push((a as u32, way));
            }
        }
        for ways in &mut near {
            ways.sort_unstable_by_key(|(b, _)| *b);
            ways.dedup_by_key(|(b, _)| *b);
        }
    }
    Watched { root_m: open.iter().map(root).collect(), near }
}

struct Market<'p> {
    places: &'p Places,
    watched: Watched,
    gains: Vec<f64>,
}

impl Market<'_> {
    /// The bound at a good price.
    fn best(&mut self, scarce: &Scarce, incumbent_gain: f64, care: Care) -> f64 {
        let all: f64 = self.gains.iter().sum();
        let limit = scarce.limit.max(1e-9);
        let known = if incumbent_gain > 0.0 { incumbent_gain } else { 0.5 * all };
        // Gain by unit of what is scarce falls with every stop: the last is worth less than the average.
        let middle = (known / limit).ln();
        let (mut low, mut high) = (middle - 2.5, middle + 0.8);
        let golden = 0.5 * (5.0_f64.sqrt() - 1.0);
        let prices = match care {
            Care::Whole => (WORK / self.gains.len().max(1)).clamp(LEAST_PRICES, MOST_PRICES),
            Care::Little => LEAST_PRICES,
        };
        let mut value = |log: f64| self.gain(scarce, log.exp(), false);
        let (mut a, mut b) = (high - golden * (high - low), low + golden * (high - low));
        let (mut at_a, mut at_b) = (value(a), value(b));
        for _ in 2..prices {
            if at_a <= at_b {
                (high, b, at_b) = (b, a, at_a);
                a = high - golden * (high - low);
                at_a = value(a);
            } else {
                (low, a, at_a) = (a, b, at_b);
                b = low + golden * (high - low);
                at_b = value(b);
            }
        }
        let price = if at_a <= at_b { a } else { b };
        self.gain(scarce, price.exp(), true)
    }

    /// What a tour gains at most, and is given, at a price; only if it is to hold, all ways are looked at.
    fn gain(&mut self, scarce: &Scarce, price: f64, hold: bool) -> f64 {
        let worth = |(gain, uses): (&f64, &f64)| (gain - price * uses).max(0.0);
        let worths: Vec<f64> = self.gains.iter().zip(&scarce.uses).map(worth).collect();
        let sum: f64 = worths.iter().sum();
        let per_m = price * scarce.per_m;
        let given = price * scarce.limit;
        let small = 1e-12 * (1.0 + sum + given.abs());
        if per_m * 1e12 <= sum || worths.len() > MOST {
            return given + sum + small;
        }
        let prizes: Vec<f64> = worths.iter().map(|worth| worth / per_m).collect();
        let places = self.places;
        let way = |a: u32, b: u32| {
            places.least_m(places.open[a as usize] as usize, places.open[b as usize] as usize)
        };
        let mut moats = grow(&self.watched, &prizes, if hold { Some(&way) } else { None });
        for _ in 0..REPAIRS {
            if moats.burst.is_empty() {
                break;
            }
            for &(a, b) in &moats.burst {
                self.watched.near[a as usize].push((b, way(a, b)));
                self.watched.near[b as usize].push((a, way(a, b)));
            }
            moats = grow(&self.watched, &prizes, Some(&way));
        }
        // Narrower moats fill no way beyond its length.
        let saved = per_m * moats.value * moats.share * (1.0 - 1e-8);
        given + sum - saved.max(0.0) + small
    }
}
