//! Which texts find room: a coarse map of what is taken, so that a crowd thins itself out at constant
//! cost a label, however many there are.

use ::svg::node::element::{Group, Text};

use super::text;
use super::view::{LEFT, TOP, View, WIDTH, tenth};

const CELL: f64 = 4.0;

/// The map's cells that something stands on.
pub(super) struct Room {
    columns: usize,
    rows: usize,
    taken: Vec<bool>,
}

/// A box, by its corners.
#[derive(Clone, Copy)]
pub(super) struct Area {
    low: [f64; 2],
    high: [f64; 2],
}

impl Area {
    /// A square around a place.
    pub fn around([x, y]: [f64; 2], reach: f64) -> Self {
        Self { low: [x - reach, y - reach], high: [x + reach, y + reach] }
    }
}

impl Room {
    /// An empty map.
    pub fn new(view: &View) -> Self {
        let columns = (WIDTH / CELL).ceil() as usize;
        let rows = (view.height / CELL).ceil() as usize;
        Self { columns, rows, taken: vec![false; columns * rows] }
    }

    /// Marks an area as taken.
    pub fn take(&mut self, area: Area) {
        let [columns, rows] = self.cells(area);
        for row in rows {
            let start = row * self.columns;
            self.taken[start + columns.start..start + columns.end].fill(true);
        }
    }

    /// Takes an area, if it is wholly on the map and free.
    pub fn claim(&mut self, area: Area) -> bool {
        let [across, down] = [WIDTH, self.rows as f64 * CELL];
        let on_map = area.low[0] >= LEFT
            && area.low[1] >= TOP
            && area.high[0] <= LEFT + across
            && area.high[1] <= TOP + down;
        let [columns, mut rows] = self.cells(area);
        let free = on_map
            && rows.all(|row| {
                let start = row * self.columns;
                !self.taken[start + columns.start..start + columns.end].contains(&true)
            });
        if free {
            self.take(area);
        }
        free
    }

    /// Takes what lies under a line.
    pub fn take_line(&mut self, [from, to]: [[f64; 2]; 2]) {
        let long = (to[0] - from[0]).hypot(to[1] - from[1]);
        let steps = (long / CELL).clamp(1.0, 1000.0).ceil();
        let mut step = 0.0;
        while step <= steps {
            let at = [0, 1].map(|axis| from[axis] + (to[axis] - from[axis]) * step / steps);
            self.take(Area::around(at, 0.5));
            step += 1.0;
        }
    }

    /// Writes a text beside a mark of that radius, if one of eight places is free; else further out.
    pub fn write_near(
        &mut self,
        into: Group,
        words: &str,
        class: &str,
        at: [f64; 2],
        radius: f64,
    ) -> Group {
        let before = into.get_children().len();
        let into = self.write(into, words, class, at, radius);
        if into.get_children().len() > before {
            return into;
        }
        self.write(into, words, class, at, radius + 12.0)
    }

    /// Writes a text beside a mark of that radius, if one of eight places is free.
    pub fn write(
        &mut self,
        into: Group,
        words: &str,
        class: &str,
        at: [f64; 2],
        radius: f64,
    ) -> Group {
        const SIZE: f64 = 10.5;
        let wide = text::width(words, SIZE);
        let aside = radius + 3.0;
        let diagonal = radius * 0.7 + 2.0;
        let places = [
            (aside, -SIZE / 2.0),
            (-aside - wide, -SIZE / 2.0),
            (-wide / 2.0, -aside - SIZE),
            (-wide / 2.0, aside),
            (diagonal, -diagonal - SIZE),
            (diagonal, diagonal),
            (-diagonal - wide, -diagonal - SIZE),
            (-diagonal - wide, diagonal),
        ];
        for (dx, dy) in places {
            let low = [at[0] + dx, at[1] + dy];
            if self.claim(Area { low, high: [low[0] + wide, low[1] + SIZE] }) {
                let label = Text::new(words)
                    .set("class", class)
                    .set("x", tenth(low[0]))
                    .set("y", tenth(low[1] + SIZE * 0.86));
                return into.add(label);
            }
        }
        into
    }

    fn cells(&self, area: Area) -> [std::ops::Range<usize>; 2] {
        let span = |low: f64, high: f64, count: usize| {
            // A cast from a float saturates, so that what lies off the map is cut.
            let start = ((low / CELL).floor().max(0.0) as usize).min(count);
            let end = ((high / CELL).ceil().max(0.0) as usize).min(count);
            start..end.max(start)
        };
        [
            span(area.low[0] - LEFT, area.high[0] - LEFT, self.columns),
            span(area.low[1] - TOP, area.high[1] - TOP, self.rows),
        ]
    }
}
